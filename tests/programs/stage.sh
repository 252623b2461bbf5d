#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Scenes in pictures: mxgen render --stage. Argument: mxgen-render.
render=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"
export MESA_SHADER_CACHE_DISABLE=true
if ! has_device "$render"; then
    skip 'no Vulkan device'
    finish stage
fi

. "$here/stage_common.sh"

cat >scene.usda <<USD
$head
def Mesh "plain" { rel material:binding = </Red>
    $quad
    $(at -3.5 3.5)
}
def Xform "moved" { rel material:binding = </Green>
    float xformOp:rotateZ = 90
    double3 xformOp:translate = (3.5, 2.5, 0)
    uniform token[] xformOpOrder = ["xformOp:rotateZ", "xformOp:translate"]
    def Mesh "below" {
        $quad
    }
    def Mesh "hidden" { token visibility = "invisible"
        $quad
        double3 xformOp:translate = (-1, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def Mesh "reset" {
        $quad
        matrix4d xformOp:transform = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (-1.5, 3.5, 0, 1))
        uniform token[] xformOpOrder = ["!resetXformStack!", "xformOp:transform"]
    }
}
def Mesh "parts" { rel material:binding = </Red>
    point3f[] points = [(-0.4, -0.4, 0), (0.4, -0.4, 0), (0.4, 0.4, 0), (-0.4, 0.4, 0), (1.4, -0.4, 0), (1.4, 0.4, 0)]
    int[] faceVertexCounts = [4, 4]
    int[] faceVertexIndices = [0, 1, 2, 3, 1, 4, 5, 2]
    $(at 0.5 3.5)
    def GeomSubset "second" { rel material:binding = </Blue>
        uniform token elementType = "face"
        uniform token familyName = "materialBind"
        int[] indices = [1]
    }
}
def Xform "colors" { color3f primvars:paint = (0, 1, 0)
    rel material:binding = </Painted>
    int primvars:number = 0
    def Mesh "inherits" {
        $quad
        $(at -3.5 0.5)
    }
    def Mesh "by_face" { int[] primvars:number = [0, 1] (
            interpolation = "uniform"
        )
        point3f[] points = [(-0.4, -0.4, 0), (0.4, -0.4, 0), (0.4, 0.4, 0), (-0.4, 0.4, 0), (1.4, -0.4, 0), (1.4, 0.4, 0)]
        int[] faceVertexCounts = [4, 4]
        int[] faceVertexIndices = [0, 1, 2, 3, 1, 4, 5, 2]
        $(at -1.5 0.5)
    }
    def Mesh "indexed" { color3f[] primvars:paint = [(1, 0, 0), (0, 0, 1)] (
            interpolation = "faceVarying"
        )
        int[] primvars:paint:indices = [0, 1, 1, 0]
        $quad
        $(at 1.5 0.5)
    }
}
def Sphere "ball" { rel material:binding = </Red>
    double radius = 0.4
    $(at -3.5 -1.5)
}
def Cube "cube" { rel material:binding = </Green>
    double size = 0.8
    $(at -2.5 -1.5)
}
def Cylinder "cylinder" { rel material:binding = </Blue>
    double radius = 0.3
    double height = 1.8
    token axis = "X"
    $(at -1 -1.5)
}
def Cone "cone" { rel material:binding = </Red>
    double radius = 0.4
    double height = 0.9
    token axis = "Y"
    $(at 0.5 -1.5)
}
def Capsule "capsule" { rel material:binding = </Green>
    double radius = 0.2
    double height = 0.5
    token axis = "Y"
    $(at 1.5 -1.5)
}
def Plane "plane" { rel material:binding = </Blue>
    double width = 0.8
    double length = 0.8
    $(at 2.5 -1.5)
}
def PointInstancer "many" { point3f[] positions = [(-3.5, -3.5, 0), (-2.5, -3.5, 0), (-1.5, -3.5, 0)]
    int[] protoIndices = [1, 0, 0]
    int64[] invisibleIds = [2]
    rel prototypes = [</many/a>, </many/b>]
    def Mesh "a" { rel material:binding = </Red>
        $quad
    }
    def Mesh "b" { rel material:binding = </Green>
        $quad
    }
}
over "Flattened_Prototype_1" {
    def Mesh "leaf" {
        $quad
    }
}
def Xform "instance" (
    instanceable = true
    references = </Flattened_Prototype_1>
) { rel material:binding = </Blue>
    $(at 0.5 -3.5)
}
def Mesh "local" { rel material:binding = </Object>
    point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    $(at 2 -4)
}
USD
sed 's|<look .*</look>|<look name="l"><materialassign material="Blue" geom="/many[7]"/></look>|' colors.mtlx >one.mtlx
sed 's|int64\[\] invisibleIds = \[2\]|int64[] ids = [8, 16777217, 7]|' scene.usda >ids.usda
# the look of colors.mtlx is for another stage
check 'a stage with bindings of its own is drawn' draw scene -W no-pattern-unmatched
check 'the stage gives no message' test ! -s err
check 'a look that names an instance is drawn' exits 0 "$render" one.mtlx --stage ids.usda -s 64 -o ids.ppm
check 'the instance of the id has its layer' eval '[ "$(cell ids.ppm -1.5 -3.5)" = b ]'
check 'others have those of their prototypes' eval '[ "$(cell ids.ppm -2.5 -3.5)" = r ]'
check 'the first one is of the other prototype' eval '[ "$(cell ids.ppm -3.5 -3.5)" = g ]'
sed 's|<look .*</look>|<look name="l"><materialassign material="Blue" geom="//" slot="050"/></look>|' colors.mtlx >two.mtlx
check 'a slot may be muted' exits 0 "$render" two.mtlx --stage scene.usda -s 64 --mute 050 -o mute.ppm
check 'what is below shows' eval '[ "$(cell mute.ppm -2.5 -3.5)" = r ]'
check 'a slot may be alone' exits 0 "$render" two.mtlx --stage scene.usda -s 64 --solo 050 -o solo.ppm
check 'it is above' eval '[ "$(cell solo.ppm -2.5 -3.5)" = b ]'
check 'an unknown slot is an error' eval 'exits 1 "$render" two.mtlx --stage scene.usda -s 64 --mute 060 -o none.ppm && grep -qF "[unknown-slot]" err'
sed 's|<surface_unlit name=.SBlue.|<ambientocclusion name="ao" type="float"/><surface_unlit name="SBlue"|; s|value=.0,0,1./>|&<input name="emission" type="float" nodename="ao"/>|' two.mtlx >open.mtlx
check 'occlusion that a stage lacks is told once' eval 'exits 0 "$render" open.mtlx --stage scene.usda -s 64 -o open.ppm && [ "$(grep -c "\[missing-primvar\]" err)" = 1 ] && grep -qF "which the slot '"'050'"' reads; rasters compute no occlusion, so 1 (open) stands in" err'
check 'and 1 stands in' eval '[ "$(cell open.ppm -2.5 -3.5)" = b ]'
printf '#usda 1.0\ndef Cube "c" {}\ndef NurbsPatch "p" {\n    point3f[] points = [(0, 0, 0)]\n}\ndef BasisCurves "a" {\n    token type = "linear"\n}\ndef BasisCurves "b" {}\n' >undrawn.usda
check 'geometry that is not drawn is told beside what is' eval 'exits 0 "$render" --stage undrawn.usda -s 16 -o undrawn.ppm && grep -F "[not-drawn]" err >told; grep -qF "(undrawn.usda:4) is NurbsPatch, which mxgen does not draw" told && grep -qF "(undrawn.usda:7) and 1 more are BasisCurves" told'
sees 'a mesh with its material' scene -3.5 3.5 r
sees 'nothing below it' scene -3.5 2.5 -
sees 'transforms in their order, for children' scene -2.5 3.5 g
sees 'nothing that is invisible' scene -2.5 2.5 -
sees 'a transform that begins anew' scene -1.5 3.5 g
sees 'the faces of a mesh' scene 0.5 3.5 r
sees 'the faces of a subset' scene 1.5 3.5 b
sees 'a primvar of the group above' scene -3.5 0.5 g
sees 'a primvar of faces, first' scene -1.5 0.5 g
sees 'a primvar of faces, second' scene -0.5 0.5 gb
sees 'a primvar of corners with indices, left' scene 1.2 0.5 r
sees 'a primvar of corners with indices, right' scene 1.8 0.5 b
sees 'a sphere' scene -3.5 -1.5 r
sees 'a sphere that is round' scene -3.95 -1.15 -
sees 'a cube' scene -2.5 -1.5 g
sees 'a cylinder along x' scene -0.2 -1.5 b
sees 'a cone, wide below' scene 0.25 -1.85 r
sees 'a cone, pointed above' scene 0.25 -1.15 -
sees 'a capsule' scene 1.5 -1.1 g
sees 'a plane' scene 2.5 -1.5 b
sees 'an instance of the second prototype' scene -3.5 -3.5 g
sees 'an instance of the first' scene -2.5 -3.5 r
sees 'no instance with an invisible id' scene -1.5 -3.5 -
sees 'no prototype by itself' scene 0 0 -
sees 'an instance of a reference' scene 0.5 -3.5 b
sees 'the object space, right below' scene 2.9 -3.8 r
sees 'the object space, left above' scene 2.1 -3.1 g

# z upwards, and a camera of the studio around it: the cube above is green.
cat >upright.usda <<'USD'
#usda 1.0
(
    upAxis = "Z"
)
def Cube "low" { rel material:binding = </Red> }
def Cube "high" { rel material:binding = </Green>
    double3 xformOp:translate = (0, 0, 2)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
USD
check 'a stage with z upwards is drawn' draw upright --camera 30,0
sees 'what is above' upright 0 1 g
sees 'what is below' upright 0 -1 r

# Tangents are smooth over faces, though faces do not share vertices: beside the edge the left face has some of the right one's.
cat >tangents.mtlx <<'XML'
<materialx version="1.39">
  <tangent name="t" type="vector3"><input name="space" type="string" value="world"/></tangent>
  <convert name="c" type="color3"><input name="in" type="vector3" nodename="t"/></convert>
  <surface_unlit name="S" type="surfaceshader"><input name="emission_color" type="color3" nodename="c"/></surface_unlit>
  <surfacematerial name="Along" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
  <look name="l"><materialassign material="Along" geom="/m"/></look>
</materialx>
XML
cat >tangents.usda <<USD
$head
def Mesh "m" {
    point3f[] points = [(-3, -2, 0), (0, -2, 0), (0, 2, 0), (-3, 2, 0), (3, -2, 0), (3, 2, 0)]
    int[] faceVertexCounts = [4, 4]
    int[] faceVertexIndices = [0, 1, 2, 3, 1, 4, 5, 2]
    normal3f[] normals = [(0, 0, 1), (0, 0, 1), (0, 0, 1), (0, 0, 1), (0, 0, 1), (0, 0, 1)]
    texCoord2f[] primvars:st = [(0, 0), (3, 0), (3, 4), (0, 4), (6, -3), (6, 1)] (
        interpolation = "vertex"
    )
}
USD
check 'a mesh with texture coordinates is drawn' env document=tangents.mtlx bash -c "$(declare -f draw exits); render='$render'; draw tangents --look l"
sees 'the tangent of the left face' tangents -2.8 0 r
sees 'of the right face' tangents 2.8 0 rg
sees 'smooth in between' tangents -0.2 0 rg
# indexed SED: the normals of the mesh as one value with indices; the script changes them
indexed() {
    sed "s|normal3f\[\] normals = .*|normal3f[] primvars:normals = [(0, 0, 1)] ( interpolation = \"vertex\" )\n    int[] primvars:normals:indices = [0, 0, 0, 0, 0, 0]|; $1" tangents.usda >indexed.usda
    "$render" tangents.mtlx --stage indexed.usda --look l --camera 0,0 -s 64 -o indexed.ppm 2>err
}
"$render" tangents.mtlx --stage tangents.usda --look l --camera 0,0 -s 64 -o plain.ppm
check 'normals may have indices' eval "indexed '' && cmp indexed.ppm plain.ppm"
check 'an index without a normal is an error' eval "! indexed 's/0, 0, 0\]/0, 0, 1]/' && grep -q 'indexed.usda:.*has an index without a value' err"
check 'one normal may stand for all' eval 'sed "s|normal3f\[\] normals = .*|normal3f[] normals = [(0, 0, 1)] ( interpolation = \"constant\" )|" tangents.usda >constant.usda && exits 0 "$render" tangents.mtlx --stage constant.usda --look l --camera 0,0 -s 64 -o constant.ppm && cmp constant.ppm plain.ppm'
check 'also as a primvar without a word' eval 'sed "s|normal3f\[\] normals = .*|normal3f[] primvars:normals = [(0, 0, 1)]|" tangents.usda >constant.usda && exits 0 "$render" tangents.mtlx --stage constant.usda --look l --camera 0,0 -s 64 -o constant.ppm && cmp constant.ppm plain.ppm'

# Groups of a file of Assimp, assigned by a look.
cat >two.obj <<'OBJ'
v -1 -1 0
v 0 -1 0
v 0 1 0
v -1 1 0
v 1 -1 0
v 1 1 0
g left
f 1 2 3 4
g right
f 2 5 6 3
OBJ
for more in '' '--path-trace --paths 4'; do
    # shellcheck disable=SC2086
    check "groups of OBJ are drawn $more" exits 0 "$render" colors.mtlx --stage two.obj --look parts --camera 0,0 -s 64 -o two.ppm $more
    check 'the left group has its material' test "$(cell two.ppm -1 0)" = r
    check 'the right group has its material' test "$(cell two.ppm 1 0)" = g
done

# Colours of vertices follow the corners, which have projected texture coordinates.
cat >painted.obj <<'OBJ'
v -1 -1 0 1 0 0
v -0.1 -1 0 1 0 0
v -0.1 1 0 1 0 0
v -1 1 0 1 0 0
v 0.1 -1 0 0 0 1
v 1 -1 0 0 0 1
v 1 1 0 0 0 1
v 0.1 1 0 0 0 1
f 1 2 3 4
f 5 6 7 8
OBJ
sed "s/value='paint'/value='displayColor'/; s/material=\"Red\" geom=\"[^\"]*\"/material=\"Painted\" geom=\"\/\"/" colors.mtlx >painted.mtlx
check 'an OBJ with colours of vertices is drawn' exits 0 "$render" painted.mtlx --stage painted.obj --look parts --camera 0,0 -s 64 -o painted.ppm \
    --background environment --environment black.ppm
check 'each corner has the colour of its vertex' test "$(colors painted.ppm) $(cell painted.ppm -1 0)$(cell painted.ppm 1 0)" = 'rb rb'

# fails ID TEXT ARGUMENT...
fails() { exits 1 "$render" "${@:3}" -s 16 -o no.ppm && grep -F "[$1]" err | grep -qF "$2"; }
broken() { sed "$1" scene.usda >broken.usda && ! cmp -s scene.usda broken.usda && fails bad-geometry "$2" colors.mtlx --stage broken.usda; }
check 'an index without a point is an error' broken '0,/faceVertexIndices = \[0, 1, 2, 3\]/s//faceVertexIndices = [0, 1, 2, 4]/' "'/plain.faceVertexIndices' (broken.usda:"
check 'a wrong number of corners is an error' broken '0,/faceVertexCounts = \[4\]/s//faceVertexCounts = [5]/' 'faceVertexCounts asks for another number'
check 'a primvar with too few values is an error' broken 's/primvars:number = \[0, 1\]/primvars:number = [0]/' "'uniform'"
check 'an unknown operation of a transform is an error' broken 's/\["xformOp:rotateZ", /["xformOp:spin", /' 'xformOp:spin'
check 'a prototype that is missing is an error' broken 's/protoIndices = \[1, 0, 0\]/protoIndices = [2, 0, 0]/' 'protoIndices'
check 'an instance without a prototype is an error' broken 's/protoIndices = \[1, 0, 0\]/protoIndices = [1, 0]/' 'has 2 numbers for 3 positions'
check 'a face that the mesh lacks is an error' broken 's/int\[\] indices = \[1\]/int[] indices = [2]/' 'the mesh has 2 faces'
check 'an infinite radius is an error' broken '0,/def Sphere "[a-z]*" {/s//&\n    double radius = inf/' "has inf; expected a finite number"
check 'NaN among points is an error with its place' broken '0,/(0.4, -0.4, 0)/s//(0.4, nan, 0)/' "/plain.points' (broken.usda:"
check 'the error counts the numbers' grep -qF 'has nan as number 5 of 12' err

# 20 km in centimetres: all of the scene far from the origin, with a light beside it.
{
    echo "${head/double3 xformOp:translate = (0, 0, 10)/double3 xformOp:translate = (1000000, 2000000, 50010)}"
    echo "def Xform \"far\" { double3 xformOp:translate = (1000000, 2000000, 50000)
    uniform token[] xformOpOrder = [\"xformOp:translate\"]
    def Mesh \"a\" { rel material:binding = </Red>
        $quad
        $(at -3.5 3.5)
    }
    def Sphere \"b\" { rel material:binding = </Green>
        double radius = 0.4
        $(at -2.5 3.5)
    }
    def Mesh \"c\" { rel material:binding = </Object>
        point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        $(at 2 -4)
    }
}"
} >far.usda
check 'a scene far from the origin is drawn' draw far
sees 'a mesh far away' far -3.5 3.5 r
sees 'a sphere far away' far -2.5 3.5 g
sees 'nothing beside the sphere' far -2.95 3.95 -
sees 'the object space far away, right below' far 2.9 -3.8 r
sees 'the object space far away, left above' far 2.1 -3.1 g

