# SPDX-License-Identifier: Apache-2.0
"""Node trees of Blender as graphs: each node lights a square, which Cycles and `mxgen render` draw; their pictures are compared pixel by
pixel. Arguments after "--": the root of the project, the program, an empty folder."""
import pathlib
import subprocess
import sys

import bpy

ROOT, PROGRAM, WORK = (pathlib.Path(word) for word in sys.argv[sys.argv.index("--") + 1:])
sys.path += [str(ROOT / "tests"), str(ROOT / "tests/blender"), str(ROOT / "blender")]
from checks import check, finish

from mxgen_materials.exporting import export_file

SIZE = 32

#: the square, and a camera that sees all of it
STAGE = """#usda 1.0
( upAxis = "Z" )
def Mesh "square" (prepend apiSchemas = ["MaterialBindingAPI"]) {
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
    normal3f[] normals = [(0, 0, 1), (0, 0, 1), (0, 0, 1), (0, 0, 1)]
    texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "vertex")
}
def Camera "eye" {
    float focalLength = 30
    float horizontalAperture = 20
    float verticalAperture = 20
    double3 xformOp:translate = (0, 0, 3)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""
LOOK = '<look name="all"><materialassign name="a" material="Light" geom="/square"/></look>'


def build_scene():
    scene = bpy.context.scene
    for one in list(scene.objects):
        bpy.data.objects.remove(one)
    bpy.ops.mesh.primitive_plane_add(size=2)
    square = bpy.context.object
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location, camera.data.lens, camera.data.sensor_width = (0, 0, 3), 30, 20
    scene.collection.objects.link(camera)
    scene.camera, scene.world = camera, None
    render = scene.render
    render.engine, render.resolution_x, render.resolution_y = "CYCLES", SIZE, SIZE
    render.image_settings.file_format, render.filepath = "OPEN_EXR", str(WORK / "cycles.exr")
    scene.cycles.device, scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.filter_width = "CPU", 4, False, 0.01
    return square


def pixels_of(path):
    image = bpy.data.images.load(str(path))
    pixels = image.pixels[:]
    bpy.data.images.remove(image)
    return pixels


def farthest(one, other):
    """The mean of the differences of colours, and the share of pixels that differ by more than 0.05: at edges they do."""
    differences = [max(abs(one[4 * p + c] - other[4 * p + c]) for c in range(3)) for p in range(SIZE * SIZE)]
    return sum(differences) / len(differences), sum(difference > 0.05 for difference in differences) / len(differences)


class Tree:
    """A material whose surface is light."""

    def __init__(self, square):
        self.material = bpy.data.materials.new("Light")
        self.material.use_nodes = True
        square.data.materials.clear()
        square.data.materials.append(self.material)
        self.nodes, self.links = self.material.node_tree.nodes, self.material.node_tree.links
        self.nodes.clear()
        self.output, self.light = self.nodes.new("ShaderNodeOutputMaterial"), self.nodes.new("ShaderNodeEmission")
        self.links.new(self.light.outputs[0], self.output.inputs["Surface"])

    def add(self, name, inputs=None, **settings):
        node = self.nodes.new(name)
        for key, value in settings.items():
            setattr(node, key, value)
        for key, value in (inputs or {}).items():
            socket = node.inputs[key] if isinstance(key, int) else next(one for one in node.inputs if one.name == key and one.enabled)
            if isinstance(value, bpy.types.NodeSocket):
                self.links.new(value, socket)
            else:
                socket.default_value = value
        return node

    def show(self, socket):
        self.links.new(socket, self.light.inputs["Color"])


def compare(name, tree, losses=(), mean=0.004, edges=0.03):
    document = WORK / "light.mtlx"
    lost = [loss.what for loss in export_file(str(document), [tree.material])]
    check(sorted(lost) == sorted(losses), f"{name}: lost {lost}, expected {list(losses)}")
    text = document.read_text(encoding="utf-8")
    document.write_text(text.replace("</materialx>", LOOK + "</materialx>"), encoding="utf-8")
    run = subprocess.run([PROGRAM, "render", document, "--stage", WORK / "stage.usda", "--camera", "/eye", "-s", str(SIZE), "-q", "-o", WORK / "mxgen.exr"],
                         capture_output=True, text=True, check=False)
    if run.returncode:
        check(False, f"{name}: {run.stderr}\n{text}")
        return
    bpy.ops.render.render(write_still=True)
    by_mean, by_edges = farthest(pixels_of(WORK / "cycles.exr"), pixels_of(WORK / "mxgen.exr"))
    print(f"{name:32} {by_mean:.5f} {by_edges:.4f}")
    check(by_mean < mean and by_edges <= edges, f"{name}: the pictures differ by {by_mean:.5f}, at {by_edges:.4f} of the pixels by more than 0.05\n{text}")


def main():
    (WORK / "stage.usda").write_text(STAGE, encoding="utf-8")
    square = build_scene()

    def tree():
        for old in list(bpy.data.materials):
            bpy.data.materials.remove(old)
        return Tree(square)
    for cases in (math_cases, vector_cases, range_cases, mix_cases, ramp_cases, color_cases, geometry_cases, texture_cases, image_cases, tree_cases):
        cases(tree)
    finish("blender-graphs")


def axes(t):
    """The coordinates of the square from -1 to 1, apart."""
    place = t.add("ShaderNodeTexCoord").outputs["Object"]
    parts = t.add("ShaderNodeSeparateXYZ", {0: place})
    return place, parts.outputs["X"], parts.outputs["Y"]


def math_cases(tree):
    operations = [one.identifier for one in bpy.types.ShaderNodeMath.bl_rna.properties["operation"].enum_items]
    for operation in operations:
        t = tree()
        _, x, y = axes(t)
        node = t.add("ShaderNodeMath", {0: x, 1: y, 2: 0.3}, operation=operation)
        # -1 to 1 becomes 0 to 1, so that light shows signs
        t.show(t.add("ShaderNodeMath", {0: node.outputs[0], 1: 0.1, 2: 0.5}, operation="MULTIPLY_ADD", use_clamp=True).outputs[0])
        compare(f"Math {operation}", t, edges=0.05)


def vector_cases(tree):
    operations = [one.identifier for one in bpy.types.ShaderNodeVectorMath.bl_rna.properties["operation"].enum_items]
    for operation in operations:
        t = tree()
        place, x, y = axes(t)
        other = t.add("ShaderNodeCombineXYZ", {"X": y, "Y": 0.4, "Z": x})
        node = t.add("ShaderNodeVectorMath", {0: place, 1: other.outputs[0]}, operation=operation)
        if node.inputs[2].enabled:
            node.inputs[2].default_value = (0.2, -0.5, 0.7)
        if node.inputs[3].enabled:
            node.inputs[3].default_value = 0.6
        output = next(one for one in node.outputs if one.enabled)
        half = t.add("ShaderNodeVectorMath", {0: output, 1: (0.2, 0.2, 0.2), 2: (0.5, 0.5, 0.5)}, operation="MULTIPLY_ADD")
        above = t.add("ShaderNodeVectorMath", {0: half.outputs[0], 1: (0, 0, 0)}, operation="MAXIMUM")
        t.show(t.add("ShaderNodeVectorMath", {0: above.outputs[0], 1: (1, 1, 1)}, operation="MINIMUM").outputs[0])
        if operation == "REFRACT":
            compare(f"Vector Math {operation}", t, ["Vector Math"], mean=1, edges=1)
        else:
            compare(f"Vector Math {operation}", t, mean=0.02, edges=0.08)


def range_cases(tree):
    for way in "LINEAR", "STEPPED", "SMOOTHSTEP", "SMOOTHERSTEP":
        for clamps in (True, False):
            t = tree()
            node = t.add("ShaderNodeMapRange", {"Value": axes(t)[1], "From Min": -0.5, "From Max": 0.7, "To Min": 0.9, "To Max": 0.1}, interpolation_type=way, clamp=clamps)
            t.show(node.outputs[0])
            compare(f"Map Range {way} {clamps}", t, edges=0.16, mean=0.015)
    for kind in "MINMAX", "RANGE":
        t = tree()
        t.show(t.add("ShaderNodeClamp", {0: axes(t)[1], 1: 0.6, 2: 0.2}, clamp_type=kind).outputs[0])
        compare(f"Clamp {kind}", t)


def two_colors(t):
    """Colours from 0 to 1 in both directions, of all hues."""
    _, x, y = axes(t)
    half = [t.add("ShaderNodeMath", {0: value, 1: 0.5, 2: 0.5}, operation="MULTIPLY_ADD").outputs[0] for value in (x, y)]
    return (t.add("ShaderNodeCombineRGB", {0: half[0], 1: half[1], 2: 0.3}).outputs[0], t.add("ShaderNodeCombineRGB", {0: half[1], 1: 0.6, 2: half[0]}).outputs[0])


def mix_cases(tree):
    for kind in [one.identifier for one in bpy.types.ShaderNodeMixRGB.bl_rna.properties["blend_type"].enum_items]:
        t = tree()
        one, two = two_colors(t)
        t.show(t.add("ShaderNodeMixRGB", {0: 0.7, 1: one, 2: two}, blend_type=kind, use_clamp=True).outputs[0])
        compare(f"Mix RGB {kind}", t)
    t = tree()
    one, two = two_colors(t)
    t.show(t.add("ShaderNodeMix", {"Factor": axes(t)[1], "A": one, "B": two}, data_type="RGBA", blend_type="SCREEN").outputs[2])
    compare("Mix of colours", t)
    t = tree()
    place, x, _ = axes(t)
    t.show(t.add("ShaderNodeMix", {"Factor": x, "A": place, "B": (0.2, 0.4, 0.9)}, data_type="VECTOR").outputs[1])
    compare("Mix of vectors", t)
    t = tree()
    t.show(t.add("ShaderNodeMix", {"Factor": 0.25, "A": axes(t)[1], "B": 0.8}, data_type="FLOAT").outputs[0])
    compare("Mix of numbers", t)


def ramp_cases(tree):
    for way, losses in ("LINEAR", ()), ("EASE", ()), ("CONSTANT", ()), ("B_SPLINE", ["ColorRamp"]):
        t = tree()
        node = t.add("ShaderNodeValToRGB", {0: t.add("ShaderNodeMath", {0: axes(t)[1], 1: 0.5, 2: 0.5}, operation="MULTIPLY_ADD").outputs[0]})
        ramp = node.color_ramp
        ramp.interpolation = way
        ramp.elements[0].position, ramp.elements[0].color = 0.2, (0.8, 0.1, 0.0, 1)
        ramp.elements[1].position, ramp.elements[1].color = 0.9, (0.1, 0.2, 1, 1)
        ramp.elements.new(0.5).color = (0.2, 0.9, 0.3, 1)
        t.show(node.outputs[0])
        # Cycles reads ramps from a table of 256 values; a spline is not linear, and that is told
        compare(f"Color Ramp {way}", t, losses, mean=0.2 if losses else 0.004, edges=1 if losses else 0.05)


def color_cases(tree):
    for name, inputs, output in (("Invert", {"Fac": 0.7}, 0), ("Gamma", {"Gamma": 2.2}, 0), ("BrightContrast", {"Bright": 0.1, "Contrast": 0.5}, 0),
                                 ("HueSaturation", {"Hue": 0.7, "Saturation": 1.4, "Value": 0.8, "Fac": 0.9}, 0), ("RGBToBW", {}, 0)):
        t = tree()
        t.show(t.add(f"ShaderNode{name}", {"Color": two_colors(t)[0], **inputs}).outputs[output])
        compare(name, t)
    for mode in "RGB", "HSV":
        t = tree()
        parts = t.add("ShaderNodeSeparateColor", {0: two_colors(t)[0]}, mode=mode)
        t.show(t.add("ShaderNodeCombineColor", {0: parts.outputs[1], 1: parts.outputs[0], 2: parts.outputs[2]}, mode=mode).outputs[0])
        compare(f"Separate and Combine Color {mode}", t, mean=0.01)
    t = tree()
    t.show(t.add("ShaderNodeBlackbody", {0: t.add("ShaderNodeMath", {0: axes(t)[1], 1: 2000, 2: 5000}, operation="MULTIPLY_ADD").outputs[0]}).outputs[0])
    compare("Blackbody", t)


def geometry_cases(tree):
    for output, losses in ("UV", ()), ("Object", ()), ("Generated", ["Generated"]), ("Normal", ()):
        t = tree()
        t.show(t.add("ShaderNodeTexCoord").outputs[output])
        compare(f"Texture Coordinate {output}", t, losses)
    for output in "Position", "Normal", "Incoming":
        t = tree()
        t.show(t.add("ShaderNodeNewGeometry").outputs[output])
        compare(f"Geometry {output}", t)
    for kind in "POINT", "TEXTURE", "VECTOR", "NORMAL":
        t = tree()
        place = t.add("ShaderNodeVectorMath", {0: axes(t)[0], 1: (0.3, 0.2, 0.5)}, operation="ADD").outputs[0]
        node = t.add("ShaderNodeMapping", {"Vector": place, "Rotation": (0.3, -0.5, 0.8), "Scale": (1.5, 0.7, 2)}, vector_type=kind)
        if kind in ("POINT", "TEXTURE"):
            node.inputs["Location"].default_value = (0.1, 0.3, -0.2)
        t.show(node.outputs[0])
        compare(f"Mapping {kind}", t)
    for kind in "AXIS_ANGLE", "X_AXIS", "Z_AXIS", "EULER_XYZ":
        for invert in False, True:
            t = tree()
            node = t.add("ShaderNodeVectorRotate", {"Vector": axes(t)[0], "Center": (0.2, 0.1, -0.4)}, rotation_type=kind, invert=invert)
            if kind == "EULER_XYZ":
                node.inputs["Rotation"].default_value = (0.4, 0.9, -0.3)
            else:
                node.inputs["Angle"].default_value = 0.7
            t.show(node.outputs[0])
            compare(f"Vector Rotate {kind} {invert}", t)
    for name, output in ("Fresnel", 0), ("LayerWeight", 0), ("LayerWeight", 1):
        t = tree()
        t.show(t.add(f"ShaderNode{name}", {0: 0.7 if name == "LayerWeight" else 1.6}).outputs[output])
        compare(f"{name} {output}", t)


def texture_cases(tree):
    noises = ({"Scale": 1.0}, {"Detail": 1.5, "Roughness": 0.3, "Scale": 0.7}, {"Distortion": 0.8, "Detail": 0.0, "Scale": 1.0})
    for inputs in noises:
        for output in 0, 1:
            t = tree()
            t.show(t.add("ShaderNodeTexNoise", {"Vector": axes(t)[0], **inputs}).outputs[output])
            compare(f"Noise {output} {inputs}", t)
    for kind in [one.identifier for one in bpy.types.ShaderNodeTexGradient.bl_rna.properties["gradient_type"].enum_items]:
        t = tree()
        t.show(t.add("ShaderNodeTexGradient", {0: axes(t)[0]}, gradient_type=kind).outputs[0])
        compare(f"Gradient {kind}", t)
    t = tree()
    place = t.add("ShaderNodeVectorMath", {0: axes(t)[0], 1: (0, 0, 0.1)}, operation="ADD").outputs[0]
    t.show(t.add("ShaderNodeTexChecker", {0: place, "Scale": 2.3, "Color1": (0.9, 0.1, 0, 1), "Color2": (0, 0.2, 0.8, 1)}).outputs[0])
    compare("Checker", t, edges=0.1, mean=0.03)
    for kind, way, profile in ("BANDS", "X", "SIN"), ("BANDS", "DIAGONAL", "SAW"), ("RINGS", "Z", "TRI"), ("RINGS", "SPHERICAL", "SIN"):
        t = tree()
        settings = {"bands_direction" if kind == "BANDS" else "rings_direction": way}
        inputs = {"Vector": axes(t)[0], "Scale": 0.4, "Phase Offset": 0.6, "Distortion": 1.5 if way == "X" else 0}
        t.show(t.add("ShaderNodeTexWave", inputs, wave_type=kind, wave_profile=profile, **settings).outputs[1])
        compare(f"Wave {kind} {way} {profile}", t, mean=0.015, edges=0.06)
    for name, losses in ("ShaderNodeTexVoronoi", ["Voronoi Texture"]), ("ShaderNodeTexWhiteNoise", ["White Noise Texture"]):
        t = tree()
        t.show(t.add(name, {0: axes(t)[0]}).outputs[0])
        compare(name, t, losses, mean=0.5, edges=1)
    t = tree()
    t.show(t.add("ShaderNodeTexMagic", {0: axes(t)[0]}).outputs[0])
    compare("Magic", t, ["Magic Texture"], mean=1, edges=1)


def image_cases(tree):
    path = WORK / "colors.png"
    image = bpy.data.images.new("colors", 4, 4)
    image.pixels = [value for p in range(16) for value in (p % 4 / 3, p // 4 / 3, p * 7 % 16 / 15, 1)]
    image.filepath_raw, image.file_format = str(path), "PNG"
    image.save()
    for space, extension, moved in ("sRGB", "REPEAT", False), ("Non-Color", "EXTEND", True), ("Non-Color", "REPEAT", True), ("sRGB", "CLIP", True):
        t = tree()
        node = t.add("ShaderNodeTexImage", interpolation="Closest", extension=extension, image=bpy.data.images.load(str(path)))
        node.image.colorspace_settings.name = space
        if moved:
            place = t.add("ShaderNodeTexCoord").outputs["UV"]
            turned = {"Vector": place, "Location": (0.3, -0.2, 0), "Rotation": (0, 0, 0.4), "Scale": (0.8, 0.6, 1)}
            t.links.new(t.add("ShaderNodeMapping", turned).outputs[0], node.inputs[0])
        t.show(node.outputs["Color"])
        compare(f"Image {space} {extension} {moved}", t, mean=0.03, edges=0.15)


def tree_cases(tree):
    """Groups, reroutes and muted nodes have no values of their own."""
    t = tree()
    inner = bpy.data.node_groups.new("Twice", "ShaderNodeTree")
    inner.inputs.new("NodeSocketFloat", "X")
    inner.inputs.new("NodeSocketFloat", "By").default_value = 2
    inner.outputs.new("NodeSocketFloat", "Y")
    ends, work = [inner.nodes.new(f"NodeGroup{word}") for word in ("Input", "Output")], inner.nodes.new("ShaderNodeMath")
    work.operation = "MULTIPLY"
    for one, two in (ends[0].outputs[0], work.inputs[0]), (ends[0].outputs[1], work.inputs[1]), (work.outputs[0], ends[1].inputs[0]):
        inner.links.new(one, two)
    _, x, y = axes(t)
    groups = [t.add("ShaderNodeGroup", node_tree=inner) for _ in range(2)]
    t.links.new(x, groups[0].inputs[0])
    groups[0].inputs[1].default_value = 0.3
    t.links.new(groups[0].outputs[0], groups[1].inputs[0])
    t.links.new(y, groups[1].inputs[1])
    way = t.add("NodeReroute")
    t.links.new(groups[1].outputs[0], way.inputs[0])
    muted = t.add("ShaderNodeMath", {0: way.outputs[0]}, operation="MULTIPLY")
    muted.mute = True
    t.show(t.add("ShaderNodeMath", {0: muted.outputs[0], 1: 0.5}, operation="ADD").outputs[0])
    compare("groups, reroutes, muted nodes", t)
    bpy.data.node_groups.remove(inner)


main()
