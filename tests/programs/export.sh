#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# mxgen export (docs/export.md): files are valid, values and texels are those of the document, and losses are told. Arguments: mxgen,
# mxgen-render, psnr, the root.
mxgen=$(realpath "$1") render=$(realpath "$2") psnr=$(realpath "$3") root=$(realpath "$4")
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"
has_device "$render" || { skip 'no Vulkan device'; finish export; }
export MESA_SHADER_CACHE_DISABLE=true TMPDIR=$work/temporary
mkdir "$TMPDIR"

valid() { # FILE...: by Khronos' validator
    NODE_PATH=$root/tests/npm/node_modules node "$here/validate_gltf.cjs" "$@"
}
member() { # FILE PATH JSON
    local got
    got=$(python3 "$here/gltf.py" "$1" get "$2") && [ "$got" = "$3" ] || { echo "'$got' instead of '$3'"; false; }
}
lacks() { ! python3 "$here/gltf.py" "$1" get "$2"; }
texel() { # FILE PATH X Y VALUE...: bytes, each within 1
    local file=$1 path=$2 x=$3 y=$4 got
    shift 4
    got=$(python3 "$here/gltf.py" "$file" texel "$path" "$x" "$y") || return
    echo "$got" "$@" | awk '{ if (NF % 2) exit 1; for (i = 1; i <= NF / 2; ++i) { d = $i - $(i + NF / 2); if (d * d > 1) bad = 1 } if (bad) print; exit bad }'
}

# u and v, from the bottom left, and numbers made of them: at the texel (0.25, 0.25) from the top left of 4 x 4, u is 0.375 and v 0.625.
cat >all.mtlx <<'EOF'
<?xml version="1.0"?>
<materialx version="1.39" colorspace="lin_rec709">
  <texcoord name="place" type="vector2"/>
  <separate2 name="parts" type="multioutput"><input name="in" type="vector2" nodename="place"/></separate2>
  <combine3 name="tone" type="color3">
    <input name="in1" type="float" nodename="parts" output="outx"/>
    <input name="in2" type="float" nodename="parts" output="outy"/>
    <input name="in3" type="float" value="0.25"/>
  </combine3>

  <multiply name="right" type="float"><input name="in1" type="float" nodename="parts" output="outx"/><input name="in2" type="float" value="0.5"/></multiply>
  <multiply name="up" type="float"><input name="in1" type="float" nodename="parts" output="outy"/><input name="in2" type="float" value="0.8"/></multiply>
  <multiply name="bright" type="color3"><input name="in1" type="color3" nodename="tone"/><input name="in2" type="float" value="8"/></multiply>
  <multiply name="film" type="float"><input name="in1" type="float" nodename="up"/><input name="in2" type="float" value="1000"/></multiply>
  <combine3 name="bumps" type="vector3"><input name="in1" type="float" nodename="right"/><input name="in2" type="float" value="0.5"/><input name="in3" type="float" value="1"/></combine3>
  <normalmap name="map" type="vector3"><input name="in" type="vector3" nodename="bumps"/><input name="scale" type="float" value="0.5"/></normalmap>
  <gltf_pbr name="S" type="surfaceshader">
    <input name="base_color" type="color3" nodename="tone"/>
    <input name="alpha" type="float" nodename="right"/>
    <input name="alpha_mode" type="integer" value="1"/>
    <input name="alpha_cutoff" type="float" value="0.3"/>
    <input name="metallic" type="float" value="0.25"/>
    <input name="roughness" type="float" nodename="up"/>
    <input name="occlusion" type="float" nodename="right"/>
    <input name="normal" type="vector3" nodename="map"/>
    <input name="emissive" type="color3" nodename="bright"/>
    <input name="emissive_strength" type="float" value="2"/>
    <input name="ior" type="float" value="1.7"/>
    <input name="specular" type="float" nodename="right"/>
    <input name="specular_color" type="color3" nodename="bright"/>
    <input name="clearcoat" type="float" value="0.5"/>
    <input name="clearcoat_roughness" type="float" nodename="up"/>
    <input name="clearcoat_normal" type="vector3" nodename="map"/>
    <input name="sheen_color" type="color3" value="0.1, 0.2, 0.3"/>
    <input name="sheen_roughness" type="float" nodename="up"/>
    <input name="iridescence" type="float" value="0.6"/>
    <input name="iridescence_thickness" type="float" nodename="film"/>
    <input name="anisotropy_strength" type="float" value="0.6"/>
    <input name="anisotropy_rotation" type="float" nodename="up"/>
  </gltf_pbr>
  <surfacematerial name="All" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
  <gltf_pbr name="G" type="surfaceshader">
    <input name="metallic" type="float" value="0"/>
    <input name="alpha" type="float" nodename="right"/>
    <input name="clearcoat_roughness" type="float" nodename="up"/>
    <input name="transmission" type="float" nodename="up"/>
    <input name="thickness" type="float" value="0.5"/>
    <input name="attenuation_distance" type="float" value="0.3"/>
    <input name="attenuation_color" type="color3" value="0.1, 0.9, 0.3"/>
    <input name="dispersion" type="float" value="0.4"/>
    <input name="emissive" type="color3" value="0, 4, 2"/>
  </gltf_pbr>
  <surfacematerial name="Glass" type="material"><input name="surfaceshader" type="surfaceshader" nodename="G"/></surfacematerial>
