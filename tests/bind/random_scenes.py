#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Random looks on random scenes: `mxgen bind --json` and resolver.py agree. Arguments: the program, the number of scenes, and the seed
of the first one."""
import json
import pathlib
import random
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish

sys.path.append(str(pathlib.Path(__file__).resolve().parent))
from resolver import Resolver

MXGEN, COUNT, FIRST = pathlib.Path(sys.argv[1]).resolve(), int(sys.argv[2]), int(sys.argv[3])
NAMES = ["a", "b", "ab", "c1", "c2", "x_y"]
GLOBS = ["*", "?", "a*", "*b", "c[12]", "[a-c]?", "{a,b}", "{c1, x*}", "{a,{b,c}*}", "*_*"]
SETS = {"V": "", "VS": ' node="surface"', "VD": ' node="displacement"', "VN": ' node="gltf_pbr"'}
SLOTS = ["000", "010", "9", "10", "base", "_"]


class Scene:
    """One random document with its paths."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.paths = self.make_paths()
        self.collections = []
        self.text = self.make_document()

    def chance(self, share):
        return self.random.random() < share

    def make_paths(self):
        paths = set()
        for _ in range(self.random.randint(1, 12)):
            paths.add("/" + "/".join(self.random.choice(NAMES) for _ in range(self.random.randint(1, 5))))
        return self.random.sample(sorted(paths), len(paths))

    def pattern(self):
        if self.chance(0.35):
            levels = self.random.choice(self.paths).split("/")
            return "/".join(levels[:self.random.randint(1, len(levels))]) or "/"
        text = ""
        for _ in range(self.random.randint(1, 4)):
            text += "//" if self.chance(0.25) else "/"
            text += self.random.choice(GLOBS if self.chance(0.5) else NAMES)
        return text + self.random.choice(["", "", "", "", "/", "//", "//*"])

    def geometry(self):
        return self.random.choice([", ", ","]).join(self.pattern() for _ in range(self.random.randint(1, 2)))

    def make_collection(self, number):
        text = f'<collection name="C{number}" includegeom="{self.geometry()}"'
        if self.collections and self.chance(0.6):
            nested = self.random.sample(self.collections, self.random.randint(1, min(2, len(self.collections))))
            text += f' includecollection="{", ".join(nested)}"'
        if self.chance(0.4):
            text += f' excludegeom="{self.geometry()}"'
        self.collections.append(f"C{number}")
        return text + "/>"

    def slot(self):
        name = self.random.choice(SLOTS[:3] if self.chance(0.7) else SLOTS)
        if self.chance(0.15):
            name += "|" + self.random.choice(SLOTS)
        if self.chance(0.35):
            name += "::" + self.random.choice(SLOTS)
        return name

    def make_assign(self, number):
        slot = self.slot()
        text = f'<materialassign name="m{number}"'
        if slot != "000" or self.chance(0.5):
            text += f' slot="{slot}"'
        if "::" in slot and self.chance(0.6):
            text += f' nodegraph="{self.random.choice(["NG1", "NG2", ""])}"'
        else:
            # a material beside the stack has no slot
            materials = ["A", "B", "C", "D", "E", ""] + (["Fog", "Lamp"] if slot == "000" else [])
            text += f' material="{self.random.choice(materials)}"'
        if self.chance(0.3):
            text += f' exclusive="{self.random.choice(["false", "false", "true"])}"'
        if self.collections and self.chance(0.5):
            text += f' collection="{self.random.choice(self.collections)}"'
        elif self.chance(0.2):
            text += f' geomprefix="{self.pattern()}" geom="{self.random.choice(["/a", "b", "", "*, c1"])}"'
        else:
            text += f' geom="{self.geometry()}"'
        inner = "".join(self.make_variant(number, i) for i in range(2) if self.chance(0.1))
        return f"{text}>{inner}</materialassign>" if inner else text + "/>"

    def make_variant(self, number, i):
        return f'<variantassign name="v{number}_{i}" variantset="{self.random.choice(list(SETS))}" variant="{self.random.choice(["x", "y"])}"/>'

    def make_looks(self):
        looks, number = [], 0
        for generation in range(self.random.randint(1, 3)):
            parent = f' inherit="L{generation - 1}"' if generation else ""
            order = f' slotorder="{self.random.choice(["10, 9", "base", "", "000, _, 010"])}"' if self.chance(0.25) else ""
            looks.append(f'<look name="L{generation}"{parent}{order}>')
            looks += [self.make_variant(f"look{generation}", i) for i in range(2) if self.chance(0.2)]
            for _ in range(self.random.randint(1, 8)):
                looks.append(self.make_assign(number))
                number += 1
            looks.append("</look>")
        self.look = f"L{generation}"
        if self.chance(0.3):
            looks.append(f'<lookgroup name="G" looks="L0, {self.look}" default="{self.look}"/>')
            self.look = "G"
        return looks

    def make_document(self):
        lines = ['<materialx version="1.39">', '<constant name="k" type="float"/>', '<surface name="s" type="surfaceshader"/>',
                 '<displacement name="d" type="displacementshader"/>', '<volume name="v" type="volumeshader"/>',
                 '<light name="l" type="lightshader"/>']
        surface = '<input name="surfaceshader" type="surfaceshader" nodename="s"/>'
        back = '<input name="backsurfaceshader" type="surfaceshader" nodename="s"/>'
        displacement = '<input name="displacementshader" type="displacementshader" nodename="d"/>'
        for name, inputs in {"A": surface, "B": surface + displacement, "C": displacement, "D": back, "E": surface + back}.items():
            lines.append(f'<surfacematerial name="{name}" type="material">{inputs}</surfacematerial>')
        lines.append('<volumematerial name="Fog" type="material"><input name="volumeshader" type="volumeshader" nodename="v"/></volumematerial>')
        lines.append('<lightmaterial name="Lamp" type="material"><input name="lightshader" type="lightshader" nodename="l"/></lightmaterial>')
        for name in "NG1", "NG2":
            lines.append(f'<nodegraph name="{name}"><constant name="c" type="float"/><output name="o" type="float" nodename="c"/></nodegraph>')
        for name, node in SETS.items():
            variants = "".join(f'<variant name="{variant}"><input name="i" type="float" value="1"/></variant>' for variant in ("x", "y"))
            lines.append(f'<variantset name="{name}"{node}>{variants}</variantset>')
        lines += [self.make_collection(number) for number in range(self.random.randint(0, 4))]
        return "\n".join(lines + self.make_looks() + ["</materialx>"])


