# SPDX-License-Identifier: Apache-2.0
"""Values of node trees as values of a MaterialX document: numbers as long as they are known, nodes where they vary."""
from __future__ import annotations

import math
import operator
import re
from collections.abc import Callable, Sequence
from typing import Union

import mxgen

#: the components of each type
WIDTHS = {"float": 1, "vector2": 2, "color3": 3, "vector3": 3, "color4": 4}
#: Rec. 709, the primaries of Blender's scene
LUMINANCE = (0.2126, 0.7152, 0.0722)

#: what stands for a value in a formula
Operand = Union["Value", float, int, Sequence[float]]


class Value:
    """A value of a type of MaterialX: `numbers` where it is known, or an output of a node."""

    __slots__ = ("graph", "kind", "numbers", "node", "output")

    def __init__(self, graph: Graph, kind: str, numbers: Sequence[float] | None = None, node: mxgen.Draft | None = None,
                 output: str | None = None) -> None:
        self.graph, self.kind, self.node, self.output = graph, kind, node, output
        self.numbers = None if numbers is None else tuple(float(x) for x in numbers)

    @property
    def number(self) -> float | None:
        """The value of a float that is known."""
        return self.numbers[0] if self.numbers is not None and self.kind == "float" else None

    def part(self, index: int) -> Value:
        """A component as a float."""
        if self.numbers is not None:
            return Value(self.graph, "float", [self.numbers[index]])
        return self if self.kind == "float" else self.graph.node("extract", "float", **{"in": self, "index": index})

    def to(self, kind: str) -> Value:
        """The value in another type, as Blender converts: a colour has its luminance, a vector the mean of its components."""
        if kind == self.kind:
            return self
        if kind != "float" and self.kind == "float" and self.numbers is not None:
            return Value(self.graph, kind, self.numbers * WIDTHS[kind])
        if kind == "float" and self.kind == "color3" and self.numbers is None:
            return self.graph.node("luminance", "color3", **{"in": self, "lumacoeffs": self.graph.value("color3", LUMINANCE)}).part(0)
        if kind == "float":
            weights = LUMINANCE if self.kind == "color3" else (1 / 3, 1 / 3, 1 / 3)
            return self.graph.dot(self, Value(self.graph, self.kind, weights))
        if self.numbers is not None:
            return Value(self.graph, kind, (*self.numbers, 0.0, 1.0)[:WIDTHS[kind]] if WIDTHS[kind] > len(self.numbers) else self.numbers[:WIDTHS[kind]])
        if WIDTHS[kind] < WIDTHS[self.kind]:
            return self.graph.combine(kind, *(self.part(i) for i in range(WIDTHS[kind])))
        return self.graph.node("convert", kind, **{"in": self})

    # ---- Formulas ----

    def __add__(self, other: Operand) -> Value: return self.graph.operate("add", operator.add, self, other)
    def __radd__(self, other: Operand) -> Value: return self.graph.operate("add", operator.add, other, self)
    def __sub__(self, other: Operand) -> Value: return self.graph.operate("subtract", operator.sub, self, other)
    def __rsub__(self, other: Operand) -> Value: return self.graph.operate("subtract", operator.sub, other, self)
    def __mul__(self, other: Operand) -> Value: return self.graph.operate("multiply", operator.mul, self, other)
    def __rmul__(self, other: Operand) -> Value: return self.graph.operate("multiply", operator.mul, other, self)
    def __truediv__(self, other: Operand) -> Value: return self.graph.operate("divide", lambda a, b: a / b if b else 0.0, self, other)
    def __rtruediv__(self, other: Operand) -> Value: return self.graph.operate("divide", lambda a, b: a / b if b else 0.0, other, self)
    def __neg__(self) -> Value: return self * -1.0


