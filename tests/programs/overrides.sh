#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The elements that drive the inputs of a layer's material (docs/slots.md, "Overrides"): outputs of graphs, inputs of materials, and variants, each rule
# with its counter-case. The shaders are constants, so the text of the main function is the colour. Argument: mxgen.
mxgen=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"

# constant NAME TYPE VALUE [OUTPUT...]: a nodegraph with a constant, and outputs with their attributes.
constant() {
    local name=$1 type=$2 value=$3 output
    echo "<nodegraph name='$name'><constant name='c' type='$type'><input name='value' type='$type' value='$value'/></constant>"
    for output in "${@:4}"; do
        echo "<output name=$output type='$type' nodename='c'/>"
    done
    echo '</nodegraph>'
}
# surface NAME INPUTS: a shader s_NAME with a material of its name.
surface() {
    echo "<surface_unlit name='s_$1' type='surfaceshader'>$2</surface_unlit>"
    echo "<surfacematerial name='$1' type='material'><input name='surfaceshader' type='surfaceshader' nodename='s_$1'/></surfacematerial>"
}
input() { echo "<input name='$1' type='$2' value='$3'/>"; }
# document TEXT LOOK...: looks over the substances and the text. The look L binds all of it to /a.
document() {
    {
        echo '<?xml version="1.0"?><materialx version="1.39">'
        surface red "$(input emission_color color3 '1, 0, 0')"
        # patterns with interfaces: the colour is tint · gain of each graph
        for graph in NG_one NG_two; do
            echo "<nodegraph name='$graph'>$(input gain float 1)
              <constant name='tint' type='color3'>$(input value color3 "$([ $graph = NG_one ] && echo '1, 0, 0' || echo '0, 0, 1')")</constant>
              <multiply name='m' type='color3'><input name='in1' type='color3' nodename='tint'/><input name='in2' type='float' interfacename='gain'/></multiply>
              <output name='out' type='color3' nodename='m'/></nodegraph>"
        done
        echo "<add name='both' type='color3'><input name='in1' type='color3' nodegraph='NG_one' output='out'/>
          <input name='in2' type='color3' nodegraph='NG_two' output='out'/></add>
          <surface_unlit name='s_pattern' type='surfaceshader'><input name='emission_color' type='color3' nodename='both'/></surface_unlit>
          <substance name='pattern' type='material'><input name='surfaceshader' type='surfaceshader' nodename='s_pattern'/></substance>"
        echo "$1"
        echo "<look name='L'>${*:2}</look></materialx>"
    } >look.mtlx
}
layer() { echo "<materialassign slot='$1' material='$2' geom='/a' ${3:-}/>"; }
override() { echo "<materialassign slot='$1' nodegraph='$2' geom='/a'/>"; }
echo /a >stage.txt
generate() { "$mxgen" look.mtlx --look L --stage stage.txt --target vulkan --interface reduced --environment none -o out.d; }
# gives WHAT COLOUR: the shader of /a has this colour, without a message.
gives() {
    check "a shader is generated: $1" exits 0 generate
    check "no message is printed: $1" test ! -s err
    local name
    name=$(python3 -c "import json; print(json.load(open('out.d/bindings.json'))['primitives'][0]['stack'])")
    check "the colour is $2: $1" eval "sed -n '/^void main/,\$p' out.d/$name.frag >main; grep -qF 'out1 = $2;' main || { cat main; false; }"
}
# complains WHAT CODE ID TEXT: once.
complains() {
    check "the run ends with $2: $1" exits "$2" generate
    check "one $3 is printed: $1" test "$(grep -c "\[$3\]" err)" = 1
    check "the message names $4: $1" grep -qF "$4" err
}

document '' "$(layer 000 red)"
gives 'a material without override stays as it is' 'vec4(1.0, 0.0, 0.0, 1.0)'

