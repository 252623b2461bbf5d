#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Each step of a budget, and each feature turned off, lowers closures, bytes or the instructions of the shader, and raises neither closures
nor bytes: all examples of slabs, with all steps there are, and once with each feature alone.

Arguments: mxgen-compile, the folder of examples."""
import pathlib
import re
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
from checks import check, finish

COMPILE, EXAMPLES = (pathlib.Path(arg).resolve() for arg in sys.argv[1:3])
DOCUMENTS = ("slabs", "slab_blends", "slab_helpers", "slab_glints", "deferred", "frosted", "slab_bodies")
FEATURES = ("glints", "lut", "fuzz", "second-lobe", "f90", "anisotropy", "subsurface", "roughness-tracking", "rough-refraction")
# Without these a number is a constant, so two lobes may have two specialised functions in place of one: more code, of which less runs.
CONSTANT = ("roughness of what lies below", "blur of what lies below")
STEP = re.compile(r"warning: (?:document: )?(.*): slabs (\d+) to (\d+), bytes (\d+) to (\d+), .*\[budget-step\]")
ALL_STEPS = ("--max-error", 100)


def compiled(document, *options):
    """The instructions of each material, and the steps that the compiler tells."""
    command = [COMPILE, document, "--targets", "vulkan", "--interfaces", "complete", "--rough-refraction", "blur", "-Wbudget-step", *options]
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    check(result.returncode == 0, f"{' '.join(map(str, command))}: {result.stderr}")
    rows = [line.split("\t") for line in result.stdout.splitlines()]
    return {row[1]: int(row[6]) for row in rows}, [(step[0], *map(int, step[1:])) for step in STEP.findall(result.stderr)]


def check_step(material, step, before, after):
    what, closures, fewer_closures, size, smaller_size = step
    check(fewer_closures <= closures and smaller_size <= size, f"{material}: {what} raises {step}")
    saves = fewer_closures < closures or smaller_size < size or after < before
    check(saves or what.removeprefix("no ") in CONSTANT, f"{material}: {what} saves nothing, {before} to {after} instructions")


def check_steps(document, material, whole):
    before = whole
    steps = compiled(document, "-e", material, *ALL_STEPS)[1]
    for count, step in enumerate(steps, 1):
        after = compiled(document, "-e", material, *ALL_STEPS, "--max-steps", count)[0][material]
        check_step(material, step, before, after)
        before = after


def check_features(document, material, whole):
    """Returns the features that the material has."""
    had = set()
    for feature in FEATURES:
        instructions, steps = compiled(document, "-e", material, "--features", f"-{feature}")
        check(len(steps) <= 1, f"{material}: -{feature} takes the steps {steps}")
        for step in steps:
            check_step(material, step, whole, instructions[material])
            had.add(feature)
        check(steps or instructions[material] == whole, f"{material}: -{feature} changes the shader, and no step tells it: {whole} {instructions}")
    return had


def main():
    had = set()
    for document in (EXAMPLES / f"{name}.mtlx" for name in DOCUMENTS):
        for material, whole in compiled(document)[0].items():
            check_steps(document, material, whole)
            had |= check_features(document, material, whole)
    check(had == set(FEATURES), f"no example has {set(FEATURES) - had}")
    finish("slab-steps")


if __name__ == "__main__":
    main()
