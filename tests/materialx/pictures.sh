#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Example materials, drawn by one scene with MaterialX's own libraries and with mxgen's: pictures.tsv lists the ratio of their means.
# Means agree within 2 %; rows beyond that have a reason. MXGEN_MATERIALX names a folder with MaterialX's libraries.
# Arguments: mxgen-render, mean_ratio, the folder shared/materials, and optionally --update, which rewrites the table.
render=$(realpath "$1") mean_ratio=$(realpath "$2") examples=$(realpath -m "$3")/resources/Materials/Examples update=${4:-}
table=$(cd "$(dirname "$0")" && pwd)/pictures.tsv
libraries=${MXGEN_MATERIALX:-}/libraries
. "$(dirname "$0")/../programs/common.sh"
export MESA_SHADER_CACHE_DISABLE=true GALLIVM_PERF=nopt

if [ -z "${MXGEN_MATERIALX:-}" ] || [ ! -d "$libraries" ]; then
    skip "MXGEN_MATERIALX does not name a folder with MaterialX's libraries"
    finish materialx-pictures
fi
[ -d "$examples" ] || { skip "there is no folder $examples"; finish materialx-pictures; }
has_device "$render" || { skip 'there is no Vulkan device'; finish materialx-pictures; }

# ratio DOCUMENT: the mean with MaterialX's libraries over the mean with mxgen's.
ratio() {
    "$render" "$examples/$1" -o own.exr --size 64 -q 2>own.log
    "$render" "$examples/$1" -o theirs.exr --size 64 -q --no-builtin-library --library "$libraries" 2>theirs.log
    "$mean_ratio" theirs.exr own.exr
}

# agrees DOCUMENT RATIO REASON
agrees() {
    local now
    now=$(ratio "$1") || { cat own.log theirs.log; return 1; }
    awk -v now="$now" -v then="$2" -v reason="$3" 'BEGIN {
        d = now - then; e = then - 1
        if (d > 0.01 || d < -0.01) { print "the ratio is " now ", not " then; exit 1 }
        if ((e > 0.02 || e < -0.02) && reason == "") { print "a ratio of " then " has no reason"; exit 1 } }'
}

declare -A reasons listed
while IFS=$'\t' read -r document listed_ratio reason; do
    reasons[$document]=$reason listed[$document]=$listed_ratio
done < <(sed 1d "$table" 2>/dev/null)
[ -z "$update" ] || printf 'document\tratio\treason\n' >"$table"
while read -r document; do
    # Its textures or includes are not in the folder.
    if "$render" "$examples/$document" -o own.exr --size 8 -q 2>&1 | grep -q 'include-missing'; then
        skip "$document includes a file that is not here"
    elif [ -n "$update" ]; then
        printf '%s\t%s\t%s\n' "$document" "$(ratio "$document")" "${reasons[$document]:-}" >>"$table"
    else
        check "$document looks as it does in MaterialX" agrees "$document" "${listed[$document]:-0}" "${reasons[$document]:-}"
    fi
done < <(cd "$examples" && find . -name '*.mtlx' | sed 's|^\./||' | sort)

finish materialx-pictures
