#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Budgets and pictures of mxgen check. Arguments: mxgen, whether shaders can be compiled, whether pictures can be drawn (yes or no).
mxgen=$(realpath "$1") compiles=$2 draws=$3
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../programs/common.sh"
. "$here/materials.sh"
export MESA_SHADER_CACHE_DISABLE=true
mkdir -p show/deep/deeper
material Near >show/deep/near.mtlx
material Deep >show/deep/deeper/deep.mtlx
quick=(--no-compile -t glsl,essl)
echo '<materialx version="1.39"><position name="p" type="vector3"/><output name="o" type="vector3" nodename="p"/></materialx>' >plain.mtlx

# Budgets on the command line
check 'a budget that is kept passes' exits 0 "$mxgen" check show "${quick[@]}" --max-source-bytes 1000000
check 'a budget that is exceeded fails' exits 1 "$mxgen" check show/deep/near.mtlx "${quick[@]}" --max-source-bytes 1000 --json over.json
check 'the error is over-budget for every target' says over.json '[(m["id"], m["target"]) for m in d[0]["messages"]]' "[('over-budget', 'glsl'), ('over-budget', 'essl')]"
check 'the failure is the budget' says over.json '(d[0]["failure"], d[0]["elements"][0]["shaders"][0]["failure"])' "('budget', 'budget')"
check 'a budget may be of one target' exits 1 "$mxgen" check show/deep/near.mtlx "${quick[@]}" --max-uniform-bytes essl=10,glsl=100000 --json one.json
check 'a budget of one target fails that target only' says one.json '[s["status"] for s in d[0]["elements"][0]["shaders"]]' "['passed', 'failed']"
check 'the error names the node' grep -Eq "bytes of uniforms; the budget allows 10: SR [0-9]+ \[over-budget\]" out
check 'a budget of samplers names the samplers' eval 'exits 1 "$mxgen" check show/deep/near.mtlx "${quick[@]}" --max-samplers 1 && grep -q "has 2 samplers; the budget allows 1: u_envIrradiance 1, u_envRadiance 1 " out'
check 'a budget of closures fails' exits 1 "$mxgen" check show "${quick[@]}" --max-closures 1
check 'the error counts the closures of nodes' grep -Eq 'has [0-9]+ closures; the budget allows 1: SR/[a-z]+ 1, SR/[a-z]+ 1,' out
check 'a budget of source bytes fails' exits 1 "$mxgen" check show/deep/near.mtlx --no-compile -t osl --max-source-bytes 100 --json source.json
check 'the error counts the bytes of functions and nodes' grep -Eq 'bytes of source; the budget allows 100: declarations [0-9]+,.* (mx_|SR/)[a-z_]+ [0-9]+' out
check 'the parts of a small source are its whole size' eval '
    exits 0 "$mxgen" check plain.mtlx --no-compile -t glsl,essl,osl --json plain.json &&
    says plain.json "[sum(s[\"parts\"][\"sourceBytes\"].values()) == s[\"sourceBytes\"] for s in d[0][\"elements\"][0][\"shaders\"]]" "[True, True, True]"'
check 'a budget of 0 is a budget' exits 1 "$mxgen" check show "${quick[@]}" --max-closures 0
check 'a budget that is no number is wrong usage' exits 2 "$mxgen" check show --max-closures many
check 'a number with more text is wrong usage' exits 2 "$mxgen" check show --max-closures 1x
check 'a budget of instructions needs compiled shaders' exits 2 "$mxgen" check show --no-compile --max-instructions 500
check 'a budget of an unknown target is wrong usage' exits 2 "$mxgen" check show --max-closures glsl=100,gsls=1
check 'the error lists the targets' grep -q "unknown target 'gsls'; expected one of: glsl" err
if [ "$compiles" = yes ]; then
    check 'a budget of instructions fails' exits 1 "$mxgen" check show/deep/near.mtlx --max-instructions 500
    check 'the error counts the instructions of functions and nodes' grep -Eq 'instructions; the budget allows 500: .*[:,] mx_[a-z_]+ [0-9]+.*\[over-budget\]' out
    check 'the error names at least two nodes' eval '[ "$(grep -o "SR/[a-z]* [0-9]*" out | wc -l)" -ge 2 ]'
else
    skip 'without glslang no instructions are counted'
fi

