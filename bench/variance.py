#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The variance of a path tracer that picks one closure, and of one that evaluates all of them.

    bench/variance.py build/mxgen FILE[#ELEMENT]... [--size 48] [--picks 64]

Draws a sphere under the built-in sky by one path per pixel, with one bounce and no shadows, and compares it with many paths. Many picks of
a closure for each path, with the same directions and lights, stand for the sum of all closures. Prints a row for each material: the
mean squared error of a pixel over the square of the mean, of one pick and of all closures, and their ratio."""

import argparse
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tests/programs"))
import exr  # pylint: disable=wrong-import-position


def draw(args, material, paths, picks):
    """The colours of a picture as one list."""
    file, _, element = material.partition("#")
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "picture.exr"
        command = [args.mxgen, "render", file, "-q", "-o", out, "-m", "sphere", "--size", str(args.size), "--lights", "none", "--path-trace",
                   "--as-drawn", "--paths", str(paths), "--picks", str(picks)]
        subprocess.run(command + (["-e", element] if element else []), check=True)
        width, height, values = exr.read(out)
        return [values[c][y][x] for c in "RGB" for y in range(height) for x in range(width)]


def variance(picture, truth):
    """The mean squared error of a pixel over the square of the mean."""
    mean = sum(truth) / len(truth)
    return sum((a - b) ** 2 for a, b in zip(picture, truth)) / len(truth) / mean ** 2


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mxgen")
    parser.add_argument("materials", nargs="+", metavar="FILE[#ELEMENT]")
    parser.add_argument("--size", type=int, default=48)
    parser.add_argument("--picks", type=int, default=64)
    args = parser.parse_args()
    print("| material | one closure | all closures | ratio |\n| --- | --- | --- | --- |")
    for material in args.materials:
        truth = draw(args, material, 64, 16)
        one, every = (variance(draw(args, material, 1, picks), truth) for picks in (1, args.picks))
        name = material.partition("#")[2] or pathlib.Path(material).stem
        print(f"| `{name}` | {one:.2f} | {every:.2f} | {one / every:.2f} |", flush=True)


if __name__ == "__main__":
    main()
