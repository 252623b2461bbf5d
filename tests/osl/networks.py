#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""OSL networks: rows of tests/conformance have the same values as shader groups and as whole shaders, and the shaders and groups of materials
compile, among them the example materials of slabs. Arguments: mxgen, the folder of the rows, deviations.tsv, a folder of materials ('' or absent: none), and optionally
document names, or --all for every document and material. Skipped (77) without oslc and testshade."""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
import scene
from checks import check_fault, finish, skip

FLAGS = [a for a in sys.argv[1:] if a.startswith("--")]
ARGS = [a for a in sys.argv[1:] if not a.startswith("--")]
MXGEN, ROWS, DEVIATIONS, MATERIALS, *NAMES = ARGS
EVERY = 5  # document, unless all are asked for
TYPES = {"float": "float", "integer": "int", "boolean": "int", "vector2": "vector2", "vector3": "vector", "vector4": "vector4",
         "color3": "color", "color4": "vector4"}
STRUCTS = {"vector2": "struct vector2 { float x; float y; };\n", "vector4": "struct vector4 { float x; float y; float z; float w; };\n"}


def generate(document, folder, *arguments):
    done = subprocess.run([MXGEN, document, "--target", "osl", "--osl-network", "--reflect", "-q", "-o", folder, *arguments],
                          capture_output=True, text=True)
    return done.stderr.strip()[:300] if done.returncode else None


def testshade(group, *arguments):
    """What it printed, and the first complaint but of closures, which it does not have."""
    done = subprocess.run(["testshade", "-t", "1", *arguments, "--group", group.name], capture_output=True, text=True, cwd=group.parent)
    said = [line for line in (done.stdout + done.stderr).splitlines() if line.startswith(("ERROR", "WARNING"))]
    said = [line for line in said if "is not supported by the current renderer" not in line]
    fault = said[0] if said else f"exit code {done.returncode}" if done.returncode else None
    return done.stdout, fault


# ---- Values ----

def show(folder, case, kind):
    """A layer that prints what it is given."""
    start = "{0, 0, 0, 0}" if kind == "vector4" else "{0, 0}" if kind == "vector2" else "0"
    source = f"{STRUCTS.get(kind, '')}shader show({kind} value = {start})\n{{\n{scene.printing(case, kind, 'value')}}}\n"
    return scene.compile_shader(source, folder / "show.osl")


def run_row(document, row, folder):
    fault = generate(scene.without_modes(document, folder), folder, "--element", row["case"])
    if fault:
        return fault
    probe = folder / "probe.tif"
    scene.write_probe(probe)
    for path in sorted(folder.glob("ND_*.osl")):
        fault = fault or scene.compile_shader(scene.place(path.read_text(encoding="utf-8"), row["case"], probe), path)
    path = folder / row["case"].replace("/", ".")
    group = json.loads(path.with_name(path.name + ".json").read_text(encoding="utf-8"))["groups"][0]
    fault = fault or show(folder, row["case"], TYPES[row["type"]])
    if fault:
        return fault
    layers = path.with_name(path.name + ".oslgroup")
    lines = [line for line in layers.read_text(encoding="utf-8").splitlines() if not line.startswith("param string ")] # the probe's
    lines += ["shader show show ;", f"connect {group['layer']}.{group['output']} show.value ;", ""]
    layers.write_text("\n".join(lines), encoding="utf-8")
    out, fault = testshade(layers, "-g", "4", "4", "--center")
    return fault or scene.compare(row, scene.read_rows(out).get(row["case"], {}))


def run_values():
    known = scene.known_deviations(pathlib.Path(ROWS) / "deviations.tsv", pathlib.Path(DEVIATIONS))
    documents = sorted((pathlib.Path(ROWS) / "cases").glob("*.mtlx"))
    for path in documents if NAMES or "--all" in FLAGS else documents[::EVERY]:
        if NAMES and path.stem not in NAMES:
            continue
        rows = [row for row in scene.wanted(pathlib.Path(ROWS) / "expected" / f"{path.stem}.csv", False) if row["type"] in TYPES]
        for row in rows if NAMES or "--all" in FLAGS else rows[:1]:
            if (path.stem, row["case"]) in known or (path.stem, "*") in known:
                continue
            with tempfile.TemporaryDirectory() as work:
                check_fault(f"{path.stem} {row['case']}", run_row(path, row, pathlib.Path(work)))


# ---- Materials ----

compiled = {}  # source of a shader to what oslc said of it


def compile_once(path, cache):
    source = path.read_text(encoding="utf-8")
    if source not in compiled:
        compiled[source] = scene.compile_shader(source, cache / path.name), cache / f"{len(compiled)}.oso"
        if not compiled[source][0]:
            (cache / path.name).with_suffix(".oso").rename(compiled[source][1])
    fault, oso = compiled[source]
    if not fault:
        shutil.copy(oso, path.with_suffix(".oso"))
    return fault


def run_material(document, cache):
    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work)
        if generate(document, folder):
            return # faults of the document: other tests look after these
        for path in sorted(folder.glob("*.osl")):
            check_fault(f"{document.name} {path.name}", compile_once(path, cache))
        for group in sorted(folder.glob("*.oslgroup")):
            check_fault(f"{document.name} {group.name}", testshade(group, "-g", "1", "1")[1])


def find_materials():
    root = pathlib.Path(MATERIALS)
    slabs = sorted((pathlib.Path(__file__).resolve().parent.parent.parent / "examples").glob("slab*.mtlx"))
    if MATERIALS and root.is_dir():
        return slabs + sorted((root if "--all" in FLAGS else root / "Materials" / "Examples").rglob("*.mtlx"))
    skip(f"there is no folder {MATERIALS}")
    return slabs


def run_materials():
    with tempfile.TemporaryDirectory() as work:
        for document in find_materials():
            run_material(document, pathlib.Path(work))


if not shutil.which("oslc") or not shutil.which("testshade"):
    skip("oslc or testshade is not installed")
    finish("osl-networks")
run_values()
run_materials()
finish("osl-networks")
