#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The options that fit shaders to the conventions of hosts (docs/hosts.md). Arguments: mxgen, mxgen-compile ('' to compile nothing).
mxgen=$(realpath "$1") compile=${2:+$(realpath "$2")}
here=$(cd "$(dirname "$0")" && pwd)
tiles=$here/../../examples/tiles.mtlx
. "$here/common.sh"
cat >glass.mtlx <<'XML'
<materialx version="1.39">
  <standard_surface name="S" type="surfaceshader">
    <input name="transmission" type="float" value="0.8"/>
    <input name="opacity" type="color3" value="0.9, 0.9, 0.9"/>
  </standard_surface>
  <surfacematerial name="Glass" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
  <dielectric_bsdf name="mirror" type="BSDF"/>
  <dielectric_bsdf name="pane" type="BSDF"><input name="scatter_mode" type="string" value="T"/></dielectric_bsdf>
  <surface name="Mirror" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="mirror"/></surface>
  <surface name="Pane" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="pane"/></surface>
  <image name="wood" type="color3"><input name="file" type="filename" value="wood.png"/></image>
  <image name="bumps" type="vector3"><input name="file" type="filename" value="bumps.png"/></image>
  <output name="Picture" type="color3" nodename="wood"/>
  <output name="Vectors" type="vector3" nodename="bumps"/>
</materialx>
XML

# make ELEMENT OPTION...: generates for vulkan to the folder out.d
make() {
    rm -rf out.d
    exits 0 "$mxgen" glass.mtlx --element "$1" --target vulkan -o out.d --reflect "${@:2}"
}
says() { grep -qE -- "$1" "out.d/$2"; }

check 'a set and a first binding are accepted' make Glass --binding-set 2 --first-binding 5
check 'the private uniforms have the first binding' says 'layout\(set = 2, binding = 5, std140\) uniform PrivateUniforms' Glass.frag
check 'the public uniforms have the next binding' says 'layout\(set = 2, binding = 6, std140\) uniform PublicUniforms' Glass.frag
check 'the lights have the next binding' says 'layout\(set = 2, binding = 7, std140\) uniform LightData_block' Glass.frag
check 'the first texture has the next binding' says 'layout\(set = 2, binding = 8\) uniform sampler2D' Glass.frag
check 'the vertex stage has the same bindings' says 'layout\(set = 2, binding = 5, std140\) uniform PrivateUniforms' Glass.vert
check 'the reflection has the bindings' eval 'tr -d " \n" <out.d/Glass.json | grep -q "\"set\":2,\"binding\":6"'
check 'a set without sets in the target is wrong usage' exits 2 "$mxgen" glass.mtlx --target glsl --binding-set 1 --stdout

check 'glass is generated with refraction' make Glass
check 'refraction shows the environment' says 'refract' Glass.frag
check 'transmission may be opacity' make Glass --transmission opacity
check 'transmission as opacity shows no environment behind' eval '! says "ggx_refraction" Glass.frag'
check 'transmission as opacity lowers alpha' says 'out1 = vec4\(clamped_opacity_grey \* color, opacity\);' Glass.frag
check 'the transmitted part lowers alpha' says '^ *\* \(1.0 - clamp\(dot\(S_transmission_color' Glass.frag
check 'transmission may be opacity without an environment' make Glass --transmission opacity --environment none
check 'transmission as opacity lowers alpha without an environment' says 'out1 = vec4\(clamped_opacity_grey \* color, opacity\);' Glass.frag
check 'a mirror may have transmission as opacity' make Mirror --transmission opacity
check 'a mirror transmits nothing' says 'out1 = vec4\(opacity \* color, opacity\);' Mirror.frag
check 'a clear pane may have transmission as opacity' make Pane --transmission opacity --interface reduced
check 'a clear pane is invisible' says 'out1 = vec4\(.*0.0\);' Pane.frag

check 'a surface can be opaque' make Glass --transparency opaque
check 'an opaque surface keeps its colour' says 'out1 = vec4\(color, 1.0\);' Glass.frag
check 'an opaque surface discards nothing' eval '! says discard Glass.frag'
check 'the reflection says that the surface is opaque' eval 'tr -d " \n" <out.d/Glass.json | grep -q "\"transparent\":false"'
check 'a surface can be a cut-out' make Glass --transparency mask
check 'a cut-out discards' says discard Glass.frag
check 'a cut-out keeps its colour' says 'out1 = vec4\(color, 1.0\);' Glass.frag
check 'the reflection says that alpha is a mask' eval 'tr -d " \n" <out.d/Glass.json | grep -q "\"alpha\":\"mask\""'
check 'a surface can always be blended' make Mirror --transparency blend
check 'the reflection says that alpha is blended' eval 'tr -d " \n" <out.d/Mirror.json | grep -q "\"alpha\":\"blend\""'

