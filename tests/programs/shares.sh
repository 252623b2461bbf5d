#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Weights, mixes, coverages and opacities outside of 0 to 1 are those at the bounds, for every target and role. Argument: mxgen.
mxgen=$(realpath "$1")
. "$(dirname "$0")/common.sh"

# document LOW HIGH FACTOR: a material for each place where a document writes a share, with the shares LOW and HIGH.
document() {
    echo '<materialx version="1.39">'
    cat <<'END'
  <oren_nayar_diffuse_bsdf name="matt" type="BSDF"/>
  <dielectric_bsdf name="glass" type="BSDF"/>
  <uniform_edf name="glow" type="EDF"/>
  <uniform_edf name="red" type="EDF"><input name="color" type="color3" value="1, 0, 0"/></uniform_edf>
  <slab name="slab" type="BSDF"/>
  <slab name="other" type="BSDF"><input name="diffuse_albedo" type="color3" value="0.8, 0.1, 0.1"/></slab>
  <surface name="plain" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="matt"/></surface>
END
    local bound share
    for bound in low high; do
        share=$1
        [ "$bound" = high ] && share=$2
        cat <<END
  <oren_nayar_diffuse_bsdf name="weight_$bound" type="BSDF"><input name="weight" type="float" value="$share"/></oren_nayar_diffuse_bsdf>
  <mix name="mix_$bound" type="BSDF">
    <input name="bg" type="BSDF" nodename="matt"/><input name="fg" type="BSDF" nodename="glass"/><input name="mix" type="float" value="$share"/>
  </mix>
  <mix name="lights_$bound" type="EDF">
    <input name="bg" type="EDF" nodename="glow"/><input name="fg" type="EDF" nodename="red"/><input name="mix" type="float" value="$share"/>
  </mix>
  <multiply name="factor_$bound" type="BSDF"><input name="in1" type="BSDF" nodename="matt"/><input name="in2" type="float" value="$share"/></multiply>
  <multiply name="colour_$bound" type="BSDF">
    <input name="in1" type="BSDF" nodename="matt"/><input name="in2" type="color3" value="$share, 0.5, $share"/>
  </multiply>
  <slab_mix name="slabs_$bound" type="BSDF">
    <input name="bg" type="BSDF" nodename="slab"/><input name="fg" type="BSDF" nodename="other"/><input name="mix" type="float" value="$share"/>
  </slab_mix>
  <slab_coverage name="coverage_$bound" type="BSDF"><input name="in" type="BSDF" nodename="slab"/><input name="weight" type="float" value="$share"/></slab_coverage>
  <surface name="opacity_$bound" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="matt"/><input name="opacity" type="float" value="$share"/></surface>
  <surface_unlit name="unlit_$bound" type="surfaceshader"><input name="emission" type="float" value="1"/><input name="opacity" type="float" value="$share"/></surface_unlit>
  <mix name="surfaces_$bound" type="surfaceshader">
    <input name="bg" type="surfaceshader" nodename="plain"/><input name="fg" type="surfaceshader" nodename="opacity_$bound"/>
    <input name="mix" type="float" value="$share"/>
  </mix>
END
        local name
        for name in weight mix factor colour slabs coverage; do
            echo "  <surface name=\"s_${name}_$bound\" type=\"surfaceshader\"><input name=\"bsdf\" type=\"BSDF\" nodename=\"${name}_$bound\"/></surface>"
        done
        echo "  <surface name=\"s_lights_$bound\" type=\"surfaceshader\"><input name=\"edf\" type=\"EDF\" nodename=\"lights_$bound\"/></surface>"
    done
    cat <<END
  <multiply name="bright" type="EDF"><input name="in1" type="EDF" nodename="glow"/><input name="in2" type="float" value="$3"/></multiply>
  <surface name="s_bright" type="surfaceshader"><input name="edf" type="EDF" nodename="bright"/></surface>
</materialx>
END
}
document 0 1 1 >bounds.mtlx
document -0.75 2 1 >outside.mtlx
document -0.75 2 3 >brighter.mtlx
for run in 'glsl raster' 'glsl scatter' 'vulkan deferred' 'osl' 'mdl'; do
    read -r target role <<<"$run"
    options=(--target "$target" ${role:+--role "$role"} --interface reduced)
    [ "$role" != deferred ] || options+=(--slabs)
    for name in bounds outside brighter; do
        check "$run: $name is generated" exits 0 "$mxgen" "$name.mtlx" "${options[@]}" -o "$name $run"
    done
    check "$run: a share outside of its bounds is the bound" diff -r "bounds $run" "outside $run"
    check "$run: it has materials" test "$(find "bounds $run" -type f | wc -l)" -gt 12
done
check 'the factor of an EDF may be more than 1' exits 1 diff -r 'outside glsl raster' 'brighter glsl raster'
check 'this one alone differs' test "$(grep -c '^diff' out)" = 1
finish shares
