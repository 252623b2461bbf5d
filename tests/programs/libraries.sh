#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Several libraries, and the folders in which mxgen looks for their files. Argument: mxgen.
mxgen=$(realpath "$1") root=$(cd "$(dirname "$0")/../.." && pwd)
. "$(dirname "$0")/common.sh"

# A library in parts, as vendors have them: "folder/maker" with definitions, and source whose `file` begins at the folder above.
mkdir -p vendor/folder/maker/glsl vendor/folder/changes parts documents
cat >vendor/folder/maker/defs.mtlx <<'END'
<materialx version="1.39">
  <nodedef name="ND_ash" node="ash"><input name="in" type="float" value="0.25"/><output name="out" type="float"/></nodedef>
  <implementation name="IM_ash" nodedef="ND_ash" target="genglsl" file="folder/maker/glsl/ash.glsl" function="ash"/>
  <implementation name="IM_ash_genrsl" nodedef="ND_ash" target="genrsl" file="folder/maker/rsl/ash.sl" function="ash"/>
</materialx>
END
cat >vendor/folder/maker/glsl/ash.glsl <<'END'
#include "folder/maker/glsl/twice.glsl"
void ash(float in1, out float result) { result = twice(in1); }
END
echo 'float twice(float x) { return 2.0 * x; }' >vendor/folder/maker/glsl/twice.glsl
sed 's/ash.glsl/grey.glsl/' vendor/folder/maker/defs.mtlx | grep -v 'nodedef name\|genrsl' >vendor/folder/changes/defs.mtlx
mkdir -p vendor/folder/changes
sed -i 's|folder/maker/glsl/||' vendor/folder/changes/defs.mtlx
echo 'void ash(float in1, out float result) { result = 3.0 * in1; }' >vendor/folder/changes/grey.glsl
cat >document.mtlx <<'END'
<materialx version="1.39"><ash name="a" type="float"/><output name="o" type="float" nodename="a"/></materialx>
END

# draws VALUE ARGUMENT...: what the output is, with all inputs compiled in.
draws() {
    local value=$1
    shift
    exits 0 "$mxgen" document.mtlx --interface reduced -o made "$@" && grep -F "vec4($value, $value, $value, 1.0)" made/o.frag
}
check 'a file of source is found from the folder above a library' draws 0.5 --library vendor/folder
check 'a part of the library fails alone' exits 1 "$mxgen" document.mtlx --library vendor/folder/maker -o made
check 'the error names the missing file of source' grep -q "defs.mtlx:3:.* error: .*folder/maker/glsl/ash.glsl.*\[missing-source-file\]" err
check '--source-path finds the file' draws 0.5 --library vendor/folder/maker --source-path vendor
check 'the later of two libraries wins' draws 0.75 --library vendor/folder/maker --library vendor/folder/changes --source-path vendor
check 'a message names both implementations' grep -q "'IM_ash' of 'vendor/folder/changes/defs.mtlx' replaces 'IM_ash' of 'vendor/folder/maker/defs.mtlx'" err
check 'the order of libraries counts' draws 0.5 --library vendor/folder/changes/defs.mtlx --library vendor/folder/maker --source-path vendor
check 'a library may be given twice' draws 0.5 --library vendor/folder/maker --library vendor/folder/maker --source-path vendor
check 'a library that is given twice replaces nothing' test "$(grep -c replaced-implementation err)" = 0

# Implementations for targets that mxgen does not have are left aside, which `library list` says.
check 'library list is accepted' exits 0 "$mxgen" library list ash vendor/folder
check 'library list notes implementations for foreign targets' grep -q 'note: 1 implementations are for .*: genrsl (1) \[foreign-implementations\]' err
check 'library list --quiet is accepted' exits 0 "$mxgen" library list ash vendor/folder --quiet
check 'library list --quiet prints no note' test ! -s err
check 'two libraries generate a document' draws 0.75 --library vendor/folder/maker --library vendor/folder/changes --source-path vendor
check 'a generation prints no note about foreign targets' test "$(grep -c foreign-implementations err)" = 0
check 'a library is packed' exits 0 "$mxgen" library pack vendor/folder/maker --source-path vendor -o maker.mxlib
check 'an image is listed' exits 0 "$mxgen" library list ash maker.mxlib
check 'an image keeps the note about foreign targets' grep -q 'genrsl (1) \[foreign-implementations\]' err