# Budgets in files
cat >show/mxgen.toml <<'END'
# for the whole show
[ budget ]
max-source-bytes = 1_000 # bytes
[budget.essl]
max-source-bytes = 1_000_000
END
check 'a budget of a file fails' exits 1 "$mxgen" check show "${quick[@]}" --json file.json
check 'a file holds for the documents below its folder' says file.json '[s["status"] for x in d for s in x["elements"][0]["shaders"]]' "['failed', 'passed', 'failed', 'passed']"
check 'a file holds without any report' exits 1 "$mxgen" check show "${quick[@]}"
check 'the error states the budget of the file' grep -q "bytes of source; the budget allows 1000" out
for place in 'show .' 'show deep' 'show/deep ../deep' 'show/deep/deeper .' 'show/deep/deeper ../..'; do
    read -r folder argument <<<"$place"
    check "a file holds for $argument in $folder" eval '(cd "$folder" && exits 1 "$mxgen" check "$argument" "${quick[@]}" && grep -q "the budget allows 1000" out && rm out err)'
done
mkdir sideways && cp show/mxgen.toml sideways
check 'a file in a folder beside does not hold' eval '(cd sideways && "$mxgen" check ../show/deep/near.mtlx "${quick[@]}" --max-source-bytes 1000000 --json d.json --depfile d.d)'
check 'a depfile does not name files that do not hold' eval 'grep -q " ../show/deep/../mxgen.toml\| ../show/mxgen.toml" sideways/d.d && ! grep -q " mxgen.toml" sideways/d.d'
rm -r sideways
check 'the command line replaces the file' exits 0 "$mxgen" check show "${quick[@]}" --max-source-bytes 1000000
check 'the command line replaces its own measures only' exits 1 "$mxgen" check show "${quick[@]}" --max-closures 100
printf '[budget]\nmax-closures = 100\nmax-source-bytes = 1000000\nmax-instructions = 1\n' >show/deep/deeper/mxgen.toml
check 'shaders that are not compiled are told, if a file has a budget of instructions' eval 'exits 0 "$mxgen" check show/deep/deeper --no-compile && grep -q "\[budget-unjudged\]" err'
printf '[budget]\nmax-closures = 100\n' >show/deep/deeper/mxgen.toml
check 'the nearest file holds' eval '"$mxgen" check show "${quick[@]}" --json near.json >out; says near.json "[x[\"status\"] for x in d]" "['"'passed', 'failed'"']"'
# Faults with their columns and messages
while IFS='|' read -r column fault message; do
    printf '[budget]\n\n%b\n' "$fault" >show/deep/deeper/mxgen.toml
    check "a fault in a file fails the run: $fault" exits 1 "$mxgen" check show/deep/deeper "${quick[@]}"
    check "the error states the fault: $message" grep -qF "show/deep/deeper/mxgen.toml:3:$column: error: $message [budget-invalid]" out
    check 'the caret stands under the fault' is "$(sed -n '/budget-invalid/{n;n;p}' out | sed 's/^    //; s/\^.*/^/' | wc -m)" "$((column + 1))"
