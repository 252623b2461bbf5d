#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# AOVs, ambient occlusion and mattes as pictures (docs/slots.md, "AOVs"). Arguments: mxgen-render.
render=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
. "$here/light.sh"

# reads FILE CHANNEL X Y VALUE TOLERANCE, or FILE CHANNEL mean VALUE TOLERANCE
reads() {
    local place=("${@:3:$#-4}") value=${*: -2:1} tolerance=${*: -1}
    local got
    got=$(python3 "$here/exr.py" "$1" "$2" "${place[@]}") || return
    awk -v a="$got" -v b="$value" -v t="$tolerance" -v what="$2" \
        'BEGIN { d = a - b; if (d * d <= t * t) exit 0; print what ": " a " instead of " b; exit 1 }'
}

cat >stage.usda <<'EOF'
#usda 1.0
(
    upAxis = "Y"
)
def Xform "a"
{
    def Plane "floor"
    {
        double width = 400
        double length = 400
        uniform token axis = "Y"
    }
    def Plane "wall"
    {
        double width = 400
        double length = 400
        uniform token axis = "Z"
    }
    def Camera "down"
    {
        float focalLength = 200
        double3 xformOp:translate = (0, 4, 0.3)
        double xformOp:rotateX = -90
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]
    }
}
EOF
# The base has one half, the layer above has 0.4 of an opacity of 0.5: weights 0.2 and 0.4, alpha 0.6.
cat >look.mtlx <<'EOF'
<materialx version="1.39">
  <surface_unlit name="SU" type="surfaceshader">
    <input name="emission_color" type="color3" value="0.5, 0.5, 0.5"/>
    <input name="opacity" type="float" value="0.5"/>
  </surface_unlit>
  <substance name="base" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SU"/></substance>
  <substance name="top" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="SU"/>
    <input name="mask" type="float" value="0.4"/>
  </substance>
  <uniform_edf name="glow" type="EDF"><input name="color" type="color3" value="1, 0.5, 0.25"/></uniform_edf>
  <nodegraph name="of_base">
    <aov name="v" type="float"><input name="name" type="string" value="v"/><input name="value" type="float" value="2"/></aov>
    <aov name="id" type="integer"><input name="name" type="string" value="id"/><input name="value" type="integer" value="7"/></aov>
    <aov name="is" type="boolean"><input name="name" type="string" value="is"/><input name="value" type="boolean" value="true"/></aov>
    <aov name="c" type="color3"><input name="name" type="string" value="of base"/><input name="value" type="color3" value="0.1, 0.2, 0.3"/></aov>
  </nodegraph>
  <nodegraph name="of_top">
    <aov name="v" type="float"><input name="name" type="string" value="v"/><input name="value" type="float" value="5"/></aov>
    <aov name="id" type="integer"><input name="name" type="string" value="id"/><input name="value" type="integer" value="9"/></aov>
  </nodegraph>
  <surface_unlit name="SA" type="surfaceshader"/>
  <nodegraph name="of_ao">
    <ambientocclusion name="ao" type="float"/>
    <ambientocclusion name="narrow" type="float"><input name="coneangle" type="float" value="30"/></ambientocclusion>
    <ambientocclusion name="near" type="float"><input name="maxdistance" type="float" value="0.01"/></ambientocclusion>
    <aov name="a" type="float"><input name="name" type="string" value="ao"/><input name="value" type="float" nodename="ao"/></aov>
    <aov name="b" type="float"><input name="name" type="string" value="narrow"/><input name="value" type="float" nodename="narrow"/></aov>
    <aov name="c" type="float"><input name="name" type="string" value="near"/><input name="value" type="float" nodename="near"/></aov>
  </nodegraph>
  <substance name="open" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SA"/></substance>
  <look name="L">
    <materialassign material="base" geom="/"/>
    <materialassign nodegraph="of_base" geom="/" slot="000::010"/>
    <materialassign material="top" geom="/" slot="050"/>
    <materialassign nodegraph="of_top" geom="/" slot="050::010"/>
    <materialassign material="" geom="/a/wall" slot="050"/>
  </look>
  <look name="AO">
    <materialassign material="open" geom="/"/>
    <materialassign nodegraph="of_ao" geom="/" slot="000::010"/>
  </look>
