#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Slabs in the path tracer: means of drawn and traced pictures agree within 3 percent; light that walks through white media is all there,
# also from behind a sheet; mixes of surfaces are as mixes of their slabs, and AOVs have the light of their closures; a clear sheet takes what
# Beer and Lambert say; slabs among closures that add up, are scaled or refract have the light of their parts; and picks of a closure
# change the noise, not the mean.
# Arguments: mxgen-render, mean_ratio, mxgen, the root of the source tree.
render=$(realpath "$1") mean_ratio=$(realpath "$2") mxgen=$(realpath "$3") root=$(realpath "$4")
examples=$root/examples
. "$root/tests/programs/light.sh"
export MESA_SHADER_CACHE_DISABLE=true

ratio() { awk -v a="$1" -v b="$2" 'BEGIN { print a / b }'; }
# trace FILE DOCUMENT ELEMENT ARGUMENT...
trace() { exits 0 "$render" "$2" -e "$3" -q --path-trace -o "$1" "${@:4}"; }

if ! has_device "$render"; then
    skip 'there is no Vulkan device'
    finish slab_paths
fi

# compare DOCUMENT ELEMENT MESH [OF-WHAT-IS-TRACED]
compare() {
    check "$2 is drawn" exits 0 "$render" "$1" -e "$2" -q -m "$3" --lights none --size 48 --samples 128 -o drawn.exr
    # shellcheck disable=SC2086 # arguments, divided by spaces
    check "$2 is traced" trace traced.exr "$1" "$2" -m "$3" --lights none --size 48 --paths 64 ${4:-}
    check "the mean of $2 is the same drawn and traced" near "$("$mean_ratio" traced.exr drawn.exr)" 1 0.03
}
compare "$examples/slabs.mtlx" CoatedMetal sphere    # opaque below a clear coat
compare "$examples/slabs.mtlx" CarPaint sphere
compare "$examples/slabs.mtlx" WrappedSilk sphere    # below a coat that scatters
compare "$examples/slab_blends.mtlx" MetalToPlastic sphere
# rough media, which have the light of the environment from between the normal and the viewer
compare "$examples/slab_helpers.mtlx" AmberOnOak sphere
compare "$examples/slab_helpers.mtlx" DustyLacquer sphere
compare "$examples/slab_helpers.mtlx" AmberOnOak plane
compare "$examples/slabs.mtlx" MilkySheet plane --as-drawn

# A leaf in a lamp behind it, drawn and traced, in each channel.
cat >leaf.mtlx <<'XML'
<?xml version="1.0"?>
<materialx version="1.39">
  <slab name="leaf" type="BSDF"><input name="diffuse_albedo" type="color3" value="0.15, 0.35, 0.05"/><input name="f0" type="color3" value="0.045, 0.045, 0.045"/>
    <input name="roughness" type="float" value="0.4"/><input name="mean_free_path" type="vector3" value="0.02, 0.03, 0.012"/></slab>
  <slab_surface name="Leaf" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="leaf"/><input name="thin" type="boolean" value="true"/>
    <input name="surface_thickness" type="float" value="0.02"/></slab_surface>
</materialx>
XML
backlit='--camera 30,20 --environment none --lights directional_light --set u_lightData[0].direction=0.28,0.19,0.94 --set u_lightData[1].color=0,0,0'
# shellcheck disable=SC2086 # arguments, divided by spaces
{
    check 'a leaf before a lamp is drawn' exits 0 "$render" leaf.mtlx -e Leaf -q -m plane --size 16 $backlit -o drawn.exr
    check 'a leaf before a lamp is traced' trace traced.exr leaf.mtlx Leaf -m plane --size 16 --paths 256 $backlit
}
check 'a leaf has as much light from behind drawn and traced' near "$("$mean_ratio" traced.exr drawn.exr)" 1 0.04
for channel in R G; do # blue has less than the error of the fit
    check "a leaf has as much light from behind drawn and traced: $channel" \
        near "$(ratio "$(channel traced.exr $channel)" "$(channel drawn.exr $channel)")" 1 0.05
done
check 'a leaf is as opaque drawn as traced' near "$(ratio "$(channel traced.exr A)" "$(channel drawn.exr A)")" 1 0.02

