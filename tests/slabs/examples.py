#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The examples of slabs: what `mxgen inspect --slabs` says of each stands in a file beside this test, the table of docs/slabs.md has the
errors of their budgets as they are drawn, and what the examples show is in the pictures.

Arguments: mxgen, mxgen-render ('' to draw nothing), the root of the project; --update rewrites the reports and prints the table."""
import json
import pathlib
import re
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
import balls
from checks import check, finish, run, skip

MXGEN, RENDER, ROOT = (pathlib.Path(arg).resolve() if arg else None for arg in sys.argv[1:4])
UPDATE = "--update" in sys.argv
PAGE = ROOT / "docs/slabs.md"
# Each example with the most bytes that its slabs may take; the talk's own sizes for three closures, two and the opal.
EXAMPLES = {"slabs": {"CoatedMetal": 48, "DustyFibre": 72, "WrappedSilk": 72, "CarPaint": 72, "MilkySheet": 20},
            "slab_blends": {"CarbonAndMetal": 72, "SkinIntoGold": 48, "CoatedSkin": 48, "MetalToPlastic": 48, "Opal": 76},
            "slab_helpers": {"HazyMetal": 20, "DustyLacquer": 48, "FlipFlop": 48, "AmberOnOak": 48, "ScreenInVelvet": 48},
            "slab_glints": {"FlakePaint": 44, "PearlPaint": 48}}
UNREAD = re.compile(r"  the estimate does not read .*\n")
NUMBER = re.compile(r"\d+\.\d+(?:e-?\d+)?")
SIZE, SWEEP = 48, 64
# How far a drawn error may be from the page, as another device rounds otherwise.
NEAR = 0.06


def document_of(material):
    return next(ROOT / "examples" / f"{name}.mtlx" for name, materials in EXAMPLES.items() if material in materials)


# ---- Reports ----

def agree(kept, now):
    """The same text, with numbers that differ by half a percent at most: another compiler rounds otherwise."""
    pairs = list(zip(map(float, NUMBER.findall(kept)), map(float, NUMBER.findall(now))))
    return NUMBER.sub("#", kept) == NUMBER.sub("#", now) and all(abs(a - b) <= 0.005 * max(a, b, 0.1) for a, b in pairs)


def check_report(material, most_bytes):
    result = run(MXGEN, "inspect", "--slabs", document_of(material), "-e", material)
    path = HERE / f"{material}.txt"
    if UPDATE:
        path.write_text(result.stdout)
    kept = path.read_text() if path.exists() else ""
    # a build without a renderer reads no texture
    now = result.stdout if RENDER else UNREAD.sub("", result.stdout)
    check(result.returncode == 0 and agree(kept, now), f"{path.name} is not the report:\n{result.stdout}{result.stderr}")
    costs = [(int(a), int(b)) for a, b in re.findall(r"(\d+) closures?, (\d+) bytes", result.stdout)]
    steps = [tuple(map(int, step)) for step in re.findall(r"slabs (\d+) to (\d+), bytes (\d+) to (\d+)", result.stdout)]
    check(len(costs) == 1 and costs[0][1] <= most_bytes, f"{material} takes more than {most_bytes} bytes: {costs}")
    check(all(b <= a and d <= c for a, b, c, d in steps) and (not steps or steps[-1][1] == 1), f"{material}: steps {steps}")


# ---- Errors of budgets ----

def draw(folder, name, document, *options):
    """The file of a picture; None: there is no device."""
    path = folder / f"{name}.ppm"
    result = run(RENDER, document, "-q", "-o", path, *options)
    if result.returncode and "no-device" in result.stderr:
        return None
    check(result.returncode == 0 and not result.stderr, f"render {name}: {result.stderr}")
    return path if result.returncode == 0 else None


def estimates(material):
    """By closures: the last estimated error of the steps that lead to so many."""
    result = run(MXGEN, document_of(material), "-e", material, "--max-slabs", "1", "-Wbudget-step", "--stdout")
    return {int(count): float(error) for count, error in re.findall(r"slabs \d+ to (\d+),.*?estimated error ([\d.e-]+)", result.stderr)}


def row_of(material, folder):
    """The row of the page: the errors with two closures, and with one."""
    ball = ("-m", "sphere", "-s", SIZE, "-e", material)
    document = document_of(material)
    whole = draw(folder, material, document, *ball)
    columns, estimated = [], estimates(material)
    for count in (2, 1):
        if count not in estimated:
            columns.append("")
            continue
        picture = draw(folder, f"{material}-{count}", document, *ball, "--max-slabs", count)
        columns.append(f"{estimated[count]:.2f}, {balls.compare(whole, picture):.2f}" if whole and picture else "?")
    return f"| `{material}` | {' | '.join(columns)} |"


def kept_row(name):
    """The row of a material in the table of errors: two numbers for a budget, estimated and drawn."""
    rows = (line for line in PAGE.read_text().splitlines() if line.startswith(f"| `{name}` |"))
    return next((row for row in rows if re.search(r"\d, \d", row)), "")


def check_row(row):
    kept = kept_row(row.split("`")[1])
    drawn, listed = (list(map(float, NUMBER.findall(text))) for text in (row, kept))
    check(len(drawn) == len(listed) and all(abs(a - b) <= NEAR for a, b in zip(drawn, listed)), f"docs/slabs.md has not the row {row}")


def drawn_steps(folder, text, profile):
    """The errors of pictures after each step of a budget, as `mxgen check --render` lists them, of the only material of a document."""
    (folder / "budget.toml").write_text(profile)
    (folder / "paint.mtlx").write_text(text)
    result = run(MXGEN, "check", folder / "paint.mtlx", "--render", "--no-compile", "--profile", folder / "budget.toml", "--json", folder / "drawn.json")
    check(result.returncode == 0, f"check --render: {result.stdout}{result.stderr}")
    element, = json.loads((folder / "drawn.json").read_text())["documents"][0]["elements"]
    return [float(step["drawnError"]) for step in element["steps"]]


def check_steps(folder):
    """Each step has a picture of its own; the picture without a budget has no step of the document either."""
    paint = re.sub(r'<surfacematerial name="(?!CarPaint").*?</surfacematerial>', "", document_of("CarPaint").read_text(), flags=re.DOTALL)
    drawn = drawn_steps(folder, paint, "max-bytes = 12\n")
    check(len(drawn) == 3 and len(set(drawn)) == 3, f"the step without a second lobe has the error of another step: {drawn}")
    share = '<input name="mix" type="float" value="0.6"/>'
    drawn = drawn_steps(folder, paint.replace(share, share + '<input name="blend_parameters" type="boolean" value="true"/>'), "max-slabs = 1\n")
    check(len(drawn) == 2 and min(drawn) > 0.2, f"the picture without steps has the step of the document: {drawn}")


# ---- What pictures show ----

def columns_of(picture):
    """The mean colour of each column in the lower middle of a square that fills the picture."""
    width, height, data = balls.read_ppm(picture)
    rows = range(height // 2, 3 * height // 4)
    return [[sum(data[3 * (y * width + x) + c] for y in rows) / len(rows) for c in range(3)] for x in range(width)]


def sweep(folder, name, document, *options):
    """A plane from the front, which fills the picture: u from 0 to 1."""
    return draw(folder, name, document, "-m", "plane", "--camera", "0,0,2.6,30", "-s", SWEEP, *options)


def only(folder, root, bsdf):
    """The document of blends with another matter below a root."""
    text = (ROOT / "examples/slab_blends.mtlx").read_text()
    path = folder / f"{bsdf}.mtlx"
    path.write_text(text.replace(f'name="bsdf" type="BSDF" nodename="{root}"', f'name="bsdf" type="BSDF" nodename="{bsdf}"'))
    return path


def difference(a, b):
    return balls.difference(balls.lab(a), balls.lab(b))


def check_halo(folder):
    """Where no mirror sends the lights to the eye, metal and plastic are dark, and so is what lies between; a halo is not."""
    variants = {"slabs": ("MetalToPlastic",), "one slab": ("MetalToPlastic", "--max-slabs", 1), "metalness": ("MetalToPlasticHalo",)}
    for name, options in variants.items():
        picture = sweep(folder, name, ROOT / "examples/slab_blends.mtlx", "--environment", "none", "-e", *options)
        means = [sum(color) / 3 for color in columns_of(picture)]
        ends, middle = max(means[0], means[-1]), max(means[8:-8])
        check(middle > 1.5 * ends if name == "metalness" else middle <= 1.15 * ends, f"{name}: {middle} between {means[0]} and {means[-1]}")


def check_sweeps(folder):
    """Without coverage there is the metal alone; without thickness the reflection of the coat is still there."""
    document = ROOT / "examples/slab_blends.mtlx"
    light = ("--environment", "none", "--set", "u_lightData[0].direction=0.26,0.1,-0.96") # the left edge mirrors it
    metal, covered, thick = (columns_of(sweep(folder, name, source, "-e", name, *light)) for name, source in (
        ("CoverageSweep", only(folder, "covered_silver", "silver")), ("CoverageSweep", document), ("ThicknessSweep", document)))
    near, middle = 0, SWEEP // 2
    check(difference(metal[near], covered[near]) < 1.5, f"no coverage is not the metal: {metal[near]}, {covered[near]}")
    check(difference(metal[near], thick[near]) > 1.5, f"no thickness is the metal: {metal[near]}, {thick[near]}")
    check(difference(covered[middle], thick[middle]) > 5, "a coat that covers half is a coat of half the thickness")


def main():
    for materials in EXAMPLES.values():
        for material, most_bytes in materials.items():
            check_report(material, most_bytes)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        if not RENDER or not sweep(folder, "first", ROOT / "examples/slab_blends.mtlx"):
            skip("without a Vulkan device nothing is drawn")
            finish("slab-examples")
        for material in (material for materials in EXAMPLES.values() for material in materials):
            row = row_of(material, folder)
            if UPDATE:
                print(row)
            check_row(row)
        check_steps(folder)
        check_halo(folder)
        check_sweeps(folder)
    finish("slab-examples")


if __name__ == "__main__":
    main()
