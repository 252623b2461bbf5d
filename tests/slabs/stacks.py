#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Budgets of a stack of eight layers (docs/slots.md, docs/slabs.md): as one surface it looks as before, and its slabs become as few as the
budget says.

Arguments: mxgen, mxgen-render ('' to draw nothing)."""
import json
import pathlib
import re
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
import balls
from checks import check, finish, run, skip

MXGEN, RENDER = (pathlib.Path(arg).resolve() if arg else None for arg in sys.argv[1:3])
NUM_LAYERS = 8
STAGE = """#usda 1.0
def Sphere "ball" { double radius = 1 }
"""


def slab(name, albedo, roughness, more=""):
    return f"""<slab name="{name}" type="BSDF"><input name="diffuse_albedo" type="color3" value="{albedo}"/>
      <input name="roughness" type="float" value="{roughness}"/>{more}</slab>"""


def layer(i, surface, inputs):
    return f"""{surface}<substance name="layer_{i}" type="material"><input name="surfaceshader" type="surfaceshader"
      nodename="surface_{i}"/>{inputs}</substance>"""


def slab_layer(i):
    """Each layer has another colour and another part of the ball."""
    albedo = ", ".join(f"{0.1 + 0.1 * (i * k % 8):.1f}" for k in (1, 3, 5))
    mask = f"""<smoothstep name="mask_{i}" type="float"><input name="in" type="float" nodename="noise_{i}"/>
      <input name="low" type="float" value="0"/><input name="high" type="float" value="0.3"/></smoothstep>
      <multiply name="place_{i}" type="vector3"><input name="in1" type="vector3" nodename="place"/>
      <input name="in2" type="float" value="{1 + 0.4 * i}"/></multiply>
      <noise3d name="noise_{i}" type="float"><input name="position" type="vector3" nodename="place_{i}"/></noise3d>"""
    surface = slab(f"slab_{i}", albedo, 0.2 + 0.1 * i) + f"""<slab_surface name="surface_{i}" type="surfaceshader">
      <input name="bsdf" type="BSDF" nodename="slab_{i}"/></slab_surface>"""
    inputs = f'<input name="mask" type="float" nodename="mask_{i}"/>' if i else ""
    return mask + layer(i, surface, inputs)


# Layers that differ from the others: matter on a layer; another model with an opacity and light of its own; a normal.
COAT = slab("coat", "0, 0, 0", 0.05, '<input name="mean_free_path" type="vector3" value="0.05, 0.2, 0.4"/>') + """
  <slab_surface name="surface_coat" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="coat"/></slab_surface>
  <substance name="varnish" type="material"><input name="surfaceshader" type="surfaceshader" nodename="surface_coat"/>
    <input name="mask" type="float" value="0.7"/></substance>"""
GLOW = """<uniform_edf name="light" type="EDF"><input name="color" type="color3" value="0.2, 0.1, 0"/></uniform_edf>
  <burley_diffuse_bsdf name="matt" type="BSDF"/><surface name="surface_3" type="surfaceshader">
  <input name="bsdf" type="BSDF" nodename="matt"/><input name="edf" type="EDF" nodename="light"/><input name="opacity" type="float" value="0.5"/>
  </surface>"""
NORMAL = """<rotate3d name="bent" type="vector3"><input name="in" type="vector3" nodename="up"/><input name="amount" type="float" value="20"/>
  </rotate3d><normal name="up" type="vector3"><input name="space" type="string" value="world"/></normal>"""

CUT = """<extract name="across" type="float"><input name="in" type="vector3" nodename="place"/></extract>
  <ifgreater name="side" type="float"><input name="value1" type="float" nodename="across"/><input name="value2" type="float" value="0.1"/>
  <input name="in1" type="float" value="1"/></ifgreater>"""


def document(kind):
    """Eight layers: `slabs` alone, or with `others`, a vertical coat on the third, a `hole` in all, half of the ball `cut` away."""
    parts = [CUT] if kind == "cut" else []
    for i in range(NUM_LAYERS):
        part = slab_layer(i)
        if kind == "others" and i == 3:
            part = re.sub(r"<slab name.*</slab_surface>", GLOW, part, flags=re.S)
        if kind == "others" and i == 5:
            part = NORMAL + part.replace("</substance>", '<input name="normal" type="vector3" nodename="bent"/></substance>')
        if kind == "hole" and i == 6:
            part = part.replace("</substance>", '<input name="cutout" type="float" value="0.6"/></substance>')
        if kind == "cut" and i == 6:
            part = part.replace("</substance>", '<input name="cutout" type="float" nodename="side"/></substance>')
        if kind == "hole" and i == 0:
            part = part.replace("</substance>", '<input name="mask" type="float" value="0.4"/></substance>')
        parts.append(part)
    assigns = "".join(f'<materialassign slot="{10 * i:03}" material="layer_{i}" geom="/"/>' for i in range(NUM_LAYERS))
    if kind == "coat":
        parts.append(COAT)
        assigns += '<materialassign slot="020|010" material="varnish" geom="/"/>'
    look = f'<look name="L">{assigns}</look>'
    place = '<position name="place" type="vector3"><input name="space" type="string" value="object"/></position>'
    return f'<?xml version="1.0"?><materialx version="1.39">{place}{"".join(parts)}{look}</materialx>'


def generate(path, stage, out, *options):
    return run(MXGEN, path, "--stage", stage, "--target", "vulkan", "--interface", "reduced", "-o", out, "-Wbudget-step", *options)


def steps_of(text):
    return [tuple(map(int, step)) for step in re.findall(r"slabs (\d+) to (\d+), bytes (\d+) to (\d+)", text)]


def check_reports(kind, path, stage, num):
    sheet = run(MXGEN, "inspect", "--slabs", "--format", "json", "--interface", "reduced", path, "--stage", stage, "-e", "/ball")
    check(sheet.returncode == 0 and not sheet.stderr, f"{kind}: inspect --slabs: {sheet.stderr}")
    trees = json.loads(sheet.stdout or "{}").get("trees", [])
    check(len(trees) == 1, f"{kind}: the stack is {len(trees)} surfaces")
    tree = trees[0]
    kinds = [row["kind"] for row in tree["rows"]]
    check(tree["name"] == "stack" and tree["cost"]["closures"] == num, f"{kind}: {tree['name']}, {tree['cost']}")
    check(kinds.count("mix") == NUM_LAYERS - 1, f"{kind}: the layers are mixes: {kinds}")
    check(kinds.count("layer") == (1 if kind == "coat" else 0), f"{kind}: vertical layers are layers: {kinds}")
    for closures in (3, 2, 1):
        made = generate(path, stage, path.parent / "made", "--max-slabs", closures)
        steps = steps_of(made.stderr)
        check(made.returncode == 0 and steps and steps[-1][1] <= closures, f"{kind}: {closures} closures: {made.stderr}")
        check(all(b <= a and d <= c for a, b, c, d in steps), f"{kind}: a step raises the cost: {steps}")
    made = generate(path, stage, path.parent / "made", "--max-bytes", 16)
    check(made.returncode == 0 and steps_of(made.stderr)[-1][3] <= 16, f"{kind}: 16 bytes: {made.stderr}")
    made = generate(path, stage, path.parent / "made", "--max-error", 0.5)
    check(made.returncode == 0 and steps_of(made.stderr)[-1][1] < num, f"{kind}: an error of 0.5: {made.stderr}")


def draw(path, stage, name, *options):
    picture = path.parent / f"{name}.ppm"
    made = run(RENDER, path, "--stage", stage, "--look", "L", "-q", "-s", 64, "--camera", "0,0", "-o", picture, *options)
    if made.returncode and "no-device" in made.stderr:
        return None
    check(made.returncode == 0 and not made.stderr, f"render {name}: {made.stderr}")
    return picture if made.returncode == 0 else None


def check_pictures(kind, path, stage, num):
    """As one surface, and with one closure, which must not be the same."""
    whole, joined, one = (draw(path, stage, f"{kind}{closures}", *(("--max-slabs", closures) if closures else ()))
                          for closures in (0, num, 1))
    if not whole or not joined or not one:
        return False
    check(balls.compare(whole, joined) < 0.1, f"{kind}: one surface differs from the stack by {balls.compare(whole, joined)}")
    check(0 < balls.compare(whole, one) < 8, f"{kind}: one closure differs by {balls.compare(whole, one)}")
    return True


def check_cut(folder, stage):
    """A cut-out whose numbers are uniforms may have any opacity, unless an option says that it is a mask."""
    path = folder / "cut.mtlx"
    path.write_text(document("cut"))
    stores = ("--interface", "complete", "--role", "deferred")
    made = generate(path, stage, folder / "made", *stores)
    check("drawn-forward" in made.stderr, f"a cut-out of uniforms is stored: {made.stderr}")
    made = generate(path, stage, folder / "made", *stores, "--transparency", "mask")
    check(made.returncode == 0 and "drawn-forward" not in made.stderr, f"a mask of uniforms is not stored: {made.stderr}")
    if RENDER is None:
        return
    forward = draw(path, stage, "forward", "--interface", "complete")
    stored = draw(path, stage, "stored", *stores, "--transparency", "mask")
    whole = draw(folder / "slabs.mtlx", stage, "whole")
    if forward and stored and whole:
        check(balls.compare(forward, stored) < 0.5, f"the stored cut-out differs from forward by {balls.compare(forward, stored)}")
        check(balls.compare(whole, stored) > 5, f"nothing is cut away: {balls.compare(whole, stored)}")


# ---- Traced ----

MEDIA = """<slab name="milk" type="BSDF"><input name="diffuse_albedo" type="color3" value="0.8, 0.6, 0.9"/>
    <input name="mean_free_path" type="vector3" value="0.1, 0.05, 0.2"/></slab>
  <slab name="wax" type="BSDF"><input name="diffuse_albedo" type="color3" value="0.9, 0.5, 0.2"/>
    <input name="mean_free_path" type="vector3" value="0.3, 0.2, 0.1"/></slab>
  <slab name="gold" type="BSDF"><input name="f0" type="color3" value="0.9, 0.7, 0.3"/><input name="roughness" type="float" value="0.3"/></slab>
  <slab name="lamp" type="BSDF"><input name="f0" type="color3" value="0.9, 0.7, 0.3"/><input name="roughness" type="float" value="0.3"/>
    <input name="emission" type="color3" value="0.1, 0.2, 0.3"/></slab>
  <uniform_edf name="light" type="EDF"><input name="color" type="color3" value="0.1, 0.2, 0.3"/></uniform_edf>"""
# Surfaces that are not just a slab on a body.
SURFACES = {
    "foil": """<slab_surface name="surface_foil" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="milk"/>
      <input name="thin" type="boolean" value="true"/><input name="surface_thickness" type="float" value="0.03"/></slab_surface>""",
    "lit": """<surface name="surface_lit" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="gold"/>
      <input name="edf" type="EDF" nodename="light"/></surface>""",
}
# By kind: the layers of a stack, and the slabs of one surface that mean the same.
TRACED = {
    "a coat that scatters": ({"000": ("gold", 1), "000|010": ("milk", 0.7)}, """<slab_coverage name="some" type="BSDF">
      <input name="in" type="BSDF" nodename="milk"/><input name="weight" type="float" value="0.7"/></slab_coverage>
      <slab_layer name="all" type="BSDF"><input name="top" type="BSDF" nodename="some"/><input name="base" type="BSDF" nodename="gold"/>
      <input name="thickness" type="float" value="0.1"/></slab_layer>"""),
    "a body beside metal": ({"000": ("wax", 1), "010": ("gold", 0.4)}, """<slab_mix name="all" type="BSDF">
      <input name="fg" type="BSDF" nodename="gold"/><input name="bg" type="BSDF" nodename="wax"/>
      <input name="mix" type="float" value="0.4"/></slab_mix>"""),
    "a sheet on metal": ({"000": ("gold", 1), "010": ("foil", 0.6)}, """<slab_coverage name="some" type="BSDF">
      <input name="in" type="BSDF" nodename="milk"/><input name="weight" type="float" value="0.6"/></slab_coverage>
      <slab_layer name="all" type="BSDF"><input name="top" type="BSDF" nodename="some"/><input name="base" type="BSDF" nodename="gold"/>
      <input name="thickness" type="float" value="0.03"/></slab_layer>"""),
    "a coat on light": ({"000": ("lit", 1), "000|010": ("milk", 0.7)}, """<slab_coverage name="some" type="BSDF">
      <input name="in" type="BSDF" nodename="milk"/><input name="weight" type="float" value="0.7"/></slab_coverage>
      <slab_layer name="all" type="BSDF"><input name="top" type="BSDF" nodename="some"/><input name="base" type="BSDF" nodename="lamp"/>
      <input name="thickness" type="float" value="0.1"/></slab_layer>"""),
}


def slab_surface(name):
    return f"""<slab_surface name="surface_{name}" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="{name}"/></slab_surface>"""


def check_traced(folder, stage):
    """Light walks through the media of a stack as through those of one surface. Without that the coat is a fifth brighter."""
    for number, (kind, (layers, slabs_of_one)) in enumerate(TRACED.items()):
        parts = [SURFACES.get(name) or slab_surface(name) for name, _ in layers.values()]
        parts += [f"""<substance name="layer_{name}" type="material"><input name="surfaceshader" type="surfaceshader" nodename="surface_{name}"/>
          <input name="mask" type="float" value="{mask}"/></substance>""" for name, mask in layers.values()]
        assigns = "".join(f'<materialassign slot="{slot}" material="layer_{name}" geom="/"/>' for slot, (name, _) in layers.items())
        one = f"""{slabs_of_one}{slab_surface("all")}<surfacematerial name="M" type="material">
          <input name="surfaceshader" type="surfaceshader" nodename="surface_all"/></surfacematerial>"""
        pictures = []
        for name, more, look in (("stack", "".join(parts), assigns), ("one", one, '<materialassign name="a" material="M" geom="/"/>')):
            path = folder / f"traced{number}{name}.mtlx"
            path.write_text(f'<materialx version="1.39">{MEDIA}{more}<look name="L">{look}</look></materialx>')
            pictures.append(draw(path, stage, f"traced{number}{name}", "-s", 24, "--path-trace", "--paths", 16))
        if all(pictures):
            check(balls.compare(*pictures) < 0.1, f"{kind}: the traced stack differs by {balls.compare(*pictures)}")


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        stage = folder / "stage.usda"
        stage.write_text(STAGE)
        draws = RENDER is not None
        for kind in ("slabs", "others", "coat", "hole"):
            path = folder / f"{kind}.mtlx"
            path.write_text(document(kind))
            num = NUM_LAYERS + (kind == "coat")
            check_reports(kind, path, stage, num)
            draws = draws and check_pictures(kind, path, stage, num)
        check_cut(folder, stage)
        if draws:
            check_traced(folder, stage)
        stored = generate(folder / "slabs.mtlx", stage, folder / "stored", "--role", "deferred", "--max-slabs", 3)
        check(stored.returncode == 0 and "drawn-forward" not in stored.stderr, f"the deferred pipeline: {stored.stderr}")
        unknown = run(MXGEN, "inspect", "--slabs", folder / "slabs.mtlx", "--stage", stage, "-e", "/bell")
        check(unknown.returncode == 1 and "did you mean '/ball'" in unknown.stderr, f"a primitive that is not there: {unknown.stderr}")
        if not draws:
            skip("without a Vulkan device nothing is drawn")
    finish("slab-stacks")


if __name__ == "__main__":
    main()
