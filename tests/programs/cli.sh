#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The command line: exit codes, filenames, messages, output files. Argument: the program.
mxgen=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"

cat >two.mtlx <<'X'
<?xml version="1.0"?>
<materialx version="1.39">
  <standard_surface name="SR_a" type="surfaceshader"/>
  <surfacematerial name="A" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="SR_a"/>
  </surfacematerial>
  <nodegraph name="NG">
    <constant name="c" type="color3"><input name="value" type="color3" value="1, 0.5, 0"/></constant>
    <output name="out" type="color3" nodename="c"/>
  </nodegraph>
  <standard_surface name="SR_c" type="surfaceshader">
    <input name="base_color" type="color3" nodegraph="NG" output="out"/>
  </standard_surface>
  <surfacematerial name="C" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="SR_c"/>
  </surfacematerial>
  <look name="L">
    <materialassign name="a" material="A" geom="/a"/>
    <materialassign name="c" material="C" geom="/c"/>
  </look>
</materialx>
X
sed 's/value="1, 0.5, 0"/value="abc"/' two.mtlx >bad.mtlx
cp two.mtlx 'with space.mtlx'
mkdir -p other && cp two.mtlx other/two.mtlx

is() { [ "$1" = "$2" ] || { echo "'$1', not '$2'"; return 1; }; }
files() { [ "$(cd "$1" && find . -type f | sort | tr '\n' ' ')" = "$2" ] || { find "$1"; return 1; }; }
none_in() { [ -z "$(find "$1" -type f 2>/dev/null)" ]; }

# Files are written where the options say
check 'a run generates every renderable element' exits 0 "$mxgen" two.mtlx --target glsl -o all
check 'a document with materials gives its materials' files all './A.frag ./A.vert ./C.frag ./C.vert '
check '--element picks an element' exits 0 "$mxgen" two.mtlx --element NG/out -o one --reflect
check 'files have the path of the element with dots' files one './NG.out.frag ./NG.out.json ./NG.out.vert '
check 'a look can be picked' exits 0 "$mxgen" two.mtlx -e L -o look
check 'a look gives all its materials' diff -r all look
check 'an assignment of a look can be picked' exits 0 "$mxgen" two.mtlx -e L/c -o assigned
check 'an assignment gives its material' files assigned './C.frag ./C.vert '
check 'several inputs are generated' exits 0 "$mxgen" two.mtlx 'with space.mtlx' -e A -o several
check 'several inputs get a folder each' files several './two/A.frag ./two/A.vert ./with space/A.frag ./with space/A.vert '
check 'two inputs of one name fail the run' exits 1 "$mxgen" two.mtlx other/two.mtlx -e A -o clash
check 'the error of two inputs of one name is output-clash' grep -q "another input writes to 'clash/two', too \[output-clash\]" err
check 'inputs of one name write nothing' test ! -e clash
check '--stdout prints a shader' eval '(mkdir nowhere && cd nowhere && exits 0 "$mxgen" ../two.mtlx -e NG/out --stdout && mv out .. && rm -f err check.log)'
check '--stdout prints both stages' test "$(grep -c '^#version' out)" -eq 2
check '--stdout writes no file' none_in nowhere
check '--stdout with a folder is wrong usage' exits 2 "$mxgen" two.mtlx --stdout -o nowhere
check 'the error says that --output does not apply to --stdout' grep -q "'--output' does not apply: --stdout" err
check '--stdout with a depfile is wrong usage' exits 2 "$mxgen" two.mtlx --stdout --depfile d
check 'the error says that --depfile does not apply to --stdout' grep -q "'--depfile' does not apply: --stdout" err
check '-o - prints as --stdout does' eval '(cd nowhere && "$mxgen" ../two.mtlx --stdout >../printed && "$mxgen" ../two.mtlx -o - >../dashed) && cmp printed dashed && none_in nowhere'
check '-o - with a depfile is wrong usage' exits 2 "$mxgen" two.mtlx -o - --depfile d
for command in format upgrade 'translate --to gltf_pbr'; do
    check "$command -o - prints" eval '"$mxgen" $command two.mtlx >printed && "$mxgen" $command two.mtlx -o - >dashed && cmp printed dashed && [ ! -e ./- ]'
done
check 'library expand -o - prints' eval '"$mxgen" library expand -o - -q 2>err | grep -q "</materialx>" && [ ! -e ./- ]'
commands=('explain cycle' 'library doc')
[ -x "$(dirname "$mxgen")/mxgen-render" ] && commands+=('bake two.mtlx' 'export two.mtlx' 'render two.mtlx')
for command in "${commands[@]}"; do
    check "$command does not print" eval "exits 2 '$mxgen' $command -o - && has err \"cannot be standard output, which '-' names\" && [ ! -e ./- ]"
done
check 'a folder of results does not print' eval 'exits 2 "$mxgen" check two.mtlx --cache - && grep -qF -- "--cache" err'
check 'a folder may have the name -' eval 'exits 0 "$mxgen" two.mtlx -e A -o ./- && test -f ./-/A.frag && rm -r ./-'
check '--depfile writes a depfile' exits 0 "$mxgen" 'with space.mtlx' -e A -o dep --depfile dep.d
check 'a depfile escapes spaces' grep -qF 'dep/A.vert dep/A.frag: with\ space.mtlx' dep.d
check 'files go to the current folder without -o' eval '(mkdir -p cwd && cd cwd && "$mxgen" ../two.mtlx -e A && test -f A.frag)'
check 'two runs give the same bytes' eval '"$mxgen" two.mtlx -o again && diff -r all again'
check 'another working folder gives the same bytes' eval '(cd other && "$mxgen" ../two.mtlx -o ../elsewhere) && diff -r all elsewhere'

# One file
check '-o may name a file' exits 0 "$mxgen" two.mtlx -e A -o one.frag
check 'a file .frag is the pixel stage' cmp one.frag all/A.frag
check '-o may name a file of the vertex stage' exits 0 "$mxgen" two.mtlx -e A -o one.vert
check 'a file .vert is the vertex stage' cmp one.vert all/A.vert
check '-o may name a file of OSL' exits 0 "$mxgen" two.mtlx -e A -t osl -o one.osl
check 'a file .osl is the shader' grep -q '^surface A' one.osl
check 'two elements do not go to one file' exits 1 "$mxgen" two.mtlx -o two.frag
check 'the error counts the elements' grep -q "'two.frag' is one file, and the document has 2 elements.*\[output-clash\]" err
check 'a stage that the element does not have fails the run' exits 1 "$mxgen" two.mtlx -e A -t osl -o A.displacement.osl
check 'the error says that there is no such stage' grep -q "has no such stage \[output-failed\]" err
while IFS='|' read -r options reason; do
    # shellcheck disable=SC2086
    check "-o may not name a file here: $options" exits 2 "$mxgen" $options
    check "the error says why: $reason" grep -q "names a file, but $reason" err
