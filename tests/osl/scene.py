# SPDX-License-Identifier: Apache-2.0
"""The scene of tests/conformance for OSL: replaces the streams in shaders by their values at testshade's 4x4 points."""
import re
import struct
import subprocess

# The grid of render/scene.c as functions of u and v; testshade sets these to the centres of 4x4 pixels.
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


def place(source, case, probe):
    """The shader with the scene's streams."""
    for text, value in WORDS.items():
        source = source.replace(text, value)
    # at the point, not over the pixel, which is a quarter of the image
    source = re.sub(r'("missingcolor",\s+(?:color\([^()]*\)|\w+)|"missingalpha",\s+missing.w|"alpha",\s+alpha)\)', r'\1, "width", 0, "interp", "linear")', source)
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
    if not head.lstrip().startswith("//"):
        raise ValueError(case)
    return SCENE + head + "\nshader " + body


def without_modes(document, folder):
    """A copy of a document whose images repeat, as the reference has them, whatever the document says; its includes stay where they are."""
    text = re.sub(r'(<input name="(?:[uv]addressmode|wrap[ST])" type="string" value=")\w+"', r'\1periodic"', document.read_text(encoding="utf-8"))
    text = text.replace('<xi:include href="../', f'<xi:include href="{document.resolve().parent.parent}/')
    copy = folder / document.name
    copy.write_text(text, encoding="utf-8")
    return copy


def printing(case, kind, name):
    """A statement that prints a value for the pixel at hand."""
    if kind in PARTS:
        values = [f"{name}.{part}" for part in PARTS[kind]]
    else:
        values = [name] if kind in ("int", "float") else [f"{name}[{i}]" for i in range(3)]
    formats = " ".join(["%d" if kind == "int" else "%.9g"] * len(values))
    return f'    printf("ROW {case} %d {formats}\\n", int(4 * v) * 4 + int(4 * u), {", ".join(values)});\n'


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


def compile_shader(source, path):
    """What oslc says; None where it says nothing."""
    path.write_text(source, encoding="utf-8")
    done = subprocess.run(["oslc", "-q", "-o", path.with_suffix(".oso"), path], capture_output=True, text=True)
    said = (done.stdout + done.stderr).strip()
    return said[:400] or "failed" if done.returncode or "warning" in said else None


def read_rows(text):
    """The values that testshade printed: by case and pixel."""
    rows = {}
    for line in text.splitlines():
        if line.startswith("ROW "):
            _, case, pixel, *values = line.split()
            rows.setdefault(case, {})[int(pixel)] = [float(v) for v in values]
    return rows


def compare(row, got):
    """What is wrong with the values of a row; None: nothing."""
    expected = [float(x) for x in row["values"].split(",")]
    if int(row["pixels"]) == 1:
        expected *= 16
    values = [x for pixel in range(16) for x in got.get(pixel, [])]
    if len(values) != len(expected):
        return f"{len(values)} values instead of {len(expected)}"
    worst = max(abs(a - b) if a == a else float("inf") for a, b in zip(values, expected))
    tolerance = max(float(row["tol"]), 1e-5 * max(map(abs, expected)))
    return f"differs by {worst:g}, tolerance {tolerance:g}" if worst > tolerance else None


def wanted(path, every):
    """Rows with numbers to compare; of each graph the first that varies, unless all are asked for."""
    with open(path, newline="", encoding="utf-8") as file:
        lines = [line.rstrip("\n").split(",", 5) for line in file][1:]
    rows = [dict(zip(("case", "type", "pixels", "status", "tol", "values"), line)) for line in lines]
    rows = [r for r in rows if r["status"] in ("ok", "derived")]
    if every:
        return rows
    first = {}
    for row in rows:
        graph = row["case"].split("/")[0]
        if graph not in first or (first[graph]["pixels"] == "1" and row["pixels"] == "16"):
            first[graph] = row
    return list(first.values())


def known_deviations(*paths):
    """(document, case) of what no target follows, and what OSL does not."""
    known = set()
    for path in paths:
        for line in path.read_text(encoding="utf-8").splitlines():
            if line.strip() and not line.startswith("#"):
                known.add(tuple(line.split("\t")[:2]))
    return known
