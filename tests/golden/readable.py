#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The shaders of the complete shading models read as if written by hand: few locals have numbers, lines are short, no number misses a
short one by its last bit, and functions have their documentation. Argument: the folder of the golden files."""
import pathlib
import re
import struct
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish

MAX_COLUMNS = 140
MAX_NUMBERED = 0.1
LOCAL = re.compile(r"^ +(?:const )?(?:closure )?[A-Za-z]\w* (\w+(?:, \w+)*)(?: = .*|;)$")
NUMBER = re.compile(r"\b\d+\.\d+(?:e-?\d+)?\b")
FUNCTION = re.compile(r"^(?!void main)[a-zA-Z_]\w* (mx_\w+)\(")


def bits(number):
    return struct.unpack("<i", struct.pack("<f", number))[0]


def misses_short_one(text):
    """True if a number of six digits is the next float; whole numbers may be missed on purpose."""
    short = float(f"{float(text):.6g}")
    return short != int(short) and abs(bits(float(text)) - bits(short)) == 1


def names_of_locals(lines):
    """Names that the main function declares."""
    for line in lines:
        match = LOCAL.match(line)
        if match and not line.lstrip().startswith("return"):
            yield from match.group(1).split(", ")


for path in sorted(pathlib.Path(sys.argv[1]).glob("models.*")):
    if path.suffix in (".json", ".mtlx", ".vert"):
        continue
    lines = path.read_text(encoding="utf-8").splitlines()
    main = next(i for i, line in enumerate(lines) if re.match(r"void main|PixelOutput main|surface ", line))
    names = list(names_of_locals(lines[main:]))
    numbered = [name for name in names if re.search(r"_\d+$", name)]
    check(names, f"{path.name}: no locals were found")
    check(len(numbered) <= MAX_NUMBERED * len(names), f"{path.name}: {len(numbered)} of {len(names)} locals have numbers: {numbered}")
    for number, line in enumerate(lines, 1):
        check(len(line) <= MAX_COLUMNS, f"{path.name}:{number}: {len(line)} columns")
        for literal in NUMBER.findall(line):
            check(not misses_short_one(literal), f"{path.name}:{number}: {literal} has useless digits")
    functions = [i for i, line in enumerate(lines) if FUNCTION.match(line)]
    documented = [i for i in functions if lines[i - 1].startswith("//")]
    if functions:
        check(len(documented) * 3 >= len(functions) * 2, f"{path.name}: {len(documented)} of {len(functions)} functions have documentation")
finish("readable")