# Displacement of instances: a vector is along the tangent of each one, over units of the world; a cube that grows is closed at its edges:
# through a gap at the edge in front one would see the one behind, and the background.
moves() { sed "s|</materialx>|<displacement name='D' type='displacementshader'><input name='displacement' type='$1' value='$2'/></displacement>\
  <surfacematerial name='Moved' type='material'><input name='surfaceshader' type='surfaceshader' nodename='SRed'/>\
    <input name='displacementshader' type='displacementshader' nodename='D'/></surfacematerial></materialx>|" colors.mtlx; }
moves vector3 '1, 0, 0' >aside.mtlx
moves float 0.5 >grown.mtlx
cat >aside.usda <<USD
$head
def PointInstancer "many" {
    point3f[] positions = [(-3.5, 3.5, 0), (-2.5, 0.5, 0), (0.5, 3.5, 0), (0.5, 0.5, 0), (3.5, -2.5, 0)]
    quath[] orientations = [(1, 0, 0, 0), (0.7071, 0, 0, 0.7071), (0, 0, 0, 1), (1, 0, 0, 0), (1, 0, 0, 0)]
    float3[] scales = [(1, 1, 1), (1, 1, 1), (1, 1, 1), (2, 1, 1), (-1, 1, 1)]
    int[] protoIndices = [0, 0, 0, 0, 0]
    rel prototypes = [</many/a>]
    def Mesh "a" { rel material:binding = </Moved>
        $quad
        texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] ( interpolation = "vertex" )
    }
}
USD
document=aside.mtlx
check 'instances with a vector displacement are drawn' draw aside -W no-pattern-unmatched
sees 'an instance along its tangent' aside -2.5 3.5 r
sees 'nothing where it was' aside -3.5 3.5 -
sees 'one that is turned along its own tangent' aside -2.5 1.5 r
sees 'nothing where that was' aside -2.5 0.5 -
sees 'one that is turned around' aside -0.5 3.5 r
sees 'the right end of one that is wider, a unit further' aside 2.2 0.5 r
sees 'nothing where its left end was' aside -0.2 0.5 -
sees 'a mirrored one against the direction' aside 2.5 -2.5 r
cat >edges.usda <<USD
$head
def PointInstancer "many" {
    point3f[] positions = [(0, 0, 0)]
    quath[] orientations = [(0.92388, 0, 0.382683, 0)]
    float3[] scales = [(3, 3, 3)]
    int[] protoIndices = [0]
    rel prototypes = [</many/a>]
    def Cube "a" { rel material:binding = </Moved>
    }
}
USD
document=grown.mtlx
check 'an instance of a cube that grows is drawn' draw edges -W no-pattern-unmatched
document=
for x in -0.1 0.1; do
    sees 'no gap at an edge' edges $x 0 r
