# SPDX-License-Identifier: Apache-2.0
"""A library of colour spaces from an OpenColorIO configuration.

    python3 -m mxgen.ocio config.ocio -o studio_colors.mtlx
    mxgen material.mtlx --library studio_colors.mtlx

The file has, for each colour space, a definition that converts from it to lin_rec709 and one that converts back. They are
expressions of the portable language, so they serve every target, and whoever reads the library needs no OpenColorIO. Needs the
Python package of OpenColorIO 2.1 or later (Debian: python3-pyopencolorio).
"""
from __future__ import annotations

import argparse
import math
import re
import sys
from dataclasses import dataclass, field
from typing import Any, Callable, Dict, Iterator, List, Optional, Sequence, Tuple
from xml.sax.saxutils import quoteattr

#: the space of mxgen's library that all others convert to
HUB = "lin_rec709"
#: other names of the hub in configurations
HUB_NAMES = (HUB, "lin_srgb", "Linear Rec.709 (sRGB)", "lin_rec709_srgb", "Utility - Linear - sRGB", "Utility - Linear - Rec.709")
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*\Z")
_MAX_LUT = 4096  # entries of a table
_MAX_GRID = 33  # entries of a table of three dimensions, in each direction
_INVERSE_GRID = 25  # of the table that stands for the inverse of such a table; OpenColorIO's fast way has one as well

Triple = Tuple[float, float, float]


class UnsupportedError(Exception):
    """A transform that an expression cannot say."""


def _number(value: float) -> str:
    if not math.isfinite(value):
        raise UnsupportedError(f"the number {value}")
    text = repr(float(value))
    return text if "." in text or "e" in text else text + ".0"


def _vec3(values: Sequence[float]) -> str:
    texts = [_number(value) for value in values[:3]]
    return f"vec3({texts[0] if len(set(texts)) == 1 else ', '.join(texts)})"


@dataclass
class _Function:
    """The statements of a function of one colour, `c`."""

    name: str
    lines: List[str] = field(default_factory=list)
    tables: List[str] = field(default_factory=list)

    def add(self, expression: str) -> None:
        self.lines.append(f"c = {expression};")

    def text(self) -> str:
        body = "".join(f"    {line}\n" for line in self.lines)
        return "".join(self.tables) + f"vec3 {self.name}(vec3 c)\n{{\n{body}    return c;\n}}\n"


def _choice(condition: str, yes: str, no: str) -> str:
    """Component by component; `condition` compares c with a vec3 by `<`."""
    edge = condition.split(" < ")[1]
    return f"mix({yes}, {no}, step({edge}, c))"


# ---- Transforms. OpenColorIO's reference says the formulas: Transforms, "Log…", "Exponent…", "CDL", "Range". ----


def _is_inverse(ocio: Any, transform: Any) -> bool:
    return bool(transform.getDirection() == ocio.TRANSFORM_DIR_INVERSE)


def _solve(matrix: List[List[float]]) -> List[List[float]]:
    """The inverse of a square matrix, by Gauss and Jordan with pivots."""
    size = len(matrix)
    rows = [row + [float(i == j) for j in range(size)] for i, row in enumerate(matrix)]
    for i in range(size):
        pivot = max(range(i, size), key=lambda row: abs(rows[row][i]))
        if rows[pivot][i] == 0:
            raise UnsupportedError("the inverse of a singular matrix")
        rows[i], rows[pivot] = rows[pivot], rows[i]
        rows[i] = [value / rows[i][i] for value in rows[i]]
        for j in range(size):
            if j != i:
                rows[j] = [a - rows[j][i] * b for a, b in zip(rows[j], rows[i])]
    return [row[size:] for row in rows]


def _matrix(ocio: Any, transform: Any, out: _Function) -> None:
    values, offset = transform.getMatrix(), transform.getOffset()
    rows = [list(values[4 * i:4 * i + 3]) for i in range(3)]
    shift = list(offset[:3])
    if any(values[4 * i + 3] for i in range(3)):
        raise UnsupportedError("a matrix that reads alpha")
    if _is_inverse(ocio, transform):
        rows = _solve(rows)
        shift = [-sum(a * b for a, b in zip(row, shift)) for row in rows]
    columns = [rows[i][j] for j in range(3) for i in range(3)]
    product = f"mat3({', '.join(map(_number, columns))}) * c"
    out.add(product + (f" + {_vec3(shift)}" if any(shift) else ""))


