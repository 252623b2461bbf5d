#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Pictures, and the effect of uniforms on them. Arguments: mxgen-render, mean_ratio, the module lost_device.
lost_device=$(realpath "$3")
. "$(dirname "$0")/pictures.sh"

cat >textured.mtlx <<'X'
<?xml version="1.0"?>
<materialx version="1.39">
  <nodegraph name="NG">
    <image name="image" type="color3"><input name="file" type="filename" value="none.png"/></image>
    <output name="out" type="color3" nodename="image"/>
  </nodegraph>
</materialx>
X

# Tiles of one texel each: red, green, blue; 1011 is missing. The coordinates of the grid are doubled.
tile() { printf 'P3 1 1 255 %s\n' "$2" >"$1"; }
tile t.1001.0030.ppm '255 0 0'
tile t.1002.0030.ppm '0 255 0'
tile t.1012.0030.ppm '0 0 255'
tile t.1001.0040.ppm '255 255 255'
tile t.1002.0040.ppm '255 255 255'
tile t.1012.0040.ppm '255 255 255'
cat >tiles.mtlx <<'X'
<?xml version="1.0"?>
<materialx version="1.39">
  <nodegraph name="NG">
    <texcoord name="uv" type="vector2"/>
    <multiply name="uv2" type="vector2">
      <input name="in1" type="vector2" nodename="uv"/><input name="in2" type="float" value="2"/>
    </multiply>
    <image name="image" type="color3">
      <input name="file" type="filename" value="t.&lt;UDIM&gt;.{04frame}.ppm"/>
      <input name="default" type="color3" value="0.4, 0.4, 0.4"/>
      <input name="texcoord" type="vector2" nodename="uv2"/>
      <input name="framerange" type="string" value="30-40"/>
      <input name="frameoffset" type="integer" value="-3"/>
      <input name="frameendaction" type="string" value="constant"/>
    </image>
    <output name="out" type="color3" nodename="image"/>
  </nodegraph>
</materialx>
X

# The mean of the square of x over a kernel is x squared and its variance, which is size squared by 12 for the box, by 36 for the other.
cat >blur.mtlx <<'X'
<?xml version="1.0"?>
<materialx version="1.39">
  <nodegraph name="NG">
    <texcoord name="uv" type="vector2"/>
    <multiply name="square" type="vector2">
      <input name="in1" type="vector2" nodename="uv"/><input name="in2" type="vector2" nodename="uv"/>
    </multiply>
    <blur name="box" type="vector2">
      <input name="in" type="vector2" nodename="square"/><input name="size" type="float" value="0.6"/>
    </blur>
    <blur name="gaussian" type="vector2">
      <input name="in" type="vector2" nodename="square"/><input name="size" type="float" value="0.6"/>
      <input name="filtertype" type="string" value="gaussian"/>
    </blur>
    <subtract name="by_box" type="vector2">
      <input name="in1" type="vector2" nodename="box"/><input name="in2" type="vector2" nodename="square"/>
    </subtract>
    <subtract name="by_gaussian" type="vector2">
      <input name="in1" type="vector2" nodename="gaussian"/><input name="in2" type="vector2" nodename="square"/>
    </subtract>
    <output name="o_box" type="vector2" nodename="by_box"/>
    <output name="o_gaussian" type="vector2" nodename="by_gaussian"/>
  </nodegraph>
</materialx>
X
# all_near ELEMENT VALUE: every value of an element is near this one.
all_near() {
    "$render" blur.mtlx --scene grid --element "$1" |
        awk -F, -v v="$2" '{ n = NF } { for (i = 2; i <= NF; i++) if ($i < v - 1e-6 || $i > v + 1e-6) exit 1 } END { exit n < 33 }'
}

if ! has_device "$render"; then
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

check 'a red base is red' test "$(sum 1 --set SR/base_color=0.8,0,0)" -gt "$((3 * $(sum 2 --set SR/base_color=0.8,0,0) / 2))"
check 'a green base is green' test "$(sum 2 --set SR/base_color=0,0.8,0)" -gt "$((3 * $(sum 1 --set SR/base_color=0,0.8,0) / 2))"
check 'emission adds light' test "$(sum 1 --set SR/emission=1)" -gt "$(($(sum 1) + 15000))"
check 'a reduced shader has no uniforms' exits 1 "$render" plain.mtlx --scene grid --interface reduced --set SR/base_color=1,0,0
check 'a picture is drawn' exits 0 "$render" plain.mtlx -o ball.png --size 48x32
check 'the picture is a PNG of the size that was asked for' test "$(od -An -tx1 -j16 -N8 ball.png | tr -d ' ')" = 0000003000000020
check 'a second picture has the same bytes' eval '"$render" plain.mtlx -o again.png --size 48x32 && cmp ball.png again.png'
check 'a missing texture fails the run' exits 1 "$render" textured.mtlx -o lost.png
check 'the error names the missing file' grep -q "none.png.*\[missing-texture\]" err
check 'the error has a place and names the option for checkers' eval 'grep -Eq "^textured.mtlx:[0-9]+:[0-9]+: warning: .*none.png" err && grep -q -- "--missing-texture checker" err'
cat >several.mtlx <<'X'
<materialx version="1.39">
  <image name="x" type="color3"><input name="file" type="filename" value="gone.png"/></image>
  <image name="y" type="color3"><input name="file" type="filename" value="gone.png"/></image>
  <image name="z" type="color3"><input name="file" type="filename" value="away.png"/></image>
  <image name="other" type="color3"><input name="file" type="filename" value="unread.png"/></image>
  <standard_surface name="SR" type="surfaceshader">
    <input name="base_color" type="color3" nodename="x"/>
    <input name="specular_color" type="color3" nodename="y"/>
    <input name="coat_color" type="color3" nodename="z"/>
    <input name="coat" type="float" value="0.5"/>
  </standard_surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SR"/></surfacematerial>
  <output name="o" type="color3" nodename="other"/>
