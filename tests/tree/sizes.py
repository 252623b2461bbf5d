#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Sizes and contents of files: lengths of files and functions, the budget of the node library, licence lines, machine paths,
self-contained headers. Arguments: the root of the project, a C compiler."""
import pathlib
import re
import subprocess
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish

ROOT = pathlib.Path(sys.argv[1])
COMPILER = sys.argv[2:]
CODE = "src generators program cli check compile doc export import lsp render bench tests examples fits include python js web editors blender action".split()


def files(folder, *endings):
    found = (path for path in sorted((ROOT / folder).rglob("*")) if path.suffix in endings)
    return [path for path in found if path.is_file() and "node_modules" not in path.parts]


def lines(path):
    return path.read_text(encoding="utf-8", errors="replace").splitlines()


def percentile(numbers, part):
    return sorted(numbers)[min(len(numbers) - 1, int(len(numbers) * part))]


def check_lengths():
    """Style: functions median 15, 90 % within 45, 99 % within 110 lines; files within 700, none above 1,200."""
    functions, lengths = {}, {}
    for folder in CODE:
        for path in files(folder, ".c", ".h", ".cpp"):
            text = lines(path)
            lengths[path] = len(text)
            start = None
            for number, line in enumerate(text):
                if line == "{":
                    start = number
                elif line == "}" and start is not None:
                    functions[f"{path.relative_to(ROOT)}:{start}"] = number - start - 1
                    start = None
    for part, limit in (0.5, 15), (0.9, 45), (0.99, 110):
        length = percentile(functions.values(), part)
        check(length <= limit, f"{part:.0%} of functions have up to {length} lines; {limit} is the limit")
    for path, length in lengths.items():
        check(length <= 1200, f"{path.relative_to(ROOT)} has {length} lines")
    long_files = [length for length in lengths.values() if length > 700]
    check(len(long_files) * 10 <= len(lengths), f"{len(long_files)} of {len(lengths)} files have more than 700 lines")
    print(f"functions: {len(functions)}, lines at 50/90/99/100 %:", *(percentile(functions.values(), p) for p in (0.5, 0.9, 0.99, 1)))
    print(f"files: {len(lengths)}, lines at 50/90/100 %:", *(percentile(lengths.values(), p) for p in (0.5, 0.9, 1)))
    for where, length in sorted(functions.items(), key=lambda item: -item[1])[:5]:
        print(f"  {where}: {length} lines")


def check_library():
    """A third of MaterialX's own 20,600 lines of XML and 7,900 of source, written for no target; it has no sampling and one
    distribution of facets, ours has two, and the nodes of slabs, slots and AOVs, and the formulas that the compiler calls. A translation between two models,
    where a way through a third one loses something, is 40 lines."""
    sizes = {endings: sum(len(lines(path)) for path in files("libraries", *endings)) for endings in ((".mtlx",), (".glsl", ".inline"))}
    whole = sum(sizes.values())
    check(whole <= 13250, f"libraries: {whole} lines; 13,250 is the budget")
    print(f"libraries: {whole} lines,", ", ".join(f"{size} of {endings[0]}" for endings, size in sizes.items()))
    for path in files("libraries", ".mtlx"):
        bound = [str(number) for number, line in enumerate(lines(path), 1) if "target=" in line and "<!-- only there:" not in line]
        check(not bound, f"{path.relative_to(ROOT)}: for one target without a reason, line {', '.join(bound)}")


def check_targets():
    """A language is little beside what all targets share: HLSL with what its dialects share takes less than 800 lines, and the
    dialect Slang less than 300."""
    for language, most in ("hlsl", 800), ("slang", 300):
        size = sum(len(lines(path)) for path in files(f"generators/{language}", ".c", ".h", ".def"))
        check(0 < size < most, f"generators/{language} has {size} lines")
    size = sum(len(lines(ROOT / "tests/toy" / name)) for name in ("toy.c", "targets.c"))
    check(size < 150, f"a language that differs from GLSL everywhere is less than 150 lines, with its place in the list of targets; tests/toy has {size}")


def check_texts():
    # Letters apart, so that this file does not match.
    unwanted = re.compile("/" + r"work/|/" + r"tmp/|/" + r"root/|/" + r"home/\w")
    for folder in CODE + ["docs", "libraries", "script"]:
        for path in files(folder, ".c", ".h", ".cpp", ".def", ".S", ".py", ".sh", ".md", ".mtlx", ".glsl", ".build", ""):
            text = path.read_text(encoding="utf-8", errors="replace")
            found = unwanted.search(text)
            check(not found, f"{path.relative_to(ROOT)}: path of a machine: {found and found.group()}")
            if path.suffix in (".c", ".h", ".cpp", ".def", ".S", ".py", ".sh"):
                check("SPDX-License-Identifier: Apache-2.0" in text[:200], f"{path.relative_to(ROOT)} has no licence line")


def check_headers():
    """A header includes what it uses."""
    command = [*COMPILER, *"-std=c17 -Wall -Wextra -Wno-unused-function -Werror -fsyntax-only -Iinclude -Isrc -I. -x c -".split()]
    for folder in "include", "src", "generators", "program", "cli", "check", "doc", "lsp":
        for path in files(folder, ".h"):
            source = f'#include "{path.relative_to(ROOT)}"\n'
            result = subprocess.run(command, input=source, cwd=ROOT, capture_output=True, text=True, check=False)
            check(result.returncode == 0, f"{path.relative_to(ROOT)} does not compile alone:\n{result.stderr}")


check_lengths()
check_library()
check_targets()
check_texts()
if COMPILER:
    check_headers()
finish("sizes")
