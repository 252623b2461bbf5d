# SPDX-License-Identifier: Apache-2.0
"""A picture of error over cost, as SVG."""
import collections
import math
import statistics

WIDTH, HEIGHT, LEFT, TOP, SIDE = 660, 400, 60, 40, 150
COLORS = {"MaterialX": "#777777", "draft": "#d08020", "good": "#2060c0", "reference": "#208040", "prefiltered": "#2060c0",
          "MaterialX, prefiltered": "#777777"}


def medians(rows):
    """By way and number of samples: the medians of cost and error over all pictures."""
    groups = collections.defaultdict(list)
    for _, row in rows:
        groups[row.way, row.samples].append(row)
    curves = collections.defaultdict(list)
    for (way, _), group in sorted(groups.items()):
        curves[way].append((statistics.median(row.operations for row in group), statistics.median(row.mean for row in group)))
    return curves


def scale(values, first, last):
    """A map of logarithms to the picture, with room at both ends."""
    low, high = math.log(min(values) / 1.2), math.log(max(values) * 1.2)
    return lambda value: first + (last - first) * (math.log(value) - low) / (high - low)


def ticks(values):
    """1, 2 and 5 by powers of ten between the least and the most value."""
    powers = range(math.floor(math.log10(min(values))), math.ceil(math.log10(max(values))) + 1)
    return [f * 10.0 ** p for p in powers for f in (1, 2, 5) if min(values) / 1.2 <= f * 10.0 ** p <= max(values) * 1.2]


def plot(title, rows):
    """rows: pairs of a map and a Row of bench/error.py."""
    curves = medians(rows)
    points = [point for curve in curves.values() for point in curve]
    costs, errors = zip(*points)
    x, y = scale(costs, LEFT, WIDTH - SIDE), scale(errors, HEIGHT - TOP, TOP)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="12">',
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#ffffff"/>',
           f'<text x="{LEFT}" y="20" font-size="14">{title}: median error (CIEDE2000) over scalar operations of a pixel</text>']
    for cost in ticks(costs):
        out.append(f'<path d="M{x(cost):.1f} {TOP}V{HEIGHT - TOP}" stroke="#dddddd"/>'
                   f'<text x="{x(cost):.1f}" y="{HEIGHT - TOP + 16}" text-anchor="middle">{cost:g}</text>')
    for error in ticks(errors):
        out.append(f'<path d="M{LEFT} {y(error):.1f}H{WIDTH - SIDE}" stroke="#dddddd"/>'
                   f'<text x="{LEFT - 6}" y="{y(error) + 4:.1f}" text-anchor="end">{error:g}</text>')
    for number, (way, color) in enumerate(COLORS.items()):
        curve = sorted(curves.get(way, []))
        mark = "none" if way.startswith("MaterialX") else color
        if len(curve) > 1:
            out.append(f'<path d="M{" L".join(f"{x(c):.1f} {y(e):.1f}" for c, e in curve)}" fill="none" stroke="{color}" stroke-width="2"/>')
        for c, e in curve:
            shape = f'<circle cx="{x(c):.1f}" cy="{y(e):.1f}" r="3.5"' if len(curve) > 1 else f'<rect x="{x(c) - 4:.1f}" y="{y(e) - 4:.1f}" width="8" height="8"'
            out.append(f'{shape} fill="{mark if mark != "none" else "#ffffff"}" stroke="{color}"/>')
        out.append(f'<text x="{WIDTH - SIDE + 10}" y="{TOP + 14 + 18 * number}" fill="{color}">{way}</text>')
    return "\n".join([*out, "</svg>", ""])
