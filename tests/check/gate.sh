#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# mxgen check as a gate: baselines, the report of changes, and the changes that fail a run. Arguments: mxgen, whether shaders can be
# compiled (yes or no).
mxgen=$(realpath "$1") compiles=$2
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../programs/common.sh"
. "$here/materials.sh"
messages=$(dirname "$mxgen")/docs/messages.md
quick=(--no-compile -t glsl,essl)
base=(--baseline base.json)

# kinds REPORT: of all documents, in order
kinds() { json "$1" '[(x["file"].split("/")[-1], c["kind"]) for x in d + r.get("gone", []) for c in x.get("changes", [])]'; }
# since: the line of the summary about the baseline
since() { grep '^since the baseline: ' out; }

# A material with a texture
wood() { # FILE
    cat <<END
<materialx version="1.39">
  <image name="I" type="color3"><input name="file" type="filename" value="$1"/></image>
  <standard_surface name="SR" type="surfaceshader"><input name="base_color" type="color3" nodename="I"/></standard_surface>
  <surfacematerial name="Wood" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SR"/></surfacematerial>
</materialx>
END
}
make_show() {
    rm -rf show && mkdir -p show/deep show/maps
    material Near >show/deep/near.mtlx
    material Bad rough >show/bad.mtlx
    touch show/maps/oak.png show/maps/elm.png
    wood maps/oak.png >show/wood.mtlx
}

# Only --update-baseline writes a baseline
make_show
check 'a baseline that is missing fails the run' exits 1 "$mxgen" check show "${quick[@]}" --baseline bsae.json --json none.json
check 'the error says how to write a baseline' grep -q "^error: there is no baseline 'bsae.json'; --update-baseline writes it \[baseline-missing\]" err
check 'a missing baseline leads to no file' test ! -e bsae.json -a ! -e none.json
check 'nothing is checked without the baseline' eval '! grep -q . out'
check 'an update writes the baseline and accepts failures' exits 0 "$mxgen" check show "${quick[@]}" "${base[@]}" --update-baseline
check 'an update shows the failures' grep -q '^FAILED show/bad.mtlx (validate)' out
check 'the baseline has all documents by their names' says base.json '[x["name"] for x in d]' "['show/bad.mtlx', 'show/deep/near.mtlx', 'show/wood.mtlx']"
cp base.json kept.json
check 'a run against a baseline passes with known failures' exits 0 "$mxgen" check show "${quick[@]}" "${base[@]}" --json same.json
check 'a run against its own baseline has no changes' is "$(kinds same.json) $(since)" '[] since the baseline: no change'
check 'the summary counts the known failure' grep -q '^2 passed, 1 failed (validate 1; known 1), 1 error, 0 warnings$' out
check 'a known failure is printed nowhere else' eval '! grep -q bad.mtlx out'
check '--verbose prints a known failure' eval '"$mxgen" check show "${quick[@]}" "${base[@]}" --verbose >out; grep -q "^known show/bad.mtlx (validate)" out'
check 'messages of a known failure are unchanged' says same.json '[m["baselineState"] for m in d[0]["messages"]]' "['unchanged']"
material Near 0.9 >show/deep/near.mtlx
check 'a changed value fails a run with --fail-on values' exits 1 "$mxgen" check show "${quick[@]}" "${base[@]}" --fail-on values
check 'a run that fails leaves the baseline as it is' cmp base.json kept.json
check 'an update may replace a file that is no baseline' eval 'cp show/bad.mtlx odd.json && exits 0 "$mxgen" check show "${quick[@]}" --baseline odd.json --update-baseline'
check 'the replaced file is a baseline' says odd.json 'len(d)' 3
check 'a run against a file that is no baseline fails' exits 1 "$mxgen" check show "${quick[@]}" --baseline show/bad.mtlx
check 'the error is report-unreadable' grep -q '\[report-unreadable\]' err
"$mxgen" check show "${quick[@]}" --shard 1/2 --json shard.json >/dev/null
check 'a shard is no baseline' eval 'exits 1 "$mxgen" check show "${quick[@]}" --baseline shard.json; grep -q "it is only a shard" err'
check 'an update needs the name of the baseline' exits 2 "$mxgen" check show --update-baseline
check '--fail-on needs a baseline' exits 2 "$mxgen" check show --fail-on size
check 'a shard cannot write a baseline' exits 2 "$mxgen" check show "${base[@]}" --update-baseline --shard 1/2
check 'an unknown kind of change is wrong usage' exits 2 "$mxgen" check show "${base[@]}" --fail-on new-warning
check 'an unknown kind of change has a suggestion' grep -q "no kind of change 'new-warning'; did you mean 'new-warnings'?" err
check 'the help names the kinds of changes' eval '"$mxgen" check --help >out; grep -q "new-warnings" out'