# metal below media that scatter, which mirrors a part of the light
cat >milk.mtlx <<'XML'
<?xml version="1.0"?>
<materialx version="1.39">
  <slab name="milk" type="BSDF"><input name="diffuse_albedo" type="color3" value="0.9, 0.9, 0.9"/><input name="f0" type="color3" value="0, 0, 0"/>
    <input name="mean_free_path" type="vector3" value="1, 1, 1"/></slab>
  <slab name="chrome" type="BSDF"><input name="diffuse_albedo" type="color3" value="0, 0, 0"/><input name="f0" type="color3" value="0.8, 0.8, 0.8"/>
    <input name="roughness" type="float" value="0.1"/></slab>
  <slab name="steel" type="BSDF"><input name="diffuse_albedo" type="color3" value="0, 0, 0"/><input name="f0" type="color3" value="0.5, 0.5, 0.5"/>
    <input name="roughness" type="float" value="0.4"/></slab>
  <slab_layer name="thin" type="BSDF"><input name="top" type="BSDF" nodename="milk"/><input name="base" type="BSDF" nodename="chrome"/>
    <input name="thickness" type="float" value="0.2"/></slab_layer>
  <slab_layer name="thick" type="BSDF"><input name="top" type="BSDF" nodename="milk"/><input name="base" type="BSDF" nodename="steel"/>
    <input name="thickness" type="float" value="0.5"/></slab_layer>
  <slab_surface name="MilkOnChrome" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="thin"/></slab_surface>
  <slab_surface name="MilkOnSteel" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="thick"/></slab_surface>
</materialx>
XML
compare milk.mtlx MilkOnChrome sphere
compare milk.mtlx MilkOnSteel sphere

# Light from everywhere: what a white pile does not let straight on comes out of it, whatever it is made of.
write_white white.hdr
cat >white.mtlx <<'XML'
<?xml version="1.0"?>
<materialx version="1.39">
  <slab name="even" type="BSDF"><input name="diffuse_albedo" type="color3" value="1, 1, 1"/><input name="f0" type="color3" value="0, 0, 0"/>
    <input name="mean_free_path" type="vector3" value="0.01, 0.02, 0.04"/></slab>
  <slab name="forward" type="BSDF"><input name="diffuse_albedo" type="color3" value="1, 1, 1"/><input name="phase_anisotropy" type="float" value="0.6"/>
    <input name="mean_free_path" type="vector3" value="0.02, 0.02, 0.02"/></slab>
  <slab name="ground" type="BSDF"><input name="diffuse_albedo" type="color3" value="1, 1, 1"/></slab>
  <slab_coverage name="half" type="BSDF"><input name="in" type="BSDF" nodename="forward"/><input name="weight" type="float" value="0.5"/></slab_coverage>
  <slab_mix name="mixed" type="BSDF"><input name="fg" type="BSDF" nodename="half"/><input name="bg" type="BSDF" nodename="even"/><input name="mix" type="float" value="0.7"/></slab_mix>
  <slab_layer name="on_ground" type="BSDF"><input name="top" type="BSDF" nodename="mixed"/><input name="base" type="BSDF" nodename="ground"/></slab_layer>
  <slab_layer name="on_forward" type="BSDF"><input name="top" type="BSDF" nodename="mixed"/><input name="base" type="BSDF" nodename="forward"/></slab_layer>
  <slab_surface name="Stack" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="on_ground"/></slab_surface>
  <slab_surface name="Sheet" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="on_forward"/><input name="thin" type="boolean" value="true"/></slab_surface>
  <slab name="dense" type="BSDF"><input name="diffuse_albedo" type="color3" value="1, 1, 1"/><input name="f0" type="color3" value="0, 0, 0"/>
    <input name="mean_free_path" type="vector3" value="0.00125, 0.00125, 0.00125"/></slab>
  <slab_surface name="Dense" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="dense"/><input name="thin" type="boolean" value="true"/></slab_surface>
  <oren_nayar_diffuse_bsdf name="paper" type="BSDF"><input name="color" type="color3" value="1, 1, 1"/></oren_nayar_diffuse_bsdf>
  <surface name="Paper" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="paper"/></surface>
  <mix name="Sheets" type="surfaceshader"><input name="bg" type="surfaceshader" nodename="Stack"/><input name="fg" type="surfaceshader" nodename="Sheet"/>
    <input name="mix" type="float" value="0.4"/></mix>
  <slab name="snow" type="BSDF"><input name="diffuse_albedo" type="color3" value="1, 1, 1"/><input name="f0" type="color3" value="0, 0, 0"/>
    <input name="mean_free_path" type="vector3" value="20, 20, 20"/></slab>
  <dielectric_bsdf name="glass" type="BSDF"><input name="scatter_mode" type="string" value="RT"/><input name="roughness" type="vector2" value="0, 0"/></dielectric_bsdf>
  <mix name="snow_and_glass" type="BSDF"><input name="fg" type="BSDF" nodename="snow"/><input name="bg" type="BSDF" nodename="glass"/><input name="mix" type="float" value="0.5"/></mix>
  <slab_layer name="under_half" type="BSDF"><input name="top" type="BSDF" nodename="half"/><input name="base" type="BSDF" nodename="snow_and_glass"/></slab_layer>
  <slab_surface name="Solid" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="under_half"/></slab_surface>
  <surface name="Holes" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="paper"/><input name="opacity" type="float" value="0.6"/></surface>
  <mix name="Mixed" type="surfaceshader"><input name="bg" type="surfaceshader" nodename="Sheets"/><input name="fg" type="surfaceshader" nodename="Holes"/>
    <input name="mix" type="float" value="0.3"/></mix>
  <slab name="brushed" type="BSDF"><input name="diffuse_albedo" type="color3" value="0, 0, 0"/><input name="f0" type="color3" value="1, 1, 1"/>
    <input name="roughness" type="float" value="0.8"/><input name="anisotropy" type="float" value="0.9"/></slab>
  <slab_surface name="Brushed" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="brushed"/></slab_surface>
  <slab name="clear" type="BSDF"><input name="diffuse_albedo" type="color3" value="0, 0, 0"/><input name="f0" type="color3" value="0, 0, 0"/>
    <input name="mean_free_path" type="vector3" value="0.01, 0.01, 0.01"/></slab>
  <slab_surface name="Clear" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="clear"/><input name="thin" type="boolean" value="true"/></slab_surface>
