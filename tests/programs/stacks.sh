#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Shaders of stacks (docs/slots.md, "Shaders"). Arguments: mxgen, mxgen-compile ('' to compile nothing).
mxgen=$(realpath "$1") compile=${2:+$(realpath "$2")}
here=$(cd "$(dirname "$0")" && pwd)
examples=$here/../../examples
. "$here/common.sh"
[ -n "$compile" ] || skip 'without glslang no shader is compiled'

# shader PATH...: the pixel stage of the stack of the primitive /PATH, and its main function in the file main.
stacks() { "$mxgen" look.mtlx --stage stage.txt --target vulkan --interface reduced -o out.d "$@"; }
program() { # PATH
    python3 -c "
import json, sys
d = json.load(open('out.d/bindings.json'))
stack = {p['path']: p['stack'] for p in d['primitives']}['$1']
print({s['name']: s['program'] for s in d['stacks']}[stack])"
}
shader() { sed -n '/void main/,$p' "out.d/$(program "$1").frag" >main; }
# Runs Python on bindings.json: `d`, its stacks by name `s`, the stack of a primitive `of(path)`.
json() {
    python3 -c "
import json
d = json.load(open('out.d/bindings.json'))
s = {x['name']: x for x in d['stacks']}
of = lambda path: s[next(p['stack'] for p in d['primitives'] if p['path'] == path)]
value = lambda path, name: next(v['value'] for v in of(path)['values'] if v['name'] == name)
assert $1, d"
}

document() { # LOOK...: the lines of a look over materials
    cat >look.mtlx <<XML
<?xml version="1.0"?>
<materialx version="1.39">
  <surface_unlit name="s_red" type="surfaceshader"><input name="emission_color" type="color3" value="1, 0, 0"/></surface_unlit>
  <surface_unlit name="s_blue" type="surfaceshader"><input name="emission_color" type="color3" value="0, 0, 1"/></surface_unlit>
  <surface_unlit name="s_half" type="surfaceshader">
    <input name="emission_color" type="color3" value="0, 1, 0"/><input name="opacity" type="float" value="0.5"/>
  </surface_unlit>
  <surfacematerial name="red" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s_red"/></surfacematerial>
  <surfacematerial name="half" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s_half"/></surfacematerial>
  <substance name="quarter" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="s_blue"/><input name="mask" type="float" value="0.25"/>
  </substance>
  <substance name="leaf" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="s_red"/><input name="cutout" type="float" value="0.5"/>
  </substance>
  <nodegraph name="NG_half"><constant name="c" type="float"><input name="value" type="float" value="0.5"/></constant>
    <output name="mask" type="float" nodename="c"/></nodegraph>
  <nodegraph name="NG_green"><constant name="c" type="color3"><input name="value" type="color3" value="0, 1, 0"/></constant>
    <output name="emission_color" type="color3" nodename="c"/></nodegraph>
  $1
</materialx>
XML
}
# out1 is a constant in these documents: the colour of the layers by their weights.
out1() { grep -qF "out1 = $1;" main; }

printf '/a/b\n/c\n' >stage.txt
document '<look name="L"><materialassign material="red" geom="/"/><materialassign slot="050" material="quarter" geom="/a/b"/>
  <materialassign slot="060" material="half" geom="/a/b"/></look>'
check 'stacks with weights are generated' exits 0 stacks
check 'a line counts stacks and programs' grep -qx '2 stacks, 2 programs' out
shader /a/b
# 060: 0.5; 050: 0.25 · 0.5; 000: 0.75 · 0.5
check 'opacity and mask hide what is below' out1 'vec4(0.375, 0.5, 0.125, 1.0)'
shader /c
check 'one layer has its colour' out1 'vec4(1.0, 0.0, 0.0, 1.0)'
document '<look name="L"><materialassign material="quarter" geom="/"/></look>'
check 'a masked layer is generated alone' exits 0 stacks
shader /c
check 'a masked layer is transparent where its mask is 0' out1 'vec4(0.0, 0.0, 0.25, 0.25)'
document '<look name="L"><materialassign material="leaf" geom="/"/><materialassign slot="050" material="quarter" geom="/"/></look>'
check 'a layer with a cutout is generated' exits 0 stacks
shader /c
check 'a cutout makes a hole in all layers' out1 'vec4(0.375, 0.0, 0.125, 0.5)'
document '<oren_nayar_diffuse_bsdf name="matt" type="BSDF"><input name="weight" type="float" value="0.5"/></oren_nayar_diffuse_bsdf>
  <surface name="s_matt" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="matt"/></surface>
  <substance name="coat" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="s_matt"/><input name="mask" type="float" value="0.5"/>
  </substance>
  <look name="L"><materialassign material="red" geom="/"/><materialassign slot="000|010" material="coat" geom="/a"/>
    <materialassign slot="000|020" material="coat" geom="/a/b"/><materialassign slot="000|010" material="half" geom="/c"/></look>'
