#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The reflection of a shader that mxgen did not write, in the form of mxgen's own (docs/reflection.md), as far as binding needs it: GLSL for
Vulkan whose blocks and variables have the names of MaterialX. Arguments: the path of a vertex stage, the path of a pixel stage; prints JSON."""
import json
import pathlib
import subprocess
import sys
import tempfile

BLOCKS = "PrivateUniforms", "PublicUniforms", "LightData"  # MaterialX adds the name of the stage
SIZES = {"float": 4, "int": 4, "uint": 4, "vec2": 8, "ivec2": 8, "vec3": 12, "ivec3": 12, "vec4": 16, "ivec4": 16, "mat2": 32, "mat3": 48, "mat4": 64}


def interface(source):
    """What spirv-cross says of the SPIR-V of a stage; the ending of the file's name tells the stage."""
    with tempfile.TemporaryDirectory() as folder:
        module = f"{folder}/module.spv"
        for command in ("glslangValidator", "-V", str(source), "-o", module), ("spirv-cross", module, "--reflect"):
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            if done.returncode:
                sys.exit(f"{source}: {command[0]} fails: {(done.stdout + done.stderr).strip()}")
        return json.loads(done.stdout)


def variables(members, types, prefix="", offset=0):
    """Members of a block; those of a structure stand for it, each by itself."""
    for found in members:
        name, at = prefix + found["name"], offset + found["offset"]
        if "array" in found:
            sys.exit(f"'{name}' is an array, which no scene has a value for")
        if found["type"] in types:
            yield from variables(types[found["type"]]["members"], types, f"{name}.", at)
            continue
        stride = {"matrixStride": found["matrix_stride"]} if "matrix_stride" in found else {}
        yield {"name": name, "type": found["type"], "offset": at, "size": SIZES[found["type"]], **stride}


def uniform_block(found, types):
    """A block of uniforms; one of lights has an array of structures."""
    name = next((name for name in BLOCKS if found["name"].startswith(name)), None)
    if not name:
        sys.exit(f"the block '{found['name']}' is none of {', '.join(BLOCKS)}")
    block = {"name": name, "set": found["set"], "binding": found["binding"]}
    members = types[found["type"]]["members"]
    if name == "LightData":
        block.update(arrayLength=members[0]["array"][0], arrayStride=members[0]["array_stride"])
        members = types[members[0]["type"]]["members"]
    block["variables"] = list(variables(members, types))
    return block


def reflection(vertex, pixel):
    """`blocks` of both stages, which have uniforms of their own or share them."""
    blocks, textures = {}, {}
    stages = [interface(vertex), interface(pixel)]
    for stage in stages:
        for found in stage.get("ubos", []):
            blocks[found["set"], found["binding"]] = uniform_block(found, stage["types"])
        for found in stage.get("textures", []):
            textures[found["name"]] = {key: found[key] for key in ("name", "type", "set", "binding")}
    attributes = [{key: found[key] for key in ("name", "type", "location")} for found in stages[0].get("inputs", [])]
    return {"blocks": [*(blocks[key] for key in sorted(blocks)), {"name": "Textures", "variables": list(textures.values())},
                       {"name": "AppData", "variables": sorted(attributes, key=lambda found: found["location"])}]}


def main():
    print(json.dumps(reflection(*map(pathlib.Path, sys.argv[1:3])), indent=1))


if __name__ == "__main__":
    main()