# A library of MaterialX before 1.39: <extract> and <convert> have the graphs and the generators of their time, and <surface> no 'thin_walled'.
# Nodes of other names are upgraded with their graphs.
mkdir -p older
cat >older/defs.mtlx <<'END'
<materialx version="1.38">
  <nodedef name="ND_extract_color3" node="extract">
    <input name="in" type="color3" value="0, 0, 0"/><input name="index" type="integer" value="0"/><output name="out" type="float"/>
  </nodedef>
  <nodegraph name="NG_extract_color3" nodedef="ND_extract_color3">
    <swizzle name="r" type="float"><input name="in" type="color3" interfacename="in"/><input name="channels" type="string" value="r"/></swizzle>
    <output name="out" type="float" nodename="r"/>
  </nodegraph>
  <nodedef name="ND_convert_float_color3" node="convert"><input name="in" type="float" value="0"/><output name="out" type="color3"/></nodedef>
  <nodedef name="ND_surface" node="surface"><input name="bsdf" type="BSDF" value=""/><output name="out" type="surfaceshader"/></nodedef>
  <nodedef name="ND_ember" node="ember"><parameter name="in" type="color3" value="0, 0.25, 0"/><output name="out" type="float"/></nodedef>
  <nodegraph name="NG_ember" nodedef="ND_ember">
    <swizzle name="g" type="float"><input name="in" type="color3" interfacename="in"/><input name="channels" type="string" value="g"/></swizzle>
    <convert name="grey" type="color3"><input name="in" type="float" nodename="g"/></convert>
    <swizzle name="r" type="float"><input name="in" type="color3" nodename="grey"/><input name="channels" type="string" value="r"/></swizzle>
    <output name="out" type="float" nodename="r"/>
  </nodegraph>
</materialx>
END
cat >older/impl.mtlx <<'END'
<materialx version="1.38">
  <implementation name="IM_convert_float_color3_genglsl" nodedef="ND_convert_float_color3" target="genglsl"/>
  <implementation name="IM_surface_genglsl" nodedef="ND_surface" target="genglsl"/>
