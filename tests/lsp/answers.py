#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the language server answers, for each kind of request on small documents. Arguments: mxgen, the root of the project."""
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish
from client import Client, Failure, edited, offset, uri_of

MXGEN, ROOT = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
IS_PROGRAM = MXGEN.suffix != ".mjs" # WebAssembly has neither links nor a command line
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
    for header in () if not IS_PROGRAM else (b"Length: 2\r\n\r\n{}", b"Content-Length: -1\r\n\r\n", b"Content-Length: 99999999999999999999\r\n\r\n", b"x" * 100000):
        ended = subprocess.run([MXGEN, "lsp"], input=header, capture_output=True, check=False)
        same((ended.returncode, b"Content-Length" in ended.stderr), (1, True), f"a wrong header: {header[:40]}")


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


def check_walls():
    """Nothing outside of the workspace and of the folder of a document is read, also through a link."""
    inner, outside = WORK / "inner", WORK / "outside"
    inner.mkdir()
    outside.mkdir()
    (outside / "secret.mtlx").write_text('<materialx version="1.39"><constant name="secret" type="color3"/></materialx>')
    (outside / "secret.png").write_bytes((WORK / "maps/brick.png").read_bytes())
    (inner / "door").symlink_to(outside)
    uri = uri_of(inner / "main.mtlx")
    text = '''<materialx version="1.39" xmlns:xi="http://www.w3.org/2001/XInclude">
  <xi:include href="FOLDER/secret.mtlx"/>
  <image name="i" type="color3"><input name="file" type="filename" value="FOLDER/secret.png"/></image>
  <output name="out" type="color3" nodename="secret"/>
</materialx>
'''
    for folder in ("../outside", str(outside), *(["door"] if IS_PROGRAM else [])):
        client = Client(MXGEN, inner)
        client.open(uri, text.replace("FOLDER", folder))
        found = {item["code"]: item["message"] for item in client.diagnostics(uri)}
        check("outside the folders" in found.get("include-missing", "") and "missing-texture" not in found, f"{folder}: {found}")
        at = client.texts[uri].index("secret.png")
        check("not there, or outside" in client.at("textDocument/hover", uri, at)["contents"]["value"], f"{folder}: the texture has a size")
        same(client.at("textDocument/completion", uri, at)["items"], [], f"{folder}: files are listed")
        same(client.at("textDocument/definition", uri, client.texts[uri].index('"secret"') + 1), None, f"{folder}: a definition is found")
        same(client.end(), 0, "the end")
    client = Client(MXGEN, inner, ["--include-root", str(outside)])
    client.open(uri, text.replace("FOLDER", "door"))
    same([item["code"] for item in client.diagnostics(uri) if item["severity"] == 1], [], "an include root is read")
    same(client.end(), 0, "the end")


def check_watching():
    client = Client(MXGEN, WORK, workspace={"didChangeWatchedFiles": {"dynamicRegistration": True}})
    message = client.receive()
    same((message["method"], message["params"]["registrations"][0]["method"]), ("client/registerCapability", "workspace/didChangeWatchedFiles"),
         "files that the client watches")
    client.send({"id": message["id"], "result": None})
    text = within(GRAPH, "maps/brick.png", "maps/late.png")
    client.open(URI, text)
    same([item["code"] for item in client.diagnostics(URI)], ["unused-node", "missing-texture"], "a texture that is missing")
    (WORK / "maps/late.png").write_bytes((WORK / "maps/brick.png").read_bytes())
    del client.published[URI]
    client.notify("workspace/didChangeWatchedFiles", {"changes": [{"uri": uri_of(WORK / "maps/late.png"), "type": 1}]})
    same([item["code"] for item in client.diagnostics(URI)], ["unused-node"], "a texture that came")
    (WORK / "maps/late.png").unlink()
    same(client.end(), 0, "the end")


