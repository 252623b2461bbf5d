#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The work of binding grows in proportion to the primitives, and to the assignments, and is within 3 times of the work of reading the paths:
scenes of depth 12 under 200 assignments with patterns and collections. Counted are instructions, which do not depend on the machine.

Arguments: mxgen, the number of primitives."""
import pathlib
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, count_instructions, counts_instructions, finish

MXGEN, COUNT = pathlib.Path(sys.argv[1]).resolve(), int(sys.argv[2])
FACTOR, MOST, MOST_OF_READING = 8, 8.8, 3.0


def write_stage(path, count):
    """Leaves below groups of ten, ten levels of them: each leaf adds 1.1 primitives at most."""
    with open(path, "w", encoding="utf-8") as file:
        for i in range(count):
            groups = "/".join(f"g{level}_{i // 10 ** max(11 - level, 1)}" for level in range(1, 12))
            file.write(f"/{groups}/leaf_{i}\n")


def write_look(path, count):
    """`count` assignments: patterns of names, of all levels and of leaves, collections with exclusions, overrides."""
    lines = ['<?xml version="1.0"?><materialx version="1.39">', '<surface name="s" type="surfaceshader"/>',
             '<surfacematerial name="A" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>',
             '<nodegraph name="NG"><constant name="c" type="float"/><output name="opacity" type="float" nodename="c"/></nodegraph>']
    lines += [f'<collection name="C{i}" includegeom="//g11_*{i}, //leaf_*{i}" excludegeom="//leaf_*3{i}"/>' for i in range(20)]
    lines.append('<look name="L">')
    kinds = ['slot="{slot}" material="A" geom="//g10_*{i}"', 'slot="{slot}" material="A" geom="//g9_{{{i},{i}*}}//*"',
             'slot="{slot}" material="" collection="C{few}"', 'slot="{slot}::x" nodegraph="NG" geom="//leaf_[0-4]*{i}"']
    lines += [f"<materialassign {kinds[i % 4].format(slot=f's{i % 8}', i=i, few=i % 20)}/>" for i in range(count)]
    path.write_text("\n".join(lines) + "</look></materialx>\n", encoding="utf-8")


def work(folder, stage, look):
    """Instructions, in millions."""
    count, done = count_instructions(MXGEN, "bind", folder / look, "--stage", folder / stage, "--geom", "/g1_0", "--quiet")
    check(done.returncode == 0 and count, f"{stage}, {look}: ends with {done.returncode}: {done.stderr[-500:]}")
    return count / 1e6 or 1


def main():
    if not counts_instructions():
        return
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for number, count in enumerate([1, COUNT, FACTOR * COUNT]):
            write_stage(folder / f"stage{number}", count)
        for count in 0, 25, 200:
            write_look(folder / f"look{count}.mtlx", count)
        none, few, many = (work(folder, f"stage{number}", "look200.mtlx") for number in range(3))
        reading = work(folder, "stage2", "look0.mtlx") - work(folder, "stage0", "look0.mtlx")
        some = work(folder, "stage2", "look25.mtlx")
    print(f"{FACTOR * COUNT} leaves: {many - none:.0f} M instructions with 200 assignments, {reading:.0f} M with none; {COUNT} leaves: {few - none:.0f} M")
    check((many - none) / (few - none) < MOST, f"{(many - none) / (few - none):.2f} times the work for {FACTOR} times the primitives")
    check((many - none) / reading < MOST_OF_READING, f"binding takes {(many - none) / reading:.2f} times the work of reading")
    # Eight times the assignments: each primitive is in some more of them.
    check((many - none) / (some - none) < FACTOR, f"{(many - none) / (some - none):.2f} times the work for {FACTOR} times the assignments")


main()
finish("scale")
