#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The drawn picture against the traced one, on a sphere in the light of the sky: means within 3 percent. ../materials/paths.tsv lists the
# exceptions among MaterialX's examples, with what their ratio is and why. Arguments: mxgen-render, mean_ratio, the folder shared/materials.
render=$(realpath "$1") mean_ratio=$(realpath "$2") materials=$(realpath -m "$3")
here=$(cd "$(dirname "$0")" && pwd)
table=$here/../materials/paths.tsv
. "$here/common.sh"
export MESA_SHADER_CACHE_DISABLE=true

# near RATIO EXPECTED
near() { awk -v a="$1" -v b="$2" 'BEGIN { print a; exit !(a > b - 0.03 && a < b + 0.03) }'; }

# compare NAME EXPECTED DOCUMENT [ARGUMENT...]
compare() {
    local name=$1 expected=$2
    shift 2
    rm -f drawn.exr traced.exr
    check "$name is drawn" exits 0 "$render" "$@" -q -m sphere --lights none --size 32 --samples 256 -o drawn.exr
    check "$name is traced" exits 0 "$render" "$@" -q -m sphere --path-trace --paths 64 --size 32 -o traced.exr
    check "$name agrees" near "$("$mean_ratio" drawn.exr traced.exr)" "$expected"
}

# leaf NAME EXPECTED NODES: a surface of the BSDF "bsdf".
leaf() {
    cat >"$1.mtlx" <<XML
<?xml version="1.0"?>
<materialx version="1.39">
  $3
  <surface name="S" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="bsdf"/></surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>
XML
    compare "$1" "$2" "$1.mtlx"
}

leaf diffuse 1 '<oren_nayar_diffuse_bsdf name="bsdf" type="BSDF"><input name="color" type="color3" value="0.8, 0.5, 0.2"/></oren_nayar_diffuse_bsdf>'
if grep -q no-device err; then
    skip 'there is no Vulkan device'
    passed=0 failed=0
    finish paths
fi
leaf mirror 1 '<conductor_bsdf name="bsdf" type="BSDF"><input name="roughness" type="vector2" value="0.0004, 0.0004"/></conductor_bsdf>'
leaf layered 1 '<dielectric_bsdf name="coat" type="BSDF"/><burley_diffuse_bsdf name="base" type="BSDF"/>
  <layer name="bsdf" type="BSDF"><input name="top" type="BSDF" nodename="coat"/><input name="base" type="BSDF" nodename="base"/></layer>'
leaf mixed 1 '<conductor_bsdf name="metal" type="BSDF"/><oren_nayar_diffuse_bsdf name="base" type="BSDF"/>
  <mix name="bsdf" type="BSDF"><input name="fg" type="BSDF" nodename="metal"/><input name="bg" type="BSDF" nodename="base"/>
    <input name="mix" type="float" value="0.25"/></mix>'

# A surface that is not there, and one that glows.
cat >clear.mtlx <<'XML'
<?xml version="1.0"?>
<materialx version="1.39">
  <uniform_edf name="edf" type="EDF"><input name="color" type="color3" value="3, 2, 1"/></uniform_edf>
  <surface name="S" type="surfaceshader"><input name="edf" type="EDF" nodename="edf"/><input name="opacity" type="float" value="1"/></surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>
XML
compare glow 1 clear.mtlx
sed -i 's/"opacity" type="float" value="1"/"opacity" type="float" value="0"/' clear.mtlx
check 'what is clear is traced' exits 0 "$render" clear.mtlx -m sphere --path-trace --paths 4 --size 8 -o clear.ppm --background none
check 'and not there' test "$(tail -c 192 clear.ppm | od -An -tu1 -v | tr -d ' 0\n')" = ''
check 'no paths' exits 2 "$render" clear.mtlx --path-trace --paths 0 -o x.png
check 'no turntable of paths' exits 2 "$render" clear.mtlx --path-trace --turntable 2 -o x.png

examples=$materials/resources/Materials/Examples
[ -d "$examples" ] || { skip "there is no folder $examples"; finish paths; }
declare -A expected
while IFS=$'\t' read -r document ratio _; do
    expected[$document]=$ratio
done < <(sed 1d "$table")
for document in "$examples"/*/*.mtlx; do
    name=${document#"$examples"/}
    case $name in *chess_set* | *look*) continue ;; esac
    compare "$name" "${expected[$name]:-1}" "$document"
done

finish paths
