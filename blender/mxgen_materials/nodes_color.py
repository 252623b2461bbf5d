# SPDX-License-Identifier: Apache-2.0
"""Nodes of Blender that make and change colours: Mix, Color Ramp, Invert, Gamma, Hue/Saturation, and what takes colours apart."""
from __future__ import annotations

from collections.abc import Callable

from .patterns import Lost, Reading, converts
from .values import Graph, Value

# ---- Mix ----


def _overlay(g: Graph, a: Value, b: Value) -> Value:
    return g.choose(g.value("float", 0.5), a, a * b * 2.0, 1.0 - (1.0 - a) * (1.0 - b) * 2.0)


def _dodge(g: Graph, a: Value, b: Value, factor: Value) -> Value:
    room, zero = 1.0 - factor * b, g.value("float", 0)
    return g.choose(a, zero, g.choose(room, zero, g.min(a / room, 1.0), 1.0), 0.0)


def _burn(g: Graph, a: Value, b: Value, factor: Value) -> Value:
    part = 1.0 - factor + factor * b
    return g.choose(part, g.value("float", 0), g.clamp(1.0 - (1.0 - a) / part), 0.0)


def _soft_light(g: Graph, a: Value, b: Value) -> Value:
    screen = 1.0 - (1.0 - a) * (1.0 - b)
    return (1.0 - a) * b * a + a * screen


#: blend type: the colour that the factor leads to, component by component where the formula chooses
BLENDS = {
    "MIX": lambda g, a, b: b, "ADD": lambda g, a, b: a + b, "SUBTRACT": lambda g, a, b: a - b, "MULTIPLY": lambda g, a, b: a * b,
    "SCREEN": lambda g, a, b: 1.0 - (1.0 - a) * (1.0 - b), "DIFFERENCE": lambda g, a, b: g.abs(a - b), "DARKEN": lambda g, a, b: g.min(a, b),
    "LIGHTEN": lambda g, a, b: g.max(a, b), "SOFT_LIGHT": _soft_light, "LINEAR_LIGHT": lambda g, a, b: a + 2.0 * b - 1.0,
}
#: those whose formula chooses
CHOICES = {"OVERLAY": _overlay, "DIVIDE": lambda g, a, b: g.choose(g.abs(b), g.value("float", 0), a / b, a)}
#: those with the factor in the formula, which gives the result
FACTORED = {"DODGE": _dodge, "BURN": _burn}
#: blend type: which of hue, saturation and value come from the second colour
TAKES = {"HUE": (0,), "SATURATION": (1,), "VALUE": (2,), "COLOR": (0, 1)}


def _by_parts(g: Graph, work: Callable[..., Value], a: Value, b: Value, *more: Value) -> Value:
    return g.combine(a.kind, *(work(g, a.part(i), b.part(i), *more) for i in range(3)))


def _by_hsv(g: Graph, taken: tuple[int, ...], a: Value, b: Value) -> Value:
    one, two = g.node("rgbtohsv", "color3", **{"in": a}), g.node("rgbtohsv", "color3", **{"in": b})
    return g.node("hsvtorgb", "color3", **{"in": g.combine("color3", *((two if i in taken else one).part(i) for i in range(3)))})


def _blend(g: Graph, kind: str, a: Value, b: Value, factor: Value) -> Value:
    if kind in FACTORED:
        return _by_parts(g, FACTORED[kind], a, b, factor)
    if kind in TAKES:
        # a grey second colour has no hue: Blender keeps the first one
        blended = _by_hsv(g, TAKES[kind], a, b)
        if 0 in TAKES[kind]:
            blended = g.choose(g.node("rgbtohsv", "color3", **{"in": b}).part(1), g.value("float", 0), blended, a)
    elif kind in CHOICES:
        blended = _by_parts(g, CHOICES[kind], a, b)
    elif kind in BLENDS:
        blended = BLENDS[kind](g, a, b)
    else:
        raise Lost(f"the blend {kind} has no counterpart")
    return g.mix(a, blended, factor)


@converts("ShaderNodeMixRGB")
def convert_mix_rgb(node: Reading, output: str) -> Value:
    g = node.graph
    made = _blend(g, node.node.blend_type, node[1], node[2], g.clamp(node[0]))
    return g.clamp(made) if node.node.use_clamp else made


