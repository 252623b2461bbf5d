#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads scan lines of an EXR file (OpenEXR, "File Layout"), and prints a channel at a place, or the names of all channels.

Arguments: the file; and optionally the name of a channel, then X and Y from 0 to 1, from the top left, or "mean"."""
import struct
import sys
import zlib

SIZES, FORMATS = {0: 4, 1: 2, 2: 4}, {0: "I", 1: "e", 2: "f"}


def text(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def unzip(data, size):
    """zlib, then the differences of bytes, whose halves are apart."""
    if len(data) == size:
        return data
    raw = bytearray(zlib.decompress(data))
    for i in range(1, len(raw)):
        raw[i] = (raw[i - 1] + raw[i] - 128) & 255
    half, out = (len(raw) + 1) // 2, bytearray(len(raw))
    out[0::2], out[1::2] = raw[:half], raw[half:]
    return bytes(out)


def read(path):
    """The size, and rows of values by channel."""
    data = open(path, "rb").read()
    at, header = 8, {}
    while data[at]:
        name, at = text(data, at)
        _, at = text(data, at)
        size = struct.unpack_from("<i", data, at)[0]
        header[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    channels, place = [], 0
    while header["channels"][place]:
        name, place = text(header["channels"], place)
        channels.append((name, struct.unpack_from("<i", header["channels"], place)[0]))
        place += 16
    low_x, low_y, high_x, high_y = struct.unpack("<4i", header["dataWindow"])
    width, height, compression = high_x - low_x + 1, high_y - low_y + 1, header["compression"][0]
    lines = {0: 1, 2: 1, 3: 16}[compression]
    values = {name: [None] * height for name, _ in channels}
    for chunk in range((height + lines - 1) // lines):
        offset = struct.unpack_from("<Q", data, at + 1 + 8 * chunk)[0]
        first, size = struct.unpack_from("<ii", data, offset)
        count = min(lines, height - (first - low_y))
        raw = unzip(data[offset + 8:offset + 8 + size], count * width * sum(SIZES[kind] for _, kind in channels))
        place = 0
        for y in range(first - low_y, first - low_y + count):
            for name, kind in channels:
                values[name][y] = struct.unpack_from(f"<{width}{FORMATS[kind]}", raw, place)
                place += width * SIZES[kind]
    return width, height, values


def main():
    width, height, values = read(sys.argv[1])
    if len(sys.argv) == 2:
        print(*values)
    elif sys.argv[3] == "mean":
        print(f"{sum(map(sum, values[sys.argv[2]])) / (width * height):.4f}")
    else:
        x, y = (min(int(float(part) * size), size - 1) for part, size in zip(sys.argv[3:5], (width, height)))
        print(f"{values[sys.argv[2]][y][x]:.4f}")


if __name__ == "__main__":
    main()
