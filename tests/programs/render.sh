#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Pictures, and that uniforms drive them. Argument: mxgen-render.
render=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"

# The driver's cache would be written to the home folder.
export MESA_SHADER_CACHE_DISABLE=true

cat >plain.mtlx <<'X'
<?xml version="1.0"?>
<materialx version="1.39">
  <standard_surface name="SR" type="surfaceshader">
    <input name="base_color" type="color3" value="0.8, 0.8, 0.8"/>
  </standard_surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SR"/></surfacematerial>
</materialx>
X
cat >textured.mtlx <<'X'
<?xml version="1.0"?>
<materialx version="1.39">
  <nodegraph name="NG">
    <image name="image" type="color3"><input name="file" type="filename" value="none.png"/></image>
    <output name="out" type="color3" nodename="image"/>
  </nodegraph>
</materialx>
X

if ! "$render" plain.mtlx --scene grid >out 2>err && grep -q no-device err; then
    skip 'there is no Vulkan device'
    finish render
fi

# sum CHANNEL [ARGUMENT...]: of the 4x4 grid, in thousandths
sum() {
    local channel=$1
    shift
    "$render" plain.mtlx --scene grid "$@" |
        awk -F, -v c="$channel" '{ for (i = 1 + c; i <= NF; i += 3) s += $i } END { printf "%d\n", s * 1000 }'
}

check 'red is red' test "$(sum 1 --set SR/base_color=0.8,0,0)" -gt "$((3 * $(sum 2 --set SR/base_color=0.8,0,0) / 2))"
check 'green is green' test "$(sum 2 --set SR/base_color=0,0.8,0)" -gt "$((3 * $(sum 1 --set SR/base_color=0,0.8,0) / 2))"
check 'emission adds' test "$(sum 1 --set SR/emission=1)" -gt "$(($(sum 1) + 15000))"
check 'a reduced shader has no uniforms' exits 1 "$render" plain.mtlx --scene grid --interface reduced --set SR/base_color=1,0,0
check 'a picture' exits 0 "$render" plain.mtlx -o ball.png --size 48x32
check 'is a PNG of that size' test "$(od -An -tx1 -j16 -N8 ball.png | tr -d ' ')" = 0000003000000020
check 'the same bytes again' eval '"$render" plain.mtlx -o again.png --size 48x32 && cmp ball.png again.png'
check 'a missing texture' exits 1 "$render" textured.mtlx -o none.png
check 'names the file' grep -q "none.png.*\[render-failed\]" err
check 'leaves no picture' test ! -e none.png
check 'a folder that is missing' exits 1 "$render" plain.mtlx -o missing/ball.png --size 8
check 'is output-failed' grep -q '\[output-failed\]' err
check 'a value that is none' exits 1 "$render" plain.mtlx -o x.png --set SR/base_color=abc
check 'a size that is none' exits 2 "$render" plain.mtlx -o x.png --size 0
check 'no driver' eval 'VK_DRIVER_FILES=/none VK_ICD_FILENAMES=/none exits 1 "$render" plain.mtlx -o x.png && grep -q mesa-vulkan-drivers err'

finish render