# ---- By name ----
document "$(constant NG color3 '0, 1, 0' "'emission_color'")" "$(layer 000 red)" "$(override 000::010 NG)"
gives 'an output drives the input of its name' 'vec4(0.0, 1.0, 0.0, 1.0)'
document "$(constant NG color3 '0, 1, 0' "'emission_color'")" "$(layer 000 pattern)" "$(override 000::010 NG)"
gives 'an output drives an input that is connected' 'vec4(0.0, 1.0, 0.0, 1.0)'
document "$(constant NG float 0.5 "'gain'")" "$(layer 000 pattern)" "$(override 000::010 NG)"
gives 'an output drives the interfaces of all graphs' 'vec4(0.5, 0.0, 0.5, 1.0)'
# The graph and the shader have an input `emission`; the graph wins, so the shader stays at 1.
inner="<nodegraph name='NG_in'>$(input emission float 0)<combine3 name='k' type='color3'><input name='in1' type='float' interfacename='emission'/></combine3>
  <output name='out' type='color3' nodename='k'/></nodegraph>
  <surface_unlit name='s_in' type='surfaceshader'><input name='emission_color' type='color3' nodegraph='NG_in' output='out'/></surface_unlit>
  <substance name='in' type='material'><input name='surfaceshader' type='surfaceshader' nodename='s_in'/></substance>"
document "$inner $(constant NG float 0.5 "'emission'")" "$(layer 000 in)" "$(override 000::010 NG)"
gives 'an interface comes before shaders' 'vec4(0.5, 0.0, 0.0, 1.0)'
document "$(constant NG float 0.5 "'emission'")" "$(layer 000 red)" "$(override 000::010 NG)"
gives 'an output drives shaders where no interface has the name' 'vec4(0.5, 0.0, 0.0, 1.0)'
masked="<nodegraph name='NG_in'>$(input mask float 1)<combine3 name='k' type='color3'><input name='in1' type='float' interfacename='mask'/></combine3>
  <output name='out' type='color3' nodename='k'/></nodegraph>
  <surface_unlit name='s_in' type='surfaceshader'><input name='emission_color' type='color3' nodegraph='NG_in' output='out'/></surface_unlit>
  <substance name='in' type='material'><input name='surfaceshader' type='surfaceshader' nodename='s_in'/></substance>"
document "$masked $(constant NG float 0.25 "'mask'")" "$(layer 000 in)" "$(override 000::010 NG)"
gives "the material's own input comes first" 'vec4(0.25, 0.0, 0.0, 0.25)'
document "$(constant NG float 0.25 "'mask'")" "$(layer 000 red)" "$(override 000::010 NG)"
gives 'each material has a mask' 'vec4(0.25, 0.0, 0.0, 0.25)'

# ---- By path ----
document "$(constant NG float 0.5 "'x' overrides='NG_two/gain'")" "$(layer 000 pattern)" "$(override 000::010 NG)"
gives 'overrides= names one input' 'vec4(1.0, 0.0, 0.5, 1.0)'
document "$(constant NG color3 '0, 1, 0' "'x' overrides='s_pattern/emission_color'")" "$(layer 000 pattern)" "$(override 000::010 NG)"
gives 'overrides= names an input of a shader' 'vec4(0.0, 1.0, 0.0, 1.0)'
document "$(constant NG float 0.25 "'x' overrides='pattern/mask'")" "$(layer 000 pattern)" "$(override 000::010 NG)"
gives 'overrides= names an input of the material' 'vec4(0.25, 0.0, 0.25, 0.25)'
document "$(constant NG color3 '0, 1, 0' "'x' overrides='NG_two/tint/value'")" "$(layer 000 pattern)" "$(override 000::010 NG)"
gives 'overrides= names an input of a node inside a graph' 'vec4(1.0, 1.0, 0.0, 1.0)'
document "$(constant NG float 0.5 "'x' overrides='NG_one/gain'" "'gain' overrides='NG_two/gain'")" "$(layer 000 pattern)" "$(override 000::010 NG)"
gives 'two outputs drive two inputs, whatever their names are' 'vec4(0.5, 0.0, 0.5, 1.0)'
document "$(constant NG float 0.5 "'gain' overrides='NG_three/gain'")" "$(layer 000 pattern)" "$(override 000::010 NG)"
complains 'a path to nothing' 0 override-unmatched "'NG_three/gain'"
document "$(constant NG float 0.5 "'x' overrides='NG_one/tint/value'")" "$(layer 000 pattern)" "$(override 000::010 NG)"
complains 'a path to an input of another type' 1 override-type 'NG_one/tint/value'

