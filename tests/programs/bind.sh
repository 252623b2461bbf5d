#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# mxgen bind as a user runs it; tests/api/rules.def has the rules. Argument: the program.
mxgen=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
examples=$here/../../examples
looks=$examples/slots/looks.mtlx receiver=$examples/slots/receiver.usda
. "$here/common.sh"

bind() { "$mxgen" bind look.mtlx --stage stage.txt "$@"; }
# Runs Python on the JSON: `d` is the document, `p` its primitives by path.
json() { # expression
    python3 -c "import json; d = json.load(open('out')); p = {x['path']: x for x in d['primitives']}; assert $1, d"
}

cat >materials.mtlx <<'XML'
<materialx version="1.39">
  <standard_surface name="SR" type="surfaceshader"/>
  <surfacematerial name="Clay" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SR"/></surfacematerial>
  <surfacematerial name="Dust" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SR"/></surfacematerial>
</materialx>
XML
cat >overrides.mtlx <<'XML'
<materialx version="1.39">
  <nodegraph name="NG"><constant name="c" type="float"/><output name="base" type="float" nodename="c"/></nodegraph>
</materialx>
XML
cat >look.mtlx <<'XML'
<materialx version="1.39" xmlns:xi="http://www.w3.org/2001/XInclude">
  <xi:include href="materials.mtlx"/>
  <xi:include href="overrides.mtlx"/>
  <variantset name="wear"><variant name="old"><input name="base" type="float" value="0.5"/></variant></variantset>
  <variantset name="other" node="gltf_pbr"><variant name="old"><input name="base" type="float" value="0.5"/></variant></variantset>
  <look name="day">
    <variantassign name="v0" variantset="other" variant="old"/>
    <materialassign name="clay" material="Clay" geom="/set"/>
    <materialassign slot="000::010" nodegraph="NG" geom="/set/cup"/>
    <materialassign name="dust" slot="050" material="Dust" geom="//*">
      <variantassign name="v1" variantset="wear" variant="old"/>
    </materialassign>
  </look>
</materialx>
XML
printf '# a stage\n\n  /set/cup/handle\n/set/plate\r\n' >stage.txt

check 'a table' exits 0 bind
check 'has a row for each primitive' grep -qE '^/set/cup/handle +\(000 Clay\) \(::010 NG\)  \[050 Dust\]$' out
check 'groups, too' grep -qE '^/set +\[000 Clay\]$' out
check 'and no colour' eval '! grep -q "$(printf "\033")" out'
check 'JSON' exits 0 bind --json -
check 'has the primitives in the order of the scene' json 'list(p) == ["/set", "/set/cup", "/set/cup/handle", "/set/plate"]'
check 'layers' json '[x["slot"] for x in p["/set/plate"]["layers"]] == ["000", "050"]'
check 'where they come from' json 'p["/set/plate"]["layers"][0]["from"] == "/set" and p["/set/plate"]["layers"][0]["inherited"] is True'
check 'their assignment' json 'p["/set"]["layers"][0]["assign"] == "day/clay look.mtlx:8"'
check 'or its number' json 'p["/set/cup"]["layers"][0]["overrides"][0]["assign"] == "day/#2 look.mtlx:9"'
check 'overrides' json 'p["/set/cup"]["layers"][0]["overrides"][0]["nodegraph"] == "NG"'
check 'variants that apply' json 'p["/set/plate"]["layers"][1]["variants"] == [{"variantset": "wear", "variant": "old"}]'
check 'and no others' json '"variants" not in p["/set/plate"]["layers"][0]'
check 'stacks' json 'sum(len(s["primitives"]) for s in d["stacks"]) == 4 and all(p[x]["stack"] == s["name"] for s in d["stacks"] for x in s["primitives"])'
check 'equal layers share a stack' eval 'printf "/set/bowl\n" >>stage.txt; bind --json - >out; json "p[\"/set/bowl\"][\"stack\"] == p[\"/set/plate\"][\"stack\"]"'
cp out before.json
# The library of materials changes, the bindings do not.
sed -i 's/standard_surface/gltf_pbr/; s/<surfacematerial name="Dust"/<!-- more -->\n\n  &/' materials.mtlx
check 'another library' exits 0 bind --json -
check 'has the variants of its shaders' json 'p["/set"]["layers"][0]["variants"] == [{"variantset": "other", "variant": "old"}]'
sed -i 's/gltf_pbr/open_pbr_surface/' materials.mtlx
check 'a library with other shaders' exits 0 bind --json -
check 'the same bindings' diff before.json out
check 'a file' exits 0 bind --json bindings.json
check 'has the same, and nothing is printed' eval 'diff before.json bindings.json && [ ! -s out ]'
# An empty stage, an empty stack.
: >empty.txt
check 'an empty stage' exits 0 "$mxgen" bind look.mtlx --stage empty.txt --json -
check 'has no primitives' json 'd == {"primitives": [], "stacks": []}'
printf '/other/x\n' >other.txt
check 'without layers' exits 0 "$mxgen" bind look.mtlx --stage other.txt --mute 050 --json -
check 'layers is an empty list' json 'p["/other/x"]["layers"] == [] and p["/other"]["stack"] == p["/other/x"]["stack"]'

