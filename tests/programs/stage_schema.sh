#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Properties of the schemas of USD, and of <geominfo>, in pictures: mxgen render --stage. Argument: mxgen-render.
render=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"
export MESA_SHADER_CACHE_DISABLE=true
if ! has_device "$render"; then
    skip 'no Vulkan device'
    finish stage-schema
fi

. "$here/stage_common.sh"

# ---- Properties of UsdGeom ----

cat >schema.usda <<USD
${head/focalLength = 10/focalLength = 10
    float horizontalApertureOffset = 1
    float verticalApertureOffset = -1}
def Mesh "holes" { rel material:binding = </Red>
    point3f[] points = [(-0.4, -0.4, 0), (0.4, -0.4, 0), (0.4, 0.4, 0), (-0.4, 0.4, 0), (1.4, -0.4, 0), (1.4, 0.4, 0)]
    int[] faceVertexCounts = [4, 4]
    int[] faceVertexIndices = [0, 1, 2, 3, 1, 4, 5, 2]
    int[] holeIndices = [1]
    $(at -2.5 2.5)
}
def PointInstancer "turned" (
    inactiveIds = [2]
) { point3f[] positions = [(-2.5, 0.5, 0), (0.5, 0.5, 0), (2.5, 0.5, 0)]
    int[] protoIndices = [0, 0, 0]
    quath[] orientations = [(1, 0, 0, 0), (1, 0, 0, 0), (1, 0, 0, 0)]
    quatf[] orientationsf = [(0.7071068, 0, 0, 0.7071068), (1, 0, 0, 0), (1, 0, 0, 0)]
    rel prototypes = </turned/bar>
    def Mesh "bar" { rel material:binding = </Green>
        point3f[] points = [(0, -0.2, 0), (1, -0.2, 0), (1, 0.2, 0), (0, 0.2, 0)]
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
    }
}
def Cylinder_1 "bucket" { rel material:binding = </Blue>
    double radiusBottom = 0.2
    double radiusTop = 0.8
    double height = 1
    token axis = "Y"
    $(at -2.5 -2)
}
def Capsule_1 "pear" { rel material:binding = </Red>
    double radiusBottom = 0.6
    double radiusTop = 0.2
    double height = 0.8
    token axis = "Y"
    $(at 0 -2)
}
def Xform "guides" { uniform token purpose = "guide"
    def Mesh "guide" { rel material:binding = </Red>
        $quad
        $(at 2.5 -2)
    }
    def Mesh "drawn" { uniform token purpose = "render"
        rel material:binding = </Blue>
        $quad
        $(at 3.5 -2)
    }
}
USD
check 'properties of the schemas are drawn' draw schema -W no-pattern-unmatched
check 'without a message' test ! -s err
# the frame lies one to the right and one below: all is one to the left and one above
sees 'a face' schema -3.5 3.5 r
sees 'no face that is a hole' schema -2.5 3.5 -
sees 'an instance that is turned in single precision' schema -3.5 2.3 g
sees 'nothing where half precision would turn it' schema -2.7 1.5 -
sees 'another one that is not' schema 0.3 1.5 g
sees 'no instance that is inactive' schema 2.3 1.5 -
sees 'a cylinder, wide above' schema -2.9 -0.6 b
sees 'a cylinder, narrow below' schema -2.9 -1.4 -
sees 'a capsule, wide below' schema -1.5 -1.4 r
sees 'a capsule, narrow above' schema -1.5 -0.6 -
sees 'nothing of a purpose that is no picture' schema 1.5 -1 -
sees 'a purpose of its own before that of its group' schema 2.5 -1 b
printf '#usda 1.0\ndef SkelRoot "body" {\n    def Cube "c" {}\n}\n' >skeleton.usda
check 'joints that move nothing are told' eval 'exits 0 "$render" --stage skeleton.usda -s 16 -o skeleton.ppm && grep -F "[not-drawn]" err | grep -qF "'"'/body'"' is SkelRoot, whose joints"'

# ---- What a document says of geometry ----

