#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Slang compiles to valid SPIR-V, in all roles that it has. MXGEN_SLANG is the path of slang-wasm.js (tests/npm).
# Arguments: mxgen, mxgen-compile, and documents or folders of documents.
mxgen=$(realpath "$1") compile=$(realpath "$2")
shift 2
documents=$(find $(realpath "$@") -name "*.mtlx")
. "$(dirname "$0")/common.sh"

# The other roles are errors that say why.
cat >gold.mtlx <<'END'
<materialx version="1.39">
  <standard_surface name="gold" type="surfaceshader"><input name="metalness" type="float" value="1"/></standard_surface>
</materialx>
END
for role in deferred depth payload; do
    check "$role is an error" exits 1 "$mxgen" gold.mtlx --target slang --role "$role" -o none
    check "the error of $role has its reason" grep -q 'can store slabs' err
done

if [ ! -f "${MXGEN_SLANG:-}" ] || ! command -v node >/dev/null; then
    skip 'MXGEN_SLANG does not name slang-wasm.js: nothing is compiled'
    finish slang
fi

# compiles DOCUMENT OPTION...: each shader has instructions, so it was compiled.
compiles() {
    exits 0 "$compile" "$@" --targets slang || return
    awk -F '\t' '$7 == 0 { print "not compiled: " $0; bad = 1 } END { exit bad || NR == 0 }' out
}
check 'documents' compiles $documents --trust --interfaces complete,reduced # Node starts once for all
for role in path scatter function; do
    check "role $role" compiles gold.mtlx --interfaces complete,reduced --role "$role"
done

# A fault has the line of the source and Slang's words.
cat >broken.mtlx <<'END'
<materialx version="1.39">
  <nodedef name="ND_broken" node="broken"><output name="out" type="float"/></nodedef>
  <implementation name="IM_broken" nodedef="ND_broken" target="genslang" sourcecode="missing + 1.0"/>
  <broken name="b" type="float"/>
  <output name="o" type="float" nodename="b"/>
</materialx>
END
check 'a fault is found' exits 1 "$compile" broken.mtlx --trust --targets slang --interfaces complete
check 'it has its line and the words of the compiler' grep -q "line [0-9].*undefined identifier 'missing'" err
finish slang
