#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Stages of USD as studios have them: mxgen bind and generate. Argument: the program.
mxgen=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"

bind() { "$mxgen" bind "$@"; }
row() { sed 's/  */ /g' out | grep -qxF "$1" || { cat out; return 1; }; }
# tells ID PLACE TEXT: the last command told a message at a place.
tells() { grep -F "[$1]" err | grep "^$2: " | grep -qF "$3" || { cat err; return 1; }; }
# fails ID ARGUMENT...
fails() { exits 1 bind "${@:2}" && grep -qF "[$1]" err; }
# values STAGE EXPRESSION: v are the values of the stacks by path of the input, t their textures.
values() {
    exits 0 "$mxgen" nothing.mtlx --stage "$1" --target vulkan -Wno-unread-input -o "$1.d" || return
    [ ! -s err ] || { cat err; return 1; }
    python3 -c "
import json
stacks = json.load(open('$1.d/bindings.json'))['stacks']
v = {x['path']: x['value'] for s in stacks for x in s['values']}
t = {x['path']: x for s in stacks for x in s['textures']}
assert $2, (v, t)"
}
echo '<materialx version="1.39"/>' >nothing.mtlx

# ---- Materials are prims ----

cat >same.usda <<'USD'
#usda 1.0
class "Prototype"
{
    def Material "paint"
    {
        token outputs:surface.connect = </Prototype/paint/s.outputs:surface>
        def Shader "s"
        {
            uniform token info:id = "UsdPreviewSurface"
            color3f inputs:diffuseColor = (1, 0, 0)
        }
    }
    def Cube "geo"
    {
        rel material:binding = </Prototype/paint>
    }
}
def Xform "a" ( references = </Prototype> )
{
    def Cube "outside"
    {
        rel material:binding = </b/mtl/paint>
    }
}
def Xform "b"
{
    def Scope "mtl"
    {
        def Material "paint"
        {
            token outputs:surface.connect = </b/mtl/paint/s.outputs:surface>
            def Shader "s"
            {
                uniform token info:id = "UsdPreviewSurface"
                color3f inputs:diffuseColor = (0, 0, 1)
            }
        }
    }
    def Cube "geo"
    {
        rel material:slotBinding:_000 = </b/mtl/paint>
    }
    def Cube "instance"
    {
        rel material:binding = </a/paint>
    }
}
USD
check 'materials of one name at two paths are two' exits 0 bind --stage same.usda
check 'a material has its path as name where others have the same' row '/a/geo [000 Prototype_paint]'
check 'the other one is another material' row '/b/geo [000 b_mtl_paint]'
check 'a binding leads out of a prototype' row '/a/outside [000 b_mtl_paint]'
check 'a binding leads to a material of an instance' row '/b/instance [000 Prototype_paint]'
check 'both materials have their values' values same.usda 'v["Prototype_paint_s/diffuseColor"] == [1, 0, 0] and v["b_mtl_paint_s/diffuseColor"] == [0, 0, 1]'
cat >same.mtlx <<'XML'
<materialx version="1.39">
  <look name="l">
    <materialassign material="paint" geom="/a"/>
  </look>
</materialx>
XML
check 'a name that two materials have is an error' fails ambiguous-material same.mtlx --stage same.usda
check 'the error has its place' tells ambiguous-material same.mtlx:3:31 "'paint' is the name of 2 materials"
check 'the error has both places' eval 'grep -q "^same.usda:4:18: note" err && grep -q "^same.usda:29:22: note" err'
sed 's/"paint"/"b_mtl_paint"/' same.mtlx >named.mtlx
check 'a look may have the name of one of them' exits 0 bind named.mtlx --stage same.usda
sed 's|<look|<surfacematerial name="paint" type="material"/>&|' same.mtlx >own.mtlx
check 'a material of the document keeps its name' exits 0 bind own.mtlx --stage same.usda
check 'it replaces those of the stage' row '/b/geo [000 paint]'
cat >names.usda <<'USD'
#usda 1.0
def Cube "x" { rel material:binding = </a> }
def Cube "y" { rel material:binding = </a_b> }
def Material "a" { token outputs:surface.connect = </a/b/c.outputs:surface>
  def Scope "b" { def Shader "c" { uniform token info:id = "UsdPreviewSurface"
    float inputs:ior = 2 } } }
def Material "a_b" { token outputs:surface.connect = </a_b/c.outputs:surface>
  def Shader "c" { uniform token info:id = "UsdPreviewSurface"
    float inputs:ior = 3 } }
USD
check 'shaders whose paths join to one name are two' values names.usda 'v["a_b_c/ior"] == 2 and v["a_b_c_2/ior"] == 3'

