#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Slabs in other tools (docs/slabs.md): what `mxgen library expand` writes for them has only nodes of MaterialX; the shaders that it gives
have no code of slabs, and look like those of slabs where the graphs have all of a material.

Arguments: mxgen, mxgen-render ('' to draw nothing), the root of the sources, the column of the page whose pictures are drawn: complete, or
incomplete for materials with parts that no graph has."""
import pathlib
import re
import sys
import tempfile
import xml.etree.ElementTree as ET

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
import balls
from checks import check, finish, run, skip

MXGEN, RENDER = (pathlib.Path(arg).resolve() if arg else None for arg in sys.argv[1:3])
ROOT, COLUMN = pathlib.Path(sys.argv[3]), sys.argv[4]
NODES = ["slab", "slab_layer", "slab_mix", "slab_coverage", "slab_select", "slab_surface", "slab_f0_of_ior", "slab_metalness",
         "slab_mean_free_path", "slab_tangent", "slab_coverage_at"]
LOSSES = {"slab": "emission, glint_density, glint_uv, specular_lut, specular_lut_weight", "slab_layer": "thickness, blend_parameters",
          "slab_mix": "blend_parameters", "slab_surface": "surface_thickness"}

DOCUMENTS = [ROOT / f"examples/{name}.mtlx" for name in ("slabs", "slab_blends", "slab_helpers", "slab_glints")]
# Tolerance of an error that the page lists: another device rounds otherwise.
NEAR, SHARE = 0.02, 0.01


def interfaces():
    """By node of MaterialX: its interfaces, as sets of inputs "name:type" and outputs."""
    rows = {}
    for line in (ROOT / "tests/library/interfaces.tsv").read_text().splitlines()[1:]:
        columns = line.split("\t")
        ports = [{port.split("=")[0].split("@")[0].split(" ")[0] for port in text.split(" | ")} for text in columns[7:9]]
        rows.setdefault(columns[1], []).append(ports)
    return rows


def is_of_materialx(node, rows):
    given = {f"{port.get('name')}:{port.get('type')}" for port in node}
    is_typed = lambda outputs: node.get("type") == "multioutput" or any(out.split(":")[1] == node.get("type") for out in outputs)
    return any(given <= inputs and is_typed(outputs) for inputs, outputs in rows.get(node.tag, []))


def expanded_graphs(text):
    """The graphs of the nodes of slabs, and that no code is beside them."""
    root = ET.fromstring(text)
    coded = {impl.get("nodedef") for impl in root.iter("implementation")}
    graphs = {graph.get("nodedef"): graph for graph in root.iter("nodegraph")}
    for name in NODES:
        check(f"ND_{name}" in graphs, f"{name} has no graph")
        check(f"ND_{name}" not in coded, f"{name} has code beside its graph")
    return [graphs[f"ND_{name}"] for name in NODES if f"ND_{name}" in graphs]


def check_losses(text):
    for name, inputs in LOSSES.items():
        comment = f'<!-- Without a part in this graph: {inputs} -->\n  <nodegraph name="NG_{name}"'
        check(comment in text, f"{name}: no comment with the inputs that its graph lacks")


def materials_of(document):
    return [material.get("name") for material in ET.parse(document).getroot().findall("surfacematerial")]


def check_shaders(document, library):
    for name in materials_of(document):
        made = run(MXGEN, document, "-e", name, "--library", library, "--stdout", "--target", "vulkan")
        check(made.returncode == 0, f"{name}: {made.stderr}")
        check("slab_medium" not in made.stdout and "mx_chan" not in made.stdout, f"{name}: the shader has code of slabs")


def listed_errors():
    """By column of the page: the errors by material, mean CIEDE2000."""
    section = (ROOT / "docs/slabs.md").read_text().partition("## In other tools")[2].partition("\n## ")[0]
    rows = [line.split("|")[1:-1] for line in section.splitlines() if re.match(r"\|.* \d+\.\d\d \|$", line)]
    name_of = lambda cell: re.search(r"`(\w+)`", cell)[1]
    return {column: {name_of(row[at]): float(row[at + 1]) for row in rows if row[at].strip()} for column, at in (("complete", 0), ("incomplete", 2))}


def check_picture(document, name, library, folder, listed):
    draw = [RENDER.parent / "mxgen", "render", document, "-e", name, "--quiet", "--size", 48, "--mesh", "sphere"]
    for path, options in ("slab.ppm", []), ("graph.ppm", ["--library", library]):
        made = run(*draw, *options, "-o", folder / path)
        if made.returncode:
            check(False, f"{name}: {made.stderr}")
            return
    error = balls.compare(folder / "slab.ppm", folder / "graph.ppm")
    check(abs(error - listed) <= NEAR + SHARE * listed, f"{name}: its graph is {error:.2f} from its slabs; docs/slabs.md has {listed}")


def check_column(library, folder):
    listed = listed_errors()
    documents = {name: document for document in DOCUMENTS for name in materials_of(document) if not name.endswith("Sweep")}
    check({*listed["complete"], *listed["incomplete"]} == {*documents}, f"docs/slabs.md lists {listed}, not all of {[*documents]}")
    for name, error in listed[COLUMN].items():
        check_picture(documents[name], name, library, folder, error)


def main():
    text = run(MXGEN, "library", "expand").stdout
    graphs = expanded_graphs(text)
    rows = interfaces()
    for graph in graphs:
        for node in graph:
            if node.tag != "output":
                check(is_of_materialx(node, rows), f"{graph.get('name')}/{node.get('name')}: MaterialX has no such <{node.tag}>")
    check_losses(text)
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        library = folder / "graphs.mtlx"
        extra = ET.Element("materialx", version="1.39")
        extra.extend(graphs)
        library.write_text(ET.tostring(extra, encoding="unicode"))
        for document in DOCUMENTS[:3]: # a graph has no glints
            check_shaders(document, library)
        if RENDER:
            check_column(library, folder)
    if not RENDER:
        skip("without mxgen-render no picture is drawn")
    finish("slab-graphs")


main()
