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

check 'the layers of a stage are printed' exits 0 bind
check 'each primitive has a row' grep -qE '^/set/cup/handle +\(000 Clay\) \(::010 NG\)  \[050 Dust\]$' out
check 'each group has a row' grep -qE '^/set +\[000 Clay\]$' out
check 'a pipe gets no colours' eval '! grep -q "$(printf "\033")" out'
check 'the layers can be JSON' exits 0 bind --json -
check 'the JSON has the primitives in the order of the scene' json 'list(p) == ["/set", "/set/cup", "/set/cup/handle", "/set/plate"]'
check 'the JSON has the layers of a primitive' json '[x["slot"] for x in p["/set/plate"]["layers"]] == ["000", "050"]'
check 'the JSON says where a layer comes from' json 'p["/set/plate"]["layers"][0]["from"] == "/set" and p["/set/plate"]["layers"][0]["inherited"] is True'
check 'the JSON names the assignment of a layer' json 'p["/set"]["layers"][0]["assign"] == "day/clay look.mtlx:8"'
check 'the JSON numbers an assignment without a name' json 'p["/set/cup"]["layers"][0]["overrides"][0]["assign"] == "day/#2 look.mtlx:9"'
check 'the JSON has the overrides of a layer' json 'p["/set/cup"]["layers"][0]["overrides"][0]["nodegraph"] == "NG"'
check 'the JSON has the variants that apply' json 'p["/set/plate"]["layers"][1]["variants"] == [{"variantset": "wear", "variant": "old"}]'
check 'the JSON has no variants that do not apply' json '"variants" not in p["/set/plate"]["layers"][0]'
check 'the JSON has the stacks with their primitives' json 'sum(len(s["primitives"]) for s in d["stacks"]) == 4 and all(p[x]["stack"] == s["name"] for s in d["stacks"] for x in s["primitives"])'
check 'primitives with equal layers share a stack' eval 'printf "/set/bowl\n" >>stage.txt; bind --json - >out; json "p[\"/set/bowl\"][\"stack\"] == p[\"/set/plate\"][\"stack\"]"'
cp out before.json
# The library of materials changes, the bindings do not.
sed -i 's/standard_surface/gltf_pbr/; s/<surfacematerial name="Dust"/<!-- more -->\n\n  &/' materials.mtlx
check 'another library of materials gives bindings' exits 0 bind --json -
check 'the variants are those of its shaders' json 'p["/set"]["layers"][0]["variants"] == [{"variantset": "other", "variant": "old"}]'
sed -i 's/gltf_pbr/open_pbr_surface/' materials.mtlx
check 'a library with other shaders gives bindings' exits 0 bind --json -
check 'other shaders do not change the bindings' diff before.json out
check 'the JSON can go to a file' exits 0 bind --json bindings.json
check 'the file has the same text, and nothing is printed' eval 'diff before.json bindings.json && [ ! -s out ]'
# An empty stage, an empty stack.
: >empty.txt
check 'an empty stage is accepted' exits 0 "$mxgen" bind look.mtlx --stage empty.txt --json -
check 'an empty stage has no primitives' json 'd == {"primitives": [], "stacks": []}'
printf '/other/x\n' >other.txt
check 'a stage without layers is accepted' exits 0 "$mxgen" bind look.mtlx --stage other.txt --mute 050 --json -
check 'a primitive without layers has an empty list' json 'p["/other/x"]["layers"] == [] and p["/other"]["stack"] == p["/other/x"]["stack"]'

check 'the reasons of a primitive are printed' exits 0 bind --geom /set/cup
check 'the reasons name the assignment that wins' eval 'grep -A1 "000::010  nodegraph NG, day/#2 (look.mtlx:9) at /set/cup" out | grep -q "wins: an override"'
check '--solo is accepted' exits 0 bind --solo 050
check '--solo shows one slot' eval 'grep -qE "^/set/plate +\[050 Dust\]$" out && grep -qE "^/set +default$" out'
check '--solo takes an override' exits 0 bind --solo 000::010
check '--solo of an override keeps its slot' grep -qE '^/set/cup/handle +\(000 Clay\) \(::010 NG\)$' out
check '--mute is accepted' exits 0 bind --mute 000
check '--mute leaves out a slot and its overrides' eval 'grep -qE "^/set/cup/handle +\[050 Dust\]$" out'
check '--mute prints no warning' test ! -s err
check '--mute takes an override' exits 0 bind --mute 000::010
check '--mute of an override leaves the slot' grep -qE '^/set/cup/handle +\(000 Clay\)  \[050 Dust\]$' out