# ---- Layers ----

printf '#usda 1.0\ndef Xform "a" {}\ndef Cube "a" {}\n' >twice.usda
check 'a prim that stands twice is an error' fails usda-twice --stage twice.usda
check 'the error has both places' eval "tells usda-twice twice.usda:3:10 \"'a'\" && grep -q '^twice.usda:2:11: note' err"
printf '#usda 1.0\ndef Xform "\u0427\u0430\u0448\u043a\u0430" {}\ndef Xform "\u676f" {}\ndef Cube "ab" {}\n' >wide.usda
check 'names in other scripts are names' exits 0 bind --stage wide.usda
check 'columns are as wide as characters are' eval '[ "$(grep -c "^/ab     default" out)" = 1 ] && grep -qx "/Чашка  -" out && grep -qx "/杯     -" out'

# ---- Shaders of USD ----

# images: by name the depth and the type of colour of a PNG, or the components of a JPEG
python3 - <<'PY'
import struct
def png(name, depth, color):
    open(name, "wb").write(b"\x89PNG\r\n\x1a\n" + struct.pack(">I4sIIBBBBB", 13, b"IHDR", 1, 1, depth, color, 0, 0, 0) + bytes(4))
png("rgb8.png", 8, 2), png("rgba8.png", 8, 6), png("palette.png", 4, 3), png("grey8.png", 8, 0), png("rgb16.png", 16, 2)
def jpeg(name, components):
    open(name, "wb").write(b"\xff\xd8\xff\xe0" + struct.pack(">H", 16) + bytes(14) + b"\xff\xc4\x00\x04ab"
                           + b"\xff\xc0" + struct.pack(">HBHHB", 8 + 3 * components, 8, 1, 1, components) + bytes(3 * components))