def check_completion(client):
    same(labels(client, within(GRAPH, 'nodename="picture"', 'nodename="¦"')), ["picture"], "nodes of the type")
    same(labels(client, within(GRAPH, 'nodename="picture"/>', 'nodename="p¦')), ["picture"], "nodes where the tag has no end")
    at = open_text(client, within(GRAPH, 'nodename="picture"/>', 'nodename="¦/>'))
    item = client.at("textDocument/completion", URI, at)["items"][0]
    same((item["label"], text_at(client, item["textEdit"]["range"])), ("picture", ""), "a name before the end of a tag, without a quote")
    same(labels(client, within(GRAPH, '<input name="in1" type="color3" nodename="picture"/>', '<input name="¦')), ["in1", "in2"], "a name that has no end")
    same(labels(client, within(GRAPH, 'interfacename="tint"', 'interfacename="¦"')), ["tint"], "inputs of the graph of the type")
    same(labels(client, within(GRAPH, 'nodegraph="NG"', 'nodegraph="¦"')), ["NG"], "graphs")
    same(labels(client, within(GRAPH, 'output="out"', 'output="¦"')), ["out"], "outputs")
    same(labels(client, within(GRAPH, 'name="base_color" type="color3"', 'name="specular_roughness" type="¦"')), ["float"], "the type of an input")
    same(labels(client, within(GRAPH, '<multiply name="product" type="color3"', '<multiply name="product" type="col¦"')), ["color3", "color4"], "types of a node")
    found = labels(client, within(GRAPH, 'colorspace="srgb_texture"', 'colorspace="r¦"'))
    check({"srgb_texture", "lin_rec709", "g22_rec709"} <= set(found), f"colour spaces: {found}")
    same(labels(client, within(GRAPH, 'maps/brick.png', 'maps/¦')), ["brick.png", "deep/"], "files of a folder")
    same(labels(client, within(GRAPH, '<input name="in1" type="color3" nodename="picture"/>', '<input name="¦"/>')), ["in1", "in2"], "names of inputs")
    same(labels(client, within(GRAPH, '<input name="in1" type="color3" nodename="picture"/>', "<¦")),
         ["input in1", "input", "output", "token"], "elements in a node")
    same(labels(client, within(GRAPH, "</nodegraph>", "</¦")), ["nodegraph"], "an end tag")
    same(labels(client, GRAPH.split("</nodegraph>")[0] + "</¦"), ["nodegraph"], "an end tag at the end of what is written")
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
    numbers = '<materialx version="1.39"><unifiednoise2d name="u" type="float"><input name="type" type="integer" value="¦"/>'
    same(labels(client, numbers), ["0", "1", "2", "3"], "numbers of an enumeration, whose words are no values")
    lumas = '<materialx version="1.39"><luminance name="l" type="color3"><input name="lumacoeffs" type="color3" value="¦"/>'
    same(labels(client, lumas)[1], "0.2126,0.7152,0.0722", "colours of an enumeration")
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


