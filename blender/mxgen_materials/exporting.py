# SPDX-License-Identifier: Apache-2.0
"""Materials of Blender as MaterialX documents: a Principled BSDF is an OpenPBR surface, other shaders are closures, patterns are nodegraphs."""
from __future__ import annotations

import os
from collections.abc import Iterable

import bpy
import mxgen

from . import nodes_color, nodes_geometry, nodes_math, nodes_texture # noqa: F401: they register their converters
from .closures import as_shader, surface_at
from .losses import Loss
from .patterns import Lost, Patterns, Reading


def _displacement(g: Patterns, socket: bpy.types.NodeSocket) -> mxgen.Draft | None:
    """The displacement along the normal; None: there is none."""
    found = g.source(socket, None)
    if not isinstance(found, tuple):
        return None
    shader, _, place = found
    if shader.bl_idname != "ShaderNodeDisplacement" or shader.space != "OBJECT":
        g.lose("Displacement", f"the node '{shader.bl_label}' is not converted: only Displacement in object space is")
        return None
    node = Reading(g, shader, place)
    g.base = shader.name
    return g.draft("displacement", "displacementshader", displacement=node["Height"] - node["Midlevel"], scale=node["Scale"])


def _convert(edit: mxgen.Edit, material: bpy.types.Material, folder: str, losses: list[Loss]) -> None:
    g = Patterns(edit, material, folder, losses)
    output = material.node_tree.get_output_node("ALL") if material.use_nodes and material.node_tree is not None else None
    if output is None or not isinstance(g.source(output.inputs["Surface"], None), tuple):
        g.lose("surface", "the material has no surface of nodes")
        return
    if output.inputs["Volume"].is_linked:
        g.lose("Volume", "volumes are not converted")
    try:
        surface = as_shader(g, surface_at(g, output.inputs["Surface"]))
        displacement = _displacement(g, output.inputs["Displacement"])
    except Lost as lost:
        g.lose("surface", str(lost))
        return
    surface.rename(edit.unique_name(f"SR_{material.name}"))
    made = edit.add("surfacematerial", edit.unique_name(material.name), "material").connect("surfaceshader", surface)
    if displacement is not None:
        made.connect("displacementshader", displacement)
    if g.made:
        edit.group(g.made, edit.unique_name(f"NG_{material.name}"))


def export_file(path: str, materials: Iterable[bpy.types.Material]) -> list[Loss]:
    """Writes a document with the materials. Raises mxgen.DocumentError or OSError; then the file is as before."""
    edit, losses = mxgen.Context().edit(name=path), []
    for material in materials:
        _convert(edit, material, os.path.dirname(os.path.abspath(path)), losses)
    text = edit.end().xml()
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return losses
