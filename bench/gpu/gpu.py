#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares shaders as AMD GPUs run them with those of MaterialX 1.39.6, as ratios: statistics of Mesa's RADV, which compiles for a GPU that
need not be there. Arguments: the build folder, the folder of MaterialX's example documents, and perhaps parts of names of documents."""
import collections
import concurrent.futures
import csv
import glob
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

BUILD, EXAMPLES, PARTS = sys.argv[1], "".join(sys.argv[2:3]), sys.argv[3:]
GPUS = "navi21", "vega10"
INTERFACES = "complete", "reduced"
DRIVERS = "/usr/share/vulkan/icd.d/radeon_icd.*.json"

# Column of materialx.tsv, the driver's names for it, what it is, which is worse, goals for median and worst by interface.
Figure = collections.namedtuple("Figure", "names title worse complete reduced")
FIGURES = {
    "instructions": Figure(("Instructions", "Instruction Count"), "instructions", max, (0.45, 0.8), (0.8, 1.0)),
    "vgprs": Figure(("VGPRs",), "registers (VGPR)", max, (0.75, 1.0), (0.9, 1.0)),
    "subgroups_per_simd": Figure(("Subgroups per SIMD",), "waves per SIMD", min, (1.0, 1.0), None),
    "inverse_throughput": Figure(("Inverse Throughput",), "inverse throughput", max, (0.35, 0.6), (0.45, 0.8)),
}


def reference():
    """Rows of MaterialX by document, interface and GPU."""
    with open(pathlib.Path(__file__).parent / "materialx.tsv", encoding="utf-8") as table:
        return {(row["document"], row["interface"], row["gpu"]): row for row in csv.DictReader(table, delimiter="\t")}


def driver():
    """The driver's file; None if Mesa's RADV is not installed."""
    return next(iter(sorted(glob.glob(DRIVERS))), None)


def run(*command, **variables):
    return subprocess.run(command, check=True, capture_output=True, text=True, env=dict(os.environ, **variables)).stdout


def modules(document, interface, folder):
    """SPIR-V of the vertex and the pixel stage of the document's first material."""
    path = next(pathlib.Path(EXAMPLES).glob(f"**/{document}.mtlx"))
    run(f"{BUILD}/mxgen", str(path), "-q", "--target", "vulkan", "--interface", interface, "-o", folder)
    return compiled(sorted(glob.glob(f"{folder}/*.frag"))[0])


def compiled(pixel):
    """SPIR-V of a pixel stage and of the vertex stage beside it."""
    made = []
    for source in pixel[:-len("frag")] + "vert", pixel:
        made.append(source + ".spv")
        run("glslangValidator", "-V", source, "-o", made[-1])
    return made


def measure(job):
    """A row per GPU: document, interface, GPU, statistics by name."""
    document, interface = job
    with tempfile.TemporaryDirectory() as folder:
        spirv = modules(document, interface, folder)
        for gpu in GPUS:
            yield document, interface, gpu, statistics_of(spirv, gpu)


def statistics_of(spirv, gpu):
    text = run(f"{BUILD}/bench/bench-gpustat", *spirv, VK_ICD_FILENAMES=driver(), RADV_FORCE_FAMILY=gpu, MESA_SHADER_CACHE_DISABLE="true")
    return dict(line.split("=") for line in text.splitlines())


def value(figure, row):
    return int(next(row[name] for name in figure.names if name in row))


def table(rows, theirs):
    """A line per shader, and the ratios by interface, GPU and figure."""
    ratios = collections.defaultdict(list)
    print(f"| document, mxgen / MaterialX on {GPUS[0]} | interface | " + " | ".join(f.title for f in FIGURES.values()) + " |")
    print("| --- | --- |" + " --- |" * len(FIGURES))
    for document, interface, gpu, row in rows:
        cells = []
        for column, figure in FIGURES.items():
            ours, other = value(figure, row), int(theirs[document, interface, gpu][column])
            ratios[interface, gpu, column].append(ours / other)
            cells.append(f"{ours:,} / {other:,}")
        if gpu == GPUS[0]:
            print(f"| {document} | {interface} | {' | '.join(cells)} |")
    return ratios


def verdict(figure, median, worst, goal):
    if not goal:
        return "-", ""
    fits = (lambda ratio, limit: ratio <= limit + 0.005) if figure.worse is max else (lambda ratio, limit: ratio >= limit - 0.005)
    reached = fits(median, goal[0]) and fits(worst, goal[1])
    return f"{goal[0]:.2f} / {goal[1]:.2f}", "reached" if reached else "missed"


def summary(ratios):
    print("\n| median / worst | " + " | ".join(GPUS) + " | goal | |\n| --- |" + " --- |" * len(GPUS) + " --- | --- |")
    for interface in INTERFACES:
        for column, figure in FIGURES.items():
            pairs = [(statistics.median(r), figure.worse(r)) for r in (ratios[interface, gpu, column] for gpu in GPUS)]
            worst = figure.worse(pairs, key=lambda pair: pair[0])[0], figure.worse(pair[1] for pair in pairs)
            goal, word = verdict(figure, *worst, getattr(figure, interface))
            cells = " | ".join(f"{median:.2f} / {far:.2f}" for median, far in pairs)
            print(f"| {interface}: {figure.title} | {cells} | {goal} | {word} |")


def main():
    theirs = reference()
    if not driver():
        print("skip: no RADV; the package mesa-vulkan-drivers has it")
        return
    if not os.path.isdir(EXAMPLES):
        print(f"skip: no example documents in '{EXAMPLES}'")
        return
    documents = sorted({document for document, _, _ in theirs if not PARTS or any(part in document for part in PARTS)})
    if not documents:
        sys.exit(f"no example document has one of these parts in its name: {' '.join(PARTS)}")
    jobs = [(document, interface) for interface in INTERFACES for document in documents]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        rows = [row for rows in pool.map(lambda job: list(measure(job)), jobs) for row in rows]
    print(f"{len(documents)} documents, target vulkan\n")
    summary(table(rows, theirs))


if __name__ == "__main__":
    main()
