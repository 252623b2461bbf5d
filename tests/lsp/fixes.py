#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every quick fix of every message of the documents: applied, its message is gone, and there is no new one, but for those that a table
names. Arguments: mxgen, the root of the project."""
import collections
import pathlib
import re
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish, skip
from client import Client, edited, uri_of
from documents import is_utf8

MXGEN, ROOT = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
# Messages that were hidden behind another one, by the message that the fix takes away.
REVEALED = {"name-missing": ["unused-node"], "bad-name": ["unused-node"], "several-connections": ["unused-node"], "unknown-node": ["no-shader"],
            "input-type": ["type-mismatch"]}


def counts(items):
    return collections.Counter((item["code"], item["message"].split("\n")[0]) for item in items)


def try_fix(client, uri, text, item, action, before, tried):
    where = f"{pathlib.Path(uri).name}:{item['range']['start']['line'] + 1}: {item['code']}: {action['title']}"
    other = uri.replace(".mtlx", "__fixed.mtlx")
    client.open(other, edited(text, action["edit"]["changes"][uri]))
    after = counts(client.diagnostics(other))
    client.close(other)
    message = (item["code"], item["message"].split("\n")[0])
    check(after[message] < before[message], f"{where}: the message stays: {message}")
    new = {other for other in after - before if other[0] not in REVEALED.get(item["code"], ())}
    check(not new, f"{where}: new messages {sorted(new)}")
    tried[item["code"]] += 1


def fix_all(client, path, tried):
    uri, text = uri_of(path), path.read_bytes().decode()
    client.open(uri, text)
    items = client.diagnostics(uri)
    before = counts(items)
    seen = set()
    for item in items:
        place = item["range"]["start"]
        actions = client.of("textDocument/codeAction", uri, range={"start": place, "end": place}, context={"diagnostics": [item]})
        for action in actions:
            if action["kind"] == "quickfix" and action["diagnostics"] == [item] and str(action) not in seen:
                seen.add(str(action))
                try_fix(client, uri, text, item, action, before, tried)
    client.close(uri)


tried = collections.Counter()
for folder in (ROOT / "tests/diag", ROOT / "examples", ROOT / "../shared/faults", ROOT / "tests/lsp"):
    if not folder.is_dir():
        skip(f"there is no {folder}")
        continue
    client = Client(MXGEN, folder.resolve())
    for path in sorted(folder.resolve().rglob("*.mtlx")):
        if is_utf8(path):
            fix_all(client, path, tried)
    check(client.end() == 0, f"{folder.name}: the server ends well")
rows = set(re.findall(r'^CURE\("([\w-]+)", \w+, (?!NULL)', (ROOT / "lsp/cures.def").read_text(encoding="utf-8"), re.MULTILINE))
check(rows <= set(tried), f"cures that no document tries: {sorted(rows - set(tried))}")
print("tried:", ", ".join(f"{code} {count}" for code, count in sorted(tried.items())))
finish("lsp-fixes")