check 'reasons' exits 0 bind --geom /set/cup
check 'name the winner' eval 'grep -A1 "000::010  nodegraph NG, day/#2 (look.mtlx:9) at /set/cup" out | grep -q "wins: an override"'
check 'solo' exits 0 bind --solo 050
check 'shows one slot' eval 'grep -qE "^/set/plate +\[050 Dust\]$" out && grep -qE "^/set +default$" out'
check 'solo of an override keeps its slot' exits 0 bind --solo 000::010
check 'and no other' grep -qE '^/set/cup/handle +\(000 Clay\) \(::010 NG\)$' out
check 'mute' exits 0 bind --mute 000
check 'leaves out a slot and its overrides' eval 'grep -qE "^/set/cup/handle +\[050 Dust\]$" out'
check 'silently' test ! -s err
check 'mute of an override' exits 0 bind --mute 000::010
check 'leaves the slot' grep -qE '^/set/cup/handle +\(000 Clay\)  \[050 Dust\]$' out

# fails ID ARGUMENT...: the command ends with 1 and tells the message.
fails() { exits 1 "$mxgen" bind "${@:2}" && grep -qF "[$1]" err; }
check 'an unknown slot' fails unknown-slot look.mtlx --stage stage.txt --solo 051
check 'no slot at all' fails bad-slot look.mtlx --stage stage.txt --mute 'a b'
check 'an unknown primitive' fails unknown-primitive look.mtlx --stage stage.txt --geom /set/cap
check 'is compared, too' grep -qF "did you mean '/set/cup'" err
check 'an unknown look' fails unknown-look look.mtlx --stage stage.txt --look dya
check 'a document without a look' fails look-missing materials.mtlx --stage stage.txt
sed 's|</look>|<materialassign material="Lost" geom="/set" slot="070"/></look>|' look.mtlx >faulty.mtlx
check 'an assignment of nothing known' fails unknown-assigned faulty.mtlx --stage stage.txt --look day
check 'stands beside the layers that are left' eval 'grep -qF "000 Clay" out && ! grep -qF 070 out'
check 'in an explanation, too' eval 'fails unknown-assigned faulty.mtlx --stage stage.txt --look day --geom /set/cup && grep -qF "000" out'
check 'but not in a file for programs' eval 'fails unknown-assigned faulty.mtlx --stage stage.txt --look day --json faulty.json && [ ! -e faulty.json ]'
check 'several looks' eval 'sed "s|</materialx>|<look name=\"night\"/></materialx>|" look.mtlx >two.mtlx; fails look-needed two.mtlx --stage stage.txt'
check 'are listed' grep -qF 'day, night' err
printf '/set/a\nset/b\n/set//c\n' >bad.txt
check 'a path that is none' fails bad-path look.mtlx --stage bad.txt
check 'with its line' eval 'grep -q "^bad.txt:2:1: error" err && grep -q "^bad.txt:3:1: error" err'
check 'a stage that is missing' fails file-missing look.mtlx --stage none.txt
check 'no stage' exits 2 "$mxgen" bind look.mtlx
check 'a document in the folder of the output' exits 1 bind --json none/out.json