# Documents are matched by their path below the root
make_show
check 'a baseline holds from another folder and with absolute paths' eval '(mkdir -p elsewhere && cd elsewhere && exits 0 "$mxgen" check "$work/show" "${quick[@]}" --root .. --baseline ../base.json && since | grep "no change")'
check 'a baseline holds from inside of the folder' eval '(cd show && exits 0 "$mxgen" check . "${quick[@]}" --root .. --baseline ../base.json && since | grep "no change"; rm -f out err check.log)'
check 'a baseline holds through a link' eval 'ln -s . link && exits 0 "$mxgen" check "$work/link/show" "${quick[@]}" "${base[@]}" && since | grep "no change"'
check 'a baseline holds for a copy of the whole tree' eval 'mkdir copy && cp -r show base.json copy && (cd copy && exits 0 "$mxgen" check show "${quick[@]}" "${base[@]}" && since | grep "no change")'
check 'a baseline does not depend on the folder of the run' eval '(cd elsewhere && "$mxgen" check "$work/show" "${quick[@]}" --root "$work" --baseline far.json --update-baseline >/dev/null); cmp base.json elsewhere/far.json'
check 'a run with another root fails' exits 1 "$mxgen" check show "${quick[@]}" "${base[@]}" --root show
check 'the error names the root of the baseline' grep -Eq "^error: 'base.json' is the baseline of another run: none of its documents, such as 'show/[a-z/]*.mtlx', is below the root '$work/show': name its root with --root DIR \[baseline-other\]" err
check 'a document outside the root fails the run' exits 1 "$mxgen" check show copy/show/bad.mtlx "${quick[@]}" --root show --baseline in.json --update-baseline
check 'the error is outside-root' grep -q "^error: 'copy/show/bad.mtlx' is not below the root.*\[outside-root\]" err
check 'a document outside the root leads to no baseline' test ! -e in.json
check 'a root that does not exist fails the run' exits 1 "$mxgen" check show "${quick[@]}" --root none
check 'a run with other targets fails' exits 1 "$mxgen" check show --no-compile -t essl "${base[@]}"
check 'the error names the targets of the baseline' grep -q "it has the targets glsl,essl: use --target glsl,essl \[baseline-other\]" err
check 'the order of targets does not matter' exits 0 "$mxgen" check show --no-compile -t essl,glsl "${base[@]}"
check 'a run that compiles fails against a baseline without compiling' exits 1 "$mxgen" check show -t glsl,essl "${base[@]}"
check 'the error says that shaders were not compiled' grep -q 'its shaders were not compiled: use --no-compile \[baseline-other\]' err
check 'an update accepts other targets' exits 0 "$mxgen" check show --no-compile -t essl --baseline odd.json --update-baseline
check 'a run may check a part of the documents' exits 0 "$mxgen" check show/deep "${quick[@]}" "${base[@]}" --json part.json
check 'the documents that the run lacks are gone' is "$(kinds part.json)" "[('bad.mtlx', 'gone'), ('wood.mtlx', 'gone')]"