check 'vertical layers are generated' exits 0 stacks --environment none --lights none
shader /a
# T of the coat is 0.5: 1 - 0.5 + 0.5 · 0.5
check 'a vertical layer takes light of its base' out1 'vec4(0.75, 0.0, 0.0, 1.0)'
shader /a/b
check 'vertical layers lie on each other' out1 'vec4(0.5625, 0.0, 0.0, 1.0)'
shader /c
check 'a vertical layer adds its own light' out1 'vec4(1.0, 0.5, 0.0, 1.0)'
document '<look name="L"><materialassign material="red" geom="/a"/></look>'
check 'a primitive without layers is generated' exits 0 stacks --environment none
shader /c
check 'a primitive without layers is white' grep -q '0.8' main

document '<look name="L"><materialassign material="red" geom="/"/><materialassign slot="000::010" nodegraph="NG_half" geom="/a"/>
  <materialassign slot="000::020" nodegraph="NG_green" geom="/a/b"/></look>'
check 'overrides are generated' exits 0 stacks
shader /a
check 'an override drives the mask of a material' out1 'vec4(0.5, 0.0, 0.0, 0.5)'
shader /a/b
check 'an override drives an input of a shader' out1 'vec4(0.0, 0.5, 0.0, 0.5)'
check 'overrides are generated as uniforms' exits 0 stacks --interface complete
check 'stacks that differ in values share a program' grep -qx '3 stacks, 2 programs' out
check 'uniforms have the names of slots' json 'value("/c", "x000_s_red_emission_color") == [1, 0, 0] and of("/c")["values"][0]["slot"] == "000"'
check 'a stack has its values under the names of the program' json 'value("/a/b", "x000_s_red_emission_color") == [0, 1, 0] if of("/a/b")["program"] == of("/a")["program"] else 0'

# One layer runs: each pattern stands in a block of its own, and no two conditions hold for one number.
cat >look.mtlx <<'XML'
<?xml version="1.0"?>
<materialx version="1.39">
  <worleynoise3d name="worley" type="float"/><fractal3d name="fractal" type="float"/><cellnoise3d name="cell" type="float"/>
  <image name="photo" type="float"><input name="file" type="filename" value="photo.png"/></image>
  <noise2d name="noise" type="float"/><image name="stencil" type="float"><input name="file" type="filename" value="stencil.png"/></image>
  <standard_surface name="a" type="surfaceshader"><input name="base" type="float" nodename="worley"/></standard_surface>
  <standard_surface name="b" type="surfaceshader"><input name="specular_roughness" type="float" nodename="fractal"/></standard_surface>
  <standard_surface name="c" type="surfaceshader"><input name="base" type="float" nodename="photo"/><input name="specular" type="float" nodename="cell"/></standard_surface>
  <substance name="A" type="material"><input name="surfaceshader" type="surfaceshader" nodename="a"/></substance>
  <substance name="B" type="material"><input name="surfaceshader" type="surfaceshader" nodename="b"/><input name="mask" type="float" nodename="noise"/></substance>
  <substance name="C" type="material"><input name="surfaceshader" type="surfaceshader" nodename="c"/><input name="mask" type="float" nodename="stencil"/></substance>
  <look name="L"><materialassign material="A" geom="/"/><materialassign slot="050" material="B" geom="/"/><materialassign slot="060" material="C" geom="/"/></look>
</materialx>
XML
cat >layers.py <<'PY'
"""The layers that run for a number: those whose patterns stand in a block whose condition holds. Argument: the file of the main function."""
import re
import sys

patterns = {"000": r"worley", "050": r"fractal", "060": r"textureGrad\("}
blocks, open_blocks = {slot: [] for slot in patterns}, []
for line in open(sys.argv[1]).read().split("\n"):
    text = line.strip()
    for slot, pattern in patterns.items():
        if re.search(pattern, text):
            blocks[slot].append([b for b in open_blocks if "pick" in b])
    open_blocks += [text] if text.endswith("{") else []
    open_blocks = open_blocks[:-1] if text.startswith("}") else open_blocks
