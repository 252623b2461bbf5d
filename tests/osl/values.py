#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The rows of tests/conformance by OSL: generates the documents, puts the scene's streams in place of the renderer's, and lets
testshade print what comes out. Arguments: mxgen, the folder of the rows, deviations.tsv, and perhaps document names and --all
(every row; else the first with varying inputs of each graph). Skipped (77) without oslc and testshade."""
import csv
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile

FLAGS = [a for a in sys.argv[1:] if a.startswith("--")]
ARGS = [a for a in sys.argv[1:] if not a.startswith("--")]
MXGEN, ROWS, DEVIATIONS, *NAMES = ARGS

# The grid of render/scene.c as functions of u and v, which testshade gives the centres of 4x4 pixels.
SCENE = """
point grid_Po() { return point(-0.83 + 1.71 * u + 0.09 * v, -0.57 + 0.12 * u + 1.37 * v, 0.31 + 0.43 * u - 0.58 * v); }
vector grid_No() { return vector(-0.25 + 0.61 * u + 0.07 * v, 0.35 - 0.11 * u - 0.53 * v, 0.91 + 0.08 * u - 0.05 * v); }
vector grid_To() { vector n = grid_No(); return vector(n[2], 0, -n[0]); }
matrix grid_world()
{
    float a = radians(40), c = cos(a), s = sin(a), d = 1 - c;
    vector x = vector(1, 2, 3) / sqrt(14);
    matrix r = matrix(x[0] * x[0] * d + c, x[0] * x[1] * d + x[2] * s, x[0] * x[2] * d - x[1] * s, 0,
                      x[0] * x[1] * d - x[2] * s, x[1] * x[1] * d + c, x[1] * x[2] * d + x[0] * s, 0,
                      x[0] * x[2] * d + x[1] * s, x[1] * x[2] * d - x[0] * s, x[2] * x[2] * d + c, 0, 0, 0, 0, 1);
    return matrix(1.3, 0, 0, 0, 0, 0.8, 0, 0, 0, 0, 1.6, 0, 0, 0, 0, 1) * r
           * matrix(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.4, -0.3, 0.7, 1);
}
point grid_P() { return transform(grid_world(), grid_Po()); }
vector grid_N() { return normalize(transform(transpose(1 / grid_world()), grid_No())); }
vector grid_T() { return normalize(transform(grid_world(), grid_To())); }
vector grid_I() { return grid_P() - point(1.1, 0.9, 4.3); }
float grid_u() { return 0.0313 + 0.9371 * u + 0.0129 * v; }
float grid_v() { return 0.0217 + 0.0171 * u + 0.9331 * v; }
"""
WORDS = {
    'transform("object", P)': "grid_Po()", 'transform("object", N)': "grid_No()", 'transform("object", dPdu)': "grid_To()",
    'transform("object", cross(N, dPdu))': "cross(grid_No(), grid_To())",
    'matrix("object", "common")': "grid_world()", 'matrix("common", "object")': "(1 / grid_world())",
    "vector2(u, v)": "vector2(grid_u(), grid_v())",
}
COLOR = "0.11+0.67*u+0.13*v 0.83-0.21*u-0.47*v 0.29-0.17*u+0.59*v 0.41+0.37*u+0.19*v".split()
STREAMS = {  # initial values of parameters with lockgeom=0
    "texcoord": "1.21-0.83*u+0.31*v -0.37+0.29*u+1.13*v 0 0".split(),
    "color_0": COLOR, "color": [COLOR[2], COLOR[0], COLOR[1], COLOR[3]],
    "": "0.23+0.71*u-0.11*v -0.43+0.31*u+0.53*v 0.79-0.61*u+0.23*v 0.51+0.17*u-0.37*v".split(),
}
PARTS = {"vector2": "xy", "vector4": "xyzw"}


def stream_value(case, kind, name, length):
    row = next(values for key, values in STREAMS.items() if name.startswith(key))
    if name == "frame":
        return "33"
    if kind == "int":
        return "1" if "boolean" in case else "3"
    if length:
        return "{" + ", ".join(row[: int(length)]) + "}"
    return row[0] if kind == "float" else f"{kind}({', '.join(row[:3])})"


def instrument(source, case, probe):
    """The shader with the scene's streams, which prints its result for each pixel."""
    for text, value in WORDS.items():
        source = source.replace(text, value)
    # at the point, not over the pixel, which is a quarter of the image
    source = re.sub(r'("missingcolor", color\([^()]*\)|"missingalpha", missing.w|"alpha", alpha)\)', r'\1, "width", 0, "interp", "linear")', source)
    source = source.replace('"interp", interp, ', "").replace('", swrap', '", "periodic"').replace('", twrap', '", "periodic"')
    source = re.sub(r'"(s|t|)wrap", "\w+"', r'"\1wrap", "periodic"', source) # as the reference has it
    head, _, body = source.rpartition("\nshader ")
    body = re.sub(r"(int|float|color|vector) (\w+)(?:\[(\d)\])? = (?:[^\[\n]*?) \[\[ int lockgeom = 0 \]\]",
                  lambda m: f"{m[1]} {m[2]}{f'[{m[3]}]' if m[3] else ''} = {stream_value(case, m[1], m[2], m[3])}", body)
    for word in "P", "N", "I":
        body = re.sub(rf"\b{word}\b(?!\()", f"grid_{word}()", body)
        head = re.sub(rf"\b{word}\b(?!\()", f"grid_{word}()", head)
    body = re.sub(r"\bdPdu\b", "grid_T()", body)
    body = re.sub(r"\btime\b(?! =)", "1.37", body)
    body = re.sub(r'string (\w+) = "[^"]*"', f'string \\1 = "{probe}"', body)
    kind, name = re.search(r"output (\w+) (\w+) =", body).groups()
    if kind in PARTS:
        values = [f"{name}.{part}" for part in PARTS[kind]]
    else:
        values = [name] if kind in ("int", "float") else [f"{name}[{i}]" for i in range(3)]
    formats = " ".join(["%d" if kind == "int" else "%.9g"] * len(values))
    pixel = "int(4 * v) * 4 + int(4 * u)"
    end = body.rindex("}")
    body = f'{body[:end]}    printf("ROW {case} %d {formats}\\n", {pixel}, {", ".join(values)});\n}}\n'
    if not head.lstrip().startswith("//"):
        raise ValueError(case)
    return SCENE + head + "\nshader " + body


