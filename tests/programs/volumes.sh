#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Volumes, path traced: what Beer and Lambert say, emission along the way, light that is scattered once by an integral, white media that lose no
# light, media that vary, media in media, the eye in media, shadows, and media inside surfaces. Arguments: mxgen-render, the root of the source tree,
# and "all" for what takes longer.
render=$(realpath "$1") root=$(realpath "$2") extent=${3:-}
. "$root/tests/programs/light.sh"

if ! has_device "$render"; then
    skip 'there is no Vulkan device'
    finish volumes
fi

write_white white.hdr
# medium NAME ABSORPTION SCATTERING ANISOTROPY
medium() {
    echo "<anisotropic_vdf name='$1' type='VDF'><input name='absorption' type='vector3' value='$2'/><input name='scattering' type='vector3' value='$3'/>
      <input name='anisotropy' type='float' value='$4'/></anisotropic_vdf>"
}
# volume NAME VDF [INPUT]
volume() {
    echo "<volume name='V$1' type='volumeshader'><input name='vdf' type='VDF' nodename='$2'/>${3:-}</volume>
      <volumematerial name='$1' type='material'><input name='volumeshader' type='volumeshader' nodename='V$1'/></volumematerial>"
}
# rising NAME VALUE: a vector3 that is VALUE times z + 1
rising() {
    echo "<multiply name='$1' type='vector3'><input name='in1' type='vector3' value='$2'/><input name='in2' type='float' nodename='height'/></multiply>"
}
# varying NAME ABSORPTION SCATTERING ANISOTROPY: a medium whose coefficients rise.
varying() {
    rising "a$1" "$2"
    rising "s$1" "$3"
    echo "<anisotropic_vdf name='$1' type='VDF'><input name='absorption' type='vector3' nodename='a$1'/><input name='scattering' type='vector3' nodename='s$1'/>
      <input name='anisotropy' type='float' value='$4'/></anisotropic_vdf>"
}
# filled NAME VDF IOR: a solid with a medium inside.
filled() {
    echo "<dielectric_bsdf name='glass$1' type='BSDF'><input name='scatter_mode' type='string' value='RT'/><input name='ior' type='float' value='$3'/>
        <input name='roughness' type='vector2' value='0, 0'/></dielectric_bsdf>
      <layer name='b$1' type='BSDF'><input name='top' type='BSDF' nodename='glass$1'/><input name='base' type='VDF' nodename='$2'/></layer>
      <surface name='S$1' type='surfaceshader'><input name='bsdf' type='BSDF' nodename='b$1'/></surface>"
}
assign() { echo "<materialassign material='$1' geom='//$2'/>"; } # MATERIAL PRIMITIVE
{
    echo '<materialx version="1.39">'
    echo "<uniform_edf name='heat' type='EDF'><input name='color' type='color3' value='0.5, 1, 0.2'/></uniform_edf>
      <uniform_edf name='light' type='EDF'><input name='color' type='color3' value='0.2, 0.5, 1'/></uniform_edf>
      <oren_nayar_diffuse_bsdf name='paint' type='BSDF'><input name='color' type='color3' value='1, 1, 1'/></oren_nayar_diffuse_bsdf>
      <surface name='SPaper' type='surfaceshader'><input name='bsdf' type='BSDF' nodename='paint'/></surface>
      <surfacematerial name='Paper' type='material'><input name='surfaceshader' type='surfaceshader' nodename='SPaper'/></surfacematerial>"
    echo "<absorption_vdf name='ink' type='VDF'><input name='absorption' type='vector3' value='0.5, 1, 2'/></absorption_vdf>
      <absorption_vdf name='tea' type='VDF'><input name='absorption' type='vector3' value='0.5, 0.5, 0.5'/></absorption_vdf>"
    medium milk '0, 0, 0' '0.5, 1, 2' 0.6
    medium smoke '0, 0, 0' '1, 0.5, 0.5' -0.5
    medium thick '0, 0, 0' '1, 2, 4' 0.3
    medium faint '0.498, 0.996, 1.992' '0.002, 0.004, 0.008' 0.5
    medium soup '1, 1, 1' '2, 2, 2' 0.4
    medium gas '0.5, 1, 0.2' '1, 0.5, 1.5' 0.3
    echo "<mix name='both' type='VDF'><input name='fg' type='VDF' nodename='milk'/><input name='bg' type='VDF' nodename='smoke'/>
      <input name='mix' type='float' value='0.5'/></mix>"
    echo "<position name='p' type='vector3'><input name='space' type='string' value='world'/></position>
      <separate3 name='xyz' type='multioutput'><input name='in' type='vector3' nodename='p'/></separate3>
      <add name='height' type='float'><input name='in1' type='float' nodename='xyz' output='outz'/><input name='in2' type='float' value='1'/></add>"
    varying fog '0.5, 1, 2' '0, 0, 0' 0
    varying cloud '0, 0, 0' '2, 3, 4' 0.4
    varying broth '1, 1, 1' '2, 2, 2' 0.4
    varying haze '0.498, 0.996, 1.992' '0.002, 0.004, 0.008' 0.5
    rising hot '0.2, 0.5, 1'
    echo "<convert name='color' type='color3'><input name='in' type='vector3' nodename='hot'/></convert>
      <uniform_edf name='embers' type='EDF'><input name='color' type='color3' nodename='color'/></uniform_edf>"
    volume Fog fog
    volume Cloud cloud
    volume Haze haze
    volume Fire fog "<input name='edf' type='EDF' nodename='embers'/>"
    volume Embers nothing "<input name='edf' type='EDF' nodename='embers'/>"
    echo "<absorption_vdf name='nothing' type='VDF'><input name='absorption' type='vector3' value='0, 0, 0'/></absorption_vdf>"
    volume Ink ink
    volume Tea tea
    volume Both both
    volume Faint faint
    volume Soup soup
    volume Lamp tea "<input name='edf' type='EDF' nodename='light'/>"
    volume Flame gas "<input name='edf' type='EDF' nodename='heat'/>"
    filled Milk thick 1.5
    filled Soup soup 1.00001
    filled Inner fog 1.00001
    echo "<surfacematerial name='Inner' type='material'><input name='surfaceshader' type='surfaceshader' nodename='SInner'/></surfacematerial>
      <look name='within'>$(assign Inner ball)</look>"
    filled Fumes cloud 1.5
    volume Broth broth
    filled Broth broth 1.00001
    echo "<look name='inside'>$(assign Ink outer)$(assign Tea inner)</look><look name='paper'>$(assign Both outer)$(assign Paper inner)</look>
      <look name='bulb'>$(assign Lamp ball)</look><look name='beam'>$(assign Faint ball)</look>
      <look name='foggy'>$(assign Fog ball)</look><look name='burning'>$(assign Fire ball)</look><look name='glowing'>$(assign Embers ball)</look>
      <look name='hazy'>$(assign Haze ball)</look><look name='over'>$(assign Fog cube)$(assign Paper floor)</look>
      <look name='shadow'>$(assign Tea cube)$(assign Paper floor)</look></materialx>"
} >volumes.mtlx

