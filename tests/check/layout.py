#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How the page of mxgen check looks in a browser, 1,400 pixels wide. `instrument PAGE OUT` adds a script that measures the page, and
`verify DOM SCREENSHOT` judges the measures and the colours of the screenshot."""
import json
import pathlib
import re
import struct
import sys
import zlib

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish

WIDTH = 1400
# Boxes whose content is wider than they are, boxes outside of the page, carets with the characters above them, and places of cards.
SCRIPT = """
{
const wide = [], outside = [], carets = [];
for (const box of document.querySelectorAll("body, main, article, article *, section, section *, header, header *")) {
  const place = box.getBoundingClientRect();
  if (box.scrollWidth > box.clientWidth + 1 && box.clientWidth) wide.push(box.tagName + " " + box.textContent.slice(0, 40));
  if (place.right > innerWidth + 1 || place.left < 0) outside.push(box.tagName + " " + box.textContent.slice(0, 40));
}
for (const box of document.querySelectorAll("pre")) {
  const text = box.firstChild, lines = text.data.split("\\n");
  const left = at => { const range = document.createRange(); range.setStart(text, at); range.setEnd(text, at + 1); return range.getBoundingClientRect().left; };
  for (let i = 1, at = lines[0].length + 1; i < lines.length; at += lines[i++].length + 1) {
    const caret = lines[i].indexOf("^"), before = at - lines[i - 1].length - 1;
    if (caret < 0 || lines[i].trim()[0] != "^") continue;
    carets.push({caret: left(at + caret), target: left(before + caret), character: lines[i - 1][caret]});
  }
}
const cards = Array.from(document.querySelectorAll("article"), card => ({name: card.className, top: card.getBoundingClientRect().top}));
const result = document.createElement("script");
result.id = "measures";
result.type = "application/json";
result.textContent = JSON.stringify({wide, outside, carets, cards, width: innerWidth});
document.body.append(result);
}
"""


def instrument(page, out):
    text = pathlib.Path(page).read_text(encoding="utf-8")
    pathlib.Path(out).write_text(text.replace("</body>", f"<script>\n//<![CDATA[\n{SCRIPT}//]]>\n</script></body>"), encoding="utf-8")


def read_png(path):
    """Width, height, and rows of pixels (r, g, b, ...): PNG 1.2, sections 3, 6 and 9, for 8 bits without interlace."""
    data, at, packed = pathlib.Path(path).read_bytes(), 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, colour, _, _, interlace = struct.unpack(">IIBBBBB", body)
        packed += body if kind == b"IDAT" else b""
        at += size + 12
    assert depth == 8 and colour in (2, 6) and not interlace
    step = 3 if colour == 2 else 4
    raw, rows, above = zlib.decompress(packed), [], bytearray(width * step)
    for y in range(height):
        kind, row = raw[y * (width * step + 1)], bytearray(raw[y * (width * step + 1) + 1:(y + 1) * (width * step + 1)])
        for x in range(len(row)) if kind else ():
            left, up, corner = row[x - step] if x >= step else 0, above[x], above[x - step] if x >= step else 0
            nearest = min((left, up, corner), key=lambda value: abs(left + up - corner - value)) # the first one of equals
            row[x] = row[x] + (0, left, up, (left + up) // 2, nearest)[kind] & 255
        rows.append([tuple(row[x:x + 3]) for x in range(0, len(row), step)])
        above = row
    return width, height, rows


def verify(dom, screenshot):
    found = re.search(r'<script id="measures" type="application/json">(.*?)</script>', pathlib.Path(dom).read_text(encoding="utf-8"), re.S)
    check(found, "the page was measured")
    if not found:
        return
    measures = json.loads(found[1])
    check(measures["width"] == WIDTH, f"the page is {measures['width']} pixels wide")
    check(not measures["wide"], f"cut off: {measures['wide']}")
    check(not measures["outside"], f"outside of the page: {measures['outside']}")
    check(len(measures["carets"]) >= 3, "there are carets")
    for caret in measures["carets"]:
        check(abs(caret["caret"] - caret["target"]) < 1, f"a caret at {caret['caret']} points at {caret['target']}")
        check(caret["character"].strip(), "a caret points at something")
    names = [card["name"].split() for card in sorted(measures["cards"], key=lambda card: card["top"])]
    failing = ["fails" in name for name in names]
    check(any(failing) and failing == sorted(failing, reverse=True), f"failures are on top: {names}")
    check(any("gone" in name for name in names), "there is a card for what is gone")
    width, height, rows = read_png(screenshot)
    check((width, height) == (WIDTH, 1600), f"the screenshot has {width} x {height} pixels")
    paper = rows[0][0]
    check(all(row[x] == paper for row in rows[80:] for x in (width - 2, width - 1)), "the right edge is free")
    red = [y for y, row in enumerate(rows) if sum(pixel[0] > 170 and pixel[1] < 90 and pixel[2] < 90 for pixel in row[:40]) >= 4]
    green = [y for y, row in enumerate(rows) if sum(pixel[1] > pixel[0] + 40 and pixel[1] > pixel[2] + 30 for pixel in row[:40]) >= 3]
    check(len(red) > 80 and red[0] < 400, "the first card is red at its left edge")
    check(not green or green[0] > red[-1], "green cards follow")
    check(sum(pixel != paper for row in rows[60:140] for pixel in row) > 1000, "the totals are above the cards")


{"instrument": instrument, "verify": verify}[sys.argv[1]](*sys.argv[2:])
if sys.argv[1] == "verify":
    finish("layout")