assert all(blocks.values()), f"a pattern is missing: {blocks}"
conditions = {slot: {c for found in list_ for c in found} for slot, list_ in blocks.items()}
assert all(len(list_) == 1 for found in blocks.values() for list_ in found), f"a pattern runs for all layers: {blocks}"
assert all(len(c) == 1 for c in conditions.values()) and len(set.union(*conditions.values())) == 3, conditions
PY
check 'stochastic layers are generated' exits 0 stacks --slots stochastic
shader /c
check 'a stochastic shader runs one layer' python3 layers.py main
check 'textures of a layer have derivatives from before the pick' eval 'grep -n "dFdx" main | head -1 | cut -d: -f1 | { read at; [ "$at" -lt "$(grep -n "if (pick" main | head -1 | cut -d: -f1)" ]; }'
check 'masks are read for all layers' eval 'grep -q "^    .*texture(.*stencil" main && grep -q "^    .*mx_noise_float" main'
check 'blended layers are generated' exits 0 stacks
shader /c
check 'a blended shader runs all layers' exits 1 python3 layers.py main
for target in glsl essl hlsl; do
    [ -z "$compile" ] || check "stochastic, $target" exits 0 "$compile" look.mtlx --stage stage.txt --slots stochastic --targets $target --interfaces complete
done
check 'stochastic layers are generated for OSL' exits 0 "$mxgen" look.mtlx --stage stage.txt --slots stochastic --target osl -o osl.d
check 'OSL picks a closure by a hash' eval 'grep -q "if (layerSample" osl.d/*.osl && grep -q "hashnoise(P, time)" osl.d/*.osl'
check 'stacks are generated for a path tracer' exits 0 stacks --role scatter
check 'a path tracer picks a layer' eval '[ "$(grep -cE "^    if \(.*(distance|product|random|w)" out.d/$(program /c).frag)" -ge 1 ]'

# Two layers of one material: their locals have one name, and the slot tells them apart, in every target.
cat >twins.mtlx <<'XML'
<materialx version="1.39">
  <fractal3d name="noise" type="float"/>
  <standard_surface name="s" type="surfaceshader"><input name="specular_roughness" type="float" nodename="noise"/></standard_surface>
  <substance name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s"/></substance>
  <nodegraph name="other"><constant name="c" type="float"><input name="value" type="float" value="0.4"/></constant>
    <output name="specular_roughness" type="float" nodename="c"/><output name="mask" type="float" nodename="c"/></nodegraph>
  <look name="L"><materialassign slot="a" material="M" geom="/"/><materialassign slot="b" material="M" geom="/"/>
    <materialassign slot="b::x" nodegraph="other" geom="/"/></look>
</materialx>
XML
echo /c >one.txt
for target in glsl vulkan essl hlsl osl; do
    check "layers of one material are generated for $target" exits 0 "$mxgen" twins.mtlx --look L --stage one.txt --target $target -o twins.d/$target
    cat twins.d/$target/stack_* >twins
    check 'locals have the slot in their names' grep -qE "^ +[a-zA-Z_0-9 ]+_[ab] =" twins
    check 'locals have no number in the place of the slot' eval '! grep -E "^ +(closure color|vec.|float.?) (metal|reflection|diffuse)[a-z_]*_2 =" twins | grep -v "_[ab]_2 ="'
done

# Slabs: the opacity of their lobes weighs a layer.
slabs='<slab name="metal" type="BSDF"><input name="diffuse_albedo" type="color3" value="0, 0, 0"/><input name="f0" type="color3" value="1, 0.8, 0.3"/></slab>
  <slab name="coat" type="BSDF"><input name="mean_free_path" type="vector3" value="0.006, 0.015, 0.2"/></slab>
  <slab_coverage name="part" type="BSDF"><input name="in" type="BSDF" nodename="metal"/><input name="weight" type="float" value="0.25"/></slab_coverage>
  <slab_surface name="s_part" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="part"/></slab_surface>
  <slab_surface name="s_sheet" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="coat"/><input name="thin" type="boolean" value="true"/></slab_surface>
  <surfacematerial name="part_of" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s_part"/></surfacematerial>
  <surfacematerial name="sheet" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s_sheet"/></surfacematerial>'
document "$slabs <look name='L'><materialassign material='red' geom='/'/><materialassign slot='050' material='part_of' geom='/a/b'/>
  <materialassign slot='000|010' material='sheet' geom='/c'/></look>"
check 'slabs in layers are generated' exits 0 stacks
shader /a/b
check 'a layer of slabs hides by its coverage' grep -q 'vec3 color = vec3(0.75, 0.0, 0.0);' main
shader /c
check 'light passes a sheet of slabs' eval 'grep -q "medium" main && grep -q "out1 = vec4(color, 1.0);" main'
for slots in blend stochastic; do
    check "slabs in layers are traced with $slots" exits 0 stacks --slots $slots --role scatter
    [ -z "$compile" ] || check "it compiles for all targets" exits 0 "$compile" look.mtlx --stage stage.txt --slots $slots --role scatter --targets glsl,essl,essl310,vulkan,hlsl --interfaces complete
    check "slabs in layers are generated for OSL with $slots" exits 0 "$mxgen" look.mtlx --stage stage.txt --slots $slots --target osl -o osl.d
    [ -z "$compile" ] || check "slabs, $slots" exits 0 "$compile" look.mtlx --stage stage.txt --slots $slots --targets vulkan,hlsl --interfaces complete