# trace FILE ELEMENT ARGUMENT...: a ball in even light, from far away.
trace() {
    exits 0 "$render" volumes.mtlx -e "$2" -q --path-trace -o "$1" -m sphere --lights none --environment white.hdr --camera 0,0,60,2.2 --bounces 64 "${@:3}"
}

# White media.
all() { of "($(channel "$1" R) + $(channel "$1" G) + $(channel "$1" B)) / 3 + 1 - $(channel "$1" A)"; } # FILE: the light, and what is seen through
check 'a mix of two white media is traced in even light' trace both.exr VBoth --size 16 --paths 96
check 'a mix of two white media loses no light' near "$(all both.exr)" 1 0.01
check 'glass with a white medium inside is traced in even light' trace glass.exr SMilk --size 16 --paths 96
check 'glass with a white medium inside loses no light' near "$(all glass.exr)" 1 0.01

# Parallel light through a ball of the radius 1 with the extinction t: the mean over the disk of exp(-2 t cos) is (1 - (1 + 2 t) exp(-2 t)) / (2 t²).
chords() { of "1 - (1 - (1 + 2 * $1) * exp(-2 * $1)) / (2 * $1 * $1)"; }
disk=$(channel glass.exr A)
check 'ink is traced' trace ink.exr VInk --size 16 --paths 96
check 'ink is as opaque as its chords' near "$(of "$(channel ink.exr A) / $disk")" "$(of "($(chords 0.5) + $(chords 1) + $(chords 2)) / 3")" 0.01
# Stages, from the front through a camera that sees the middle of a ball of the radius 1, or a floor.
usd() { # FIELD Z LINE...: a stage
    printf '#usda 1.0\n(\n upAxis = "Y"\n metersPerUnit = 0.01\n)\n'
    printf 'def Camera "camera"\n{\n    float focalLength = 1\n    float horizontalAperture = %s\n    float verticalAperture = %s\n' "$1" "$1"
    printf '    double3 xformOp:translate = (0, 0, %s)\n    uniform token[] xformOpOrder = ["xformOp:translate"]\n}\n' "$2"
    printf '%s\n' "${@:3}"
}
sphere() { printf 'def Sphere "%s"\n{\n    double radius = %s\n}\n' "$1" "$2"; } # NAME RADIUS
sun() { # OPERATION...: of its transform; it shines along -z
    printf 'def DistantLight "sun"\n{\n    float inputs:intensity = 100\n    float inputs:angle = 0\n    bool inputs:normalize = 1\n'
    printf '%s\n' "$@" '}'
}
# stage FILE STAGE LOOK ARGUMENT...
stage() {
    exits 0 "$render" volumes.mtlx --stage "$2" --look "$3" -q --path-trace -o "$1" --camera /camera --bounces 64 "${@:4}"
}
even="--lights none --environment white.hdr"
usd 0.0004 60 "$(sphere ball 1)" >ball.usda
# shellcheck disable=SC2086 # arguments, divided by spaces
check 'a medium that shines and absorbs is traced' stage lamp.exr ball.usda bulb $even --size 4 --paths 16
check 'a medium shines along the way' near "$(channel lamp.exr G)" "$(of '0.5 * (1 - exp(-1)) / 0.5')" 0.002