# Stages of USD.
cat >stage.usda <<'USD'
#usda 1.0
(
    defaultPrim = "set"
)
over "Flattened_Prototype_1"
{
    def Mesh "leg"
    {
        rel material:binding = </Looks/Clay>
    }
}
def Xform "set"
{
    uniform token[] material:slotOrder = ["000", "dust", "base"]
    rel material:slotBinding:_dust = </Looks/Dust>
    rel material:slotBinding:_base = </Looks/Clay>
    def Xform "table" (
        instanceable = true
        references = </Flattened_Prototype_1>
    )
    {
        rel material:slotBinding:_dust:_:_010 = </Looks/Clay>
    }
    def Xform "stool" (
        references = </Flattened_Prototype_1>
    )
    {
    }
    def Mesh "cup"
    {
        rel material:slotBinding:_dust = None
        rel material:binding = None
        rel material:binding:full = </Looks/Dust>
        rel material:binding:preview = </Looks/Clay>
        def GeomSubset "rim"
        {
            uniform token familyName = "materialBind"
            rel material:slotBinding:_000 = </Looks/Dust>
            rel material:binding = </Looks/Clay>
        }
        def GeomSubset "faces"
        {
            uniform token familyName = "other"
        }
    }
    def Xform "shelf"
    {
        rel material:binding = </Looks/Dust> (
            bindMaterialAs = "strongerThanDescendants"
        )
        def Mesh "board"
        {
            rel material:binding = </Looks/Clay>
        }
    }
}
def Material "Clay"
{
    def Shader "S"
    {
    }
}
USD
usd() { "$mxgen" bind "${document:-materials.mtlx}" --stage stage.usda "$@"; }
row() { sed 's/  */ /g' out | grep -qxF "$1" || { cat out; return 1; }; }
check 'a stage of USD, without a look' exits 0 usd
check 'brings its own bindings, in its slotOrder' row '/set [dust Dust] [base Clay]'
check 'instances are primitives' row '/set/table/leg [000 Clay] (dust Dust) (::010 Clay) (base Clay)'
check 'each by itself' row '/set/stool/leg [000 Clay] (dust Dust) (base Clay)'
check 'None removes a slot' row '/set/cup (base Clay)'
check 'a slot binding beats a plain one' row '/set/cup/rim [000 Dust] (base Clay)'
check 'a stronger binding beats those below' row '/set/shelf/board (000 Dust) (dust Dust) (base Clay)'
check 'no shading and no other subsets' eval '! grep -qE "/Clay|/faces|Prototype" out'
check 'JSON names the property' exits 0 usd --json -
check 'and its line' json 'p["/set/table/leg"]["layers"][0]["assign"] == "/set/table/leg.material:binding stage.usda:9"'
check 'a purpose' exits 0 usd --purpose full
check 'beats all others' row '/set/cup/rim (000 Dust) (base Clay)'
check 'the other purpose' exits 0 usd --purpose preview
check 'has its own binding' row '/set/cup [000 Clay] (base Clay)'
sed 's|<look name="day">|&<materialassign slot="000" material="Clay" geom="/set/shelf, /set/stool"/>|' look.mtlx >over.mtlx
check 'with a look' exits 0 env document=over.mtlx "$mxgen" bind over.mtlx --stage stage.usda --mute 050
check 'a look beats the scene at one path' row '/set/shelf [000 Clay] (dust Dust) (base Clay)'
check 'and what a stronger binding has beaten' row '/set/shelf/board (000 Clay) (dust Dust) (base Clay)'
check 'but deeper wins' row '/set/stool/leg [000 Clay] (dust Dust) (base Clay)'
check 'reasons name it' exits 0 usd --geom /set/shelf/board
check 'as stronger' grep -q 'loses to /set/shelf.material:binding, which is stronger than bindings of the scene below it' out
cat >leaves.mtlx <<'XML'
<materialx version="1.39"><xi:include xmlns:xi="http://www.w3.org/2001/XInclude" href="materials.mtlx"/>
  <look name="l"><materialassign slot="leaf" material="Clay" geom="//*"/></look></materialx>
