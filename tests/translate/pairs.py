#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""mxgen translate where two models differ: values by the formulas of docs/translate.md, reckoned here, and what is told where a part of
an input is lost. Arguments: mxgen."""
import math
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish

MXGEN = sys.argv[1]
FOLDER = tempfile.TemporaryDirectory()
IMAGE = '<image name="T" type="float"><input name="file" type="filename" value="none.png"/></image>' \
    '<image name="C" type="color3"><input name="file" type="filename" value="none.png"/></image>'


def kind_of(value):
    if isinstance(value, bool):
        return "boolean", str(value).lower()
    if isinstance(value, int):
        return "integer", str(value)
    return ("float", repr(value)) if isinstance(value, float) else ("color3", ", ".join(map(str, value)))


def port(name, value):
    if value in ("T", "C"):
        return f'<input name="{name}" type="{"float" if value == "T" else "color3"}" nodename="{value}"/>'
    kind, text = kind_of(value)
    return f'<input name="{name}" type="{kind}" value="{text}"/>'


def translate(model, to, **inputs):
    """The inputs of the new surface that have values, those that are connected, and what mxgen says."""
    path = pathlib.Path(FOLDER.name, "in.mtlx")
    ports = "\n".join(port(*item) for item in inputs.items())
    path.write_text(f'<?xml version="1.0"?><materialx version="1.39">{IMAGE}<{model} name="S" type="surfaceshader">\n{ports}</{model}></materialx>', encoding="utf-8")
    done = subprocess.run([MXGEN, "translate", path, "--to", to], capture_output=True, text=True, check=False)
    check(done.returncode == 0, f"{model} to {to}, {inputs}: {done.stderr[:300]}")
    root = ET.fromstring(done.stdout) if done.returncode == 0 else ET.Element("materialx")
    new = next((node for node in root.iter() if node.get("name") == "S"), ET.Element("none"))
    found = {p.get("name"): p for p in new.findall("input")}
    values = {name: [float(x) for x in p.get("value").split(",")] for name, p in found.items() if p.get("value") not in (None, "true", "false")}
    return values, {name for name, p in found.items() if p.get("value") is None}, done.stderr


def near(found, wanted, what):
    wanted = wanted if isinstance(wanted, (list, tuple)) else [wanted]
    good = found is not None and len(found) == len(wanted) and all(math.isclose(a, b, rel_tol=2e-5, abs_tol=2e-6) for a, b in zip(found, wanted))
    check(good, f"{what}: {found} instead of {wanted}")


def is_told(said, path, model, what):
    check(f"'{path}' of <{model}>" in said and "[translation-loss]" in said, f"{what}: '{path}' of {model} is told: {said[:400]}")


def through(ior):
    return 4 * ior / (ior + 1) ** 2


def times(a, b):
    return [x * y for x, y in zip(a, b)]


COAT, GLOW = (0.2, 0.9, 0.3), (0.5, 0.25, 1.0)
NAMES = {"standard_surface": ("emission", "emission_color", "coat", "coat_color", "coat_IOR"),
         "open_pbr_surface": ("emission_luminance", "emission_color", "coat_weight", "coat_color", "coat_ior")}


def test_emission():
    for model, names in NAMES.items():
        for weight in (0.0, 0.5, 1.0):
            shade = [1 + (c * through(1.7) - 1) * weight for c in COAT]
            inputs = dict(zip(names, (2.0, GLOW, weight, COAT, 1.7)))
            values, _, _ = translate(model, "gltf_pbr", **inputs)
            near(values.get("emissive"), times(GLOW, shade), f"{model}, below a coat of weight {weight}, as gltf_pbr")
            near(values.get("emissive_strength"), 2, f"{model}, strength of the emission")
            values, _, _ = translate(model, "UsdPreviewSurface", **inputs)
            near(values.get("emissiveColor"), times(GLOW, [2 * x for x in shade]), f"{model}, below a coat of weight {weight}, as UsdPreviewSurface")
        values, _, _ = translate("gltf_pbr", model, emissive=GLOW, emissive_strength=3.0, clearcoat=0.5)
        near(values.get(names[0]), 3 / (1 + (through(1.5) - 1) * 0.5), f"what gltf_pbr emits above its coat is more below that of {model}")
        check(values.get(names[1]) == list(GLOW), "its colour stays")
        values, _, _ = translate("UsdPreviewSurface", model, emissiveColor=GLOW, ior=2.0, clearcoat=1.0)
        near(values.get(names[0]), 1 / through(2), f"what UsdPreviewSurface emits as {model}")
        mask, connected, said = translate(model, "gltf_pbr", **dict(zip(names, ("T", GLOW, 0.0))))
        check("emissive" in connected and "emissive_strength" not in mask and not said, f"a mask of lamps at {model} is part of the colour: {said[:300]}")
    path = '<uniform_edf name="e" type="EDF"><input name="color" type="color3" value="0.5, 0.25, 1"/></uniform_edf>' \
        '<slab name="s" type="BSDF"/><slab_coat name="c" type="BSDF"><input name="base" type="BSDF" nodename="s"/><input name="color" type="color3" value="0.9, 0.5, 0.5"/></slab_coat>' \
        '<surface name="S" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="c"/><input name="edf" type="EDF" nodename="e"/></surface>'
    file = pathlib.Path(FOLDER.name, "slabs.mtlx")
    file.write_text(f'<?xml version="1.0"?><materialx version="1.39">{path}</materialx>', encoding="utf-8")
    done = subprocess.run([MXGEN, "translate", file, "--to", "open_pbr_surface"], capture_output=True, text=True, check=False)
    new = {p.get("name"): p.get("value") for p in ET.fromstring(done.stdout).find("open_pbr_surface")}
    number = {name: [float(x) for x in new.get(name, fallback).split(",")] for name, fallback in (("coat_color", "1, 1, 1"), ("coat_ior", "1.6"), ("emission_color", "1, 1, 1"))}
    shade = [c * through(number["coat_ior"][0]) for c in number["coat_color"]]
    near(times(number["emission_color"], shade), list(GLOW), "what a surface emits on top of a coat goes through it in OpenPBR")


def test_transmission():
    glass = {"transmission": 0.8, "transmission_color": (0.2, 0.8, 0.3), "base_color": (0.8, 0.3, 0.1), "base": 1.0}
    flat, _, _ = translate("standard_surface", "disney_principled", **glass)
    deep, _, said = translate("standard_surface", "disney_principled", transmission_depth=2.0, **glass)
    near(deep.get("baseColor"), [b * 0.2 + t * 0.8 for b, t in zip(glass["base_color"], glass["transmission_color"])], "disney_principled has the tint, whatever the depth is")
    check(deep == flat, "the depth changes no value")
    is_told(said, "transmission_depth", "standard_surface", "a depth")
    volume = {"transmission": 1.0, "metallic": 0.0, "base_color": (0.8, 0.3, 0.1), "thickness": 1.0, "attenuation_distance": 2.0, "attenuation_color": (0.1, 0.9, 0.5)}
    tint = times(volume["base_color"], volume["attenuation_color"])
    for model in ("standard_surface", "open_pbr_surface"):
        values, _, _ = translate("gltf_pbr", model, **volume)
        near(values.get("transmission_color"), tint, f"the tint of glass and of its volume in {model}")
        near(values.get("transmission_depth"), 2, "the depth")
    values, _, said = translate("gltf_pbr", "disney_principled", **volume)
    near(values.get("baseColor"), tint, "and in disney_principled")
    is_told(said, "S/transmission_depth", "standard_surface", "the depth of a volume")


def test_metal():
    color = (0.9, 0.6, 0.2)
    for metalness, weight in ((1.0, 0.5), (0.25, 0.5), (1.0, 1.5), (0.0, 0.5)):
        factor = 1 + (min(weight, 1) - 1) * metalness
        inputs = {"base_color": color, "base_weight": 0.8, "base_metalness": metalness, "specular_weight": weight}
        values, _, said = translate("open_pbr_surface", "standard_surface", **inputs)
        near(values.get("base", [1]), 0.8 * factor, f"metal {metalness} with a weight of {weight}")
        check(values.get("base_color") == list(color) and not said, "its colour stays")
        for model, name in ("gltf_pbr", "base_color"), ("UsdPreviewSurface", "diffuseColor"), ("disney_principled", "baseColor"):
            values, _, said = translate("open_pbr_surface", model, **inputs)
            near(values.get(name), [0.8 * factor * c for c in color], f"metal {metalness} with a weight of {weight} as {model}")


def test_sheet():
    base, below, w = (0.5, 0.25, 0.125), (0.1, 0.2, 0.9), 0.8
    thin = {"base_color": base, "subsurface": w, "subsurface_color": below, "thin_walled": True}
    values, _, said = translate("standard_surface", "open_pbr_surface", subsurface_anisotropy=0.3, **thin)
    check(values.get("subsurface_scatter_anisotropy") == [1] and values.get("subsurface_weight") == [w] and not said, f"all of standard_surface goes through: {values}")
    for g in (-0.5, 0.0, 1.0):
        for metal in (0.0, 0.5, 1.0):
            inputs = {"base_color": base, "base_weight": 0.5, "base_metalness": metal, "subsurface_weight": w, "subsurface_color": below,
                      "subsurface_scatter_anisotropy": g, "geometry_thin_walled": True}
            values, _, said = translate("open_pbr_surface", "standard_surface", **inputs)
            passes = w * (1 + g) / 2
            near(values.get("subsurface", [passes * (metal == 1)]), passes, f"the share that goes through with g = {g}")
            part, passes = w * (1 - metal), passes * (1 - metal) # metal keeps its colour
            left = [((1 - part) * 0.5 * b + part * c * (1 - g) / 2) / (1 - passes) for b, c in zip(base, below)]
            near(times(values.get("base_color"), values.get("base", [1]) * 3), left, f"what is left with g = {g}, metal {metal}")
            check(metal == 1 or not said, f"nothing is lost: {said[:300]}")
    values, _, _ = translate("open_pbr_surface", "standard_surface", base_color=base, subsurface_weight=w, subsurface_color=below, subsurface_scatter_anisotropy=1.0, geometry_thin_walled=True)
    check(values.get("base_color") == list(base) and values.get("subsurface") == [w], f"there and back a sheet is exact: {values}")
    values, _, _ = translate("open_pbr_surface", "standard_surface", base_weight=0.5, subsurface_weight=w, subsurface_scatter_anisotropy=0.3)
    check(values.get("base") == [0.5] and values.get("subsurface_anisotropy") == [0.3], "matter that is no sheet keeps its values")


def test_specular_workflow():
    """The new surface reflects as much of each colour facing the viewer as the old one: u d + (1 - u d) B."""
    for base, f0 in (((0.8, 0.3, 0.1), (0.1, 0.4, 0.9)), ((0.0, 0.0, 0.0), (1.0, 0.77, 0.34)), ((0.8, 0.3, 0.1), (1.0, 0.5, 0.1)), ((0.5, 0.5, 0.5), (0.6, 0.0, 0.0))):
        source = {"diffuseColor": base, "useSpecularWorkflow": 1, "specularColor": f0}
        wanted = [f + (1 - f) * b for f, b in zip(f0, base)]
        for model, color, metal, default in (("standard_surface", "base_color", "metalness", 0), ("open_pbr_surface", "base_color", "base_metalness", 0), ("disney_principled", "baseColor", "metallic", 0)):
            values, _, said = translate("UsdPreviewSurface", model, **source)
            d = 0.2 * (1 - values.get(metal, [default])[0])
            found = [d + (1 - d) * b for b in values.get(color, [0.8] * 3)]
            near(found, wanted, f"{f0} above {base} as {model}")
            check(not said, f"nothing is lost: {said[:300]}")
        for ior in (1.5, 2.0, 1.0):
            values, _, said = translate("UsdPreviewSurface", "gltf_pbr", ior=ior, **source)
            reflectance = ((values.get("ior", [1.5])[0] - 1) / (values.get("ior", [1.5])[0] + 1)) ** 2
            near([c * reflectance for c in values.get("specular_color", [1] * 3)], list(f0), f"gltf_pbr has the reflectance {f0} itself, ior {ior}")
            near(values.get("base_color"), list(base), "and the colour below it")
            check(values.get("metallic") == [0] and (ior == 1 or values.get("ior", [1.5]) == [ior]) and not said, f"no metal, the index stays: {values} {said[:300]}")
    values, connected, said = translate("UsdPreviewSurface", "gltf_pbr", useSpecularWorkflow=1, specularColor="C")
    check("specular_color" in connected and "ior" not in values and not said, f"a texture of the reflectance stays one: {values} {said[:300]}")
    base, f0 = (0.8, 0.3, 0.1), (0.05, 0.1, 0.2)
    values, _, _ = translate("UsdPreviewSurface", "standard_surface", diffuseColor=base, useSpecularWorkflow=1, specularColor=f0)
    near(values.get("base_color"), [b * (1 - f) / 0.8 for b, f in zip(base, f0)], "a dielectric with a tint lets as much through")
    near(values.get("specular_color"), (0.25, 0.5, 1), "its tint")
    values, _, _ = translate("UsdPreviewSurface", "standard_surface", diffuseColor=base, useSpecularWorkflow=1, specularColor=(0.04, 0.04, 0.04))
    check(values.get("base_color") == list(base) and "metalness" not in values, "a grey one keeps the colour")


def test_masks():
    for threshold in (0.01, 0.4, 0.5, 0.9):
        values, connected, said = translate("UsdPreviewSurface", "gltf_pbr", opacity="T", opacityThreshold=threshold)
        check(values.get("alpha_mode") == [1] and values.get("alpha_cutoff", [0.5]) == [threshold] and "alpha" in connected and not said, f"a mask above {threshold} stays one: {values}")
        values, connected, _ = translate("gltf_pbr", "UsdPreviewSurface", alpha="T", alpha_mode=1, alpha_cutoff=threshold)
        check(values.get("opacityMode") == [1] and "opacity" in connected, f"a mask above {threshold} cuts: {values}")
        values, connected, _ = translate("standard_surface", "gltf_pbr", opacity="C")
        check(values.get("alpha_mode") == [2] and "alpha" in connected, f"an opacity blends: {values}")
    values, connected, _ = translate("UsdPreviewSurface", "gltf_pbr", opacity="T", opacityMode=1)
    check(values.get("alpha_mode") == [2] and "alpha" in connected, f"presence of a texture blends: {values}")
    values, connected, _ = translate("UsdPreviewSurface", "gltf_pbr", opacity="T")
    check("alpha_mode" not in values and "transmission" in connected, f"an opacity that refracts is no mask: {values}")
    values, _, _ = translate("UsdPreviewSurface", "gltf_pbr", opacity=0.25, opacityMode=1)
    check(values.get("alpha_mode") == [2] and values.get("alpha") == [0.25], "presence blends")


def test_sheen():
    """The sheen of standard_surface is a part of its dielectric, so metal and glass have none; fuzz of the other two lies on top."""
    for metalness, transmission in ((0.0, 0.0), (0.25, 0.0), (0.0, 0.5), (0.25, 0.5), (1.0, 0.0), (0.0, 1.0)):
        inputs = {"sheen": 0.8, "sheen_color": (0.5, 0.25, 1.0), "metalness": metalness, "transmission": transmission}
        weight = 0.8 * (1 - metalness) * (1 - transmission)
        values, _, said = translate("standard_surface", "gltf_pbr", **inputs)
        near(values.get("sheen_color", [0] * 3), [weight * c for c in (0.5, 0.25, 1.0)], f"sheen of metal {metalness}, glass {transmission} as gltf_pbr")
        check(not said, f"nothing is lost: {said[:300]}")
        values, _, said = translate("standard_surface", "open_pbr_surface", **inputs)
        near(values.get("fuzz_weight", [0]), weight, f"sheen of metal {metalness}, glass {transmission} as open_pbr_surface")
        check(not said, f"nothing is lost: {said[:300]}")
    for model, fuzz, metal in (("open_pbr_surface", "fuzz_weight", {"base_metalness": 1.0}), ("gltf_pbr", "sheen_color", {"metallic": 1.0}),
                               ("open_pbr_surface", "fuzz_weight", {"transmission_weight": 1.0})):
        _, _, said = translate(model, "standard_surface", **{fuzz: (0.9, 0.5, 0.2) if model == "gltf_pbr" else 0.8}, **metal)
        is_told(said, fuzz, model, "fuzz that lies on metal or glass")


def test_principled():
    for ior in (1.02, 1.1, 1.33, 1.5, 2.0):
        for specular in (0.25, 0.5, 1.0):
            own = ((ior - 1) / (ior + 1)) ** 2
            for glass in (0.0, 1.0):
                values, _, _ = translate("disney_principled", "standard_surface", specular=specular, ior=ior, specTrans=glass)
                found_ior, weight = values.get("specular_IOR", [1.5])[0], values.get("specular", [1])[0]
                found = weight * ((found_ior - 1) / (found_ior + 1)) ** 2
                near([found], min(0.08 * specular, own) if glass else 0.08 * specular, f"specular {specular} with an index of {ior}, {'glass' if glass else 'opaque'}")
                check(0 <= weight <= 1.0001 and (not glass or found_ior == ior), f"a weight is at most 1: {weight}")


def test_parts():
    """A part of an input that is lost behind the first step of a chain is told with the input of the surface between."""
    for source, target, inputs, path in (
            ("gltf_pbr", "disney_principled", {"sheen_color": (0.1, 0.3, 0.9), "metallic": 0.0}, "S/sheen_color"),
            ("gltf_pbr", "UsdPreviewSurface", {"base_color": (0.8, 0.3, 0.1), "transmission": 0.7, "metallic": 0.0}, "S/transmission_color"),
            ("disney_principled", "UsdPreviewSurface", {"specTrans": 0.7, "baseColor": (0.8, 0.3, 0.1)}, "S/transmission_color"),
            ("UsdPreviewSurface", "disney_principled", {"useSpecularWorkflow": 1, "specularColor": (0.02, 0.05, 0.15)}, "S/specular_color")):
        _, _, said = translate(source, target, **inputs)
        is_told(said, path, "standard_surface", f"{source} to {target}")
        check(said.count("[translation-loss]") == 1 and "in.mtlx:" in said, f"once, at its place: {said[:400]}")
    for source, target, inputs in (
            ("gltf_pbr", "disney_principled", {"sheen_color": (0.9, 0.9, 0.9), "metallic": 0.0}),
            ("gltf_pbr", "UsdPreviewSurface", {"base_color": (0.8, 0.3, 0.1)}),
            ("UsdPreviewSurface", "disney_principled", {"useSpecularWorkflow": 1, "specularColor": (0.04, 0.04, 0.04), "clearcoat": 0.5, "metallic": 0.5})):
        _, _, said = translate(source, target, **inputs)
        check("translation-loss" not in said, f"{source} to {target} loses nothing: {said[:400]}")
    for more in {"opacityThreshold": 0.5}, {"opacityMode": 1}:
        _, _, said = translate("UsdPreviewSurface", "disney_principled", opacity=0.4, **more)
        is_told(said, "opacity", "UsdPreviewSurface", f"an opacity that is no transmission, {more}")
    _, _, said = translate("standard_surface", "gltf_pbr", transmission=0.5, transmission_depth="T")
    check("keeps its default 0.0 [translation-varies]" in said, f"an input without a default has 0: {said[:300]}")


def test_defaults():
    """Light below the surface is lost in models without it by the default of the radius, too, and not where the radius is 0."""
    for source, weight, radius, zero, thin in (("standard_surface", "subsurface", "subsurface_radius", (0, 0, 0), "thin_walled"),
                                               ("open_pbr_surface", "subsurface_weight", "subsurface_radius", 0.0, "geometry_thin_walled"),
                                               ("disney_principled", "subsurface", "subsurfaceDistance", (0, 0, 0), None)):
        for target in "gltf_pbr", "UsdPreviewSurface":
            direct = source == "standard_surface" or (source, target) == ("open_pbr_surface", "gltf_pbr")
            told = (radius, source) if direct else ("S/subsurface_radius", "standard_surface")
            color = {} if source == "disney_principled" else {"subsurface_color": (0.5, 0.25, 0.125)}
            _, _, said = translate(source, target, **{weight: 0.5}, **color)
            is_told(said, *told, f"{source} to {target}, the default of the radius")
            check(said.count("radius' of") == 1 and "in.mtlx:1:" in said, f"once, at the surface: {said[:400]}")
            _, _, said = translate(source, target, **{weight: 0.5, radius: zero}, **color)
            check(not direct or "radius' of" not in said, f"{source} to {target}, a radius of 0 is none: {said[:300]}")
            _, _, said = translate(source, target)
            check(not said, f"{source} to {target} without it loses nothing: {said[:300]}")
            if thin:
                _, _, said = translate(source, target, **{weight: 0.5, thin: True})
                check("radius' of" not in said, f"{source} to {target}, a sheet has no radius: {said[:300]}")
    for target in "open_pbr_surface", "disney_principled":
        _, _, said = translate("standard_surface", target, subsurface=0.5)
        check(not said, f"{target} has a radius: {said[:300]}")


def luminance(color):
    return sum(a * b for a, b in zip(color, (0.2722287, 0.6740818, 0.0536895)))


def test_preview_glass():
    """gltf_pbr tints refracted light with the colour of diffuse light: the luminance of the diffuse light is exact, and of a grey all is."""
    for color in (0.5, 0.5, 0.5), (0.1, 0.1, 0.1), (1.0, 1.0, 1.0), (0.8, 0.2, 0.1), (0.02, 0.3, 0.05), (0.0, 0.0, 0.0):
        for opacity in (1.0, 0.75, 0.5, 0.1, 0.0):
            values, _, said = translate("UsdPreviewSurface", "gltf_pbr", diffuseColor=color, opacity=opacity)
            base, refracts = values.get("base_color", [1, 1, 1]), values.get("transmission", [0])[0]
            what = f"{color} of opacity {opacity}: {base}, {refracts}"
            near([(1 - refracts) * luminance(base)], [opacity * luminance(color)], f"diffuse light of {what}")
            check(all(0 <= x <= 1.00001 for x in base) and not said, f"a colour: {what} {said[:200]}")
            if len(set(color)) == 1:
                near([refracts * b for b in base], [1 - opacity] * 3, f"refracted light of {what}")
            if opacity == 1:
                check(base == list(color) and refracts == 0, f"an opaque one is exact: {what}")
            if opacity == 0:
                check(base == [1, 1, 1] and refracts == 1, f"glass is white: {what}")
    _, connected, said = translate("UsdPreviewSurface", "gltf_pbr", diffuseColor="C", opacity="T")
    check({"base_color", "transmission"} <= connected and not said, f"textures stay connected: {connected} {said[:300]}")


def test_off():
    """An input that changes nothing beside the values of others is no loss; with another value of one of them it is."""
    volume = {"thickness": 0.5, "attenuation_distance": 2.0, "attenuation_color": (0.2, 0.9, 0.3), "dispersion": 0.4}
    for source, target, weight, inputs in (
            ("gltf_pbr", "UsdPreviewSurface", {"transmission": 0.5}, volume),
            ("gltf_pbr", "UsdPreviewSurface", {"anisotropy_strength": 0.5, "roughness": 0.3}, {"anisotropy_rotation": 0.4}),
            ("standard_surface", "UsdPreviewSurface", {"transmission": 0.5}, {"transmission_depth": 2.0, "transmission_dispersion": 40.0}),
            ("standard_surface", "UsdPreviewSurface", {"transmission": 0.5, "transmission_scatter": (0.1, 0.2, 0.3)}, {"transmission_scatter_anisotropy": 0.5}),
            ("open_pbr_surface", "disney_principled", {"transmission_weight": 0.5, "transmission_depth": 1.0}, {"transmission_scatter": (0.2, 0.9, 0.3)}),
            ("open_pbr_surface", "disney_principled", {"transmission_weight": 0.5}, {"transmission_dispersion_scale": 1.0})):
        for name, value in inputs.items():
            _, _, said = translate(source, target, **{name: value})
            check(not said, f"{name} of {source} alone does nothing: {said[:300]}")
        _, _, said = translate(source, target, **weight, **inputs)
        for name in inputs:
            check(f"'{name}'" in said or f"/{name}'" in said, f"{name} of {source} with {weight} is told: {said[:600]}")
    for source, name in (("gltf_pbr", "alpha_mode"), ("UsdPreviewSurface", "opacityMode")):
        _, _, said = translate(source, "standard_surface", **{name: 1})
        check(not said, f"{name} of {source} without an opacity does nothing: {said[:300]}")
    for target in "standard_surface", "open_pbr_surface":
        values, _, said = translate("gltf_pbr", target, **volume)
        check(not said and not any(name.startswith("transmission") for name in values), f"a volume without transmission has no counterpart, and is no loss: {values} {said[:300]}")
    off, _, _ = translate("standard_surface", "gltf_pbr", transmission_depth=2.0, transmission_dispersion=40.0)
    check("thickness" not in off and "attenuation_distance" not in off and "dispersion" not in off, f"what is off is left out: {off}")
    on, _, _ = translate("standard_surface", "gltf_pbr", transmission=0.5, transmission_depth=2.0, transmission_dispersion=40.0)
    check(on.get("attenuation_distance") == [2] and "dispersion" in on, f"and stays where it is on: {on}")


test_emission()
test_preview_glass()
test_off()
test_defaults()
test_transmission()
test_metal()
test_sheet()
test_specular_workflow()
test_masks()
test_sheen()
test_principled()
test_parts()
finish("translate-pairs")