# Every change is told, and each kind fails on demand. change KIND... : the kinds, all that fail the run and all others
# changed WHAT EXPECTED KIND...: the kinds of changes, and that each of the given kinds fails a run, but no other does
changed() {
    local what=$1 expected=$2 all=(fixed gone-errors new-warnings gone-warnings topology size values textures new gone)
    shift 2
    check "the report has the kinds of changes of $what" eval '"$mxgen" check show "${quick[@]}" "${base[@]}" --json c.json >out 2>err; is "$(kinds c.json)" "$expected"'
    for kind in "${all[@]}"; do
        case " $* " in
        *" $kind "*) check "$what: --fail-on $kind" exits 1 "$mxgen" check show "${quick[@]}" "${base[@]}" --fail-on "$kind" ;;
        *) case "$*" in *always*) ;; *) check "$what is no $kind" exits 0 "$mxgen" check show "${quick[@]}" "${base[@]}" --fail-on "$kind" ;; esac ;;
        esac
    done
    make_show
}
sed -i 's/specular_rough.*value="0.5"/specular_roughness" type="float" value="0.7"/' show/deep/near.mtlx
changed 'another value' "[('near.mtlx', 'values')]" values
sed -i 's/specular_roughness/specular_rough/; s/0.5/0.2/' show/deep/near.mtlx
changed 'a misspelt input' "[('near.mtlx', 'new-warnings'), ('near.mtlx', 'values')]" new-warnings values
wood maps/elm.png >show/wood.mtlx
changed 'another texture' "[('wood.mtlx', 'textures')]" textures
rm show/maps/oak.png
changed 'a texture that is missing' "[('wood.mtlx', 'new-warnings')]" new-warnings
rm show/wood.mtlx
changed 'a document that is gone' "[('wood.mtlx', 'gone')]" gone
material More >show/more.mtlx
changed 'a document that is new' "[('more.mtlx', 'new')]" new
material Far >show/deep/near.mtlx
changed 'a material of another name' "[('near.mtlx', 'new'), ('near.mtlx', 'gone')]" new gone
material Bad >show/bad.mtlx
changed 'a failure that ends' "[('bad.mtlx', 'fixed'), ('bad.mtlx', 'gone-errors'), ('bad.mtlx', 'fixed'), ('bad.mtlx', 'fixed')]" fixed gone-errors
sed -i '/<input name="surfaceshader"/d' show/deep/near.mtlx
check '--fail-on gone fails a shader that is gone' eval '"$mxgen" check show "${quick[@]}" "${base[@]}" --fail-on gone >out; [ $? -eq 1 ] && grep -q "^FAILED show/deep/near.mtlx" out'
make_show
printf '%s\n' '2i <!-- a comment -->' | sed -i -f - show/bad.mtlx
changed 'a known error in another line' '[]'
material Near rough >show/deep/near.mtlx
changed 'a new failure' "[('near.mtlx', 'fails'), ('near.mtlx', 'new-errors'), ('near.mtlx', 'fails'), ('near.mtlx', 'fails')]" always
sed -i 's|<surfacematerial|<nonsense name="n" type="float"/>\n<surfacematerial|' show/bad.mtlx
changed 'a new error in a document that fails' "[('bad.mtlx', 'new-errors')]" always

# Messages are counted: a second equal one is new, and so is one beyond the limit
sed 's|<standard_surface name|<image name="J" type="color3"><input name="file" type="filename" value="maps/none.png"/></image>\n&|' show/wood.mtlx >wood
sed 's|<standard_surface name|<image name="K" type="color3"><input name="file" type="filename" value="maps/none.png"/></image>\n&|' wood >wood2
cp wood show/wood.mtlx
"$mxgen" check show "${quick[@]}" --baseline twice.json --update-baseline >/dev/null
cp wood2 show/wood.mtlx
check 'a message that appears a second time is a new warning' eval '"$mxgen" check show "${quick[@]}" --baseline twice.json --json two.json >out; [[ $(kinds two.json) == *new-warnings* ]]'
check 'only one of two equal messages is new' says two.json 'sorted(m["baselineState"] for m in d[2]["messages"] if m["id"] == "missing-texture")' "['new', 'unchanged']"
nonsense() { # COUNT: a document with as many errors
    echo '<materialx version="1.39">'
    for i in $(seq "$1"); do echo "<nonsense$i name='n$i' type='float'/>"; done
    echo '</materialx>'
}
nonsense 30 >show/many.mtlx
"$mxgen" check show "${quick[@]}" --baseline many.json --update-baseline >/dev/null
nonsense 31 >show/many.mtlx
check 'an error beyond --max-errors fails the run' exits 1 "$mxgen" check show "${quick[@]}" --baseline many.json
check 'errors beyond --max-errors are counted' grep -Eq '^FAILED show/many.mtlx \(new-errors\): [0-9]+ errors beyond --max-errors, before [0-9]+' out
make_show

