#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Lights of a stage: a matt floor reflects what the formulas of UsdLux and glTF say. Arguments: mxgen-render, and "shadows" for those of path tracing alone."""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish

sys.path.append(str(pathlib.Path(__file__).resolve().parent))
import exr

RENDER = pathlib.Path(sys.argv[1]).resolve()
FOLDER = tempfile.TemporaryDirectory()
AT = pathlib.Path(FOLDER.name)
ALBEDO = 0.5
(AT / "matt.mtlx").write_text(f"""<materialx version="1.39">
  <oren_nayar_diffuse_bsdf name="b" type="BSDF"><input name="color" type="color3" value="{ALBEDO}, {ALBEDO}, {ALBEDO}"/></oren_nayar_diffuse_bsdf>
  <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="b"/></surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>
  <look name="l"><materialassign material="M" geom="/"/></look>
</materialx>
""")
FLOOR = """#usda 1.0
def Plane "floor" {
  token axis = "Y"
  double width = 2
  double length = 2
}
def Camera "camera" {
  float focalLength = 20.955
  double3 xformOp:translate = (0, 2, 0)
  double xformOp:rotateX = -90
  uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]
}
"""


def light(kind, *inputs, name="light", place=(0, 2, 0), turn=-90, scale=1):
    """A light above the floor, which points down."""
    return "\n".join([f'def {kind} "{name}" {{', *inputs, f"double3 xformOp:translate = {place}", f"double xformOp:rotateX = {turn}",
                      f"double3 xformOp:scale = ({scale}, {scale}, {scale})",
                      'uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX", "xformOp:scale"]', "}\n"])


