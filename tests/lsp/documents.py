#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The language server opens every document, also faulty ones, and has the messages of `mxgen validate`. Arguments: mxgen, the root of
the project."""
import pathlib
import re
import subprocess
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish, skip
from client import Client, uri_of
import urllib.parse

MXGEN, ROOT = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
MESSAGE = re.compile(r"^(/.*?):(\d+):(\d+): (error|warning): (.*) \[([\w-]+)\]$", re.MULTILINE)


def is_utf8(path):
    try:
        path.read_bytes().decode()
    except UnicodeDecodeError: # no editor sends it
        return False
    return True


def plain(message):
    """Control characters are '?' on a terminal."""
    return re.sub(r"[\x00-\x1f]", "?", message)


def of_validate(folder, documents):
    """File, line, id and message of each message. Warnings of one text stand once, with a count of the others."""
    run = subprocess.run([MXGEN, "validate", "--max-errors", "0", *documents], cwd=folder, capture_output=True, check=False)
    return {(file, int(line), identifier, plain(message)) for file, line, _, _, message, identifier in MESSAGE.findall(run.stderr.decode(errors="replace"))}


def of_server(client, documents):
    found = set()
    for path in documents:
        uri = uri_of(path)
        client.open(uri, path.read_bytes().decode())
        client.diagnostics(uri)
        for place, told in client.published.items():
            file = urllib.parse.unquote(place[len("file://"):])
            for item in told["diagnostics"]:
                found.add((file, item["range"]["start"]["line"] + 1, item["code"], plain(item["message"])))
        client.close(uri)
    return found


def has(told, item, any_line=False):
    """Notes without a place stand behind a message of the server."""
    file, line, identifier, message = item
    return any((file, identifier) == (other[0], other[2]) and (any_line or line == other[1])
               and (other[3].startswith(message) or message.startswith(other[3])) for other in told)


def compare(folder):
    # what is outside of the workspace is not read
    documents = sorted(path for path in folder.rglob("*.mtlx") if path.is_file() and is_utf8(path) and not path.stem.startswith("sandbox"))
    client = Client(MXGEN, folder)
    mine = of_server(client, documents)
    check(client.end() == 0, f"{folder}: the server ends well")
    theirs = of_validate(folder, documents)
    for item in sorted(theirs):
        check(has(mine, item), f"{folder.name}: only validate has {item}")
    for item in sorted(mine): # of equal warnings validate shows the first
        check(has(theirs, item, True), f"{folder.name}: only the server has {item}")
    print(f"{folder.name}: {len(documents)} documents, {len(mine)} messages")


if __name__ == "__main__":
    for folder in (ROOT / "examples", ROOT / "tests/diag", ROOT / "../shared/faults", ROOT / "../shared/materials"):
        if folder.is_dir():
            compare(folder.resolve())
        else:
            skip(f"there is no {folder}")
    finish("lsp-documents")
