# SPDX-License-Identifier: Apache-2.0
"""Nodes of Blender that read the geometry: coordinates, attributes, normals, and what turns and bends them."""
from __future__ import annotations

from collections.abc import Iterator

import bpy
import mathutils

from .patterns import Lost, Patterns, Reading, converts
from .values import Value

# ---- Coordinates ----


def _objects(g: Patterns) -> Iterator[bpy.types.Object]:
    """The objects with the material."""
    return (one for one in bpy.data.objects if g.material.name in getattr(one.data, "materials", ()))


def texture_set(g: Patterns, name: str = "") -> int:
    """The number of a set of texture coordinates of the first mesh that has it; "": the one that is active for drawing."""
    for one in _objects(g):
        sets = getattr(one.data, "uv_layers", ())
        found = next((i for i, layer in enumerate(sets) if (layer.name == name if name else layer.active_render)), None)
        if found is not None:
            return found
    return 0


def texture_coordinates(g: Patterns, name: str = "") -> Value:
    """The coordinates of a set."""
    before, g.base = g.base, "UV"
    made = g.node("texcoord", "vector2", index=texture_set(g, name)).to("vector3")
    g.base = before
    return made


def generated(g: Patterns) -> Value:
    """The place in the box of the object, from 0 to 1: that of the first object with this material."""
    one = next(_objects(g), None)
    if one is None:
        raise Lost("generated coordinates need an object with the material")
    low, high = (tuple(map(pick, zip(*(tuple(corner) for corner in one.bound_box)))) for pick in (min, max))
    # an edge without length counts as 2 units
    middles = [(a + b) / 2 for a, b in zip(low, high)]
    halves = [(b - a) / 2 if b - a > 1e-5 else 1 for a, b in zip(low, high)]
    g.lose("Generated", f"the coordinates are those of the object '{one.name}'")
    return (g.node("position", "vector3", space="object") - [m - h for m, h in zip(middles, halves)]) / [2 * h for h in halves]


@converts("ShaderNodeTexCoord")
def convert_coordinates(node: Reading, output: str) -> Value:
    g = node.graph
    if output == "Object" and node.node.object is None:
        return g.node("position", "vector3", space="object")
    if output == "Reflection":
        return g.node("reflect", "vector3", **{"in": g.node("viewdirection", "vector3", space="world")})
    made = {"UV": lambda: texture_coordinates(g), "Generated": lambda: generated(g), "Normal": lambda: g.node("normal", "vector3", space="object")}.get(output)
    if made is None:
        raise Lost(f"the coordinates '{output}' have no counterpart")
    return made()


@converts("ShaderNodeUVMap")
def convert_uv_map(node: Reading, output: str) -> Value:
    return texture_coordinates(node.graph, node.node.uv_map)


@converts("ShaderNodeAttribute")
def convert_attribute(node: Reading, output: str) -> Value:
    kinds = {"Color": "color3", "Vector": "vector3", "Fac": "float"}
    if node.node.attribute_type != "GEOMETRY" or output not in kinds:
        raise Lost(f"'{output}' of an attribute of type {node.node.attribute_type} has no counterpart")
    return node.graph.node("geompropvalue", kinds[output], geomprop=node.node.attribute_name)


@converts("ShaderNodeVertexColor")
def convert_vertex_color(node: Reading, output: str) -> Value:
    g = node.graph
    color = g.node("geomcolor", "color4", index=0)
    return color.part(3) if output == "Alpha" else color.to("color3")


@converts("ShaderNodeNewGeometry")
def convert_geometry(node: Reading, output: str) -> Value:
    g = node.graph
    if output == "True Normal":
        g.lose(node.node.name, "the true normal is the smooth one")
    made = {"Position": lambda: g.node("position", "vector3", space="world"), "Normal": lambda: g.node("normal", "vector3", space="world"),
            "True Normal": lambda: g.node("normal", "vector3", space="world"), "Tangent": lambda: g.node("tangent", "vector3", space="world"),
            "Incoming": lambda: -g.node("viewdirection", "vector3", space="world")}.get(output)
    if made is None:
        raise Lost(f"'{output}' of the geometry has no counterpart")
    return made()


@converts("ShaderNodeLightPath")
def convert_light_path(node: Reading, output: str) -> Value:
    g = node.graph
    g.lose(node.node.name, "all rays are those of the camera")
    return g.value("float", 1 if output == "Is Camera Ray" else 0)


# ---- Turning ----