def strip(layer):
    """Without what resolver.py does not know: places in files."""
    if isinstance(layer, list):
        return [strip(one) for one in layer]
    if not isinstance(layer, dict):
        return layer
    return {key: value.split(" ")[0] if key == "assign" else strip(value) for key, value in layer.items() if key != "stack"}


def compare(seed, folder):
    scene = Scene(seed)
    document, stage = folder / "look.mtlx", folder / "stage.txt"
    document.write_text(scene.text, encoding="utf-8")
    stage.write_text("\n".join(scene.paths) + "\n", encoding="utf-8")
    command = [MXGEN, "bind", document, "--stage", stage, "--look", scene.look, "--json", "-", "--quiet"]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if result.returncode:
        check(False, f"scene {seed}: {result.stderr}")
        return
    is_ = {one["path"]: one for one in strip(json.loads(result.stdout)["primitives"])}
    should = {one["path"]: one for one in Resolver(scene.text, scene.paths, scene.look).resolve()}
    wrong = next((path for path in should if is_.get(path) != should[path]), None)
    check(wrong is None and is_.keys() == should.keys(),
          f"scene {seed}, {wrong}:\n  is     {json.dumps(is_.get(wrong))}\n  should {json.dumps(should.get(wrong))}")


with tempfile.TemporaryDirectory() as name:
    for seed in range(FIRST, FIRST + COUNT):
        compare(seed, pathlib.Path(name))
finish("bind-random")
