#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# mxgen export --stage (docs/export.md): objects have the materials of looks, variants are looks, and both come back. Arguments: mxgen,
# mxgen-render, the root.
mxgen=$(realpath "$1") render=$(realpath "$2") root=$(realpath "$3")
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"
has_device "$render" || { skip 'no Vulkan device'; finish export-stage; }
export MESA_SHADER_CACHE_DISABLE=true TMPDIR=$work/temporary
mkdir "$TMPDIR"

# worn FILE NODE: the material of a node's mesh, then "VARIANT=MATERIAL" in the order of the variants.
worn() {
    python3 - "$1" "$2" <<'END'
import json, sys
root = json.load(open(sys.argv[1]))
node = next(n for n in root["nodes"] if n["name"] == sys.argv[2])
primitive = root["meshes"][node["mesh"]]["primitives"][0]
name = lambda i: root["materials"][i]["name"]
variants = [v["name"] for v in root.get("extensions", {}).get("KHR_materials_variants", {"variants": []})["variants"]]
mappings = primitive.get("extensions", {}).get("KHR_materials_variants", {"mappings": []})["mappings"]
of = sorted((v, m["material"]) for m in mappings for v in m["variants"])
print(" ".join([name(primitive["material"]) if "material" in primitive else "none"] + [f"{variants[v]}={name(m)}" for v, m in of]))
END
}
wears() { # FILE NODE WORDS
    local got
    got=$(worn "$1" "$2") && [ "$got" = "$3" ] || { echo "'$got' instead of '$3'"; false; }
}

