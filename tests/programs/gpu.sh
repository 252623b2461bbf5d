#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Shaders need no more registers on a GPU than MaterialX's, reduced ones fewer, and at least as many waves run at once; the layers of a stack do not need
# registers together. What Mesa's compiler tells of an AMD GPU that need not be there. Arguments: mxgen, bench-gpustat, the folder bench.
mxgen=$(realpath "$1") gpustat=$(realpath "$2") bench=$(realpath "$3")
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"
drivers=(/usr/share/vulkan/icd.d/radeon_icd.*.json)
[ -e "${drivers[0]}" ] || { skip 'no RADV (the package mesa-vulkan-drivers)'; finish gpu; }
command -v glslangValidator >/dev/null || { skip 'no glslangValidator'; finish gpu; }

theirs() { awk -F'\t' -v d="$1" -v i="$2" -v c="$3" 'NR == 1 { for (k = 1; k <= NF; k++) at[$k] = k } $1 == d && $2 == i && $3 == "navi21" { print $at[c] }' "$bench/gpu/materialx.tsv"; }
statistics_of() { VK_ICD_FILENAMES=${drivers[0]} RADV_FORCE_FAMILY=navi21 MESA_SHADER_CACHE_DISABLE=true "$gpustat" "$@" >statistics 2>err; } # MODULE...
ours() { sed -n "s/^$1=//p" statistics; } # NAME
declare -A percent=([complete]=29 [reduced]=45) # of MaterialX's inverse throughput
declare -A registers=([complete]=100 [reduced]=80)
for document in standard_surface_default open_pbr_default; do
    for interface in complete reduced; do
        folder=$document.$interface
        check "$folder is generated" exits 0 "$mxgen" "$bench/$document.mtlx" --target vulkan --interface $interface -o "$folder"
        for stage in vert frag; do
            check "the shader of $folder compiles" exits 0 glslangValidator -V "$folder"/*.$stage -o $stage.spv
        done
        statistics_of vert.spv frag.spv
        check "$folder takes few registers" test "$(ours VGPRs)" -le "$(($(theirs $document $interface vgprs) * ${registers[$interface]} / 100))"
        check "$folder has enough waves per SIMD" test "$(ours 'Subgroups per SIMD')" -ge "$(theirs $document $interface subgroups_per_simd)"
        check "$folder has a low inverse throughput" test "$(ours 'Inverse Throughput')" -le "$(($(theirs $document $interface inverse_throughput) * ${percent[$interface]} / 100))"
    done
done

# Four layers in one loop over the lights would need all 256 registers, the slabs of a pixel 176.
{
    echo '<materialx version="1.39">'
    for i in 0 1 2 3; do
        echo "<standard_surface name=\"s$i\" type=\"surfaceshader\"/><substance name=\"m$i\" type=\"material\">"
        echo "<input name=\"surfaceshader\" type=\"surfaceshader\" nodename=\"s$i\"/><input name=\"mask\" type=\"float\" value=\"0.5\"/></substance>"
    done
    echo '<look name="stack">'
    for i in 0 1 2 3; do echo "<materialassign name=\"a$i\" slot=\"00$i\" material=\"m$i\" geom=\"/\"/>"; done
    echo '</look></materialx>'
} >stack.mtlx
printf '#usda 1.0\ndef Mesh "ball"\n{\n}\n' >stage.usda
check 'a stack is generated' exits 0 "$mxgen" stack.mtlx --look stack --stage stage.usda --slots blend --target vulkan --interface complete -o stack
for stage in vert frag; do
    check 'a stack compiles' exits 0 glslangValidator -V stack/*.$stage -o $stage.spv
done
statistics_of vert.spv frag.spv
check 'a stack takes few registers' test "$(ours VGPRs)" -le 184
check 'passes are generated' exits 0 "$mxgen" pipeline passes
check 'a pass compiles' exits 0 glslangValidator -V passes/light_complex.comp -o pass.spv
statistics_of pass.spv
check 'light_complex takes few registers' test "$(ours VGPRs)" -le 160

# One slab costs no more than a dielectric over a diffuse closure that conserves energy, too.
cat >slab.mtlx <<'END'
<materialx version="1.39">
  <slab name="matter" type="BSDF">
    <input name="diffuse_albedo" type="color3" value="0.6, 0.3, 0.1"/>
    <input name="f0" type="color3" value="0.04, 0.04, 0.04"/>
    <input name="roughness" type="float" value="0.5"/>
  </slab>
  <slab_surface name="slab" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="matter"/></slab_surface>
  <dielectric_bsdf name="interface" type="BSDF">
    <input name="ior" type="float" value="1.5"/>
    <input name="roughness" type="vector2" value="0.25, 0.25"/>
  </dielectric_bsdf>
  <oren_nayar_diffuse_bsdf name="diffuse" type="BSDF">
    <input name="color" type="color3" value="0.6, 0.3, 0.1"/>
    <input name="roughness" type="float" value="0.5"/>
    <input name="energy_compensation" type="boolean" value="true"/>
  </oren_nayar_diffuse_bsdf>
  <layer name="both" type="BSDF">
    <input name="top" type="BSDF" nodename="interface"/>
    <input name="base" type="BSDF" nodename="diffuse"/>
  </layer>
  <surface name="layers" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="both"/></surface>
</materialx>
END
for interface in complete reduced; do
    check "a slab and layers are generated: $interface" exits 0 "$mxgen" slab.mtlx --target vulkan --interface $interface -o one
    for shader in slab layers; do
        for stage in vert frag; do
            check "$shader compiles: $interface" exits 0 glslangValidator -V one/$shader.$stage -o $stage.spv
        done
        statistics_of vert.spv frag.spv
        cp statistics $shader.statistics
    done
    for figure in 'Instructions' 'VGPRs' 'Inverse Throughput'; do
        check "a slab costs no more than layers: $interface, $figure" test "$(sed -n "s/^$figure=//p" slab.statistics)" -le "$(sed -n "s/^$figure=//p" layers.statistics)"
    done
done
finish gpu