</materialx>
EOF

picture() { "$render" look.mtlx --stage stage.usda --camera /a/down -q -s 16 "$@"; }
for mode in raster traced; do
    options=(--look L --mattes -o $mode.exr) tolerance=0.001
    [ $mode = traced ] && options+=(--path-trace --paths 4096) tolerance=0.1
    check "a picture has AOVs: $mode" exits 0 picture "${options[@]}"
    check 'the picture has a channel for each component of an AOV' test "$(python3 "$here/exr.py" $mode.exr)" = 'A B G R id is matte.000 matte.050 of base.B of base.G of base.R v'
    # the weights of the layers: top 0.4 * 0.5, base (1 - 0.2) * 0.5
    check 'a float is blended by weights' reads $mode.exr v 0.5 0.9 1.8 $tolerance
    check 'a colour that one layer has is blended by its weight' reads $mode.exr 'of base.G' 0.5 0.9 0.08 $tolerance
    check 'the matte of the base is its weight' reads $mode.exr matte.000 0.5 0.9 0.4 $tolerance
    check 'the matte of the layer above is its weight' reads $mode.exr matte.050 0.5 0.9 0.2 $tolerance
done
check 'an integer is that of the greatest weight' reads raster.exr id 0.5 0.9 7 0
check 'a boolean is that of the greatest weight' reads raster.exr is 0.5 0.9 1 0

# A point on a floor beside a wall that is as wide as the sky: half of the light comes.
check 'occlusion is traced' exits 0 picture --look AO --path-trace --paths 64 -o ao.exr
check 'a point beside a wall sees half of the sky' reads ao.exr ao mean 0.5 0.02
check 'a narrow cone sees half of the sky' reads ao.exr narrow mean 0.5 0.02
check 'a surface beyond the distance does not occlude' reads ao.exr near mean 1 0.001
check 'occlusion may come from a primvar' exits 0 picture --look AO -o primvar.exr
check 'a missing primvar is 1' reads primvar.exr ao mean 1 0.001
sed 's|        double width = 400|&\n        float primvars:ambientocclusion = 0.25|' stage.usda >closed.usda
check 'a stage may have the primvar of occlusion' exits 0 "$render" look.mtlx --stage closed.usda --camera /a/down -q -s 16 --look AO -o primvar.exr
check 'the primvar of the stage is read' reads primvar.exr ao mean 0.25 0.001

check 'slots are shown' exits 0 "$render" look.mtlx --stage stage.usda --camera /a/down -s 16 --look L --show slots -o slots.png
check 'the slots of a picture have a legend' grep -q '^slot 050: #' err
check 'weights are shown' exits 0 picture --look L --show weights -o weights.exr
check 'weights are blended with the opacity of the picture' reads weights.exr A 0.5 0.9 0.6 0.001
check 'another view is wrong usage' exits 2 picture --look L --show layers -o x.png
check 'mattes in PNG are wrong usage' exits 2 picture --look L --mattes -o x.png
check 'the error says that EXR has channels' grep -q 'only EXR files have channels' err
check 'slots without a stage are wrong usage' exits 2 "$render" look.mtlx --show slots -o x.png

# The hash picks layers as often as their weights say: the mean of a picture is that of all layers, within 1 %.
sed 's|<look name="L">|&<visibility geom="/a/wall" visible="false"/>|' look.mtlx >floor.mtlx
for slots in blend stochastic; do
    check "a picture of the floor is drawn: $slots" exits 0 "$render" floor.mtlx --stage stage.usda --camera /a/down -q --look L --mattes --slots $slots -s 192 -o $slots.exr
done
for channel in R v matte.000 matte.050; do
    mean=$(channel blend.exr $channel)
    check "the mean of $channel is that of all layers" reads stochastic.exr $channel mean "$mean" "$(awk -v m="$mean" 'BEGIN { print m / 100 }')"
done
check 'stochastic layers give another picture than blended ones' test "$(md5sum <blend.exr)" != "$(md5sum <stochastic.exr)"