class Graph:
    """The nodes of a document under construction, with functions for formulas. `made` has what was added."""

    def __init__(self, edit: mxgen.Edit) -> None:
        self.edit = edit
        self.made: list[mxgen.Draft] = []
        self.base = "" # names of new nodes begin with it

    def name(self, text: str) -> str:
        return self.edit.unique_name(re.sub(r"\W+", "_", text, flags=re.ASCII).strip("_") or "node")

    def value(self, kind: str, numbers: Sequence[float] | float) -> Value:
        return Value(self, kind, [numbers] * WIDTHS[kind] if isinstance(numbers, (int, float)) else numbers)

    def draft(self, category: str, kind: str, **inputs: Operand | str | mxgen.Draft) -> mxgen.Draft:
        """A node with inputs: values, numbers, texts, or other nodes."""
        made = self.edit.add(category, self.name(f"{self.base}_{category}"), kind)
        for name, given in inputs.items():
            if isinstance(given, mxgen.Draft):
                made.connect(name, given)
            elif not isinstance(given, Value):
                made.value(name, given)
            elif given.numbers is not None:
                made.value(name, given.numbers, given.kind)
            else:
                made.connect(name, given.node, given.output)
        return made

    def node(self, category: str, kind: str, **inputs: Operand | str) -> Value:
        made = self.draft(category, kind, **inputs)
        self.made.append(made)
        return Value(self, kind, node=made)

    def operate(self, category: str, formula: Callable[[float, float], float], a: Operand, b: Operand) -> Value:
        """A node of two values of one type, or of a type and a float, component by component; known numbers are computed."""
        one, two = (x if isinstance(x, Value) else self.value("float", x) if isinstance(x, (int, float)) else self.value("vector3", x) for x in (a, b))
        kind = one.kind if two.kind == "float" else two.kind
        if one.numbers is not None and two.numbers is not None:
            left, right = (x.numbers * (WIDTHS[kind] // len(x.numbers)) for x in (one, two))
            return Value(self, kind, list(map(formula, left, right)))
        neutral = {"add": 0.0, "subtract": 0.0, "multiply": 1.0, "divide": 1.0}.get(category)
        if two.numbers is not None and set(two.numbers) == {neutral}:
            return one.to(kind)
        if one.numbers is not None and set(one.numbers) == {neutral} and category in ("add", "multiply"):
            return two.to(kind)
        return self.node(category, kind, in1=one.to(kind), in2=two if two.kind == "float" and kind != "float" else two.to(kind))

    # ---- Functions ----

    def call(self, category: str, formula: Callable[[float], float], x: Value) -> Value:
        """A function of one value, component by component."""
        if x.numbers is not None:
            return Value(self, x.kind, list(map(formula, x.numbers)))
        return self.node(category, x.kind, **{"in": x})

    def floor(self, x: Value) -> Value: return self.call("floor", math.floor, x)
    def ceil(self, x: Value) -> Value: return self.call("ceil", math.ceil, x)
    def abs(self, x: Value) -> Value: return self.call("absval", abs, x)
    def sign(self, x: Value) -> Value: return self.call("sign", lambda a: (a > 0) - (a < 0), x)
    def sqrt(self, x: Value) -> Value: return self.call("sqrt", lambda a: math.sqrt(max(a, 0.0)), x)
    def exp(self, x: Value) -> Value: return self.call("exp", math.exp, x)
    def ln(self, x: Value) -> Value: return self.call("ln", lambda a: math.log(a) if a > 0 else 0.0, x)
    def sin(self, x: Value) -> Value: return self.call("sin", math.sin, x)
    def cos(self, x: Value) -> Value: return self.call("cos", math.cos, x)
    def tan(self, x: Value) -> Value: return self.call("tan", math.tan, x)
    def asin(self, x: Value) -> Value: return self.call("asin", lambda a: math.asin(min(max(a, -1.0), 1.0)), x)
    def acos(self, x: Value) -> Value: return self.call("acos", lambda a: math.acos(min(max(a, -1.0), 1.0)), x)
    def min(self, a: Operand, b: Operand) -> Value: return self.operate("min", min, a, b)
    def max(self, a: Operand, b: Operand) -> Value: return self.operate("max", max, a, b)
    def modulo(self, a: Operand, b: Operand) -> Value: return self.operate("modulo", lambda x, y: x - y * math.floor(x / y) if y else 0.0, a, b)
    def power(self, a: Operand, b: Operand) -> Value: return self.operate("power", lambda x, y: x ** y if x > 0 or (x == 0 and y >= 0) else 0.0, a, b)
    def fract(self, x: Value) -> Value: return self.call("fract", lambda a: a - math.floor(a), x)
    def clamp(self, x: Value, low: float = 0.0, high: float = 1.0) -> Value:
        if x.numbers is not None:
            return Value(self, x.kind, [min(max(a, low), high) for a in x.numbers])
        return self.node("clamp", x.kind, **{"in": x, "low": self.value(x.kind, low), "high": self.value(x.kind, high)})

    def atan2(self, y: Value, x: Value) -> Value:
        if y.numbers is not None and x.numbers is not None:
            return Value(self, "float", [math.atan2(y.numbers[0], x.numbers[0])])
        return self.node("atan2", "float", iny=y, inx=x)

    def dot(self, a: Value, b: Value) -> Value:
        if a.numbers is not None and b.numbers is not None:
            return Value(self, "float", [sum(map(operator.mul, a.numbers, b.numbers))])
        return self.node("dotproduct", "float", in1=a, in2=b)

    def length(self, x: Value) -> Value:
        return Value(self, "float", [math.hypot(*x.numbers)]) if x.numbers is not None else self.node("magnitude", "float", **{"in": x})

    def normalize(self, x: Value) -> Value:
        return self.node("normalize", x.kind, **{"in": x})

    def cross(self, a: Value, b: Value) -> Value:
        return self.node("crossproduct", "vector3", in1=a, in2=b)

    def combine(self, kind: str, *parts: Value) -> Value:
        if all(part.numbers is not None for part in parts):
            return Value(self, kind, [part.numbers[0] for part in parts])
        return self.node(f"combine{len(parts)}", kind, **{f"in{i + 1}": part for i, part in enumerate(parts)})

    def mix(self, a: Value, b: Value, amount: Operand) -> Value:
        """a where the amount is 0, b where it is 1; a vector mixes component by component."""
        factor = amount if isinstance(amount, Value) else self.value("float", amount)
        known = factor.number
        if known in (0.0, 1.0):
            return b if known else a
        if a.numbers is not None and b.numbers is not None and factor.numbers is not None:
            return a + (b - a) * factor
        return self.node("mix", a.kind, bg=a, fg=b.to(a.kind), mix=factor)

    def choose(self, a: Value, b: Value, yes: Operand, no: Operand, is_equal: bool = False) -> Value:
        """`yes` where the float a is greater than b (is_equal: not less), otherwise `no`."""
        results = [x if isinstance(x, Value) else self.value("float", x) for x in (yes, no)]
        if a.numbers is not None and b.numbers is not None:
            return results[0] if a.numbers > b.numbers or (is_equal and a.numbers == b.numbers) else results[1]
        return self.node("ifgreatereq" if is_equal else "ifgreater", results[0].kind, value1=a, value2=b, in1=results[0], in2=results[1])

    def smoothstep(self, x: Value) -> Value:
        """0 below 0, 1 above 1, 3x² - 2x³ between."""
        t = self.clamp(x)
        return t * t * (3.0 - 2.0 * t)
