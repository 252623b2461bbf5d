#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Plug-ins with nodes in C: the one of the examples in every command, and files that are none. Arguments: mxgen, mxgen-compile (''
# to compile nothing), mxgen-render ('' to render nothing), the plug-in of the examples, the wrong plug-ins.
mxgen=$(realpath "$1") compile=${2:+$(realpath "$2")} render=${3:+$(realpath "$3")} plugin=$(realpath "$4")
wrong=()
for path in "${@:5}"; do
    wrong+=("$(realpath "$path")")
done
here=$(cd "$(dirname "$0")" && pwd)
document=$here/../../examples/nodes/felt.mtlx
. "$here/common.sh"

for target in glsl vulkan essl essl310 hlsl osl; do
    check "the document is generated for $target" exits 0 "$mxgen" "$document" --plugin "$plugin" --target "$target" -o "$target.d"
    check "the generation for $target prints nothing" test ! -s err
done
check 'a network of OSL is generated' exits 0 "$mxgen" "$document" --plugin "$plugin" --target osl --osl-network -o net.d
check 'the network has a shader for the knots' eval 'ls net.d/ND_curve_float_knots_*.osl'
check 'code of the plug-in runs at the vertices' eval 'grep -q "placed_texcoord = i_texcoord_0 \* " vulkan.d/Felt.vert && ! grep -q "texcoord_0" vulkan.d/Felt.frag'
check 'a curve has its knots' grep -q 'clamp' vulkan.d/Felt.frag
if [ -n "$compile" ]; then
    check 'the shaders compile' exits 0 "$compile" "$document" --plugin "$plugin" --targets glsl,vulkan,essl,essl310,hlsl
    check 'each target has a line for each element' eval '[ "$(grep -c Felt out)" -eq 15 ]'
else
    skip 'without glslang no shader is compiled'
fi
if [ -n "$render" ] && has_device "$render"; then
    check 'a picture is drawn' exits 0 "$mxgen" render "$document" --plugin "$plugin" --size 32 -o felt.png
    check 'the picture is written' test -s felt.png
else
    skip 'without a Vulkan device nothing is rendered'
fi

check 'a folder is checked with the plug-in' exits 0 "$mxgen" check "$document" --plugin "$plugin" --jobs 2 --cache cache.d
check 'a second check reads the cache' eval '"$mxgen" check "$document" --plugin "$plugin" --cache cache.d --json report.json && grep -q Felt report.json'
check 'a check without the plug-in fails' exits 1 "$mxgen" check "$document" --cache cache.d
check 'the document is valid with the plug-in' exits 0 "$mxgen" validate "$document" --plugin "$plugin"
check 'explain knows a node of the plug-in' eval '"$mxgen" explain fuzz_bsdf --plugin "$plugin" | grep -q "Fibres on a rough"'
check 'library list knows a node of the plug-in' eval '"$mxgen" library list curve --plugin "$plugin" | grep -qx "ND_curve_float  curve(in:float, knots:string) -> out:float"'
check 'library doc is accepted' exits 0 "$mxgen" library doc --plugin "$plugin" --markdown -o doc.d
check 'library doc documents the nodes of the plug-in' grep -q 'A curve through knots' doc.d/index.md
check 'a depfile is written' exits 0 "$mxgen" "$document" --plugin "$plugin" -o dep.d --depfile felt.d
check 'the depfile names the plug-in and its definitions' eval 'grep -qF "$plugin" felt.d && grep -q studio.mtlx felt.d'

