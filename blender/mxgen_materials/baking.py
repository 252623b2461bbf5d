# SPDX-License-Identifier: Apache-2.0
"""Documents whose materials the Principled BSDF cannot have become flat documents of one model, with images (docs/bake.md)."""
from __future__ import annotations

import pathlib
from typing import NamedTuple

import bpy
import mxgen

from .losses import Loss
from .mapping import EXPORTED, MODELS


class Baking(NamedTuple):
    """How graphs become images."""

    #: for the flat document and its images
    folder: pathlib.Path
    #: texels along each side; 0: as many as the largest texture of a graph has, or 1024
    size: int = 0
    #: an object with a mesh that has texture coordinates: its surface; None: texture coordinates alone
    surface: bpy.types.Object | None = None


def surface_of(material: mxgen.Element) -> mxgen.Element | None:
    """The surface shader of a material."""
    port = material.child("surfaceshader")
    return port.connection.source if port is not None and port.connection is not None else None


def translate_unknown(document: mxgen.Document, path: str, losses: list[Loss]) -> mxgen.Document:
    """The document, or one in the model of the export where a material has a surface of another model. Raises mxgen.DocumentError."""
    surfaces = [surface_of(element) for element in document if element.category == "surfacematerial"]
    if all(surface is None or surface.category in MODELS for surface in surfaces):
        return document
    translated = document.translate(EXPORTED)
    losses += [Loss(pathlib.Path(path).name, one.id, one.message) for one in translated.diagnostics if one.severity is not mxgen.Severity.NOTE]
    return mxgen.Context().parse(translated.text, name=path)


def bake(document: mxgen.Document, baking: Baking) -> tuple[mxgen.Document, pathlib.Path]:
    """The flat document, and its path. Raises mxgen.RenderError: a graph cannot be an image."""
    options = ["--size", str(baking.size)] if baking.size else []
    if baking.surface is not None:
        mesh = pathlib.Path(bpy.app.tempdir) / "surface.obj"
        _write_mesh(baking.surface, mesh)
        options += ["--mesh", str(mesh)]
    path = mxgen.bake(document, baking.folder, options=options)
    return mxgen.Context().load(path), path


def _write_mesh(surface: bpy.types.Object, path: pathlib.Path) -> None:
    selected, active = bpy.context.selected_objects, bpy.context.view_layer.objects.active
    for one in selected:
        one.select_set(False)
    surface.select_set(True)
    bpy.ops.wm.obj_export(filepath=str(path), export_selected_objects=True, export_materials=False, export_triangulated_mesh=True)
    surface.select_set(False)
    for one in selected:
        one.select_set(True)
    bpy.context.view_layer.objects.active = active
