# SPDX-License-Identifier: Apache-2.0
"""Runs the main function of simple shaders as Python: assignments, `if`, and functions that the caller gives."""
import math
import re


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return [x / length for x in v]


UP = [0.0, 0.0, 1.0]  # the normal of the geometry


class Vec(tuple):
    """A vector of the shading language."""

    def _with(self, other, op):
        other = other if isinstance(other, Vec) else (other,) * len(self)
        return Vec(op(a, b) for a, b in zip(self, other))

    def __add__(self, other): return self._with(other, lambda a, b: a + b)
    def __sub__(self, other): return self._with(other, lambda a, b: a - b)
    def __mul__(self, other): return self._with(other, lambda a, b: a * b)
    def __truediv__(self, other): return self._with(other, lambda a, b: a / b)
    def __rsub__(self, other): return Vec((other,) * len(self)) - self
    def __neg__(self): return self * -1.0
    __radd__, __rmul__ = __add__, __mul__
    xyz = property(lambda self: Vec(self[:3]))
    x, y, z = (property(lambda self, i=i: self[i]) for i in range(3))


class Identity:
    """A matrix of the host."""

    def __mul__(self, vector): return vector


class Streams:
    """From the vertex stage to the pixel stage."""

    positionWorld = positionObject = Vec((0.0, 0.0, 0.0))
    normalWorld = Vec(UP)


def vec(size):
    def make(*parts):
        flat = [x for part in parts for x in (part if isinstance(part, Vec) else (part,))]
        return Vec(flat * size if len(flat) == 1 else flat)
    return make


def mix(a, b, t):
    return Vec(a) * (1 - t) + Vec(b) * t if isinstance(a, Vec) else a * (1 - t) + b * t


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


WORDS = {"vec3": vec(3), "vec4": vec(4), "mix": mix, "dot": dot, "normalize": lambda v: Vec(unit(v)), "clamp": lambda x, low, high: min(max(x, low), high), "max": max, "min": min}


def close_of(text, at):
    """The place behind the bracket that closes the one at a place."""
    depth = 0
    for i in range(at, len(text)):
        depth += (text[i] == "(") - (text[i] == ")")
        if depth == 0:
            return i + 1
    raise ValueError(text)


def assignment(text):
    if text == "discard;":
        return "discarded = True"
    parts = re.match(r"([\w.]+) (\+?)= (.*);", text)
    assert parts, text
    name, sign, value = parts.groups()
    value = re.sub(r"^(.+?) \? (.+?) : (.+)$", r"(\2) if (\1) else (\3)", value)
    return f"{name} = {name + ' + ' if sign else ''}{value}"


def mattes_of(source):
    """The AOVs of --mattes, in the order of their locations."""
    return re.findall(r"out vec4 (aov_matte_\w+);", source)


def as_python(source):
    """The main function, for the statements that these shaders have."""
    body = re.sub(r"//.*", "", source[source.index("void main()"):]).split("{", 1)[1]
    out, depth = ["def main(u_layerSample):", "    discarded = False"], 1
    for statement in re.split(r"(?<=[;{}])", body):
        text = " ".join(statement.split())
        if text in ("", "}"):
            depth -= text == "}"
            continue
        text = re.sub(r"u_layerSample < 0\.0 \? [^:]* : u_layerSample", "u_layerSample", text)
        if text.startswith("uint ") or ">>" in text:
            continue  # the hash, which the host's number replaces
        text = re.sub(r"^(?:const )?(?:u?int|float|bool|vec\d) (?=\w+ =)", "", text)
        text = text.replace("&&", " and ").replace("||", " or ")
        if text.startswith("if"):
            end = close_of(text, text.index("("))
            out.append("    " * depth + f"if {text[2:end]}:")
            depth += 1
            if text.endswith("{"):
                continue
            out.append("    " * depth + assignment(text[end:].strip()))
            depth -= 1
            continue
        out.append("    " * depth + assignment(text))
    mattes = mattes_of(source)
    values = " + ".join(["tuple(out1)"] + [f"({matte}[0],)" for matte in mattes])
    out.append("    return gl_Position" if "gl_Position" in body else f"    return Vec((0.0,) * {4 + len(mattes)}) if discarded else Vec({values})")
    return "\n".join(out)


def run(source, values, number, **functions):
    """The output for a number that picks a layer, or the outputs for a list of numbers."""
    matrices = dict.fromkeys(re.findall(r"u_\w+Matrix", source), Identity())
    scope = dict(WORDS, Vec=Vec, u_alphaThreshold=0.0, vd=Streams(), i_position=Vec((0.0,) * 3), i_normal=Vec(UP), **values, **matrices, **functions)
    exec(as_python(source), scope)
    return [scope["main"](n) for n in number] if isinstance(number, list) else scope["main"](number)
