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
    check "$target" exits 0 "$mxgen" "$document" --plugin "$plugin" --target "$target" -o "$target.d"
    check "$target, without a warning" test ! -s err
done
check 'an OSL network' exits 0 "$mxgen" "$document" --plugin "$plugin" --target osl --osl-network -o net.d
check 'has a shader for the knots' eval 'ls net.d/ND_curve_float_knots_*.osl'
check 'code at the vertices' eval 'grep -q "placed_texcoord = i_texcoord_0 \* " vulkan.d/Felt.vert && ! grep -q "texcoord_0" vulkan.d/Felt.frag'
check 'a curve of knots' grep -q 'clamp' vulkan.d/Felt.frag
if [ -n "$compile" ]; then
    check 'it compiles' exits 0 "$compile" "$document" --plugin "$plugin" --targets glsl,vulkan,essl,essl310,hlsl
    check 'lines of each target' eval '[ "$(grep -c Felt out)" -eq 15 ]'
else
    skip 'without glslang no shader is compiled'
fi
if [ -n "$render" ] && has_device "$render"; then
    check 'it renders' exits 0 "$mxgen" render "$document" --plugin "$plugin" --size 32 -o felt.png
    check 'a picture' test -s felt.png
else
    skip 'without a Vulkan device nothing is rendered'
fi

check 'check' exits 0 "$mxgen" check "$document" --plugin "$plugin" --jobs 2 --cache cache.d
check 'its second run is from the cache' eval '"$mxgen" check "$document" --plugin "$plugin" --cache cache.d --json report.json && grep -q Felt report.json'
check 'check without the plug-in' exits 1 "$mxgen" check "$document" --cache cache.d
check 'validate' exits 0 "$mxgen" validate "$document" --plugin "$plugin"
check 'explain' eval '"$mxgen" explain fuzz_bsdf --plugin "$plugin" | grep -q "Fibres on a rough"'
check 'library list' eval '"$mxgen" library list curve --plugin "$plugin" | grep -qx "ND_curve_float  curve(in:float, knots:string) -> out:float"'
check 'library doc' exits 0 "$mxgen" library doc --plugin "$plugin" --markdown -o doc.d
check 'documents the nodes' grep -q 'A curve through knots' doc.d/index.md
check 'a depfile' exits 0 "$mxgen" "$document" --plugin "$plugin" -o dep.d --depfile felt.d
check 'names the plug-in and its definitions' eval 'grep -qF "$plugin" felt.d && grep -q studio.mtlx felt.d'

cat >noise.mtlx <<'XML'
<materialx version="1.39">
  <unifiednoise3d name="n" type="float"/>
  <output name="out" type="float" nodename="n"/>
</materialx>
XML
check 'a block of the plug-in' grep -q 'uniform StudioFrame {' vulkan.d/Felt.frag
check 'a constant buffer of the plug-in' grep -q 'cbuffer StudioFrame ' hlsl.d/Felt.ps.hlsl
check 'its uniform without blocks' grep -q '^uniform float u_studioDust' essl.d/Felt.frag
check 'another definition for one target' eval 'for t in glsl essl; do "$mxgen" noise.mtlx --plugin "$plugin" --target $t -o $t.d; done'
check 'which is smaller' eval 'grep -q cellnoise glsl.d/out.frag && ! grep -q cellnoise essl.d/out.frag && grep -q noise essl.d/out.frag'

sed 's/0:0.35/-1:0.35/' "$document" >bad.mtlx
check 'an error of the code' exits 1 "$mxgen" bad.mtlx --plugin "$plugin" --stdout
check 'is at the input' grep -q '^bad.mtlx:14:7: error: <curve>: expected knots .*\[code-error\]' err

check 'not in a sandbox' exits 2 "$mxgen" "$document" --plugin "$plugin" --sandbox --stdout
check 'with the reason' grep -q -- '--sandbox allows no --plugin' err
check 'a missing file' exits 2 "$mxgen" "$document" --plugin none.so --stdout
check 'is named' grep -q "cannot load the plug-in 'none.so'" err
check 'a file that is none' exits 2 "$mxgen" "$document" --plugin "$document" --stdout
check 'another version' exits 2 "$mxgen" "$document" --plugin "${wrong[0]}" --stdout
check 'says which' grep -q 'it is for version 2 of the interface; this mxgen has 1' err
check 'a plug-in that gives nothing' exits 2 "$mxgen" "$document" --plugin "${wrong[1]}" --stdout
check 'says so' grep -q 'returns NULL' err
check 'no entry point' exits 2 "$mxgen" "$document" --plugin "${wrong[2]}" --stdout
check 'names the function' grep -q 'it has no function mxgen_plugin' err
check 'a node for no target' exits 1 "$mxgen" "$document" --plugin "${wrong[3]}" --stdout
check 'says what is wrong' grep -q 'for an unknown target' err
finish plugin
