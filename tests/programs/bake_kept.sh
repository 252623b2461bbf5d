#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# mxgen bake (docs/bake.md): what stays in the new document: names with a namespace, tokens, facts of geometries. Arguments: mxgen,
# mxgen-render.
mxgen=$(realpath "$1") render=$(realpath "$2")
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"
has_device "$render" || { skip 'no Vulkan device'; sed 's/height="4"/height="8"/' asks.mtlx >square.mtlx
check 'a square image has the size and the bits that its output asks for' eval 'exits 0 "$mxgen" bake square.mtlx -e g/o -o square -f png && ! grep -e width -e height -e bitdepth err && [ "$(od -An -tu1 -j16 -N9 square/*.png | tr -s " ")" = " 0 0 0 8 0 0 0 8 16" ]'
check 'bits that the format lacks are told' eval 'exits 0 "$mxgen" bake square.mtlx -e g/o -o jpeg -f jpg && has err "asks for bitdepth '"'16'"', and its image has '"'8'"'" && ! grep width err'
finish bake-kept; }
export MESA_SHADER_CACHE_DISABLE=true

gray() { printf 'P2 %s %s 255 %s\n' "$2" "$2" "$3" >"$1"; }

# ---- Namespaces ----

# Names of an include with a namespace are those by which looks know them.
mkdir -p show/tx
gray show/tx/a.pgm 1 51
cat >show/parts.mtlx <<'EOF'
<materialx version="1.39" namespace="parts" fileprefix="tx/">
  <image name="im" type="float"><input name="file" type="filename" value="a.pgm"/></image>
  <noise2d name="k" type="color3"/>
  <nodedef name="ND_own" node="own"><output name="out" type="surfaceshader"/></nodedef>
  <nodegraph name="NG_own" nodedef="ND_own"><image name="i" type="float"><input name="file" type="filename" value="a.pgm"/></image>
    <surface_unlit name="s" type="surfaceshader"><input name="emission" type="float" nodename="i"/></surface_unlit><output name="out" type="surfaceshader" nodename="s"/></nodegraph>
  <own name="O" type="surfaceshader"/>
  <surfacematerial name="Own" type="material"><input name="surfaceshader" type="surfaceshader" nodename="O"/></surfacematerial>
  <standard_surface name="S" type="surfaceshader"><input name="base" type="float" nodename="im"/><input name="base_color" type="color3" nodename="k"/></standard_surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>
EOF
cat >show.mtlx <<'EOF'
<materialx version="1.39" xmlns:xi="http://www.w3.org/2001/XInclude">
  <xi:include href="show/parts.mtlx"/>
  <standard_surface name="S" type="surfaceshader"><input name="base" type="float" value="0.5"/></standard_surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
  <look name="L"><materialassign name="a" material="parts:M" geom="/a"/><materialassign name="b" material="M" geom="/b"/></look>
