# SPDX-License-Identifier: Apache-2.0
"""Principled materials as OpenPBR documents."""
from __future__ import annotations

import os
import re
from collections.abc import Iterable

import bpy
import mxgen

from .losses import Loss
from .mapping import EXPORTED, MODELS, SHADER, ior_of, specular_of

#: sockets that only matter if another one is above 0
NEEDS = {"Anisotropic Rotation": "Anisotropic", "Sheen Tint": "Sheen", "Clearcoat Roughness": "Clearcoat", "Transmission Roughness": "Transmission",
         "Subsurface IOR": "Subsurface", "Subsurface Anisotropy": "Subsurface", "Subsurface Color": "Subsurface"}
TYPES = {"RGBA": "color3", "VALUE": "float", "VECTOR": "vector3"}


def _name(text: str, taken: set[str]) -> str:
    """A name of MaterialX that is new."""
    base = re.sub(r"\W", "_", text, flags=re.ASCII) or "material"
    base = f"_{base}" if base[0].isdigit() else base
    name, number = base, 1
    while name in taken:
        number += 1
        name = f"{base}_{number}"
    taken.add(name)
    return name


class _Exporter:
    """The conversion of one material."""

    def __init__(self, edit: mxgen.Edit, material: bpy.types.Material, folder: str, taken: set[str]) -> None:
        self.edit, self.material, self.folder, self.taken = edit, material, folder, taken
        self.losses: list[Loss] = []
        self.model = MODELS[EXPORTED]

    def lose(self, what: str, reason: str) -> None:
        self.losses.append(Loss(self.material.name, what, reason))

    def find_shader(self) -> bpy.types.Node | None:
        if not self.material.use_nodes or self.material.node_tree is None:
            self.lose("surface", "the material has no nodes")
            return None
        output = self.material.node_tree.get_output_node("ALL")
        links = output.inputs["Surface"].links if output is not None else ()
        node = links[0].from_node if links else None
        if output is not None and output.inputs["Displacement"].is_linked:
            self.lose("Displacement", "displacement is not converted")
        if node is None or node.type != "BSDF_PRINCIPLED":
            self.lose("surface", f"the surface is no {SHADER}")
            return None
        return node

    # ---- Textures ----

    def image(self, node: bpy.types.Node, kind: str, what: str) -> mxgen.Draft | None:
        image = node.image
        if image is None or not image.filepath:
            self.lose(what, "the image has no file: save it first")
            return None
        path = bpy.path.abspath(image.filepath)
        try:
            path = os.path.relpath(path, self.folder)
        except ValueError:
            pass # another drive
        made = self.edit.add("image", _name(os.path.splitext(os.path.basename(path))[0], self.taken), kind)
        made.value("file", path.replace(os.sep, "/"), "filename")
        if image.colorspace_settings.name == "sRGB" and kind == "color3":
            made.child("file").set("colorspace", "srgb_texture")
        if node.extension != "REPEAT":
            for axis in ("uaddressmode", "vaddressmode"):
                made.value(axis, "clamp" if node.extension == "EXTEND" else "constant", "string")
        if node.inputs["Vector"].is_linked:
            self.lose(what, "the texture coordinates come from nodes; the first ones are used")
        return made

    def source(self, socket: bpy.types.NodeSocket) -> mxgen.Draft | None:
        """The node of a linked socket; None: it was lost."""
        link = socket.links[0]
        node, kind = link.from_node, TYPES[socket.type]
        if node.type == "NORMAL_MAP" and node.inputs["Color"].is_linked:
            picture = node.inputs["Color"].links[0].from_node
            image = self.image(picture, "vector3", socket.name) if picture.type == "TEX_IMAGE" else None
            if image is None:
                return None
            made = self.edit.add("normalmap", _name(f"{self.material.name}_{socket.name}", self.taken), "vector3")
            made.connect("in", image)
            return made.value("scale", float(node.inputs["Strength"].default_value), "float")
        if node.type == "TEX_IMAGE" and link.from_socket.name == "Color":
            return self.image(node, kind, socket.name)
        self.lose(socket.name, f"the node '{node.name}' is not converted: only images and normal maps are")
        return None

    # ---- The shader ----

    def value(self, shader: mxgen.Draft, node: bpy.types.Node, socket: bpy.types.NodeSocket, name: str) -> None:
        kind, scale = TYPES[socket.type], self.model.scales.get(socket.name, 1)
        if socket.is_linked:
            source = self.source(socket)
            if source is not None:
                shader.connect(name, source)
                if scale != 1:
                    self.lose(socket.name, f"the texture is not scaled: 1 in Blender is {scale:g} in the document")
                return
        if kind == "float":
            shader.value(name, scale * float(socket.default_value), kind)
        elif kind == "color3":
            shader.value(name, [float(x) for x in socket.default_value[:3]], kind)

    def convert(self) -> None:
        node = self.find_shader()
        if node is None:
            return
        name = _name(self.material.name, self.taken)
        shader = self.edit.add(EXPORTED, _name(f"SR_{self.material.name}", self.taken), "surfaceshader")
        sockets, plain = node.inputs, lambda socket: float(sockets[socket].default_value)
        for socket, input_name in self.model.sockets.items():
            self.value(shader, node, sockets[socket], input_name)
        for socket in ("Specular", "Sheen Tint", "Specular Tint", "Anisotropic Rotation", "Transmission Roughness", "Subsurface IOR", "Subsurface Anisotropy"):
            needed = NEEDS.get(socket)
            if sockets[socket].is_linked:
                self.lose(socket, "a texture is not converted here; its value counts")
            elif socket not in ("Specular", "Subsurface IOR") and plain(socket) != 0 and (needed is None or plain(needed) != 0 or sockets[needed].is_linked):
                if socket != "Sheen Tint":
                    self.lose(socket, f"OpenPBR has no such input; the value was {plain(socket):g}")
        radius = [float(x) for x in sockets["Subsurface Radius"].default_value]
        greatest = max(*radius, 1e-6)
        shader.value(self.model.radius[0], greatest, "float").value(self.model.radius[1], [x / greatest for x in radius], "color3")
        # The clearcoat of the Principled BSDF takes no light from the layers below.
        shader.value("coat_ior", 1.5, "float").value("coat_darkening", 0.0, "float")
        self.specular(shader, sockets)
        self.tints(shader, sockets)
        self.edit.add("surfacematerial", name, "material").connect("surfaceshader", shader)

    def specular(self, shader: mxgen.Draft, sockets: bpy.types.NodeInputs) -> None:
        """The index of refraction for the reflectance of "Specular". The weight stays 1, because OpenPBR's scales metals, too."""
        specular, ior = float(sockets["Specular"].default_value), float(sockets["IOR"].default_value)
        transmission = sockets["Transmission"]
        if not transmission.is_linked and transmission.default_value == 0:
            shader.value(self.model.specular[1], ior_of(specular), "float")
        elif transmission.is_linked or transmission.default_value < 1:
            if abs(specular_of(1, ior) - specular) > 1e-3:
                self.lose("Specular", f"with transmission the index of refraction counts; the value was {specular:g}")

    def tints(self, shader: mxgen.Draft, sockets: bpy.types.NodeInputs) -> None:
        """The Principled BSDF takes the colours of transmitted light and of sheen from the base colour."""
        base = [float(x) for x in sockets["Base Color"].default_value[:3]]
        if sockets["Transmission"].is_linked or sockets["Transmission"].default_value > 0:
            if sockets["Base Color"].is_linked:
                self.lose("Transmission", "the colour of transmitted light does not follow the texture of the base colour")
            else:
                shader.value("transmission_color", base, "color3")
        tint = float(sockets["Sheen Tint"].default_value)
        luminance = max(0.2126 * base[0] + 0.7152 * base[1] + 0.0722 * base[2], 1e-6)
        shader.value("fuzz_color", [1 - tint + tint * x / luminance for x in base] if max(base) > 0 else [1.0, 1.0, 1.0], "color3")


def export_file(path: str, materials: Iterable[bpy.types.Material]) -> list[Loss]:
    """Writes a document with the materials. Raises mxgen.DocumentError or OSError; then the file is as before."""
    edit, losses, taken = mxgen.Context().edit(name=path), [], set()
    for material in materials:
        exporter = _Exporter(edit, material, os.path.dirname(os.path.abspath(path)), taken)
        exporter.convert()
        losses += exporter.losses
    text = edit.end().xml()
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return losses
