#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the stage of the story in docs/slots.md, a radio receiver, as receiver.usda and receiver.gltf: the same primitives at the same
paths, with the same camera. Argument: the folder."""
import base64
import json
import math
import pathlib
import struct
import sys

SEGMENTS = 24
AXES = {"X": (1, 2, 0), "Y": (2, 0, 1), "Z": (0, 1, 2)}  # two axes around, and the axis itself

# The tree: a group is (translation, children), a part is (kind, sizes, translation). Lengths in centimetres; z points to the front.
KNOB = {"ring": ("CylinderZ", (1.5, 0.4), (0, 0, 0.2)), "cap": ("CylinderZ", (1.1, 1.6), (0, 0, 1.0)), "mark": ("Box", (0.2, 0.9, 0.1), (0, 0.5, 1.82))}
SOCKET = {"socket": ("CylinderZ", (0.9, 0.8), (0, 0, 0.4)), "pin": ("CylinderZ", (0.3, 1.5), (0, 0, 0.75))}
PARTS = {"receiver": ((0, 0, 0), {
    "case": ((0, 0, 0), {
        "shell": ("Box", (36, 22, 14), (0, 0, -7.5)),
        "front_panel": ("Box", (35, 21, 1), (0, 0, 0)),
        "handle": ((0, 13.5, -7.5), {"grip": ("CapsuleX", (0.9, 20), (0, 0, 0)), "left": ("CylinderY", (0.6, 3), (-10, -1.2, 0)),
                                     "right": ("CylinderY", (0.6, 3), (10, -1.2, 0))}),
        "feet": ((0, -11.6, -7.5), {f"foot_{i + 1}": ("CylinderY", (1.4, 1.2), (x, 0, z)) for i, (x, z) in
                                    enumerate([(-15, 5), (15, 5), (-15, -5), (15, -5)])}),
        "screws": ((0, 0, 0.6), {f"screw_{i + 1}": ("CylinderZ", (0.45, 0.3), (x, y, 0)) for i, (x, y) in
                                 enumerate([(-16.5, 9.5), (16.5, 9.5), (-16.5, -9.5), (16.5, -9.5)])})}),
    "speaker": ((-9, -1, 0.5), {
        "cloth": ("CylinderZ", (6, 0.3), (0, 0, 0.15)), "ring": ("Ring", (6, 7, 0.9), (0, 0, 0)),
        "bars": ((0, 0, 0.6), {f"bar_{i + 1}": ("CapsuleX", (0.25, 2 * math.sqrt(36 - y * y) - 0.6), (0, y, 0)) for i, y in enumerate([-4, -2, 0, 2, 4])})}),
    "dial": ((7, 5.5, 0.5), {"plate": ("Box", (16, 5, 0.2), (0, 0, 0.1)), "needle": ("Box", (0.15, 4.4, 0.1), (2.5, 0, 0.35)),
                             "window": ("Box", (16, 5, 0.15), (0, 0, 0.7)), "frame": ("Frame", (8, 2.5, 0.8, 0.9), (0, 0, 0))}),
    "knobs": ((7, -1.2, 0.5), {"tuning": ((0, 0, 0), KNOB), "volume": ((-5.5, 0, 0), KNOB), "tone": ((5.5, 0, 0), KNOB)}),
    "keys": ((3, -7.5, 0.5), {f"key_{i + 1}": ("Box", (1.5, 1, 1.1), (1.8 * (i - 2), 0, 0.55)) for i in range(5)}),
    "sockets": ((11, -7.5, 0.5), {"audio": ((0, 0, 0), SOCKET), "line": ((2.5, 0, 0), SOCKET),
                                  "power": ((5, 0, 0), {"socket": SOCKET["socket"]})}),
    "aerial": ((15, 11, -12), {"base": ("CylinderY", (1, 1.6), (0, 0.8, 0)), "rod_1": ("CylinderY", (0.45, 7), (0, 5, 0)),
                               "rod_2": ("CylinderY", (0.3, 6), (0, 11.5, 0)), "tip": ("Sphere", (0.6,), (0, 15, 0))})})}
EYE, TARGET, FOCAL, APERTURE = (38, 19, 48), (1, 4.5, -7), 40, (38, 28.5)


# ---- Meshes: points, and faces as lists of points ----

def box(x, y, z):
    points = [((i & 1 or -1) * x / 2, (i & 2 or -2) * y / 4, (i & 4 or -4) * z / 8) for i in range(8)]
    return points, [[4, 5, 7, 6], [1, 0, 2, 3], [5, 1, 3, 7], [0, 4, 6, 2], [6, 7, 3, 2], [0, 1, 5, 4]]


def band(inner, outer, depth):
    """What lies between two outlines in the plane z = 0, with a thickness."""
    count = len(inner)
    points = [(x, y, z) for z in (depth, 0) for outline in (inner, outer) for x, y in outline]
    faces = []
    for i in range(count):
        k = (i + 1) % count
        a, b, c, d = (ring * count for ring in range(4))  # inner and outer in front, inner and outer behind
        faces += [[a + i, b + i, b + k, a + k], [b + i, d + i, d + k, b + k], [a + k, c + k, c + i, a + i]]
    return points, faces


def ring(inner, outer, depth):
    turn = [2 * math.pi * i / 48 for i in range(48)]
    return band(*([(r * math.cos(t), r * math.sin(t)) for t in turn] for r in (inner, outer)), depth)


def frame(x, y, border, depth):
    corners = [(1, 1), (-1, 1), (-1, -1), (1, -1)]
    return band([(x * i, y * k) for i, k in corners], [((x + border) * i, (y + border) * k) for i, k in corners], depth)


MESHES = {"Box": box, "Ring": ring, "Frame": frame}


# ---- USD ----

def numbers(values):
    return "(" + ", ".join(f"{value:.6g}" for value in values) + ")"


def shape(kind, sizes):
    """The lines of a shape's properties."""
    if kind in MESHES:
        points, faces = MESHES[kind](*sizes)
        return [f"point3f[] points = [{', '.join(map(numbers, points))}]", f"int[] faceVertexCounts = {[len(face) for face in faces]}",
                f"int[] faceVertexIndices = {sum(faces, [])}", 'uniform token subdivisionScheme = "none"']
    lines = [f"double radius = {sizes[0]:.6g}"]
    return lines if kind == "Sphere" else lines + [f"double height = {sizes[1]:.6g}", f'uniform token axis = "{kind[-1]}"']