done

# Primvars of instances, and primvars of another type than is read.
cat >primvars.usda <<USD
$head
def PointInstancer "many" { point3f[] positions = [(-3.5, 3.5, 0), (-2.5, 3.5, 0), (-1.5, 3.5, 0)]
    int[] protoIndices = [0, 0, 1]
    rel prototypes = [</many/a>, </many/b>]
    color3f[] primvars:paint = [(1, 0, 0), (0, 1, 0)] ( interpolation = "vertex" )
    int[] primvars:paint:indices = [1, 0, 0]
    int primvars:number = 0
    def Mesh "a" { rel material:binding = </Painted>
        $quad
    }
    def Mesh "b" { rel material:binding = </Painted>
        $quad
        color3f primvars:paint = (0, 1, 1)
    }
}
def Mesh "short" { rel material:binding = </Painted>
    $quad
    float primvars:paint = 1
    string primvars:number = "one"
    $(at -0.5 3.5)
}
USD
check 'instances with primvars are drawn' draw primvars
sees 'the value of the first instance' primvars -3.5 3.5 g
sees 'that of the second' primvars -2.5 3.5 r
sees 'that of the prototype itself' primvars -1.5 3.5 gb
exits 0 "$render" colors.mtlx --stage primvars.usda -s 16 -o primvars16.ppm
check 'a primvar of fewer numbers has a warning' eval "grep -F '[primvar-type]' err | grep -qF \"the primvar 'paint' of '/short' (primvars.usda:35:11) has the type 'float'\""
check 'so has one that is a text' eval "grep -F '[primvar-type]' err | grep -qF \"'number' of '/short' (primvars.usda:36:12) has the type 'string'\""
check 'a primvar that is there is not missing' eval '! grep -qF "[missing-primvar]" err'

