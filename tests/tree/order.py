#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The order in which C evaluates the arguments of a call is open, and nodes of the graph have numbers in the order of their making.
So no two arguments of one call make nodes: otherwise two compilers give different shaders. Argument: the root of the project."""
import pathlib
import re
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish

ROOT = pathlib.Path(sys.argv[1])
# Constants have no place among the statements, so their numbers are in no output. `ir_arg` reads.
HARMLESS = {"ir_arg", "ir_const_float", "ir_const_splat", "number", "splat", "grey", "uint_of", "ir_white", "ir_black"}
KEYWORDS = {"if", "while", "for", "switch", "return", "sizeof", "assert"}
CALL = re.compile(r"\b([a-zA-Z_]\w*)\(")
MAKER = re.compile(r"^(static )?(?:inline )?(?:ir_ref|mxg_ref)\s+(\w+)\(", re.MULTILINE)


def without_comments(text):
    return re.sub(r"/\*.*?\*/|//[^\n]*", lambda found: re.sub(r"[^\n]", " ", found.group()), text, flags=re.DOTALL)


def arguments(text, start):
    """The arguments of the call whose parenthesis opens before `start`."""
    depth, found, first = 0, [], start
    for at in range(start, len(text)):
        if text[at] in "([{":
            depth += 1
        elif text[at] in ")]}":
            if depth == 0:
                return found + [text[first:at]]
            depth -= 1
        elif text[at] == "," and depth == 0:
            found.append(text[first:at])
            first = at + 1
    return []


def open_orders(text, makers):
    """(line, function) of each call of which two arguments make nodes."""
    for call in CALL.finditer(text):
        if call.group(1) in KEYWORDS:
            continue
        making = [argument for argument in arguments(text, call.end()) if any(inner.group(1) in makers for inner in CALL.finditer(argument))]
        if len(making) > 1:
            yield text.count("\n", 0, call.start()) + 1, call.group(1)


def main():
    paths = [path for folder in ("src", "generators", "include") for path in sorted((ROOT / folder).rglob("*.[ch]"))]
    texts = {path: without_comments(path.read_text(encoding="utf-8")) for path in paths}
    makers = {name for path, text in texts.items() for static, name in MAKER.findall(text) if not static or path.suffix == ".h"} - HARMLESS
    makers.add("FORMULA") # a macro
    check(len(makers) > 100, "the functions that make nodes are found")
    example = "x = ir_op2(g, IR_ADD, ir_op1(g, IR_SIN, a),\n ir_op1(g, IR_COS, f(b, c)));"
    check(list(open_orders(example, makers)) == [(1, "ir_op2")], "an open order is found")
    for path, text in texts.items():
        if path.suffix == ".c":
            own = {name for _, name in MAKER.findall(text)} - HARMLESS
            faults = [f"{path.relative_to(ROOT)}:{line}: {name}" for line, name in open_orders(text, makers | own)]
            check(not faults, "two arguments make nodes: " + ", ".join(faults))
    finish("order")


main()
