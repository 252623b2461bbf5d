#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# mxgen import (docs/import.md): materials of glTF as documents. Arguments: mxgen, mxgen-render, psnr.
mxgen=$(realpath "$1") render=$(realpath "$2") psnr=$(realpath "$3")
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"
export MESA_SHADER_CACHE_DISABLE=true

files() { [ "$(cd "$1" && find . -type f | sort | tr '\n' ' ')" = "$2" ] || { find "$1" -type f && false; }; }
imports() { exits 0 "$mxgen" import "$@"; }
clean() { exits 0 "$mxgen" validate "$@" && [ ! -s err ]; }

# ---- Values and extensions ----

cat >values.gltf <<'END'
{"asset": {"version": "2.0"}, "materials": [
  {"name": "1 Plain metal", "pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.6, 0.2, 1], "roughnessFactor": 0.25}},
  {"name": "All", "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0, "roughnessFactor": 0.5},
   "emissiveFactor": [0, 1, 0.5], "alphaMode": "MASK", "alphaCutoff": 0.3, "doubleSided": true,
   "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4}, "KHR_materials_ior": {"ior": 1.7},
     "KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [2, 1, 1]}, "KHR_materials_dispersion": {"dispersion": 0.4},
     "KHR_materials_clearcoat": {"clearcoatFactor": 0.5, "clearcoatRoughnessFactor": 0.25}, "KHR_materials_anisotropy": {"anisotropyStrength": 0.6, "anisotropyRotation": 0.5},
     "KHR_materials_sheen": {"sheenColorFactor": [0.1, 0.2, 0.3], "sheenRoughnessFactor": 0.75}, "KHR_materials_iridescence": {"iridescenceFactor": 0.6},
     "KHR_materials_transmission": {"transmissionFactor": 0.5},
     "KHR_materials_volume": {"thicknessFactor": 0.5, "attenuationDistance": 0.3, "attenuationColor": [0.1, 0.9, 0.3]}}},
  {"name": "All", "alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5]}}, {},
  {"name": "Flat", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0.125, 0.75]}, "alphaMode": "BLEND", "extensions": {"KHR_materials_unlit": {}}},
  {"name": "Holes", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 0.75]}, "alphaMode": "MASK", "extensions": {"KHR_materials_unlit": {}}},
  {"name": "Other", "extensions": {"EXT_other": {"amount": 1}}}]}
END
check 'values are read' imports values.gltf -o values.mtlx
check 'what gltf_pbr has not is told' has err "'Other' of 'values.gltf' is not in the document as it is: gltf_pbr has nothing like the extension 'EXT_other' [import-loss]"
check 'the document is valid' clean values.mtlx
check 'the document can be printed' eval 'exits 0 "$mxgen" import values.gltf -o - && sed -n "/<materialx/,\$p" out >a && sed -n "/<materialx/,\$p" values.mtlx >b && cmp a b && [ ! -e ./- ]'
check 'names become valid and differ' has values.mtlx 'name="_1_Plain_metal"' 'name="All"' 'name="All_2"' 'name="material_3"'
has_values() { # NAME VALUE...: pairs of inputs of a surface
    python3 - values.mtlx "$@" <<'END'
import sys, xml.etree.ElementTree as tree
node = tree.parse(sys.argv[1]).getroot().find(f"*[@name='{sys.argv[2]}']")
found = {i.get("name"): [float(x) for x in i.get("value").split(",")] for i in node if i.get("value")}
wanted = dict(zip(sys.argv[3::2], ([float(x) for x in v.split(",")] for v in sys.argv[4::2])))
sys.exit(0 if found == wanted else f"{found} instead of {wanted}")
END
}
check 'members with their defaults are left out' has_values SR__1_Plain_metal base_color 0.9,0.6,0.2 roughness 0.25
check 'all members become inputs' has_values SR_All base_color 0.1,0.2,0.3 alpha 0.4 alpha_mode 1 alpha_cutoff 0.3 metallic 0 roughness 0.5 emissive 0,1,0.5 emissive_strength 4 \
    ior 1.7 specular 0.5 specular_color 2,1,1 dispersion 0.4 clearcoat 0.5 clearcoat_roughness 0.25 anisotropy_strength 0.6 anisotropy_rotation 0.5 sheen_color 0.1,0.2,0.3 \
    sheen_roughness 0.75 iridescence 0.6 iridescence_thickness 400 transmission 0.5 thickness 0.5 attenuation_distance 0.3 attenuation_color 0.1,0.9,0.3