# The sizes of shaders
check 'a run with other options passes' exits 0 "$mxgen" check show/deep "${quick[@]}" --interface reduced "${base[@]}"
check 'another shader is a change of topology' grep -q "(topology) 'Near' for glsl: another shader" out
check 'another length of the source is a change of size' grep -Eq "\(size\) 'Near' for essl: [0-9]+ bytes of source, before [0-9]+ \(-[0-9.]+ %\)" out
check '--fail-on size fails a change of size' exits 1 "$mxgen" check show/deep "${quick[@]}" --interface reduced "${base[@]}" --fail-on size,new

# A machine without a compiler
if [ "$compiles" = yes ]; then
    "$mxgen" check show/deep --baseline compiled.json --update-baseline >/dev/null
    sed 's/"compiled":false/"compiled":true/g' base.json | sed 's/"compiles":false/"compiles":true/; s/"targets":\["glsl","essl"\]/"targets":["osl"]/; s/"glsl"/"osl"/g' >osl.json
    "$mxgen" check show -t osl --json osl_now.json >/dev/null
    if [ "$(json osl_now.json 'd[1]["elements"][0]["shaders"][0]["compiled"]')" = False ]; then
        check 'a shader that had a compiler and has none fails the run' exits 1 "$mxgen" check show -t osl --baseline osl.json
        check 'the change is uncompiled' grep -q '(uncompiled) .* for osl: was compiled, but no compiler is installed now' out
    else
        skip 'oslc is installed: every target has a compiler'
    fi
else
    skip 'without glslang no shader is compiled'
fi

# New failures come first, then what else has changed, then one summary
material Near rough >show/deep/near.mtlx
material Aaa >show/aaa.mtlx
rm show/wood.mtlx
check 'a run with changes of all sorts fails' exits 1 "$mxgen" check show "${quick[@]}" "${base[@]}" --html all.html --sarif all.sarif --junit all.xml --json all.json
check 'failures are printed before other changes' is "$(grep -n '^changed' out | head -n 1 | cut -d: -f1)" "$(($(grep -n '^FAILED' out | tail -n 1 | cut -d: -f1) + 1))"
check 'a new error is printed with its source' is "$(grep -A 2 '(new-errors)' out | tail -n 1 | tr -d ' ')" '^~~~~'
check 'the other changes are printed after the failures' eval 'grep -q "^changed show/aaa.mtlx (new): is new" out && grep -q "^changed show/wood.mtlx (gone): is in the baseline, but not in this run" out'
check 'the summary is printed last' is "$(tail -n 3 out)" '3 documents, 3 elements, 6 shaders
since the baseline: 1 document fails (fails 1, new-errors 1); others: new 1, gone 1
1 passed, 2 failed (validate 2; known 1), 2 errors, 0 warnings'
check 'JUnit fails a document that is gone with --fail-on gone' eval '"$mxgen" check show "${quick[@]}" "${base[@]}" --fail-on gone --junit gone.xml >out; grep -A 1 "<testsuite name=\"show/wood.mtlx\" tests=\"1\" failures=\"1\"" gone.xml | grep "<failure type=\"gone\""'
check 'JUnit skips a document that is gone' grep -q 'classname="show/wood.mtlx" name="document"><skipped message="gone: ' all.xml
check 'JUnit skips a known failure' grep -q 'classname="show/bad.mtlx" name="document"><skipped message="known failure: ' all.xml
check 'the text is complete without a temporary folder' eval 'TMPDIR=none "$mxgen" check show "${quick[@]}" "${base[@]}" >unsorted; sort unsorted >a; "$mxgen" check show "${quick[@]}" "${base[@]}" | sort >b; cmp a b'
check 'a run with --quiet fails as without' exits 1 "$mxgen" check show "${quick[@]}" "${base[@]}" --quiet
check '--quiet prints failures only' eval '! grep -q "^changed" out && grep -q "^FAILED show/deep/near.mtlx (fails)" out'
check '--quiet prints the summary' is "$(tail -n 3 out | head -n 1)" '3 documents, 3 elements, 6 shaders'
check 'a baseline can be renewed' exits 0 "$mxgen" check show "${quick[@]}" --baseline new.json --update-baseline
check 'a renewed baseline has no changes' exits 0 "$mxgen" check show "${quick[@]}" --baseline new.json --fail-on all

