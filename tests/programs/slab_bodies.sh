#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Light in the meshes of bodies of slabs, path traced: white bodies lose no light, clear ones take what Beer and Lambert say of the way
# through the mesh and in colour, thick ones reflect their albedo, and thin ones shine through. Arguments: mxgen-render, the root of the source tree.
render=$(realpath "$1") root=$(realpath "$2")
. "$root/tests/programs/light.sh"
export MESA_SHADER_CACHE_DISABLE=true

# trace FILE ELEMENT ARGUMENT...: a ball in even light, from far away.
trace() {
    exits 0 "$render" bodies.mtlx -e "$2" -q --path-trace -o "$1" -m sphere --lights none --environment white.hdr --camera 0,0,60,2.2 \
        --size 24 --bounces 64 "${@:3}"
}

if ! has_device "$render"; then
    skip 'there is no Vulkan device'
    finish slab_bodies
fi

write_white white.hdr
# slab NAME ALBEDO MEAN-FREE-PATH F0 [INPUTS]
slab() {
    echo "<slab name='$1' type='BSDF'><input name='diffuse_albedo' type='color3' value='$2'/><input name='mean_free_path' type='vector3' value='$3'/>
      <input name='f0' type='color3' value='$4, $4, $4'/>${5:-}</slab>"
}
# body NAME BSDF
body() {
    echo "<slab_surface name='S$1' type='surfaceshader'><input name='bsdf' type='BSDF' nodename='$2'/></slab_surface>
      <surfacematerial name='$1' type='material'><input name='surfaceshader' type='surfaceshader' nodename='S$1'/></surfacematerial>"
}
# operator KIND NAME A B NUMBER: of the inputs that the kind has.
operator() {
    local names
    case $1 in
        slab_layer) names='top base thickness' ;;
        slab_mix) names='fg bg mix' ;;
        slab_coverage) names='in - weight' ;;
    esac
    set -- "$@" $names
    echo "<$1 name='$2' type='BSDF'><input name='$6' type='BSDF' nodename='$3'/>"
    [ "$7" = - ] || echo "<input name='$7' type='BSDF' nodename='$4'/>"
    echo "<input name='$8' type='float' value='$5'/></$1>"
}
{
    echo '<materialx version="1.39">'
    slab white '1, 1, 1' '0.2, 0.4, 0.8' 0
    slab shiny '1, 1, 1' '0.3, 0.3, 0.3' 0.04 "<input name='phase_anisotropy' type='float' value='0.5'/>"
    slab milk '1, 1, 1' '0.02, 0.02, 0.02' 0.04
    slab chalk '1, 1, 1' '0, 0, 0' 0.04
    slab clear '0, 0, 0' '1, 1, 1' 0
    slab amber '0, 0, 0' '1, 1, 1' 0.04
    slab tinted '0, 0, 0' '10, 2, 1' 0
    slab thin '0, 0, 0' '2, 2, 2' 0
    slab thinner '0, 0, 0' '4, 4, 4' 0
    slab thick '0.8, 0.5, 0.2' '0.002, 0.002, 0.002' 0
    slab wax '1, 1, 1' '0.1, 0.1, 0.1' 0
    operator slab_layer coated milk shiny 0.02
    operator slab_mix mixed shiny chalk 0.5
    operator slab_coverage half shiny - 0.5
    for name in white clear thick wax coated mixed half amber tinted thin thinner; do body "${name^}" $name; done
    echo "<oren_nayar_diffuse_bsdf name='paint' type='BSDF'><input name='color' type='color3' value='1, 1, 1'/></oren_nayar_diffuse_bsdf>
      <surface name='SPaper' type='surfaceshader'><input name='bsdf' type='BSDF' nodename='paint'/></surface>
      <surfacematerial name='Paper' type='material'><input name='surfaceshader' type='surfaceshader' nodename='SPaper'/></surfacematerial>
      <look name='inside'><materialassign material='White' geom='//outer'/><materialassign material='Paper' geom='//inner'/></look>
      <look name='scattering'><materialassign material='White' geom='//outer'/><materialassign material='Coated' geom='//middle'/>
        <materialassign material='Wax' geom='//inner'/></look>
      <look name='absorbing'><materialassign material='Clear' geom='//outer'/><materialassign material='Thin' geom='//middle'/>
        <materialassign material='Thinner' geom='//inner'/><materialassign material='Paper' geom='//floor'/></look>"
    echo '</materialx>'
} >bodies.mtlx

