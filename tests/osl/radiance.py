# SPDX-License-Identifier: Apache-2.0
"""Reads pictures in Radiance's format (Ward, "Real Pixels", Graphics Gems II): a mantissa of 8 bits for each colour, and one exponent."""
import math
import re


def encoded(pixel):
    _, exponent = math.frexp(max(pixel))
    return bytes([int(c * 2.0 ** (8 - exponent)) for c in pixel] + [exponent + 128])


def write(path, rows):
    head = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {len(rows)} +X {len(rows[0])}\n"
    path.write_bytes(head.encode() + b"".join(encoded(pixel) for row in rows for pixel in row))


def write_constant(path, value, width=8, height=4):
    write(path, [[(value, value, value)] * width] * height)


def read_runs(data, at, width):
    """One channel of a row: a run of n > 128 is n - 128 times the byte that follows, any other the next n bytes."""
    values = bytearray()
    while len(values) < width:
        count = data[at]
        if count > 128:
            values += data[at + 1:at + 2] * (count - 128)
            at += 2
        else:
            values += data[at + 1:at + 1 + count]
            at += 1 + count
    return values, at


def read_row(data, at, width):
    if data[at:at + 2] != b"\2\2":
        return [tuple(data[at + 4 * x:at + 4 * x + 4]) for x in range(width)], at + 4 * width
    at += 4
    channels = []
    for _ in range(4):
        channel, at = read_runs(data, at, width)
        channels.append(channel)
    return list(zip(*channels)), at


def read(path):
    """Rows of pixels of three numbers. A mantissa stands for the middle of what it covers."""
    _, _, rest = path.read_bytes().partition(b"\n\n")
    size, _, data = rest.partition(b"\n")
    height, width = map(int, re.fullmatch(rb"-Y (\d+) \+X (\d+)", size).groups())
    rows, at = [], 0
    for _ in range(height):
        row, at = read_row(data, at, width)
        rows.append([tuple((c + 0.5) / 256 * 2.0 ** (pixel[3] - 128) if pixel[3] else 0.0 for c in pixel[:3]) for pixel in row])
    return rows
