#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""clang compiles the C sources that draw, with the build's flags, without warnings. The build with a sanitizer (script/test) has the other
sources: clang makes it, and a warning is an error. Argument: the build folder, with its compile_commands.json."""
import json
import pathlib
import shlex
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

BUILD = pathlib.Path(sys.argv[1])
CLANG = shutil.which("clang")
OF_GCC = {"-fdiagnostics-color=always"}
DRAWS = ("bench", "compile", "examples", "export", "render", "tests/conformance", "tests/deferred", "tests/physics", "tests/programs")


def check(entry):
    """What clang says of a source, or ''."""
    words = shlex.split(entry["command"])
    flags = [word for word in words[1:] if word.startswith(("-I", "-D", "-std", "-W", "-f", "-isystem")) and word not in OF_GCC]
    flags = [flag for flag in flags if not flag.startswith("-Winvalid")]
    command = [CLANG, *flags, "-Werror", "-Wno-unknown-warning-option", "-fsyntax-only", entry["file"]]
    return subprocess.run(command, cwd=entry["directory"], capture_output=True, text=True, check=False).stderr


if not CLANG:
    print("skip: clang is not installed")
    sys.exit(77)
sources = {entry["file"]: entry for entry in json.loads((BUILD / "compile_commands.json").read_text(encoding="utf-8"))
           if entry["file"].endswith(".c") and entry["file"].removeprefix("../").startswith(DRAWS)}
with ThreadPoolExecutor(2) as pool:
    said = list(pool.map(check, sources.values()))
faults = [text for text in said if text]
print("\n".join(faults[:10]))
print(f"clang: {len(said) - len(faults)} passed, {len(faults)} failed, 0 skipped")
sys.exit(bool(faults))
