#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the structs and enumerations of the public headers for JavaScript, with their places in the memory of WebAssembly, and a C file
that lets the compiler compare these places. Arguments: the headers; the output in JavaScript; the output in C."""
import json
import pathlib
import re
import sys

COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
STRUCT = re.compile(r"typedef struct (mxg_\w+) \{(.*?)\n\} \1;", re.DOTALL)
ENUM = re.compile(r"typedef enum (mxg_\w+) \{(.*?)\n\} \1;", re.DOTALL)
ALIAS = re.compile(r"typedef (\w+) (mxg_\w+);")
FUNCTION = re.compile(r"\(\*(\w+)\)\s*\([^)]*\)")
DECLARATOR = re.compile(r"(\**)\s*(?:const\s*\*)?\s*(\w+)(?:\[(\d+)\])?$")

# the name in layout.js, bytes
SCALARS = {"bool": ("bool", 1), "int32_t": ("i32", 4), "uint32_t": ("u32", 4), "size_t": ("u32", 4), "float": ("f32", 4),
           "uint64_t": ("u64", 8)}
POINTER = ("pointer", 4)


def camel(name):
    first, *others = name.lower().split("_")
    return first + "".join(word.capitalize() for word in others)


def read_enum(body):
    """The values by name, without the part that all names share."""
    values, number = {}, 0
    for item in filter(None, (text.strip() for text in body.split(","))):
        name, _, given = (text.strip() for text in item.partition("="))
        number = int(given, 0) if given else number
        values[name] = number
        number += 1
    values = {name: value for name, value in values.items() if not re.search(r"_MAX_ENUM$|^MXG_NUM_", name)}
    words = [name.split("_") for name in values]
    shared = next(i for i in range(len(words[0])) if len({tuple(other[:i + 1]) for other in words}) > 1 or i + 1 == len(words[0]))
    return {camel("_".join(name.split("_")[shared:])): value for name, value in values.items()}


def read_members(body, enums, scalars):
    """The members of a struct: name in C, kind (an enumeration has its name), bytes of one item, number of items."""
    for declaration in filter(None, (text.strip() for text in body.split(";"))):
        function = FUNCTION.search(declaration)
        if function:
            yield (function.group(1), *POINTER, 1)
            continue
        words = declaration.replace("const ", "").strip()
        base, declarators = re.match(r"(?:struct )?(\w+)\s*(.*)", words, re.DOTALL).groups()
        for declarator in declarators.split(","):
            stars, name, items = DECLARATOR.match(declarator.strip()).groups()
            if stars or base.endswith("_fn"):
                kind = ("text", 4) if base == "char" and stars == "*" and "*const" not in declarator else POINTER
            elif base in enums:
                kind = (base, 4)
            elif base in scalars:
                kind = scalars[base]
            else:
                raise SystemExit(f"make_layout.py: unknown type in '{declaration}'")
            yield (name, *kind, int(items or 1))


def main(headers, script, check):
    text = "\n".join(COMMENT.sub("", pathlib.Path(header).read_text(encoding="utf-8")) for header in headers)
    enums = {name: read_enum(body) for name, body in ENUM.findall(text)}
    scalars = SCALARS | {name: SCALARS[base] for base, name in ALIAS.findall(text)}
    structs, asserts = {}, []
    for struct, body in STRUCT.findall(text):
        offset, widest, members = 0, 1, {}
        for name, kind, size, items in read_members(body, enums, scalars):
            offset = -(-offset // size) * size
            if name.endswith("_len") and camel(name[:-4]) in members: # a text without a NUL
                members[camel(name[:-4])] = ["piece", members[camel(name[:-4])][1]]
            else:
                members[camel(name)] = [kind, offset] + ([items] if items > 1 else [])
            asserts.append(f'_Static_assert(offsetof({struct}, {name}) == {offset}, "{struct}.{name}");')
            offset += size * items
            widest = max(widest, size)
        size = -(-offset // widest) * widest
        asserts.append(f'_Static_assert(sizeof({struct}) == {size}, "{struct}");')
        structs[struct] = {"size": size, "members": members}
    pathlib.Path(script).write_text("// Made by js/make_layout.py from the headers.\n"
                                    f"export const ENUMS = {json.dumps(enums, indent=1)};\n"
                                    f"export const STRUCTS = {json.dumps(structs, indent=1)};\n", encoding="utf-8")
    pathlib.Path(check).write_text("#include <mxgen/mxgen.h>\n" + "\n".join(asserts) + "\n", encoding="utf-8")


main(sys.argv[1:-2], *sys.argv[-2:])
