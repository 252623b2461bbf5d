#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# mxgen bake (docs/bake.md) of folders, of outputs and of sets of files; meshes with mirrored, separate and flat texture coordinates; a full
# disk. Arguments: mxgen, mxgen-render, psnr.
mxgen=$(realpath "$1") render=$(realpath "$2") psnr=$(realpath "$3")
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"
has_device "$render" || { skip 'no Vulkan device'; finish bake-more; }
export MESA_SHADER_CACHE_DISABLE=true

# surface FILE NODES INPUTS: a document with one material
surface() {
    cat >"$1" <<EOF
<?xml version="1.0"?>
<materialx version="1.39">
  $2
  <standard_surface name="S" type="surfaceshader">$3</standard_surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>
EOF
}
noise='<noise2d name="n" type="float"/>'
reads_noise='<input name="base" type="float" nodename="n"/>'

# ---- Looks ----

surface looks.mtlx "$noise
  <collection name=\"parts\" includegeom=\"/a, /b\"/>
  <constant name=\"dim\" type=\"float\"/>
  <nodegraph name=\"wet\"><constant name=\"c\" type=\"float\"/><output name=\"specular_roughness\" type=\"float\" nodename=\"c\"/></nodegraph>" "$reads_noise"
sed -i 's|</materialx>|  <look name="S_base"><materialassign name="m" material="M" collection="parts"/></look>\n  <look name="wet_look" inherit="S_base"><materialassign name="w" slot="000::010" nodegraph="wet" geom="/a"/><visibility name="v" geom="/b" visible="false"/></look>\n&|' looks.mtlx
check 'looks and collections stay' eval 'exits 0 "$mxgen" bake looks.mtlx -o looks --size 4 && has looks/looks.mtlx "<collection name=\"parts\"" "<materialassign name=\"m\" material=\"M\" collection=\"parts\"/>" "<visibility name=\"v\""'
check 'names of images do not take theirs' eval 'has looks/looks.mtlx "<look name=\"S_base\">" && ! grep -q "<image name=\"S_base\"" looks/looks.mtlx && exits 0 "$mxgen" validate looks/looks.mtlx'
check 'a layer that is a nodegraph is told' eval '"$mxgen" bake looks.mtlx -o looks --size 4 2>err; has err "'"'wet_look/w' (looks.mtlx:"'" "changes inputs that are baked [bake-look]" && ! grep -q wet\" looks/looks.mtlx'

sed 's|version="1.39"|& geomprefix="/x/"|; s|includegeom="/a, /b"|includegeom="a" excludegeom="b"|' looks.mtlx >prefix.mtlx
check 'and the geomprefix of the document' eval 'exits 0 "$mxgen" bake prefix.mtlx -o prefix --size 4 && has prefix/prefix.mtlx "<collection name=\"parts\" includegeom=\"a\" excludegeom=\"b\" geomprefix=\"/x/\"/>"'

# Names that a document cannot have give way to those that it can, and looks follow.
material_of() { # NAME NUMBER COLOUR
    printf '<checkerboard name="k%s" type="color3"><input name="color1" type="color3" value="%s"/></checkerboard>' "$2" "$3"
    printf '<standard_surface name="S%s" type="surfaceshader"><input name="base_color" type="color3" nodename="k%s"/></standard_surface>' "$2" "$2"
    printf '<surfacematerial name="%s" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S%s"/></surfacematerial>' "$1" "$2"
}
{
    echo '<materialx version="1.39">'
    material_of 'a b' 1 '1, 0, 0'
    material_of a_b 2 '0, 1, 0'
    material_of 1a 3 '0, 0, 1'
    material_of c/d 4 '1, 1, 0'
    echo '<look name="L"><materialassign name="m1" material="a_b" geom="/x"/><materialassign name="m2" material="a b" geom="/y"/><materialassign name="m3" material="1a" geom="/z"/><materialassign name="m4" material="c/d" geom="/w"/></look></materialx>'
} >names.mtlx
check 'materials of unusual names are baked' exits 0 "$mxgen" bake names.mtlx -o names --size 4
check 'a valid name stays' has names/names.mtlx '"a_b" type="material"' 'name="m1" material="a_b"'
check 'and looks name the others as they are now' has names/names.mtlx 'name="m2" material="a_b_2"' 'name="m3" material="_1a"' 'name="m4" material="c_d"'

# ---- Folders ----