# Light from the side that is scattered once, by an integral over the way of the view; so little is scattered that twice is below 1 %.
usd 0.0004 60 "$(sphere ball 1)" "$(sun '    float xformOp:rotateY = 90' '    uniform token[] xformOpOrder = ["xformOp:rotateY"]')" >side.usda
check 'light from the side is traced' stage side.exr side.usda beam --size 16 --paths 128
once() { # SCATTERING EXTINCTION
    python3 -c 'import math, sys
scattering, extinction, steps, g = float(sys.argv[1]), float(sys.argv[2]), 4000, 0.5
phase = (1 - g * g) / (4 * math.pi * (1 + g * g) ** 1.5)  # around a right angle
total = 0
for i in range(steps):
    t = 2 * (i + 0.5) / steps  # from the eye
    total += math.exp(-extinction * (t + math.sqrt(1 - (1 - t) ** 2))) * 2 / steps
print(100 * scattering * phase * total)' "$1" "$2"
}
for row in 'R 0.002 0.5' 'G 0.004 1' 'B 0.008 2'; do
    read -r name scattering extinction <<<"$row"
    check "light from the side is scattered once: $name" near "$(of "$(channel side.exr "$name") / $(once "$scattering" "$extinction")")" 1 0.03
done

# Media that vary: their extinction is that of above times z + 1, so from front to back through the middle of the ball it is as above times 2.
# shellcheck disable=SC2086
check 'a medium that varies is traced' stage fog.exr ball.usda foggy $even --size 4 --paths 1024
check 'a medium that varies is as opaque as its integral' near "$(channel fog.exr A)" "$(of '1 - (exp(-1) + exp(-2) + exp(-4)) / 3')" 0.01

# A medium inside a surface that bends nothing: what is seen through it is the light of the sky behind.
# shellcheck disable=SC2086
check 'a medium that varies inside a surface is traced' stage within.exr ball.usda within $even --size 4 --paths 1536
for row in 'R 1' 'G 2' 'B 4'; do
    read -r name depth <<<"$row"
    check "a medium that varies inside a surface absorbs by its integral: $name" near "$(channel within.exr "$name")" "$(of "exp(-$depth)")" 0.012
done

