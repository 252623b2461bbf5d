#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The examples in WebGPU draw a lit ball, forward and deferred. Arguments: mxgen, the folder examples, and tests/golden/precision.mtlx. MXGEN_DAWN and MXGEN_SWIFTSHADER: see draw.mjs.
mxgen=$(realpath "$1") examples=$(realpath "$2") coloured=$(realpath "$3")
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

# like A B: two pictures differ by the rounding of what is stored alone, 45 dB.
like() {
    python3 -c 'import math, sys
a, b = (open(path, "rb").read()[15:] for path in sys.argv[1:])
error = sum((x - y) ** 2 for x, y in zip(a, b)) / len(a)
sys.exit(not 10 * math.log10(255 ** 2 / error) > 45)' "$1" "$2"
}
# SwiftShader has no half floats. Where their types are names of whole ones, the picture is that without them: all conversions are right.
for precision in highp mediump; do
    check "precision $precision is written" exits 0 "$mxgen" "$coloured" --target wgsl --precision "$precision" --reflect -q -o "$precision"
    sed -i 's/^enable f16;$/alias f16 = f32; alias vec2h = vec2f; alias vec3h = vec3f; alias vec4h = vec4f;/' "$precision"/*.wgsl
    check "precision $precision is drawn" exits 0 node "$examples/webgpu.mjs" "$precision/Coloured" "$precision.ppm"
done
check 'half floats are asked for' grep -q '^alias f16' mediump/Coloured.frag.wgsl
check 'there is a picture' test "$(tr -d '\\0' <highp.ppm | wc -c)" -gt 20000
check 'the pictures are equal' cmp highp.ppm mediump.ppm
# Plain takes the targets alone; Lacquered writes the image, also from its hidden back, and has two closures.
check 'materials are stored' exits 0 "$mxgen" "$examples/deferred.mtlx" -e Plain -e Lacquered --role deferred --target wgsl --reflect -q -o stored
check 'they are lit' exits 0 "$mxgen" pipeline passes --target wgsl
for name in Plain Lacquered; do
    check "$name is written" exits 0 "$mxgen" "$examples/deferred.mtlx" -e "$name" --target wgsl --reflect -q -o forward
    check "$name is drawn forward" exits 0 node "$examples/webgpu.mjs" "forward/$name" "$name.ppm"
    check "$name is drawn deferred" exits 0 node "$examples/webgpu_deferred.mjs" "stored/$name" passes "$name.deferred.ppm"
    check "$name looks alike" like "$name.ppm" "$name.deferred.ppm"
done
finish wgsl-ball