def _exponent(ocio: Any, transform: Any, out: _Function) -> None:
    exponents = [1 / value if _is_inverse(ocio, transform) else value for value in transform.getValue()]
    style = transform.getNegativeStyle()
    if style == ocio.NEGATIVE_CLAMP:
        out.add(f"pow(max(c, vec3(0.0)), {_vec3(exponents)})")
    elif style == ocio.NEGATIVE_MIRROR:
        out.add(f"sign(c) * pow(abs(c), {_vec3(exponents)})")
    else:
        out.add(_choice("c < vec3(0.0)", "c", f"pow(max(c, vec3(0.0)), {_vec3(exponents)})"))


def _exponent_with_linear(ocio: Any, transform: Any, out: _Function) -> None:
    curves: List[Tuple[float, float, float, float]] = []  # gamma, offset, break, slope of the line
    for gamma, offset in zip(transform.getGamma()[:3], transform.getOffset()[:3]):
        gamma, offset = max(gamma, 1.000001), max(offset, 1e-6)
        edge = offset / (gamma - 1)
        curves.append((gamma, offset, edge, ((edge + offset) / (1 + offset))**gamma / edge))
    gammas, offsets, edges, slopes = ([curve[i] for curve in curves] for i in range(4))
    scale = [1 + offset for offset in offsets]
    mirrors = transform.getNegativeStyle() == ocio.NEGATIVE_MIRROR
    side = f"side_{len(out.lines)}"
    if mirrors:
        out.lines.append(f"vec3 {side} = sign(c);")
        out.add("abs(c)")
    if _is_inverse(ocio, transform):
        ends = [edge * slope for edge, slope in zip(edges, slopes)]
        power = f"pow(max(c, vec3(0.0)), {_vec3([1 / gamma for gamma in gammas])}) * {_vec3(scale)} - {_vec3(offsets)}"
        out.add(_choice(f"c < {_vec3(ends)}", f"c / {_vec3(slopes)}", power))
    else:
        power = f"pow(max((c + {_vec3(offsets)}) / {_vec3(scale)}, vec3(0.0)), {_vec3(gammas)})"
        out.add(_choice(f"c < {_vec3(edges)}", f"c * {_vec3(slopes)}", power))
    if mirrors:
        out.add(f"{side} * c")


def _log(ocio: Any, transform: Any, out: _Function) -> None:
    scale = math.log(transform.getBase())
    if _is_inverse(ocio, transform):
        out.add(f"exp(c * {_number(scale)})")
    else:
        out.add(f"log(max(c, vec3(1.17549435e-38))) / {_number(scale)}")


def _affine_parts(transform: Any) -> Tuple[float, Sequence[float], Sequence[float], Sequence[float], Sequence[float]]:
    return (math.log(transform.getBase()), transform.getLogSideSlopeValue(), transform.getLogSideOffsetValue(),
            transform.getLinSideSlopeValue(), transform.getLinSideOffsetValue())


def _log_side(transform: Any) -> str:
    scale, slope, offset, lin_slope, lin_offset = _affine_parts(transform)
    inside = f"max(c * {_vec3(lin_slope)} + {_vec3(lin_offset)}, vec3(1.17549435e-38))"
    return f"log({inside}) * {_vec3([value / scale for value in slope])} + {_vec3(offset)}"


def _lin_side(transform: Any) -> str:
    scale, slope, offset, lin_slope, lin_offset = _affine_parts(transform)
    return f"(exp((c - {_vec3(offset)}) * {_vec3([scale / value for value in slope])}) - {_vec3(lin_offset)}) / {_vec3(lin_slope)}"


def _log_affine(ocio: Any, transform: Any, out: _Function) -> None:
    out.add(_lin_side(transform) if _is_inverse(ocio, transform) else _log_side(transform))


def _log_camera(ocio: Any, transform: Any, out: _Function) -> None:
    scale, slope, offset, lin_slope, lin_offset = _affine_parts(transform)
    edges = transform.getLinSideBreakValue()
    inside = [a * edge + b for a, edge, b in zip(lin_slope, edges, lin_offset)]
    ends = [a * math.log(x) / scale + b for a, x, b in zip(slope, inside, offset)]
    # OpenColorIO: without a slope of its own, the line continues the curve smoothly.
    try:
        lines = list(transform.getLinearSlopeValue())
    except Exception:  # pylint: disable=broad-except  # the binding has no narrower one
        lines = []
    if not lines or any(math.isnan(line) for line in lines):
        lines = [a * b / (x * scale) for a, b, x in zip(slope, lin_slope, inside)]
    shifts = [end - line * edge for end, line, edge in zip(ends, lines, edges)]
    if _is_inverse(ocio, transform):
        out.add(_choice(f"c < {_vec3(ends)}", f"(c - {_vec3(shifts)}) / {_vec3(lines)}", _lin_side(transform)))
    else:
        out.add(_choice(f"c < {_vec3(edges)}", f"c * {_vec3(lines)} + {_vec3(shifts)}", _log_side(transform)))


