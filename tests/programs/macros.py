#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Names of a document that are macros of a language get other names in its shaders, which compile: inputs and nodes. The words are those of
specifications and headers; glslang and oslc refuse most of them. Arguments: mxgen, mxgen-compile or ''."""
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish, skip

MXGEN, COMPILE = sys.argv[1:3]
GLSL = "GL_ES GL_SPIRV GL_core_profile GL_FRAGMENT_PRECISION_HIGH GL_KHR_blend_equation_advanced GL_OES_standard_derivatives GL_later VULKAN".split()
OSL = "OSL_VERSION OSL_VERSION_MAJOR OSL_VERSION_MINOR OSL_VERSION_PATCH STDOSL_H _Pragma M_PI M_4PI".split()
HLSL = GLSL + "_Pragma NULL min16float2 min10float4 min12int2x2 min16uint4 SubpassInput SubpassInputMS".split()
SLANG = "_Pragma min16float2 SubpassInput".split()
MSL = ("_Pragma _LP64 NULL INFINITY NAN MAXFLOAT HUGE_VALH FLT_MAX_EXP HALF_MANT_DIG HALF_RADIX M_PI M_SQRT2_H M_LN2_BF BFLT_MAX SCHAR_MIN "
       "FP_ILOGBNAN").split()
WORDS = {"glsl": GLSL, "vulkan": GLSL, "essl": GLSL, "essl310": GLSL, "hlsl": HLSL, "slang": SLANG, "msl": MSL, "osl": OSL, "wgsl": ["NULL"], "mdl": []}
# MDL and WGSL have no preprocessor: mdlc refuses '#define', so no word is a macro there.


def document(words):
    """Each word is an input of the document and of a nodegraph, and a node."""
    lines = [f'<input name="{word}" type="float" value="0.1"/>' for word in words]
    lines.append('<nodegraph name="g"><texcoord name="uv" type="vector2"/><separate2 name="s" type="multioutput">'
                 '<input name="in" type="vector2" nodename="uv"/></separate2>')
    lines += [f'<input name="{word}" type="float" value="0.2"/>' for word in words]
    before = 'nodename="s" output="outx"'
    for word in words:
        lines.append(f'<sin name="{word}_in" type="float"><input name="in" type="float" {before}/></sin>'
                     f'<multiply name="m_{word}" type="float"><input name="in1" type="float" nodename="{word}_in"/><input name="in2" type="float" interfacename="{word}"/></multiply>')
        before = f'nodename="m_{word}"'
    lines.append(f'<output name="out" type="float" {before}/></nodegraph>')
    before = 'nodegraph="g" output="out"'
    for word in words:
        lines.append(f'<multiply name="of_{word}" type="float"><input name="in1" type="float" {before}/><input name="in2" type="float" interfacename="{word}"/></multiply>')
        before = f'nodename="of_{word}"'
    lines.append(f'<output name="out" type="float" {before}/>')
    return '<?xml version="1.0"?>\n<materialx version="1.39">\n' + "\n".join(lines) + "\n</materialx>\n"


def names(path):
    return set(re.findall(r"[A-Za-z_]\w*", re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', " ", path.read_text(encoding="utf-8"), flags=re.DOTALL)))


with tempfile.TemporaryDirectory() as folder:
    path, out = pathlib.Path(folder) / "macros.mtlx", pathlib.Path(folder) / "out"
    every = sorted({word for words in WORDS.values() for word in words})
    path.write_text(document(every), encoding="utf-8")
    for target, words in WORDS.items():
        result = subprocess.run([MXGEN, path, "-e", "out", "-t", target, "-o", out / target], capture_output=True, text=True, check=False)
        check(result.returncode == 0, f"{target}: {result.stderr}")
        made = [file for file in (out / target).rglob("*") if file.is_file() and file.suffix != ".json"]
        check(made, f"{target}: no shader")
        found = set().union(*map(names, made)) & set(words)
        check(not found, f"{target}: {sorted(found)} are names of the shader")
    if COMPILE:
        result = subprocess.run([COMPILE, path, "-e", "out", "--targets", ",".join(WORDS)], capture_output=True, text=True, check=False)
        check(result.returncode == 0, f"they do not compile: {result.stdout[-1500:]}{result.stderr[-1500:]}")
    else:
        skip("without glslang nothing is compiled")
finish("macros")
