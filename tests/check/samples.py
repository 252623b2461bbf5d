#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The samples in the documentation of mxgen check are what the program prints: runs the commands of each block ```console, one after the
other, in a folder with the documents below. Hashes, and numbers of three digits and more, may differ: they depend on the compiler. With
--update it writes the output into the page. Arguments: mxgen, the page, [--update]."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish

MATERIAL = """<?xml version="1.0"?>
<materialx version="1.39">
  <standard_surface name="SR_{name}" type="surfaceshader">
    <input name="specular_roughness" type="float" value="{roughness}"/>
  </standard_surface>
  <surfacematerial name="{name}" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="SR_{name}"/>
  </surfacematerial>
</materialx>
"""


def make_show(folder):
    """Two materials, one with a misspelled node, and a table whose input is misspelled."""
    (folder / "show/props").mkdir(parents=True)
    lamp = MATERIAL.format(name="Lamp", roughness=0.4).replace("standard_surface ", "standard_surfase ").replace("</standard_surface", "</standard_surfase")
    (folder / "show/props/lamp.mtlx").write_text(lamp, encoding="utf-8")
    (folder / "show/props/vase.mtlx").write_text(MATERIAL.format(name="Vase", roughness=0.1), encoding="utf-8")
    (folder / "show/table.mtlx").write_text(MATERIAL.format(name="Table", roughness=0.5), encoding="utf-8")


def run(command, folder, mxgen):
    environment = {**os.environ, "PATH": f"{mxgen.parent}:{os.environ['PATH']}", "TERM": "dumb"}
    result = subprocess.run(["bash", "-c", command], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
                            env=environment)
    return result.stdout


def masked(text):
    return re.sub(r"\d{3,}", "N", re.sub(r"\b[0-9a-f]{16}\b", "H", re.sub(r"[+-]\d+\.\d %", "P %", text)))


def play(block, folder, mxgen):
    """The block with the output of now. A command goes on after a backslash."""
    commands = re.findall(r"^\$ (.*(?:\\\n.*)*)", block, re.M)
    return "".join(f"$ {command}\n{run(command, folder, mxgen)}" for command in commands)


def main(mxgen, page, update=None):
    mxgen, page = pathlib.Path(mxgen).resolve(), pathlib.Path(page)
    text = page.read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as work:
        make_show(pathlib.Path(work))
        blocks = re.findall(r"^```console\n(.*?)^```$", text, re.M | re.S)
        check(len(blocks) >= 5, f"{page} has {len(blocks)} samples")
        for block in blocks:
            now = play(block, work, mxgen)
            if update == "--update":
                text = text.replace(f"```console\n{block}```", f"```console\n{now}```")
            else:
                check(masked(now) == masked(block), f"{page.name} shows:\n{block}but the program prints:\n{now}")
    if update == "--update":
        page.write_text(text, encoding="utf-8")


main(*sys.argv[1:])
finish("check-samples")