def _cdl(ocio: Any, transform: Any, out: _Function) -> None:
    slope, offset, power = transform.getSlope(), transform.getOffset(), transform.getPower()
    saturation, clamps = transform.getSat(), transform.getStyle() == ocio.CDL_ASC
    limit: Callable[[str], str] = (lambda text: f"clamp({text}, vec3(0.0), vec3(1.0))") if clamps else (lambda text: text)
    luma = "vec3(dot(c, vec3(0.2126, 0.7152, 0.0722)))"

    def powers(exponents: Sequence[float]) -> None:
        if all(exponent == 1 for exponent in exponents):
            return
        power_of = f"pow(max(c, vec3(0.0)), {_vec3(exponents)})"
        out.add(power_of if clamps else _choice("c < vec3(0.0)", "c", power_of))

    if _is_inverse(ocio, transform):
        if saturation == 0:
            raise UnsupportedError("the inverse of no saturation")
        out.add(limit("c"))
        out.add(limit(f"mix({luma}, c, {_number(1 / saturation)})"))
        powers([1 / value for value in power])
        out.add(limit(f"(c - {_vec3(offset)}) / {_vec3(slope)}"))
    else:
        out.add(limit(f"c * {_vec3(slope)} + {_vec3(offset)}"))
        powers(power)
        out.add(limit(f"mix({luma}, c, {_number(saturation)})"))


def _range(ocio: Any, transform: Any, out: _Function) -> None:
    has = transform.hasMinInValue(), transform.hasMaxInValue()
    low = (transform.getMinInValue(), transform.getMinOutValue()) if has[0] else None
    high = (transform.getMaxInValue(), transform.getMaxOutValue()) if has[1] else None
    if _is_inverse(ocio, transform):
        low, high = (None if end is None else (end[1], end[0]) for end in (low, high))
    scale = (high[1] - low[1]) / (high[0] - low[0]) if low and high else 1.0
    fixed = low or high
    shift = fixed[1] - scale * fixed[0] if fixed else 0.0
    out.add(f"c * {_number(scale)} + {_vec3([shift] * 3)}")
    if transform.getStyle() == ocio.RANGE_CLAMP:
        if low:
            out.add(f"max(c, {_vec3([low[1]] * 3)})")
        if high:
            out.add(f"min(c, {_vec3([high[1]] * 3)})")


def _table(out: _Function, kind: str, entries: Sequence[str]) -> str:
    """The name of a new array."""
    name = f"{out.name}_table_{len(out.tables) + 1}"
    out.tables.append(f"const {kind} {name}[{len(entries)}] = {kind}[{len(entries)}]({', '.join(entries)});\n")
    return name


def _tables_of(ocio: Any, transform: Any, out: _Function) -> List[Tuple[str, List[float]]]:
    """An array for each channel, and its entries; equal channels share one."""
    length = transform.getLength()
    if transform.getInputHalfDomain() or transform.getHueAdjust() != ocio.HUE_NONE:
        raise UnsupportedError("a table (Lut1DTransform) of half floats, or one that adjusts hues")
    if not 2 <= length <= _MAX_LUT:
        raise UnsupportedError(f"a table (Lut1DTransform) of {length} entries; 2 to {_MAX_LUT} are possible")
    channels = [list(channel) for channel in zip(*(transform.getValue(i) for i in range(length)))]
    if _is_inverse(ocio, transform):
        channels = [_monotonic(channel) for channel in channels]
    found: List[Tuple[str, List[float]]] = []
    for channel in channels:
        same = [one for one in found if one[1] == channel]
        found.append(same[0] if same else (_table(out, "float", [_number(value) for value in channel]), channel))
    return found


def _monotonic(entries: List[float]) -> List[float]:
    """OpenColorIO inverts a table that goes back as if it stayed where it was."""
    choose = max if entries[-1] >= entries[0] else min
    result = entries[:1]
    for entry in entries[1:]:
        result.append(choose(result[-1], entry))
    return result


