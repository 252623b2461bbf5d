#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# mxgen render --bake-occlusion (docs/slots.md): values are those of an integral, and rasters draw them. Arguments: mxgen, mxgen-render.
mxgen=$(realpath "$1") render=$(realpath "$2")
. "$(dirname "$0")/common.sh"
has_device "$render" || { skip 'no Vulkan device'; finish occlusion; }
export MESA_SHADER_CACHE_DISABLE=true

# A floor of 200 x 200 before a wall of 200 x 100, with a small post, twice as large in the world, and a sphere that is far away.
cat >room.usda <<'END'
#usda 1.0
def Xform "room"
{
    double3 xformOp:scale = (2, 2, 2)
    uniform token[] xformOpOrder = ["xformOp:scale"]
    def Mesh "floor"
    {
        point3f[] points = [(-100, 0, -100), (100, 0, -100), (100, 0, 100), (-100, 0, 100), (0, 0, 0), (0, 0, -30), (9, 9, 9)]
        int[] faceVertexCounts = [3, 3, 3, 3, 3]
        int[] faceVertexIndices = [0, 5, 1, 1, 4, 2, 2, 4, 3, 3, 4, 0, 5, 0, 4]
    }
    def Mesh "wall"
    {
        point3f[] points = [(-100, 0, 0.5), (100, 0, 0.5), (100, 100, 0.5), (-100, 100, 0.5)]
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        def GeomSubset "half"
        {
            uniform token elementType = "face"
            int[] indices = [0]
        }
    }
    def Mesh "post"
    {
        point3f[] points = [(50, 0, -95), (50, 0, -94), (50, 1, -94), (50, 1, -95)]
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
    }
    def Sphere "ball"
    {
        double3 xformOp:translate = (0, 100000, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
}
END
check 'a layer is written' exits 0 "$mxgen" render --stage room.usda --bake-occlusion layer.usda --paths 400
check 'with the primitives that have points' eval 'has layer.usda "over \"room\"" "over \"floor\"" "over \"wall\"" && ! grep -q ball layer.usda && has err "'"'/room/ball'"'" "[occlusion-left-out]"'
# The light that a wall hides: the integral of y d / (pi r^4) over it (Lambert's form factor), from a point of the floor at the distance d.
check 'what the wall hides is the integral over it' python3 - layer.usda <<'END'
import re, sys
from math import pi
text = open(sys.argv[1]).read()
floor, wall, post = ([float(x) for x in values.split(", ")] for values in re.findall(r"ambientocclusion = \[(.*?)\] \(interpolation = \"vertex\"\)", text))
def opening(d, step=0.5):
    steps = lambda low, high: (low + step * (i + 0.5) for i in range(int((high - low) / step)))
    return 1 - sum(y * d / (pi * (x * x + y * y + d * d) ** 2) for x in steps(-100, 100) for y in steps(0, 100)) * step * step
for found, expected in ((floor[5], opening(30.5)), (floor[4], opening(3)), (floor[6], 1)):
    assert abs(found - expected) < 0.03, (found, expected)
assert all(0.35 < x < 0.5 for x in post), post # the floor hides half, the wall some
assert len(floor) == 7 and len(wall) == 4 and all(x > 0.9 for x in floor[:2]), (floor, wall)
END
cat >open.mtlx <<'END'
<materialx version="1.39">
  <ambientocclusion name="ao" type="float"/>
  <convert name="grey" type="color3"><input name="in" type="float" nodename="ao"/></convert>
  <surface_unlit name="SR" type="surfaceshader"><input name="emission_color" type="color3" nodename="grey"/></surface_unlit>
  <surfacematerial name="Open" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SR"/></surfacematerial>
  <look name="main"><materialassign name="all" material="Open" geom="/"/></look>
</materialx>
END
# The stage with the values of the layer, as a program that composes them gives it.
python3 - <<'END'
import re
stage, layer = open("room.usda").read(), open("layer.usda").read()
for name in "floor", "wall", "post":
    line = re.search(f'over "{name}"\\s*{{\\s*(.*?\\))\n', layer).group(1)
    stage = stage.replace(f'def Mesh "{name}"\n    {{', f'def Mesh "{name}"\n    {{\n        {line}', 1)
open("composed.usda", "w").write(stage)
END
check 'rasters read it' exits 0 "$mxgen" render open.mtlx --stage composed.usda --ambient-occlusion primvar -s 64 -o open.exr
check 'where it is' eval '! grep missing-primvar err | grep -v /room/ball'
check 'and without it they tell' eval 'exits 0 "$mxgen" render open.mtlx --stage room.usda --ambient-occlusion primvar -s 16 -o none.exr && has err missing-primvar'
cat >row.usda <<'END'
#usda 1.0
def PointInstancer "row"
{
    int[] protoIndices = [0, 0, 0]
    point3f[] positions = [(0, 0, 0), (3, 0, 0), (6, 0, 0)]
    rel prototypes = </row/ball>
    def Sphere "ball" {}
}
def Cube "box" {}
END
check 'what has no points is told once, not for each instance' eval 'exits 0 "$mxgen" render --stage row.usda --bake-occlusion row_layer.usda --paths 1 && [ "$(grep -c "^warning: .*/row/ball.*\[occlusion-left-out\]" err)" = 1 ]'
check 'the stage is not overwritten' eval 'cp room.usda keep.usda && exits 1 "$mxgen" render --stage keep.usda --bake-occlusion keep.usda && has err "[output-clash]" && cmp room.usda keep.usda'
check 'other options mean nothing' eval 'exits 2 "$mxgen" render --stage room.usda --bake-occlusion layer.usda -s 64 && has err "--bake-occlusion renders nothing"'
check 'a stage is needed' exits 2 "$mxgen" render open.mtlx --bake-occlusion layer.usda
check 'a folder must exist' eval 'exits 1 "$mxgen" render --stage room.usda --bake-occlusion none/layer.usda && has err "[output-failed]"'
finish occlusion
