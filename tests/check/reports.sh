#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The reports of mxgen check: each conforms to its format, and all have the same content. Arguments: mxgen.
mxgen=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../programs/common.sh"
. "$here/materials.sh"
messages=$(dirname "$mxgen")/docs/messages.md

mkdir show
material Good >'show/a good.mtlx'
material Wrong '&lt;b&gt;' >show/wrong.mtlx
material Half | head -n 5 >show/half.mtlx
material Odd | sed 's/standard_surface/standard_surfase/' >show/odd.mtlx
material Warned | sed 's/specular_roughness/specular_rough/' >show/warned.mtlx
echo '<materialx version="1.39"><nodedef name="ND_x" node="x"><output name="out" type="float"/></nodedef></materialx>' >show/library.mtlx

check 'all reports can be written at once' exits 1 "$mxgen" check show --no-compile -t glsl,essl --json r.json --sarif r.sarif --junit r.xml --html r.html
check 'the run has documents of every kind' says r.json '[x.get("failure", "passed") for x in d]' \
    "['passed', 'load', 'passed', 'validate', 'passed', 'validate']"
check 'all reports have the same content' "$here/reports.py" r.json r.sarif r.xml r.html "$messages"
check 'two reports in one file fail the run' exits 1 "$mxgen" check show --no-compile --json one.json --sarif one.json
check 'the error is output-clash' grep -q '\[output-clash\]' err
check 'two reports on standard output are wrong usage' exits 2 "$mxgen" check show --no-compile --json - --html -
check 'two reports of a merge on standard output are wrong usage' exits 2 "$mxgen" check merge r.json --json - --html -
check 'two reports may go to /dev/null' exits 1 "$mxgen" check show --no-compile --json /dev/null --sarif /dev/null
check 'all reports can have times' exits 1 "$mxgen" check show --no-compile --stats --json t.json --sarif t.sarif --junit t.xml --html t.html
check 'JUnit has the times' grep -q '<testcase [^>]* time="[0-9.]*"' t.xml
check 'all reports with times have the same content' "$here/reports.py" t.json t.sarif t.xml t.html "$messages"

# Messages with notes
mkdir notes
cat >notes/twice.mtlx <<'END'
<materialx version="1.39">
  <constant name="a" type="float"/>
  <constant name="a" type="float"/>
  <output name="out" type="float" nodename="a"/>
</materialx>
END
check 'a document with notes passes' exits 0 "$mxgen" check notes --no-compile --json n.json --sarif n.sarif --junit n.xml --html n.html
check 'the record of a message has its notes' says n.json '[n["line"] for m in d[0]["messages"] for n in m["notes"]]' '[2]'
check 'all reports have the same notes' "$here/reports.py" n.json n.sarif n.xml n.html "$messages"

# The date of the page, and a temporary folder that is not there
check 'SOURCE_DATE_EPOCH fixes the date of the page' eval 'SOURCE_DATE_EPOCH=1700000000 "$mxgen" check show --no-compile --html a.html >out; grep -q "<time>2023-11-14 22:13 UTC</time>" a.html'
check 'a page of a fixed date is the same each time' eval 'SOURCE_DATE_EPOCH=1700000000 "$mxgen" check show --no-compile --html b.html >out; cmp a.html b.html'
for kind in html junit; do
    check "a report as $kind fails without a temporary folder" exits 1 env TMPDIR=none "$mxgen" check show/warned.mtlx --no-compile --$kind none.$kind
    check 'the error names the report' grep -q "^error: cannot write 'none.$kind': No such file or directory \[output-failed\]" err
    check 'a report that fails leaves no file' test ! -e none.$kind
done

# The page in a browser: cards that are shown after a filter, and their order
browser=$(command -v chromium chromium-browser google-chrome | head -n 1)
browse() { # OPTION...
    timeout 120 "$browser" --headless --no-sandbox --disable-gpu --hide-scrollbars --force-color-profile=srgb --window-size=1400,1600 \
        --user-data-dir="$work/browser" "$@" 2>browser.log
}
# shown ADDRESS: what stands on the cards that are visible, in order
shown() {
    browse --dump-dom "file://$work/r.html#$1" |
        grep -o '<article [^>]*>\(<img[^>]*>\)\?<h2>[^<]*' | grep -v 'hidden' | sed 's/.*<h2>//; s/ $//' | paste -sd ' '
}
if [ -n "$browser" ]; then
    check 'the page shows all cards' is "$(shown '')" 'document Odd Wrong Good document Warned'
    check 'the page filters by status' is "$(shown status=failed)" 'document Odd Wrong'
    check 'the page filters by text' is "$(shown filter=show/war)" 'Warned'
    check 'the page sorts by size' is "$(shown order=sourceBytes)" "$(json r.json '
        " ".join(e["path"] for x, e in sorted(((x, e) for x in d for e in x["elements"] or [{"path": "document", "shaders": []}]),
                                              key=lambda pair: (-max((s.get("sourceBytes", 0) for s in pair[1]["shaders"]), default=0),
                                                                pair[0]["status"] == "passed")))')"

    # How it looks: a document with long lines, tabs and many targets, and one that is gone
    mkdir look
    long=$(printf 'a very long name %.0s' $(seq 20))
    printf '<materialx version="1.39">\n\t<standard_surface name="SR" type="surfaceshader">\n\t\t<input name="specular_roughness" type="float" doc="%s" value="wrong"/>\n\t</standard_surface>\n</materialx>\n' "$long" >look/long.mtlx
    material 'Wide' >look/wide.mtlx
    material Lost >look/lost.mtlx
    targets=(--no-compile -t glsl,vulkan,essl,essl310,hlsl,osl)
    "$mxgen" check look "${targets[@]}" --baseline look.json --update-baseline >/dev/null
    rm look/lost.mtlx
    sed 's/name="specular_roughness"/name="specular_rough"/' look/wide.mtlx >wide && mv wide look/wide.mtlx
    sed 's/specular_roughness/specular_rough/' look/long.mtlx >look/longer.mtlx
    "$mxgen" check look "${targets[@]}" --baseline look.json --html look.html >out
    "$here/layout.py" instrument look.html measured.html
    check 'the page is drawn' eval 'browse --screenshot="$work/look.png" "file://$work/look.html" && [ -s look.png ]'
    check 'nothing is cut off and carets stand under what they point at' eval 'browse --dump-dom "file://$work/measured.html" >dom.html && "$here/layout.py" verify dom.html look.png'
else
    skip 'there is no Chromium: the page was read by a parser only'
fi

finish check-reports
