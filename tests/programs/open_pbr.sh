#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Changes of version 1.2 of OpenPBR, by surfaces that must look the same. Its values are in ../shaderx. Arguments: mxgen, mxgen-render, the root of the
# source tree.
mxgen=$(realpath "$1") render=${2:+$(realpath "$2")} root=$(realpath "$3")
. "$root/tests/programs/common.sh"

# material NAME VERSION INPUT=TYPE:VALUE...
material() {
    local name=$1 version=$2 input
    shift 2
    echo "<open_pbr_surface name='S$name' type='surfaceshader' version='$version'>"
    for input in "$@"; do
        local value=${input#*=}
        echo "<input name='${input%%=*}' type='${value%%:*}' value='${value#*:}'/>"
    done
    echo "</open_pbr_surface><surfacematerial name='$name' type='material'>
      <input name='surfaceshader' type='surfaceshader' nodename='S$name'/></surfacematerial>"
}
metal="base_metalness=float:1" matte="specular_weight=float:0"
{
    echo '<materialx version="1.39">'
    material Core 1.2 $metal specular_roughness=float:0.3
    material Rough 1.2 $metal specular_roughness=float:0.65
    material Haze 1.2 $metal specular_roughness=float:0.3 specular_haze=float:0.4 specular_haze_spread=float:0.5
    material Retro 1.2 $metal specular_roughness=float:0.3 specular_retroreflectivity=float:1
    echo '<generalized_schlick_bsdf name="back" type="BSDF"><input name="color0" type="color3" value="0.8,0.8,0.8"/>
      <input name="roughness" type="vector2" value="0.09,0.09"/><input name="retroreflective" type="boolean" value="true"/></generalized_schlick_bsdf>
      <surface name="sheet" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="back"/></surface>
      <surfacematerial name="Sheet" type="material"><input name="surfaceshader" type="surfaceshader" nodename="sheet"/></surfacematerial>'
    for share in 0 0.25 1; do
        material Gloss$share 1.2 base_color=color3:0,0,0 specular_haze=float:0.2 specular_retroreflectivity=float:$share
    done
    material Dark 1.2 $matte
    material Glow 1.2 $matte emission_weight=float:0.25 emission_luminance=float:2 emission_color=color3:4,1,1
    material GlowBefore 1.1.1 $matte emission_luminance=float:0.5 emission_color=color3:4,1,1
    material White 1.2 $matte base_color=color3:1,1,1
    material Whiter 1.2 $matte base_color=color3:2,2,2
    material Glass 1.2 $matte transmission_weight=float:1
    material GlassBefore 1.1.1 $matte transmission_weight=float:1
    echo '</materialx>'
} >surfaces.mtlx

# 1.5 divides the direction of the ray inside of the ball.
check 'shaders are generated' exits 0 "$mxgen" surfaces.mtlx --interface reduced -o shaders
check 'refraction does not depend on the specular weight' grep -q 'refract(.*0\.6666667)' shaders/Glass.frag
check 'before 1.2 it did' exits 1 grep -q 'refract(.*0\.6666667)' shaders/GlassBefore.frag

if [ -z "$render" ] || ! has_device "$render"; then
    skip 'there is no Vulkan device'
    finish open_pbr
fi
mean() { python3 "$root/tests/programs/exr.py" "$1.exr" R mean; }
# near A B TOLERANCE: two numbers.
near() { awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN { print a, b; exit !(a - b < t && b - a < t && a > 0.01) }'; }
far() { ! near "$@"; }
for name in Retro Sheet Gloss0 Gloss0.25 Gloss1 Core Rough Haze Dark Glow GlowBefore White Whiter; do
    check "$name is drawn" exits 0 "$render" surfaces.mtlx -e "$name" -s 24 -o "$name.exr"
done

mixed=$(awk -v a="$(mean Core)" -v b="$(mean Rough)" 'BEGIN { print 0.6 * a + 0.4 * b }')
check 'haze is a second lobe' near "$(mean Haze)" "$mixed" 0.001
check 'haze is seen' far "$(mean Haze)" "$(mean Core)" 0.002
check 'metal is retroreflective as the closure is' near "$(mean Retro)" "$(mean Sheet)" 0.0001
check 'that is seen' far "$(mean Retro)" "$(mean Core)" 0.01
mixed=$(awk -v a="$(mean Gloss0)" -v b="$(mean Gloss1)" 'BEGIN { print 0.75 * a + 0.25 * b }')
check 'gloss goes back in part' near "$(mean Gloss0.25)" "$mixed" 0.0005
check 'the two ends differ' far "$(mean Gloss0)" "$(mean Gloss1)" 0.002
check 'the weight scales the luminance' near "$(mean Glow)" "$(mean GlowBefore)" 0.0001
check 'weight 0, the default, is dark' far "$(mean Glow)" "$(mean Dark)" 0.1
check 'colours end at 1' near "$(mean Whiter)" "$(mean White)" 0.0001
finish open_pbr
