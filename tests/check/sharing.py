#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""mxgen check generates one of several elements of equal structure, where nobody reads more than messages: what it says is what it says with
--no-sharing. Arguments: mxgen, the folder of the sources, folders of documents of which some may not be there."""
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish, skip

MXGEN, ROOT = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2])
MATERIAL = """<standard_surface name="S{0}" type="surfaceshader">
  <input name="base" type="float" value="{1}"/><input name="coat" type="float" value="0.{0}"/>
</standard_surface>
<surfacematerial name="M{0}" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S{0}"/></surfacematerial>
"""


def run(folder, *arguments):
    """Everything that a run tells: exit code, output and reports."""
    reports = [f"{folder}/report.{kind}" for kind in ("sarif", "junit")]
    asked = [f"--sarif={reports[0]}", f"--junit={reports[1]}"]
    done = subprocess.run([MXGEN, "check", "--no-compile", *asked, *arguments], cwd=ROOT, capture_output=True, check=False)
    return done.returncode, done.stdout, done.stderr, *(pathlib.Path(report).read_bytes() for report in reports)


def check_alike(folder, *arguments):
    parts = ("exit code", "output", "errors", "SARIF", "JUnit")
    for part, shared, alone in zip(parts, run(folder, *arguments), run(folder, "--no-sharing", *arguments)):
        check(shared == alone, f"{part} of {' '.join(map(str, arguments))} is the same without sharing")


def write(folder, name, values):
    path = pathlib.Path(folder, name)
    materials = "".join(MATERIAL.format(number, value) for number, value in enumerate(values))
    path.write_text(f'<materialx version="1.39">{materials}</materialx>', encoding="utf-8")
    return path


def check_faults(folder):
    """A value that is none counts wherever it stands, though values of uniforms do not."""
    for name, values in {"good.mtlx": ["0.5", "0.6", "1"], "bad.mtlx": ["0.5", "0.6", "1x", "1x", "0.7"]}.items():
        path = write(folder, name, values)
        code, output, *_ = run(folder, path)
        check(code == (name == "bad.mtlx"), f"{name}: exit code {code}")
        check(output.count(b"bad-value") == values.count("1x"), f"{name}: {output.decode()}")
        check_alike(folder, path)


def seconds(*arguments):
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run([MXGEN, "check", "--no-compile", *arguments], stdout=subprocess.DEVNULL, check=True)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def check_time(folder):
    path = write(folder, "many.mtlx", [str(number / 4000) for number in range(4000)])
    shared, alone = seconds(path), seconds("--no-sharing", path)
    check(shared < 0.5 * alone, f"4,000 materials of one structure take {shared:.2f} s, {alone:.2f} s one by one")


with tempfile.TemporaryDirectory() as work:
    check_faults(work)
    check_time(work)
    for documents in sys.argv[3:]:
        if not pathlib.Path(documents).is_dir():
            skip(f"there is no folder {documents}")
            continue
        check_alike(work, "-j1", documents)
        check_alike(work, "--target=vulkan,osl", "--interface=reduced", "-v", documents)
finish("check-sharing")
