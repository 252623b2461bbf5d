# SPDX-License-Identifier: Apache-2.0
"""Shader nodes of Blender as surfaces of MaterialX: closures, and mixes of them."""
from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import bpy
import mxgen

from .patterns import Lost, Patterns, Place, Reading
from .principled import principled
from .values import Value


class Surface(NamedTuple):
    """The surface of a shader socket: closures, or a whole shader, which has an opacity of its own."""

    bsdf: mxgen.Draft | None = None
    edf: mxgen.Draft | None = None
    whole: mxgen.Draft | None = None


# ---- Closures ----


def _rough(node: Reading, anisotropy: Value | None = None) -> Value:
    """The widths of facets: the square of the roughness, and the aspect of Cycles' anisotropic closure."""
    g, width = node.graph, node["Roughness"] * node["Roughness"]
    if anisotropy is None or anisotropy.number == 0:
        return g.combine("vector2", width, width)
    stretch = 1.0 - g.min(g.abs(anisotropy), 0.99)
    narrow, wide = width * stretch, width / stretch
    zero = g.value("float", 0)
    return g.combine("vector2", g.choose(zero, anisotropy, narrow, wide), g.choose(zero, anisotropy, wide, narrow))


def _made(node: Reading, category: str, **inputs: Value | float | str) -> mxgen.Draft:
    """A closure with the normal of the node, if it has one."""
    if any(one.name == "Normal" for one in node.node.inputs) and node.is_linked("Normal"):
        inputs["normal"] = node["Normal"]
    return node.graph.draft(category, "BSDF", **inputs)


def _diffuse(node: Reading) -> Surface:
    return Surface(_made(node, "oren_nayar_diffuse_bsdf", color=node["Color"], roughness=node["Roughness"]))


def _glossy(node: Reading) -> Surface:
    anisotropy = node["Anisotropy"] if "Anisotropy" in node.node.inputs else None
    if anisotropy is not None and node["Rotation"].number != 0:
        node.graph.lose(node.node.name, "the rotation of the anisotropy has no counterpart")
    color = node["Color"]
    widths = node.graph.value("vector2", 0) if node.node.distribution == "SHARP" else _rough(node, anisotropy)
    return Surface(_made(node, "generalized_schlick_bsdf", color0=color, color82=node.graph.value("color3", 1), color90=color, roughness=widths))


def _dielectric(mode: str) -> Callable[[Reading], Surface]:
    def convert(node: Reading) -> Surface:
        widths = node.graph.value("vector2", 0) if node.node.distribution == "SHARP" else _rough(node)
        return Surface(_made(node, "dielectric_bsdf", tint=node["Color"], ior=node["IOR"], roughness=widths, scatter_mode=mode))
    return convert


def _translucent(node: Reading) -> Surface:
    return Surface(_made(node, "translucent_bsdf", color=node["Color"]))


def _velvet(node: Reading) -> Surface:
    node.graph.lose(node.node.name, "velvet is a sheen of the same width")
    return Surface(_made(node, "sheen_bsdf", color=node["Color"], roughness=node.graph.clamp(node["Sigma"])))


def _subsurface(node: Reading) -> Surface:
    radius = (node["Radius"] * node["Scale"]).to("color3")
    return Surface(_made(node, "subsurface_bsdf", color=node["Color"], radius=radius, anisotropy=node["Anisotropy"]))


def _emission(node: Reading) -> Surface:
    return Surface(edf=node.graph.draft("uniform_edf", "EDF", color=node["Color"] * node["Strength"]))


def _transparent(node: Reading) -> Surface:
    g, color = node.graph, node["Color"]
    if color.numbers is None or len(set(color.numbers)) > 1:
        g.lose(node.node.name, "light goes through in the grey of the colour")
    return Surface(whole=g.draft("surface", "surfaceshader", opacity=1.0 - color.to("float")))


def _holdout(node: Reading) -> Surface:
    node.graph.lose(node.node.name, "a holdout is black")
    return Surface()


