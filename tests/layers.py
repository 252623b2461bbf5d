#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks the includes: a room of src/ includes only earlier rooms, the back end does not include the front end, one room includes
libxml2, two files know the platform, programs include only the public header and nothing of the commands (cli), and at most three files of a room call each other in a circle. Argument: the
root of the project."""
import pathlib
import re
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent))
from checks import check, finish

ROOT = pathlib.Path(sys.argv[1])
ROOMS = "base diag ir document xml usda tree parse lower specialise print shader closure slabs deferred library bind build dynamic material network walk spell translate api".split()
FRONT = set("document xml usda parse library bind build dynamic material network walk".split())
BACK = {"ir", "lower", "specialise", "print", "closure", "slabs", "deferred", "shader", "spell", "translate"}
PROGRAMS = "cli check compile doc export lsp render".split()
INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)[">]', re.MULTILINE)

# Headers with <> that a library in C17 may include, and the files that need more: they know their platform.
PORTABLE = re.compile(r"(assert|ctype|errno|inttypes|limits|math|setjmp|stdalign|stdarg|stdatomic|stdbool|stddef|stdint|stdio|stdlib|string)\.h|(libxml|mxgen)/\w+\.h")
PLATFORM = {"posix.c", "windows.c"}
ASKED = re.compile(r"^\s*#\s*(?:include\s*<([^>]+)>|.*\b(_(?:POSIX_C|XOPEN|GNU|DEFAULT)_SOURCE|__unix__|__linux__|__APPLE__|_WIN32)\b)", re.MULTILINE)


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
        if used in ROOMS:
            return "programs stand on mxgen.h alone"
        if used == "cli" and place != "cli":
            return "nothing stands on the commands"
        return "program stands below all programs" if place == "program" and used in PROGRAMS else None
    if used not in ROOMS or used == room:
        return None
    if ROOMS.index(used) > ROOMS.index(room):
        return f"{room} stands below {used}"
    if room in BACK and used in FRONT:
        return f"{room} is in the back of the house, {used} in front"
    return None


DEFINITION = re.compile(r"^(?!static|typedef|#)[A-Za-z_][\w \t*]*?[ *](\w+)\((?:[^;{}])*?\)\n\{", re.MULTILINE)
COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)


def calls_of(room):
    """The files of a room by name; each with the files whose functions it names."""
    texts = {path.name: COMMENT.sub("", path.read_text(encoding="utf-8")) for path in (ROOT / "src" / room).glob("*.c")}
    owners = {name: file for file, text in texts.items() for name in DEFINITION.findall(text)}
    return {file: {owners[word] for word in re.findall(r"\w+", text) if word in owners} - {file} for file, text in texts.items()}


def reached(calls, file):
    """Every file that `file` calls, over others, too."""
    found, new = set(), {file}
    while new:
        new = {called for name in new for called in calls[name]} - found
        found |= new
    return found


MAX_CIRCLE = 3
for room in sorted(path.name for path in (ROOT / "src").iterdir() if path.is_dir()):
    calls = calls_of(room)
    below = {file: reached(calls, file) for file in calls}
    circles = {frozenset(other for other in below[file] if file in below[other]) for file in calls}
    for circle in circles:
        check(len(circle) <= MAX_CIRCLE, f"src/{room}: a circle of {len(circle)} files: {' '.join(sorted(circle))}")

for folder in ("src", "generators", "program", "bench", "examples", *PROGRAMS):
    for path in sorted((ROOT / folder).rglob("*.[ch]")):
        for included in INCLUDE.findall(path.read_text(encoding="utf-8")):
            fault = fault_of(path, included)
            check(not fault, f"{path.relative_to(ROOT)} includes {included}: {fault}")
for path in sorted(path for folder in ("src", "generators") for path in (ROOT / folder).rglob("*.[ch]") if path.name not in PLATFORM):
    for included, macro in ASKED.findall(path.read_text(encoding="utf-8")):
        check(included and PORTABLE.fullmatch(included), f"{path.relative_to(ROOT)}: {included or macro} is for src/api/posix.c and src/api/windows.c")
finish("layers")
