#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""An edit takes the same work in a small and in a large document, and in a long series. Counted are instructions of bench-edit, which makes
edits of all kinds. Arguments: bench-edit."""

import os
import re
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import checks  # noqa: E402

KINDS = ["value", "input", "node", "material", "connection", "name", "graph", "removal", "move", "copy"]
SMALL, LARGE, SERIES = 30, 400, 30
MOST = 1.5  # times the instructions of an edit; work for the whole document would take 13 times


def work(program, materials, edits, kind):
    """Instructions."""
    counter = ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null"]
    run = subprocess.run(counter + [program, str(materials), str(edits), kind], capture_output=True, check=False)
    found = re.findall(rb"I +refs: +([\d,]+)", run.stderr)
    checks.check(run.returncode == 0 and found, f"{kind}: ends with {run.returncode}")
    return int(found[-1].replace(b",", b""))


def main():
    program = sys.argv[1]
    if not shutil.which("valgrind") or os.environ.get("SANITIZER"):
        checks.skip("valgrind is not installed, or a sanitizer is in the program: no instructions are counted")
        checks.finish("edits")
    small, large = (work(program, materials, 0, "") for materials in (SMALL, LARGE))
    for kind in KINDS:
        one = work(program, SMALL, SERIES, kind) - small
        many = work(program, LARGE, SERIES, kind) - large
        checks.check(many < MOST * one, f"{kind}: {one / SERIES:.0f} instructions in a small document, {many / SERIES:.0f} in a large one")
    checks.finish("edits")


main()