done <<'X'
two.mtlx -e A -o A.osl|this ending is of another target
two.mtlx -e A -t osl -o A.frag|this ending is of another target
two.mtlx -e A -t osl --osl-network -o A.osl|an OSL network has several files
two.mtlx -e A --reflect -o A.frag|--reflect writes another file
two.mtlx bad.mtlx -e A -o A.frag|there are several documents
other -e A -o A.frag|there are several documents
X
check 'wrong names of files write nothing' eval '! ls -d two.frag A.* 2>/dev/null | grep -q .'
mkdir folder.frag
check 'a folder may have the name of a file' exits 0 "$mxgen" two.mtlx -o folder.frag
check 'such a folder gets all files' diff -r all folder.frag

# Options of other targets
check 'an option of OSL with glsl is wrong usage' exits 2 "$mxgen" two.mtlx -e A --metadata none -o other_target
check 'the error says to which targets the option applies' grep -qx "mxgen: option '--metadata' does not apply to 'glsl'; it applies to 'osl', 'mdl'" err
check 'lights with OSL are wrong usage' exits 2 "$mxgen" two.mtlx -e A -t osl --lights none -o other_target
check 'the error says to which targets lights apply' grep -q "option '--lights' does not apply to 'osl'; it applies to 'glsl', 'vulkan'" err
check 'an option of another target is wrong usage of inspect' exits 2 "$mxgen" inspect two.mtlx --ir --no-osl-network
check 'check takes an option that one of its targets has' exits 0 "$mxgen" check two.mtlx --no-compile -t glsl,osl --lights none --metadata none
check 'check rejects an option that none of its targets has' exits 2 "$mxgen" check two.mtlx --no-compile -t glsl,vulkan --metadata none
check 'wrong options write nothing' eval '! test -e other_target'

# Folders
mkdir -p tree/props tree/.hidden tree/empty && cp two.mtlx tree && cp two.mtlx tree/props/lamp.mtlx && cp bad.mtlx tree/.hidden
ln -s .. tree/props/up && ln -s . tree/self && mkfifo tree/pipe.mtlx
check 'a folder can be generated' exits 0 timeout 60 "$mxgen" tree -e A -o forest
check 'a folder gives all documents below it, each in a folder of its own' files forest './props/lamp/A.frag ./props/lamp/A.vert ./two/A.frag ./two/A.vert '
check 'a folder of a folder can be generated beside a file' exits 0 "$mxgen" tree/props/ two.mtlx -e A -o grove
check 'a folder and a file give a folder for each document' files grove './lamp/A.frag ./lamp/A.vert ./two/A.frag ./two/A.vert '
check 'a folder without documents fails the run' exits 1 "$mxgen" tree/empty
check 'the error says that the folder has no document' grep -q "'tree/empty': the folder has no document" err
check 'a folder can be validated' exits 0 timeout 60 "$mxgen" validate tree

mkdir -p library/sub && echo '<materialx version="1.39"><nodedef name="ND_own" node="own"><output name="out" type="float"/></nodedef></materialx>' >library/sub/own.mtlx
ln -s . library/self && ln -s . library/again && ln -s .. library/sub/up && ln -s sub library/alias && mkfifo library/sub/pipe.mtlx
check 'a library may have circles of links and a pipe' exits 0 timeout 60 "$mxgen" library list library
check 'each file of such a library is read once' is "$(grep -c ND_own out)" 1
check 'such a library can be that of a document' exits 0 timeout 60 "$mxgen" two.mtlx -e A --library library -o linked --depfile linked.d
check 'the depfile names files of the library by their first path' grep -q ' library/alias/own.mtlx' linked.d

# A file that is read and written, or written twice
cp two.mtlx clash.mtlx && cp "$here/parts/name_clash.mtlx" .
echo '<materialx version="1.39"><nodedef name="ND_own" node="own"><output name="out" type="float"/></nodedef></materialx>' >lib.mtlx
printf '%s\n' '<materialx version="1.39" xmlns:xi="http://www.w3.org/2001/XInclude"><xi:include href="clash.mtlx"/></materialx>' >including.mtlx
while IFS='|' read -r file options; do
    cp "$file" before
    # shellcheck disable=SC2086
    check "an output may not replace an input: $options" exits 1 "$mxgen" $options
    check "the error is output-clash: $options" grep -q "\[output-clash\]" err
    check "the input is unchanged: $options" cmp "$file" before
done <<'X'
clash.mtlx|clash.mtlx -o clashes --depfile clash.mtlx
clash.mtlx|clash.mtlx -o clashes --depfile ./tree/../clash.mtlx
clash.mtlx|including.mtlx -o clashes --depfile clash.mtlx
lib.mtlx|clash.mtlx --library lib.mtlx -o clashes --depfile lib.mtlx
clash.mtlx|clash.mtlx -o clashes --depfile clashes/A.frag
name_clash.mtlx|name_clash.mtlx -o clashes
name_clash.mtlx|name_clash.mtlx -t osl -o clashes
name_clash.mtlx|name_clash.mtlx -t osl --osl-network -o clashes
lib.mtlx|library pack lib.mtlx -o lib.mtlx
lib.mtlx|library expand lib.mtlx -o ./lib.mtlx
clash.mtlx|format clash.mtlx -o ./clash.mtlx
clash.mtlx|upgrade clash.mtlx -o clash.mtlx
X
check 'clashes are found before anything is written' test ! -e clashes
ln -s clash.mtlx link.mtlx
check 'an output through a link to an input fails the run' exits 1 "$mxgen" link.mtlx -o clashes --depfile clash.mtlx
check 'the error of a link to an input is output-clash' grep -q "\[output-clash\]" err
check 'one of two elements with one file name can be generated' exits 0 "$mxgen" name_clash.mtlx -e a.b -o clashes

mkdir -p deep/deeper && sed 's|<look |<xi:include href="../../thrice_part.mtlx"/><look |; s|<materialx |&xmlns:xi="http://www.w3.org/2001/XInclude" |' two.mtlx >deep/deeper/up.mtlx
echo '<materialx version="1.39"/>' >thrice_part.mtlx
check 'an include may lie in a folder above' exits 0 "$mxgen" validate deep/deeper/up.mtlx
check 'an include may lie above a path with ./' exits 0 "$mxgen" validate ./deep/./deeper/up.mtlx

