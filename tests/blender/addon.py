# SPDX-License-Identifier: Apache-2.0
"""The add-on inside of Blender, without a display: import, export, round trips, losses, faults, the preview. Arguments after "--": the root
of the project, the program, an empty folder."""
import pathlib
import sys

import bpy

ROOT, PROGRAM, WORK = (pathlib.Path(word) for word in sys.argv[sys.argv.index("--") + 1:])
sys.path += [str(ROOT / "tests"), str(ROOT / "tests/blender"), str(ROOT / "blender")]
from checks import check, finish, skip

import mxgen_materials
import mxgen
from mxgen_materials.baking import Baking
from mxgen_materials.exporting import export_file
from mxgen_materials.importing import import_file
import pictures

PRESETS = {
    "plastic": {"Base Color": (0.8, 0.1, 0.05, 1), "Roughness": 0.3, "Specular": 0.5},
    "metal": {"Base Color": (0.95, 0.64, 0.54, 1), "Metallic": 1.0, "Roughness": 0.2, "Anisotropic": 0.5},
    "glass": {"Base Color": (0.9, 1.0, 0.9, 1), "Transmission": 1.0, "Roughness": 0.05, "IOR": 1.33},
    "wax": {"Base Color": (0.8, 0.7, 0.5, 1), "Subsurface": 0.4, "Subsurface Radius": (1.0, 0.4, 0.2), "Subsurface Color": (0.9, 0.5, 0.3, 1)},
    "velvet": {"Base Color": (0.2, 0.0, 0.3, 1), "Sheen": 0.8, "Roughness": 0.9, "Specular": 0.1},
    "paint": {"Base Color": (0.0, 0.1, 0.6, 1), "Clearcoat": 1.0, "Clearcoat Roughness": 0.02},
    "lamp": {"Emission": (1.0, 0.8, 0.4, 1), "Emission Strength": 3.0, "Base Color": (0, 0, 0, 1)},
    "veil": {"Alpha": 0.4},
}


def principled(name, values):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    node = material.node_tree.nodes["Principled BSDF"]
    for socket, value in values.items():
        node.inputs[socket].default_value = value
    return material


def bsdf_of(material):
    return next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")


def values_of(material):
    """The sockets with values, as lists of numbers."""
    found = {}
    for socket in bsdf_of(material).inputs:
        if socket.type in ("RGBA", "VECTOR", "VALUE") and not socket.hide_value and not socket.is_linked:
            value = socket.default_value
            found[socket.name] = [float(x) for x in value] if socket.type != "VALUE" else [float(value)]
    return found


def close(one, other):
    return all(abs(a - b) < 1e-4 for a, b in zip(one, other))


def clear():
    for group in bpy.data.materials, bpy.data.images, bpy.data.texts:
        for one in list(group):
            group.remove(one)


def text_of(path, text):
    path.write_text(text, encoding="utf-8")
    return str(path)


def document(shader):
    return f"""<materialx version="1.39">{shader}<surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial></materialx>"""


def check_round_trips():
    for name, values in PRESETS.items():
        clear()
        before = values_of(principled(name, values))
        path = str(WORK / f"{name}.mtlx")
        losses = export_file(path, list(bpy.data.materials))
        check(not losses, f"{name} loses nothing: {losses}")
        exported = mxgen.Context().load(path)
        check(exported.validate().errors == 0 and exported[f"SR_{name}"].category == "open_pbr_surface", f"{name} is a valid OpenPBR document")
        check("void main" in (exported.generate("essl").pixel or ""), f"{name} generates")
        clear()
        made, losses = import_file(path)
        expected = ["fuzz_color"] if "Sheen" in values else [] # the tint of sheen
        check(len(made) == 1 and [loss.what for loss in losses] == expected, f"{name} comes back whole: {losses}")
        after = values_of(made[0])
        for socket, value in before.items():
            # Unused sockets may differ: OpenPBR has other defaults, and no such inputs.
            if socket in ("Sheen Tint", "Specular Tint", "Anisotropic Rotation", "Transmission Roughness", "Subsurface IOR", "Subsurface Anisotropy", "Weight"):
                continue
            if socket == ("Specular" if "Transmission" in values else "IOR"): # the other one counts
                continue
            check(close(value, after[socket]), f"{name}: {socket} was {value} and is {after[socket]}")


