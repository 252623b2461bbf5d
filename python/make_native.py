#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the declarations of the public headers for ctypes. Arguments: the headers, in the order of use; the output.

The declarations of the library stand in its headers only. A pointer to a struct that the headers do not define is a void pointer, and so
is a text that C writes to or that has no NUL. Each member of a struct and each parameter that is a pointer to a function also is a type
`callback_<name>`."""
import pathlib
import re
import sys

COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
NUMBER = re.compile(r"^#define (MXG_\w+) (\d+|0x[0-9a-f]+)u?$", re.MULTILINE)
ENUM = re.compile(r"typedef enum (mxg_\w+) \{(.*?)\n\} \1;", re.DOTALL)
STRUCT = re.compile(r"typedef struct (mxg_\w+) \{(.*?)\n\} \1;", re.DOTALL)
ALIAS = re.compile(r"typedef (\w+) (mxg_\w+);")
FUNCTION = re.compile(r"MXG_API ([^;(]*?)(mxg_\w+)\(([^;]*)\);")
POINTER_TO_FUNCTION = re.compile(r"(.+?)\(\*(\w+)\)\s*\((.*)\)$", re.DOTALL)
DECLARATION = re.compile(r"((?:const |struct )*)(\w+)\b(.*)$", re.DOTALL)

SCALARS = {"bool": "c_bool", "int": "c_int", "int32_t": "c_int32", "uint32_t": "c_uint32", "uint64_t": "c_uint64", "size_t": "c_size_t",
           "float": "c_float", "double": "c_double"}


class Writer:
    def __init__(self):
        self.scalars, self.structs, self.callbacks = dict(SCALARS), set(), {}
        self.constants, self.enums, self.functions, self.lines = {}, {}, [], []

    def type_of(self, words, base, stars):
        """The type of ctypes for a type of C."""
        if base in self.scalars and stars < 2:
            return f"POINTER({self.scalars[base]})" if stars else self.scalars[base]
        if base == "char" and (not stars or "const" in words):
            return ["c_char", "c_char_p", "POINTER(c_char_p)"][stars]
        if base in self.structs and stars == 1:
            return f"POINTER({base})"
        if base == "void" and not stars:
            return "None"
        if not stars and not base.endswith("_fn"):
            raise SystemExit(f"make_native.py: unknown type '{base}'")
        return "POINTER(c_void_p)" if stars == 2 else "c_void_p"

    def callback(self, match):
        """The type of a pointer to a function, and its name."""
        result, name, parameters = match.groups()
        parts = split(parameters)
        types = [self.parameter(part) for part in parts]
        types = [kind if kind != "c_char_p" or not after.startswith("size_t ") else "c_void_p" for kind, after in zip(types, parts[1:] + [""])]
        types = ", ".join([self.declared(result)[0][1], *types])
        self.callbacks[f"callback_{name}"] = f"CFUNCTYPE({types})"
        return name, f"CFUNCTYPE({types})"

    def declared(self, text):
        """The names and types of a declaration."""
        words, base, rest = DECLARATION.match(text.strip()).groups()
        found = []
        for declarator in rest.split(","):
            stars, name, items = re.match(r"([\s*]*(?:const\s*\*)?)\s*(?:const\s+)?(\w*)(?:\[(\d*)\])?\s*$", declarator).groups()
            kind = self.type_of(words, base, stars.count("*") + (items == ""))
            found.append((name, f"{kind} * {items}" if items else kind))
        return found

    def parameter(self, text):
        match = POINTER_TO_FUNCTION.match(text.strip())
        if match:
            return self.callback(match)[1]
        kind = self.declared(text)[0][1]
        return f"POINTER({kind.split(' * ')[0]})" if " * " in kind else kind # an array

    def add_struct(self, name, body):
        members = []
        for declaration in filter(None, (text.strip() for text in body.split(";"))):
            match = POINTER_TO_FUNCTION.match(declaration)
            members += [self.callback(match)] if match else self.declared(declaration)
        names = {name for name, _ in members}
        members = [(name, "c_void_p" if f"{name}_len" in names else kind) for name, kind in members]
        self.structs.add(name)
        self.lines += [f"class {name}(Structure):", "    _fields_ = [", *(f"        ({name!r}, {kind})," for name, kind in members), "    ]", ""]

    def add_enum(self, name, body):
        self.scalars[name], self.enums[name], number = "c_int", {}, 0
        for item in filter(None, (text.strip() for text in body.split(","))):
            constant, _, given = (text.strip() for text in item.partition("="))
            number = int(given, 0) if given else number
            self.enums[name][constant] = number
            number += 1

    def add(self, text):
        text = COMMENT.sub("", text)
        self.constants.update((name, int(number, 0)) for name, number in NUMBER.findall(text))
        self.scalars.update((name, self.scalars[base]) for base, name in ALIAS.findall(text) if base in self.scalars)
        for name, body in ENUM.findall(text):
            self.add_enum(name, body)
        for name, body in STRUCT.findall(text):
            self.add_struct(name, body)
        for result, name, parameters in FUNCTION.findall(text):
            self.functions.append((name, result, parameters))

    def write(self):
        functions = []
        for name, result, parameters in self.functions:
            types = "".join(f"{self.parameter(part)}, " for part in split(parameters) if part != "void")
            functions.append(f"    {name!r}: ({self.declared(result)[0][1]}, ({types})),")
        return "\n".join(["# Made by python/make_native.py from the headers.", "from ctypes import *  # noqa: F403", "",
                          f"CONSTANTS = {self.constants!r}", f"ENUMS = {self.enums!r}", "", *self.lines,
                          *(f"{name} = {kind}" for name, kind in self.callbacks.items()), "",
                          "FUNCTIONS = {", *functions, "}", ""])


def split(parameters):
    """The parameters of a function, without those of functions among them."""
    return [part.strip() for part in re.split(r",(?![^()]*\))", " ".join(parameters.split()))]


def main(headers, output):
    writer = Writer()
    for header in headers:
        writer.add(pathlib.Path(header).read_text(encoding="utf-8"))
    pathlib.Path(output).write_text(writer.write(), encoding="utf-8")


main(sys.argv[1:-1], sys.argv[-1])
