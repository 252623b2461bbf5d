#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Meshes of glTF as its specification has them, on stages and as one mesh: types of accessors, skins, morph targets, instances,
extensions, lights and cameras. Arguments: mxgen, mxgen-render."""
import math
import pathlib
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish

sys.path.append(str(pathlib.Path(__file__).resolve().parent))
import exr
from gltf_file import CORNERS, File, INDICES, UV

MXGEN, RENDER = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
FOLDER = tempfile.TemporaryDirectory()
AT = pathlib.Path(FOLDER.name)
(AT / "look.mtlx").write_text("""<materialx version="1.39">
  <texcoord name="t" type="vector2"/>
  <geomcolor name="c" type="color4"/>
  <extract name="u" type="float"><input name="in" type="vector2" nodename="t"/></extract>
  <extract name="v" type="float"><input name="in" type="vector2" nodename="t"/><input name="index" type="integer" value="1"/></extract>
  <extract name="a" type="float"><input name="in" type="color4" nodename="c"/><input name="index" type="integer" value="3"/></extract>
  <combine3 name="all" type="color3">
    <input name="in1" type="float" nodename="u"/><input name="in2" type="float" nodename="v"/><input name="in3" type="float" nodename="a"/>
  </combine3>
  <surface_unlit name="s" type="surfaceshader"><input name="emission_color" type="color3" nodename="all"/></surface_unlit>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>
  <oren_nayar_diffuse_bsdf name="b" type="BSDF"><input name="color" type="color3" value="1, 1, 1"/></oren_nayar_diffuse_bsdf>
  <surface name="d" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="b"/></surface>
  <surfacematerial name="matt" type="material"><input name="surfaceshader" type="surfaceshader" nodename="d"/></surfacematerial>
  <look name="seen"><materialassign name="a" material="M" geom="/"/></look>
  <look name="lit"><materialassign name="a" material="matt" geom="/"/></look>
