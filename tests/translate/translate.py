#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""mxgen translate: values that models share stay exact, there and back; graphs, normals, losses; every document becomes one that
generates. Arguments: mxgen, the root of the project, a folder of further documents (skipped if it is absent)."""
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish, skip

MXGEN, ROOT, FURTHER = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
MODELS = ["standard_surface", "open_pbr_surface", "gltf_pbr", "UsdPreviewSurface", "disney_principled"]
FOLDER = tempfile.TemporaryDirectory()
PLACE = pathlib.Path(FOLDER.name)


def run(*arguments):
    return subprocess.run([MXGEN, *map(str, arguments)], capture_output=True, text=True, check=False)


def translate(text, model, what, wants=0):
    """The new document, and what mxgen says."""
    path = PLACE / "in.mtlx"
    path.write_text(text if text.startswith("<?xml") else f'<?xml version="1.0"?><materialx version="1.39">{text}</materialx>', encoding="utf-8")
    done = run("translate", path, "--to", model)
    check(done.returncode == wants, f"{what} to {model}: exit code {done.returncode}: {done.stderr[:300]}")
    return (ET.fromstring(done.stdout) if done.stdout else ET.Element("materialx")), done.stderr, done.stdout


def surface(root, name="S"):
    return next((node for node in root.iter() if node.get("name") == name), ET.Element("none"))


def values(root, name="S"):
    return {port.get("name"): [float(x) if x not in ("true", "false") else x for x in port.get("value").replace(" ", "").split(",")]
            for port in surface(root, name).findall("input") if port.get("value") is not None}


def flat(model, inputs):
    ports = "".join(f'<input name="{n}" type="{t}" value="{v}"/>' for n, (t, v) in inputs.items())
    return f'<{model} name="S" type="surfaceshader">{ports}</{model}>'


# Each model's inputs with values that are no defaults, by a meaning that models share.
SHARED = {
    "standard_surface": {"color": ("base_color", "color3"), "metal": ("metalness", "float"), "rough": ("specular_roughness", "float"),
                         "ior": ("specular_IOR", "float"), "coat": ("coat", "float"), "coat rough": ("coat_roughness", "float"),
                         "glow": ("emission_color", "color3"), "glow strength": ("emission", "float"), "sheen": ("sheen", "float"),
                         "transmission": ("transmission", "float"), "subsurface": ("subsurface", "float"), "diffuse": ("diffuse_roughness", "float"),
                         "film ior": ("thin_film_IOR", "float"), "specular color": ("specular_color", "color3")},
    "open_pbr_surface": {"color": ("base_color", "color3"), "metal": ("base_metalness", "float"), "rough": ("specular_roughness", "float"),
                         "ior": ("specular_ior", "float"), "glow": ("emission_color", "color3"), "glow strength": ("emission_luminance", "float"),
                         "sheen": ("fuzz_weight", "float"), "transmission": ("transmission_weight", "float"),
                         "subsurface": ("subsurface_weight", "float"), "diffuse": ("base_diffuse_roughness", "float"),
                         "film ior": ("thin_film_ior", "float"), "specular color": ("specular_color", "color3")},
    "gltf_pbr": {"color": ("base_color", "color3"), "metal": ("metallic", "float"), "rough": ("roughness", "float"), "ior": ("ior", "float"),
                 "coat": ("clearcoat", "float"), "coat rough": ("clearcoat_roughness", "float"), "glow": ("emissive", "color3"),
                 "glow strength": ("emissive_strength", "float"), "transmission": ("transmission", "float")},
    "UsdPreviewSurface": {"color": ("diffuseColor", "color3"), "metal": ("metallic", "float"), "rough": ("roughness", "float"),
                          "ior": ("ior", "float"), "coat": ("clearcoat", "float"), "coat rough": ("clearcoatRoughness", "float")},
    "disney_principled": {"color": ("baseColor", "color3"), "metal": ("metallic", "float"), "rough": ("roughness", "float"),
                          "coat": ("clearcoat", "float"), "sheen": ("sheen", "float"), "transmission": ("specTrans", "float"),
                          "subsurface": ("subsurface", "float")},
}
NUMBERS = {"color": "0.125, 0.7, 0.31", "metal": "0.375", "rough": "0.43", "ior": "1.37", "coat": "0.8", "coat rough": "0.17", "glow": "0.2, 0.3, 0.9",
           "glow strength": "2.5", "sheen": "0.6", "transmission": "0.3", "subsurface": "0.45", "diffuse": "0.21", "film ior": "1.8",
           "specular color": "0.9, 0.8, 0.7"}
# A meaning shows only beside others: the index of a film needs a film.
BESIDE = {"coat rough": ["coat"], "glow strength": ["glow"]}
EXTRA = {"standard_surface": {"film ior": ("thin_film_thickness", "float", "300"), "glow": ("emission", "float", "1")},
         "open_pbr_surface": {"film ior": ("thin_film_weight", "float", "1"), "glow": ("emission_luminance", "float", "1")},
         "gltf_pbr": {"ior": ("metallic", "float", "0"), "transmission": ("metallic", "float", "0")}}


def alone(model, meaning):
    """A surface with one meaning, and what it shows beside; with two of one meaning that would change each other, it is not exact."""
    inputs = {}
    for one in [meaning, *BESIDE.get(meaning, [])]:
        name, kind = SHARED[model][one]
        inputs[name] = (kind, NUMBERS[one])
    if meaning in EXTRA.get(model, {}):
        name, kind, value = EXTRA[model][meaning]
        inputs.setdefault(name, (kind, value))
    return inputs


def same(a, b):
    return a is not None and b is not None and len(a) == len(b) and all(x == y for x, y in zip(a, b))


def test_exact():
    for source in MODELS:
        for meaning in SHARED[source]:
            for target in MODELS:
                if target == source or meaning not in SHARED[target]:
                    continue
                inputs = alone(source, meaning)
                if meaning in ("coat rough", "coat") and source == "UsdPreviewSurface":
                    inputs["ior"] = ("float", "1.5") # its coat has the index of the base
                what = f"{source}, {meaning}"
                there, _, text = translate(flat(source, inputs), target, what)
                wanted = [float(x) for x in NUMBERS[meaning].split(",")]
                is_below_coat = meaning in ("color",) and "coat" in inputs
                found = values(there).get(SHARED[target][meaning][0])
                check(is_below_coat or same(found, wanted), f"{what} to {target}: {wanted} becomes {found}")
                back, _, _ = translate(text, source, f"{what} from {target}")
                found = values(back).get(SHARED[source][meaning][0])
                check(same(found, wanted), f"{what} to {target} and back: {wanted} becomes {found}")


GRAPH = """<nodegraph name="G"><image name="i" type="color3"><input name="file" type="filename" value="none.png"/></image>
  <image name="n" type="vector3"><input name="file" type="filename" value="none.png"/></image>
  <normalmap name="m" type="vector3"><input name="in" type="vector3" nodename="n"/>SCALE</normalmap>
  <extract name="e" type="float"><input name="in" type="color3" nodename="i"/></extract>
  <output name="color" type="color3" nodename="i"/><output name="number" type="float" nodename="e"/>
  <output name="normal" type="vector3" nodename="m"/></nodegraph>"""


def test_graphs():
    ports = '<input name="base_color" type="color3" nodegraph="G" output="color"/><input name="normal" type="vector3" nodegraph="G" output="normal"/>'
    text = GRAPH.replace("SCALE", "") + f'<standard_surface name="S" type="surfaceshader">{ports}</standard_surface>'
    root, _, _ = translate(text, "gltf_pbr", "a texture")
    port = {p.get("name"): p for p in surface(root)}
    check(port["base_color"].get("nodegraph") == "G" and port["base_color"].get("output") == "color", "a texture stays connected")
    check(port["normal"].get("output") == "normal", "a normal stays connected")
    check(not [g for g in root.findall("nodegraph") if g.get("name") != "G"], "what passes through needs no graph")
    # a weight makes a graph of the translation's own
    root, _, _ = translate(text.replace("</standard_surface>", '<input name="base" type="float" nodegraph="G" output="number"/></standard_surface>'),
                           "gltf_pbr", "a weighted texture")
    graph = next(g for g in root.findall("nodegraph") if g.get("name") == "NG_S_gltf_pbr")
    check([n.tag for n in graph] == ["input", "input", "multiply", "output"], f"a product of inputs is one node: {[n.tag for n in graph]}")
    check(graph.find("output").get("name") == "base_color_out", "the output has the name of its input")
    # UsdPreviewSurface has its normal in tangent space
    root, _, usd = translate(text, "UsdPreviewSurface", "a normal map")
    graph = next(g for g in root.findall("nodegraph") if g.get("name") == "NG_S_UsdPreviewSurface")
    check([n.tag for n in graph] == ["input", "multiply", "add", "output"], "the map leaves <normalmap>")
    check(root.find("nodegraph[@name='G']/output[@name='map_out']").get("nodename") == "n", "the graph of the map gives it out")
    root, _, _ = translate(usd, "standard_surface", "a normal in tangent space")
    graph = next(g for g in root.findall("nodegraph") if g.get("name") == "NG_S_standard_surface")
    check([n.tag for n in graph][-2:] == ["normalmap", "output"], "the map enters <normalmap>")
    scaled = text.replace("</normalmap>", '<input name="scale" type="float" value="0.5"/></normalmap>')
    root, _, _ = translate(scaled, "UsdPreviewSurface", "a scaled normal map")
    check(root.find(".//multiply/input[@name='in2']").get("value") == "1.0, 1.0, 2.0", "the scale is part of the product")
    _, said, _ = translate(text.replace("normalmap", "normalize"), "UsdPreviewSurface", "a normal of the world")
    check("'normal' of <standard_surface>" in said and "[translation-loss]" in said, "a normal of the world is told")
    idle = text.split("<standard_surface")[0] + '<standard_surface name="S" type="surfaceshader"><input name="coat_roughness" type="float" nodegraph="G" output="number"/></standard_surface>'
    root, _, _ = translate(idle, "gltf_pbr", "an idle texture")
    check([g.get("name") for g in root.findall("nodegraph")] == ["G"], "a graph that nothing reads is not written")
    # a surface inside of a graph
    inside = GRAPH.replace("SCALE", "").replace('<output name="normal" type="vector3" nodename="m"/></nodegraph>',
                           '<standard_surface name="S" type="surfaceshader"><input name="base_color" type="color3" nodename="i"/>'
                           '<input name="base" type="float" nodename="e"/></standard_surface><output name="out" type="surfaceshader" nodename="S"/></nodegraph>')
    root, _, text = translate(inside, "gltf_pbr", "a surface in a graph")
    check(root.find("nodegraph[@name='G']/S_multiply") is None and root.find("nodegraph[@name='G']/multiply[@name='S_multiply']") is not None,
          "its nodes stand beside it")
    check(root.find("nodegraph[@name='G']/gltf_pbr/input[@name='base_color']").get("nodename") == "S_multiply", "and it reads them")


def test_choices():
    text = GRAPH.replace("SCALE", "") + '<standard_surface name="S" type="surfaceshader"><input name="opacity" type="color3" nodegraph="G" output="color"/></standard_surface>'
    root, _, _ = translate(text, "gltf_pbr", "a textured opacity")
    check(values(root).get("alpha_mode") == [2], "a textured opacity blends")
    root, _, _ = translate(flat("standard_surface", {"opacity": ("color3", "1, 1, 1")}), "gltf_pbr", "an opaque surface")
    check("alpha_mode" not in values(root), "an opaque surface has no mode of its own")
    text = GRAPH.replace("SCALE", "") + '<standard_surface name="S" type="surfaceshader"><input name="specular_IOR" type="float" nodegraph="G" output="number"/></standard_surface>'
    root, said, _ = translate(text, "gltf_pbr", "a textured index")
    check("'ior' of 'gltf_pbr' is uniform" in said and "[translation-varies]" in said and "ior" not in values(root), "a uniform input takes no texture, and that is told")


def test_losses():
    _, said, _ = translate(flat("standard_surface", {"thin_film_thickness": ("float", "300")}), "UsdPreviewSurface", "a film")
    check("in.mtlx:1:" in said and "'thin_film_thickness' of <standard_surface>" in said, f"a film is told: {said[:200]}")
    _, said, _ = translate(flat("standard_surface", {"thin_film_IOR": ("float", "1.9"), "coat_roughness": ("float", "0.5"), "sheen_color": ("color3", "1, 0, 0")}),
                           "UsdPreviewSurface", "idle inputs")
    check("translation-loss" not in said, f"an input without effect is no loss: {said[:300]}")
    _, said, _ = translate(flat("standard_surface", {"metalness": ("float", "1"), "specular_color": ("color3", "1, 0, 0")}), "gltf_pbr", "an edge")
    check("'specular_color' of <standard_surface>" in said, "an input that only idle inputs take is a loss")
    _, said, _ = translate(flat("standard_surface", {}), "gltf", "a wrong name", 1)
    check("did you mean 'gltf_pbr'?" in said and "[unknown-model]" in said, "a model is suggested")
    _, said, _ = translate(flat("standard_surface", {}).replace('"S"', '"1 2"'), "gltf_pbr", "a name with a blank", 1)
    check("in.mtlx:1:" in said and "[translation-name]" in said, "a name that no new surface can have is told")
    _, said, _ = translate('<standard_surface type="surfaceshader"/>', "gltf_pbr", "no name", 1)
    check("[name-missing]" in said, "a surface without a name is told")
    for inputs, ident in ({"base": ("float", "x")}, "bad-value"), ({"base": ("color3", "1, 1, 1")}, "input-type"):
        _, said, _ = translate(flat("standard_surface", inputs), "gltf_pbr", "a fault", 1)
        check("in.mtlx:1:" in said and f"[{ident}]" in said, f"a fault of the surface is told in its place: {said[:200]}")
    root, said, _ = translate(flat("standard_surface", {"metalness": ("float", "1e99")}), "gltf_pbr", "an infinite number")
    check("[translation-op]" in said and "metallic" not in values(root), "an infinite number is told")
    twice = flat("standard_surface", {"metalness": ("float", "0.5")}) + flat("standard_surface", {"metalness": ("float", "0.25")})
    root, _, _ = translate(twice, "gltf_pbr", "two of one name")
    check(len(root) == 1 and values(root).get("metallic") == [0.5], "the first of two of one name counts")
    root, _, _ = translate(flat("gltf_pbr", {"alpha_mode": ("integer", "2"), "alpha": ("float", "0.5")}), "open_pbr_surface", "a mode by its number")
    check(values(root).get("geometry_opacity") == [0.5], "the mode BLEND has the number 2")
    _, said, _ = translate(flat("gltf_pbr", {"alpha_mode": ("integer", "BLEND")}), "open_pbr_surface", "a mode by its name", 1)
    check("[bad-value]" in said, "the value of an integer is a number, also where its enumeration has names")
    cycle = "".join(f'<nodegraph name="{a}"><output name="o" type="vector3" nodegraph="{b}" output="o"/></nodegraph>' for a, b in ("AB", "BA"))
    translate(cycle + '<standard_surface name="S" type="surfaceshader"><input name="normal" type="vector3" nodegraph="A" output="o"/></standard_surface>',
              "UsdPreviewSurface", "a cycle", 1)
    studio = '<nodedef name="ND_s" node="studio"><output name="out" type="surfaceshader"/></nodedef>' \
        '<nodedef name="ND_to" node="plain_to_studio" nodegroup="translation"><output name="a_out" type="float"/></nodedef>'
    _, said, _ = translate(studio + '<surface name="S" type="surfaceshader"/>', "studio", "closures", 1)
    check("in.mtlx:1:" in said and "[no-translation]" in said, "no way leads from slabs to a model with another source alone")


def test_inputs_of_others():
    """What no shader reads stays where the other model has it, and is told as lost elsewhere."""
    for occlusion in ('value="0.5"', 'nodename="T"'):
        text = '<image name="T" type="float"/><gltf_pbr name="S" type="surfaceshader">' \
            f'<input name="occlusion" type="float" {occlusion}/><input name="transmission" type="float" value="0.5"/><input name="thickness" type="float" value="0.1"/></gltf_pbr>'
        root, said, _ = translate(text, "UsdPreviewSurface", "an occlusion")
        kept = surface(root).find("input[@name='occlusion']")
        check(kept is not None and f'{kept.get("value")}{kept.get("nodename")}' in ("0.5None", "NoneT"), f"an occlusion stays: {occlusion}")
        check("'thickness' of <gltf_pbr> is for other programs" in said and "'occlusion'" not in said, f"a volume is lost, an occlusion is not: {said[:300]}")
        _, said, _ = translate(text, "standard_surface", "an occlusion")
        check("in.mtlx:1:" in said and "'occlusion' of <gltf_pbr> is for other programs" in said and "[translation-loss]" in said, f"a lost occlusion is told: {said[:300]}")
    _, said, _ = translate('<UsdPreviewSurface name="S" type="surfaceshader"><input name="occlusion" type="float" value="1.0"/></UsdPreviewSurface>', "standard_surface", "no occlusion")
    check("occlusion" not in said, "a default is no loss")


def test_inputs_of_renderers():
    """What renderers with closures read alone, and no raster, stays, there and back."""
    pairs = (("standard_surface", "subsurface", "subsurface_anisotropy"), ("open_pbr_surface", "subsurface_weight", "subsurface_scatter_anisotropy"))
    for (model, weight, name), (other, other_weight, other_name) in (pairs, pairs[::-1]):
        text = flat(model, {weight: ("float", "0.9"), name: ("float", "0.8")})
        root, said, _ = translate(text, other, name)
        check((values(root).get(other_weight), values(root).get(other_name)) == ([0.9], [0.8]), f"{name} stays as {other_name}: {values(root)}")
        _, said, _ = translate(text, "gltf_pbr", name)
        check(f"'{name}'" in said and "[translation-loss]" in said, f"{name} is told where it is lost: {said[:300]}")


def test_coloured_opacity():
    """The luminance counts, as the model draws it; a grey is exact."""
    for model, name in (("open_pbr_surface", "geometry_opacity"), ("gltf_pbr", "alpha"), ("UsdPreviewSurface", "opacity")):
        for colour, wanted in (("0, 1, 0", 0.6740818), ("0, 0, 1", 0.0536895), ("0.3, 0.3, 0.3", 0.3)):
            root, _, _ = translate(flat("standard_surface", {"opacity": ("color3", colour)}), model, "an opacity")
            found = values(root).get(name, [None])[0]
            check(found is not None and abs(found - wanted) <= (0 if wanted == 0.3 else 1e-6), f"opacity {colour} is {found} as {name}")


def test_spaces():
    inputs = {"base_color": ("color3", "0.5, 0.5, 0.5"), "metalness": ("float", "0.5")}
    text = f'<?xml version="1.0"?><materialx version="1.39" colorspace="srgb_texture">{flat("standard_surface", inputs)}</materialx>'
    root, _, _ = translate(text, "gltf_pbr", "a colour space")
    port = surface(root).find("input[@name='base_color']")
    check(port.get("colorspace") == "lin_rec709" and abs(values(root)["base_color"][0] - 0.21404114) < 1e-5, "a colour is linear, and says so")
    check(surface(root).find("input[@name='metallic']").get("colorspace") is None, "a number has no space")


STUDIO = """<nodedef name="ND_plain" node="plain"><input name="hue" type="color3" value="0.2, 0.4, 0.6"/><output name="out" type="surfaceshader"/></nodedef>
<nodegraph name="NG_plain" nodedef="ND_plain"><oren_nayar_diffuse_bsdf name="d" type="BSDF"><input name="color" type="color3" interfacename="hue"/></oren_nayar_diffuse_bsdf>
<surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="d"/></surface><output name="out" type="surfaceshader" nodename="s"/></nodegraph>
<nodedef name="ND_plain_to_standard_surface" node="plain_to_standard_surface" nodegroup="translation"><input name="hue" type="color3" value="1, 1, 1"/>
<output name="base_color_out" type="color3"/><output name="specular_out" type="float"/></nodedef>
<nodegraph name="NG_plain_to" nodedef="ND_plain_to_standard_surface"><constant name="none" type="float"/><dot name="same" type="color3"><input name="in" type="color3" interfacename="hue"/></dot>
<output name="base_color_out" type="color3" nodename="same"/><output name="specular_out" type="float" nodename="none"/></nodegraph>
<plain name="S" type="surfaceshader"/>"""


def test_studio():
    root, _, _ = translate(STUDIO, "gltf_pbr", "a model of the document")
    check(values(root) .get("base_color") == [0.2, 0.4, 0.6] and values(root).get("specular") == [0], "a translation of the document leads on, with the model's defaults")


def test_files():
    (PLACE / "deep").mkdir()
    (PLACE / "in.mtlx").write_text('<?xml version="1.0"?><materialx version="1.39" fileprefix="tex/">' + GRAPH.replace("SCALE", "").replace('name="G"', 'name="G" fileprefix="more/"')
                                   + flat("standard_surface", {}) + "</materialx>", encoding="utf-8")
    out = PLACE / "deep" / "out.mtlx"
    done = run("translate", PLACE / "in.mtlx", "--to", "gltf_pbr", "-o", out)
    root = ET.parse(out).getroot() if done.returncode == 0 else ET.Element("none")
    check(root.get("fileprefix") == "../tex/" and root.find("nodegraph").get("fileprefix") == "../more/", "files are found from the new place")
    before = (PLACE / "in.mtlx").read_bytes()
    done = run("translate", PLACE / "in.mtlx", "--to", "gltf_pbr", "-o", PLACE / "in.mtlx")
    check(done.returncode == 1 and (PLACE / "in.mtlx").read_bytes() == before, "the output is not the input")
    check(run("translate", PLACE / "in.mtlx").returncode == 2, "--to is needed")
    check(run("translate", PLACE / "in.mtlx", "--to", "gltf_pbr", "--accept", "much").returncode == 2, "--accept is a number")


def translatable(path):
    text = path.read_text(encoding="utf-8", errors="replace")
    return any(f"<{model}" in text for model in MODELS)


def test_documents():
    examples = [ROOT / "examples" / name for name in ("gold.mtlx", "marble.mtlx", "textured.mtlx")]
    if FURTHER.is_dir():
        examples += sorted(path for path in FURTHER.glob("*/*.mtlx") if translatable(path))
    else:
        skip(f"{FURTHER} is absent")
    out = PLACE / "out.mtlx"
    for path in examples:
        for model in MODELS:
            out.unlink(missing_ok=True)
            done = run("translate", path, "--to", model, "-o", out)
            if "[include-missing]" in done.stderr:
                continue
            check(done.returncode == 0 and "[translation-op]" not in done.stderr, f"{path.name} to {model}: {done.stderr[:300]}")
            made = run(out, "--target", "glsl", "-o", PLACE / "shaders")
            check(made.returncode == 0 and "warning: translation" not in made.stderr, f"{path.name} as {model} does not generate: {made.stderr[:300]}")


test_exact()
test_graphs()
test_choices()
test_losses()
test_inputs_of_others()
test_inputs_of_renderers()
test_coloured_opacity()
test_spaces()
test_studio()
test_files()
test_documents()
finish("translate")