check 'alpha stays with its mode' has_values SR_All_2 alpha 0.5 alpha_mode 2
check 'a material without members is the default' has_values SR_material_3
check 'an unlit material is its colour' has_values SR_Flat emission_color 0.5,0.25,0.125 opacity 0.75
check 'an unlit mask is a comparison' has values.mtlx '<ifgreatereq name="opaque" type="float">' '<input name="value1" type="float" value="0.75"'

# ---- Images ----

cat >make.py <<'END'
import base64, json, math, struct, sys, zlib
def png(pixels, size):
    raw = b"".join(b"\0" + bytes(v for x in range(size) for v in pixels(x, y)) for y in range(size))
    part = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    return b"\x89PNG\r\n\x1a\n" + part(b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0)) + part(b"IDAT", zlib.compress(raw)) + part(b"IEND", b"")
angle, offset, scale = float(sys.argv[1]), [float(sys.argv[2]), float(sys.argv[3])], [float(sys.argv[4]), float(sys.argv[5])]
image = base64.b64encode(png(lambda x, y: (40 + 50 * x, 40 + 50 * y, 0), 4)).decode()
where = {"offset": offset, "rotation": angle, "scale": scale}
json.dump({"asset": {"version": "2.0"}, "images": [{"uri": "data:image/png;base64," + image, "name": "dots"}],
           "samplers": [{"magFilter": 9728}], "textures": [{"source": 0, "sampler": 0}],
           "materials": [{"name": "U", "extensions": {"KHR_materials_unlit": {}}, "pbrMetallicRoughness": {
               "baseColorTexture": {"index": 0, "extensions": {"KHR_texture_transform": where}}}}]}, open("placed.gltf", "w"))
END
# placed DEGREES OFFSET SCALE: each texel of the surface has the dot that KHR_texture_transform says: scale, then turn (the specification's
# example, a quadrant turned by 90 degrees, fixes the direction), then shift; v runs down.
placed() {
    python3 make.py "$@" && imports placed.gltf -o placed.mtlx && rm -rf baked && exits 0 "$mxgen" bake placed.mtlx -o baked --size 8 --samples 1 --format png || return
    PYTHONPATH=$here python3 - "$@" <<'END'
import math, pathlib, sys, gltf
angle, off_u, off_v, by_u, by_v = map(float, sys.argv[1:])
width, rows, channels = gltf.unpack(next(pathlib.Path("baked").glob("*.png")).read_bytes())
for y in range(8):
    for x in range(8):
        u, v = by_u * (x + 0.5) / 8, by_v * (y + 0.5) / 8
        u, v = math.cos(angle) * u + math.sin(angle) * v + off_u, math.cos(angle) * v - math.sin(angle) * u + off_v
        dot = math.floor(4 * u) % 4, math.floor(4 * v) % 4
        found = rows[y][channels * x:channels * x + 2]
        assert all(abs(40 + 50 * d - f) <= 1 for d, f in zip(dot, found)), (x, y, dot, list(found))
END
}
# tinted: factors multiply linear values (glTF 2.0, 3.9.2): decoded, times (0.5, 0.25), encoded
tinted() {
    python3 make.py 0 0 0 1 1 && sed 's/"baseColorTexture"/"baseColorFactor": [0.5, 0.25, 1, 1], &/' placed.gltf >tinted.gltf || return
    imports tinted.gltf -o tinted.mtlx && rm -rf tint && exits 0 "$mxgen" bake tinted.mtlx -o tint --size 4 --samples 1 --format png || return
    PYTHONPATH=$here python3 - <<'END'
import pathlib, gltf
linear = lambda c: c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4
encoded = lambda c: 12.92 * c if c <= 0.0031308 else 1.055 * c ** (1 / 2.4) - 0.055
width, rows, channels = gltf.unpack(next(pathlib.Path("tint").glob("*.png")).read_bytes())
for y in range(4):
    for x in range(4):
        for channel, (at, factor) in enumerate([(x, 0.5), (y, 0.25)]):
            wanted = 255 * encoded(factor * linear((40 + 50 * at) / 255))
            assert abs(rows[y][channels * x + channel] - wanted) <= 1.5, (x, y, channel, wanted, list(rows[y]))
END
}
if has_device "$render"; then
    check 'an image lies where it is' placed 0 0 0 1 1
    check 'a factor multiplies decoded colours' tinted
    check 'an image is scaled and shifted' placed 0 0.25 0.5 0.5 2
    check "an image is turned: the specification's example" placed 1.5707963 0 1 0.5 0.5
    check 'an image is turned by any angle' placed 0.6 0.3 0.1 1.5 0.7
    cat >source.mtlx <<'END'