def write_probe(path):
    """The scene's texture: 64x64 texels of float RGBA in a TIFF without compression, top row first."""
    from math import cos, pi, sin
    size, tau = 64, 2 * pi
    texels = []
    for y in range(size):
        for x in range(size):
            u, v = (x + 0.5) / size, (size - y - 0.5) / size
            texels += [0.5 + 0.4 * sin(tau * u) * cos(tau * v), 0.45 + 0.35 * cos(tau * (u + 2 * v)),
                       0.55 + 0.25 * sin(tau * (2 * u - v) + 0.7) + 0.15 * cos(tau * v),
                       0.6 + 0.3 * cos(tau * u + 0.4) * sin(tau * v + 1.1)]
    data = struct.pack(f"<{len(texels)}f", *texels)
    bits, formats, sizes = 8 + len(data), 16 + len(data), 24 + len(data)
    tags = [(256, 3, 1, size), (257, 3, 1, size), (258, 3, 4, bits), (259, 3, 1, 1), (262, 3, 1, 2), (273, 4, 1, 8), (277, 3, 1, 4),
            (278, 3, 1, size), (279, 4, 1, len(data)), (284, 3, 1, 1), (338, 3, 1, 1), (339, 3, 4, formats)]
    directory = struct.pack("<H", len(tags)) + b"".join(struct.pack("<HHII", *tag) for tag in tags) + struct.pack("<I", 0)
    path.write_bytes(struct.pack("<2sHI", b"II", 42, sizes) + data + struct.pack("<4H", *[32] * 4) + struct.pack("<4H", *[3] * 4) + directory)


