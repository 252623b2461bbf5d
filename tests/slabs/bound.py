#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The bound of estimated errors (docs/slabs.md): 30 materials that no weight of the estimate was fitted to, as one slab each, drawn from four
sides; no side is farther off than the bound says. The first twelve are drawn without parts that a budget may leave out, too.

Arguments: mxgen; --print lists each material."""
import pathlib
import random
import re
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
import balls
from checks import check, finish, run

MXGEN = pathlib.Path(sys.argv[1]).resolve()
NUM_MATERIALS, NUM_FEWER, SIZE = 30, 12, 48
CAMERAS = ("0,0", "90,0", "180,30", "270,-20")
# docs/slabs.md: the most that a side is off, of the estimate.
FACTOR, REST = 2.5, 0.5
PARTS = ("fuzz", "second-lobe", "anisotropy")
BUDGETS = {"one slab": ("--max-slabs", "1"), "fewer parts": ("--features", ",".join(f"-{part}" for part in PARTS))}
STEP = re.compile(r"slabs \d+ to (\d+), .* estimated error (\S+)")
ALONE = re.compile(r"^  1 slab, ", re.MULTILINE)


class Material:
    """A tree of two to five slabs, as XML."""

    def __init__(self, name, seed):
        self.name, self.random, self.nodes, self.count = name, random.Random(seed), [], 0
        root = self.tree(self.random.randint(2, 5), True)
        self.add("slab_surface", "surfaceshader", f"SR_{name}", bsdf=("BSDF", root))

    def add(self, node, kind, name=None, **inputs):
        self.count += 1
        name = name or f"{self.name}_{self.count}"
        ports = "".join(f'<input name="{key}" type="{of}" {"value" if of not in ("BSDF", "node float", "node vector3") else "nodename"}='
                        f'"{value}"/>' for key, (of, value) in inputs.items())
        ports = ports.replace('type="node ', 'type="')
        self.nodes.append(f'  <{node} name="{name}" type="{kind}">{ports}</{node}>')
        return name

    def color(self, least=0.0, most=0.9):
        return "color3", ", ".join(f"{self.random.uniform(least, most):.3f}" for _ in range(3))

    def mask(self):
        """A constant, soft noise, hard patches, or one side of the ball."""
        kind = self.random.choice(("constant", "noise", "patches", "side"))
        if kind == "constant":
            return "float", f"{self.random.uniform(0.1, 0.9):.3f}"
        place = self.add("position", "vector3", space=("string", "object"))
        if kind == "side":
            value, low = self.add("extract", "float", **{"in": ("node vector3", place), "index": ("integer", self.random.randint(0, 2))}), self.random.uniform(-0.5, 0.8)
            high = low + 0.1
        else:
            scaled = self.add("multiply", "vector3", in1=("node vector3", place), in2=("float", f"{self.random.uniform(1, 6):.2f}"))
            value = self.add("noise3d", "float", position=("node vector3", scaled))
            low, high = (-0.5, 0.5) if kind == "noise" else (0.0, 0.05)
        return "node float", self.add("smoothstep", "float", **{"in": ("node float", value), "low": ("float", f"{low:.3f}"), "high": ("float", f"{high:.3f}")})

    def slab(self, is_top):
        r, inputs = self.random, {}
        is_metal, is_clear = r.random() < 0.3, is_top and r.random() < 0.6
        inputs["diffuse_albedo"] = ("color3", "0, 0, 0") if is_metal or is_clear else self.color()
        if is_metal and not is_clear:
            inputs["f0"] = self.color(0.4, 1.0)
        inputs["roughness"] = ("float", f"{r.uniform(0.05, 0.9):.3f}")
        if is_clear:
            inputs["mean_free_path"] = ("vector3", ", ".join(f"{r.uniform(0.01, 0.2):.3f}" for _ in range(3)))
        if r.random() < 0.25:
            inputs["fuzz_amount"] = ("float", f"{r.uniform(0.2, 1):.3f}")
            inputs["fuzz_color"] = self.color()
        if r.random() < 0.2:
            inputs["anisotropy"] = ("float", f"{r.uniform(-0.9, 0.9):.3f}")
        if r.random() < 0.2:
            inputs["second_roughness"] = ("float", f"{r.uniform(0.1, 0.9):.3f}")
            inputs["second_roughness_weight"] = ("float", f"{r.uniform(0.1, 0.7):.3f}")
        return self.add("slab", "BSDF", **inputs)

    def tree(self, num, is_bottom):
        if num == 1:
            return self.slab(not is_bottom)
        left = self.random.randint(1, num - 1)
        if self.random.random() < 0.5:
            top = self.tree(left, False)
            if self.random.random() < 0.5:
                top = self.add("slab_coverage", "BSDF", **{"in": ("BSDF", top), "weight": self.mask()})
            return self.add("slab_layer", "BSDF", top=("BSDF", top), base=("BSDF", self.tree(num - left, is_bottom)))
        parts = self.tree(left, is_bottom), self.tree(num - left, is_bottom)
        return self.add("slab_mix", "BSDF", fg=("BSDF", parts[0]), bg=("BSDF", parts[1]), mix=self.mask())


def estimate(document, name, budget):
    """The slabs and the estimated error after the steps of a budget. A slab that hides the others takes no step; a budget of parts may have none
    to leave out, which is None."""
    told = run(MXGEN, "inspect", document, "-e", name, "--slabs", *BUDGETS[budget]).stdout
    steps = STEP.findall(told)
    if steps:
        return int(steps[-1][0]), float(steps[-1][1])
    return (1, 0.0) if budget == "one slab" and ALONE.search(told) else None


def draw(document, name, camera, path, *options):
    made = run(MXGEN, "render", document, "-e", name, "-s", SIZE, "-m", "sphere", "--quiet", f"--camera={camera}", *options, "-o", path)
    check(made.returncode == 0, f"{name}: {made.stderr}")


def drawn(document, name, folder, budgets):
    """By budgets: the largest drawn error of all sides."""
    errors = dict.fromkeys(budgets, 0)
    for camera in CAMERAS:
        draw(document, name, camera, folder / "whole.ppm")
        for budget in budgets:
            draw(document, name, camera, folder / "less.ppm", *BUDGETS[budget])
            errors[budget] = max(errors[budget], balls.compare(folder / "whole.ppm", folder / "less.ppm"))
    return errors


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for i in range(NUM_MATERIALS):
            material = Material(f"m{i}", i)
            document = folder / f"{material.name}.mtlx"
            document.write_text('<materialx version="1.39">\n' + "\n".join(material.nodes) + "\n</materialx>\n")
            guesses = {budget: estimate(document, f"SR_{material.name}", budget) for budget in BUDGETS}
            guesses = {budget: guess for budget, guess in guesses.items() if guess and (i < NUM_FEWER or budget == "one slab")}
            check(guesses.get("one slab", (0, 0))[0] == 1, f"{material.name} becomes no single slab")
            for budget, found in drawn(document, f"SR_{material.name}", folder, guesses).items():
                guess = guesses[budget][1]
                check(found <= FACTOR * guess + REST, f"{material.name}, {budget}: drawn {found:.2f}, estimated {guess:.2f}")
                if "--print" in sys.argv:
                    print(f"{material.name}, {budget}: estimated {guess:.3f} drawn {found:.3f}", flush=True)
    finish("slab-bound")


main()
