#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How far pictures are from the truth, and what they cost: rasters of mxgen and of MaterialX against a path tracer, by the number of samples
of the environment. Needs `mxgenpeer`, which writes MaterialX's shaders; without it the figures are those of mxgen alone.

    bench/error.py BUILD FOLDER [--size 64] [--paths 256] [--interface reduced] [--plots FOLDER] FILE...

Draws the first material of each document on a ball, under the light of four maps. FOLDER keeps pictures and shaders, which a second run does
not make again. Prints tables (docs/benchmarks.md, "Light at equal error"); --plots writes a picture for each folder of documents."""
import argparse
import collections
import json
import math
import pathlib
import shutil
import statistics
import struct
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "gpu"))
import error_plot  # pylint: disable=wrong-import-position
import reflect  # pylint: disable=wrong-import-position

GENERATOR, SAMPLES = "mxgenpeer", 16  # of MaterialX's hosts
THEIRS, OURS = "MaterialX", ("draft", "good", "reference")
Row = collections.namedtuple("Row", "material way samples operations reads mean most")

# ---- Maps: radiance by the unit direction (x, y up, z); lights have a direction, half the width and height, and a radiance


def rectangle(d, centre, width, height):
    """Whether direction d meets a rectangle that faces the origin."""
    length = math.hypot(*centre)
    c = [x / length for x in centre]
    side = [c[2], 0.0, -c[0]]
    scale = math.hypot(*side) or 1.0
    side = [x / scale for x in side]
    up = [c[1] * side[2] - c[2] * side[1], c[2] * side[0] - c[0] * side[2], c[0] * side[1] - c[1] * side[0]]
    ahead, across, along = (sum(a * b for a, b in zip(d, axis)) for axis in (c, side, up))
    return ahead > 0 and abs(across) < width * ahead and abs(along) < height * ahead


def sky(d):
    sun = sum(a * b for a, b in zip(d, (0.48, 0.6, 0.64)))
    if sun > math.cos(math.radians(2)):
        return 900.0, 830.0, 700.0
    if d[1] < 0:
        return 0.18, 0.16, 0.13
    return tuple(a + (b - a) * d[1] ** 0.5 for a, b in zip((0.9, 0.95, 1.0), (0.15, 0.3, 0.75)))


def studio(d):
    boxes = ((1.0, 0.6, 0.3), 0.25, 0.25, 8.0), ((-1.0, 0.3, 0.6), 0.35, 0.5, 3.0), ((0.2, 0.2, -1.0), 0.15, 0.6, 12.0), ((0.3, 1.0, 0.5), 0.3, 0.3, 5.0)
    return (next((light for centre, width, height, light in boxes if rectangle(d, centre, width, height)), 0.05),) * 3


def overcast(d):
    """The luminance of the CIE's overcast sky (CIE S 011): a third at the horizon."""
    return tuple(x * ((1 + 2 * d[1]) / 3 if d[1] > 0 else 0.1) for x in (0.9, 0.95, 1.0))


def window(d):
    return (60.0, 57.0, 50.0) if rectangle(d, (1.0, 0.5, 0.6), 0.12, 0.18) else (0.02, 0.02, 0.02)


MAPS = {"sky": sky, "studio": studio, "overcast": overcast, "window": window}