done <<'END'
1|max-closure = 1|there is no budget 'max-closure'; did you mean 'max-closures'?
1|colour = 1|there is no budget 'colour'; 'mxgen check --help all' lists them, without the dashes
1|max-closures|a line is a table, a key with '=' and a value, or a comment
1|= 3|a line is a table, a key with '=' and a value, or a comment
16|max-closures = many|a budget is a whole number; 'many' is none
16|max-closures = |a budget is a whole number; '' is none
16|max-closures = "3"|a budget is a whole number, not a string
16|max-closures = '3'|a budget is a whole number, not a string
16|max-closures = true # yes|a budget is a whole number, not a boolean
16|max-closures = 3.5|a budget is a whole number, not a number with a fraction
16|max-closures = 1e3|a budget is a whole number, not a number with a fraction
16|max-closures = inf|a budget is a whole number, not a number with a fraction
16|max-closures = [3]|a budget is a whole number, not an array
16|max-closures = { glsl = 3 }|a budget is a whole number, not a table
16|max-closures = 2026-01-01|a budget is a whole number, not a date
16|max-closures = 10:20:30|a budget is a whole number, not a time
16|max-closures = -3|a budget is a whole number from 0, not a negative one
16|max-closures = 1__0|a budget is a whole number; '1__0' is none
16|max-closures = 007|a budget is a whole number; '007' is none
16|max-closures = 99999999999999999999|a budget is a whole number; '99999999999999999999' is none
17|\tmax-closures = x|a budget is a whole number; 'x' is none
2|[budgets]|there is no table 'budgets'; did you mean 'budget'?
2|[tool.x]|there is no table 'tool'; tables are [budget] and [budget.TARGET]
9|[budget.gsls]|there is no target 'gsls'; did you mean 'glsl'?
2|[[budget]]|a table has one pair of brackets: [budget]
8|[budget|a table is a name in brackets: [budget] or [budget.TARGET]
9|[budget essl]|a table is a name in brackets: [budget] or [budget.TARGET]
9|[budget.] x|a table is a name in brackets: [budget] or [budget.TARGET]
2|[budget]|this table stands above already
END
printf 'max-closures = 1\n' >show/deep/deeper/mxgen.toml
check 'a key without a table fails the run' exits 1 "$mxgen" check show/deep/deeper "${quick[@]}"
check 'the error states the missing table' grep -q 'mxgen.toml:1:1: error: a key stands below a table: \[budget\] \[budget-invalid\]' out
printf '[budget]\nmax-closures = 1\nmax-closures = 2\n' >show/deep/deeper/mxgen.toml
check 'a key that stands twice fails the run' exits 1 "$mxgen" check show/deep/deeper "${quick[@]}"
check 'the error names the key' grep -q "mxgen.toml:3:1: error: 'max-closures' stands above already" out
printf '\n# all of these are 4096\r\n["budget"]\n"max-closures" = 0x1000\nmax-textures=0b1000000000000# bits\n[ budget . glsl ]\nmax-samplers = +4_096\nmax-source-bytes = 0o3641100\n' >show/deep/deeper/mxgen.toml
check 'every form of whole numbers and names is read' exits 0 "$mxgen" check show/deep/deeper "${quick[@]}"
ln -sf /proc/self/mem show/deep/deeper/mxgen.toml # which nobody can read from its beginning
check 'a file that cannot be read fails the run' exits 1 "$mxgen" check show/deep/deeper "${quick[@]}"
check 'the error names the file that cannot be read' grep -q '^show/deep/deeper/mxgen.toml: error: cannot be read: .*\[budget-invalid\]' out
rm show/mxgen.toml show/deep/deeper/mxgen.toml

if python3 -c 'import jsonschema' 2>/dev/null; then
    for report in over file; do
        check "$report.json follows its schema" validates "$here/../../docs/check.schema.json" $report.json
    done
else
    skip 'python3-jsonschema is not installed: reports are not compared with the schema'
fi

# Pictures
changes() { json "$1" '[(x["file"].split("/")[-1], c["kind"]) for x in d for c in x.get("changes", [])]'; }
mkdir programs && cp "$mxgen" "$(dirname "$mxgen")/mxgen-check" programs
check 'a run with pictures fails without a renderer' exits 1 env PATH= programs/mxgen check show/deep/near.mtlx --no-compile --render
check 'the error is no-renderer' grep -q '\[no-renderer\]' err
printf '#!/bin/sh\necho "error: no device"\nexit 1\n' >programs/mxgen-render && chmod +x programs/mxgen-render
check 'a renderer that fails is an error' exits 1 programs/mxgen check show/deep/near.mtlx --no-compile --render
check 'the error has the words of the renderer' grep -q "cannot render 'Near': error: no device \[render-failed\]" out
if [ "$draws" = no ]; then
    skip 'there is no renderer: nothing was drawn'
elif ! has_device "$mxgen" render; then
    skip 'there is no Vulkan device: nothing was drawn'
else
    sed 's|<input.*specular_rough.*/>|<input name="base_color" type="color3" value="0.8, 0.1, 0.1"/>|' show/deep/near.mtlx >red.mtlx
    draw=("$mxgen" check red.mtlx --no-compile --render)
    check 'pictures are drawn' exits 0 "${draw[@]}" --baseline red.json --update-baseline --html red.html --json drawn.json
    check 'the report has pictures as PNG' eval 'json drawn.json "d[0][\"elements\"][0][\"picture\"]" | base64 -d | head -c 8 | od -An -c | grep -q "P *N *G"'
    check 'the page shows the pictures' grep -q 'src="data:image/png;base64,iVBOR' red.html
    check 'the baseline has signatures in place of pictures' says red.json '(len(d[0]["elements"][0]["signature"]), "picture" in d[0]["elements"][0])' '(1024, False)'
    check 'a second run draws the same' eval 'exits 0 "${draw[@]}" --baseline red.json --json red2.json && is "$(changes red2.json)" "[]"'
    check 'the page has no full picture without a budget' bash -c '! grep -q "without a budget" red.html'
    check 'a budget of slabs is drawn' exits 0 "${draw[@]}" --features -fuzz --slabs --html slabs.html --json slabs.json
    check "the page shows the full picture beside the budget's" eval '[ "$(grep -o "src=\"data:image/png" slabs.html | wc -l)" = 2 ] && grep -q "drawn error of the budget: 0" slabs.html'
    check 'the report has the drawn error' says slabs.json '0 <= float(d[0]["elements"][0]["drawnError"]) < 3' True
    cp "$here/../../examples/slabs.mtlx" paints.mtlx
    steps=("$mxgen" check paints.mtlx --no-compile --render --max-error 1.2 -t glsl)
    check 'the steps of a budget are drawn' exits 0 "${steps[@]}" --html steps.html --json steps.json
    check 'the text has cost and errors of each step' grep -Eq "^  'CarPaint': one slab for the layer 'coated': slabs 2 to 1, bytes 28 to 16, error estimated [01]\.[0-9]+, drawn [01]\.[0-9]+" out
    check 'the page has cost and errors of each step' grep -q "<td>one slab for the layer &#39;coated&#39;</td><td>2 to 1</td><td>28 to 16</td><td>" steps.html
    check 'the page has the tree of slabs' eval '[ "$(grep -c "<summary>slabs</summary><pre>[A-Za-z_]*, a [bs]" steps.html)" = 5 ] && grep -q "^  one slab for the layer &#39;" steps.html'
    check 'the page of other materials has no tree of slabs' eval '! grep -q "<summary>slabs" red.html'
    check 'the report has a drawn error for each step' says steps.json '[all(float(s["drawnError"]) >= 0 for s in e["steps"]) and e["steps"][-1]["drawnError"] == e["drawnError"] for e in d[0]["elements"] if e["path"] == "CarPaint"]' '[True]'
    check 'steps have drawn errors of their own' says steps.json '[len({s["drawnError"] for s in e["steps"]}) > 1 for e in d[0]["elements"] if e["path"] == "CarPaint"]' '[True]'
    sed -i 's/0.8, 0.1, 0.1/0.1, 0.8, 0.1/' red.mtlx
    check 'another colour passes' exits 0 "${draw[@]}" --baseline red.json --json green.json
    check 'another colour is a change of the picture' is "$(changes green.json)" "[('red.mtlx', 'values'), ('red.mtlx', 'picture')]"

    # An image that changes under its name
    paint() { # FILE R G B: a picture of 4 x 4 pixels
        python3 -c 'import struct, sys, zlib
chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
row = b"\0" + bytes(map(int, sys.argv[2:5])) * 4
open(sys.argv[1], "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 4, 4, 8, 2, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(row * 4)) + chunk(b"IEND", b""))' "$@"
        touch -d "$((++painted)) hours ago" "$1"
    }
    painted=0
    mkdir -p look/wood
    sed 's|<standard_surface.*|<image name="I" type="color3"><input name="file" type="filename" value="wood/oak.png"/></image>\n&|
         s|<input.*specular_rough.*/>|<input name="base_color" type="color3" nodename="I"/>|' show/deep/near.mtlx >look/oak.mtlx
    touch -d '1 hour ago' look/oak.mtlx
    look() { # CODE REPORT OPTION...
        local code=$1 report=$2
        shift 2
        exits "$code" "$mxgen" check look --no-compile --render --cache drawn --baseline look.json --json "$report" --depfile look.d "$@"
    }
    paint look/wood/oak.png 200 60 20
    check 'a document with an image is drawn' look 0 first.json --update-baseline
    check 'the document with an image passes again' look 0 second.json
    check 'its result comes from the cache' grep -q '1 document unchanged' out
    check 'the depfile names the image' grep -q '^ look/wood/oak.png' look.d
    check 'a depfile may stand beside any report' exits 0 "$mxgen" check look --no-compile --render --junit look.xml --depfile look2.d
    check 'that depfile names the image' grep -q '^ look/wood/oak.png' look2.d
    check 'the report names the image' says first.json 'd[0]["images"]' "['look/wood/oak.png']"
    paint look/wood/oak.png 20 60 200
    check 'a changed image passes' look 0 third.json
    check 'a changed image changes the picture' is "$(changes third.json)" "[('oak.mtlx', 'picture')]"
    check '--fail-on picture fails a changed image' look 1 fourth.json --fail-on picture
fi

finish check-judge
