#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Estimated errors of budgets follow the texels of a document (docs/slabs.md): a mask that hides gold or cloth, or one that nobody can read.

Arguments: mxgen, mxgen-render ('': no texture can be read)."""
import json
import os
import pathlib
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish, run, skip

MXGEN, RENDER = sys.argv[1:3]
DOCUMENT = """<?xml version="1.0"?>
<materialx version="1.39">
  <image name="mask" type="float"><input name="file" type="filename" value="mask.ppm"/></image>
  <slab name="cloth" type="BSDF">
    <input name="diffuse_albedo" type="color3" value="0.1, 0.02, 0.3"/>
    <input name="roughness" type="float" value="0.8"/>
    <input name="fuzz_amount" type="float" value="1"/>
  </slab>
  <slab name="gold" type="BSDF">
    <input name="diffuse_albedo" type="color3" value="0, 0, 0"/>
    <input name="f0" type="color3" value="0.9, 0.7, 0.3"/>
    <input name="roughness" type="float" value="0.1"/>
  </slab>
  <slab_mix name="mixed" type="BSDF">
    <input name="fg" type="BSDF" nodename="cloth"/>
    <input name="bg" type="BSDF" nodename="gold"/>
    <input name="mix" type="float" nodename="mask"/>
  </slab_mix>
  <slab_surface name="surface" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="mixed"/></slab_surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="surface"/></surfacematerial>
</materialx>
"""


def write_mask(path, share):
    """White on the left, black on the right."""
    row = b"".join(b"\xff\xff\xff" if x < 64 * share else b"\0\0\0" for x in range(64))
    path.write_bytes(b"P6 64 64 255\n" + row * 64)


def write_stripes(path, width):
    """White and black in turn."""
    row = b"".join(b"\xff\xff\xff" if x // width % 2 else b"\0\0\0" for x in range(64))
    path.write_bytes(b"P6 64 64 255\n" + row * 64)


def report(document):
    done = run(MXGEN, "inspect", document, "--slabs", "--format", "json")
    check(done.returncode == 0, f"inspect: {done.stderr}")
    return json.loads(done.stdout)


with tempfile.TemporaryDirectory() as folder:
    document, mask = pathlib.Path(folder) / "textured.mtlx", pathlib.Path(folder) / "mask.ppm"
    document.write_text(DOCUMENT)
    unread = report(document)
    check(unread["notRead"] == ["mask"], f"a file that is missing is not named: {unread['notRead']}")
    document.write_text(DOCUMENT.replace("<image", '<time name="now" type="float"/><image').replace('name="roughness" type="float" value="0.8"',
        'name="roughness" type="float" nodename="now"').replace('<input name="file" type="filename" value="mask.ppm"/></image>',
        '<input name="geomprop" type="string" value="wear"/></geompropvalue>').replace("<image", "<geompropvalue"))
    unknown = report(document)["notRead"]
    check(sorted(unknown) == ["mask", "now"], f"the time and data of vertices are not named: {unknown}")
    document.write_text(DOCUMENT)
    if RENDER:
        errors = {}
        for share in (0, 0.5, 1):
            write_mask(mask, share)
            seen = report(document)
            check(seen["notRead"] == [], f"mask of {share}: told as not read")
            errors[share] = seen["steps"][-1]["estimatedError"]
        fixed = unread["steps"][-1]["estimatedError"]
        check(errors[0] < 0.01 and errors[1] < 0.01, f"one slab is seen alone, but blending shows: {errors}")
        check(errors[0.5] < 0.01 < fixed, f"each texel shows one slab, but blending shows: {errors}, unread {fixed}")
        for width in (4, 1):
            write_stripes(mask, width)
            error = report(document)["steps"][-1]["estimatedError"]
            check(error < 0.01, f"stripes of {width}: each texel shows one slab, but blending shows: {error}")
        write_mask(mask, 1)
        for name, is_one in (("mask.ppm", True), ("missing.ppm", False)):
            document.write_text(DOCUMENT.replace("mask.ppm", name))
            done = run(MXGEN, document, "--target", "vulkan", "--max-error", fixed / 2, "-Wbudget-step", "-o", f"{folder}/out")
            check(("one slab for the mix" in done.stderr) == is_one, f"{name}: half of the fixed error: {done.stderr}")
        # the cache of checks knows which texels a budget depends on
        document.write_text(DOCUMENT)
        seen = []
        for color in (b"\xff", b"\xff", b"\x80"):
            mask.write_bytes(b"P6 64 64 255\n" + color * 3 * 64 * 64)
            os.utime(mask, (10**9, 10**9 - color[0]))
            os.utime(document, (10**9, 10**9))
            done = run(MXGEN, "check", document, "--no-compile", "-q", "--max-error", fixed / 2, "-Wbudget-step", "--json", "-", "--cache", f"{folder}/cache")
            seen.append([line["message"] for line in json.loads(done.stdout)["documents"][0]["messages"]])
        check(seen[0] == seen[1] != seen[2], f"steps before and after a texture changed: {seen}")
        mask.write_bytes(b"no picture")
        document.write_text(DOCUMENT)
        check(report(document)["notRead"] == ["mask"], "a file that is no picture counts as read")
    else:
        skip("there is no renderer, which reads textures")
finish("slab-texels")
