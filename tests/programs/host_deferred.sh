#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# host_deferred.sh HOST EXAMPLES: examples/host_deferred draws materials of all examples, with shadows of its own, a decal and views.
host=$(realpath "$1") examples=$(realpath "$2")
. "$(dirname "$0")/common.sh"
files=$(ls "$examples"/*.mtlx)

# region PICTURE X0 Y0 X1 Y1: the mean of red, green and blue, of 255, in a part of the picture (0 to 1).
region() {
    python3 - "$@" <<'END'
import sys
data, (x0, y0, x1, y1) = open(sys.argv[1], "rb").read(), map(float, sys.argv[2:])
head, _, pixels = data.partition(b" 255\n")
width, height = map(int, head.split()[1:])
part = [pixels[3 * (y * width + x):][:3] for y in range(int(y0 * height), int(y1 * height)) for x in range(int(x0 * width), int(x1 * width))]
print(*(round(sum(pixel[c] for pixel in part) / len(part), 1) for c in range(3)))
END
}
# is CONDITION PICTURE X0 Y0 X1 Y1: a condition of r, g and b.
is() {
    local condition=$1 r g b
    shift
    read -r r g b <<<"$(region "$@")"
    awk -v r="$r" -v g="$g" -v b="$b" "BEGIN { exit !($condition) }"
}

# shellcheck disable=SC2086 # each file is an argument
"$host" all.ppm "$examples/host_deferred" $files >out 2>err
code=$?
if grep -q 'failed: .*GPU\|failed: vkCreate' err; then
    echo "skip: no Vulkan device with the features that images of words need"
    exit 77
fi
check 'the examples are drawn' [ "$code" = 0 ]
check 'no shader, pass or document has a fault' eval '! [ -s err ]'
check 'forty materials are stored' eval '[ "$(sed -n "s/^240 balls of \([0-9]*\) materials.*/\1/p" out)" -ge 40 ]'
check 'what is drawn forward is told' grep -qx 'MilkySheet lights itself' out
check 'nothing is above the ground' is 'r + g + b == 0' all.ppm 0 0 1 0.2
check 'the balls are lit' is 'r > 30 && g > 30 && b > 30' all.ppm 0.1 0.4 0.9 0.8

draw() { exits 0 "$host" "$@" "$examples/deferred.mtlx"; }
check 'a picture without decal is drawn' draw --no-decal plain.ppm "$examples/host_deferred"
check 'a picture with a decal is drawn' draw painted.ppm "$examples/host_deferred"
check 'the decal is red' is 'r > 2 * g && r > 2 * b' painted.ppm 0.41 0.66 0.43 0.7
check 'without it nothing there is red' is 'r < 2 * g' plain.ppm 0.41 0.66 0.43 0.7
check 'it leaves what is beside it' eval '[ "$(region painted.ppm 0.7 0.4 1 1)" = "$(region plain.ppm 0.7 0.4 1 1)" ]'

mkdir bright
sed 's/return true;/return false;/' "$examples/host_deferred/lights.glsl" >bright/lights.glsl
check 'a picture without shadows is drawn' draw --no-decal bright.ppm bright
check 'shadows of the host hide light' eval 'is "r < 0.9 * $(region bright.ppm 0 0.85 1 0.9 | cut -d" " -f1)" plain.ppm 0 0.85 1 0.9'

check 'the view of classes is drawn' draw --no-decal --show classes classes.ppm "$examples/host_deferred"
check 'it has the four colours of classes' python3 - <<'END'
pixels = open("classes.ppm", "rb").read().partition(b" 255\n")[2]
colors = {pixels[i:i + 3] for i in range(0, len(pixels), 3)}
assert 4 <= len(colors) <= 5, len(colors)
END
check 'a view that does not exist is an error' exits 1 "$host" --show nothing none.ppm "$examples/host_deferred" "$examples/deferred.mtlx"
check 'no file is wrong usage' exits 2 "$host" none.ppm "$examples/host_deferred"
check 'the host has less than 900 lines of C' eval '[ "$(cat "$examples"/host_deferred/*.[ch] | wc -l)" -lt 900 ]'

finish host-deferred