</materialx>
EOF
mkdir out1
check 'a document is exported' exits 0 "$mxgen" export all.mtlx -o 'out1/all of it.gltf' --size 4 -Werror
check 'and as one file' exits 0 "$mxgen" export all.mtlx -o all.glb --size 4 -Werror
check 'nothing else is left' eval 'test "$(ls -A "$TMPDIR" | wc -l)" = 0 && test "$(ls out1 | wc -l)" = 12'
all=materials/All glass=materials/Glass
for file in 'out1/all of it.gltf' all.glb; do
    base=$all/pbrMetallicRoughness
    check "$file: colors are sRGB, and alpha is not" texel "$file" $base/baseColorTexture 0.25 0.25 165 206 137 48
    check "$file: occlusion, roughness and metallic are one image" texel "$file" $base/metallicRoughnessTexture 0.25 0.25 48 128 255
done
file=all.glb
check 'a value beside a texture is its factor' member $file $base/metallicFactor 0.25
check 'what is a texture alone has no factor' lacks $file $base/roughnessFactor
check 'occlusion is the same texture' member $file $all/occlusionTexture "$(python3 "$here/gltf.py" $file get $base/metallicRoughnessTexture)"
check 'a mask has its cutoff' eval "member $file $all/alphaMode '\"MASK\"' && member $file $all/alphaCutoff 0.3"
check 'a map of normals keeps its numbers' texel $file $all/normalTexture 0.25 0.25 48 128 255
check 'and its scale' member $file $all/normalTexture/scale 0.5
check 'emission above 1 is strength' member $file $all/extensions/KHR_materials_emissive_strength/emissiveStrength 14.0
check 'of which the texture has parts of 1' texel $file $all/emissiveTexture 0.875 0.875 255 106 145
check 'a texture above 1 has its factor' member $file $all/extensions/KHR_materials_specular/specularColorFactor '[7.0, 7.0, 7.0]'
check 'specular is its alpha' texel $file $all/extensions/KHR_materials_specular/specularTexture 0.25 0.25 175 220 146 48
check 'the index of refraction is written' member $file $all/extensions/KHR_materials_ior/ior 1.7
check 'a clearcoat has its factor and its roughness' eval "member $file $all/extensions/KHR_materials_clearcoat/clearcoatFactor 0.5 && texel $file $all/extensions/KHR_materials_clearcoat/clearcoatRoughnessTexture 0.25 0.25 255 128 255"
check 'its map is that of the surface' member $file $all/extensions/KHR_materials_clearcoat/clearcoatNormalTexture '{"index": 2, "scale": 0.5}'
check 'sheen has its roughness in alpha' eval "member $file $all/extensions/KHR_materials_sheen/sheenColorFactor '[0.1, 0.2, 0.3]' && texel $file $all/extensions/KHR_materials_sheen/sheenRoughnessTexture 0.25 0.25 255 255 255 128"
check 'a film has its thickness in nanometres' eval "member $file $all/extensions/KHR_materials_iridescence/iridescenceThicknessMaximum 700.0 && member $file $all/extensions/KHR_materials_iridescence/iridescenceThicknessMinimum 0 && texel $file $all/extensions/KHR_materials_iridescence/iridescenceThicknessTexture 0.25 0.25 255 182 255"
check 'an angle is a direction' texel $file $all/extensions/KHR_materials_anisotropy/anisotropyTexture 0.25 0.25 239 189 255
check 'glass is a volume' eval "member $file $glass/extensions/KHR_materials_volume '{\"thicknessFactor\": 0.5, \"attenuationDistance\": 0.3, \"attenuationColor\": [0.1, 0.9, 0.3]}' && member $file $glass/extensions/KHR_materials_dispersion/dispersion 0.4 && texel $file $glass/extensions/KHR_materials_transmission/transmissionTexture 0.25 0.25 128 255 255"
check 'emission of one value is a factor' eval "member $file $glass/emissiveFactor '[0.0, 1.0, 0.5]' && member $file $glass/extensions/KHR_materials_emissive_strength/emissiveStrength 4.0"
check 'inputs that do nothing are left out' eval "lacks $file $glass/extensions/KHR_materials_clearcoat && lacks $file $glass/pbrMetallicRoughness/baseColorTexture && lacks $file $glass/alphaMode"
check 'materials stand side by side' member $file nodes/Glass/translation '[2.2, 0, 0]'
check 'only maps need tangents' eval "member $file meshes/0/primitives/0/attributes/TANGENT 3 && lacks $file meshes/1/primitives/0/attributes/TANGENT"