@converts("ShaderNodeMix")
def convert_mix(node: Reading, output: str) -> Value:
    g, settings = node.graph, node.node
    factor, a, b = node["Factor"], node["A"], node["B"]
    if settings.clamp_factor:
        factor = g.clamp(factor)
    if settings.data_type != "RGBA":
        return g.mix(a, b, factor)
    made = _blend(g, settings.blend_type, a, b, factor)
    return g.clamp(made) if settings.clamp_result else made


# ---- Ramps ----

#: interpolation of a ramp between two stops: the share of the second at a share of the way
STEPS = {"LINEAR": lambda g, t: g.clamp(t), "EASE": lambda g, t: g.smoothstep(t), "CONSTANT": None}


@converts("ShaderNodeValToRGB")
def convert_ramp(node: Reading, output: str) -> Value:
    g, ramp, x = node.graph, node.node.color_ramp, node["Fac"]
    way = ramp.interpolation
    if ramp.color_mode != "RGB":
        raise Lost(f"a ramp in {ramp.color_mode} has no counterpart")
    if way not in STEPS:
        g.lose(node.node.name, f"a ramp with the interpolation {way} is linear")
        way = "LINEAR"
    stops = [(stop.position, g.value("float", stop.alpha) if output == "Alpha" else g.value("color3", tuple(stop.color)[:3])) for stop in ramp.elements]
    made = stops[0][1]
    for (before, _), (position, color) in zip(stops, stops[1:]):
        if STEPS[way] is None or position - before < 1e-6:
            made = g.choose(x, g.value("float", position), color, made, is_equal=True)
        else:
            made = g.mix(made, color, STEPS[way](g, (x - before) / (position - before)))
    return made


# ---- Changes ----


@converts("ShaderNodeInvert")
def convert_invert(node: Reading, output: str) -> Value:
    color = node["Color"]
    return node.graph.mix(color, 1.0 - color, node["Fac"])


@converts("ShaderNodeGamma")
def convert_gamma(node: Reading, output: str) -> Value:
    return node.graph.power(node.graph.max(node["Color"], 0.0), node["Gamma"])


@converts("ShaderNodeBrightContrast")
def convert_brightness(node: Reading, output: str) -> Value:
    g, contrast = node.graph, node["Contrast"]
    return g.max(node["Color"] * (contrast + 1.0) + (node["Bright"] - contrast * 0.5), 0.0)


@converts("ShaderNodeHueSaturation")
def convert_hue(node: Reading, output: str) -> Value:
    g, color = node.graph, node["Color"]
    hsv = g.node("rgbtohsv", "color3", **{"in": color})
    changed = g.combine("color3", g.fract(hsv.part(0) + node["Hue"] + 0.5), g.clamp(hsv.part(1) * node["Saturation"]), hsv.part(2) * node["Value"])
    return g.mix(color, g.max(g.node("hsvtorgb", "color3", **{"in": changed}), 0.0), node["Fac"])


@converts("ShaderNodeRGBToBW")
def convert_luminance(node: Reading, output: str) -> Value:
    return node["Color"].to("float")


@converts("ShaderNodeSeparateColor", "ShaderNodeSeparateHSV")
def convert_separate_color(node: Reading, output: str) -> Value:
    g, mode = node.graph, getattr(node.node, "mode", "HSV")
    if mode == "HSL":
        raise Lost("HSL has no counterpart")
    color = g.node("rgbtohsv", "color3", **{"in": node[0]}) if mode == "HSV" else node[0]
    return color.part([one.name for one in node.node.outputs].index(output))


@converts("ShaderNodeCombineColor", "ShaderNodeCombineHSV", "ShaderNodeCombineRGB")
def convert_combine_color(node: Reading, output: str) -> Value:
    g = node.graph
    mode = getattr(node.node, "mode", "HSV" if node.node.bl_idname == "ShaderNodeCombineHSV" else "RGB")
    if mode == "HSL":
        raise Lost("HSL has no counterpart")
    made = g.combine("color3", node[0], node[1], node[2])
    return g.node("hsvtorgb", "color3", **{"in": made}) if mode == "HSV" else made


@converts("ShaderNodeRGB")
def convert_rgb(node: Reading, output: str) -> Value:
    return node.graph.value("color3", tuple(node.node.outputs[0].default_value)[:3])


@converts("ShaderNodeBlackbody")
def convert_blackbody(node: Reading, output: str) -> Value:
    return node.graph.node("blackbody", "color3", temperature=node["Temperature"])
