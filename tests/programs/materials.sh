#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Real documents: every material of MaterialX's Standard Surface examples compiles for all targets and interface modes, and can be drawn.
# Arguments: mxgen-compile, mxgen-render ('' to draw nothing), the folder shared/materials.
compile=$(realpath "$1") render=${2:+$(realpath "$2")} materials=$3
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"
export MESA_SHADER_CACHE_DISABLE=true

folder=$materials/resources/Materials/Examples/StandardSurface
if [ ! -d "$folder" ]; then
    skip "there is no folder $folder"
    finish materials
fi
for document in "$folder"/*.mtlx; do
    name=$(basename "$document" .mtlx)
    missing=$(sed -n 's/.*<xi:include href="\([^"]*\)".*/\1/p' "$document" | while read -r file; do
        [ -e "$folder/$file" ] || echo "$file"
    done)
    if [ -n "$missing" ]; then
        skip "$name includes $missing, which is not there"
        check "$name says so" eval 'exits 1 "$compile" "$document" && grep -q "\[include-missing\]" err'
        continue
    fi
    check "$name compiles" exits 0 "$compile" "$document"
    check "$name gives no warning" test ! -s err
    for element in $(cut -f 2 out | sort -u); do
        [ -z "$render" ] || check "$name $element is drawn" exits 0 "$render" "$document" -e "$element" -o ball.png --size 16
    done
done

finish materials