# ---- Meshes, and images that stay ----

cat >plane.obj <<'EOF'
v -1 -1 0
v 1 -1 0
v 1 1 0
vt 0 0.25
vt 1 0.25
vt 1 1
vn 0 0 1
f 1/1/1 2/2/1 3/3/1
EOF
cp "$root/examples/marble.mtlx" .
check 'another model, over a mesh' exits 0 "$mxgen" export marble.mtlx -m plane.obj -s 8 -o marble.glb
check 'v counts from the top' eval 'test "$(python3 "$here/gltf.py" marble.glb vertex 0)" = "-1.0000 -1.0000 0.0000 0.0000 0.7500"'
check 'mxgen draws its mesh' eval 'exits 0 "$render" marble.mtlx -m marble.glb -s 32 -o stage.png'
check 'without a mesh, what reads positions is told' eval 'exits 1 "$mxgen" export marble.mtlx -o none.glb && has err "[bake-mesh]" && test ! -e none.glb'
"$mxgen" bake all.mtlx -e All -o flat --size 4 -q
cat >image.mtlx <<'EOF'
<?xml version="1.0"?>
<materialx version="1.39">
  <image name="tone" type="color3">
    <input name="file" type="filename" value="flat/S_base_color.png" colorspace="srgb_texture"/>
    <input name="uaddressmode" type="string" value="mirror"/>
  </image>
  <standard_surface name="S" type="surfaceshader"><input name="base" type="float" value="1"/><input name="base_color" type="color3" nodename="tone"/></standard_surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>
EOF
check 'an image without changes is the same file' eval 'exits 0 "$mxgen" export image.mtlx -o image.gltf && cmp flat/S_base_color.png image_M_baseColor.png && member image.gltf samplers "[{\"wrapS\": 33648}]"'

cat >unlit.mtlx <<'EOF'
<?xml version="1.0"?>
<materialx version="1.39">
  <image name="tone" type="color3"><input name="file" type="filename" value="flat/S_base_color.png" colorspace="srgb_texture"/></image>
  <surface_unlit name="S" type="surfaceshader">
    <input name="emission_color" type="color3" nodename="tone"/>
    <input name="opacity" type="float" value="0.5"/>
  </surface_unlit>
  <surfacematerial name="Sign" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
  <surface_unlit name="L" type="surfaceshader">
    <input name="emission" type="float" value="0.5"/>
    <input name="emission_color" type="color3" value="1, 0.5, 0.25"/>
  </surface_unlit>
  <surfacematerial name="Lamp" type="material"><input name="surfaceshader" type="surfaceshader" nodename="L"/></surfacematerial>
</materialx>
EOF
check 'what only emits is unlit' eval 'exits 0 "$mxgen" export unlit.mtlx -o unlit.gltf -Werror && member unlit.gltf materials/Lamp/extensions "{\"KHR_materials_unlit\": {}}" && member unlit.gltf materials/Lamp/pbrMetallicRoughness/baseColorFactor "[0.5, 0.25, 0.125, 1.0]" && lacks unlit.gltf materials/Lamp/emissiveFactor'
check 'with its opacity once' eval 'member unlit.gltf materials/Sign/pbrMetallicRoughness/baseColorFactor "[1.0, 1.0, 1.0, 0.5]" && cmp flat/S_base_color.png unlit_Sign_baseColor.png'
check 'and comes back' eval 'exits 0 "$mxgen" import unlit.gltf -o unlit_back.mtlx -Werror && test "$(grep -c "<surface_unlit" unlit_back.mtlx)" = 2 && grep -q "0.5, 0.25, 0.125" unlit_back.mtlx'