# fails ID ARGUMENT...: the command ends with 1 and tells the message.
fails() { exits 1 "$mxgen" bind "${@:2}" && grep -qF "[$1]" err; }
check 'an unknown slot is an error' fails unknown-slot look.mtlx --stage stage.txt --solo 051
check 'a word that is no slot is an error' fails bad-slot look.mtlx --stage stage.txt --mute 'a b'
check 'an unknown primitive is an error' fails unknown-primitive look.mtlx --stage stage.txt --geom /set/cap
check 'an unknown primitive has a suggestion' grep -qF "did you mean '/set/cup'" err
check 'an unknown look is an error' fails unknown-look look.mtlx --stage stage.txt --look dya
check 'a document without a look is an error' fails look-missing materials.mtlx --stage stage.txt
sed 's|</look>|<materialassign material="Lost" geom="/set" slot="070"/></look>|' look.mtlx >faulty.mtlx
check 'an unknown material of an assignment is an error' fails unknown-assigned faulty.mtlx --stage stage.txt --look day
check 'the layers that are left stand beside the error' eval 'grep -qF "000 Clay" out && ! grep -qF 070 out'
check 'the reasons stand beside the error' eval 'fails unknown-assigned faulty.mtlx --stage stage.txt --look day --geom /set/cup && grep -qF "000" out'
check 'a file for programs is not written beside an error' eval 'fails unknown-assigned faulty.mtlx --stage stage.txt --look day --json faulty.json && [ ! -e faulty.json ]'
check 'a document with several looks needs a name' eval 'sed "s|</materialx>|<look name=\"night\"/></materialx>|" look.mtlx >two.mtlx; fails look-needed two.mtlx --stage stage.txt'
check 'the error lists the looks' grep -qF 'day, night' err
printf '/set/a\nset/b\n/set//c\n' >bad.txt
check 'a line that is no path is an error' fails bad-path look.mtlx --stage bad.txt
check 'the error has the line of the path' eval 'grep -q "^bad.txt:2:1: error" err && grep -q "^bad.txt:3:1: error" err'
check 'a stage that is missing is an error' fails file-missing look.mtlx --stage none.txt
check 'a document without a stage is wrong usage' exits 2 "$mxgen" bind look.mtlx
check 'an output in a folder that is missing fails' exits 1 bind --json none/out.json

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
check 'a stage of USD needs no look' exits 0 usd
check 'a stage of USD has bindings in its slotOrder' row '/set [dust Dust] [base Clay]'
check 'a primitive of an instance has layers' row '/set/table/leg [000 Clay] (dust Dust) (::010 Clay) (base Clay)'
check 'each instance has layers of its own' row '/set/stool/leg [000 Clay] (dust Dust) (base Clay)'
check 'None removes a slot' row '/set/cup (base Clay) [dust removed]'
check 'a removal of what is not there is none' row '/set/stool/leg [000 Clay] (dust Dust) (base Clay)'
check 'a slot binding beats a plain one' row '/set/cup/rim [000 Dust] (base Clay) (dust removed)'
check 'a stronger binding beats those below' row '/set/shelf/board (000 Dust) (dust Dust) (base Clay)'
check 'shading and other subsets are no primitives' eval '! grep -qE "/Clay|/faces|Prototype" out'
check 'a stage of USD gives JSON' exits 0 usd --json -
check 'the JSON has what is removed' json 'p["/set/cup"]["removed"] == [{"slot": "dust", "from": "/set/cup", "inherited": False, "assign": "/set/cup.material:slotBinding:_dust stage.usda:31"}]'
check 'the JSON names the property and its line' json 'p["/set/table/leg"]["layers"][0]["assign"] == "/set/table/leg.material:binding stage.usda:9"'
check 'the purpose full is accepted' exits 0 usd --purpose full
check 'a binding of the purpose beats all others' row '/set/cup/rim (000 Dust) (base Clay) (dust removed)'
check 'the purpose preview is accepted' exits 0 usd --purpose preview
check 'the reason is the purpose' eval 'exits 0 usd --purpose full --geom /set/cup/rim && grep -qF "which is for the purpose '"'full'"'" out'
exits 0 usd --purpose preview
check 'the other purpose has its own binding' row '/set/cup [000 Clay] (base Clay) [dust removed]'
sed 's|<look name="day">|&<materialassign slot="000" material="Clay" geom="/set/shelf, /set/stool"/>|' look.mtlx >over.mtlx
check 'a look counts beside the stage' exits 0 env document=over.mtlx "$mxgen" bind over.mtlx --stage stage.usda --mute 050
check 'a look beats the scene at one path' row '/set/shelf [000 Clay] (dust Dust) (base Clay)'
check 'a look beats a binding that a stronger one has beaten' row '/set/shelf/board (000 Clay) (dust Dust) (base Clay)'
check 'a deeper binding beats a look' row '/set/stool/leg [000 Clay] (dust Dust) (base Clay)'
check 'reasons name a stronger binding of a stage' exits 0 usd --geom /set/shelf/board
check 'the reason says what is stronger' grep -q 'loses to /set/shelf.material:binding, which is stronger than bindings of the scene below it' out
cat >leaves.mtlx <<'XML'
<materialx version="1.39"><xi:include xmlns:xi="http://www.w3.org/2001/XInclude" href="materials.mtlx"/>
  <look name="l"><materialassign slot="leaf" material="Clay" geom="//*"/></look></materialx>