cat >room.usda <<'END'
#usda 1.0
(
    metersPerUnit = 0.01
    upAxis = "Z"
)
def Xform "room"
{
    double3 xformOp:translate = (100, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    def Cube "table"
    {
        double size = 100
    }
    def Sphere "lamp"
    {
    }
    def Sphere "mouse"
    {
    }
}
END
cat >looks.mtlx <<'END'
<?xml version="1.0"?>
<materialx version="1.39" colorspace="lin_rec709">
  <position name="place" type="vector3" xpos="1"/>
  <convert name="tone" type="color3"><input name="in" type="vector3" nodename="place"/></convert>
  <gltf_pbr name="SR_wood" type="surfaceshader"><input name="base_color" type="color3" value="0.5, 0.25, 0.125"/></gltf_pbr>
  <surfacematerial name="Wood" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SR_wood"/></surfacematerial>
  <gltf_pbr name="SR_paint" type="surfaceshader"><input name="base_color" type="color3" value="0.125, 0.25, 0.5"/></gltf_pbr>
  <surfacematerial name="Paint" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SR_paint"/></surfacematerial>
  <gltf_pbr name="SR_world" type="surfaceshader"><input name="base_color" type="color3" nodename="tone"/></gltf_pbr>
  <surfacematerial name="World" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SR_world"/></surfacematerial>
  <look name="new">
    <materialassign name="all" material="Wood" geom="/room/table"/>
  </look>
  <look name="old">
    <materialassign name="all" material="Paint" geom="/room"/>
    <materialassign name="dirt" slot="050" material="Wood" geom="/room/table"/>
    <visibility name="gone" geom="/room/mouse" visible="false"/>
  </look>
</materialx>
END
check 'a stage is written' exits 0 "$mxgen" export looks.mtlx --stage room.usda -o room.gltf
check 'with a node for each primitive' eval 'exits 0 "$mxgen" bind looks.mtlx --stage room.gltf --look old && has out "/room/table" "/room/lamp" "/room/mouse"'
check 'materials of a look are variants' wears room.gltf table 'Wood new=Wood old=Paint'
check 'a look may give none' wears room.gltf lamp 'none old=Paint'
check 'layers above the base are told once' eval '[ "$(grep -c "looks.mtlx:16) is not in the file:" err)" = 1 ] || { "$mxgen" export looks.mtlx --stage room.usda -o again.gltf 2>err; grep -F "/room/table/050'\'' (looks.mtlx:16) is not in the file: a primitive of this format has one material, that of its base, and this layer is left out [export-loss]" err; }'
check 'a look that hides is told' eval '"$mxgen" export looks.mtlx --stage room.usda -o again.gltf 2>err; has err "/room/mouse/old'\'' (room.usda) is not in the file as it is: the look hides it"'
check 'materials that nothing has are left out' eval '! grep -q World room.gltf'
check 'it stands where it stood, in metres, y upwards' eval 'grep -A4 "\"max\"" room.gltf | tr -d " \n" | grep -q "1.5,0.5,0.5"'
check 'one look has no variants' eval 'exits 0 "$mxgen" export looks.mtlx --stage room.usda --look old -o old.gltf && wears old.gltf table Paint && ! grep -q variants old.gltf && ! grep -q mouse old.gltf'
sed 's|geom="/room/mouse"|geom="/room"|' looks.mtlx >hidden.mtlx
check 'a look that hides all is told' eval 'exits 1 "$mxgen" export hidden.mtlx --stage room.usda --look old -o none.gltf && has err "the look hides all primitives of the stage [empty-mesh]" && test ! -e none.gltf'
check 'unknown looks are told' eval 'exits 1 "$mxgen" export looks.mtlx --stage room.usda --look ancient -o none.gltf && has err "ancient" && test ! -e none.gltf'
check 'a package of USD has the first look' eval 'exits 0 "$mxgen" export looks.mtlx --stage room.usda -o room_out.usda && has err "'"'"'room.usda/old'"'"' (looks.mtlx:14) is not in the file as it is: the format has one look" && has room_out.usda "rel material:binding = </room_out/Materials/Wood>" && ! grep -q Paint room_out.usda'
check 'which is drawn again' exits 0 "$render" --stage room_out.usda -s 32 -Wno-unread-input -o room.png

# ---- The way back ----

check 'variants come back as looks' exits 0 "$mxgen" import room.gltf -o back.mtlx -Werror
check 'by the paths of the stage' has back.mtlx '<look name="new">' '<materialassign name="Wood" material="Wood" geom="/room/table"/>' \
    '<materialassign name="Paint" material="Paint" geom="/room/table, /room/lamp"/>'
check 'and bind alike' eval 'exits 0 "$mxgen" bind back.mtlx --stage room.gltf --look old -Werror && has out "/room/lamp" "[000 Paint]"'

# A mesh of two primitives, two nodes of one name, and one without; twice the same node.
cat >parts.py <<'END'
import json
of = lambda *pairs: {"KHR_materials_variants": {"mappings": [{"material": m, "variants": v} for m, v in pairs]}}
primitive = lambda m, *pairs: {"attributes": {"POSITION": 0}, "indices": 1, "material": m, "extensions": of(*pairs)}
json.dump({
    "asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_variants"],
    "extensions": {"KHR_materials_variants": {"variants": [{"name": "day"}, {"name": "night"}]}},
    "materials": [{"name": "A"}, {"name": "B"}], "scene": 0, "scenes": [{"nodes": [0, 1, 2, 0, 99]}],
    "nodes": [{"name": "door", "mesh": 0}, {"name": "door", "mesh": 1}, {"mesh": 1, "children": [3, 2]}, {"name": "knob", "mesh": 1}],
    "meshes": [{"name": "leaf", "primitives": [primitive(0, (1, [1])), primitive(1, (0, [0, 1]))]}, {"primitives": [primitive(0, (1, [0]))]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                  {"bufferView": 1, "componentType": 5125, "count": 3, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 12}],
    "buffers": [{"byteLength": 48, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAEAAAACAAAA"}],
}, open("parts.gltf", "w"))
END
python3 parts.py
check 'parts of a mesh have paths of their own' eval 'exits 0 "$mxgen" import parts.gltf -o parts.mtlx -Werror && has parts.mtlx "<look name=\"day\">" \
    "<materialassign name=\"A\" material=\"A\" geom=\"/door/leaf_0, /door/leaf_1\"/>" "<materialassign name=\"B\" material=\"B\" geom=\"/door_2, /nodes_2_, /nodes_2_/knob\"/>"'
sed 's/\[0, 1, 2, 0, 99\]/[0, 1, 2]/; s/\[3, 2\]/[3]/' parts.gltf >sound.gltf
check 'which those of the stage are' eval 'exits 0 "$mxgen" bind parts.mtlx --stage sound.gltf --look night && ! grep -q unmatched err && has out "/door_2" && ! grep -q "matches no primitive" err'

# ---- Faults ----

check 'a look needs a stage' exits 2 "$mxgen" export looks.mtlx --look old -o none.gltf
check 'a stage that is missing is told' eval 'exits 1 "$mxgen" export looks.mtlx --stage none.usda -o none.gltf && has err none.usda && test ! -e none.gltf'
sed 's/material="Wood" geom="\/room\/table"/material="World" geom="\/room\/table"/' looks.mtlx >world.mtlx
check 'places in the world need a surface' eval 'exits 1 "$mxgen" export world.mtlx --stage room.usda -o none.gltf && has err "[bake-mesh]" && test ! -e none.gltf'
check 'which is another mesh' exits 0 "$mxgen" export world.mtlx --stage room.usda --mesh sphere --size 16 -o world.gltf
check 'a stage brings its own materials' eval 'exits 0 "$mxgen" export --stage room_out.usda -o own.gltf && wears own.gltf room_table Wood'
check 'it stays as it is' eval 'cp room.usda keep.usda && exits 1 "$mxgen" export looks.mtlx --stage keep.usda -o keep.usda && has err "[output-clash]" && cmp room.usda keep.usda'
check 'nothing of failures is left' test "$(ls -A "$TMPDIR" | wc -l)" = 0
if [ -d "$root/tests/npm/node_modules/gltf-validator" ] && command -v node >valid.log; then
    check "Khronos' validator has no objection" eval 'NODE_PATH=$root/tests/npm/node_modules node "$here/validate_gltf.cjs" room.gltf old.gltf world.gltf own.gltf'
else
    skip 'no gltf-validator (npm ci --prefix tests/npm) or no node'
fi
finish export-stage