# One number for the whole picture picks a layer: the upper one, which has a mask, below 0.5.
cat >picked.mtlx <<'XML'
<materialx version="1.39">
  <xi:include xmlns:xi="http://www.w3.org/2001/XInclude" href="colors.mtlx"/>
  <substance name="Half" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SGreen"/><input name="mask" type="float" value="0.5"/></substance>
  <look name="layers"><materialassign material="Red" geom="/"/><materialassign slot="050" material="Half" geom="/"/></look>
</materialx>
XML
for number in 0 0.499 0.5 0.999; do
    check "a picture is drawn with --layer-sample $number" exits 0 "$render" picked.mtlx --stage two.obj --look layers --slots stochastic --layer-sample $number \
        -s 64 --camera 0,0 --background environment --environment black.ppm -o picked.ppm
    check 'the number picks the layer' test "$(colors picked.ppm)" = "$(case $number in 0 | 0.499) echo g ;; *) echo r ;; esac)"
done
check 'a picture is drawn without --layer-sample' exits 0 "$render" picked.mtlx --stage two.obj --look layers --slots stochastic \
    -s 64 --camera 0,0 --background environment --environment black.ppm -o picked.ppm
check 'each point picks a layer of its own' test "$(colors picked.ppm)" != r -a "$(colors picked.ppm)" != g

