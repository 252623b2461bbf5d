#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Materials of engines that were wrong once, with the light that they have to return: in shaders, and drawn forward, through the deferred
pipeline and by paths.

Arguments: mxgen, mxgen-render ('' to draw nothing)."""
import pathlib
import re
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path += [str(HERE.parent), str(HERE.parent / "programs")]
import balls
import exr
from checks import check, finish, run, skip

MXGEN, RENDER = (pathlib.Path(arg).resolve() if arg else None for arg in sys.argv[1:3])
FILES = HERE / "faults"
WAYS = {"forward": (), "deferred": ("--role", "deferred"), "traced": ("--path-trace", "--paths", "64")}
SIZE = 24
# In even light, of the middle of a plane: a file, a channel, the least and the most of its pixels, and how far pixels may be off; the noise of paths has their mean alone.
LIGHT = (("black_texel_hole", "A", 1, 1, 0.001),
         ("add_equal_halves_deferred", "R", 1, 1, 0.005),
         ("mask_out_of_range", "R", 0.2, 0.8, 0.003),
         ("coverage_above_1_alpha", "A", 1, 1, 0.0005),
         ("white_rough1_loses_2pct", "R", 1, 1, 0.006))
# docs/slabs.md: the most that a side is off, of the estimate.
FACTOR, REST = 2.5, 0.5


def generated(name, *options):
    done = run(MXGEN, FILES / f"{name}.mtlx", "--stdout", *options)
    check(done.returncode == 0, f"{name}: {done.stderr}")
    return done


def report(path, *options):
    done = run(MXGEN, "inspect", "--slabs", path, *options)
    check(done.returncode == 0, f"{path}: {done.stderr}")
    return done.stdout


# ---- Shaders ----

def check_shaders():
    for budget in (), ("--max-slabs", 1), ("--profile", "mobile"):
        done = generated("skin_patch", "--role", "deferred", "--target", "vulkan", *budget)
        check("drawn-forward" not in done.stderr, f"skin and mud are drawn forward with {budget}: {done.stderr}")
    check("max(positionObject.x > 0.0 ? color(0.002) : color(0.0), 0.001)" in generated("black_texel_hole", "--target", "osl").stdout,
          "a black texel is clear in OSL")
    check("clamp(positionObject.x * 3.0, 0.0, 1.0)" in generated("mask_out_of_range", "--target", "osl").stdout, "OSL has a mask outside 0 to 1")


def check_budgets():
    soup = HERE / "eight.mtlx"
    last = report(soup, "--max-bytes", 48).strip().splitlines()[-1]
    numbers = re.search(r"slabs \d+ to (\d+), bytes \d+ to (\d+), estimated error (\S+)", last)
    check(numbers and int(numbers[1]) == 2 and 28 < int(numbers[2]) <= 48, f"48 bytes for eight slabs: {last}")
    check("nothing keeps to the budget; the least are 1 slabs, 12 bytes" in report(soup, "--max-bytes", 3), "3 bytes are possible, or the least is not told")


def hidden(name, *command):
    """The output for a material of hidden.mtlx, without the names in which it differs from the one without a base."""
    done = run(MXGEN, *command, HERE / "hidden.mtlx", "-q", "-e", name)
    check(done.returncode == 0, f"{name} with {command}: {done.stderr}")
    return " ".join(done.stdout.replace("_alone", "").split())


def check_hidden():
    """A base that opaque matter hides is no slab in any role, budget or report."""
    deferred = ("--stdout", "--role", "deferred", "--target", "vulkan", "--slabs")
    pack = ("--stdout", "--role", "pack", "--target", "vulkan", "--slabs", "--interface", "reduced")
    shaders = (("--stdout",), ("--stdout", "--max-slabs", 1), deferred, (*deferred, "--max-slabs", 2), ("--stdout", "--role", "payload", "--target", "vulkan"),
               pack, ("--stdout", "--role", "scatter"))
    reports = (("inspect", "--slabs"), ("inspect", "--slabs", "--max-bytes", 36), ("inspect", "--slabs", "--max-error", 0.2))
    for name in "Constant", "Covered", "Nested", "Closures":
        for way in shaders if name == "Closures" else shaders + reports:
            check(hidden(name, *way) == hidden(f"{name}_alone", *way), f"{name} with {way} is not {name}_alone")
    check("4 slabs, 1 tangent basis, 4 closures, 64 bytes" in hidden("Nested", "inspect", "--slabs"), "the coat and three opaque slabs count")
    for name, num in ("Partly", 3), ("Splashed", 2):
        check(f" {num} slabs" in hidden(name, "inspect", "--slabs"), f"the base of {name} is seen, so it counts")


# ---- Pictures ----

def draw(path, document, *options):
    done = run(RENDER, document, "-q", "-o", path, *options)
    if done.returncode and "no-device" in done.stderr:
        return False
    check(done.returncode == 0, f"render {document} {options}: {done.stderr}")
    return done.returncode == 0


def check_light(folder):
    """False: there is no device."""
    white = folder / "white.hdr"
    white.write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n" + b"\200\200\200\201" * 32)
    for name, channel, least, most, error in LIGHT:
        means = {}
        for way, options in WAYS.items():
            path = folder / "light.exr"
            if not draw(path, FILES / f"{name}.mtlx", "-s", SIZE, "-m", "plane", "--camera", "0,0", "--environment", white, "--lights", "none", *options):
                return False
            middle = slice(SIZE // 4, -SIZE // 4)
            pixels = [value for row in exr.read(path)[2][channel][middle] for value in row[middle]]
            means[way] = sum(pixels) / len(pixels)
            is_right = abs(min(pixels) - least) < error and abs(max(pixels) - most) < error
            check(way == "traced" or is_right, f"{name}, {way}: {channel} is {min(pixels)} to {max(pixels)}")
        for way, mean in means.items():
            check(abs(mean - means["forward"]) < 0.01, f"{name}: the mean of {channel} is {mean} {way}, {means['forward']} forward")
    return True


def check_patch(folder):
    """A patch that faces the viewer: within the error that is asked for, and within the bound where its fuzz is lost."""
    document, camera = FILES / "small_patch_estimate.mtlx", ("-s", 48, "-m", "sphere", "--camera", "90,0")
    draw(folder / "whole.ppm", document, *camera)
    for options in ("--max-error", 0.1), ("--features", "-fuzz"):
        steps = re.findall(r"estimated error (\S+)", report(document, *options))
        draw(folder / "less.ppm", document, *camera, *options)
        drawn, estimated = balls.compare(folder / "whole.ppm", folder / "less.ppm"), float(steps[-1])
        check(drawn <= FACTOR * estimated + REST, f"a patch with {options}: drawn {drawn}, estimated {estimated}")
        check((drawn < 0.5) == (options[0] == "--max-error"), f"a patch with {options}: drawn {drawn}")


check_shaders()
check_budgets()
check_hidden()
with tempfile.TemporaryDirectory() as name:
    if not RENDER:
        skip("nothing is drawn")
    elif check_light(pathlib.Path(name)):
        check_patch(pathlib.Path(name))
    else:
        skip("there is no Vulkan device")
finish("slab-faults")