# Standard input
sed 's|<look |<xi:include href="other/part.mtlx"/><look |; s|<materialx |&xmlns:xi="http://www.w3.org/2001/XInclude" |' two.mtlx >piped.mtlx
cp thrice_part.mtlx other/part.mtlx
check 'a document may come from standard input' exits 0 bash -c "'$mxgen' - -o piped --depfile piped.d <piped.mtlx"
check 'a document from standard input gives the files of a document from a file' diff -r all piped
check 'a depfile does not name standard input' eval 'grep -q "^piped/A.vert .*: other/part.mtlx$" piped.d'
check 'standard input may be one of several inputs' exits 0 bash -c "'$mxgen' - two.mtlx -e A -o inputs <two.mtlx"
check 'standard input gets a folder among several inputs' files inputs './stdin/A.frag ./stdin/A.vert ./two/A.frag ./two/A.vert '
check 'a fault in standard input fails the run' exits 1 bash -c "'$mxgen' validate - <bad.mtlx"
check 'a fault in standard input has a place' grep -Eq '^<stdin>:8:[0-9]+: error: .*\[bad-value\]' err
check 'a fault in standard input is shown with its line' grep -q 'value="abc"' err
check 'a closed standard input fails the run' exits 1 bash -c "'$mxgen' - <&-"

# Bad input: exit code 1, and nothing half-written
check 'a bad value fails the run' exits 1 "$mxgen" bad.mtlx -o bad
check 'a bad value has id, line and column' grep -Eq '^bad\.mtlx:8:[0-9]+: error: .*\[bad-value\]' err
check 'a bad value is shown with its line' grep -q 'value="abc"' err
check 'a bad value is shown with a caret' grep -Eq '^ *\^' err
check 'elements without the bad value are written' files bad './A.frag ./A.vert '
sed 's|<look |<xi:include href="none.mtlx"/><look |; s|<materialx |&xmlns:xi="http://www.w3.org/2001/XInclude" |' two.mtlx >part.mtlx
check 'a missing include fails the run' exits 1 "$mxgen" part.mtlx -o part
check 'a missing include has id, line and column' grep -Eq '^part\.mtlx:17:[0-9]+: error: .*\[include-missing\]' err
check 'a missing include does not stop the other elements' diff -r all part
head -n 12 two.mtlx >half.mtlx
check 'a truncated file fails the run' exits 1 "$mxgen" half.mtlx -o half
check 'a truncated file gives no output' none_in half
check 'a missing file fails the run' exits 1 "$mxgen" none.mtlx
check 'the error of a missing file is file-missing' grep -q '\[file-missing\]' err
check 'too little memory fails the run' exits 1 "$mxgen" two.mtlx --max-memory 1000
check 'the error names the memory' grep -q 'memory \[failed\]' err
: >empty.mtlx
check 'an empty file fails the run' exits 1 "$mxgen" empty.mtlx
check 'the error of an empty file is file-empty' grep -q '\[file-empty\]' err
cp two.mtlx locked.mtlx && chmod 0 locked.mtlx
if [ -r locked.mtlx ]; then
    skip 'root reads every file'
else
    check 'an unreadable file fails the run' exits 1 "$mxgen" locked.mtlx
fi
cat >leaf.mtlx <<'X'
<materialx version="1.39">
  <nodedef name="ND_matte" node="matte"><input name="weight" type="float" value="1"/><output name="out" type="BSDF"/></nodedef>
  <implementation name="IM_matte" nodedef="ND_matte" file="matte.glsl" function="matte"/>
  <matte name="m" type="BSDF"/>
  <surface name="S" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="m"/></surface>
</materialx>
X
echo 'vec3 matte_eval(vec3 N, vec3 L) { return vec3(0.3 * max(dot(N, L), 0.0)); }' >matte.glsl
check "a leaf of a document is generated" exits 0 "$mxgen" leaf.mtlx -o leaf
check 'a leaf of a document is fitted in OSL' exits 0 "$mxgen" leaf.mtlx -t osl -o leaf
check 'the warning tells the closures' grep -q 'no closure for this <matte>: a sum of 1 closure stands for it.*\[closure-fitted\]' err
check 'the light is that of the leaf' grep -Fq 'oren_nayar_diffuse_bsdf(N, color(1.0), 0.0) * 0.942' leaf/S.osl # 0.3 pi
check 'a leaf of a document is fitted in networks of OSL' exits 0 "$mxgen" leaf.mtlx -t osl --osl-network -o net
check 'the warning of the network tells the closures' grep -q 'closure-fitted' err
cat >gloss.mtlx <<'X'
<materialx version="1.39">
  <nodedef name="ND_gloss" node="gloss"><input name="power" type="float" value="3"/><output name="out" type="BSDF"/></nodedef>
  <implementation name="IM_gloss" nodedef="ND_gloss" file="gloss.glsl" function="gloss"/>
  <nodedef name="ND_bent" node="bent"><output name="out" type="BSDF"/></nodedef>
  <implementation name="IM_bent" nodedef="ND_bent" file="gloss.glsl" function="bent"/>
  <nodedef name="ND_read" node="read"><output name="out" type="BSDF"/></nodedef>
  <implementation name="IM_read" nodedef="ND_read" file="gloss.glsl" function="read"/>
  <noise2d name="n" type="float"/>
  <gloss name="g" type="BSDF"><input name="power" type="float" value="2"/></gloss>
  <gloss name="v" type="BSDF"><input name="power" type="float" nodename="n"/></gloss>
  <bent name="b" type="BSDF"/>
  <read name="r" type="BSDF"/>
</materialx>
X
cat >gloss.glsl <<'X'
in vec3 positionWorld;
vec3 gloss_eval(float power, vec3 N, vec3 L) { return vec3(pow(max(dot(N, L), 0.0), power)); }
vec3 bent_eval(vec3 N, vec3 V, vec3 L) { return vec3(pow(max(dot(N, L), 0.0), 50.0) * max(dot(N, L), 0.0)); }
vec3 read_eval(vec3 N, vec3 L) { return positionWorld * max(dot(N, L), 0.0); }
X
check 'an input of a leaf is compiled in' exits 0 "$mxgen" gloss.mtlx -e g -t osl --uniform '**' --reflect -o leaf
check 'the reflection tells it' grep -q '"path": "g/power"' leaf/g.json
check 'an input that varies is an error' exits 1 "$mxgen" gloss.mtlx -e v -t osl -o leaf
check 'the error names the input' grep -q "osl has no closure for 'gloss'.*'power' varies.*\[not-renderable\]" err
check 'light that no closures send is an error' exits 1 "$mxgen" gloss.mtlx -e b -t osl -o leaf
check 'the error tells how much' grep -q "for 'bent'.*sends [0-9]* % of its light elsewhere.*\[not-renderable\]" err
check 'functions that read the shader are an error' exits 1 "$mxgen" gloss.mtlx -e r -t osl -o leaf
check 'the error tells why' grep -q "for 'read'.*cannot be evaluated.*\[not-renderable\]" err
check 'an unknown element fails the run' exits 1 "$mxgen" two.mtlx --element B
check 'the error of an unknown element is unknown-element' grep -q '\[unknown-element\]' err
check 'a run with -q fails as without' exits 1 "$mxgen" bad.mtlx -q -o bad
check '-q prints errors' grep -q bad-value err
check 'a pipe gets no colours' eval '! grep -q "$(printf "\033")" err'