def _search(out: _Function, table: str, entries: List[float]) -> str:
    """A function that finds the place of a value in a table, from 0 to 1: bisection. Flat ends of the table have one place."""
    first, last = 0, len(entries) - 1
    while first < last and entries[first + 1] == entries[first]:
        first += 1
    while last > first and entries[last - 1] == entries[last]:
        last -= 1
    name, less = f"{table}_place", "<" if entries[-1] >= entries[0] else ">"
    if f"float {name}(" in "".join(out.tables):
        return name
    low, high = sorted((entries[first], entries[last]))
    lines = [f"float v = clamp(value, {_number(low)}, {_number(high)});", f"int at = {first};"]
    step = 1 << max(0, (last - first).bit_length() - 1)
    while step:
        lines.append(f"if (at + {step} < {last} && {table}[at + {step}] {less} v)\n        at += {step};")
        step //= 2
    lines += [f"float size = {table}[min(at + 1, {last})] - {table}[at];",
              f"return (float(at) + (size == 0.0 ? 0.0 : (v - {table}[at]) / size)) / {_number(len(entries) - 1)};"]
    out.tables.append(f"float {name}(float value)\n{{\n" + "".join(f"    {line}\n" for line in lines) + "}\n")
    return name


def _lut_1d(ocio: Any, transform: Any, out: _Function) -> None:
    tables = _tables_of(ocio, transform, out)
    if _is_inverse(ocio, transform):
        places = [_search(out, table, entries) for table, entries in tables]
        out.add(f"vec3({', '.join(f'{place}(c.{axis})' for place, axis in zip(places, 'rgb'))})")
        return
    length = transform.getLength()
    place, base = f"{tables[0][0]}_place", f"{tables[0][0]}_base"
    out.lines.append(f"vec3 {place} = clamp(c, vec3(0.0), vec3(1.0)) * {_number(length - 1)};")
    out.lines.append(f"vec3 {base} = min(floor({place}), vec3({_number(length - 2)}));")
    parts = []
    for (table, _), axis in zip(tables, "rgb"):
        first = f"int({base}.{axis})"
        parts.append(f"mix({table}[{first}], {table}[{first} + 1], {place}.{axis} - {base}.{axis})")
    out.add(f"vec3({', '.join(parts)})")


# The sum of the corners of a tetrahedron, or of all corners of a cell (OpenColorIO's reference, "Interpolation"). The corners of the
# tetrahedron lie on the way from the low corner of the cell to the high one along the axes, the largest part first.
_TETRAHEDRAL = """vec3 {name}(vec3 place)
{{
    vec3 low = min(floor(place), vec3({last}));
    vec3 f = place - low;
    vec3 first = vec3(0.0, 0.0, 1.0);
    vec3 second = f.r >= f.g ? vec3(1.0, 0.0, 1.0) : vec3(0.0, 1.0, 1.0);
    if (f.r >= f.g && f.r >= f.b) {{
        first = vec3(1.0, 0.0, 0.0);
        second = f.g >= f.b ? vec3(1.0, 1.0, 0.0) : vec3(1.0, 0.0, 1.0);
    }} else if (f.g >= f.b) {{
        first = vec3(0.0, 1.0, 0.0);
        second = f.r >= f.b ? vec3(1.0, 1.0, 0.0) : vec3(0.0, 1.0, 1.0);
    }}
    float largest = max(f.r, max(f.g, f.b));
    float least = min(f.r, min(f.g, f.b));
    float middle = f.r + f.g + f.b - largest - least;
    return {name}_at(low) * (1.0 - largest) + {name}_at(low + first) * (largest - middle)
           + {name}_at(low + second) * (middle - least) + {name}_at(low + vec3(1.0)) * least;
}}
"""
_TRILINEAR = """vec3 {name}(vec3 place)
{{
    vec3 low = min(floor(place), vec3({last}));
    vec3 f = place - low;
    vec3 near = mix(mix({name}_at(low), {name}_at(low + vec3(0.0, 0.0, 1.0)), f.b),
                    mix({name}_at(low + vec3(0.0, 1.0, 0.0)), {name}_at(low + vec3(0.0, 1.0, 1.0)), f.b), f.g);
    vec3 far = mix(mix({name}_at(low + vec3(1.0, 0.0, 0.0)), {name}_at(low + vec3(1.0, 0.0, 1.0)), f.b),
                   mix({name}_at(low + vec3(1.0, 1.0, 0.0)), {name}_at(low + vec3(1.0)), f.b), f.g);
    return mix(near, far, f.r);
}}
"""


