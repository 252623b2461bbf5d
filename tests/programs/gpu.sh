#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Shaders need no more registers on a GPU than MaterialX's, reduced ones fewer, and at least as many waves run at once: what Mesa's compiler tells of an AMD GPU
# that need not be there. Arguments: mxgen, bench-gpustat, the folder bench.
mxgen=$(realpath "$1") gpustat=$(realpath "$2") bench=$(realpath "$3")
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"
drivers=(/usr/share/vulkan/icd.d/radeon_icd.*.json)
[ -e "${drivers[0]}" ] || { skip 'no RADV (the package mesa-vulkan-drivers)'; finish gpu; }
command -v glslangValidator >/dev/null || { skip 'no glslangValidator'; finish gpu; }

theirs() { awk -F'\t' -v d="$1" -v i="$2" -v c="$3" 'NR == 1 { for (k = 1; k <= NF; k++) at[$k] = k } $1 == d && $2 == i && $3 == "navi21" { print $at[c] }' "$bench/gpu/materialx.tsv"; }
ours() { sed -n "s/^$1=//p" statistics; } # NAME
declare -A percent=([complete]=27 [reduced]=45) # of MaterialX's inverse throughput
declare -A registers=([complete]=100 [reduced]=80)
for document in standard_surface_default open_pbr_default; do
    for interface in complete reduced; do
        folder=$document.$interface
        check "$folder is generated" exits 0 "$mxgen" "$bench/$document.mtlx" --target vulkan --interface $interface -o "$folder"
        for stage in vert frag; do
            check "$folder compiles" exits 0 glslangValidator -V "$folder"/*.$stage -o $stage.spv
        done
        VK_ICD_FILENAMES=${drivers[0]} RADV_FORCE_FAMILY=navi21 MESA_SHADER_CACHE_DISABLE=true "$gpustat" vert.spv frag.spv >statistics 2>err
        check "$folder: registers" test "$(ours VGPRs)" -le "$(($(theirs $document $interface vgprs) * ${registers[$interface]} / 100))"
        check "$folder: waves per SIMD" test "$(ours 'Subgroups per SIMD')" -ge "$(theirs $document $interface subgroups_per_simd)"
        check "$folder: inverse throughput" test "$(ours 'Inverse Throughput')" -le "$(($(theirs $document $interface inverse_throughput) * ${percent[$interface]} / 100))"
    done
done
finish gpu