def draw(stage, *options):
    """The colour in the middle, and the messages."""
    out = AT / "out.exr"
    out.unlink(missing_ok=True)
    run = subprocess.run([RENDER, AT / "matt.mtlx", "--stage", stage, "--look", "l", "-s", "9", "-o", out, *options], capture_output=True, text=True,
                         check=False)
    if run.returncode:
        return None, run.stderr
    width, height, channels = exr.read(out)
    return [channels[channel][height // 2][width // 2] for channel in "RGB"], run.stderr


def write(text):
    path = AT / "stage.usda"
    path.write_text(FLOOR + text)
    return path


def sees(name, text, expected, *options, traced=False, tolerance=0.012):
    expected = expected if isinstance(expected, (list, tuple)) else [expected] * 3
    for more in ((), ("--path-trace", "--paths", "64"))[:1 + traced]:
        color, messages = draw(write(text), *options, *more)
        good = color and all(abs(c - e) <= tolerance * max(e, 0.01) for c, e in zip(color, expected))
        check(good, f"{name} {' '.join(more)}: {color}, expected {expected}\n{messages}")
        check("light-" not in messages, f"{name}: no warning\n{messages}")


def tells(name, text, *expected):
    _, messages = draw(write(text))
    for part in expected:
        check(part in messages, f"{name}: '{part}' is in\n{messages}")


def shadows():
    """Half way to a light at (2, 2, 0) a lid hides what lies below its edge. A path tracer draws the shadow of the whole light."""
    radius, radiance, steps = 0.3, 300, 200
    across, away = (-math.sqrt(0.5), math.sqrt(0.5)), math.sqrt(8)  # in the plane z = 0: from the lid's edge upwards; to the light

    def lid(edge):
        at = [1 + (edge - 1) * c for c in across]
        return f"""def Plane "lid" {{
  token axis = "Y"
  double width = 2
  double length = 2
  double3 xformOp:translate = ({at[0]}, {at[1]}, 0)
  double xformOp:rotateZ = -45
  uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateZ"]
}}
"""

    def reflected(edge, is_disk):
        """The sum over points of the disk that is seen: of the light, or of the cone around a sphere, at a distance of 1."""
        size = radius / away if is_disk else math.tan(math.asin(radius / away))
        total, cell = 0, (2 * size / steps) ** 2
        for i in range(steps):
            for k in range(steps):
                up, aside = ((2 * n + 1) / steps * size - size for n in (i, k))
                if math.hypot(up, aside) <= size and up > edge / (away / 2):
                    length = math.sqrt(1 + up * up + aside * aside)
                    total += math.sqrt(0.5) * (1 + up) / length * cell / length ** 3  # the floor's cosine; the solid angle
        return ALBEDO / math.pi * radiance * total

    size = f"float inputs:radius = {radius}", f"float inputs:intensity = {radiance}"
    sees("half of a sphere", light("SphereLight", *size, place=(2, 2, 0)) + lid(0), reflected(0, False), *TRACED, tolerance=0.03)
    disk = light("DiskLight", *size, place=(2, 2, 0)).replace("double xformOp:rotateX = -90", "double3 xformOp:rotateXYZ = (-90, 0, -45)")
    sees("a fifth of a disk", disk.replace('"xformOp:rotateX"', '"xformOp:rotateXYZ"') + lid(0.075), reflected(0.075, True), *TRACED, tolerance=0.04)


TRACED = "--path-trace", "--paths", "4096", "-s", "3"  # the last size counts
if sys.argv[2:]:
    FLOOR = FLOOR.replace("20.955", "400")  # pixels that are small beside the half shadow
    shadows()
    finish("stage-shadows")

sun = math.pi * math.sin(math.radians(0.265)) ** 2
sees("the sun of the schema", light("DistantLight"), ALBEDO / math.pi * 50000 * sun, traced=True)
sees("a wide sun", light("DistantLight", "float inputs:angle = 220", "float inputs:intensity = 0.2"),
     ALBEDO * 0.2 * (2 - math.sin(math.radians(110)) ** 2))
sees("a sun by its illuminance, inclined", light("DistantLight", "bool inputs:normalize = 1", "float inputs:intensity = 2", turn=-30), ALBEDO / math.pi)
sees("a colour and an exposure", light("DistantLight", "float angle = 0", "float intensity = 1", "float exposure = 1", "color3f color = (1, 0.5, 0.25)"),
     [ALBEDO / math.pi * 2 * c for c in (1, 0.5, 0.25)])
sees("a sphere", light("SphereLight", "float inputs:radius = 0.1", "float inputs:intensity = 300"), ALBEDO * 300 * 0.01 / 4, traced=True)
sees("its size in the world", light("SphereLight", "float inputs:radius = 0.05", "float inputs:intensity = 300", scale=2), ALBEDO * 300 * 0.01 / 4)
sees("a sphere by its power", light("SphereLight", "bool inputs:normalize = 1", "float inputs:intensity = 16"), ALBEDO / math.pi * 16 / 4 / 4)
sees("a point by its power", light("SphereLight", "bool inputs:normalize = 1", "float inputs:intensity = 16", "float inputs:radius = 0",
                                   "bool treatAsPoint = 1"), ALBEDO / math.pi * 16 / 4 / 4)
cone = ("float inputs:radius = 0.1", "float inputs:intensity = 300", "float inputs:shaping:cone:angle = 20")
sees("a cone to the floor", light("SphereLight", *cone, turn=-75), ALBEDO * 300 * 0.01 / 4)
sees("and beside it", light("SphereLight", *cone, turn=-60), 0, traced=True)
sees("a disk", light("DiskLight", "float inputs:radius = 0.2", "float inputs:intensity = 80"), ALBEDO * 80 * 0.04 / 4.04, traced=True)
sees("its back", light("DiskLight", "float inputs:radius = 0.2", "float inputs:intensity = 80", turn=90), 0)
sees("a rectangle", light("RectLight", "float inputs:width = 0.2", "float inputs:height = 0.1", "float inputs:intensity = 400"),
     ALBEDO * 400 * 0.02 / math.pi / (4 + 0.02 / math.pi))
sees("two lights", light("DistantLight", "float inputs:angle = 0", "float inputs:intensity = 2")
     + light("SphereLight", "float inputs:radius = 0.1", "float inputs:intensity = 300", name="b"), ALBEDO / math.pi * 2 + ALBEDO * 300 * 0.01 / 4)
sees("five lights", "".join(light("DistantLight", "float inputs:angle = 0", "float inputs:intensity = 0.5", name=f"l{i}") for i in range(5)),
     ALBEDO / math.pi * 2.5)
sees("no light that is hidden", light("DistantLight") + light("DistantLight", 'token visibility = "invisible"', name="b"), ALBEDO / math.pi * 50000 * sun)
sees("a dome of one colour", light("DomeLight", "float inputs:intensity = 0.5", "color3f inputs:color = (1, 0.5, 0.25)"),
     [ALBEDO * 0.5 * c for c in (1, 0.5, 0.25)], traced=True, tolerance=0.03)

# A black body of 6500 K is nearly white, one of 2000 K is red; the luminance stays.
for kelvin, ratio in (6500, (0.9, 1.15)), (2000, (0.0, 0.1)):
    color, _ = draw(write(light("DistantLight", "float inputs:angle = 0", "float inputs:intensity = 1", "bool inputs:enableColorTemperature = 1",
                                f"float inputs:colorTemperature = {kelvin}")))
    luminance = sum(c * w for c, w in zip(color, (0.2126, 0.7152, 0.0722)))
    check(ratio[0] <= color[2] / color[0] <= ratio[1], f"{kelvin} K: {color}")
    check(abs(luminance / (ALBEDO / math.pi) - 1) < 0.02, f"{kelvin} K: the luminance is {luminance}")

# The map of a dome: OpenEXR's latitude and longitude, the middle at +z, and +x left of it.
(AT / "map.ppm").write_text("P3 4 2 255\n" + " ".join(["255 0 0", "0 255 0", "0 0 255", "255 255 255"]) + "\n" + " ".join(["0 0 0"] * 4) + "\n")


def looks(name, direction, up, dome, expected, y_up="Y"):
    """The environment behind the floor, seen along a direction."""
    z = [-d for d in direction]
    x = [up[1] * z[2] - up[2] * z[1], up[2] * z[0] - up[0] * z[2], up[0] * z[1] - up[1] * z[0]]
    rows = ", ".join("(" + ", ".join(map(str, [*row, 0])) + ")" for row in (x, up, z))
    path = AT / "stage.usda"
    path.write_text(f"""#usda 1.0
( upAxis = "{y_up}" )
def Plane "floor" {{
  double3 xformOp:translate = ({", ".join(str(-3 * d) for d in direction)})
  uniform token[] xformOpOrder = ["xformOp:translate"]
}}
def Camera "camera" {{
  float focalLength = 100
  matrix4d xformOp:transform = ( {rows}, (0, 0, 0, 1) )
  uniform token[] xformOpOrder = ["xformOp:transform"]
}}
{dome}""")
    color, messages = draw(path, "--background", "environment")
    out = AT / "out.ppm"
    subprocess.run([RENDER, AT / "matt.mtlx", "--stage", path, "--look", "l", "-s", "9", "-o", out, "--background", "environment"], capture_output=True,
                   check=False)
    pixels = out.read_bytes().split(b"255\n", 1)[1]
    middle = pixels[3 * 40:3 * 41]
    letters = "".join(c for c, v in zip("rgb", middle) if v > 2 * max(middle) // 3) if max(middle) > 20 else "-"
    check(letters == expected, f"{name}: '{letters}' of {list(middle)}, expected '{expected}' {color}\n{messages}")


dome, turned = ('def {} "dome" {{\n asset inputs:texture:file = @map.ppm@\n {}\n}}\n'.format(kind, rest) for kind, rest in (
    ("DomeLight", ""), ("DomeLight", 'double xformOp:rotateY = 90\n uniform token[] xformOpOrder = ["xformOp:rotateY"]')))
a = math.sqrt(0.5)
# the texels' middles: longitudes 135, 45, -45 and -135 degrees, latitude 45 degrees
high = math.sin(math.radians(40))
flat = math.cos(math.radians(40)) * a
looks("longitude 135", (flat, high, -flat), (-high * a, math.cos(math.radians(40)), high * a), dome, "r")
looks("longitude 45", (flat, high, flat), (-high * a, math.cos(math.radians(40)), -high * a), dome, "g")
looks("longitude -45", (-flat, high, flat), (high * a, math.cos(math.radians(40)), -high * a), dome, "b")
looks("a turned dome", (flat, high, -flat), (-high * a, math.cos(math.radians(40)), high * a), turned, "g")
looks("a dome with the pole of the stage", (flat, flat, high), (-high * a, -high * a, math.cos(math.radians(40))),
      dome.replace("DomeLight", "DomeLight_1"), "r", "Z")
looks("a dome with the pole y", (flat, high, flat), (-high * a, math.cos(math.radians(40)), -high * a), dome, "g", "Z")

# Lights that the picture lacks are told, with their place.
tells("a factor of specular light", light("DistantLight", "float inputs:specular = 0.5"), "'/light.inputs:specular' (", "stage.usda:14:7)", "[light-unread]")
tells("a link", light("DistantLight", "rel collection:lightLink:includes = </floor>"), "'/light.collection:lightLink:includes'", "[light-unread]")
tells("a profile", light("SphereLight", "asset inputs:shaping:ies:file = @a.ies@"), "'/light.inputs:shaping:ies:file'", "[light-unread]")
tells("a texture of a rectangle", light("RectLight", "asset inputs:texture:file = @a.png@"), "'/light.inputs:texture:file'", "[light-unread]")
tells("a cylinder", light("CylinderLight", "float inputs:length = 2"), "'/light' (", "is a light (CylinderLight) that mxgen does not draw [light-left-out]")
tells("a mesh that shines", FLOOR[len("#usda 1.0\n"):].replace("floor", "b").replace("camera", "c").replace("token axis", "float inputs:intensity = 3\n token axis"),
      "'/b' (", "[light-left-out]")
tells("a second dome", light("DomeLight") + light("DomeLight", name="b"), "'/b' (", "is a second dome", "[light-left-out]")
tells("a map of another kind", light("DomeLight", 'token inputs:texture:format = "angular"'), "'/light.inputs:texture:format' (", "[light-left-out]")
tells("a light without a size", light("SphereLight", "float inputs:radius = 0"), "without a size", "[light-left-out]")
tells("a map that is missing", light("DomeLight", "asset inputs:texture:file = @none.hdr@"), "'/light.inputs:texture:file' (", "stage.usda:14:7)", "[bad-geometry]")
color, messages = draw(write(light("DistantLight")), "--lights", "point_light=1")
check("[light-left-out]" in messages, f"--lights of other types\n{messages}")

# A map of the command replaces the lights of the stage.
(AT / "grey.ppm").write_text("P3 1 1 255 188 188 188\n")
color, messages = draw(write(light("DistantLight")), "--environment", AT / "grey.ppm")
check(color and abs(color[0] - ALBEDO * ((188 / 255 + 0.055) / 1.055) ** 2.4) < 0.01, f"a map of the command: {color}\n{messages}")

# glTF: a floor of two triangles, and a light of each type.
floor = {"asset": {"version": "2.0"}, "scene": 0, "extensionsUsed": ["KHR_lights_punctual"],
         "scenes": [{"nodes": [0, 1, 2]}], "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-9, 0, -9], "max": [9, 0, 9]}],
         "bufferViews": [{"buffer": 0, "byteLength": 36}],
         "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAQwQAAAAAAABDBAAAQwQAAAAAAABBBAAAQQQAAAAAAAAAA"}],
         "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
         "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "aspectRatio": 1, "znear": 0.1}}]}
down = [-math.sqrt(0.5), 0, 0, math.sqrt(0.5)]
for kind, more, expected in (("directional", {}, 3), ("point", {}, 3 / 4), ("spot", {"spot": {"innerConeAngle": 0.3, "outerConeAngle": 0.4}}, 3 / 4)):
    floor["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": kind, "intensity": 3, "color": [1, 0.5, 0.25], **more}]}}
    floor["nodes"] = [{"name": "floor", "mesh": 0}, {"name": "eye", "camera": 0, "translation": [0, 4, 0], "rotation": down},
                      {"name": "lamp", "translation": [0, 2, 0], "rotation": down, "extensions": {"KHR_lights_punctual": {"light": 0}}}]
    (AT / "stage.gltf").write_text(json.dumps(floor))
    color, messages = draw(AT / "stage.gltf")
    check(color and all(abs(c - ALBEDO / math.pi * expected * e) < 0.01 for c, e in zip(color, (1, 0.5, 0.25))), f"glTF: {kind}: {color}\n{messages}")
finish("stage-lights")