def check_pictures():
    """Hovers show pictures of a reference."""
    folder = WORK / "a reference"
    (folder / "pictures").mkdir(parents=True)
    (folder / "pictures/multiply.png").write_bytes(b"")
    client = Client(MXGEN, WORK, ["--reference", str(folder)])
    found = hover(client, within(GRAPH, "<multiply name", "<mult¦iply name"))
    picture = f"**multiply** (math)\n\n![picture of multiply](<{uri_of((folder / 'pictures/multiply.png').resolve())}>)\n\nin1 * in2"
    check(found.startswith(picture), f"a picture: {found}")
    check("![" not in hover(client, within(GRAPH, "<image name", "<im¦age name")), "a node without a picture")
    same(client.end(), 0, "the end of that")
    done = subprocess.run([MXGEN, "lsp", "--reference", WORK / "none"], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    check(done.returncode == 1 and "none/pictures" in done.stderr and "[file-missing]" in done.stderr, f"no reference: {done.stderr}")


def text_at(client, place, uri=URI):
    """The text of a range."""
    return client.texts[uri][offset(client.texts[uri], place["start"]):offset(client.texts[uri], place["end"])]


def line_of(place):
    return place["start"]["line"]


def check_navigation(client):
    at = open_text(client, within(GRAPH, 'nodename="picture"', 'nodename="pict¦ure"'))
    found = client.at("textDocument/definition", URI, at)
    same((found["uri"], line_of(found["range"]), text_at(client, found["range"])), (URI, 5, "picture"), "a definition")
    same([line_of(item["range"]) for item in client.at("textDocument/references", URI, at, context={"includeDeclaration": True})], [5, 10], "references")
    same([line_of(item["range"]) for item in client.at("textDocument/references", URI, at, context={"includeDeclaration": False})], [10],
         "references without the declaration")
    same([line_of(item["range"]) for item in client.at("textDocument/documentHighlight", URI, at)], [5, 10], "highlights")
    found = client.at("textDocument/prepareRename", URI, at)
    same((found["placeholder"], line_of(found["range"])), ("picture", 10), "what a rename changes")
    edits = client.at("textDocument/rename", URI, at, newName="brick")["changes"][URI]
    same(edited(client.texts[URI], edits), GRAPH.replace('"picture"', '"brick"'), "a node renamed")
    for name in "product", "1st", "":
        try:
            client.at("textDocument/rename", URI, at, newName=name)
            check(False, f"a rename to {name!r} has an answer")
        except Failure as failure:
            same(failure.args[0]["code"], -32803, f"a rename to {name!r}")
    for old, new, expected in (("tint", "hue", GRAPH.replace('"tint"', '"hue"')), ("NG", "Wall", GRAPH.replace('"NG"', '"Wall"')),
                               ("out", "color", GRAPH.replace('"out"', '"color"'))):
        at = open_text(client, within(GRAPH, f'name="{old}"', f'name="{old}¦"'))
        edits = client.at("textDocument/rename", URI, at, newName=new)["changes"][URI]
        same(edited(client.texts[URI], edits), expected, f"{old} renamed")
    at = open_text(client, within(GRAPH, 'name="base_color"', 'name="base¦_color"'))
    same(client.at("textDocument/prepareRename", URI, at), None, "names of a definition of the library stay")
    definition = """<materialx version="1.39">
  <nodedef name="ND_twice" node="twice">
    <input name="in" type="float"/>
    <output name="out" type="float"/>
  </nodedef>
  <nodegraph name="NG_twice" nodedef="ND_twice">
    <add name="sum" type="float"><input name="in1" type="float" interfacename="in"/><input name="in2" type="float" interfacename="in"/></add>
    <output name="out" type="float" nodename="sum"/>
  </nodegraph>
  <twi¦ce name="t" type="float"><input name="in" type="float" value="1"/></twice>
</materialx>
"""
    at = open_text(client, definition)
    client.diagnostics(URI)
    same(line_of(client.at("textDocument/definition", URI, at)["range"]), 1, "the definition of a node of the document")
    at = client.texts[URI].index('"in"') + 1
    edits = client.at("textDocument/rename", URI, at, newName="value")["changes"][URI]
    same(edited(client.texts[URI], edits), definition.replace("¦", "").replace('"in"', '"value"'), "an input of an interface renamed")
    heir = """  <nodedef name="ND_heir" node="twice" version="2" inherit="ND_twice"/>
  <nodegraph name="NG_heir" nodedef="ND_heir">
    <dot name="same" type="float"><input name="in" type="float" interfacename="in"/></dot>
    <output name="out" type="float" nodename="same"/>
  </nodegraph>
</materialx>
"""
    at = open_text(client, definition.replace("twi¦ce", "twice").replace("</materialx>\n", heir).replace('name="in" type="float"/>', 'name="i¦n" type="float"/>', 1))
    client.diagnostics(URI)
    edits = client.at("textDocument/rename", URI, at, newName="value")["changes"][URI]
    changed = edited(client.texts[URI], edits)
    same((changed.count('interfacename="value"'), changed.count('interfacename="in"')), (3, 0), "an input in the graph of a definition that inherits it")
    check_inputs(client)
    open_text(client, definition)
    at = client.texts[URI].index('"out"') + 1
    same(client.at("textDocument/prepareRename", URI, at), None, "outputs of a definition have their names in two places")
    (WORK / "part.mtlx").write_text('<materialx version="1.39">\n  <constant name="é" type="float"/>\n  <constant name="far" type="float"/>\n</materialx>\n')
    at = open_text(client, '<materialx version="1.39" xmlns:xi="http://www.w3.org/2001/XInclude">\n  <xi:include href="part.mtlx"/>\n'
                   '  <add name="a" type="float"><input name="in1" type="float" nodename="far¦"/></add>\n</materialx>\n')
    client.diagnostics(URI)
    found = client.at("textDocument/definition", URI, at)
    same((found["uri"], line_of(found["range"])), (uri_of(WORK / "part.mtlx"), 2), "a definition in an included file")
    just_opened = uri_of(WORK / "just_opened.mtlx")
    client.open(just_opened, client.texts[URI])
    found = client.at("textDocument/definition", just_opened, at)
    same(found and found["uri"], uri_of(WORK / "part.mtlx"), "also before the first check of a document has ended")
    same([item["label"] for item in client.at("textDocument/completion", URI, at)["items"]], ["far"], "names of an included file")
    links = client.of("textDocument/documentLink", URI)
    same([(line_of(item["range"]), item["target"]) for item in links], [(1, uri_of(WORK / "part.mtlx"))], "a link to an include")


def check_inputs(client):
    """Whatever names an input of a definition, and a frame around nodes."""
    text = """<materialx version="1.39">
  <nodedef name="ND_p" node="p"><input name="rough" type="float" value="1"/><output name="res" type="float" defaultinput="rough"/></nodedef>
  <implementation name="IM_p" nodedef="ND_p" nodegraph="NG_p"/>
  <implementation name="IM_glsl" nodedef="ND_p" target="genglsl" sourcecode="{{rough}} * 2.0 + {{rough}}"><input name="rough" type="float" implname="r"/></implementation>
  <nodegraph name="NG_p"><dot name="d" type="float"><input name="in" type="float" interfacename="rough"/></dot><output name="res" type="float" nodename="d"/></nodegraph>
  <nodedef name="ND_heir" node="p" version="2" inherit="ND_p"><input name="rough" type="float" value="2"/></nodedef>
  <p name="P" type="float"><input name="rough" type="float" value="3"/></p>
  <backdrop name="frame" contains="Q, P"/>
  <variantset name="any"><variant name="x"><input name="rough" type="float" value="0.3"/></variant></variantset>
  <variantset name="of_node" node="p"><variant name="x"><input name="rough" type="float" value="0.3"/></variant></variantset>
  <variantset name="of_nodedef" nodedef="ND_p"><variant name="x"><input name="rough" type="float" value="0.3"/></variant></variantset>
  <variantset name="of_others" node="q"><variant name="x"><input name="rough" type="float" value="0.3"/></variant></variantset>
  <output name="o" type="float" nodename="P" output="res"/>
</materialx>
"""
    named = text.replace("rough", "grain").replace('node="q"><variant name="x"><input name="grain"', 'node="q"><variant name="x"><input name="rough"')
    for place in 'name="rough" type="float" value="1"', 'interfacename="rough"', '{{rough}} *', 'name="rough" type="float" implname', 'name="rough" type="float" value="2"', 'name="rough" type="float" value="0.3"':
        open_text(client, text)
        client.diagnostics(URI)
        at = text.index(place) + place.index("rough")
        same(edited(text, client.at("textDocument/rename", URI, at, newName="grain")["changes"][URI]), named, f"an input renamed at {place}")
    at = text.index('name="P"') + 6
    changed = edited(text, client.at("textDocument/rename", URI, at, newName="R")["changes"][URI])
    same((changed.count('"R"'), 'contains="Q, R"' in changed), (2, True), "a node in a frame")
    shared = text.replace("</materialx>", '  <nodedef name="ND_q" node="q"><input name="rough" type="float"/><output name="res" type="float"/></nodedef>\n'
                          '  <implementation name="IM_q" nodedef="ND_q" nodegraph="NG_p"/>\n</materialx>')
    open_text(client, shared)
    client.diagnostics(URI)
    for place in 'name="rough" type="float" value="1"', 'name="rough" type="float"/>':
        at = shared.index(place) + 6
        same(client.at("textDocument/prepareRename", URI, at), None, "an input that another definition of the nodegraph has")
        try:
            client.at("textDocument/rename", URI, at, newName="grain")
            check(False, "a rename would take an input from another definition")
        except Failure as failure:
            same(failure.args[0]["message"], "another definition has the same nodegraph, and would lose the input", "a rename that would take an input from another definition")


def check_families(client):
    """References and renames across files: an open one, one that only the disk has, and one that has the name itself."""
    include = '<materialx version="1.39" xmlns:xi="http://www.w3.org/2001/XInclude">\n  <xi:include href="{}"/>\n{}</materialx>\n'
    reader = '  <add name="{}" type="float"><input name="in1" type="float" nodename="tone"/></add>\n'
    part, user, far, other = (WORK / f"family_{name}.mtlx" for name in ("part", "user", "far", "other"))
    part.write_text('<materialx version="1.39">\n  <constant name="tone" type="float"/>\n  <nodegraph name="NG_far"><constant name="tone" type="float"/>'
                    '<output name="out" type="float" nodename="tone"/></nodegraph>\n</materialx>\n')
    user.write_text(include.format(part.name, reader.format("u")))
    far.write_text(include.format(user.name, reader.format("f")
                                  + '  <add name="g" type="float"><input name="in1" type="float" nodegraph="NG_far" output="out"/></add>\n'))
    other.write_text('<materialx version="1.39">\n  <constant name="tone" type="float"/>\n' + reader.format("o") + "</materialx>\n")
    at = open_text(client, include.format(user.name, reader.format("mine").replace('"tone"', '"to¦ne"')))
    client.diagnostics(URI)
    found = client.at("textDocument/references", URI, at, context={"includeDeclaration": True})
    same(sorted((item["uri"].rsplit("/", 1)[1], line_of(item["range"])) for item in found),
         sorted([("family_far.mtlx", 2), ("family_part.mtlx", 1), ("family_user.mtlx", 2), (URI.rsplit("/", 1)[1], 2)]), "references across files")
    same(client.at("textDocument/prepareRename", URI, at)["placeholder"], "tone", "a name of an included file can change")
    changes = client.at("textDocument/rename", URI, at, newName="shade")["changes"]
    same(edited(part.read_text(), changes[uri_of(part)]), part.read_text().replace('name="tone"', 'name="shade"', 1), "where the name stands")
    same(edited(far.read_text(), changes[uri_of(far)]), far.read_text().replace('"tone"', '"shade"'), "in a file that includes another one")
    same(sorted(uri.rsplit("/", 1)[1] for uri in changes), sorted(["family_far.mtlx", "family_part.mtlx", "family_user.mtlx", URI.rsplit("/", 1)[1]]),
         "no other file changes")
    for name in "f", "NG_far":
        try:
            client.at("textDocument/rename", URI, at, newName=name)
            check(False, f"{name} is taken in another file")
        except Failure as failure:
            same(failure.args[0]["message"], "another element has this name", f"{name} is taken in another file")
    client.open(uri_of(part), part.read_text())
    place = part.read_text().index('name="out"') + len('name="o')
    changes = client.at("textDocument/rename", uri_of(part), place, newName="value")["changes"]
    same(edited(far.read_text(), changes[uri_of(far)]), far.read_text().replace('output="out"', 'output="value"'), "an output of a graph")
    same(sorted(uri.rsplit("/", 1)[1] for uri in changes), ["family_far.mtlx", "family_part.mtlx"], "and its own file")
    named, main = WORK / "family_named.mtlx", WORK / "family_main.mtlx"
    named.write_text('<materialx version="1.39" namespace="studio">\n  <nodedef name="ND_two" node="two"><input name="in" type="float"/><output name="out" type="float"/></nodedef>\n'
                     '  <surfacematerial name="Paint" type="material"/>\n  <look name="base"><materialassign name="m" material="Paint" geom="/"/></look>\n</materialx>\n')
    main.write_text(include.format(named.name, '  <surfacematerial name="Paint" type="material"/>\n  <look name="own" inherit="studio:base"><materialassign name="a" material="studio:Paint" geom="/a"/>'
                                   '<materialassign name="b" material="Paint" geom="/b"/></look>\n  <studio:two name="t" type="float"/>\n'))
    client.open(uri_of(named), named.read_text())
    for old, new in (("Paint", "Lack"), ("base", "ground")):
        changes = client.at("textDocument/rename", uri_of(named), named.read_text().index(f'name="{old}"') + 7, newName=new)["changes"]
        same(edited(main.read_text(), changes[uri_of(main)]), main.read_text().replace(f'"studio:{old}"', f'"studio:{new}"'), f"{old} keeps its namespace in another file")
    client.open(uri_of(main), main.read_text())
    client.diagnostics(uri_of(main))
    place = main.read_text().index("studio:Paint") + 9
    same(client.at("textDocument/prepareRename", uri_of(main), place)["placeholder"], "Paint", "the name behind a namespace can change")
    changes = client.at("textDocument/rename", uri_of(main), place, newName="Lack")["changes"]
    same(edited(named.read_text(), changes[uri_of(named)]), named.read_text().replace('"Paint"', '"Lack"'), "in the file that has it")
    place = named.read_text().index('"in"') + 1
    same(client.at("textDocument/prepareRename", uri_of(named), place), None, "an input that nodes of another file have stays")
    try:
        client.at("textDocument/rename", uri_of(named), place, newName="value")
        check(False, "a rename would take an input from nodes of another file")
    except Failure as failure:
        same(failure.args[0]["message"], "other files use this input of the definition, and would lose it", "a rename that would take an input from another file")
    main.write_text(include.format(named.name, '  <variantset name="set"><variant name="x"><input name="in" type="float" value="1"/></variant></variantset>\n'))
    client.close(uri_of(main))
    client.open(uri_of(main), main.read_text())
    client.diagnostics(uri_of(main))
    same(client.at("textDocument/prepareRename", uri_of(named), place), None, "an input that a variant of another file changes stays")
    inside = part.read_text().index('"tone" type="float"/><output') + 2
    same(list(client.at("textDocument/rename", uri_of(part), inside, newName="deep")["changes"]), [uri_of(part)], "names inside of a graph are its own")


def readers_of_c(address):
    """The files with references, where another folder than the document's has one."""
    folder = WORK / "roots"
    client = Client(MXGEN, cwd=WORK, address=address)
    uri, text = uri_of(folder / "here/a.mtlx"), (folder / "here/a.mtlx").read_text(encoding="utf-8")
    client.open(uri, text)
    found = client.at("textDocument/references", uri, text.index('"c"') + 1, context={"includeDeclaration": True})
    same(client.end(), 0, f"{address}: the end")
    return {item["uri"].rsplit("/", 1)[1] for item in found}


def check_roots():
    """Odd roots of a workspace."""
    folder = WORK / "roots"
    for name, text in ("here/a.mtlx", '<materialx version="1.39"><constant name="c" type="float"/></materialx>'), (
            "there/b.mtlx", '<materialx version="1.39"><xi:include href="../here/a.mtlx"/><output name="o" type="float" nodename="c"/></materialx>'):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")
    for link in range(5): # they lead to 5 to the power of 16 folders, if one follows them
        (folder / f"there/link{link}").symlink_to(".")
    path = uri_of(folder).removeprefix("file://")
    for address in f"file://{path}", f"file://{path}/", f"file:{path}", f"FILE://LocalHost{path}", f"file://{path.replace('r', '%72')}", f"file://{path}/./here/..":
        same(readers_of_c(address), {"a.mtlx", "b.mtlx"}, address)
    for address in (f"file://server{path}", f"file://{path}%00x", f"file://{path}%2", f"file://{path}/here/a.mtlx", f"file://{path}/none", f"http://{path}",
                    "file:///c%3A/Users", "file:///C:/Users", "file:", "file://", path, "", "untitled:Untitled-1", 5, None):
        same(readers_of_c(address), {"a.mtlx"}, address)
    check("a.mtlx" in readers_of_c("file:///"), "a whole disk is a workspace")


def check_looks(client):
    """Names in lists, and of what looks have."""
    text = """<materialx version="1.39">
  <collection name="legs" includegeom="/a"/>
  <collection name="all" includecollection="legs, top ,legs2"/>
  <collection name="top" includegeom="/b"/>
  <input name="n" type="string" default="day"/>
  <look name="day"><materialassign name="legs" collection="legs"/><visibility name="v" viewercollection="legs"/></look>
  <look name="night" inherit="day"/>
  <lookgroup name="both" looks="night,day" default="day"/>
</materialx>
"""
    for old, count, new, at in (("legs", 4, "feet", text.index("legs, top") + 2), ("day", 4, "noon", text.index("night,day") + 7), ("top", 2, "lid", text.index('name="top"') + 7)):
        open_text(client, text)
        changed = edited(text, client.at("textDocument/rename", URI, at, newName=new)["changes"][URI])
        same((changed.count(new), changed.replace(new, old)), (count, text), f"{old} renamed")
    place = client.at("textDocument/definition", URI, text.index("top ,legs2") + 1)
    same(line_of(place["range"]), 3, "an item of a list")
    check_references(client)


def check_references(client):
    """Each attribute of the library's table of references leads to what it names, and follows a rename."""
    text = (ROOT / "tests/api/documents/names.mtlx").read_text(encoding="utf-8")
    open_text(client, text)
    for use in re.finditer(r'[ "](\w+)="(?:[^"]*, )?(old_\w+)[^"]*"', text):
        if use[1] == "name" or use[2] == "old_token":  # which files name, too
            continue
        place = client.at("textDocument/definition", URI, use.start(2) + 1)
        where = text.split("\n")[line_of(place["range"])] if place else None
        check(where and f'name="{use[2]}"' in where, f"{use[1]} of {use[2]} leads to {where}")
    # inputs of a definition and outputs have names in other places, which are tested above; files do not know units and variants of others
    for name in sorted(set(re.findall(r'name="(old_\w+)"', text)) - {"old_in", "old_token", "old_out", "old_unit", "old_variant", "old_prop"}):
        edits = client.at("textDocument/rename", URI, text.index(f'name="{name}"') + 7, newName="x_" + name)["changes"][URI]
        same(edited(text, edits), text.replace(f'"{name}', f'"x_{name}').replace(f", {name}", f", x_{name}"), f"{name} renamed")
    found = client.at("textDocument/completion", URI, text.index('old_collection" geom="/"/>'))
    labels = {item["label"] for item in (found["items"] if isinstance(found, dict) else found)}
    check("more" in labels and "old_look" not in labels, f"collections for viewercollection: {labels}")


def check_moves(client):
    """Names of files follow the files, and documents that move."""
    include = '<materialx version="1.39" xmlns:xi="http://www.w3.org/2001/XInclude">\n{}</materialx>\n'
    image = '  <image name="{}" type="color3"><input name="file" type="filename" value="{}"/></image>\n'
    (WORK / "moves/sub").mkdir(parents=True)
    library, reader = WORK / "moves/library.mtlx", WORK / "moves/sub/reader.mtlx"
    library.write_text(include.format(image.format("brick", "../maps/brick.png") + image.format("sky", "https://example.com/sky.png")))
    reader.write_text(include.format('  <xi:include href="../library.mtlx"/>\n  <nodegraph name="N" fileprefix="../../maps/">\n'
                                     + image.format("prefixed", "brick.png") + "  </nodegraph>\n"))
    client.notify("workspace/didChangeWatchedFiles", {"changes": [{"uri": uri_of(path), "type": 1} for path in (library, reader)]})

    def renamed(old, new):
        return client.request("workspace/willRenameFiles", {"files": [{"oldUri": uri_of(WORK / old), "newUri": uri_of(WORK / new)}]})["changes"]

    def after(path, changes):
        return edited(path.read_text(), changes.pop(uri_of(path), []))

    changes = renamed("moves/library.mtlx", "moves/sub/deep/parts.mtlx")
    same(after(reader, changes), reader.read_text().replace("../library.mtlx", "deep/parts.mtlx"), "an include follows")
    same(after(library, changes), library.read_text().replace("../maps", "../../../maps"), "what moves finds its files")
    same(changes, {}, "nothing else changes")
    changes = renamed("maps", "pictures")
    same(after(reader, changes), reader.read_text().replace('"brick.png"', '"../pictures/brick.png"'), "a folder, behind a prefix")
    same(after(library, changes), library.read_text().replace("../maps", "../pictures"), "a folder")
    client.open(uri_of(library), library.read_text().replace("../maps/brick.png", "local.png"))
    changes = renamed("moves/local.png", "moves/here.png")
    same([edit["newText"] for edit in changes[uri_of(library)]], ["here.png"], "the editor's text counts")
    client.close(uri_of(library))


def names_of(symbols):
    return [(item["name"], item["detail"], names_of(item.get("children", []))) for item in symbols]


def check_outline(client):
    open_text(client, GRAPH)
    found = names_of(client.of("textDocument/documentSymbol", URI))
    same([(name, detail, len(below)) for name, detail, below in found],
         [("NG", "nodegraph", 6), ("SR", "standard_surface surfaceshader", 0), ("Paint", "surfacematerial material", 0)], "symbols")
    same(found[0][2][2], ("picture", "image color3", []), "a symbol inside")
    same([(item["startLine"], item["endLine"]) for item in client.of("textDocument/foldingRange", URI)],
         [(1, 20), (2, 13), (5, 6), (9, 11), (15, 16), (18, 19)], "folds")
    same([item["target"] for item in client.of("textDocument/documentLink", URI)], [uri_of(WORK / "maps/brick.png")], "a link to a texture")
    data = client.of("textDocument/semanticTokens/full", URI)["data"]
    tokens, line, column = [], 0, 0
    for i in range(0, len(data), 5):
        line, column = line + data[i], data[i + 1] + (0 if data[i] else column)
        text = client.texts[URI].split("\n")[line][column:column + data[i + 2]]
        tokens.append((text, data[i + 3], data[i + 4]))
    same(tokens[:9], [("materialx", 5, 0), ("nodegraph", 5, 0), ("NG", 2, 1), ("input", 5, 0), ("tint", 3, 1), ("color3", 1, 0), ("0.8, 0.2, 0.1", 4, 0),
                      ("input", 5, 0), ("amount", 3, 1)], "tokens")
    check(("multiply", 0, 0) in tokens and ("picture", 2, 0) in tokens and ("tint", 3, 0) in tokens, "tokens of nodes and references")


def check_colours(client):
    open_text(client, within(GRAPH, '"0.8, 0.2, 0.1"', '"1, 0.2140411, 0"'))
    found = client.of("textDocument/documentColor", URI)
    same([(line_of(item["range"]), [round(value, 4) for value in item["color"].values()]) for item in found], [(3, [1, 0.5, 0, 1])], "a linear colour")
    half = {"red": 0.5, "green": 1, "blue": 0, "alpha": 1}
    same(client.of("textDocument/colorPresentation", URI, range=found[0]["range"], color=half)[0]["label"], "0.214, 1, 0", "a linear value")
    open_text(client, within(GRAPH, '"0.8, 0.2, 0.1"', '"1, 0.5, 0" colorspace="srgb_texture"'))
    found = client.of("textDocument/documentColor", URI)
    same([round(value, 4) for value in found[0]["color"].values()], [1, 0.5, 0, 1], "a colour in sRGB")
    edit = client.of("textDocument/colorPresentation", URI, range=found[0]["range"], color=half)[0]["textEdit"]
    same((edit["newText"], text_at(client, edit["range"])), ("0.5, 1, 0", "1, 0.5, 0"), "a value in sRGB")
    open_text(client, within(GRAPH, 'version="1.39"', 'version="1.39" colorspace="acescg"'))
    same(client.of("textDocument/documentColor", URI), [], "no box in a space that is not converted")


def check_hints(client):
    text = within(within(GRAPH, 'version="1.39"', 'version="1.39" colorspace="lin_rec709"'), '<constant name="grey"',
                  '<blackbody name="b" type="color3"/>\n<constant name="grey"')
    open_text(client, text)
    whole = {"start": {"line": 0, "character": 0}, "end": {"line": 99, "character": 0}}
    found = [(item["position"]["line"], item["label"]) for item in client.of("textDocument/inlayHint", URI, range=whole)]
    same(found, [(3, "lin_rec709"), (5, "ND_image_color3"), (9, "ND_constant_float"), (10, "ND_multiply_color3"), (16, "ND_standard_surface_surfaceshader")], "hints")
    part = {"start": {"line": 9, "character": 0}, "end": {"line": 10, "character": 0}}
    same(len(client.of("textDocument/inlayHint", URI, range=part)), 1, "hints of a range")


def check_lenses(client):
    open_text(client, GRAPH)
    client.diagnostics(URI)
    lens = client.of("textDocument/codeLens", URI)
    same([text_at(client, item["range"]) for item in lens], ["surfacematerial"], "lenses")
    same(client.request("codeLens/resolve", lens[0])["command"]["title"], "shader: 2 closures, 1 texture", "a lens")
    open_text(client, within(GRAPH, 'nodename="SR"', 'nodename="SS"'))
    client.diagnostics(URI)
    same(client.request("codeLens/resolve", lens[0])["command"]["title"], "shader: none, because of errors", "a lens without a shader")


def check_render():
    """The command of a client stands over materials."""
    client = Client(MXGEN, WORK, options={"renderCommand": "draw"})
    open_text(client, GRAPH)
    client.diagnostics(URI)
    found = [lens.get("command") for lens in client.of("textDocument/codeLens", URI)]
    same(found, [None, {"title": "render", "command": "draw", "arguments": [URI, "Paint"]}], "a lens that renders")
    same(client.end(), 0, "the end of that client")


def check_format(client):
    options = {"tabSize": 2, "insertSpaces": True}
    open_text(client, GRAPH)
    same(client.of("textDocument/formatting", URI, options=options), [], "a formatted text stays")
    open_text(client, within(GRAPH, '    <constant name="grey" type="float"/>', '  <constant   type="float"  name="grey"></constant>'))
    edits = client.of("textDocument/formatting", URI, options=options)
    same(edited(client.texts[URI], edits), GRAPH, "a text formatted")
    same(line_of(edits[0]["range"]), 8, "the edit has the lines that differ")
    windows = within(GRAPH, '    <constant name="grey" type="float"/>', '  <constant   type="float"  name="grey"></constant>').replace("\n", "\r\n")
    open_text(client, windows)
    edits = client.of("textDocument/formatting", URI, options=options)
    same(edited(client.texts[URI], edits), GRAPH.replace("\n", "\r\n"), "a text with the line ends of Windows keeps them")
    open_text(client, GRAPH.replace("\n", "\r\n"))
    same(client.of("textDocument/formatting", URI, options=options), [], "and stays once it is formatted")
    open_text(client, "<materialx")
    same(client.of("textDocument/formatting", URI, options=options), None, "a text that is not XML")


def check_actions(client):
    def actions(text, code, only=None):
        """The actions about the first message of a kind."""
        open_text(client, text)
        item = next((item for item in client.diagnostics(URI) if item["code"] == code), {"range": {"start": {"line": 0, "character": 0}}})
        place = {"start": item["range"]["start"], "end": item["range"]["start"]}
        context = {"diagnostics": [item], **({"only": only} if only else {})}
        return client.of("textDocument/codeAction", URI, range=place, context=context)

    def fixed(text, code):
        found = actions(text, code)[0]
        return edited(client.texts[URI], found["edit"]["changes"][URI])

    mixed = within(GRAPH, 'nodename="picture"', 'nodename="grey"')
    same(fixed(mixed, "type-mismatch"), within(within(mixed, '<multiply name="product"', """<convert name="in1_of_color3" type="color3">
      <input name="in" type="float" nodename="grey"/>
    </convert>
    <multiply name="product\""""), 'nodename="grey"/>\n      <input name="in2"', 'nodename="in1_of_color3"/>\n      <input name="in2"'), "a conversion")
    wrong = within(GRAPH, "<multiply", "<multply").replace("</multiply", "</multply")
    found = actions(wrong, "unknown-node")[0]
    same((found["title"], found["kind"], found["isPreferred"]), ("Change to 'multiply'", "quickfix", True), "an action")
    same(found["diagnostics"][0]["code"], "unknown-node", "the message of an action")
    same(fixed(wrong, "unknown-node"), GRAPH, "a suggestion for a node")
    same(fixed(within(GRAPH, 'name="base_color" type="color3"', 'name="base_color"'), "missing-attribute"),
         within(GRAPH, 'name="base_color" type="color3" nodegraph="NG" output="out"', 'name="base_color" nodegraph="NG" output="out" type="color3"'),
         "a missing type")
    same(fixed(GRAPH, "unused-node"), within(GRAPH, '    <constant name="grey" type="float"/>\n', ""), "an unused node removed")
    same(actions(wrong, "unknown-node", ["refactor"]), [], "kinds that the client wants")
    old = GRAPH.replace('version="1.39"', 'version="1.36"')
    found = actions(old, "none", ["source"])
    same([action["title"] for action in found], ["Upgrade the document to MaterialX 1.39"], "an upgrade")
    same(edited(client.texts[URI], found[0]["edit"]["changes"][URI]).split("\n")[1], '<materialx version="1.39">', "what an upgrade writes")


def check_calls(client):
    at = open_text(client, within(GRAPH, '<multiply name="product"', '<multiply name="prod¦uct"'))
    item = client.at("textDocument/prepareCallHierarchy", URI, at)[0]
    same((item["name"], item["detail"]), ("product", "multiply"), "a node")
    found = client.request("callHierarchy/outgoingCalls", {"item": item})
    same([(call["to"]["name"], [line_of(place) for place in call["fromRanges"]]) for call in found], [("picture", [10])], "upstream")
    found = client.request("callHierarchy/incomingCalls", {"item": item})
    same([(call["from"]["name"], [line_of(place) for place in call["fromRanges"]]) for call in found], [("NG", [13])], "downstream")
    found = client.request("callHierarchy/incomingCalls", {"item": found[0]["from"]})
    same([call["from"]["name"] for call in found], ["SR"], "downstream of a graph")


def check_junk(client):
    """Parameters that are none of the protocol's: each request has an answer or an error, and the server goes on."""
    open_text(client, GRAPH)
    methods = re.findall(r'^    \{"([\w/]+)",', (ROOT / "lsp/methods.c").read_text(encoding="utf-8"), re.MULTILINE)
    check(len(methods) > 25, f"{len(methods)} methods")
    place, document = {"line": 3, "character": 10}, {"uri": URI}
    for method in set(methods) - {"initialize", "shutdown", "exit", "textDocument/didClose"}:
        for params in (None, [], "text", {}, {"textDocument": 1}, {"textDocument": {"uri": 1}}, {"textDocument": document, "position": "here"},
                       {"textDocument": document, "position": {"line": -1, "character": 1 << 60}},
                       {"textDocument": document, "position": {"line": 1 << 31, "character": -5}, "newName": 7, "context": [], "options": None},
                       {"textDocument": document, "range": {"start": {"line": 9, "character": 0}, "end": place}, "color": 1, "position": place},
                       {"textDocument": document, "contentChanges": {"range": place}}, {"item": {"uri": URI}}, {"item": 3},
                       {"textDocument": document, "contentChanges": [1, {"text": 1}, {"range": {"start": place}, "text": ""}]}):
            try:
                client.request(method, params)
            except Failure as failure:
                check(failure.args[0]["code"] < 0, f"{method} {params}: {failure}")
    same(client.of("textDocument/foldingRange", URI)[0]["startLine"], 1, "the text after junk")


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
check_walls()
check_watching()
check_junk(session)
check_messages(session)
check_completion(session)
check_hover(session)
if IS_PROGRAM:
    check_pictures()
    check_roots()
check_navigation(session)
check_families(session)
check_looks(session)
check_moves(session)
check_outline(session)
check_colours(session)
check_hints(session)
check_lenses(session)
check_render()
check_format(session)
check_actions(session)
check_calls(session)
same(session.end(), 0, "the end")
finish("lsp-answers")