sed 's/srgb_texture/acescg/' image.mtlx >aces.mtlx # 0.647, 0.808, 0.537 by the matrix of ACES (S-2014-004) and Rec. 709
check 'an image in another space is drawn in sRGB' eval 'exits 0 "$mxgen" export aces.mtlx -o aces.glb && texel aces.glb materials/M/pbrMetallicRoughness/baseColorTexture 0.25 0.25 197 235 187'
cat >tall.usda <<'EOF'
#usda 1.0
(
    upAxis = "Z"
    metersPerUnit = 0.01
)
def Mesh "sheet"
{
    point3f[] points = [(0, 0, 100), (200, 0, 100), (0, 300, 100)]
    int[] faceVertexCounts = [3]
    int[] faceVertexIndices = [0, 1, 2]
    texCoord2f[] primvars:st = [(0, 0), (1, 0), (0, 1)] (interpolation = "vertex")
    float3 xformOp:scale = (-1, 1, 1)
    uniform token[] xformOpOrder = ["xformOp:scale"]
}
EOF
check 'metres, and y upwards' eval 'exits 0 "$mxgen" export image.mtlx -m tall.usda -o tall.glb && member tall.glb accessors/0/min "[-2.0, 1.0, -3.0]" && member tall.glb accessors/0/max "[0.0, 1.0, 0.0]"'
check 'also in USD' eval 'exits 0 "$mxgen" export image.mtlx -m tall.usda -o metres.usda && has metres.usda "((-0.01, 0, 0, 0), (0, 0, -0.01, 0), (0, 0.01, 0, 0), (0, 0, 0, 1))"'

# ---- Images that are placed ----

# The color is scaled by 2 and 4 about the centre; metallic repeats twice, roughness not, and they share a texture.
cat >placed.mtlx <<'EOF'
<?xml version="1.0"?>
<materialx version="1.39">
  <texcoord name="uv" type="vector2"/>
  <place2d name="place" type="vector2">
    <input name="texcoord" type="vector2" nodename="uv"/>
    <input name="pivot" type="vector2" value="0.5, 0.5"/>
    <input name="scale" type="vector2" value="0.5, 0.25"/>
    <input name="offset" type="vector2" value="0.1, 0.2"/>
  </place2d>
  <place2d name="turned" type="vector2"><input name="texcoord" type="vector2" nodename="uv"/><input name="rotate" type="float" value="45"/></place2d>
  <image name="tone" type="color3"><input name="file" type="filename" value="flat/S_base_color.png" colorspace="srgb_texture"/><input name="texcoord" type="vector2" nodename="place"/></image>
  <image name="rough" type="float"><input name="file" type="filename" value="flat/S_roughness.png"/></image>
  <tiledimage name="metal" type="float"><input name="file" type="filename" value="flat/S_roughness.png"/><input name="uvtiling" type="vector2" value="2, 2"/></tiledimage>
  <image name="glow" type="color3"><input name="file" type="filename" value="flat/S_base_color.png" colorspace="srgb_texture"/><input name="texcoord" type="vector2" nodename="turned"/></image>
  <gltf_pbr name="S" type="surfaceshader">
    <input name="base_color" type="color3" nodename="tone"/>
    <input name="roughness" type="float" nodename="rough"/>
    <input name="metallic" type="float" nodename="metal"/>
    <input name="emissive" type="color3" nodename="glow"/>
  </gltf_pbr>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>
EOF
check 'images stay behind a scale and a shift' eval 'exits 0 "$mxgen" export placed.mtlx -s 64 -o placed.gltf && cmp flat/S_base_color.png placed_M_baseColor.png'
check 'which the texture has' eval 'member placed.gltf materials/M/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform "{\"offset\": [-0.6, -1.3], \"scale\": [2.0, 4.0]}"'
check 'parts with other places are drawn' eval 'texel placed.gltf materials/M/pbrMetallicRoughness/metallicRoughnessTexture 0.1 0.1875 255 166 128 && lacks placed.gltf materials/M/pbrMetallicRoughness/metallicRoughnessTexture/extensions'
check 'an image without a size is told' eval 'sed "s/0.5, 0.25/0, 1/" placed.mtlx >flat.mtlx && exits 0 "$mxgen" export flat.mtlx -s 4 -o flat.gltf && has err "has no size"'
check 'and images that are turned' lacks placed.gltf materials/M/emissiveTexture/extensions

# ---- USD ----

check 'a stage of USD' exits 0 "$mxgen" export marble.mtlx -m sphere -s 256 -o marble.usda
check 'has both networks' has marble.usda 'info:id = "UsdPreviewSurface"' 'asset inputs:file = @./marble_Marble_diffuseColor.png@' \
    'outputs:surface.connect = </marble/Materials/Marble/preview.outputs:surface>' 'info:id = "ND_fractal3d_float"' \
    'outputs:mtlx:surface.connect = </marble/Materials/Marble/SR_marble.outputs:out>' 'rel material:binding = </marble/Materials/Marble>'