<materialx version="1.39" colorspace="lin_rec709">
  <fractal2d name="noise" type="float"><input name="texcoord" type="vector2" nodename="place"/></fractal2d>
  <smoothstep name="cloud" type="float"><input name="in" type="float" nodename="noise"/><input name="low" type="float" value="-1"/></smoothstep>
  <texcoord name="uv" type="vector2"/>
  <multiply name="place" type="vector2"><input name="in1" type="vector2" nodename="uv"/><input name="in2" type="float" value="4"/></multiply>
  <mix name="paint" type="color3">
    <input name="fg" type="color3" value="0.8, 0.3, 0.1"/><input name="bg" type="color3" value="0.1, 0.2, 0.5"/><input name="mix" type="float" nodename="cloud"/>
  </mix>
  <remap name="rough" type="float">
    <input name="in" type="float" nodename="cloud"/><input name="outlow" type="float" value="0.3"/><input name="outhigh" type="float" value="0.7"/>
  </remap>
  <heighttonormal name="bumps" type="vector3"><input name="in" type="float" nodename="cloud"/><input name="scale" type="float" value="0.2"/></heighttonormal>
  <normalmap name="bumped" type="vector3"><input name="in" type="vector3" nodename="bumps"/><input name="scale" type="float" value="0.5"/></normalmap>
  <gltf_pbr name="SR_Paint" type="surfaceshader">
    <input name="base_color" type="color3" nodename="paint"/>
    <input name="metallic" type="float" value="0.25"/>
    <input name="roughness" type="float" nodename="rough"/>
    <input name="occlusion" type="float" nodename="rough"/>
    <input name="clearcoat" type="float" value="0.5"/>
    <input name="clearcoat_roughness" type="float" nodename="rough"/>
    <input name="sheen_color" type="color3" nodename="paint"/>
    <input name="sheen_roughness" type="float" nodename="rough"/>
  </gltf_pbr>
  <surfacematerial name="Paint" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SR_Paint"/></surfacematerial>
  <multiply name="bright" type="color3"><input name="in1" type="color3" nodename="paint"/><input name="in2" type="float" value="3"/></multiply>
  <multiply name="film" type="float"><input name="in1" type="float" nodename="rough"/><input name="in2" type="float" value="600"/></multiply>
  <gltf_pbr name="SR_Film" type="surfaceshader">
    <input name="base_color" type="color3" value="0.2, 0.2, 0.2"/>
    <input name="normal" type="vector3" nodename="bumped"/>
    <input name="emissive" type="color3" nodename="bright"/>
    <input name="metallic" type="float" value="0.5"/>
    <input name="roughness" type="float" value="0.4"/>
    <input name="iridescence" type="float" value="0.6"/>
    <input name="iridescence_thickness" type="float" nodename="film"/>
    <input name="anisotropy_strength" type="float" nodename="rough"/>
    <input name="anisotropy_rotation" type="float" nodename="rough"/>
  </gltf_pbr>
  <surfacematerial name="Film" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SR_Film"/></surfacematerial>