# Paint comes of a primvar or a <geominfo>, a picture of a token.
{
    echo '<materialx version="1.39">'
    grep -A6 "name='Gpaint'" colors.mtlx
    for name in red green; do echo "<geominfo name='I$name' geom='/$name'><token name='id' type='string' value='$name'/></geominfo>"; done
    cat <<'XML'
  <geominfo name="IG" geom="/green, /own, /among"><geomprop name="paint" type="color3" value="0, 1, 0"/><geomprop name="number" type="integer" value="0"/></geominfo>
  <geominfo name="IB" geom="/among/deeper"><geomprop name="paint" type="color3" value="0, 0, 1"/></geominfo>
  <geominfo name="IO" geom="/out"><token name="id" type="string" value="/../../black"/></geominfo>
  <image name="picture" type="color3"><input name="file" type="filename" value="of_&lt;id&gt;.ppm"/></image>
  <surface_unlit name="SF" type="surfaceshader"><input name="emission_color" type="color3" nodename="picture"/></surface_unlit>
  <surfacematerial name="Pictured" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SF"/></surfacematerial>
</materialx>
XML
} >geominfo.mtlx
printf 'P3 1 1 255 255 0 0\n' >of_red.ppm
printf 'P3 1 1 255 0 255 0\n' >of_green.ppm
cat >geominfo.usda <<USD
$head
def Mesh "green" { rel material:binding = </Painted>
    $quad
    $(at -3.5 3.5)
}
def Mesh "own" { color3f primvars:paint = (1, 0, 0)
    rel material:binding = </Painted>
    $quad
    $(at -1.5 3.5)
}
def Xform "among" { rel material:binding = </Painted>
    def Mesh "deeper" {
        $quad
        $(at 0.5 3.5)
    }
    def Mesh "beside" {
        $quad
        $(at 2.5 3.5)
    }
}
USD
document=geominfo.mtlx check 'properties of <geominfo> are drawn' draw geominfo
check 'without a message' test ! -s err
sees 'the property of the document' geominfo -3.5 3.5 g
sees "the geometry's own primvar before that of the document" geominfo -1.5 3.5 r
sees 'the property of a deeper primitive' geominfo 0.5 3.5 b
sees 'the property of the primitive above' geominfo 2.5 3.5 g
cat >tokens.usda <<USD
$head
def Mesh "red" { rel material:binding = </Pictured>
    $quad
    $(at -3.5 3.5)
}
def Mesh "green" { rel material:binding = </Pictured>
    $quad
    $(at -1.5 3.5)
}
USD
document=geominfo.mtlx check 'tokens of <geominfo> name files' draw tokens
check 'without a message' test ! -s err
sees 'the file of the first primitive' tokens -3.5 3.5 r
sees 'the file of the second' tokens -1.5 3.5 g
# A unit, a default of tokens, and a property that stands in for colours.
cat >facts.mtlx <<'XML'
<materialx version="1.39">
  <geompropdef name="h" type="float" unittype="distance" unit="centimeter"/>
  <tokendefault name="id" type="string" value="red"/>
  <geominfo name="A" geom="/high"><geomprop name="h" type="float" value="1" unit="meter" unittype="distance"/></geominfo>
  <geominfo name="B" geom="/colored, /own"><geomprop name="geomcolor" type="color3" value="0, 1, 0"/></geominfo>
  <geominfo name="C" geom="/given"><token name="id" type="string" value="green"/></geominfo>
  <geompropvalue name="gh" type="float"><input name="geomprop" type="string" value="h"/></geompropvalue>
  <combine3 name="high" type="color3"><input name="in2" type="float" nodename="gh"/></combine3>
  <geomcolor name="color" type="color3"/>
  <image name="picture" type="color3"><input name="file" type="filename" value="of_&lt;id&gt;.ppm"/></image>
XML
for pair in High:high Colored:color Pictured:picture; do
    echo "  <surface_unlit name='S_${pair%:*}' type='surfaceshader'><input name='emission_color' type='color3' nodename='${pair#*:}'/></surface_unlit>
  <surfacematerial name='${pair%:*}' type='material'><input name='surfaceshader' type='surfaceshader' nodename='S_${pair%:*}'/></surfacematerial>" >>facts.mtlx
done
echo '</materialx>' >>facts.mtlx
mesh() { # NAME MATERIAL X Y [TEXT]
    echo "def Mesh \"$1\" { ${5:-}
    rel material:binding = </$2>
    $quad
    $(at "$3" "$4")
}"
}
{
    echo "$head"
    mesh high High -3.5 3.5
    mesh colored Colored -1.5 3.5
    mesh own Colored 0.5 3.5 'color3f[] primvars:displayColor = [(1, 0, 0)]'
    mesh given Pictured 2.5 3.5
    mesh other Pictured -3.5 1.5
} >facts.usda
document=facts.mtlx check 'units, colours and defaults of tokens are drawn' draw facts
check 'without a message' test ! -s err
sees 'a property in the unit of its definition' facts -3.5 3.5 g
sees 'a colour of the document' facts -1.5 3.5 g
sees "the geometry's own colour before that of the document" facts 0.5 3.5 r
sees 'the token of a <geominfo>' facts 2.5 3.5 g
sees 'the default of a token' facts -3.5 1.5 r
# Without a stage no geometry has a token.
mean() { # NAME: the mean colour
    python3 -c 'import sys; d = open(sys.argv[1], "rb").read().split(None, 4); w, h = int(d[1]), int(d[2]); p = d[4][-3 * w * h:]; print(*(round(sum(p[c::3]) / (w * h)) for c in range(3)))' "$1"
}
check 'the default of a token is drawn without a stage' exits 0 "$render" facts.mtlx -e Pictured -m plane -s 4 --environment none --background none -o plane.ppm
check 'it is the red file' eval 'read -r r g b <<<"$(mean plane.ppm)"; [ "$r" -gt 40 ] && [ "$g" = 0 ] && [ "$b" = 0 ]'
mkdir -p inner/of_
cp geominfo.mtlx of_green.ppm inner
sed 's/"red"/"out"/' tokens.usda >inner/out.usda
check 'the names that tokens make may lead out of the folder' exits 0 "$render" inner/geominfo.mtlx --stage inner/out.usda -s 16 -o out.ppm
check 'a sandbox holds for these names' eval 'exits 1 "$render" inner/geominfo.mtlx --stage inner/out.usda --sandbox -s 16 -o out.ppm && grep -F "[missing-texture]" err | grep -qF "outside"'

finish stage-schema
