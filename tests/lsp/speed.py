#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How long the language server takes for a keystroke in a large document: a change, then completion or hover, as editors ask. Arguments: mxgen,
the number of materials, the number of keystrokes, and the greatest 99th percentile in milliseconds."""
import pathlib
import random
import sys
import time

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish
from client import Client

MXGEN, MATERIALS, KEYS, BOUND = pathlib.Path(sys.argv[1]).resolve(), int(sys.argv[2]), int(sys.argv[3]), float(sys.argv[4])
URI = "file:///somewhere/large.mtlx"
chance = random.Random(1)

MATERIAL = '''  <nodegraph name="NG_{0}">
    <input name="tint" type="color3" value="0.8, 0.{0}, 0.1"/>
    <noise2d name="noise" type="float">
      <input name="amplitude" type="float" value="0.{0}"/>
    </noise2d>
    <multiply name="product" type="color3">
      <input name="in1" type="color3" interfacename="tint"/>
      <input name="in2" type="float" nodename="noise"/>
    </multiply>
    <output name="out" type="color3" nodename="product"/>
  </nodegraph>
  <standard_surface name="SR_{0}" type="surfaceshader">
    <input name="base" type="float" value="0.9"/>
    <input name="base_color" type="color3" nodegraph="NG_{0}" output="out"/>
    <input name="specular_roughness" type="float" value="0.3"/>
    <input name="metalness" type="float" value="0"/>
    <input name="coat" type="float" value="0.5"/>
    <input name="coat_color" type="color3" value="1, 0.9, 0.8"/>
    <input name="coat_roughness" type="float" value="0.1"/>
    <input name="sheen" type="float" value="0"/>
    <input name="emission" type="float" value="0"/>
    <input name="emission_color" type="color3" value="1, 1, 1"/>
  </standard_surface>
  <surfacematerial name="M_{0}" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="SR_{0}"/>
  </surfacematerial>
'''
# Keys that are typed, and their place: the text that stands in front of it.
TYPED = [('<input name="base_color" type="color3" nodegraph="', "textDocument/completion"), ('nodename="', "textDocument/completion"),
         ("<multiply ", "textDocument/completion"), ('value="', "textDocument/hover"), ("    <noise2d", "textDocument/hover")]


def percentile(times, part):
    return sorted(times)[min(len(times) - 1, int(len(times) * part))]


def spent(client):
    """Milliseconds that the thread of the answers has run: other programs of the machine do not count."""
    identifier = client.process.pid
    return int(pathlib.Path(f"/proc/{identifier}/task/{identifier}/schedstat").read_text(encoding="ascii").split()[0]) / 1e6


def type_letter(client, lines, letter, method, before):
    """Milliseconds from a change to the answer about the place of the change."""
    line = chance.choice(lines[before])
    text, column = line
    client.versions[URI] += 1
    place = {"line": text, "character": column}
    begin, begin_spent = time.perf_counter(), spent(client)
    client.notify("textDocument/didChange", {"textDocument": {"uri": URI, "version": client.versions[URI]},
                                             "contentChanges": [{"range": {"start": place, "end": place}, "text": letter}]})
    client.request(method, {"textDocument": {"uri": URI}, "position": place})
    end, end_spent = time.perf_counter(), spent(client)
    client.notify("textDocument/didChange", {"textDocument": {"uri": URI, "version": client.versions[URI] + 1}, "contentChanges": [
        {"range": {"start": place, "end": {"line": text, "character": column + len(letter)}}, "text": ""}]})
    client.versions[URI] += 1
    return (end - begin) * 1e3, end_spent - begin_spent


def tokens_of(client, name, text):
    """Milliseconds of the processor for the colours of a text."""
    uri = f"file:///somewhere/{name}.mtlx"
    client.open(uri, text)
    client.diagnostics(uri)
    begin = spent(client)
    client.of("textDocument/semanticTokens/full", uri)
    return spent(client) - begin


text = '<?xml version="1.0"?>\n<materialx version="1.39">\n' + "".join(MATERIAL.format(n) for n in range(MATERIALS)) + "</materialx>\n"
lines = {before: [(number, line.index(before) + len(before)) for number, line in enumerate(text.split("\n")) if before in line] for before, _ in TYPED}
client = Client(MXGEN, None, textDocument={"completion": {"completionItem": {"snippetSupport": True}}})
client.open(URI, text)
begin = time.perf_counter()
client.diagnostics(URI)
print(f"{MATERIALS} materials, {len(text) / 1e6:.1f} MB: opened and checked in {(time.perf_counter() - begin) * 1e3:.0f} ms")
times = []
for key in range(KEYS):
    before, method = TYPED[key % len(TYPED)]
    times.append(type_letter(client, lines, "x", method, before))
    if len(sys.argv) > 5: # somebody types: the pause between two letters, in which the server checks
        time.sleep(float(sys.argv[5]))
for side, name in enumerate(("by the clock", "of the processor")):
    for method in dict.fromkeys(method for _, method in TYPED):
        part = [taken[side] for key, taken in enumerate(times) if TYPED[key % len(TYPED)][1] == method]
        print(f"didChange and {method}, {name}: median {percentile(part, 0.5):.2f} ms, 90 % {percentile(part, 0.9):.2f}, "
              f"99 % {percentile(part, 0.99):.2f}, most {max(part):.2f}")
worst = percentile([taken[1] for taken in times], 0.99)
check(worst <= BOUND, f"99 % of keystrokes take {worst:.2f} ms of the processor; {BOUND} is the limit")
constants = [f'<constant name="c{n}" type="float"><input name="value" type="float" value="0.5"/></constant>' for n in range(1500)]
many, one = (tokens_of(client, name, f'<materialx version="1.39">{end.join(constants)}</materialx>') for name, end in (("many", "\n"), ("one", " ")))
print(f"the colours of 1,500 lines take {many:.1f} ms of the processor, those of the same in one line {one:.1f}")
check(one <= 3 * many + 10, "a long line takes as long as many short ones")
check(client.end() == 0, "the server ends well")
finish("lsp-speed")