# draws FILE PICTURE. A distance counts in the size of a mesh, which is the radius here, or that of a stage: half the diagonal of its box.
draws() { exits 0 "$render" --stage "$1" -Wno-unread-input -s 64 --camera 25,16,1.7320508 -o "$2" && ! grep warning err; }
sed 's/outputs:surface.connect/outputs:none.connect/' marble.usda >network.usda
sed '/outputs:mtlx:surface.connect/d' marble.usda >preview.usda
check 'mxgen draws the graph of the stage' draws network.usda network.exr
check 'and its images' draws preview.usda preview.exr
"$render" marble.mtlx -m sphere -s 64 --camera 25,16,3 -q -o marble.exr
check 'the graph is the one of the document' "$psnr" --at-least 24 marble.exr network.exr
check 'and images are near' "$psnr" --at-least 24 marble.exr preview.exr
sed '/name="\(metallic\|emissive\)"/d; s/gltf_pbr/UsdPreviewSurface/; s/base_color" type="color3" nodename/diffuseColor" type="color3" nodename/' placed.mtlx >moved.mtlx
"$mxgen" export moved.mtlx -q -o placed.usda
sed '/outputs:mtlx:surface.connect/d' placed.usda >placed_preview.usda
check 'placed images have their transform' eval 'has placed.usda "inputs:scale = (2, 4)" "inputs:translation = (-0.6, -1.7)" && draws placed.usda placed.exr && draws placed_preview.usda placed_preview.exr'
check 'they lie where they lie in the graph' "$psnr" --at-least 40 placed.exr placed_preview.exr
check 'images of maps and numbers above 1' eval 'exits 0 "$mxgen" export all.mtlx -o all.usda --size 4 && has all.usda "inputs:scale = (2, 2, 2, 1)" "inputs:bias = (-1, -1, -1, 0)" "inputs:scale = (14, 14, 14, 1)" "double3 xformOp:translate = (2.2, 0, 0)" && draws all.usda all.png'
mkdir package
check 'a package is written' exits 0 "$mxgen" export image.mtlx -o package/image.usdz
cat >package.py <<'EOF'
import struct, sys, zipfile
data = open(sys.argv[1], "rb").read()
files = zipfile.ZipFile(sys.argv[1])
assert files.testzip() is None
assert files.namelist() == sys.argv[2:], files.namelist()
for file in files.infolist():
    name, extra = struct.unpack_from("<HH", data, file.header_offset + 26)
    assert file.compress_type == zipfile.ZIP_STORED and (file.header_offset + 30 + name + extra) % 64 == 0, file
stage = files.read(sys.argv[2]).decode()
assert all(f"@./{name}@" in stage for name in sys.argv[3:])
EOF
check 'has its files in place' python3 package.py package/image.usdz image.usda M_diffuseColor.png S_base_color.png
check 'and nothing beside it' test image.usdz = "$(ls -A package)"

# ---- What a file does not have ----

cat >bad.mtlx <<'EOF'
<?xml version="1.0"?>
<materialx version="1.39">
  <gltf_pbr name="turned" type="surfaceshader"><input name="tangent" type="vector3" nodename="t"/><input name="base_color" type="color3" value="3, 0, 0"/></gltf_pbr>
  <constant name="t" type="vector3"><input name="value" type="vector3" value="0, 1, 0"/></constant>
  <gltf_pbr name="wide" type="surfaceshader"><input name="sheen_color" type="color3" value="0.5, 0, 0" colorspace="acescg"/></gltf_pbr>
  <image name="set" type="color3"><input name="file" type="filename" value="a.&lt;UDIM&gt;.png"/></image>
  <gltf_pbr name="tiles" type="surfaceshader"><input name="base_color" type="color3" nodename="set"/></gltf_pbr>
</materialx>
EOF
cat >closures.mtlx <<'EOF'
<?xml version="1.0"?>
<materialx version="1.39">
  <oren_nayar_diffuse_bsdf name="chalk" type="BSDF"><input name="color" type="color3" value="0.5, 0.25, 0.125"/></oren_nayar_diffuse_bsdf>
  <surface name="closures" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="chalk"/></surface>