def write_usda(out):
    def prim(name, node, depth):
        indent = "    " * depth
        is_group, at = isinstance(node[1], dict), node[0] if isinstance(node[1], dict) else node[2]
        type_name = "Xform" if is_group else "Mesh" if node[0] in MESHES else node[0].rstrip("XYZ")
        lines = [] if is_group else shape(*node[:2])
        if any(at):
            lines += [f"double3 xformOp:translate = {numbers(at)}", 'uniform token[] xformOpOrder = ["xformOp:translate"]']
        out.write(f'{indent}def {type_name} "{name}"\n{indent}{{\n' + "".join(f"{indent}    {line}\n" for line in lines))
        for child, below in node[1].items() if is_group else ():
            prim(child, below, depth + 1)
        out.write(f"{indent}}}\n")

    out.write('#usda 1.0\n(\n    defaultPrim = "receiver"\n    doc = "The stage of docs/slots.md. receiver.py writes this file."\n'
              '    metersPerUnit = 0.01\n    upAxis = "Y"\n)\n\n')
    for name, node in PARTS.items():
        prim(name, node, 0)
    rows = ", ".join(numbers(row + (0,)) for row in camera_axes()) + ", " + numbers(EYE + (1,))
    out.write(f'\ndef Camera "camera"\n{{\n    float focalLength = {FOCAL}\n    float horizontalAperture = {APERTURE[0]}\n'
              f'    float verticalAperture = {APERTURE[1]}\n    matrix4d xformOp:transform = ({rows})\n'
              '    uniform token[] xformOpOrder = ["xformOp:transform"]\n}\n')


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return tuple(x / length for x in v)


def cross(a, b):
    return tuple(a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3] for i in range(3))


def camera_axes():
    """x, y and z of the camera, which looks along -z."""
    z = unit(tuple(e - t for e, t in zip(EYE, TARGET)))
    x = unit(cross((0, 1, 0), z))
    return x, cross(z, x), z


# ---- glTF: triangles with normals ----

def flat(points, faces):
    """Faces with a normal each."""
    vertices, triangles = [], []
    for face in faces:
        a, b, c = (points[i] for i in face[:3])
        normal = unit(cross([q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]))
        first = len(vertices)
        vertices += [(*points[i], *normal) for i in face]
        triangles += [(first, first + i, first + i + 1) for i in range(1, len(face) - 1)]
    return vertices, triangles


