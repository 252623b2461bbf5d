# SPDX-License-Identifier: Apache-2.0
"""Stacks of layers whose masks are textures, for bench/slots.py and for the test `bind-operations`."""
import math
import random

COUNTS = 1, 2, 4, 8


def write_mask(path, dice):
    """Smooth blobs, half of them covered."""
    waves = [(dice.uniform(1, 5), dice.uniform(1, 5), dice.uniform(0, 6.3)) for _ in range(4)]
    pixels = bytearray()
    for y in range(64):
        for x in range(64):
            value = sum(math.sin(a * x / 10 + b * y / 10 + c) for a, b, c in waves)
            pixels.append(max(0, min(255, int(127.5 + 100 * value))))
    path.write_bytes(b"P5\n64 64\n255\n" + bytes(pixels))


def write_looks(folder):
    """look.mtlx, with a look of each number of layers, L1 and so on: every layer has other values of the same inputs of standard_surface."""
    dice = random.Random(17)
    lines = ['<?xml version="1.0"?><materialx version="1.39">']
    for i in range(max(COUNTS)):
        write_mask(folder / f"mask{i}.pgm", dice)
        color, roughness = ", ".join(f"{dice.uniform(0.1, 0.8):.3f}" for _ in range(3)), f"{dice.uniform(0.2, 0.6):.3f}"
        lines.append(f'<image name="i{i}" type="float"><input name="file" type="filename" value="mask{i}.pgm"/></image>'
                     f'<standard_surface name="s{i}" type="surfaceshader"><input name="base_color" type="color3" value="{color}"/>'
                     f'<input name="specular_roughness" type="float" value="{roughness}"/><input name="metalness" type="float" value="0.{i + 1}"/>'
                     f'</standard_surface><substance name="m{i}" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s{i}"/>'
                     + (f'<input name="mask" type="float" nodename="i{i}"/>' if i else "") + "</substance>")
    for count in COUNTS:
        assigns = "".join(f'<materialassign slot="{i:03}" material="m{i}" geom="/"/>' for i in range(count))
        lines.append(f'<look name="L{count}">{assigns}</look>')
    (folder / "look.mtlx").write_text("\n".join(lines + ["</materialx>"]), encoding="utf-8")
    return folder / "look.mtlx"