# The target of the plug-in is GLSL 3.30 with blocks and its own endings.
own=(--plugin "$plugin" --target studiogl)
check 'the target of the plug-in is written' exits 0 "$mxgen" "$document" "${own[@]}" -o own.d
check 'its files have its endings' test -s own.d/Felt.vs.glsl -a -s own.d/Felt.fs.glsl
check 'it has its version' eval '[ "$(head -1 own.d/Felt.fs.glsl)" = "#version 330" ]'
check 'it has its options' grep -q 'uniform PublicUniforms' own.d/Felt.fs.glsl
check 'an ending of it names one file' eval '"$mxgen" "$document" "${own[@]}" -o one.fs.glsl && cmp one.fs.glsl own.d/Felt.fs.glsl'
check 'options of its language have a meaning' exits 0 "$mxgen" "$document" "${own[@]}" --target-version 450 -o own450.d
check 'the command line has the last word' eval '[ "$(head -1 own450.d/Felt.fs.glsl)" = "#version 450" ]'
check 'options of other languages have none' exits 2 "$mxgen" "$document" "${own[@]}" --osl-network -o none.d
check 'inspect knows the target' exits 0 "$mxgen" inspect "$document" "${own[@]}" --closures
check 'an unknown target is wrong usage' exits 2 "$mxgen" "$document" --plugin "$plugin" --target studio -o none.d
check 'the error lists the target of the plug-in' grep -q ', studiogl \[unknown-target\]' err
check 'a folder is checked for the target' exits 0 "$mxgen" check "$document" "${own[@]}" --max-closures studiogl=99 --json own.json
check 'the report names the target' grep -q '"target": *"studiogl"' own.json
check 'a budget of the target fails' exits 1 "$mxgen" check "$document" "${own[@]}" --max-closures studiogl=1
mkdir -p own && cp "$document" own/felt.mtlx && printf '[budget.studiogl]\nmax-closures = 1\n' >own/mxgen.toml
check 'a file of budgets knows the target' eval '! "$mxgen" check own "${own[@]}" >out 2>err && grep -q over-budget out err'
if [ -n "$compile" ]; then
    check 'its shaders compile as those of its language' exits 0 "$compile" "$document" --plugin "$plugin" --targets studiogl
    check 'its compiler is there' eval '! grep -q "no compiler" err && grep -q studiogl out'
fi

cat >noise.mtlx <<'XML'
<materialx version="1.39">
  <unifiednoise3d name="n" type="float"/>
  <output name="out" type="float" nodename="n"/>
</materialx>
XML
check 'the shader has a block of the plug-in' grep -q 'uniform StudioFrame {' vulkan.d/Felt.frag
check 'the shader of HLSL has a constant buffer of the plug-in' grep -q 'cbuffer StudioFrame ' hlsl.d/Felt.ps.hlsl
check 'a target without blocks has uniforms of the plug-in' grep -q '^uniform float u_studioDust' essl.d/Felt.frag
check 'a definition of one target is generated' eval 'for t in glsl essl; do "$mxgen" noise.mtlx --plugin "$plugin" --target $t -o $t.d; done'
check 'the definition of that target is smaller' eval 'grep -q cellnoise glsl.d/out.frag && ! grep -q cellnoise essl.d/out.frag && grep -q noise essl.d/out.frag'

sed 's/0:0.35/-1:0.35/' "$document" >bad.mtlx
check 'an error of the code fails' exits 1 "$mxgen" bad.mtlx --plugin "$plugin" --stdout
check 'the error stands at the input' grep -q '^bad.mtlx:14:7: error: <curve>: expected knots .*\[code-error\]' err

check 'a sandbox with a plug-in is wrong usage' exits 2 "$mxgen" "$document" --plugin "$plugin" --sandbox --stdout
check 'the error says that a sandbox allows no plug-in' grep -q -- '--sandbox allows no --plugin' err
check 'a plug-in that is missing is wrong usage' exits 2 "$mxgen" "$document" --plugin none.so --stdout
check 'the error names the missing plug-in' grep -q "cannot load the plug-in 'none.so'" err
check 'a file that is no plug-in is wrong usage' exits 2 "$mxgen" "$document" --plugin "$document" --stdout
check 'a plug-in of another version is wrong usage' exits 2 "$mxgen" "$document" --plugin "${wrong[0]}" --stdout
check 'the error names both versions' grep -q 'it is for version 3 of the interface; this mxgen has 2' err
check 'a plug-in that gives nothing is wrong usage' exits 2 "$mxgen" "$document" --plugin "${wrong[1]}" --stdout
check 'the error says that it returns NULL' grep -q 'returns NULL' err
check 'a plug-in without an entry point is wrong usage' exits 2 "$mxgen" "$document" --plugin "${wrong[2]}" --stdout
check 'the error names the entry point' grep -q 'it has no function mxgen_plugin' err
check 'a node for an unknown target fails' exits 1 "$mxgen" "$document" --plugin "${wrong[3]}" --stdout
check 'the error names the unknown target' grep -q "a plug-in is refused: the code for 'ND_x' is for the unknown target 'genmoon'" err
check 'a target of an unknown language fails' exits 1 "$mxgen" "$document" --plugin "${wrong[4]}" --stdout
check 'the error names its base' grep -q "a plug-in is refused: dialect 'moon' has the unknown base 'genmoon'" err
finish plugin