jpeg("rgb.jpg", 3), jpeg("grey.jpg", 1)
PY
# preview.usda has each attribute of each shader of the specification.
cat >preview.usda <<'USD'
#usda 1.0
def Cube "x"
{
    rel material:binding = </m>
}
def Material "m"
{
    token outputs:surface.connect = </m/s.outputs:surface>
    token outputs:displacement.connect = </m/s.outputs:displacement>
    string inputs:frame:uv = "st"
    float3 inputs:tint = (0.1, 0.2, 0.3)
    def Shader "s"
    {
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor.connect = </m/t.outputs:rgb>
        color3f inputs:emissiveColor.connect = </m/glow.outputs:result>
        int inputs:useSpecularWorkflow = 1
        color3f inputs:specularColor.connect = </m.inputs:tint>
        float inputs:metallic.connect = </m/t.outputs:b>
        float inputs:roughness.connect = </m/t.outputs:g>
        float inputs:clearcoat = 0.5
        float inputs:clearcoatRoughness = 0.25
        float inputs:opacity.connect = </m/t.outputs:a>
        token inputs:opacityMode = "presence"
        float inputs:opacityThreshold = 0.125
        float inputs:ior = 1.25
        normal3f inputs:normal.connect = </m/n.outputs:rgb>
        float inputs:displacement = 0.75
        float inputs:occlusion.connect = </m/t.outputs:r>
        token outputs:surface
        token outputs:displacement
    }
    def Shader "t"
    {
        uniform token info:id = "UsdUVTexture"
        asset inputs:file = @rgb8.png@
        float2 inputs:st.connect = </m/place.outputs:result>
        token inputs:wrapS = "repeat"
        token inputs:wrapT = "mirror"
        float4 inputs:fallback = (0.5, 0.25, 0.125, 1)
        float4 inputs:scale = (2, 3, 4, 1)
        float4 inputs:bias = (5, 6, 7, 0)
        token inputs:sourceColorSpace = "sRGB"
        float outputs:r
        float outputs:g
        float outputs:b
        float outputs:a
        float3 outputs:rgb
    }
    def Shader "n"
    {
        uniform token info:id = "UsdUVTexture"
        asset inputs:file = @rgb8.png@
        token inputs:sourceColorSpace = "raw"
        float3 outputs:rgb
    }
    def Shader "place"
    {
        uniform token info:id = "UsdTransform2d"
        float2 inputs:in.connect = </m/uv.outputs:result>
        float inputs:rotation = 90
        float2 inputs:scale = (8, 9)
        float2 inputs:translation = (10, 11)
        float2 outputs:result
    }
    def Shader "uv"
    {
        uniform token info:id = "UsdPrimvarReader_float2"
        token inputs:varname.connect = </m.inputs:frame:uv>
        float2 inputs:fallback = (12, 13)
        float2 outputs:result
    }
    def Shader "glow"
    {
        uniform token info:id = "UsdPrimvarReader_float3"
        string inputs:varname = "glow"
        float3 inputs:fallback = (14, 15, 16)
        float3 outputs:result
    }
}
USD
check 'a network of all shaders of USD has its values' values preview.usda 'v["m_s/useSpecularWorkflow"] == 1 and v["m_s/clearcoat"] == 0.5 and v["m_s/clearcoatRoughness"] == 0.25 and v["m_s/opacityThreshold"] == 0.125 and v["m_s/ior"] == 1.25'
check 'opacityMode is a token' values preview.usda 'v["m_s/opacityMode"] == 1'
check 'transparent is the other one' eval 'sed "s/\"presence\"/\"transparent\"/" preview.usda >transparent.usda; values transparent.usda "v[\"m_s/opacityMode\"] == 0"'
check 'an integer is what older files have' eval 'sed "s/token inputs:opacityMode = \"presence\"/int inputs:opacityMode = 1/" preview.usda >integer.usda; values integer.usda "v[\"m_s/opacityMode\"] == 1"'
check 'wrapping has the words of USD' values preview.usda 't["m_graph/t/file"]["uaddressmode"] == "periodic" and t["m_graph/t/file"]["vaddressmode"] == "mirror"'
check 'without a word wrapping is black' values preview.usda 't["m_graph/n/file"]["uaddressmode"] == "constant" and t["m_graph/n/file"]["vaddressmode"] == "constant"'
check 'so is useMetadata, and clamp is clamp' eval 'sed "s/\"repeat\"/\"useMetadata\"/; s/\"mirror\"/\"clamp\"/" preview.usda >meta.usda; values meta.usda "t[\"m_graph/t/file\"][\"uaddressmode\"] == \"constant\" and t[\"m_graph/t/file\"][\"vaddressmode\"] == \"clamp\""'
# The fallback 0.5, 0.25, 0.125 is what the shader reads, so the border of an sRGB file is 1.055 x^(1 / 2.4) - 0.055 of it.
check 'a texture has its fallback' values preview.usda 'max(abs(a - b) for a, b in zip(t["m_graph/t/file"]["default"], [0.735357, 0.537099, 0.388573, 1])) < 1e-5'
# main STAGE: what the shaders do with their values
main() { exits 0 "$mxgen" nothing.mtlx --stage "$1" --target vulkan --interface reduced -o "$1.m" && cat "$1.m"/*.frag "$1.m"/*.vert | sed -n '/^void main/,$p' >main.txt; }
check 'a network of all shaders of USD gives a shader' main preview.usda
check 'sRGB textures are decoded before scale and bias' grep -qF 'vec4(mx_srgb_texture_to_lin_rec709(image.xyz), image.w) * vec4(2.0, 3.0, 4.0, 1.0)' main.txt
check 'raw textures are not' grep -qF 'vec3 normal_map = texture(x000_n_file' main.txt
check 'without a connection the coordinates are 0, as in USD' grep -qF 'texture(x000_n_file, vec2(0.0))' main.txt
check 'a value of them is one place' eval 'sed "/def Shader \"n\"/,/}/s/float3 outputs:rgb/&\n        float2 inputs:st = (0.25, 0.75)/" preview.usda >placed.usda; main placed.usda && grep -qF "texture(x000_n_file, vec2(0.25, 0.75))" main.txt && main preview.usda'
check 'scale and bias count' grep -qF '+ vec4(5.0, 6.0, 7.0, 0.0)' main.txt
check 'a primvar has the name that a token gives' grep -qF 'vd.geomprop_st' main.txt
check 'coordinates are scaled, turned and moved' eval 'grep -qF "scaled = vd.geomprop_st * vec2(8.0, 9.0)" main.txt && grep -qF "vec2(-scaled.y, scaled.x) + vec2(10.0, 11.0)" main.txt'
check 'a vector of three numbers is a colour' grep -qF 'vd.geomprop_glow' main.txt
check 'occlusion, which no shader shows, is told' tells unread-input preview.usda:29:15 occlusion
check 'displacement is not' eval '! grep -qF "displacement" err'
check 'displacement moves vertices' eval 'grep -qF "* 0.75)" preview.usda.m/*.vert'
check 'it does not without its terminal' eval 'sed "/outputs:displacement.connect/d" preview.usda >flat.usda; main flat.usda && ! grep -qF "0.75" flat.usda.m/*.vert'
check 'an input of the material is a colour and a vector' eval 'sed "s|normal3f inputs:normal.connect = </m/n.outputs:rgb>|normal3f inputs:normal.connect = </m.inputs:tint>|" preview.usda >both.usda; main both.usda'

# ---- UsdPreviewSurface in documents ----

# document NAME INPUTS ELEMENTS: a material whose surface and displacement are the arguments
document() {
    cat >"$1.mtlx" <<XML
<materialx version="1.39">
  <noise2d name="n" type="float"/>
  <UsdPreviewSurface name="S" type="surfaceshader">$2</UsdPreviewSurface>
  <nodegraph name="G">
    <noise2d name="n" type="float"/>
    <UsdPreviewSurface name="S" type="surfaceshader">$2</UsdPreviewSurface>
    <output name="out" type="surfaceshader" nodename="S"/>
  </nodegraph>
  $3
</materialx>
XML
    for target in vulkan osl mdl; do
        exits 0 "$mxgen" "$1.mtlx" -e M --target "$target" --interface reduced -o "$1.d" && [ ! -s err ] || return
    done
}
own='<input name="displacement" type="float" nodename="n"/>'
surface='<input name="surfaceshader" type="surfaceshader" nodename="S"/>'
check 'a material with a displacement shader' document explicit '' "<displacement name='D' type='displacementshader'>$own</displacement>
  <surfacematerial name='M' type='material'>$surface<input name='displacementshader' type='displacementshader' nodename='D'/></surfacematerial>"
check 'a material whose surface has a displacement' document implicit "$own" "<surfacematerial name='M' type='material'>$surface</surfacematerial>"
# words DIRECTORY: the words of its shaders; operands of a product may stand in another order
words() { cat "$1"/* | grep -oE '[A-Za-z0-9_.]+' | sort; }
check 'its shaders are those of the displacement shader' cmp <(words explicit.d) <(words implicit.d)
check 'it moves vertices' grep -q 'gl_Position = .*normalWorld \*' implicit.d/M.vert
check 'a surface inside a nodegraph' document nested "$own" "<surfacematerial name='M' type='material'><input name='surfaceshader' type='surfaceshader' nodegraph='G' output='out'/></surfacematerial>"
check 'it moves vertices, too' grep -q 'gl_Position = .*normalWorld \*' nested.d/M.vert

# ---- Textures of UsdPreviewSurface ----

# auto FILE: true if the texture is decoded
auto() { sed "s/@rgb8.png@/@$1@/; /inputs:sourceColorSpace = \"sRGB\"/d" preview.usda >auto.usda && main auto.usda && grep -q 'mx_srgb_texture_to_lin_rec709(' main.txt; }
for file in rgb8.png rgba8.png palette.png rgb.jpg none.jpg; do
    check "$file is sRGB where nobody says so" auto "$file"
done
for file in grey8.png rgb16.png grey.jpg none.exr; do
    check "$file is raw where nobody says so" eval "! auto $file"
done
check 'auto is what nobody says' eval 'sed "s/\"sRGB\"/\"auto\"/" preview.usda >said.usda; main said.usda && grep -q "mx_srgb_texture_to_lin_rec709(" main.txt'
for edit in 's/"repeat"/"periodic"/ wrapS 38:15' 's/"presence"/"mask"/ opacityMode 24:15' 's/"raw"/"linear"/ sourceColorSpace 54:15'; do
    read -r script input place <<<"$edit"
    check "another token of $input is an error" eval "sed '$script' preview.usda >odd.usda; fails usda-token --stage odd.usda && tells usda-token odd.usda:$place inputs:$input"
done
check 'the error lists the tokens' grep -qF 'expected one of: auto, raw, sRGB' err
cat >space.mtlx <<'XML'
<materialx version="1.39" colorspace="srgb_texture"/>
XML
check 'colours of a stage are linear beside a document' eval 'sed "s/\"presence\"/\"transparent\"/; s/color3f inputs:diffuseColor.connect = .*/color3f inputs:diffuseColor = (0.5, 0.5, 0.5)/" preview.usda >linear.usda; exits 0 "$mxgen" space.mtlx --stage linear.usda --target vulkan -o linear.d && grep -qF "\"m_s/diffuseColor\",\"value\":[0.5,0.5,0.5]" linear.d/bindings.json'

# ---- What an artist is told ----

cat >foreign.usda <<'USD'
#usda 1.0
def Cube "a" { rel material:binding = </L/m> }
def Cube "b" { rel material:binding = </L/n> }
def Scope "L" {
    def Material "m" {
        token outputs:arnold:surface.connect = </L/m/s.outputs:out>
        def Shader "s" { uniform token info:id = "arnold:standard_surface" } }
    def Material "n" {
        token outputs:surface.connect = </L/n/s.outputs:surface>
        def Shader "s" { uniform token info:id = "UsdPreviewSurface" } }
    def Material "unbound" {
        token outputs:ri:surface.connect = </L/unbound/s.outputs:out> }
}
USD
check 'a material of another renderer stops nothing' exits 0 "$mxgen" nothing.mtlx --stage foreign.usda --target vulkan -o foreign.d
check 'it is told' tells usda-material foreign.usda:5:18 "'m' has no surface that mxgen reads (it has outputs:arnold:surface)"
check 'one that nobody binds is not' test "$(grep -c '\[usda-material\]' err)" = 1
cat >white.py <<'PY'
import json
d = json.load(open("foreign.d/bindings.json"))
stack = {p["path"]: p.get("stack") for p in d["primitives"]}
program = {s["name"]: s["program"] for s in d["stacks"]}
print(open(f"foreign.d/{program[stack['/a']]}.frag").read())
PY
check 'the default substance stands in' eval 'python3 white.py | grep -q "mx_oren_nayar\|0\.31830987"'

printf '/espresso/body\n/espresso/cup\n/table\n' >espresso.txt
# warns ATTRIBUTES: a look with these attributes on an assignment, or on itself
cat >plain.mtlx <<'XML'
<materialx version="1.39">
  <surfacematerial name="Clay" type="material"/>
  <collection name="c" includegeom="/espresso" excludegeom="/espresso/body"/>
  <look name="l">
    <materialassign material="Clay" geom="/espresso"/>
    <materialassign slot="050" material="Clay" collection="c"/>
  </look>
</materialx>
XML
# edited SED: binds the look with a change
edited() { sed "$1" plain.mtlx >edited.mtlx && ! cmp -s plain.mtlx edited.mtlx && exits "${2:-0}" bind edited.mtlx --stage espresso.txt; }
check 'what matches has no warning' eval 'exits 0 bind plain.mtlx --stage espresso.txt && test ! -s err'
check 'a path that matches nothing is told' eval "edited 's|\"/espresso\"/|\"/espreso\"/|' && tells pattern-unmatched edited.mtlx:5:43 \"'/espreso' matches no primitive of the stage (did you mean '/espresso'?)\""
check 'so is one of a list' eval "edited 's|geom=\"/espresso\"/|geom=\"/table, /espresso/bodi\"/|' && tells pattern-unmatched edited.mtlx:5:43 \"did you mean '/espresso/body'\""
check 'so is a glob' eval "edited 's|geom=\"/espresso\"/|geom=\"/espresso/b?\"/|' && tells pattern-unmatched edited.mtlx:5:43 \"'/espresso/b?' matches no primitive\""
check 'so is an included path' eval "edited 's|includegeom=\"/espresso\"|includegeom=\"/espreso\"|' && tells pattern-unmatched edited.mtlx:3:37 \"'/espresso'\""
check 'so is an excluded path' eval "edited 's|/espresso/body|/espresso/bodi|' && tells pattern-unmatched edited.mtlx:3:61 \"'/espresso/body'\""
check 'a geomprefix belongs to the name' eval "edited 's|<look name=\"l\"|& geomprefix=\"/espresso/\"|; s|geom=\"/espresso\"/|geom=\"cupp\"/|' && tells pattern-unmatched edited.mtlx:5:43 \"'/espresso/cup'\""
check 'the root is always there' eval "edited 's|geom=\"/espresso\"/|geom=\"/, //, //*\"/|' && test ! -s err"
check 'a slotorder with an unknown slot is told' eval "edited 's|<look name=\"l\"|& slotorder=\"000, 05, 050\"|' && tells unused-order edited.mtlx:4:29 \"'05'\""
check 'one colon is told' eval "edited 's|\"050\"|\"050:010\"|' 1 && tells bad-slot edited.mtlx:6:27 \"has one ':', and an override has two\""
check 'several parents of a look are told' eval "edited 's|<look name=\"l\"|& inherit=\"a, b\"|' 1 && tells inherit-several edited.mtlx:4:27 'expected one'"
check 'an unknown slot is told with those there are' eval "fails unknown-slot plain.mtlx --stage espresso.txt --solo 05 && grep -qF 'it has: 000, 050' err"
check 'without --stage the message names it' eval 'exits 2 bind plain.mtlx; grep -qF -- "--stage is missing" err'
check 'a document of several looks needs none beside bindings of the stage' eval 'sed "s|</materialx>|<look name=\"k\"/>&|" plain.mtlx >two.mtlx; exits 0 bind two.mtlx --stage foreign.usda && row "/b [000 n]"'
check 'validate knows the attribute overrides' eval 'echo "<materialx version=\"1.39\"><nodegraph name=\"n\"><constant name=\"c\" type=\"float\"/><output name=\"o\" type=\"float\" nodename=\"c\" overrides=\"NG/scale\"/></nodegraph></materialx>" >over.mtlx; exits 0 "$mxgen" validate over.mtlx && test ! -s err'

cat >masks.mtlx <<'XML'
<materialx version="1.39">
  <nodegraph name="loop"><add name="a" type="float"><input name="in1" type="float" nodename="b"/></add>
    <add name="b" type="float"><input name="in1" type="float" nodename="a"/></add><output name="mask" type="float" nodename="a"/></nodegraph>
  <constant name="c" type="color3"/>
  <surface name="s" type="surfaceshader"/>
  <substance name="Dust" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s"/><input name="mask" type="float" nodename="c"/></substance>
  <look name="l"><materialassign material="Dust" geom="/table"/><materialassign slot="000::010" nodegraph="loop" geom="/table"/></look>
</materialx>
XML
check 'faults of masks and graphs stop no layers' eval 'exits 0 bind masks.mtlx --stage espresso.txt && row "/table [000 Dust] [::010 loop]"'
check 'they are found without generating' eval 'exits 1 bind masks.mtlx --stage espresso.txt --check && row "/table [000 Dust] [::010 loop]" && grep -q "^masks.mtlx:2:.*cycle" err && grep -q "^masks.mtlx:6:.*\[type-mismatch\]" err'
check 'those of a stage are found, too' eval 'sed "s|token inputs:varname.connect = </m.inputs:frame:uv>|float inputs:none = 1|" preview.usda >port.usda; exits 0 bind --stage port.usda && [ ! -s err ] && exits 0 bind --stage port.usda --check && grep -q "^port.usda:.*\[unknown-input\]" err'

cat >odd.usda <<'USD'
#usda 1.0
def Xform "s" {
    rel material:slotBinding:_050:_010 = </m>
    rel material:slotBindng:_050 = </m>
    rel material:slotBinding:_060:foo = </m>
    rel material:binding:other = </m>
    rel material:binding:collection:c = [</s.collection:c>, </m>]
    rel material:binding = </m>
    rel collection:c:includes = [</s/a>, </s/b>, </m>]
    def Cube "a" {}
}
def Material "m" { token outputs:surface.connect = </m/s.outputs:surface>
    def Shader "s" { uniform token info:id = "UsdPreviewSurface" } }
USD
check 'bindings that bind nothing are told' exits 0 bind --stage odd.usda
check 'an override with one colon' tells ignored-binding odd.usda:3:9 "':_:_010'"
check 'a misspelled word' tells ignored-binding odd.usda:4:9 "expected 'material:binding'"
check 'a purpose that a slot does not have' tells ignored-binding odd.usda:5:9 "'foo' is no purpose"
check 'other purposes of plain bindings are silent' test "$(grep -c '\[ignored-binding\]' err)" = 3
check 'a member of a collection that is missing' tells pattern-unmatched odd.usda:9:9 "'/s/b'"
check 'a material may be a member' test "$(grep -c '\[pattern-unmatched\]' err)" = 1
check 'reasons say that a collection beats a direct binding' eval "exits 0 bind --stage odd.usda --geom /s/a && grep -qF 'because at one prim a collection beats a direct binding' out"

cat >removed.usda <<'USD'
#usda 1.0
def Xform "s" {
    rel material:slotBinding:_050 = </m>
    rel material:binding = </m>
    def Cube "none" { rel material:slotBinding:_050 = None }
    def Cube "bare" { rel material:slotBinding:_050 }
    def Cube "plain" { rel material:binding }
}
def Material "m" { token outputs:surface.connect = </m/s.outputs:surface>
    def Shader "s" { uniform token info:id = "UsdPreviewSurface" } }
USD
check 'None removes a slot, and a relationship without targets, which is what flattening leaves of it' eval 'exits 0 bind --stage removed.usda && [ ! -s err ] && row "/s/none (000 m) [050 removed]" && row "/s/bare (000 m) [050 removed]"'
check 'a plain binding without targets clears nothing' row '/s/plain (000 m) (050 m)'

# ---- What is drawn, and what is not ----

cat >groups.usda <<'USD'
#usda 1.0
def Xform "set" {
    rel material:binding = </m>
    def Camera "camera" {}
    def SphereLight "light" {}
    def Scope "empty" { rel material:binding = </n> }
    def "plain" {}
    def Cube "cube" { rel material:binding = </n> }
    def Mesh "mesh" {}
}
def Xform "other" {}
def Cube "bare" {}
def Material "m" { token outputs:surface.connect = </m/s.outputs:surface>
    def Shader "s" { uniform token info:id = "UsdPreviewSurface" } }
def Material "n" { token outputs:surface.connect = </n/s.outputs:surface>
    def Shader "s" { uniform token info:id = "UsdPreviewSurface"
    float inputs:ior = 2 } }
def Material "o" { token outputs:surface.connect = </o/s.outputs:surface>
    def Shader "s" { uniform token info:id = "UsdPreviewSurface" } }
USD
check 'groups are listed' exits 0 bind --stage groups.usda --json groups.json
exits 0 bind --stage groups.usda
check 'a group without layers is no default substance' eval 'row "/other -" && row "/bare default"'
check 'a group has layers for those below' eval 'row "/set [000 m]" && row "/set/camera (000 m)"'
sed 's/"mesh"/"mesh" { rel material:binding = <\/n> } def Xform "mesh2"/' groups.usda >alone.usda
check 'a stack of groups alone gets no shader' eval 'exits 0 "$mxgen" nothing.mtlx --stage alone.usda --target vulkan -o alone.d && [ "$(ls alone.d/*.frag | wc -l)" = 2 ] && python3 -c "
import json
d = json.load(open(\"alone.d/bindings.json\"))
p = {x[\"path\"]: x for x in d[\"primitives\"]}
assert \"stack\" not in p[\"/set\"] and \"stack\" not in p[\"/set/camera\"], p
assert p[\"/set/empty\"][\"stack\"] == p[\"/set/cube\"][\"stack\"] in [s[\"name\"] for s in d[\"stacks\"]]"'

# ---- Instances of a PointInstancer ----

cat >forest.usda <<'USD'
#usda 1.0
def Xform "set" {
    def PointInstancer "forest" {
        int64[] ids = [10, 11, 12, 9007199254740993]
        int[] protoIndices = [0, 1, 0, 1]
        point3f[] positions = [(-3, 0, 0), (-1, 0, 0), (1, 0, 0), (3, 0, 0)]
        rel prototypes = [</set/forest/tree>, </set/forest/stone>]
        def Xform "tree" {
            def Cone "top" {}
            def Cylinder "trunk" {}
        }
        def Sphere "stone" {}
    }
    def PointInstancer "row" {
        int[] protoIndices = [0, 0]
        point3f[] positions = [(0, 5, 0), (0, 7, 0)]
        rel prototypes = </set/forest/stone>
    }
    def Cube "forest1" {}
}
USD
cat >forest.mtlx <<'XML'
<materialx version="1.39">
  <surfacematerial name="Red" type="material"/>
  <surfacematerial name="Green" type="material"/>
  <collection name="some" includegeom="/set/forest[11], /set/row[1]"/>
  <look name="l">
    <materialassign slot="050" material="Red" geom="/set/forest[12], /set/forest[9007199254740993]"/>
    <materialassign slot="060" material="Red" collection="some"/>
    <materialassign material="Green" geom="/set/forest//*"/>
    <materialassign material="" geom="/set/forest[11]"/>
    <materialassign slot="070" material="Red" geom="/set/forest[1]"/>
  </look>
</materialx>
XML
check 'a look names instances' exits 0 bind forest.mtlx --stage forest.usda
check 'an instance has the layers of its prototype, and its own' eval 'row "/set/forest/tree/top/set:forest[12] (000 Green) [050 Red]" && row "/set/forest/tree/trunk/set:forest[12] (000 Green) [050 Red]"'
check 'an id has as many digits as it has' row '/set/forest/stone/set:forest[9007199254740993] (000 Green) [050 Red]'
check 'an instance removes, and stands in a collection' row '/set/forest/stone/set:forest[11] [060 Red] [000 removed]'
check 'without ids its number is the id' row '/set/forest/stone/set:row[1] (000 Green) [060 Red]'
check 'the prototype stays as it is, and a leaf' row '/set/forest/stone [000 Green]'
check 'instances that nobody names are no primitives' test "$(grep -c '\[' <(grep -o '^[^ ]*\[' out))" = 5
check 'an id that the instancer lacks is told' eval "tells pattern-unmatched forest.mtlx:10:53 \"'/set/forest[1]'\" && test \$(grep -c pattern-unmatched err) = 1"
check 'in other names brackets are a pattern' eval 'sed "s|/set/forest\[1\]|/set/fores[st]1|" forest.mtlx >glob.mtlx; exits 0 bind glob.mtlx --stage forest.usda && test ! -s err'
check 'reasons for an instance' eval 'exits 0 bind glob.mtlx --stage forest.usda --geom "/set/forest/stone/set:forest[11]" && grep -q "is removed by l/#4, which stands deeper, at /set/forest/stone/set:forest\[11\]" out'
check 'USD has no place for slots of instances' eval 'exits 0 bind glob.mtlx --stage forest.usda --usda instances.usda && grep -qF "[usda-loss]" err && ! grep -q "forest_" instances.usda && grep -qxF "# left out: \"l/#1\" at \"/set/forest/stone/set:forest[9007199254740993]\": USD has no prim for an instance" instances.usda'

# ---- Composition: a stand-in for usdcat of OpenUSD ----

cat >arcs.usda <<'USD'
#usda 1.0
def Xform "set" (
    payload = @table.usda@
)
{
}
USD
printf '#usda 1.0\ndef Xform "set"\n{\n    def Cube "table" {}\n}\n' >composed.usda
printf 'PXR-USDC' >binary.usdc
mkdir bin none temp
cat >bin/usdcat <<'SH'
#!/bin/bash
printf '%s\n' "$@" >usdcat.arguments
case $USDCAT in
fail) printf 'Warning: something\n\nsyntax error on line 59\n\n'; echo 'cannot open layer @table.usda@' >&2; exit 1 ;;
nothing) exit 0 ;;
arcs) cat arcs.usda >"$4" ;;
large) while :; do head -c 1000000 /dev/zero; done >"$4" ;;
*) cat composed.usda >"$4" ;;
esac
SH
chmod +x bin/usdcat
with() { env PATH="$PWD/bin:$PATH" TMPDIR="$PWD/temp" USDCAT="$1" "$mxgen" bind --stage "${@:2}"; }
without() { env PATH="$PWD/none" "$mxgen" bind --stage "$@"; }
check 'usdcat composes a stage with arcs' exits 0 with good arcs.usda
check 'the stage is what it writes' eval 'row "/set/table default" && test ! -s err'
check 'it gets the file as one argument' eval '[ "$(sed -n "1,3p" usdcat.arguments | paste -sd" ")" = "--flatten arcs.usda --out" ]'
check 'nothing is left behind' eval '[ -z "$(ls temp)" ]'
check 'a binary stage goes the same way' eval 'exits 0 with good binary.usdc && row "/set/table default"'
check 'a name is no option and no command' eval 'cp arcs.usda "a b;touch x.usda"; exits 0 with good "a b;touch x.usda" && grep -qxF "a b;touch x.usda" usdcat.arguments && [ ! -e x.usda ]'
check 'shaders of such a stage are made' eval 'exits 0 env PATH="$PWD/bin:$PATH" "$mxgen" nothing.mtlx --stage arcs.usda --target vulkan -o arcs.d'
check 'its errors are passed on' eval "exits 1 with fail arcs.usda && grep -qF 'cannot open layer @table.usda@ [usd-flatten]' err"
check 'with the lines before the last one, which have the cause' grep -qx 'syntax error on line 59' err
check 'so is its silence' eval "exits 1 with nothing arcs.usda && grep -qF '[usd-flatten]' err"
check 'arcs in its output are errors' eval "exits 1 with arcs arcs.usda && grep -qF '[usda-arc]' err"
check 'messages name the stage, not the file that is gone' tells usda-arc 'arcs.usda as composed:2:11' "'set' has payload"
check 'its output has a limit' eval "exits 1 with large arcs.usda --max-file-size 2 && grep -F '[usd-flatten]' err | grep -qF -- '--max-file-size' && [ -z \"\$(ls temp)\" ]"
check 'a sandbox starts no program' eval "rm -f usdcat.arguments; exits 1 with good arcs.usda --sandbox && grep -qF '[usda-arc]' err && ! grep -qF 'on the path' err && [ ! -e usdcat.arguments ]"
check 'without usdcat the arc is an error' exits 1 without arcs.usda
check 'it names the arc and its place, and a cure' eval "tells usda-arc arcs.usda:2:11 \"'set' has payload\" && grep -qF \"flatten the file with 'usdcat --flatten'\" err && grep -qF 'with the program usdcat of OpenUSD on the path' err"
check 'without usdcat a binary stage is an error' eval 'exits 1 without binary.usdc && grep -qF "[usda-syntax]" err'
check 'a stage of text alone starts no program' eval 'rm -f usdcat.arguments; exits 0 with good composed.usda && [ ! -e usdcat.arguments ]'

finish usd
