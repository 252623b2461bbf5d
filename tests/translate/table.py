#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Real documents as other shading models, for the tables of docs/translate.md: how many become one, what is told of them, how far they
look from their source, and why the rest does not. A document belongs to the family of its first surface.
Arguments: mxgen, a folder of documents, how many documents of each family are drawn (default: 0).
Fails if a document that generates has no translation, or if the translation of one does not generate: --check alone tests this, and
prints no table."""
import collections
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

MODELS = ("gltf_pbr", "open_pbr_surface", "UsdPreviewSurface")
# the first word that a document has as an element, in this order
FAMILIES = ("open_pbr_surface", "gltf_pbr", "UsdPreviewSurface", "disney_principled", "standard_surface", "Lama", "surface_unlit", "surface")
LIMIT = 600 # seconds


def run(*arguments):
    return subprocess.run([MXGEN, *map(str, arguments)], capture_output=True, text=True, check=False, timeout=LIMIT)


def family_of(path):
    text = path.read_text(encoding="utf-8", errors="replace")
    return next((name for name in FAMILIES if re.search(rf"<{name}{'' if name == 'Lama' else '[ >]'}", text)), "no surface")


def errors_of(said):
    return sorted(set(re.findall(r"error: .*\[([a-z-]+)\]$", said, re.MULTILINE)))


class Row:
    """What the documents of a family become as one model."""

    def __init__(self):
        self.translated = self.failed = self.lossy = 0
        self.estimated, self.drawn = [], []

    def add(self, done):
        self.translated += done.returncode == 0
        self.failed += done.returncode != 0
        self.lossy += done.returncode == 0 and "[translation-" in done.stderr
        self.estimated += [float(x) for x in re.findall(r"the estimated error is ([\d.]+)", done.stderr)]


def is_sound(path, done, out, shaders):
    """False after a message: the document generates, but not as the other model."""
    if done.returncode == 0:
        made = run(out, "--target", "glsl", "-o", shaders)
        good = made.returncode == 0 or "[no-renderables]" in made.stderr or run(path, "--target", "glsl", "-o", shaders).returncode != 0
    else:
        made = done
        good = run(path, "--target", "glsl", "-o", shaders).returncode != 0
    if not good:
        print(f"{path}: {made.stderr[:400]}", file=sys.stderr)
    return good


def sample_of(documents, num):
    """`num` documents of each family, evenly spread over those that are quick to draw."""
    sample = set()
    for family in (*FAMILIES, "no surface"):
        quick = [path for path in documents if family_of(path) == family and 1 <= path.read_bytes().count(b"<surfacematerial") <= 2]
        sample |= {quick[i * len(quick) // num] for i in range(num) if quick}
    return sample


def draw(path, model, out, row):
    done = run("translate", path, "--to", model, "--drawn", "-o", out)
    row.drawn += [float(x) for x in re.findall(r"drawn error ([\d.e+-]+)$", done.stderr, re.MULTILINE)]


def spread(numbers):
    return f"{statistics.median(numbers):.3g} / {max(numbers):.3g}" if numbers else "–"


def cell(row, is_itself):
    """How many have losses told, and the drawn errors."""
    drawn = f"; {spread(row.drawn)}" if row.drawn else ""
    return "–" if is_itself else f"{row.lossy}{drawn}"


def print_tables(rows, reasons):
    print(f"| source | documents | failed | estimated | {' | '.join(MODELS)} |\n| --- | --- | --- | --- |{' --- |' * len(MODELS)}")
    for family in dict.fromkeys(family for family, _ in rows):
        of_models = [rows[family, model] for model in MODELS]
        cells = [cell(row, family == model) for row, model in zip(of_models, MODELS)]
        first = of_models[0]
        print(f"| {family} | {first.translated + first.failed} | {max(row.failed for row in of_models)} | {spread(first.estimated)} | {' | '.join(cells)} |")
    print("\n| reason | documents |\n| --- | --- |")
    for reason, documents in sorted(reasons.items(), key=lambda item: (-len(item[1]), item[0])):
        print(f"| {reason} | {len(documents)} |")


def main(folder, num_drawn, only_checks):
    rows, reasons, num_faults = {}, collections.defaultdict(set), 0
    documents = [path for path in sorted(folder.rglob("*.mtlx")) if path.is_file()]
    sample = sample_of(documents, num_drawn)
    by_family = sorted(documents, key=lambda path: (FAMILIES + ("no surface",)).index(family_of(path)))
    with tempfile.TemporaryDirectory() as place:
        out, shaders = pathlib.Path(place, "out.mtlx"), pathlib.Path(place, "shaders")
        for path in by_family:
            family = family_of(path)
            for model in MODELS:
                row = rows.setdefault((family, model), Row())
                done = run("translate", path, "--to", model, "-o", out)
                row.add(done)
                num_faults += not is_sound(path, done, out, shaders)
                if done.returncode != 0:
                    reasons[", ".join(f"`{name}`" for name in errors_of(done.stderr))].add(path)
                elif path in sample and family != model:
                    draw(path, model, out, row)
    if only_checks:
        print(f"translate-table: {len(documents) * len(MODELS) - num_faults} passed, {num_faults} failed, 0 skipped")
    else:
        print_tables(rows, reasons)
    return num_faults > 0


if __name__ == "__main__":
    ONLY_CHECKS = "--check" in sys.argv
    WORDS = [word for word in sys.argv[1:] if word != "--check"]
    MXGEN, ROOT = os.path.abspath(WORDS[0]), pathlib.Path(WORDS[1])
    if not ROOT.is_dir():
        print(f"skip: there is no folder {ROOT}")
        sys.exit(77)
    sys.exit(main(ROOT, int(WORDS[2]) if len(WORDS) > 2 else 0, ONLY_CHECKS))