def _baked(ocio: Any, transform: Any, size: int) -> List[List[float]]:
    """What OpenColorIO computes for the places of a table, the last channel fastest."""
    processor = ocio.Config.CreateRaw().getProcessor(transform).getOptimizedCPUProcessor(ocio.OPTIMIZATION_LOSSLESS)
    scale = 1 / (size - 1)
    places = [x * scale for r in range(size) for g in range(size) for b in range(size) for x in (r, g, b)]
    values = processor.applyRGB(places)
    return [values[3 * i:3 * i + 3] for i in range(size**3)]


def _lut_3d(ocio: Any, transform: Any, out: _Function) -> None:
    size = transform.getGridSize()
    entries: List[List[float]]
    if _is_inverse(ocio, transform):
        size = _INVERSE_GRID
        entries = _baked(ocio, transform, size)
    elif 2 <= size <= _MAX_GRID:
        entries = [transform.getValue(r, g, b) for r in range(size) for g in range(size) for b in range(size)]
    else:
        raise UnsupportedError(f"a table (Lut3DTransform) of {size} entries in each direction; 2 to {_MAX_GRID} are possible")
    tables = [_table(out, "float", [_number(float(f"{value:.7g}")) for value in channel]) for channel in zip(*entries)]
    name = f"{tables[0]}_mix"
    index = f"int((place.r * {_number(size)} + place.g) * {_number(size)} + place.b)"
    out.tables.append(f"vec3 {name}_at(vec3 place)\n{{\n    int at = {index};\n    return vec3({', '.join(f'{table}[at]' for table in tables)});\n}}\n")
    is_tetrahedral = transform.getInterpolation() in (ocio.INTERP_TETRAHEDRAL, ocio.INTERP_BEST)
    out.tables.append((_TETRAHEDRAL if is_tetrahedral else _TRILINEAR).format(name=name, last=_number(size - 2)))
    out.add(f"{name}(clamp(c, vec3(0.0), vec3(1.0)) * {_number(size - 1)})")


_WRITERS: Dict[str, Callable[[Any, Any, _Function], None]] = {
    "MatrixTransform": _matrix,
    "ExponentTransform": _exponent,
    "ExponentWithLinearTransform": _exponent_with_linear,
    "LogTransform": _log,
    "LogAffineTransform": _log_affine,
    "LogCameraTransform": _log_camera,
    "CDLTransform": _cdl,
    "RangeTransform": _range,
    "Lut1DTransform": _lut_1d,
    "Lut3DTransform": _lut_3d,
}


def _parts(transform: Any) -> Iterator[Any]:
    if type(transform).__name__ == "GroupTransform":
        for part in transform:
            yield from _parts(part)
    elif type(transform).__name__ != "AllocationTransform":  # which OpenColorIO's own GPU shaders need only
        yield transform


def _convert(ocio: Any, config: Any, source: str, target: str, name: str) -> _Function:
    processor = config.getProcessor(source, target).getOptimizedProcessor(ocio.OPTIMIZATION_LOSSLESS)
    out = _Function(name)
    for part in _parts(processor.createGroupTransform()):
        kind = type(part).__name__
        if kind not in _WRITERS:
            raise UnsupportedError(f"a {kind}")
        _WRITERS[kind](ocio, part, out)
    return out


# ---- The library ----


@dataclass
class ColorLibrary:
    """What `make_library` gives: two files, and what they lack."""

    #: the definitions; they name the file of the functions as `functions_file`
    document: str
    #: functions of the portable language
    functions: str
    #: names that documents can use
    spaces: List[str]
    #: (name, reason) of the colour spaces that are not in the library
    missing: List[Tuple[str, str]]
    #: (name, reason) of those to which nothing converts, so they cannot be the working space
    one_way: List[Tuple[str, str]]


def _names_of(space: Any) -> List[str]:
    return [name for name in [space.getName(), *space.getAliases()] if _NAME.match(name)]


def _hub_of(config: Any, hub: Optional[str]) -> str:
    for name in [hub] if hub else HUB_NAMES:
        space = config.getColorSpace(name)
        if space:
            return str(space.getName())
    what = f"'{hub}' is no colour space of the configuration" if hub else "the configuration has no linear Rec. 709 by a known name"
    raise ValueError(f"{what}; say the name of linear Rec. 709 (--hub)")


