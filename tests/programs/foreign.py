#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes a shader of mxgen one that mxgen did not write: bench/gpu/reflect.py describes it, and of mxgen's own reflection only values and files
are taken. What both say of blocks, offsets, bindings and locations must be equal. Arguments: the folder bench/gpu, STEM of STEM.vert, .frag and
.json, the JSON to write."""
import json
import sys

sys.dont_write_bytecode = True
sys.path.append(sys.argv[1])
import reflect  # noqa: E402

TYPES = {"bool": "uint"}  # SPIR-V has no bool in a block
KEYS = "name", "set", "binding", "location", "offset", "size", "matrixStride", "arrayLength", "arrayStride"
BOUND = "PublicUniforms", "PrivateUniforms", "LightData", "Textures", "AppData"


def described(reflection):
    """What binding needs, by block and variable."""
    table = {}
    for block in reflection["blocks"]:
        if block["name"] in BOUND and block["variables"]:
            table[block["name"]] = {key: block[key] for key in KEYS if key in block and key != "size"}  # mxgen's is rounded
            for variable in block["variables"]:
                kind = {"type": TYPES.get(variable["type"], variable["type"])}
                table[block["name"], variable["name"]] = {**kind, **{key: variable[key] for key in KEYS if key in variable}}
    return table


def main():
    stem, out = sys.argv[2:4]
    with open(f"{stem}.json", encoding="utf-8") as file:
        own = json.load(file)
    found = reflect.reflection(f"{stem}.vert", f"{stem}.frag")
    expected, got = described(own), described(found)
    for key in sorted(expected.keys() | got.keys(), key=str):
        if expected.get(key) != got.get(key):
            sys.exit(f"{key}: mxgen says {expected.get(key)}, reflect.py {got.get(key)}")
    known = {variable["name"]: variable for block in own["blocks"] for variable in block["variables"]}
    for block in found["blocks"]:
        for variable in block["variables"]:
            variable.update({key: known[variable["name"]][key] for key in ("path", "default", "file") if key in known[variable["name"]]})
    with open(out, "w", encoding="utf-8") as file:
        json.dump(found, file)


if __name__ == "__main__":
    main()