# Warnings
sed 's|<input name="value" type="color3" value="1, 0.5, 0"/>|&<input name="valeu" type="float" value="1"/>|' two.mtlx >warned.mtlx
check 'a document with a warning passes' exits 0 "$mxgen" validate warned.mtlx
check 'the warning is unknown-input' grep -Eq 'warning: .*valeu.*value.*\[unknown-input\]' err
check 'a run with -Wno-ID passes' exits 0 "$mxgen" validate warned.mtlx -Wno-unknown-input
check '-Wno-ID hides the warning' eval '! grep -q unknown-input err'
check '-Werror fails the run' exits 1 "$mxgen" validate warned.mtlx -Werror
check '-Werror makes the warning an error' grep -Eq 'error: .*\[unknown-input\]' err
check '-Werror=ID fails the run' exits 1 "$mxgen" validate warned.mtlx -Werror=unknown-input
check '-Wno-error=ID lets a warning pass' exits 0 "$mxgen" validate warned.mtlx -Werror -Wno-error=unknown-input
check '-Wno-error=ID leaves a warning' grep -q 'warning: ' err
check 'an unknown id of -W is wrong usage' exits 2 "$mxgen" validate warned.mtlx -Wno-unknown-inputs
check 'an unknown id of -W has a suggestion' grep -q "did you mean 'unknown-input'" err
check 'an error cannot be switched off' exits 2 "$mxgen" validate bad.mtlx -Wno-bad-value
for i in $(seq 30); do echo "<nonsense name='n$i' type='float'/>"; done | { echo "<materialx version='1.39'>"; cat; echo '</materialx>'; } >thirty.mtlx
check 'thirty errors fail the run' exits 1 "$mxgen" validate thirty.mtlx
check 'twenty of thirty errors are printed' eval 'test "$(grep -c unknown-node err)" -eq 20 && grep -q "more than 20 errors" err'
check 'a run with --max-errors 0 fails as without' exits 1 "$mxgen" validate thirty.mtlx --max-errors 0
check '--max-errors 0 prints all errors' eval 'test "$(grep -c unknown-node err)" -eq 30'
# Equal warnings appear once, with the lines of the others; a note without a message needs --verbose.
{
    echo '<materialx version="1.39">'
    for i in $(seq 15); do echo "<constant name='c$i' type='float' nodeid='$i'/><output name='o$i' type='float' nodename='c$i'/>"; done
    echo '<constant name="p" type="color3"><input name="value" type="color3" value="1, 1, 1" colorspace="srgb_tx"/></constant>'
    echo '<output name="q" type="color3" nodename="p"/></materialx>'
} >repeats.mtlx
check 'a document with a warning in fifteen places passes' exits 0 "$mxgen" validate repeats.mtlx
check 'a warning in fifteen places is printed once' eval 'test "$(grep -c unknown-attribute err)" -eq 1 && grep -q "^note: and 14 more, in the lines 3, 4, 5, 6, 7, 8, 9, 10, …" err'
check 'a note without a message is not printed' eval '! grep -q colorspace-alias err'
check 'a document with a note passes with --verbose' exits 0 "$mxgen" validate repeats.mtlx --verbose
check '--verbose prints the note' grep -q "note: 'srgb_tx' is another name of the colour space 'srgb_texture' \[colorspace-alias\]" err
# Errors that follow from a missing include are counted for every element
{
    echo '<materialx version="1.39" xmlns:xi="http://www.w3.org/2001/XInclude"><xi:include href="absent.mtlx"/>'
    for i in 1 2 3; do echo "<glow name='g$i' type='float'/><output name='o$i' type='float' nodename='g$i'/>"; done
    echo '</materialx>'
} >absent_include.mtlx
check 'a document with a missing include is not valid' exits 1 "$mxgen" validate absent_include.mtlx
check 'the missing include is the only error' eval 'test "$(grep -c "error: " err)" -eq 1 && grep -q "note: 3 more errors may follow" err'
check 'a missing include fails a generation' exits 1 "$mxgen" absent_include.mtlx -o absent
check 'the missing include is the only error of the generation' eval 'test "$(grep -c "error: " err)" -eq 1'
check 'an unknown working space fails the run' exits 1 "$mxgen" two.mtlx --colorspace acecsg -o space
check 'the error suggests a working space' grep -q "'acecsg' is not a value of option 'colorspace'; expected acescg" err
check 'a working space like no other fails the run' exits 1 "$mxgen" two.mtlx --colorspace moonlight -o space
check 'the error lists the working spaces' grep -q 'one of: none, lin_rec709, .*acescg' err
# Nodes are found by name
check 'library list takes a word' exits 0 "$mxgen" library list NOISE2
check 'library list lists the nodes with the word' eval 'test "$(grep -c noise2d out)" -eq "$(wc -l <out)" && grep -q "^ND_noise2d_float  noise2d(" out'
check 'library list fails for a misspelt word' exits 1 "$mxgen" library list nois2d
check 'the error suggests a node for the misspelt word' grep -q "did you mean 'noise2d'" err
check 'explain takes a node' exits 0 "$mxgen" explain standard_surface
check 'explain prints the inputs of a node' grep -Eq '^ +base_color +color3 +0.8, 0.8, 0.8' out
check 'explain fails for a misspelt node' exits 2 "$mxgen" explain standard_surfac
check 'the error suggests a node' grep -q "did you mean 'standard_surface'" err
check 'explain prints no raw format' eval '"$mxgen" explain | { ! grep -q "%[sud]"; }'

# Output that cannot be written
touch file
check 'a folder that cannot be made fails the run' exits 1 "$mxgen" two.mtlx -o file/sub
check 'the error of such a folder is output-failed' grep -q '\[output-failed\]' err
# A limit on file sizes is a full disk that needs no privileges.
check 'a full disk fails the run' exits 1 bash -c "ulimit -f 1; exec '$mxgen' two.mtlx -e A -o full"
check 'the error of a full disk is output-failed' grep -q '\[output-failed\]' err
check 'a full disk leaves no half-written file' eval '! grep -L "^}" full/* | grep -q . && ! ls full | grep -q tmp'
check 'a full standard output fails the run' bash -c "'$mxgen' two.mtlx --stdout >/dev/full 2>err; test \$? -eq 1"
check 'a full disk fails the expansion of a library' exits 1 "$mxgen" library expand -o /dev/full

