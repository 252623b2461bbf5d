#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A look with a variant: commands that cannot keep it say so, each in its own message. Arguments: the program.
mxgen=$(realpath "$1")
. "$(dirname "$(realpath "$0")")/common.sh"
render=$(dirname "$mxgen")/mxgen-render

cat >show.mtlx <<'X'
<materialx version="1.39">
  <standard_surface name="S" type="surfaceshader"><input name="base_color" type="color3" value="1, 0, 0"/></standard_surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
  <variantset name="colours"><variant name="green"><input name="base_color" type="color3" value="0, 1, 0"/></variant></variantset>
  <look name="plain"><materialassign name="a" material="M" geom="/a"/></look>
  <look name="base"><materialassign name="b" material="M" geom="/a"/><variantassign name="v" variantset="colours" variant="green"/></look>
  <look name="heir" inherit="base"/>
</materialx>
X
printf '/a\n' >stage.txt
cat >stage.usda <<'X'
#usda 1.0
def Cube "a" {}
X
tells() { # ID COMMAND…: the command works and has this warning
    local id=$1
    shift
    exits 0 "$@" && grep -qF "[$id]" err
}
silent() { exits 0 "$@" && ! grep -q 'warning' err; }
for look in base heir; do
    check "bind --usda tells the variants of the look $look" tells usda-loss "$mxgen" bind show.mtlx --look $look --stage stage.txt --usda out.usda
    check 'and the layer names what is left out' grep -q '^# left out: .*: its variants' out.usda
done
check 'a look without them has nothing to tell' eval 'exits 0 "$mxgen" bind show.mtlx --look plain --stage stage.txt --usda plain.usda && ! grep -q variants plain.usda'
check 'a translation tells them' tells translation-look "$mxgen" translate show.mtlx --to gltf_pbr -o translated.mtlx
check 'the same model has nothing to tell' silent "$mxgen" translate show.mtlx --to standard_surface -o translated.mtlx
if [ -x "$render" ]; then
    for look in base heir; do
        check "an export tells the variants of the look $look" tells export-loss "$mxgen" export show.mtlx --stage stage.usda --look $look -o out.gltf
        check "a picture of materials tells those of the look $look" tells look-part "$mxgen" render show.mtlx --look $look -s 8 -o picture.ppm
    done
    check 'an export of a look without them has nothing to tell' eval 'exits 0 "$mxgen" export show.mtlx --stage stage.usda --look plain -o plain.gltf && ! grep -q export-loss err'
    check 'nor has a picture' silent "$mxgen" render show.mtlx --look plain -s 8 -o picture.ppm
else
    skip 'mxgen-render is not built'
fi
finish look-parts