XML
check 'a look may assign to leaves' exits 0 "$mxgen" bind leaves.mtlx --stage stage.usda --look l
check 'a subset is a leaf and its mesh is none' eval 'grep -E "^/set/cup/rim .*\[leaf Clay\]" out && ! grep -E "^/set/cup .*leaf" out && grep -E "^/set/shelf/board .*leaf" out'
check 'an unknown slot of a stage is an error' fails unknown-slot materials.mtlx --stage stage.usda --solo dsut
check 'the unknown slot has a suggestion' grep -qF "did you mean 'dust'" err
# broken SCRIPT ID [LINE]: the stage, edited by sed.
broken() {
    sed "$1" stage.usda >broken.usda
    fails "$2" materials.mtlx --stage broken.usda && grep -q "^broken.usda:${3:-}" err
}
check 'a syntax error of USD is an error' broken 's/def Xform "shelf"/def Xform shelf/' usda-syntax 46:15
check 'a binary stage is an error' broken '1s/.*/PXR-USDC/' usda-syntax 1:1
check 'an arc that is no reference is an error' broken 's/instanceable = true/payload = @x.usda@/' usda-arc 17
check 'a reference to a file is an error' broken 's|references = </Flattened_Prototype_1>|references = @x.usda@|' usda-reference 17
check 'a reference to nothing is an error' broken 's|references = </Flattened_Prototype_1>|references = </Prototype>|' usda-reference 17
check 'a cycle of references is an error' broken 's|def Mesh "leg"|def Mesh "leg" ( references = </Flattened_Prototype_1> )|' usda-cycle 7
check 'a property that names no slot is an error' broken 's/slotBinding:_dust = None/slotBinding:dust = None/' bad-binding 31
sed 's|</Looks/Dust>|</Looks/Duts>|' stage.usda >broken.usda
check 'a binding to no material is told' eval 'exits 0 "$mxgen" bind materials.mtlx --stage broken.usda && grep -q "^broken.usda:15:.*did you mean.*\[usda-binding\]" err'
check 'the rest of the stage counts' grep -qF '[000 Clay]' out
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
check 'a stage may bind collections' exits 0 "$mxgen" bind materials.mtlx --stage collections.usda
check 'a collection holds what is below its paths' row '/s/a (000 Dust) (050 Dust) (::010 Clay)'
check 'a collection does not hold what it excludes' row '/s/a/b (000 Clay) (050 Dust) (060 Dust)'
check 'a collection holds what a deeper path includes again' row '/s/a/b/c (000 Dust) (050 Dust)'
check 'the deepest of several exclusions counts' row '/s/a/b/c (000 Dust) (050 Dust)'
check 'a deeper binding beats a collection' row '/s/a/own [000 Clay] (050 Dust)'
check 'the first of several collections wins over the direct binding' row '/s/d (000 Clay) (050 Dust) (::010 Clay)'
check 'a collection counts only at or below its primitive' row '/outside default'
check 'a collection may have a purpose' exits 0 "$mxgen" bind materials.mtlx --stage collections.usda --purpose full
check 'a collection of the purpose beats the others' row '/s/a (000 Clay) (050 Dust) (::010 Clay)'
check 'reasons of a primitive in collections are printed' exits 0 "$mxgen" bind materials.mtlx --stage collections.usda --geom /s/a
check 'a collection that is missing is an error' eval 'sed "s/s.collection:metal>/s.collection:mteal>/" collections.usda >odd.usda; fails bad-binding materials.mtlx --stage odd.usda'

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
check 'a stage needs no document' exits 0 "$mxgen" bind --stage network.usda
check 'a stage has its own materials' row '/m [000 Net]'
cat >like.mtlx <<'XML'
<materialx version="1.39"><look name="l"><materialassign material="Net" geom="/m"/></look></materialx>
XML
check 'a look may assign materials of the stage' exits 0 "$mxgen" bind like.mtlx --stage network.usda
check 'a material of the document beats one of the stage' eval 'sed "s|<look|<standard_surface name=\"x\" type=\"surfaceshader\"/><surfacematerial name=\"Net\" type=\"material\"><input name=\"surfaceshader\" type=\"surfaceshader\" nodename=\"x\"/></surfacematerial>&|" like.mtlx >own.mtlx; exits 0 "$mxgen" bind own.mtlx --stage network.usda'
check 'a shader without a definition is a warning' eval 'sed s/ND_mix_color3/ND_mxi_color3/ network.usda >odd.usda; "$mxgen" bind --stage odd.usda 2>err; grep -q "^odd.usda:.*\[usda-shader\]" err'
# odd SED ID LINE:COLUMN: the network has a fault at its place.
odd() { sed "$1" network.usda >odd.usda && ! cmp -s network.usda odd.usda && fails "$2" --stage odd.usda && grep -q "^odd.usda:$3: error" err; }
check 'a type that the definition does not have is an error' odd 's/float inputs:base = 0.5/color3f inputs:base = (1, 1, 1)/' usda-type 14:17
check 'a value that does not fit a role is an error' odd 's/color3f inputs:bg = (1, 0, 0)/float3 inputs:bg = (1, 0)/' usda-value 22:20
check 'a role is a type of its shape' eval 'sed "s/color3f inputs:bg/vector3f inputs:bg/; s/float inputs:base = 0.5/double inputs:base = 0.5/" network.usda >roles.usda; exits 0 "$mxgen" bind --stage roles.usda; test ! -s err'
check 'an integer in place of a float is an error' odd 's/float inputs:base = 0.5/int inputs:base = 1/' usda-type 14:13
check 'a type of USD alone is an error' odd 's/float inputs:base = 0.5/quatf inputs:base = (1, 0, 0, 0)/' usda-type 14:15
check "an input of another type than its material's is an error" odd 's/float inputs:amount = 0.25/color3f inputs:amount = (1, 1, 1)/' usda-type 8:13
check 'a number in place of a colour is an error' odd 's/inputs:fg = (0, 0, 1)/inputs:fg = 0.5/' usda-value 23:21
check 'a colour with too many numbers is an error' odd 's/inputs:fg = (0, 0, 1)/inputs:fg = (0, 0, 1, 0)/' usda-value 23:21
check 'a text in place of a colour is an error' odd 's/inputs:fg = (0, 0, 1)/inputs:fg = "blue"/' usda-value 23:21
check 'a list in place of a number is an error' odd 's/inputs:base = 0.5/inputs:base = [0.5]/' usda-value 14:15
check 'a connection to an input that is missing is an error' odd 's/<\/Net.inputs:amount>/<\/Net.inputs:amuont>/' usda-connection 24:19
check 'a connection to a prim that is missing is an error' odd 's/<\/Net\/Graph\/Mix.outputs:out>/<\/Net\/Graph\/Mxi.outputs:out>/' usda-connection 18:17
check 'a connection without a port is an error' odd 's/<\/Net.inputs:amount>/<\/Net>/' usda-connection 24:19
check 'a blocked value has no message' eval 'sed "s/inputs:base = 0.5/inputs:base = None/" network.usda >blocked.usda; exits 0 "$mxgen" bind --stage blocked.usda; test ! -s err'
check 'a document alone is wrong usage' exits 2 "$mxgen" bind like.mtlx

