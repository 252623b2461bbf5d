#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes stages that an attacker might send. Arguments: their folder, and one outside of it."""
import base64
import json
import os
import struct
import sys

FOLDER, SECRET = sys.argv[1:3]
NAN = float("nan")


def floats(*numbers):
    return struct.pack(f"<{len(numbers)}f", *numbers)


TRIANGLE = floats(-1, -1, 0, 1, -1, 0, 0, 1, 0)
INDICES = struct.pack("<3H", 0, 1, 2)


def gltf(name, nodes=None, uri=None, size=None, position=TRIANGLE, **attributes):
    """A triangle with more attributes, (type, bytes) each, in nodes that refer to mesh 0."""
    data, views, accessors = b"", [], []
    parts = [("VEC3", 5126, position), ("SCALAR", 5123, INDICES)]
    parts += [(kind, 5126, numbers) for kind, numbers in attributes.values()]
    for kind, component, numbers in parts:
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(numbers)})
        accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": 3, "type": kind})
        data += numbers + bytes(-len(numbers) % 4)
    accessors[0] |= {"min": [-1, -1, 0], "max": [1, 1, 0]}
    if uri:
        path = os.path.join(FOLDER, uri)
        if os.path.isdir(os.path.dirname(path)) and not os.path.lexists(path) and "missing" not in uri and "fifo" not in uri:
            with open(path, "wb") as out:
                out.write(data.ljust(size or 0, b"\0"))
    uri = uri or "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    names = {name: number + 2 for number, name in enumerate(attributes)}
    document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": nodes or [{"mesh": 0}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0, **names}, "indices": 1}]}],
                "buffers": [{"uri": uri, "byteLength": max(len(data), size or 0)}], "bufferViews": views, "accessors": accessors}
    write(name, json.dumps(document))


def write(name, text):
    with open(os.path.join(FOLDER, name), "w", encoding="utf-8") as out:
        out.write(text)


gltf("whole.gltf")
gltf("nan_position.gltf", position=floats(*[NAN] * 9))
gltf("nan_normal.gltf", TEXCOORD_0=("VEC2", floats(0, 0, 1, 0, 0, 1)), NORMAL=("VEC3", floats(NAN, NAN, NAN, 0, 0, 1, 0, 0, 1)))
gltf("nan_uv.gltf", TEXCOORD_0=("VEC2", floats(0, 0, NAN, 0, 0, 1)))
gltf("nan_uv_1.gltf", TEXCOORD_0=("VEC2", floats(0, 0, 1, 0, 0, 1)), TEXCOORD_1=("VEC2", floats(0, 0, float("inf"), 0, 0, 1)))
gltf("nan_color.gltf", COLOR_0=("VEC4", floats(*[NAN] * 12)))
for name, count in (("deep", 2000), ("deeper", 60000)):
    gltf(f"{name}.gltf", [{"children": [i + 1]} for i in range(count)] + [{"mesh": 0}])
gltf("expo.gltf", [{"children": [i + 1, i + 1]} for i in range(40)] + [{"mesh": 0}])
gltf("fifo.gltf", uri="fifo.bin")
gltf("outside.gltf", uri=os.path.join(SECRET, "there.bin"))
gltf("missing.gltf", uri=os.path.join(SECRET, "missing.bin"))
os.symlink(os.path.join("..", SECRET, "there.bin"), os.path.join(FOLDER, "inside", "link.bin"))
gltf("link.gltf", uri="inside/link.bin")
gltf("large.gltf", uri="large.bin", size=2 << 20)
ZEROS = {"componentType": 5126, "count": 1 << 20, "type": "VEC3"}


def bare(name, **members):
    """A file of nodes that share mesh 0, which has the given primitives over accessor 0: zeros without bytes."""
    write(name, json.dumps({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "accessors": [ZEROS],
                            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}]} | members))


bare("zeros.gltf", accessors=[ZEROS | {"count": 1 << 28}])
bare("reuse.gltf", meshes=[{"primitives": [{"attributes": {"POSITION": 0}}] * 2000}])
bare("weights.gltf", meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "targets": [{"POSITION": 0}]}]}], nodes=[{"mesh": 0, "weights": [1]}] * 2000,
     scenes=[{"nodes": list(range(2000))}])
bare("targets.gltf", meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "targets": [{"POSITION": 0}] * 5000}], "weights": [1] * 5000}])
bare("names.gltf", nodes=[{"name": "n" * 1000, "children": [i + 1]} for i in range(900)] + [{"children": list(range(901, 10000))}] + [{}] * 9099)
bare("instances.gltf", nodes=[{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}}}])
bare("buffers.gltf", buffers=[{"byteLength": 1, "uri": "large.bin"}] * 5000)
bare("joints.gltf", nodes=[{"mesh": 0, "skin": 0}], skins=[{"joints": [0] * 10, "inverseBindMatrices": 0}])
write("deep.json.gltf", '{"asset":' + "[" * 200000 + "]" * 200000 + "}")
write("deep.dae", '<COLLADA version="1.4.1"><library_visual_scenes><visual_scene id="s">' + "<node>" * 50000 + "</node>" * 50000
      + '</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>')
write("outside.obj", f"mtllib {SECRET}/x.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
with open(os.path.join(FOLDER, "slow.obj"), "w", encoding="utf-8") as slow:
    for i in range(150000):
        slow.write(f"v {i} {i % 7} {i % 11}\nv {i} 1 0\nv {i} 0 1\nf -1 -2 -3\n")

MESH = """def Mesh "m" {
 point3f[] points = [(-1,-1,0),(1,-1,0),(0,1,0)]
 int[] faceVertexCounts = [3]
 int[] faceVertexIndices = [0,1,2]
%s}
"""


def usda(name, text):
    write(name, "#usda 1.0\n" + text)


def instancer(name, prototype, count):
    return (f'def PointInstancer "{name}" {{\n rel prototypes = <{prototype}>\n int[] protoIndices = [{", ".join(["0"] * count)}]\n'
            f' point3f[] positions = [{", ".join(["(0,0,0)"] * count)}]\n}}\n')


usda("dome.usda", MESH % "" + f'def DomeLight "d" {{ asset inputs:texture:file = @{SECRET}/there.bin@ }}\n')
usda("dome_missing.usda", MESH % "" + f'def DomeLight "d" {{ asset inputs:texture:file = @{SECRET}/missing.hdr@ }}\n')
usda("instances.usda", instancer("i", "/s", 20000) + 'def Sphere "s" {}\n')
usda("visits.usda", "".join(instancer(f"i{i}", f"/i{i + 1}", 400) for i in range(5)) + 'def Xform "i5" {}\n')
usda("ops.usda", MESH % (" double3 xformOp:translate = (0, 0, 0)\n uniform token[] xformOpOrder = ["
                         + ", ".join(['"xformOp:translate"'] * 5000) + "]\n"))
usda("rotate.usda", MESH % ' float xformOp:rotateXYZ = 30\n uniform token[] xformOpOrder = ["xformOp:rotateXYZ"]\n')
usda("index.usda", MESH % ' texCoord2f[] primvars:st = [(0,0),(1,1)] (interpolation = "vertex")\n int[] primvars:st:indices = [0,1,1e30]\n')
