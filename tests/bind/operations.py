#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The cost of picked layers: the operations that shaders execute, counted by themselves on a device (bench/operations.h), for eight layers beside
one. Blended layers are the counter-case: they cost what they are.

Arguments: bench-slots, the folder bench."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path += [str(pathlib.Path(__file__).resolve().parent.parent), sys.argv[2]]
from checks import check, finish, skip
from slot_stacks import COUNTS, write_looks

GOAL = 1.6
MODES = "blend", "one number", "hash"


def ratios(document):
    """By look, the ratios to the first look of the three modes, for operations and for instructions; None without a device."""
    command = [sys.argv[1], "operations", document, *(f"L{count}" for count in (COUNTS[0], COUNTS[-1]))]
    env = dict(os.environ, MESA_SHADER_CACHE_DISABLE="true")
    out = subprocess.run(command, env=env, capture_output=True, text=True, check=True).stdout
    if out.startswith("skip: no Vulkan"):
        skip(out.strip())
        return None
    rows = re.findall(r"^\| (L\d) \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \|$", out, re.MULTILINE)
    return [dict(zip(MODES, map(float, row[1:])), look=row[0]) for row in rows]


with tempfile.TemporaryDirectory() as name:
    found = ratios(write_looks(pathlib.Path(name)))
if found is not None:
    check([row["look"] for row in found] == ["L1", f"L{COUNTS[-1]}"] * 2, f"rows of both counts: {found}")
    for one, many in found[:2], found[2:]:
        # a layer that is picked clamps its opacity once more
        check(all(1 <= one[mode] <= 1.01 for mode in MODES), f"one layer has the cost of one, picked or not: {one}")
        for mode in MODES[1:]:
            check(1 < many[mode] < GOAL, f"{COUNTS[-1]} layers, {mode}: {many[mode]} of one; the goal is {GOAL}")
        check(many["blend"] > 2 * GOAL, f"{COUNTS[-1]} layers blended: {many['blend']} of one, so the count would show them")
finish("bind-operations")