def compile_case(path, case, folder):
    probe = folder / "probe.tif"
    if not probe.exists():
        write_probe(probe)
    target = folder / f"s{len(list(folder.glob('*.oso')))}.osl"
    target.write_text(instrument(path.read_text(encoding="utf-8"), case, probe), encoding="utf-8")
    done = subprocess.run(["oslc", "-q", "-o", target.with_suffix(".oso"), target], capture_output=True, text=True)
    if done.returncode or "warning" in done.stdout + done.stderr:
        print(f"failed: {case}: {(done.stdout + done.stderr).strip()[:400]}")
        return None
    return target.with_suffix(".oso")


def wanted(rows):
    """Rows with numbers to compare; of each graph the first that varies, unless all are asked for."""
    rows = [r for r in rows if r["status"] in ("ok", "derived")]
    if "--all" in FLAGS:
        return rows
    first = {}
    for row in rows:
        graph = row["case"].split("/")[0]
        if graph not in first or (first[graph]["pixels"] == "1" and row["pixels"] == "16"):
            first[graph] = row
    return list(first.values())


def compare(row, got):
    expected = [float(x) for x in row["values"].split(",")]
    if int(row["pixels"]) == 1:
        expected *= 16
    values = [x for pixel in range(16) for x in got.get(pixel, [])]
    if len(values) != len(expected):
        return f"{len(values)} values instead of {len(expected)}"
    worst = max(abs(a - b) if a == a else float("inf") for a, b in zip(values, expected))
    tolerance = max(float(row["tol"]), 1e-5 * max(map(abs, expected)))
    return f"differs by {worst:g}, tolerance {tolerance:g}" if worst > tolerance else None


def run_document(name, folder):
    document = pathlib.Path(ROWS) / "cases" / f"{name}.mtlx"
    with open(pathlib.Path(ROWS) / "expected" / f"{name}.csv", newline="", encoding="utf-8") as file:
        lines = [line.rstrip("\n").split(",", 5) for line in file][1:]
    rows = wanted([dict(zip(("case", "type", "pixels", "status", "tol", "values"), line)) for line in lines])
    if not rows:
        return {}
    elements = [word for row in rows for word in ("--element", row["case"])]
    done = subprocess.run([MXGEN, document, "--target", "osl", "-q", "-o", folder, *elements], capture_output=True, text=True)
    if done.returncode:
        return {rows[0]["case"]: f"mxgen: {done.stderr.strip()[:300]}"}
    shaders, faults = [], {}
    for row in rows:
        path = folder / (row["case"].replace("/", ".") + ".osl")
        oso = compile_case(path, row["case"], folder)
        if oso:
            shaders += ["--layer", oso.stem, "--shader", str(oso), oso.stem, "--entry", oso.stem]
        else:
            faults[row["case"]] = "does not compile"
    out = subprocess.run(["testshade", "-t", "1", "-g", "4", "4", "--center", *entries(shaders)], capture_output=True, text=True)
    got = {}
    for line in out.stdout.splitlines():
        if line.startswith("ROW "):
            _, case, pixel, *values = line.split()
            got.setdefault(case, {})[int(pixel)] = [float(v) for v in values]
    for row in rows:
        fault = faults.get(row["case"]) or compare(row, got.get(row["case"], {}))
        if fault:
            faults[row["case"]] = fault
    counts["passed"] += len(rows) - len(faults)
    return faults


def entries(shaders):
    return [word for i in range(0, len(shaders), 7) for word in (*shaders[i + 2:i + 5], *shaders[i + 5:i + 7])]


if not shutil.which("oslc") or not shutil.which("testshade"):
    print("skip: osl-values: oslc or testshade is not installed\nosl-values: 0 passed, 0 failed, 1 skipped")
    sys.exit(77)
known = {}
for path in pathlib.Path(ROWS) / "deviations.tsv", pathlib.Path(DEVIATIONS): # what no target follows, and what OSL does not
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.strip() and not line.startswith("#"):
            document, case, reason = line.split("\t")
            known[document, case] = reason
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
sys.exit(counts["failed"] > 0)