</materialx>
END
    check 'a document goes out' exits 0 "$mxgen" export source.mtlx -o out.glb --size 128
    check 'and comes back' imports out.glb -o back.mtlx
    check 'it is valid' clean back.mtlx
    similar() { # ELEMENT DB
        exits 0 "$mxgen" render source.mtlx -e "$1" --size 64 --samples 16 -o a.exr && exits 0 "$mxgen" render back.mtlx -e "$1" --size 64 --samples 16 -o b.exr &&
            { "$psnr" --at-least "$2" a.exr b.exr || { "$psnr" a.exr b.exr && false; }; }
    }
    for element in $(sed -n 's/.*<surfacematerial name="\([^"]*\)".*/\1/p' source.mtlx); do
        check "it looks as before: $element" similar "$element" 33
    done
else
    skip 'no Vulkan device'
fi

# ---- Files ----

python3 make.py 0 0 0 1 1
check 'an image inside of the file becomes a file' eval 'imports placed.gltf -o placed.mtlx && has placed.mtlx "value=\"dots.png\"" && test -s dots.png'
check 'beside a printed document there is no place for it' eval 'exits 1 "$mxgen" import placed.gltf -o - && has err "[output-failed]" "dots.png" && [ ! -s out ] && [ ! -e ./- ]'
mkdir -p deep/'a folder' other
python3 - <<'END'
import base64, json
data = json.load(open("placed.gltf"))
image = base64.b64decode(data["images"][0]["uri"].split(",")[1])
open("deep/a folder/dots.png", "wb").write(image)
data["images"][0] = {"uri": "a%20folder/dots.png"}
json.dump(data, open("deep/outside.gltf", "w"))
data["images"][0] = {"bufferView": 0, "mimeType": "image/png", "name": "../../../evil\n"}
data["bufferViews"] = [{"buffer": 0, "byteLength": len(image)}]
data["buffers"] = [{"byteLength": len(image), "uri": "bytes.bin"}]
open("bytes.bin", "wb").write(image)
json.dump(data, open("inside.gltf", "w"))
data["bufferViews"][0]["byteLength"] = 10 ** 9
json.dump(data, open("short.gltf", "w"))
data["images"][0] = {"uri": "nowhere.png"}
json.dump(data, open("other/missing.gltf", "w"))
data["images"][0] = {"uri": "../secret.png"}
json.dump(data, open("other/above.gltf", "w"))
open("secret.png", "wb").write(image)
data["images"][0] = {"uri": "https://example.com/a.png"}
json.dump(data, open("web.gltf", "w"))
data["textures"][0] = {"extensions": {"KHR_texture_basisu": {"source": 0}}}
json.dump(data, open("basis.gltf", "w"))
END
check 'an image beside the file stays where it is' eval 'imports deep/outside.gltf -o other/o.mtlx && has other/o.mtlx "value=\"../deep/a folder/dots.png\"" && files other "./above.gltf ./missing.gltf ./o.mtlx "'
check 'a name of an image does not leave the folder' eval 'mkdir safe && imports inside.gltf -o safe/s.mtlx && [ "$(ls safe | wc -l)" = 2 ] && ls safe | grep -q "^_*evil_-[0-9a-f]*.png$"'
loses() { # FILE WORDS...: the image is told, and the rest is there
    local file=$1
    shift
    imports "$file" -o lost.mtlx $options && has err "[import-loss]" "$@" && has lost.mtlx '<surface_unlit name="SR_U"'
}
options=
check 'missing bytes are told' loses short.gltf 'the bytes of the image are missing'
check 'the web is not read' loses web.gltf "'https://example.com/a.png': it is no file beside it"
check 'other kinds of images are told' loses basis.gltf "'baseColorTexture' has no image in PNG or JPEG"
check 'a missing file is told' loses other/missing.gltf "there is no file 'other/nowhere.png'"
sed 's|nowhere.png|no/./way/../where.png|' other/missing.gltf >other/apart.gltf
check 'in a folder that is missing, too, where it would be' eval 'loses other/apart.gltf "there is no file" && has lost.mtlx "value=\"other/no/where.png\"" && imports other/apart.gltf -o safe/apart.mtlx && has safe/apart.mtlx "value=\"../other/no/where.png\""'
sed 's|nowhere.png|now\\nhere.png|' other/missing.gltf >other/line.gltf
check 'a URI does not end the line of a message' loses other/line.gltf "there is no file 'other/now?here.png'"
sed 's|nowhere.png|..\\\\nowhere.png|' other/missing.gltf >other/back.gltf
check 'a backslash is no part of a URI' eval 'loses other/back.gltf "a URI has" && ! grep -q nowhere lost.mtlx'
options=--sandbox
check 'a sandbox has a border' loses other/above.gltf "'../secret.png': it is outside"
printf '{"asset": {"version": "2.0"},\n "materials": [}' >broken.gltf
printf '{"asset": {"version": "1.0"}}' >old.gltf
printf '{"asset": {"version": "2.0"}, "materials": []}' >empty.gltf
printf 'glTF\2\0\0\0\377\377\377\377\377\377\377\377JSON' >broken.glb
fails() { # FILE WORDS...
    local file=$1
    shift
    exits 1 "$mxgen" import "$file" -o none.mtlx && has err '[import-file]' "$file" "$@" && [ ! -e none.mtlx ]
}
check 'a fault of JSON has its place' fails broken.gltf 'line 2, column 16'
check 'glTF 1.0 is not read' fails old.gltf '2.0'
python3 - <<'END'
import json
extension = lambda value: {"KHR_materials_variants": value}
def write(name, nodes, scene, variants, primitives):
    json.dump({"asset": {"version": "2.0"}, "materials": [{"name": "m"}, {"name": "k"}], "extensions": extension({"variants": variants}),
               "meshes": [{"primitives": primitives}], "nodes": nodes, "scenes": [{"nodes": scene}]}, open(name, "w"))
