#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Computes the rows of tests/conformance with the folder of mdlc: at one point of the scene the texture coordinates are constants, so mdlc
folds the expression of a material's emission where it has no loops, textures and other state. The others compile and have no value.
Arguments: mxgen, the folder of the rows, and optionally document names and --all (every row, with the complete and the reduced interface;
by default the first with varying inputs of each nodegraph, complete), and --module (materials import the functions). Skipped (77) without
mdlc."""
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.path += [str(pathlib.Path(__file__).resolve().parents[1] / folder) for folder in ("", "osl")]
import checks
import scene

FLAGS = [a for a in sys.argv[1:] if a.startswith("--")]
MXGEN, ROWS, *NAMES = [a for a in sys.argv[1:] if not a.startswith("--")]
PIXEL, U, V = 6, 0.625, 0.375 # the third of the second row of 4x4
# of index 0, as in scene.SCENE
COORDINATES = f"(index == 0 ? float3({0.0313 + 0.9371 * U + 0.0129 * V:.9g}, {0.0217 + 0.0171 * U + 0.9331 * V:.9g}, 0.0) : state::texture_coordinate(index))"
NUMBER = r"(-?[\d.]+(?:e[-+]?\d+)?)f"
FOLDED = re.compile(rf"intensity: color\({NUMBER}(?:, {NUMBER}, {NUMBER})?\)")
CALLS = [] # the rows with a value that call the module
TEXTURED = set() # documents and rows that read a texture of the scene, which mdlc folds to black and reduced shaders do not have
LEAST_FOLDED = 0.4 # of the rows
MODULE = ["--mdl-module", "mxgen"] if "--module" in FLAGS else []
NAME = "values-mdl-module" if MODULE else "values-mdl"
INTERFACES = ["complete", "reduced"] if "--all" in FLAGS else ["complete"]


def folded(folder, modules):
    """By module: the radiance of its material, a list of three numbers; None if mdlc does not fold it."""
    command = ["mdlc", "--no-resolve-resources", "-W", "183=off", "-W", "350=off", "-p", folder, "-t", "DAG", "-O", "2"]
    done = subprocess.run(command + ["::" + module for module in modules], capture_output=True, text=True, check=False)
    values = {}
    for part in ("\n" + done.stdout).split('\ndag 1.10 "::')[1:]:
        module, _, text = part.partition('"')
        surface = text[text.find("    surface:"):text.find("    backface:")]
        found = FOLDED.search(surface)
        values[module] = [float(x if x is not None else found[1]) / math.pi for x in found.groups()] if found else None
    return values


def difference(row, value):
    """The fault of a value; None: it has none."""
    numbers = [float(x) for x in row["values"].split(",")]
    size = len(numbers) // int(row["pixels"])
    expected = numbers[-size:] if row["pixels"] == "1" else numbers[PIXEL * size:(PIXEL + 1) * size]
    worst = max(abs(a - b) if a == a else math.inf for a, b in zip(value, expected))
    tolerance = max(float(row["tol"]), 1e-5 * max(map(abs, numbers)))
    return f"differs by {worst:g}, tolerance {tolerance:g}" if worst > tolerance else None


def run_document(name, interface, folder):
    """By case, for rows that have a value or do not compile: what is wrong, or None. And the numbers of rows with a value, and of all."""
    rows = scene.wanted(pathlib.Path(ROWS) / "expected" / f"{name}.csv", "--all" in FLAGS)
    elements = [word for row in rows for word in ("--element", row["case"])]
    subprocess.run([MXGEN, pathlib.Path(ROWS) / "cases" / f"{name}.mtlx", "--target", "mdl", "--interface", interface, "-q", "-o", folder, *MODULE,
                    *elements], capture_output=True, check=False)
    if MODULE:
        subprocess.run([MXGEN, "pipeline", folder, "--target", "mdl", *MODULE], check=True)
    modules = {}
    for row in rows:
        source = folder / (row["case"].replace("/", ".") + ".mdl")
        text = source.read_text(encoding="utf-8") if source.exists() else "" # MDL has no derivatives, for example: tests/mdl/limits.sh
        if re.search("tex::(lookup|texel)", text):
            TEXTURED.add((name, row["case"]))
        if text:
            (folder / f"row{len(modules)}.mdl").write_text(text.replace("state::texture_coordinate(index)", COORDINATES), encoding="utf-8")
            modules[f"row{len(modules)}"] = row
    values = folded(folder, modules) if modules else {}
    found = {row["case"]: "does not compile" for module, row in modules.items() if module not in values}
    CALLS.extend(module for module, value in values.items() if value and "mxgen::" in (folder / f"{module}.mdl").read_text(encoding="utf-8"))
    with_value = {modules[module]["case"]: difference(modules[module], value) for module, value in values.items()
                  if value and (name, modules[module]["case"]) not in TEXTURED}
    return found | with_value, len(with_value), len(rows)


def main():
    if not shutil.which("mdlc"):
        checks.skip("mdlc is not installed")
        checks.finish(NAME)
    known = scene.known_deviations(pathlib.Path(ROWS) / "deviations.tsv", pathlib.Path(__file__).with_name("deviations.tsv"))
    num_folded = num_rows = 0
    for path in sorted((pathlib.Path(ROWS) / "cases").glob("*.mtlx")):
        if NAMES and path.stem not in NAMES:
            continue
        for interface in INTERFACES:
            with tempfile.TemporaryDirectory() as work:
                found, with_value, rows = run_document(path.stem, interface, pathlib.Path(work))
            num_folded, num_rows = num_folded + with_value, num_rows + rows
            for case, fault in found.items():
                checks.check(not fault or known & {(path.stem, case), (path.stem, "*")}, f"{path.stem} {case}, {interface}: {fault}")
    print(f"mdlc folds {num_folded} of {num_rows} rows, {len(CALLS)} with calls of the module")
    checks.check(num_folded >= LEAST_FOLDED * num_rows, "mdlc folds too few rows")
    checks.check(CALLS or not MODULE, "no row with a value calls the module")
    checks.finish(NAME)


main()