def check_textures():
    clear()
    image = bpy.data.images.new("bricks", 4, 4)
    image.filepath_raw = str(WORK / "bricks.png")
    image.file_format = "PNG"
    image.save()
    material = principled("Wall", {"Roughness": 0.7})
    tree, node = material.node_tree, bsdf_of(material)
    for socket, space in ("Base Color", "sRGB"), ("Roughness", "Non-Color"):
        texture = tree.nodes.new("ShaderNodeTexImage")
        texture.image = bpy.data.images.load(str(WORK / "bricks.png"))
        texture.image.colorspace_settings.name = space
        texture.extension = "EXTEND"
        tree.links.new(texture.outputs["Color"], node.inputs[socket])
    bump = tree.nodes.new("ShaderNodeNormalMap")
    bump.inputs["Strength"].default_value = 0.5
    tree.links.new(texture.outputs["Color"], bump.inputs["Color"])
    tree.links.new(bump.outputs["Normal"], node.inputs["Normal"])
    magic = tree.nodes.new("ShaderNodeTexMagic")
    tree.links.new(magic.outputs["Fac"], node.inputs["Metallic"])
    losses = export_file(str(WORK / "wall.mtlx"), [material])
    check([loss.what for loss in losses] == ["Magic Texture"] and "'Metallic'" in losses[0].reason, f"a node without counterpart is lost: {losses}")
    exported = mxgen.Context().load(WORK / "wall.mtlx")
    check(exported.validate().errors == 0, str(exported.validate()))
    color = exported["NG_Wall/bricks_image"]
    check((color.child("file").value, color.child("file").get("colorspace"), color.child("uaddressmode").value) == ("bricks.png", "srgb_texture", "clamp"),
          "the image of the colour")
    check(exported["NG_Wall/Normal_Map_normalmap"].category == "normalmap", "the normal map")
    clear()
    made, losses = import_file(str(WORK / "wall.mtlx"))
    node = bsdf_of(made[0])
    texture = node.inputs["Base Color"].links[0].from_node
    check((texture.type, texture.image.colorspace_settings.name, texture.extension) == ("TEX_IMAGE", "sRGB", "EXTEND"), "the texture comes back")
    check(pathlib.Path(texture.image.filepath) == WORK / "bricks.png", texture.image.filepath)
    check(abs(node.inputs["Normal"].links[0].from_node.inputs["Strength"].default_value - 0.5) < 1e-6, "the strength of the normal map")
    check(node.inputs["Roughness"].links[0].from_node.image.colorspace_settings.name == "Non-Color", "numbers stay numbers")


