#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The profiles of examples/slab_profiles.mtlx: slabs have the free paths and albedos that the measured coefficients give, by formula, and
light below the surface goes as far as the scale of the profile says.

Arguments: mxgen, mxgen-render ('': only the numbers), the root of the project."""
import math
import pathlib
import re
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path += [str(HERE.parent), str(HERE.parent / "osl")]
import radiance
from checks import check, finish, run, skip

MXGEN, RENDER, ROOT = (pathlib.Path(arg).resolve() if arg else None for arg in sys.argv[1:4])
DOCUMENT = ROOT / "examples/slab_profiles.mtlx"
MARBLE, SKIN, MILK = ((2.19, 2.62, 3.00), (0.0021, 0.0041, 0.0071)), ((0.74, 0.88, 1.01), (0.032, 0.17, 0.48)), ((2.55, 3.21, 3.77), (0.0011, 0.0024, 0.014))
# Each material with what Jensen et al. measured, per millimetre, and the scale of its free path.
MATERIALS = {"PolishedMarble": (MARBLE, 1), "WornMarble": (MARBLE, 1), "Skin": (SKIN, 1), "SmallSkin": (SKIN, 0.1), "Milk": (MILK, 1)}
SIZE, EDGE = 24, 3


def sent_back(scattering, absorption):
    """The diffuse albedo of an endless medium without a surface (Kulla and Conty 2017)."""
    s = math.sqrt(absorption / (scattering + absorption))
    return (1 - s) * (1 - 0.139 * s) / (1 + 1.17 * s)


def numbers_of(word, text):
    found = re.search(rf"{word} ([\d.]+(?:, [\d.]+)*)", text)
    return [float(number) for number in found.group(1).split(", ")] if found else []


def near(numbers, expected):
    return len(numbers) == len(expected) and all(abs(a / b - 1) < 0.001 for a, b in zip(numbers, expected))


def check_numbers(material):
    (scattering, absorption), scale = MATERIALS[material]
    result = run(MXGEN, "inspect", "--slabs", DOCUMENT, "-e", material)
    check(result.returncode == 0, f"inspect {material}: {result.stderr}")
    pairs = list(zip(scattering, absorption))
    check(near(numbers_of("albedo", result.stdout), [sent_back(*pair) for pair in pairs]), f"{material} has another albedo: {result.stdout}")
    check(near(numbers_of("mean free path", result.stdout), [0.1 * scale / sum(pair) for pair in pairs]),
          f"{material} has another free path: {result.stdout}")


def traced(folder, material):
    """Rows of a ball in the light of one lamp from the right, which leaves the left half to light below the surface; None: no device."""
    path = folder / f"{material}.hdr"
    dark = [word for light in (1, 2) for word in ("--set", f"u_lightData[{light}].intensity=0")]
    result = run(RENDER, DOCUMENT, "-e", material, "-q", "-m", "sphere", "--camera", "0,0", "-s", SIZE, "--environment", "none", "--path-trace",
                 "--paths", 16, "--set", "u_lightData[0].direction=-1,0,0", "--set", "u_lightData[0].intensity=3", *dark, "-o", path)
    if "no-device" in result.stderr:
        return None
    check(result.returncode == 0, f"render {material}: {result.stderr}")
    return radiance.read(path)


def shares(rows):
    """What is sent from right behind the edge of the light, over what is sent from where it is bright, in each colour."""
    middle = rows[SIZE // 2 - EDGE:SIZE // 2 + EDGE]
    sums = [[sum(row[x][c] for row in middle for x in columns) for c in range(3)]
            for columns in (range(SIZE // 2 - EDGE, SIZE // 2), range(SIZE // 2 + EDGE, SIZE // 2 + 2 * EDGE))]
    return [behind / lit for behind, lit in zip(*sums)]


def main():
    for material in MATERIALS:
        check_numbers(material)
    if not RENDER:
        finish("slab-profiles")
    with tempfile.TemporaryDirectory() as name:
        skin = traced(pathlib.Path(name), "Skin")
        if not skin:
            skip("without a Vulkan device nothing is drawn")
            finish("slab-profiles")
        near_edge, small = shares(skin), shares(traced(pathlib.Path(name), "SmallSkin"))
        print("skin", *(f"{share:.3f}" for share in near_edge), "at a tenth", *(f"{share:.3f}" for share in small))
        check(near_edge[0] > 1.5 * near_edge[1] > 2.25 * near_edge[2], f"red light does not go further in skin than green, nor that than blue: {near_edge}")
        check(near_edge[0] > 3 * small[0], f"light goes as far where the scale is a tenth: {near_edge[0]}, {small[0]}")
    finish("slab-profiles")


if __name__ == "__main__":
    main()