</materialx>
XML
for element in Stack Sheet Mixed Solid; do # a body beside glass, below a coat that scatters
    check "$element is traced in even light" trace even.exr white.mtlx $element -m sphere --lights none --environment white.hdr --size 32 --paths 256 --bounces 64
    light=$(of "($(channel even.exr R) + $(channel even.exr G) + $(channel even.exr B)) / 3 + 1 - $(channel even.exr A)")
    check "$element loses no light" near "$light" 1 0.01
done

# A rough anisotropic metal loses no light, drawn or traced.
check 'an anisotropic metal is traced' trace even.exr white.mtlx Brushed -m sphere --lights none --environment white.hdr --size 32 --paths 128
check 'the anisotropic metal loses no light' near "$(ratio "$(channel even.exr R)" "$(channel even.exr A)")" 1 0.015
check 'the anisotropic metal is drawn' exits 0 "$render" white.mtlx -e Brushed -q -m sphere --lights none --environment white.hdr --size 32 --samples 256 -o drawn.exr
check 'the drawn metal has as much light as the traced one' near "$("$mean_ratio" even.exr drawn.exr)" 1 0.01

# A quad in the light of one lamp, before and behind it. A white sheet sends all of it to one side or the other.
printf 'v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvn 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1/1 2/2/1 3/3/1 4/4/1\n' >quad.obj
# lit ELEMENT Z: in the light that goes to this z.
lit() {
    trace lit.exr white.mtlx "$1" -m quad.obj --camera 30,20 --environment none --lights directional_light --size 24 --paths 64 \
        --set "u_lightData[0].direction=0.3,0.2,$2" --set 'u_lightData[1].color=0,0,0' && channel lit.exr R
}
before=$(lit Dense -1) behind=$(lit Dense 1) paper=$(lit Paper -1)
check 'paper has no light from behind' near "$(lit Paper 1)" 0 0.001
check 'a sheet has light from behind' awk -v a="$behind" -v b="$paper" 'BEGIN { exit !(a > 0.1 * b) }'
check 'all light of a lamp goes to one side of a sheet or the other' \
    near "$(of "($before + $behind) / $paper")" 1 0.03

