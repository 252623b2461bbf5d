#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# mxgen bake (docs/bake.md): baked values are those of the graph, documents are flat, and bad input is told. Arguments: mxgen, mxgen-render,
# psnr, the root.
mxgen=$(realpath "$1") render=$(realpath "$2") psnr=$(realpath "$3") root=$(realpath "$4")
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"
has_device "$render" || { skip 'no Vulkan device'; finish bake; }
export MESA_SHADER_CACHE_DISABLE=true

# A material with inputs of all kinds; the graph is in texture coordinates.
cat >wall.mtlx <<'EOF'
<?xml version="1.0"?>
<materialx version="1.39" colorspace="lin_rec709">
  <nodegraph name="NG">
    <input name="tone" type="color3" value="0.5, 0.4, 0.2"/>
    <input name="plain" type="float" value="0.25"/>
    <fractal2d name="noise" type="float"><input name="amplitude" type="float" value="0.4"/></fractal2d>
    <add name="shifted" type="float"><input name="in1" type="float" nodename="noise"/><input name="in2" type="float" value="0.5"/></add>
    <clamp name="kept" type="float"><input name="in" type="float" nodename="shifted"/></clamp>
    <multiply name="color" type="color3"><input name="in1" type="color3" interfacename="tone"/><input name="in2" type="float" nodename="kept"/></multiply>
    <multiply name="bright" type="color3"><input name="in1" type="color3" nodename="color"/><input name="in2" type="float" value="20"/></multiply>
    <add name="three" type="float"><input name="in1" type="float" value="1"/><input name="in2" type="float" value="2"/></add>
    <combine3 name="bumps" type="vector3">
      <input name="in1" type="float" nodename="kept"/>
      <input name="in2" type="float" value="0.5"/>
      <input name="in3" type="float" value="1"/>
    </combine3>
    <normalmap name="map" type="vector3"><input name="in" type="vector3" nodename="bumps"/><input name="scale" type="float" value="0.5"/></normalmap>
    <output name="color_out" type="color3" nodename="color"/>
    <output name="bright_out" type="color3" nodename="bright"/>
    <output name="kept_out" type="float" nodename="kept"/>
    <output name="plain_out" type="float" interfacename="plain"/>
    <output name="three_out" type="float" nodename="three"/>
    <output name="normal_out" type="vector3" nodename="map"/>
  </nodegraph>
  <standard_surface name="SR" type="surfaceshader">
    <input name="base" type="float" value="0.75"/>
    <input name="base_color" type="color3" nodegraph="NG" output="color_out"/>
    <input name="specular_roughness" type="float" nodegraph="NG" output="kept_out"/>
    <input name="coat_roughness" type="float" nodegraph="NG" output="kept_out"/>
    <input name="coat" type="float" nodegraph="NG" output="plain_out"/>
    <input name="specular_IOR" type="float" nodegraph="NG" output="three_out"/>
    <input name="emission_color" type="color3" nodegraph="NG" output="bright_out"/>
    <input name="emission" type="float" value="0.01"/>
    <input name="normal" type="vector3" nodegraph="NG" output="normal_out"/>
  </standard_surface>
  <surfacematerial name="Wall" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SR"/></surfacematerial>
</materialx>
EOF
check 'a document is baked' exits 0 "$mxgen" bake wall.mtlx -o flat --size 64 --samples 2
check 'it says what it did' has err 'of 5 graphs of inputs of '"'wall.mtlx'"', 4 are images (4 files) and 1 values'
check 'the new document is flat and valid' eval 'exits 0 "$mxgen" validate flat/wall.mtlx -Werror && ! grep -q "nodegraph\|fractal" flat/wall.mtlx'
check 'values stay, and constants become values' has flat/wall.mtlx 'name="coat" type="float" value="0.25"' \
    'name="specular_IOR" type="float" value="3.0"' 'name="base" type="float" value="0.75"' '<materialx version="1.39" colorspace="lin_rec709">'
check 'one graph of two inputs is one image' test 1 = "$(grep -c 'value="SR_specular_roughness.png"' flat/wall.mtlx)"
check 'a color is sRGB' has flat/wall.mtlx 'value="SR_base_color.png" colorspace="srgb_texture"'
check 'values above 1 are floats' has flat/wall.mtlx 'value="SR_emission_color.exr"'
check 'a normal map stays one' has flat/wall.mtlx '<normalmap name="map"' 'name="scale" type="float" value="0.5"' 'value="map_in.png"'
check 'nothing else is in the folder' test 'SR_base_color.png SR_emission_color.exr SR_specular_roughness.png map_in.png wall.mtlx' = "$(ls -A flat | tr '\n' ' ' | sed 's/ $//')"

