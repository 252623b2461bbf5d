# SPDX-License-Identifier: Apache-2.0
"""Which input of a MaterialX shading model is which socket of Blender's Principled BSDF (before version 4.0), as data. The sockets have the
meaning of Blender's manual; formulas are in docs/blender.md."""
from __future__ import annotations

from typing import NamedTuple

SHADER = "Principled BSDF"


class Model(NamedTuple):
    """A shading model: its inputs by the sockets that they are; the inputs of values that several sockets share; and factors."""

    #: socket: input; the value is the same
    sockets: dict[str, str]
    #: socket: input that the value is multiplied by
    factors: dict[str, str]
    #: socket: value of the input at which the lobe reflects as much as that of the socket at 1
    scales: dict[str, float]
    #: weight and index of refraction of the dielectric: together the socket "Specular"
    specular: tuple[str, str] | None
    #: scale and colour of the radius below the surface; the socket is their product
    radius: tuple[str, str] | None
    #: inputs with another form of a socket's value: socket: input with a colour whose mean counts
    means: dict[str, str]
    #: beginnings of names of inputs that have no effect if a weight is 0: beginning: weight
    weights: dict[str, str]
    #: what the Principled BSDF has without a socket: input: its value, or the input that it equals
    implied: dict[str, float | str]


STANDARD_SURFACE = Model(
    sockets={
        "Base Color": "base_color", "Metallic": "metalness", "Roughness": "specular_roughness", "IOR": "specular_IOR",
        "Anisotropic": "specular_anisotropy", "Anisotropic Rotation": "specular_rotation", "Transmission": "transmission",
        "Transmission Roughness": "transmission_extra_roughness", "Subsurface": "subsurface", "Subsurface Color": "subsurface_color",
        "Sheen": "sheen", "Clearcoat": "coat", "Clearcoat Roughness": "coat_roughness", "Emission": "emission_color",
        "Emission Strength": "emission", "Normal": "normal", "Clearcoat Normal": "coat_normal", "Tangent": "tangent",
    },
    factors={"Base Color": "base"}, scales={"Clearcoat": 0.25, "Sheen": 0.06}, specular=("specular", "specular_IOR"), radius=("subsurface_scale", "subsurface_radius"),
    means={"Alpha": "opacity"},
    weights={"transmission_": "transmission", "sheen_": "sheen", "coat_": "coat", "subsurface_": "subsurface"},
    implied={"coat_IOR": 1.5, "transmission_color": "base_color"})

OPEN_PBR = Model(
    sockets={
        "Base Color": "base_color", "Metallic": "base_metalness", "Roughness": "specular_roughness", "IOR": "specular_ior",
        "Anisotropic": "specular_roughness_anisotropy", "Transmission": "transmission_weight", "Subsurface": "subsurface_weight",
        "Subsurface Color": "subsurface_color", "Sheen": "fuzz_weight", "Clearcoat": "coat_weight", "Clearcoat Roughness": "coat_roughness",
        "Emission": "emission_color", "Emission Strength": "emission_luminance", "Alpha": "geometry_opacity", "Normal": "geometry_normal",
        "Clearcoat Normal": "geometry_coat_normal", "Tangent": "geometry_tangent",
    },
    factors={"Base Color": "base_weight"}, scales={"Clearcoat": 0.25, "Sheen": 0.1}, specular=("specular_weight", "specular_ior"),
    radius=("subsurface_radius", "subsurface_radius_scale"), means={},
    weights={"transmission_": "transmission_weight", "fuzz_": "fuzz_weight", "coat_": "coat_weight", "subsurface_": "subsurface_weight",
             "thin_film_": "thin_film_weight"},
    implied={"coat_ior": 1.5, "coat_darkening": 0.0, "transmission_color": "base_color"})

GLTF_PBR = Model(
    sockets={
        "Base Color": "base_color", "Metallic": "metallic", "Roughness": "roughness", "IOR": "ior", "Transmission": "transmission",
        "Clearcoat": "clearcoat", "Clearcoat Roughness": "clearcoat_roughness", "Emission": "emissive", "Emission Strength": "emissive_strength",
        "Alpha": "alpha", "Normal": "normal", "Clearcoat Normal": "clearcoat_normal",
    },
    factors={}, scales={"Clearcoat": 0.25}, specular=("specular", "ior"), radius=None, means={},
    weights={"sheen_": "sheen_color", "iridescence_": "iridescence"}, implied={})

PREVIEW_SURFACE = Model(
    sockets={
        "Base Color": "diffuseColor", "Metallic": "metallic", "Roughness": "roughness", "IOR": "ior", "Clearcoat": "clearcoat",
        "Clearcoat Roughness": "clearcoatRoughness", "Emission": "emissiveColor", "Alpha": "opacity", "Normal": "normal",
    },
    factors={}, scales={"Clearcoat": 0.25}, specular=None, radius=None, means={}, weights={}, implied={})

MODELS = {"standard_surface": STANDARD_SURFACE, "open_pbr_surface": OPEN_PBR, "gltf_pbr": GLTF_PBR, "UsdPreviewSurface": PREVIEW_SURFACE}

#: The model of documents that the exporter writes.
EXPORTED = "open_pbr_surface"


def frontal(ior: float) -> float:
    """The reflectance of a dielectric at normal incidence."""
    return ((ior - 1) / (ior + 1)) ** 2


def specular_of(weight: float, ior: float) -> float:
    """The socket "Specular": 1 is a reflectance of 8 % at normal incidence."""
    return weight * frontal(ior) / 0.08


def ior_of(specular: float) -> float:
    """The index of refraction of a dielectric with the reflectance of the socket "Specular"."""
    root = (specular * 0.08) ** 0.5
    return (1 + root) / (1 - root)