# Bad usage: exit code 2
check 'a run without arguments is wrong usage' exits 2 "$mxgen"
check 'a run without an input is wrong usage' exits 2 "$mxgen" --target glsl
check 'an unknown option is wrong usage' exits 2 "$mxgen" two.mtlx --interfase reduced
check 'an unknown option has a suggestion' grep -q "did you mean '--interface'" err
check 'an unknown command is wrong usage' exits 2 "$mxgen" inspec
check 'an unknown command has a suggestion' grep -q "unknown command or file 'inspec' (did you mean 'inspect'" err
check 'a bad value of an option is wrong usage' exits 2 "$mxgen" two.mtlx --interface some
check 'the error lists the values' grep -q complete err
check 'a missing value is wrong usage' exits 2 "$mxgen" two.mtlx --target
for value in --output= --element= --depfile=; do
    check "an empty value of $value is wrong usage" exits 2 "$mxgen" two.mtlx "$value"
done
check 'an empty word as a value is wrong usage' exits 2 "$mxgen" two.mtlx -o ''
for command in generate inspect check; do
    check "an unknown target of $command is wrong usage" exits 2 "$mxgen" "$command" two.mtlx --target glslx
    check "the error of $command lists the targets" grep -q 'glsl, vulkan, essl, ' err
done
check 'help on an unknown command is wrong usage' exits 2 "$mxgen" help inspec
while IFS='|' read -r options option; do
    # shellcheck disable=SC2086
    check "the command has no such option: $options" exits 2 "$mxgen" $options
    check "the error says that --$option does not apply" grep -q "option '--$option' does not apply" err
done <<'X'
library list -o list|output
library list --html|html
library pack --pictures -o pack|pictures
library expand --markdown|markdown
explain bad-value --markdown -o explained|output
X
check 'an unknown action is wrong usage' exits 2 "$mxgen" library lst

# Texts
check '--version is accepted' exits 0 "$mxgen" --version
check '--version prints the version' grep -Eq '^mxgen [0-9]+\.[0-9]+\.[0-9]+$' out
check '--help is accepted' exits 0 "$mxgen" --help
cp out overview
check 'help is accepted' exits 0 "$mxgen" help
check 'help prints the same as --help' cmp out overview
for command in generate inspect validate library; do
    check "$command --help is accepted" exits 0 "$mxgen" "$command" --help
    cp out by_option
    check "help $command is accepted" exits 0 "$mxgen" help "$command"
    check "help $command prints the same as $command --help" cmp out by_option
done

# Materials that differ in names and in values of uniforms share a program
one_material() { # NAME VALUE of the shader
    printf '%s\n' '<materialx version="1.39">' "<standard_surface name='SR_$1' type='surfaceshader'><input name='coat' type='float' value='$2'/>" \
        "<input name='base_color' type='color3' value='$2, 0.2, 0.7'/></standard_surface>" \
        "<surfacematerial name='$1' type='material'><input name='surfaceshader' type='surfaceshader' nodename='SR_$1'/></surfacematerial>" '</materialx>'
}
one_material a 0.25 >short.mtlx
one_material a_material_of_a_show_whose_names_are_never_short_at_all 1 >long.mtlx
check 'a material of a short name is generated' exits 0 "$mxgen" short.mtlx --names neutral --reflect -o short
check 'a material of a long name is generated' exits 0 "$mxgen" long.mtlx --names neutral --reflect -o long
check 'names do not change the topology' eval 'diff <(grep topology short/*.json) <(grep topology long/*.json)'
check 'neutral names do not change the statements' eval 'diff <(sed "1,/^void main/d" short/*.frag) <(sed "1,/^void main/d" long/*.frag)'
check 'names by path do not change the topology' eval '"$mxgen" long.mtlx --reflect -o path && diff <(grep topology short/*.json) <(grep topology path/*.json)'

# A material without a shader is the same error for all commands
shaderless() { exits 1 "$mxgen" "$@" && grep -q "^shaderless\.mtlx:4:26: error: the material 'A' has no shader; .*\[no-shader\]" err; }
value_only() { exits 1 "$mxgen" "$@" && grep -q '^value_only\.mtlx:5:.*(did you mean nodename="SR_a"?) \[shader-value\]' err; }
sed '5d' two.mtlx >shaderless.mtlx
sed '5s/nodename=/value=/' two.mtlx >value_only.mtlx
for document in shaderless value_only; do
    check "$document.mtlx has its error in validate" "$document" validate $document.mtlx
    check "$document.mtlx has its error in the generation of an element" "$document" $document.mtlx -e A -o $document-a
    check "the element of $document.mtlx writes nothing" none_in $document-a
    check "$document.mtlx has its error in the generation of all elements" "$document" $document.mtlx -o $document
    check "$document.mtlx gives the elements that have a shader" files $document './C.frag ./C.vert '
done

# Every node of type material is an element to generate, whatever its category
roots() { # FILE ELEMENTS of type material, and options
    { echo '<materialx version="1.39">'; cat; echo '</materialx>'; } >"$1.mtlx"
    check "$1 is valid" exits 0 "$mxgen" validate "$1.mtlx" -Werror "${@:3}"
    check "$1 is generated" exits 0 "$mxgen" "$1.mtlx" -Werror -o "roots-$1" "${@:3}"
    check "$1 gives its materials" files "roots-$1" "$2"
}
roots lama './Skin.frag ./Skin.vert ' <<'X'
<LamaDiffuse name="b" type="BSDF"/>
<LamaSurface name="Skin" type="material"><input name="materialFront" type="BSDF" nodename="b"/></LamaSurface>
X
check 'a material of Lama reflects light' grep -q u_lightData roots-lama/Skin.frag
roots own './Root.frag ./Root.vert ' <<'X'
<nodedef name="ND_shop" node="shop"><input name="base" type="color3" value="0.8, 0.1, 0.2"/><output name="out" type="material"/></nodedef>
<nodegraph name="NG_shop" nodedef="ND_shop">
  <oren_nayar_diffuse_bsdf name="b" type="BSDF"><input name="color" type="color3" interfacename="base"/></oren_nayar_diffuse_bsdf>
  <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="b"/></surface>
  <surfacematerial name="m" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>
  <output name="out" type="material" nodename="m"/>
</nodegraph>
<shop name="Root" type="material"/>
X
check 'a material of its own reflects light' grep -q u_lightData roots-own/Root.frag
roots implemented './Root.frag ./Root.vert ' -Wno-bad-definition <<'X'
<nodedef name="ND_shop" node="shop"><input name="paint" type="surfaceshader"/><output name="out" type="material"/></nodedef>
<implementation name="IM_shop" nodedef="ND_shop" nodegraph="Booth"/>
<nodegraph name="Booth">
  <input name="paint" type="surfaceshader"/>
  <surfacematerial name="m" type="material"><input name="surfaceshader" type="surfaceshader" interfacename="paint"/></surfacematerial>
  <output name="out" type="material" nodename="m"/>
