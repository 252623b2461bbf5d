#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The cost of layers (docs/benchmarks.md, "Slots"): stacks of standard_surface whose masks are textures, blended and picked, beside one layer.
bench-slots draws them by lavapipe (pixels), and counts what their shaders do (operations); gpu is what Mesa's compiler for AMD GPUs makes of them.

Arguments: the build folder, and perhaps parts of these three."""
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent / "gpu"))
import gpu
from slot_stacks import COUNTS, write_looks

BUILD, PARTS = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:] or ["operations", "pixels", "gpu"]
MODES = "blend", "stochastic"


def drawn(part, document):
    looks = [f"L{count}" for count in COUNTS]
    subprocess.run([BUILD / "bench" / "bench-slots", part, document, *looks], env=dict(os.environ, MESA_SHADER_CACHE_DISABLE="true"), check=True)


def gpu_rows(document):
    if not gpu.driver():
        print("skip: no RADV; the package mesa-vulkan-drivers has it")
        return
    print("| layers | mode | " + " | ".join(figure.title for figure in gpu.FIGURES.values()) + f" on {gpu.GPUS[0]} |")
    print("| --- | --- |" + " --- |" * len(gpu.FIGURES))
    (document.parent / "stage.txt").write_text("/quad\n", encoding="utf-8")
    for count in COUNTS:
        for mode in MODES:
            out = document.parent / f"{count}_{mode}"
            gpu.run(str(BUILD / "mxgen"), str(document), "-q", "--look", f"L{count}", "--stage", str(document.parent / "stage.txt"), "--slots", mode,
                    "--target", "vulkan", "--interface", "complete", "-o", str(out))
            row = gpu.statistics_of(gpu.compiled(str(next(out.glob("*.frag")))), gpu.GPUS[0])
            print(f"| {count} | {mode} | " + " | ".join(f"{gpu.value(figure, row):,}" for figure in gpu.FIGURES.values()) + " |", flush=True)


def main():
    with tempfile.TemporaryDirectory() as name:
        document = write_looks(pathlib.Path(name))
        for part in PARTS:
            if part == "gpu":
                gpu_rows(document)
            else:
                drawn(part, document)
            print(flush=True)


main()
