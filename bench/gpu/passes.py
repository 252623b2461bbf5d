#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The deferred pipeline as AMD GPUs run it (docs/benchmarks.md, "On GPUs"): the passes that belong to no material, and the material pass of each
example beside its forward shader. Arguments: the build folder, and examples/deferred.mtlx."""
import pathlib
import sys
import tempfile

import gpu

BUILD, EXAMPLES = sys.argv[1:]


def row(what, kind, spirv):
    figures = gpu.statistics_of(spirv, gpu.GPUS[0])
    print(f"| {what} | {kind} | " + " | ".join(f"{gpu.value(figure, figures):,}" for figure in gpu.FIGURES.values()) + " |", flush=True)


def main():
    if not gpu.driver():
        print("skip: no RADV; the package mesa-vulkan-drivers has it")
        return
    with tempfile.TemporaryDirectory() as folder:
        gpu.run(f"{BUILD}/mxgen", "pipeline", folder, "-q")
        print(f"\n| what | pass on {gpu.GPUS[0]} | " + " | ".join(figure.title for figure in gpu.FIGURES.values()) + " |")
        print("| --- | --- |" + " --- |" * len(gpu.FIGURES))
        for source in sorted(pathlib.Path(folder).glob("*.comp")):
            gpu.run("glslangValidator", "-V", str(source), "-o", f"{source}.spv")
            row(source.stem, "whole screen", [f"{source}.spv"])
        for role in "deferred", "raster":
            gpu.run(f"{BUILD}/mxgen", EXAMPLES, "-q", "--target", "vulkan", "--role", role, "-o", f"{folder}/{role}")
        for source in sorted(pathlib.Path(folder, "deferred").glob("*.frag")):
            depth = source.stem.endswith(".depth")
            row(source.stem.removesuffix(".depth"), "depth" if depth else "material", gpu.compiled(str(source)))
            if not depth:
                row(source.stem, "forward", gpu.compiled(f"{folder}/raster/{source.name}"))


main()
