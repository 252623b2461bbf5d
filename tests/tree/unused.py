#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Generates every node of the library alone with its defaults: the shader has no unused function, uniform, stream, struct or
variable. Arguments: mxgen, a target."""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parent.parent))
from checks import check, finish

MXGEN, TARGET = sys.argv[1:]
LINE = re.compile(r"^(\S+)  (\w+)\((.*)\) -> (.*)$")
PATTERNS = {"boolean", "integer", "float", "color3", "color4", "vector2", "vector3", "vector4"}
WORD = re.compile(r"[A-Za-z_]\w*")
# Names that a declaration introduces: functions, uniforms and streams, structs, local variables (also in lists).
TYPE = r"(?:float|int|uint|bool|[iu]?vec[234]|mat[234]|sampler2D|[A-Z]\w*|mx_\w+)"
FUNCTION = re.compile(rf"^(?:void|{TYPE}) (\w+)\(", re.M)
GLOBAL = re.compile(rf"^(?:layout\([^)]*\) )?(?:flat )?(?:uniform|in) {TYPE} (\w+)", re.M)
MEMBER = re.compile(rf"^    (?:flat )?{TYPE} (\w+)(?:\[\d+\])?;$", re.M)
STRUCT = re.compile(r"^struct (\w+)", re.M)
LOCAL = re.compile(rf"^ +(?:const )?{TYPE} (\w+(?:, \w+)*)(?: =|;)", re.M)
# The value of a call with `out` arguments (declared without a value) may not matter; the call does.
OUT_CALL = re.compile(rf"^ +{TYPE} (\w+) = \w+\(.*\b(\w+)\);$", re.M)
HOST = {"main", "LightData"}  # whose members are the host's


def document(lines):
    """A graph per definition and output. Closures and shaders need lights; they are tested elsewhere."""
    text = ['<materialx version="1.39">']
    for name, node, _, outputs in lines:
        ports = [output.split(":") for output in outputs.split(", ")]
        for port, kind in ports:
            if kind not in PATTERNS or node == "aovpass":  # it reads a shader
                continue
            several = len(ports) > 1
            choice = f' output="{port}"' if several else ""
            inner = '<input name="name" type="string" value="a"/>' if node == "aov" else ""  # each AOV needs one
            text.append(f'<nodegraph name="{name}_{port}"><{node} name="n" nodedef="{name}" type="{"multioutput" if several else kind}">'
                        f'{inner}</{node}><output name="o" type="{kind}" nodename="n"{choice}/></nodegraph>')
    return "\n".join(text + ["</materialx>"])


def unused(source):
    code = re.sub(r"//.*", "", source)
    counts = {}
    for word in WORD.findall(code):
        counts[word] = counts.get(word, 0) + 1
    names = FUNCTION.findall(code) + GLOBAL.findall(code) + MEMBER.findall(code) + STRUCT.findall(code)
    for names_of_one in LOCAL.findall(code):
        names += names_of_one.split(", ")
    outs = set(re.findall(rf"^ +{TYPE} (\w+);$", code, re.M))
    called = {name for name, last in OUT_CALL.findall(code) if last in outs}
    return sorted({name for name in names if counts[name] < 2 and name not in HOST | called})


listed = subprocess.run([MXGEN, "library", "list"], capture_output=True, text=True, check=True).stdout
definitions = [match.groups() for match in map(LINE.match, listed.splitlines()) if match]
with tempfile.TemporaryDirectory() as folder:
    path = Path(folder, "all.mtlx")
    path.write_text(document(definitions), encoding="utf-8")
    made = subprocess.run([MXGEN, path, "--target", TARGET, "--stdout"], capture_output=True, text=True, check=False)
    check(made.returncode == 0, made.stderr)
    for section in re.split(r"^// (?=\S+\.(?:vert|frag)$)", made.stdout, flags=re.M)[1:]:
        name, source = section.split("\n", 1)
        found = unused(source)
        check(not found, f"{name}: not used: {', '.join(found)}")
finish("unused")