def check_models():
    """Documents of other shading models, and what is lost of them."""
    for shader, socket, expected, lost in (
            ('<standard_surface name="S" type="surfaceshader"><input name="base" type="float" value="0.5"/><input name="base_color" type="color3" value="0.8, 0.4, 0.2"/>'
             '<input name="thin_film_thickness" type="float" value="500"/></standard_surface>', "Base Color", [0.4, 0.2, 0.1, 1], ["thin_film_thickness"]),
            ('<standard_surface name="S" type="surfaceshader"><input name="opacity" type="color3" value="0.2, 0.4, 0.6"/></standard_surface>',
             "Alpha", [0.4], ["opacity"]),
            ('<standard_surface name="S" type="surfaceshader"><input name="specular" type="float" value="1"/><input name="specular_IOR" type="float" value="1.5"/></standard_surface>',
             "Specular", [0.5], []),
            ('<open_pbr_surface name="S" type="surfaceshader"><input name="coat_darkening" type="float" value="0.5"/><input name="fuzz_weight" type="float" value="0.03"/></open_pbr_surface>',
             "Sheen", [0.3], []), # there is no coat
            ('<open_pbr_surface name="S" type="surfaceshader"><input name="fuzz_weight" type="float" value="0.5"/></open_pbr_surface>',
             "Sheen", [1], ["fuzz_weight"]),
            ('<open_pbr_surface name="S" type="surfaceshader"><input name="coat_darkening" type="float" value="0.5"/><input name="coat_weight" type="float" value="0.1"/></open_pbr_surface>',
             "Clearcoat", [0.4], ["coat_darkening", "coat_ior"]),
            ('<gltf_pbr name="S" type="surfaceshader"><input name="metallic" type="float" value="0.25"/></gltf_pbr>', "Metallic", [0.25], []),
            ('<UsdPreviewSurface name="S" type="surfaceshader"><input name="diffuseColor" type="color3" value="0.1, 0.2, 0.3"/></UsdPreviewSurface>',
             "Base Color", [0.1, 0.2, 0.3, 1], []),
            ('<standard_surface name="S" type="surfaceshader"><input name="base" type="float" value="0"/><input name="transmission" type="float" value="1"/>'
             '<input name="transmission_color" type="color3" value="0.2, 0.4, 0.6"/></standard_surface>', "Base Color", [0.2, 0.4, 0.6, 1], []),
            ('<standard_surface name="S" type="surfaceshader"><input name="coat" type="float" value="0.5"/><input name="base" type="float" value="1"/>'
             '<input name="base_color" type="color3" value="1, 0.5, 0"/><input name="coat_color" type="color3" value="0.5, 0.5, 0.5"/></standard_surface>',
             "Base Color", [0.75, 0.375, 0, 1], ["coat"]),
            ('<standard_surface name="S" type="surfaceshader"><input name="normal" type="vector3" nodename="n"/></standard_surface><normalmap name="n" type="vector3">'
             '<input name="in" type="vector3" nodename="t"/></normalmap><tiledimage name="t" type="vector3"><input name="file" type="filename" value="bricks.png"/>'
             '<input name="uvtiling" type="vector2" nodename="c"/></tiledimage><constant name="c" type="vector2"/>', "Metallic", [0], ["normal"]),
            ('<standard_surface name="S" type="surfaceshader"><input name="base_color" type="color3" nodename="n"/></standard_surface>'
             '<noise2d name="n" type="color3"/>', "Metallic", [0], ["base_color"]),
            ('<standard_surface name="S" type="surfaceshader"><input name="base_color" type="color3" nodename="n"/></standard_surface>'
             '<image name="n" type="color3"><input name="file" type="filename" value="gone.png"/></image>', "Metallic", [0], ["base_color"])):
        clear()
        made, losses = import_file(text_of(WORK / "model.mtlx", document(shader)))
        check(len(made) == 1 and close(values_of(made[0])[socket], expected), f"{socket} is {values_of(made[0]).get(socket)}, not {expected}: {shader}")
        check([loss.what for loss in losses] == lost, f"losses {losses}, not {lost}: {shader}")
    made, losses = import_file(text_of(WORK / "model.mtlx", document('<surface name="S" type="surfaceshader"/>')))
    check(not made and "has no counterpart" in losses[0].reason, f"a surface of BSDF nodes: {losses}")


RAMP = """<standard_surface name="S" type="surfaceshader"><input name="specular_roughness" type="float" nodename="r"/></standard_surface>
    <ramplr name="r" type="float"><input name="valuel" type="float" value="0"/><input name="valuer" type="float" value="1"/></ramplr>"""