</materialx>
EOF
check 'what glTF does not have is a loss' eval 'exits 0 "$mxgen" export bad.mtlx -e turned -o loss.gltf && has err "turned/tangent'"'"' (bad.mtlx:3:" "[export-loss]" "from 0 to 3" "[export-clamped]"'
check 'or an error' eval 'exits 1 "$mxgen" export bad.mtlx -e turned -o none.gltf -W error=export-loss && has err "error: '"'"'turned/tangent" && test ! -e none.gltf'
check 'or nobody wants to know' eval 'exits 0 "$mxgen" export bad.mtlx -e turned -o loss.gltf -Wno-export-loss && ! grep export-loss err'
# Each number out of the range of glTF's schemas, with the weights that make it do something.
ranges() { # VALUE NAME...
    local value=$1 name
    shift
    echo '<?xml version="1.0"?>' '<materialx version="1.39"><gltf_pbr name="S" type="surfaceshader">'
    for name in alpha_mode:integer:1 "$@"; do
        IFS=: read -r name type own <<<"$name"
        echo "<input name=\"$name\" type=\"${type:-float}\" value=\"${own:-$value}\"/>"
    done
    echo '</gltf_pbr></materialx>'
}
weights='emissive:color3:1,1,1 transmission::1 thickness::1 iridescence::1 sheen_color:color3:1,1,1 clearcoat::1 anisotropy_strength::1'
low='alpha alpha_cutoff metallic roughness occlusion emissive_strength ior specular clearcoat_roughness sheen_roughness attenuation_distance dispersion iridescence_ior iridescence_thickness'
check 'numbers below the range of glTF are told, each one' eval 'ranges -1 $weights $low anisotropy_rotation >low.mtlx && exits 0 "$mxgen" export low.mtlx -o low.glb && [ "$(grep -c "has values from -1 to -1; glTF keeps .*\[export-clamped\]" err)" = "$(wc -w <<<"$low")" ] && ! grep rotation err'
check 'and are in the range' eval 'member low.glb materials/0/extensions/KHR_materials_iridescence/iridescenceIor 1.0 && member low.glb materials/0/alphaCutoff 0.0'
check 'indices between 0 and 1 are told, and 0 is not' eval 'ranges 0.5 $weights iridescence_ior ior >half.mtlx && exits 0 "$mxgen" export half.mtlx -o half.glb && has err "/ior" "glTF keeps 0 and those from 1 to infinity" "/iridescence_ior" && ranges 0 ior >zero.mtlx && exits 0 "$mxgen" export zero.mtlx -o zero.glb && ! grep export-clamped err && member zero.glb materials/0/extensions/KHR_materials_ior/ior 0.0'
check 'a strength beyond all numbers stays one' eval 'ranges 3e38 emissive:color3:9,9,9 emissive_strength >huge.mtlx && exits 0 "$mxgen" export huge.mtlx -o huge.glb && member huge.glb materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength 3.402823e+38'
bad() { exits 1 "$mxgen" export "$1" -e "$2" -o none.gltf && has err "${@:3}" && test ! -e none.gltf && test ! -e none.bin; }
cat >own.mtlx <<'EOF'
<?xml version="1.0"?>
<materialx version="1.39">
  <nodedef name="ND_own" node="own"><output name="out" type="float"/></nodedef>
  <nodegraph name="NG_own" nodedef="ND_own"><constant name="c" type="float"><input name="value" type="float" value="0.25"/></constant><output name="out" type="float" nodename="c"/></nodegraph>
  <own name="half" type="float"/>
  <standard_surface name="S" type="surfaceshader"><input name="metalness" type="float" nodename="half"/></standard_surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>
EOF
check 'a definition of the document is a loss for the graph alone' eval 'exits 0 "$mxgen" export own.mtlx -o own.usda && has err "[export-loss]" && has own.usda "inputs:metallic = 0.25" && ! grep -q ND_ own.usda'
check 'a missing image is told' eval 'sed "s,flat/S,flat/N," image.mtlx >lost.mtlx && bad lost.mtlx M "[missing-texture]"'
check 'or is a checker' eval 'exits 0 "$mxgen" export lost.mtlx --missing-texture checker -s 16 -o lost.glb && texel lost.glb materials/M/pbrMetallicRoughness/baseColorTexture 0.1 0.1 255 0 255'
check 'another space of colors is told' bad bad.mtlx wide '(bad.mtlx:5:' '[export-space]'
check 'tiles are told' bad bad.mtlx tiles '(bad.mtlx:6:3) are several images' '[export-tiles]'
# A default of tokens that no geometry replaces holds for all.
printf 'P3 1 1 255 255 0 0\n' >of_red.ppm
cat >tokens.mtlx <<'EOF'
<?xml version="1.0"?>
<materialx version="1.39">
  <tokendefault name="id" type="string" value="red"/>
  <image name="i" type="color3"><input name="file" type="filename" value="of_&lt;id&gt;.ppm"/></image>
  <standard_surface name="S" type="surfaceshader"><input name="base_color" type="color3" nodename="i"/></standard_surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>
