#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""mxgen translate of surfaces that are made of closures: their values by formula, what stays connected, what is told, and that every
document becomes one that generates. Arguments: mxgen, the root of the project, a folder of further documents (skipped if it is absent)."""
import math
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish, skip

MXGEN, ROOT, FURTHER = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
FOLDER = tempfile.TemporaryDirectory()
PLACE = pathlib.Path(FOLDER.name)


def run(*arguments):
    return subprocess.run([MXGEN, *map(str, arguments)], capture_output=True, text=True, check=False)


def translate(text, model="open_pbr_surface", bsdf="top", more=""):
    """The new document, and what mxgen says, of a surface over a BSDF."""
    surface = f'<surface name="S" type="surfaceshader">{port("bsdf", "BSDF", node=bsdf) if bsdf else ""}{more}</surface>'
    path = PLACE / "in.mtlx"
    path.write_text(f'<?xml version="1.0"?><materialx version="1.39">{text}{surface}</materialx>', encoding="utf-8")
    done = run("translate", path, "--to", model)
    check(done.returncode == 0, f"{text[:200]}: {done.stderr[:300]}")
    return (ET.fromstring(done.stdout) if done.returncode == 0 else ET.Element("materialx")), done.stderr


def port(name, kind, value=None, node=None):
    return f'<input name="{name}" type="{kind}" ' + (f'nodename="{node}"/>' if node else f'value="{value}"/>')


def node(category, name, kind, *ports):
    return f'<{category} name="{name}" type="{kind}">{"".join(ports)}</{category}>'


def surface(root):
    return next((e for e in root.iter() if e.get("name") == "S"), ET.Element("none"))


def number(root, name):
    """The values of an input of the new surface; [] where it has its default."""
    value = next((i.get("value") for i in surface(root).findall("input") if i.get("name") == name), None)
    return [float(x) for x in value.split(",")] if value else []


def near(found, *wanted):
    return len(found) == len(wanted) and all(math.isclose(a, b, rel_tol=1e-4, abs_tol=1e-5) for a, b in zip(found, wanted))


RED = node("oren_nayar_diffuse_bsdf", "red", "BSDF", port("color", "color3", "0.6, 0.1, 0.05"))
GLOSS = node("dielectric_bsdf", "gloss", "BSDF", port("ior", "float", "1.6"), port("roughness", "vector2", "0.16, 0.16"))


def layer(name, top, base, kind="BSDF"):
    return node("layer", name, "BSDF", port("top", "BSDF", node=top), port("base", kind, node=base))


def test_values():
    root, said = translate(RED + GLOSS + layer("top", "gloss", "red"))
    check(near(number(root, "base_color"), 0.6, 0.1, 0.05) and near(number(root, "specular_ior"), 1.6), "plastic keeps its colour and its index")
    check(near(number(root, "specular_roughness"), 0.4) and not said, "the roughness is the root of the squared one, and nothing is lost")
    check(number(root, "base_metalness") == [] and number(root, "coat_weight") == [], "plastic is no metal and has no coat")
    # a metal by its indices: (n - 1)^2 + k^2 over (n + 1)^2 + k^2
    metal = node("conductor_bsdf", "top", "BSDF", port("ior", "color3", "0.2, 0.4, 1.4"), port("extinction", "color3", "3.4, 2.3, 1.8"), port("roughness", "vector2", "0.25, 0.25"))
    root, _ = translate(metal)
    wanted = [((n - 1) ** 2 + k * k) / ((n + 1) ** 2 + k * k) for n, k in ((0.2, 3.4), (0.4, 2.3), (1.4, 1.8))]
    check(near(number(root, "base_metalness"), 1) and near(number(root, "base_color"), *wanted), f"a metal has its reflectance as its colour: {number(root, 'base_color')}, {wanted}")
    root, _ = translate(metal, "gltf_pbr")
    check(near(number(root, "base_color"), *wanted) and number(root, "metallic") == [] and near(number(root, "roughness"), 0.5), "and goes on to glTF, where metal is the default")
    # widths a and b along two axes: OpenPBR has 1 - b / a, and a = r^2 sqrt(2 / (1 + (b / a)^2))
    stretched = node("dielectric_bsdf", "gloss", "BSDF", port("roughness", "vector2", "0.2, 0.1"))
    root, _ = translate(RED + stretched + layer("top", "gloss", "red"))
    check(near(number(root, "specular_roughness_anisotropy"), 0.5) and near(number(root, "specular_roughness"), math.sqrt(0.2 * math.sqrt((1 + 0.25) / 2))), "widths of a lobe")


def test_matter():
    root, said = translate(node("dielectric_bsdf", "top", "BSDF", port("scatter_mode", "string", "RT"), port("tint", "color3", "0.5, 1, 1")))
    check(near(number(root, "transmission_weight"), 1) and near(number(root, "transmission_color"), 0.5, 1, 1), f"glass refracts, with its tint: {said}")
    volume = node("anisotropic_vdf", "inside", "VDF", port("absorption", "vector3", "0.5, 1, 0"), port("scattering", "vector3", "0.25, 0, 0"))
    root, _ = translate(node("dielectric_bsdf", "glass", "BSDF", port("scatter_mode", "string", "RT")) + volume + layer("top", "glass", "inside", "VDF"))
    check(near(number(root, "transmission_color"), math.exp(-0.75), math.exp(-1), 1) and near(number(root, "transmission_depth"), 1), "what is inside of glass takes its light by Beer and Lambert")
    check(near(number(root, "transmission_scatter"), 0.25, 0, 0), "and scatters it")
    root, _ = translate(node("dielectric_bsdf", "glass", "BSDF", port("scatter_mode", "string", "RT")) + volume + layer("top", "glass", "inside", "VDF"), "gltf_pbr")
    check(near(number(root, "attenuation_color"), math.exp(-0.75), math.exp(-1), 1) and near(number(root, "attenuation_distance"), 1) and near(number(root, "thickness"), 1),
          "the volume of glTF, which MaterialX does not draw, stays")
    clear = node("dielectric_bsdf", "clear", "BSDF", port("ior", "float", "1.4"), port("roughness", "vector2", "0.01, 0.01"))
    plastic = RED + GLOSS + layer("plastic", "gloss", "red")
    root, said = translate(plastic + clear + layer("top", "clear", "plastic"))
    check(near(number(root, "coat_ior"), 1.4) and near(number(root, "coat_weight"), 1) and near(number(root, "coat_roughness"), 0.1), "clear matter on matter is a coat")
    check(near(number(root, "specular_ior"), 1.6 * 1.4) and not said, "below it an index is against that of the coat")
    root, _ = translate(node("subsurface_bsdf", "top", "BSDF", port("color", "color3", "0.8, 0.4, 0.2"), port("radius", "color3", "2, 1, 0.8")))
    check(near(number(root, "subsurface_weight"), 1) and near(number(root, "subsurface_color"), 0.8, 0.4, 0.2) and near(number(root, "subsurface_radius_scale"), 1, 0.5, 0.4) and near(number(root, "subsurface_radius"), 2), "matter that scatters")
    fuzz = node("sheen_bsdf", "fuzz", "BSDF", port("mode", "string", "zeltner"), port("weight", "float", "0.7"), port("roughness", "float", "0.4"))
    root, _ = translate(RED + fuzz + layer("top", "fuzz", "red"))
    check(near(number(root, "fuzz_weight"), 0.7) and near(number(root, "fuzz_roughness"), 0.4) and near(number(root, "base_color"), 0.6, 0.1, 0.05), "fuzz over a colour")
    film = node("dielectric_bsdf", "film", "BSDF", port("thinfilm_thickness", "float", "400"), port("thinfilm_ior", "float", "1.7"))
    root, said = translate(RED + film + layer("top", "film", "red"))
    check(near(number(root, "thin_film_weight"), 1) and near(number(root, "thin_film_thickness"), 0.4) and near(number(root, "thin_film_ior"), 1.7) and not said, "a film, in micrometres")
    light = node("uniform_edf", "light", "EDF", port("color", "color3", "2, 1, 0.5"))
    root, _ = translate(light, bsdf=None, more=port("edf", "EDF", node="light") + port("opacity", "float", "0.25"))
    check(near(number(root, "emission_color"), 2, 1, 0.5) and near(number(root, "geometry_opacity"), 0.25) and near(number(root, "base_color"), 0, 0, 0), "light alone, half there")


SLAB = node("slab", "slab", "BSDF", port("diffuse_albedo", "color3", "0.3, 0.2, 0.1"), port("f0", "color3", "0.04, 0.02, 0.04"), port("roughness", "float", "0.4"))


def test_slabs():
    root, said = translate(SLAB + node("slab_coat", "top", "BSDF", port("base", "BSDF", node="slab"), port("color", "color3", "0.9, 0.5, 0.5")))
    check(near(number(root, "base_color"), 0.3, 0.2, 0.1) and near(number(root, "specular_color"), 1, 0.5, 1) and near(number(root, "coat_weight"), 1)
          and near(number(root, "coat_color"), *(x ** (2 * 1.1458980) for x in (0.9, 0.5, 0.5))), f"a slab under a coat: {said}")
    either = node("texcoord", "t", "vector2") + node("extract", "u", "float", port("in", "vector2", node="t"))
    gold = node("slab", "gold", "BSDF", port("diffuse_albedo", "color3", "0, 0, 0"), port("f0", "color3", "0.9, 0.6, 0.3"), port("roughness", "float", "0.4"))
    root, said = translate(either + SLAB + gold + node("slab_select", "top", "BSDF", port("in1", "BSDF", node="slab"), port("in2", "BSDF", node="gold"), port("mask", "float", node="u")))
    metal = next((i for i in surface(root).findall("input") if i.get("name") == "base_metalness"), None)
    check(metal is not None and metal.get("nodegraph") is not None and "second_roughness" not in said, f"one of two slabs is a choice of values: {said}")


    fuzzy = node("slab", "fuzzy", "BSDF", port("fuzz_amount", "float", "0.5"))
    brushed = node("slab", "brushed", "BSDF", port("anisotropy", "float", "0.5"), port("second_roughness_weight", "float", "0.5"), port("f0", "color3", "0.9, 0.9, 0.9"))
    root, _ = translate(either + fuzzy + brushed + node("slab_select", "top", "BSDF", port("in1", "BSDF", node="fuzzy"), port("in2", "BSDF", node="brushed"), port("mask", "float", node="u")))
    check(any(i.get("name") == "fuzz_weight" for i in surface(root).findall("input")), "a choice of slabs that has more features than each of them")


def test_connections():
    graph = '<nodegraph name="G">' + node("image", "i", "color3", port("file", "filename", "none.png")) + node("normalmap", "m", "vector3") \
        + node("oren_nayar_diffuse_bsdf", "d", "BSDF", port("color", "color3", node="i"), port("normal", "vector3", node="m")) \
        + node("add", "unread", "BSDF", port("in1", "BSDF", node="d")) + '<output name="out" type="BSDF" nodename="d"/></nodegraph>'
    path = PLACE / "in.mtlx"
    path.write_text(f'<?xml version="1.0"?><materialx version="1.39">{graph}<surface name="S" type="surfaceshader"><input name="bsdf" type="BSDF" nodegraph="G" output="out"/></surface></materialx>')
    root = ET.fromstring(run("translate", path, "--to", "open_pbr_surface").stdout)
    ports = {i.get("name"): i for i in surface(root).findall("input")}
    outputs = {o.get("name"): o.get("nodename") for o in root.find("nodegraph").findall("output")}
    check(outputs.get(ports["base_color"].get("output")) == "i" and ports["base_color"].get("nodegraph") == "G", "a texture stays connected through an output of its graph")
    check(outputs.get(ports["geometry_normal"].get("output")) == "m" and "out" not in outputs, "so does a normal; the output of the closure is gone")
    check(root.find(".//surface") is None and root.find("nodegraph/add") is not None and root.find("nodegraph/oren_nayar_diffuse_bsdf") is not None, "a closure that another one reads stays")
    studio = '<nodedef name="ND_studio" node="studio"><input name="hue" type="color3" value="0.2, 0.4, 0.6"/><input name="wear" type="float" value="0"/><output name="out" type="surfaceshader"/></nodedef>' \
        '<nodegraph name="NG_studio" nodedef="ND_studio"><multiply name="dark" type="color3"><input name="in1" type="color3" interfacename="hue"/><input name="in2" type="float" value="0.5"/></multiply>' \
        + node("oren_nayar_diffuse_bsdf", "d", "BSDF", port("color", "color3", node="dark")) + node("surface", "s", "surfaceshader", port("bsdf", "BSDF", node="d")) \
        + '<output name="out" type="surfaceshader" nodename="s"/></nodegraph>'
    path.write_text(f'<?xml version="1.0"?><materialx version="1.39">{studio}<image name="i" type="color3"/><studio name="S" type="surfaceshader">{port("hue", "color3", node="i")}</studio></materialx>')
    root = ET.fromstring(run("translate", path, "--to", "gltf_pbr").stdout)
    check(surface(root).tag == "gltf_pbr" and root.find(".//multiply") is not None and root.find(".//nodedef") is not None, "a studio's surface needs no translation: its graph is read")
    path.write_text(f'<?xml version="1.0"?><materialx version="1.39">{studio}<studio name="S" type="surfaceshader"/></materialx>')
    root = ET.fromstring(run("translate", path, "--to", "open_pbr_surface").stdout)
    check(near(number(root, "base_color"), 0.1, 0.2, 0.3), "and its constants fold")


def test_losses():
    _, said = translate(node("translucent_bsdf", "top", "BSDF"))
    check("[translation-closure]" in said and "<translucent_bsdf>" in said, "a closure that no slab stands for")
    _, said = translate(node("sheen_bsdf", "top", "BSDF", port("mode", "string", "conty_kulla")))
    check("'mode' of <sheen_bsdf>" in said and "[translation-loss]" in said, "fuzz of another kind")
    lamp = node("uniform_edf", "all", "EDF", port("color", "color3", "1, 1, 1")) + node("generalized_schlick_edf", "lamp", "EDF", port("color90", "color3", "1, 0, 0"), port("base", "EDF", node="all"))
    _, said = translate(lamp, bsdf=None, more=port("edf", "EDF", node="lamp"))
    check("'color90' of <generalized_schlick_edf>" in said, f"light that differs by direction: {said}")
    _, said = translate(node("slab", "top", "BSDF", port("glint_density", "float", "10")))
    check("'glint_density' of <slab>" in said, "glints")
    fine = node("texcoord", "t", "vector2") + node("extract", "u", "float", port("in", "vector2", node="t"))
    mix = node("mix", "top", "BSDF", port("fg", "BSDF", node="red"), port("bg", "BSDF", node="gloss"), port("mix", "float", node="u"))
    _, said = translate(fine + RED + GLOSS + mix)
    check("[translation-blend]" in said and "the mix 'top'" in said and "the estimated error is" in said, f"blends, with an estimated error: {said}")


def test_depth():
    """Neither many layers nor shared ones crash or hang."""
    deep = RED + "".join(layer(f"n{i}", "red", f"n{i - 1}" if i else "red") for i in range(400))
    root, said = translate(deep, bsdf="n399")
    check(surface(root).tag == "open_pbr_surface" or "[too-many-slabs]" in said, "400 layers")
    cycle = layer("a", "b", "b") + layer("b", "a", "a")
    path = PLACE / "in.mtlx"
    path.write_text(f'<?xml version="1.0"?><materialx version="1.39">{cycle}<surface name="S" type="surfaceshader">{port("bsdf", "BSDF", node="a")}</surface></materialx>')
    done = run("translate", path, "--to", "gltf_pbr")
    check(done.returncode == 1 and "[cycle]" in done.stderr, f"a cycle is an error: {done.stderr[:200]}")


def test_documents():
    """Every document of closures becomes one that generates."""
    documents = [ROOT / "examples" / name for name in ("slabs.mtlx", "slab_helpers.mtlx", "car_paint.mtlx", "frosted.mtlx")]
    if FURTHER.is_dir():
        documents += sorted(FURTHER.glob("pbrlib/bsdf/*.mtlx")) + sorted(FURTHER.glob("pbrlib/surfaceshader/lama/*.mtlx"))
    else:
        skip(f"{FURTHER} is absent")
    out = PLACE / "out.mtlx"
    for path in documents:
        out.unlink(missing_ok=True)
        done = run("translate", path, "--to", "gltf_pbr", "-o", out)
        check(done.returncode == 0, f"{path.name}: {done.stderr[:300]}")
        made = run(out, "--target", "glsl", "-o", PLACE / "shaders")
        check(made.returncode == 0 or "[no-renderables]" in made.stderr, f"{path.name} as gltf_pbr does not generate: {made.stderr[:300]}")


test_values()
test_matter()
test_slabs()
test_connections()
test_losses()
test_depth()
test_documents()
finish("translate-closures")