mkdir -p many/wood/deep many/faulty
surface many/a.mtlx "$noise" "$reads_noise"
surface many/wood/deep/b.mtlx '' '<input name="base" type="float" value="0.5"/>'
surface many/faulty/c.mtlx '<viewdirection name="n" type="vector3"/>' '<input name="normal" type="vector3" nodename="n"/>'
echo '<materialx version="1.39"><nodedef name="ND_x" node="x"><output name="out" type="float"/></nodedef></materialx>' >many/library.mtlx
check 'a folder is baked, and what fails in it is told' exits 1 "$mxgen" bake many -o many/flat --size 8
check 'with its place, and a sum' has err 'many/faulty/c.mtlx:3:' '[bake-view]' "note: 'many/library.mtlx' has no material and no output" '2 baked, 1 failed, 1 without anything to bake'
check 'documents stand where they stood' test "$(cd many/flat && find . -type f | sort | tr '\n' ' ')" = './S_base.exr ./a.mtlx ./wood/deep/b.mtlx '
check 'and nothing is left of the failure' test ! -e many/flat/faulty
rm -r many/faulty
check 'a second time, the output is no input' eval 'exits 0 "$mxgen" bake many/ -o many/flat --size 8 && has err "2 baked, 0 failed, 1 without" && test ! -e many/flat/flat'
mkdir empty
check 'a folder without documents' eval 'exits 1 "$mxgen" bake empty -o none && has err "[file-unreadable]" && test ! -e none'
check 'one element of a folder is none' exits 2 "$mxgen" bake many -o none -e M

# ---- Outputs ----

cat >outputs.mtlx <<'EOF'
<?xml version="1.0"?>
<materialx version="1.39">
  <nodegraph name="NG">
    <noise2d name="n" type="color3"/>
    <constant name="c" type="float"><input name="value" type="float" value="0.5"/></constant>
    <output name="color" type="color3" nodename="n"/>
    <output name="plain" type="float" nodename="c"/>
    <input name="tint" type="color3" value="1, 0.5, 0"/>
    <output name="tinted" type="color3" interfacename="tint"/>
    <output name="place" type="vector3" value="1, 2, 3"/>
  </nodegraph>
  <output name="level" type="float" value="0.25"/>
  <output name="nothing" type="float"/>
  <fractal2d name="f" type="float"/>
  <output name="top" type="float" nodename="f"/>
</materialx>
EOF
check 'without a material, outputs are baked' exits 0 "$mxgen" bake outputs.mtlx -o outs --size 16
check 'the document has them' has outs/outputs.mtlx '<output name="NG_color" type="color3" nodename="NG_color_image"/>' \
    '<output name="top" type="float" nodename="top_image"/>' '<input name="value" type="float" value="0.5"/>' '<output name="NG_plain" type="float" nodename="NG_plain_value"/>'
check 'outputs that have values alone, too' eval 'has outs/outputs.mtlx "name=\"value\" type=\"vector3\" value=\"1, 2, 3\"" "name=\"value\" type=\"color3\" value=\"1, 0.5, 0\"" "name=\"value\" type=\"float\" value=\"0.25\"" "<output name=\"NG_place\"" "<output name=\"NG_tinted\"" "<output name=\"level\"" && ! grep -q nothing outs/outputs.mtlx'
check 'and is valid' exits 0 "$mxgen" validate outs/outputs.mtlx -Werror
check 'one output is baked alone' eval 'exits 0 "$mxgen" bake outputs.mtlx -e top -o one --size 16 && test "$(ls one | tr "\n" " ")" = "outputs.mtlx top_image.exr "'
"$render" outputs.mtlx -e NG/n --scene plane -s 16 -q -o live.exr
check 'files of OpenEXR have no date' eval '! grep -qa capDate live.exr && ! grep -qa capDate outs/NG_color_image.exr'
check 'its image is the pattern' "$psnr" --at-least 45 live.exr outs/NG_color_image.exr

# ---- Sets of files ----

mkdir -p tx
for name in wood.1001.png wood.1012.png wood.old.png fire_7.png fire_12.png; do echo "$name" >tx/$name; done
sets='<image name="i" type="color3"><input name="file" type="filename" value="tx/wood.&lt;UDIM&gt;.png"/></image>
  <image name="f" type="float"><input name="file" type="filename" value="tx/fire_{0Nframe}.png"/></image>'
