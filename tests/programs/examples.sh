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

# All documents go to one process: each start of glslang makes its tables of built-in functions again.
for target in vulkan osl hlsl; do
    check "the documents are generated for $target" exits 0 "$mxgen" "$examples"/*.mtlx --target $target -o $target.d
    check "they give no warning" test ! -s err
done
check 'no line is long' eval 'find vulkan.d osl.d hlsl.d -type f -exec awk "length(\$0) > 140 { print FILENAME \":\" FNR; long = 1 } END { exit long }" {} +'
[ -z "$compile" ] || check 'they compile' exits 0 "$compile" "$examples"/*.mtlx
[ -z "$compile_osl" ] || check 'they compile as OSL' exits 0 "$compile" "$examples"/*.mtlx --targets osl
for document in "$examples"/*.mtlx; do
    check "${document##*/} is in the list of examples" grep -qF "\`${document##*/}\`" "$examples/README.md"
    check "${document##*/} has shaders" test -d "vulkan.d/$(basename "$document" .mtlx)"
done
# Materials of MDL with one module of functions, as docs/mdl.md has them.
check 'examples are generated as MDL' exits 0 "$mxgen" "$examples"/{gold,marble,textured,slabs}.mtlx --target mdl --mdl-module studio -o mdl.d
check 'their module is generated' exits 0 "$mxgen" pipeline mdl.d --target mdl --mdl-module studio
check 'it has what they call' eval '[ -z "$(comm -23 <(grep -ho "studio::mx_[a-z0-9_]*" mdl.d/*/*.mdl | sed "s/studio:://" | sort -u) <(sed -n "s/^export .* \(mx_[a-z0-9_]*\)(.*/\1/p" mdl.d/studio.mdl | sort))" ]'
check 'they call it' [ "$(grep -ho 'studio::mx_[a-z0-9_]*' mdl.d/*/*.mdl | sort -u | wc -l)" -ge 10 ]
! command -v mdlc >/dev/null || check 'mdlc compiles them' mdlc --no-resolve-resources -W 183=off -p mdl.d ::studio ::gold::Gold ::marble::Marble ::slabs::CarPaint
# Light data and light code are made of what is bound, and of nothing else.
for lights in lantern_light=7 none; do
    check "lantern.mtlx is generated with the lights $lights" exits 0 "$mxgen" "$examples/lantern.mtlx" --lights "$lights" --environment none -o out.d
    mv out.d/Wood.frag "$lights.frag"
done
check 'the light data has members of the light' grep -qE '^ *float upwards;' lantern_light=7.frag
check 'the light data has no members of other lights' eval '! grep -qE "inner_angle|decay_rate|intensity" lantern_light=7.frag'
check 'the light is chosen by its number' grep -q 'type == 7' lantern_light=7.frag
check 'a shader without lights and environment has no code of them' eval '! grep -qiE "light|u_env|mx_ggx" none.frag'
[ -z "$compile" ] || check 'compiles' exits 0 "$compile" "$examples/lantern.mtlx" --lights lantern_light=7
# Lights made of nodes stand where the host puts them, and have the inputs of their definition.
check 'stage.mtlx is generated with its lights' exits 0 "$mxgen" "$examples/stage.mtlx" --lights spot=1,bulb=2 --environment none --reflect -o out.d
for member in 'vec3 position' 'vec3 direction' 'float temperature' 'float power'; do
    check "the lights of stage.mtlx have the member $member" grep -qE "^ *$member;" out.d/Curtain.frag
done
check 'the lights of stage.mtlx have no other members' eval '! grep -qE "decay_rate|float intensity|inner_angle;" out.d/Curtain.frag'
check 'the reflection names the lights' eval 'grep -q "\"shader\": *\"spot\"" out.d/Curtain.json && grep -q "\"shader\": *\"bulb\"" out.d/Curtain.json'
check 'a chain of light types is not nested' exits 0 "$mxgen" "$examples/stage.mtlx" --element Curtain --lights "$(seq -f spot=%g -s , 1 400)" -o many -q
check 'each further type is an else if' eval '[ $(grep -c "^        } else if (light_type == [0-9]*) {" many/Curtain.frag) -ge 398 ]'
[ -z "$compile" ] || check 'stage.mtlx compiles' exits 0 "$compile" "$examples/stage.mtlx" --lights spot=1,bulb=2
cat >key.mtlx <<'XML'
<?xml version="1.0"?>
<materialx version="1.39">
  <point_light name="key" type="lightshader"/>
  <light name="off" type="lightshader"/>
  <standard_surface name="S" type="surfaceshader"/>
</materialx>
XML
check 'a light that is a function fails' exits 1 "$mxgen" key.mtlx --element S --lights key=1 -o out.d
check 'the error says to bind the definition of the light' grep -q "unknown light shader 'key'; bind 'point_light'" err
check 'a light that emits nothing fails' exits 1 "$mxgen" key.mtlx --element S --lights off=1 -o out.d
check 'the error says that the node has no EDF' grep -q "the node has no EDF" err
check 'a light is no element to render' exits 1 "$mxgen" key.mtlx --element key -o out.d
check 'the program reflection runs' exits 0 "${program[reflection]}" "$examples/marble.mtlx"
check 'the program reflection prints the user interface' grep -q "float NG_marble_scale = 5 .*shown as 'Scale' from 0.1 to 50" out
check 'the program reflection prints textures' eval '"${program[reflection]}" "$examples/textured.mtlx" | grep -q "sampler2D image_color_file .*textures/wood_color.png"'
check 'the program osl_network runs' exits 0 "${program[osl_network]}" "$examples/marble.mtlx" .
cp out marble.oslgroup
check 'the program osl_network prints layers' grep -q '^shader ND_fractal3d_float NG_marble_noise ;' out
check 'the program osl_network connects layers' grep -q '^connect NG_marble_scaled.out NG_marble_noise.position ;' out
check 'the program osl_network gives values' grep -q '^param int octaves 4 ;' out
check 'the program osl_network ends in a material' grep -q '^connect SR_marble_surface.out root.surfaceshader ;' out
check 'the program osl_network writes each shader' eval 'for name in $(sed -n "s/^shader \([^ ]*\) .*/\1/p" out); do [ -s $name.osl ] || exit 1; done'
[ -z "$compile_osl" ] || check 'that compile' exits 0 "$compile" "$examples/marble.mtlx" --targets osl --osl-network
if command -v oslc >/dev/null && command -v testshade >/dev/null; then
    check 'oslc compiles each shader of the network' eval 'for file in ND_*.osl mx_*.osl; do oslc -q "$file" || exit 1; done'
    printf 'shader show(color value = 0) { printf("%%.3f %%.3f %%.3f\\n", value[0], value[1], value[2]); }' >show.osl
    check 'oslc compiles the shader that shows values' oslc -q show.osl
    sed -i '/^shader mx_surface_root/,$d' marble.oslgroup
    printf 'shader show show ;\nconnect NG_marble_color.out show.value ;\n' >>marble.oslgroup
    check 'testshade runs the group' exits 0 testshade -t 1 -g 1 1 --group marble.oslgroup
    check 'the marble of the group is between both colours' eval 'read -r r g b <out && awk "BEGIN { exit !($r >= 0.149 && $r <= 0.801 && $b >= 0.249 && $b <= 0.751) }"'
else
    skip 'without oslc and testshade the group is not run'
fi
check 'the program edit runs' exits 0 "${program[edit]}"
sed '1,/<\/materialx>/d' out >polished.mtlx
check 'the program edit writes what it built' eval 'sed "/<\/materialx>/q" out | "$mxgen" --target vulkan --stdout - | grep -q noise'
check 'the program edit writes what it edited' eval '"$mxgen" --target vulkan --stdout polished.mtlx >edited && [ -s edited ] && ! grep -q noise edited'
check 'the program embedding runs' exits 0 "${program[embedding]}"
check 'the program embedding reads a value' grep -qx '  metalness = 1' out
check 'the program embedding follows a connection' grep -qx '  base_color reads Wood' out
check 'the program embedding prints blocks with sizes' grep -q '^PublicUniforms: set 0, binding 1, [1-9][0-9]* bytes$' out
check 'the program embedding prints an input that is compiled in' grep -q '^compiled in: vector2 Wood/uvtiling = 4.0, 4.0$' out
check 'the program embedding keeps its shader for a value' grep -q '^change 1, 1 values$' out
check 'the program embedding compiles another shader for a constant' eval '[ "$(sed -n "/^change/{s/.* \([0-9]\), .*/\1/;p}" out | tr "\n" " ")" = "1 2 " ]'
check 'the program embedding reports a misspelt input' grep -qx 'there is no SR/metal' out
check 'the program embedding reports the place of an error' grep -q '^broken.mtlx:1:[0-9]*: dangling-nodename$' out
check 'the program host_resolver runs' exits 0 "${program[host_resolver]}"
check 'the program host_resolver reads three assets' grep -q 'fract' out
# Each change finds only the primitives that it touches: an item, none where a name is known there, a shelf with its hundred items.
cat >tree.txt <<'X'
the scene [000 Paint] [050 Dust], 20202 primitives
a layer on an item [000 Paint] [050 Dust] [100 Paint], 1 primitives
no paint below it [050 Dust] [100 Paint], 0 primitives
a layer on a shelf [050 Dust] [070 Dust] [100 Paint], 101 primitives
another material there [050 Dust] [070 Paint] [100 Paint], 0 primitives
the paint again [000 Paint] [050 Dust] [070 Paint] [100 Paint], 0 primitives
X
check 'the program assign runs' exits 0 "${program[assign]}" 20000
check 'the program assign has the layers of a primitive after each change' eval 'sed "s| */hall_0/shelf_12/item_17||" out | diff tree.txt -'
[ -z "${program[c_minimal]:-}" ] || check 'c_minimal' exits 0 "${program[c_minimal]}" "$examples/gold.mtlx"

finish examples
