#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""mxgen translate of surfaces with graphs inside of their definitions: what reads textures or patterns there stands in the new document,
what is computed of constants is a value, and a known model inside is found. Arguments: mxgen, the root of the project."""
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish

MXGEN = sys.argv[1]
FOLDER = tempfile.TemporaryDirectory()
PLACE = pathlib.Path(FOLDER.name)


def translate(text, model, what):
    """The new document by XML element, after a check that it generates without new messages."""
    path, out = PLACE / "in.mtlx", PLACE / "out.mtlx"
    path.write_text(f'<?xml version="1.0"?><materialx version="1.39">{text}</materialx>', encoding="utf-8")
    done = subprocess.run([MXGEN, "translate", path, "--to", model, "-o", out], capture_output=True, text=True, check=False)
    check(done.returncode == 0, f"{what}: {done.stderr[:300]}")
    made = subprocess.run([MXGEN, out, "--target", "glsl", "-o", PLACE / "shaders"], capture_output=True, text=True, check=False)
    check(made.returncode == 0, f"{what} generates: {made.stderr[:300]}")
    return ET.parse(out).getroot() if done.returncode == 0 else ET.Element("materialx"), done.stderr


def port(name, kind, **attributes):
    more = " ".join(f'{key}="{value}"' for key, value in attributes.items())
    return f'<input name="{name}" type="{kind}" {more}/>'


def node(category, name, kind, *ports):
    return f'<{category} name="{name}" type="{kind}">{"".join(ports)}</{category}>'


def define(name, kind, inputs, nodes, last):
    """A definition by a nodegraph."""
    return f'<nodedef name="ND_{name}" node="{name}">{inputs}<output name="out" type="{kind}"/></nodedef>' \
        f'<nodegraph name="NG_{name}" nodedef="ND_{name}">{nodes}<output name="out" type="{kind}" nodename="{last}"/></nodegraph>'


def named(root, name):
    return next((e for e in root if e.get("name") == name), ET.Element("none"))


def inputs(root, name="S"):
    return {i.get("name"): i.attrib for i in named(root, name).findall("input")}


HUE = port("hue", "color3", value="0.2, 0.4, 0.6")
STUDIO = define(
    "studio", "surfaceshader", HUE + port("file", "filename", value="") + port("scale", "float", value="4"),
    node("texcoord", "t", "vector2") + node("multiply", "st", "vector2", port("in1", "vector2", nodename="t"), port("in2", "float", interfacename="scale"))
    + node("image", "i", "color3", port("file", "filename", interfacename="file"), port("texcoord", "vector2", nodename="st"))
    + node("multiply", "tinted", "color3", port("in1", "color3", interfacename="hue"), port("in2", "color3", nodename="i"))
    + node("oren_nayar_diffuse_bsdf", "d", "BSDF", port("color", "color3", nodename="tinted"))
    + node("surface", "s", "surfaceshader", port("bsdf", "BSDF", nodename="d")), "s")


def test_textures():
    root, said = translate(STUDIO + node("studio", "S", "surfaceshader", port("file", "filename", value="wood.png")), "gltf_pbr", "a texture in a definition")
    check(inputs(root)["base_color"].get("nodename") == "S_tinted" and not said, f"the texture of a definition is a node of the document: {said}")
    check(inputs(root, "S_i")["file"].get("value") == "wood.png" and inputs(root, "S_st")["in2"].get("value") == "4", "with the values of the surface, and defaults")
    check(named(root, "S_d").tag == "none" and named(root, "NG_studio").tag == "nodegraph", "closures are gone, and the definition stays")
    twice, _ = translate(STUDIO + node("studio", "S", "surfaceshader", port("file", "filename", value="a.png"))
                         + node("studio", "T", "surfaceshader", port("file", "filename", value="b.png")), "open_pbr_surface", "two surfaces")
    check(inputs(twice, "S_i")["file"].get("value") == "a.png" and inputs(twice, "T_i")["file"].get("value") == "b.png", "each surface has its own")


def test_materials():
    inner = define("coated", "material", HUE, node("standard_surface", "s", "surfaceshader", port("base_color", "color3", interfacename="hue"))
                   + node("surfacematerial", "m", "material", port("surfaceshader", "surfaceshader", nodename="s")), "m")
    outer = define("painted", "material", port("tone", "color3", value="0, 0, 1"), node("coated", "c", "material", port("hue", "color3", interfacename="tone")), "c")
    look = '<look name="L"><materialassign name="a" material="T" geom="/a"/></look>'
    for name, text, tone in (("coated", inner, "hue"), ("painted", inner + outer, "tone")):
        root, said = translate(text + node(name, "T", "material", port(tone, "color3", value="0.1, 0.7, 0.3")) + look, "gltf_pbr", f"the material <{name}>")
        surface = named(root, "T").find("input")
        check(named(root, "T").tag == "surfacematerial" and not said, f"<{name}> is a material with its name: {named(root, 'T').tag} {said}")
        shader = surface.get("nodename") if surface is not None else ""
        check(named(root, shader).tag == "gltf_pbr" and inputs(root, shader)["base_color"]["value"] == "0.1, 0.7, 0.3", f"<{name}> has the new surface")
    broken = inner.replace('interfacename="hue"', 'nodename="nowhere"') + node("coated", "T", "material")
    path = PLACE / "broken.mtlx"
    path.write_text(f'<?xml version="1.0"?><materialx version="1.39">{broken}</materialx>', encoding="utf-8")
    done = subprocess.run([MXGEN, "translate", path, "--to", "gltf_pbr"], capture_output=True, text=True, check=False)
    check(done.returncode == 1 and "[dangling-nodename]" in done.stderr and not done.stdout, f"a material with a fault inside is told: {done.stderr[:300]}")


def test_levels():
    inner = define("worn", "BSDF", port("wear", "float", value="0.25"),
                   node("noise3d", "n", "float", port("amplitude", "float", interfacename="wear"))
                   + node("LamaDielectric", "l", "BSDF", port("roughness", "float", nodename="n")), "l")
    outer = define("outer", "surfaceshader", port("age", "float", value="0.2"),
                   node("multiply", "w", "float", port("in1", "float", interfacename="age"), port("in2", "float", value="2"))
                   + node("worn", "i", "BSDF", port("wear", "float", nodename="w")) + node("surface", "s", "surfaceshader", port("bsdf", "BSDF", nodename="i")), "s")
    root, said = translate(inner + outer + node("outer", "S", "surfaceshader"), "open_pbr_surface", "definitions inside of definitions")
    check("specular_roughness" in inputs(root) and "[translation-op]" not in said, f"a pattern two levels down: {said}")
    check(named(root, "S_i_n").tag == "noise3d" and inputs(root, "S_i_n")["amplitude"].get("nodename") == "S_w", "the pattern reads what the outer definition computes")
    check(not any(e.get("name", "").startswith("S_i_l") for e in root), "closures of the library stay whole, as formulas")


WRAP = define("wrap", "surfaceshader", HUE + port("age", "float", value="0.5"),
              node("noise2d", "n", "float") + node("multiply", "dark", "color3", port("in1", "color3", interfacename="hue"), port("in2", "float", nodename="n"))
              + node("mix", "rough", "float", port("bg", "float", value="0.2"), port("fg", "float", value="0.6"), port("mix", "float", interfacename="age"))
              + node("standard_surface", "s", "surfaceshader", port("base_color", "color3", nodename="dark"), port("specular_roughness", "float", nodename="rough")), "s")


def test_models_inside():
    root, said = translate(WRAP + node("wrap", "S", "surfaceshader"), "gltf_pbr", "a model in a definition")
    check(inputs(root)["base_color"].get("nodename") == "S_dark" and not said, f"a standard_surface inside is translated as one: {said}")
    check(abs(float(inputs(root)["roughness"].get("value", "0")) - 0.4) < 1e-6, "what the definition computes of constants is a value")
    check(named(root, "S_rough").tag == "none", "and its nodes are gone")
    shell = define("shell", "surfaceshader", "", node("wrap", "w", "surfaceshader", port("age", "float", value="1")), "w")
    root, _ = translate(WRAP + shell + node("shell", "S", "surfaceshader"), "gltf_pbr", "a model two levels down")
    check(abs(float(inputs(root)["roughness"].get("value", "0")) - 0.6) < 1e-6, "through two definitions")
    root, _ = translate(WRAP + node("constant", "c", "float", port("value", "float", value="0.25")) + node("wrap", "S", "surfaceshader", port("age", "float", nodename="c")),
                        "standard_surface", "the model itself")
    check(named(root, "S").tag == "standard_surface" and named(root, "c").tag == "constant", "a definition around the wanted model is that model; nodes of the document stay")
    graph = f'<nodegraph name="G">{node("wrap", "S", "surfaceshader")}<output name="out" type="surfaceshader" nodename="S"/></nodegraph>'
    root, _ = translate(WRAP + graph, "gltf_pbr", "in a nodegraph")
    check(root.find("nodegraph[@name='G']/gltf_pbr") is not None and root.find("nodegraph[@name='G']/multiply[@name='S_dark']") is not None, "inside of a nodegraph")


def test_faults():
    """Definitions that contain themselves are told, and nothing hangs."""
    loop = define("loop", "surfaceshader", "", node("loop", "s", "surfaceshader"), "s")
    (PLACE / "in.mtlx").write_text(f'<?xml version="1.0"?><materialx version="1.39">{loop}{node("loop", "S", "surfaceshader")}</materialx>', encoding="utf-8")
    done = subprocess.run([MXGEN, "translate", PLACE / "in.mtlx", "--to", "gltf_pbr"], capture_output=True, text=True, check=False, timeout=60)
    check(done.returncode == 1 and "in.mtlx:1:" in done.stderr and "error:" in done.stderr, f"a definition inside of itself: {done.stderr[:200]}")


def test_spaces():
    """Numbers in the place of textures have no colour space, whatever the document has."""
    text = node("image", "i", "color3", port("file", "filename", value="a.png")) + node("oren_nayar_diffuse_bsdf", "d", "BSDF", port("color", "color3", nodename="i")) \
        + node("surface", "S", "surfaceshader", port("bsdf", "BSDF", nodename="d"))
    path = PLACE / "in.mtlx"
    path.write_text(f'<?xml version="1.0"?><materialx version="1.39" colorspace="srgb_texture">{text}</materialx>', encoding="utf-8")
    done = subprocess.run([MXGEN, "translate", path, "--to", "open_pbr_surface"], capture_output=True, text=True, check=False)
    check(inputs(ET.fromstring(done.stdout))["base_color"].get("nodename") == "i", f"a texture stays itself in a document of sRGB: {done.stdout}")


test_textures()
test_materials()
test_levels()
test_models_inside()
test_faults()
test_spaces()
finish("translate-definitions")
