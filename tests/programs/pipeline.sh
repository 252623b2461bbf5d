#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# The deferred pipeline: its passes, the combinations of options, what materials write. Arguments: mxgen, the folder of the examples.
mxgen=$(realpath "$1") examples=$(realpath "$2")
scripts=$(dirname "$(realpath "$0")")
source "$scripts/common.sh"

# ---- passes ----

check "the passes are generated" "$mxgen" pipeline passes
for name in classify compose light_simple light_single light_complex light_special show light_rays; do
    check "the pass $name has a shader and a reflection" test -s "passes/$name.comp" -a -s "passes/$name.json"
done
check "the functions for passes of a host are there" eval 'test -s passes/read.glsl -a ! -e passes/read.comp && grep -q "\"pass\": \"read\"" passes/read.json && ! grep -q groupSize passes/read.json'
check "the pass for decals is there" test -s passes/over.comp -a -s passes/over.json
check "a pass that the options do not ask for is not there" test ! -e passes/diffuse.comp -a ! -e passes/diffuse.json -a ! -e passes/blur.comp
check "passes are generated for OpenGL" "$mxgen" pipeline gl --target glsl
check "passes are generated for one light" "$mxgen" pipeline few --max-lights 1 --environment none
same() { cmp -s "$1/classify.comp" "$2/classify.comp"; }
check "a pass that lights nothing does not depend on lights" same passes few
check "a pass that lights depends on lights" bash -c '! cmp -s passes/light_simple.comp few/light_simple.comp'
check "passes are generated with names and inputs of a host" "$mxgen" pipeline named --uniform '**' --rename positionWorld=pw --prefix x_
check "names and inputs of a host do not change passes" diff -r passes named
check "passes are generated with functions of a host" "$mxgen" pipeline hosted --host-lights --host-occlusion --host-environment
asked() { python3 -c 'import json, sys
assert set(json.load(open(sys.argv[1]))["hostFunctions"]) == set(sys.argv[2:]), sys.argv' "$@"; }
for name in simple single complex special rays; do
    check "the reflection names the functions of the host: light_$name" asked "hosted/light_$name.json" mxg_light_count mxg_light mxg_ambient_occlusion mxg_irradiance mxg_radiance
done
check "passes without light ask the host for nothing" eval 'cmp -s passes/classify.comp hosted/classify.comp && ! grep -q hostFunctions hosted/compose.json passes/*.json'
check "passes are generated with shadows of a host" "$mxgen" pipeline shaded --host-shadows --environment none
check "the shadows are the only function" asked shaded/light_single.json mxg_shadow
check "material passes do not depend on functions of the host" eval '"$mxgen" "$examples/deferred.mtlx" -e Plain --target vulkan --role deferred -o own &&
    "$mxgen" "$examples/deferred.mtlx" -e Plain --target vulkan --role deferred --host-lights --host-environment -o other && cmp own/Plain.frag other/Plain.frag'
check "a run without a folder is wrong usage" exits 2 "$mxgen" pipeline
check "a target without passes is wrong usage" exits 2 "$mxgen" pipeline out --target mdl
check "and the message has the option that the target needs" grep -q "'mdl' has no passes .*--mdl-module NAME" err

# Compiles all passes of a folder with glslang's own program, where there is one.
compiles() {
    local file
    for file in "$1"/*.comp; do
        glslangValidator $2 "$file" >compile.log 2>&1 || { cat compile.log; return 1; }
    done
}
if command -v glslangValidator >/dev/null; then
    "$mxgen" pipeline shadow --shadow-map --environment prefiltered --albedo table --storage float >/dev/null
    "$mxgen" pipeline spread --sss diffusion >/dev/null
    "$mxgen" pipeline blurred --rough-refraction blur >/dev/null
    "$mxgen" pipeline soft --rough-refraction blur --sss diffusion >/dev/null
    for folder in passes few shadow spread blurred soft; do
        check "the passes compile: $folder" compiles "$folder" "-V -o code.spv"
    done
    cat >host.glsl <<'X'
int mxg_light_count() { return mxg_pixel.x; }
void mxg_light(int i, vec3 P, out vec3 L, out vec3 radiance) { L = normalize(P); radiance = P; }
float mxg_ambient_occlusion(vec3 P, vec3 N) { return dot(P, N); }
vec3 mxg_irradiance(vec3 P, vec3 N) { return P + N; }
vec3 mxg_radiance(vec3 P, vec3 L, float roughness) { return P + roughness * L; }
X
    for file in hosted/light_*.comp; do cat host.glsl >>"$file"; done
    mkdir -p reading
    { echo "#version 450"; cat passes/read.glsl; cat; } >reading/read.comp <<'X'
layout(local_size_x = 1) in;
void main()
{
    MxClosure top;
    if (mx_read_top(ivec2(gl_GlobalInvocationID.xy), top) && top.roughness + top.f0.x + top.normal.x < 0.0)
        memoryBarrier();
}
X
    check "a pass of a host reads the top" compiles reading "-V -o code.spv"
    check "the passes with functions of a host compile" compiles hosted "-V -o code.spv"
    check "the passes for OpenGL compile" compiles gl ""
else
    skip "no glslangValidator"
fi

# ---- other languages ----

for target in hlsl slang msl; do
    check "passes are generated for $target" "$mxgen" pipeline "$target" --target "$target"
done
check "files of passes have the endings of their languages" test -s hlsl/over.cs.hlsl -a -s hlsl/read.hlsl -a -s slang/over.comp.slang -a -s msl/show.comp.metal -a -s msl/read.metal
check "passes in Metal ask their host" "$mxgen" pipeline hosted_msl --target msl --host-lights --host-environment
check "they tell it the pixel" grep -q '^    mxg_host.mxg_pixel = pixel;' hosted_msl/light_single.comp.metal
check "those that light nothing have no host" eval '! grep -q mxg_ hosted_msl/classify.comp.metal hosted_msl/compose.comp.metal'
if command -v glslangValidator >/dev/null; then
    cat hlsl/read.hlsl - >read.hlsl <<'X'
RWTexture2D<float4> picture : register(u0, space0);
[numthreads(8, 8, 1)]
void main(uint3 pixel : SV_DispatchThreadID)
{
    MxClosure top;
    picture[pixel.xy] = mx_read_top(int2(pixel.xy), top) ? float4(top.f0, top.roughness) : (float4)0.0;
}
X
    check "a pass of a host in HLSL reads the top" glslangValidator -D -V -e main -S comp -o code.spv read.hlsl
    "$mxgen" pipeline hosted_hlsl --target hlsl --host-lights --host-environment >/dev/null
    cat hosted_hlsl/light_single.cs.hlsl - >hosted.hlsl <<'X'
int mxg_light_count() { return mxg_pixel.x; }
void mxg_light(int i, float3 P, out float3 L, out float3 radiance) { L = normalize(P); radiance = P; }
float3 mxg_irradiance(float3 P, float3 N) { return P + N; }
float3 mxg_radiance(float3 P, float3 L, float roughness) { return P + roughness * L; }
X
    check "a pass in HLSL calls functions of a host" glslangValidator -D -V -e main -S comp -o code.spv hosted.hlsl
else
    skip "no glslangValidator"
fi

# ---- reflection ----

# The arguments of pass_layouts.py: the JSON of all passes of some folders, each with its SPIR-V as text.
disassembled() {
    local file
    for file in $(printf '%s/*.comp ' "$@"); do
        glslangValidator -V -o code.spv "$file" >/dev/null && spirv-dis --raw-id code.spv -o "$file.spvasm" || return 1
        echo "${file%.comp}.json" "$file.spvasm"
    done
}
if command -v glslangValidator >/dev/null && command -v spirv-dis >/dev/null; then
    check "the reflection has what the passes have" python3 "$scripts/pass_layouts.py" $(disassembled passes spread soft)
else
    skip "no glslangValidator or spirv-dis"
fi

# ---- materials ----

number() { sed -n "s/.*\"$2\": \([0-9]*\).*/\1/p" "$1" | head -1; }
check "materials are generated" "$mxgen" "$examples/deferred.mtlx" --target vulkan --role deferred --interface reduced --reflect -o materials
fits() {
    local file
    for file in materials/[!L]*.json materials/Lantern.json materials/Lacquered.json passes/[!l]*.json \
        passes/light_[!r]*.json; do
        [ "$(number "$file" layout)" = "$(number passes/show.json layout)" ] || { echo "$file"; return 1; }
    done
}
check "all reflections have one layout" fits
"$mxgen" pipeline float --storage float >/dev/null
other_layout() { [ "$(number float/show.json layout)" != "$(number passes/show.json layout)" ]; }
check "another storage has another layout" other_layout
"$mxgen" pipeline spread --sss diffusion >/dev/null
"$mxgen" pipeline blurred --rough-refraction blur >/dev/null
check "a material is generated for blur" "$mxgen" "$examples/frosted.mtlx" --target vulkan --role deferred --rough-refraction blur --reflect -o frosted
check "a material for blur has the layout of its passes" eval '[ "$(number frosted/Frosted.json layout)" = "$(number blurred/show.json layout)" ]'
check "a forward shader is generated for blur" "$mxgen" "$examples/frosted.mtlx" --target vulkan --rough-refraction blur -o forward
check "a forward shader blurs values by derivatives" grep -q 'dFdx(vd.positionWorld)' forward/Frosted.frag
check "a path tracer is generated for blur" "$mxgen" "$examples/frosted.mtlx" --target vulkan --role scatter --rough-refraction blur -o traced
check "a path tracer blurs values by ray differentials" grep -q 'vd.dx_texcoord_0' traced/Frosted.frag
cat >ridges.mtlx <<'X'
<materialx version="1.39">
  <nodedef name="ND_ridges" node="ridges">
    <input name="st" type="vector2" defaultgeomprop="UV0"/><input name="rounds" type="integer" value="3"/><output name="out" type="float"/>
  </nodedef>
  <implementation name="IM_ridges" nodedef="ND_ridges" file="ridges.glsl" function="ridges"/>
  <ridges name="few" type="float"/>
  <surface_unlit name="S" type="surfaceshader"><input name="emission" type="float" nodename="few"/></surface_unlit>
  <cellnoise2d name="random" type="float"/>
  <floor name="any" type="integer"><input name="in" type="float" nodename="random"/></floor>
  <ridges name="many" type="float"><input name="rounds" type="integer" nodename="any"/></ridges>
  <surface_unlit name="V" type="surfaceshader"><input name="emission" type="float" nodename="many"/></surface_unlit>
</materialx>
X
cat >ridges.glsl <<'X'
float ridges(vec2 st, int rounds)
{
    float sum = 0.0;
    for (int i = 0; i < rounds; ++i)
        sum += dFdx(st.x * float(i + 1)) * float(i + 1);
    return sum;
}
X
check "a loop with derivatives is generated for paths" "$mxgen" ridges.mtlx -e S --target vulkan --role scatter -o ridges
check "its rounds are differences of rays, one after the other" grep -q 'dx_texcoord_0' ridges/S.frag
check "of the loop nothing is left" eval '! grep -q "for (int i = 0" ridges/S.frag'
check "a loop with rounds that vary is generated for paths" "$mxgen" ridges.mtlx -e V --target vulkan --role scatter -o ridges
check "it stays a loop" eval 'grep -q "for (int i = 0" ridges/V.frag && ! grep -q "dx_texcoord_0" ridges/V.frag'
check "that its derivatives are lost is told" eval '"$mxgen" ridges.mtlx -e V --target vulkan --role scatter -o ridges 2>&1 | grep -q "ridges.mtlx:10:3: warning: .*\[derivatives-left-out\]"'
check "a raster keeps them, without a message" eval '! "$mxgen" ridges.mtlx -e V --target vulkan -o ridges 2>&1 | grep -q derivatives-left-out'
sed 's/for (int i = 0; i < rounds; ++i)/if (st.y > 0.5)/; s/float(i + 1)/st.y/g' ridges.glsl >branch.glsl
sed 's/ridges\.glsl/branch.glsl/' ridges.mtlx >branch.mtlx
check "derivatives in a branch are generated for paths" "$mxgen" branch.mtlx -e S --target vulkan --role scatter -Werror -o branch
check "they are differences of rays" grep -q 'dx_texcoord_0' branch/S.frag
check "nothing is blurred without the option" eval '"$mxgen" "$examples/frosted.mtlx" --target vulkan -o sharp && ! grep -q "dFdx" sharp/Frosted.frag'
check "blur has another layout" eval '[ "$(number blurred/show.json layout)" != "$(number passes/show.json layout)" ]'
check "diffusion has another layout" eval '[ "$(number spread/show.json layout)" != "$(number passes/show.json layout)" ]'
check "diffusion has an image" eval 'grep -q "\"scattered\"" spread/light_single.json && ! grep -q "\"scattered\"" passes/light_single.json'
check "blur has an image" eval 'grep -q "\"below\"" blurred/light_complex.json && ! grep -q "\"below\"" blurred/light_single.json'
words() { [ "$(number "materials/$1.json" words)" = "$2" ]; }
check "Plain stores 3 words" words Plain 3
check "Lacquered stores 10 words" words Lacquered 10
check "Pearly stores 11 words" words Pearly 11
check "Glittering stores 15 words" words Glittering 15
check "a tint is stored as the number of a table" python3 -c 'import json
blocks = {block["name"]: block["variables"] for block in json.load(open("materials/Pearly.json"))["blocks"]}
number, = [v for v in blocks["PublicUniforms"] if v.get("documentType") == "filename"]
assert (number["type"], number["path"], number["file"]) == ("int", "pearl/specular_lut", "pearl.png"), number
tables = [v for block in json.load(open("passes/light_special.json"))["blocks"] for v in block["variables"] if v["name"] == "u_tints"]
assert len(tables) == 1 and tables[0]["semantic"] == "tints", tables'
check "one pass alone reads the tints" eval '! grep -q u_tints passes/light_complex.comp'
check "a cut-out has a depth pass" bash -c 'test -s materials/Lantern.depth.frag && grep -q discard materials/Lantern.depth.frag'
check "the depth pass has a vertex stage and bindings of its own" test -s materials/Lantern.depth.vert -a -s materials/Lantern.depth.json
check "its vertex stage places vertices as that of the material" eval 'diff <(grep gl_Position materials/Lantern.vert) <(grep gl_Position materials/Lantern.depth.vert)'
check "an opaque material has no depth pass" test ! -e materials/Plain.depth.frag
check "positions are invariant" grep -q 'invariant gl_Position' materials/Plain.vert

# A stack of eight layers of slabs.
{
    echo '<materialx version="1.39">'
    for i in 1 2 3 4 5 6 7 8; do
        echo "<slab name='s$i' type='BSDF'><input name='roughness' type='float' value='0.$i'/></slab>
<surface name='SR$i' type='surfaceshader'><input name='bsdf' type='BSDF' nodename='s$i'/></surface>
<surfacematerial name='M$i' type='material'><input name='surfaceshader' type='surfaceshader' nodename='SR$i'/></surfacematerial>"
    done
    echo '<look name="L">'
    for i in 1 2 3 4 5 6 7 8; do
        echo "<materialassign name='a$i' geom='/a' material='M$i' slot='0$i'/>"
    done
    echo '</look></materialx>'
} >eight.mtlx
echo /a >eight.txt
check "a stack of eight layers is generated" "$mxgen" eight.mtlx --stage eight.txt --look L --target vulkan --role deferred --reflect -o eight

# ---- other materials, as slabs ----

cat >models.mtlx <<'X'
<materialx version="1.39">
  <standard_surface name="Paint" type="surfaceshader"><input name="base" type="float" value="1"/></standard_surface>
  <standard_surface name="Glass" type="surfaceshader"><input name="transmission" type="float" value="1"/></standard_surface>
  <surface_unlit name="Flat" type="surfaceshader"/>
  <metalbsdf name="satin" type="BSDF"><input name="distribution" type="string" value="beckman"/></metalbsdf>
  <surface name="Satin" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="satin"/></surface>
</materialx>
X
as_slabs() { "$mxgen" models.mtlx --target vulkan --role deferred --reflect -o models "$@" >out 2>&1; }
check "a model without --slabs is an error" exits 1 as_slabs -e Paint
check "the error is closure-not-stored" grep -q closure-not-stored out
check "a model is generated as slabs" as_slabs -e Paint --interface reduced --slabs
check "a model as slabs takes the bytes of one slab" eval '[ "$(number models/Paint.json words)" = 3 ] && ! grep -q drawn-forward out'
check "a model with all inputs is generated as slabs" as_slabs -e Paint --slabs --transparency opaque
check "the glass of the model is compiled in" python3 -c 'import json
reflection = json.load(open("models/Paint.json"))
assert reflection["deferred"]["words"] > 3, reflection["deferred"]
compiled = {item["path"] for item in reflection["compiledInputs"]}
assert {"Paint/transmission", "Paint/thin_walled"} <= compiled and "Paint/specular_roughness" not in compiled, compiled'
check "glass is generated" as_slabs -e Glass --interface reduced --slabs
check "a message says that glass is drawn forward" grep -q "'Glass' is drawn forward: its part 'refraction' is no slab" out
check "glass lights itself" eval '! grep -q mx_word0 models/Glass.frag && grep -q u_envRadiance models/Glass.frag'
check "facets of another distribution are generated" as_slabs -e Satin --interface reduced --slabs --transparency opaque
check "facets of another distribution are drawn forward" eval 'grep -q "drawn forward: its part .metal. is no slab" out && grep -q mx_beckmann_smith models/Satin.frag'
check "glass in a budget is generated" as_slabs -e Glass --interface reduced --max-slabs 4
check "glass in a budget is stored" eval 'grep -q mx_word0 models/Glass.frag && ! grep -q drawn-forward out'
cat >absent.mtlx <<'X'
<materialx version="1.39">
  <oren_nayar_diffuse_bsdf name="none" type="BSDF"><input name="weight" type="float" value="0"/></oren_nayar_diffuse_bsdf>
  <oren_nayar_diffuse_bsdf name="red" type="BSDF"><input name="color" type="color3" value="0.75, 0.125, 0.25"/></oren_nayar_diffuse_bsdf>
  <layer name="both" type="BSDF"><input name="top" type="BSDF" nodename="none"/><input name="base" type="BSDF" nodename="red"/></layer>
  <surface name="SR" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="both"/></surface>
</materialx>
X
stores_red() {
    "$mxgen" absent.mtlx --target vulkan --role deferred --interface reduced --slabs -o absent "$@" >out &&
        grep -q 'mx_store_closure(stored, vec3(0.75, 0.125, 0.25)' absent/SR.frag
}
check "a top of weight 0 hides nothing" stores_red
check "a top of weight 0 hides all with --layering occluding" eval '! stores_red --layering occluding && test -s absent/SR.frag'
check "a material that only glows is generated" as_slabs -e Flat --interface reduced
check "options of slabs are accepted for passes" "$mxgen" pipeline slabs --slabs --max-slabs 1
check "options of slabs do not change passes" eval 'cmp -s slabs/light_complex.comp passes/light_complex.comp'

# ---- payloads of rays ----

payload() { "$mxgen" models.mtlx -e "$1" --target "$2" --role payload --interface reduced --reflect -o rays >out 2>&1; }
# A closest-hit shader around the function of a payload, with zeros as vertex data.
wrap() {
    python3 - "$@" <<'X'
import json, sys
stage, source, reflection = sys.argv[1:]
variables = next((block["variables"] for block in json.load(open(reflection))["blocks"] if block["name"] == "VertexData"), [])
arguments = ", ".join(f"{variable['type']}(0)" for variable in variables)
head = {"rchit": "#version 460\n#extension GL_EXT_ray_tracing : require\n", "comp": "#version 430\n"}[stage]
out = {"rchit": "layout(location = 0) rayPayloadInEXT Surface payload;\n",
       "comp": "layout(local_size_x = 1) in;\nlayout(std430) buffer Out { Surface payload; };\n"}[stage]
print(head + open(source).read() + out + f"void main() {{ payload = surface({arguments}); }}")
X
}
for material in Paint Glass Flat; do
    check "a payload is generated: $material" payload $material vulkan
    check "a payload has 64 bytes: $material" eval '[ "$(number rays/$material.json words)" = 16 ] && [ "$(grep -c "uint word_" rays/$material.frag)" = 16 ]'
    check "a payload has the layout of the pass over rays: $material" eval '[ "$(number rays/$material.json layout)" = "$(number passes/light_rays.json layout)" ]'
    if command -v glslangValidator >/dev/null; then
        wrap rchit rays/$material.frag rays/$material.json >hit.rchit
        check "a payload compiles in a hit shader: $material" glslangValidator -V --target-env vulkan1.2 -o code.spv hit.rchit
    fi
done
check "a payload is generated for OpenGL" payload Paint glsl
if command -v glslangValidator >/dev/null; then
    wrap comp rays/Paint.frag rays/Paint.json >hit.comp
    check "a payload compiles for OpenGL" glslangValidator hit.comp
fi
check "a material of many slabs gives a payload of one" eval '"$mxgen" "$examples/slabs.mtlx" -e WrappedSilk --role payload --target vulkan --stdout -q >wrapped &&
    [ "$(grep -c "stored = mx_store_closure" wrapped)" = 1 ]'

# ---- words by a function ----

packed() { "$mxgen" "$examples/deferred.mtlx" -e Lacquered --target "$1" --role pack --interface reduced --reflect -o packed >out 2>&1; }
check "a function of words is generated" packed vulkan
check "it returns the words of the material pass" eval '[ "$(number packed/Lacquered.json words)" = "$(number materials/Lacquered.json words)" ] &&
    [ "$(grep -c "uint word_" packed/Lacquered.frag)" = 10 ] && [ "$(number packed/Lacquered.json layout)" = "$(number passes/show.json layout)" ]'
if command -v glslangValidator >/dev/null; then
    check "a function of words is generated for OpenGL" packed glsl
    wrap comp packed/Lacquered.frag packed/Lacquered.json >packed.comp
    check "a function of words compiles in a compute stage" glslangValidator packed.comp
fi
check "a function of words is generated for HLSL" packed hlsl

# ---- what is an error ----

cat >other.mtlx <<'X'
<materialx version="1.39">
  <oren_nayar_diffuse_bsdf name="chalk" type="BSDF"/>
  <surface name="SR" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="chalk"/></surface>
</materialx>
X
reports() {
    local id=$1
    shift
    exits 1 "$@" && grep -q "\[$id\]" err
}
check "a payload for OpenGL ES is an error" reports options-clash "$mxgen" models.mtlx -e Paint --role payload --target essl -o other
check "a payload with lights is an error" reports option-without-effect "$mxgen" models.mtlx -e Paint --role payload --max-lights 8 --target vulkan
echo '<materialx version="1.39"><constant name="c" type="color3"/></materialx>' >value.mtlx
check "a payload of a value is an error" reports not-renderable "$mxgen" value.mtlx -e c --role payload --target vulkan -o other
check "words of a transparent surface are an error" reports not-renderable "$mxgen" "$examples/slabs.mtlx" -e MilkySheet --role pack --target vulkan -o other
check "a closure that is no slab is an error" reports closure-not-stored "$mxgen" other.mtlx -e SR --target vulkan --role deferred -o other
{
    echo '<materialx version="1.39"><slab name="s0" type="BSDF"/>'
    for i in {1..16}; do
        echo "<slab name='t$i' type='BSDF'><input name='roughness' type='float' value='$(printf 0.%02d $i)'/></slab>
<slab_mix name='s$i' type='BSDF'><input name='fg' type='BSDF' nodename='t$i'/><input name='bg' type='BSDF' nodename='s$((i - 1))'/>
<input name='mix' type='float' value='0.5'/></slab_mix>"
    done
    echo '<slab_surface name="SR" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="sN"/></slab_surface></materialx>'
} >many.mtlx
sed 's/"sN"/"s16"/' many.mtlx >seventeen.mtlx
sed 's/"sN"/"s15"/' many.mtlx >sixteen.mtlx
check "17 slabs are an error" reports closures-not-stored "$mxgen" seventeen.mtlx -e SR --target vulkan --role deferred -o many
check "17 slabs are an error of words by a function" reports closures-not-stored "$mxgen" seventeen.mtlx -e SR --target vulkan --role pack -o many
check "16 slabs are words of a function" "$mxgen" sixteen.mtlx -e SR --target vulkan --role pack -o many
check "16 slabs are stored" "$mxgen" sixteen.mtlx -e SR --target vulkan --role deferred -o many
warns() { "$mxgen" "$examples/slabs.mtlx" -e MilkySheet --target vulkan --role deferred -o milky 2>&1 | grep -q drawn-forward; }
check "a message says that a transparent surface is drawn forward" warns
# told WORDS ARGUMENT...: a sheet that scatters, with its message
told() { "$mxgen" "$examples/slabs.mtlx" -e MilkySheet --target vulkan "${@:2}" -o milky 2>&1 | grep -qF -- "$1"; }
check "a sheet that is opaque by an option is drawn forward for its light from behind" told 'no word has the light from behind a sheet [drawn-forward]' --role deferred --transparency opaque
check "a payload tells that it has no light from behind" told 'no light comes from behind what is stored [slab-left-out]' --role payload
cat >rich.mtlx <<'X'
<materialx version="1.39">
  <slab name="rich" type="BSDF">
    <input name="glint_density" type="float" value="12"/>
    <input name="specular_lut" type="filename" value="tint.png"/>
    <input name="specular_lut_weight" type="float" value="0.5"/>
    <input name="fuzz_amount" type="float" value="0.5"/>
    <input name="emission" type="color3" value="1, 1, 1"/>
  </slab>
  <slab_surface name="SR" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="rich"/></slab_surface>
</materialx>
X
# lost OPTION...: the lines of the inputs that a role leaves out, in order
lost() { "$mxgen" rich.mtlx -e SR --target vulkan --reflect -o rich "$@" 2>&1 | sed -n 's/^rich.mtlx:\([0-9]*\):.*slab-left-out.*/\1/p' | sort -n | tr '\n' ' '; }
check "a payload tells of glints and tints" eval '[ "$(lost --role payload)" = "3 4 " ]'
check "a function of a pixel tells of nothing" eval '[ -z "$(lost --role pack)" ]'
check "it takes the change of coordinates by a pixel, for glints" grep -q dx_texcoord_0 rich/SR.json
check "a payload, which has no glints, takes none" eval 'lost --role payload && ! grep -q dx_texcoord_0 rich/SR.json'
check "a decal for images tells of all that they lack" eval '[ "$(lost --role payload --decals images)" = "3 4 6 7 " ]'
check "its reflection has the images" python3 -c 'import json
deferred = json.load(open("rich/SR.json"))["deferred"]
assert deferred["pass"] == "decal" and [t["name"] for t in deferred["targets"]] == ["decal_albedo", "decal_f0", "decal_normal", "decal_roughness"], deferred'
check "a material that is stored tells of nothing" eval '[ -z "$(lost --role deferred --decals images)" ]'
check "its reflection has the images that it reads" python3 -c 'import json
read = {r["name"] for r in json.load(open("rich/SR.json"))["deferred"]["resources"] if r["access"] == "read"}
assert read == {"decal_albedo", "decal_f0", "decal_normal", "decal_roughness"}, read'
check "a forward shader has no decals in images" reports option-without-effect "$mxgen" rich.mtlx -e SR --decals images -o rich
cat >aov.mtlx <<'X'
<materialx version="1.39">
  <slab name="matter" type="BSDF"/>
  <surface name="SR" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="matter"/></surface>
  <aov name="own" type="float"><input name="name" type="string" value="own"/><input name="value" type="float" value="1"/></aov>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SR"/></surfacematerial>
</materialx>
X
aovs_are_told() { "$mxgen" aov.mtlx --target vulkan --interface reduced --role deferred -o aovs "$@" 2>&1 | grep -q "drawn forward: it has AOVs"; }
check "a message says that AOVs are drawn forward" aovs_are_told
check "nothing is drawn forward without AOVs" exits 1 aovs_are_told --aovs none
# sum NAME: two nodes and a mask, as the slab of a material; equal slabs are one closure, whose weights are added.
sums() {
    local name=$1
    shift
    cat >"$name.mtlx" <<X
<materialx version="1.39">
  <slab name="a" type="BSDF"/><slab name="b" type="BSDF"/>
  <texcoord name="uv" type="vector2"/><extract name="m" type="float"><input name="in" type="vector2" nodename="uv"/></extract>
  <slab_mix name="mixed" type="BSDF"><input name="fg" type="BSDF" nodename="a"/><input name="bg" type="BSDF" nodename="half"/><input name="mix" type="float" nodename="m"/></slab_mix>
  <multiply name="half" type="BSDF"><input name="in1" type="BSDF" nodename="a"/><input name="in2" type="float" value="0.5"/></multiply>
  <multiply name="rest" type="BSDF"><input name="in1" type="BSDF" nodename="b"/><input name="in2" type="float" value="0.5"/></multiply>
  <slab_mix name="again" type="BSDF"><input name="fg" type="BSDF" nodename="b"/><input name="bg" type="BSDF" nodename="mixed"/><input name="mix" type="float" nodename="m"/></slab_mix>
  <add name="whole" type="BSDF"><input name="in1" type="BSDF" nodename="$1"/><input name="in2" type="BSDF" nodename="$2"/></add>
  <slab_surface name="SR" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="$3"/></slab_surface>
</materialx>
X
    "$mxgen" "$name.mtlx" -e SR --target vulkan --role deferred -o sum 2>&1
}
weighed_as() {
    local role=$1 words=$2
    shift 2
    sums "$@" >/dev/null
    "$mxgen" sum.mtlx -e SR --target vulkan --role "$role" --stdout >payload.glsl 2>payload.err && tr -d '\n' <payload.glsl | tr -s ' ' | grep -qF "stored = mx_store_closure(stored, $words"
}
too_heavy() { sums "$@" | grep -q 'drawn forward: a sum of equal slabs may weigh more than 1'; }
check "a sum of equal slabs is drawn forward" too_heavy sum a b whole
check "so is one that is too heavy in places" too_heavy sum mixed rest whole
check "a function of pixels adds their albedos and f0" weighed_as pack 'vec3(0.37565216), vec3(0.08), vec3(1.0),' sum a b whole
check "a payload adds their albedos and f0" weighed_as payload 'vec3(0.37565216), vec3(0.08), vec3(1.0),' sum a b whole
check "and tells nothing" eval '! grep -q slab-left-out payload.err'
check "halves stay one slab there" weighed_as payload 'vec3(0.18), vec3(0.04), vec3(1.0),' sum half rest whole
sed -i 's|<slab name="\(.\)" type="BSDF"/>|<slab name="\1" type="BSDF"><input name="f0" type="color3" value="0.7, 0.7, 0.7"/></slab>|g; s|nodename="half"/><input name="in2"|nodename="a"/><input name="in2"|; s|nodename="rest"/></add>|nodename="b"/></add>|' sum.mtlx
check "what goes beyond 1 is told" eval '"$mxgen" sum.mtlx -e SR --target vulkan --role payload --stdout 2>&1 >payload.glsl | grep -q "f0.*slab-left-out"'
cat >coated.mtlx <<'X'
<materialx version="1.39">
  <slab name="a" type="BSDF"/><slab name="b" type="BSDF"/>
  <add name="whole" type="BSDF"><input name="in1" type="BSDF" nodename="a"/><input name="in2" type="BSDF" nodename="b"/></add>
  <slab name="coat" type="BSDF"><input name="diffuse_albedo" type="color3" value="0, 0, 0"/><input name="mean_free_path" type="vector3" value="0.02, 0.02, 0.02"/></slab>
  <slab_layer name="coated" type="BSDF"><input name="top" type="BSDF" nodename="coat"/><input name="base" type="BSDF" nodename="whole"/></slab_layer>
  <slab_surface name="SR" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="coated"/></slab_surface>
</materialx>
X
check "a sum below a coat is told, too" eval '"$mxgen" coated.mtlx -e SR --target vulkan --role pack --stdout 2>&1 >payload.glsl | grep -q "diffuse_albedo.*slab-left-out"'
check "halves of equal slabs are stored" exits 1 too_heavy sum half rest whole
check "mixes of equal slabs are stored" exits 1 too_heavy sum a b again
for target in essl essl310 osl; do
    check "material passes for $target are an error" reports options-clash "$mxgen" "$examples/deferred.mtlx" -e Plain --target "$target" --role deferred -o no
done
check "passes for ESSL are an error" exits 2 "$mxgen" pipeline no --target essl
check "passes for OpenGL 3.3 are an error" reports options-clash "$mxgen" pipeline no --target glsl --target-version 330
check "passes do not light paths" reports options-clash "$mxgen" pipeline no --role scatter
check "passes light payloads" exits 0 "$mxgen" pipeline rays_lit --role payload

finish pipeline
