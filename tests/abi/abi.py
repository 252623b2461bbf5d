#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the binary interface with tests/abi/abi.txt: functions with their types, enumerators and numbers with their values, and structs
with their sizes and the offsets of their members. The shared library exports exactly these functions.

Arguments: the library, the project's root, the compiler. With --update instead of the library: writes abi.txt under the next number, which
CHANGELOG.md must then explain."""
import difflib
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish

LIBRARY, ROOT, COMPILER = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3:]
LIST = ROOT / "tests/abi/abi.txt"
HEADERS = sorted((ROOT / "include/mxgen").glob("*.h"))
PLAIN = "-D__attribute__(x)=", "-D__extension__=", "-D__restrict=restrict", "-D__inline="
NUMBER = re.compile(r"^#define (MXG_\w+) (?:0x)?[0-9a-fA-F]+u?$", re.MULTILINE)

try:
    from pycparser import c_ast, c_generator, c_parser
except ImportError:
    print("skip: python3-pycparser is not installed")
    sys.exit(77)


def run(*command, **options):
    return subprocess.run(command, check=True, capture_output=True, text=True, **options).stdout


def declarations():
    """The declarations of the public headers, those of the system removed."""
    source = "".join(f'#include "{header}"\n' for header in HEADERS)
    text = run(*COMPILER, "-E", f"-I{ROOT / 'include'}", *PLAIN, "-xc", "-", input=source)
    return [part for part in c_parser.CParser().parse(text).ext if "include/mxgen/" in (part.coord.file or "")]


class Interface:
    """The text of each kind of declaration. A line of a struct or a constant holds an expression for the compiler."""

    def __init__(self):
        self.functions, self.names, self.values = [], [], []
        self.write = c_generator.CGenerator().visit
        for part in declarations():
            self.add(part.type, part)
        for header in HEADERS:
            for name in NUMBER.findall(header.read_text(encoding="utf-8")):
                self.values.append((f"constant {name}", f"(long)({name})"))

    def add(self, kind, part):
        if isinstance(kind, c_ast.FuncDecl):
            self.functions.append(f"function {' '.join(self.write(part).split())}")
            self.names.append(part.name)
        elif isinstance(kind, c_ast.TypeDecl):
            self.add(kind.type, part)
        elif isinstance(kind, c_ast.Enum) and kind.values:
            for item in kind.values.enumerators:
                self.values.append((f"constant {item.name}", f"(long)({item.name})"))
        elif isinstance(kind, c_ast.Struct) and kind.decls:
            self.add_struct(part.name, kind)

    def add_struct(self, name, struct):
        self.values.append((f"struct {name}", f"(long)sizeof({name})"))
        for member in struct.decls:
            text = " ".join(self.write(member).split())
            self.values.append((f"struct {name}: {text}", f"(long)offsetof({name}, {member.name})"))


def evaluate(values):
    """The values of constants, sizes of structs and offsets of members."""
    rows = "".join(f'    printf("%ld\\n", {expression});\n' for _, expression in values)
    includes = "".join(f'#include "{header}"\n' for header in HEADERS)
    source = f"#include <stddef.h>\n#include <stdio.h>\n{includes}int main(void)\n{{\n{rows}    return 0;\n}}\n"
    with tempfile.TemporaryDirectory() as folder:
        program = f"{folder}/values"
        run(*COMPILER, f"-I{ROOT / 'include'}", "-xc", "-", "-o", program, input=source)
        return run(program).split()


def describe(interface):
    lines = [f"{text} = {value}" for (text, _), value in zip(interface.values, evaluate(interface.values))]
    return sorted(interface.functions + lines, key=lambda line: line.split(":")[0].split(" = ")[0])


def exported():
    """The functions that the library exports: "mxg_generate@@MXGEN_0"."""
    rows = (line.split() for line in run("nm", "--dynamic", "--defined-only", LIBRARY).splitlines())
    return sorted(row[2].removesuffix("@@MXGEN_0") for row in rows if row[1] != "A")


def main():
    interface = Interface()
    current = describe(interface)
    head, *listed = LIST.read_text(encoding="utf-8").splitlines() if LIST.exists() else ["abi 0"]
    number = int(head.split()[1])
    if LIBRARY == "--update":
        if current != listed:
            number += 1
            LIST.write_text("\n".join([f"abi {number}", *current, ""]), encoding="utf-8")
        print(f"abi {number}: explain it in CHANGELOG.md")
        return
    changed = [line for line in difflib.ndiff(listed, current) if line[0] in "+-"]
    check(not changed, "\n".join(changed))
    declared = sorted(interface.names)
    check(declared == exported(), f"abi: declared or exported alone: {sorted(set(declared) ^ set(exported()))}")
    changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    check(re.search(rf"^\* ABI {number}: \S", changes, re.MULTILINE), f"abi: CHANGELOG.md lacks the line `* ABI {number}: …`")
    finish("abi")


main()
