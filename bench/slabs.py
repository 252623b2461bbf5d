#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Materials with options of generation: the mean CIEDE2000 of a ball drawn as slabs, and with one closure, from the ball as it is.

    bench/slabs.py build/mxgen FOLDER... [--size 64] [--jobs 2] [--variant "NAME=OPTIONS"]...

Draws the first renderable of each document where the options change its shader. Prints each document as soon as it is drawn, then a
row for each model of shading, the worst documents, and the parts of materials that no slab stands for. --variant takes the place of slabs and one closure: --variant "occluding=--layering occluding"."""

import argparse
import collections
import concurrent.futures
import math
import pathlib
import re
import statistics
import subprocess
import tempfile

VARIANTS = {"slabs": ["--slabs"], "one closure": ["--max-closures", "1"]}


def lab(color):
    """CIELAB of an sRGB colour, 0 to 255."""
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in (v / 255 for v in color)]
    rows = ((0.4124564 / 0.95047, 0.3575761 / 0.95047, 0.1804375 / 0.95047), (0.2126729, 0.7151522, 0.0721750),
            (0.0193339 / 1.08883, 0.1191920 / 1.08883, 0.9503041 / 1.08883))
    x, y, z = (sum(a * b for a, b in zip(row, linear)) for row in rows)
    x, y, z = (t ** (1 / 3) if t > 216 / 24389 else (24389 / 27 * t + 16) / 116 for t in (x, y, z))
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


def difference(p, q):
    """CIEDE2000 as in Sharma, Wu and Dalal 2005."""
    (l1, a1, b1), (l2, a2, b2) = p, q
    mean = (math.hypot(a1, b1) + math.hypot(a2, b2)) / 2
    more = 1 + 0.5 * (1 - math.sqrt(mean ** 7 / (mean ** 7 + 25 ** 7)))
    c1, c2 = math.hypot(a1 * more, b1), math.hypot(a2 * more, b2)
    h1, h2 = math.degrees(math.atan2(b1, a1 * more)) % 360, math.degrees(math.atan2(b2, a2 * more)) % 360
    step = 0 if c1 * c2 == 0 else (h2 - h1 + 180) % 360 - 180
    hue = h1 + h2 if c1 * c2 == 0 else (h1 + step / 2) % 360
    light, chroma = (l1 + l2) / 2, (c1 + c2) / 2
    t = (1 - 0.17 * math.cos(math.radians(hue - 30)) + 0.24 * math.cos(math.radians(2 * hue))
         + 0.32 * math.cos(math.radians(3 * hue + 6)) - 0.20 * math.cos(math.radians(4 * hue - 63)))
    turn = -math.sin(math.radians(60 * math.exp(-((hue - 275) / 25) ** 2))) * 2 * math.sqrt(chroma ** 7 / (chroma ** 7 + 25 ** 7))
    dl = (l2 - l1) / (1 + 0.015 * (light - 50) ** 2 / math.sqrt(20 + (light - 50) ** 2))
    dc = (c2 - c1) / (1 + 0.045 * chroma)
    dh = 2 * math.sqrt(c1 * c2) * math.sin(math.radians(step / 2)) / (1 + 0.015 * chroma * t)
    return math.sqrt(max(dl * dl + dc * dc + dh * dh + turn * dc * dh, 0))


def read_ppm(path):
    data = path.read_bytes()
    head = re.match(rb"P6\s+(\d+)\s+(\d+)\s+255\s", data)
    return int(head[1]), int(head[2]), data[head.end():]


def compare(first, second):
    """The mean over the pixels of the ball, which fills the middle of the picture."""
    width, height, a = read_ppm(first)
    b = read_ppm(second)[2]
    total = count = 0
    for y in range(height):
        for x in range(width):
            if math.hypot(x + 0.5 - width / 2, y + 0.5 - height / 2) < 0.36 * height:
                at = 3 * (y * width + x)
                p, q = a[at:at + 3], b[at:at + 3]
                total += difference(lab(p), lab(q)) if p != q else 0
                count += 1
    return total / count


def run(*command):
    words = [str(word) for word in command]
    try:
        return subprocess.run(words, capture_output=True, text=True, errors="replace", timeout=600)
    except subprocess.TimeoutExpired:
        return subprocess.CompletedProcess(words, 1, "", "error: ten minutes are not enough [timeout]\n")


def source_of(mxgen, document, *options):
    """The shaders of a document; None: it has none."""
    made = run(mxgen, document, "-q", "--interface", "reduced", "--stdout", *options)
    return made.stdout if made.returncode == 0 else None


def model_of(document):
    text = document.read_text(errors="replace")
    for name in ("open_pbr_surface", "standard_surface", "gltf_pbr", "UsdPreviewSurface", "disney_principled", "slab_surface"):
        if f"<{name} " in text:
            return name
    return "Lama" if "<Lama" in text else "BSDF nodes"


def misfit_of(mxgen, document):
    """The part of a material that no slab stands for, as the deferred pipeline names it; "" if slabs stand for all."""
    made = run(mxgen, document, "--target", "vulkan", "--interface", "reduced", "--stdout", "--pipeline", "deferred", "--slabs")
    part = re.search(r"its part '(.*?)' is no slab", made.stderr)
    return part[1] if part else ""


def reason_of(made):
    """Why a document is not drawn: the first error without its place, or how the program ends."""
    found = re.search(r"error: (.*?)(?: \[([a-z-]+)\])?$", made.stderr, re.MULTILINE)
    return (found[2] or found[1]) if found else f"ends with {made.returncode}"


def measure(mxgen, document, size, variants):
    """The differences by variant, 0 where the shader stays the same; for a document that is not drawn the reason."""
    source = source_of(mxgen, document)
    sources = {name: source_of(mxgen, document, *options) for name, options in variants.items()}
    changed = [name for name in variants if not source or source != sources[name]]
    result = {name: 0.0 for name in variants}
    result["misfit"] = misfit_of(mxgen, document) if changed else ""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        draw = [mxgen, "render", document, "--quiet", "--size", size, "--missing-texture", "checker", "--mesh", "sphere"]
        whole = run(*draw, "-o", folder / "whole.ppm") if changed else None
        if whole and whole.returncode:
            return {"reason": reason_of(whole)}
        drawn = {}  # by shader: variants may agree
        for name in changed:
            key = sources[name] or name
            if key not in drawn:
                failed = run(*draw, *variants[name], "-o", folder / "variant.ppm").returncode
                drawn[key] = None if failed else compare(folder / "whole.ppm", folder / "variant.ppm")
            result[name] = drawn[key]
    return result


def number(value):
    return "-" if value is None else f"{value:.2f}"


def tell(document, result, variants):
    """A line about a document, at once."""
    if "reason" in result:
        print(f"not drawn {document} ({result['reason']})", flush=True)
        return
    values = " ".join(number(result[name]) for name in variants)
    print(f"{values} {document}" + (f" ({result['misfit']} is no slab)" if result["misfit"] else ""), flush=True)


def print_models(results, variants):
    models = collections.defaultdict(list)
    for document, result in results:
        models[model_of(document)].append(result)
    print("| model | documents | all slabs |", " | ".join(f"{name}: median | worst" for name in variants), "|")
    print("| --- | --- | --- |", " | ".join("--- | ---" for _ in variants), "|")
    for model, rows in sorted(models.items()):
        columns = []
        for name in variants:
            values = [result[name] for result in rows if result[name] is not None]
            columns += [f"{statistics.median(values):.2f}", f"{max(values):.2f}"] if values else ["-", "-"]
        print(f"| `{model}` | {len(rows)} | {sum(not row['misfit'] for row in rows)} |", " | ".join(columns), "|")


def short(document):
    """The path behind the folder "materials", which several collections of documents have."""
    parts = document.parts
    return "/".join(parts[parts.index("materials") + 1:]) if "materials" in parts else str(document)


def page_of(drawn, rest, variants):
    """The errors of all documents as Markdown, the worst first."""
    first = next(iter(variants))
    lines = ["# Errors of slabs", "", "`bench/slabs.py` writes this page: [slabs.md](slabs.md#every-material) explains it. Mean CIEDE2000 of a",
             "ball; - is no picture.", "", f"| document | model | {' | '.join(variants)} | part that is no slab |", "| --- " * (3 + len(variants)) + "|"]
    for document, result in sorted(drawn, key=lambda row: (-(row[1][first] or 0), str(row[0]))):
        values = " | ".join(number(result[name]) for name in variants)
        lines.append(f"| {short(document)} | {model_of(document)} | {values} | {result['misfit']} |")
    lines += ["", "Documents without a picture:", "", "| document | reason |", "| --- | --- |"]
    lines += [f"| {short(document)} | {result['reason']} |" for document, result in rest]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mxgen", type=pathlib.Path)
    parser.add_argument("folders", type=pathlib.Path, nargs="+")
    parser.add_argument("--size", type=int, default=64)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--markdown", type=pathlib.Path, help="a page with a row for each document")
    parser.add_argument("--variant", action="append", metavar="NAME=OPTIONS")
    args = parser.parse_args()
    args.mxgen = args.mxgen.resolve()
    variants = {name: options.split() for name, _, options in (text.partition("=") for text in args.variant or [])} or VARIANTS
    found = {path for folder in args.folders for path in (folder.rglob("*.mtlx") if folder.is_dir() else [folder])}
    documents = sorted(path for path in found if path.is_file())
    drawn, rest = [], []
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        for document, result in zip(documents, pool.map(lambda path: measure(args.mxgen, path, args.size, variants), documents)):
            tell(document, result, variants)
            (rest if "reason" in result else drawn).append((document, result))
    print_models(drawn, variants)
    for name in variants:
        rows = [(result[name], document) for document, result in drawn if result[name] is not None]
        for value, document in sorted(rows, reverse=True)[:12]:
            print(f"{name}: {value:.2f} {document}")
        print(f"{name}: {sum(result[name] is None for _, result in drawn)} documents cannot be drawn so")
    misfits = collections.Counter(result["misfit"] for _, result in drawn if result["misfit"])
    for part, count in misfits.most_common():
        print(f"no slab stands for '{part}': {count} documents")
    for reason, count in collections.Counter(result["reason"] for _, result in rest).most_common():
        print(f"not drawn, {reason}: {count} documents")
    if args.markdown:
        args.markdown.write_text(page_of(drawn, rest, variants), encoding="utf-8")


if __name__ == "__main__":
    main()
