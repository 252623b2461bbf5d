#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# mxgen check: the selection of documents, the report, exit codes, and isolation of failures. Arguments: mxgen, a worker whose
# behaviour follows the names of documents (fake_worker.c), whether shaders can be compiled (yes or no).
mxgen=$(realpath "$1") fake=$(realpath "$2") compiles=$3
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../programs/common.sh"
. "$here/materials.sh"

mkdir -p tree/sub/deep tree/.hidden
material A >tree/a.mtlx
material B >tree/b.mtlx
material C >tree/sub/c.mtlx
material D >tree/sub/deep/d.mtlx
material H >tree/.hidden/h.mtlx
echo text >tree/readme.txt
ln -s .. tree/sub/back # a circle of links

# Which documents
quick=(--no-compile -j2)
check 'a folder can be checked' exits 0 "$mxgen" check tree "${quick[@]}" --json tree.json
check 'the documents of a folder are all that lie below, in order' says tree.json '[x["file"] for x in d]' "['tree/a.mtlx', 'tree/b.mtlx', 'tree/sub/c.mtlx', 'tree/sub/deep/d.mtlx']"
check 'the documents of a report are numbered' says tree.json '[x["index"] for x in d]' '[0, 1, 2, 3]'
check 'a pattern can be checked' exits 0 "$mxgen" check 'tree/*.mtlx' "${quick[@]}" --json pattern.json
check 'the documents of a pattern are those that match' says pattern.json '[x["file"] for x in d]' "['tree/a.mtlx', 'tree/b.mtlx']"
check 'a pattern that nothing matches is an error' exits 1 "$mxgen" check 'tree/none*.mtlx' tree/a.mtlx "${quick[@]}"
check 'the error names the pattern' grep -q "no file matches 'tree/none\*.mtlx' \[file-missing\]" err
check 'a pattern that nothing matches counts as no document' grep -q '^1 document, 1 element, 1 shader$' out
printf 'tree/b.mtlx\r\n\n./tree/a.mtlx\ntree/sub\n' >list
check 'a list can be checked' exits 0 "$mxgen" check @list "${quick[@]}" --json list.json
check 'the documents of a list have its order' says list.json '[x["file"] for x in d]' "['tree/b.mtlx', 'tree/a.mtlx', 'tree/sub/c.mtlx', 'tree/sub/deep/d.mtlx']"
check 'a list can come from standard input' eval '"$mxgen" check --files-from - "${quick[@]}" --json stdin.json <list'
check 'a list from standard input gives the same report' cmp list.json stdin.json
check 'a document may be named several times' exits 0 "$mxgen" check tree/a.mtlx tree @list "${quick[@]}" --json twice.json
check 'a document that is named several times is checked once' says twice.json 'len(d), len({x["file"] for x in d})' '(4, 4)'
check 'a list that does not exist is an error' exits 1 "$mxgen" check tree @none "${quick[@]}"
check 'a document that does not exist fails the run' exits 1 "$mxgen" check tree/none.mtlx tree/a.mtlx "${quick[@]}"
check 'a document that does not exist has an id' grep -q '\[file-missing\]' out
check 'a document that does not exist leaves the others to be checked' grep -q '^1 passed, 1 failed (load 1)' out
mkdir -p kept/locked && cp tree/a.mtlx kept && chmod 0 kept/locked
if [ -r kept/locked ]; then
    skip 'root reads every folder'
else
    check 'a folder that cannot be read fails the run' exits 1 "$mxgen" check kept "${quick[@]}"
    check 'the error names the folder that cannot be read' grep -q "cannot read the folder 'kept/locked'.*\[file-unreadable\]" err
fi
check 'a time limit of 0 is no limit' exits 0 "$mxgen" check tree/a.mtlx "${quick[@]}" --time-limit 0
mkdir empty
for target in glsl vulkan essl hlsl; do
    check "functions of a path tracer have prefixes, $target" exits 0 "$mxgen" check tree/a.mtlx -t $target --role scatter --prefix my_
done
check 'a run with nothing to check fails' exits 1 "$mxgen" check empty
check 'a run with nothing to check has an id' grep -q '\[nothing-to-check\]' err
check 'a run without arguments is wrong usage' exits 2 "$mxgen" check
check 'an unknown target is wrong usage' exits 2 "$mxgen" check tree -t gsls
check 'an unknown option is wrong usage' exits 2 "$mxgen" check tree --jobbs 2
check 'a bad value of an option of generation is wrong usage' exits 2 "$mxgen" check tree --interface none