EOF
check 'the default of a token names a texture' exits 0 "$mxgen" export tokens.mtlx -m plane -o tokens.glb
check 'it is the red file' texel tokens.glb materials/M/pbrMetallicRoughness/baseColorTexture 0.5 0.5 255 0 0
check 'also in USD' eval 'exits 0 "$mxgen" export tokens.mtlx -m plane -o tokens.usda && has tokens.usda "of_red.ppm" && ! grep -q "<id>" tokens.usda'
sed -i 's|  <image|  <geominfo name="g" geom="/a"><token name="id" type="string" value="green"/></geominfo>\n&|' tokens.mtlx
check 'a default that a geometry replaces does not' bad tokens.mtlx M '[export-tiles]'
cat >mixed.mtlx <<'EOF'
<?xml version="1.0"?>
<materialx version="1.39">
  <nodedef name="ND_t" node="t"><input name="c" type="color3" value="1, 1, 1"/><output name="out" type="material"/></nodedef>
  <nodegraph name="NG_t" nodedef="ND_t"><standard_surface name="s" type="surfaceshader"><input name="base_color" type="color3" interfacename="c"/></standard_surface>
    <surfacematerial name="m" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial><output name="out" type="material" nodename="m"/></nodegraph>
  <t name="T" type="material"/>
  <standard_surface name="F" type="surfaceshader"/>
  <standard_surface name="B" type="surfaceshader"/>
  <mix name="X" type="surfaceshader"><input name="fg" type="surfaceshader" nodename="F"/><input name="bg" type="surfaceshader" nodename="B"/><input name="mix" type="float" value="0.25"/></mix>
  <surfacematerial name="Mix" type="material"><input name="surfaceshader" type="surfaceshader" nodename="X"/></surfacematerial>
  <displacement name="D" type="displacementshader"/>
  <surfacematerial name="Moved" type="material"><input name="displacementshader" type="displacementshader" nodename="D"/></surfacematerial>
</materialx>
EOF
check 'a surface of several surfaces is one' eval 'exits 0 "$mxgen" export mixed.mtlx -e Mix -o mix.glb -Werror=translation-loss && member mix.glb materials/0/name \"Mix\" && lacks mix.glb materials/1'
check 'also by its own name' eval 'exits 0 "$mxgen" export mixed.mtlx -e X -o mix.glb && member mix.glb materials/0/name \"X\"'
sed -e 's|nodename="X"/></surf|nodename="Y"/></surf|' -e 's|</materialx>|<mix name="Y" type="surfaceshader"><input name="fg" type="surfaceshader" nodename="X"/><input name="bg" type="surfaceshader" nodename="F"/></mix><constant name="X_material" type="float"/>&|' mixed.mtlx >nested.mtlx
check 'also where it is a part of another one' eval 'exits 0 "$mxgen" export mixed.mtlx -e X -o alone.usda && ! grep -q "nodename=.X.*surfacematerial" nested.mtlx && exits 0 "$mxgen" export nested.mtlx -e X -o part.usda && grep -q diffuseColor part.usda && [ "$(grep "float inputs:\|3f inputs:" part.usda)" = "$(grep "float inputs:\|3f inputs:" alone.usda)" ]'
check 'and among all materials, without its parts' eval 'exits 0 "$mxgen" export mixed.mtlx -o mixed.gltf && has err "no surface [export-loss]" && has mixed.gltf "\"Mix\"" "\"T\"" && lacks mixed.gltf materials/2'
check 'a part of it is exported by its name' eval 'exits 0 "$mxgen" export mixed.mtlx -e F -o part.glb && ! grep -q warning err && member part.glb materials/0/name \"F\"'
# Paint where u is above a half, gold elsewhere, both behind a mask; then the same inside of a definition, with the pattern.
parts='<texcoord name="uv" type="vector2"/><separate2 name="place" type="multioutput"><input name="in" type="vector2" nodename="uv"/></separate2>
  <ifgreater name="mask" type="float"><input name="value1" type="float" nodename="place" output="outx"/><input name="value2" type="float" value="0.5"/><input name="in1" type="float" value="1"/><input name="in2" type="float" value="0"/></ifgreater>
  <standard_surface name="paint" type="surfaceshader"><input name="base_color" type="color3" value="0.8, 0.2, 0.1"/></standard_surface>
  <standard_surface name="gold" type="surfaceshader"><input name="base_color" type="color3" value="0.9, 0.8, 0.3"/><input name="metalness" type="float" value="1"/></standard_surface>
  <mix name="both" type="surfaceshader"><input name="fg" type="surfaceshader" nodename="paint"/><input name="bg" type="surfaceshader" nodename="gold"/><input name="mix" type="float" nodename="mask"/></mix>'