def turned(outline, axis):
    """An outline of (radius, height, normal outwards, normal along the axis), turned around an axis."""
    u, v, w = AXES[axis]
    vertices, triangles = [], []
    for radius, height, out, along in outline:
        for i in range(SEGMENTS + 1):
            angle, vertex = 2 * math.pi * i / SEGMENTS, [0.0] * 6
            for begin, size, rise in (0, radius, height), (3, out, along):
                vertex[begin + u], vertex[begin + v], vertex[begin + w] = size * math.cos(angle), size * math.sin(angle), rise
            vertices.append(tuple(vertex))
    for row in range(len(outline) - 1):
        for i in range(SEGMENTS):
            a, b = row * (SEGMENTS + 1) + i, (row + 1) * (SEGMENTS + 1) + i
            triangles += [(a, a + 1, b + 1), (a, b + 1, b)]
    return vertices, triangles


def round_outline(radius, height):
    """A sphere whose halves lie apart."""
    outline = []
    for half in -1, 1:
        for i in range(7):
            angle = math.pi / 12 * (i - 6 if half < 0 else i)
            out, along = math.cos(angle), math.sin(angle)
            outline.append((radius * out, radius * along + half * height / 2, out, along))
    return outline


def triangles_of(kind, sizes):
    if kind in MESHES:
        return flat(*MESHES[kind](*sizes))
    if kind == "Sphere":
        return turned(round_outline(sizes[0], 0), "Y")
    radius, height = sizes
    if kind.startswith("Capsule"):
        return turned(round_outline(radius, height), kind[-1])
    return turned([(0, -height / 2, 0, -1), (radius, -height / 2, 0, -1), (radius, -height / 2, 1, 0), (radius, height / 2, 1, 0),
                   (radius, height / 2, 0, 1), (0, height / 2, 0, 1)], kind[-1])


class Gltf:
    """A file with one buffer; parts of equal shape share a mesh. Lengths are metres."""

    def __init__(self):
        self.data, self.meshes = b"", {}
        self.file = {"asset": {"version": "2.0", "generator": "receiver.py"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [],
                     "accessors": [], "bufferViews": [], "cameras": []}

    def accessor(self, rows, code, kind, component, **more):
        self.data += b"\0" * (-len(self.data) % 4)
        data = b"".join(struct.pack(f"<{len(row)}{code}", *row) for row in rows)
        self.file["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)})
        self.data += data
        count = len(rows) * (len(rows[0]) if kind == "SCALAR" else 1)
        self.file["accessors"].append({"bufferView": len(self.file["bufferViews"]) - 1, "componentType": component, "count": count, "type": kind, **more})
        return len(self.file["accessors"]) - 1

    def mesh(self, kind, sizes):
        if (kind, sizes) not in self.meshes:
            vertices, triangles = triangles_of(kind, sizes)
            points = [tuple(x / 100 for x in vertex[:3]) for vertex in vertices]
            bounds = {"min": [min(axis) for axis in zip(*points)], "max": [max(axis) for axis in zip(*points)]}
            attributes = {"POSITION": self.accessor(points, "f", "VEC3", 5126, **bounds),
                          "NORMAL": self.accessor([vertex[3:] for vertex in vertices], "f", "VEC3", 5126)}
            self.meshes[kind, sizes] = len(self.file["meshes"])
            self.file["meshes"].append({"primitives": [{"attributes": attributes, "indices": self.accessor(triangles, "H", "SCALAR", 5123)}]})
        return self.meshes[kind, sizes]

    def node(self, name, node):
        is_group = isinstance(node[1], dict)
        item = {"name": name, "translation": [x / 100 for x in (node[0] if is_group else node[2])]}
        number = len(self.file["nodes"])
        self.file["nodes"].append(item)
        if is_group:
            item["children"] = [self.node(child, below) for child, below in node[1].items()]
        else:
            item["mesh"] = self.mesh(*node[:2])
        return number

    def write(self, out):
        roots = self.file["scenes"][0]["nodes"]
        roots += [self.node(name, node) for name, node in PARTS.items()]
        width, height = (size / 2 / FOCAL for size in APERTURE)
        self.file["cameras"].append({"type": "perspective", "perspective": {"yfov": 2 * math.atan(height), "aspectRatio": width / height, "znear": 0.01}})
        matrix = [value for row in camera_axes() for value in row + (0,)] + [value / 100 for value in EYE] + [1]
        self.file["nodes"].append({"name": "camera", "camera": 0, "matrix": matrix})
        roots.append(len(self.file["nodes"]) - 1)
        self.file["buffers"] = [{"byteLength": len(self.data), "uri": "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()}]
        rows = ",\n".join(f'"{key}": ' + json.dumps(value, separators=(",", ":")) for key, value in self.file.items())
        out.write("{\n" + rows + "\n}\n")


folder = pathlib.Path(sys.argv[1])
with open(folder / "receiver.usda", "w", encoding="utf-8") as file:
    write_usda(file)
with open(folder / "receiver.gltf", "w", encoding="utf-8") as file:
    Gltf().write(file)