# Messages
sed 's/standard_surface/standard_surfase/' tree/a.mtlx >bad.mtlx
sed 's/value="0.5"/value="abc"/' tree/a.mtlx >worse.mtlx
head -n 5 tree/a.mtlx >half.mtlx
echo '<materialx version="1.39"><surfacematerial name="M" type="material"/></materialx>' >shaderless.mtlx
check 'a material without a shader fails the run' exits 1 "$mxgen" check shaderless.mtlx "${quick[@]}" --json shaderless.json
check 'a material without a shader is an error of its document' says shaderless.json '(d[0]["failure"], [m["id"] for m in d[0]["messages"]])' "('validate', ['no-shader'])"
check 'documents with errors fail the run' exits 1 "$mxgen" check bad.mtlx worse.mtlx half.mtlx tree "${quick[@]}" --json bad.json
check 'documents with errors do not stop the others' says bad.json '[x["status"] for x in d]' "['failed', 'failed', 'failed', 'passed', 'passed', 'passed', 'passed']"
check 'the report has each failure' says bad.json '[x["failure"] for x in d[:3]]' "['validate', 'validate', 'load']"
check 'the report has the place of each failure' says bad.json '(d[1]["messages"][0]["id"], d[1]["messages"][0]["line"])' "('bad-value', 4)"
check 'the text shows the line of an error' grep -q 'value="abc"' out
check 'a fault is printed once' is "$(grep -c '^worse.mtlx:4:.*error' out)" 1
check 'the summary is the last line' is "$(tail -n 1 out)" "$(grep 'passed, 3 failed' out)"
{
    echo '<materialx version="1.39">'
    for i in $(seq 30); do
        echo "<nonsense name='n$i' type='float'/><output name='o$i' type='float' nodename='n$i'/>"
    done
    echo '</materialx>'
} >many.mtlx # each output is a generation of its own
check 'a document with many faults fails' exits 1 "$mxgen" check many.mtlx "${quick[@]}" --json many.json
check '20 errors of a document are printed' is "$(grep -c 'error:' out)" 20
check 'a note says that there are more errors' grep -q '^note: more than 20 errors; the rest is not shown' out
check 'every shader of the report refers to the errors' says many.json 'all(s["messages"] for e in d[0]["elements"] for s in e["shaders"])' True
check '--max-errors 0 prints all errors' eval 'exits 1 "$mxgen" check many.mtlx "${quick[@]}" --max-errors 0; is "$(grep -c "error:" out)" 30'
check 'a generation of a document with many faults fails' exits 1 "$mxgen" many.mtlx -o many_out
check 'a generation prints 20 errors of a document' is "$(grep -c 'error:' err)" 20
check 'a generation notes once that there are more errors' is "$(grep -c '^note: more than 20 errors' err)" 1
mkdir repeats && for i in $(seq 15); do echo "<constant name='c$i' type='float' nodeid='$i'/><output name='o$i' type='float' nodename='c$i'/>"; done |
    { echo '<materialx version="1.39">'; cat; echo '<constant name="c16" type="float" uid="1"/></materialx>'; } >repeats/a.mtlx
