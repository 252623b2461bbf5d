# SPDX-License-Identifier: Apache-2.0
"""How far two drawn balls are apart, as program/drawn.c measures it, but without its code: for tests and benchmarks."""
import math
import re

BALL = 0.36  # of the height: the radius of the ball, without its edge


def linear(value):
    """An sRGB channel, 0 to 255, as light (IEC 61966-2-1)."""
    c = value / 255
    return c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4


def lab(color):
    """CIELAB of an sRGB colour, 0 to 255."""
    rows = ((0.4124564 / 0.95047, 0.3575761 / 0.95047, 0.1804375 / 0.95047), (0.2126729, 0.7151522, 0.0721750),
            (0.0193339 / 1.08883, 0.1191920 / 1.08883, 0.9503041 / 1.08883))
    x, y, z = (sum(a * linear(value) for a, value in zip(row, color)) for row in rows)
    x, y, z = (t ** (1 / 3) if t > 216 / 24389 else (24389 / 27 * t + 16) / 116 for t in (x, y, z))
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


def difference(p, q):
    """CIEDE2000 as in Sharma, Wu and Dalal 2005."""
    (l1, a1, b1), (l2, a2, b2) = p, q
    mean = (math.hypot(a1, b1) + math.hypot(a2, b2)) / 2
    more = 1 + 0.5 * (1 - math.sqrt(mean ** 7 / (mean ** 7 + 25 ** 7)))
    c1, c2 = math.hypot(a1 * more, b1), math.hypot(a2 * more, b2)
    h1, h2 = math.degrees(math.atan2(b1, a1 * more)) % 360, math.degrees(math.atan2(b2, a2 * more)) % 360
    step = 0 if c1 * c2 == 0 else (h2 - h1 + 180) % 360 - 180
    hue = h1 + h2 if c1 * c2 == 0 else (h1 + step / 2) % 360
    light, chroma = (l1 + l2) / 2, (c1 + c2) / 2
    t = (1 - 0.17 * math.cos(math.radians(hue - 30)) + 0.24 * math.cos(math.radians(2 * hue))
         + 0.32 * math.cos(math.radians(3 * hue + 6)) - 0.20 * math.cos(math.radians(4 * hue - 63)))
    turn = -math.sin(math.radians(60 * math.exp(-((hue - 275) / 25) ** 2))) * 2 * math.sqrt(chroma ** 7 / (chroma ** 7 + 25 ** 7))
    dl = (l2 - l1) / (1 + 0.015 * (light - 50) ** 2 / math.sqrt(20 + (light - 50) ** 2))
    dc = (c2 - c1) / (1 + 0.045 * chroma)
    dh = 2 * math.sqrt(c1 * c2) * math.sin(math.radians(step / 2)) / (1 + 0.015 * chroma * t)
    return math.sqrt(max(dl * dl + dc * dc + dh * dh + turn * dc * dh, 0))


def read_ppm(path):
    data = path.read_bytes()
    head = re.match(rb"P6\s+(\d+)\s+(\d+)\s+255\s", data)
    return int(head[1]), int(head[2]), data[head.end():]


def compare(first, second):
    """The mean over the pixels of the ball, which fills the middle of the picture."""
    width, height, a = read_ppm(first)
    b = read_ppm(second)[2]
    total = count = 0
    for y in range(height):
        for x in range(width):
            if math.hypot(x + 0.5 - width / 2, y + 0.5 - height / 2) < BALL * height:
                at = 3 * (y * width + x)
                p, q = a[at:at + 3], b[at:at + 3]
                total += difference(lab(p), lab(q)) if p != q else 0
                count += 1
    return total / count