</materialx>
X
echo 'no picture' >broken.png
check 'several missing textures fail the run' exits 1 "$render" several.mtlx -e M -o lost.png
check 'each missing file is named once' eval 'test "$(grep -c "there is no file" err)" -eq 2 && test "$(grep -c "gone.png. \[" err)" -eq 1'
check 'the last line counts the files and names the option for checkers' eval "tail -n 1 err | grep -q \"M: 2 texture files cannot be read; '--missing-texture checker' draws checkers in their place\""
check 'missing files of other materials are not named' eval '! grep -q unread.png err'
check "a broken file of the user fails the run" exits 1 "$render" several.mtlx -e M -o lost.png --set z/file=broken.png
check "the error names the input of the user's file" grep -q "error: cannot read 'broken.png' for 'z/file': .*\[missing-texture\]" err
check 'the file that the user replaces is not named' eval '! grep -q "lost.png. \[" err && grep -q "gone.png. \[" err'
check 'broken files in place of all textures fail the run' exits 1 "$render" several.mtlx -e M -o lost.png --set x/file=broken.png --set y/file=broken.png --set z/file=broken.png
check "the errors name the user's files only" eval 'test "$(grep -c "cannot read .broken.png" err)" -eq 3 && grep -q "3 texture files" err && ! grep -q "there is no file" err'
check 'checkers stand for all missing textures' exits 0 "$render" several.mtlx -e M -o lost.png --size 8 --missing-texture checker --set z/file=broken.png
check 'missing textures are warnings then' eval 'test "$(grep -c "warning: " err)" -eq 2 && ! grep -q "error: " err'
check '--quiet drops these warnings' eval 'exits 0 "$render" several.mtlx -e M -o lost.png --size 8 --missing-texture checker --quiet && test ! -s err'
rm -f lost.png

# The files of an include are beside it, whoever includes it.
mkdir -p parts/maps moved
"$render" plain.mtlx -m plane -o parts/maps/red.png --size 8 -q
cat >including.mtlx <<'X'
<materialx version="1.39" fileprefix="maps/" xmlns:xi="http://www.w3.org/2001/XInclude">
  <xi:include href="parts/part.mtlx"/>
  <standard_surface name="SR" type="surfaceshader"><input name="base_color" type="color3" nodegraph="NG"/></standard_surface>
</materialx>
X
cat >parts/part.mtlx <<'X'
<materialx version="1.39">
  <nodegraph name="NG">
    <image name="image" type="color3"><input name="file" type="filename" value="red.png"/></image>
    <output name="out" type="color3" nodename="image"/>
  </nodegraph>
</materialx>
X
check 'the texture of an include is beside it' exits 0 "$render" including.mtlx -m plane -o included.png --size 16
check 'a misspelt input fails the run' exits 1 "$render" plain.mtlx --set SR/base_colr=1,0,0 -o lost.png
check 'a misspelt input has a suggestion' grep -q "did you mean 'SR/base_color'" err
check 'a run that fails leaves no picture' test ! -e lost.png
quarter='1,0,0,1,0,0,0,1,0,0,1,0'
half="$quarter,$quarter"
missing='0.400000006,0.400000006,0.400000006,0.400000006,0.400000006,0.400000006,0,0,1,0,0,1'
check 'tiles by <UDIM> are read, and the default stands for a missing one' \
    test "$("$render" tiles.mtlx --scene grid)" = "NG/out,$half,$missing,$missing"
check 'another frame reads other tiles' test "$("$render" tiles.mtlx --scene grid --frame 43 | tr ',' '\n' | sort -u | tr '\n' ' ')" = \
    '0.400000006 1 NG/out '
check 'a frame that is out of range shows the default' \
    test "$("$render" tiles.mtlx --scene grid --frame 44 | tr ',' '\n' | sort -u | tr '\n' ' ')" = '0.400000006 NG/out '
check 'a box blur has its mean' all_near NG/o_box 0.03
check 'a gaussian blur has its mean' all_near NG/o_gaussian 0.01
python3 - <<'X'
import struct, zlib
part = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
for alpha in 51, 255:
    open(f"leaf_{alpha}.png", "wb").write(b"\x89PNG\r\n\x1a\n" + part(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 6, 0, 0, 0))
                                         + part(b"IDAT", zlib.compress(bytes((0, 204, 102, 51, alpha)))) + part(b"IEND", b""))
    open(f"leaf_{alpha}.mtlx", "w").write(f"""<materialx version="1.39">
  <image name="leaf" type="color3"><input name="file" type="filename" value="leaf_{alpha}.png"/></image>
  <surface_unlit name="S" type="surfaceshader"><input name="emission_color" type="color3" nodename="leaf"/></surface_unlit>
</materialx>""")
X
check 'an image without holes is drawn' exits 0 "$render" leaf_255.mtlx -e S --size 8 -o drawn_255.png
check 'colours of an image are not multiplied by its alpha' eval 'exits 0 "$render" leaf_51.mtlx -e S --size 8 -o drawn_51.png && cmp drawn_51.png drawn_255.png'
check 'a missing tile of a frame fails the run' exits 1 "$render" tiles.mtlx --scene grid --frame 34
check 'the error names the file of the tile' grep -q "t.1001.0031.ppm" err
# Found out before anything is drawn: the document is not even read
for place in missing/ball.png ball.xyz . ; do
    check "a picture that cannot be written fails the run: $place" exits 1 "$render" none.mtlx -o "$place" --size 8
    check 'the error is output-failed before the document is read' eval 'grep -q "\[output-failed\]" err && ! grep -q none.mtlx err'
done
check 'an ending of no format is an error' eval '! "$render" plain.mtlx -o ball.xyz 2>err; grep -q "ball.xyz.: unknown image format" err'
check 'a copy that cannot be written fails the run' exits 1 "$render" none.mtlx -o x.png --copy missing/x.png
check 'a bad value of --set fails the run' exits 1 "$render" plain.mtlx -o x.png --set SR/base_color=abc
check 'the error of a bad value is bad-value' grep -q '\[bad-value\]' err
check 'an unknown input of --set fails the run' exits 1 "$render" plain.mtlx -o x.png --set SR/none=1
check 'the error of an unknown input is no-uniform' grep -q '\[no-uniform\]' err
check 'a size of 0 is wrong usage' exits 2 "$render" plain.mtlx -o x.png --size 0
# The driver loses the device: while it sends textures, and while it draws or traces.
for lost in 1 2; do
    for how in '' '--path-trace --paths 64'; do
        # shellcheck disable=SC2086
        LD_PRELOAD=$lost_device LOST_DEVICE=$lost exits 1 "$render" plain.mtlx -m sphere --size 8 $how -o lost.png >lost.log
        check "a lost device does not crash the program: $lost $how" test "$(wc -c <lost.log)" = 0
        check 'the error of a lost device is device-lost' grep -q '\[device-lost\]' err
        check 'a lost device writes nothing' test ! -e lost.png
    done