sed 's/ nodeid=.[0-9]*.//' repeats/a.mtlx >clean.mtlx
check 'a document with a warning in fifteen places passes' exits 0 "$mxgen" check repeats "${quick[@]}" --json repeats.json --html repeats.html
check 'a warning in fifteen places is printed once' is "$(grep -c "'nodeid'" out)" 1
check 'the printed warning names the lines of the others' eval 'grep -A3 "nodeid" out | grep -q "^note: and 14 more, in the lines 3, 4, 5, 6, 7, 8, 9, 10, …$"'
check 'another warning is printed by itself' is "$(grep -c "'uid'" out)" 1
check 'the page has a warning of the document once, on its card' is "$(grep -o "attribute &#39;nodeid&#39;" repeats.html | wc -l)" 1
check 'the card counts the other places' is "$(grep -o 'and 14 more' repeats.html | wc -l)" 1
check 'the page has a card for the document and one for each of 15 elements' is "$(grep -o '<article' repeats.html | wc -l)" 16
check 'reports for programs have a warning for each place' says repeats.json 'sum("nodeid" in m["message"] for m in d[0]["messages"])' 15
check 'a baseline with the warning can be made' exits 0 "$mxgen" check repeats --root repeats "${quick[@]}" --baseline repeats.base --update-baseline
cp clean.mtlx repeats/a.mtlx
check 'a baseline can be made of a document without the warning' eval 'exits 0 "$mxgen" check repeats --root repeats "${quick[@]}" --baseline clean.base --update-baseline'
sed "s/'float'\/><output/'float' nodeid='1'\/><output/" clean.mtlx >repeats/a.mtlx
check 'fifteen new warnings fail a run that forbids new warnings' exits 1 "$mxgen" check repeats --root repeats "${quick[@]}" --baseline clean.base --fail-on new-warnings
check 'fifteen new warnings are one change' is "$(grep -c '^FAILED .*(new-warnings)' out)" 1
check 'the change names the lines of the others' grep -q '^note: and 14 more, in the lines 3' out
check 'a run takes several targets' exits 0 "$mxgen" check tree/a.mtlx -t glsl,essl -t vulkan "${quick[@]}" --json targets.json
check 'the report has every element for every target' says targets.json '[s["target"] for s in d[0]["elements"][0]["shaders"]]' "['glsl', 'essl', 'vulkan']"
cat >foreign.mtlx <<'X'
<materialx version="1.39">
  <nodedef name="ND_glow" node="glow"><output name="out" type="float"/></nodedef>
  <implementation name="IM_glow" nodedef="ND_glow" target="genosl" sourcecode="u"/>
  <glow name="g" type="float"/><output name="o" type="float" nodename="g"/>
</materialx>
X
check 'a node that only one target has fails the others' exits 1 "$mxgen" check foreign.mtlx -t glsl,osl,vulkan,hlsl --trust "${quick[@]}" --json foreign.json
check 'a node without an implementation is one error' is "$(grep -c 'error:' out)" 1
check 'the error says for which targets there are implementations' grep -q "'ND_glow' has no implementation for this target; it has implementations for: genosl \[missing-implementation\]" out
check 'a note says for which targets the node is missing' grep -q '^note: for the targets glsl, vulkan, hlsl$' out
check 'reports for programs refer to the error from each target' says foreign.json '[s.get("messages", []) for s in d[0]["elements"][0]["shaders"]]' '[[0], [], [0], [0]]'
check 'a node that no target of a run has fails the run' exits 1 "$mxgen" check foreign.mtlx -t glsl,vulkan --trust "${quick[@]}"
check 'an error of all targets has no note about targets' eval '! grep -q "note: for the target" out'
check 'options of generation are accepted' exits 0 "$mxgen" check tree/a.mtlx --interface reduced "${quick[@]}" --json reduced.json
check 'a reduced interface makes smaller shaders' eval \
    '[ "$(json reduced.json "$uniforms")" -lt "$(json targets.json "$uniforms")" ]' # in materials.sh
check 'a report can go to standard output' exits 0 "$mxgen" check tree --json - "${quick[@]}"
check 'standard output has nothing but the report' python3 -m json.tool out
check 'two runs give the same bytes' eval '"$mxgen" check tree -j1 --no-compile --json again.json && cmp tree.json again.json'
check '--stats is accepted' exits 0 "$mxgen" check tree --stats "${quick[@]}"
check '--stats lists the slowest documents' grep -q 'slowest documents' out
check 'a report in a folder that does not exist fails the run' exits 1 "$mxgen" check tree "${quick[@]}" --json none/a.json
check 'the error of a report in no folder is output-failed' grep -q output-failed err
check 'a report on a full disk fails the run' exits 1 "$mxgen" check tree "${quick[@]}" --json /dev/full
check 'the error of a full disk is output-failed' grep -q output-failed err
compiled=
if [ "$compiles" = yes ]; then
    compiled=1
    check 'shaders of three targets compile' exits 0 "$mxgen" check tree/a.mtlx -t glsl,vulkan,essl --json compiled.json
    check 'the report counts the instructions of each compiled shader' says compiled.json '[s["compiled"] and s["instructions"] > 500 for s in d[0]["elements"][0]["shaders"]]' '[True, True, True]'
    check 'the report tells where instructions go' says compiled.json 'all(max(s["parts"]["instructions"].values()) > 50 for s in d[0]["elements"][0]["shaders"])' True
else
    skip 'glslang is not installed: nothing was compiled'
fi

