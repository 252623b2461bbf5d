#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Frame times on a device. Arguments: bench-device, and the folder of examples.
bench=$(realpath "$1") examples=$(realpath "$2")
. "$(dirname "$0")/common.sh"
export MESA_SHADER_CACHE_DISABLE=true

"$bench" complete "$examples/gold.mtlx" >first
grep -q "^skip: no Vulkan" first && { skip "$(cat first)"; finish bench-device; }
check 'a device, or why there is none' grep -qE '^\| gold\.mtlx \| [0-9.]+ \| 1\.00 \|$|^skip: the only Vulkan device is a processor, .*--any' first
check 'any device' exits 0 "$bench" --any --small reduced "$examples/gold.mtlx" "$examples/marble.mtlx"
check 'a line for each' test "$(grep -cE '^\| [a-z]+\.mtlx \| [0-9.]+ \| [0-9.]+ \|$' out)" -eq 2
check 'an interface that is none' exits 1 "$bench" --any --small other "$examples/gold.mtlx"
finish bench-device
