#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`--transparency dual`: what a surface lets through is a second source, a colour. Behind two sheets of a clear medium the background has
the product of their transmittances, channel by channel; with `blend` it has their mean in all channels.

Arguments: mxgen, mxgen-compile, mxgen-render ('' to draw nothing)."""
import json
import math
import pathlib
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
import balls
from checks import check, finish, run, skip

MXGEN, COMPILE, RENDER = (pathlib.Path(arg).resolve() if arg else None for arg in sys.argv[1:4])
PATHS = 0.1, 0.01, 0.005  # mean free paths; the sheet is 0.01 thick
CLEAR = 1e4, 1e4, 1e4
SIZE = 32
SOURCES = [  # target, stage, and what the language says of the two sources
    ("vulkan", "frag", ["layout(location = 0, index = 1) out vec4 out2;"]),
    ("glsl", "frag", ["layout(location = 0, index = 1) out vec4 out2;"]),
    ("hlsl", "ps.hlsl", ["out float4 out1 : SV_Target0", "out float4 out2 : SV_Target1"]),
    ("slang", "frag.slang", [f"[[vk::location(0)]] [[vk::index({i})]] out float4 out{i + 1} : SV_Target{i}" for i in (0, 1)]),
    ("msl", "frag.metal", ["float4 out1 [[color(0)]];", "float4 out2 [[color(0), index(1)]];"]),
    ("wgsl", "frag.wgsl", ["enable dual_source_blending;", "@blend_src(0) @location(0) out1: vec4f", "@blend_src(1) @location(0) out2: vec4f"]),
]


def sheet(paths):
    return f"""<materialx version="1.39">
  <slab name="glass" type="BSDF"><input name="diffuse_albedo" type="color3" value="0, 0, 0"/><input name="f0" type="color3" value="0, 0, 0"/>
    <input name="mean_free_path" type="vector3" value="{", ".join(map(str, paths))}"/></slab>
  <slab_surface name="SR" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="glass"/><input name="thin" type="boolean" value="true"/>
    <input name="surface_thickness" type="float" value="0.01"/></slab_surface>
  <surfacematerial name="Glass" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SR"/></surfacematerial>
</materialx>"""


def middle(folder, paths, *options):
    """The linear colour in the middle of a ball of the sheet, whose front and back are two sheets."""
    (folder / "glass.mtlx").write_text(sheet(paths))
    made = run(RENDER.parent / "mxgen", "render", folder / "glass.mtlx", "-q", "--mesh", "sphere", "--size", SIZE, "--background", "environment",
               "-o", folder / "ball.ppm", *options)
    check(made.returncode == 0, made.stderr)
    width, _, pixels = balls.read_ppm(folder / "ball.ppm")
    at = 3 * (SIZE // 2 * width + width // 2)
    return [balls.linear(value) for value in pixels[at:at + 3]]


def check_pictures(folder):
    behind = middle(folder, CLEAR, "--transparency", "dual")
    through = [math.exp(-2 * 0.01 / path) for path in PATHS]
    seen = middle(folder, PATHS, "--transparency", "dual")
    for b, t, s in zip(behind, through, seen):
        check(abs(s - b * t) < 0.01 * b + 0.002, f"dual shows {s:.4f}, and {b * t:.4f} comes through")
    grey = middle(folder, PATHS)
    ratios = [g / b for g, b in zip(grey, behind)]
    mean = (sum(math.exp(-0.01 / path) for path in PATHS) / 3) ** 2
    check(all(abs(r - mean) < 0.02 for r in ratios), f"blend shows {ratios}, and {mean:.3f} is the mean")


def check_sources(folder):
    document = folder / "sheet.mtlx"
    document.write_text(sheet(PATHS))
    for target, stage, declarations in SOURCES:
        made = run(COMPILE, document, "--targets", target, "--transparency", "dual") if COMPILE else None
        check(not made or made.returncode == 0, f"{target}: {made and made.stderr}")
        made = run(MXGEN, document, "--target", target, "--transparency", "dual", "-o", folder, "--reflect")
        text = (folder / f"Glass.{stage}").read_text()
        check(all(line in text for line in declarations), f"{target}: no second source")
        check('"transmittance"' in (folder / "Glass.json").read_text(), f"{target}: the reflection does not name the second source")
        features = json.loads((folder / "Glass.json").read_text()).get("deviceFeatures")
        check(features == ("dual-source-blending" if target == "wgsl" else None), f"{target}: features {features}")
    for target in "essl", "essl310":
        made = run(MXGEN, document, "--target", target, "--transparency", "dual", "--stdout")
        check(made.returncode == 1 and "[options-clash]" in made.stderr, f"{target} has no second source: {made.stderr}")
    made = run(MXGEN, HERE.parent / "golden" / "aov.mtlx", "--target", "vulkan", "--transparency", "dual", "--stdout")
    check(made.returncode == 1 and "one attachment" in made.stderr, f"AOVs beside a second source: {made.stderr}")
    plain = '<oren_nayar_diffuse_bsdf name="d" type="BSDF"/><surface name="SR" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="d"/></surface>'
    document.write_text(f'<materialx version="1.39">{plain}</materialx>')
    made = run(MXGEN, document, "--target", "vulkan", "--transparency", "dual", "--stdout", "--interface", "reduced")
    check("out2 = vec4(0.0);" in made.stdout, f"an opaque surface lets something through: {made.stderr}")


def main():
    with tempfile.TemporaryDirectory() as folder:
        check_sources(pathlib.Path(folder))
        if RENDER:
            check_pictures(pathlib.Path(folder))
        else:
            skip("without mxgen-render no picture is drawn")
    finish("dual")


main()
