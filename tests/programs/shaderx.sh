#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Documents that compile for all targets, and films on BSDFs. Arguments: mxgen, mxgen-compile, the document of films, more documents.
here=$(cd "$(dirname "$0")" && pwd)
mxgen=$(realpath "$1") compile=$(realpath "$2") films=$(realpath "$3")
shift 3
. "$here/common.sh"
for document in "$@" "$films"; do
    check "the document ${document##*/} compiles" exits 0 "$compile" "$document"
    check "${document##*/} has shaders" test -s out
done

functions() { grep -o '\<mx_[a-z_]*(' "$1" | sort -u; } # FILE
for target in glsl osl; do
    check "films are generated for $target" exits 0 "$mxgen" "$films" --target $target --interface reduced --names neutral --no-comments -o $target
    for over in $target/Over_*; do
        own=${over/Over_/Own_}
        case $over in
            *varnished*) check "${over#*/} has the functions of ${own#*/}" diff <(functions "$over") <(functions "$own") ;; # in another order
            *) check "${over#*/} is ${own#*/}" diff <(sed 's/Over_/Own_/g' "$over") "$own" ;;
        esac
    done
done
check 'the film is over the closure' grep -q 'mx_film_index(.*\.cosine)' glsl/Over_varnished.frag
check 'the closure below has no film' grep -q 'mx_fresnel_conductor(.*\.cosine)' glsl/Over_varnished.frag

# Operators by their values (ShaderX 4.2, 4.3): in1 has the weight of a mix, a scale of a BSDF is at most 1, and a coat with ior 0 is its weight.
cat >operators.mtlx <<'XML'
<?xml version="1.0"?>
<materialx version="1.39">
  <uniformedf name="red" type="EDF"><input name="intensity" type="color3" value="1, 0, 0"/></uniformedf>
  <uniformedf name="blue" type="EDF"><input name="intensity" type="color3" value="0, 0, 1"/></uniformedf>
  <mixedf name="mixed" type="EDF"><input name="in1" type="EDF" nodename="red"/><input name="in2" type="EDF" nodename="blue"/>
    <input name="weight" type="float" value="0.25"/></mixedf>
  <scaleedf name="scaled" type="EDF"><input name="in" type="EDF" nodename="mixed"/><input name="weight" type="color3" value="2, 1, 3"/></scaleedf>
  <surface name="Lamp" type="surfaceshader"><input name="edf" type="EDF" nodename="scaled"/></surface>
  <diffusebsdf name="paint" type="BSDF"/>
  <scalebsdf name="dim" type="BSDF"><input name="in" type="BSDF" nodename="paint"/><input name="weight" type="color3" value="4, 2, 1"/></scalebsdf>
  <translucentbsdf name="paper" type="BSDF"/>
  <mixbsdf name="both" type="BSDF"><input name="in1" type="BSDF" nodename="dim"/><input name="in2" type="BSDF" nodename="paper"/>
    <input name="weight" type="float" value="0.25"/></mixbsdf>
  <surface name="Shade" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="both"/></surface>
  <coatingbsdf name="half" type="BSDF"><input name="weight" type="float" value="0.5"/><input name="ior" type="float" value="0"/></coatingbsdf>
  <surface name="Coat" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="half"/></surface>
</materialx>
XML
check 'a lamp is generated' exits 0 "$mxgen" operators.mtlx -e Lamp --environment none --lights none --interface reduced --stdout
check 'a mix of EDFs has the weight of in1, and a scale its colour' grep -qF 'out1 = vec4(0.5, 0.0, 2.25, 1.0)' out
check 'the weights of BSDFs are printed' exits 0 "$mxgen" inspect --closures operators.mtlx -e Shade
check 'a mix of BSDFs has the weight of in1, and a scale is at most 1' grep -q '^  diffuse .*weight 0.25 \* (1.0, 0.5, 0.25)$' out
check 'the other one has the rest' grep -q '^  translucent .*weight 0.75$' out
check 'a coat with ior 0 is generated' exits 0 "$mxgen" operators.mtlx -e Coat --environment none --interface reduced --stdout
check 'its permittivity is so large that all is reflected' grep -qF 'float cg2 = c2 * (c2 + 1e14);' out
finish shaderx-compile
