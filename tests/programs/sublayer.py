# SPDX-License-Identifier: Apache-2.0
"""Composes a USD text layer over another one, as `subLayers` would: sublayer.py STRONG WEAK prints the stage.

It knows prims and their properties, whose stronger value and metadata win. What a prim's metadata lists
(apiSchemas) is that of the stronger layer.
"""
import re
import sys

TOKEN = re.compile(r'\s+|#[^\n]*|"""(?:\\.|[^\\])*?"""|"(?:\\.|[^"\\\n])*"|@[^@\n]*@|<[^>\n]*>|[^\s()\[\]{}"@<>=,;#]+|.', re.S)
CLOSE = {"(": ")", "[": "]", "{": "}"}
SPECIFIERS = ("def", "over", "class")


class Layer:
    """The tokens of a layer, read from the front; a newline is a token, other blanks are none."""

    def __init__(self, text):
        words = (m.group() for m in TOKEN.finditer(text))
        self.words = ["\n" if w.isspace() else w for w in words if not w.startswith("#") and (not w.isspace() or "\n" in w)]
        self.at = 0
        self.skip_lines()
        self.head = self.group() if self.peek() == "(" else "()"
        self.prims = self.body(None)

    def peek(self):
        return self.words[self.at] if self.at < len(self.words) else None

    def take(self):
        self.at += 1
        return self.words[self.at - 1]

    def skip_lines(self):
        while self.peek() in ("\n", ";"):
            self.take()

    def group(self):
        """A text in brackets, with the brackets."""
        out = [self.take()]
        while self.peek() != CLOSE[out[0]]:
            out.append(self.group() if self.peek() in CLOSE else self.take())
        return " ".join(out + [self.take()]).replace("\n ", "\n")

    def metadata(self):
        """{name: line} of a text in round brackets, which may be missing."""
        self.skip_lines()
        if self.peek() != "(":
            return {}
        lines = re.split(r"[\n;]", self.group()[1:-1])
        return {re.split(r"\s*=", line)[0].split()[-1]: line.strip() for line in lines if "=" in line}

    def statement(self):
        """A property: the text up to its metadata, and that."""
        out = []
        while self.peek() not in ("\n", ";", "}", "(") or (self.peek() == "(" and out[-1] == "="):
            out.append(self.group() if self.peek() in CLOSE else self.take())
        meta = self.metadata() if self.peek() == "(" else {}
        name = out[out.index("=") - 1] if "=" in out else out[-1]
        return name, (" ".join(out), meta)

    def body(self, end):
        """{name: prim} and under None {name: property}, up to a bracket."""
        prims, properties = {}, {}
        self.skip_lines()
        while self.peek() not in (end, None):
            if self.peek() in SPECIFIERS:
                words = [self.take()]
                while not words[-1].startswith('"'):
                    words.append(self.take())
                meta = self.metadata()
                self.skip_lines()
                self.take()
                assert words[-1] not in prims, words
                prims[words[-1]] = (words, meta, self.body("}"))
                self.take()
            else:
                name, said = self.statement()
                properties[name] = said
            self.skip_lines()
        return {**prims, None: properties}


def compose(strong, weak):
    out = {name: weak.get(name) for name in weak if name is not None}
    for name, prim in strong.items():
        if name is not None and name in weak:
            below = weak[name]
            out[name] = (below[0] if prim[0][0] == "over" else prim[0], {**below[1], **prim[1]}, compose(prim[2], below[2]))
        elif name is not None:
            out[name] = prim
    properties = dict(weak[None])
    for name, (text, meta) in strong[None].items():
        properties[name] = (text, {**properties.get(name, ("", {}))[1], **meta})
    return {**out, None: properties}


def write(prims, indent=""):
    for text, meta in prims[None].values():
        print(indent + text, "(" + "\n".join(meta.values()) + ")" if meta else "")
    for name in prims:
        if name is not None:
            words, meta, below = prims[name]
            print(indent + " ".join(words), "(" + "\n".join(meta.values()) + ")" if meta else "")
            print(indent + "{")
            write(below, indent + "    ")
            print(indent + "}")


strong, weak = (Layer(open(path, encoding="utf-8").read()) for path in sys.argv[1:3])
print("#usda 1.0\n" + strong.head)
write(compose(strong.prims, weak.prims))
