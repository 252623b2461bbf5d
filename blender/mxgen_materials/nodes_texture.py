# SPDX-License-Identifier: Apache-2.0
"""Textures of Blender: images and patterns. Blender's noise is Perlin's with the hash of OSL, as MaterialX's is, so it has the same values;
cells of other hashes lie elsewhere, which is told."""
from __future__ import annotations

import math
import os
import struct

import bpy

from .nodes_geometry import generated, texture_coordinates, texture_set
from .patterns import Lost, Patterns, Reading, converts
from .values import Value


def _coordinates(node: Reading) -> Value:
    return node["Vector"] if node.is_linked("Vector") else generated(node.graph)


# ---- Images ----


@converts("ShaderNodeTexImage")
def convert_image(node: Reading, output: str) -> Value:
    g, settings = node.graph, node.node
    image = settings.image
    if image is None or not image.filepath:
        raise Lost("the image has no file: save it first")
    if settings.projection != "FLAT":
        raise Lost(f"the projection {settings.projection} has no counterpart")
    path = bpy.path.abspath(image.filepath)
    try:
        path = os.path.relpath(path, g.folder)
    except ValueError:
        pass # another drive
    is_alpha = output == "Alpha"
    before, g.base = g.base, os.path.splitext(os.path.basename(path))[0]
    made = g.draft("image", "color4" if is_alpha else "color3")
    g.base = before
    g.made.append(made)
    made.value("file", path.replace(os.sep, "/"), "filename")
    if image.colorspace_settings.name == "sRGB":
        made.child("file").set("colorspace", "srgb_texture")
    if node.is_linked("Vector"):
        place = node["Vector"].to("vector2")
        made.connect("texcoord", place.node, place.output) if place.node is not None else made.value("texcoord", place.numbers, "vector2")
    elif texture_set(g) != 0: # images read the first one by themselves
        place = texture_coordinates(g).to("vector2")
        made.connect("texcoord", place.node, place.output)
    if settings.extension != "REPEAT":
        for axis in ("uaddressmode", "vaddressmode"):
            made.value(axis, "clamp" if settings.extension == "EXTEND" else "constant", "string")
    if settings.interpolation == "Closest":
        made.value("filtertype", "closest", "string")
    value = Value(g, "color4" if is_alpha else "color3", node=made)
    return value.part(3) if is_alpha else value


# ---- Noise ----


def _hash(*numbers: float) -> float:
    """Cycles' number from 0 to 1 for floats: Jenkins' final mix of their bits (lookup3, 2006)."""
    def rotate(x: int, k: int) -> int:
        return (x << k | x >> (32 - k)) & 0xFFFFFFFF
    words = [struct.unpack("<I", struct.pack("<f", x))[0] for x in numbers] + [0] * (3 - len(numbers))
    a, b, c = ((0xDEADBEEF + (len(numbers) << 2) + 13 + word) & 0xFFFFFFFF for word in words)
    for x, y, turn in (("c", "b", 14), ("a", "c", 11), ("b", "a", 25), ("c", "b", 16), ("a", "c", 4), ("b", "a", 14), ("c", "b", 24)):
        state = {"a": a, "b": b, "c": c}
        state[x] = ((state[x] ^ state[y]) - rotate(state[y], turn)) & 0xFFFFFFFF
        a, b, c = state["a"], state["b"], state["c"]
    return c / 0xFFFFFFFF


def _offset(seed: float) -> list[float]:
    """Where another noise begins that does not look like the first one."""
    return [100 + 100 * _hash(seed, axis) for axis in (0.0, 1.0, 2.0)]


def _signed_noise(g: Patterns, x: Value) -> Value:
    return g.node("noise3d", "float", position=x)


def fractal(g: Patterns, x: Value, detail: float, roughness: float) -> Value:
    """Octaves of noise, each with twice the frequency, from 0 to 1; the last one counts by the fraction of `detail`."""
    detail, roughness = min(max(detail, 0.0), 15.0), min(max(roughness, 0.0), 1.0)

    def sum_of(octaves: int) -> Value:
        most = sum(roughness ** i for i in range(octaves))
        return g.node("fractal3d", "float", position=x, octaves=octaves, lacunarity=2.0, diminish=roughness) * (0.5 / most) + 0.5
    whole = int(detail)
    return g.mix(sum_of(whole + 1), sum_of(whole + 2), detail - whole) if detail != whole else sum_of(whole + 1)


def _position(node: Reading, settings: bpy.types.Node) -> Value:
    dimensions = getattr(settings, "noise_dimensions", getattr(settings, "voronoi_dimensions", "3D"))
    if dimensions != "3D":
        raise Lost(f"the pattern in {dimensions} has no counterpart; that in 3D has")
    return _coordinates(node) * node["Scale"]


