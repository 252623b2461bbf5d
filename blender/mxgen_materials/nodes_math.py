# SPDX-License-Identifier: Apache-2.0
"""Nodes of Blender that compute: Math, Vector Math, Map Range, Clamp, and what takes vectors apart."""
from __future__ import annotations

import math

from .patterns import Lost, Reading, converts
from .values import Graph, Value


def _wrap(g: Graph, x: Value, high: Value, low: Value) -> Value:
    extent = high - low
    return g.choose(g.abs(extent), g.value("float", 0), x - extent * g.floor((x - low) / extent), low)


def _pingpong(g: Graph, x: Value, scale: Value) -> Value:
    return g.choose(g.abs(scale), g.value("float", 0), g.abs(g.fract((x - scale) / (scale * 2.0)) * scale * 2.0 - scale), 0.0)


def _smooth_min(g: Graph, a: Value, b: Value, distance: Value) -> Value:
    h = g.max(distance - g.abs(a - b), 0.0) / distance
    return g.choose(distance, g.value("float", 0), g.min(a, b) - h * h * h * distance * (1 / 6), g.min(a, b))


def _toward_zero(g: Graph, x: Value) -> Value:
    return g.sign(x) * g.floor(g.abs(x))


def _remainder(g: Graph, a: Value, b: Value) -> Value:
    """The rest of a division whose quotient is cut off: it has the sign of a."""
    return a - b * _toward_zero(g, a / b)


def _compare(g: Graph, a: Value, b: Value, within: Value) -> Value:
    return g.choose(g.max(within, 1e-5), g.abs(a - b), 1.0, 0.0, is_equal=True)


def _power(g: Graph, a: Value, b: Value) -> Value:
    """A negative number has whole powers alone; its other powers are 0."""
    exponent = b.number
    if exponent is None or exponent != round(exponent):
        return g.power(g.max(a, 0.0), b)
    return g.power(g.abs(a), b) * (g.sign(a) if exponent % 2 else 1.0)


def _logarithm(g: Graph, a: Value, b: Value) -> Value:
    """0 where it is undefined."""
    zero = g.value("float", 0)
    return g.choose(g.min(a, b), zero, g.ln(a) / g.ln(b), 0.0)


def _tanh(g: Graph, x: Value) -> Value:
    return 1.0 - 2.0 / (g.exp(x * 2.0) + 1.0)


#: operation of the node Math: its value
MATH = {
    "ADD": lambda g, a, b, c: a + b, "SUBTRACT": lambda g, a, b, c: a - b, "MULTIPLY": lambda g, a, b, c: a * b,
    "DIVIDE": lambda g, a, b, c: g.choose(g.abs(b), g.value("float", 0), a / b, 0.0),
    "MULTIPLY_ADD": lambda g, a, b, c: a * b + c,
    "POWER": lambda g, a, b, c: _power(g, a, b), "LOGARITHM": lambda g, a, b, c: _logarithm(g, a, b),
    "SQRT": lambda g, a, b, c: g.sqrt(g.max(a, 0.0)), "INVERSE_SQRT": lambda g, a, b, c: g.choose(a, g.value("float", 0), 1.0 / g.sqrt(a), 0.0),
    "ABSOLUTE": lambda g, a, b, c: g.abs(a), "EXPONENT": lambda g, a, b, c: g.exp(a),
    "MINIMUM": lambda g, a, b, c: g.min(a, b), "MAXIMUM": lambda g, a, b, c: g.max(a, b),
    "LESS_THAN": lambda g, a, b, c: g.choose(b, a, 1.0, 0.0), "GREATER_THAN": lambda g, a, b, c: g.choose(a, b, 1.0, 0.0),
    "SIGN": lambda g, a, b, c: g.sign(a), "COMPARE": _compare, "SMOOTH_MIN": _smooth_min,
    "SMOOTH_MAX": lambda g, a, b, c: -_smooth_min(g, -a, -b, c),
    "ROUND": lambda g, a, b, c: g.floor(a + 0.5), "FLOOR": lambda g, a, b, c: g.floor(a), "CEIL": lambda g, a, b, c: g.ceil(a),
    "TRUNC": lambda g, a, b, c: _toward_zero(g, a), "FRACT": lambda g, a, b, c: g.fract(a), "MODULO": lambda g, a, b, c: _remainder(g, a, b),
    "WRAP": _wrap, "SNAP": lambda g, a, b, c: g.floor(a / b) * b, "PINGPONG": lambda g, a, b, c: _pingpong(g, a, b),
    "SINE": lambda g, a, b, c: g.sin(a), "COSINE": lambda g, a, b, c: g.cos(a), "TANGENT": lambda g, a, b, c: g.tan(a),
    "ARCSINE": lambda g, a, b, c: g.asin(g.clamp(a, -1, 1)), "ARCCOSINE": lambda g, a, b, c: g.acos(g.clamp(a, -1, 1)),
    "ARCTANGENT": lambda g, a, b, c: g.atan2(a, g.value("float", 1)), "ARCTAN2": lambda g, a, b, c: g.atan2(a, b),
    "SINH": lambda g, a, b, c: (g.exp(a) - g.exp(-a)) * 0.5, "COSH": lambda g, a, b, c: (g.exp(a) + g.exp(-a)) * 0.5,
    "TANH": lambda g, a, b, c: _tanh(g, a),
    "RADIANS": lambda g, a, b, c: a * (math.pi / 180), "DEGREES": lambda g, a, b, c: a * (180 / math.pi),
}