</nodegraph>
<standard_surface name="SR" type="surfaceshader"/>
<shop name="Root" type="material"><input name="paint" type="surfaceshader" nodename="SR"/></shop>
X
check 'the shader of its definition draws' grep -q u_lightData roots-implemented/Root.frag
roots displaced './Waves.frag ./Waves.vert ' <<'X'
<noise3d name="n" type="float"/>
<displacement name="d" type="displacementshader"><input name="displacement" type="float" nodename="n"/></displacement>
<surfacematerial name="Waves" type="material"><input name="displacementshader" type="displacementshader" nodename="d"/></surfacematerial>
X
check 'a displacement alone moves vertices' grep -q mx_noise_float roots-displaced/Waves.vert
cat >booth.mtlx <<'X'
<materialx version="1.39">
<nodegraph name="Booth"><input name="paint" type="surfaceshader"/>
<surfacematerial name="sprayed" type="material"><input name="surfaceshader" type="surfaceshader" interfacename="paint"/></surfacematerial>
<output name="out" type="material" nodename="sprayed"/></nodegraph>
</materialx>
X
check 'an input of a graph that nobody sets fails the run' exits 1 "$mxgen" booth.mtlx -e Booth/sprayed -o booth
check 'the error says where a shader can be connected' grep -q "'sprayed' has no shader; connect a node to the input 'paint' of 'Booth' \[no-shader\]" err
check 'an input that nobody sets writes nothing' none_in booth

# Other commands
check 'a good document is valid' exits 0 "$mxgen" validate two.mtlx
check 'a document with a fault is not valid' exits 1 "$mxgen" validate bad.mtlx
for view in elements graph dot ir closures statistics slabs; do
    check "inspect --$view is accepted" exits 0 "$mxgen" inspect two.mtlx "--$view" --element A
    check "inspect --$view prints something" test -s out
done
# Weights are expressions with the names of inputs and nodes
check 'closures of a material are printed' exits 0 "$mxgen" inspect two.mtlx --closures --element A
check 'weights have the names of inputs' grep -q 'weight [A-Za-z_]*/[a-z_]*' out
check 'weights have no numbers of the graph' eval '! grep -q "%[0-9]" out'
check 'two surfaces of one definition are inspected' exits 0 "$mxgen" inspect --closures "${0%/*}/../golden/two_materials.mtlx"
check 'each of their closures says whose it is' eval '[ "$(grep -cE "^  (rust|paint)_(reflection|diffuse) " out)" = 4 ]'

# Nodes with more inputs than any list was made for
many_inputs() { # attributes of the <implementation>, [the end of its source]
    local i inputs='' sum=''
    for i in $(seq 300); do
        inputs+="<input name='i$i' type='float' value='$i'/>"
        sum+="$(((i - 1) % 100 ? 0 : 1)){{i$i}}"
    done
    sum=$(sed 's/0{{/ + {{/g; s/1{{/) + ({{/g; s/^) + //; s/$/)/' <<<"$sum")
    cat <<X
<materialx version="1.39"><nodedef name="D" node="many">$inputs<output name="out" type="float"/></nodedef>
<implementation name="I" nodedef="D" $1 sourcecode="$sum${2:-}"/>
<many name="m" type="float"/><output name="o" type="float" nodename="m"/></materialx>
X
}
many_inputs '' >many_inputs.mtlx
many_inputs 'target="genglsl"' ' + float(gl_FrontFacing)' >many_source.mtlx
check 'an expression may have 300 inputs' exits 0 "$mxgen" many_inputs.mtlx --interface reduced --stdout
check 'all inputs of the expression are summed' grep -q 45150.0 out
check 'source for one target may have 300 inputs' exits 0 "$mxgen" many_source.mtlx --trust --interface reduced --stdout
check 'all inputs of the source are read' test "$(grep -Eo '\b[0-9]+\.0' out | sort -u | wc -l)" -ge 300
# A function has 255 parameters, the limit of SPIR-V: a leaf as source, and as portable functions
leaf() { # INPUTS FILE, and attributes of the <implementation>
    local i inputs='' parameters='' sum=0.0
    for i in $(seq "$1"); do
        inputs+="<input name='i$i' type='float' value='0.$i'/>"
        parameters+="float i$i, "
        [ "$i" -gt 100 ] || sum+=" + i$i" # expressions have a limit, too
    done
    cat >leaf.glsl <<X
vec3 many_eval(${parameters}vec3 N, vec3 V, vec3 L) { return vec3($sum); }
X
    cat >source.glsl <<X
void many(ClosureData closureData, ${parameters}inout BSDF bsdf) { bsdf.response = vec3($sum); bsdf.throughput = vec3(gl_FragCoord.x); }
X
    cat >leaf.mtlx <<X
<materialx version="1.39"><nodedef name="D" node="many" bsdf="R">$inputs<output name="out" type="BSDF"/></nodedef>
<implementation name="I" nodedef="D" file="$2" function="many" ${3:-}/>
<many name="m" type="BSDF"/><surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="m"/></surface></materialx>
X
}
leaf 120 leaf.glsl
check 'a leaf may have 120 inputs' exits 0 "$mxgen" leaf.mtlx --stdout
check 'the leaf reads its inputs' grep -q 'const float i100' out
leaf 128 leaf.glsl # three vectors, and a result
check 'a leaf whose call has 132 numbers and vectors fails' exits 1 "$mxgen" leaf.mtlx --stdout
check 'the error stands at the node of the leaf' grep -q '^leaf.mtlx:3:1: error: .* more than 128 numbers and vectors \[lang-limit\]' err
check 'there is one error of the leaf' eval 'test "$(grep -c error: err)" -eq 1'
leaf 253 leaf.glsl
check 'a leaf of 256 parameters fails' exits 1 "$mxgen" leaf.mtlx --stdout
check 'the error gives the limit of parameters' grep -q 'leaf.glsl:1:6: error: a function has at most 255 parameters \[lang-limit\]' err
leaf 253 source.glsl 'target="genglsl"'
check 'source may have 255 parameters' exits 0 "$mxgen" leaf.mtlx --trust --stdout
leaf 254 source.glsl 'target="genglsl"'
check 'source of 256 parameters fails' exits 1 "$mxgen" leaf.mtlx --trust --stdout
check 'the error of the source gives the limit' grep -q 'it has more than 255 parameters \[function-signature\]' err
# A surface of more leaves than any list was made for
{
    echo '<materialx version="1.39"><oren_nayar_diffuse_bsdf name="a0" type="BSDF"/>'
    for i in $(seq 300); do
        echo "<oren_nayar_diffuse_bsdf name='b$i' type='BSDF'><input name='roughness' type='float' value='0.$((i + 1000))'/><input name='color' type='color3' value='0.$i, 0, 0'/></oren_nayar_diffuse_bsdf>"
        echo "<add name='a$i' type='BSDF'><input name='in1' type='BSDF' nodename='a$((i - 1))'/><input name='in2' type='BSDF' nodename='b$i'/></add>"
    done
    echo '<surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="a300"/></surface></materialx>'
} >leaves.mtlx
for target in glsl osl; do
    check "a surface may have 301 leaves for $target" exits 0 "$mxgen" leaves.mtlx --target $target --stdout
