#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The compiler finds its formulas by name, in the files that src/meson.build lists: each call has its function, and each function a call
or another function that calls it. Argument: the root of the project."""
import pathlib
import re
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish

ROOT = pathlib.Path(sys.argv[1])
CODE = "\n".join(path.read_text(encoding="utf-8") for folder in ("src", "generators") for path in sorted((ROOT / folder).rglob("*.c")))
LISTED = re.search(r"formula_texts = \{\}(.*?)\n  \}", (ROOT / "src/meson.build").read_text(encoding="utf-8"), re.DOTALL).group(1)
called = set(re.findall(r'"(mx_\w+)"', CODE))
files = re.findall(r": '([^']+\.glsl)'", LISTED)
check(len(files) > 1, "src/meson.build lists the files")
known = set()
for file in files:
    text = (ROOT / "libraries" / file).read_text(encoding="utf-8")
    names = set(re.findall(r"^\w+ (mx_\w+)\(", text, re.MULTILINE))
    inner = {name for name in names if re.search(rf"^ .*\b{name}\(", text, re.MULTILINE)}
    known |= names
    check(not (unused := names - called - inner), f"{file}: nobody calls {unused}")
wanted = set(re.findall(r'\b(?:FORMULA|of_interface)\(\s*[^,()]+(?:->\w+)?, "(mx_\w+)"', CODE))
check(len(wanted) > 10, "calls are found")
check(not (absent := wanted - known), f"no file of formulas has {absent}")
finish("formulas")
