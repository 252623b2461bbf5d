#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks the includes: a room of src/ includes only earlier rooms, the back end does not include the front end, one room includes
libxml2, and programs include only the public header. Argument: the root of the project."""
import pathlib
import re
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent))
from checks import check, finish

ROOT = pathlib.Path(sys.argv[1])
ROOMS = "base diag ir document xml lang shader closure library build spell bind api".split()
FRONT = {"document", "xml", "library", "build", "bind"}
BACK = {"ir", "closure", "shader", "spell"}
INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)[">]', re.MULTILINE)


def fault_of(path, included):
    """What is wrong with an include, or None."""
    room = path.relative_to(ROOT / "src").parts[0] if path.is_relative_to(ROOT / "src") else None
    used = included.split("/")[0] if "/" in included else None
    if used == "libxml" and room not in ("xml", None):
        return "libxml2 lives in src/xml"
    if room is None:
        place = path.relative_to(ROOT).parts[0]
        if place == "generators":
            return "a target sees the back of the house only" if used in FRONT | {"api"} else None
        return "programs stand on mxgen.h alone" if used in ROOMS else None
    if used not in ROOMS or used == room:
        return None
    if ROOMS.index(used) > ROOMS.index(room):
        return f"{room} stands below {used}"
    if room in BACK and used in FRONT:
        return f"{room} is in the back of the house, {used} in front"
    return None


for folder in "src", "generators", "cli", "check", "compile", "doc", "render":
    for path in sorted((ROOT / folder).rglob("*.[ch]")):
        for included in INCLUDE.findall(path.read_text(encoding="utf-8")):
            fault = fault_of(path, included)
            check(not fault, f"{path.relative_to(ROOT)} includes {included}: {fault}")
finish("layers")
