#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The node reference. Arguments: mxgen, and mxgen-render or nothing.
mxgen=$(realpath "$1")
render=${2:-}
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"

# every_definition FILE: each name of `library list` stands in it.
every_definition() {
    "$mxgen" library list | sed 's/ .*//' | sort -u >names
    grep -ow 'ND_[A-Za-z0-9_]*' "$1" | sort -u >told
    [ -s names ] && comm -23 names told >missing && [ ! -s missing ] || { cat missing; return 1; }
}

check 'the reference is written' exits 0 "$mxgen" library doc -o both
check 'the page has every definition' every_definition both/index.html
check 'Markdown has every definition' every_definition both/index.md
check 'a second run gives the same bytes' eval '"$mxgen" library doc -o again && diff -r both again'
check '--html writes the page only' eval '"$mxgen" library doc --html -o html && test "$(ls html)" = index.html && cmp html/index.html both/index.html'
check '--markdown writes Markdown only' eval '"$mxgen" library doc --markdown -o md && test "$(ls md)" = index.md'
if command -v xmllint >/dev/null; then
    check 'the page is well-formed' xmllint --noout --nonet both/index.html
else
    skip 'there is no xmllint'
fi
check 'ids are unique' eval '! grep -o " id=\"[^\"]*\"" both/index.html | sort | uniq -d | grep .'
check 'the page loads nothing from elsewhere' eval '! grep -Eq "(src|href)=\"[a-z]+:|@import|url\(" both/index.html'
check 'every link within the page has its end' eval \
    'grep -o "<a href=\"#[^\"]*" both/index.html | sed "s/.*#//" | sort -u | while read -r id; do grep -q " id=\"$id\"" both/index.html || exit 1; done'
check 'inputs have their ranges' grep -q '| `specular_IOR` | float | `1.5` | from 0, usually 1 to 3 |' both/index.md
check 'values have their names' grep -q '| `operationorder` | integer | `0` | SRT = 0, TRS = 1 |' both/index.md
check 'inputs have their units' grep -q '| `thinfilm_thickness` | float | `0` | from 0, usually up to 2000; in nanometer |' both/index.md
check 'an older version has what differs' eval 'grep -A5 "^Version 1.0.0 differs from 1.0.1" both/index.md | grep -q "^| .base. | float | .0.8. |"'

# Definitions of one's own, on the library that is built in
cat >own.mtlx <<'X_'
<?xml version="1.0"?>
<materialx version="1.39">
  <nodedef name="ND_own_float" node="own" nodegroup="procedural2d" doc="Less &lt; more | &quot;all&quot;.">
    <input name="texcoord" type="vector2" defaultgeomprop="UV0"/>
    <input name="count" type="float" value="4.0" uimin="1" uimax="9"/>
    <output name="out" type="float"/>
  </nodedef>
  <nodegraph name="NG_own_float" nodedef="ND_own_float">
    <noise2d name="noise" type="float"><input name="texcoord" type="vector2" interfacename="texcoord"/></noise2d>
    <output name="out" type="float" nodename="noise"/>
  </nodegraph>
  <nodedef name="ND_orphan_float" node="orphan"><output name="out" type="float"/></nodedef>
  <nodedef name="ND_osl_float" node="only_osl"><output name="out" type="float"/></nodedef>
  <implementation name="IM_osl_float" nodedef="ND_osl_float" target="essl" sourcecode="1.0"/>
</materialx>
X_
check 'a library of a user has a reference' exits 0 "$mxgen" library doc own.mtlx -o own
check 'the reference has the nodes of that library only' eval '[ "$(grep -c "^### " own/index.md)" -eq 3 ]'
check 'text is escaped' eval 'grep -qF "Less &lt; more | &quot;all&quot;." own/index.html && grep -qF "Less \\< more \\| " own/index.md'
cat >hostile.py <<'X_'
# Texts that end their place in Markdown and HTML; what a reader of CommonMark takes for code is left out.
import html.parser, re, subprocess, sys
from xml.sax.saxutils import quoteattr
class Page(html.parser.HTMLParser):
    def handle_starttag(self, tag, attributes):
        assert tag != "mark" and not any(name.startswith("on") for name, value in attributes), (tag, attributes)
