#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Pictures that cannot be: hostile images and meshes, values and options that are none. Arguments: mxgen-render, mean_ratio.
. "$(dirname "$0")/pictures.sh"

cp "$here/parts/huge_window.exr" "$here/parts/huge_window.mtlx" .
printf 'PF\n2 1\n-1.0\n' >red.pfm
for i in 1 2; do printf '\000\000\200\077\000\000\000\000\000\000\000\000' >>red.pfm; done

# An option that does not apply is an error: the option, and the option or fact that excludes it.
while IFS='|' read -r option other; do
    # shellcheck disable=SC2086
    check "--$option with $other is wrong usage" exits 2 "$render" $other "--$option"
    check "the error says that --${option%%=*} does not apply" grep -q "option '--${option%%=*}' does not apply: " err
done <<'X'
environment=red.pfm|plain.mtlx -o x.png --scene sphere
mesh=cube|plain.mtlx -o x.png --scene plane
camera=0,0|plain.mtlx --scene grid
turntable=2|plain.mtlx -o x.png --scene sphere
turntable=2|plain.mtlx plain.mtlx -o x.png
path-trace|plain.mtlx -o x.png --scene sphere
path-trace|plain.mtlx -o x.png --turntable 2
scene=grid|plain.mtlx plain.mtlx
output=x.png|plain.mtlx --scene grid
copy=x.png|plain.mtlx --scene grid
copy=y.png|plain.mtlx plain.mtlx -o x.png
copy=y.png|plain.mtlx -o x.png --turntable 2
background=none|plain.mtlx --scene grid
background=none|plain.mtlx -o x.exr
role=path|plain.mtlx -o x.png --path-trace
role=scatter|plain.mtlx -o x.png
role=payload|plain.mtlx -o x.png
paths=2|plain.mtlx -o x.png
bounces=2|plain.mtlx -o x.png
picks=2|plain.mtlx -o x.png
as-drawn|plain.mtlx -o x.png
samples=2|plain.mtlx -o x.png --environment none
samples=2|plain.mtlx -o x.png --environment prefiltered
samples=2|plain.mtlx -o x.png --path-trace
environment=prefiltered|plain.mtlx -o x.png --path-trace
quality=draft|plain.mtlx -o x.png --path-trace
element=M|plain.mtlx -o x.png --look L
layer-sample=0.5|plain.mtlx -o x.png
mesh=cube|--bake-environment sky -o baked
paths=2|--bake-environment sky -o baked
lights=none|--bake-environment sky -o baked
X
check 'a document with --bake-environment is wrong usage' exits 2 "$render" plain.mtlx --bake-environment sky -o baked
for count in '--samples 0' '--samples 65537' '--frame 99999999999' '--paths 0 --path-trace' '--bounces 65 --path-trace' '--picks 0 --path-trace' \
    '--layer-sample 1' '--layer-sample -0.1' '--layer-sample x' '--layer-sample nan' '--turntable 0' '--turntable 10001' '--camera nan,0' '--camera 0,0,inf' '--size nan'; do
    # shellcheck disable=SC2086
    check "a number out of range is wrong usage: $count" exits 2 "$render" plain.mtlx -o x.png $count
done
check 'wrong usage writes nothing' eval '! ls x.png y.png x.exr baked 2>/dev/null | grep -q .'

# Gigabytes that are only promised take no time, but with this variable the allocator writes them.
export MALLOC_PERTURB_=0

# The file promises 65,536 x 4 pixels of 1,000 channels. OpenImageIO throws where it finds no memory for them, which depends on the
# limit; an exception that leaves the reader would abort the program.
python3 - <<'P'
import struct
data = bytearray(open("huge_window.exr", "rb").read())
for name in b"dataWindow\0box2i\0", b"displayWindow\0box2i\0":
    at = data.index(name) + len(name) + 4
    data[at:at + 16] = struct.pack("<4i", 0, 0, 65535, 3)
at = data.index(b"channels\0chlist\0") + len(b"channels\0chlist\0")
size, = struct.unpack_from("<i", data, at)
channels = b"".join(b"c%04d\0" % i + struct.pack("<iB3xii", 2, 0, 1, 1) for i in range(1000)) + b"\0"
data[at:at + 4 + size] = struct.pack("<i", len(channels)) + channels
open("channels.exr", "wb").write(data)
nan, inf = float("nan"), float("inf")
for name, value in ("nan", nan), ("inf", inf):
    open(f"{name}.pfm", "wb").write(b"PF\n2 1\n-1.0\n" + struct.pack("<6f", value, 0, 0, 1, 1, 1))
P
if [ -n "${SANITIZER:-}" ]; then
    skip 'a program with a sanitizer maps terabytes: its memory has no limit'
else
    for kilobytes in $(seq 700000 400000 1900000); do
        check "an image of 1,000 channels is an error in $kilobytes KB of memory" exits 1 bash -c "ulimit -v $kilobytes && '$mean_ratio' channels.exr channels.exr"
    done
fi

if ! has_device "$render"; then
    skip 'there is no Vulkan device'
    finish render-faults
fi

# Meshes that take for ever, or have no size
python3 - <<'P'
import math
for name, count in ("largest", 4096), ("larger", 4097):
    with open(f"{name}.obj", "w", encoding="ascii") as out:
        for i in range(count):
            out.write(f"v {math.cos(2 * math.pi * i / count):.6f} {math.sin(2 * math.pi * i / count):.6f} 0\n")
        out.write("f " + " ".join(str(i + 1) for i in range(count)) + "\n")