#: on a plane from -1 to 1 the same
ALONG = """<standard_surface name="S" type="surfaceshader"><input name="specular_roughness" type="float" nodename="r"/></standard_surface>
    <position name="p" type="vector3"><input name="space" type="string" value="object"/></position>
    <extract name="x" type="float"><input name="in" type="vector3" nodename="p"/><input name="index" type="integer" value="0"/></extract>
    <remap name="r" type="float"><input name="in" type="float" nodename="x"/><input name="inlow" type="float" value="-1"/></remap>"""


def is_ramp(image):
    """Whether the rows of an image go from 0 to 1."""
    width, height = image.size
    pixels = image.pixels[:]
    return all(abs(pixels[4 * (row * width + column)] - (column + 0.5) / width) < 0.01 for row in (0, height // 2) for column in range(width))


def check_baking():
    """Graphs become images, and other surfaces the model of the export."""
    clear()
    bpy.ops.mesh.primitive_plane_add()
    plane = bpy.context.object
    for name, shader, surface in ("ramp", RAMP, None), ("along", ALONG, plane):
        made, losses = import_file(text_of(WORK / f"{name}.mtlx", document(shader)), Baking(WORK / f"{name}_baked", 32, surface))
        check(len(made) == 1 and not losses, f"{name} loses nothing: {losses}")
        links = bsdf_of(made[0]).inputs["Roughness"].links
        image = links[0].from_node.image if links else None
        check(image is not None and image.colorspace_settings.name == "Non-Color" and is_ramp(image), f"{name}: the graph is an image")
        check(len(bpy.data.materials) == 1, f"{name}: the first try leaves no material")
        clear()
    check(bpy.context.object == plane and not plane.data.materials, "the object stays as it was")
    closures = document("""<oren_nayar_diffuse_bsdf name="B" type="BSDF"><input name="color" type="color3" value="0.2, 0.4, 0.6"/></oren_nayar_diffuse_bsdf>
        <surface name="S" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="B"/></surface>""")
    made, losses = import_file(text_of(WORK / "closures.mtlx", closures), Baking(WORK / "closures_baked"))
    check(len(made) == 1 and close(values_of(made[0])["Base Color"], [0.2, 0.4, 0.6, 1]), f"closures become the model of the export: {losses}")
    check(not (WORK / "closures_baked").exists(), "without a graph nothing is baked")
    clear()
    facing = document(RAMP.replace("ramplr", "facingratio").replace('valuel" type="float" value="0"', 'faceforward" type="boolean" value="true"')
                      .replace('<input name="valuer" type="float" value="1"/>', ""))
    made, losses = import_file(text_of(WORK / "facing.mtlx", facing), Baking(WORK / "facing_baked"))
    check(len(made) == 1 and [loss.what for loss in losses] == ["graphs", "specular_roughness"], f"what depends on the view stays lost: {losses}")
    check("facing.mtlx:" in losses[0].reason, f"with its place: {losses[0]}")


def fails(operator, *words, **arguments):
    """Whether an operator reports an error with the words."""
    try:
        operator(**arguments)
    except RuntimeError as error:
        return all(word in str(error) for word in words) or print(error)
    return False


def check_operators():
    clear()
    mxgen_materials.register()
    bpy.ops.mesh.primitive_cube_add()
    check(bpy.ops.mxgen.import_document(filepath=str(ROOT / "examples/gold.mtlx")) == {"FINISHED"}, "the operator imports")
    material = bpy.context.object.active_material
    check(material is not None and material.name == "Gold" and close(values_of(material)["Metallic"], [1]), "and assigns the material")
    check("specular_color" in bpy.data.texts["mxgen report"].as_string(), "the report lists the losses")
    check(bpy.ops.mxgen.export_document(filepath=str(WORK / "out.mtlx")) == {"FINISHED"} and (WORK / "out.mtlx").exists(), "the operator exports")
    broken = text_of(WORK / "broken.mtlx", document('<standard_surface name="S" type="surfaceshader"><input name="base" type="float" value="red"/></standard_surface>'))
    count = len(bpy.data.materials)
    check(fails(bpy.ops.mxgen.import_document, "broken.mtlx:1:", "bad-value", filepath=broken), "a broken document is an error with its place")
    check(len(bpy.data.materials) == count, "and makes nothing")
    check(fails(bpy.ops.mxgen.import_document, "none.mtlx", filepath=str(WORK / "none.mtlx")), "a missing document is an error")
    check(fails(bpy.ops.mxgen.import_document, "no surface material", filepath=text_of(WORK / "empty.mtlx", '<materialx version="1.39"/>')), "an empty document")
    check(fails(bpy.ops.mxgen.export_document, "No such file", filepath=str(WORK / "none/out.mtlx")), "a missing folder is an error")
    check(bpy.ops.mxgen.preview(size=32) == {"FINISHED"} and tuple(bpy.data.images["mxgen preview"].size) == (32, 32), "the preview")
    clear()
    check(fails(bpy.ops.mxgen.export_document, "no material", filepath=str(WORK / "x.mtlx")), "nothing to export")
    mxgen_materials.unregister()
    check(not hasattr(bpy.types, "MXGEN_OT_import_document"), "the add-on goes without a trace")


def closures():
    """Shaders of nodes by name: a function that makes nodes, and how far the mean of the ball may be from that of Cycles."""
    def one(name, **inputs):
        def make(tree):
            node = tree.nodes.new(f"ShaderNode{name}")
            for key, value in inputs.items():
                node.inputs[key].default_value = value
            return node.outputs[0]
        return make

    def two(name, a, b, amount=None):
        def make(tree):
            node = tree.nodes.new(f"ShaderNode{name}")
            ends = node.inputs[1:] if amount is not None else node.inputs
            if callable(amount):
                tree.links.new(amount(tree), node.inputs[0])
            elif amount is not None:
                node.inputs[0].default_value = amount
            for socket, shader in zip(ends, (a, b)):
                tree.links.new(shader(tree), socket)
            return node.outputs[0]
        return make
    red, blue = (0.8, 0.2, 0.1, 1), (0.1, 0.2, 0.8, 1)
    diffuse, glossy, clear = one("BsdfDiffuse", Color=red), one("BsdfGlossy", Color=blue, Roughness=0.3), one("BsdfTransparent")
    return {
        "diffuse": (diffuse, 0.02), "rough diffuse": (one("BsdfDiffuse", Color=red, Roughness=0.8), 0.12), "glossy": (glossy, 0.03),
        "anisotropic": (one("BsdfAnisotropic", Color=blue, Roughness=0.4, Anisotropy=0.6), 0.05), "glass": (one("BsdfGlass", Color=(0.9, 1, 0.9, 1), Roughness=0.1, IOR=1.4), 0.04),
        "refraction": (one("BsdfRefraction", Roughness=0.1, IOR=1.4), 0.1), "translucent": (one("BsdfTranslucent", Color=red), 0.05),
        "emission": (one("Emission", Color=red, Strength=2.5), 0.01), "subsurface": (one("SubsurfaceScattering", Color=red, Scale=0.1), 0.15),
        "mixed": (two("MixShader", diffuse, glossy, 0.4), 0.03), "by Fresnel": (two("MixShader", diffuse, glossy, one("Fresnel", IOR=1.5)), 0.03),
        "added": (two("AddShader", diffuse, one("Emission", Color=blue, Strength=0.5)), 0.02), "veiled": (two("MixShader", clear, diffuse, 0.5), 0.03),
        "clear coat of a model": (two("MixShader", one("BsdfPrincipled", Specular=0.0), glossy, 0.3), 0.05),
    }


def check_closures():
    """Shaders that are no Principled BSDF."""
    clear()
    sky = WORK / "sky.hdr"
    ball = pictures.build_scene(pictures.write_sky(sky))
    for name, (make, tolerance) in closures().items():
        material = bpy.data.materials.new(name)
        material.use_nodes = True
        tree = material.node_tree
        tree.nodes.clear()
        tree.links.new(make(tree), tree.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
        for node in tree.nodes:
            if hasattr(node, "distribution") and node.type in ("BSDF_GLOSSY", "BSDF_ANISOTROPIC", "BSDF_GLASS", "BSDF_PRINCIPLED"):
                node.distribution = "MULTI_GGX"
        document_path = WORK / "closures.mtlx"
        losses = export_file(str(document_path), [material])
        check(not losses, f"{name}: {losses}")
        list_means(name, pictures.by_cycles(ball, material, WORK / "cycles.exr"), pictures.by_mxgen(PROGRAM, document_path, sky, WORK / "mxgen.exr"), tolerance)


#: of the brightest channel: how far `mxgen render` may be from Cycles. The models differ: the Principled BSDF adds a dielectric to its
#: diffuse base without taking light from the base, and has another subsurface scattering.
TOLERANCE = {"plastic": 0.07, "metal": 0.02, "glass": 0.02, "wax": 0.15, "velvet": 0.08, "paint": 0.1, "lamp": 0.02, "veil": 0.12}
#: the same for documents as Principled materials; below MATERIALS where it is there
EXAMPLES = {"gold.mtlx": 0.02}
MATERIALS = ROOT.parent / "shared/materials/resources/Materials/Examples"
STANDARD = {
    "StandardSurface/standard_surface_default.mtlx": 0.06, "StandardSurface/standard_surface_plastic.mtlx": 0.07,
    "StandardSurface/standard_surface_gold.mtlx": 0.02, "StandardSurface/standard_surface_copper.mtlx": 0.1,
    "StandardSurface/standard_surface_glass.mtlx": 0.02, "OpenPbr/open_pbr_default.mtlx": 0.07, "OpenPbr/open_pbr_glass.mtlx": 0.02,
    "GltfPbr/gltf_pbr_default.mtlx": 0.06, "GltfPbr/gltf_pbr_carpaint.mtlx": 0.06, "UsdPreviewSurface/usd_preview_surface_default.mtlx": 0.1,
    "UsdPreviewSurface/usd_preview_surface_plastic.mtlx": 0.07,
}


def list_means(name, cycles, ours, tolerance):
    brightest = max(range(3), key=lambda channel: cycles[channel])
    print(f"{name:28} Cycles {' '.join(f'{x:.4f}' for x in cycles)}   mxgen {' '.join(f'{x:.4f}' for x in ours)}")
    check(abs(ours[brightest] / cycles[brightest] - 1) < tolerance, f"{name}: Cycles draws {cycles}, mxgen {ours}")


def check_pictures():
    clear()
    sky = WORK / "sky.hdr"
    ball = pictures.build_scene(pictures.write_sky(sky))
    for name, values in PRESETS.items():
        material = principled(name, values)
        bsdf_of(material).distribution = "MULTI_GGX" # GGX loses energy, MaterialX's models do not
        document_path = WORK / f"{name}.mtlx"
        export_file(str(document_path), [material])
        list_means(name, pictures.by_cycles(ball, material, WORK / "cycles.exr"),
                   pictures.by_mxgen(PROGRAM, document_path, sky, WORK / "mxgen.exr"), TOLERANCE[name])
    documents = {ROOT / "examples" / name: tolerance for name, tolerance in EXAMPLES.items()}
    if MATERIALS.is_dir():
        documents.update({MATERIALS / name: tolerance for name, tolerance in STANDARD.items()})
    else:
        skip(f"{len(STANDARD)} standard materials are not here")
    for document_path, tolerance in documents.items():
        material = import_file(str(document_path))[0][0]
        list_means(document_path.stem, pictures.by_cycles(ball, material, WORK / "cycles.exr"),
                   pictures.by_mxgen(PROGRAM, document_path, sky, WORK / "mxgen.exr"), tolerance)


check_round_trips()
check_textures()
check_models()
check_baking()
check_operators()
check_closures()
check_pictures()
finish("blender")