check 'colours can be encoded' make Picture --encode srgb
check 'the encoding has both parts of the curve' eval 'says "12.92" Picture.frag && says "1.055 - vec3\(0.055\)" Picture.frag && says "0.0031308" Picture.frag'
check 'a surface can be encoded' make Glass --encode srgb
check 'an encoded surface has the curve' says '12.92' Glass.frag
check 'vectors are accepted with an encoding' make Vectors --encode srgb
check 'vectors are not encoded' eval '! says 12.92 Vectors.frag'

check 'textures can begin at the top' make Picture --texture-origin top
check 'textures from the top have v flipped' says 'texture\(wood_file, vec2\(vd.texcoord_0.x, 1.0 - vd.texcoord_0.y\)\)' Picture.frag
check 'tiles can begin at the top' exits 0 "$mxgen" "$tiles" --target vulkan --texture-origin top -o out.d
check 'tiles count upwards from the top, too' eval 'says "floor\(" "$(cd out.d && ls *.frag | head -1)"'

check 'names of the host can be reserved' make Glass --reserved S_transmission,out1,opacity_grey
check 'reserved names get numbers' eval 'says "float S_transmission_2;" Glass.frag && says "out vec4 out1_2;" Glass.frag && ! says " opacity_grey " Glass.frag'

check 'a shadow map is accepted' make Glass --shadow-map
check 'the shadow map is bound by its name' eval 'says "mat4 u_shadowMatrix;" Glass.frag && says "uniform sampler2D u_shadowMap;" Glass.frag'
check 'the shadow map serves the first light' eval 'says "occlusion = 1.0;" Glass.frag && says "float occlusion = " Glass.frag'
check 'an occlusion map is accepted' make Glass --occlusion-map
check 'the occlusion map is bound by its name' eval 'says "float u_ambOccGain;" Glass.frag && says "texture\(u_ambOccMap, vd.texcoord_0\).x" Glass.frag'
check 'a shadow map without lighting is wrong usage' exits 2 "$mxgen" glass.mtlx --target osl --shadow-map --stdout

# The names that ShaderGraph::create and finalize of MaterialX 1.39 give to the sockets of a graph.
cat >names.mtlx <<'XML'
<materialx version="1.39">
  <nodegraph name="NG">
    <input name="tint" type="color3" value="1, 0.5, 0.2"/>
    <mix name="color_mix" type="color3">
      <input name="fg" type="color3" interfacename="tint"/>
      <input name="bg" type="color3" value="0.1, 0.2, 0.3"/>
      <input name="mix" type="float" value="0.5"/>
    </mix>
    <output name="out" type="color3" nodename="color_mix"/>
  </nodegraph>
  <multiply name="dim" type="float"><input name="in1" type="float" value="0.4"/></multiply>
  <standard_surface name="SR" type="surfaceshader">
    <input name="base_color" type="color3" nodegraph="NG" output="out"/>
    <input name="base" type="float" nodename="dim"/>
    <input name="specular_color" type="color3" value="0.5, 0.5, 0.5" colorspace="srgb_texture"/>
  </standard_surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SR"/></surfacematerial>
</materialx>
XML
uniforms() { exits 0 "$mxgen" names.mtlx --element "$1" --target glsl --stdout "${@:2}" && sed -n 's/^uniform [a-z0-9]* \([a-zA-Z0-9_]*\) =.*/\1/p' out >names; }
check 'all inputs can be published' uniforms M --publish all
for name in color_mix_fg color_mix_bg color_mix_mix dim_in1 dim_in2 diffuse_roughness specular SR_specular_color_cm_in coat_IOR; do
    check "published inputs have MaterialX's names: $name" grep -qx "$name" names
done
check 'the inputs of the interface are published' uniforms M
for name in NG_tint SR_diffuse_roughness SR_specular_color; do
    check "inputs of the interface have the names of paths: $name" grep -qx "$name" names
done
check 'inputs of nodes inside are not published' eval '! grep -q "dim_\|color_mix" names'
check 'the inputs of a graph can be published' uniforms NG/out --publish all
check 'a graph has its inputs' eval 'grep -qx tint names && grep -qx color_mix_bg names'
check 'authored inputs of all nodes can be published' uniforms M --publish all --interface authored
check 'authored inputs are those in the document' eval 'grep -qx dim_in1 names && ! grep -qx dim_in2 names'

