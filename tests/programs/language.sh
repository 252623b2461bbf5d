#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Functions of the portable language compile in every target. Arguments: mxgen-compile, the documents.
compile=$(realpath "$1")
shift
mapfile -t documents < <(realpath "$@")
. "$(dirname "$0")/common.sh"
outputs=$(cat "${documents[@]}" | grep -c '<output name="[a-z_]*".*nodename=')
for target in glsl essl essl310 vulkan hlsl osl; do
    if [ "$target" = osl ] && ! command -v oslc >/dev/null; then
        skip 'without oslc no OSL is compiled'
        continue
    fi
    check "the functions compile for $target" exits 0 "$compile" "${documents[@]}" --targets "$target"
    check "each output compiles with three interfaces for $target" test "$(grep -c "	$target	" out)" -eq $((3 * outputs))
done
finish language-compile
