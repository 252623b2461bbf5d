#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The language server as WebAssembly answers as the program does: every request, over the documents of the project. Arguments: mxgen, the
server as WebAssembly (tests/js/lsp.mjs), the root of the project."""
import pathlib
import random
import re
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish
from client import Client, Failure, position, uri_of
from documents import is_utf8

MXGEN, WASM, ROOT = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
FOLDERS = "examples", "tests/diag", "tests/golden", "tests/lsp"
WHOLE = {"start": {"line": 0, "character": 0}, "end": {"line": 1 << 20, "character": 0}}
OF_DOCUMENT = "documentSymbol foldingRange documentLink semanticTokens/full documentColor codeLens".split()
AT_PLACE = "completion hover definition documentHighlight references prepareRename rename prepareCallHierarchy".split()
PLACES = 6 # of a document
chance = random.Random(1)


def plain(value):
    """Without the order of names in a folder, which the system chooses, and without the place of the explanations. JavaScript has 1 for 1.0."""
    if isinstance(value, list):
        return sorted((plain(item) for item in value), key=str)
    if isinstance(value, dict):
        return {key: item.partition("#")[2] if key == "href" else plain(item) for key, item in sorted(value.items())}
    return int(value) if isinstance(value, float) and value.is_integer() else value


def answer_of(client, method, params):
    try:
        return client.request(method, params)
    except Failure as failure:
        return {"error": failure.args[0]}


def requests_of(uri, text, told):
    """Methods and parameters for a document with these messages."""
    document = {"textDocument": {"uri": uri}}
    for name in OF_DOCUMENT:
        yield name, document
    yield "inlayHint", {**document, "range": WHOLE}
    yield "formatting", {**document, "options": {"tabSize": 2, "insertSpaces": True}}
    for item in told:
        yield "codeAction", {**document, "range": item["range"], "context": {"diagnostics": [item]}}
    words = [match.start() + 1 for match in re.finditer(r"""[<"'\w]\w""", text)] or [0]
    for at in chance.sample(words, min(PLACES, len(words))):
        for name in AT_PLACE:
            yield name, {**document, "position": position(text, at), "newName": "renamed", "context": {"includeDeclaration": True}}


def follow_ups(name, answer):
    """Requests about the items of an answer."""
    for item in answer if isinstance(answer, list) else []:
        if name == "codeLens":
            yield "codeLens/resolve", item
        elif name == "prepareCallHierarchy":
            yield from ((f"callHierarchy/{way}Calls", {"item": item}) for way in ("incoming", "outgoing"))


def compare(clients, path, counts):
    uri, text = uri_of(path), path.read_bytes().decode()
    for client in clients:
        client.published.clear()
        client.open(uri, text)
    told = [client.diagnostics(uri) for client in clients]
    mine, theirs = ({file: items for file, items in client.published.items() if items["diagnostics"]} for client in clients)
    check(plain(mine) == plain(theirs), f"{path.name}: messages:\n  {mine}\n  {theirs}")

    def ask(method, params):
        mine, theirs = (answer_of(client, method, params) for client in clients)
        counts[method] = counts.get(method, 0) + (bool(mine) and "error" not in mine)
        check(plain(mine) == plain(theirs), f"{path.name}: {method} {params}:\n  {mine}\n  {theirs}")
        return mine

    for name, params in requests_of(uri, text, told[0]):
        for method, item in follow_ups(name, ask(f"textDocument/{name}", params)):
            ask(method, item)
    for client in clients:
        client.close(uri)


counts = {}
for folder in FOLDERS:
    root = (ROOT / folder).resolve()
    clients = [Client(program, root, cwd="/", textDocument={"completion": {"completionItem": {"snippetSupport": True}}}) for program in (MXGEN, WASM)]
    for path in sorted(root.rglob("*.mtlx")):
        if path.is_file() and is_utf8(path):
            compare(clients, path, counts)
    check([client.end() for client in clients] == [0, 0], f"{folder}: the servers end well")
check(len(counts) == len(OF_DOCUMENT) + len(AT_PLACE) + 6 and all(counts.values()), f"requests with an answer: {counts}")
print(", ".join(f"{method.split('/', 1)[1]} {count}" for method, count in counts.items()))
finish("lsp-same")
