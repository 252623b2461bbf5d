#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Computes the rows of tests/conformance with OSL: generates the documents, replaces the renderer's streams by those of the scene, and
reads the output of testshade. Arguments: mxgen, the folder of the rows, deviations.tsv, and optionally document names, --all
(every row; by default the first with varying inputs of each nodegraph), and --modes (images with address modes, which the reference of
tests/conformance lacks). Skipped (77) without oslc and testshade."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import scene

FLAGS = [a for a in sys.argv[1:] if a.startswith("--")]
ARGS = [a for a in sys.argv[1:] if not a.startswith("--")]
MXGEN, ROWS, DEVIATIONS, *NAMES = ARGS


def compile_case(path, case, folder):
    probe = folder / "probe.tif"
    if not probe.exists():
        scene.write_probe(probe)
    source = scene.place(path.read_text(encoding="utf-8"), case, probe)
    kind, name = re.search(r"output (\w+) (\w+) =", source.rpartition("\nshader ")[2]).groups()
    end = source.rindex("}")
    target = folder / f"s{len(list(folder.glob('*.oso')))}.osl"
    fault = scene.compile_shader(f"{source[:end]}{scene.printing(case, kind, name)}}}\n", target)
    if fault:
        print(f"failed: {case}: {fault}")
    return None if fault else target.with_suffix(".oso")


def run_document(name, folder):
    document = pathlib.Path(ROWS) / "cases" / f"{name}.mtlx"
    rows = scene.wanted(pathlib.Path(ROWS) / "expected" / f"{name}.csv", "--all" in FLAGS)
    if not rows:
        return {}
    if "--modes" not in FLAGS:
        document = scene.without_modes(document, folder)
    elements = [word for row in rows for word in ("--element", row["case"])]
    done = subprocess.run([MXGEN, document, "--target", "osl", "-q", "-o", folder, *elements], capture_output=True, text=True)
    if done.returncode:
        return {rows[0]["case"]: f"mxgen: {done.stderr.strip()[:300]}"}
    shaders, faults = [], {}
    for row in rows:
        path = folder / (row["case"].replace("/", ".") + ".osl")
        oso = compile_case(path, row["case"], folder)
        if oso:
            shaders += ["--shader", str(oso), oso.stem, "--entry", oso.stem]
        else:
            faults[row["case"]] = "does not compile"
    out = subprocess.run(["testshade", "-t", "1", "-g", "4", "4", "--center", *shaders], capture_output=True, text=True)
    got = scene.read_rows(out.stdout)
    for row in rows:
        fault = faults.get(row["case"]) or scene.compare(row, got.get(row["case"], {}))
        if fault:
            faults[row["case"]] = fault
    counts["passed"] += len(rows) - len(faults)
    return faults


if not shutil.which("oslc") or not shutil.which("testshade"):
    print("skip: oslc or testshade is not installed\nosl-values: 0 passed, 0 failed, 1 skipped")
    sys.exit(77)
known = scene.known_deviations(pathlib.Path(ROWS) / "deviations.tsv", pathlib.Path(DEVIATIONS))
counts = {"passed": 0, "failed": 0, "known": 0}
for path in sorted((pathlib.Path(ROWS) / "cases").glob("*.mtlx")):
    if NAMES and path.stem not in NAMES:
        continue
    with tempfile.TemporaryDirectory() as work:
        for case, fault in run_document(path.stem, pathlib.Path(work)).items():
            if (path.stem, case) in known or (path.stem, "*") in known:
                counts["known"] += 1
            else:
                counts["failed"] += 1
                print(f"failed: {path.stem} {case}: {fault}")
print(f"osl-values: {counts['passed'] + counts['known']} passed, {counts['failed']} failed, 0 skipped")
sys.exit(1 if counts["failed"] else 0 if counts["passed"] + counts["known"] else 77)