check 'a clear sheet is traced' trace clear.exr white.mtlx Clear -m quad.obj --camera 0,0 --environment none --lights none --size 24 --paths 64
check 'paper is traced' trace full.exr white.mtlx Paper -m quad.obj --camera 0,0 --environment none --lights none --size 24 --paths 16
check 'a clear sheet lets exp(-1) through' near "$(of "$(channel clear.exr A) / $(channel full.exr A)")" 0.632 0.01

# A surface with holes beside a sheet, and the same as slabs of one surface. The metal is the AOV of its own definition.
cat >mixed.mtlx <<'XML'
<?xml version="1.0"?>
<materialx version="1.39">
  <nodedef name="ND_metal" node="metal"><output name="out" type="surfaceshader"/></nodedef>
  <nodegraph name="NG_metal" nodedef="ND_metal">
    <slab name="top" type="BSDF"><input name="diffuse_albedo" type="color3" value="0.9, 0.8, 0.6"/><input name="mean_free_path" type="vector3" value="0.01, 0.02, 0.04"/></slab>
    <slab name="base" type="BSDF"><input name="f0" type="color3" value="0.9, 0.7, 0.3"/><input name="roughness" type="float" value="0.3"/></slab>
    <slab_layer name="coated" type="BSDF"><input name="top" type="BSDF" nodename="top"/><input name="base" type="BSDF" nodename="base"/></slab_layer>
    <aov name="shown" type="BSDF"><input name="name" type="string" value="metal"/><input name="value" type="BSDF" nodename="coated"/></aov>
    <surface name="surface" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="coated"/><input name="opacity" type="float" value="0.6"/></surface>
    <output name="out" type="surfaceshader" nodename="surface"/>
  </nodegraph>
  <slab name="milk" type="BSDF"><input name="diffuse_albedo" type="color3" value="0.9, 0.8, 0.6"/><input name="mean_free_path" type="vector3" value="0.01, 0.02, 0.04"/></slab>
  <slab name="gold" type="BSDF"><input name="f0" type="color3" value="0.9, 0.7, 0.3"/><input name="roughness" type="float" value="0.3"/></slab>
  <slab_layer name="coated" type="BSDF"><input name="top" type="BSDF" nodename="milk"/><input name="base" type="BSDF" nodename="gold"/></slab_layer>
  <slab_coverage name="holes" type="BSDF"><input name="in" type="BSDF" nodename="coated"/><input name="weight" type="float" value="0.6"/></slab_coverage>
  <metal name="Metal" type="surfaceshader"/>
  <slab_surface name="Sheet" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="milk"/><input name="thin" type="boolean" value="true"/>
    <input name="surface_thickness" type="float" value="0.02"/></slab_surface>
  <mix name="Mixed" type="surfaceshader"><input name="bg" type="surfaceshader" nodename="Metal"/><input name="fg" type="surfaceshader" nodename="Sheet"/>
    <input name="mix" type="float" value="0.35"/></mix>
  <slab_mix name="all" type="BSDF"><input name="bg" type="BSDF" nodename="holes"/><input name="fg" type="BSDF" nodename="milk"/><input name="mix" type="float" value="0.35"/></slab_mix>
  <slab_surface name="One" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="all"/><input name="thin" type="boolean" value="true"/>
    <input name="surface_thickness" type="float" value="0.02"/></slab_surface>
  <slab_coverage name="some" type="BSDF"><input name="in" type="BSDF" nodename="holes"/><input name="weight" type="float" value="0.65"/></slab_coverage>
  <slab_surface name="Some" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="some"/></slab_surface>
</materialx>
XML
for element in Mixed One Some; do
    check "$element is traced on a quad" trace $element.exr mixed.mtlx $element -m quad.obj --camera 30,20 --lights none --size 24 --paths 1024