# A report over an input, or over another report
cp tree/a.mtlx over.mtlx && cp tree/b.mtlx part.mtlx && echo over.mtlx >over.list && cp tree.json shard.json && mkdir overs && cp over.mtlx overs
echo '<materialx version="1.39" xmlns:xi="http://www.w3.org/2001/XInclude"><xi:include href="part.mtlx"/></materialx>' >includes.mtlx
echo '<materialx version="1.39"><nodedef name="ND_own" node="own"><output name="out" type="float"/></nodedef></materialx>' >own.mtlx
while IFS='|' read -r file options; do
    cp "$file" before
    # shellcheck disable=SC2086
    check "a report may not replace an input: check $options" exits 1 "$mxgen" check $options
    check 'the error of a replaced input is output-clash' grep -q '\[output-clash\]' err
    check 'the input is unchanged' cmp "$file" before
done <<'X'
over.mtlx|over.mtlx --no-compile --json over.mtlx
over.mtlx|over.mtlx --no-compile --sarif ./over.mtlx
over.mtlx|over.mtlx --no-compile --junit tree/../over.mtlx
over.mtlx|over.mtlx --no-compile --html over.mtlx
over.mtlx|over.mtlx --no-compile --json y.json --depfile over.mtlx
overs/over.mtlx|overs --no-compile --json overs/over.mtlx
part.mtlx|includes.mtlx --no-compile --json part.mtlx
own.mtlx|over.mtlx --library own.mtlx --no-compile --json own.mtlx
over.list|@over.list --no-compile --json over.list
over.list|--files-from over.list --no-compile --json over.list
over.mtlx|over.mtlx --no-compile --json y.json --sarif ./y.json
shard.json|merge shard.json --json shard.json
shard.json|merge shard.json --html ./shard.json
X
check 'a run that fails so writes no other report' test ! -e y.json

# The schema of JSON reports
schema=$here/../../docs/check.schema.json
if python3 -c 'import jsonschema' 2>/dev/null; then
    for report in tree bad targets ${compiled:+compiled}; do
        check "$report.json follows its schema" validates "$schema" $report.json
    done
    check 'a report with times can be made' exits 0 "$mxgen" check tree --stats "${quick[@]}" --json times.json
    check 'a report with times follows its schema' validates "$schema" times.json
    sed 's/"status":"passed"/"status":"perhaps"/' tree.json >broken.json
    check 'the schema rejects a broken report' eval '! validates "$schema" broken.json'
else
    skip 'python3-jsonschema is not installed: reports are not compared with the schema'
fi

# Workers that die, hang and lie
mkdir programs && cp "$mxgen" programs/mxgen && cp "$fake" programs/mxgen-check
mkdir odd
touch odd/{a,b_dies,c,d_hangs,e_slow,f,g_lies,h}.mtlx
check 'a worker that dies, one that hangs and one that lies fail the run' exits 1 programs/mxgen check odd --time-limit 1 -j3 --json odd.json
check 'each of them fails its own document only' says odd.json '[x.get("failure", "passed") for x in d]' \
    "['passed', 'crash', 'passed', 'timeout', 'passed', 'passed', 'crash', 'passed']"
check 'each of them has an id' says odd.json '[m["id"] for x in d for m in x["messages"]]' "['check-crashed', 'check-timeout', 'check-crashed']"
check 'the error of a worker that dies says at which step' grep -q 'signal 9 (Killed) at: validate' out
mkdir many
for i in $(seq 100 199); do
    case $i in 1?7) touch many/${i}_dies.mtlx ;; 150) touch many/${i}_hangs.mtlx ;; *) touch many/$i.mtlx ;; esac
done
check 'a worker that has several documents may die' exits 1 programs/mxgen check many --time-limit 1 -j1 --verbose --json many.json
check 'a worker that dies loses only the document at hand' says many.json '[i for i, x in enumerate(d) if x.get("failure")]' '[7, 17, 27, 37, 47, 50, 57, 67, 77, 87, 97]'
check 'documents stay in order when workers die' says many.json '[int(x["file"].split("/")[1][:3]) for x in d] == list(range(100, 200))' True
check 'all answers arrive when workers die' is "$(grep -c '^passed' out)" 89
name=$(printf 'x%.0s' $(seq 200)) deep=deep
for i in $(seq 15); do deep=$deep/$name; done
mkdir -p "$deep"
touch "$deep"/{10..99}.mtlx
check 'paths may fill a pipe' exits 0 programs/mxgen check deep -j1 --json deep.json
check 'all documents with long paths are answered' says deep.json '{x["status"] for x in d}, len(d)' "({'passed'}, 90)"
rm programs/mxgen-check
check 'a run without a worker program fails' exits 1 env PATH= programs/mxgen check tree
check 'a run without a worker program has an id' grep -q '\[check-failed\]' err
# Another shading model
cat >paint.mtlx <<'EOF'
<?xml version="1.0"?>
<materialx version="1.39">
  <standard_surface name="S" type="surfaceshader"><input name="coat" type="float" value="1"/><input name="coat_anisotropy" type="float" value="0.5"/></standard_surface>
