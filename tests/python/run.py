#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The tests of the Python package: all test_*.py of this folder. Afterwards every public function has been called, and every function
of the C library is used. Arguments: the root of the project, a folder with the package ("": the installed one), the program."""
import inspect
import os
import pathlib
import re
import sys
import types
import unittest

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path += [str(FOLDER.parent), str(FOLDER)]
from checks import check, finish, skip

os.environ.pop("LD_PRELOAD", None) # the sanitizer of this process, but not of the program
if sys.argv[2]:
    sys.path.insert(0, sys.argv[2])
import mxgen

import common

ROOT = pathlib.Path(sys.argv[1])
common.EXAMPLES = ROOT / "examples"
common.PROGRAM = sys.argv[3]
CALLED = set()
# A package gets along without it: Python frees objects.
NOT_USED = {"mxg_library_ref"}


def remember(frame, event, _argument):
    if event == "call":
        CALLED.add(frame.f_code)


def functions_of(owner):
    """The public functions, methods and properties of a class or module, with their names."""
    for name, member in vars(owner).items():
        if name.startswith("_") and name not in ("__getitem__", "__iter__", "__len__", "__eq__", "__hash__", "__enter__", "__exit__"):
            continue
        member = member.fget if isinstance(member, property) else inspect.unwrap(member) if callable(member) else member
        if isinstance(member, types.FunctionType) and member.__module__.startswith("mxgen"):
            yield name, member


def check_calls():
    for name in mxgen.__all__:
        thing = getattr(mxgen, name)
        if isinstance(thing, types.FunctionType):
            check(thing.__code__ in CALLED, f"no test calls mxgen.{name}")
        elif inspect.isclass(thing):
            check(bool(thing.__doc__), f"mxgen.{name} has no docstring")
            for method, function in functions_of(thing):
                if function.__code__.co_filename == "<string>": # made by dataclasses
                    continue
                check(function.__code__ in CALLED, f"no test calls mxgen.{name}.{method}")
                check(method.startswith("__") or bool(function.__doc__), f"mxgen.{name}.{method} has no docstring")


def check_library():
    headers = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "include/mxgen").glob("*.h") if path.name != "node.h")
    declared = set(re.findall(r"MXG_API [^;]*?\b(mxg_\w+)\(", headers))
    package = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "python/mxgen").glob("*.py"))
    for name in sorted(declared - NOT_USED):
        check(f"lib.{name}" in package, f"the Python package does not use {name}")
    check(len(declared) > 80, f"the headers declare {len(declared)} functions only")


sys.setprofile(remember)
result = unittest.TextTestRunner(stream=sys.stdout, verbosity=0).run(unittest.defaultTestLoader.discover(str(FOLDER)))
sys.setprofile(None)
for _ in range(result.testsRun - len(result.failures) - len(result.errors) - len(result.skipped)):
    check(True, "")
for test, text in result.failures + result.errors:
    check(False, f"{test}: {text}")
for _, reason in result.skipped:
    skip(reason)
check_calls()
check_library()
finish("python")
