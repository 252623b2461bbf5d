#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What --precision mediump says in the source, in SPIR-V and in the reflection: colours bear half floats, all else has all bits. Arguments: mxgen, and the document
tests/golden/precision.mtlx, whose colours have the names below."""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
import checks

MXGEN, DOCUMENT = sys.argv[1:]
UNIFORMS = {"NG_coloured_tint", "SR_coloured_specular_color", "SR_coloured_sheen_color"}
IMAGE = "albedo_file"
# Languages with types of half floats: the file of the pixel stage, a local of such a type, and what a device must have.
HALVES = {
    "wgsl": ("frag.wgsl", r"let (\w+): vec[34]h = ", "shader-f16"),
    "hlsl": ("ps.hlsl", r"min16float[34] (\w+) = ", None),
    "msl": ("frag.metal", r"half[34] (\w+) = ", None),
    "slang": ("frag.slang", r"half[34] (\w+) = ", None),
}
RESULT = re.compile(r"^\s*(%\S+) = (Op\w+) (.*)$", re.M)
# instructions whose results are directions, lengths, positions
WHOLE = "Normalize", "Length", "Cross", "Sqrt", "InverseSqrt", "Log2", "Pow", "FaceForward"


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def source(folder, target, *options):
    run(MXGEN, DOCUMENT, "--target", target, "-q", "-o", folder, *options)
    return f"{folder}/Coloured.frag"


def disassembly(path):
    run("glslangValidator", "-V", path, "-o", path + ".spv")
    return run("spirv-dis", path + ".spv")


def relaxed_members(text):
    """Names of struct members with the decoration."""
    names = {(kind, member): name for kind, member, name in re.findall(r'OpMemberName (\S+) (\d+) "(.*)"', text)}
    return {names[key] for key in re.findall(r"OpMemberDecorate (\S+) (\d+) RelaxedPrecision", text)}


def check_spirv(folder):
    text = disassembly(source(folder, "vulkan", "--precision", "mediump"))
    relaxed = set(re.findall(r"OpDecorate (%\S+) RelaxedPrecision", text))
    results = {name: (op, rest.split()) for name, op, rest in RESULT.findall(text)}
    checks.check(relaxed_members(text) == UNIFORMS, f"relaxed uniforms: {sorted(relaxed_members(text))}")
    checks.check(f"%{IMAGE}" in relaxed, "the colour's texture is not relaxed")
    samples = [(name, rest) for name, (op, rest) in results.items() if op.startswith("OpImageSample")]
    checks.check(len(samples) >= 3, f"{len(samples)} samples")
    for name, rest in samples:
        checks.check(rest[2] not in relaxed, f"coordinates {rest[2]} of {name} are relaxed")
        texture = results[rest[1]][1][1]
        checks.check((name in relaxed) == (texture == f"%{IMAGE}"), f"{name} of {texture} is {'' if name in relaxed else 'not '}relaxed")
    whole = [name for name, (op, rest) in results.items() if op == "OpExtInst" and rest[2] in WHOLE]
    checks.check(len(whole) > 10, f"{len(whole)} directions and lengths")
    checks.check(not relaxed.intersection(whole), f"relaxed directions: {relaxed.intersection(whole)}")
    inputs = [name for name, (op, rest) in results.items() if op == "OpLoad" and re.search(r"%vd\b", " ".join(results.get(rest[1], ("", []))[1]))]
    checks.check(inputs and not relaxed.intersection(inputs), "relaxed inputs of the stage")
    locals_of = [name for name, (op, rest) in results.items() if op == "OpVariable" and "Function" in rest and name in relaxed]
    checks.check("%tinted" in locals_of, f"relaxed locals: {locals_of}")


def check_halves(folder, target):
    """Locals are half floats, and nothing else is: the host writes uniforms as ever."""
    ending, local, feature = HALVES[target]
    texts, features = [], []
    for precision in "mediump", "highp":
        run(MXGEN, DOCUMENT, "--target", target, "--precision", precision, "--reflect", "-q", "-o", folder)
        texts.append(pathlib.Path(f"{folder}/Coloured.{ending}").read_text(encoding="utf-8"))
        features.append(json.loads(pathlib.Path(f"{folder}/Coloured.json").read_text(encoding="utf-8")).get("deviceFeatures"))
    checks.check(set(re.findall(local, texts[0])) == {"image", "tinted", "faded", "fresnel_facing"}, f"{target}: {re.findall(local, texts[0])}")
    checks.check(not re.search(local, texts[1]), f"{target}: half floats without the option")
    checks.check(features == [feature, None], f"{target}: {features}")
    for text, word in zip(texts, (target == "wgsl", False)):
        checks.check(("\nenable f16;\n" in text) == word, f"{target}: enable f16 in {text[:80]}")


def main():
    missing = [tool for tool in ("glslangValidator", "spirv-dis") if not shutil.which(tool)]
    with tempfile.TemporaryDirectory() as folder:
        if missing:
            checks.skip(f"{missing[0]} is not installed")
        else:
            check_spirv(folder)
            checks.check("RelaxedPrecision" not in disassembly(source(folder, "vulkan")), "relaxed without the option")
        for target in "essl", "essl310":
            lines = pathlib.Path(source(folder, target, "--precision", "mediump")).read_text(encoding="utf-8").splitlines()
            checks.check("precision highp float;" in lines, f"{target}: not highp by default")
            uniforms = {line.split()[-1].rstrip(";") for line in lines if re.match(r"\s*(uniform )?mediump vec[34] \w+;", line)}
            checks.check(uniforms == UNIFORMS, f"{target}: {sorted(uniforms)}")
        for target in HALVES:
            check_halves(folder, target)
        refused = subprocess.run([MXGEN, DOCUMENT, "--target", "glsl", "--precision", "mediump", "-o", folder], capture_output=True, text=True,
                                 check=False)
        checks.check(refused.returncode == 2 and "precision" in refused.stderr, f"glsl: {refused.returncode}, {refused.stderr}")
    checks.finish("precision-words")


main()
