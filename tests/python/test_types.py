# SPDX-License-Identifier: Apache-2.0
"""An argument of a wrong type is refused by name in every parameter of every public function: no error comes from what is inside."""
import dataclasses
import enum
import inspect
import re
import typing
import unittest

import mxgen

import common

SCENE = '#usda 1.0\ndef Xform "set" { def Mesh "m" { rel material:binding = </set/M> }\ndef Material "M" {} }\n'
LOOK = '<look name="L"><materialassign name="a" material="Gold" geom="/"/></look></materialx>'
# They take any object: callbacks of with, comparisons, keys that may be missing.
ANY = {"__exit__", "__eq__", "__contains__", "__getattr__", "__setattr__", "__delattr__", "__init_subclass__", "__reduce__", "__setstate__"}


class Wrong:
    """Of no type that a function takes."""


def objects_of():
    """One object of each public class that has any."""
    context = mxgen.Context()
    document = context.parse(common.GOLD.replace("</materialx>", LOOK))
    shader = document.generate("glsl", "Gold")
    found, todo = {}, [context, document, shader, context.parse_scene(SCENE)]
    found_scene = todo[-1]
    todo += [document.bind(found_scene), document.edit()]
    while todo:
        thing = todo.pop()
        kind = type(thing)
        if not kind.__module__.startswith("mxgen") or kind in found or isinstance(thing, enum.Enum):
            continue
        found[kind] = thing
        for name in dir(kind):
            if name.startswith("_") or not isinstance(getattr(kind, name), property):
                continue
            try:
                value = getattr(thing, name)
            except mxgen.Error: # an edit that has made no document yet
                continue
            todo += list(value)[:2] if isinstance(value, (list, tuple)) else [value]
    return found


def functions_of(found):
    """The bound public functions, with their names."""
    for name in mxgen.__all__:
        thing = getattr(mxgen, name)
        if inspect.isfunction(thing):
            yield name, thing
        if not inspect.isclass(thing) or issubclass(thing, (BaseException, enum.Enum)) or dataclasses.is_dataclass(thing):
            continue
        for method in dir(thing):
            is_public = not method.startswith("_") or method in ("__getitem__", "__call__")
            if is_public and method not in ANY and thing in found and callable(getattr(thing, method)):
                yield f"{name}.{method}", getattr(found[thing], method)


def has_type(parameter):
    return parameter.annotation not in (inspect.Parameter.empty, typing.Any, "Any", "object", "bool")


class Types(unittest.TestCase):
    def test_wrong_types_are_type_errors(self):
        found, count = objects_of(), 0
        for name, function in functions_of(found):
            parameters = inspect.signature(function).parameters.values()
            fixed = [p for p in parameters if p.kind in (p.POSITIONAL_ONLY, p.POSITIONAL_OR_KEYWORD)]
            named = [p for p in parameters if p.kind is p.KEYWORD_ONLY]
            for wanted in [p for p in fixed + named if has_type(p)]:
                for wrong in Wrong(), "x", 3, 2.5, [Wrong()]:
                    count += 1
                    self.check(found, name, function, fixed, wanted, wrong)
        self.assertGreater(count, 300)

    def check(self, found, name, function, fixed, wanted, wrong):
        """Gives the wrong value to one parameter, and leaves out what can be left out."""
        arguments = {p.name: right(found, p) for p in fixed if p.default is p.empty}
        arguments[wanted.name] = wrong
        try:
            result = function(*[arguments.pop(p.name) for p in fixed if p.name in arguments and p.kind is p.POSITIONAL_ONLY], **arguments)
            if inspect.isgenerator(result):
                list(result)
        except (TypeError, ValueError, LookupError, OSError, mxgen.Error, ModuleNotFoundError):
            pass # another argument may be wrong as well, a wrong member of an enum is a ValueError, and numpy may be missing
        except Exception as error: # pylint: disable=broad-exception-caught
            self.fail(f"{name}({wanted.name}={wrong!r}): {type(error).__name__}: {error}")
        else:
            self.assertFalse(isinstance(wrong, Wrong), f"{name}({wanted.name}={wrong!r}) is accepted")


def right(found, parameter):
    """A value of the type of a parameter."""
    for kind, thing in found.items():
        if re.search(rf"\b{kind.__name__}\b", str(parameter.annotation)):
            return thing
    values = {"Block": mxgen.Block.PUBLIC_UNIFORMS, "int": 0, "bytearray": bytearray(64), "Sequence": (), "Iterable": (), "Mapping": {}}
    return next((value for word, value in values.items() if str(parameter.annotation).startswith(word)), "x")


if __name__ == "__main__":
    unittest.main()