# ---- Several overrides ----
more="$(constant low color3 '0, 1, 0' "'emission_color'") $(constant high color3 '0, 0, 1' "'emission_color'") $(constant half float 0.5 "'emission'")"
document "$more" "$(layer 000 red)" "$(override 000::020 high)" "$(override 000::010 low)"
gives 'the highest override wins, whatever the order' 'vec4(0.0, 0.0, 1.0, 1.0)'
document "$more" "$(layer 000 red)" "$(override 000::020 half)" "$(override 000::010 low)"
gives 'the highest override wins for each input by itself' 'vec4(0.0, 0.5, 0.0, 1.0)'
document "$more" "$(layer 000 red)" "$(override 000::010 low)" "$(layer 010 red)"
gives 'another slot has overrides of its own' 'vec4(1.0, 0.0, 0.0, 1.0)'

# ---- Materials as overrides ----
green=$(surface green "$(input emission_color color3 '0, 1, 0')")
document "$green" "$(layer 000 red)" "$(layer 000::010 green)"
gives 'a material overrides by the inputs that its shader has in the document' 'vec4(0.0, 1.0, 0.0, 1.0)'
dim=$(surface dim "$(input emission float 0.5)")
document "$dim" "$(layer 000 red)" "$(layer 000::010 dim)"
gives 'a material does not override by defaults' 'vec4(0.5, 0.0, 0.0, 1.0)'
document "$green" "$(layer 000 pattern)" "$(layer 000::010 green)"
gives 'a material overrides a connection' 'vec4(0.0, 1.0, 0.0, 1.0)'
document "<surface_unlit name='s_blue' type='surfaceshader'>$(input emission_color color3 '0, 0, 1')</surface_unlit>
  <substance name='part' type='material'><input name='surfaceshader' type='surfaceshader' nodename='s_blue'/>$(input mask float 0.25)</substance>" \
    "$(layer 000 red)" "$(layer 000::010 part)"
gives "a material overrides by its own inputs" 'vec4(0.0, 0.0, 0.25, 0.25)'
document "$green" "$(layer 000 pattern)" "$(layer 000::010 pattern)" "$(layer 000::020 red)"
gives 'a value wins over the connection of a material below it' 'vec4(1.0, 0.0, 0.0, 1.0)'
document "<surface name='s_wrong' type='surfaceshader'>$(input opacity float 0.5)</surface>
  <displacement name='d' type='displacementshader'>$(input displacement float 1)</displacement>
  <surfacematerial name='wrong' type='material'><input name='surfaceshader' type='surfaceshader' nodename='s_wrong'/></surfacematerial>
  <standard_surface name='s_std' type='surfaceshader'/>
  <surfacematerial name='std' type='material'><input name='surfaceshader' type='surfaceshader' nodename='s_std'/></surfacematerial>" \
    "$(layer 000 std)" "$(layer 000::010 wrong)"
complains 'a material whose input has another type' 1 override-type 's_std/opacity'
document "$(surface odd "$(input gain float 0.5)")" "$(layer 000 red)" "$(layer 000::010 odd)"
check 'an input that no node has is generated' exits 0 generate
check 'an input that no node has is a warning' grep -q override-unmatched err

# ---- Displacement, vertical layers ----
document "<displacement name='d' type='displacementshader'>$(input displacement float 1)$(input scale float 2)</displacement>
  <substance name='moved' type='material'><input name='surfaceshader' type='surfaceshader' nodename='s_red'/>
    <input name='displacementshader' type='displacementshader' nodename='d'/></substance>
  $(constant NG float 3 "'scale'")" "$(layer 000 moved)" "$(override 000::010 NG)"