write("deep.gltf", [{"children": [i + 1]} for i in range(1000)] + [{"mesh": 0}], [0], [{}], [{"material": 0}])
write("many.gltf", [{"mesh": 0, "name": "n"} for i in range(2000)], list(range(2000)), [{}] * 2000, [{"material": 0}])
mapping = extension({"mappings": [{"material": 1, "variants": [1, 1, -1, 7, "x"]}, {"material": 0, "variants": [1]}, {"material": 9, "variants": [2]}]})
write("mapped.gltf", [{"mesh": 0, "name": "n"}], [0], [{"name": "a"}, {"name": "b"}, {"name": "c"}], [{"material": 0, "extensions": mapping}])
END
check 'nodes may be nested 1,000 deep' fails deep.gltf 'nested more than 1000 deep'
check 'looks have a limit' eval 'exits 1 "$mxgen" import many.gltf -o none.mtlx --max-output-size 64 && has err "[output-limit]" "the looks have more than 64 MiB" && [ ! -e none.mtlx ]'
check 'the first mapping of a variant counts' eval 'imports mapped.gltf -o mapped.mtlx && python3 -c "
import xml.etree.ElementTree as tree
looks = {look.get(\"name\"): [assign.get(\"material\") for assign in look] for look in tree.parse(\"mapped.mtlx\").getroot().findall(\"look\")}
assert looks == {\"a\": [\"m\"], \"b\": [\"k\"], \"c\": []}, looks"'
printf '{"asset": {"version": "2.0"}, "materials": [{"name": "m", "extensions": {"EXT_\\u001b[31m\\u009b31m": {}}}]}' >escape.gltf
check 'no control character goes to a terminal' eval 'imports escape.gltf -o escape.mtlx && has err "EXT_?[31m?31m" && ! LC_ALL=C grep -q "$(printf "\\033\\|\\302\\233")" err'
# Members of wrong types do not count, and are told.
loses() { imports wrong.gltf -o wrong.mtlx && has err '[import-loss]' "$1" && exits 0 "$mxgen" validate wrong.mtlx; }
wrong() { # MATERIAL MESSAGE: a material of this JSON has this loss
    printf '{"asset": {"version": "2.0"}, "images": [{"uri": "a[b].png"}], "textures": [{"source": 0}, {"source": 0, "sampler": 3}, {"source": 1}, {"source": 0.5}], "materials": [%s]}' "$1" >wrong.gltf
    check "a material $1: $2" loses "$2"
}
texture() { printf '{"name": "m", "pbrMetallicRoughness": {"baseColorTexture": %s}}' "$1"; }
wrong null 'a material is an object'
wrong '{"extensions": []}' "'extensions' must be an object"
wrong '{"alphaMode": "HASHED"}' "'alphaMode' must be 'OPAQUE', 'MASK' or 'BLEND'"
wrong '{"pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1]}}' "'baseColorFactor' must be an array of 4 numbers"
wrong '{"pbrMetallicRoughness": {"metallicFactor": "1"}}' "'metallicFactor' must be a number"
for set in 256 100000 4294967297 1.5 -1 '"1"'; do
    wrong "$(texture "{\"index\": 0, \"texCoord\": $set}")" "'texCoord' must be an integer from 0 to 255"
    check "and its image reads the first coordinates: $set" eval '! grep -q "<texcoord" wrong.mtlx'
done
wrong "$(texture '{"index": 0, "extensions": {"KHR_texture_transform": {"offset": [1, 2, 3]}}}')" "'offset' must be an array of 2 numbers"
wrong "$(texture '{"index": 5}')" "the texture of 'baseColorTexture' is not there"
wrong "$(texture '{"index": 1}')" "the sampler of a texture is not there"
wrong "$(texture '{"index": 2}')" "the image of 'baseColorTexture' is not there"
wrong "$(texture '{"index": 3}')" "'baseColorTexture' has no image in PNG or JPEG"
wrong "$(texture '{"index": 0}')" "MaterialX reads '[' in a name as a token"
check 'a file without materials is an error' fails empty.gltf 'it has no materials'
check 'a broken binary file is an error' fails broken.glb 'no binary glTF 2.0'
python3 - <<'END'
import struct
text = b'{"asset": {"version": "2.0"}, "materials": [{"name": "m"}]}  '
text += b" " * (-len(text) % 4)
for name, more in ("whole", 0), ("longer", 4), ("shorter", -4):
    header = b"glTF" + struct.pack("<II", 2, 20 + len(text) + more)
    open(name + ".glb", "wb").write(header + struct.pack("<I", len(text)) + b"JSON" + text)
END
check 'a binary file is as long as its header says' exits 0 "$mxgen" import whole.glb -o whole.mtlx
check 'one that is cut off is an error' fails longer.glb 'it has 84 bytes, and its header says 88'
check 'and one with bytes behind its end' fails shorter.glb 'it has 84 bytes, and its header says 80'
check 'a missing file is an error' fails missing.gltf 'No such file'
check 'a document is no glTF' fails values.mtlx 'it is no glTF'
printf 'PK\3\4' >packed.usdz
check 'nor is a package of USD' fails packed.usdz 'it is no glTF'
check 'a folder that is missing is an error' eval 'exits 1 "$mxgen" import values.gltf -o nowhere/a.mtlx && has err "[output-failed]"'
check 'the file itself is not overwritten' eval 'cp values.gltf keep.gltf && exits 1 "$mxgen" import keep.gltf -o keep.gltf && cmp values.gltf keep.gltf'
check 'wrong usage is told' exits 2 "$mxgen" import values.gltf
finish import
