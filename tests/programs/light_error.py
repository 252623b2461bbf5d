#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The error and the cost of light from an environment by 16 samples. With `--quality good` each material keeps to a bound, and to half of the
texture reads of `reference`, which comes nearer; `draft` is cheaper than both. Against MaterialX's shaders, `good` has their error for half of
their reads. Rough metals keep to a bound by prefiltered maps, too.

Arguments: the build folder, the root of the project, and `materialx` to draw MaterialX's shaders, too, which mxgenpeer on the PATH writes."""
import pathlib
import sys
import tempfile

BUILD, ROOT = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "bench")]
import checks  # pylint: disable=wrong-import-position
import error  # pylint: disable=wrong-import-position

# the mean CIEDE2000 that a material may have under soft boxes in a dark room
BOUNDS = {"bench/standard_surface_default.mtlx": 0.4, "bench/open_pbr_default.mtlx": 0.6, "examples/gold.mtlx": 2.5, "examples/car_paint.mtlx": 4.5,
          "examples/old_copper.mtlx": 6.0, "examples/frosted.mtlx": 2.0}
# the same of white metals by prefiltered maps, by their roughness
PREFILTERED_BOUNDS = {0.5: 4.0, 0.9: 2.0}
METAL = '''<?xml version="1.0"?>
<materialx version="1.39">
  <conductor_bsdf name="lobe" type="BSDF">
    <input name="ior" type="color3" value="0.2, 0.2, 0.2"/>
    <input name="extinction" type="color3" value="4, 4, 4"/>
    <input name="roughness" type="vector2" value="{0}, {0}"/>
  </conductor_bsdf>
  <surface name="surface" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="lobe"/></surface>
  <surfacematerial name="Metal" type="material"><input name="surfaceshader" type="surfaceshader" nodename="surface"/></surfacematerial>
</materialx>
'''
TRUTH = "--samples", "512", "--size", "32"


def write_metal(folder, roughness):
    path = folder / f"metal_{round(100 * roughness)}.mtlx"
    path.write_text(METAL.format(roughness ** 2), encoding="utf-8")
    return path


def main():
    documents = [ROOT / name for name in BOUNDS]
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        has_theirs = sys.argv[3:] == ["materialx"] and error.prepare_theirs(BUILD, folder, documents)
        metals = [write_metal(folder, roughness) for roughness in PREFILTERED_BOUNDS]
        rows = error.draw(BUILD, folder, documents + metals, "studio", TRUTH, width=128)
    if rows is None:
        checks.skip("no Vulkan device")
        checks.finish("light-error")
    if sys.argv[3:] and not has_theirs:
        checks.skip(f"{error.GENERATOR} is not on the PATH: no shader of MaterialX is drawn")
    for document, bound in zip(documents, BOUNDS.values()):
        name = document.stem
        by_way = {row.way: row for row in rows if row.material == name and row.samples == 16}
        draft, good, reference, theirs = (by_way.get(way) for way in (*error.OURS, error.THEIRS))
        print(name, *(f"{way} {row.mean:.2f} ({row.reads:.1f} reads)" for way, row in by_way.items()))
        checks.check(good.mean <= bound, f"{name}: the error is {good.mean:.2f}, and may be {bound}")
        checks.check(reference.mean <= good.mean, f"{name}: `reference` errs by {reference.mean:.2f}, `good` by {good.mean:.2f}")
        checks.check(2 * (good.reads - 1) <= reference.reads, f"{name}: `good` reads {good.reads:.1f} texels, `reference` {reference.reads:.1f}")
        checks.check(draft.reads <= good.reads, f"{name}: `draft` reads {draft.reads:.1f} texels, `good` {good.reads:.1f}")
        if theirs:
            checks.check(good.mean <= 1.1 * theirs.mean + 0.05, f"{name}: `good` errs by {good.mean:.2f}, MaterialX's shader by {theirs.mean:.2f}")
            checks.check(2 * good.reads <= theirs.reads, f"{name}: `good` reads {good.reads:.1f} texels, MaterialX's shader {theirs.reads:.1f}")
    for metal, bound in zip(metals, PREFILTERED_BOUNDS.values()):
        found = next(row.mean for row in rows if row.material == metal.stem and row.way == "prefiltered")
        print(f"{metal.stem}, prefiltered: {found:.2f}")
        checks.check(found <= bound, f"{metal.stem}: by prefiltered maps the error is {found:.2f}, and may be {bound}")
    checks.finish("light-error")


if __name__ == "__main__":
    main()
