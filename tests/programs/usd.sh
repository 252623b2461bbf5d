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

finish usd