done

# Textures: equal ones count once, and a target has few.
pictures() { # NUMBER NAME OFFSET: a surface that reads so many pictures
    echo "<nodegraph name='NG_$2'>"
    for i in $(seq "$1"); do
        echo "<image name='i$i' type='float'><input name='file' type='filename' value='$((i + $3)).png'/></image>"
        echo "<add name='s$i' type='float'><input name='in1' type='float' nodename='i$i'/>"
        [ "$i" = 1 ] || echo "<input name='in2' type='float' nodename='s$((i - 1))'/>"
        echo '</add>'
    done
    echo "<output name='out' type='float' nodename='s$1'/></nodegraph>"
    echo "<standard_surface name='s_$2' type='surfaceshader'><input name='base' type='float' nodegraph='NG_$2'/><input name='opacity' type='color3' value='0.5, 0.5, 0.5'/></standard_surface>"
    echo "<surfacematerial name='$2' type='material'><input name='surfaceshader' type='surfaceshader' nodename='s_$2'/></surfacematerial>"
}
document "$(pictures 8 P 0) $(pictures 8 Q 4) <look name='L'><materialassign material='P' geom='/'/><materialassign slot='050' material='Q' geom='/'/></look>"
check 'layers with textures are generated' exits 0 "$mxgen" look.mtlx --stage stage.txt --target essl --environment none -o out.d
check 'equal textures of layers count once' json 'sorted(t["file"] for t in of("/c")["textures"]) == sorted(f"{i}.png" for i in range(1, 13))'
document "$(pictures 12 P 0) $(pictures 8 Q 12) <look name='L'><materialassign material='P' geom='/'/><materialassign slot='050' material='Q' geom='/'/></look>"
check 'too many textures fail' exits 1 "$mxgen" look.mtlx --stage stage.txt --target essl --environment none -o out.d
check 'the error names the slots' grep -q "reads 20 textures, .* at most 16 in essl; .*: '000', '050' \[texture-limit\]" err
check 'another target takes these textures' exits 0 "$mxgen" look.mtlx --stage stage.txt --target vulkan --environment none -o out.d
# So may one material.
textures() { # N: a document with N images in one sum
    echo '<materialx version="1.39"><constant name="s0" type="color3"/>'
    for i in $(seq "$1"); do echo "<image name=\"i$i\" type=\"color3\"><input name=\"file\" type=\"filename\" value=\"$i.png\"/></image><add name=\"s$i\" type=\"color3\"><input name=\"in1\" type=\"color3\" nodename=\"s$((i - 1))\"/><input name=\"in2\" type=\"color3\" nodename=\"i$i\"/></add>"; done
    echo "<output name=\"o\" type=\"color3\" nodename=\"s$1\"/></materialx>"
}
textures 16 >few.mtlx
textures 17 >many.mtlx
for target in essl msl wgsl; do
    check "$target has 16 textures" exits 0 "$mxgen" few.mtlx --target $target -o few
    check "$target has no 17" eval 'exits 1 "$mxgen" many.mtlx --target $target -o many && grep -q "reads 17 textures, .* at most 16 in $target \[texture-limit\]" err'
done

# Looks without a scene.
document '<look name="base"><materialassign slot="a b" material="red" geom="/"/><materialassign slot="050" nodegraph="NG_half" geom="/"/></look>
  <look name="day" inherit="base"><materialassign material="red" geom="/{a"/><materialassign material="nothing" geom="/"/></look><look name="night" inherit="base"/>'
check 'a look with faults is not valid' exits 1 "$mxgen" validate look.mtlx
check 'validate reports faults of slots once' eval '[ "$(grep -c "\[bad-slot\]" err)" = 1 ] && [ "$(grep -c "\[override-needed\]" err)" = 1 ]'
check 'validate reports faults of geometry' grep -q '\[bad-geometry-name\]' err
check 'validate reports each place once' eval '[ "$(grep -cE "look.mtlx:.*: (error|warning)" err)" = "$(grep -oE "look.mtlx:[0-9]*:[0-9]*: (error|warning)" err | sort -u | wc -l)" ]'

# Faults of overrides: once each, whatever the number of primitives.
document '<nodegraph name="NG_text"><geompropvalue name="g" type="float"><input name="geomprop" type="string" value="g"/></geompropvalue>
    <constant name="c" type="string"/>
    <output name="emission_colour" type="float" nodename="g"/><output name="emission" type="string" nodename="c"/></nodegraph>
  <nodegraph name="NG_mode"><geompropvalue name="m" type="string"><input name="geomprop" type="string" value="m"/></geompropvalue>
    <output name="normal_mode" type="string" nodename="m"/></nodegraph>
  <look name="L"><materialassign material="quarter" geom="/"/><materialassign slot="000::010" nodegraph="NG_text" geom="/"/>
    <materialassign slot="000::020" nodegraph="NG_mode" geom="/"/></look>'
