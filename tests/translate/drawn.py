#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How far a translated material looks from its source: mxgen translate --accept. Arguments: mxgen, the root of the project, a folder of
further documents (skipped if it is absent)."""
import pathlib
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish, skip

MXGEN, ROOT, FURTHER = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
# a document, a model, and the error that it may have (mean CIEDE2000 of three views)
LIMITS = [
    (ROOT / "examples/marble.mtlx", "open_pbr_surface", "0.05"),
    (FURTHER / "StandardSurface/standard_surface_carpaint.mtlx", "open_pbr_surface", "0.05"),
    (FURTHER / "StandardSurface/standard_surface_jade.mtlx", "gltf_pbr", "1.2"),
    (FURTHER / "GltfPbr/gltf_pbr_boombox.mtlx", "standard_surface", "0.5"),
    # closures
    (ROOT / "examples/car_paint.mtlx", "open_pbr_surface", "0.1"),
    (ROOT / "examples/frosted.mtlx", "gltf_pbr", "1.6"),
]

with tempfile.TemporaryDirectory() as folder:
    out = pathlib.Path(folder) / "out.mtlx"
    for color, limit in ("0.5, 0.5, 0.5", "1.5"), ("0.8, 0.2, 0.1", "4"): # partly glass: the colour of the diffuse light counts
        glass = pathlib.Path(folder) / "glass.mtlx"
        glass.write_text('<?xml version="1.0"?><materialx version="1.39"><UsdPreviewSurface name="S" type="surfaceshader">'
                         f'<input name="diffuseColor" type="color3" value="{color}"/><input name="opacity" type="float" value="0.5"/></UsdPreviewSurface>'
                         '</materialx>', encoding="utf-8")
        LIMITS.append((glass.rename(glass.with_name(f"glass{limit}.mtlx")), "gltf_pbr", limit))
    for path, model, limit in LIMITS:
        if not path.exists():
            skip(f"{path} is absent")
            continue
        done = subprocess.run([MXGEN, "translate", path, "--to", model, "--accept", limit, "-o", out], capture_output=True, text=True, check=False)
        check(done.returncode == 0 and "drawn error" in done.stderr, f"{path.name} as {model}: {done.stderr}")
    done = subprocess.run([MXGEN, "translate", ROOT / "examples/gold.mtlx", "--to", "gltf_pbr", "--accept", "0.001", "-o", out],
                          capture_output=True, text=True, check=False)
    check(done.returncode == 1 and "[translation-error]" in done.stderr, "an error above the limit fails")
    for limit, code in (("2", 0), ("0.001", 1)):
        done = subprocess.run([MXGEN, "check", ROOT / "examples/gold.mtlx", "--no-compile", "--translate", "gltf_pbr", "--accept", limit], capture_output=True, text=True, check=False)
        check(done.returncode == code and ("[translation-error]" in done.stdout) == (code == 1), f"a check accepts {limit}: {done.stdout}")
finish("translate-drawn")
