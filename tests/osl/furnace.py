#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Renders OSL closures on balls under a uniform sky with OSL's testrender and with mxgen's path tracer; the means agree within 3 percent.
Tints of slabs follow the light, so these balls are also under a lamp, which is above them.
Rows of furnace.tsv: a material of furnace.mtlx, a document of tests/slabs/faults or of the examples; the ratio of the means if the models differ; settings that
make them agree (then the ratio is 1, which proves the reason); the reason. Some are also rendered as shader groups. The example materials
of slabs, and a stack of layers, are the same as whole shaders and as shader groups. Arguments: mxgen, the folder of MaterialX's examples ('' or absent: none), and
optionally names. Skipped (77) without oslc and testrender, or a Vulkan device."""
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
import radiance
from checks import check_fault, finish, skip

MXGEN, EXAMPLES, *NAMES = sys.argv[1:]
HERE = pathlib.Path(__file__).resolve().parent
SKY, SIZE, TOLERANCE, SAME = 0.5, 32, 0.03, 0.005
DISTANCE, FIELD = 4.0, math.radians(30)
NETWORKS = {"varnished", "fitted_layer", "slabs_lacquered", "slab_tinted", "slab_glints", "StandardSurface/standard_surface_gold.mtlx", "OpenPbr/open_pbr_default.mtlx"}
LAMPS = {"fitted_phong", "fitted_velvet", "slab_tinted", "slab_tinted_rough", "slab_tinted_glints"}


def ball_mean(path):
    """What the ball sends of the sky's light, in each colour: over the disc that it covers, but for its rim."""
    rows = radiance.read(path)
    radius = math.tan(math.asin(1 / DISTANCE)) / math.tan(FIELD / 2) * len(rows) / 2
    inside = [pixel for y, row in enumerate(rows) for x, pixel in enumerate(row)
              if math.hypot(x + 0.5 - len(rows) / 2, y + 0.5 - len(rows) / 2) < 0.93 * radius]
    return [sum(pixel[c] for pixel in inside) / (SKY * len(inside)) for c in range(3)]


def run(*command, folder=None):
    """Its complaint; testrender has some that leave its exit code 0."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, cwd=folder)
    said = (done.stdout + done.stderr).strip()
    return said[:300] or f"exit code {done.returncode}" if done.returncode or "ERROR" in said else None


def scene(layers):
    slope = math.degrees(2 * math.atan(2 * math.tan(FIELD / 2)))  # testrender's field of view is that of half the picture
    return f"""<World>