check 'faulty overrides fail' exits 1 stacks
check 'an output that drives nothing is a warning with a suggestion' eval '[ "$(grep -c override-unmatched err)" = 1 ] && grep -q "did you mean .emission_color" err'
check 'an output of another type is an error' eval '[ "$(grep -c override-type err)" = 1 ] && grep -q "s_blue/emission. *, which has the type float" err'
check 'a varying output for a uniform input is an error' eval '[ "$(grep -c override-varies err)" = 1 ] && grep -q "quarter/normal_mode" err'

# The example in every target.
for look in default pattern metal replaced red light clean sign_add sign_none finished; do
    check "the look $look of examples/slots/looks.mtlx is generated for OSL" exits 0 "$mxgen" "$examples/slots/looks.mtlx" --stage "$examples/slots/receiver.usda" --look "$look" --target osl -o osl.d
    [ -z "$compile" ] || check "examples/slots/looks.mtlx, $look, compiles" exits 0 "$compile" "$examples/slots/looks.mtlx" --stage "$examples/slots/receiver.usda" --look "$look"
done
if [ -n "$compile" ]; then
    check 'the example compiles for every other target' exits 0 "$compile" "$examples/slots/looks.mtlx" --stage "$examples/slots/receiver.usda" --look finished \
        --targets hlsl,essl310 --interfaces reduced
fi

# Arguments that do not go together.
check 'a look without a scene is wrong usage' exits 2 "$mxgen" look.mtlx --look L
check 'an element of a scene is wrong usage' exits 2 stacks --element red
check 'a scene on standard output is wrong usage' exits 2 stacks --stdout
# A document says more of primitives than their layers.
cat >look.mtlx <<'XML'
<?xml version="1.0"?>
<materialx version="1.39">
  <surface_unlit name="S" type="surfaceshader"/>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
  <collection name="C" includegeom="/a/b"/>
  <geominfo name="g1" geom="/a"><geomprop name="id" type="integer" value="3"/><token name="Asset" type="string" value="car"/></geominfo>
  <geominfo name="g2" geom="/a/b/*"><geomprop name="id" type="integer" value="4"/></geominfo>
  <propertyset name="PS"><property name="blur" type="boolean" value="true" target="fast"/></propertyset>
  <look name="parent">
    <visibility name="v" geom="/a/b" vistype="camera" visible="false"/>
    <propertyassign property="matte" type="boolean" value="false" geom="/a"/>
    <materialassign material="M" geom="/"/>
  </look>
  <look name="L" inherit="parent">
    <propertyassign property="matte" type="boolean" value="true" collection="C"/>
    <propertysetassign propertyset="PS" geom="/a/c"/>
  </look>
