#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The name of a file states its idea, so two C files or headers outside of tests/ have one name only if a row here says why.
Argument: the root of the project."""
import collections
import pathlib
import subprocess
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish

ROOT = pathlib.Path(sys.argv[1])

# Folders whose files have the name of something that others make; such a name may stand once more elsewhere.
FACES = {
    "include/mxgen": "a public header has the name of its subject",
    "src/api": "exported functions stand in a file with the name of their object",
    "cli": "a command stands in a file with its name",
    "bench": "bench-NAME is a program of one file",
    "examples": "an example is a program of its own, in one file",
    "examples/nodes": "an example is a program of its own",
    "examples/host_deferred": "an example is a program of its own",
    "examples/host_vulkan": "an example is a program of its own",
}

LANGUAGES = "generators/(any)"
WITH_CLOSURES = "generators/mdl generators/osl"
FUNCTIONS = "src/lower src/parse src/print src/specialise src/spell"

# Names that several rooms share because they do one thing, each in its own way: the name, the folders, the thing.
SHARED = {
    "frame.c": (LANGUAGES, "declarations and head of a shader in a language"),
    "forms.c": (LANGUAGES, "forms of operations that depend on types in a language"),
    "syntax.c": ("generators/osl src/print", "the table of a syntax: OSL's, and the one that all others change"),
    "closures.c": (WITH_CLOSURES, "the effects of a shader in a language with closures of its own"),
    "combine.c": (WITH_CLOSURES, "sums, factors and mixes of its closures"),
    "leaves.c": (WITH_CLOSURES, "a leaf as its closures, by the rows of closures.def"),
    "closure_tree.h": (WITH_CLOSURES, "the tree of its closures"),
    "textures.c": (WITH_CLOSURES, "its reads of textures, with address modes"),
    "expression.c": (FUNCTIONS, "what the room does with expressions of the portable language"),
    "statement.c": (FUNCTIONS, "what the room does with statements of the portable language"),
    "lex.c": ("src/parse src/usda", "the tokens of a language of text"),
    "main.c": ("cli compile render", "the main function of a program"),
    "posix.c": ("js/native src/api", "what POSIX has, and what stands for it in WebAssembly"),
    "trap.c": ("js/native src/base", "the unwinding of the stack, by setjmp and in WebAssembly"),
    "usd_mesh.c": ("export render", "meshes of USD, written and read"),
}


def faults_of(paths):
    """The names that stand in several of these paths without a row that allows it, with their places."""
    folders = collections.defaultdict(set)
    for path in paths:
        folders[path.name].add(path.parent.as_posix())
    faults = []
    for name, places in sorted(folders.items()):
        others = places - set(FACES)
        allowed = SHARED.get(name, ("", ""))[0].split()
        if len(others) > 1 and not all(place in allowed or f"{place.rsplit('/', 1)[0]}/(any)" in allowed for place in others):
            faults.append(f"{name}: {' '.join(sorted(places))}")
    return faults, folders


def main():
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "*.c", "*.h"], cwd=ROOT, capture_output=True, text=True, check=False)
    paths = [pathlib.Path(line) for line in listed.stdout.splitlines() if not line.startswith("tests/") and (ROOT / line).exists()]
    check(len(paths) > 500, "the files of the project are found")
    for folder, name in ("src/xml", "mem.c"), ("lsp", "frame.c"), ("src/usda", "text.h"):
        check(faults_of([*paths, pathlib.Path(folder, name)])[0], f"a second {name} is found, in {folder}")
    faults, folders = faults_of(paths)
    for fault in faults:
        check(False, f"one name, several files; name each by its idea, or add a row to tests/tree/names.py: {fault}")
    for name in SHARED:
        check(len(folders[name] - set(FACES)) > 1 or len(folders[name]) > 1, f"tests/tree/names.py: no two files have the name {name} of this row")
    for folder in FACES:
        check(any(folder in places for places in folders.values()), f"tests/tree/names.py: there is no folder {folder}")
    finish("names")


main()