</materialx>
EOF
check 'an include with a namespace is baked' exits 0 "$mxgen" bake show.mtlx -o shown --size 4
check 'its elements keep their names, and images have those of files' has shown/show.mtlx '<surfacematerial name="parts:M"' 'nodename="parts:S"' '<image name="parts:im"' '<image name="parts_S_base_color"' 'material="parts:M" geom="/a"' 'material="M" geom="/b"'
printf '/a\n/b\n' >stage.txt
check 'a look finds them' exits 0 "$mxgen" bind shown/show.mtlx --stage stage.txt --look L
textures_of() { # FILE ELEMENT: the textures of its shader
    rm -rf reflected
    "$mxgen" "$1" -e "$2" -t glsl --reflect -o reflected >log 2>&1 && cat reflected/*.json
}
check 'a definition has its files, with the prefix once' eval 'textures_of shown/show.mtlx parts:Own >told && has told "\"file\": \"../show/tx/a.pgm\""'
check 'and USD has their graphs' eval 'exits 0 "$mxgen" export show.mtlx -e parts:M --size 4 -o show.usda && ! grep export-loss err'

# ---- Tokens ----

gray t_hi.pgm 1 200
gray t_lo.pgm 1 20
cat >tokens.mtlx <<'EOF'
<materialx version="1.39">
  <nodedef name="ND_p" node="p"><token name="R" type="string" value="lo"/><output name="out" type="surfaceshader"/></nodedef>
  <nodegraph name="NG_p" nodedef="ND_p"><image name="i" type="float"><input name="file" type="filename" value="t_[R].pgm"/></image>
    <surface_unlit name="s" type="surfaceshader"><input name="emission" type="float" nodename="i"/></surface_unlit><output name="out" type="surfaceshader" nodename="s"/></nodegraph>
  <p name="P" type="surfaceshader"><token name="R" type="string" value="hi"/></p>
  <surfacematerial name="Own" type="material"><input name="surfaceshader" type="surfaceshader" nodename="P"/></surfacematerial>
  <nodegraph name="g"><token name="Q" type="string" value="hi"/>
    <p name="P" type="surfaceshader"><token name="R" type="string" interfacename="Q"/></p><output name="out" type="surfaceshader" nodename="P"/>
    <image name="i" type="float"><input name="file" type="filename" value="t_[Q].pgm"/></image><output name="n" type="float" nodename="i"/></nodegraph>
  <surfacematerial name="Outer" type="material"><input name="surfaceshader" type="surfaceshader" nodegraph="g" output="out"/></surfacematerial>
  <image name="i" type="float"><input name="file" type="filename" value="[A][B].pgm"/><token name="A" type="string" value="t_"/><token name="B" type="string" value="hi"/></image>
  <standard_surface name="S" type="surfaceshader"><input name="base" type="float" nodename="i"/><input name="metalness" type="float" nodegraph="g" output="n"/></standard_surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>
EOF
check 'a document with tokens is baked' exits 0 "$mxgen" bake tokens.mtlx -o tokens
check 'a node keeps its token' eval 'textures_of tokens/tokens.mtlx Own >told && has told t_hi.pgm && ! grep t_lo.pgm told'
check 'and one that names a token around it the value' eval 'textures_of tokens/tokens.mtlx Outer >told && has told t_hi.pgm && ! grep t_lo.pgm told'
check 'files of images that stay have the values of tokens' eval 'has tokens/tokens.mtlx "value=\"../t_hi.pgm\"" && ! grep -q "value=\"[^\"]*\[[AQ]" tokens/tokens.mtlx'
check 'also as copies' eval 'exits 0 "$mxgen" bake tokens.mtlx -e M -o token_copies --copy && test "$(ls token_copies | tr "\n" " ")" = "t_hi.pgm tokens.mtlx "'
check 'and in other formats' exits 0 "$mxgen" export tokens.mtlx -e M -o tokens.glb

# ---- Facts of geometries ----

cat >facts.mtlx <<'EOF'
<materialx version="1.39">
  <attributedef name="AD" attrname="grade" type="string" value=""/>
  <geompropdef name="wear" type="float" unittype="distance" unit="centimeter"/>
  <geominfo name="gi" geom="/a"><geomprop name="wear" type="float" value="0.5"/><token name="txt" type="string" value="hi"/></geominfo>
  <tokendefault name="txt" type="string" value="lo"/>
  <image name="i" type="float" grade="A"><input name="file" type="filename" value="t_&lt;txt&gt;.pgm"/></image>
  <standard_surface name="S" type="surfaceshader"><input name="base" type="float" nodename="i"/></standard_surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>
EOF
check 'what a document says of geometries stays' eval 'exits 0 "$mxgen" bake facts.mtlx -o facts && has facts/facts.mtlx "<geominfo name=\"gi\" geom=\"/a\">" "<geomprop name=\"wear\" type=\"float\" value=\"0.5\"/>" "<token name=\"txt\" type=\"string\" value=\"hi\"/>" "<geompropdef" "<tokendefault" "<attributedef"'
check 'without new warnings' exits 0 "$mxgen" validate facts/facts.mtlx -Werror

# ---- What outputs ask for ----

cat >asks.mtlx <<'EOF'
<materialx version="1.39">
  <nodegraph name="g">
    <noise2d name="n" type="color3"><input name="amplitude" type="vector3" value="0.3, 0.3, 0.3"/><input name="pivot" type="float" value="0.5"/></noise2d>
    <output name="o" type="color3" nodename="n" colorspace="acescg" width="8" height="4" bitdepth="16"/>
    <output name="p" type="color3" nodename="n" colorspace="srgb_texture" width="8" height="8" bitdepth="8"/>
  </nodegraph>
  <standard_surface name="S" type="surfaceshader"><input name="base_color" type="color3" nodegraph="g" output="o"/></standard_surface>
</materialx>
EOF
asks() { has err "'g/o' (asks.mtlx:4:5) asks for height '4', and its image has '8'" "asks for bitdepth '16', and its image has '8'" "asks for colorspace 'acescg', and its image has 'srgb_texture'" "[bake-output]" && ! grep -e width -e g/p err; }
check 'an output that asks for another image is told' eval 'exits 0 "$mxgen" bake asks.mtlx -e g/o -o asks --size 8 --depth 8 -f png && asks'
check 'also where a surface reads it' eval 'exits 0 "$mxgen" bake asks.mtlx -e S -o asks_s --size 8 --depth 8 -f png && asks'
check 'and one that has what it asks for is not' eval 'exits 0 "$mxgen" bake asks.mtlx -e g/p -o asks_p --size 8 -f png && ! grep warning err'
finish bake-kept
