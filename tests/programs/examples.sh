#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The documents and programs of examples/ work as documented. Arguments: mxgen, mxgen-compile ('' to compile nothing), the programs.
mxgen=$(realpath "$1") compile=${2:+$(realpath "$2")}
here=$(cd "$(dirname "$0")" && pwd)
examples=$here/../../examples
declare -A program
for path in "${@:3}"; do
    program[${path##*/}]=$(realpath "$path")
done
. "$here/common.sh"
[ -n "$compile" ] || skip 'without glslang no shader is compiled'
compile_osl=$compile
command -v oslc >/dev/null || { compile_osl= && skip 'without oslc no OSL is compiled'; }

for document in "$examples"/*.mtlx; do
    check "${document##*/}" exits 0 "$mxgen" "$document" --target vulkan -o out.d
    check "${document##*/} without a warning" test ! -s err
    [ -z "$compile" ] || check "${document##*/} compiles" exits 0 "$compile" "$document"
    check "${document##*/} as OSL" exits 0 "$mxgen" "$document" --target osl -o osl.d
    [ -z "$compile_osl" ] || check "${document##*/} compiles as OSL" exits 0 "$compile" "$document" --targets osl
    check "${document##*/} is in the list" grep -qF "\`${document##*/}\`" "$examples/README.md"
done
# Light data and light code are made of what is bound, and of nothing else.
for lights in lantern_light=7 none; do
    check "lantern.mtlx, lights $lights" exits 0 "$mxgen" "$examples/lantern.mtlx" --lights "$lights" --environment none -o out.d
    mv out.d/Wood.frag "$lights.frag"
done
check 'members of the light' grep -qE '^ *float upwards;' lantern_light=7.frag
check 'and of no other' eval '! grep -qE "inner_angle|decay_rate|intensity" lantern_light=7.frag'
check 'chosen by its number' grep -q 'type == 7' lantern_light=7.frag
check 'nothing of lights and the environment' eval '! grep -qiE "light|u_env|mx_ggx" none.frag'
[ -z "$compile" ] || check 'compiles' exits 0 "$compile" "$examples/lantern.mtlx" --lights lantern_light=7
# Lights made of nodes stand where the host puts them, and have the inputs of their definition.
check 'stage.mtlx, its lights' exits 0 "$mxgen" "$examples/stage.mtlx" --lights spot=1,bulb=2 --environment none --reflect -o out.d
for member in 'vec3 position' 'vec3 direction' 'float temperature' 'float power'; do
    check "stage.mtlx: $member" grep -qE "^ *$member;" out.d/Curtain.frag
done
check 'and no other' eval '! grep -qE "decay_rate|float intensity|inner_angle;" out.d/Curtain.frag'
check 'reflection tells them' eval 'grep -q "\"shader\": *\"spot\"" out.d/Curtain.json && grep -q "\"shader\": *\"bulb\"" out.d/Curtain.json'
[ -z "$compile" ] || check 'stage.mtlx compiles' exits 0 "$compile" "$examples/stage.mtlx" --lights spot=1,bulb=2
cat >key.mtlx <<'XML'
<?xml version="1.0"?>
<materialx version="1.39">
  <point_light name="key" type="lightshader"/>
  <light name="off" type="lightshader"/>
  <standard_surface name="S" type="surfaceshader"/>
</materialx>
XML
check 'a light that is a function' exits 1 "$mxgen" key.mtlx --element S --lights key=1 -o out.d
check 'is bound by its definition' grep -q "unknown light shader 'key'; bind 'point_light'" err
check 'a light that emits nothing' exits 1 "$mxgen" key.mtlx --element S --lights off=1 -o out.d
check 'has no EDF' grep -q "the node has no EDF" err
check 'a light is not rendered itself' exits 1 "$mxgen" key.mtlx --element key -o out.d
check 'reflection' exits 0 "${program[reflection]}" "$examples/marble.mtlx"
check 'tells the user interface' grep -q "float NG_marble_scale = 5 .*shown as 'Scale' from 0.1 to 50" out
check 'tells textures' eval '"${program[reflection]}" "$examples/textured.mtlx" | grep -q "sampler2D image_color_file .*textures/wood_color.png"'
check 'osl_network' exits 0 "${program[osl_network]}" "$examples/marble.mtlx" .
cp out marble.oslgroup
check 'prints layers' grep -q '^shader ND_fractal3d_float NG_marble_noise ;' out
check 'connects them' grep -q '^connect NG_marble_scaled.out NG_marble_noise.position ;' out
check 'gives values' grep -q '^param int octaves 4 ;' out
check 'ends in a material' grep -q '^connect SR_marble_surface.out root.surfaceshader ;' out
check 'writes each shader' eval 'for name in $(sed -n "s/^shader \([^ ]*\) .*/\1/p" out); do [ -s $name.osl ] || exit 1; done'
[ -z "$compile_osl" ] || check 'that compile' exits 0 "$compile" "$examples/marble.mtlx" --targets osl --osl-network
if command -v oslc >/dev/null && command -v testshade >/dev/null; then
    check 'compiles' eval 'for file in ND_*.osl mx_*.osl; do oslc -q "$file" || exit 1; done'
    printf 'shader show(color value = 0) { printf("%%.3f %%.3f %%.3f\\n", value[0], value[1], value[2]); }' >show.osl
    check 'show compiles' oslc -q show.osl
    sed -i '/^shader mx_surface_root/,$d' marble.oslgroup
    printf 'shader show show ;\nconnect NG_marble_color.out show.value ;\n' >>marble.oslgroup
    check 'testshade runs the group' exits 0 testshade -t 1 -g 1 1 --group marble.oslgroup
    check 'its marble is between both colours' eval 'read -r r g b <out && awk "BEGIN { exit !($r >= 0.149 && $r <= 0.801 && $b >= 0.249 && $b <= 0.751) }"'
else
    skip 'without oslc and testshade the group is not run'
fi
check 'edit' exits 0 "${program[edit]}"
sed '1,/<\/materialx>/d' out >polished.mtlx
check 'writes what it built' eval 'sed "/<\/materialx>/q" out | "$mxgen" --target vulkan --stdout - | grep -q noise'
check 'and what it edited' eval '"$mxgen" --target vulkan --stdout polished.mtlx >edited && [ -s edited ] && ! grep -q noise edited'
check 'embedding' exits 0 "${program[embedding]}"
check 'reads a value' grep -qx '  metalness = 1' out
check 'follows a connection' grep -qx '  base_color reads Wood' out
check 'tells blocks with sizes' grep -q '^PublicUniforms: set 0, binding 1, [1-9][0-9]* bytes$' out
check 'tells an input that is compiled in' grep -q '^compiled in: vector2 Wood/uvtiling = 4.0, 4.0$' out
check 'keeps its program for a value' grep -q '^change 1, 1 values$' out
check 'compiles another one for a constant' eval '[ "$(sed -n "/^change/{s/.* \([0-9]\), .*/\1/;p}" out | tr "\n" " ")" = "1 2 " ]'
check 'tells a misspelt input' grep -qx 'there is no SR/metal' out
check 'tells the place of an error' grep -q '^broken.mtlx:1:[0-9]*: dangling-nodename$' out
check 'host_resolver' exits 0 "${program[host_resolver]}"
check 'reads three assets' grep -q 'fract' out
[ -z "${program[c_minimal]:-}" ] || check 'c_minimal' exits 0 "${program[c_minimal]}" "$examples/gold.mtlx"

finish examples