<Camera eye="0, 0, {DISTANCE}" dir="0, 0, -1" fov="{slope}"/>
<ShaderGroup>{layers}</ShaderGroup>
<Sphere center="0, 0, 0" radius="1" resolution="256"/>
<ShaderGroup><Shader type="surface" name="sky" layer="sky"/></ShaderGroup>
<Background resolution="128"/>
</World>
"""


def write_tint(folder):
    """Colours by the cosines of view (to the right) and light (upwards; files begin at the top)."""
    steps = [i / 7 for i in range(8)]
    radiance.write(folder / "tint.hdr", [[(light, 1 - light, view) for view in steps] for light in reversed(steps)])


def lamp(height):
    """What the lamp sends from a direction of this height, over what a uniform sky sends."""
    return 0.1 + 8 * max(height, 0) ** 8 # never 0, by which testrender divides


def write_sky(path, is_lamp, rows=64):
    radiance.write(path, [[(SKY * (lamp(math.cos(math.pi * (y + 0.5) / rows)) if is_lamp else 1),) * 3] * (2 * rows) for y in range(rows)])


def by_osl(document, options, folder, is_lamp=False):
    fault = run(MXGEN, document, "--target", "osl", "-q", "-o", folder, *options)
    groups = [path for path in folder.glob("*.oslgroup") if ".displacement." not in path.name]
    write_tint(folder)
    for path in document.parent.glob("*.png"): # a texture lies beside its document
        shutil.copy(path, folder)
    share = "(0.1 + 8 * pow(max(up[1], 0), 8))" if is_lamp else "1"
    (folder / "sky.osl").write_text(f"surface sky()\n{{\n    vector up = normalize(I);\n    Ci = background() * ({SKY} * {share});\n}}\n")
    for path in sorted(folder.glob("*.osl")):
        fault = fault or run("oslc", "-q", path.name, folder=folder)
    if fault:
        return fault
    if groups:
        layers = f"<![CDATA[\n{groups[0].read_text()}]]>"
    else:
        whole = next(path for path in folder.glob("*.osl") if path.name != "sky.osl" and ".displacement." not in path.name)
        name = re.search(r"^surface (\w+)\(", whole.read_text(), re.MULTILINE).group(1)
        layers = f'<Shader type="surface" name="{name}" layer="{name}"/>'
    (folder / "scene.xml").write_text(scene(layers))
    fault = run("testrender", "-t", "1", "-r", SIZE, SIZE, "-aa", "8", "scene.xml", "osl.hdr", folder=folder)
    return fault or ball_mean(folder / "osl.hdr")


def traced(document, options, folder, is_lamp=False):
    write_sky(folder / "sky.hdr", is_lamp)
    if document.parent == HERE: # textures and functions lie beside their document
        shutil.copy(HERE / "fitted.glsl", folder)
        document = pathlib.Path(shutil.copy(document, folder))
        write_tint(folder)
    fault = run(MXGEN, "render", document, "-q", "-m", "sphere", "--camera", f"0,0,{DISTANCE:g},30", "--lights", "none", "--environment",
                folder / "sky.hdr", "--path-trace", "--paths", "64", "--size", SIZE, "-o", folder / "traced.hdr", *options)
    return fault or ball_mean(folder / "traced.hdr")


def in_folder(render, document, options, is_lamp=False):
    with tempfile.TemporaryDirectory() as folder:
        return render(document, options, pathlib.Path(folder), is_lamp)


def agree(what, mean, reference, expected, by="traced", tolerance=TOLERANCE):
    if isinstance(mean, str) or isinstance(reference, str):
        return check_fault(what, mean if isinstance(mean, str) else reference)
    ratio = max((a / b for a, b in zip(mean, reference)), key=lambda one: abs(math.log(one)))
    print(f"{what}: by OSL {' '.join(f'{c:.3f}' for c in mean)}, {by} {' '.join(f'{c:.3f}' for c in reference)}: {ratio:.3f}", flush=True)
    return check_fault(what, None if abs(ratio / expected - 1) < tolerance else f"the ratio is {ratio:.3f}, not {expected}")


def compare(what, document, options, expected):
    reference = in_folder(traced, document, options)
    if isinstance(reference, str) and "no-device" in reference:
        skip("there is no Vulkan device")
        finish("osl-furnace")
    agree(what, in_folder(by_osl, document, options), reference, expected)
    if what in NETWORKS:
        agree(f"{what}, as a network", in_folder(by_osl, document, [*options, "--osl-network"]), reference, expected)
    if what in LAMPS:
        agree(f"{what}, under a lamp", *(in_folder(render, document, options, True) for render in (by_osl, traced)), expected)


if not shutil.which("oslc") or not shutil.which("testrender"):
    skip("oslc or testrender is not installed")
    finish("osl-furnace")
def materials_of(document):
    with tempfile.TemporaryDirectory() as folder:
        run(MXGEN, document, "--target", "osl", "-q", "-o", folder)
        return sorted(path.stem for path in pathlib.Path(folder).glob("*.osl"))


def compare_network(name, document, *options):
    if not NAMES or name in NAMES:
        whole, network = (in_folder(by_osl, document, [*options, *more]) for more in ([], ["--osl-network"]))
        agree(f"{name}, as a network", network, whole, 1, "as one shader", SAME)
        check_fault(f"{name}: no more light than there is", f"{max(whole)}" if not isinstance(whole, str) and max(whole) > 1.01 else None)


OURS = HERE.parent.parent / "examples"
for document in sorted(OURS.glob("slab*.mtlx")):
    for name in materials_of(document):
        compare_network(name, document, "--element", name)
with tempfile.TemporaryDirectory() as folder:
    stage = pathlib.Path(folder) / "stage.txt"
    stage.write_text("/receiver\n", encoding="utf-8")
    compare_network("stack", OURS / "slots" / "looks.mtlx", "--stage", stage, "--look", "finished")
for line in (HERE / "furnace.tsv").read_text(encoding="utf-8").splitlines()[1:]:
    name, ratio, alike, _ = (line.split("\t") + ["", "", ""])[:4]
    if NAMES and name not in NAMES:
        continue
    is_whole, is_ours = name.endswith(".mtlx"), name.startswith("slabs/")
    document = (HERE.parent if is_ours else pathlib.Path(EXAMPLES)) / name if is_whole else HERE / "furnace.mtlx"
    if is_whole and not ((EXAMPLES or is_ours) and document.exists()):
        skip(f"there is no {document}")
        continue
    element = [] if is_whole else ["--element", name]
    compare(name, document, element, float(ratio or 1))
    if alike.startswith("--"):
        compare(f"{name}, alike", document, element + alike.split(), 1)
    elif alike:
        compare(f"{name}, alike", HERE / "furnace.mtlx", ["--element", alike], 1)
finish("osl-furnace")