check 'a displacement is generated' exits 0 generate
check 'an override drives the displacement' eval 'grep -rqF "3.0" out.d/*.vert && ! grep -qF "2.0 *" out.d/*.vert'
dim=$(surface dim "$(input emission float 0.5) $(input emission_color color3 '1, 0, 0')") # light of both adds up
document "$more $dim" "$(layer 000 red)" "$(layer '000|010' dim)" "$(override '000|010::x' low)"
gives 'an override drives a vertical layer' 'vec4(1.0, 0.5, 0.0, 1.0)'
document "$more $dim" "$(layer 000 red)" "$(layer '000|010' dim)" "$(override 000::x low)"
gives 'an override of the slot does not drive its vertical layer' 'vec4(0.5, 1.0, 0.0, 1.0)'

# ---- Variants ----
variants="<variantset name='V'><variant name='green'>$(input emission_color color3 '0, 1, 0')</variant><variant name='blue'>$(input emission_color color3 '0, 0, 1')</variant></variantset>"
pick() { echo "<variantassign name='v$2' variantset='V' variant='$1'/>"; }
document "$variants" "$(pick green 1)" "$(layer 000 red)"
gives 'a variant of the look applies' 'vec4(0.0, 1.0, 0.0, 1.0)'
document "$variants" "$(pick green 1)" "<materialassign material='red' geom='/a'>$(pick blue 2)</materialassign>"
gives 'a variant inside the assignment wins' 'vec4(0.0, 0.0, 1.0, 1.0)'
document "$variants" "<materialassign material='red' geom='/a'>$(pick blue 2)</materialassign>" "$(pick green 1)"
gives 'a variant inside the assignment wins wherever that of the look stands' 'vec4(0.0, 0.0, 1.0, 1.0)'
document "$variants" "<materialassign material='red' geom='/a'>$(pick blue 2)$(pick green 3)</materialassign>"
gives 'the later of two variants inside wins' 'vec4(0.0, 1.0, 0.0, 1.0)'
document "$variants $more" "<materialassign material='red' geom='/a'>$(pick blue 2)</materialassign>" "$(override 000::010 low)"
gives 'an override wins over both' 'vec4(0.0, 1.0, 0.0, 1.0)'
document "$variants" "<materialassign material='red' geom='/a'>$(pick blue 2)</materialassign>" "<materialassign material='red' geom='/a/b'/>"
printf '/a\n/a/b\n' >stage.txt
check 'an assignment without the variant is generated' exits 0 generate
check 'the assignment without the variant has a shader of its own' test "$(grep -l 'vec4(1.0, 0.0, 0.0, 1.0)' out.d/*.frag | wc -l)" -ge 1
echo /a >stage.txt
document "$variants <look name='P'>$(pick green 1)$(layer 000 red)</look>" "$(pick blue 2)"
sed -i "s|<look name='L'>|<look name='L' inherit='P'>|" look.mtlx
gives "a look's variant comes after its parent's" 'vec4(0.0, 0.0, 1.0, 1.0)'
dimmed="<variantset name='D'><variant name='dim'>$(input emission float 0.5)</variant><variant name='blue'>$(input emission_color color3 '0, 0, 1')</variant></variantset>"
assign() { echo "<variantassign name='v$2' variantset='D' variant='$1'/>"; }
document "$dimmed <look name='P'>$(assign dim 1)$(layer 000 red)</look>" "$(assign blue 2)"
sed -i "s|<look name='L'>|<look name='L' inherit='P'>|" look.mtlx
gives "nothing stays of the parent's variant of the set" 'vec4(0.0, 0.0, 1.0, 1.0)'
document "$dimmed" "$(assign dim 1)<materialassign material='red' geom='/a'>$(assign blue 2)</materialassign>"
gives "nothing stays of the look's variant of the set" 'vec4(0.0, 0.0, 1.0, 1.0)'
document "<variantset name='W' node='standard_surface'><variant name='x'>$(input emission_color color3 '0, 1, 0')</variant></variantset>" \
    "<variantassign name='v' variantset='W' variant='x'/>" "$(layer 000 red)"
