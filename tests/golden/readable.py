#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Shaders read as if written by hand. In all golden files lines are short, no two sections have one name, and nothing is left over from
generation. In the complete shading models few locals have numbers, no number misses a short one by its last bit, and functions have their
documentation. Arguments: the folder of the golden files, mxgen, the folder of the examples."""
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish

MAX_COLUMNS = 140
MAX_NUMBERED = 0.07
MAX_NUMBERED_OF_SCATTER = 0.17  # light comes from several directions, each an L; MDL has curves of values at seven angles
LOCAL = re.compile(r"^ +(?:const )?(?:closure )?[A-Za-z]\w* (\w+(?:, \w+)*)(?:: [\w<>]+)?(?: = .*|;)$")
NUMBER = re.compile(r"\b\d+\.\d+(?:e-?\d+)?\b")
FUNCTION = re.compile(r"^(?!void main)[a-zA-Z_]\w* (mx_\w+)\(")
# Where the statements of a surface begin, in each language and role.
MAIN = re.compile(r"void (?:main|fragmentMain|FragmentMain|scatter)\(|PixelOutput main|\w+ surface\(|surface |fn (?:main|surface|scatter)\(|export material ")

SHADERS = {".vert", ".frag", ".comp", ".hlsl", ".osl", ".slang", ".metal", ".wgsl", ".mdl"}
LEFTOVERS = {
    "a constructor in a constructor": re.compile(r"\b(?:vec|float)[34]f?\((?:vec|float)[23]f?\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*\), "),
    "an element of a constant": re.compile(r"\b(?:vec|float)[234]f?\([\d.]+\)\["),
    "a part of a negative vector": re.compile(r"\(-\w+\)\."),
    "a step that is guarded twice": re.compile(r"\? [01]\.0 : [^;]*\bsmoothstep\("),
    "a cosine of 90 degrees": re.compile(r"-4\.371139e-0?8"),
    "a choice in the same choice": re.compile(r"(?<![\w.])(\w+) \? \(?\1 \?"),
    "a sample that is chosen": re.compile(r"\bi == 0 \?"),
    "a conversion in parentheses": re.compile(r"[-+*/] \((?:int|uint|float|[iuf]32)\([^()]*\)\)"),
    "a normal as a vector where oslc turns it into one": re.compile(r"\b(?:cross|faceforward|reflect|refract)\([^;]*\bvector\(N\)"),
    "a sum with a negative value": re.compile(r"\+= -[A-Za-z(]"),
    "a product with 0": re.compile(r"(?<![\w.]) \* 0\.0(?![\d.])"),
    "'&&' beside '||'": re.compile(r"\|\| !?[\w.]+(?: [<>=!]=? [\w.]+)? &&|&& !?[\w.]+(?: [<>=!]=? [\w.]+)? \|\|"),
    "a number behind a turn": re.compile(r"\bturn_\d"),
    "a break inside an argument": re.compile(r"^ *[^/ ].{40,}, [\w.\[\]]+$"),
    "a length of nothing": re.compile(r"\b(?:length|normalize)\((?:vec|float)[234]f?\(0\.0\)"),
}
# Examples with texts that no golden file has.
EXAMPLES = [
    ("car_paint.mtlx", "mdl"),
    ("slab_glints.mtlx", "mdl"),
    ("slabs.mtlx", "osl"),
    ("tiles.mtlx", "glsl", "--role", "scatter"),
    ("marble.mtlx", "wgsl", "--role", "scatter"),
]
SECTION = re.compile(r"^ +// (?!from the last light)(.*)$")


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


def above_struct(lines, number):
    """The line of a function, or of the struct of its results before it, which MDL needs."""
    if lines[number - 1] != "};":
        return number
    return next(i for i in range(number, 0, -1) if lines[i].startswith("struct "))


def check_text(path):
    lines = path.read_text(encoding="utf-8").splitlines()
    sections = [match.group(1) for match in map(SECTION.match, lines) if match]
    again = {section for section in sections if sections.count(section) > 1}
    check(not again, f"{path.name}: several sections have the names {again}")
    for number, line in enumerate(lines, 1):
        is_alone = line.startswith("// Here ") and not lines[number - 2].startswith("//") # documents need not explain their functions
        check(not is_alone or " mx_" not in lines[number], f"{path.name}:{number}: the constants of a function that is not explained")
        check(len(line) <= MAX_COLUMNS, f"{path.name}:{number}: {len(line)} columns")
        for name, leftover in LEFTOVERS.items():
            check(not leftover.search(line), f"{path.name}:{number}: {name}: {line.strip()}")


shaders = sorted(path for path in pathlib.Path(sys.argv[1]).iterdir() if path.suffix in SHADERS)
check(len(shaders) > 100, "there are few golden files")
for path in shaders:
    check_text(path)
for document, target, *options in EXAMPLES:
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.argv[2], str(pathlib.Path(sys.argv[3]) / document), "--target", target, *options, "-q", "-o", folder], check=True)
        made = [path for path in sorted(pathlib.Path(folder).iterdir()) if path.suffix in SHADERS]
        check(made, f"{document} makes no shaders for {target}")
        for path in made:
            check_text(path)
for path in shaders:
    if not path.name.startswith("models.") or path.suffix in (".vert", ".comp"):
        continue
    lines = path.read_text(encoding="utf-8").splitlines()
    main = next(i for i, line in enumerate(lines) if MAIN.match(line))
    names = list(names_of_locals(lines[main:]))
    numbered = [name for name in names if re.search(r"_\d+$", name)]
    check(names, f"{path.name}: no locals were found")
    most = MAX_NUMBERED_OF_SCATTER if ".scatter." in path.name or path.suffix == ".mdl" else MAX_NUMBERED
    check(len(numbered) <= most * len(names), f"{path.name}: {len(numbered)} of {len(names)} locals have numbers: {numbered}")
    for number, line in enumerate(lines, 1):
        for literal in NUMBER.findall(line):
            check(not misses_short_one(literal), f"{path.name}:{number}: {literal} has useless digits")
    functions = [i for i, line in enumerate(lines) if FUNCTION.match(line)]
    documented = [i for i in functions if lines[above_struct(lines, i) - 1].startswith("//")]
    if functions:
        check(len(documented) * 3 >= len(functions) * 2, f"{path.name}: {len(documented)} of {len(functions)} functions have documentation")
finish("readable")