# all FILE: the light, and what is seen through.
all() { of "($(channel "$1" R) + $(channel "$1" G) + $(channel "$1" B)) / 3 + 1 - $(channel "$1" A)"; }
for element in SWhite SCoated SMixed SHalf; do
    check "$element is traced in even light" trace even.exr $element --paths 128
    check "$element loses no light" near "$(all even.exr)" 1 0.01
done

# The disk of the ball, by paper.
check 'paper is traced' trace paper.exr SPaper --paths 64
disk=$(channel paper.exr A)
# Parallel light through a ball of the radius 1 with the extinction t: the mean over the disk of exp(-2 t cos) is (1 - (1 + 2 t) exp(-2 t)) / (2 t²).
# clear T: what is not seen through.
clear() { of "1 - (1 - (1 + 2 * $1) * exp(-2 * $1)) / (2 * $1 * $1)"; }
check 'a clear ball is traced' trace clear.exr SClear --paths 256
check 'a clear ball is as opaque as its chords' near "$(of "$(channel clear.exr A) / $disk")" "$(clear 1)" 0.01
check 'a smaller clear ball is traced' trace clear.exr SClear --paths 256 --distance-unit millimeter
check 'a smaller ball has shorter chords' near "$(of "$(channel clear.exr A) / $disk")" "$(clear 0.1)" 0.01

# light FILE PIXEL COLOUR: of a picture for display, as linear light (IEC 61966-2-1).
light() {
    tail -c $((3 * (24 * 24 - $2))) "$1" | od -An -tu1 -N3 | awk -v n="$3" '{ c = $n / 255; print (c > 0.04045 ? ((c + 0.055) / 1.055) ^ 2.4 : c / 12.92) }'
}
check 'a coloured ball is traced before white' trace tinted.ppm STinted --paths 1024 --background environment
for i in 1 2 3; do
    way=$(echo '10 2 1' | cut -d' ' -f$i)
    check "a coloured ball is seen through in its colour: $i" near "$(of "$(light tinted.ppm 300 $i) / $(light tinted.ppm 0 $i)")" "$(of "exp(-2 / $way)")" 0.03
done

check 'a thick ball is traced' trace thick.exr SThick --paths 256
check 'a thick ball reflects its red albedo' near "$(of "$(channel thick.exr R) / $disk")" 0.8 0.015
check "a thick ball reflects its green albedo" near "$(of "$(channel thick.exr G) / $disk")" 0.5 0.015
check "a thick ball reflects its blue albedo" near "$(of "$(channel thick.exr B) / $disk")" 0.2 0.015
check 'a thick ball is traced with the lobe of rasters' trace thick.exr SThick --paths 64 --as-drawn
check 'the lobe of rasters reflects the red albedo' near "$(of "$(channel thick.exr R) / $disk")" 0.8 0.01

# A plate with a lamp behind it. plate DEPTH: from z = -DEPTH to 0.
plate() {
    local x y z
    for z in "-$1" 0; do for y in -1 1; do for x in -1 1; do echo "v $x $y $z"; done; done; done
    printf 'f %s\n' '5 6 8 7' '2 1 3 4' '1 5 7 3' '6 2 4 8' '7 8 4 3' '1 2 6 5'
}
# behind DEPTH: the light that comes through it.
behind() {
    plate "$1" >plate.obj
    exits 0 "$render" bodies.mtlx -e SWax -q --path-trace -o plate.exr -m plate.obj --camera 0,0 --environment none --lights directional_light --size 8 \
        --paths 64 --set u_lightData[0].direction=0,0,1 --set 'u_lightData[1].color=0,0,0' --set u_lightData[2].color=0,0,0 >&2 && channel plate.exr R
}
thin=$(behind 0.2) wide=$(behind 0.8)
check 'a thin plate shines through' awk -v a="$thin" 'BEGIN { exit !(a > 0.05) }'
check 'a thin plate shines through more than a thick one' awk -v a="$thin" -v b="$wide" 'BEGIN { print a, b; exit !(b > 0.005 && b < 0.6 * a) }'

