#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# examples/host_vulkan: a thousand variants of a material share a program; changes of values, connections and the file reach the picture.
# Argument: the program.
host=$(realpath "$1")
. "$(dirname "$0")/common.sh"

# document COLOR: 1,000 materials, whose colours turn from red to green; the first one has this colour.
document() {
    echo '<?xml version="1.0"?><materialx version="1.39">'
    awk -v first="$1" 'BEGIN { for (i = 0; i < 1000; i++)
        printf "<standard_surface name=\"S%d\" type=\"surfaceshader\"><input name=\"specular\" type=\"float\" value=\"0\"/>" \
               "<input name=\"base_color\" type=\"color3\" value=\"%s\"/></standard_surface>\n" \
               "<surfacematerial name=\"M%d\" type=\"material\"><input name=\"surfaceshader\" type=\"surfaceshader\" nodename=\"S%d\"/>" \
               "</surfacematerial>\n", i, i ? (1 - i / 1000) ", " (i / 1000) ", 0" : first, i, i }'
    echo '<constant name="Blue" type="color3"><input name="value" type="color3" value="0, 0, 1"/></constant></materialx>'
}

# pixel PICTURE BALL: red, green and blue in the middle of a ball; a row has 32 balls of 20 pixels.
pixel() {
    local x=$((10 + 20 * ($2 % 32))) y=$((10 + 20 * ($2 / 32)))
    od -An -tu1 -j $((15 + 3 * (640 * y + x))) -N 3 "$1"
}
# dominates CHANNEL PICTURE BALL: red 0, green 1 or blue 2 is the only colour of the ball.
dominates() { pixel "$2" "$3" | awk -v c="$1" '{ for (i = 1; i < 4; i++) if (i == c + 1 ? $i < 60 : $i > 20) exit 1 }'; }

document '1, 0, 0' >many.mtlx
document '0, 1, 0' >other.mtlx
cat >commands <<'END'
draw first.ppm
set S0 base_color 0 0 1
draw value.ppm
set S0 nothing 1
set S0 base_color 1
connect S1 base_color Blue
draw connected.ppm
set S1 base_color 1 0 0
connect S1 base_color S1
END
mkfifo in
"$host" many.mtlx <in >out 2>err &
exec 3>in
cat commands >&3
until [ -s connected.ppm ] || ! kill -0 $! 2>/dev/null; do sleep 0.1; done
sleep 0.1
echo '<materialx version="1.39"><broken>' >many.mtlx
printf 'reload\ndraw broken.ppm\n' >&3
until [ -s broken.ppm ] || ! kill -0 $! 2>/dev/null; do sleep 0.1; done
cp other.mtlx many.mtlx
printf 'reload\ndraw reloaded.ppm\n' >&3
exec 3>&-
check 'the host ends without an error' wait $!
if grep -q 'failed: .*GPU\|failed: vkCreateInstance' err; then
    echo "skip: no Vulkan device"
    exit 77
fi
check 'a thousand variants share a program' grep -qx '0 unchanged, 0 with other values, 1000 with other shaders, 1 programs' out
check 'the first ball is red' dominates 0 first.ppm 0
check 'the last ball is green' dominates 1 first.ppm 999
check 'a new value needs no program' grep -qx 'a uniform' out
check 'the new value shows in its ball' dominates 2 value.ppm 0
check 'the new value shows in no other ball' dominates 0 value.ppm 1
check 'the host reports a misspelt input' grep -qx 'there is no S0/nothing' err
check 'the host reports a value of another type' grep -q "component" err
check 'a connection changes one program' grep -qx '998 unchanged, 1 with other values, 1 with other shaders, 2 programs' out
check 'the connection shows in its ball' dominates 2 connected.ppm 1
check 'a connected input takes no value' grep -qx 'S1/base_color is connected' err
check 'the host reports a faulty connection' grep -q "S1" err
check 'the host reports a broken file' grep -q 'many.mtlx:.*xml-truncated' err
check 'a broken file keeps the old document' cmp connected.ppm broken.ppm
check 'a mended file shows' dominates 1 reloaded.ppm 0
check 'a mended file has its own connections' dominates 0 reloaded.ppm 1
finish host-vulkan