surface sets.mtlx "$sets" '<input name="base_color" type="color3" nodename="i"/><input name="base" type="float" nodename="f"/>'
check 'tiles and frames are copied' exits 0 "$mxgen" bake sets.mtlx -o copies --copy
check 'all of them, and no other' test "$(ls copies | tr '\n' ' ')" = 'fire_12.png fire_7.png sets.mtlx wood.1001.png wood.1012.png '
check 'each is its own' eval 'cmp tx/wood.1012.png copies/wood.1012.png && cmp tx/fire_7.png copies/fire_7.png'
check 'the document names them' has copies/sets.mtlx 'value="wood.&lt;UDIM&gt;.png"' 'value="fire_{0Nframe}.png"'
rm tx/fire_*
check 'a set without files is told' eval 'exits 1 "$mxgen" bake sets.mtlx -o none --copy && has err "[missing-texture]" "fire_{0Nframe}.png" && test ! -e none'

# ---- Tiles ----

# The tiles of a drawing are those of its own textures, also where these have one texel each.
gray() { printf 'P2 %s %s 255 %s\n' "$2" "$2" "$3" >"$1"; }
gray plain.pgm 2 '10 20 30 40'
gray tile.1001.pgm 1 51
gray tile.1012.pgm 1 204
doubled() { # NAME FILE
    printf '<image name="%s" type="float"><input name="file" type="filename" value="%s"/></image>' "$1" "$2"
    printf '<multiply name="%s_2" type="float"><input name="in1" type="float" nodename="%s"/><input name="in2" type="float" value="0.5"/></multiply>' "$1" "$1"
}
surface tiled.mtlx "$(doubled a plain.pgm) $(doubled t 'tile.&lt;UDIM&gt;.pgm')" '<input name="base" type="float" nodename="a_2"/><input name="metalness" type="float" nodename="t_2"/>'
check 'a set of tiles and an image beside it are baked' exits 0 "$mxgen" bake tiled.mtlx -o tiled -f exr --depth 32
check 'each has its own files' test "$(ls tiled | tr '\n' ' ')" = 'S_base.exr S_metalness.1001.exr S_metalness.1012.exr tiled.mtlx '
reads() { # FILE X Y VALUE
    python3 "$here/exr.py" "$1" R "$2" "$3" | awk -v b="$4" '{ d = $1 - b; exit !(d * d < 1e-6) }'
}
check 'the image has its own size and values' eval "reads tiled/S_base.exr 1 1 $(awk 'BEGIN { print 20 / 255 }')"
check 'and so have the tiles' eval 'reads tiled/S_metalness.1001.exr 0 0 0.1 && reads tiled/S_metalness.1012.exr 0 0 0.4'

gray lone.1001.pgm 2 '10 20 30 40'
surface lone.mtlx "$(doubled t 'lone.&lt;UDIM&gt;.pgm')" '<input name="metalness" type="float" nodename="t_2"/>'
check 'a set whose only tile is 1001 is baked' exits 0 "$mxgen" bake lone.mtlx -o lone -f exr
check 'and stays a set, which does not repeat' eval 'test "$(ls lone | tr "\n" " ")" = "S_metalness.1001.exr lone.mtlx " && grep -q "value=\"S_metalness.&lt;UDIM&gt;.exr\"" lone/lone.mtlx'
check 'files of glTF have no sets, so it is an image there' eval 'exits 0 "$mxgen" export lone.mtlx -m plane -o lone.glb'

# ---- Channels ----

echo '<materialx version="1.39"><texcoord name="t" type="vector2"/><separate2 name="s" type="multioutput"><input name="in" type="vector2" nodename="t"/></separate2>
  <combine4 name="c" type="color4"><input name="in4" type="float" nodename="s" output="outx"/></combine4><output name="o" type="color4" nodename="c"/></materialx>' >four.mtlx
check 'four channels are baked beside JPEG' exits 0 "$mxgen" bake four.mtlx -o four -s 2 -f jpg
check 'and keep the fourth one' eval 'test "$(ls four | tr "\n" " ")" = "four.mtlx o_image.exr " && python3 "$here/exr.py" four/o_image.exr A 0.9 0.5 | awk "{ exit !(\$1 > 0.7 && \$1 < 0.8) }"'

# ---- Meshes ----