XML
check 'a mesh with subsets is no leaf' exits 0 "$mxgen" bind leaves.mtlx --stage stage.usda --look l
check 'its subset is one' eval 'grep -E "^/set/cup/rim .*\[leaf Clay\]" out && ! grep -E "^/set/cup .*leaf" out && grep -E "^/set/shelf/board .*leaf" out'
check 'an unknown slot of the stage' fails unknown-slot materials.mtlx --stage stage.usda --solo dsut
check 'is compared' grep -qF "did you mean 'dust'" err
# broken SCRIPT ID [LINE]: the stage, edited by sed.
broken() {
    sed "$1" stage.usda >broken.usda
    fails "$2" materials.mtlx --stage broken.usda && grep -q "^broken.usda:${3:-}" err
}
check 'a syntax error' broken 's/def Xform "shelf"/def Xform shelf/' usda-syntax 46:15
check 'no text' broken '1s/.*/PXR-USDC/' usda-syntax 1:1
check 'another arc' broken 's/instanceable = true/payload = @x.usda@/' usda-arc 17
check 'a reference to a file' broken 's|references = </Flattened_Prototype_1>|references = @x.usda@|' usda-reference 17
check 'a reference to nothing' broken 's|references = </Flattened_Prototype_1>|references = </Prototype>|' usda-reference 17
check 'a cycle' broken 's|def Mesh "leg"|def Mesh "leg" ( references = </Flattened_Prototype_1> )|' usda-cycle 7
check 'a slot that is none' broken 's/slotBinding:_dust = None/slotBinding:dust = None/' bad-binding 31
check 'a material that is none' broken 's|</Looks/Dust>|</Looks/Duts>|' unknown-assigned 15:
# Collections of USD: /s holds three bindings, of which the first wins, and one in a slot.
cat >collections.usda <<'USD'
#usda 1.0
def Xform "s"
{
    rel material:binding = </Looks/Clay>
    rel material:binding:collection:first = [</s.collection:metal>, </Looks/Dust>]
    rel material:binding:collection:second = [</s.collection:all>, </Looks/Clay>]
    rel material:binding:collection:full:third = [</s.collection:all>, </Looks/Clay>]
    rel material:slotBinding:collection:_050:_:_010:top = [</s.collection:outer>, </Looks/Clay>]
    rel material:slotBinding:_050 = </Looks/Dust>
    rel material:slotBinding:collection:_060:nested = [</s.collection:nested>, </Looks/Dust>]
    rel material:slotBinding:collection:_070:empty = [</s.collection:empty>, </Looks/Dust>]
    rel collection:nested:includes = </s/a/b>
    rel collection:nested:excludes = [</s>, </s/a/b/c>]
    rel collection:empty:includes = []
    rel collection:metal:includes = [</s/a>, </s/a/b/c>]
    rel collection:metal:excludes = </s/a/b>
    rel collection:all:includes = </s>
    rel collection:outer:includes = [</s.collection:only>, </s/d>]
    uniform token collection:only:expansionRule = "explicitOnly"
    rel collection:only:includes = </s/a>
    def Xform "a"
    {
        def Xform "b"
        {
            def Mesh "c"
            {
            }
        }
        def Mesh "own"
        {
            rel material:binding = </Looks/Clay>
        }
    }
    def Mesh "d"
    {
    }
}
def Mesh "outside"
{
}
USD
check 'collections of USD' exits 0 "$mxgen" bind materials.mtlx --stage collections.usda
check 'hold what is below their paths' row '/s/a (000 Dust) (050 Dust) (::010 Clay)'
check 'but not what is excluded' row '/s/a/b (000 Clay) (050 Dust) (060 Dust)'
check 'and again what a deeper path includes' row '/s/a/b/c (000 Dust) (050 Dust)'
check 'of several exclusions the deepest counts' row '/s/a/b/c (000 Dust) (050 Dust)'
check 'a deeper binding wins' row '/s/a/own [000 Clay] (050 Dust)'
check 'of several the first wins, over the direct one' row '/s/d (000 Clay) (050 Dust) (::010 Clay)'
check 'only at or below their prim' row '/outside default'
check 'for a purpose' exits 0 "$mxgen" bind materials.mtlx --stage collections.usda --purpose full
check 'which beats the others' row '/s/a (000 Clay) (050 Dust) (::010 Clay)'
check 'reasons of a prim in collections' exits 0 "$mxgen" bind materials.mtlx --stage collections.usda --geom /s/a
check 'a collection that is missing' eval 'sed -i "s/s.collection:metal>/s.collection:mteal>/" collections.usda; fails bad-binding materials.mtlx --stage collections.usda'