def _definitions(source: str, target: str, function: str, file: str) -> str:
    text = ""
    for kind, call in ("color3", f"{function}({{{{in}}}})"), ("color4", f"vec4({function}({{{{in}}}}.rgb), {{{{in}}}}.a)"):
        name = f"{source}_to_{target}"
        default = ", ".join(["0"] * int(kind[-1]))
        text += (f'  <nodedef name="ND_{name}_{kind}" node="{name}" nodegroup="colortransform" doc="Color from {source} to {target}.">\n'
                 f'    <input name="in" type="{kind}" value="{default}" doc="The color."/>\n'
                 f'    <output name="out" type="{kind}"/>\n  </nodedef>\n'
                 f'  <implementation name="IM_{name}_{kind}" nodedef="ND_{name}_{kind}" file={quoteattr(file)} sourcecode="{call}"/>\n')
    return text


def make_library(config: Any, functions_file: str, hub: Optional[str] = None) -> ColorLibrary:
    """The colour spaces of an OpenColorIO configuration (PyOpenColorIO.Config) as a library.

    `hub` is the configuration's name of linear Rec. 709 with the white D65; None looks for a known one. Raises ValueError if
    the configuration has none. A space is missing, with the reason, if no name of it is an identifier, or if it needs a
    transform that an expression cannot say, or a larger table.
    """
    import PyOpenColorIO as ocio  # type: ignore[import]  # pylint: disable=import-outside-toplevel  # an optional package

    center = _hub_of(config, hub)
    out = ColorLibrary('<?xml version="1.0"?>\n<materialx version="1.39">\n', "", [], [], [])
    for space in config.getColorSpaces():
        names = [name for name in _names_of(space) if name != HUB]
        if space.getName() == center or space.isData():
            continue
        if not names:
            out.missing.append((space.getName(), "no name or alias of it is an identifier"))
            continue
        try:
            to_hub = _convert(ocio, config, space.getName(), center, f"ocio_{names[0]}_to_{HUB}")
        except (UnsupportedError, ocio.Exception) as error:
            out.missing.append((space.getName(), f"it needs {error}"))
            continue
        out.functions += to_hub.text()
        out.document += "".join(_definitions(name, HUB, to_hub.name, functions_file) for name in names)
        out.spaces += names
        try:
            from_hub = _convert(ocio, config, center, space.getName(), f"ocio_{HUB}_to_{names[0]}")
        except (UnsupportedError, ocio.Exception) as error:
            out.one_way.append((space.getName(), f"it needs {error}"))
            continue
        out.functions += from_hub.text()
        out.document += "".join(_definitions(HUB, name, from_hub.name, functions_file) for name in names)
    out.document += "</materialx>\n"
    return out


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """The command `python3 -m mxgen.ocio`."""
    parser = argparse.ArgumentParser(prog="python3 -m mxgen.ocio", description="Writes the colour spaces of an OpenColorIO configuration as a library.")
    parser.add_argument("config", help="the configuration, config.ocio")
    parser.add_argument("-o", "--output", required=True, help="the library, NAME.mtlx; the functions are in NAME.glsl beside it")
    parser.add_argument("--hub", help="the configuration's name of linear Rec. 709")
    options = parser.parse_args(arguments)
    try:
        import PyOpenColorIO as ocio  # pylint: disable=import-outside-toplevel
    except ImportError:
        print("mxgen.ocio: the Python package of OpenColorIO is missing; Debian has it as python3-pyopencolorio", file=sys.stderr)
        return 2
    if not options.output.endswith(".mtlx"):
        print(f"mxgen.ocio: expected a file that ends in .mtlx, not '{options.output}'", file=sys.stderr)
        return 2
    functions = re.sub(r"\.mtlx\Z", ".glsl", options.output)
    try:
        library = make_library(ocio.Config.CreateFromFile(options.config), re.split(r"[/\\]", functions)[-1], options.hub)
        for path, text in (options.output, library.document), (functions, library.functions):
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
    except (ValueError, OSError, ocio.Exception) as error:
        print(f"mxgen.ocio: {error}", file=sys.stderr)
        return 1
    for name, reason in library.missing:
        print(f"mxgen.ocio: warning: '{name}' is not in the library: {reason}", file=sys.stderr)
    for name, reason in library.one_way:
        print(f"mxgen.ocio: warning: '{name}' cannot be the working space: {reason}", file=sys.stderr)
    print(f"{options.output}: {len(library.spaces)} names of colour spaces, {len(library.missing)} colour spaces missing")
    return 0


if __name__ == "__main__":
    sys.exit(main())