# Overrides of the stage: a Material without terminals, and a NodeGraph.
cat >drives.usda <<'USD'
#usda 1.0
def Mesh "set"
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
check 'a stage may have overrides' exits 0 "$mxgen" bind --stage drives.usda
check 'overrides of a stage give no warning' test ! -s err
check 'overrides of a stage are layers' row '/set/a (000 Paint) (::010 Red) [::020 Pattern]'
check 'overrides of a stage give JSON' exits 0 "$mxgen" bind --stage drives.usda --json -
check 'the JSON has overrides of a stage as graphs' json '[o["nodegraph"] for o in p["/set/a"]["layers"][0]["overrides"]] == ["Red", "Pattern"]'
# main PATH: what the shader of a primitive does
main() { sed -n '/^void main/,$p' "drives.d/$(python3 -c "import json; print({p['path']: p.get('stack') for p in json.load(open('drives.d/bindings.json'))['primitives']}['$1'])").frag"; }
check 'materials of a stage give shaders' exits 0 "$mxgen" nothing.mtlx --stage drives.usda --target vulkan --interface reduced -o drives.d
check 'values of overrides drive inputs' eval 'main /set | grep -qF "out1 = vec4(0.5, 0.0, 0.0, 0.5)"'
check 'networks of overrides drive inputs' eval 'main /set/a | grep -qF "mx_noise_float(vd.positionObject) * 0.25 * 0.5 * vec3(1.0, 0.0, 0.0)"'
check 'a material with terminals overrides by its shaders' eval 'sed "s|float outputs:nothing|token outputs:surface.connect = </Looks/Paint/S.outputs:out>|" drives.usda >both.usda; exits 0 "$mxgen" bind --stage both.usda --json - && json "p[\"/set\"][\"layers\"][0][\"overrides\"][0][\"material\"] == \"Red\""'