material='<surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="both"/></surfacematerial></materialx>'
echo "<?xml version=\"1.0\"?><materialx version=\"1.39\">$parts$material" >blended.mtlx
echo "<?xml version=\"1.0\"?><materialx version=\"1.39\"><nodedef name=\"ND_two\" node=\"two\"><output name=\"out\" type=\"surfaceshader\"/></nodedef>
  <nodegraph name=\"NG_two\" nodedef=\"ND_two\">$parts<output name=\"out\" type=\"surfaceshader\" nodename=\"both\"/></nodegraph><two name=\"both\" type=\"surfaceshader\"/>$material" >blended_inside.mtlx
paint='0.75 0.5 231 124 89' gold='0.25 0.5 243 231 149'
for name in blended blended_inside; do
    check "$name: a mix behind a pattern is one surface" eval 'exits 0 "$mxgen" export "$name.mtlx" -s 64 -o "$name.glb" && has err "one slab for the mix '"'both'"'"'
    check "$name: with the colours of its parts" eval 'texel "$name.glb" materials/M/pbrMetallicRoughness/baseColorTexture $paint && texel "$name.glb" materials/M/pbrMetallicRoughness/baseColorTexture $gold'
    check "$name: gold is metal, paint is not" eval 'texel "$name.glb" materials/M/pbrMetallicRoughness/metallicRoughnessTexture 0.75 0.5 255 255 0 && texel "$name.glb" materials/M/pbrMetallicRoughness/metallicRoughnessTexture 0.25 0.5 255 255 255'
done
"$render" blended.mtlx -m sphere -s 64 -q -o source.exr
check 'it looks like its source' eval 'exits 0 "$mxgen" import blended.glb -o back.mtlx && "$render" back.mtlx -m sphere -s 64 -q -o back.exr && "$psnr" --at-least 27 source.exr back.exr'
check 'a UsdPreviewSurface has it, too' eval 'exits 0 "$mxgen" export blended.mtlx -s 64 -o blended.usda && has blended.usda "UsdPreviewSurface" "inputs:metallic.connect"'
check 'and a material by a definition' eval 'exits 0 "$mxgen" export mixed.mtlx -e T -o defined.glb && member defined.glb materials/0/name \"T\" && ! grep -q warning err'
check 'surfaces of closures go through slabs' eval 'exits 0 "$mxgen" export closures.mtlx -e closures -o closures.gltf && grep -A4 baseColorFactor closures.gltf | tr -d " \n" | grep -q "0.5,0.25,0.125"'
check 'a document is not written over itself' eval 'cp all.mtlx all.gltf && exits 1 "$mxgen" export all.gltf -o all.gltf && has err "[output-clash]" && cmp all.mtlx all.gltf'
check 'nor an image that it reads' eval 'cp flat/S_base_color.png clash_M_baseColor.png && sed "s,flat/S_base_color,clash_M_baseColor," image.mtlx >clash.mtlx && exits 1 "$mxgen" export clash.mtlx -o clash.gltf && has err "[output-clash]" && cmp flat/S_base_color.png clash_M_baseColor.png && test ! -e clash.gltf'
check 'a folder must exist' eval 'exits 1 "$mxgen" export image.mtlx -o none/a.gltf && has err "[output-failed]"'
check 'a sandbox holds' eval 'mkdir -p in && sed "s,flat/,../flat/," image.mtlx >in/image.mtlx && exits 1 "$mxgen" export in/image.mtlx --sandbox -o none.gltf && has err "[texture-refused]" && test ! -e none.gltf'
check 'nothing of failures is left' test "$(ls -A "$TMPDIR" | wc -l)" = 0
check 'an unknown ending fails' exits 2 "$mxgen" export all.mtlx -o none.fbx
check 'export without an output fails' exits 2 "$mxgen" export all.mtlx
if [ -d "$root/tests/npm/node_modules/gltf-validator" ] && command -v node >valid.log; then
    check "Khronos' validator has no objection" valid 'out1/all of it.gltf' all.glb marble.glb image.gltf aces.glb tall.glb loss.gltf placed.gltf unlit.gltf low.glb half.glb zero.glb huge.glb
else
    skip 'no gltf-validator (npm ci --prefix tests/npm) or no node'
fi
cat >told.mtlx <<'XML'
<materialx version="1.39">
<image name="i" type="color3"><input name="texcoord" type="vector2" value="0.5, 0.5"/></image>
<standard_surface name="S" type="surfaceshader"><input name="base_color" type="color3" nodename="i"/></standard_surface>
<surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial></materialx>
XML
check 'a line of the translated document is none of the file' eval '"$mxgen" export told.mtlx -o told.gltf --size 4 2>err; grep -q "^told.mtlx as gltf_pbr:[0-9]*:[0-9]*: warning: .*\[geomprop-literal\]" err && ! grep -q "^told.mtlx:" err'
finish export
