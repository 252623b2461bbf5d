#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A primitive with many layers: bindings and shaders need memory in proportion to them; what grows with their square does not fit.

Arguments: mxgen, the number of layers."""
import pathlib
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish

MXGEN, COUNT = pathlib.Path(sys.argv[1]).resolve(), int(sys.argv[2])
MOST_BYTES = 50000  # for each layer


def write(folder):
    lines, assigns = ['<?xml version="1.0"?><materialx version="1.39">'], []
    for i in range(COUNT):
        lines.append(f'<surface_unlit name="s{i}" type="surfaceshader"/><substance name="m{i}" type="material">'
                     f'<input name="surfaceshader" type="surfaceshader" nodename="s{i}"/><input name="mask" type="float" value="0.5"/></substance>')
        assigns.append(f'<materialassign slot="{i:05}" material="m{i}" geom="/"/>')
    (folder / "look.mtlx").write_text("\n".join(lines + ['<look name="L">'] + assigns + ["</look></materialx>"]), encoding="utf-8")
    (folder / "stage.txt").write_text("/a\n", encoding="utf-8")


def run(folder, what, *arguments):
    command = [MXGEN, *arguments, "--stage", "stage.txt", "--look", "L", "--max-memory", str(COUNT * MOST_BYTES)]
    result = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    check(result.returncode == 0 and not result.stderr, f"{COUNT} layers, {what}: {result.stderr[-500:]}")


with tempfile.TemporaryDirectory() as name:
    write(pathlib.Path(name))
    run(name, "bindings", "bind", "look.mtlx", "--json", "out.json")
    for mode in "blend", "stochastic":
        for interface in "reduced", "complete":
            run(name, f"{mode}, {interface}", "look.mtlx", "--target", "vulkan", "--slots", mode, "--interface", interface, "-o", "out")
finish("layers-of-one")