def write_map(path, radiance, width):
    """A latitude-longitude map in Radiance's format, whose texels are sharp: of few directions each is a mean of four."""
    height, texels = width // 2, bytearray()
    for i in range(width * height):
        color = [0.0] * 3
        for k in range(4):
            polar, around = math.pi * (i // width + 0.25 + k // 2 / 2) / height, 2 * math.pi * (i % width + 0.25 + k % 2 / 2) / width
            d = math.sin(polar) * math.sin(around), math.cos(polar), math.sin(polar) * math.cos(around)
            color = [a + b / 4 for a, b in zip(color, radiance(d))]
        mantissa, exponent = math.frexp(max(color))
        texels += struct.pack("4B", *(min(int(x * mantissa * 256 / max(color)), 255) for x in color), exponent + 128)
    path.write_bytes(f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode() + texels)


# ---- MaterialX's shaders


def add_values(blocks, document, interface, build, folder):
    """The textures of a shader and the values of its inputs, as the reflection of mxgen's tells them. An input that mxgen's lacks is 0:
    what no raster of mxgen reads, such as the anisotropy of scattering, MaterialX's ignore, too."""
    subprocess.run([f"{build}/mxgen", document, "-q", "--target", "vulkan", "--interface", interface, "--reflect", "-o", folder], check=True)
    known = {}
    for path in folder.glob("*.json"):
        for block in json.loads(path.read_text(encoding="utf-8"))["blocks"]:
            known.update({variable["name"]: variable for variable in block["variables"]})
    for variable in (variable for block in blocks if block["name"] in ("PublicUniforms", "Textures") for variable in block["variables"]):
        variable.update({key: value for key, value in known.get(variable["name"], {}).items()
                         if key in ("path", "file", "uaddressmode", "vaddressmode", "filtertype", "default")})


def write_theirs(document, libraries, build, folder, interface):
    """Writes the shaders of a document for foreign.h."""
    for kind in "fis", "prefilter":
        stem, work = folder / interface / kind / document.stem, folder / "work"
        if stem.with_suffix(".json").exists():
            continue
        shutil.rmtree(work, ignore_errors=True)
        (work / "ours").mkdir(parents=True)
        stem.parent.mkdir(parents=True, exist_ok=True)
        done = subprocess.run([GENERATOR, document, "vkglsl", work, *(["--reduced"] if interface == "reduced" else []), "--no-lights", "--env", kind,
                               "--transparency", "off", "--libs", libraries], capture_output=True, text=True, check=False)
        pixel = next(iter(sorted(work.glob("*.frag"))), None)
        if not pixel:
            print(f"{document.stem}: {GENERATOR} wrote no shader: {done.stderr.strip()[-200:]}", file=sys.stderr)
            continue
        for ending in "vert", "frag":
            shutil.copy(pixel.with_suffix(f".{ending}"), stem.with_suffix(f".{ending}"))
        made = reflect.reflection(stem.with_suffix(".vert"), stem.with_suffix(".frag"))
        add_values(made["blocks"], document, interface, build, work / "ours")
        stem.with_suffix(".json").write_text(json.dumps(made), encoding="utf-8")


# ---- Figures


def draw(build, folder, documents, name, truth, width=512, interface="reduced"):
    """The rows of all documents under a map of this width; truth: the options of their true pictures. None: there is no device."""
    file, baked, truths = folder / f"{name}.hdr", folder / f"{name}-prefiltered", folder / f"{name}-truth"
    if not file.exists():
        write_map(file, MAPS[name], width)
    if not baked.exists():
        subprocess.run([f"{build}/mxgen", "render", "-q", "--bake-environment", file, "-o", baked], check=True)
    truths.mkdir(exist_ok=True)
    for document in documents:
        picture = truths / f"{document.stem}.exr"
        if not picture.exists():
            subprocess.run([f"{build}/mxgen", "render", document, "-q", "-m", "sphere", "--lights", "none", "--environment", file, "-o", picture,
                            *truth], check=True)
    done = subprocess.run([f"{build}/bench/bench-error", file, baked, truths, folder / interface, interface, *documents], stdout=subprocess.PIPE, text=True,
                          check=True).stdout
    if done.startswith("skip"):
        return None
    return [Row(fields[0], fields[1], int(fields[2]), *map(float, fields[3:])) for fields in (line.split("\t") for line in done.splitlines())]


def curve(rows, material, way):
    """By rising cost."""
    return sorted((row for row in rows if row.material == material and row.way == way), key=lambda row: row.operations)


def cost_at(rows, error):
    """The operations for an error, in between by powers; None: no number of samples comes so near."""
    for before, after in zip([None, *rows], rows):
        if after.mean > 1.01 * error: # the truth has noise of its own
            continue
        if not before:
            return after.operations
        share = math.log(before.mean / (1.01 * error)) / math.log(before.mean / after.mean)
        return before.operations * (after.operations / before.operations) ** share
    return None


def error_at(rows, operations):
    """The least error for at most so many operations."""
    return min((row.mean for row in rows if row.operations <= operations), default=None)


def spread(values):
    """The median and the worst; what is not reached is worse than all."""
    reached = [value for value in values if value is not None]
    missed = len(values) - len(reached)
    if not reached:
        return "-"
    return f"{statistics.median(reached):.2f} / {max(reached):.2f}" + (f" ({missed} not reached)" if missed else "")


def compare(found, names):
    """Lines of a table over the pictures of the materials, for each way of mxgen."""
    for way in OURS:
        ratios, errors, reads = [], [], []
        for rows in found.values():
            for name in names:
                theirs = next((row for row in curve(rows, name, THEIRS) if row.samples == SAMPLES), None)
                ours = curve(rows, name, way)
                if not theirs:
                    continue
                cost, error = cost_at(ours, theirs.mean), error_at(ours, theirs.operations)
                same = next(row for row in ours if row.samples == SAMPLES)
                ratios.append(cost and cost / theirs.operations)
                errors.append(error and error / theirs.mean)
                reads.append(same.reads / theirs.reads)
        yield f"| `{way}` | {len(ratios)} | {spread(ratios)} | {spread(errors)} | {spread(reads)} |"


def prepare_theirs(build, folder, documents, interface="reduced"):
    """Writes MaterialX's shaders of the documents where its generator is at hand; says whether it is."""
    generator = shutil.which(GENERATOR)
    for document in documents if generator else []:
        write_theirs(document, pathlib.Path(generator).resolve().parent.parent / "materialx", build, folder, interface)
    return generator is not None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("documents", nargs="+", type=pathlib.Path)
    parser.add_argument("--size", type=int, default=64)
    parser.add_argument("--paths", type=int, default=256)
    parser.add_argument("--interface", choices=("reduced", "complete"), default="reduced")
    parser.add_argument("--plots", type=pathlib.Path)
    args = parser.parse_args()
    args.folder.mkdir(parents=True, exist_ok=True)
    if not prepare_theirs(args.build, args.folder, args.documents, args.interface):
        print(f"MaterialX's shaders: left out, {GENERATOR} is not on the PATH\n")
    truth = "--path-trace", "--as-drawn", "--paths", str(args.paths), "--size", str(args.size)
    found = {name: draw(args.build, args.folder, args.documents, name, truth, interface=args.interface) for name in MAPS}
    if None in found.values():
        sys.exit("skip: no Vulkan device")
    families = collections.defaultdict(list)
    for document in args.documents:
        families[document.parent.name].append(document.stem)
    for family, names in [*families.items(), ("all", [document.stem for document in args.documents])]:
        print(f"| {family} | pictures | cost at MaterialX's error | error at MaterialX's cost | texture reads |\n| --- | --- | --- | --- | --- |")
        print(*compare(found, names), sep="\n", end="\n\n")
        if args.plots:
            rows = [(name, row) for name, map_rows in found.items() for row in map_rows if row.material in names]
            (args.plots / f"{family}.svg").write_text(error_plot.plot(family, rows), encoding="utf-8")


if __name__ == "__main__":
    main()
