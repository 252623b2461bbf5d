#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the interfaces of mxgen's definitions with those of MaterialX, and prints what differs, a line each:

    compare.py MXGEN CHECKOUT

MXGEN is the program, CHECKOUT a copy of MaterialX's sources or its folder `libraries`. Of each input and output are compared: its type, its
default, uniform, defaultgeomprop, enumerations and units; of inputs with --ui also names, folders and ranges. Definitions that only mxgen has
are counted."""
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree

MEANING = ["type", "value", "uniform", "defaultgeomprop", "defaultinput", "enum", "enumvalues", "unit", "unittype", "hint"]
USER_INTERFACE = ["uiname", "uifolder", "uiadvanced", "uimin", "uimax", "uisoftmin", "uisoftmax", "uistep"]
RAW = re.compile(r"&(?!(?:lt|gt|amp|quot|apos|#\d+|#x[0-9a-fA-F]+);)")
ABSENT = {"uniform": "false", "uiadvanced": "false", "enum": "", "hint": ""}


def canonical(name, text, kind):
    """An attribute as it compares: numbers by value, lists without blanks."""
    if name == "value" and not text and kind in ("string", "filename", "BSDF", "EDF", "VDF", "surfaceshader", "displacementshader"):
        return None
    if text is None:
        return ABSENT.get(name)
    words = [word.strip() for word in text.split(",")]
    try:
        return tuple(float(word) for word in words)
    except ValueError:
        return ",".join(words)


def ports(definition, tag, all_definitions):
    """The inputs or outputs of a definition, with those that it inherits."""
    found = {}
    while definition is not None:
        for port in definition.findall(tag):
            found.setdefault(port.get("name"), port)
        definition = all_definitions.get(definition.get("inherit"))
    return found


def definitions(texts):
    found = {}
    for text in texts:
        root = xml.etree.ElementTree.fromstring(RAW.sub("&amp;", text))
        found.update({definition.get("name"): definition for definition in root.iter("nodedef")})
    return found


def differences(name, ours, theirs, all_ours, all_theirs, attributes):
    for tag in ("input", "output"):
        mine, other = ports(ours, tag, all_ours), ports(theirs, tag, all_theirs)
        for port in sorted(other.keys() - mine.keys()):
            yield f"{name}.{port}: mxgen lacks the {tag}"
        for port in sorted(mine.keys() - other.keys()):
            yield f"{name}.{port}: MaterialX lacks the {tag}"
        for port in sorted(mine.keys() & other.keys()):
            kind = mine[port].get("type")
            for attribute in attributes:
                have, want = (canonical(attribute, one[port].get(attribute), kind) for one in (mine, other))
                if have != want:
                    yield f"{name}.{port}: {attribute} is {mine[port].get(attribute)!r}, in MaterialX {other[port].get(attribute)!r}"


def main():
    arguments = [argument for argument in sys.argv[1:] if argument != "--ui"]
    attributes = MEANING + (USER_INTERFACE if "--ui" in sys.argv else [])
    folder = pathlib.Path(arguments[1])
    folder = folder / "libraries" if (folder / "libraries").is_dir() else folder
    expanded = subprocess.run([arguments[0], "library", "expand", "-q"], check=True, capture_output=True, text=True).stdout
    ours = definitions([expanded])
    theirs = definitions(path.read_text(encoding="utf-8") for path in sorted(folder.rglob("*.mtlx")))
    lines = [f"{name}: mxgen lacks the definition" for name in sorted(theirs.keys() - ours.keys())]
    for name in sorted(theirs.keys() & ours.keys()):
        lines += differences(name, ours[name], theirs[name], ours, theirs, attributes)
    print("\n".join(lines))
    print(f"{len(theirs)} definitions of MaterialX, {len(ours)} of mxgen, {len(ours.keys() - theirs.keys())} only there; {len(lines)} differences")


main()
