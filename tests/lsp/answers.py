#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the language server answers, for each kind of request on small documents. Arguments: mxgen, the root of the project."""
import pathlib
import re
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish
from client import Client, Failure, offset, uri_of

MXGEN, ROOT = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
FOLDER = tempfile.TemporaryDirectory()
WORK = pathlib.Path(FOLDER.name).resolve()
URI = uri_of(WORK / "main.mtlx")

GRAPH = '''<?xml version="1.0"?>
<materialx version="1.39">
  <nodegraph name="NG">
    <input name="tint" type="color3" value="0.8, 0.2, 0.1"/>
    <input name="amount" type="float" value="0.5"/>
    <image name="picture" type="color3">
      <input name="file" type="filename" value="maps/brick.png" colorspace="srgb_texture"/>
    </image>
    <constant name="grey" type="float"/>
    <multiply name="product" type="color3">
      <input name="in1" type="color3" nodename="picture"/>
      <input name="in2" type="color3" interfacename="tint"/>
    </multiply>
    <output name="out" type="color3" nodename="product"/>
  </nodegraph>
  <standard_surface name="SR" type="surfaceshader">
    <input name="base_color" type="color3" nodegraph="NG" output="out"/>
  </standard_surface>
  <surfacematerial name="Paint" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="SR"/>
  </surfacematerial>
</materialx>
'''


def same(found, expected, what):
    check(found == expected, f"{what}: {found!r} in place of {expected!r}")


def open_text(client, text, uri=URI):
    """Opens a text with a cursor, '¦', or without; gives its offset."""
    at = text.find("¦")
    client.open(uri, text.replace("¦", ""))
    return at


def labels(client, text):
    at = open_text(client, text)
    return [item["label"] for item in client.at("textDocument/completion", URI, at)["items"]]


def within(document, old, new):
    """A document with a part replaced, by the first place of it."""
    assert old in document, old
    return document.replace(old, new, 1)


def check_life():
    client = Client(MXGEN, WORK, general={"positionEncodings": ["utf-8", "utf-16"]})
    same(client.capabilities["positionEncoding"], "utf-8", "the encoding that the client prefers")
    client.open(URI, "<materialx version=\"1.39\">é😀 <image/></materialx>")
    found = client.request("textDocument/hover", {"textDocument": {"uri": URI}, "position": {"line": 0, "character": 35}})
    same(found and found["range"]["start"]["character"], 34, "columns in bytes")
    for method, params, code in (("nothing/here", {}, -32601), ("initialize", {}, -32600), ("textDocument/hover", {}, -32602)):
        try:
            client.request(method, params)
            check(False, f"{method} has an answer")
        except Failure as failure:
            same(failure.args[0]["code"], code, method)
    client.process.stdin.write(b"Content-Length: 3\r\n\r\n{]}")
    client.process.stdin.flush()
    while "error" not in (message := client.receive()):
        pass
    same(message["error"]["code"], -32700, "a message that is no JSON")
    client.notify("$/anything", {})
    same(client.end(), 0, "exit after shutdown")
    client = Client(MXGEN, WORK)
    client.notify("exit", None)
    same(client.process.wait(10), 1, "exit without shutdown")


def check_messages(client):
    (WORK / "part.mtlx").write_text('<materialx version="1.39">\n  <constant name="c" type="flot"/>\n</materialx>\n')
    open_text(client, '<materialx version="1.39">\n  <xi:include href="part.mtlx"/>\n  <nothing name="n" type="float"/>\n</materialx>\n')
    found = client.diagnostics(URI)
    same([(item["code"], item["severity"], item["range"]["start"]["line"]) for item in found],
         [("xml-undeclared-prefix", 2, 1), ("unknown-node", 1, 2)], "messages of the document")
    same(found[1]["data"]["arguments"][0], "nothing", "arguments")
    check(found[1]["codeDescription"]["href"].endswith("/messages.md#unknown-node"), "the link to the explanation")
    part = client.published[uri_of(WORK / "part.mtlx")]["diagnostics"]
    check("unknown-type" in [item["code"] for item in part], f"messages of the included file: {part}")
    client.close(URI)
    while client.published[uri_of(WORK / "part.mtlx")]["diagnostics"]:
        client.receive()
    check(True, "closing takes the messages away")
    open_text(client, within(GRAPH, 'nodename="product"', 'nodename="product" value="1, 1, 1"'))
    found = client.diagnostics(URI)
    same([(item["code"], item.get("tags")) for item in found][:1], [("value-and-connection", [1])], "a tag")


