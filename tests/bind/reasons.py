#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`mxgen bind --geom`: each assignment that was considered for a primitive, and why it won, lost, was removed or sleeps, each reason of the rules
with the case that has it. And what terminals show: inherited layers are dim, others are not, and a pipe has no colour.

Argument: mxgen."""
import os
import pathlib
import pty
import re
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish

MXGEN = pathlib.Path(sys.argv[1]).resolve()
HEAD = """<materialx version="1.39">
  <standard_surface name="s" type="surfaceshader"/>
  <displacement name="d" type="displacementshader"/>
  <surfacematerial name="A" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>
  <surfacematerial name="B" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s"/>
    <input name="displacementshader" type="displacementshader" nodename="d"/></surfacematerial>
  <nodegraph name="NG"><constant name="c" type="float"/><output name="base" type="float" nodename="c"/></nodegraph>
"""


def assign(name, geom=None, slot="000", **attributes):
    """An assignment of material A, unless the attributes say another."""
    attributes = {"material": "A", **attributes} if "nodegraph" not in attributes else attributes
    place = {} if geom is None else {"geom": geom}
    text = " ".join(f'{key}="{value}"' for key, value in {"name": name, "slot": slot, **place, **attributes}.items())
    return f"<materialassign {text}/>"


# Each row has the object that is shown, the texts of parent look and look, options, the primitive, and its assignments with their reasons, in order.
CASES = [
    ("a deeper one", "", assign("low", "/") + assign("deep", "/a"), [], "/a/b",
     [("000", "deep", "wins: a layer"), ("000", "low", "loses to L/deep, which stands deeper, at /a")]),
    ("a later one", "", assign("first", "/a") + assign("second", "/a"), [], "/a/b",
     [("000", "second", "wins: a layer"), ("000", "first", "loses to L/second, which stands later in the file")]),
    ("each loses to the next stronger", "", assign("one", "/") + assign("two", "/a") + assign("three", "/a/b"), [], "/a/b",
     [("000", "three", "wins: a layer"), ("000", "two", "loses to L/three, which stands deeper, at /a/b"),
      ("000", "one", "loses to L/two, which stands deeper, at /a")]),
    ("a look and its parent", assign("old", "/a"), assign("new", "/a"), [], "/a/b",
     [("000", "new", "wins: a layer"), ("000", "old", "loses to L/new, which a look has that inherits from this one")]),
    ("a removal", "", assign("paint", "/") + assign("none", "/a", material=""), [], "/a/b",
     [("000", "none", "removes the slot"), ("000", "paint", "is removed by L/none, which stands deeper, at /a")]),
    ("and not beside it", "", assign("paint", "/") + assign("none", "/a", material=""), [], "/c", [("000", "paint", "wins: a layer")]),
    ("overrides of what is removed", "", assign("paint", "/") + assign("drive", "/", "000::x", nodegraph="NG") + assign("none", "/a", material=""), [],
     "/a/b", [("000", "none", "removes the slot"), ("000", "paint", "is removed by L/none, which stands deeper, at /a"),
              ("000::x", "drive", "sleeps: there is no layer in 000")]),
    ("an override that is removed", "", assign("paint", "/") + assign("drive", "/", "000::x", nodegraph="NG")
     + assign("none", "/a", "000::x", nodegraph=""), [], "/a",
     [("000", "paint", "wins: a layer"), ("000::x", "none", "removes the name"), ("000::x", "drive", "is removed by L/none, which stands deeper, at /a")]),
    ("vertical layers", "", assign("paint", "/a") + assign("coat", "/", "000|v"), [], "/a",
     [("000", "paint", "wins: a layer"), ("000|v", "coat", "wins: a vertical layer")]),
    ("over nothing", "", assign("paint", "/a") + assign("coat", "/", "000|v"), [], "/c", [("000|v", "coat", "sleeps: there is no layer in 000")]),
    ("a mute slot", "", assign("paint", "/") + assign("dust", "/", "050"), ["--mute", "050"], "/a",
     [("000", "paint", "wins: a layer"), ("050", "dust", "is muted")]),
    ("products of a weaker one", "", assign("deep", "/a", exclusive="false") + assign("low", "/", material="B"), [], "/a",
     [("000", "deep", "wins: a layer"), ("000", "low", "gives what stronger ones lack and share: displacementshader")]),
    ("and none without the flag", "", assign("deep", "/a") + assign("low", "/", material="B"), [], "/a",
     [("000", "deep", "wins: a layer"), ("000", "low", "loses to L/deep, which stands deeper, at /a")]),
    ("a collection in another one", "", assign("inner", collection="Inner") + assign("outer", collection="Outer"), [], "/a",
     [("000", "inner", "wins: a layer"), ("000", "outer", "loses to L/inner, whose collection this one's includes")]),
    ("an exclusion", "", assign("most", collection="Most"), [], "/c",
     [("000", "most", "does not stand here: the collection Most excludes the primitive")]),
    ("is none elsewhere", "", assign("most", collection="Most"), [], "/a", [("000", "most", "wins: a layer")]),
]
COLLECTIONS = """<collection name="Inner" includegeom="/a"/><collection name="Outer" includecollection="Inner"/>
  <collection name="Most" includegeom="/" excludegeom="/c"/>"""


def write(parent, look):
    text = f'{HEAD}{COLLECTIONS}<look name="P">{parent}</look><look name="L" inherit="P">{look}</look></materialx>'
    pathlib.Path("look.mtlx").write_text(text, encoding="utf-8")
    pathlib.Path("stage.txt").write_text("/a/b\n/c\n", encoding="utf-8")
    return [MXGEN, "bind", "look.mtlx", "--look", "L", "--stage", "stage.txt"]


def reasons(command, path):
    out = subprocess.run([*command, "--geom", path], capture_output=True, text=True, check=False).stdout
    return re.findall(r"^  (\S+)  .*?, [LP]/(\w+) \(look.mtlx:\d+\).*\n +(.*)$", out, re.MULTILINE), out


def on_terminal(command):
    """What a program writes to a terminal."""
    pid, terminal = pty.fork()
    if not pid:
        os.execv(command[0], [str(part) for part in command])
    out = b""
    try:
        while more := os.read(terminal, 4096):
            out += more
    except OSError:  # the end of a terminal's program
        pass
    os.waitpid(pid, 0)
    os.close(terminal)
    return out.decode().replace("\r", "")


def test_colours():
    command = write("", assign("paint", "/a") + assign("dust", "/a/b", "050"))
    row = next((line for line in on_terminal(command).split("\n") if line.startswith("/a/b")), "")
    check(re.search(r"\x1b\[2m\(000 A\)\x1b\[0m", row), f"an inherited layer is dim on a terminal: {row!r}")
    check(re.search(r"(?<!m)\[050 A\]|\x1b\[1m\[050 A\]", row), f"what is set here is not: {row!r}")
    piped = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    check("\x1b" not in piped and "(000 A)  [050 A]" in piped, f"a pipe has no colour: {piped!r}")


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for what, parent, look, options, path, expected in CASES:
        found, out = reasons([*write(parent, look), *options], path)
        check(found == expected, f"{what}: {out}")
        check(out.startswith(path + "\n"), f"{what}: the primitive is named: {out}")
    found, out = reasons(write("", assign("paint", "/a")), "/c")
    check("no assignment stands here: the default substance" in out, f"nothing stands there: {out}")
    test_colours()
    os.chdir("/")
finish("bind-reasons")