# Objects of other shaders inside a body, and in its shadow.
# sphere NAME RADIUS [Z]
sphere() {
    printf 'def Sphere "%s"\n{\n    double radius = %s\n    double3 xformOp:translate = (0, 0, %s)\n    uniform token[] xformOpOrder = ["xformOp:translate"]\n}\n' \
        "$1" "$2" "${3:-0}"
}
# cube NAME SIZE: above the floor.
cube() {
    printf 'def Cube "%s"\n{\n    double size = %s\n    double3 xformOp:translate = (0, 0, 3)\n    uniform token[] xformOpOrder = ["xformOp:translate"]\n}\n' "$1" "$2"
}
# stage FILE STAGE LOOK ARGUMENT...: objects in even light.
stage() {
    exits 0 "$render" bodies.mtlx --stage "$2" --look "$3" -q --path-trace -o "$1" --lights none --environment white.hdr --camera 0,0 --bounces 64 "${@:4}"
}
head='#usda 1.0
(
 upAxis = "Y"
 metersPerUnit = 0.01
)'
{ echo "$head"; sphere outer 1; sphere inner 0.5; } >inside.usda
check 'paper is traced in a white body' stage inside.exr inside.usda inside --size 16 --paths 64
check 'paper in a white body loses no light' near "$(all inside.exr)" 1 0.01
{ echo "$head"; sphere outer 1; sphere middle 0.7; sphere inner 0.4; } >three.usda
check 'three white bodies inside each other are traced' stage three.exr three.usda scattering --size 16 --paths 64
check 'three white bodies lose no light' near "$(all three.exr)" 1 0.01
# through FILE: the opacity in the middle.
through() { python3 "$exr" "$1" A 0.5 0.5; }
check 'three clear bodies inside each other are traced' stage three.exr three.usda absorbing --size 17 --paths 2048
check 'three clear bodies are as opaque as their chords' near "$(through three.exr)" "$(of '1 - exp(-0.6 / 1 - 0.6 / 2 - 0.8 / 4)')" 0.01
# Light leaves the first one inside the second.
{ echo "$head"; sphere outer 1 1; sphere middle 1; } >overlap.usda
check 'two clear bodies that overlap are traced' stage overlap.exr overlap.usda absorbing --size 17 --paths 2048
check 'light in both bodies goes through the second' near "$(through overlap.exr)" "$(of '1 - exp(-1 / 1 - 2 / 2)')" 0.01
check 'two white bodies that overlap are traced' stage overlap.exr overlap.usda scattering --size 16 --paths 64
check 'two white bodies that overlap lose no light' near "$(all overlap.exr)" 1 0.01
{
    echo "$head"
    cube outer 1
    cube middle 0.6
    cube inner 0.2
    cat <<'USDA'
def Mesh "floor"
{
    point3f[] points = [(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0)]
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
}
def DistantLight "sun"
{
    float inputs:intensity = 3.14159
    float inputs:angle = 0
}
def Camera "camera"
{
    float focalLength = 10
    float horizontalAperture = 1
    float verticalAperture = 1
    double3 xformOp:translate = (0, 10, 10)
    float xformOp:rotateX = -45
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]
}
USDA
} >shadow.usda
check 'the shadow of clear blocks inside each other is traced' exits 0 "$render" bodies.mtlx --stage shadow.usda --look absorbing -q --path-trace -o shadow.exr --camera /camera --size 17 --paths 16
shadow=$(python3 "$exr" shadow.exr R 0.5 0.5)
check 'the place without the shadow is traced' exits 0 "$render" bodies.mtlx --stage shadow.usda --look absorbing -q --path-trace -o shadow.exr --camera /camera --size 17 --paths 16 --distance-unit nanometer
check 'the shadow is that of the ways through the blocks' near "$(of "$shadow / $(python3 "$exr" shadow.exr R 0.5 0.5)")" "$(of 'exp(-0.4 / 1 - 0.4 / 2 - 0.2 / 4)')" 0.01

finish slab_bodies