done
check 'a machine without a driver is an error that names a package' eval 'VK_DRIVER_FILES=/none VK_ICD_FILENAMES=/none exits 1 "$render" plain.mtlx -o x.png && grep -q "mesa-vulkan-drivers.*\[no-device\]" err'
check 'failed runs leave no files' test -z "$(ls -A | grep -E '^x.png|tmp')"

# corner FILE: the last pixel of a PPM.
corner() { od -An -tu1 -j"$(($(wc -c <"$1") - 3))" -N3 "$1" | tr -s ' '; }
# pixels FILE: a line for each pixel of a PPM below 100x100.
pixels() { tail -c "+$(($(head -n 3 "$1" | wc -c) + 1))" "$1" | od -An -tu1 -v -w3 | tr -s ' '; }

check 'a checker may stand for a missing texture' exits 0 "$render" textured.mtlx -m plane --missing-texture checker -o checker.ppm --size 24
check 'the missing texture of a checker is a warning' grep -q 'warning: .*none.png.*\[missing-texture\]' err
check 'the checker is magenta and black' test "$(pixels checker.ppm | awk '!$2 && $1 == $3 { if ($1 > 150) m++; if ($1 < 100) b++ } END { print (m > 9 && b > 9) }')" = 1
check 'a texture that is no picture fails the run' exits 1 "$render" textured.mtlx --set NG/image/file=broken.png -o x.png
check 'the error of such a texture is missing-texture' grep -q 'broken.png.*\[missing-texture\]' err
check 'a picture that is too large for the device fails the run' exits 1 "$render" plain.mtlx -o x.png --size 16384
check 'the error of such a picture is size-limit' grep -q '\[size-limit\]' err
check 'a pipe gets no progress' eval 'exits 0 "$render" plain.mtlx plain.mtlx -o x.png --size 8 && test ! -s err'
rm -f x.png

# Meshes
for mesh in ball sphere plane cube cloth; do
    check "the mesh $mesh is drawn" exits 0 "$render" plain.mtlx -m $mesh -o $mesh.ppm --size 24 --background none
    check "the mesh $mesh is in the middle" test "$(pixels $mesh.ppm | awk '$1 + $2 + $3 > 60 { n++ } END { print (n > 60) }')" = 1
done
check 'the meshes have different pictures' test "$(md5sum ball.ppm sphere.ppm plane.ppm cube.ppm cloth.ppm | cut -c -32 | sort -u | wc -l)" = 5
printf 'v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n' >bare.obj
check 'a mesh without normals and texture coordinates is drawn' exits 0 "$render" plain.mtlx -m bare.obj -o bare.ppm --size 16
for part in normals 'texture coordinates' tangents; do
    check "$part are made, with a note" grep -q "note: the mesh 'bare.obj' has no $part" err