</materialx>
XML
printf '/a/b/d\n/a/c\n/e\n' >stage.txt
fact() { json "next((f['value'], f.get('target')) for p in d['primitives'] if p['path'] == '$1' for f in p.get('$2', []) if f['name'] == '$3') == ('$4', ${5:-None})"; }
check 'a look with facts is generated' exits 0 stacks --look L
check 'a geometric property is inherited' fact /a/b geomprops id 3
check 'a geometric property of a deeper path wins' fact /a/b/d geomprops id 4
check 'a primitive has its tokens' fact /a/c tokens Asset car
check 'a property of the look beats that of its parent' fact /a/b/d properties matte true
check 'a property does not count where it does not stand' fact /a/c properties matte false
check 'a primitive has a set of properties' fact /a/c properties blur true '"fast"'
check 'a primitive has its visibility' fact /a/b/d visibility camera false
check 'other primitives have no facts' json 'set(d["primitives"][-1]) == {"path", "stack"}'
sed -i 's|  <propertyset name|  <geompropdef name="h" type="vector2" unittype="distance" unit="centimeter"/><tokendefault name="Asset" type="string" value="none"/><tokendefault name="Part" type="string" value="lid"/>\n  <geominfo name="g3" geom="/a"><geomprop name="h" type="vector2" value="3, 0.5" unit="meter" unittype="distance"/></geominfo>\n  <geominfo name="g4" geom="/a/c"><geomprop name="h" type="vector2" value="7, 8" unit="centimeter"/></geominfo>\n  <geominfo name="g5" geom="/a/b/d"><geomprop name="h" type="vector2" value="1, 2"/></geominfo>\n&|' look.mtlx
check 'a look with units and defaults is generated' exits 0 stacks --look L
check 'without a message' test ! -s err
check 'a geometric property is in the unit of its definition' fact /a/b geomprops h '300.0, 50.0'
check 'one in this unit stays' fact /a/c geomprops h '7, 8'
check 'one without a unit has it' fact /a/b/d geomprops h '1, 2'
check 'a token of a <geominfo> counts before the default' fact /a/c tokens Asset car
check 'a default of tokens counts elsewhere' fact /e tokens Asset none
check 'a default of another token counts everywhere' fact /a/c tokens Part lid
check 'a unit of another type is told' eval 'sed "s/unit=.meter. unittype=.distance./unit=\"degree\" unittype=\"distance\"/" look.mtlx >degrees.mtlx; "$mxgen" degrees.mtlx --stage stage.txt --look L -t glsl -o degrees.d 2>&1 | grep -q "degree.*\[unit-of-other-type\]"'
check 'a default of tokens inside of a <geominfo> is misplaced' eval 'sed "s|<token name=.Asset.|<tokendefault name=\"Asset\"|" look.mtlx >inner.mtlx; "$mxgen" validate inner.mtlx 2>&1 | grep -q "<tokendefault> is not allowed in <geominfo> \[misplaced-element\]"'
# Every name of geometry has the prefix.
sed 's|  <propertyset name|  <geominfo name="p1" geomprefix="/a/" geom="c"><geomprop name="light" type="geomname" value="key"/><geomprop name="lights" type="geomnamearray" value="key,{b,d}/rim"/></geominfo>\n&|; s|<propertysetassign|<visibility name="w" geomprefix="/a/" geom="c" viewergeom="key , b/rim" vistype="shadow" visible="false"/><visibility name="x" geom="/a/c" viewercollection="lamps" vistype="secondary"/>&|; s|<look |<collection name="lamps" includegeom="/a/b"/>\n&|' look.mtlx >prefixes.mtlx
cp look.mtlx before.mtlx
cp prefixes.mtlx look.mtlx
check 'geometry with prefixes is generated' exits 0 stacks --look L
check 'viewers are a collection, and visible is the default' fact /a/c visibility secondary true '"collection:lamps"'
check 'a viewer has the prefix' fact /a/c visibility shadow false '"/a/key, /a/b/rim"'
check 'a geometry as a value has the prefix' fact /a/c geomprops light /a/key
check 'so have several' fact /a/c geomprops lights '/a/key, /a/{b,d}/rim'
mv before.mtlx look.mtlx
cat >names.mtlx <<'XML'
<materialx version="1.39" geomprefix="/a/">
  <nodedef name="ND_n" node="n"><input name="g" type="geomname" value="none"/><output name="out" type="float" value="0"/></nodedef>
  <implementation name="I" nodedef="ND_n" target="genglsl" sourcecode="({{g}} == &quot;/a/key&quot; ? 0.25 : {{g}} == &quot;/a/none&quot; ? 0.5 : 0.75)"/>
  <n name="x" type="float"><input name="g" type="geomname" value="key"/></n>
  <n name="y" type="float"/>
  <add name="z" type="float"><input name="in1" type="float" nodename="x"/><input name="in2" type="float" nodename="y"/></add>
  <output name="o" type="float" nodename="z"/>
</materialx>
XML
check 'a node that names geometry is generated' exits 0 "$mxgen" names.mtlx -e o -t glsl --interface reduced -o names.d
check 'its value and its default have the prefix' grep -q 'vec4(0.75, 0.75, 0.75, 1.0)' names.d/o.frag
# Colours go to the space of geometry: 0.5 of sRGB is 0.21404114, and ACES gives the matrix from AP1.
sed 's|  <propertyset name|  <geominfo name="c1" geom="/a/c" colorspace="srgb_texture"><geomprop name="tint" type="color3" value="0.5, 1, 0"/></geominfo>\n  <geominfo name="c2" geom="/a/b"><geomprop name="tint" type="color4" value="0.5, 0.2, 1, 0.25" colorspace="lin_ap1"/></geominfo>\n  <geominfo name="c3" geom="/e"><geomprop name="tint" type="color3" value="0.5, 0.2, 1" colorspace="none"/></geominfo>\n&|' look.mtlx >spaces.mtlx
mv look.mtlx before.mtlx
cp spaces.mtlx look.mtlx
check 'colours of geometry are generated' exits 0 stacks --look L
check 'without a message' test ! -s err
colour() { json "next(all(abs(a - b) < 1e-4 for a, b in zip(map(float, f['value'].split(',')), [$2], strict=True)) for p in d['primitives'] if p['path'] == '$1' for f in p['geomprops'] if f['name'] == 'tint')"; }
check 'a colour has the space of the element around it' colour /a/c '0.21404114, 1, 0'
check 'a colour with alpha has its own space' colour /a/b '0.64491, 0.15249, 1.11518, 0.25'
check 'a colour without a space stays' colour /e '0.5, 0.2, 1'
check 'a space that nobody knows is told' eval 'sed "s/lin_ap1/lin_ap7/" look.mtlx >unknown.mtlx; "$mxgen" unknown.mtlx --stage stage.txt --look L -t glsl -o unknown.d 2>&1 | grep -q "lin_ap7.*\[unknown-colorspace\]"'
# No two <geominfo>s give one geometry a value, however they name it; the parent's value is another matter.
sed -i 's|  <propertyset name|  <collection name="both" includegeom="/a/c, /x"/>\n  <geominfo name="c4" collection="both"><geomprop name="tint" type="color3" value="1, 1, 1"/></geominfo>\n&|' look.mtlx
check 'two values at one geometry are generated' exits 0 stacks --look L
check 'they are told once, and the later one wins' eval '[ "$(grep -c "tint.*\[geominfo-twice\]" err)" = 1 ] && [ "$(grep -c "\[geominfo-twice\]" err)" = 1 ] && colour /a/c "1, 1, 1"'
mv before.mtlx look.mtlx
check 'a set of properties that is missing is an error' eval 'sed -i "s/propertyset=\"PS\"/propertyset=\"QS\"/" look.mtlx; exits 1 stacks --look L && grep -q "no propertyset .QS.*\[unknown-assigned\]" err'