# The eye inside: 1 to the front of the ball through one medium; through two, half of the way in each.
usd 0.0004 0 "$(sphere ball 1)" >eye.usda
usd 0.0004 0 "$(sphere outer 1)" "$(sphere inner 0.5)" >eyes.usda
# shellcheck disable=SC2086
check 'the eye in a medium is traced' stage eye.exr eye.usda bulb $even --size 4 --paths 16
check 'the eye in a medium sees its light' near "$(channel eye.exr G)" "$(of '0.5 * (1 - exp(-0.5)) / 0.5')" 0.002
check 'the eye in a medium sees through it' near "$(channel eye.exr A)" "$(of '1 - exp(-0.5)')" 0.002
# shellcheck disable=SC2086
check 'the eye in two media is traced' stage eyes.exr eyes.usda inside $even --size 4 --paths 16
check 'the eye in two media sees through both' near "$(channel eyes.exr A)" \
    "$(of '1 - exp(-0.25) * (exp(-0.25) + exp(-0.5) + exp(-1)) / 3')" 0.005

# Media in media, and what they hold. By order of entry: inside the inner one the outer one is not.
usd 0.0004 60 "$(sphere outer 1)" "$(sphere inner 0.5)" >inside.usda
# shellcheck disable=SC2086
check 'a medium in a medium is traced' stage inside.exr inside.usda inside $even --size 4 --paths 16
check 'a medium in a medium is as opaque as both ways' near "$(channel inside.exr A)" "$(of '1 - (exp(-0.5 - 0.5) + exp(-1 - 0.5) + exp(-2 - 0.5)) / 3')" 0.005
# A shadow.
usd 0.1 2 "$(sun)" 'def Cube "cube"
{
    double size = 1
    double3 xformOp:translate = (0, 0, 3)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Mesh "floor"
{
    point3f[] points = [(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0)]
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
}' >shadow.usda
check 'a floor below a medium is traced' stage shadow.exr shadow.usda shadow --size 4 --paths 16
check 'light comes through the medium' near "$(channel shadow.exr R)" "$(of '100 / 3.14159265 * exp(-0.5)')" 0.1

# As drawn: once scattered, and nothing takes from light that comes.
check 'smoke is drawn' exits 0 "$render" "$root/examples/fog.mtlx" -q -o drawn.exr -m sphere --lights none --environment white.hdr --size 32 --samples 64
check 'smoke is traced as drawn' exits 0 "$render" "$root/examples/fog.mtlx" -q -o traced.exr -m sphere --lights none --environment white.hdr --size 32 \
    --path-trace --as-drawn --paths 64
for name in R G B A; do
    check "smoke is traced as it is drawn: $name" near "$(of "$(channel drawn.exr $name) / $(channel traced.exr $name)")" 1 0.02
done
if [ "$extent" = all ]; then
    # A lamp shines in through a rough surface: a medium inside sends as much of its light back as of a small bright part of an environment, the
    # eight rows of 128 around the top, whose solid angle is 2 π (1 - cos(8 π / 128)). Paths meet that by chance alone.
    {
        printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 128 +X 8\n'
        for _ in {1..64}; do printf '\200\200\200\205'; done # 16
        for _ in {1..960}; do printf '\0\0\0\0'; done
    } >spot.hdr
    cat >frosted.mtlx <<'XML'
<materialx version="1.39">
  <anisotropic_vdf name="milk" type="VDF"><input name="absorption" type="vector3" value="0, 0, 0"/><input name="scattering" type="vector3" value="3, 3, 3"/></anisotropic_vdf>
  <dielectric_bsdf name="glass" type="BSDF"><input name="scatter_mode" type="string" value="T"/><input name="roughness" type="vector2" value="0.4, 0.4"/></dielectric_bsdf>
  <layer name="jar" type="BSDF"><input name="top" type="BSDF" nodename="glass"/><input name="base" type="VDF" nodename="milk"/></layer>
  <surface name="S" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="jar"/></surface>
</materialx>
XML
    # jar FILE INTENSITY ENVIRONMENT PATHS
    jar() {
        exits 0 "$render" frosted.mtlx -q --path-trace -o "$1" -m sphere --environment "$3" --camera 0,0,60,2.2 --bounces 64 --size 16 --paths "$4" \
            --set "u_lightData[0].intensity=$2" --set u_lightData[0].direction=0,-1,0 --set u_lightData[0].color=1,1,1 \
            --set u_lightData[1].intensity=0 --set u_lightData[2].intensity=0
    }
    check 'milk in a frosted jar is traced in the light of a lamp' jar lamp.exr "$(of '16 * 2 * 3.14159265 * (1 - cos(8 * 3.14159265 / 128))')" none 128
    check 'milk in a frosted jar is traced in the light of an environment' jar spot.exr 0 spot.hdr 384
    check 'the lamp shines in as the environment does' near "$(of "$(channel lamp.exr R) / $(channel spot.exr R)")" 1 0.12

    # shellcheck disable=SC2086
    check 'a medium that varies and shines is traced' stage fire.exr ball.usda burning $even --size 4 --paths 1024
    check 'a medium that varies shines as much as it absorbs' near "$(channel fire.exr G)" "$(of '0.5 * (1 - exp(-2))')" 0.015
    # shellcheck disable=SC2086
    check 'nothing that shines is traced' stage embers.exr ball.usda glowing $even --size 4 --paths 1024
    check 'nothing shines by the integral' near "$(channel embers.exr B)" 2 0.06
    check 'nothing is not opaque' near "$(channel embers.exr A)" 0 0.005
    check 'light from the side is traced in a medium that varies' stage haze.exr side.usda hazy --size 16 --paths 256
    # by an integral over the way of the view, from z = 1 down; the light comes along x, where the medium is the same
    rising_once() { # SCATTERING EXTINCTION
        python3 -c 'import math, sys
scattering, extinction, steps, g = float(sys.argv[1]), float(sys.argv[2]), 4000, 0.5
phase = (1 - g * g) / (4 * math.pi * (1 + g * g) ** 1.5)
total = 0
for i in range(steps):
    z = 1 - 2 * (i + 0.5) / steps
    seen = 1.5 - z - z * z / 2  # the integral of z + 1 from there to the eye
    total += (z + 1) * math.exp(-extinction * (seen + (z + 1) * math.sqrt(1 - z * z))) * 2 / steps
print(100 * scattering * phase * total)' "$1" "$2"
    }
    for row in 'R 0.002 0.5' 'G 0.004 1' 'B 0.008 2'; do
        read -r name scattering extinction <<<"$row"
        check "light is scattered once in a medium that varies: $name" near \
            "$(of "$(channel haze.exr "$name") / $(rising_once "$scattering" "$extinction")")" 1 0.04
    done
    check 'glass with a white medium inside that varies is traced' trace fumes.exr SFumes --size 16 --paths 256
    check 'glass with a white medium inside that varies loses no light' near "$(all fumes.exr)" 1 0.01
    # shellcheck disable=SC2086
    check 'the eye in a medium that varies is traced' stage fogged.exr eye.usda foggy $even --size 4 --paths 1024
    check 'the eye in a medium that varies sees through it' near "$(channel fogged.exr A)" "$(of '1 - (exp(-0.25) + exp(-0.5) + exp(-1)) / 3')" 0.01
    # The cube reaches from 2.5 to 3.5 above the floor; the integral of z + 1 is 4.
    check 'a floor below a medium that varies is traced' stage over.exr shadow.usda over --size 4 --paths 512
    check 'light comes through a medium that varies' near "$(channel over.exr R)" "$(of '100 / 3.14159265 * exp(-2)')" 0.2
    check 'a white medium that varies is traced in even light' trace cloud.exr VCloud --size 16 --paths 512
    check 'a white medium that varies loses no light' near "$(all cloud.exr)" 1 0.01
    check 'a medium that sends what it absorbs is traced in even light' trace flame.exr VFlame --size 16 --paths 128
    check 'a medium that sends what it absorbs is not to be seen' near "$(all flame.exr)" 1 0.01
    # One medium as a volume, and inside a surface that does not bend light.
    check 'a medium that absorbs and scatters is traced' trace soup.exr VSoup --size 16 --paths 96
    check 'a surface around it is traced' trace around.exr SSoup --size 16 --paths 96
    check 'a surface that bends nothing changes nothing' near "$(all around.exr)" "$(all soup.exr)" 0.01
    check 'a medium that varies, absorbs and scatters is traced' trace broth.exr VBroth --size 16 --paths 256
    check 'a surface around it is traced, too' trace bowl.exr SBroth --size 16 --paths 256
    check 'a surface that bends nothing changes nothing of what varies' near "$(all bowl.exr)" "$(all broth.exr)" 0.01
    usd 0.04 60 "$(sphere outer 1)" "$(sphere inner 0.5)" >paper.usda
    # shellcheck disable=SC2086
    check 'white paper in a white medium is traced' stage paper.exr paper.usda paper $even --size 12 --paths 128
    check 'white paper in a white medium loses no light' near "$(all paper.exr)" 1 0.02
fi
finish volumes