# The light of BSDFs. In even light a ball sends the albedo of a closure: that of the paint is its colour.
write_white white.hdr
cat >lit.mtlx <<'EOF'
<materialx version="1.39">
  <oren_nayar_diffuse_bsdf name="paint" type="BSDF"><input name="color" type="color3" value="0.6, 0.3, 0.1"/></oren_nayar_diffuse_bsdf>
  <dielectric_bsdf name="coat" type="BSDF"><input name="roughness" type="vector2" value="0.3, 0.3"/></dielectric_bsdf>
  <layer name="both" type="BSDF"><input name="top" type="BSDF" nodename="coat"/><input name="base" type="BSDF" nodename="paint"/></layer>
  <conductor_bsdf name="metal" type="BSDF"><input name="roughness" type="vector2" value="0.4, 0.4"/></conductor_bsdf>
  <uniform_edf name="glow" type="EDF"><input name="color" type="color3" value="0.2, 0.1, 0.05"/></uniform_edf>
  <surface name="S" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="both"/><input name="edf" type="EDF" nodename="glow"/></surface>
  <surface name="SM" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="metal"/></surface>
  <aov name="a" type="BSDF"><input name="name" type="string" value="all"/><input name="value" type="BSDF" nodename="both"/></aov>
  <aov name="b" type="BSDF"><input name="name" type="string" value="paint"/><input name="value" type="BSDF" nodename="paint"/></aov>
  <aov name="c" type="BSDF"><input name="name" type="string" value="metal"/><input name="value" type="BSDF" nodename="metal"/></aov>
  <aov name="d" type="EDF"><input name="name" type="string" value="glow"/><input name="value" type="EDF" nodename="glow"/></aov>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
  <nodegraph name="of_base">
    <oren_nayar_diffuse_bsdf name="d" type="BSDF"><input name="color" type="color3" value="0.6, 0.3, 0.1"/></oren_nayar_diffuse_bsdf>
    <aov name="a" type="BSDF"><input name="name" type="string" value="base"/><input name="value" type="BSDF" nodename="d"/></aov>
  </nodegraph>
  <substance name="quarter" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="SM"/><input name="mask" type="float" value="0.25"/>
  </substance>
  <look name="One"><materialassign material="M" geom="/"/></look>
  <look name="Two">
    <materialassign material="M" geom="/"/>
    <materialassign slot="000::010" nodegraph="of_base" geom="/"/>
    <materialassign slot="050" material="quarter" geom="/"/>
  </look>
</materialx>
EOF
part() { of "$1 * $(channel "$2" A)"; } # NUMBER FILE: of the pixels that the ball covers
for mode in '' '--path-trace --paths 64'; do
    check "a ball in even light is drawn $mode" exits 0 "$render" lit.mtlx -e M --environment white.hdr -m sphere -q -s 24 $mode -o even.exr
    check 'the paint has its colour' reads even.exr paint.R mean "$(part 0.6 even.exr)" 0.005
    check 'the paint has its blue' reads even.exr paint.B mean "$(part 0.1 even.exr)" 0.001
    check 'emission does not depend on the light' reads even.exr glow.G mean "$(part 0.1 even.exr)" 0.001
    metal=$(channel even.exr metal.R)
    check "a ball of metal is drawn $mode" exits 0 "$render" lit.mtlx -e SM --environment white.hdr -m sphere -q -s 24 $mode -o metal.exr
    check 'an AOV has the light of the metal that the surface lacks' reads metal.exr R mean "$metal" 0.01
done
# A layer has the weight of its mask.
printf '#usda 1.0\ndef Sphere "ball"\n{\n}\n' >ball.usda
for mode in '' '--slots stochastic' '--path-trace --paths 64'; do
    check "a ball with a stack is drawn $mode" exits 0 "$render" lit.mtlx --stage ball.usda --look Two --environment white.hdr -q -s 24 $mode -o two.exr
    check 'the base has three quarters of the light' reads two.exr base.R mean "$(part 0.45 two.exr)" 0.01