# A texture of an included file is beside that file.
mkdir -p include
cat >include/lib.mtlx <<'XML'
<?xml version="1.0"?>
<materialx version="1.39" fileprefix="tx/">
  <image name="i" type="color3"><input name="file" type="filename" value="inner.png"/></image>
</materialx>
XML
cat >look.mtlx <<'XML'
<?xml version="1.0"?>
<materialx version="1.39" xmlns:xi="http://www.w3.org/2001/XInclude">
  <xi:include href="include/lib.mtlx"/>
  <image name="o" type="color3"><input name="file" type="filename" value="outer.png"/></image>
  <add name="a" type="color3"><input name="in1" type="color3" nodename="i"/><input name="in2" type="color3" nodename="o"/></add>
  <surface_unlit name="S" type="surfaceshader"><input name="emission_color" type="color3" nodename="a"/></surface_unlit>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
  <look name="L"><materialassign material="M" geom="/"/></look>
</materialx>
XML
check 'textures of an included file are generated' exits 0 stacks --look L
check 'its textures have an origin, those of the document none' json 'sorted((t["file"], t.get("origin")) for t in d["stacks"][0]["textures"]) == [("outer.png", None), ("tx/inner.png", "include/lib.mtlx")]'

# OSL networks: each stack has its own, because its values stand in it. A stack of several layers ends with a shader that composes them.
cat >stacks.mtlx <<'XML'
<materialx version="1.39">
  <noise3d name="grain" type="float"/>
  <oren_nayar_diffuse_bsdf name="d" type="BSDF"><input name="roughness" type="float" nodename="grain"/></oren_nayar_diffuse_bsdf>
  <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="d"/></surface>
  <surfacematerial name="Base" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>
  <nodegraph name="NG_rough"><constant name="c" type="float"><input name="value" type="float" value="0.25"/></constant>
    <noise2d name="n" type="float"><input name="pivot" type="float" nodename="c"/></noise2d><output name="mask" type="float" nodename="n"/></nodegraph>
  <substance name="Dirt" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s"/></substance>
  <look name="L"><materialassign material="Base" geom="/"/><materialassign slot="050" material="Dirt" geom="/b"/>
    <materialassign slot="050::010" nodegraph="NG_rough" geom="/b"/></look>
</materialx>
XML
printf '/a\n/b\n' >stage.txt
check 'a scene is generated as networks' exits 0 "$mxgen" stacks.mtlx --stage stage.txt --look L --target osl --osl-network --reflect -o scene.d
check 'each stack has a network' python3 -c "
import glob, json
bound = json.load(open('scene.d/bindings.json'))
stack = {p['path']: json.load(open('scene.d/' + p['stack'] + '.json'))['groups'][0]['layers'] for p in bound['primitives']}
assert [s['name'] for s in bound['stacks']] == [p['name'] for p in bound['programs']] and len(stack) == 2, bound
assert stack['/a'][-1]['shader'] == 'mx_surface_root', stack['/a']
root = stack['/b'][-1]
assert root['name'] == 'root' and glob.glob('scene.d/stack_*_*.osl') == ['scene.d/' + root['shader'] + '.osl'], root
assert {i.get('layer') for i in root['inputs']} >= {'x050_NG_rough_n', 'x000_grain'}, root"

