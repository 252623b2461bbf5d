#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Documents that once crashed mxgen, hung it, took its memory, or gave a shader that does not compile: each for every
target and both interfaces, with --trust, under a limit of memory. It is generated and compiles, or ends with exit code 1 and
a message with its place. Arguments: mxgen, mxgen-compile or '', the folder."""
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish, skip

MXGEN, COMPILE, FOLDER = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
MEMORY, SECONDS = 1 << 30, 240 # a machine may be slow; without a limit these take hours
GOOD = ""
# The message of each document, or GOOD. A verbatim implementation is for GLSL only.
EXPECTED = {
    "add_minus_inf": GOOD,
    "chosen_index": GOOD,
    "divide_by_zero_reduced": GOOD,
    "extract_index3": "index-out-of-range",
    "extract_matrix_index": "index-out-of-range",
    "function_stream": GOOD,
    "inf_default_options": GOOD,
    "many_fn": GOOD,
    "matrix_default": GOOD,
    "matrix_stream": "function-signature",
    "ndchain": "missing-implementation",
    "osl_network_ladder20": GOOD,
    "slab_ladder20": "too-many-slabs",
    "sandbox_texture": GOOD, # without --sandbox; see tests/diag/sandbox_texture.mtlx
    "struct_exp": "lang-limit",
    "subtract_inf_default": GOOD,
    "udimset40000": GOOD,
    "uniform_clash": "uniform-name",
    "upgrade_null": "name-missing",
    "verbatim_index_oob": "lang-unknown",
    "verbatim_stack": "lang-unknown",
}
NETWORK = {"osl_network_ladder20": "network-limit"} # with --osl-network
GLSL_ONLY = {"verbatim_index_oob", "verbatim_stack"}
GLSL = ("glsl", "vulkan", "essl", "essl310")
WORKERS = ("msl", "slang", "wgsl") # their compilers (compile/compiler_process.h) reserve more memory than the limit, and start slowly
NOT_FOR_OSLC = {"many_fn", "osl_network_ladder20"} # it inlines each call, so its time and memory double with each level
LINES = subprocess.run([MXGEN, "--help"], capture_output=True, text=True, check=True).stdout.splitlines()
TARGETS = [line.split()[0] for line in LINES[LINES.index("Targets:") + 1:] if line.startswith("  ")]


def limit(memory):
    """Of all processes that this one starts: to limit each when it starts would copy this one."""
    if not os.environ.get("SANITIZER"): # which maps terabytes
        resource.setrlimit(resource.RLIMIT_AS, (memory, resource.RLIM_INFINITY))


def run(command, seconds=SECONDS):
    """The exit code, or None after the time; and what it says."""
    try:
        result = subprocess.run(command, capture_output=True, text=True, check=False, timeout=seconds)
        return result.returncode, result.stderr
    except subprocess.TimeoutExpired:
        return None, "it does not end"


def expected_of(document, target, arguments):
    if "--osl-network" in arguments and document.stem in NETWORK:
        return NETWORK[document.stem]
    return "missing-implementation" if document.stem in GLSL_ONLY and target not in GLSL else EXPECTED[document.stem]


def check_run(documents, target, arguments, out):
    """All documents in one process; each is generated in a folder of its own, or has its message."""
    code, text = run([MXGEN, *documents, "--target", target, "--trust", "-o", out, *arguments])
    check(code == 1, f"{target} {' '.join(arguments)}: exit code {code}: {text[:500]}")
    for document in documents:
        what, expected = f"{document.name}, {target} {' '.join(arguments)}", expected_of(document, target, arguments)
        errors = re.findall(rf"\b{document.stem}\.\w+:\d+:\d+: error: .*", text)  # also in its source
        made = [path for path in (out / document.stem).rglob("*") if path.is_file()]
        if expected:
            check(any(error.endswith(f"[{expected}]") for error in errors), f"{what}: no '{expected}' with a place in: {text[:500]}")
            continue
        check(made and not errors, f"{what}: nothing is written: {errors}")
        check(sum(path.stat().st_size for path in made) < 1 << 20, f"{what}: the output is too large")
    shutil.rmtree(out, ignore_errors=True)


def check_compiles(documents, targets):
    """All in one process, as compilers start slowly."""
    code, text = run([COMPILE, *documents, "--trust", "--targets", ",".join(targets), "--interfaces", "complete,reduced"], 600)
    check(code == 0, f"documents do not compile for {', '.join(targets)}: {text[:1000]}")


def write_tiles(path):
    """A udimset of 40,000 numbers, most of which are no tiles."""
    tiles = ",".join(str(number) for number in range(1001, 41001))
    path.write_text(f"""<materialx version="1.39">
  <geominfo name="g" geom="*"><geomprop name="udimset" type="stringarray" value="{tiles}"/></geominfo>
  <image name="i" type="color3"><input name="file" type="filename" value="a.&lt;UDIM&gt;.png"/></image>
  <output name="o" type="color3" nodename="i"/>
</materialx>
""", encoding="utf-8")


limit(MEMORY)
with tempfile.TemporaryDirectory() as folder:
    temporary = pathlib.Path(folder)
    write_tiles(temporary / "udimset40000.mtlx")
    documents = sorted(FOLDER.glob("*.mtlx")) + [temporary / "udimset40000.mtlx"]
    check({document.stem for document in documents} == set(EXPECTED), "a document or its row is missing")
    for target in TARGETS:
        for interface in ("complete", "reduced"):
            check_run(documents, target, ["--interface", interface], temporary / "out")
    check_run(documents, "osl", ["--osl-network"], temporary / "out")
    if COMPILE:
        good = [document for document in documents if EXPECTED[document.stem] == GOOD]
        check_compiles([document for document in good if document.stem not in NOT_FOR_OSLC], ["osl"])
        check_compiles(good, [target for target in TARGETS if target not in WORKERS and target != "osl"])
        limit(resource.RLIM_INFINITY)
        check_compiles(good, WORKERS)

if not COMPILE:
    skip("without glslang nothing is compiled")
finish("faults")