# near LIVE-ELEMENT BAKED-FILE [--srgb]: the picture of the live graph over the plane has the same samples.
near() {
    "$render" "$live" -e "$1" --scene plane -s 64 -q -o live.exr && "$psnr" "${@:3}" --at-least 45 live.exr "$2"
}
live=wall.mtlx
check 'colors are those of the graph' near NG/color flat/SR_base_color.png --srgb
check 'bright colors are those of the graph' near NG/bright flat/SR_emission_color.exr
check 'a map of normals is that of the graph' near NG/bumps flat/map_in.png
# Lit, the baked document looks like its source.
for document in wall.mtlx flat/wall.mtlx; do
    "$render" "$document" -m sphere -s 64 -q -o "$(dirname "$document" | tr . s).exr" || echo "no picture of $document"
done
check 'the picture is that of the source' "$psnr" --at-least 30 s.exr flat.exr

# The plane of the scene as a mesh: positions and normals are part of what is baked.
cat >plane.obj <<'EOF'
v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
vn 0 0 1
f 1/1/1 2/2/1 3/3/1 4/4/1
EOF
cp "$root/examples/marble.mtlx" .
live=marble.mtlx
check 'a mesh gives positions' exits 0 "$mxgen" bake marble.mtlx -o stone -m plane.obj --size 64 --samples 2
check 'colors by position are those of the graph' near NG_marble/color stone/SR_marble_base_color.png --srgb
check 'without a mesh, what reads positions has its place told' exits 1 "$mxgen" bake marble.mtlx -o none
check 'with an id' has err "'NG_marble/place' (marble.mtlx:10:5), which 'SR_marble/base_color' reads" '[bake-mesh]'
check 'and no folder stays' test ! -e none

# ---- Meshes ----

# reads FILE CHANNEL X Y VALUE: a texel of a file of floats.
reads() {
    local got
    got=$(python3 "$here/exr.py" "$1" "$2" "$3" "$4") || return
    awk -v a="$got" -v b="$5" 'BEGIN { d = a - b; if (d * d < 1e-4) exit 0; print a " instead of " b; exit 1 }'
}
# Two squares side by side, each in a tile of its own with a margin.
cat >tiles.obj <<'EOF'
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 2 0 0
v 2 1 0
vt 0.1 0.1
vt 0.9 0.1
vt 0.9 0.9
vt 0.1 0.9
vt 1.1 0.1
vt 1.9 0.1
vt 1.9 0.9
vt 1.1 0.9
vn 0 0 1
f 1/1/1 2/2/1 3/3/1 4/4/1
f 2/5/1 5/6/1 6/7/1 3/8/1
EOF
cat >place.mtlx <<'EOF'
<?xml version="1.0"?>
<materialx version="1.39">
  <position name="place" type="vector3"/>
  <convert name="color" type="color3"><input name="in" type="vector3" nodename="place"/></convert>
  <constant name="leaning" type="vector3"><input name="value" type="vector3" value="3, 0, 4"/></constant>
  <standard_surface name="S" type="surfaceshader">
    <input name="base_color" type="color3" nodename="color"/>
    <input name="normal" type="vector3" nodename="leaning"/>
  </standard_surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>
EOF
check 'each tile has a file' exits 0 "$mxgen" bake place.mtlx -m tiles.obj --size 64 -f exr -o udim
check 'the document names them together' eval 'has udim/place.mtlx "S_base_color.&lt;UDIM&gt;.exr" && test "$(ls udim/S_base_color.*)" = "udim/S_base_color.1001.exr
udim/S_base_color.1002.exr"'
check 'the first tile has its positions' reads udim/S_base_color.1001.exr R 0.5 0.5 0.51
check 'and the second its own' reads udim/S_base_color.1002.exr R 0.5 0.5 1.51
check 'texels beside a triangle take its values' reads udim/S_base_color.1002.exr R 0.02 0.5 1
for channel in 'R 0.8' 'G 0.5' 'B 0.9'; do
    check "a direction becomes a map of normals: $channel" reads udim/S_normal.1001.exr ${channel% *} 0.5 0.5 "${channel#* }"
