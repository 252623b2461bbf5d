#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""MaterialX's own libraries, unchanged, in place of the built-in library: a document for each definition (documents.py), and the example
materials and test suite of MaterialX, generate for all targets and compile.

    libraries.py mxgen-compile shared/materials

The environment variable MXGEN_MATERIALX names a copy of MaterialX's sources with `libraries`; without it the test is skipped. Its
`resources`, if it has them, serve in place of those of shared/materials. exceptions.tsv lists what fails, with the reason. OSL is
compiled if oslc is installed."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import documents
from checks import check, finish, skip

COMPILE, MATERIALS = sys.argv[1], pathlib.Path(sys.argv[2])
HERE = pathlib.Path(__file__).resolve().parent
COLORSPACES = HERE.parent.parent / "libraries" / "colorspaces"  # spaces of OpenColorIO, which MaterialX's library lacks
TARGETS = ["glsl", "essl", "vulkan", "osl"]
LEAST_DEFINITIONS = 0.98  # of the documents of definitions
LEAST_DOCUMENTS = 69 / 71  # of the documents of the test suite with something to draw


def run(libraries, files, *arguments):
    """The targets per element and file for which there is a shader without an error."""
    done = subprocess.run([COMPILE, *map(str, files), "--no-builtin-library", "--library", str(libraries), "--trust", "--targets",
                           ",".join(TARGETS), "--interfaces", "complete", "--max-errors", "0", *arguments],
                          capture_output=True, text=True, check=False)
    check(done.returncode in (0, 1), f"mxgen-compile ends with {done.returncode}: {done.stderr[-500:]}")
    targets = {str(file): {} for file in files}
    for line in done.stdout.splitlines():
        file, element, target, *_ = line.split("\t")
        targets[file].setdefault(element, set()).add(target)
    for line in done.stderr.splitlines():  # a shader that does not compile has a row, too
        file = line.split(":")[0]
        if ": error: " in line and file in targets:
            targets[file].setdefault("", set())
    return targets


def errors_of(libraries, file, *arguments):
    done = subprocess.run([COMPILE, str(file), "--no-builtin-library", "--library", str(libraries), "--trust", "--targets",
                           ",".join(TARGETS), "--interfaces", "complete", "--max-errors", "0", *arguments],
                          capture_output=True, text=True, check=False)
    lines = [line for line in done.stderr.splitlines() if "error: " in line]
    return ",".join(sorted({line[line.rindex("[") + 1:-1] for line in lines if line.endswith("]")})), lines


def judge(libraries, name, file, elements, exceptions, *arguments, is_part=False):
    """True if every element of the document has a shader for each target, and no error."""
    is_whole = bool(elements) and all(len(targets) == len(TARGETS) for targets in elements.values())
    ids, lines = ("", []) if is_whole and name not in exceptions else errors_of(libraries, file, *arguments)
    expected = exceptions.pop(name, "")
    if is_part and ids == "include-missing":
        skip(f"{name} includes a file that shared/materials does not have")
        return True
    check(ids == expected, f'{name}: expected "{expected}", got "{ids}": {" ".join(lines[:2])}')
    return not ids and is_whole


def check_definitions(libraries, exceptions):
    with tempfile.TemporaryDirectory() as folder:
        written, others = documents.write(libraries, pathlib.Path(folder))
        check(len(written) >= 700, f"{len(written)} definitions have a document; there are more")
        for name in others:
            print(f"no document: {name}")
        files = {name: pathlib.Path(folder) / f"{name}.mtlx" for name in written}
        rows = run(libraries, files.values())
        good = 0
        for name, file in files.items():
            elements, arguments = rows[str(file)], []
            if not elements and name not in exceptions:  # a material without shaders, which is no renderable by itself
                arguments = ["-e", "n"]
                elements = run(libraries, [file], *arguments)[str(file)]
            good += judge(libraries, name, file, elements, exceptions, *arguments)
        check(good >= LEAST_DEFINITIONS * len(written), f"{good} of {len(written)} definitions generate and compile")
        print(f"definitions: {good} of {len(written)} generate and compile for {', '.join(TARGETS)}")


def check_documents(libraries, resources, is_part, exceptions):
    for folder, least in (("Examples", 1), ("TestSuite", LEAST_DOCUMENTS)):
        root = resources / "Materials" / folder
        files = {str(file.relative_to(root)): file for file in sorted(root.rglob("*.mtlx"))}
        more = ["--library", str(COLORSPACES)] if folder == "TestSuite" else []
        rows = run(libraries, files.values(), *more)
        good = silent = 0
        for name, file in files.items():
            elements = rows[str(file)]
            is_empty = not elements and name not in exceptions and not errors_of(libraries, file, *more)[0].replace("nothing-to-render", "")
            if is_empty:  # nothing in it can be drawn: definitions, options, lights
                silent += 1
                continue
            good += judge(libraries, name, file, elements, exceptions, *more, is_part=is_part)
        check(files and good >= least * (len(files) - silent), f"{folder}: {good} of {len(files) - silent} documents generate and compile")
        print(f"{folder}: {good} of {len(files) - silent} documents generate and compile; {silent} have nothing to draw")


def main():
    root = os.environ.get("MXGEN_MATERIALX", "")
    libraries = pathlib.Path(root) / "libraries"
    if not root or not libraries.is_dir():
        skip("MXGEN_MATERIALX does not name a folder with MaterialX's libraries")
        finish("materialx")
    if not shutil.which("oslc"):
        skip("without oslc no OSL is compiled")
    rows = (line.split("\t") for line in (HERE / "exceptions.tsv").read_text().splitlines()[1:])
    exceptions = {what: errors for what, errors, _ in rows}
    check_definitions(libraries, exceptions)
    own = pathlib.Path(root) / "resources"
    is_part = not (own / "Materials").is_dir()
    resources = MATERIALS / "resources" if is_part else own
    if resources.is_dir():
        check_documents(libraries, resources, is_part, exceptions)
        left = [name for name in exceptions if not (is_part and name.endswith(".mtlx"))]  # shared/materials lacks some documents
        check(not left, f"exceptions.tsv has rows without a document: {', '.join(left)}")
    else:
        skip("there are no documents of MaterialX")
    finish("materialx")


main()
