#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A library from its sources gives the same shaders as its library image. Arguments: mxgen.
mxgen=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
root=$here/../..
. "$here/common.sh"

# Shading models with varying inputs, images, channels, products, a normal map, a node with two connections, constants.
{
    echo '<materialx version="1.39">'
    for model in standard_surface open_pbr_surface gltf_pbr UsdPreviewSurface disney_principled; do
        echo "<$model name=\"all_$model\" type=\"surfaceshader\"/>"
    done
    cat <<'END'
<image name="color" type="color3"><input name="file" type="filename" value="a.png"/></image>
<image name="grey" type="float"><input name="file" type="filename" value="b.png"/></image>
<normalmap name="bent" type="vector3"><input name="in" type="vector3" value="0.4, 0.5, 0.9"/></normalmap>
<standard_surface name="textured" type="surfaceshader">
  <input name="base_color" type="color3" nodename="color"/>
  <input name="specular_color" type="color3" nodename="color"/>
  <input name="specular_roughness" type="float" nodename="grey"/>
  <input name="transmission" type="float" nodename="grey"/>
  <input name="normal" type="vector3" nodename="bent"/>
</standard_surface>
<gltf_pbr name="equal" type="surfaceshader">
  <input name="metallic" type="float" nodename="grey"/>
  <input name="roughness" type="float" nodename="grey"/>
  <input name="transmission" type="float" nodename="grey"/>
</gltf_pbr>
<separate3 name="channels" type="multioutput"><input name="in" type="color3" nodename="color"/></separate3>
<multiply name="darker" type="color3">
  <input name="in1" type="color3" nodename="color"/>
  <input name="in2" type="float" nodename="grey"/>
</multiply>
<gltf_pbr name="packed" type="surfaceshader">
  <input name="base_color" type="color3" nodename="darker"/>
  <input name="occlusion" type="float" nodename="channels" output="outr"/>
  <input name="roughness" type="float" nodename="channels" output="outg"/>
  <input name="metallic" type="float" nodename="channels" output="outb"/>
  <input name="normal" type="vector3" nodename="bent"/>
</gltf_pbr>
<open_pbr_surface name="twice" type="surfaceshader">
  <input name="base_color" type="color3" nodename="darker"/>
  <input name="subsurface_color" type="color3" nodename="darker"/>
  <input name="specular_roughness" type="float" nodename="channels" output="outg"/>
  <input name="geometry_normal" type="vector3" nodename="bent"/>
  <input name="geometry_coat_normal" type="vector3" nodename="bent"/>
</open_pbr_surface>
<constant name="none" type="float"><input name="value" type="float" value="0"/></constant>
<standard_surface name="reduced" type="surfaceshader">
  <input name="coat" type="float" nodename="none"/>
  <input name="base_color" type="color3" nodename="darker"/>
</standard_surface>
</materialx>
END
} >models.mtlx

sources=(--no-builtin-library --library "$root/libraries")

compare() {
    local document=$1
    shift
    rm -rf image sources
    "$mxgen" "$document" -q -o image "$@" >/dev/null 2>&1
    "$mxgen" "$document" -q -o sources "${sources[@]}" "$@" >/dev/null 2>&1
    [ -n "$(ls image)" ] && diff -r image sources
}

for options in '' '--interface reduced' '--environment prefiltered' '--environment none --lights directional_light' '--layering two-sided' \
    '--role path' '--target vulkan --interface authored'; do
    check "the shaders of models.mtlx are the same with $options" compare models.mtlx --target glsl $options
done
for document in "$root"/examples/*.mtlx "$root"/bench/standard_surface_default.mtlx; do
    check "the shaders of ${document##*/} are the same" compare "$document" --target glsl
done

finish image
