#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Materials with options of generation: the mean CIEDE2000 of a ball drawn as slabs, and with one slab, from the ball as it is.

    bench/slabs.py build/mxgen FOLDER... [--size 64] [--jobs 2] [--variant "NAME=OPTIONS"]...

Draws the first renderable of each document where the options change its shader. Prints each document as soon as it is drawn, then a
row for each model of shading, the worst documents, and the parts of materials that no slab stands for. --variant takes the place of slabs and one slab: --variant "occluding=--layering occluding"."""

import argparse
import collections
import concurrent.futures
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "tests"))
import balls  # pylint: disable=wrong-import-position

VARIANTS = {"slabs": ["--slabs"], "one slab": ["--max-slabs", "1"]}


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
    made = run(mxgen, document, "--target", "vulkan", "--interface", "reduced", "--stdout", "--role", "deferred", "--slabs")
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
                drawn[key] = None if failed else balls.compare(folder / "whole.ppm", folder / "variant.ppm")
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
