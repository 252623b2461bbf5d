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
    exits 0 "$mxgen" nothing.mtlx --stage "$1" --target vulkan -o "$1.d" || return
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
check 'columns are as wide as characters are' eval '[ "$(grep -c "^/ab     default" out)" = 1 ] && grep -qx "/Чашка  default" out && grep -qx "/杯     default" out'

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
check 'a texture has its fallback' values preview.usda 't["m_graph/t/file"]["default"] == [0.5, 0.25, 0.125, 1]'
# main STAGE: what the shaders do with their values
main() { exits 0 "$mxgen" nothing.mtlx --stage "$1" --target vulkan --interface reduced -o "$1.m" && cat "$1.m"/*.frag "$1.m"/*.vert | sed -n '/^void main/,$p' >main.txt; }
check 'a network of all shaders of USD gives a shader' main preview.usda
check 'sRGB textures are decoded before scale and bias' grep -qF 'vec4(mx_srgb_texture_to_lin_rec709(image.xyz), image.w) * vec4(2.0, 3.0, 4.0, 1.0)' main.txt
check 'raw textures are not' grep -qF 'vec3 normal_map = texture(x000_n_file' main.txt
check 'scale and bias count' grep -qF '+ vec4(5.0, 6.0, 7.0, 0.0)' main.txt
check 'a primvar has the name that a token gives' grep -qF 'vd.geomprop_st' main.txt
check 'coordinates are scaled, turned and moved' eval 'grep -qF "scaled = vd.geomprop_st * vec2(8.0, 9.0)" main.txt && grep -qF "vec2(-scaled.y, scaled.x) + vec2(10.0, 11.0)" main.txt'
check 'a vector of three numbers is a colour' grep -qF 'vd.geomprop_glow' main.txt
check 'displacement moves vertices' eval 'grep -qF "* 0.75)" preview.usda.m/*.vert'
check 'it does not without its terminal' eval 'sed "/outputs:displacement.connect/d" preview.usda >flat.usda; main flat.usda && ! grep -qF "0.75" flat.usda.m/*.vert'
check 'an input of the material is a colour and a vector' eval 'sed "s|normal3f inputs:normal.connect = </m/n.outputs:rgb>|normal3f inputs:normal.connect = </m.inputs:tint>|" preview.usda >both.usda; main both.usda'
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

finish usd