# AOVs of an OSL network: the layers that have them, though nothing else may need these.
cat >network.mtlx <<'XML'
<materialx version="1.39">
  <nodedef name="ND_painted" node="painted"><output name="out" type="surfaceshader"/><input name="tint" type="color3" value="1, 0, 0"/></nodedef>
  <nodegraph name="NG_painted" nodedef="ND_painted">
    <noise3d name="n" type="float"/>
    <oren_nayar_diffuse_bsdf name="d" type="BSDF"><input name="color" type="color3" interfacename="tint"/></oren_nayar_diffuse_bsdf>
    <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="d"/></surface>
    <aov name="a" type="float"><input name="name" type="string" value="grain"/><input name="value" type="float" nodename="n"/></aov>
    <aov name="b" type="BSDF"><input name="name" type="string" value="matt"/><input name="value" type="BSDF" nodename="d"/></aov>
    <output name="out" type="surfaceshader" nodename="s"/>
  </nodegraph>
  <painted name="P" type="surfaceshader"/>
  <painted name="Q" type="surfaceshader"><input name="tint" type="color3" value="0, 1, 0"/></painted>
  <mix name="both" type="surfaceshader"><input name="fg" type="surfaceshader" nodename="P"/><input name="bg" type="surfaceshader" nodename="Q"/></mix>
  <aov name="id" type="integer"><input name="name" type="string" value="id"/><input name="value" type="integer" value="7"/></aov>
  <surfacematerial name="One" type="material"><input name="surfaceshader" type="surfaceshader" nodename="P"/></surfacematerial>
  <surfacematerial name="Sides" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="P"/><input name="backsurfaceshader" type="surfaceshader" nodename="Q"/>
  </surfacematerial>
  <surfacematerial name="Mixed" type="material"><input name="surfaceshader" type="surfaceshader" nodename="both"/></surfacematerial>
</materialx>
XML
# network ELEMENT EXPRESSION OPTION...: Python on the AOVs by name as (type, layer, output), on the layers by name, and on the last layer `root`.
network() {
    exits 0 "$mxgen" network.mtlx -e "$1" --target osl --osl-network --reflect -o net "${@:3}" || return
    python3 -c "
import json
group = json.load(open('net/$1.json'))['groups'][0]
aovs = {a['name']: (a['documentType'], a['layer'], a['output']) for a in group.get('aovs', [])}
layers = {l['name']: l for l in group['layers']}
root = {i['name']: i.get('layer') for i in layers['root']['inputs']}
assert all(layer in layers for _, layer, _ in aovs.values()), (aovs, list(layers))
assert $2, (aovs, layers, root)"
}
check 'a network has AOVs' network One 'list(aovs) == ["grain", "matt", "id"]'
check 'AOVs of a network give no message' test ! -s err
check 'AOVs of values are outputs of layers' network One 'aovs["grain"] == ("float", "P_n", "out") and layers["P_n"]["shader"] == "ND_noise3d_float"'
check 'AOVs of closures are outputs of layers' network One 'aovs["matt"] == ("BSDF", "P_d", "out")'
check 'AOVs of constants have layers of their own' network One '[i["value"] for i in layers[aovs["id"][1]]["inputs"]] == [7]'
check 'AOVs do not change the surface' network One 'root == {"surfaceshader": "P_s"}'
check 'the group has the layers of AOVs' eval 'grep -qx "shader ND_noise3d_float P_n ;" net/One.oslgroup && ls net/ND_noise3d_float.osl'
check '--aovs none leaves out the layers of AOVs' network One 'not aovs and "P_n" not in layers and root == {"surfaceshader": "P_s"}' --aovs none
check '--aovs gives the order of AOVs' network One 'list(aovs) == ["id", "grain"]' --aovs id=integer,other=float,grain=float
check 'a surface alone has AOVs' network P 'list(aovs) == ["grain", "matt", "id"] and root == {"surfaceshader": "P_s"}'
check 'a surface of two sides has AOVs' network Sides 'list(aovs) == ["grain", "matt", "id"] and aovs["matt"] == ("BSDF", "root", "aov_matt") and root["P_n"] == "P_n"'
check 'the two sides are one shader' eval 'grep -q "backfacing()" net/Sides_*.osl && [ "$(grep -c "aov_matt = [PQ]_d_lobe" net/Sides_*.osl)" = 2 ]'
check 'a mix of surfaces has AOVs' network Mixed 'list(aovs) == ["grain", "matt", "id"] and aovs["grain"] == ("float", "root", "aov_grain") and root["mix_"] is None'
check 'a mix of surfaces blends its AOVs' grep -q 'aov_grain = P_n \* (1.0 - \([a-z_]*\)) + P_n \* \1;' net/Mixed_*.osl
check 'a mix of surfaces has no shader of its own without AOVs' network Mixed 'root == {"surfaceshader": "both"} and layers["both"]["inputs"][0]["layer"] == "P_s"' --aovs none
check 'a mix of surfaces gives no message' test ! -s err

finish stacks