def check_completion(client):
    same(labels(client, within(GRAPH, 'nodename="picture"', 'nodename="¦"')), ["picture"], "nodes of the type")
    same(labels(client, within(GRAPH, 'nodename="picture"/>', 'nodename="p¦')), ["picture"], "nodes where the tag has no end")
    same(labels(client, within(GRAPH, 'interfacename="tint"', 'interfacename="¦"')), ["tint"], "inputs of the graph of the type")
    same(labels(client, within(GRAPH, 'nodegraph="NG"', 'nodegraph="¦"')), ["NG"], "graphs")
    same(labels(client, within(GRAPH, 'output="out"', 'output="¦"')), ["out"], "outputs")
    same(labels(client, within(GRAPH, 'name="base_color" type="color3"', 'name="specular_roughness" type="¦"')), ["float"], "the type of an input")
    found = labels(client, within(GRAPH, 'colorspace="srgb_texture"', 'colorspace="r¦"'))
    check({"srgb_texture", "lin_rec709", "g22_rec709"} <= set(found), f"colour spaces: {found}")
    same(labels(client, within(GRAPH, 'maps/brick.png', 'maps/¦')), ["brick.png", "deep/"], "files of a folder")
    same(labels(client, within(GRAPH, '<input name="in1" type="color3" nodename="picture"/>', '<input name="¦"/>')), ["in1", "in2"], "names of inputs")
    same(labels(client, within(GRAPH, '<input name="in1" type="color3" nodename="picture"/>', "<¦")),
         ["input in1", "input", "output", "token"], "elements in a node")
    same(labels(client, within(GRAPH, "</nodegraph>", "</¦")), ["nodegraph"], "an end tag")
    same(labels(client, within(GRAPH, 'version="1.39"', 'version="¦"')), ["1.39"], "versions")
    many = within(GRAPH, "</materialx>", "".join(f'<noise2d name="n{n}" type="float"/>' for n in range(500)) + '<add name="a" type="float"><input name="in1" type="float" nodename="¦"/></add></materialx>')
    at = open_text(client, many)
    found = client.at("textDocument/completion", URI, at)
    same((len(found["items"]), found["isIncomplete"]), (400, True), "a long list is cut")
    same(len(labels(client, many.replace('nodename="¦', 'nodename="49¦'))), 23, "what is typed chooses")
    unit = '<materialx version="1.39"><position name="p" type="vector3"/><heighttonormal name="h" type="vector3"/><UVTILE/>' \
           '<geompropvalue name="g" type="float"><input name="geomprop" type="string" value="a"/><input name="default" type="float" unittype="angle" unit="¦"/>'
    same(labels(client, unit), ["degree", "radian"], "units of the kind")
    found = labels(client, within(GRAPH, '<constant name="grey"', "<¦\n    <constant name=\"grey\""))
    check({"noise2d", "standard_surface", "input", "output"} <= set(found) and "look" not in found, "categories in a graph")
    enum = within(GRAPH, '<input name="file"', '<input name="uaddressmode" type="string" value="¦"/><input name="file"')
    same(labels(client, enum)[:4], ["constant", "clamp", "periodic", "mirror"], "values of an enumeration")
    found = labels(client, within(GRAPH, 'type="float"/>', 'type="float" ¦/>'))
    check("doc" in found and "uniform" not in found and "type" not in found, "attributes of a node")
    at = open_text(client, within(GRAPH, '<constant name="grey"', "<nois¦\n    <constant name=\"grey\""))
    item = next(item for item in client.at("textDocument/completion", URI, at)["items"] if item["label"] == "noise2d")
    same(item["textEdit"]["newText"], 'noise2d name="${1:noise2d1}" type="${2:float}">\n  $0\n</noise2d>', "a node as a snippet")
    start = offset(client.texts[URI], item["textEdit"]["range"]["start"])
    same(client.texts[URI][start:at], "nois", "what the snippet replaces")


def hover(client, text):
    found = client.at("textDocument/hover", URI, open_text(client, text))
    return found and found["contents"]["value"]


def check_hover(client):
    same(hover(client, within(GRAPH, "<multiply name", "<mult¦iply name")),
         "**multiply** (math)\n\nin1 * in2, for each component.\n\nDefinition `ND_multiply_color3`\n\nGives `out`: color3\n\n"
         "* `in1`: color3 = `0.0, 0.0, 0.0`\n* `in2`: color3 = `1.0, 1.0, 1.0`", "a node")
    found = hover(client, within(GRAPH, "base_color", "base_¦color"))
    check(found.startswith("`base_color`: color3 = `0.8, 0.8, 0.8`"), f"an input: {found}")
    found = hover(client, within(GRAPH, "maps/brick.png", "maps/br¦ick.png"))
    same(found, "`maps/brick.png`\n\nPNG, 3 × 2\n\nColour space: srgb_texture", "a texture")
    found = hover(client, within(GRAPH, 'nodename="picture"', 'nodename="pict¦ure"'))
    check(found.startswith('`<image name="picture" type="color3">`'), f"a connection: {found}")
    same(hover(client, within(GRAPH, 'interfacename="tint"', 'interface¦name="tint"')),
         "`interfacename`: The input of the nodegraph whose value this has.", "an attribute")
    same(hover(client, within(GRAPH, "<materialx ", "¦<materialx ")), None, "nothing")


def check_table():
    """The attributes of the server are those that the library checks."""
    names = lambda path: set(re.findall(r'^ATTRIBUTE\("?(\w+)"?,', (ROOT / path).read_text(encoding="utf-8"), re.MULTILINE))
    mine, theirs = names("lsp/attributes.def"), names("src/document/attributes.def")
    outdated = {"cms", "cmsconfig", "require", "channels", "member", "graphname"}
    same(theirs - outdated - mine, set(), "attributes that the server lacks")
    same(mine - theirs - {"name", "href"}, set(), "attributes that the library does not know")
    kinds = set(re.findall(r"^KIND\(\w+, (\w+)\)", (ROOT / "src/document/kinds.def").read_text(encoding="utf-8"), re.MULTILINE))
    elements = set(re.findall(r'^ELEMENT\("([\w:]+)"', (ROOT / "lsp/elements.def").read_text(encoding="utf-8"), re.MULTILINE))
    same(elements ^ kinds, {"xi:include"}, "elements that only one side knows")


(WORK / "maps/deep").mkdir(parents=True)
(WORK / "maps/brick.png").write_bytes(b"\x89PNG\r\n\x1a\n" + b"\0\0\0\rIHDR" + (3).to_bytes(4, "big") + (2).to_bytes(4, "big") + b"\x08\2\0\0\0")
check_life()
check_table()
session = Client(MXGEN, WORK, textDocument={"completion": {"completionItem": {"snippetSupport": True}}})
check_messages(session)
check_completion(session)
check_hover(session)
same(session.end(), 0, "the end")
finish("lsp-answers")