done
check 'behind a normalmap' has udim/place.mtlx '<normalmap name="S_normal_map"'

# ---- Images that stay ----

mkdir -p in
cp flat/SR_base_color.png 'in/a tone.png'
cat >in/stays.mtlx <<'EOF'
<?xml version="1.0"?>
<materialx version="1.39" fileprefix="../in/">
  <image name="tone" type="color3"><input name="file" type="filename" value="a tone.png" colorspace="srgb_texture"/></image>
  <standard_surface name="S" type="surfaceshader"><input name="base_color" type="color3" nodename="tone"/></standard_surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>
EOF
check 'an image without changes stays' eval 'exits 0 "$mxgen" bake in/stays.mtlx -o stays && has stays/stays.mtlx "value=\"../in/a tone.png\" colorspace=\"srgb_texture\"" && test "$(ls stays)" = stays.mtlx'
check 'or is copied' eval 'exits 0 "$mxgen" bake in/stays.mtlx -o copies --copy && has copies/stays.mtlx "value=\"a_tone.png\"" && cmp "in/a tone.png" copies/a_tone.png'
sed 's|<standard_surface|<image name="again" type="color3"><input name="file" type="filename" value="../in/a tone.png"/></image>&|
    s|nodename="tone"/>|&<input name="specular_color" type="color3" nodename="again"/>|' in/stays.mtlx >in/twice.mtlx
check 'a file that two images read is copied once' eval 'exits 0 "$mxgen" bake in/twice.mtlx -o once --copy && test "$(ls once)" = "a_tone.png
twice.mtlx" && test "$(grep -c a_tone.png once/twice.mtlx)" = 2'
rm 'in/a tone.png'
check 'a lost one is told' eval 'exits 1 "$mxgen" bake in/stays.mtlx -o none && has err "[missing-texture]" && test ! -e none'

# ---- What cannot be baked ----

cat >bad.mtlx <<'EOF'
<?xml version="1.0"?>
<materialx version="1.39">
  <viewdirection name="view" type="vector3"/>
  <convert name="seen" type="color3"><input name="in" type="vector3" nodename="view"/></convert>
  <texcoord name="place" type="vector2"/>
  <separate2 name="parts" type="multioutput"><input name="in" type="vector2" nodename="place"/></separate2>
  <ifgreater name="side" type="boolean"><input name="value1" type="float" nodename="parts" output="outx"/><input name="value2" type="float" value="0.5"/></ifgreater>
  <multiply name="wide" type="color3"><input name="in1" type="color3" value="3, 3, 3"/><input name="in2" type="float" nodename="parts" output="outy"/></multiply>
  <image name="lost" type="color3"><input name="file" type="filename" value="lost.png"/><input name="texcoord" type="vector2" nodename="twice"/></image>
  <multiply name="twice" type="vector2"><input name="in1" type="vector2" nodename="place"/><input name="in2" type="float" value="2"/></multiply>
  <standard_surface name="by_view" type="surfaceshader"><input name="coat_color" type="color3" nodename="seen"/></standard_surface>
  <standard_surface name="by_side" type="surfaceshader"><input name="thin_walled" type="boolean" nodename="side"/></standard_surface>
  <standard_surface name="by_file" type="surfaceshader"><input name="base_color" type="color3" nodename="lost"/></standard_surface>
  <standard_surface name="by_range" type="surfaceshader"><input name="base_color" type="color3" nodename="wide"/></standard_surface>
</materialx>
EOF
bad() { exits 1 "$mxgen" bake bad.mtlx -e "$1" -o none && has err "${@:2}" && test ! -e none; }
check 'what depends on the view is told with its place' bad by_view "'view' (bad.mtlx:3:3), which 'by_view/coat_color' reads" '[bake-view]'
check 'a boolean that varies is told' bad by_side '(bad.mtlx:12:57)' '[bake-type]'
check 'a missing texture is told' bad by_file 'bad.mtlx:9:' '[missing-texture]'
check 'a pattern alone has nothing to bake' bad wide '[nothing-to-bake]'
check 'values that a format cannot have are told' eval 'exits 0 "$mxgen" bake bad.mtlx -e by_range -o wide --size 8 -f png && has err "[bake-clamped]"'
cat >huge.mtlx <<'EOF'
<?xml version="1.0"?>
<materialx version="1.39">
  <ramplr name="nits" type="color3"><input name="valuel" type="color3" value="0, 0, 0"/><input name="valuer" type="color3" value="200000, 100000, 0"/></ramplr>
  <standard_surface name="SR" type="surfaceshader"><input name="emission" type="float" value="1"/><input name="emission_color" type="color3" nodename="nits"/></standard_surface>