</materialx>
""")


def run(program, *arguments, code=0):
    """The messages; checks the exit code."""
    done = subprocess.run([program, *arguments], cwd=AT, capture_output=True, text=True, check=False)
    check(done.returncode == code, f"{' '.join(map(str, arguments))}: {done.returncode} instead of {code}\n{done.stderr}")
    return done.stdout + done.stderr


def draw(*arguments, size=96):
    """The channels of a picture, and the messages."""
    out = AT / "out.exr"
    out.unlink(missing_ok=True)
    messages = run(RENDER, "look.mtlx", *arguments, "-s", str(size), "-o", out)
    return (exr.read(out)[2] if out.exists() else None), messages


# ---- A wall of quads, of which each has its numbers in another way ----

WIDTH, STEP = 5, 3  # quads in a row, and their distance
CELLS = []  # name, (u, v) of a place on the quad, alpha
ALPHA = {"f": (1, 0.5), "B": (255, 128), "H": (65535, 32768)}
file = File(extensionsUsed=["EXT_mesh_gpu_instancing", "KHR_mesh_quantization"], extensionsRequired=["EXT_mesh_gpu_instancing", "KHR_mesh_quantization"],
            skins=[], animations=[{"channels": [], "samplers": []}])


def place():
    number = len(CELLS)
    return [STEP * (number % WIDTH), -STEP * (number // WIDTH), 0]


def usual(x, y):
    return (x + 1) / 2, (y + 1) / 2


def cell(name, primitive, uv=usual, alpha=0, **members):
    """A node with a quad at the next place. `uv` gives the texture coordinates at (x, y), from -1 to 1."""
    targets = members.pop("mesh_members", {})
    file.node(name=name, mesh=file.mesh(primitive, **targets), **({"translation": place()} | members))
    CELLS.append((name, uv, alpha))


def whole(kind, rows):
    scale = ALPHA[kind][0]
    return [tuple(x if kind == "f" else round(x * scale) for x in row) for row in rows]


for kind, stride in (("f", 0), ("B", 4), ("H", 0)):
    cell(f"coordinates {kind}", file.primitive(TEXCOORD_0=file.accessor(whole(kind, UV), kind, kind != "f", stride)))
for kind, stride in (("f", 0), ("B", 4), ("H", 8)):
    rgb = whole(kind, [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)])
    cell(f"rgb {kind}", file.primitive(COLOR_0=file.accessor(rgb, kind, kind != "f", stride)), alpha=1)
    rgba = [color + (ALPHA[kind][1],) for color in rgb]
    cell(f"rgba {kind}", file.primitive(COLOR_0=file.accessor(rgba, kind, kind != "f")), alpha=ALPHA[kind][1] / ALPHA[kind][0])
cell("a stride", file.primitive(TEXCOORD_0=file.accessor(UV, stride=20)))
cell("a strip", file.primitive([0, 1, 3, 2]) | {"mode": 5})
cell("a fan", file.primitive([0, 1, 2, 3]) | {"mode": 6})
cell("indices of bytes", file.primitive(kind="B"))
cell("indices of words", file.primitive(kind="I"))
cell("no indices", file.primitive(None, POSITION=file.accessor([CORNERS[i] for i in INDICES]), NORMAL=file.accessor([(0, 0, 1)] * 6),
                                  TEXCOORD_0=file.accessor([UV[i] for i in INDICES])))
replaced = file.accessor([(0.5, 0.5)] * 4)
file.sparse(replaced, [0, 1, 2, 3], UV)
cell("sparse elements", file.primitive(TEXCOORD_0=replaced))
file.root["accessors"].append({"componentType": 5126, "count": 4, "type": "VEC2"})
file.sparse(len(file.root["accessors"]) - 1, [1, 2], [(1, 0), (1, 0)])
cell("sparse elements over nothing", file.primitive(TEXCOORD_0=len(file.root["accessors"]) - 1), uv=lambda x, y: ((x + 1) / 2, 1))
cell("short positions", file.primitive(POSITION=file.accessor([tuple(100 * x for x in corner) for corner in CORNERS], "h", stride=8),
                                       NORMAL=file.accessor([(0, 0, 127)] * 4, "b", True, stride=4)), scale=[0.01] * 3)
cell("normalized positions", file.primitive(POSITION=file.accessor([tuple(127 * x for x in corner) for corner in CORNERS], "b", True, stride=4)))
cell("no texture coordinates", file.primitive(TEXCOORD_0=None), uv=None)


def morphed(**members):
    """A quad that lies to the left by 1, and whose target is 1 to the right."""
    moved = file.primitive(POSITION=file.accessor([(x - 1, y, z) for x, y, z in CORNERS]))
    return moved | {"targets": [{"POSITION": file.accessor([(5, 0, 0)] * 4)}, {"POSITION": file.accessor([(1, 0, 0)] * 4)}]} | members


cell("weights of a mesh", morphed(), mesh_members={"weights": [0, 1]})
cell("weights of a node", morphed(), mesh_members={"weights": [1, 1]}, weights=[0, 1])
coordinates = file.primitive(TEXCOORD_0=file.accessor([(0, 0)] * 4)) | {"targets": [{"TEXCOORD_0": file.accessor(UV)}]}
cell("texture coordinates of a target", coordinates, mesh_members={"weights": [1]})


def skinned(weights, joints=(0, 1, 0, 0)):
    return file.primitive(JOINTS_0=file.accessor([joints] * 4, "B"), WEIGHTS_0=file.accessor([weights] * 4))


def turned(x, y):
    return usual(-x, -y)


# a joint that is no root turns the quad by half a turn; the place of the skinned node does not count
arm = file.node(is_root=False, rotation=[0, 0, 1, 0])
file.node(translation=place(), children=[arm])
file.root["skins"].append({"joints": [arm]})
cell("a skin", skinned((1, 0, 0, 0), (0, 0, 0, 0)), uv=turned, skin=0, translation=[100, 0, 0])
shifted = file.node(translation=place())
far = file.node(translation=[100, 100, 100])
file.root["skins"].append({"joints": [far, shifted], "inverseBindMatrices": file.accessor(
    [(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1), (0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)])})
cell("inverse matrices of a skin", skinned((0, 1, 0, 0)), uv=lambda x, y: usual(y, -x), skin=1)
left, right = (file.node(translation=[place()[0] + x, place()[1], 0]) for x in (-3, 1))
file.root["skins"].append({"joints": [left, right]})
cell("weights of joints", skinned((0.25, 0.75, 0, 0)), skin=2)
at = place()
CELLS.append(("an instance", usual, 0))
other = place()
cell("another instance", file.primitive(), translation=[0, 0, 0],
     extensions={"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": file.accessor([at, other]), "SCALE": file.accessor([(1, 1, 1), (1, 1, 1)])}}})

ROWS = (len(CELLS) - 1) // WIDTH + 1
MIDDLE = (STEP * (WIDTH - 1) / 2, -STEP * (ROWS - 1) / 2)
HEIGHT = STEP * max(WIDTH, ROWS) / 2 + 1
file.root["cameras"] = [{"type": "perspective", "perspective": {"aspectRatio": 1, "yfov": 2 * math.atan(HEIGHT / 100), "znear": 1}}]
file.node(name="eye", camera=0, translation=[*MIDDLE, 100])
file.write(AT / "wall.gltf")


def look_at(channels, half, size=96):
    """Compares each quad with what it has at some places; `half` is the half of the picture's width."""
    for number, (name, uv, alpha) in enumerate(CELLS):
        for x, y in (-0.5, -0.6), (0.6, -0.3), (0.2, 0.5):
            at_x, at_y = STEP * (number % WIDTH) + x - MIDDLE[0], -STEP * (number // WIDTH) + y - MIDDLE[1]
            column, row = int((at_x / half + 1) / 2 * size), int((1 - at_y / half) / 2 * size)
            found = [channels[c][row][column] for c in "RGB"]
            # the middle of the texel lies elsewhere
            x += ((column + 0.5) / size * 2 - 1) * half - at_x
            y += (1 - (row + 0.5) / size * 2) * half - at_y
            expected = [*uv(x, y), alpha] if uv else [*found[:2], alpha]
            check(all(abs(f - e) < 0.01 for f, e in zip(found, expected)), f"{name} at ({x:.2f}, {y:.2f}): {found}, expected {expected}")


picture, told = draw("--stage", "wall.gltf", "--look", "seen")
if picture:
    look_at(picture, HEIGHT)
check("'wall.gltf' has animations, which mxgen does not play" in told, f"animations are told:\n{told}")
listed = run(RENDER, "--stage", "wall.gltf", "--list").split("\n")
check("/coordinates_B" in listed and "/another_instance" in listed and "/eye" in listed, f"paths: {listed}")

# the same as one mesh, in the unit sphere: the studio's camera fits it into its angle of 30 degrees
corners = [(x, y) for n in range(len(CELLS)) for x in (n % WIDTH * STEP - 1, n % WIDTH * STEP + 1) for y in (-(n // WIDTH) * STEP - 1, -(n // WIDTH) * STEP + 1)]
radius = max(math.hypot(x - MIDDLE[0], y - MIDDLE[1]) for x, y in corners)
picture, told = draw("-m", "wall.gltf", "-e", "M", "--camera", "0,0")
if picture:
    look_at(picture, radius * 1.04 / math.cos(math.radians(15)))
check("note: parts of the mesh 'wall.gltf' have no texture coordinates; they were made" in told and "no normals" not in told, f"notes:\n{told}")

# ---- Parts of one mesh: each has what it lacks by itself ----

(AT / "mixed.obj").write_text("""o A
v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
vn 0 0 1
f 1/1/1 2/2/1 3/3/1 4/4/1
o B
v -1 -1 -1
v 1 -1 -1
v 1 1 -1
v -1 1 -1
f 5//1 6//1 7//1
""")
picture, told = draw("-m", "mixed.obj", "-e", "M", "--camera", "0,0", size=32)
if picture:
    # the quad is in front of the middle of the sphere, whose radius is 1.5
    near, distance = 0.5 / 1.5, 1.04 / math.sin(math.radians(15))
    half = 1.5 * (distance - near) * math.tan(math.radians(15))
    for column, row in (12, 12), (20, 14), (18, 20):
        expected = [(((column + 0.5) / 16 - 1) * half + 1) / 2, ((1 - (row + 0.5) / 16) * half + 1) / 2]
        found = [picture[c][row][column] for c in "RG"]
        check(all(abs(f - e) < 0.01 for f, e in zip(found, expected)), f"texture coordinates of a file stay beside those that are made: {found}, expected {expected}")
check("note: parts of the mesh 'mixed.obj' have no texture coordinates; they were made" in told, f"the note about parts:\n{told}")

# a stage of USD is such a mesh, too: its z is upwards
(AT / "up.usda").write_text("""#usda 1.0
( upAxis = "Z" )
def Xform "x" {
  double3 xformOp:scale = (-4, 4, 4)
  uniform token[] xformOpOrder = ["xformOp:scale"]
  def Mesh "quad" {
    point3f[] points = [(-1, 0, -1), (1, 0, -1), (1, 0, 1), (-1, 0, 1)]
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [3, 2, 1, 0]
    texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "vertex")
  }
}
""")
picture, told = draw("-m", "up.usda", "-e", "M", "--camera", "0,0", size=32)
half = math.sqrt(2) * 1.04 / math.cos(math.radians(15))
for column, row in (12, 12), (20, 14), (18, 20):
    expected = [(1 - ((column + 0.5) / 16 - 1) * half) / 2, ((1 - (row + 0.5) / 16) * half + 1) / 2]
    found = [picture[c][row][column] for c in "RG"] if picture else [2, 2]
    check(all(abs(f - e) < 0.01 for f, e in zip(found, expected)), f"a mesh of USD: {found}, expected {expected}")

# ---- Names that nodes share ----

lamp = {"KHR_lights_punctual": {"lights": [{"type": "point", "color": [1, 0, 0], "intensity": 10}, {"type": "point", "color": [0, 1, 0], "intensity": 10}]}}
file = File(extensions=lamp, extensionsUsed=["KHR_lights_punctual"],
            cameras=[{"type": "perspective", "perspective": {"yfov": 0.01, "znear": 0.1}}, {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 9}}])
file.node(name="floor", mesh=file.mesh(file.primitive(), {"attributes": {"POSITION": 0}, "mode": 0}, {"attributes": {"POSITION": 0}, "mode": 3}))
for index in range(2):
    file.node(name="lamp", translation=[0, 0, 2], extensions={"KHR_lights_punctual": {"light": index}})
for x in (-0.5, 0.5):
    file.node(name="eye", camera=0, translation=[x, -0.25, 4])
file.node(name="flat", camera=1)
file.write(AT / "same.gltf")
picture, told = draw("--stage", "same.gltf", "--look", "lit", "--camera", "0,0", size=9)
middle = [picture[c][4][4] for c in "RGB"] if picture else None
check(middle and all(abs(m - e) < 0.01 for m, e in zip(middle, (10 / 4 / math.pi, 10 / 4 / math.pi, 0))), f"two lamps of one name: {middle}")
check("'/floor/meshes_0__1' and 1 more have points or lines, which mxgen does not draw [not-drawn]" in told, f"points and lines are told:\n{told}")
check("'/flat' is an orthographic camera, which mxgen does not draw [not-drawn]" in told, f"a camera is told:\n{told}")
for camera, u in ("/eye", 0.25), ("/eye_2", 0.75):
    picture, _ = draw("--stage", "same.gltf", "--look", "seen", "--camera", camera, size=9)
    middle = [picture[c][4][4] for c in "RG"] if picture else None
    check(middle and abs(middle[0] - u) < 0.01 and abs(middle[1] - 0.375) < 0.01, f"{camera} sees {middle}, expected {u}, 0.375")

# ---- Extensions ----

file = File(materials=[{"name": "M"}], extensionsUsed=["EXT_foo"])
file.node(mesh=file.mesh(file.primitive()))
file.write(AT / "may.gltf")
file.root["extensionsRequired"] = ["KHR_lights_punctual", "EXT_foo"]
file.write(AT / "must.gltf")
run(RENDER, "--stage", "may.gltf", "--list")
run(MXGEN, "import", "may.gltf", "-o", "may.mtlx")
for arguments in (RENDER, "--stage", "must.gltf", "--list"), (RENDER, "look.mtlx", "-e", "M", "-m", "must.gltf", "-o", "no.exr"), (MXGEN, "import", "must.gltf", "-o", "no.mtlx"):
    told = run(*arguments, code=1)
    check("'must.gltf': it requires the extension 'EXT_foo' (extensionsRequired[1]), which mxgen does not read" in told, f"{arguments[1:]}:\n{told}")
check(not list(AT.glob("no.*")), "nothing is written")

# ---- Faults, with their places ----


def fails(name, change, expected):
    """A file with this change is an error."""
    made = File(skins=[{"joints": [0]}])
    made.node(mesh=made.mesh(made.primitive()))
    change(made.root)
    made.write(AT / "bad.gltf")
    told = run(RENDER, "--stage", "bad.gltf", "--list", code=1)
    check(expected in told and "[bad-mesh]" in told, f"{name}: no '{expected}' in\n{told}")


def accessor(number, **members):
    return lambda root: root["accessors"][number].update(members)


def attributes(**members):
    return lambda root: root["meshes"][0]["primitives"][0]["attributes"].update(members)


def node(**members):
    return lambda root: root["nodes"][0].update(members)


fails("too many elements", accessor(0, count=5), "accessors[0] has 5 elements, which end behind bufferViews[0]")
for number in (1e30, -1, 1.5, 4.0, "4", None, [4], True):
    fails(f"an offset of {number} bytes", lambda root: root["bufferViews"][1].update(byteOffset=number), "bufferViews[1].byteOffset is no whole number from 0")
for member in ("byteLength", "byteStride"):
    fails(f"no number as {member}", lambda root: root["bufferViews"][1].update({member: 1e30}), f"bufferViews[1].{member} is no whole number from 0")
fails("an offset of elements below 0", accessor(2, byteOffset=-1), "accessors[2].byteOffset is no whole number from 0")
for part in ("indices", "values"):
    fails(f"an offset of sparse {part} below 0", accessor(2, sparse={part: {"byteOffset": -1}}), f"accessors[2].sparse.{part}.byteOffset is no whole number from 0")
fails("a buffer of half a byte", lambda root: root.update(buffers=[{"byteLength": 0.5}]), "buffers[0].byteLength is no whole number from 0")
fails("a scene below 0", lambda root: root.update(scene=-1), '"scene" is no whole number from 0')
fails("a version to come", lambda root: root["asset"].update(minVersion="2.1"), "it needs the version 2.1 of glTF; mxgen reads 2.0")
fails("elements beyond all numbers", accessor(0, count=2**62), "accessors[0] has 4611686018427387904 elements, which end behind bufferViews[0]")
fails("a begin beyond all numbers", accessor(0, byteOffset=2**63 - 8), "which end behind bufferViews[0]")
fails("other counts", accessor(1, count=3), "accessors[1] has 3 elements; its primitive has 4 vertices")
fails("another type", accessor(0, type="VEC2"), "accessors[0].type is 'VEC2'; expected VEC3")
fails("another type of numbers", accessor(0, componentType=5130), "accessors[0].componentType is 5130")
fails("indices with a sign", accessor(3, componentType=5122), "accessors[3] has no unsigned integers as indices")
fails("an index of no vertex", accessor(3, byteOffset=0, componentType=5125, count=3), "is the index")
fails("no such accessor", attributes(POSITION=77), "there are no accessors[77]; the file has 4")
fails("a view beyond its buffer", lambda root: root["bufferViews"][0].update(byteLength=10**6), "bufferViews[0] ends behind the")
fails("a short stride", lambda root: root["bufferViews"][0].update(byteStride=4), "bufferViews[0].byteStride is 4; an element of accessors[0] has 12 bytes")
fails("a skin without joints", node(skin=0), "a node has a skin, and a primitive of its mesh has no JOINTS_0 and WEIGHTS_0")
fails("joints of fewer vertices", lambda root: (root["accessors"].append({"bufferView": 0, "componentType": 5126, "count": 1, "type": "VEC4"}),
                                              attributes(JOINTS_0=4, WEIGHTS_0=4)(root), root["nodes"][0].update(skin=0)),
      "accessors[4] has 1 elements; its primitive has 4 vertices")
fails("no such skin", node(skin=5), "there are no skins[5] with joints")
fails("a joint that is missing", lambda root: (root["nodes"][0].update(skin=0), root["skins"][0].update(joints=[9])), "joint 0 of a skin is no node of the scene")
fails("no such mesh", node(mesh=4), "nodes[0] has the mesh 4, which is missing")
fails("a node below itself", node(children=[0]), "nodes[0] stands below two nodes, or below itself")
fails("a short matrix", node(matrix=[1, 2, 3]), "a 'matrix' has 3 numbers; expected 16")
fails("a lens without an angle", lambda root: (root["nodes"][0].update(camera=0), root.update(cameras=[{"type": "perspective", "perspective": {}}])),
      "cameras[0].perspective has the yfov 0")
finish("gltf-stage")
