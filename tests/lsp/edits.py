#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Random edits, as of somebody who types, deletes and pastes: the server does not end, and its answers about the edited text are those
about a new document of the same text. Arguments: mxgen, the root of the project, the number of edits; then a seed, or nothing."""
import pathlib
import random
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish
from client import Client

MXGEN, ROOT, STEPS = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(), int(sys.argv[3])
chance = random.Random(int(sys.argv[4]) if len(sys.argv) > 4 else 1)
EDITED, FRESH = "file:///somewhere/edited.mtlx", "file:///somewhere/fresh.mtlx"
PIECES = ["<", ">", "/>", '"', "'", "=", " ", "\n", "\r\n", "\r", "<input ", '<input name="x" type="float" value="0.5"/>', "</nodegraph>", "<nodegraph>",
          "<!--", "-->", "<![CDATA[", "]]>", "<?", "é", "😀", 'nodename="', "</", '<xi:include href="a.mtlx"/>', "<materialx>", "</materialx>",
          "\t", "\0", "&", "&amp;", "<image", ' type="color3"', "<standard_surface name=\"S\" type=\"surfaceshader\">"]
SOURCES = [path.read_text(encoding="utf-8") for path in sorted((ROOT / "examples").glob("*.mtlx"))]
# Requests about the whole document, and about a place in it.
WHOLE = ["textDocument/documentSymbol", "textDocument/foldingRange", "textDocument/documentLink", "textDocument/semanticTokens/full",
         "textDocument/documentColor", "textDocument/inlayHint"]
PLACED = ["textDocument/completion", "textDocument/hover", "textDocument/definition", "textDocument/references", "textDocument/documentHighlight",
          "textDocument/prepareRename", "textDocument/prepareCallHierarchy", "textDocument/formatting"]


def change(text):
    """A part of the text and what takes its place."""
    start = chance.randrange(len(text) + 1)
    kind = chance.random()
    if kind < 0.35: # a letter
        return start, start, chance.choice("abcdefghinmort_0123456789.,")
    if kind < 0.6:
        return start, start, chance.choice(PIECES)
    if kind < 0.85:
        return start, min(len(text), start + chance.choice((1, 1, 1, 5, 40))), ""
    source = chance.choice(SOURCES)
    begin = chance.randrange(len(source))
    return start, min(len(text), start + chance.randrange(80)), source[begin:begin + chance.randrange(300)]


def is_between(text, at):
    """A client has no position between the two characters of a line end."""
    return 0 < at < len(text) and text[at - 1] == "\r" and text[at] == "\n"


def compare(client, step):
    client.open(FRESH, client.texts[EDITED])
    found = {uri: [{**item, "relatedInformation": None} for item in client.diagnostics(uri)] for uri in (EDITED, FRESH)}
    check(found[EDITED] == found[FRESH], f"step {step}: other messages")
    for method in WHOLE:
        results = [str(client.of(method, uri, range=None)).replace(uri, "") for uri in (EDITED, FRESH)]
        check(results[0] == results[1], f"step {step}: another answer to {method}")
    client.close(FRESH)


client = Client(MXGEN, None, textDocument={"completion": {"completionItem": {"snippetSupport": True}}})
client.open(EDITED, SOURCES[0])
asked = 0
for step in range(STEPS):
    if step % 150 == 0:
        client.change(EDITED, 0, len(client.texts[EDITED]), chance.choice(SOURCES))
    start, end, new = change(client.texts[EDITED])
    text = client.texts[EDITED]
    if not is_between(text, start) and not is_between(text, end):
        client.change(EDITED, start, end, new)
    if PLACED and step % 3 == 0:
        client.at(chance.choice(PLACED), EDITED, min(len(client.texts[EDITED]), start + chance.randrange(3)), newName="other",
                  context={"includeDeclaration": True, "diagnostics": []})
        asked += 1
    if step % 10 == 9:
        compare(client, step)
check(client.end() == 0, "the server ends well")
print(f"{STEPS} edits, {asked} requests")
finish("lsp-edits")