P
check 'a face of 4096 corners is drawn' exits 0 "$render" plain.mtlx -m largest.obj -o face.png --size 8
check 'a face of 4097 corners fails' exits 1 "$render" plain.mtlx -m larger.obj -o x.png --size 8
check 'the error gives the limit of corners' grep -q "more than 4096 corners \[bad-mesh\]" err
printf 'v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >nan.obj
check 'a corner that is NaN fails' exits 1 "$render" plain.mtlx -m nan.obj -o x.png --size 8
check 'the error says that a corner is NaN or infinite' grep -q "NaN or infinite \[bad-mesh\]" err

# Images that promise too much, never end, or have no values
check 'a texture of 400,000,000 pixels fails' exits 1 "$render" huge_window.mtlx --set i/file=huge_window.exr -o x.png --size 8
check 'the error gives the limit of pixels of a texture' grep -q "100000000 x 4 pixels; the limit is .*\[missing-texture\]" err
check 'an environment of 400,000,000 pixels fails' exits 1 "$render" plain.mtlx --environment huge_window.exr -o x.png --size 8
check 'the error gives the limit of pixels of an environment' grep -q "100000000 x 4 pixels; the limit is .*\[bad-environment\]" err
mkfifo pipe
for file in /dev/zero pipe; do
    check "an environment that is no file fails: $file" exits 1 timeout 60 "$render" plain.mtlx --environment $file -o x.png --size 8
    check 'the error says that the environment is no file' grep -q "it is not a regular file \[bad-environment\]" err
    check "a texture that is no file fails: $file" exits 1 timeout 60 "$render" huge_window.mtlx --set i/file=$file -o x.png --size 8
    check 'the error says that the texture is no file' grep -q "it is not a regular file.*\[missing-texture\]" err
    check "a mesh that is no file fails: $file" exits 1 timeout 60 "$render" plain.mtlx -m "$(realpath $file)" -o x.png --size 8
    check 'the error says that the mesh is no file' grep -q "it is not a file \[bad-mesh\]" err
done
for value in nan inf 1e99 -nan 0.5,nan; do
    check "a value of $value fails" exits 1 "$render" plain.mtlx -o x.png --set "SR/base=$value"
    check "the error of $value is bad-value" grep -q '\[bad-value\]' err
done
check 'faults of values write nothing' test ! -e x.png
for value in nan inf; do
    check "an environment with $value is drawn" exits 0 "$render" plain.mtlx --environment $value.pfm -o x.exr --size 8
    check "a warning names the environment with $value" grep -q "warning: the environment '$value.pfm' has pixels that are NaN.*\[bad-pixels\]" err
    check "a texture with $value is drawn" exits 0 "$render" huge_window.mtlx --set i/file=$value.pfm -o x.png --size 8
    check "a warning names the texture with $value" grep -q "warning: the texture '$value.pfm' has pixels that are NaN.*\[bad-pixels\]" err
done
cat >hot.mtlx <<'X'
<materialx version="1.39">
  <surface_unlit name="SR" type="surfaceshader">
    <input name="emission" type="float" value="3e38"/>
    <input name="emission_color" type="color3" value="100, 100, 100"/>
  </surface_unlit>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SR"/></surfacematerial>
</materialx>
X
for how in '' '--path-trace --paths 2'; do
    # shellcheck disable=SC2086
    check "a picture of infinite light fails $how" exits 1 "$render" hot.mtlx -o hot.png --size 8 $how
    check 'the error counts the pixels that are NaN or infinite' grep -q "'M': [0-9]* of 64 pixels are NaN or infinite, the first at .*\[bad-pixels\]" err
    check 'the picture is written to show where they are' test -s hot.png
    rm -f hot.png
done
# A picture that would be written over an input, or over another picture
cp red.pfm map.pfm && cp red.pfm t.png && cp plain.mtlx one.mtlx && cp nan.obj mesh.png && cp nan.pfm map.png
echo '<materialx version="1.39" xmlns:xi="http://www.w3.org/2001/XInclude"><xi:include href="part.png"/></materialx>' >including.mtlx
cp plain.mtlx part.png
while IFS='|' read -r file options; do
    cp "$file" before
    # shellcheck disable=SC2086
    check "a picture may not replace an input: $options" exits 1 "$render" $options --size 8
    check "the error is output-clash: $options" grep -q '\[output-clash\]' err
    check "the input is unchanged: $options" cmp "$file" before
done <<'X'
map.png|plain.mtlx --environment map.png -o map.png
map.png|plain.mtlx --environment map.png -o y.png --copy map.png
mesh.png|plain.mtlx -m mesh.png -o mesh.png
t.png|huge_window.mtlx -o t.png
t.png|huge_window.mtlx plain.mtlx -o t.png
map.png|huge_window.mtlx --set i/file=map.png -o ./map.png
part.png|including.mtlx -o part.png
part.png|including.mtlx plain.mtlx -o part.png
plain.mtlx|plain.mtlx -o y.png --copy y.png
X
check 'clashes write no other picture' test ! -e y.png
awk '{ print } /<surfacematerial/ { for (i = 2; i <= 15; i++) { line = $0; sub(/"M"/, "\"M" i "\"", line); print line } }' plain.mtlx >many.mtlx
check 'a document of 15 materials is drawn' exits 0 "$render" many.mtlx -o x.png --size 8
check 'a note names the element that is drawn' grep -q "^note: 'M' is rendered, the first of 15 elements; -e PATH" err
check 'an element that is asked for has no note' eval 'exits 0 "$render" many.mtlx -e M12 -o x.png --size 8 && ! grep -q note: err'

finish render-faults