check 'a primvar that is missing is a warning' eval 'sed "/int primvars:number = 0/d" scene.usda >lacking.usda; exits 0 "$render" colors.mtlx --stage lacking.usda -s 16 -o no.ppm && grep -qF "[missing-primvar]" err'
check 'an unknown camera is an error that lists cameras' fails unknown-camera "there is '/camera'" colors.mtlx --stage scene.usda --camera /kamera
check 'a camera is found by its path' exits 0 "$render" colors.mtlx --stage scene.usda --camera /camera -s 16 -o yes.ppm
check 'a stage without geometry is an error' eval 'printf "#usda 1.0\n" >empty.usda; fails empty-mesh empty.usda colors.mtlx --stage empty.usda'
check 'a syntax error of the stage is an error' eval 'echo "def x" >>empty.usda; fails usda-syntax empty.usda:2:6 colors.mtlx --stage empty.usda'
check 'an option that a stage does not take is wrong usage' exits 2 "$render" colors.mtlx --stage scene.usda --mesh cube -o no.ppm
check 'a purpose without a stage is wrong usage' exits 2 "$render" colors.mtlx --purpose full -o no.ppm

# One root, and a camera, of glTF: paths as in the file.
cat >one.gltf <<'JSON'
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
 "min": [0, 0, 0], "max": [1, 1, 0]}], "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36,
 "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.79757, "aspectRatio": 2, "znear": 0.1}}],
 "nodes": [{"name": "set", "children": [1, 2]}, {"name": "left", "mesh": 0}, {"name": "eye", "camera": 0, "translation": [0, 0, 10]}]}