done
check 'a surface of 301 leaves is inspected' exits 0 "$mxgen" inspect leaves.mtlx --closures
check 'each of 301 leaves is listed' eval 'test "$(grep -c "mx_oren_nayar_diffuse_bsdf" out)" -eq 301'
cat >outputs.mtlx <<'X'
<materialx version="1.39"><nodedef name="D" node="two"><input name="in" type="float" value="2"/><output name="a" type="float"/><output name="b" type="float"/></nodedef>
<implementation name="I" nodedef="D" target="genglsl"><output name="a" sourcecode="{{in}} + float(gl_FrontFacing)"/><output name="b" sourcecode="{{in}} - gl_FragCoord.x"/></implementation>
<time name="t" type="float"/><two name="m" type="multioutput"><input name="in" type="float" nodename="t"/></two>
<add name="s" type="float"><input name="in1" type="float" nodename="m" output="a"/><input name="in2" type="float" nodename="m" output="b"/></add>
<output name="o" type="float" nodename="s"/></materialx>
X
check 'source of one target may have several outputs' exits 0 "$mxgen" outputs.mtlx --trust --stdout
check 'each output has its own source' grep -q 'u_time + float(gl_FrontFacing).*u_time - gl_FragCoord.x' out

# Each message shows its own line, wherever the messages before it stand
{
    echo '<materialx version="1.39">'
    for i in $(seq 40); do printf '<add name="a%d" type="float"><input name="in1" type="float" nodename="none%d"/></add>\n' $i $((41 - i)); done
    echo '</materialx>'
} >lines.mtlx
check 'a document with forty faults is not valid' exits 1 "$mxgen" validate lines.mtlx --max-errors 0
check 'forty faults have forty messages with their lines' eval "test \"\$(awk '/ error: /{ split(\$0, q, /\047/); getline line; good += index(line, q[2] \"\\\"\") > 0 } END { print good }' err)\" = 40"

# Nodes of 1.39 that were renamed
sed 's/<[/]*materialx.*>//' <<'X' | { echo '<materialx version="1.39">'; cat; echo '</materialx>'; } >conditions.mtlx
<ifgreater name="g" type="float"><input name="value1" type="float" value="1"/><input name="value2" type="float" value="2"/></ifgreater>
<compare name="h" type="float"><input name="intest" type="float" value="1"/></compare>
<output name="o" type="float" nodename="g"/><output name="p" type="float" nodename="h"/>
X
check 'ifgreater is a node' exits 0 "$mxgen" conditions.mtlx -e o --stdout
check 'compare is no node' exits 1 "$mxgen" validate conditions.mtlx
check 'the error names the successor of compare' eval 'test "$(grep -c "error:" err)" -eq 1 && has err "unknown node <compare>; MaterialX 1.39 has <ifgreatereq>, with '"'in1' and 'in2'"' swapped, in its place"'

check 'library list is accepted' exits 0 "$mxgen" library list
check 'library list has a line for each definition, its name first' eval 'grep -q "^ND_mix_float  mix(" out'
check 'library list has the 816 definitions of MaterialX' eval 'test "$(wc -l <out)" -ge 816'
check 'library expand is accepted' exits 0 "$mxgen" library expand -o expanded.mtlx
check 'library expand writes templates as definitions' eval 'grep -q "ND_add_color3\"" expanded.mtlx && ! grep -q "<template" expanded.mtlx'
cat >both.mtlx <<'X'
<materialx version="1.39">
  <nodedef name="ND_same" node="same"><input name="in" type="float" value="0.0"/><output name="out" type="float"/></nodedef>
  <implementation name="IM_same" nodedef="ND_same" sourcecode="{{in}}"/>
  <nodedef name="ND_grey" node="grey">
    <input name="level" type="float" value="0.5"/>
    <input name="glow" type="float" value="0.0"/>
    <output name="out" type="float"/>
  </nodedef>
  <implementation name="IM_grey" nodedef="ND_grey" sourcecode="{{level}} + {{glow}}"/>
  <nodegraph name="NG_grey" nodedef="ND_grey">
    <same name="c" type="float"><input name="in" type="float" interfacename="level"/></same>
    <output name="out" type="float" nodename="c"/>
  </nodegraph>
</materialx>
X
check 'library expand writes a graph for other tools' exits 0 "$mxgen" library expand --no-builtin-library both.mtlx -o graphs.mtlx
check 'an input that the graph lacks is a warning' eval '[ "$(grep -c "expand-loss" err)" = 1 ] && grep -q "^both.mtlx:6:.*warning: .*.glow. of <grey>.*\[expand-loss\]" err'
check 'a comment above the graph names the input' grep -q '<!-- Without a part in this graph: glow -->' graphs.mtlx
check 'the warning can be made an error' exits 1 "$mxgen" library expand --no-builtin-library both.mtlx -o graphs.mtlx -Werror=expand-loss
check 'a library without code has no warning' eval 'sed -i "/IM_grey/d" both.mtlx && exits 0 "$mxgen" library expand --no-builtin-library both.mtlx -o graphs.mtlx && test ! -s err'
cat >coat.mtlx <<'X'
<materialx version="1.39">
  <nodedef name="ND_paint" node="paint"><input name="color" type="color3" value="1, 0, 0"/><output name="out" type="BSDF"/></nodedef>
  <nodegraph name="NG_paint" nodedef="ND_paint">
    <slab name="a" type="BSDF"><input name="diffuse_albedo" type="color3" interfacename="color"/></slab>
    <output name="out" type="BSDF" nodename="a"/>
  </nodegraph>
</materialx>
X
check 'a library of built-in nodes is expanded' exits 0 "$mxgen" library expand coat.mtlx -o graphs.mtlx -Werror
check "the expansion has the library's own definitions only" test "$(grep -c '<nodedef' graphs.mtlx)" = 1
cat >extra.mtlx <<'X'
<?xml version="1.0"?>
<materialx version="1.39">
  <template vars="type" rows="float; color3">
    <nodedef name="ND_thrice_@type@" node="thrice">
      <input name="in" type="@type@" value="@type.one@"/>
      <output name="out" type="@type@"/>
    </nodedef>
    <implementation name="IM_thrice_@type@" nodedef="ND_thrice_@type@" sourcecode="{{in}} * 3.0"/>
  </template>