# Materials of the stage: a network, the same as nodes of MaterialX.
cat >network.usda <<'USD'
#usda 1.0
def Mesh "m"
{
    rel material:binding = </Looks/Net>
}
def Material "Net"
{
    float inputs:amount = 0.25
    token outputs:mtlx:surface.connect = </Net/Surface.outputs:out>
    def Shader "Surface"
    {
        uniform token info:id = "ND_standard_surface_surfaceshader"
        color3f inputs:base_color.connect = </Net/Graph.outputs:color>
        float inputs:base = 0.5
    }
    def NodeGraph "Graph"
    {
        color3f outputs:color.connect = </Net/Graph/Mix.outputs:out>
        def Shader "Mix"
        {
            uniform token info:id = "ND_mix_color3"
            color3f inputs:bg = (1, 0, 0)
            color3f inputs:fg = (0, 0, 1)
            float inputs:mix.connect = </Net.inputs:amount>
        }
    }
}
USD
check 'a stage without a document' exits 0 "$mxgen" bind --stage network.usda
check 'has its own materials' row '/m [000 Net]'
cat >like.mtlx <<'XML'
<materialx version="1.39"><look name="l"><materialassign material="Net" geom="/m"/></look></materialx>
XML
check 'a look assigns them' exits 0 "$mxgen" bind like.mtlx --stage network.usda
check 'an input of the document wins' eval 'sed "s|<look|<standard_surface name=\"x\" type=\"surfaceshader\"/><surfacematerial name=\"Net\" type=\"material\"><input name=\"surfaceshader\" type=\"surfaceshader\" nodename=\"x\"/></surfacematerial>&|" like.mtlx >own.mtlx; exits 0 "$mxgen" bind own.mtlx --stage network.usda'
check 'a shader without a definition' eval 'sed s/ND_mix_color3/ND_mxi_color3/ network.usda >odd.usda; "$mxgen" bind --stage odd.usda 2>err; grep -q "^odd.usda:.*\[usda-shader\]" err'
# odd SED ID LINE:COLUMN: the network has a fault at its place.
odd() { sed "$1" network.usda >odd.usda && ! cmp -s network.usda odd.usda && fails "$2" --stage odd.usda && grep -q "^odd.usda:$3: error" err; }
check 'a type that the definition has not' odd 's/float inputs:base = 0.5/color3f inputs:base = (1, 1, 1)/' usda-type 14:17
check 'a role is a type of its shape' odd 's/color3f inputs:bg = (1, 0, 0)/float3 inputs:bg = (1, 0)/' usda-value 22:20
check 'and is no fault' eval 'sed "s/color3f inputs:bg/vector3f inputs:bg/; s/float inputs:base = 0.5/double inputs:base = 0.5/" network.usda >roles.usda; exits 0 "$mxgen" bind --stage roles.usda; test ! -s err'
check 'an integer for a number' odd 's/float inputs:base = 0.5/int inputs:base = 1/' usda-type 14:13
check 'a type of USD alone' odd 's/float inputs:base = 0.5/quatf inputs:base = (1, 0, 0, 0)/' usda-type 14:15
check 'an input of the material of another type' odd 's/float inputs:amount = 0.25/color3f inputs:amount = (1, 1, 1)/' usda-type 8:13
check 'a number for a colour' odd 's/inputs:fg = (0, 0, 1)/inputs:fg = 0.5/' usda-value 23:21
check 'a number too many' odd 's/inputs:fg = (0, 0, 1)/inputs:fg = (0, 0, 1, 0)/' usda-value 23:21
check 'a text for a colour' odd 's/inputs:fg = (0, 0, 1)/inputs:fg = "blue"/' usda-value 23:21
check 'a list for a number' odd 's/inputs:base = 0.5/inputs:base = [0.5]/' usda-value 14:15
check 'a connection to an input that is missing' odd 's/<\/Net.inputs:amount>/<\/Net.inputs:amuont>/' usda-connection 24:19
check 'to a prim that is missing' odd 's/<\/Net\/Graph\/Mix.outputs:out>/<\/Net\/Graph\/Mxi.outputs:out>/' usda-connection 18:17
check 'to no port' odd 's/<\/Net.inputs:amount>/<\/Net>/' usda-connection 24:19
check 'a value that is blocked' eval 'sed "s/inputs:base = 0.5/inputs:base = None/" network.usda >blocked.usda; exits 0 "$mxgen" bind --stage blocked.usda; test ! -s err'
check 'a document without a stage' exits 2 "$mxgen" bind like.mtlx

