#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The variance of paths that pick one closure, and of all closures, is what the table of docs/slabs.md ("Picking one closure") lists.

Arguments: mxgen, the root of the sources."""
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree as ET

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish, skip

MXGEN, ROOT = sys.argv[1], pathlib.Path(sys.argv[2])
DOCUMENTS = [ROOT / "examples/slabs.mtlx", ROOT / "examples/slab_blends.mtlx", ROOT / "examples/slab_helpers.mtlx", ROOT / "tests/golden/models.mtlx"]
ROW = re.compile(r"^\| `(\w+)` \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \|$", re.MULTILINE)
# Paths are the same in each run; another device rounds otherwise.
NEAR, SHARE = 0.01, 0.02


def rows_of(text):
    return {name: list(map(float, numbers)) for name, *numbers in ROW.findall(text)}


section = (ROOT / "docs/slabs.md").read_text().partition("**Picking one closure.**")[2].partition("\n## ")[0]
listed = rows_of(section)
elements = {material.get("name"): f"{path}#{material.get('name')}" for path in DOCUMENTS
            for material in ET.parse(path).getroot().findall("surfacematerial")}
check(len(listed) >= 8, f"docs/slabs.md lists {listed}")
made = subprocess.run([ROOT / "bench/variance.py", MXGEN, *(elements[name] for name in listed)], capture_output=True, text=True, timeout=900)
if "no-device" in made.stderr:
    skip("there is no Vulkan device")
    finish("slab-picks")
drawn = rows_of(made.stdout)
check(drawn.keys() == listed.keys(), f"not all materials are drawn: {made.stdout}{made.stderr}")
for name, numbers in drawn.items():
    check(all(abs(a - b) <= NEAR + SHARE * b for a, b in zip(numbers, listed[name])), f"{name}: {numbers}, and docs/slabs.md has {listed[name]}")
finish("slab-picks")