for number, text in enumerate(["`<mark>`", "a`` ``<mark>", "x\n\n<mark>\n", "x\r\r<mark>\r", '" onload="mark()', "--><mark>", "]]><mark>", "|<mark>|"]):
    word = quoteattr(text, {"\n": "&#10;", "\r": "&#13;", '"': "&quot;"})
    with open("hostile.mtlx", "w") as file:
        file.write(f"""<materialx version="1.39"><nodedef name={word} node={word} nodegroup={word} doc={word} version={word}>
            <input name={word} type="string" value={word} doc={word} uiname={word} enum={word}/><output name="out" type="float"/></nodedef>
            <nodegraph name="G" nodedef={word}><constant name="c" type="float"/><output name="out" type="float" nodename="c"/></nodegraph></materialx>""")
    subprocess.run([sys.argv[1], "library", "doc", "hostile.mtlx", "-o", "hostile"], check=True, capture_output=True)
    lines = open("hostile/index.md").read().split("\n")
    for line in lines:
        plain = re.sub(r"\\.", "", re.sub(r"(?<![`\\])(`+)(?!`)(.*?[^`])\1(?!`)", "", line))
        assert "<mark" not in plain and not line.startswith("<"), line
    assert sum(line.startswith(("| `", "| \u2192")) for line in lines) == 2, lines
    Page().feed(open("hostile/index.html").read())
X_
check 'hostile texts stay in their place' python3 hostile.py "$mxgen"
check 'the library of a user has its ranges' grep -q '| `count` | float | `4` | 1 to 9 |' own/index.md
check 'the reference marks a node without implementation' eval 'grep -A3 "^### orphan" own/index.md | grep -q "not implemented"'
check 'the reference marks a node of one target' eval 'grep -A3 "^### only" own/index.md | grep -q "only essl"'
check 'a library that is missing fails' exits 1 "$mxgen" library doc none.mtlx -o none

touch file
check 'a folder that cannot be made fails' exits 1 "$mxgen" library doc -o file/sub
check 'the error of such a folder is output-failed' grep -q '\[output-failed\]' err
check 'a full disk fails' exits 1 bash -c "ulimit -f 1; exec '$mxgen' library doc -o full"
check 'the error of a full disk is output-failed' grep -q '\[output-failed\]' err
check 'a full disk leaves no half-written page' test -z "$(ls full)"

export MESA_SHADER_CACHE_DISABLE=true
if [ -z "$render" ]; then
    skip 'there is no renderer'
elif ! has_device "$render"; then
    skip 'there is no Vulkan device'
else
    cat >second.mtlx <<'X_'
<?xml version="1.0"?>
<materialx version="1.39">
  <nodedef name="ND_second_bsdf" node="second" nodegroup="pbr"><output name="out" type="BSDF"/></nodedef>
  <nodegraph name="NG_second_bsdf" nodedef="ND_second_bsdf">
    <conductor_bsdf name="metal" type="BSDF"/>
    <output name="out" type="BSDF" nodename="metal"/>
  </nodegraph>
</materialx>
X_
    check 'the reference can have pictures' exits 0 "$mxgen" library doc own.mtlx second.mtlx --pictures -o drawn
    check 'a pattern and a closure have pictures' eval 'file() { head -c 4 "$1" | grep -q PNG; }; file drawn/pictures/own.png && file drawn/pictures/second.png'
    check 'the pages show the pictures' eval 'grep -q "src=\"pictures/own.png\"" drawn/index.html && grep -q "](pictures/second.png)" drawn/index.md'
    check 'a node that cannot be drawn has no picture' test ! -e drawn/pictures/orphan.png
    check 'a run without a device fails' exits 1 env VK_DRIVER_FILES=/none VK_ICD_FILENAMES=/none "$mxgen" library doc own.mtlx --pictures -o dark
    check 'a run without a device writes pages without pictures' eval 'test -s dark/index.html && ! grep -q "<img" dark/index.html'
fi

finish library-doc