check 'a function is generated' make Glass --role function --prefix pane_ --rename u_viewPosition=eye,normalWorld=Nw,surface=pane
check 'the function has its name' says '^pane_Surface pane\(vec3 positionWorld, vec3 Nw' Glass.frag
check 'uniforms have the prefix' says '^    float pane_S_base;' Glass.frag
check 'functions have the prefix' says '^float pane_mx_fresnel_dielectric' Glass.frag
check 'the shader reads a name of the host' says 'eye - positionWorld' Glass.frag
check 'the shader does not declare a name of the host' eval '! says "vec3 eye;" Glass.frag'
check 'the function asks for the lights' says '^void mxg_light\(int i, vec3 P, out vec3 L, out vec3 radiance\);' Glass.frag
check 'a function has no vertex stage' eval '! [ -e out.d/Glass.vert ]'
check 'the reflection names the function' eval 'tr -d " \n" <out.d/Glass.json | grep -q "\"function\":\"pane\",\"functionType\":\"pane_Surface\""'
check 'a function of a displaced surface has the normal of the host' eval 'exits 0 "$mxgen" "${tiles%/*}/displaced.mtlx" --role function --target glsl --stdout >displaced && ! grep -Eq "cross\(|dFd|fwidth|(length|normalize)\(vec3\(0" displaced'
check 'a function may be without lights' make Glass --role function --lights none
check 'a function without lights asks for none' eval '! says mxg_light Glass.frag'
check 'a function may ask for more' make Glass --role function --prefix pane_ --host-occlusion --host-environment
check 'the function asks for the environment' says '^vec3 mxg_radiance\(vec3 P, vec3 L, float roughness\);' Glass.frag
check 'the function asks for occlusion, once in a file' eval 'grep -B2 "^float mxg_ambient_occlusion(vec3 P, vec3 N);" out.d/Glass.frag | grep -q "^#ifndef MXG_"'
check 'functions of the host have no prefix' eval '! grep -q "pane_mxg" out.d/Glass.frag'
check 'a program may ask its host' make Glass --host-lights
check 'the program has no lights of its own' eval 'says "mxg_light_count\(\) - 1" Glass.frag && ! says u_lightData Glass.frag'
check 'a program in Metal may ask its host' exits 0 "$mxgen" glass.mtlx --target msl -o metal --host-shadows --host-thickness
check 'its host is an argument buffer' grep -q 'constant MxgHost& mxg_host \[\[buffer(30)\]\]' metal/Glass.frag.metal
check 'it tells its host the pixel' grep -q 'host.mxg_pixel = int2(vd.pos.xy);' metal/Glass.frag.metal
check 'it calls functions of its host' grep -q 'mxg_host.mxg_shadow(i, vd.positionWorld' metal/Glass.frag.metal
check 'a vertex stage has no host' eval '! grep -q mxg_host metal/Glass.vert.metal'
check 'OSL has no functions of the host' exits 2 "$mxgen" glass.mtlx --target osl --stdout --host-shadows
check 'a prefix goes without a function' make Glass --prefix pane_ --rename out1=host_color
check 'the prefix is in all names' eval 'says "pane_VertexData" Glass.frag && says "pane_VertexData" Glass.vert && says "vec4 host_color" Glass.frag'
for options in '--role function --max-lights 8' '--role function --shadow-map' \
    '--role function --lights point_light' '--role scatter --shadow-map' '--role scatter --occlusion-map' \
    '--role scatter --transmission opacity' '--role scatter --encode srgb' '--role scatter --transparency mask' \
    '--role scatter --quality draft' '--role scatter --environment none' '--role scatter --environment prefiltered' \
    '--role scatter --ambient-occlusion primvar' '--role scatter --ambient-occlusion none'; do
    # shellcheck disable=SC2086
    check "options without effect are an error: $options" eval 'exits 1 "$mxgen" glass.mtlx --target glsl --stdout $options && grep -q "option-without-effect" err'
done
for options in '--rename u_viewPosition' '--rename =eye' '--rename a=b,c=b' '--rename a=b,a=c' \
    '--rename out1=uniform' '--rename out1=a-b' '--rename out1=main' '--rename vd=VertexData' '--prefix p_ --rename vd=p_VertexData' \
    '--role function --rename VertexData=Surface' '--role function --rename Surface=VertexData'; do
    # shellcheck disable=SC2086
    check "bad names are an error: $options" eval 'exits 1 "$mxgen" glass.mtlx --target glsl --stdout $options && grep -q "bad-option" err'
done
check 'lights beside none are an error' eval 'exits 1 "$mxgen" glass.mtlx --target glsl --lights none,point_light=1 --stdout && grep -q "\[bad-option\]" err'
check 'the default of an option may be given' exits 0 "$mxgen" glass.mtlx --target glsl --role scatter --transmission refraction --lights none --stdout
check 'OSL has no functions for hosts' exits 1 "$mxgen" glass.mtlx --target osl --role function --stdout

if [ -n "$compile" ]; then
    for options in '--binding-set 2 --first-binding 5' '--transmission opacity --transparency blend' '--transparency mask --encode srgb' \
        '--role function' '--role function --prefix a_ --rename normalWorld=N' '--prefix a_' '--texture-origin top --occlusion-map' '--shadow-map --reserved main,mx_square,color' '--transparency opaque'; do
        case $options in --binding*) targets=vulkan,hlsl ;; *) targets=glsl,vulkan,essl,essl310,hlsl ;; esac
        # shellcheck disable=SC2086
        check "a shader compiles with $options" exits 0 "$compile" glass.mtlx "$tiles" --targets $targets --interfaces complete,reduced $options
    done
else
    skip 'without glslang no shader is compiled'
fi
finish hosts