@converts("ShaderNodeTexNoise")
def convert_noise(node: Reading, output: str) -> Value:
    g, x = node.graph, _position(node, node.node)
    distortion = node["Distortion"]
    if distortion.number != 0:
        x = x + g.combine("vector3", *(_signed_noise(g, x + _offset(seed)) * distortion for seed in (0.0, 1.0, 2.0)))
    detail, roughness = node.known("Detail"), node.known("Roughness")
    first = fractal(g, x, detail, roughness)
    if output != "Color":
        return first
    return g.combine("color3", first, *(fractal(g, x + _offset(seed), detail, roughness) for seed in (3.0, 4.0)))


@converts("ShaderNodeTexVoronoi")
def convert_voronoi(node: Reading, output: str) -> Value:
    g, settings, x = node.graph, node.node, _position(node, node.node)
    if settings.feature not in ("F1", "F2") or settings.distance != "EUCLIDEAN" or output not in ("Distance", "Color"):
        raise Lost(f"'{output}' of {settings.feature} by the distance {settings.distance} has no counterpart")
    g.lose(settings.name, "the cells lie elsewhere")
    if output == "Color":
        return g.node("worleynoise3d", "vector3", position=x, jitter=node["Randomness"], style=1).to("color3")
    return g.node("worleynoise3d", "vector3", position=x, jitter=node["Randomness"]).part(0 if settings.feature == "F1" else 1)


@converts("ShaderNodeTexWhiteNoise")
def convert_white_noise(node: Reading, output: str) -> Value:
    g = node.graph
    if node.node.noise_dimensions != "3D":
        raise Lost(f"white noise in {node.node.noise_dimensions} has no counterpart; that in 3D has")
    g.lose(node.node.name, "the random numbers are others, one for each unit of space")
    x = _coordinates(node)
    value = g.node("cellnoise3d", "float", position=x)
    if output == "Value":
        return value
    return g.combine("color3", value, *(g.node("cellnoise3d", "float", position=x + _offset(seed)) for seed in (1.0, 2.0)))


# ---- Patterns ----


@converts("ShaderNodeTexChecker")
def convert_checker(node: Reading, output: str) -> Value:
    g = node.graph
    cells = g.floor((_coordinates(node) * node["Scale"] + 1e-6) * 0.999999)
    is_odd = g.modulo(cells.part(0) + cells.part(1) + cells.part(2), 2.0)
    half = g.value("float", 0.5)
    # of Blender's pattern the first colour is that of odd sums
    return g.choose(is_odd, half, 1.0, 0.0) if output == "Fac" else g.choose(is_odd, half, node["Color1"], node["Color2"])


#: gradient: its value at a place
GRADIENTS = {
    "LINEAR": lambda g, p: p.part(0),
    "QUADRATIC": lambda g, p: g.max(p.part(0), 0.0) * g.max(p.part(0), 0.0),
    "EASING": lambda g, p: g.smoothstep(p.part(0)),
    "DIAGONAL": lambda g, p: (p.part(0) + p.part(1)) * 0.5,
    "RADIAL": lambda g, p: g.atan2(p.part(1), p.part(0)) * (0.5 / math.pi) + 0.5,
    "SPHERICAL": lambda g, p: g.max(0.999999 - g.length(p), 0.0),
    "QUADRATIC_SPHERE": lambda g, p: g.max(0.999999 - g.length(p), 0.0) * g.max(0.999999 - g.length(p), 0.0),
}


@converts("ShaderNodeTexGradient")
def convert_gradient(node: Reading, output: str) -> Value:
    g = node.graph
    return g.clamp(GRADIENTS[node.node.gradient_type](g, _coordinates(node)))


def _wave_phase(g: Patterns, settings: bpy.types.Node, p: Value) -> Value:
    if settings.wave_type == "BANDS":
        ways = {"X": (20, 0, 0), "Y": (0, 20, 0), "Z": (0, 0, 20), "DIAGONAL": (10, 10, 10)}
        return g.dot(p, g.value("vector3", ways[settings.bands_direction]))
    flat = {"X": (0, 1, 1), "Y": (1, 0, 1), "Z": (1, 1, 0), "SPHERICAL": (1, 1, 1)}[settings.rings_direction]
    return g.length(p * list(flat)) * 20.0


@converts("ShaderNodeTexWave")
def convert_wave(node: Reading, output: str) -> Value:
    g, settings = node.graph, node.node
    p = (_coordinates(node) * node["Scale"] + 1e-6) * 0.999999
    phase = _wave_phase(g, settings, p) + node["Phase Offset"]
    distortion = node["Distortion"]
    if distortion.number != 0:
        noise = fractal(g, p * node["Detail Scale"], node.known("Detail"), node.known("Detail Roughness"))
        phase = phase + distortion * (noise * 2.0 - 1.0)
    if settings.wave_profile == "SIN":
        value = g.sin(phase - math.pi / 2) * 0.5 + 0.5
    elif settings.wave_profile == "SAW":
        value = g.fract(phase / (2 * math.pi))
    else: # TRI
        turns = phase / (2 * math.pi)
        value = g.abs(turns - g.floor(turns + 0.5)) * 2.0
    return value if output == "Fac" else value.to("color3")