done
check 'a mix of surfaces has the light of a mix of slabs' near "$("$mean_ratio" Mixed.exr One.exr)" 1 0.01
check 'a mix of surfaces lets as much light through' near "$(of "$(channel Mixed.exr A) / $(channel One.exr A)")" 1 0.01
check 'the AOV of a closure is its light' near "$(of "$(channel Mixed.exr metal.R) / $(channel Some.exr R)")" 1 0.01
# On a ball paths meet many surfaces, so a pixel's paths need several runs of a kernel. An AOV takes half of them, and no light.
sed '/<aov /d' mixed.mtlx >bare.mtlx
for name in mixed bare; do
    check "$name is traced on a ball" trace $name.exr $name.mtlx Mixed -m sphere --lights none --size 32 --paths 256
done
check 'no run of a kernel loses light' near "$(of "$(channel bare.exr R) / $(channel mixed.exr R)")" 1 0.02

# Slabs among other closures. A coat that is as clear as air makes a pile of what is a list of leaves without it.
cat >among.mtlx <<'XML'
<?xml version="1.0"?>
<materialx version="1.39">
  <slab name="milk" type="BSDF"><input name="diffuse_albedo" type="color3" value="0.9, 0.5, 0.3"/><input name="mean_free_path" type="vector3" value="0.03, 0.02, 0.01"/></slab>
  <slab name="air" type="BSDF"><input name="f0" type="color3" value="0, 0, 0"/><input name="mean_free_path" type="vector3" value="1000, 1000, 1000"/></slab>
  <slab name="ground" type="BSDF"><input name="diffuse_albedo" type="color3" value="0.8, 0.7, 0.2"/></slab>
  <slab_layer name="coated" type="BSDF"><input name="top" type="BSDF" nodename="milk"/><input name="base" type="BSDF" nodename="ground"/></slab_layer>
  <slab_layer name="bare" type="BSDF"><input name="top" type="BSDF" nodename="air"/><input name="base" type="BSDF" nodename="ground"/></slab_layer>
  <oren_nayar_diffuse_bsdf name="paper" type="BSDF"><input name="color" type="color3" value="0.3, 0.4, 0.5"/></oren_nayar_diffuse_bsdf>
  <multiply name="tinted" type="BSDF"><input name="in1" type="BSDF" nodename="coated"/><input name="in2" type="color3" value="0.9, 0.5, 0.2"/></multiply>
  <multiply name="some" type="BSDF"><input name="in1" type="BSDF" nodename="paper"/><input name="in2" type="float" value="0.4"/></multiply>
  <multiply name="rest" type="BSDF"><input name="in1" type="BSDF" nodename="coated"/><input name="in2" type="float" value="0.6"/></multiply>
  <add name="sum" type="BSDF"><input name="in1" type="BSDF" nodename="some"/><input name="in2" type="BSDF" nodename="rest"/></add>
  <sheen_bsdf name="dust" type="BSDF"><input name="weight" type="float" value="0.8"/></sheen_bsdf>
  <multiply name="red" type="BSDF"><input name="in1" type="BSDF" nodename="dust"/><input name="in2" type="color3" value="0.9, 0.1, 0.1"/></multiply>
  <dielectric_bsdf name="glass" type="BSDF"><input name="scatter_mode" type="string" value="RT"/><input name="roughness" type="vector2" value="0.1, 0.1"/></dielectric_bsdf>
  <surface name="Coated" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="coated"/></surface>
  <surface name="Paper" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="paper"/></surface>
  <surface name="Tinted" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="tinted"/></surface>
  <surface name="Sum" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="sum"/></surface>