# Two squares side by side; the second has the texture coordinates of its mirror image.
cat >mirrored.obj <<'EOF'
v -1 -1 0
v 0 -1 0
v 0 1 0
v -1 1 0
v 1 -1 0
v 1 1 0
vt 0.02 0.02
vt 0.48 0.02
vt 0.48 0.98
vt 0.02 0.98
vt 0.98 0.02
vt 0.52 0.02
vt 0.52 0.98
vt 0.98 0.98
vn 0 0 1
f 1/1/1 2/2/1 3/3/1 4/4/1
f 2/5/1 5/6/1 6/7/1 3/8/1
EOF
# looks_like LEAST SOURCE FLAT MESH: pictures of both on the mesh
looks_like() {
    "$render" "$2" -m "$4" -s 96 -q -o source.exr && "$render" "$3" -m "$4" -s 96 -q -o flat.exr && "$psnr" --at-least "$1" source.exr flat.exr
}
# differs: red to the right in the first half of the map, and to the left in the second
differs() {
    local first second
    first=$(python3 "$here/exr.py" mirrored/S_normal.exr R 0.25 0.5) && second=$(python3 "$here/exr.py" mirrored/S_normal.exr R 0.75 0.5) || return
    awk -v a="$first" -v b="$second" 'BEGIN { exit !(a - 0.5 > 0.1 && b - 0.5 < -0.1) }'
}
surface leaning.mtlx '<constant name="n" type="vector3"><input name="value" type="vector3" value="0.3, 0.2, 0.9327"/></constant>
  <normalize name="l" type="vector3"><input name="in" type="vector3" nodename="n"/></normalize>' '<input name="normal" type="vector3" nodename="l"/>'
check 'a direction is baked on mirrored texture coordinates' exits 0 "$mxgen" bake leaning.mtlx -m mirrored.obj -o mirrored --size 32 -f exr
check 'the map differs between the halves' differs
check 'and both look as the direction does' looks_like 45 leaning.mtlx mirrored/leaning.mtlx mirrored.obj

# 36 squares that touch each other on the surface, and not in the image. Its corners lie at the distance 1, so pictures do not scale it.
python3 - >islands.obj <<'EOF'
n, side = 6, 2 ** 0.5
for y in range(n):
    for x in range(n):
        for dx, dy in ((0, 0), (1, 0), (1, 1), (0, 1)):
            print("v", side * ((x + dx) / n - 0.5), side * ((y + dy) / n - 0.5), 0)
            print("vt", ((x * 5 + 2) % n + 0.15 + 0.7 * dx) / n, ((y * 5 + 3) % n + 0.15 + 0.7 * dy) / n)
print("vn 0 0 1")
for i in range(n * n):
    print("f", *(f"{4 * i + k}/{4 * i + k}/1" for k in (1, 2, 3, 4)))
EOF
surface place.mtlx '<position name="p" type="vector3"/>
  <multiply name="h" type="vector3"><input name="in1" type="vector3" nodename="p"/><input name="in2" type="float" value="0.4"/></multiply>
  <add name="a" type="vector3"><input name="in1" type="vector3" nodename="h"/><input name="in2" type="float" value="0.5"/></add>
  <convert name="c" type="color3"><input name="in" type="vector3" nodename="a"/></convert>' \
    '<input name="base_color" type="color3" nodename="c"/><input name="specular" type="float" value="0"/>'
check 'a mesh of islands is baked' exits 0 "$mxgen" bake place.mtlx -m islands.obj -o islands --size 48
check 'no seam shows' looks_like 50 place.mtlx islands/place.mtlx islands.obj
check 'without padding seams would' eval 'exits 0 "$mxgen" bake place.mtlx -m islands.obj -o bare --size 48 --padding 0 && ! looks_like 50 place.mtlx bare/place.mtlx islands.obj'

sed '/^f 2/ s,2/5/1 5/6/1 6/7/1 3/8/1,2/5/1 5/6/1 6/5/1,' mirrored.obj >part.obj
check 'a triangle without an area in the image is told' eval 'exits 0 "$mxgen" bake place.mtlx -m part.obj -o part --size 16 && has err "1 of the 3 triangles" "[bake-degenerate]"'
sed 's,^vt.*,vt 0.5 0.5,' mirrored.obj >point.obj
check 'and a mesh of them is an error' eval 'exits 1 "$mxgen" bake place.mtlx -m point.obj -o none && has err "[no-texcoords]" "no triangle" && test ! -e none'

# ---- A full disk ----

mkdir kept
echo mine >kept/mine.txt
surface noisy.mtlx "$noise" "$reads_noise"
full() { (ulimit -f 2 && exits 1 "$mxgen" bake noisy.mtlx -o kept --size 256); }
check 'a disk that is full in the middle is told' eval 'full && has err "error:" "kept"'
check 'and the folder is as it was' test "$(ls -A kept)" = mine.txt
finish bake-more