</materialx>
EOF
# most FILE: the greatest number of an EXR
most() { python3 -c 'import sys; sys.path.insert(0, sys.argv[1]); import exr; print(max(max(row) for rows in exr.read(sys.argv[2])[2].values() for row in rows))' "$here" "$1"; }
check 'colours beyond half floats have 32 bits' eval 'exits 0 "$mxgen" bake huge.mtlx -o huge --size 8 && ! grep -q bake-clamped err && [ "$(most huge/*.exr)" = 187500.0 ]'
check 'with 16 bits they are told, and stay finite' eval 'exits 0 "$mxgen" bake huge.mtlx -o half --size 8 --depth 16 && has err "exr with 16 bits keeps those from -65504 to 65504 [bake-clamped]" && [ "$(most half/*.exr)" = 65504.0 ]'
cat >mild.mtlx <<'EOF'
<?xml version="1.0"?>
<materialx version="1.39">
  <ramplr name="ramp" type="color3"><input name="valuel" type="color3" value="0, 0, 0"/><input name="valuer" type="color3" value="1, 0.5, 0"/></ramplr>
  <standard_surface name="SR" type="surfaceshader"><input name="base_color" type="color3" nodename="ramp"/></standard_surface>
</materialx>
EOF
for row in 'png 32 8 or 16' 'exr 8 16 or 32' 'jpg 16 8' 'jpg 32 8' 'png 24 8 or 16'; do
    read -r format depth depths <<<"$row"
    check "$depth bits in $format are an error that says which it has" eval 'exits 2 "$mxgen" bake mild.mtlx -o none --size 4 -f $format --depth $depth && has err "$format has $depths bits, and not $depth" && test ! -e none'
done
check 'a depth that no format has is one, too' eval 'exits 2 "$mxgen" bake mild.mtlx -o none --size 4 --depth 24 && has err "an image has 8, 16 or 32 bits, and not 24"'
check 'only EXR has 32 bits, so images become EXR' eval 'exits 0 "$mxgen" bake mild.mtlx -o deep --size 4 --depth 32 && [ "$(ls deep)" = "$(printf "SR_base_color.exr\nmild.mtlx")" ]'
check '8 bits are those of PNG, and numbers beyond it keep theirs' eval 'exits 0 "$mxgen" bake huge.mtlx -o whole --size 8 --depth 8 && ! grep -q bake-clamped err && [ "$(most whole/*.exr)" = 187500.0 ]'
cat >outputs.mtlx <<'EOF'
<?xml version="1.0"?>
<materialx version="1.39">
  <noise2d name="waves" type="color3"/>
  <artistic_ior name="metal" type="multioutput"><input name="reflectivity" type="color3" nodename="waves"/></artistic_ior>
  <standard_surface name="SR" type="surfaceshader"><input name="base_color" type="color3" nodename="metal"/></standard_surface>
</materialx>
EOF
check 'a node of several outputs gives the first of its type' eval 'exits 0 "$mxgen" bake outputs.mtlx -o several --size 8 && test -e several/SR_base_color.exr'
sed '/^vt/d; s,/[0-9]/,//,g' plane.obj >bare.obj
check 'a mesh needs texture coordinates' eval 'exits 1 "$mxgen" bake marble.mtlx -m bare.obj -o none && has err "[no-texcoords]" && test ! -e none'
(cat plane.obj; sed -n '/^f/p' plane.obj) | sed '$ s,^f.*,f 1/1/1 3/3/1 2/2/1,' >twice.obj
check 'overlapping triangles are told' eval 'exits 0 "$mxgen" bake marble.mtlx -m twice.obj -o stone --size 16 && has err "[bake-overlap]" "50.0 percent"'
check 'a document is not written over itself' eval 'exits 1 "$mxgen" bake wall.mtlx -o . --size 8 && has err "[output-clash]" && test ! -e SR_base_color.png'
touch file
check 'a folder must be one' eval 'exits 1 "$mxgen" bake wall.mtlx -o file/in --size 8 && has err "[output-failed]"'
check 'bake without an output fails' exits 2 "$mxgen" bake wall.mtlx
check 'an unknown format fails' exits 2 "$mxgen" bake wall.mtlx -o none -f gif
finish bake
