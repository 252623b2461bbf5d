#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""SPIR-V that Slang's compiler makes of the target slang, beside that of the target vulkan, as AMD GPUs run them: ratios over MaterialX's
examples. MXGEN_SLANG names slang-wasm.js. Arguments: as of gpu.py. It fails where a ratio is beyond its limit."""
import collections
import glob
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

import gpu

# Both are one program: a GPU needs the same for either, but for the order of instructions, which may take one step of 8 registers.
LIMITS = {"instructions": 1.02, "vgprs": 1.08, "subgroups_per_simd": 1.0, "inverse_throughput": 1.02}
COMPILER = pathlib.Path(__file__).resolve().parents[2] / "compile"


class Slang:
    """slang-wasm in Node, which answers requests (compile/answer.mjs)."""

    def __init__(self):
        script = "".join((COMPILER / name).read_text(encoding="utf-8") for name in ("slang.mjs", "answer.mjs"))
        self.process = subprocess.Popen(["node", "--input-type=module", "-e", script], stdin=subprocess.PIPE, stdout=subprocess.PIPE)

    def compile(self, sources, targets):
        """Writes SPIR-V of a vertex and a pixel stage."""
        texts = [pathlib.Path(source).read_bytes() for source in sources]
        self.process.stdin.write(b"%d %d\n" % tuple(map(len, texts)) + b"".join(texts))
        self.process.stdin.flush()
        log, *words, _ = (self.process.stdout.read(int(size)) for size in self.process.stdout.readline().split())
        if not all(words):
            raise RuntimeError(log.decode())
        for target, module in zip(targets, words):
            pathlib.Path(target).write_bytes(module)
        return targets

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def modules(slang, document, interface, folder):
    """SPIR-V of both stages by Slang."""
    path = next(pathlib.Path(gpu.EXAMPLES).glob(f"**/{document}.mtlx"))
    gpu.run(f"{gpu.BUILD}/mxgen", str(path), "-q", "--target", "slang", "--interface", interface, "-o", folder)
    pixel = sorted(glob.glob(f"{folder}/*.frag.slang"))[0]
    return slang.compile((pixel.replace(".frag.", ".vert."), pixel), (f"{folder}/slang.vert.spv", f"{folder}/slang.frag.spv"))


def main():
    documents = sorted({document for document, _, _ in gpu.reference() if not gpu.PARTS or any(part in document for part in gpu.PARTS)})
    if not gpu.driver() or not os.path.isfile(os.environ.get("MXGEN_SLANG", "")) or not os.path.isdir(gpu.EXAMPLES):
        print("skip: RADV, MXGEN_SLANG or the example documents are missing")
        return 77
    slang, ratios = Slang(), collections.defaultdict(list)
    for interface in gpu.INTERFACES:
        for document in documents:
            with tempfile.TemporaryDirectory() as folder:
                pair = modules(slang, document, interface, folder), gpu.modules(document, interface, folder)
                theirs, ours = (gpu.statistics_of(spirv, gpu.GPUS[0]) for spirv in pair)
            for column, figure in gpu.FIGURES.items():
                ratios[interface, column].append(gpu.value(figure, theirs) / gpu.value(figure, ours))
    slang.close()
    print(f"\n| slang / vulkan on {gpu.GPUS[0]}, {len(documents)} documents | median | least | most | |\n| --- | --- | --- | --- | --- |")
    missed = 0
    for (interface, column), found in ratios.items():
        figure, limit = gpu.FIGURES[column], LIMITS[column]
        is_missed = figure.worse(found) > limit if figure.worse is max else min(found) < limit
        missed += is_missed
        print(f"| {interface}: {figure.title} | {statistics.median(found):.3f} | {min(found):.3f} | {max(found):.3f} | {'missed' if is_missed else ''} |")
    print(f"gpu-slang: {len(ratios) - missed} passed, {missed} failed")
    return int(missed > 0)


sys.exit(main())
