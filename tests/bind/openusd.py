#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every .usda file in the testenv folders of OpenUSD's sources is read, or has a message with its line and column. Argument: the program.
The variable MXGEN_OPENUSD names the sources; without it the test is skipped."""
import collections
import os
import pathlib
import re
import subprocess
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish, skip

MXGEN, SOURCES = pathlib.Path(sys.argv[1]).resolve(), os.environ.get("MXGEN_OPENUSD")


def read(path, ids):
    """Binds a layer; its errors must have a place."""
    run = subprocess.run([MXGEN, "bind", "--stage", path, "--json", os.devnull], capture_output=True, text=True, errors="replace", timeout=600,
                         check=False)
    errors = re.findall(r"^(.*): error: .*\[([a-z-]+)\]$", run.stderr, re.MULTILINE)
    check(run.returncode == (1 if errors else 0), f"{path}: exit code {run.returncode}\n{run.stderr[:500]}")
    check(all(re.search(r":\d+:\d+$", place) for place, _ in errors), f"{path}: an error without a place\n{run.stderr[:500]}")
    for kind in {kind for _, kind in errors} or {"read"}:
        ids[kind] += 1


if not SOURCES:
    skip("MXGEN_OPENUSD does not name the sources of OpenUSD")
else:
    files = [path for path in sorted(pathlib.Path(SOURCES).rglob("*.usda")) if "testenv" in path.parts]
    counts = collections.Counter()
    for layer in files:
        read(layer, counts)
    print(f"{len(files)} files:", ", ".join(f"{number} {kind}" for kind, number in counts.most_common()))
finish("bind-openusd")
