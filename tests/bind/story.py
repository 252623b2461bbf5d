#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The story of docs/slots.md: each look of examples/slots is drawn. A picture differs from that of its parent look where primitives have
another stack, and nowhere else. The page shows the rows that `mxgen bind` prints, and a picture of each look. Bindings do not depend on the
library of substances.

Arguments: mxgen, mxgen-render, the root of the project; "matte" for the path traced look alone, which takes minutes."""
import json
import pathlib
import re
import shutil
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "programs"))
import exr
from checks import check, finish, run, skip

MXGEN, RENDER, ROOT = (pathlib.Path(arg).resolve() for arg in sys.argv[1:4])
SLOTS, PAGE = ROOT / "examples/slots", ROOT / "docs/slots.md"
WIDTH, HEIGHT = 200, 150
# Each look with its parent, and primitives that must look different from there: a part of their pixels.
STEPS = {"base": ("default", {"case/shell": 0.9, "knobs/tuning/cap": 0.8, "aerial/rod_1": 0.5}),
         "pattern": ("base", {"case/shell": 0.9, "case/front_panel": 0.9}),
         "metal": ("pattern", {"speaker/ring": 0.7, "dial/frame": 0.7, "aerial/rod_1": 0.5, "case/screws/screw_4": 0.2}),
         "replaced": ("metal", {"case/shell": 0.7}),
         "red": ("replaced", {"knobs/tuning/cap": 0.5, "knobs/tone/cap": 0.5, "keys/key_1": 0.5}),
         "dirty": ("red", {"case/shell": 0.15, "case/front_panel": 0.15, "case/handle/grip": 0.15}),
         "light": ("dirty", {"case/shell": 0.15, "case/front_panel": 0.15, "case/handle/grip": 0.15}),
         "clean": ("light", {"case/front_panel": 0.15}),
         "sign": ("clean", {"case/shell": 0.1}),
         "sign_add": ("sign", {"case/shell": 0.05}),
         "sign_none": ("sign", {"case/shell": 0.3}),
         "finished": ("sign", {"case/front_panel": 0.3})}
# How far a colour of 0 to 255 may be off, and how far from a primitive, in pixels, its samples and its ribs reach.
THRESHOLD, REACH = 2, 2


def bind(document, look, stage=SLOTS / "receiver.usda"):
    result = run(MXGEN, "bind", document, "--stage", stage, "--look", look, "--json", "-")
    check(result.returncode == 0 and not result.stderr, f"bind, {look}: {result.stderr}")
    return result.stdout


class Picture:
    """The colours of the pixels of a PPM file."""

    def __init__(self, path):
        header, self.bytes = path.read_bytes().split(b"255\n", 1)
        self.width, self.height = map(int, header.split()[1:3])

    def __getitem__(self, at):
        return self.bytes[3 * at:3 * at + 3]

    def changed(self, other):
        return {i for i in range(self.width * self.height) if max(abs(a - b) for a, b in zip(self[i], other[i])) > THRESHOLD}

    def near(self, at, reach):
        x, y = at % self.width, at // self.width
        return (row * self.width + column for row in range(max(y - reach, 0), min(y + reach + 1, self.height))
                for column in range(max(x - reach, 0), min(x + reach + 1, self.width)))


def draw(document, look, folder, stage=SLOTS / "receiver.usda", name=None, size=1):
    path = folder / f"{name or look}.ppm"
    result = run(RENDER, document, "--stage", stage, "--look", look, "-s", f"{size * WIDTH}x{size * HEIGHT}", "-o", path)
    if result.returncode and "no-device" in result.stderr:
        return None
    check(result.returncode == 0 and not result.stderr, f"render, {look}: {result.stderr}")
    return Picture(path) if result.returncode == 0 else None


FINER = 4


def draw_primitives(paths, folder):
    """The primitives that each pixel shows, from pictures that are finer, in which each primitive has a colour: with the window, and without."""
    shown = {}
    for opacity in 0, 1:
        fine = draw_colors(paths, opacity, folder)
        if fine is None:
            return None
        for at, path in fine[0].items():
            x, y = at % fine[1] // FINER, at // fine[1] // FINER
            shown.setdefault(y * (fine[1] // FINER) + x, set()).add(path)
    return shown


def draw_colors(paths, window, folder):
    """Which primitive a pixel of a finer picture shows; those of several primitives show none. And the width of the picture."""
    levels = [0, 0.2, 0.4, 0.6, 0.8, 1]  # of linear light: bytes that differ
    colors = [(r, g, b) for r in levels for g in levels for b in levels][1:]
    lines = ['<?xml version="1.0"?><materialx version="1.39">']
    assigns = []
    for path, color in zip(paths, colors):
        name = path.strip("/").replace("/", "__")
        opacity = window if path.endswith("window") else 1
        lines.append(f'<surface_unlit name="s{name}" type="surfaceshader"><input name="emission_color" type="color3" value="{color[0]}, {color[1]}, '
                     f'{color[2]}"/><input name="opacity" type="float" value="{opacity}"/></surface_unlit><surfacematerial name="m{name}" type="material">'
                     f'<input name="surfaceshader" type="surfaceshader" nodename="s{name}"/></surfacematerial>')
        assigns.append(f'<materialassign material="m{name}" geom="{path}"/>')
    document = folder / "primitives.mtlx"
    document.write_text("\n".join(lines + ['<look name="l">'] + assigns + ["</look></materialx>"]), encoding="utf-8")
    picture = draw(document, "l", folder, size=FINER)
    if not picture:
        return None
    exposed = {round(255 * to_display(0.6 * level)): level for level in levels}
    shown = {}
    by_color = dict(zip(colors, paths))
    for i in range(picture.width * picture.height):
        color = tuple(nearest(byte, exposed) for byte in picture[i])
        if color in by_color:
            shown[i] = by_color[color]
    return shown, picture.width


def nearest(byte, exposed):
    return next((level for other, level in exposed.items() if abs(other - byte) <= 1), None)


def to_display(light):
    return 12.92 * light if light <= 0.0031308 else 1.055 * light ** (1 / 2.4) - 0.055


def check_step(look, step, pictures, stacks, shown):
    parent, musts = step
    moved = {path for path in stacks[look] if stacks[look][path] != stacks[parent][path]}
    changed = pictures[look].changed(pictures[parent])
    check(len(changed) > 20, f"{look}: nothing to see")
    grows = look == "sign_none"  # the case, which then shows behind the front panel, too
    stray = [at for at in changed if not any(shown.get(near, set()) & moved or (grows and near not in shown) for near in pictures[look].near(at, REACH * (1 + grows)))]
    check(not stray, f"{look}: {len(stray)} pixels differ from {parent} where no stack does: {[divmod(at, WIDTH)[::-1] for at in stray[:4]]}")
    for path, share in musts.items():
        own = [at for at, seen in shown.items() if seen == {f"/receiver/{path}"}]
        check(own and len(changed & set(own)) >= share * len(own),
              f"{look}: {path} has {len(changed & set(own))} of {len(own)} pixels that differ from {parent}")


def check_pictures(folder):
    default = json.loads(bind(SLOTS / "looks.mtlx", "default"))
    paths = [primitive["path"] for primitive in default["primitives"]]
    parts = [path for path in paths if not any(other.startswith(path + "/") for other in paths) and path != "/camera"]
    check(30 <= len(parts) <= 60, f"the device has {len(parts)} parts")
    shown = draw_primitives(parts, folder)
    if shown is None:
        skip("no Vulkan device: no look is drawn")
        return
    stacks = {look: {one["path"]: one.get("stack") for one in json.loads(bind(SLOTS / "looks.mtlx", look))["primitives"]} for look in ["default", *STEPS]}
    pictures = {look: draw(SLOTS / "looks.mtlx", look, folder) for look in stacks}
    for look, step in STEPS.items():
        if pictures[look] and pictures[step[0]]:
            check_step(look, step, pictures, stacks, shown)
    check_modes(pictures)
    check_formats(pictures, folder)
    check_mattes(pictures["finished"], shown, folder)


def check_modes(pictures):
    """Beyond the sign, none moves the case, and mix and add leave it where it is."""
    def differ(look):
        return len(pictures[look].changed(pictures["clean"]))
    check(differ("sign_none") > 2 * differ("sign"), f"none differs in {differ('sign_none')} pixels, mix in {differ('sign')}")
    check(len(pictures["sign_add"].changed(pictures["sign"])) > 20, "add and mix look alike")


def check_mattes(picture, shown, folder):
    """Each slot has a matte: the weights of all layers are the opacity, and a primitive has those of its own slots alone."""
    path = folder / "mattes.exr"
    result = run(RENDER, SLOTS / "looks.mtlx", "--stage", SLOTS / "receiver.usda", "--look", "finished", "--mattes", "-s", f"{WIDTH}x{HEIGHT}", "-o", path)
    check(result.returncode == 0 and not result.stderr, f"render, mattes: {result.stderr}")
    values = {name: [value for row in rows for value in row] for name, rows in exr.read(path)[2].items()} if result.returncode == 0 else {}
    mattes = {name[len("matte."):]: numbers for name, numbers in values.items() if name.startswith("matte.")}
    check(sorted(mattes) == ["000", "000|010", "010", "040", "050"], f"mattes of {sorted(mattes)}")
    layers = {one["path"]: {layer["slot"] for layer in one["layers"]} | {part["slot"] for layer in one["layers"] for part in layer.get("vertical", [])}
              for one in json.loads(bind(SLOTS / "looks.mtlx", "finished"))["primitives"]}
    for slot, numbers in mattes.items():
        has = {at for at, seen in shown.items() if any(slot in layers[path] for path in seen)}
        lacks = [at for at in shown if not any(near in has or near not in shown for near in picture.near(at, REACH))]
        check(any(numbers[at] > 0.5 for at in has), f"the matte of {slot} is nowhere")
        check(slot == "000" or len(lacks) > 100, f"primitives without {slot} have {len(lacks)} pixels")
        check(not any(numbers[at] > 0 for at in lacks), f"the matte of {slot} is where no primitive has it")
    whole = [sum(numbers[at] for slot, numbers in mattes.items() if "|" not in slot) - values["A"][at] for at in range(len(values.get("A", [])))]
    check(whole and max(map(abs, whole)) < 1e-5, "the mattes of the slots do not add up to the opacity")


def check_formats(pictures, folder):
    """The same device as glTF has the same bindings, and looks the same but for its roundness."""
    gltf = SLOTS / "receiver.gltf"
    other = draw(SLOTS / "looks.mtlx", "finished", folder, stage=gltf, name="gltf")
    if other:
        share = sum(max(abs(a - b) for a, b in zip(other[i], pictures["finished"][i])) > 16 for i in range(other.width * other.height))
        check(share < 0.02 * other.width * other.height, f"receiver.gltf: {share} pixels differ from receiver.usda")


def check_matte(folder):
    """The dirt that masks itself has an AOV, from none to much: it is not where the surface is open."""
    path = folder / "matte.exr"
    result = run(RENDER, SLOTS / "looks.mtlx", "--stage", SLOTS / "receiver.usda", "--look", "matte", "-s", "80x60", "--path-trace", "--paths", "2", "-o", path)
    if result.returncode and "no-device" in result.stderr:
        skip("no Vulkan device: the matte is not drawn")
        return
    check(result.returncode == 0 and not result.stderr, f"render, matte: {result.stderr}")
    values = [value for row in exr.read(path)[2]["dirt"] for value in row]
    check(max(values) > 0.5 and sum(values) / len(values) < 0.2, f"dirt has up to {max(values)}, and {sum(values) / len(values)} in the mean")
    check(sum(value == 0 for value in values) > len(values) / 4, "dirt is everywhere")


def check_library(folder):
    """Another library of substances under the same names: the bindings stay, byte by byte."""
    other = folder / "other"
    shutil.copytree(SLOTS, other)
    text = (other / "substances.mtlx").read_text(encoding="utf-8")
    text = re.sub(r"<(/?)standard_surface", r"<\1open_pbr_surface", text)
    for old, new in (("metalness", "base_metalness"), ("base", "base_weight"), ("specular", "specular_weight"), ("diffuse_roughness", "base_diffuse_roughness")):
        text = text.replace(f'<input name="{old}"', f'<input name="{new}"')
    text = re.sub(r'<input name="opacity" type="color3" value="([\d.]+)[^"]*"/>', r'<input name="geometry_opacity" type="float" value="\1"/>', text)
    text = re.sub(r'<input name="specular_IOR"', '<input name="specular_ior"', text)
    check(text.count("open_pbr_surface") > 10, "the library has no surfaces")
    (other / "substances.mtlx").write_text(text, encoding="utf-8")
    for look in ["default", *STEPS]:
        check(bind(SLOTS / "looks.mtlx", look).replace(str(SLOTS), "") == bind(other / "looks.mtlx", look).replace(str(other), ""),
              f"{look}: another library changes the bindings")
    result = run(MXGEN, other / "looks.mtlx", "--look", "finished", "--stage", SLOTS / "receiver.usda", "--target", "vulkan", "-o", folder / "out")
    check(result.returncode == 0, f"the other library does not generate: {result.stderr}")


def check_page():
    page = PAGE.read_text(encoding="utf-8")
    for look in ["default", *STEPS, "matte"]:
        check(f"](slots/{look}.jpg)" in page and (ROOT / f"docs/slots/{look}.jpg").exists(), f"docs/slots.md has no picture of {look}")
    for look, text in re.findall(r"^\| `(\w+)` .*?<br>(.*?) \|$", page, re.MULTILINE):
        table = run(MXGEN, "bind", SLOTS / "looks.mtlx", "--stage", SLOTS / "receiver.usda", "--look", look).stdout
        rows = {re.sub(" +", " ", row).replace("|", "\\|") for row in table.splitlines()}
        quoted = re.findall(r"`(/[^`]*)`", text)
        check(quoted, f"docs/slots.md: {look} shows no row")
        for row in quoted:
            check("/receiver" + row in rows, f"docs/slots.md, {look}: bind prints no row '{row}'")


def check_generated(folder):
    """The stages are those that their script writes."""
    result = run(sys.executable, SLOTS / "receiver.py", folder)
    check(result.returncode == 0, result.stderr)
    for name in "receiver.usda", "receiver.gltf":
        check((folder / name).read_bytes() == (SLOTS / name).read_bytes(), f"receiver.py writes another {name}")


if sys.argv[4:] == ["matte"]:
    with tempfile.TemporaryDirectory() as name:
        check_matte(pathlib.Path(name))
    finish("story-matte")
with tempfile.TemporaryDirectory() as name:
    check_generated(pathlib.Path(name))
    check_library(pathlib.Path(name))
    check_page()
    check_pictures(pathlib.Path(name))
finish("story")
