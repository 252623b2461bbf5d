#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A document injects no code: hostile names, values and filenames in every place that reaches a shader, for every
target and for networks of OSL. The source without its comments and string literals must not contain the payload, and it must compile.
Arguments: mxgen, mxgen-compile or '', the template."""
import pathlib
import re
import subprocess
import sys
import tempfile
from xml.sax.saxutils import quoteattr

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish, skip

MXGEN, COMPILE, TEMPLATE = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3]).read_text(encoding="utf-8")
MARK = re.compile(r"\bINJECTED\b") # a part of an identifier is harmless
PAYLOADS = { # a geometric property is an identifier: it may be the payload's letters, but not these alone
    "comment end": "*/ INJECTED /*",
    "line end": "\n INJECTED \n",
    "carriage return": "\r INJECTED \r\n",
    "directive": "\n#define main INJECTED\n",
    "continued line": "x\\",
    "quote": '" INJECTED "',
    "escaped quote": '\\" INJECTED \\"',
    "apostrophe": "' INJECTED '",
    "statement": "x; INJECTED(); //",
    "interpolation": "{{in}} ${INJECTED} @INJECTED@ $0 %s %n",
    "line separators": "\u2028 INJECTED \u2029 \u0085 INJECTED",
    "unicode": "\u00e4\U0001f4a5 x INJECTED",
    "null escape": "\\0 INJECTED \\x00",
    "long": "INJECTED " * 200,
}
TOKENS = re.compile(r'//[^\n\r]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)


def attribute(text):
    """As the inside of an attribute in quotation marks, with line ends kept."""
    quoted = quoteattr(text, {"\n": "&#10;", "\r": "&#13;", '"': "&quot;"})
    return quoted[1:-1]


def check_source(path, what):
    text = path.read_text(encoding="utf-8")
    check(not MARK.search(TOKENS.sub(" ", text)), f"{what}: {path.name} has the payload outside of comments and strings")
    ends = [line for line in re.findall(r"//[^\n]*", text) if line.rstrip("\r").endswith("\\")]
    check(not ends, f"{what}: {path.name} has a comment that goes on in the next line: {ends[:1]}")


def targets():
    lines = subprocess.run([MXGEN, "--help"], capture_output=True, text=True, check=True).stdout.splitlines()
    return [line.split()[0] for line in lines[lines.index("Targets:") + 1:] if line.startswith("  ")]


uncompiled = set()
with tempfile.TemporaryDirectory() as folder:
    for name, payload in PAYLOADS.items():
        document = pathlib.Path(folder) / f"{name.replace(' ', '_')}.mtlx"
        document.write_text(TEMPLATE.replace("@@", attribute(payload)), encoding="utf-8")
        for target, options in [(target, []) for target in targets()] + [("osl", ["--osl-network"])]:
            out = pathlib.Path(folder) / name.replace(" ", "_") / (target + "".join(options))
            command = [MXGEN, document, "--target", target, *options, "-o", out, "-Wno-bad-name", "--reflect"]
            result = subprocess.run(command, capture_output=True, text=True, check=False)
            made = [path for path in out.rglob("*") if path.is_file() and path.suffix != ".json"]
            check(result.returncode == 0 and made, f"{name}, {target}: {result.stderr}")
            check(all(out in path.parents for path in made), f"{name}, {target}: a file elsewhere")
            for path in made:
                check_source(path, f"{name}, {target}")
    if COMPILE: # all targets that have a compiler here, in one process, because some compilers start slowly
        documents = sorted(pathlib.Path(folder).glob("*.mtlx"))
        command = [COMPILE, *documents, "--interfaces", "complete", "--targets", ",".join(targets())]
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        check(result.returncode == 0, f"they do not compile: {result.stdout[-1500:]}{result.stderr[-1500:]}")
        for document in documents:
            check(f"{document}\t" in result.stdout, f"{document.name} is not compiled")
        uncompiled.update(re.findall("shaders for '(\\w+)' are not compiled", result.stderr))

if not COMPILE:
    skip("without glslang nothing is compiled")
if uncompiled:
    skip(f"no compiler for {', '.join(sorted(uncompiled))}")
finish("injection")
