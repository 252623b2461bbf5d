#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Stages in pictures: materials of one colour, a camera, and the colours that are seen. For scripts
# that have sourced common.sh and set `render`.

# Materials of one colour each, and two that show primvars.
{
    echo '<materialx version="1.39">'
    while read -r name color; do
        echo "<surface_unlit name='S$name' type='surfaceshader'><input name='emission_color' type='color3' value='$color'/></surface_unlit>
          <surfacematerial name='$name' type='material'><input name='surfaceshader' type='surfaceshader' nodename='S$name'/></surfacematerial>"
    done <<<'Red 1,0,0
Green 0,1,0
Blue 0,0,1'
    for name in paint number; do
        echo "<geompropvalue name='G$name' type='$([ $name = paint ] && echo color3 || echo integer)'><input name='geomprop' type='string' value='$name'/></geompropvalue>"
    done
    cat <<'XML'
  <convert name="asfloat" type="float"><input name="in" type="integer" nodename="Gnumber"/></convert>
  <combine3 name="numbered" type="color3"><input name="in3" type="float" nodename="asfloat"/></combine3>
  <add name="sum" type="color3"><input name="in1" type="color3" nodename="Gpaint"/><input name="in2" type="color3" nodename="numbered"/></add>
  <surface_unlit name="SP" type="surfaceshader"><input name="emission_color" type="color3" nodename="sum"/></surface_unlit>
  <surfacematerial name="Painted" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SP"/></surfacematerial>
  <position name="where" type="vector3"><input name="space" type="string" value="object"/></position>
  <convert name="local" type="color3"><input name="in" type="vector3" nodename="where"/></convert>
  <surface_unlit name="SO" type="surfaceshader"><input name="emission_color" type="color3" nodename="local"/></surface_unlit>
  <surfacematerial name="Object" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SO"/></surfacematerial>
  <look name="parts"><materialassign material="Red" geom="//left"/><materialassign material="Green" geom="//right"/></look>
</materialx>
XML
} >colors.mtlx

# A camera that sees -4..4 at z = 0, over cells of 8 pixels. square NAME X Y: a quad of side 0.8 in a cell.
head='#usda 1.0
( upAxis = "Y" metersPerUnit = 1 )
def Camera "camera"
{
    float focalLength = 10
    float horizontalAperture = 8
    float verticalAperture = 8
    double3 xformOp:translate = (0, 0, 10)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}'
head=${head/\( upAxis = \"Y\" metersPerUnit/(
 upAxis = \"Y\"
 metersPerUnit}
quad='point3f[] points = [(-0.4, -0.4, 0), (0.4, -0.4, 0), (0.4, 0.4, 0), (-0.4, 0.4, 0)]
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]'
at() { printf 'double3 xformOp:translate = (%s, %s, 0)\n    uniform token[] xformOpOrder = ["xformOp:translate"]' "$1" "$2"; }
# cell FILE X Y: which colour is seen there: the letters of the channels above 100, or "-".
cell() {
    python3 - "$@" <<'P'
import sys
data = open(sys.argv[1], "rb").read()
header, pixels = data.split(b"255\n", 1)
width = int(header.split()[1])
x, y = (int((float(v) + 4) * width / 8) for v in sys.argv[2:4])
at = 3 * ((width - 1 - y) * width + x)
print("".join(c for c, v in zip("rgb", pixels[at : at + 3]) if v > 100) or "-")
P
}
# cell_of FILE X Y: the same for a pixel, from the left above.
cell_of() {
    python3 - "$@" <<'P'
import sys
header, pixels = open(sys.argv[1], "rb").read().split(b"255\n", 1)
at = 3 * (int(sys.argv[3]) * int(header.split()[1]) + int(sys.argv[2]))
print("".join(c for c, v in zip("rgb", pixels[at : at + 3]) if v > 100) or "-")
P
}
# colors FILE: the letters of the channels that any pixel has.
colors() {
    python3 - "$1" <<'P'
import sys
pixels = open(sys.argv[1], "rb").read().split(b"255\n", 1)[1]
print("".join(c for i, c in enumerate("rgb") if max(pixels[i::3]) > 100))
P
}
# draw FILE ARGUMENT...: raster and path traced, to FILE.ppm and FILE.path.ppm.
draw() {
    exits 0 "$render" "${document:-colors.mtlx}" --stage "$1.usda" -s 64 --background environment --environment black.ppm -o "$1.ppm" "${@:2}" || return
    exits 0 "$render" "${document:-colors.mtlx}" --stage "$1.usda" -s 64 --background environment --environment black.ppm -o "$1.path.ppm" --path-trace --paths 4 "${@:2}"
}
# sees WHAT FILE X Y COLOUR
sees() {
    local picture
    for picture in "$2.ppm" "$2.path.ppm"; do
        check "$picture shows $1" test "$(cell "$picture" "$3" "$4")" = "$5"
    done
}
printf 'P3 2 1 255 0 0 0 0 0 0\n' >black.ppm
