#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""An edit takes the same work in a small and in a large document, and in a long series. Counted are instructions of bench-edit, which makes
edits of all kinds. Arguments: bench-edit."""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import checks  # noqa: E402

KINDS = ["value", "input", "node", "material", "connection", "name", "graph", "removal", "move", "copy"]
SMALL, LARGE, SERIES = 30, 400, 30
MOST = 1.5  # times the instructions of an edit; work for the whole document would take 13 times


def work(program, materials, edits, kind):
    """Instructions."""
    count, done = checks.count_instructions(program, materials, edits, kind)
    checks.check(done.returncode == 0 and count, f"{kind}: ends with {done.returncode}")
    return count


def main():
    program = sys.argv[1]
    if not checks.counts_instructions():
        checks.finish("edits")
    small, large = (work(program, materials, 0, "") for materials in (SMALL, LARGE))
    for kind in KINDS:
        one = work(program, SMALL, SERIES, kind) - small
        many = work(program, LARGE, SERIES, kind) - large
        checks.check(many < MOST * one, f"{kind}: {one / SERIES:.0f} instructions in a small document, {many / SERIES:.0f} in a large one")
    checks.finish("edits")


main()