done
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n' >flat.obj
check 'a mesh without area fails the run' exits 1 "$render" plain.mtlx -m flat.obj -o x.png
check 'the error of such a mesh is empty-mesh' grep -q '\[empty-mesh\]' err
check 'a mesh that is missing fails the run' exits 1 "$render" plain.mtlx -m none.obj -o x.png
check 'the error of a missing mesh is bad-mesh' grep -q "none.obj.*\[bad-mesh\]" err
check 'an unknown shape fails the run' exits 1 "$render" plain.mtlx -m bal -o x.png
check 'the error lists the shapes' grep -q "'bal': write ball, .*\[bad-mesh\]" err
echo 'v x' >junk.gltf
check 'a file that is no mesh fails the run' exits 1 "$render" plain.mtlx -m junk.gltf -o x.png
positions=AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAA
cat >triangle.gltf <<X
{ "asset": { "version": "2.0" }, "scene": 0, "scenes": [ { "nodes": [ 0 ] } ], "nodes": [ { "mesh": 0 } ],
  "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 } } ] } ],
  "buffers": [ { "byteLength": 36, "uri": "data:application/octet-stream;base64,$positions" } ],
  "bufferViews": [ { "buffer": 0, "byteLength": 36 } ],
  "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [ -1, -1, 0 ], "max": [ 1, 1, 0 ] } ] }
X
check 'a mesh of glTF is drawn' exits 0 "$render" plain.mtlx -m triangle.gltf -o triangle.ppm --size 16 --background none
check 'the mesh of glTF is a triangle' test "$(pixels triangle.ppm | awk '$1 { n++ } END { print (n > 20 && n < 120) }')" = 1

# Camera, environment, formats
check 'a camera may stand in front' exits 0 "$render" plain.mtlx -m cube --camera 0,0,4,40 -o front.ppm --size 24
check 'a camera may stand elsewhere' exits 0 "$render" plain.mtlx -m cube --camera 40,30,4,40 -o side.ppm --size 24
check 'another camera sees another picture' eval '! cmp -s front.ppm side.ppm'
check 'a camera of one number is wrong usage' exits 2 "$render" plain.mtlx --camera 1 -o x.png
check 'a camera in the zenith is wrong usage' exits 2 "$render" plain.mtlx --camera 0,90 -o x.png
printf 'PF\n2 1\n-1.0\n' >red.pfm
for i in 1 2; do printf '\000\000\200\077\000\000\000\000\000\000\000\000' >>red.pfm; done
check 'an environment may be a file' exits 0 "$render" plain.mtlx --environment red.pfm -o red.ppm --size 8 -m sphere
check 'a red environment lights the ball in red' test "$(pixels red.ppm | sed -n 37p | awk '{ print ($1 > 100 && $2 < 60 && $3 < 60) }')" = 1
check 'an environment may be the background' exits 0 "$render" plain.mtlx --environment red.pfm --background environment -o red.ppm --size 8 -m sphere
check 'the background shows in the corners' test "$(corner red.ppm)" = ' 203 0 0'
check 'a file and a mode of the environment go together' exits 0 "$render" plain.mtlx --environment red.pfm --environment none -o none.ppm --size 8 -m sphere
check 'the mode none gives no light' test "$(pixels none.ppm | sed -n 37p)" = ' 0 0 0'
check 'an environment that is missing fails the run' exits 1 "$render" plain.mtlx --environment none.exr -o x.png
check 'the error of a missing environment is bad-environment' grep -q 'none.exr.*\[bad-environment\]' err
check 'a picture may be EXR' exits 0 "$render" plain.mtlx -o ball.exr --size 8
check 'the picture is EXR' test "$(od -An -tx1 -N4 ball.exr | tr -d ' ')" = 762f3101
# A limit on file sizes is a full disk that needs no privileges.
full() { (ulimit -f 1 && exits 1 "$render" plain.mtlx -o "full.$1" --size 64) && has err 'File too large' '[output-failed]' && test ! -e "full.$1"; }
for format in png jpg exr hdr; do check "a full disk is told, and no part of a picture stays: $format" full "$format"; done

cat >metal.mtlx <<'X'
<?xml version="1.0"?>
<materialx version="1.39">
  <conductor_bsdf name="bsdf" type="BSDF"><input name="roughness" type="vector2" value="0.15, 0.15"/></conductor_bsdf>
  <surface name="S" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="bsdf"/></surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>
X
# agree A B: two PPMs, within one percent of the whole range in the mean and ten for each value (a prefiltered map knows no
# grazing angles).
agree() {
    paste <(pixels "$1") <(pixels "$2") | awk '
        { for (i = 1; i < 4; i++) { d = $i - $(i + 3); s += d; n++; if (d * d > m) m = d * d } }
        END { printf "mean %.2f, worst %.2f percent\n", s / n / 2.55, sqrt(m) / 2.55; exit !(s * s < (2.55 * n) ^ 2 && sqrt(m) < 25.5) }'
}
metal() { "$render" metal.mtlx -m sphere --lights none --size 48 "$@"; }
check 'a metal is drawn by importance sampling' metal --environment importance --samples 256 -o importance.ppm
check 'a metal is drawn by a prefiltered map' metal --environment prefiltered -o prefiltered.ppm
check 'both pictures agree' agree importance.ppm prefiltered.ppm
check 'an environment can be baked' exits 0 "$render" --bake-environment sky -o baked
check 'a baked environment is three files' test -s baked/radiance.exr -a -s baked/irradiance.exr -a -s baked/albedo.exr
check 'a metal is drawn by a baked environment' metal --environment prefiltered --environment baked -o baked.ppm
check 'a baked environment gives the same picture' cmp prefiltered.ppm baked.ppm
check 'a baked environment serves importance sampling' metal --environment baked --samples 256 -o baked.ppm
check 'its picture agrees with that of the sky' agree importance.ppm baked.ppm
check 'an environment that is missing cannot be baked' exits 1 "$render" --bake-environment none.exr -o nothing
check 'a folder that is not baked is an error' eval 'mkdir bare; exits 1 "$render" metal.mtlx --environment bare -o x.png && grep -q "\[bad-environment\]" err'

# Displacement: a ball that grows by a quarter is one seen from nearer; a plane that rises to the right is a tilted one.
displaced() { # NAME NODES
    cat >"$1.mtlx" <<X
<?xml version="1.0"?>
<materialx version="1.39">
  $2
  <displacement name="D" type="displacementshader"><input name="displacement" type="float" nodename="height"/></displacement>
  <conductor_bsdf name="bsdf" type="BSDF"><input name="roughness" type="vector2" value="0.15, 0.15"/></conductor_bsdf>
  <surface name="S" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="bsdf"/></surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="S"/>
    <input name="displacementshader" type="displacementshader" nodename="D"/>
  </surfacematerial>
</materialx>
X
}
displaced grown '<constant name="height" type="float"><input name="value" type="float" value="0.25"/></constant>'
displaced ramp '<texcoord name="uv" type="vector2"/><separate2 name="st" type="multioutput"><input name="in" type="vector2" nodename="uv"/></separate2>
  <range name="height" type="float"><input name="in" type="float" nodename="st" output="outx"/>
    <input name="outlow" type="float" value="-0.4"/><input name="outhigh" type="float" value="0.4"/></range>'
printf 'v -0.8 -0.8 -0.4\nv 0.8 -0.8 0.4\nv 0.8 0.8 0.4\nv -0.8 0.8 -0.4\nf 1 2 3 4\n' >tilted.obj
check 'a displaced ball is drawn' exits 0 "$render" grown.mtlx -m sphere --lights none --size 48 --camera 25,16,5 -o grown.ppm
check 'a nearer ball is drawn' metal --camera 25,16,4 -o nearer.ppm
check 'a ball that grows agrees with a nearer one' agree grown.ppm nearer.ppm
check 'a displaced plane is drawn' exits 0 "$render" ramp.mtlx -m plane --lights none --size 48 --camera 10,10,4.8 -o ramp.ppm
check 'a tilted plane is drawn' exits 0 "$render" metal.mtlx -m tilted.obj --lights none --size 48 --camera 10,10,4 -o tilted.ppm
check 'a plane that rises agrees with a tilted one' agree ramp.ppm tilted.ppm
check 'a plane that rises differs from a flat one' eval 'metal -m plane --camera 10,10,4.8 -o flat.ppm && ! agree ramp.ppm flat.ppm'
# A cube that grows has no gap at its edges, through which one would see what is behind it: from one edge to the opposite one.
for trace in '' '--path-trace --paths 4'; do
    # shellcheck disable=SC2086 # arguments, divided by spaces
    check "a displaced cube is drawn ${trace:-in a raster}" exits 0 "$render" grown.mtlx -m cube --lights none --size 8 --camera 45,0,20,1 $trace -o cube.exr
    check "a displaced cube has no gaps ${trace:-in a raster}" test "$(python3 "$exr" cube.exr A mean)" = 1.0000
done

# Volumes. In a white room one that scatters only is not to be seen: what it takes it gives back.
printf 'PF\n2 1\n-1.0\n\0\0\200\077\0\0\200\077\0\0\200\077\0\0\200\077\0\0\200\077\0\0\200\077' >white.pfm
volume() { # NAME ABSORPTION SCATTERING EMISSION
    cat >"$1.mtlx" <<X
<?xml version="1.0"?>
<materialx version="1.39">
  <anisotropic_vdf name="vdf" type="VDF">
    <input name="absorption" type="vector3" value="$2"/><input name="scattering" type="vector3" value="$3"/>
    <input name="anisotropy" type="float" value="0.3"/>
  </anisotropic_vdf>
  <uniform_edf name="edf" type="EDF"><input name="color" type="color3" value="$4"/></uniform_edf>
  <volume name="one" type="volumeshader"><input name="vdf" type="VDF" nodename="vdf"/><input name="edf" type="EDF" nodename="edf"/></volume>
  <volume name="none" type="volumeshader"/>
  <mix name="V" type="volumeshader"><input name="fg" type="volumeshader" nodename="one"/>
    <input name="bg" type="volumeshader" nodename="none"/><input name="mix" type="float" value="0.5"/></mix>
  <volumematerial name="M" type="material"><input name="volumeshader" type="volumeshader" nodename="V"/></volumematerial>
</materialx>
X
}
in_room() { # NAME ENVIRONMENT
    "$render" "$1.mtlx" -m sphere --camera 0,0,5 --lights none --environment "$2" --background environment --size 32 -o "$1.ppm" -q
}
# middle FILE: the green of a pixel in the middle, as light (the inverse of sRGB), over that of white.
middle() { pixels "$1" | sed -n 529p | awk '{ printf "%.3f", ($2 / 203) ^ 2.2 }'; }
volume milk '0,0,0' '3,3,3' '0,0,0'
check 'a volume that only scatters is drawn' in_room milk white.pfm
check 'a volume that only scatters is invisible in a white room' test "$(pixels milk.ppm | awk '{ for (i = 1; i < 4; i++) if ($i < 202 || $i > 204) n++ } END { print n + 0 }')" = 0
volume ink '1,1,1' '0,0,0' '0,0,0'
check 'a volume that absorbs is drawn' in_room ink white.pfm
check 'a volume absorbs by the law of Beer' near "$(middle ink.ppm)" 0.368 0.02
volume glow '0,0,0' '0,0,0' '0,0.5,0'
check 'a volume that emits is drawn' in_room glow red.pfm
check 'a volume emits along the whole way' near "$(middle glow.ppm)" 0.5 0.02

# Transparency: half of white over black, in any order of triangles; a mask hides what is behind it.
sheet() { # NAME OPACITY
    cat >"$1.mtlx" <<X
<?xml version="1.0"?>
<materialx version="1.39">
  <texcoord name="uv" type="vector2"/>
  <separate2 name="st" type="multioutput"><input name="in" type="vector2" nodename="uv"/></separate2>
  <position name="p" type="vector3"/>
  <separate3 name="xyz" type="multioutput"><input name="in" type="vector3" nodename="p"/></separate3>
  <ifgreater name="near" type="color3"><input name="value1" type="float" nodename="xyz" output="outz"/>
    <input name="in1" type="color3" value="1, 0, 0"/><input name="in2" type="color3" value="0, 0, 1"/></ifgreater>
  $2
  <surface_unlit name="S" type="surfaceshader">
    <input name="emission_color" type="color3" nodename="near"/><input name="opacity" type="float" nodename="opacity"/>
  </surface_unlit>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>
X
}
sheet half '<constant name="opacity" type="float"><input name="value" type="float" value="0.5"/></constant>'
sheet mask '<ifgreater name="opacity" type="float"><input name="value1" type="float" nodename="st" output="outx"/>
  <input name="value2" type="float" value="0.5"/><input name="in1" type="float" value="1"/><input name="in2" type="float" value="0"/></ifgreater>'
# Two sheets, the nearer one first in one file and last in the other.
near='v -1 -1 0.1\nv 1 -1 0.1\nv 1 1 0.1\nv -1 1 0.1\n' far='v -1 -1 -0.1\nv 1 -1 -0.1\nv 1 1 -0.1\nv -1 1 -0.1\n'
printf "$near${far}f 1 2 3 4\nf 5 6 7 8\n" >near_first.obj
printf "$near${far}f 5 6 7 8\nf 1 2 3 4\n" >far_first.obj
for mesh in near_first far_first; do
    check "two sheets are drawn: $mesh" exits 0 "$render" half.mtlx -m $mesh.obj --camera 0,0,3 --size 8 -o $mesh.ppm -q
done
check 'the order of triangles does not matter' cmp near_first.ppm far_first.ppm
# Red at one half over blue at one half: twice as much red, before sRGB.
check 'the near sheet is above' test "$(pixels near_first.ppm | sed -n 36p | awk '{ print ($1 > $3 + 20 && $3 > $2 + 20) }')" = 1
check 'a mask is drawn' exits 0 "$render" mask.mtlx -m plane --camera 0,0,3 --size 16 --background none -o mask.ppm
check 'a mask hides half of the plane' test "$(pixels mask.ppm | awk '!$1 && !$2 && $3 == 203 { n++ } END { print n }')" = 128

# Many pictures
check 'a turntable is drawn' exits 0 "$render" plain.mtlx -m cube --turntable 4 -o turn.ppm --size 8
check 'the pictures of a turntable are numbered' test -s turn.0000.ppm -a -s turn.0001.ppm -a -s turn.0003.ppm -a ! -e turn.0004.ppm
check 'a quarter turn shows another side' eval '! cmp -s turn.0000.ppm turn.0001.ppm'
mkdir -p materials/deep
cp plain.mtlx materials/a.mtlx
sed 's/0.8, 0.8, 0.8/0.8, 0, 0/; s/"M"/"Red"/' plain.mtlx >materials/deep/b.mtlx
check 'a folder gives a sheet' exits 0 "$render" materials -o sheet.ppm --size 32
check 'a sheet has room for two pictures' test "$(sed -n 2p sheet.ppm)" = '76 51'
sed 's/standard_surface/none/' plain.mtlx >materials/c.mtlx
check 'a sheet with a faulty document fails the run' exits 1 "$render" materials -o sheet3.ppm --size 32
check 'a sheet with a faulty document is drawn' test -s sheet3.ppm
check 'a folder without documents is an error' eval 'mkdir empty; exits 1 "$render" empty -o x.png && grep -q "\[nothing-to-render\]" err'
cat >look.mtlx <<'X'
<?xml version="1.0"?>
<materialx version="1.39">
  <standard_surface name="S1" type="surfaceshader"><input name="base_color" type="color3" value="1, 0, 0"/></standard_surface>
  <standard_surface name="S2" type="surfaceshader"><input name="base_color" type="color3" value="0, 0, 1"/></standard_surface>
  <surfacematerial name="M1" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S1"/></surfacematerial>
  <surfacematerial name="M2" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S2"/></surfacematerial>
  <look name="blue"><materialassign name="a" material="M2" geom="/"/></look>
  <look name="both"><materialassign name="b" material="M1" geom="/a"/><materialassign name="c" material="M2" geom="/b"/></look>
</materialx>
X
check 'a look with one material is drawn' exits 0 "$render" look.mtlx --look blue -o look.ppm --size 16 -m sphere
check 'the material of the look is blue' test "$(pixels look.ppm | sed -n 136p | awk '{ print ($3 > 2 * $1) }')" = 1
check 'a look with two materials is drawn' exits 0 "$render" look.mtlx --look both -o both.ppm --size 16
check 'a look with two materials is a sheet' test "$(sed -n 2p both.ppm | cut -d ' ' -f 1)" = 44
check 'an unknown look fails the run' exits 1 "$render" look.mtlx --look green -o x.png
check 'the error of an unknown look is no-look' grep -q '\[no-look\]' err
check 'these runs leave no files' test -z "$(ls -A | grep -E '^x\.|tmp-')"

# ratio_is A B EXPECTED: the means of two pictures, within 1 percent.
ratio_is() { awk -v a="$("$mean_ratio" "$1" "$2")" -v b="$3" 'BEGIN { print a; exit !(a > b * 0.99 && a < b * 1.01) }'; }

# Albedos of lobes come from a fit and from the baked table: pictures agree, and only the latter asks for a texture.
cat >rough.mtlx <<'X'
<?xml version="1.0"?>
<materialx version="1.39">
  <standard_surface name="SR" type="surfaceshader">
    <input name="specular" type="float" value="1"/><input name="specular_roughness" type="float" value="0.7"/>
    <input name="metalness" type="float" value="0.5"/>
  </standard_surface>
</materialx>
X
check 'the albedo may come from a fit' exits 0 "$render" rough.mtlx -q -m sphere --size 16 -o fit.exr
check 'the albedo may come from a table' exits 0 "$render" rough.mtlx -q -m sphere --size 16 --albedo table -o table.exr
check 'fit and table agree' ratio_is table.exr fit.exr 1
check 'fit and table are two pictures' eval '! cmp -s table.exr fit.exr'
check 'the table may come from a baked environment' exits 0 "$render" rough.mtlx -q -m sphere --size 16 --environment baked --albedo table -o baked.exr

# A light made of nodes: what it sends to a white plane at a distance of 10 is its intensity over 100 pi, times cos^3 away from the middle;
# half of that distance four times as much; nothing where the cone looks away.
cat >light.mtlx <<'X'
<?xml version="1.0"?>
<materialx version="1.39">
  <uniform_edf name="glow" type="EDF"/>
  <light name="bulb" type="lightshader">
    <input name="edf" type="EDF" nodename="glow"/><input name="intensity" type="float" value="157.08"/><input name="exposure" type="float" value="1"/>
  </light>
  <conical_edf name="cone" type="EDF"><input name="inner_angle" type="float" value="60"/></conical_edf>
  <light name="spot" type="lightshader"><input name="edf" type="EDF" nodename="cone"/><input name="intensity" type="float" value="314.16"/></light>
  <oren_nayar_diffuse_bsdf name="white" type="BSDF"><input name="color" type="color3" value="1, 1, 1"/></oren_nayar_diffuse_bsdf>
  <surface name="S" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="white"/></surface>
  <surface name="G" type="surfaceshader"><input name="edf" type="EDF" nodename="glow"/></surface>
</materialx>
X
# lit NAME LIGHT DISTANCE [FACING]: the picture by one light in front of the plane.
lit() {
    check "$1 is drawn" exits 0 "$render" light.mtlx -e S -q --scene plane --environment none --lights "$2=1" --max-lights 1 --size 8 \
        --set "u_lightData[0].position=0,0,$3" ${4:+--set "u_lightData[0].direction=$4"} -o "$1.exr"
}
lit far bulb 10
lit near bulb 5
lit spot spot 10 0,0,-1
lit away spot 10 0,0,1
check 'a plane that glows is drawn' exits 0 "$render" light.mtlx -e G -q --scene plane --size 8 -o glow.exr
check 'a light falls off with the square of the distance' ratio_is far.exr glow.exr 0.990
check 'a light is brighter when it is near' ratio_is near.exr glow.exr 3.848
check 'a light has its whole intensity in its cone' ratio_is spot.exr far.exr 1
check 'a light sends nothing behind its cone' test "$("$mean_ratio" away.exr glow.exr)" = 0.0000
check 'an unknown member of a light fails the run' exits 1 "$render" light.mtlx -e S --lights bulb=1 --set 'u_lightData[0].colour=1' -o x.png
check 'the error of an unknown member is no-uniform' grep -q no-uniform err

# Properties of the geometry: a mesh has texture coordinates under the names that programs give them; the default of a node stands in for
# what it lacks, for each reader its own.
tile wood.ppm '255 0 0'
read_property() { echo "<$1 name='$2' type='$3'><input name='$4' type='string' value='$5'/>${7:+<input name='$6' type='$3' value='$7'/>}</$1>"; }
{
    echo '<materialx version="1.39" colorspace="lin_rec709">'
    read_property UsdPrimvarReader usd float varname fade fallback 0.25
    read_property geompropvalue own float geomprop fade default 0.75
    read_property geompropvalue shown boolean geomprop shown default true
    read_property geompropvalueuniform picture filename geomprop picture default wood.ppm
    echo '<texcoord name="first" type="vector2"/><convert name="off0" type="float"><input name="in" type="boolean" nodename="shown"/></convert>'
    last=0
    for name in st UVMap uv map1; do
        read_property geompropvalue "$name" vector2 geomprop "$name" default '7, 7'
        echo "<distance name='d$name' type='float'><input name='in1' type='vector2' nodename='first'/><input name='in2' type='vector2' nodename='$name'/></distance>
          <add name='off$((last + 1))' type='float'><input name='in1' type='float' nodename='off$last'/><input name='in2' type='float' nodename='d$name'/></add>"
        last=$((last + 1))
    done
    echo '<image name="i" type="float"><input name="file" type="filename" nodename="picture"/></image>
      <multiply name="usd_i" type="float"><input name="in1" type="float" nodename="usd"/><input name="in2" type="float" nodename="i"/></multiply>
      <combine3 name="c" type="color3"><input name="in1" type="float" nodename="usd_i"/><input name="in2" type="float" nodename="own"/><input name="in3" type="float" nodename="off4"/></combine3>
      <surface_unlit name="M" type="surfaceshader"><input name="emission_color" type="color3" nodename="c"/></surface_unlit></materialx>'
} >properties.mtlx
for trace in '' --path-trace; do
    check "properties are drawn $trace" exits 0 "$render" properties.mtlx -e M -m plane --camera 0,0 --size 8 $trace -o properties.exr
    check "a property that the mesh lacks is a warning $trace" grep -q "'plane' has no primvar for '[a-z]*', which 'M' reads (and others); .*\[missing-primvar\]" err
    for channel in R=0.25 G=0.75 B=1; do
        check "defaults and texture coordinates: $channel $trace" near "$(python3 "$exr" properties.exr ${channel%=*} 0.5 0.5)" ${channel#*=} 0.002
    done
done

# A thin sheet under light of 1 from everywhere sends back its colour, whatever its anisotropy: (1 - g) / 2 and (1 + g) / 2 of it. Files have
# the unit and the space of their inputs, through interfaces, too: a foot, and sRGB's 128 of 255 in linear light.
write_white white.hdr
tile grey.ppm '128 128 128'
cat >values.mtlx <<'X'
<?xml version="1.0"?>
<materialx version="1.39" colorspace="lin_rec709">
  <open_pbr_surface name="sheet" type="surfaceshader">
    <input name="specular_weight" type="float" value="0"/><input name="subsurface_weight" type="float" value="1"/>
    <input name="subsurface_color" type="color3" value="0.5, 0.25, 0.75"/><input name="subsurface_scatter_anisotropy" type="float" value="0.5"/>
    <input name="geometry_thin_walled" type="boolean" value="true"/>
  </open_pbr_surface>
  <image name="feet" type="float"><input name="file" type="filename" value="wood.ppm" unit="foot" unittype="distance"/></image>
  <nodegraph name="G">
    <input name="f" type="filename" value="wood.ppm" unit="foot" unittype="distance"/>
    <input name="g" type="filename" value="grey.ppm" colorspace="srgb_texture"/>
    <image name="i" type="vector2"><input name="file" type="filename" interfacename="f"/></image>
    <image name="j" type="color3"><input name="file" type="filename" interfacename="g"/></image>
    <output name="feet" type="vector2" nodename="i"/><output name="grey" type="color3" nodename="j"/>
  </nodegraph>
  <extract name="x" type="float"><input name="in" type="vector2" nodegraph="G" output="feet"/></extract>
  <extract name="r" type="float"><input name="in" type="color3" nodegraph="G" output="grey"/></extract>
  <combine3 name="c" type="color3"><input name="in1" type="float" nodename="feet"/><input name="in2" type="float" nodename="x"/><input name="in3" type="float" nodename="r"/></combine3>
  <surface_unlit name="files" type="surfaceshader"><input name="emission_color" type="color3" nodename="c"/></surface_unlit>
</materialx>
X
check 'a thin sheet is drawn' exits 0 "$render" values.mtlx -e sheet -m plane --camera 0,0 --size 8 --environment white.hdr -o sheet.exr
check 'files with units are drawn' exits 0 "$render" values.mtlx -e files -m plane --camera 0,0 --size 8 -o files.exr
for value in sheet.exr,R,0.5 sheet.exr,G,0.25 sheet.exr,B,0.75 files.exr,R,0.3048 files.exr,G,0.3048 files.exr,B,0.2158; do
    IFS=, read -r file channel value <<<"$value"
    check "$file: $channel is $value" near "$(python3 "$exr" "$file" "$channel" 0.5 0.5)" "$value" 0.005
done

# A tile that is turned by 90 degrees has its +x downwards, and so has the lean of a normal.
tile lean.ppm '191 128 238'
cat >hextile.mtlx <<'X'
<?xml version="1.0"?>
<materialx version="1.39" colorspace="lin_rec709">
  <hextilednormalmap name="h" type="vector3">
    <input name="file" type="filename" value="lean.ppm"/><input name="rotation" type="float" value="1"/><input name="rotationrange" type="vector2" value="90, 90"/>
  </hextilednormalmap>
  <convert name="c" type="color3"><input name="in" type="vector3" nodename="h"/></convert>
  <add name="above" type="color3"><input name="in1" type="color3" nodename="c"/><input name="in2" type="float" value="1"/></add>
  <surface_unlit name="M" type="surfaceshader"><input name="emission_color" type="color3" nodename="above"/></surface_unlit>
</materialx>
X
check 'turned tiles are drawn' exits 0 "$render" hextile.mtlx -e M -m plane --camera 0,0 --size 8 -o hextile.exr
for channel in R=1 G=0.5 B=1.867; do
    check "normals turn with their tile: $channel" near "$(python3 "$exr" hextile.exr ${channel%=*} 0.5 0.5)" ${channel#*=} 0.01
done

# Further texture coordinates and colours of a file: (0.25, 0.5) and (0.1, 0.2, 0.3) at each corner.
python3 - <<'X' >sets.gltf
import base64, json, struct
corners = [((x, y, 0), (x / 2 + .5, y / 2 + .5), (.25, .5), (.1, .2, .3, 1)) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
parts = [b"".join(struct.pack(f"<{len(v)}f", *v) for v in column) for column in zip(*corners)] + [struct.pack("<6H", 0, 1, 2, 0, 2, 3)]
kinds = [("VEC3", 5126), ("VEC2", 5126), ("VEC2", 5126), ("VEC4", 5126), ("SCALAR", 5123)]
accessors = [{"bufferView": i, "componentType": kind, "count": 6 if kind == 5123 else 4, "type": name} for i, (name, kind) in enumerate(kinds)]
accessors[0].update(min=[-1, -1, 0], max=[1, 1, 0])
names = {"POSITION": 0, "TEXCOORD_0": 1, "TEXCOORD_1": 2, "COLOR_0": 3}
uri = "data:application/octet-stream;base64," + base64.b64encode(b"".join(parts)).decode()
print(json.dumps({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "accessors": accessors,
    "meshes": [{"primitives": [{"attributes": names, "indices": 4}]}], "buffers": [{"byteLength": sum(map(len, parts)), "uri": uri}],
    "bufferViews": [{"buffer": 0, "byteOffset": sum(map(len, parts[:i])), "byteLength": len(p)} for i, p in enumerate(parts)]}))
X
cat >sets.mtlx <<'X'
<?xml version="1.0"?>
<materialx version="1.39">
  <texcoord name="uv" type="vector2"><input name="index" type="integer" value="1"/></texcoord>
  <geompropvalue name="st" type="vector2"><input name="geomprop" type="string" value="st1"/></geompropvalue>
  <geomcolor name="color" type="color3"/>
  <extract name="u" type="float"><input name="in" type="vector2" nodename="uv"/></extract>
  <extract name="v" type="float"><input name="in" type="vector2" nodename="st"/><input name="index" type="integer" value="1"/></extract>
  <extract name="b" type="float"><input name="in" type="color3" nodename="color"/><input name="index" type="integer" value="2"/></extract>
  <combine3 name="all" type="color3">
    <input name="in1" type="float" nodename="u"/><input name="in2" type="float" nodename="v"/><input name="in3" type="float" nodename="b"/>
  </combine3>
  <surface_unlit name="M" type="surfaceshader"><input name="emission_color" type="color3" nodename="all"/></surface_unlit>
</materialx>
X
check 'a file with several sets is drawn' exits 0 "$render" sets.mtlx -e M -m sets.gltf --camera 0,0 --size 8 -o sets.exr
check 'nothing is missing' test -z "$(grep missing-primvar err)"
for channel in R=0.25 G=0.5 B=0.3; do
    check "sets of coordinates and colours are read: $channel" near "$(python3 "$exr" sets.exr ${channel%=*} 0.5 0.5)" ${channel#*=} 0.001
done

# At its edge the ray inside of a smooth ball is as flat as it can be.
cat >smooth.mtlx <<'END'
<materialx version="1.39">
  <open_pbr_surface name="S" type="surfaceshader">
    <input name="specular_roughness" type="float" value="0"/><input name="specular_ior" type="float" value="1.52"/><input name="transmission_weight" type="float" value="1"/>
  </open_pbr_surface>
  <surfacematerial name="Glass" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>
END
check 'smooth glass is finite up to its edge' exits 0 "$render" smooth.mtlx --mesh sphere --camera 25,16,5,30 -s 256 -o smooth.exr

# White matter in white light has the light's colour: MaterialX's rough Burley lobe has more, its anisotropic metal less.
cat >white.mtlx <<'END'
<materialx version="1.39">
  <burley_diffuse_bsdf name="B" type="BSDF"><input name="color" type="color3" value="1, 1, 1"/><input name="roughness" type="float" value="1"/></burley_diffuse_bsdf>
  <conductor_bsdf name="C" type="BSDF">
    <input name="ior" type="color3" value="0.001, 0.001, 0.001"/><input name="extinction" type="color3" value="100, 100, 100"/>
    <input name="roughness" type="vector2" value="0.6, 0.05"/>
  </conductor_bsdf>
  <generalized_schlick_bsdf name="D" type="BSDF">
    <input name="color0" type="color3" value="1, 1, 1"/><input name="color90" type="color3" value="1, 1, 1"/>
    <input name="roughness" type="vector2" value="0.8, 0.3"/><input name="distribution" type="string" value="beckmann"/>
  </generalized_schlick_bsdf>
  <surface name="burley" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="B"/></surface>
  <surface name="brushed" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="D"/></surface>
  <surface name="metal" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="C"/></surface>
  <surface_unlit name="light" type="surfaceshader"/>
</materialx>
END
{ printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n'; for _ in {1..32}; do printf '\200\200\200\201'; done; } >white.hdr
# furnace ELEMENT QUALITY RATIO: the share of the light that comes back
furnace() {
    exits 0 "$render" white.mtlx -e "$1" --mesh sphere -s 32 --lights none --environment white.hdr --samples 256 --quality "$2" -o white.exr &&
        ratio_is white.exr light.exr "$3"
}
check 'the light is drawn' exits 0 "$render" white.mtlx -e light --mesh sphere -s 32 -o light.exr
for element in burley metal brushed; do
    check "the best quality keeps the energy of $element" furnace $element reference 1
done
check 'a good one has that of MaterialX: Burley' furnace burley good 1.07
check 'and of anisotropic metal' furnace metal good 0.89
check 'but keeps that of facets by Beckmann, which MaterialX does not have' furnace brushed good 1
finish render