# Files of Assimp come through mxgen-render: the same primitives as in USD.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\ng left\nf 1 2 3\n' >one.obj
sed 's|</materialx>|<look name="l"><materialassign material="Clay" geom="/left"/></look>&|' materials.mtlx >obj.mtlx
# json_layers FILE: the layers by path; nobody knows what is a group in a file without types
json_layers() { python3 -c 'import json, sys; print(*((p["path"], p["layers"]) for p in json.load(open(sys.argv[1]))["primitives"]), sep="\n")' "$1"; }
if [ -x "$(dirname "$mxgen")/mxgen-render" ]; then
    check 'a stage may be glTF' exits 0 "$mxgen" bind "$looks" --stage "$examples/slots/receiver.gltf" --look finished --json gltf.json
    check 'the stage may be USD' exits 0 "$mxgen" bind "$looks" --stage "$receiver" --look finished --json usda.json
    check 'both stages have the same bindings' eval 'for f in gltf usda; do json_layers $f.json >$f.layers || exit; done; diff gltf.layers usda.layers'
    check 'a stage may be OBJ' exits 0 "$mxgen" bind obj.mtlx --stage one.obj
    check 'a stage of OBJ has its groups' row '/left [000 Clay]'
    check 'a stage of OBJ gives shaders' exits 0 "$mxgen" obj.mtlx --stage one.obj --look l -o obj.d
    echo x >bad.gltf
    check 'a stage that cannot be read fails' exits 1 "$mxgen" bind obj.mtlx --stage bad.gltf
    check 'the error is printed once' test "$(grep -c '\[bad-mesh\]' err)" = 1
else
    skip 'without Assimp no glTF is read'
fi
mkdir alone
cp "$mxgen" alone/mxgen
check 'a stage of OBJ fails without the renderer' exits 1 env PATH=/nonexistent LD_LIBRARY_PATH="$(dirname "$mxgen")" alone/mxgen bind obj.mtlx --stage one.obj
check 'the error is no-renderer' grep -qF '[no-renderer]' err