</materialx>
END
sed 's/ash/ember/g' document.mtlx >ember.mtlx
check 'a library before 1.39 is upgraded with its graphs' exits 0 "$mxgen" ember.mtlx --interface reduced --library older -o made
check 'its definitions give way to those of 1.39' grep -q "older/defs.mtlx:2:.* warning: 3 definitions .*: ND_extract_color3, ND_convert_float_color3, ND_surface \[older-definitions\]" err
check 'and its nodes compute' grep -F 'vec4(0.25, 0.25, 0.25, 1.0)' made/o.frag
check 'a surface keeps its inputs' exits 0 "$mxgen" "$root/examples/gold.mtlx" --library older -o made
sed -i 's/version="1.38"/version="1.39"/' older/*.mtlx
check 'definitions of 1.39 replace' exits 1 "$mxgen" ember.mtlx --library older -o made

# Before 1.39.5 a VDF was a BSDF, <heighttonormal> had a generator, and conditions had raw ampersands.
cat >volume.mtlx <<'END'
<materialx version="1.39">
  <nodedef name="ND_mist" node="mist"><input name="absorption" type="vector3" value="1, 1, 1"/><output name="out" type="VDF"/></nodedef>
  <implementation name="IM_mist_genglsl" nodedef="ND_mist" file="mist.glsl" function="mist" target="genglsl"/>
  <nodedef name="ND_heighttonormal_vector3" node="heighttonormal">
    <input name="in" type="float" value="0"/><input name="scale" type="float" value="1"/><output name="out" type="vector3"/>
  </nodedef>
  <implementation name="IM_heighttonormal_vector3_genglsl" nodedef="ND_heighttonormal_vector3" target="genglsl"/>
  <nodedef name="ND_both" node="both"><input name="a" type="boolean" value="true"/><output name="out" type="boolean"/></nodedef>
  <implementation name="IM_both" nodedef="ND_both" target="genglsl" sourcecode="{{a}} && {{a}}"/>
</materialx>
END
cat >mist.glsl <<'END'
void mist(ClosureData closureData, vec3 absorption, inout BSDF bsdf) { if (closureData.closureType == CLOSURE_TYPE_TRANSMISSION) bsdf.throughput = exp(-absorption); }
END
cat >misty.mtlx <<'END'
<materialx version="1.39">
  <mist name="m" type="VDF"/>
  <dielectric_bsdf name="glass" type="BSDF"><input name="scatter_mode" type="string" value="T"/></dielectric_bsdf>
  <layer name="l" type="BSDF"><input name="top" type="BSDF" nodename="glass"/><input name="base" type="VDF" nodename="m"/></layer>
  <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="l"/></surface>
  <surfacematerial name="Misty" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>
  <heighttonormal name="h" type="vector3"/><output name="slope" type="vector3" nodename="h"/>
  <both name="b" type="boolean"/><output name="both" type="boolean" nodename="b"/>
</materialx>
END
check 'libraries of 1.39.0 to 1.39.4 load' exits 0 "$mxgen" misty.mtlx --library volume.mtlx -o made -e Misty -e slope -e both
check 'a VDF may be a BSDF' grep -q '^ *BSDF m = BSDF(' made/Misty.frag
check 'raw ampersands are told' grep -q 'volume.mtlx:9:.*xml-raw-ampersand' err

# A broken implementation is an error of the nodes that need it; the rest of its library works.
cat >partly.mtlx <<'END'
<materialx version="1.39">
  <nodedef name="ND_good" node="good"><output name="out" type="float"/></nodedef>
  <implementation name="IM_good" nodedef="ND_good" sourcecode="0.25"/>
  <nodedef name="ND_bad" node="bad"><output name="out" type="float"/></nodedef>
  <implementation name="IM_bad" nodedef="ND_bad" sourcecode="0.25 *"/>
  <nodedef name="ND_lost" node="lost"><output name="out" type="float"/></nodedef>
  <implementation name="IM_lost" nodedef="ND_lost" target="genglsl" file="none.glsl" function="lost"/>
  <nodedef name="ND_graph" node="graph"><output name="out" type="float"/></nodedef>
  <nodegraph name="NG_graph" nodedef="ND_graph">
    <add name="a" type="float"><input name="in1" type="float" nodename="nothing"/></add><output name="out" type="float" nodename="a"/>
  </nodegraph>
  <nodedef name="ND_same" node="same"><output name="out" type="float"/></nodedef>
  <implementation name="IM_same" nodedef="ND_same" nodegraph="NG_graph"/>
</materialx>
END
while read -r node code place id; do
    echo "<materialx version='1.39'><$node name='n' type='float'/><output name='o' type='float' nodename='n'/></materialx>" >"$node.mtlx"
    check "a library with faults ends with $code for <$node>" exits "$code" "$mxgen" "$node.mtlx" --library partly.mtlx -o "made-$node"
    check 'each fault of the library is a warning' test "$(grep -c 'warning: .*\[broken-implementation\]' err)" = 4
    check 'a note has the place of the fault' grep -q '^partly.mtlx:5:68: note: expected an expression' err
    if [ "$code" = 0 ]; then
        check 'a node without the fault has no error' eval '! grep -q error: err'
    else
        check 'a fault that a node needs is an error' grep -q "^partly.mtlx:$place: error: .*\[$id\]" err
        check 'a note has the place of the use' grep -q "^$node.mtlx:1:27: note: 'n' needs it here" err
    fi
done <<'END'
good 0
bad 1 5:68 lang-expected
lost 1 7:[0-9]* missing-source-file
graph 1 10:[0-9]* dangling-nodename
same 1 10:[0-9]* dangling-nodename
END
check 'a library with faults gives no image' exits 1 "$mxgen" library pack partly.mtlx -o partly.mxlib
check 'the error says that images have no faults' grep -q '^error: an image has no faulty implementations' err
check 'no image is written' test ! -e partly.mxlib

# A library on top of the built-in one is no image: by its graphs, or by what it inherits.
cat >upper.mtlx <<'END'
<materialx version="1.39">
  <nodedef name="ND_upper" node="upper"><input name="in" type="float" value="1"/><output name="out" type="float"/></nodedef>
  <nodegraph name="NG_upper" nodedef="ND_upper">
    <sin name="s" type="float"><input name="in" type="float" interfacename="in"/></sin>
    <output name="out" type="float" nodename="s"/>
  </nodegraph>
</materialx>
END
cat >heir.mtlx <<'END'
<materialx version="1.39">
  <nodedef name="ND_heir" node="heir" inherit="ND_sin_float"/>
  <implementation name="IM_heir" nodedef="ND_heir" sourcecode="{{in}}"/>
</materialx>
END
for file in upper heir; do
    check "$file gives no image" exits 1 "$mxgen" library pack $file.mtlx -o $file.mxlib
    check "the error of $file names the reason" grep -q "^error: '$file.mtlx' uses what the built-in library defines.*\[image-needs-library\]" err
    check "the error of $file is the only one" test "$(grep -c error: err)" = 1
    check "$file is no image" test ! -e $file.mxlib
    check "$file alone has faults" exits 1 "$mxgen" library pack $file.mtlx -o $file.mxlib --no-builtin-library
    check "the faults of $file are told" grep -Eq 'unknown node|inherit' err
done
check 'the warning can be made an error' exits 1 "$mxgen" good.mtlx --library partly.mtlx -o made-strict -Werror=broken-implementation

# Included documents, too.
cat >documents/outer.mtlx <<'END'
<materialx version="1.39" xmlns:xi="http://www.w3.org/2001/XInclude">
  <xi:include href="shared/ash.mtlx"/><output name="o" type="float" nodename="a"/>
</materialx>
END
mkdir -p elsewhere/shared
echo '<materialx version="1.39"><constant name="a" type="float"><input name="value" type="float" value="0.125"/></constant></materialx>' >elsewhere/shared/ash.mtlx
check 'an include in another folder fails' exits 1 "$mxgen" documents/outer.mtlx -o made
check 'the error is include-missing' grep -q 'outer.mtlx:2:.*include-missing' err
check '--source-path finds an include' exits 0 "$mxgen" documents/outer.mtlx -o made --interface reduced --source-path elsewhere
check 'the include is read' grep -qF 'vec4(0.125, 0.125, 0.125, 1.0)' made/o.frag
mkdir -p documents/shared
sed 's/0.125/0.75/' elsewhere/shared/ash.mtlx >documents/shared/ash.mtlx
check 'a file beside the document is accepted' exits 0 "$mxgen" documents/outer.mtlx -o made --interface reduced --source-path elsewhere
check 'a file beside the document comes first' grep -qF 'vec4(0.75, 0.75, 0.75, 1.0)' made/o.frag
rm documents/shared/ash.mtlx && mkdir documents/shared/ash.mtlx
check 'an include that cannot be read fails' exits 1 "$mxgen" documents/outer.mtlx -o made --source-path elsewhere
check 'an unreadable include is not looked for elsewhere' grep -q 'outer.mtlx:2:' err

# Source for genglsl is read as portable where it can be: functions of MaterialX's generators, words as numbers, implicit inputs, tokens of
# textures. So it folds.
mkdir -p portable
cat >portable/defs.mtlx <<'END'
<materialx version="1.39">
  <nodedef name="ND_rest" node="rest"><input name="in" type="float" value="1"/><output name="out" type="float"/></nodedef>
  <implementation name="IM_rest" nodedef="ND_rest" target="genglsl" sourcecode="mx_mod({{in}}, 0.75) * mx_square(M_PI / M_PI);"/>
  <nodedef name="ND_pick" node="pick">
    <input name="mode" type="string" value="third" enum="first, second, third" uniform="true"/><output name="out" type="float"/>
  </nodedef>
  <implementation name="IM_pick" nodedef="ND_pick" target="genglsl" file="pick.glsl" function="pick"/>
  <nodedef name="ND_read" node="read"><input name="file" type="filename" value="" uniform="true"/><output name="out" type="float"/></nodedef>
  <implementation name="IM_read" nodedef="ND_read" target="genglsl" file="read.glsl" function="read"/>
</materialx>
END
cat >portable/pick.glsl <<'END'
#include "lib/$fileTransformUv"
void pick(int mode, vec2 uv_scale, vec2 uv_offset, out float result)
{
    result = mx_transform_uv(vec2(float(mode) * 0.25), uv_scale, uv_offset).x;
}
END
mkdir -p portable/lib
echo 'vec2 mx_transform_uv(vec2 uv, vec2 scale, vec2 offset) { return uv * scale + offset; }' >portable/lib/mx_transform_uv.glsl
cat >portable/read.glsl <<'END'
void read($texSamplerSignature, out float result)
{
    result = texture($texSamplerSampler2D, vec2(0.25)).x;
}
END
cat >portable.mtlx <<'END'
<materialx version="1.39">
  <rest name="a" type="float"/><output name="rest" type="float" nodename="a"/>
  <pick name="b" type="float"/><output name="pick" type="float" nodename="b"/>
  <read name="c" type="float"><input name="file" type="filename" value="x.png"/></read><output name="read" type="float" nodename="c"/>
</materialx>
END
check 'source for genglsl is generated' exits 0 "$mxgen" portable.mtlx --interface reduced --library portable -o made
check "functions of MaterialX's generators fold" grep -qF 'vec4(0.25, 0.25, 0.25, 1.0)' made/rest.frag
check 'a word is a number and inputs are implicit' grep -qF 'vec4(0.5, 0.5, 0.5, 1.0)' made/pick.frag
check 'tokens of textures are replaced' grep -q 'texture(.*vec2(0.25))' made/read.frag
check 'no function is copied' test "$(grep -c 'void read' made/read.frag)" = 0

# Operators and materials that only foreign targets implement are mxgen's own.
cat >operators.mtlx <<'END'
<materialx version="1.39">
  <nodedef name="ND_surface" node="surface">
    <input name="bsdf" type="BSDF" value=""/><input name="edf" type="EDF" value=""/>
    <input name="opacity" type="float" value="1"/><input name="thin_walled" type="boolean" value="false" uniform="true"/>
    <output name="out" type="surfaceshader"/>
  </nodedef>
  <implementation name="IM_surface" nodedef="ND_surface" target="genmdl" file="none.mdl" function="surface"/>
  <nodedef name="ND_surfacematerial" node="surfacematerial">
    <input name="surfaceshader" type="surfaceshader" value=""/><input name="backsurfaceshader" type="surfaceshader" value=""/>
    <input name="displacementshader" type="displacementshader" value=""/><output name="out" type="material"/>
  </nodedef>
  <nodedef name="ND_other" node="other"><output name="out" type="surfaceshader"/></nodedef>
</materialx>
END
cat >material.mtlx <<'END'
<materialx version="1.39">
  <surface name="s" type="surfaceshader"/>
  <surfacematerial name="m" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>
</materialx>
END
check 'operators without implementations are generated' exits 0 "$mxgen" material.mtlx --no-builtin-library --library operators.mtlx -o made
sed 's/<surface name="s" type="surfaceshader"/<other name="s" type="surfaceshader"/' material.mtlx >other.mtlx
check 'other nodes without implementations fail' exits 1 "$mxgen" other.mtlx --no-builtin-library --library operators.mtlx -o made
check 'the error is missing-implementation' grep -q 'missing-implementation' err

# Only what needs adjacent pixels counts as a derivative, function by function; several outputs have an expression each.
cat >near.glsl <<'END'
float mx_near_step(float x) { return x / fwidth(x); }
float mx_near_edge(float x) { return clamp(mx_near_step(x), 0.0, 1.0); }
void mx_near(float x, out float result) { result = mx_near_edge(x) + unpackHalf2x16(0u).x; }
void mx_far(float x, out float result) { result = x + unpackHalf2x16(0u).x; }
END
cat >near.mtlx <<'END'
<materialx version="1.39">
  <nodedef name="ND_near" node="near"><input name="x" type="float" value="0"/><output name="out" type="float"/></nodedef>
  <implementation name="IM_near" nodedef="ND_near" target="genglsl" file="near.glsl" function="mx_near"/>
  <nodedef name="ND_far" node="far"><input name="x" type="float" value="0"/><output name="out" type="float"/></nodedef>
  <implementation name="IM_far" nodedef="ND_far" target="genglsl" file="near.glsl" function="mx_far"/>
  <nodedef name="ND_inline" node="inlined"><input name="x" type="float" value="0"/><output name="out" type="float"/></nodedef>
  <implementation name="IM_inline" nodedef="ND_inline" target="genglsl" sourcecode="dFdx({{x}}) + unpackHalf2x16(0u).x"/>
  <nodedef name="ND_both" node="both"><input name="x" type="float" value="0"/><output name="a" type="float"/><output name="b" type="float"/></nodedef>
  <implementation name="IM_both" nodedef="ND_both" target="genglsl">
    <output name="a" type="float" sourcecode="{{x}} + unpackHalf2x16(1u).x"/>
    <output name="b" type="float" sourcecode="fwidth({{x}}) + unpackHalf2x16(2u).x"/>
  </implementation>
  <nodegraph name="NG">
    <texcoord name="uv" type="vector2"/>
    <extract name="u" type="float"><input name="in" type="vector2" nodename="uv"/></extract>
    <near name="n" type="float"><input name="x" type="float" nodename="u"/></near>
    <far name="f" type="float"><input name="x" type="float" nodename="u"/></far>
    <inlined name="i" type="float"><input name="x" type="float" nodename="u"/></inlined>
    <both name="b2" type="multioutput"><input name="x" type="float" nodename="u"/></both>
    <combine4 name="c" type="color4">
      <input name="in1" type="float" nodename="n"/><input name="in2" type="float" nodename="f"/><input name="in3" type="float" nodename="i"/>
      <input name="in4" type="float" nodename="b2" output="a"/>
    </combine4>
    <multiply name="m" type="color4"><input name="in1" type="color4" nodename="c"/><input name="in2" type="float" nodename="b2" output="b"/></multiply>
    <output name="out" type="color4" nodename="m"/>
  </nodegraph>
</materialx>
END
check 'source with derivatives is inspected' exits 0 "$mxgen" inspect near.mtlx --ir --trust
cat >callees <<'END'
callee "ND_near" verbatim 0 derivative
callee "ND_far" verbatim 1
callee "ND_inline" verbatim 2 derivative
callee "ND_both" verbatim 3
callee "ND_both" verbatim 4 derivative
END
check 'derivatives are those of the functions that have them' diff <(grep '^callee' out) callees

# A checkout of MaterialX that is a copy of mxgen's own library, then with another default.
mkdir -p checkout/libraries
check 'the library is written as MaterialX' exits 0 "$mxgen" library expand -q -o checkout/libraries/all.mtlx
compare() { python3 "$root/libraries/compare.py" "$mxgen" "$1"; }
check 'a copy does not differ' eval 'compare checkout | grep -q "; 0 differences"'
sed -i '/nodedef name="ND_checkerboard_color3"/,/nodedef>/s/name="color1" type="color3" value="[^"]*"/name="color1" type="color3" value="0.25, 0, 0"/' checkout/libraries/all.mtlx
check 'a default that differs is told' eval "compare checkout/libraries | grep -qF \"ND_checkerboard_color3.color1: value is\""

finish libraries