#: shader node: its surface
CLOSURES: dict[str, Callable[[Reading], Surface]] = {
    "ShaderNodeBsdfDiffuse": _diffuse, "ShaderNodeBsdfGlossy": _glossy, "ShaderNodeBsdfAnisotropic": _glossy,
    "ShaderNodeBsdfGlass": _dielectric("RT"), "ShaderNodeBsdfRefraction": _dielectric("T"), "ShaderNodeBsdfTranslucent": _translucent,
    "ShaderNodeBsdfVelvet": _velvet, "ShaderNodeSubsurfaceScattering": _subsurface, "ShaderNodeEmission": _emission,
    "ShaderNodeBsdfTransparent": _transparent, "ShaderNodeHoldout": _holdout,
    "ShaderNodeBsdfPrincipled": lambda node: Surface(whole=principled(node)),
}


# ---- Mixes ----


def as_shader(g: Patterns, surface: Surface) -> mxgen.Draft:
    """The whole shader of closures."""
    if surface.whole is not None:
        return surface.whole
    inputs = {name: closure for name, closure in (("bsdf", surface.bsdf), ("edf", surface.edf)) if closure is not None}
    return g.draft("surface", "surfaceshader", **inputs)


def _mix_closures(g: Patterns, kind: str, a: mxgen.Draft | None, b: mxgen.Draft | None, amount: Value) -> mxgen.Draft | None:
    if a is None and b is None:
        return None
    if a is not None and b is not None:
        return g.draft("mix", kind, bg=a, fg=b, mix=amount)
    return g.draft("multiply", kind, in1=a or b, in2=amount if a is None else 1.0 - amount)


def _mix(node: Reading, amount: Value, a: Surface, b: Surface) -> Surface:
    g = node.graph
    if amount.number in (0.0, 1.0):
        return b if amount.number else a
    if a.whole is None and b.whole is None:
        return Surface(_mix_closures(g, "BSDF", a.bsdf, b.bsdf, amount), _mix_closures(g, "EDF", a.edf, b.edf, amount))
    return Surface(whole=g.draft("mix", "surfaceshader", bg=as_shader(g, a), fg=as_shader(g, b), mix=amount))


def _add_closures(g: Patterns, kind: str, a: mxgen.Draft | None, b: mxgen.Draft | None) -> mxgen.Draft | None:
    return g.draft("add", kind, in1=a, in2=b) if a is not None and b is not None else a or b


def _add(node: Reading, a: Surface, b: Surface) -> Surface:
    g = node.graph
    if a.whole is not None and b.whole is not None or (a.whole or b.whole) and (a.bsdf or b.bsdf or a.edf or b.edf):
        g.lose(node.node.name, "only closures can be added: the first of the two shaders counts")
        return a
    if a.whole is not None or b.whole is not None:
        return a if a.whole is not None else b
    return Surface(_add_closures(g, "BSDF", a.bsdf, b.bsdf), _add_closures(g, "EDF", a.edf, b.edf))


def surface_at(g: Patterns, socket: bpy.types.NodeSocket, place: Place | None = None) -> Surface:
    """The surface of a shader socket; a node without a counterpart is black."""
    found = g.source(socket, place)
    if not isinstance(found, tuple):
        return Surface()
    shader, _, inside = found
    node = Reading(g, shader, inside)
    if shader.bl_idname == "ShaderNodeMixShader":
        amount, a, b = g.clamp(node[0]), surface_at(g, shader.inputs[1], inside), surface_at(g, shader.inputs[2], inside)
        g.base = shader.label or shader.name
        return _mix(node, amount, a, b)
    if shader.bl_idname == "ShaderNodeAddShader":
        a, b = (surface_at(g, one, inside) for one in shader.inputs)
        g.base = shader.label or shader.name
        return _add(node, a, b)
    convert = CLOSURES.get(shader.bl_idname)
    if convert is None:
        g.lose(shader.name, f"the shader '{shader.bl_label}' has no counterpart, and is black")
        return Surface()
    g.base = shader.label or shader.name
    try:
        return convert(node)
    except Lost as lost:
        g.lose(shader.name, str(lost))
        return Surface()