done
# With light from other surfaces and from lights: the whole is the sum of its parts.
sums() { # FILE WHOLE PART...
    python3 - "$here" "$@" <<'EOF'
import sys
sys.path.append(sys.argv[1])
import exr
file, whole, *parts = sys.argv[2:]
_, _, values = exr.read(file)
numbers = {name: sum(map(list, rows), []) for name, rows in values.items()}
most = max(abs(w - sum(p)) / (1 + w) for w, *p in zip(numbers[whole], *(numbers[p] for p in parts)))
print(f"{whole} is off by {most}, of up to {max(numbers[whole])}")
sys.exit(most > 0.002 or max(numbers[whole]) < 0.1)
EOF
}
check 'a corner is traced' exits 0 "$render" lit.mtlx --stage stage.usda --camera /a/down -q -s 24 --look One --path-trace --paths 32 -o corner.exr
for channel in R G B; do check "the light of the corner is the sum of its parts in $channel" sums corner.exr $channel all.$channel glow.$channel; done
check 'a sphere under lights is traced' exits 0 "$render" lit.mtlx -e M -m sphere -q -s 24 --path-trace --paths 64 -o lights.exr
check 'the light of the sphere is the sum of its parts' sums lights.exr R all.R glow.R
metal=$(channel lights.exr metal.R)
check 'a sphere of metal is traced' exits 0 "$render" lit.mtlx -e SM -m sphere -q -s 24 --path-trace --paths 64 -o lights.exr
check 'an AOV has the traced light of the metal' reads lights.exr R mean "$metal" 0.01

# A primitive that the look hides is not drawn.
sed 's|<look name="L">|&<visibility geom="/a/floor" vistype="camera" visible="false"/>|' look.mtlx >hidden.mtlx
check 'a stage with visibility is drawn' exits 0 "$render" hidden.mtlx --stage stage.usda --camera /a/down -q -s 16 --look L -o hidden.exr
check 'an invisible primitive is not drawn' reads hidden.exr A 0.5 0.9 0 0
check 'a stage with visibility is traced' exits 0 "$render" hidden.mtlx --stage stage.usda --camera /a/down -q -s 16 --look L --path-trace --paths 4 -o hidden.exr
check 'an invisible primitive is not traced' reads hidden.exr A 0.5 0.9 0 0
see() { sed "s|<look name=\"L\">|&$1|" look.mtlx >seen.mtlx; exits 0 "$render" seen.mtlx --stage stage.usda --camera /a/down -s 16 --look L -o hidden.exr; }
unseen='<visibility geom="/a/floor" vistype="camera" visible="false"/>'
check 'a look without visibility' see ''
cp hidden.exr plain.exr
check 'a visibility for all beside one for the camera' see "$unseen<visibility geom=\"/a/floor\"/>"
check 'that for all counts' cmp plain.exr hidden.exr
check 'a visibility for all above one for the camera' see "$unseen<visibility geom=\"/\"/>"
check 'that for the camera counts' reads hidden.exr A 0.5 0.9 0 0
check 'a look with what no picture follows' see '<visibility geom="/a" vistype="shadow" visible="false"/><visibility geom="/a" vistype="camera" viewergeom="/cam" visible="false"/><propertyassign property="matte" type="boolean" value="true" geom="/a"/>'
for word in "visibility 'shadow'" "viewer of a visibility '/cam'" "property 'matte'"; do
    check "the $word is told once" eval '[ "$(grep -c "the $word of the look has no effect.*\[look-unread\]" err)" = 1 ]'
done
check 'a stage without a visible primitive is an error' eval 'sed -i "s|geom=\"/a/floor\" vistype=\"camera\"|geom=\"/\"|" hidden.mtlx; exits 1 "$render" hidden.mtlx --stage stage.usda -s 16 --look L -o no.exr && grep -q "empty-mesh" err'

# More AOVs than attachments: drawn again and again.
{
    echo '<materialx version="1.39"><surface_unlit name="S" type="surfaceshader"/>'
    for i in $(seq 1 10); do
        echo "<aov name='a$i' type='float'><input name='name' type='string' value='a$i'/><input name='value' type='float' value='$i'/></aov>"
    done
    echo '<surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial></materialx>'
} >many.mtlx
check 'a picture may have ten AOVs' exits 0 "$render" many.mtlx -e M -m plane -q -s 8 -o many.exr
check 'the last of ten AOVs is drawn' reads many.exr a10 0.5 0.5 10 0.001
check 'the first of ten AOVs is drawn' reads many.exr a1 0.5 0.5 1 0.001
for view in slots classes; do
    check "--show $view without such a thing is wrong usage" exits 2 "$render" look.mtlx --show $view -o no.png
    check "the error says that --show $view does not apply" grep -q "'--show' does not apply" err
done
finish aovs
