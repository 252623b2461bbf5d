#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads glTF 2.0 by its specification, and PNG (8 bits, not interlaced) by RFC 2083.

    gltf.py FILE get PATH        the member at "materials/0/name", as JSON; the name of a material may stand for its number
    gltf.py FILE texel PATH X Y  the bytes of the image of a texture ("materials/0/normalTexture"), X and Y from 0 to 1, from the top left
    gltf.py FILE vertex N        position and texture coordinates of a vertex of the first mesh"""
import json
import pathlib
import struct
import sys
import urllib.parse
import zlib


def read(path):
    """The JSON, and the bytes of the buffer."""
    data = path.read_bytes()
    if data[:4] != b"glTF":
        root = json.loads(data)
        return root, (path.parent / urllib.parse.unquote(root["buffers"][0]["uri"])).read_bytes()
    assert struct.unpack_from("<II", data, 4) == (2, len(data)), "the header"
    size, kind = struct.unpack_from("<I4s", data, 12)
    assert kind == b"JSON" and size % 4 == 0, "the chunk of the text"
    size_of_bytes, kind = struct.unpack_from("<I4s", data, 20 + size)
    assert kind == b"BIN\0" and 28 + size + size_of_bytes == len(data), "the chunk of the buffer"
    return json.loads(data[20:20 + size]), data[28 + size:]


def find(root, path):
    value = root
    for word in path.split("/"):
        if isinstance(value, list):
            names = [item.get("name") if isinstance(item, dict) else None for item in value]
            value = value[names.index(word) if word in names else int(word)]
        else:
            value = value[word]
    return value


def unpack(data):
    """Width, rows of bytes, and channels of a PNG."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n", "a PNG"
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, colour, _, _, interlace = struct.unpack(">IIBBBBB", body)
            assert depth == 8 and not interlace
        packed += body if kind == b"IDAT" else b""
        at += 12 + size
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[colour]
    raw, rows, above = zlib.decompress(packed), [], bytearray(width * channels)
    for y in range(height):
        start = y * (width * channels + 1)
        method, row = raw[start], bytearray(raw[start + 1:start + 1 + width * channels])
        for i in range(len(row)):
            left, corner = (row[i - channels], above[i - channels]) if i >= channels else (0, 0)
            guess = left + above[i] - corner
            near = min((abs(guess - left), 0, left), (abs(guess - above[i]), 1, above[i]), (abs(guess - corner), 2, corner))[2]
            row[i] = (row[i] + [0, left, above[i], (left + above[i]) // 2, near][method]) & 255
        rows.append(row)
        above = row
    return width, rows, channels


def view(root, buffer, index):
    part = root["bufferViews"][index]
    return buffer[part["byteOffset"]:part["byteOffset"] + part["byteLength"]]


def numbers(root, buffer, index, at):
    accessor = root["accessors"][index]
    width = int(accessor["type"][-1])
    return struct.unpack_from(f"<{width}f", view(root, buffer, accessor["bufferView"]), at * 4 * width)


def main():
    path, what = pathlib.Path(sys.argv[1]), sys.argv[2]
    root, buffer = read(path)
    if what == "get":
        print(json.dumps(find(root, sys.argv[3])))
    elif what == "vertex":
        attributes = root["meshes"][0]["primitives"][0]["attributes"]
        print(*(f"{number:.4f}" for name in ("POSITION", "TEXCOORD_0") for number in numbers(root, buffer, attributes[name], int(sys.argv[3]))))
    else:
        image = root["images"][root["textures"][find(root, sys.argv[3])["index"]]["source"]]
        data = (path.parent / urllib.parse.unquote(image["uri"])).read_bytes() if "uri" in image else view(root, buffer, image["bufferView"])
        width, rows, channels = unpack(data)
        x, y = int(float(sys.argv[4]) * width), int(float(sys.argv[5]) * len(rows))
        print(*rows[y][x * channels:(x + 1) * channels])


if __name__ == "__main__":
    main()
