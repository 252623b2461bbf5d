#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures mxgen and prints counts and ratios, never times: instructions by callgrind, peak memory, sizes of shaders,
growth with the size of a graph. Arguments: the build folder, a document, and a folder of materials for the shader counts."""
import glob
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

BUILD, DOCUMENT = sys.argv[1], sys.argv[2]
MXGEN = f"{BUILD}/mxgen"

# MaterialX 1.39.6 on standard_surface_default.mtlx, and what mxgen wants to be.
ROWS = {
    "process": ("instructions of the whole process, glsl", 295e6, 5.5e6),
    "generation": ("instructions of a generation, glsl", 29e6, 2.2e6),
    "open_pbr": ("the same, open_pbr_surface by default", None, 3e6),
    "memory": ("peak memory of the process, MB", 19.7, 8),
    "map": ("instructions to map the library", None, 100e3),
    "image": ("bytes of the library image", None, 1.4e6),
    "source complete": ("bytes of pixel source, complete", 79e3, 24e3),
    "source reduced": ("bytes of pixel source, reduced", 76e3, 8e3),
    "spirv complete": ("SPIR-V body instructions, complete", 6831, 3000),
    "spirv reduced": ("SPIR-V body instructions, reduced", None, 600),
}


# SPIR-V instructions of MaterialX 1.39.6's shaders of the 42 example materials after `spirv-opt -O`, target vulkan.
MATERIALS = {"complete": 179163, "reduced": 36563}


def run(*command, check=True):
    return subprocess.run(command, check=check, capture_output=True, text=True)


def instructions(*command):
    """Instructions executed by a program, its start included."""
    result = run("valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", *command)
    return int(re.search(r"Collected : (\d+)", result.stderr)[1])


def peak(*command):
    """Peak memory in KiB, processor time in milliseconds."""
    return [int(word) for word in run(f"{BUILD}/bench/bench-peak", *command).stdout.split()]


def generation(document, *options):
    """Instructions of the first generation of a document that is loaded already."""
    program = f"{BUILD}/bench/bench-generate"
    return (instructions(program, document, "glsl", "1", *options) - instructions(program, document, "glsl", "0", *options))


def with_materialx(folder):
    """The cost with MaterialX's own library, packed, beside that with the built-in one and that of MaterialX's generator."""
    root = os.environ.get("MXGEN_MATERIALX")
    if not root:
        print("\nMXGEN_MATERIALX names no folder with MaterialX's libraries: their cost is not measured")
        return
    image = f"{folder}/materialx.mxlib"
    run(MXGEN, "library", "pack", f"{root}/libraries", "-o", image, "-q")
    command = MXGEN, DOCUMENT, "--target", "glsl", "-o", folder
    theirs = ["--no-builtin-library", "--library", image]
    rows = (("process", instructions(*command), instructions(*command, *theirs)),
            ("generation", generation(DOCUMENT), generation(DOCUMENT, f"library={image}")))
    print(f"\n{'instructions with the library':45} {'of mxgen':>12} {'of MaterialX':>14} {'MaterialX':>14}")
    for key, own, other in rows:
        print(f"{ROWS[key][0]:45} {number(own):>12} {number(other):>14} {number(ROWS[key][1]):>14}")
    print(f"{'bytes of the library image':45} {'':12} {number(os.path.getsize(image)):>14}")


def mapping():
    """Instructions to map the library, once libxml2 has started."""
    program = f"{BUILD}/bench/bench-map"
    return instructions(program, "2") - instructions(program, "1")


def sizes():
    """Per target and interface mode: bytes of the pixel source and SPIR-V instructions."""
    table = {}
    for line in run(f"{BUILD}/mxgen-compile", DOCUMENT).stdout.splitlines():
        _, _, target, interface, size, _, pixel, _ = line.split("\t")
        table[target, interface] = int(size), int(pixel)
    return table


def optimised(source, folder):
    """SPIR-V instructions in the functions of a source after `spirv-opt -O`."""
    module = f"{folder}/pixel.spv"
    run("glslangValidator", "-V", source, "-o", module)
    run("spirv-opt", "-O", module, "-o", module)
    lines = run("spirv-dis", "--no-header", module).stdout.splitlines()
    return sum(1 for line in lines[next(i for i, line in enumerate(lines) if " OpFunction " in line):] if line.strip())


def materials(folder):
    """SPIR-V instructions of each material after `spirv-opt -O`, target vulkan; a broken document still has its other materials."""
    table = {}
    for path in sorted(glob.glob(f"{folder}/**/*.mtlx", recursive=True)):
        for interface in MATERIALS:
            with tempfile.TemporaryDirectory() as out:
                run(MXGEN, path, "-q", "--target", "vulkan", "--interface", interface, "-o", out, check=False)
                for source in sorted(glob.glob(f"{out}/*.frag")):
                    name = f"{pathlib.Path(path).stem} {pathlib.Path(source).stem}"
                    table.setdefault(name, {})[interface] = optimised(source, out)
    print(f"\n{'SPIR-V instructions after spirv-opt -O, vulkan':60} {'complete':>10} {'reduced':>10}")
    for name, counts in table.items():
        print(f"{name:60} {counts['complete']:10,} {counts['reduced']:10,}")
    for interface, reference in MATERIALS.items():
        total = sum(counts[interface] for counts in table.values())
        print(f"{len(table)} materials, {interface}: {total:,}; MaterialX's 42: {reference:,}; ratio {total / reference:.2f}, "
              f"goal 0.50: {'reached' if total * 2 <= reference else 'MISSED'}")


def number(value):
    return "-" if value is None else f"{value:,.1f}" if value < 100 and value != int(value) else f"{value:,.0f}"


def print_row(key, measured):
    what, reference, goal = ROWS[key]
    ratio = f"{reference / measured:6.1f}x" if reference else "      -"
    verdict = "reached" if measured < goal else "MISSED"
    print(f"{what:45} {number(measured):>12} {'< ' + number(goal):>12} {verdict:>8} {number(reference):>14} {ratio}")


def graph(shape, count):
    """A document with a float graph of `count` nodes: each reads the one before, once (chain) or twice (diamond)."""
    yield '<?xml version="1.0"?>\n<materialx version="1.39">\n<nodegraph name="g">\n'
    yield '<position name="p" type="vector3"/>\n'
    yield '<extract name="n0" type="float"><input name="in" type="vector3" nodename="p"/></extract>\n'
    for i in range(1, count):
        second = f'nodename="n{i - 1}"' if shape == "diamond" else f'value="{i % 97 + 0.5}"'
        node = "multiply" if i % 2 else "subtract" if shape == "chain" else "add"
        yield (f'<{node} name="n{i}" type="float"><input name="in1" type="float" nodename="n{i - 1}"/>'
               f'<input name="in2" type="float" {second}/></{node}>\n')
    yield f'<output name="out" type="float" nodename="n{count - 1}"/>\n</nodegraph>\n</materialx>\n'


def growth(folder):
    print(f"\n{'growth, per node':20} {'nodes':>10} {'instructions':>14} {'bytes of memory':>16} {'processor time, ratio':>22}")
    for shape in "chain", "diamond":
        first = None
        for count in 1_000, 10_000, 100_000, 1_000_000:
            path = f"{folder}/{shape}{count}.mtlx"
            with open(path, "w", encoding="utf-8") as out:
                out.writelines(graph(shape, count))
            command = MXGEN, path, "--target", "glsl", "-o", folder
            # callgrind is fifty times slower than the processor: the largest is judged by processor time alone
            counted = instructions(*command) if count <= 100_000 else None
            memory, time = peak(*command)
            if count == 100_000:
                first = time / count
            ratio = f"{time / count / first:.2f}" if first else "-"
            print(f"{shape:20} {count:10,} {number(counted and counted / count):>14} {memory * 1024 / count:16,.0f} {ratio:>22}")
            os.remove(path)


def cpu(*command):
    """Processor seconds of a program and what it starts; the least of three runs."""
    times = []
    for _ in range(3):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run(command, check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        times.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return min(times)


def checks(folder):
    """mxgen check over many documents, in processor time: against xmllint, how much of it is compilation, and with a cache."""
    root = "../shared/materials" if os.path.isdir("../shared/materials") else "examples"
    files = sorted(str(path) for path in pathlib.Path(root).rglob("*.mtlx") if path.is_file())
    check = [MXGEN, "check", "-q", "-j1", *files]
    alone = cpu("xmllint", "--noout", *files)
    each = sum(cpu("xmllint", "--noout", path) for path in files[::10]) / len(files[::10]) * len(files)
    generate = cpu(*check, "--no-compile")
    print(f"\nmxgen check, {len(files)} documents of {root}, one worker, ratios of processor time")
    print(f"{'documents a second without compiling, to xmllint --noout of all in one process':85} {alone / generate:6.2f} {'> 0.25':>8}")
    print(f"{'the same, to an xmllint for each document':85} {each / generate:6.2f}")
    report = cpu(*check, "--no-compile", "--json", f"{folder}/report.json")
    print(f"{'with a JSON report, for which every shader is written and measured':85} {alone / report:6.2f}")
    part = [path for path in files if "/wild/" not in path] or files
    cache = f"{folder}/cache"
    first = cpu(MXGEN, "check", "-q", "-j1", *part)
    compilers = 1 - cpu(MXGEN, "check", "-q", "-j1", "--no-compile", *part) / first
    subprocess.run([MXGEN, "check", "-q", "--cache", cache, *part], check=False, stdout=subprocess.DEVNULL)
    second = cpu(MXGEN, "check", "-q", "-j1", "--cache", cache, *part)
    print(f"{'the part of compilers, where they are asked':85} {compilers:6.2f} {'> 0.90':>8}")
    print(f"{'a second run with a cache, to the first':85} {second / first:6.3f} {'< 0.05':>8}")


def same_bytes(folder):
    """Two runs from different folders."""
    texts = []
    for name in "a", "b":
        os.makedirs(f"{folder}/{name}")
        subprocess.run([os.path.abspath(MXGEN), os.path.abspath(DOCUMENT), "--reflect", "-q"], cwd=f"{folder}/{name}", check=True)
        texts.append({file: open(f"{folder}/{name}/{file}", "rb").read() for file in os.listdir(f"{folder}/{name}")})
    return texts[0] == texts[1]


def main():
    with tempfile.TemporaryDirectory() as folder:
        print(f"{os.path.basename(DOCUMENT):45} {'mxgen':>12} {'goal':>12} {'':8} {'MaterialX':>14}   ratio")
        command = MXGEN, DOCUMENT, "--target", "glsl", "-o", folder
        base = instructions(f"{BUILD}/bench/bench-parse", DOCUMENT)
        process = instructions(*command)
        print_row("process", process)
        print_row("generation", generation(DOCUMENT))
        print_row("open_pbr", generation("bench/open_pbr_default.mtlx"))
        print_row("memory", peak(*command)[0] * 1024 / 1e6)
        print_row("map", mapping())
        print_row("image", os.path.getsize(f"{BUILD}/libraries/stdlib.mxlib"))
        if os.path.exists(f"{BUILD}/mxgen-compile"):
            table = sizes()
            for interface in "complete", "reduced":
                print_row(f"source {interface}", table["glsl", interface][0])
            for interface in "complete", "reduced":
                print_row(f"spirv {interface}", table["glsl", interface][1])
        print(f"\nprocess / libxml2 alone (start and parse: {base:,} instructions): {process / base:.2f}")
        print(f"libxml2 alone: {number(peak(f'{BUILD}/bench/bench-parse', DOCUMENT)[0] * 1024 / 1e6)} MB peak")
        print(f"two runs in two folders give the same bytes: {'yes' if same_bytes(folder) else 'NO'}")
        with_materialx(folder)
        checks(folder)
        if len(sys.argv) > 3:
            materials(sys.argv[3])
        growth(folder)


if __name__ == "__main__":
    main()
