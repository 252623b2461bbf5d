#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A report from elsewhere puts no markup into the reports that are made of it, and no control character on the terminal: each text of a
report becomes hostile in turn, also those that a report may have and this one lacks. Argument: mxgen."""
import copy
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish

MXGEN = pathlib.Path(sys.argv[1]).resolve()
HOSTILE = "\"'/><script>alert(1)</script><!-- ]]>%s%n&amp;\x07\x1b[31m\x9b31m"
DOCUMENT = """<materialx version="1.39"><standard_surface name="S" type="surfaceshader"></standard_surface>
<surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial></materialx>
"""
# what a run with a device, a budget and a baseline adds to an element
DRAWN = {"picture": "", "fullPicture": "", "slabs": "", "drawnError": "", "signature": "", "steps": [{
    "text": "", "closuresBefore": 1, "closuresAfter": 1, "bytesBefore": 1, "bytesAfter": 1, "estimated": "", "drawn": "",
    "estimatedError": "", "drawnError": ""}]}
CHANGE = {"kind": "new-errors", "element": "M", "target": "glsl", "text": "", "from": "", "to": ""}


def places(value, path=()):
    """The paths of all texts."""
    if isinstance(value, str):
        yield path
    for key, part in value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ():
        yield from places(part, (*path, key))


def names(value, path=()):
    """The paths of all keys that are names: of values, textures and parts."""
    if isinstance(value, dict):
        for key, part in value.items():
            if path and path[-1] in ("values", "textures", "instructions", "closures", "samplers", "uniformBytes", "sourceBytes"):
                yield (*path, key)
            yield from names(part, (*path, key))
    for index, part in enumerate(value) if isinstance(value, list) else ():
        yield from names(part, (*path, index))


def changed(report, path, rename):
    out = copy.deepcopy(report)
    at = out
    for key in path[:-1]:
        at = at[key]
    if rename:
        at[HOSTILE] = at.pop(path[-1])
    else:
        at[path[-1]] = HOSTILE
    return out


def try_report(folder, report, what):
    (folder / "part.json").write_text(json.dumps(report), encoding="utf-8")
    command = [MXGEN, "check", "merge", "part.json", "--html", "page.html", "--junit", "cases.xml", "--json", "merged.json"]
    result = subprocess.run(command, cwd=folder, capture_output=True, check=False)
    check(result.returncode in (0, 1), f"{what}: exit code {result.returncode}: {result.stderr[-200:]}")
    said = (result.stdout + result.stderr).decode(errors="replace")
    check(not re.search(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]", said), f"{what}: a control character goes to the terminal: {said!r}")
    for name, scripts in ("page.html", 1), ("cases.xml", 0):
        path = folder / name
        if not path.exists():
            continue
        try:
            found = [part.tag.rpartition("}")[2] for part in ElementTree.parse(path).iter()]
        except ElementTree.ParseError as fault:
            check(False, f"{what}: {name} is not well-formed: {fault}")
            continue
        check(found.count("script") == scripts, f"{what}: {name} has {found.count('script')} scripts")
        path.unlink()
    (folder / "merged.json").unlink(missing_ok=True)


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "look.mtlx").write_text(DOCUMENT, encoding="utf-8")
        subprocess.run([MXGEN, "check", "look.mtlx", "--no-compile", "--max-closures", "1", "--json", "whole.json"], cwd=folder, check=False,
                       capture_output=True)
        report = json.loads((folder / "whole.json").read_text(encoding="utf-8"))
        check(report["documents"] and report["documents"][0]["elements"], "the report has an element")
        for document in report["documents"]:
            document["changes"] = [CHANGE]
            for message in document["messages"]:
                message.update({"baselineState": "", "notes": [{"message": "", "text": "", "file": ""}]})
            for element in document["elements"]:
                element.update(DRAWN)
        paths = list(places(report))
        check(len(paths) > 40, f"{len(paths)} texts")
        for path in paths:
            if path[0] != "format":
                try_report(folder, changed(report, path, False), "/".join(map(str, path)))
        for path in names(report):
            try_report(folder, changed(report, path, True), "name " + "/".join(map(str, path)))


main()
finish("hostile-report")