</materialx>
X
cat >thrice.mtlx <<'X'
<?xml version="1.0"?>
<materialx version="1.39">
  <nodegraph name="NG">
    <thrice name="t" type="color3"/>
    <output name="out" type="color3" nodename="t"/>
  </nodegraph>
</materialx>
X
check 'library pack is accepted' exits 0 "$mxgen" library pack extra.mtlx -o image.mxlib
check 'an image lists its definitions' eval '"$mxgen" library list image.mxlib | grep -q "^ND_thrice_color3  thrice("'
check 'a node of a library is unknown without it' exits 1 "$mxgen" thrice.mtlx
check 'the error is unknown-node' grep -q '\[unknown-node\]' err
check 'an image can replace the built-in library' exits 0 "$mxgen" thrice.mtlx --no-builtin-library --library image.mxlib -o image
check 'a document can be the library of another' exits 0 "$mxgen" thrice.mtlx --library extra.mtlx -o document --depfile library.d
check 'a depfile names the library' grep -q ' extra.mtlx' library.d
check 'an image and a document give the same files' diff -r image document
head -c 100 image.mxlib >broken.mxlib
check 'a broken image fails the run' exits 1 "$mxgen" thrice.mtlx --library broken.mxlib
check 'the error of a broken image is image-bad' grep -q '\[image-bad\]' err

# Colours of the geometry: the node's own space, and no parent's.
cat >colours.mtlx <<'X'
<materialx version="1.39" colorspace="acescg">
  <geompropvalue name="own" type="color3" colorspace="srgb_texture"><input name="geomprop" type="string" value="c"/><input name="default" type="color3" value="0.5, 0.5, 0.5"/></geompropvalue>
  <geompropvalue name="none" type="color3"><input name="geomprop" type="string" value="c"/></geompropvalue>
  <geompropvalue name="other" type="color3" colorspace="srgb_texture"><input name="geomprop" type="string" value="c"/><input name="default" type="color3" value="0.5, 0.5, 0.5" colorspace="lin_rec709"/></geompropvalue>
  <output name="o1" type="color3" nodename="own"/><output name="o2" type="color3" nodename="none"/><output name="o3" type="color3" nodename="other"/>
</materialx>
X
check 'a colour of the geometry is converted from the space of its node' eval '"$mxgen" inspect --ir colours.mtlx -e o1 >ir && has ir "srgb_texture_to"'
check 'and not from that of its parents' eval '"$mxgen" inspect --ir colours.mtlx -e o2 >ir && ! grep -q "_to_" ir'
check 'the working space none converts nothing' eval '"$mxgen" inspect --ir colours.mtlx -e o1 --colorspace none >ir && ! grep -q "_to_" ir'
check 'its default is of that space' eval '"$mxgen" colours.mtlx -e o1 -o colours --reflect -q && has colours/o1.json "\"default\": [0.5, 0.5, 0.5]"'
check 'a default of another space is brought into it' eval 'exits 0 "$mxgen" colours.mtlx -e o3 -o colours --reflect && has colours/o3.json "\"default\": [0.735" && [ ! -s err ]'

# The default of an image stands in for texels, so reflection has it in the space and the unit of the file: sRGB of 0.5 is 0.735357.
{
  echo '<materialx version="1.39">'
  for node in image tiledimage hextiledimage latlongimage gltf_image; do
    echo "<$node name=\"n_$node\" type=\"color3\"><input name=\"file\" type=\"filename\" value=\"\" colorspace=\"srgb_texture\"/><input name=\"default\" type=\"color3\" value=\"0.5, 0.5, 0.5\" colorspace=\"lin_rec709\"/></$node><output name=\"$node\" type=\"color3\" nodename=\"n_$node\"/>"
  done
  cat <<'X'
  <triplanarprojection name="n_tri" type="color3"><input name="filex" type="filename" value="" colorspace="srgb_texture"/><input name="default" type="color3" value="0.5, 0.5, 0.5"/></triplanarprojection>
  <output name="triplanarprojection" type="color3" nodename="n_tri"/>
  <UsdUVTexture name="n_usd" type="multioutput"><input name="file" type="filename" value="" colorspace="srgb_texture"/><input name="fallback" type="color4" value="0.5, 0.5, 0.5, 1"/></UsdUVTexture>
  <output name="UsdUVTexture" type="color3" nodename="n_usd" output="rgb"/>
  <tiledimage name="n_same" type="color3" colorspace="srgb_texture"><input name="file" type="filename" value=""/><input name="default" type="color3" value="0.25, 0.25, 0.25"/></tiledimage>
  <output name="same" type="color3" nodename="n_same"/>
  <image name="n_plain" type="color3"><input name="file" type="filename" value=""/><input name="default" type="color3" value="0.5, 0.5, 0.5" colorspace="srgb_texture"/></image>
  <output name="plain" type="color3" nodename="n_plain"/>
  <tiledimage name="n_feet" type="vector2"><input name="file" type="filename" value="" unit="foot"/><input name="default" type="vector2" value="0.3048, 0.6096"/></tiledimage>
  <output name="feet" type="vector2" nodename="n_feet"/>
  <geomcolor name="paint" type="color3"/>
  <image name="n_varies" type="color3"><input name="file" type="filename" value="" colorspace="srgb_texture"/><input name="default" type="color3" nodename="paint"/></image>
  <output name="varies" type="color3" nodename="n_varies"/>
</materialx>
X
} >borders.mtlx
# border ELEMENT TEXT: the reflection of the element, with all inputs as uniforms and without, has the default
border() {
  for interface in complete reduced; do
    "$mxgen" borders.mtlx -e "$1" -o borders --reflect -q --interface $interface && has "borders/$1.json" "\"default\": $2" || return 1
  done
}
for node in image tiledimage hextiledimage latlongimage gltf_image triplanarprojection; do
  check "the default of <$node> is in the space of the file" border $node '[0.735'
done
check 'the fallback of <UsdUVTexture> is in the space of the file' border UsdUVTexture '[0.735'
check 'a default of the same space stays as it is' border same '[0.25, 0.25, 0.25]'
check 'a default beside a file without a space is converted' border plain '[0.21404'
check 'a default is in the unit of the file' border feet '[1.0, 2.0]'
check 'a default that varies is told' eval 'exits 0 "$mxgen" borders.mtlx -e varies -o borders && has err "borders.mtlx:18:" "it varies" "[image-default]"'

finish cli
