# SPDX-License-Identifier: Apache-2.0
"""A client of the language server: messages over pipes, and documents whose text it changes as editors do."""
import json
import pathlib
import re
import select
import subprocess
import time
import urllib.parse


def units(text):
    """The length of a text in UTF-16 code units."""
    return len(text.encode("utf-16-le", "surrogatepass")) // 2


LINE_END = re.compile(r"\r\n|\r|\n")


def position(text, at):
    """The position of a character in a text."""
    before = LINE_END.split(text[:at])
    return {"line": len(before) - 1, "character": units(before[-1])}


def offset(text, place):
    """The character at a position; the inverse of `position`."""
    at = 0
    for _ in range(place["line"]):
        at = LINE_END.search(text, at).end()
    column = 0
    while column < place["character"]:
        column += units(text[at])
        at += 1
    return at


def edited(text, edits):
    """A text after edits of one request, whose ranges are those of the text before."""
    for edit in sorted(edits, key=lambda edit: offset(text, edit["range"]["start"]), reverse=True):
        start, end = (offset(text, edit["range"][side]) for side in ("start", "end"))
        text = text[:start] + edit["newText"] + text[end:]
    return text


class Failure(Exception):
    """The server answered a request with an error."""


class Client:
    """A session. `root` is the folder of the workspace, and the working directory unless there is `cwd`; `address` is one that no folder has."""

    def __init__(self, mxgen, root=None, arguments=(), cwd=None, options=None, address=None, **capabilities):
        self.process = subprocess.Popen([mxgen, "lsp", *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE, cwd=cwd or root)
        self.bytes, self.next, self.published, self.versions, self.texts = bytearray(), 1, {}, {}, {}
        self.capabilities = self.request("initialize", {"processId": None, "rootUri": uri_of(root) if root else address, "initializationOptions": options,
                                                        "capabilities": capabilities})["capabilities"]
        self.notify("initialized", {})

    def send(self, message):
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
        self.process.stdin.flush()

    def notify(self, method, params):
        self.send({"method": method, "params": params})

    def ask(self, method, params):
        """Sends a request; `answer` has its result."""
        self.next += 1
        self.send({"id": self.next, "method": method, "params": params})
        return self.next

    def receive(self, timeout=60):
        end = time.monotonic() + timeout
        while True:
            head = self.bytes.find(b"\r\n\r\n")
            stop = head + 4 + int(self.bytes[:head].split(b":")[1]) if head >= 0 else 1 << 62
            if len(self.bytes) >= stop:
                message = json.loads(self.bytes[head + 4:stop])
                del self.bytes[:stop]
                if message.get("method") == "textDocument/publishDiagnostics":
                    self.published[message["params"]["uri"]] = message["params"]
                return message
            assert select.select([self.process.stdout], [], [], max(0, end - time.monotonic()))[0], "the server is silent"
            data = self.process.stdout.read1(1 << 20)
            assert data, f"the server ended: {self.process.wait()}"
            self.bytes += data

    def answer(self, number):
        while True:
            message = self.receive()
            if message.get("id") == number:
                if "error" in message:
                    raise Failure(message["error"])
                return message["result"]

    def request(self, method, params):
        return self.answer(self.ask(method, params))

    # Documents

    def open(self, uri, text):
        self.versions[uri], self.texts[uri] = self.versions.get(uri, 0) + 1, text
        self.published.pop(uri, None)
        self.notify("textDocument/didOpen", {"textDocument": {"uri": uri, "languageId": "materialx", "version": self.versions[uri], "text": text}})

    def change(self, uri, start, end, new):
        """Replaces characters."""
        text = self.texts[uri]
        self.versions[uri] += 1
        self.texts[uri] = text[:start] + new + text[end:]
        self.notify("textDocument/didChange", {
            "textDocument": {"uri": uri, "version": self.versions[uri]},
            "contentChanges": [{"range": {"start": position(text, start), "end": position(text, end)}, "text": new}]})

    def close(self, uri):
        self.notify("textDocument/didClose", {"textDocument": {"uri": uri}})

    def diagnostics(self, uri):
        """Those of the text as it is now."""
        while self.published.get(uri, {}).get("version") != self.versions[uri]:
            self.receive()
        return self.published[uri]["diagnostics"]

    def at(self, method, uri, at, **more):
        return self.request(method, {"textDocument": {"uri": uri}, "position": position(self.texts[uri], at), **more})

    def of(self, method, uri, **more):
        return self.request(method, {"textDocument": {"uri": uri}, **more})

    def end(self):
        """The exit code."""
        self.request("shutdown", None)
        self.notify("exit", None)
        self.process.stdin.close()
        return self.process.wait(30)


def uri_of(path):
    return "file://" + urllib.parse.quote(str(pathlib.Path(path).resolve()))
