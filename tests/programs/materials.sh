#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Real documents (shared/materials/README.md): counts the generated elements, compiles them, and compares the errors of the others with
# ../materials/expected.tsv:
#
#     document   elements generated   ids of errors, with commas   reason if MaterialX generates more, or if `resources` is incomplete
#
# MaterialX's own documents compile for all targets, complete and reduced; others compile for glsl. Also renders Standard Surface.
# Arguments: mxgen-compile, mxgen-render ('' to render nothing), the folder shared/materials, N to take each N-th document, and optionally
# --update, which rewrites the table (N is 1).
export compile=$(realpath "$1") materials=$(realpath -m "$3")
render=${2:+$(realpath "$2")} step=$4 update=${5:-}
here=$(cd "$(dirname "$0")" && pwd)
table=$here/../materials/expected.tsv
. "$here/common.sh"
export MESA_SHADER_CACHE_DISABLE=true

if [ ! -d "$materials" ]; then
    skip "there is no folder $materials"
    finish materials
fi

# compile_document DOCUMENT: a folder of its own for what came of it.
compile_document() {
    local modes=(--targets glsl --interfaces complete) code=0
    [[ $1 == resources/* ]] && modes=(--targets glsl,vulkan,essl,hlsl --interfaces complete,reduced)
    mkdir -p "made/$1"
    timeout 120 "$compile" "$materials/$1" "${modes[@]}" --max-errors 1000 >"made/$1/out" 2>"made/$1/err" || code=$?
    echo "$code" >"made/$1/code"
}
export -f compile_document
(cd "$materials" && find . -type f -name '*.mtlx' | sed 's|^\./||' | sort) >documents
awk -v step="$step" 'NR % step == 0' documents >taken
xargs -d '\n' -P 2 -I{} bash -c 'compile_document "$1"' - {} <taken

# How many elements were generated; "1 or 2" where targets or interfaces differ, or a shader did not compile.
generated() {
    cut -f 2-4 "made/$1/out" | sort -u | awk -F '\t' '
        { mode = $2 "\t" $3; if (!count[mode]++) modes[++n] = mode }
        END { printf "%d", count[modes[1]]; for (i = 2; i <= n; i++) if (count[modes[i]] != count[modes[1]]) printf " or %d", count[modes[i]] }'
}

# Exit code 1 goes with errors, and nothing else does.
errors() {
    local ids code
    ids=$(sed -n 's/^\(.*: \)\?error: .*\[\([a-z0-9-]*\)\]$/\2/p' "made/$1/err" | sort -u | paste -sd ,)
    code=$(cat "made/$1/code")
    [ "$code" -eq $((${#ids} > 0)) ] && echo "$ids" || echo "exit code $code,$ids"
}

# as_expected GENERATED ERRORS DOCUMENT
as_expected() {
    [ "$(generated "$3")" = "$1" ] && [ "$(errors "$3")" = "$2" ] && return
    printf 'expected %s and "%s", got %s and "%s"\n' "$1" "$2" "$(generated "$3")" "$(errors "$3")"
    head -n 20 "made/$3/err"
    return 1
}

declare -A is_listed is_left_out reasons
while read -r document; do is_left_out[$document]=1; done < <(comm -23 documents taken)
while IFS=$'\t' read -r document count ids reason; do
    ids=${ids#-}
    is_listed[$document]=1 reasons[$document]=$reason
    [ -z "$update" ] || continue
    [ -z "${is_left_out[$document]:-}" ] || continue
    check "$document is generated as listed" as_expected "$count" "$ids" "$document"
done < <(sed 1d "$table")
[ -z "$update" ] || printf 'document\tgenerated\terrors\treason\n' >"$table"
while read -r document; do
    if [ -n "$update" ]; then
        ids=$(errors "$document")
        printf '%s\t%s\t%s\t%s\n' "$document" "$(generated "$document")" "${ids:--}" "${reasons[$document]:-}" >>"$table"
    elif [ -z "${is_listed[$document]:-}" ]; then
        check "$document is in the table" false
    fi
done <documents

[ -n "$render" ] || { [ "$step" -gt 1 ] || skip 'there is no renderer'; finish materials; }
has_device "$render" || { skip 'there is no Vulkan device'; finish materials; }
examples=resources/Materials/Examples/StandardSurface
for document in $(grep "^$examples/" taken); do
    for element in $(cut -f 2 "made/$document/out" | sort -u); do
        got=0
        "$render" "$materials/$document" -e "$element" -o ball.png --size 16 >render.log 2>&1 || got=$?
        check "$document $element is drawn" test "$got" -eq "$(cat "made/$document/code")" -a -s ball.png
        rm -f ball.png
    done
done

finish materials
