#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes cases/films.mtlx and expected/films.csv: slab_film_at of 400 films.

The numbers are Airy's sum (Born and Wolf 1999, "Principles of Optics", section 7.6) for a dielectric whose reflectance
in air is f0, under a film, in both polarisations, integrated over the CIE's curves wavenumber by wavenumber. The
shader has Gaussians after a Fourier transform instead (Belcour and Barla 2017). The curves are their Gaussians: what
is tested is the optics. A film adds to Schlick's curve what it adds to the dielectric.
"""
import cmath
import math
import os
import random

# wavenumber (in radians for 4 pi micrometres / wavelength of path), deviation, height of the Gaussians of X, Y, Z
CURVES = [
    [(1.6810, math.sqrt(2 * 0.0043278), 0.846202), (2.2399, math.sqrt(2 * 0.0045282), 0.153798)],
    [(1.7953, math.sqrt(2 * 0.0093046), 1.0)],
    [(2.2084, math.sqrt(2 * 0.0066121), 1.0)],
]
# CIE 1931: RGB of even energy
TO_XYZ = [(0.49, 0.31, 0.2), (0.17697, 0.8124, 0.01063), (0, 0.01, 0.99)]
TO_RGB = [(2.3706743, -0.9000405, -0.4706338), (-0.513885, 1.4253036, 0.0885814), (0.0052982, -0.0146949, 1.0093968)]


def times(matrix, v):
    return [sum(a * b for a, b in zip(row, v)) for row in matrix]


def amplitudes(n1, c1, n2, c2):
    """Of an interface from n1 to n2 at these cosines: perpendicular and parallel light."""
    return (n1 * c1 - n2 * c2) / (n1 * c1 + n2 * c2), (n2 * c1 - n1 * c2) / (n2 * c1 + n1 * c2)


def behind(cosine, n1, n2):
    return cmath.sqrt(1 - (1 - cosine * cosine) * (n1 / n2) ** 2)


def reflectance(index, film, film_index, cosine, wavenumber):
    """Of one wave; without a film of the bare interface. `film` is in micrometres."""
    below = behind(cosine, 1, index)
    if film is None:
        return sum(abs(r) ** 2 for r in amplitudes(1, cosine, index, below)) / 2
    inside = behind(cosine, 1, film_index)
    turn = cmath.exp(1j * wavenumber * 4 * math.pi * film_index * inside * film)
    pairs = zip(amplitudes(1, cosine, film_index, inside), amplitudes(film_index, inside, index, below))
    return sum(abs((a + b * turn) / (1 + a * b * turn)) ** 2 for a, b in pairs) / 2


def seen(index, film, film_index, cosine):
    """The reflectances that the three curves see."""
    out = []
    for curve, n in zip(CURVES, index):
        total = weight = 0
        for centre, deviation, height in curve:
            steps = 400
            for i in range(steps):
                x = 5 * (2 * (i + 0.5) / steps - 1)
                share = height * math.exp(-x * x / 2)
                total += share * reflectance(n, film, film_index, cosine, centre + x * deviation)
                weight += share
        out.append(total / weight)
    return out


def clamp(v):
    return [min(max(x, 0), 1) for x in v]


def film_at(f0, thickness, film_index, cosine):
    roots = [math.sqrt(x) for x in times(TO_XYZ, f0)]
    index = [(1 + x) / (1 - x) for x in roots]
    bare = clamp(times(TO_RGB, seen(index, None, 1, cosine)))
    coated = clamp(times(TO_RGB, seen(index, thickness / 1000, film_index, cosine)))
    return clamp(a + (b - c) / (1 - (1 - cosine) ** 5) for a, b, c in zip(f0, coated, bare))


def films():
    numbers = random.Random(2017)
    for thickness in (0, 0.001, 1, 10, 50, 100, 300, 550, 1000):  # matched to the interface: no film
        yield [0.04] * 3, thickness, 1.5, 1
    for thickness in (0, 1, 100):
        yield [0.04] * 3, thickness, 1.4, 1
        yield [1, 0.78, 0.34], thickness, 1.5, 0.8
    while True:
        f0 = [numbers.uniform(0.02, 0.5)] * 3
        if numbers.random() < 0.3:
            f0 = [numbers.uniform(0.02, 0.95) for _ in range(3)]
        cosine = 1 if numbers.random() < 0.5 else numbers.uniform(0.25, 1)
        yield f0, numbers.choice([numbers.uniform(0, 60), numbers.uniform(0, 1500)]), numbers.uniform(1, 2.2), cosine


def main():
    folder = os.path.dirname(os.path.abspath(__file__))
    nodes, outputs, rows = [], [], []
    for number, (f0, thickness, film_index, cosine) in zip(range(400), films()):
        text = ", ".join(f"{x:.4g}" for x in f0)
        f0 = [float(x) for x in text.split(", ")]
        inputs = {"thickness": f"{thickness:.6g}", "ior": f"{film_index:.4g}", "cosine": f"{cosine:.4g}"}
        values = film_at(f0, *(float(x) for x in inputs.values()))
        given = "".join(f'<input name="{name}" type="float" value="{value}"/>' for name, value in inputs.items())
        nodes.append(f'  <slab_film_at name="n{number}" type="color3"><input name="f0" type="color3" value="{text}"/>{given}</slab_film_at>')
        outputs.append(f'  <output name="film_{number}" type="color3" nodename="n{number}"/>')
        rows.append(f"films/film_{number},color3,1,ok,0.005," + ",".join(f"{x:.6f}" for x in values))
    with open(os.path.join(folder, "cases", "films.mtlx"), "w", encoding="utf-8") as file:
        print('<?xml version="1.0"?>\n<!-- Written by films.py. -->\n<materialx version="1.39">\n<nodegraph name="films">',
              *nodes, *outputs, "</nodegraph>\n</materialx>", sep="\n", file=file)
    with open(os.path.join(folder, "expected", "films.csv"), "w", encoding="utf-8") as file:
        print("case,type,pixels,status,tol,values", *rows, sep="\n", file=file)


if __name__ == "__main__":
    main()