</materialx>
EOF
check 'documents can be checked as another model' exits 0 "$mxgen" check paint.mtlx --translate gltf_pbr "${quick[@]}" --json model.json
check 'what is lost is a message of the document' says model.json '[m["id"] for m in d[0]["messages"]]' "['translation-loss']"
check 'what is lost fails the run where it is an error' eval 'exits 1 "$mxgen" check paint.mtlx --translate gltf_pbr -W error=translation-loss "${quick[@]}" && grep -q "(translate 1)" out'
check 'a model that nothing makes fails the run' eval 'exits 1 "$mxgen" check paint.mtlx --translate none "${quick[@]}" && grep -q "\[unknown-model\]" out'
check 'a drawn error is that of a translation' exits 2 "$mxgen" check paint.mtlx --accept 2
check 'a drawn error is a number' exits 2 "$mxgen" check paint.mtlx --translate gltf_pbr --accept some

# The stacks of a stage
cat >look.mtlx <<'EOF'
<?xml version="1.0"?>
<materialx version="1.39">
  <standard_surface name="S" type="surfaceshader"/>
  <standard_surface name="R" type="surfaceshader"><input name="opacity" type="color3" value="0.5, 0.5, 0.5"/></standard_surface>
  <surfacematerial name="paint" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
  <surfacematerial name="rust" type="material"><input name="surfaceshader" type="surfaceshader" nodename="R"/></surfacematerial>
  <look name="plain"><materialassign name="a" material="paint" geom="/car"/></look>
  <look name="rusty" inherit="plain"><materialassign name="b" material="rust" geom="/car/door" slot="050"/></look>
  <look name="wrong"><materialassign name="c" material="paint" geom="/cat"/></look>
</materialx>
EOF
printf '#usda 1.0\ndef Xform "car"\n{\n    def Cube "hood"\n    {\n    }\n    def Cube "door"\n    {\n    }\n    def Cube "lid"\n    {\n    }\n}\n' >car.usda
stage=(check look.mtlx --stage car.usda "${quick[@]}")
check 'stacks of a stage are elements' exits 0 "$mxgen" "${stage[@]}" --look rusty --json stacks.json
check 'a stack has the name of its first primitive' says stacks.json '[(e["path"], e["type"]) for e in d[0]["elements"]]' \
    "[('/car', 'stack'), ('/car/door', 'stack')]"
check 'stacks have measures' says stacks.json '[e["shaders"][0]["closures"] for e in d[0]["elements"]]' '[9, 18]'
check 'stacks have budgets' eval 'exits 1 "$mxgen" "${stage[@]}" --look rusty --max-closures 10 && grep -q "/car/door. for glsl has 18 closures" out'
check 'a look that is not there fails the document' eval 'exits 1 "$mxgen" "${stage[@]}" --look rust --json wrong.json && grep -q "(load 1)" out'
check 'the message of a look is of the document' says wrong.json '[m["id"] for m in d[0]["messages"]]' "['unknown-look']"
check 'a binding that matches nothing is told' eval 'exits 1 "$mxgen" "${stage[@]}" --look wrong -Werror && grep -q "matches no primitive" out'
check 'a stage that is not there fails the document' eval 'exits 1 "$mxgen" check look.mtlx --stage none.usda --look plain && grep -q "\[file-missing\]" out'
check 'a look needs a stage' exits 2 "$mxgen" check look.mtlx --look plain
for other in --render '--cache c' '--translate gltf_pbr'; do
    check "a stage excludes $other" exits 2 "$mxgen" "${stage[@]}" --look plain $other
done

printf '#!/bin/sh\nexit 3\n' >programs/mxgen-check && chmod +x programs/mxgen-check
check 'a worker that cannot begin fails the run' exits 1 programs/mxgen check tree --json nothing.json
check 'a worker that cannot begin leaves no report' test ! -e nothing.json

finish check