XML
# pair NAME NODE INPUT INPUT ATTRIBUTE...: NAMEPile and NAMEList, with the ground below air in the first.
pair() {
    local ground
    for ground in bare ground; do
        name=$1$([ $ground = bare ] && echo Pile || echo List)
        printf '  <%s name="%s_" type="BSDF">' "$2" "$name"
        printf '<input name="%s" type="BSDF" nodename="%s"/>' "$3" "${4/ground/$ground}" "$5" "${6/ground/$ground}"
        printf '%s</%s>\n  <surface name="%s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="%s_"/></surface>\n' "${7:-}" "$2" "$name" "$name"
    done >>among.mtlx
}
pair Dusty layer top red base ground
pair Chipped mix fg ground bg glass '<input name="mix" type="float" value="0.4"/>'
cat >>among.mtlx <<'XML'
  <slab name="amber" type="BSDF"><input name="diffuse_albedo" type="color3" value="0, 0, 0"/><input name="f0" type="color3" value="0, 0, 0"/>
    <input name="mean_free_path" type="vector3" value="0.05, 0.03, 0.02"/></slab>
  <dielectric_bsdf name="gas" type="BSDF"><input name="scatter_mode" type="string" value="RT"/><input name="ior" type="float" value="1"/>
    <input name="roughness" type="vector2" value="0.05, 0.05"/></dielectric_bsdf>
  <anisotropic_vdf name="green" type="VDF"><input name="absorption" type="vector3" value="1, 0.1, 0.7"/></anisotropic_vdf>
  <layer name="filled" type="BSDF"><input name="top" type="BSDF" nodename="glass"/><input name="base" type="VDF" nodename="green"/></layer>
  <slab_layer name="bottle" type="BSDF"><input name="top" type="BSDF" nodename="air"/><input name="base" type="BSDF" nodename="filled"/></slab_layer>
  <slab_layer name="balloon" type="BSDF"><input name="top" type="BSDF" nodename="amber"/><input name="base" type="BSDF" nodename="gas"/></slab_layer>
  <surface name="BottlePile" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="bottle"/></surface>
  <surface name="BottleList" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="filled"/></surface>
  <surface name="Balloon" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="balloon"/></surface>
</materialx>
XML
for element in Coated Paper Tinted Sum DustyPile DustyList ChippedPile ChippedList BottlePile BottleList Balloon; do
    check "$element is traced" trace $element.exr among.mtlx $element -m sphere --lights none --size 32 --paths 256
done
for channel in 'R 0.9' 'G 0.5' 'B 0.2'; do
    # shellcheck disable=SC2086 # a name and a number
    set -- $channel
    coated=$(channel Coated.exr "$1")
    check "a scaled pile has the scaled light: $1" near "$(ratio "$(channel Tinted.exr "$1")" "$coated")" "$2" 0.02
    check "a sum has the light of its parts: $1" near "$(of "$(channel Sum.exr "$1") / ($(channel Paper.exr "$1") * 0.4 + $coated * 0.6)")" 1 0.02
    check "scaled dust has the light of a list of leaves: $1" near "$(of "$(channel DustyPile.exr "$1") / $(channel DustyList.exr "$1")")" 1 0.02
    check "a pile above glass has the light of a list of leaves: $1" near "$(of "$(channel BottlePile.exr "$1") / $(channel BottleList.exr "$1")")" 1 0.02
    check "a pile beside glass has the light of a list of leaves: $1" near "$(of "$(channel ChippedPile.exr "$1") / $(channel ChippedList.exr "$1")")" 1 0.02
done
for element in ChippedPile ChippedList Balloon; do
    check "$element is traced as drawn" trace drawn_$element.exr among.mtlx $element -m sphere --lights none --size 32 --paths 256 --as-drawn
done
check 'a pile beside glass has the light of a list of leaves as drawn' near "$("$mean_ratio" drawn_ChippedPile.exr drawn_ChippedList.exr)" 1 0.01
# light pays for the coat where it goes in and where it comes out
check 'a balloon has its light as drawn' near "$("$mean_ratio" drawn_Balloon.exr Balloon.exr)" 1 0.02
for element in Coated Tinted Sum DustyPile ChippedPile BottlePile Balloon; do # or the pictures compare lists of leaves
    check "$element is a pile" eval "'$mxgen' among.mtlx -e $element --role scatter --stdout | grep -q out9"
done

# Picks of a closure.
check 'a material is traced with one pick' trace one.exr "$examples/slabs.mtlx" CarPaint -m sphere --lights none --size 32 --paths 512
check 'a material is traced with sixteen picks' trace more.exr "$examples/slabs.mtlx" CarPaint -m sphere --lights none --size 32 --paths 32 --picks 16
check 'the number of picks does not change the mean' near "$("$mean_ratio" one.exr more.exr)" 1 0.03

finish slab_paths
