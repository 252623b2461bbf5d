#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the JSON of passes with their SPIR-V: resources, formats, access, members with offsets and strides, and the size of a group. A
host can then lay out its buffers and sets by the JSON alone. Arguments: pairs of a JSON file and the output of `spirv-dis --raw-id`."""
import json
import pathlib
import re
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish


class Module:
    """The types, names and decorations of a module."""

    def __init__(self, text):
        self.made, self.names, self.marks, self.uses = {}, {}, {}, set()
        self.group = None
        is_code = False
        for line in text.splitlines():
            found = re.match(r"\s*(?:(%\d+) = )?(Op\w+)\s*(.*)", line)
            if not found:
                continue
            result, op, rest = found.groups()
            words = re.findall(r'"[^"]*"|\S+', rest)
            is_code = is_code or op == "OpFunction"
            if is_code:
                self.uses.update(words)
            elif op in ("OpName", "OpMemberName"):
                self.names[tuple(words[:-1])] = words[-1].strip('"')
            elif op == "OpDecorate":
                self.marks.setdefault((words[0],), {})[words[1]] = words[2:]
            elif op == "OpMemberDecorate":
                self.marks.setdefault(tuple(words[:2]), {})[words[2]] = words[3:]
            elif op == "OpExecutionMode" and words[1] == "LocalSize":
                self.group = [int(word) for word in words[2:]]
            elif result:
                self.made[result] = [op, *words]

    def mark(self, *key):
        return self.marks.get(key, {})

    def number(self, key, name):
        return int(self.mark(*key)[name][0]) if name in self.mark(*key) else None

    def length(self, array):
        """None: it has none of its own."""
        op, _, *length = self.made[array]
        return None if op == "OpTypeRuntimeArray" else int(self.made[length[0]][2])

    def type_name(self, of):
        op, *words = self.made[of]
        if op == "OpTypeVector":
            return {"float": "vec", "uint": "uvec", "int": "ivec"}[self.type_name(words[0])] + words[1]
        if op == "OpTypeMatrix":
            return "mat" + words[1]
        if op == "OpTypeInt":
            return "int" if words[1] == "1" else "uint"
        return {"OpTypeFloat": "float", "OpTypeBool": "bool"}.get(op) or self.names[(of,)]

    def members(self, struct):
        """Each member as JSON has it, without texts."""
        found = []
        for index, of in enumerate(self.made[struct][1:]):
            key = (struct, str(index))
            member = {"name": self.names[key], "offset": self.number(key, "Offset")}
            if self.made[of][0] in ("OpTypeArray", "OpTypeRuntimeArray"):
                member["arrayStride"] = self.number((of,), "ArrayStride")
                member["length"] = self.length(of)
                of = self.made[of][1]
            member["type"] = self.type_name(of)
            if "MatrixStride" in self.mark(*key):
                member["matrixStride"] = self.number(key, "MatrixStride")
            if self.made[of][0] == "OpTypeStruct":
                member["members"] = self.members(of)
            found.append(member)
        return found

    def resource(self, variable):
        pointed = self.made[self.made[variable][1]][2]
        kind, words = self.made[pointed][0], self.made[pointed][1:]
        found = {"set": self.number((variable,), "DescriptorSet"), "binding": self.number((variable,), "Binding")}
        mark = self.mark(variable)
        if kind == "OpTypeStruct":
            found["members"] = self.members(pointed)
            found["kind"] = "uniform" if "Block" in self.mark(pointed) and self.made[variable][2] == "Uniform" else "buffer"
            parts = [self.mark(pointed, str(index)) for index in range(len(words))]
            mark = {name: 0 for name in parts[0] if all(name in part for part in parts)}
        elif kind == "OpTypeSampledImage":
            found["kind"] = "sampler2D"
        else:
            found["kind"] = "image2DArray" if words[3] == "1" else "image2D"
            found["format"] = {"Unknown": "any"}.get(words[6], words[6].lower())
        only_reads, only_writes = "NonWritable" in mark, "NonReadable" in mark
        found["access"] = "read" if only_reads or found["kind"] in ("uniform", "sampler2D") else "write" if only_writes else "read-write"
        return found

    def resources(self):
        """By set and binding; and whether code uses them."""
        found = {}
        for variable in self.made:
            if self.made[variable][0] == "OpVariable" and "Binding" in self.mark(variable):
                resource = self.resource(variable)
                found[resource["set"], resource["binding"]] = resource, variable in self.uses
        return found


def bare(member):
    """A member of the JSON without its texts and what SPIR-V does not have."""
    kept = {key: member[key] for key in ("name", "type", "offset", "arrayStride", "matrixStride") if key in member}
    if "arrayStride" in member:
        kept["length"] = None if "per" in member else member["arrayLength"]
    if "members" in member:
        kept["members"] = [bare(inner) for inner in member["members"]]
    return kept


def end_of(member):
    sizes = {"float": 4, "int": 4, "uint": 4, "uvec2": 8, "vec3": 12, "vec4": 16, "uvec4": 16, "mat4": 64}
    if "per" in member:
        return member["offset"]
    return member["offset"] + (member["arrayLength"] * member["arrayStride"] if "arrayLength" in member else sizes[member["type"]])


def check_resource(name, described, found):
    for key in ("kind", "access") + (("format",) if "image" in described["kind"] else ()):
        check(described[key] == found[key], f"{name}: {key} {described[key]}, {found[key]} in SPIR-V")
    members = [bare(member) for member in described.get("members", [])]
    check(members == found.get("members", []), f"{name}: {members}, {found.get('members')} in SPIR-V")
    if "members" in described:
        end = max(end_of(member) for member in described["members"])
        rounded = (end + 15) // 16 * 16
        check(described.get("size", 0) == rounded, f"{name}: size {described.get('size')}, not {rounded}")


def check_block(name, block, found):
    """Uniforms and lights of a lighting pass, which all shaders describe alike."""
    members = found["members"]
    if block["name"] == "LightData":
        outer = members[0]
        check((outer["length"], outer["arrayStride"]) == (block["arrayLength"], block["arrayStride"]), f"{name}: {outer}")
        members = outer["members"]
    described = [(variable["name"], variable["type"], variable["offset"]) for variable in block["variables"]]
    check(described == [(member["name"], member["type"], member["offset"]) for member in members], f"{name}: {described}, {members}")


def check_pass(described, module, file):
    deferred, left = described["deferred"], module.resources()
    check(deferred["groupSize"] == module.group, f"{file}: a group of {module.group}")
    for resource in deferred["resources"]:
        found, is_used = left.pop((resource["set"], resource["binding"]), (None, False))
        name = f"{file}: {resource['name']}"
        check(found, f"{name} is not declared")
        if found:
            check(is_used, f"{name} is not used")
            check_resource(name, resource, found)
    for block in described["blocks"]:
        places = block["variables"] if block["name"] == "Textures" else [block]
        for place in places:
            name = f"{file}: {place['name']}"
            found, _ = left.pop((place["set"], place["binding"]), (None, False))
            check(found, f"{name} is not declared")
            if found and place is block:
                check_block(name, block, found)
        for variable in block["variables"]:
            check(variable["stages"] == ["compute"], f"{file}: {variable['name']} in {variable['stages']}")
    check(not left, f"{file}: not in the JSON: {left}")
    wrong = {"path", "closures", "transparent", "lit", "compiledInputs"} & set(described)
    check(not wrong and described["element"] == "pass" and described["name"] == deferred["pass"], f"{file}: {wrong}, {described['name']}")
    blocks = {block["name"] for block in described["blocks"]}
    check(blocks <= {"PrivateUniforms", "LightData", "Textures"}, f"{file}: {blocks}")


for reflection, disassembly in zip(sys.argv[1::2], sys.argv[2::2]):
    check_pass(json.loads(pathlib.Path(reflection).read_text(encoding="utf-8")),
               Module(pathlib.Path(disassembly).read_text(encoding="utf-8")), reflection)
finish("pass_layouts")