JSON
printf '/set\n/set/left\n/set/eye\n' >paths
check 'the paths of glTF are those of the file' eval '"$render" --stage one.gltf --list >out && diff paths out'
check 'a stage of glTF is drawn' exits 0 "$render" colors.mtlx --stage one.gltf --look parts -s 128x64 --background environment --environment black.ppm -o one.ppm
# The camera sees 8.43 units of height at 0: the triangle, of one unit, begins in the middle, and goes right and up.
check 'a stage of glTF is seen through its camera' eval 'test "$(cell_of one.ppm 66 30)$(cell_of one.ppm 62 30)$(cell_of one.ppm 66 34)$(cell_of one.ppm 72 24)" = "r---"'
check 'a list without a stage is wrong usage' exits 2 "$render" --list
check 'a list of a file that is missing fails' exits 1 "$render" --stage none.gltf --list
check 'the error is bad-mesh' grep -qF '[bad-mesh]' err
# ---- Points ----

{
    cat <<<"$head"
    cat <<'USD'
def Points "dots" {
    rel material:binding = </Painted>
    point3f[] points = [(-2, 0, 0), (0, 0, 0), (2, 0, 0)]
    float[] widths = [1, 2, 0.2]
    color3f[] primvars:paint = [(1, 0, 0), (0, 1, 0), (0, 0, 1)] ( interpolation = "vertex" )
    int primvars:number = 0
}
def Points "plain" {
    rel material:binding = </Red>
    point3f[] points = [(0, 3, 0)]
}
USD
} >points.usda
check 'points are drawn' draw points -W no-pattern-unmatched
check 'without a message' test ! -s err
for place in '-2 0 r' '-1.7 0 r' '-1.3 0 -' '0 0 g' '0.8 0 g' '0 1.2 -' '2 0 b' '2.3 0 -' '0 3 r' '0 3.3 r' '0.7 3 -'; do
    read -r x y color <<<"$place"
    sees "a point or none at $x, $y" points "$x" "$y" "$color"
