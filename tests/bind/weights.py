#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Random stacks of unlit layers against the rules of docs/slots.md ("Substances"), which this file computes by itself: the shader that blends
all layers, and the mean of the shader that picks one over the numbers (i + 1/2) / 4096; the normal of each layer, which is its colour then;
the displacement of a vertex. The shaders run here, as Python.

Arguments: mxgen, the number of stacks, the first seed."""
import json
import pathlib
import random
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish
from shader_python import UP, Vec, mattes_of, run, unit

MXGEN, NUM, SEED = pathlib.Path(sys.argv[1]).resolve(), int(sys.argv[2]), int(sys.argv[3])
SAMPLES = 4096
# A layer alone: not opaque; without surface; not opaque, with displacement.
LONE = 20309, 3129, 3325
MODES = {"blend": [], "stochastic": ["--slots", "stochastic"]}


# ---- A stack, and what the rules say of it ----

def clamp(x):
    return min(max(x, 0.0), 1.0)


class Layer:
    """A layer with the values of its inputs; None where the document does not say them."""

    def __init__(self, dice, slot, theme):
        self.slot, self.theme = slot, theme
        has_product = theme != "colors" and dice.random() < 0.8
        self.product = None if not has_product else unit([dice.uniform(-1, 1), dice.uniform(-1, 1), 1.5]) if theme == "normals" else round(dice.uniform(-2, 2), 3)
        self.mode = dice.choice([None, "add", "mix", "none"])
        self.color = [round(dice.random(), 3) for _ in range(3)]
        self.opacity = dice.choice([1.0, 1.0, 0.0, round(dice.random(), 3)])
        # masks beyond 0 and 1 are clamped
        self.mask = dice.choice([None, 1.0, 0.0, round(dice.uniform(-0.5, 1.5), 3), round(dice.random(), 3)])
        self.cutout = dice.choice([None, None, round(dice.random(), 3)])
        self.override = dice.choice([None, None, round(dice.random(), 3)])  # of the mask
        self.is_removed = dice.random() < 0.15
        self.is_bare = dice.random() < 0.1  # without surface

    def presence(self):
        mask = self.mask if self.override is None else self.override
        return clamp(1.0 if mask is None else mask) * clamp(self.opacity)

    def document(self):
        name = self.slot
        color = 'nodename="normal_color"' if self.theme == "normals" else f'value="{", ".join(map(str, self.color))}"'
        lines = [f'<surface_unlit name="s{name}" type="surfaceshader"><input name="emission_color" type="color3" {color}/>',
                 f'<input name="opacity" type="float" value="{self.opacity}"/></surface_unlit>',
                 f'<substance name="m{name}" type="material">']
        if not self.is_bare:
            lines.append(f'<input name="surfaceshader" type="surfaceshader" nodename="s{name}"/>')
        lines += [f'<input name="{k}" type="float" value="{v}"/>' for k, v in (("mask", self.mask), ("cutout", self.cutout)) if v is not None]
        lines += self.products()
        lines.append("</substance>")
        if self.product is not None and self.theme == "normals":
            lines.append(f'<constant name="normal{name}" type="vector3"><input name="value" type="vector3" value="{", ".join(map(str, self.product))}"/></constant>')
        if self.product is not None and self.theme == "displacements":
            lines.append(f'<displacement name="d{name}" type="displacementshader"><input name="displacement" type="float" value="{self.product}"/></displacement>')
        if self.override is not None:
            lines.append(f'<nodegraph name="n{name}"><constant name="c" type="float"><input name="value" type="float" '
                         f'value="{self.override}"/></constant><output name="mask" type="float" nodename="c"/></nodegraph>')
        return "\n".join(lines)

    def products(self):
        """The inputs of the material for its normal or displacement."""
        if self.theme == "colors":
            return []
        word = self.theme[:-1]
        lines = [f'<input name="{word}_mode" type="string" value="{self.mode}"/>'] if self.mode else []
        if self.product is not None and word == "normal":
            lines.append(f'<input name="normal" type="vector3" nodename="normal{self.slot}"/>')
        elif self.product is not None:
            lines.append(f'<input name="displacementshader" type="displacementshader" nodename="d{self.slot}"/>')
        return lines

    def share(self):
        """Of its normal or displacement: without a surface the mask alone."""
        mask = self.mask if self.override is None else self.override
        return clamp(1.0 if mask is None else mask) if self.is_bare else self.presence()

    def assignments(self):
        lines = [f'<materialassign slot="{self.slot}" material="m{self.slot}" geom="/a"/>']
        if self.override is not None:
            lines.append(f'<materialassign slot="{self.slot}::010" nodegraph="n{self.slot}" geom="/"/>')
        if self.is_removed:
            lines.append(f'<materialassign slot="{self.slot}" material="" geom="/a/b"/>')
        return "\n".join(lines)


def normals(layers):
    """The normal after each layer, base first (rules, section 4)."""
    everywhere = [sum(l.product[i] - UP[i] for l in layers if l.product and l.mode == "none") for i in range(3)]
    current, found = UP, []
    for layer in layers:
        m = layer.share()
        if layer.product and layer.mode == "add":
            current = unit([c + m * (n - up) for c, n, up in zip(current, layer.product, UP)])
        elif layer.product and layer.mode != "none":
            current = unit([c + m * (n - c) for c, n in zip(current, layer.product)])
        found.append(unit([c + e for c, e in zip(current, everywhere)]))
    return found


def height(layers):
    """How far the layers move a vertex along its normal."""
    moved = 0.0
    for layer in layers:
        if layer.product is not None and layer.mode == "add":
            moved += layer.share() * layer.product
        elif layer.product is not None and layer.mode != "none":
            moved += layer.share() * (layer.product - moved)
    return moved + sum(l.product for l in layers if l.product is not None and l.mode == "none")


def expected(layers):
    """The premultiplied colour and the alpha of the layers, base first (rules, section 3), and the weight of each: its matte."""
    color, through, shape, mattes = [0.0, 0.0, 0.0], 1.0, 1.0, {}
    for layer in layers:
        shape *= clamp(1.0 if layer.cutout is None else layer.cutout)
    for layer in reversed(layers):
        if layer.is_bare:
            continue
        weight = layer.presence() * through
        through *= 1.0 - layer.presence()
        mattes[f"aov_matte_{layer.slot}"] = shape * weight
        color = [c + shape * weight * own for c, own in zip(color, layer.color)]
    return color + [shape * (1.0 - through)], mattes


# ---- The test ----

def generate(folder, mode, interface):
    subprocess.run([MXGEN, "look.mtlx", "--stage", "stage.txt", "--target", "glsl", "--environment", "none", "--lights", "none", "--interface", interface, "-q",
                    "--mattes", "-o", mode] + MODES[mode], cwd=folder, check=True)
    bindings = json.loads((folder / mode / "bindings.json").read_text())
    stacks = {s["name"]: s for s in bindings["stacks"]}
    stack = stacks[next(p["stack"] for p in bindings["primitives"] if p["path"] == "/a/b")]
    values = {v["name"]: Vec(v["value"]) if isinstance(v["value"], list) else v["value"] for v in stack["values"]}
    return {end: (folder / mode / f"{stack['program']}.{end}").read_text() for end in ("vert", "frag")}, values


def is_near(a, b, tolerance):
    return len(a) == len(b) and all(abs(x - y) <= tolerance for x, y in zip(a, b))


def test_pixel(what, folder, interface, want, mattes):
    sources, values = generate(folder, "blend", interface)
    check(set(mattes_of(sources["frag"])) == set(mattes), f"{what}: {mattes_of(sources['frag'])} instead of {list(mattes)}")
    want = want + [mattes[matte] for matte in mattes_of(sources["frag"])]
    got = run(sources["frag"], values, 0.0)
    check(is_near(got, want, 1e-5), f"{what}: blend gives {list(got)} instead of {want}")
    sources, values = generate(folder, "stochastic", interface)
    picks = run(sources["frag"], values, [(i + 0.5) / SAMPLES for i in range(SAMPLES)])
    mean = [sum(p[i] for p in picks) / SAMPLES for i in range(len(want))]
    check(is_near(mean, want, 1e-3), f"{what}: the mean of stochastic is {mean} instead of {want}")
    check(all(abs(p[3] - round(p[3])) < 1e-6 for p in picks), f"{what}: a layer is picked or none")
    check(all(abs(sum(p[4:]) - p[3]) < 1e-6 for p in picks), f"{what}: exactly one layer runs where one is picked")


def test_vertex(what, folder, interface, want):
    for mode in MODES:  # displacement is never picked
        sources, values = generate(folder, mode, interface)
        got = run(sources["vert"], values, 0.0)
        check(abs(got[2] - want) < 1e-5, f"{what}, {mode}: the vertex moves {got[2]} instead of {want}")


def test(seed, folder):
    dice = random.Random(seed)
    theme = dice.choice(["colors", "normals", "displacements"])
    layers = [Layer(dice, f"{i:03}", theme) for i in range(0, 10 * dice.randint(1, 6), 10)]
    here = [layer for layer in layers if not layer.is_removed]
    (folder / "look.mtlx").write_text('''<?xml version="1.0"?>
<materialx version="1.39">
<normal name="normal_world" type="vector3"><input name="space" type="string" value="world"/></normal>
<convert name="normal_color" type="color3"><input name="in" type="vector3" nodename="normal_world"/></convert>
''' + "\n".join(l.document() for l in layers) + '\n<look name="L">\n' + "\n".join(l.assignments() for l in layers) + "\n</look>\n</materialx>\n")
    (folder / "stage.txt").write_text("/a/b\n")
    interface = dice.choice(["complete", "authored", "reduced"])
    if not here:
        return  # the default substance, which is lit
    if theme == "normals":
        for layer, normal in zip(here, normals(here)):
            layer.color = normal
    want, mattes = expected(here)
    what = f"seed {seed}, {theme}, {interface}"
    check(min(mattes.values(), default=0) >= 0 and abs(sum(mattes.values()) - want[3]) < 1e-9, f"{what}: the weights are the alpha")
    check(0 <= want[3] <= 1 + 1e-9 and (theme == "normals" or min(want) >= 0), f"{what}: weights are 0 to 1")
    if theme == "displacements":
        test_vertex(what, folder, interface, height(here))
    else:
        test_pixel(what, folder, interface, want, mattes)


with tempfile.TemporaryDirectory() as name:
    for seed in (*LONE, *range(SEED, SEED + NUM)):
        test(seed, pathlib.Path(name))
finish("bind-weights")