# Merged shards are judged alike
shards() { for k in 1 2 3; do "$mxgen" check show "${quick[@]}" --shard $k/3 --json shard$k.json >/dev/null; done; }
shards
merge() { "$mxgen" check merge shard?.json "${base[@]}" "$@"; }
cp base.json kept.json
check 'a merge compares with a baseline' exits 1 merge --html m.html --sarif m.sarif --junit m.xml --json m.json
check 'a merge leaves the baseline as it is' cmp base.json kept.json
for kind in sarif xml json; do check "a merge gives the report of one run: $kind" cmp m.$kind all.$kind; done
check 'a merge gives the page of one run' eval 'diff <(sed "s/<time>[^<]*//" m.html) <(sed "s/<time>[^<]*//" all.html)'
# damaged SED: a merge of the shards, of which one is changed
damaged() { sed "$1" shard1.json >damage1.json && cmp -s damage1.json shard1.json && echo 'nothing was changed' && return 1; exits 1 "$mxgen" check merge damage1.json shard2.json shard3.json && grep -q "$2.*report-unreadable" err && ! grep -q shard-other err; }
check 'a word that no status is fails the merge' damaged 's/"status":"[a-z]*"/"status":"faild"/' 'a document in it cannot be read'
check 'a lost document fails the merge' damaged '0,/^{"index"/{/^{"index"/d}' 'its summary counts other documents'
check 'a lost summary fails the merge' damaged 's/,"summary":.*/}/' 'only a part of one'
check 'a damaged baseline fails the run' eval 'sed "s/\"status\":\"[a-z]*\"/\"status\":\"?\"/" base.json >bad.json; exits 1 "$mxgen" check show "${quick[@]}" --baseline bad.json; grep -q report-unreadable err'
check 'a merge against a missing baseline fails' eval 'exits 1 "$mxgen" check merge shard?.json --baseline bsae.json && grep -q baseline-missing err && [ ! -e bsae.json ]'
check 'a merge fails with --fail-on' eval 'material Near >show/deep/near.mtlx; shards; exits 0 merge && exits 1 merge --fail-on gone'
check 'a merge can write a baseline' eval 'exits 0 "$mxgen" check merge shard?.json --baseline merged.json --update-baseline'
check 'a merge writes the baseline of one run' eval '"$mxgen" check show "${quick[@]}" --baseline one.json --update-baseline >/dev/null; cmp merged.json one.json'
for k in 1 2; do "$mxgen" check show "${quick[@]}" "${base[@]}" --shard $k/2 --json compared$k.json >/dev/null; done
check 'a merge of compared shards fails without the baseline' exits 1 "$mxgen" check merge compared?.json
check 'the error says that the merge needs the baseline' grep -q "is compared with a baseline, which the merge needs too.*\[baseline-missing\]" err
check 'a merge with the baseline gives the report of one run' eval '"$mxgen" check merge compared?.json "${base[@]}" --json whole.json >/dev/null; "$mxgen" check show "${quick[@]}" "${base[@]}" --json single.json >/dev/null; cmp whole.json single.json'
(cd show && for k in 1 2; do "$mxgen" check . "${quick[@]}" --shard $k/2 --json ../root$k.json >/dev/null; done)
check 'shards of another root fail the merge' exits 1 "$mxgen" check merge root?.json "${base[@]}"
check 'the error is baseline-other' grep -q '\[baseline-other\]' err

if python3 -c 'import jsonschema' 2>/dev/null; then
    for report in base all c two merged compared1; do
        check "$report.json follows its schema" validates "$here/../../docs/check.schema.json" $report.json
    done
else
    skip 'python3-jsonschema is not installed: reports are not compared with the schema'
fi
check 'all reports have the same content' "$here/reports.py" all.json all.sarif all.xml all.html "$messages"

finish check-gate
