#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# mxgen format and mxgen upgrade: the text changes, the document does not. Arguments: the program, the examples, a folder of
# documents that may be absent.
mxgen=$(realpath "$1")
examples=$(realpath "$2")
corpus=$3
[ -d "$corpus" ] && corpus=$(realpath "$corpus")
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"

keeps() { # DOCUMENT: the formatted text has the same tree and comments, and formats to itself
    local copy=formatted.mtlx
    "$mxgen" format "$1" -o $copy -q && "$mxgen" format $copy -q | cmp - $copy || return 1
    # beside the original, so that includes are found
    diff <("$mxgen" inspect "$1" --graph 2>/dev/null) <(cd "$(dirname "$1")" && "$mxgen" inspect - --graph <"$work/$copy" 2>/dev/null) || return 1
    [ "$(grep -o -- '<!--' "$1" | wc -l)" = "$(grep -o -- '<!--' $copy | wc -l)" ]
}
for document in "$examples"/*.mtlx; do
    check "format keeps $(basename "$document")" keeps "$document"
done
if [ -d "$corpus" ]; then
    while read -r document; do
        check "format keeps $document" keeps "$document"
    done < <(find "$corpus/resources" -name '*.mtlx' -type f | sort)
else
    skip "$corpus is absent: only the examples were formatted"
fi

cat >old.mtlx <<'END'
<?xml version="1.0"?>
<!-- licence -->
<materialx version="1.36">
  <!-- metal -->
  <material name="M"> <!-- the only one -->
    <shaderref name="sr" node="standard_surface">
      <bindinput name="metalness" type="float" value="1"/> <!-- full -->
    </shaderref>
  </material>
</materialx>
END
check 'an old document is upgraded' exits 0 "$mxgen" upgrade old.mtlx -o new.mtlx
check 'the upgraded document has version 1.39' grep -q 'version="1.39"' new.mtlx
cat >instructions.mtlx <<'END'
<?xml version="1.0"?>
<?xml-model href="x.rng"?>
<materialx version="1.39">
  <!---->
  <?note?>
  <constant name="a" type="float"/> <?behind it?>
  <?last one?>
</materialx>
<?after?>
END
check 'processing instructions and an empty comment stay' eval '"$mxgen" format instructions.mtlx | cmp - instructions.mtlx'
echo '<materialx version="1.38"><nodegraph name="g"><input name="s" type="string" value="object"/><normalmap name="n" type="vector3"><input name="space" type="string" interfacename="s"/></normalmap><output name="o" type="vector3" nodename="n"/></nodegraph></materialx>' >space.mtlx
check 'a meaning that the upgrade cannot keep is told' eval '"$mxgen" upgrade space.mtlx -o - >out 2>err && has err "space.mtlx:1:" "[upgrade-loss]"'
check 'the upgrade keeps comments' test "$(grep -c -- '<!--' new.mtlx)" = 4
check 'the upgraded document is valid' exits 0 "$mxgen" validate new.mtlx --verbose
check 'the upgraded document needs no upgrade' eval '! grep -q upgraded err'
"$mxgen" old.mtlx -o from_old -q && "$mxgen" new.mtlx -o from_new -q
check 'the upgraded document gives the same shader' cmp from_old/M.frag from_new/M.frag
check 'a second upgrade changes nothing' exits 0 "$mxgen" upgrade new.mtlx --check
check '--verbose notes the changes' eval '"$mxgen" upgrade old.mtlx --verbose 2>&1 >/dev/null | grep -q upgraded'

# The prefix of includes is declared once, whatever the document says of it.
echo '<materialx version="1.39" xmlns:xi="ours"><xi:include href="new.mtlx"/></materialx>' >prefix.mtlx
check 'a document with a prefix of its own is formatted' exits 0 "$mxgen" format prefix.mtlx --in-place
check 'and has the prefix once' exits 0 "$mxgen" format prefix.mtlx --check
check '--check fails for a document that would change' exits 1 "$mxgen" format old.mtlx new.mtlx --check
check 'the error names the document that would change' grep -q "'old.mtlx' would change \[would-change\]" err
check 'the error names no other document' eval '! grep -q new.mtlx err'
cp old.mtlx copy.mtlx
check '--in-place is accepted' exits 0 "$mxgen" format copy.mtlx new.mtlx --in-place
check 'a formatted document passes --check' exits 0 "$mxgen" format copy.mtlx new.mtlx --check
check 'a document may come from standard input' eval '"$mxgen" format - <old.mtlx | cmp - copy.mtlx'

check 'a file that is missing fails' exits 1 "$mxgen" format none.mtlx
check 'the error is file-missing' grep -q file-missing err
echo '<materialx version="1.39"><add name="a"' >cut.mtlx
cp cut.mtlx before.mtlx
check 'a truncated file fails' exits 1 "$mxgen" format cut.mtlx --in-place
check 'a truncated file stays as it is' cmp cut.mtlx before.mtlx
check 'the error names the truncated file' grep -q 'cut.mtlx:' err
check '-o with --in-place is wrong usage' exits 2 "$mxgen" format old.mtlx -o a --in-place
check 'two documents with -o are wrong usage' exits 2 "$mxgen" format old.mtlx new.mtlx -o a
check '--check with -o is wrong usage' exits 2 "$mxgen" format old.mtlx --check -o a
check 'standard input with --in-place is wrong usage' exits 2 "$mxgen" format - --in-place
check 'a run without a document is wrong usage' exits 2 "$mxgen" format
finish rewrite
