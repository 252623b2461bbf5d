#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""OSL networks of slabs and stacks, by their text: the last layer of each group is the whole shader of the element, with the closures that
--target osl has, and its parameters are outputs of layers. Needs no oslc. Arguments: mxgen, the folder of examples."""
import collections
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check_fault, finish

MXGEN, EXAMPLES = sys.argv[1], pathlib.Path(sys.argv[2])
CLOSURE = re.compile(r"\b(\w+_(?:bsdf|bssrdf|edf|vdf))\(")
PARAMETER = re.compile(r"^    (output )?(?:closure )?\w+ (\w+)(?:\[\d\])? = ", re.MULTILINE)


def generate(document, folder, *arguments):
    subprocess.run([MXGEN, document, "--target", "osl", "-q", "-o", folder, *arguments], check=True, stderr=subprocess.DEVNULL)


def shader(path):
    """The inputs and outputs of a shader, and its body."""
    head, _, body = path.read_text(encoding="utf-8").rpartition("\n{\n")
    head = head[max(head.rfind(f"\n{kind} ") for kind in ("shader", "surface", "volume", "displacement")):]
    found = PARAMETER.findall(head)
    return {name for out, name in found if not out}, {name for out, name in found if out}, body


def group_fault(path):
    """What is wrong with the layers of a group; None: nothing."""
    layers, values, connected = {}, set(), set()
    for line in path.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if words[0] == "param":
            values.add(words[2].split(".")[0])
        elif words[0] == "shader":
            layers[words[2]] = shader(path.parent / f"{words[1]}.osl")
            last, name, values, given, connected = words[1], words[2], set(), values, set()
            if given - layers[name][0]:
                return f"{name} has no parameter {given - layers[name][0]}"
        else:
            (source, output), (layer, parameter) = words[1].split("."), words[2].split(".")
            if layer != name or parameter not in layers[name][0] or output not in layers[source][1]:
                return line
            connected.add(parameter)
    if name != "root" or not re.fullmatch(rf"{path.name.split('.')[0]}_[0-9a-f]{{8}}", last):
        return f"the last layer is {name}, a {last}"
    missing = layers[name][0] - connected - given
    missing = {one for one in missing if not re.search(rf" {one} = .*lockgeom = 0", (path.parent / f"{last}.osl").read_text(encoding="utf-8"))}
    return f"nothing gives {missing}" if missing else None


def closures(path):
    return collections.Counter(CLOSURE.findall(shader(path)[2]))


def run_document(document, arguments, is_whole):
    with tempfile.TemporaryDirectory() as work:
        net, one = pathlib.Path(work) / "net", pathlib.Path(work) / "one"
        generate(document, net, "--osl-network", *arguments)
        generate(document, one, *arguments)
        groups = [path for path in sorted(net.glob("*.oslgroup")) if is_whole or list(net.glob(f"{path.name.split('.')[0]}_*.osl"))]
        check_fault(f"{document.name} has groups", None if groups else "none")
        for path in groups:
            check_fault(f"{document.name} {path.name}", group_fault(path))
            if ".displacement." in path.name:
                continue
            element = path.stem
            # the shader of a stack is that of the first with its topology
            alone = one / f"{element}.osl"
            whole = next(p for p in net.glob(f"{element}_*.osl") if "\nsurface " in p.read_text(encoding="utf-8"))
            if alone.exists():
                different = closures(whole) != closures(alone)
                check_fault(f"{document.name} {element}: closures", f"{closures(whole)} instead of {closures(alone)}" if different else None)
        odd = [path.name for path in net.glob("ND_*.osl") if CLOSURE.search(shader(path)[2]) and is_whole]
        check_fault(f"{document.name}: no closure of another shader", ", ".join(odd))


for path in sorted(EXAMPLES.glob("slab*.mtlx")):
    run_document(path, [], True)
slots = EXAMPLES / "slots"
run_document(slots / "looks.mtlx", ["--stage", slots / "receiver.usda", "--look", "finished"], False)
finish("osl-structure")