def transform(g: Patterns, x: Value, matrix: mathutils.Matrix) -> Value:
    """A constant 3x3 matrix times a vector."""
    rows = [tuple(row) for row in matrix]
    if all(abs(rows[i][j]) < 1e-9 for i in range(3) for j in range(3) if i != j):
        return x * [rows[i][i] for i in range(3)]
    return g.combine("vector3", *(g.dot(x, g.value("vector3", row)) for row in rows))


@converts("ShaderNodeMapping")
def convert_mapping(node: Reading, output: str) -> Value:
    g, x, kind = node.graph, node["Vector"], node.node.vector_type
    turned = g.at(node.socket("Rotation"), node.place)
    if turned.numbers is None:
        g.lose(node.node.name, "the rotation cannot vary; its own value counts")
    angles = turned.numbers or tuple(node.socket("Rotation").default_value)
    turn = mathutils.Euler(angles, "XYZ").to_matrix()
    move = node["Location"] if kind in ("POINT", "TEXTURE") else g.value("vector3", 0)
    if kind == "TEXTURE":
        return transform(g, x - move, turn.transposed()) / node["Scale"]
    if kind == "NORMAL":
        return g.normalize(transform(g, x / node["Scale"], turn))
    return transform(g, x * node["Scale"], turn) + move


@converts("ShaderNodeVectorRotate")
def convert_vector_rotate(node: Reading, output: str) -> Value:
    g, kind, center = node.graph, node.node.rotation_type, node["Center"]
    if kind == "EULER_XYZ":
        angles = node["Rotation"].numbers
        turn = mathutils.Euler(angles, "XYZ").to_matrix() if angles else None
    else:
        axis = {"X_AXIS": (1, 0, 0), "Y_AXIS": (0, 1, 0), "Z_AXIS": (0, 0, 1)}.get(kind) or node["Axis"].numbers
        angle = node["Angle"].number
        turn = mathutils.Matrix.Rotation(angle, 3, axis) if axis and angle is not None else None
    if turn is None:
        raise Lost("a rotation that varies has no counterpart")
    return transform(g, node["Vector"] - center, turn.transposed() if node.node.invert else turn) + center


# ---- Normals ----


@converts("ShaderNodeNormalMap")
def convert_normal_map(node: Reading, output: str) -> Value:
    g = node.graph
    if node.node.space != "TANGENT":
        raise Lost(f"a normal map in the space {node.node.space} has no counterpart")
    color = node["Color"].to("vector3")
    return g.node("normalmap", "vector3", **{"in": color, "scale": node["Strength"]})


@converts("ShaderNodeBump")
def convert_bump(node: Reading, output: str) -> Value:
    g = node.graph
    if not node.is_linked("Height"):
        return node["Normal"] if node.is_linked("Normal") else g.node("normal", "vector3", space="world")
    g.lose(node.node.name, "bumps lean by the change of the height in texture coordinates, not on the surface")
    scale = node["Strength"] * node["Distance"] * (-1.0 if node.node.invert else 1.0)
    inputs = {"height": node["Height"], "scale": scale}
    if node.is_linked("Normal"):
        inputs["normal"] = node["Normal"]
    return g.node("bump", "vector3", **inputs)


# ---- Angles to the eye ----


def _cosine(node: Reading) -> Value:
    """The cosine to the eye, on both sides of the surface."""
    g = node.graph
    inputs = {"normal": node["Normal"]} if node.is_linked("Normal") else {}
    return g.node("facingratio", "float", faceforward=True, **inputs)


def _fresnel(g: Patterns, cosine: Value, ior: Value) -> Value:
    """The reflectance of a dielectric for light without polarisation (Born and Wolf, Principles of Optics, 1.5.2)."""
    squared = ior * ior - 1.0 + cosine * cosine
    root = g.sqrt(g.max(squared, 0.0))
    across = (root - cosine) / (root + cosine)
    along = (cosine * (root + cosine) - 1.0) / (cosine * (root - cosine) + 1.0)
    return g.choose(squared, g.value("float", 0), across * across * (along * along + 1.0) * 0.5, 1.0)


@converts("ShaderNodeFresnel")
def convert_fresnel(node: Reading, output: str) -> Value:
    g = node.graph
    return _fresnel(g, _cosine(node), g.max(node["IOR"], 1e-5))


@converts("ShaderNodeLayerWeight")
def convert_layer_weight(node: Reading, output: str) -> Value:
    g, blend = node.graph, node["Blend"]
    if output == "Fresnel":
        return _fresnel(g, _cosine(node), 1.0 / g.max(1.0 - blend, 1e-5))
    blend = g.clamp(blend, 0.0, 1 - 1e-5)
    half = g.value("float", 0.5)
    return 1.0 - g.power(_cosine(node), g.choose(half, blend, blend * 2.0, 0.5 / (1.0 - blend)))

