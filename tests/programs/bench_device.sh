#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Frame times on a device, and shaders that mxgen did not write: its own, bound by what spirv-cross says of them, give the same picture.
# Arguments: bench-device, mxgen, the folder of examples, the folder bench/gpu.
bench=$(realpath "$1") mxgen=$(realpath "$2") examples=$(realpath "$3") gpu=$(realpath "$4")
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"
export MESA_SHADER_CACHE_DISABLE=true GALLIVM_PERF=nopt
number='-?[0-9.]+'

"$bench" complete "$examples/gold.mtlx" >first
grep -q "^skip: no Vulkan" first && { skip "$(cat first)"; finish bench-device; }
check 'the program measures a device or says why there is none' grep -qE "^\| gold \| .* $number \| 1\.00 \|$|^skip: the only Vulkan device is a processor, .*--any" first
measure() { "$bench" --any --size 96x54 "$@"; }
check '--any measures any device' exits 0 measure reduced "$examples/gold.mtlx" "$examples/marble.mtlx"
check 'each document has a line' test "$(grep -cE "^\| [a-z]+ \| - \| - \| - \| $number \| $number \|$" out)" -eq 2
check "a line says that MaterialX's shaders are missing" grep -q "^MaterialX's shaders: not given (--materialx FOLDER)$" out
check 'an unknown interface fails' exits 1 measure other "$examples/gold.mtlx"
check 'an unknown option fails' exits 1 measure --other 1 reduced "$examples/gold.mtlx"

for command in glslangValidator spirv-cross; do
    command -v $command >/dev/null || { skip "no $command"; finish bench-device; }
done
while read -r document interface; do
    check "$document is generated" exits 0 "$mxgen" "$examples/$document.mtlx" -q --target vulkan --interface $interface --reflect -o $document
    files=($document/*.json) folder=theirs/$interface
    mkdir -p $folder
    check "both reflections of $document agree" exits 0 python3 "$here/foreign.py" "$gpu" "${files[0]%.json}" $folder/$document.json
    cp "${files[0]%.json}.vert" $folder/$document.vert
    cp "${files[0]%.json}.frag" $folder/$document.frag
    check "$document is drawn with both shaders" exits 0 measure --materialx theirs $interface "$examples/$document.mtlx"
    check "both pictures of $document are the same" grep -qE "^\| $document \| $number \| $number \| 0\.0000 \| $number \| $number \|$" out
    check "$document is one of one" grep -qE '^\| all \| 1 \| [0-9.]+ \([0-9.]+, [0-9.]+\) \|$' out
done <<'END'
gold complete
textured reduced
END

# Each mistake in a binding shows in the picture, and the shader does not count.
wrong() { # WHAT SED-COMMAND
    mkdir -p wrong/reduced
    cp theirs/reduced/* wrong/reduced
    sed -E "$2" theirs/reduced/textured.json >wrong/reduced/textured.json
    check "the reflection changes where $1" exits 1 cmp -s {theirs,wrong}/reduced/textured.json
    check "the run fails where $1" exits 1 measure --materialx wrong reduced "$examples/textured.mtlx"
    check "the line says that the pictures differ where $1" grep -qE '^\| textured \| .* not counted \| 0\.[0-9]+: the pictures differ \|' out
}
wrong 'a matrix is not the scene'"'"'s' 's/u_worldInverseTransposeMatrix/u_other/'
wrong 'the lights are others' 's/"name": "(color|intensity)"/"name": "other"/'
wrong 'a texture is not there' 's/"file": "[^"]*"/"file": ""/'
wrong 'an attribute is another' 's/i_texcoord_0/i_texcoord_1/'
rm wrong/reduced/textured.frag
check 'a document that the folder lacks fails' exits 1 measure --materialx wrong reduced "$examples/textured.mtlx"
check 'the line says that the document is not in the folder' grep -q '^| textured | not in the folder |' out
finish bench-device
