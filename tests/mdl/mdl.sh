#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Materials of MDL by NVIDIA's compiler. Arguments: mxgen, interfaces ("complete,reduced"), and documents or folders of documents.
mxgen=$(realpath "$1") interfaces=$2
shift 2
documents=$(find $(realpath "$@") -name "*.mtlx" | LC_ALL=C sort)
. "$(dirname "$0")/../programs/common.sh"

cat >gold.mtlx <<'END'
<materialx version="1.39">
  <standard_surface name="gold" type="surfaceshader"><input name="metalness" type="float" value="1"/></standard_surface>
  <viewdirection name="view" type="vector3"/>
  <output name="seen" type="vector3" nodename="view"/>
  <UsdUVTexture name="height" type="multioutput"/>
  <heighttonormal name="bumps" type="vector3"><input name="in" type="float" nodename="height" output="r"/></heighttonormal>
  <output name="slopes" type="vector3" nodename="bumps"/>
  <constant name="word" type="string"><input name="value" type="string" value="x"/></constant>
  <output name="text" type="string" nodename="word"/>
  <constant name="grey" type="float"><input name="value" type="float" value="0.5"/></constant>
  <output name="glow" type="float" nodename="grey"/>
</materialx>
END
for role in path scatter function deferred depth payload; do
    check "$role is an error" exits 1 "$mxgen" gold.mtlx --target mdl --role "$role" -o none
done
check 'a material knows no view' exits 1 "$mxgen" gold.mtlx --target mdl --element seen -o none
check 'the error says so' grep -q 'gold.mtlx:.*mdl has no viewPosition' err
check 'a material has no derivatives' exits 1 "$mxgen" gold.mtlx --target mdl --element slopes -o none
check 'the error says so' grep -q 'gold.mtlx:.*mdl has no slopes' err
check 'a text is no light' exits 1 "$mxgen" gold.mtlx --target mdl --element text -o none
check 'a value is light' exits 0 "$mxgen" gold.mtlx --target mdl --element glow -o glow
check 'a value is the intensity of an edf' grep -q 'emission: material_emission(emission: surface_emission' glow/glow.mdl

if ! command -v mdlc >/dev/null; then
    skip 'mdlc is not installed: nothing is compiled'
    finish mdl
fi
# unused functions and values, numbers that are infinite, and textures that are not there
mdlc=(mdlc --no-resolve-resources -W err)
for warning in 181 182 183 225 230 350; do
    mdlc+=(-W "$warning=off")
done

# accepts FOLDER: mdlc takes each file of it.
accepts() {
    local file made good=0
    for file in "$1"/*.mdl; do
        [ -e "$file" ] || continue
        made=${file##*/} made=${made%.mdl}
        "${mdlc[@]}" -p "$1" "::$made" >said 2>&1 || { cat said && good=1; }
    done
    return "$good"
}

# compiles DOCUMENT OPTION...: what mxgen writes of it compiles. A document that mxgen refuses has an error with its place.
compiles() {
    local name
    rm -rf made
    "$mxgen" "$@" --target mdl --trust -o made >out 2>err || grep -q '^[^ ]*:[0-9]*:[0-9]*: error: ' err || { cat err && return 1; }
    for name in made/*.mdl; do # the name of a module is an identifier
        [ ! -e "$name" ] || [[ ${name#made/} =~ ^[A-Za-z_0-9]+\.mdl$ ]] || mv "$name" "made/$(basename "$name" .mdl | tr -c 'A-Za-z0-9\n' _).mdl"
    done
    [ ! -d made ] || accepts made
}
for document in $documents; do
    for interface in ${interfaces//,/ }; do
        check "$document, $interface" compiles "$document" --interface "$interface"
    done
done
for version in 1.8 1.9 1.10; do
    check "version $version" compiles gold.mtlx --target-version "$version" --element gold
    check "it is version $version" grep -qx "mdl $version;" made/gold.mdl
done
finish mdl