# Overrides of the stage: a Material without terminals, and a NodeGraph.
cat >drives.usda <<'USD'
#usda 1.0
def Xform "set"
{
    rel material:slotBinding:_000 = </Looks/Paint>
    rel material:slotBinding:_000:_:_010 = </Looks/Red>
    def Mesh "a"
    {
        rel material:slotBinding:_000:_:_020 = </Looks/Pattern>
    }
}
def Scope "Looks"
{
    def Material "Paint"
    {
        token outputs:mtlx:surface.connect = </Looks/Paint/S.outputs:out>
        def Shader "S"
        {
            uniform token info:id = "ND_surface_unlit"
            color3f inputs:emission_color = (0, 0, 1)
        }
    }
    def Material "Red"
    {
        color3f inputs:color = (1, 0, 0)
        color3f outputs:emission_color.connect = </Looks/Red.inputs:color>
        float outputs:opacity = 0.5
        float outputs:nothing
    }
    def NodeGraph "Pattern"
    {
        float outputs:emission.connect = </Looks/Pattern/N.outputs:out>
        def Shader "N"
        {
            uniform token info:id = "ND_noise3d_float"
            float inputs:amplitude = 0.25
        }
    }
    def NodeGraph "Unused"
    {
        float outputs:emission.connect = </Looks/Unused/N.outputs:out>
        def Shader "N"
        {
            uniform token info:id = "ND_none"
        }
    }
}
USD
echo '<materialx version="1.39"/>' >nothing.mtlx
check 'overrides of a stage' exits 0 "$mxgen" bind --stage drives.usda
check 'without a warning' test ! -s err
check 'are layers' row '/set/a (000 Paint) (::010 Red) [::020 Pattern]'
check 'the JSON' exits 0 "$mxgen" bind --stage drives.usda --json -
check 'calls them graphs' json '[o["nodegraph"] for o in p["/set/a"]["layers"][0]["overrides"]] == ["Red", "Pattern"]'
# main PATH: what the shader of a primitive does
main() { sed -n '/^void main/,$p' "drives.d/$(python3 -c "import json; print({p['path']: p['stack'] for p in json.load(open('drives.d/bindings.json'))['primitives']}['$1'])").frag"; }
check 'shaders of materials of the stage' exits 0 "$mxgen" nothing.mtlx --stage drives.usda --target vulkan --interface reduced -o drives.d
check 'values drive inputs' eval 'main /set | grep -qF "out1 = vec4(0.5, 0.0, 0.0, 0.5)"'
check 'and networks' eval 'main /set/a | grep -qF "mx_noise_float(vd.positionObject) * 0.25 * 0.5 * vec3(1.0, 0.0, 0.0)"'
check 'a material with terminals overrides by its shaders' eval 'sed "s|float outputs:nothing|token outputs:surface.connect = </Looks/Paint/S.outputs:out>|" drives.usda >both.usda; exits 0 "$mxgen" bind --stage both.usda --json - && json "p[\"/set\"][\"layers\"][0][\"overrides\"][0][\"material\"] == \"Red\""'

# Files of Assimp come through mxgen-render: the same primitives as in USD.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\ng left\nf 1 2 3\n' >one.obj
sed 's|</materialx>|<look name="l"><materialassign material="Clay" geom="/left"/></look>&|' materials.mtlx >obj.mtlx
if [ -x "$(dirname "$mxgen")/mxgen-render" ]; then
    check 'a stage of glTF' exits 0 "$mxgen" bind "$looks" --stage "$examples/slots/receiver.gltf" --look finished --json gltf.json
    check 'of USD' exits 0 "$mxgen" bind "$looks" --stage "$receiver" --look finished --json usda.json
    check 'has the same bindings' diff gltf.json usda.json
    check 'a stage of OBJ' exits 0 "$mxgen" bind obj.mtlx --stage one.obj
    check 'has its groups' row '/left [000 Clay]'
    check 'shaders for it' exits 0 "$mxgen" obj.mtlx --stage one.obj --look l -o obj.d
    echo x >bad.gltf
    check 'a file that it cannot read' exits 1 "$mxgen" bind obj.mtlx --stage bad.gltf
    check 'says so once' test "$(grep -c '\[bad-mesh\]' err)" = 1