done
check 'widths for other points are an error' eval 'sed "s/\[1, 2, 0.2\]/[1, 2]/" points.usda >widths.usda; exits 1 "$render" colors.mtlx --stage widths.usda -s 16 -o widths.ppm && grep -F "[bad-geometry]" err | grep -qF "has 2 numbers for 3 points"'

# ---- Many objects ----

# spheres NUM: as many instances, and as many prims
spheres() {
    python3 - "$1" <<'P'
import sys
num = int(sys.argv[1])
places = [(i % 50 * 3, i // 50 * 3, 0) for i in range(num)]
print('#usda 1.0\ndef PointInstancer "many" {\n    int[] protoIndices =', [0] * num, '\n    point3f[] positions =', places)
print('    rel prototypes = </many/s>\n    def Sphere "s" {}\n}\ndef Xform "row" {')
for x, y, z in places:
    print(f'    def Sphere "s_{x}_{y}" {{\n        double3 xformOp:translate = ({x}, {y}, 5)\n        uniform token[] xformOpOrder = ["xformOp:translate"]\n    }}')
print('}')
P
}
# peak FILE: the most memory that reading takes, in KiB; the memory of drawing is the driver's
peak() { python3 -c 'import resource, subprocess, sys; subprocess.run(sys.argv[1:], check=True, stdout=subprocess.DEVNULL); print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)' "$render" --stage "$1" --list; }
spheres 1 >one.usda
spheres 1000 >thousand.usda
check 'equal spheres share their mesh: each needs less than 4 KiB' eval '[ $(($(peak thousand.usda) - $(peak one.usda))) -lt $((2 * 999 * 4)) ]'
check 'they are drawn' exits 0 "$render" --stage thousand.usda -s 32 -o thousand.ppm

finish stage