gives 'a variant of another node says nothing' 'vec4(1.0, 0.0, 0.0, 1.0)'
# ---- Tokens of variants ----
# files WHAT FILE...: the files of the textures of /a's stack, base first, without a message.
files() {
    check "a shader is generated: $1" exits 0 generate
    check "no message is printed: $1" test ! -s err
    check "the files are ${*:2}: $1" python3 -c 'import json, sys
bindings = json.load(open("out.d/bindings.json"))
stack = next(s for s in bindings["stacks"] if s["name"] == bindings["primitives"][0]["stack"])
have = [t["file"] for t in stack["textures"]]
sys.exit(f"the files are {have}" if have != sys.argv[1:] else 0)' "${@:2}"
}
token() { echo "<token name='$1' type='string' value='$2'/>"; }
image="<image name='i' type='color3'><input name='file' type='filename' value='t_[map].png'/></image>"
unlit="<surface_unlit name='s' type='surfaceshader'><input name='emission_color' type='color3' nodename='i'/></surface_unlit>"
material() { echo "<surfacematerial name='$1' type='material'><input name='surfaceshader' type='surfaceshader' nodename='$2'/></surfacematerial>"; }
papers="<nodedef name='ND_paper' node='paper'>$(token map dry)<output name='out' type='surfaceshader'/></nodedef>
  <nodegraph name='NG_paper' nodedef='ND_paper'>$image $unlit<output name='out' type='surfaceshader' nodename='s'/></nodegraph>
  <paper name='plain' type='surfaceshader'/><paper name='own' type='surfaceshader'>$(token map own)</paper>
  $(material M plain)$(material O own)
  <nodegraph name='G'>$(token map graph)$image<output name='out' type='color3' nodename='i'/></nodegraph>
  <surface_unlit name='g' type='surfaceshader'><input name='emission_color' type='color3' nodegraph='G' output='out'/></surface_unlit>$(material N g)
  <substance name='H' type='material'><input name='surfaceshader' type='surfaceshader' nodename='plain'/>$(input mask float 0.5)</substance>
  <variantset name='W'><variant name='wet'>$(token map wet)</variant></variantset>"
wet="<variantassign name='v' variantset='W' variant='wet'/>"
worn() { echo "<materialassign slot='$1' material='$2' geom='/a'>${3:-}</materialassign>"; }
document "$papers" "$(worn 000 M)"
files 'the token of a definition' t_dry.png
document "$papers" "$wet" "$(worn 000 M)"
files 'a token of a variant of the look' t_wet.png
document "$papers" "$(worn 000 O)"
files 'the token of a node' t_own.png
document "$papers" "$(worn 000 O "$wet")"
files 'a token of a variant wins over that of the node' t_wet.png
document "$papers" "$(worn 000 N "$wet")"
files 'a token of a variant drives that of a nodegraph' t_wet.png
document "$papers" "$(worn 000 H "$wet")" "$(worn 010 H)" "$(worn 020 H "$wet")"
files 'a layer without the variant keeps its token between two with it, which share a texture' t_wet.png t_dry.png
document "$papers <variantset name='X'><variant name='x'>$(token maps wet)</variant></variantset>" "<variantassign name='v' variantset='X' variant='x'/>" "$(worn 000 M)"
files 'a token of another name says nothing' t_dry.png
# ---- Sets that are for some nodes ----
# chosen RESTRICTION [TEXT [LOOK...]]: a set of a green variant under a look of a red material.
chosen() {
    document "<variantset name='R' $1><variant name='x'>$(input emission_color color3 '0, 1, 0')$(input opacity float 0.5)</variant></variantset> ${2:-}" \
        "<variantassign name='v' variantset='R' variant='x'/>" "${3:-$(layer 000 red)}"
}
green='vec4(0.0, 0.5, 0.0, 0.5)'
chosen "node='open_pbr_surface, surface_unlit'"
gives 'a set lists its nodes' "$green"
chosen "nodedef='ND_surface_unlit'"
gives 'a set names a definition that the node has without saying so' "$green"
chosen "nodedef='ND_standard_surface_surfaceshader,ND_surface_unlit'"
gives 'a set lists its definitions' "$green"
chosen "nodedef='ND_standard_surface_surfaceshader'"
gives 'a set of another definition says nothing' 'vec4(1.0, 0.0, 0.0, 1.0)'
chosen "node='surface_unlit' nodedef='ND_standard_surface_surfaceshader'"
gives 'a set of a node and of a definition of another says nothing' 'vec4(1.0, 0.0, 0.0, 1.0)'
inner="<nodegraph name='shades'><surface_unlit name='s' type='surfaceshader'>$(input emission_color color3 '1, 0, 0')</surface_unlit>
  <output name='out' type='surfaceshader' nodename='s'/></nodegraph>
  <surfacematerial name='I' type='material'><input name='surfaceshader' type='surfaceshader' nodegraph='shades' output='out'/></surfacematerial>"
