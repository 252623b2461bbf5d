#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The cost of layers (docs/benchmarks.md, "Slots"): stacks of standard_surface whose masks are textures, blended and picked, beside one layer.
The processor time that lavapipe takes for the pixels of a plane: that of a larger picture less that of a smaller one. And what Mesa's compiler for AMD GPUs makes of the shaders.

Arguments: the build folder, and perhaps "pixels" or "gpu" for one of the two."""
import math
import os
import pathlib
import random
import statistics
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent / "gpu"))
import gpu

BUILD, PARTS = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:] or ["pixels", "gpu"]
COUNTS, MODES = (1, 2, 4, 8), ("blend", "stochastic")
SMALL, LARGE, RUNS = 32, 256, 5

STAGE = """#usda 1.0
def Camera "camera"
{
    float focalLength = 10
    float horizontalAperture = 8
    float verticalAperture = 8
    double3 xformOp:translate = (0, 0, 10)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Mesh "plane"
{
    point3f[] points = [(-5, -5, 0), (5, -5, 0), (5, 5, 0), (-5, 5, 0)]
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    uniform token subdivisionScheme = "none"
    texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (
        interpolation = "vertex"
    )
}
"""


def write_mask(path, dice):
    """Smooth blobs, half of them covered."""
    waves = [(dice.uniform(1, 5), dice.uniform(1, 5), dice.uniform(0, 6.3)) for _ in range(4)]
    pixels = bytearray()
    for y in range(64):
        for x in range(64):
            value = sum(math.sin(a * x / 10 + b * y / 10 + c) for a, b, c in waves)
            pixels.append(max(0, min(255, int(127.5 + 100 * value))))
    path.write_bytes(b"P5\n64 64\n255\n" + bytes(pixels))


def write_documents(folder):
    """A look of each number of layers: every layer has other values of the same inputs."""
    dice = random.Random(17)
    lines = ['<?xml version="1.0"?><materialx version="1.39">']
    for i in range(max(COUNTS)):
        write_mask(folder / f"mask{i}.pgm", dice)
        color, roughness = ", ".join(f"{dice.uniform(0.1, 0.8):.3f}" for _ in range(3)), f"{dice.uniform(0.2, 0.6):.3f}"
        lines.append(f'<image name="i{i}" type="float"><input name="file" type="filename" value="mask{i}.pgm"/></image>'
                     f'<standard_surface name="s{i}" type="surfaceshader"><input name="base_color" type="color3" value="{color}"/>'
                     f'<input name="specular_roughness" type="float" value="{roughness}"/><input name="metalness" type="float" value="0.{i + 1}"/>'
                     f'</standard_surface><substance name="m{i}" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s{i}"/>'
                     + (f'<input name="mask" type="float" nodename="i{i}"/>' if i else "") + "</substance>")
    for count in COUNTS:
        assigns = "".join(f'<materialassign slot="{i:03}" material="m{i}" geom="/"/>' for i in range(count))
        lines.append(f'<look name="L{count}">{assigns}</look>')
    (folder / "look.mtlx").write_text("\n".join(lines + ["</materialx>"]), encoding="utf-8")
    (folder / "stage.usda").write_text(STAGE, encoding="utf-8")


def seconds(folder, count, mode, size):
    """Processor time of the whole program. A mode may have a number that picks the layers of all pixels."""
    mode, _, number = mode.partition(" ")
    command = [BUILD / "mxgen-render", "look.mtlx", "--stage", "stage.usda", "--look", f"L{count}",
               "--slots", mode, "-s", size, "-o", "out.ppm", "--samples", "16", "--interface", "complete"]
    if number:
        command += ["--layer-sample", number]
    env = dict(os.environ, LP_NUM_THREADS="0", MESA_SHADER_CACHE_DISABLE="true")
    before = os.times().children_user
    subprocess.run([str(part) for part in command], cwd=folder, env=env, capture_output=True, check=True)
    return os.times().children_user - before


def pixels(folder):
    """Rounds of all stacks, one after the other: the median of the ratios to the one layer of the same round."""
    modes = "blend", "stochastic 0.3", "stochastic"
    stacks = [(1, "blend")] + [(count, mode) for count in COUNTS[1:] for mode in modes]
    times = {stack: [] for stack in stacks}
    for _ in range(RUNS):
        for stack in stacks:
            times[stack].append(seconds(folder, *stack, LARGE) - seconds(folder, *stack, SMALL))
    print("| layers | blend | stochastic, one number for all pixels | stochastic, a hash in each pixel |\n| --- | --- | --- | --- |")
    for count in COUNTS[1:]:
        cells = [statistics.median(time / one for time, one in zip(times[count, mode], times[1, "blend"])) for mode in modes]
        print(f"| {count} | {' | '.join(f'{cell:.2f}' for cell in cells)} |", flush=True)
    print(f"One layer: {statistics.median(times[1, 'blend']) * 1e9 / (LARGE**2 - SMALL**2):,.0f} nanoseconds for a pixel.")


def gpu_rows(folder):
    if not gpu.driver():
        print("skip: no RADV; the package mesa-vulkan-drivers has it")
        return
    print("\n| layers | mode | " + " | ".join(figure.title for figure in gpu.FIGURES.values()) + f" on {gpu.GPUS[0]} |")
    print("| --- | --- |" + " --- |" * len(gpu.FIGURES))
    for count in COUNTS:
        for mode in MODES:
            out = folder / f"{count}_{mode}"
            gpu.run(str(BUILD / "mxgen"), str(folder / "look.mtlx"), "-q", "--look", f"L{count}", "--stage", str(folder / "stage.usda"), "--slots", mode,
                    "--target", "vulkan", "--interface", "complete", "-o", str(out))
            # the camera has the other stack
            pixel = max(out.glob("*.frag"), key=lambda path: path.stat().st_size)
            row = gpu.statistics_of(gpu.compiled(str(pixel)), gpu.GPUS[0])
            print(f"| {count} | {mode} | " + " | ".join(f"{gpu.value(figure, row):,}" for figure in gpu.FIGURES.values()) + " |", flush=True)


def main():
    with tempfile.TemporaryDirectory() as name:
        write_documents(pathlib.Path(name))
        if "pixels" in PARTS:
            pixels(pathlib.Path(name))
        if "gpu" in PARTS:
            gpu_rows(pathlib.Path(name))


main()