@converts("ShaderNodeMath")
def convert_math(node: Reading, output: str) -> Value:
    g, work = node.graph, MATH.get(node.node.operation)
    if work is None:
        raise Lost(f"the operation {node.node.operation} has no counterpart")
    made = work(g, node[0], node[1], node[2])
    return g.clamp(made) if node.node.use_clamp else made


def _each(work):
    """A function of numbers, for each component."""
    def apply(g: Graph, *vectors: Value) -> Value:
        return g.combine("vector3", *(work(g, *(vector.part(i) for vector in vectors)) for i in range(3)))
    return apply


def _project(g: Graph, a: Value, b: Value) -> Value:
    return b * (g.dot(a, b) / g.max(g.dot(b, b), 1e-30))


def _reflect(g: Graph, a: Value, b: Value) -> Value:
    normal = g.normalize(b)
    return a - normal * (g.dot(a, normal) * 2.0)


#: operation of the node Vector Math: its value from the vectors a, b, c and the number Scale
VECTORS = {
    "ADD": lambda g, a, b, c, s: a + b, "SUBTRACT": lambda g, a, b, c, s: a - b, "MULTIPLY": lambda g, a, b, c, s: a * b,
    "DIVIDE": lambda g, a, b, c, s: _each(lambda g, x, y: MATH["DIVIDE"](g, x, y, None))(g, a, b),
    "MULTIPLY_ADD": lambda g, a, b, c, s: a * b + c,
    "CROSS_PRODUCT": lambda g, a, b, c, s: g.cross(a, b), "PROJECT": lambda g, a, b, c, s: _project(g, a, b), "REFLECT": lambda g, a, b, c, s: _reflect(g, a, b),
    "FACEFORWARD": lambda g, a, b, c, s: g.choose(g.value("float", 0), g.dot(b, c), a, -a),
    "DOT_PRODUCT": lambda g, a, b, c, s: g.dot(a, b), "DISTANCE": lambda g, a, b, c, s: g.length(a - b), "LENGTH": lambda g, a, b, c, s: g.length(a),
    "SCALE": lambda g, a, b, c, s: a * s, "NORMALIZE": lambda g, a, b, c, s: g.normalize(a), "ABSOLUTE": lambda g, a, b, c, s: g.abs(a),
    "MINIMUM": lambda g, a, b, c, s: g.min(a, b), "MAXIMUM": lambda g, a, b, c, s: g.max(a, b), "FLOOR": lambda g, a, b, c, s: g.floor(a),
    "CEIL": lambda g, a, b, c, s: g.ceil(a), "FRACTION": lambda g, a, b, c, s: g.fract(a), "MODULO": lambda g, a, b, c, s: _remainder(g, a, b),
    "WRAP": lambda g, a, b, c, s: _each(_wrap)(g, a, b, c), "SNAP": lambda g, a, b, c, s: g.floor(a / b) * b,
    "SINE": lambda g, a, b, c, s: g.sin(a), "COSINE": lambda g, a, b, c, s: g.cos(a), "TANGENT": lambda g, a, b, c, s: g.tan(a),
}


@converts("ShaderNodeVectorMath")
def convert_vector_math(node: Reading, output: str) -> Value:
    work = VECTORS.get(node.node.operation)
    if work is None:
        raise Lost(f"the operation {node.node.operation} has no counterpart")
    return work(node.graph, node[0], node[1], node[2], node[3])


@converts("ShaderNodeMapRange")
def convert_map_range(node: Reading, output: str) -> Value:
    g, settings = node.graph, node.node
    if settings.data_type != "FLOAT":
        raise Lost("a range of vectors has no counterpart")
    low, high = node["To Min"], node["To Max"]
    t = (node["Value"] - node["From Min"]) / (node["From Max"] - node["From Min"])
    kind = settings.interpolation_type
    if kind == "STEPPED":
        steps = node["Steps"]
        t = g.floor(t * (steps + 1.0)) / steps
    elif kind == "SMOOTHSTEP":
        t = g.smoothstep(t)
    elif kind == "SMOOTHERSTEP":
        t = g.clamp(t)
        t = t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
    if settings.clamp and kind in ("LINEAR", "STEPPED"):
        t = g.clamp(t)
    return low + t * (high - low)


@converts("ShaderNodeClamp")
def convert_clamp(node: Reading, output: str) -> Value:
    g, low, high = node.graph, node["Min"], node["Max"]
    if node.node.clamp_type == "RANGE":
        low, high = g.min(low, high), g.max(low, high)
    return g.min(g.max(node["Value"], low), high)


@converts("ShaderNodeSeparateXYZ", "ShaderNodeSeparateRGB")
def convert_separate(node: Reading, output: str) -> Value:
    return node[0].part({"X": 0, "Y": 1, "Z": 2, "R": 0, "G": 1, "B": 2}[output])


@converts("ShaderNodeCombineXYZ")
def convert_combine(node: Reading, output: str) -> Value:
    return node.graph.combine("vector3", node[0], node[1], node[2])


@converts("ShaderNodeValue")
def convert_value(node: Reading, output: str) -> Value:
    return node.graph.value("float", float(node.node.outputs[0].default_value))