chosen "node='surface_unlit'" "$inner" "$(layer 000 I)"
gives 'a set is for a shader in a nodegraph' "$green"
wears='"variants":[{"variantset":"R","variant":"x"}]'
check 'mxgen bind tells the variant' eval '"$mxgen" bind look.mtlx --look L --stage stage.txt --json bound.json >out && tr -d " \n" <bound.json | grep -qF "$wears"'
# one set, two shaders with an input of its name: the set is for one of them
papers="<nodedef name='ND_note' node='note'>$(input emission_color color3 '0, 0, 1')<output name='out' type='surfaceshader'/></nodedef>
  <nodegraph name='NG_note' nodedef='ND_note'><surface_unlit name='s' type='surfaceshader'><input name='emission_color' type='color3' interfacename='emission_color'/></surface_unlit>
  <output name='out' type='surfaceshader' nodename='s'/></nodegraph><note name='n' type='surfaceshader'/>
  <mix name='mixed' type='surfaceshader'><input name='fg' type='surfaceshader' nodename='n'/><input name='bg' type='surfaceshader' nodename='s_red'/>$(input mix float 0.5)</mix>
  $(material B mixed)"
chosen "node='note'" "$papers" "$(layer 000 B)"
gives 'the variants of a set drive its nodes alone' 'vec4(0.5, 0.5, 0.0, 1.0)'
# the document and the set have a namespace
mkdir -p library
sed "s|<materialx version=\"1.39\">|<materialx version=\"1.39\" namespace=\"lib\">|; s|<look.*</look>||" look.mtlx >library/lib.mtlx
for restriction in "node='note'" "nodedef='ND_note'" "node='other, note'"; do
    sed -i "s|<variantset name='R' [^>]*>|<variantset name='R' $restriction>|" library/lib.mtlx
    echo '<?xml version="1.0"?><materialx version="1.39" xmlns:xi="http://www.w3.org/2001/XInclude"><xi:include href="library/lib.mtlx"/>
  <look name="L"><variantassign name="v" variantset="lib:R" variant="x"/><materialassign material="lib:B" geom="/a"/></look></materialx>' >look.mtlx
    gives "a set in a namespace: $restriction" 'vec4(0.5, 0.5, 0.0, 1.0)'
done
chosen "nodedef='ND_surface_unlit'"
check 'validate knows a set of a definition' eval 'exits 0 "$mxgen" validate look.mtlx && test ! -s err'
chosen "nodedef='ND_surface_unlot'"
check 'validate tells a set of a definition that is not there' eval '"$mxgen" validate look.mtlx 2>err; grep -q "ND_surface_unlot.*\[dangling-reference\]" err'
printf '/a\n/b\n' >stage.txt
chosen "node='standard_surface'" '' "$(layer 000 red)<materialassign material='red' geom='/b'><variantassign name='w' variantset='R' variant='x'/></materialassign>"
check 'a variant that does not apply makes no stack' eval 'generate >out 2>err && grep -q "^1 stack, 1 program" out'
echo /a >stage.txt
finish overrides