# Looks as slot bindings of USD: a layer over the stage, with which the stage has the same stacks.
cat >stacks.py <<'PY'
import json, sys
read = lambda file: {p["path"]: (p.get("stack"), [l["slot"] for l in p["layers"]]) for p in json.load(open(file))["primitives"]}
before, after = read(sys.argv[1]), read(sys.argv[2])
assert before == {path: after.get(path) for path in before}, (before, after)
PY
# round_trip DOCUMENT STAGE OPTION...: the look of a document as USD, and back, with the document's materials alone.
round_trip() {
    exits 0 "$mxgen" bind "$1" --stage "$2" --json before.json --usda round.usda "${@:3}" || return
    sed "s|href=\"\([^/]\)|href=\"$examples/slots/\1|" "$1" | python3 -c 'import re, sys; print(re.sub(r"<look [^>]*/>|<look .*?</look>", "", sys.stdin.read(), flags=re.S))' >without.mtlx
    again "$2" without.mtlx
}
# again STAGE ARGUMENT...: the stage with round.usda over it has the stacks of before.json.
again() {
    python3 "$here/sublayer.py" round.usda "$1" >composed.usda
    exits 0 "$mxgen" bind --stage composed.usda --json after.json "${@:2}" && python3 stacks.py before.json after.json
}
check 'a stage comes back from USD' round_trip materials.mtlx stage.usda
check 'a look comes back from USD' round_trip "$looks" "$receiver" --look finished
check 'writing USD gives no warning' test ! -s err
check 'a primitive of the USD has only what is new' eval '! grep -A6 "over \"bar_1\"" round.usda | grep -q _050'
check 'slot 000 is the plain binding' grep -q 'rel material:binding = </receiver/Looks/ribbed_steel>' round.usda
check 'the plain binding is the last one of its prim' eval '! grep -A1 "rel material:binding = " round.usda | grep -q slotBinding'
check 'slot 000 is written once' eval '! grep -q "slotBinding:_000 = <" round.usda'
check 'the USD removes slots' grep -q 'material:slotBinding:_050 = None' round.usda
check 'the USD names overrides' grep -q 'rel material:slotBinding:_000:_:_020 = </receiver/Looks/red_color>' round.usda
check 'the USD names vertical layers' grep -q 'rel material:slotBinding:_000:over:_010 = </receiver/Looks/varnish>' round.usda
sed "s|<look name=\"default\"/>|<look name=\"default\" slotorder=\"050, 000, 010, 020, 040\"/>|; s|href=\"|&$examples/slots/|" "$looks" >ordered.mtlx
check 'primitives with bindings have the schema of them' awk '/over "/ { schema = 0 } /MaterialBindingAPI/ { schema = 1 } /^ *rel / && !schema { exit 1 }' round.usda
check 'materials that the stage lacks are prims below the default prim' eval 'grep -A1 "^    def Scope \"Looks\"" round.usda && grep -q "^        def NodeGraph \"red_color\"" round.usda'
check 'a look with a slotorder comes back from USD' round_trip ordered.mtlx "$receiver" --look finished
check 'the USD has the slotorder' grep -q 'uniform token\[\] material:slotOrder = \["050", "000"' round.usda
sed 's|<materialassign material="Clay" geom="/left"/>|<materialassign material="Dust" geom="/set/shelf"/><materialassign slot="base" material="" geom="/set/cup"/><materialassign slot="_1" material="Clay" geom="/set/table/leg"/>|' obj.mtlx >shelf.mtlx
check 'a look over bindings of the stage comes back' round_trip shelf.mtlx stage.usda
check 'bindings that were strong are weak' eval 'grep -A3 "over \"shelf\"" round.usda && grep -q "rel material:binding = </set/Looks/Dust> (bindMaterialAs = \"weakerThanDescendants\")" round.usda'
check 'an instance with other bindings below it is none' eval 'grep -A4 "over \"table\"" round.usda | grep -q "instanceable = false"'
check 'materials of the stage keep their paths' grep -qF '</Clay>' round.usda
check 'a purpose has bindings of its own' eval 'exits 0 usd --purpose full --json before.json --usda round.usda && again stage.usda materials.mtlx --purpose full && ! grep "rel " round.usda | grep -v ":full = "'
check 'those for all purposes stay' eval 'exits 0 usd --json before.json && again stage.usda materials.mtlx'
check 'collections of the stage do not bind beside the layer' eval 'exits 0 "$mxgen" bind materials.mtlx --stage collections.usda --json before.json --usda round.usda && again collections.usda materials.mtlx && grep -q "rel material:binding:collection:[a-z]* = None" round.usda'
check 'a slot alone comes back' eval 'exits 0 usd --solo dust --json before.json --usda round.usda && again stage.usda materials.mtlx'
check 'a look with variants gives USD' exits 0 bind --usda lossy.usda
check 'a warning says that variants are lost' grep -qF '[usda-loss]' err
check 'comments say where' grep -q '^# left out: ".*" at ".*": its variants$' lossy.usda
check 'USD in a folder that is missing fails' exits 1 bind --usda none/out.usda

# The example, as docs/slots.md shows it.
check 'examples/slots/looks.mtlx gives layers' exits 0 "$mxgen" bind "$looks" --stage "$receiver" --look finished
check 'the example gives no warning' test ! -s err
while read -r row; do
    check "docs/slots.md has a row as printed: $row" eval 'sed "s/  */ /g" out | grep -qxF "$(sed "s/  */ /g" <<<"$row")"'
done < <(grep -E '^    /receiver' "$here/../../docs/slots.md")
for look in default base pattern metal replaced red dirty light clean sign sign_add sign_none; do
    check "the example has the look $look" exits 0 "$mxgen" bind "$looks" --stage "$receiver" --look "$look"
done

finish bind