else
    skip 'without Assimp no glTF is read'
fi
mkdir alone
cp "$mxgen" alone/mxgen
check 'without the renderer' exits 1 env PATH=/nonexistent LD_LIBRARY_PATH="$(dirname "$mxgen")" alone/mxgen bind obj.mtlx --stage one.obj
check 'an error says that it is missing' grep -qF '[no-renderer]' err

# Looks as slot bindings of USD: reading them again gives the same stacks.
cat >stacks.py <<'PY'
import json, sys
read = lambda file: {p["path"]: (p["stack"], [l["slot"] for l in p["layers"]]) for p in json.load(open(file))["primitives"]}
assert read(sys.argv[1]) == read(sys.argv[2]), (read(sys.argv[1]), read(sys.argv[2]))
PY
# round_trip DOCUMENT STAGE OPTION...: the look of a document as USD, and back, with the document's materials alone.
round_trip() {
    exits 0 "$mxgen" bind "$1" --stage "$2" --json before.json --usda round.usda "${@:3}" || return
    sed "s|href=\"\([^/]\)|href=\"$examples/slots/\1|" "$1" | python3 -c 'import re, sys; print(re.sub(r"<look [^>]*/>|<look .*?</look>", "", sys.stdin.read(), flags=re.S))' >without.mtlx
    exits 0 "$mxgen" bind without.mtlx --stage round.usda --json after.json && python3 stacks.py before.json after.json
}
check 'the bindings of a stage as USD' round_trip materials.mtlx stage.usda
check 'a look as USD' round_trip "$looks" "$receiver" --look finished
check 'without a warning' test ! -s err
check 'says on a primitive only what is new' eval '! grep -A4 "def \"bar_1\"" round.usda | grep -q _050'
check 'slot 000 as the plain binding, which tools without slots know' grep -q 'rel material:binding = </Looks/ribbed_steel>' round.usda
check 'behind all others of its prim' eval '! grep -A1 "rel material:binding = " round.usda | grep -q slotBinding'
check 'and not a second time' eval '! grep -q "slotBinding:_000 = <" round.usda'
check 'removes' grep -q 'material:slotBinding:_050 = None' round.usda
check 'names overrides' grep -q 'rel material:slotBinding:_000:_:_020 = </Looks/red_color>' round.usda
check 'names vertical layers' grep -q 'rel material:slotBinding:_000:over:_010 = </Looks/varnish>' round.usda
sed "s|<look name=\"default\"/>|<look name=\"default\" slotorder=\"050, 000, 010, 020, 040\"/>|; s|href=\"|&$examples/slots/|" "$looks" >ordered.mtlx
check 'a look with a slotorder' round_trip ordered.mtlx "$receiver" --look finished
check 'which USD has, too' grep -q 'uniform token\[\] material:slotOrder = \["050", "000"' round.usda
check 'variants have no place' exits 0 bind --usda lossy.usda
check 'which a warning says' grep -qF '[usda-loss]' err
check 'a folder that is missing' exits 1 bind --usda none/out.usda

# The example, as docs/slots.md shows it.
check 'examples/slots/looks.mtlx' exits 0 "$mxgen" bind "$looks" --stage "$receiver" --look finished
check 'without a warning' test ! -s err
while read -r row; do
    check "docs/slots.md: $row" eval 'sed "s/  */ /g" out | grep -qxF "$(sed "s/  */ /g" <<<"$row")"'
done < <(grep -E '^    /receiver' "$here/../../docs/slots.md")
for look in default base pattern metal replaced red dirty light clean sign sign_add sign_none; do
    check "its look $look" exits 0 "$mxgen" bind "$looks" --stage "$receiver" --look "$look"
done

finish bind
