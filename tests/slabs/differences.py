#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tests/balls.py, which other tests measure pictures with: CIEDE2000 of pairs with known differences, CIELAB, and the pixels that count."""
import math
import pathlib
import re
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
import balls
from checks import check, finish

SIZE = 40


def check_pairs():
    rows = re.findall(r"^PAIR\((.*)\)$", (HERE.parent / "unit/differences.def").read_text(), re.MULTILINE)
    check(len(rows) >= 7, f"differences.def has {len(rows)} pairs")
    for row in rows:
        *colors, wanted = map(float, row.split(", "))
        for pair in (colors[:3], colors[3:]), (colors[3:], colors[:3]):
            got = balls.difference(*pair)
            check(abs(got - wanted) < 1e-4, f"{pair}: {got}, not {wanted}")


def check_lab():
    for color, wanted in {(0, 0, 0): (0, 0, 0), (255, 255, 255): (100, 0, 0), (255, 0, 0): (53.2408, 80.0925, 67.2032)}.items():
        got = balls.lab(color)
        check(math.dist(got, wanted) < 0.02, f"CIELAB of {color}: {got}, not {wanted}")


def picture(path, color_at):
    pixels = (color_at(math.hypot(x + 0.5 - SIZE / 2, y + 0.5 - SIZE / 2) / SIZE, x) for y in range(SIZE) for x in range(SIZE))
    path.write_bytes(b"P6\n%d %d\n255\n" % (SIZE, SIZE) + bytes(value for color in pixels for value in color))
    return path


def check_ball(folder):
    """The mean of the ball alone: nothing around it counts, and half of it counts for half."""
    black, white = (0, 0, 0), (255, 255, 255)
    dark = picture(folder / "dark.ppm", lambda away, x: black)
    for name, wanted, color_at in (("around", 0, lambda away, x: black if away < 0.36 else white),
                                   ("ball", 100, lambda away, x: white if away < 0.36 else black),
                                   ("half", 50, lambda away, x: white if x < SIZE / 2 else black)):
        got = balls.compare(dark, picture(folder / f"{name}.ppm", color_at))
        check(abs(got - wanted) < 0.01, f"{name}: {got}, not {wanted}")


check_pairs()
check_lab()
with tempfile.TemporaryDirectory() as name:
    check_ball(pathlib.Path(name))
finish("slab-differences")
