#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The example in WebGPU draws a lit ball. Arguments: mxgen, the folder examples. MXGEN_DAWN and MXGEN_SWIFTSHADER: see draw.mjs.
mxgen=$(realpath "$1") examples=$(realpath "$2")
. "$(dirname "$0")/../programs/common.sh"
export VK_ICD_FILENAMES=${MXGEN_SWIFTSHADER:-/usr/lib/chromium/vk_swiftshader_icd.json}
if [ ! -f "${MXGEN_DAWN:-}" ] || [ ! -f "$VK_ICD_FILENAMES" ] || ! command -v node >/dev/null; then
    skip 'without Node, Dawn and SwiftShader nothing is drawn'
    finish wgsl-ball
fi

# pixel X Y: "R G B" of ball.ppm, 256 pixels wide.
pixel() { tail -c $((3 * 256 * 256)) ball.ppm | od -An -tu1 -j $((3 * (256 * $2 + $1))) -N 3; }
# brighter A B: the red of the first pixel is above that of the second.
brighter() { awk -v a="$1" -v b="$2" 'BEGIN { split(a, p); split(b, q); exit !(p[1] > q[1] + 20) }'; }

check 'the material is written' exits 0 "$mxgen" "$examples/gold.mtlx" --target wgsl --reflect -q -o ball.d
check 'the ball is drawn' exits 0 node "$examples/webgpu.mjs" ball.d/Gold ball.ppm
check 'it has 256 pixels on a side' test "$(head -c 15 ball.ppm | tr -d '\n')" = 'P6 256 256 255'
check 'the ball has a colour' brighter "$(pixel 128 128)" '0 0 0'
check 'the corner has none' test "$(pixel 2 2 | tr -d ' ')" = 000
check 'light comes from the upper right' brighter "$(pixel 170 80)" "$(pixel 86 176)"
finish wgsl-ball
