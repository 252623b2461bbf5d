# SPDX-License-Identifier: Apache-2.0
"""Stages of OpenUSD's Python package `pxr`, which the caller has: this module does not import it."""
from __future__ import annotations

from typing import Protocol

from .context import Context
from .scene import Scene


class _Layer(Protocol):
    """The part of pxr.Sdf.Layer that is used."""

    @property
    def identifier(self) -> str: ...

    @property
    def realPath(self) -> str: ...


class Stage(Protocol):
    """The part of pxr.Usd.Stage that is used."""

    def ExportToString(self, addSourceFileComment: bool = ...) -> str: ...

    def GetRootLayer(self) -> _Layer: ...


def scene(stage: Stage, *, context: Context | None = None, purpose: str | None = None) -> Scene:
    """The scene of a composed stage: its prims, bindings, primvars, transforms, materials and instances, whatever arcs they come from.

    `context` reads it; None: a new one. `purpose` chooses among the bindings as in `Context.load_scene`. Messages have lines of the
    text that `stage.ExportToString()` gives, under the name of the root layer. The scene does not change with the stage. Raises
    DocumentError."""
    layer = stage.GetRootLayer()
    text = stage.ExportToString(addSourceFileComment=False)
    return (context or Context()).parse_scene(text, name=layer.realPath or layer.identifier, purpose=purpose)
