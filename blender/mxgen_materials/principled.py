# SPDX-License-Identifier: Apache-2.0
"""The Principled BSDF as OpenPBR (docs/blender.md)."""
from __future__ import annotations

import mxgen

from .mapping import EXPORTED, MODELS, specular_of
from .patterns import Reading
from .values import Value

#: sockets that OpenPBR has no input for: the one that they need above 0
WITHOUT_INPUT = {"Specular Tint": None, "Anisotropic Rotation": "Anisotropic", "Transmission Roughness": "Transmission",
                 "Subsurface Anisotropy": "Subsurface"}


class _Principled:
    """A Principled BSDF, and the inputs that it has."""

    def __init__(self, node: Reading) -> None:
        self.node, self.graph, self.model = node, node.graph, MODELS[EXPORTED]
        self.inputs: dict[str, Value | float] = {}

    def is_off(self, socket: str) -> bool:
        """True where the socket is 0 everywhere."""
        return self.node[socket].number == 0

    def copy(self) -> None:
        """The sockets that are inputs of the same meaning."""
        for socket, name in self.model.sockets.items():
            value = self.node[socket]
            if value.kind == "vector3" and not self.node.is_linked(socket):
                continue # a normal or a tangent of the geometry
            self.inputs[name] = value * self.model.scales.get(socket, 1)
        for socket, needed in WITHOUT_INPUT.items():
            value = self.node[socket]
            if self.node.socket(socket).enabled and value.number != 0 and (needed is None or not self.is_off(needed)):
                shown = "a texture" if value.number is None else f"the value {value.number:g}"
                self.graph.lose(socket, f"OpenPBR has no such input; it was {shown}")

    def radius(self) -> None:
        radius = self.node["Subsurface Radius"]
        scale, color = self.model.radius
        if radius.numbers is None:
            self.inputs[scale], self.inputs[color] = 1.0, radius.to("color3")
            return
        greatest = max(*radius.numbers, 1e-6)
        self.inputs[scale] = greatest
        self.inputs[color] = self.graph.value("color3", [x / greatest for x in radius.numbers])

    def specular(self) -> None:
        """The index of refraction for the reflectance of "Specular". The weight stays 1, because OpenPBR's scales metals, too."""
        g, specular, transmission = self.graph, self.node["Specular"], self.node["Transmission"]
        if transmission.number == 0:
            root = g.sqrt(g.max(specular * 0.08, 0.0))
            self.inputs[self.model.specular[1]] = (1.0 + root) / (1.0 - root)
        elif transmission.number is None or transmission.number < 1:
            ior = self.node["IOR"].number
            if specular.number is None or ior is None or abs(specular_of(1, ior) - specular.number) > 1e-3:
                g.lose("Specular", "with transmission the index of refraction counts")

    def tints(self) -> None:
        """The Principled BSDF takes the colours of transmitted light and of sheen from the base colour."""
        g, base, tint = self.graph, self.node["Base Color"], self.node["Sheen Tint"]
        if not self.is_off("Transmission"):
            self.inputs["transmission_color"] = base
        if self.is_off("Sheen") or tint.number == 0:
            return
        luminance = base.to("float")
        tinted = g.choose(luminance, g.value("float", 0), base / g.max(luminance, 1e-6), g.value("color3", 1))
        self.inputs["fuzz_color"] = g.mix(g.value("color3", 1), tinted, tint)


def principled(node: Reading) -> mxgen.Draft:
    """The surface shader."""
    made = _Principled(node)
    made.copy()
    made.radius()
    made.specular()
    made.tints()
    # The clearcoat of the Principled BSDF takes no light from the layers below.
    made.inputs.update(coat_ior=1.5, coat_darkening=0.0)
    return node.graph.draft(EXPORTED, "surfaceshader", **made.inputs)
