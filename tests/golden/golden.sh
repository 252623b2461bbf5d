#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Compares generated files with golden files beside the documents. A document begins with a line per run:
#
#     <!-- mxgen: NAME key=value ... -->     options of mxgen; files=frag,json selects the golden files (default: frag)
#
# A run makes DOCUMENT.NAME.frag and so on. Arguments: mxgen, mxgen-compile ('' to compile nothing), and optionally --update, which
# rewrites golden files and prints the differences for review.
mxgen=$(realpath "$1") compile=${2:+$(realpath "$2")} update=${3:-}
golden=$(cd "$(dirname "$0")" && pwd)
. "$golden/../programs/common.sh"

[ -n "$compile" ] || skip 'without glslang nothing is compiled'
command -v glslangValidator >/dev/null || skip 'without glslangValidator no function of path tracers is compiled'
# same KEPT NEW: whether they are equal; with --update they are then.
same() {
    diff -u --label "${1##*/}" --label "${1##*/} (now)" "$([ -e "$1" ] && echo "$1" || echo /dev/null)" "$2" && return
    [ -n "$update" ] && cp "$2" "$1"
}

run_line() {
    local document=$1 name=$2 files=frag target=glsl role=raster interface=complete option options=()
    shift 2
    for option in "$@"; do
        case $option in
            files=*) files=${option#*=} ;;
            target=*) target=${option#*=} ;;
            role=*) role=${option#*=} options+=("--$option") ;;
            interface=*) interface=${option#*=} ;;
            *) options+=("--$option") ;;
        esac
    done
    local title=${document%.mtlx}.$name
    check "$title is generated" exits 0 "$mxgen" "$document" --target "$target" --interface "$interface" --reflect -o "$title.d" "${options[@]}" || return
    for ending in ${files//,/ }; do
        local made=("$title.d"/*."$ending")
        for file in "${made[@]}"; do
            local element=${file##*/}
            [ ${#made[@]} -eq 1 ] && element= || element=.${element%."$ending"}
            kept[$title$element.$ending]=1
            written[$ending.$role]=1
            check "$title$element.$ending stays as it is" same "$golden/$title$element.$ending" "$file"
            [ -z "$update" ] || cat check.log
        done
    done
    [ -n "$compile" ] && [ "$target" != slang ] || return # each start of slang-wasm takes seconds: the test `slang` has these documents
    check "each stage of $title compiles" "$compile" "$document" --targets "$target" --interfaces "$interface" "${options[@]}"
    if grep -q '^note: .* no compiler' check.log; then missing[$target]=1; fi
}

declare -A kept written missing
cp -R "$golden"/*.mtlx "$golden/parts" .
for document in *.mtlx; do
    while read -r line; do
        read -ra words <<<"$line"
        run_line "$document" "${words[@]}"
    done < <(sed -n 's/^<!-- mxgen: \(.*\) -->$/\1/p' "$document")
done
for file in vulkan.light_complex.comp vulkan.compose.comp hlsl.light_simple.cs.hlsl hlsl.classify.cs.hlsl msl.classify.comp.metal; do
    target=${file%%.*}
    [ -d "passes.$target" ] || check "passes of the deferred pipeline: $target" exits 0 "$mxgen" pipeline "passes.$target" --target "$target"
    kept[pipeline.$file]=1
    check "pipeline.$file stays as it is" same "$golden/pipeline.$file" "passes.$target/${file#*.}"
    [ -z "$update" ] || cat check.log
done
targets=$("$mxgen" --help | sed -n '/^Targets:/,$ s/^  \([a-z][^ ]*\) .*/\1/p')
check 'there are targets' test -n "$targets"
for target in $targets; do # the shading models in every language
    check "models.mtlx has a run '$target'" ls "$golden/models.$target".standard_surface.*
done
mapfile -t roles < <("$mxgen" --help all | sed -n 's/^ *--role \([a-z|]*\)$/\1/p' | tr '|' '\n')
check 'there are roles' test ${#roles[@]} -gt 5
for target in $targets; do # each role in every language; dialects have one ending
    for role in "${roles[@]}"; do
        "$mxgen" roles.mtlx --target "$target" --role "$role" --element Cup --interface reduced -q -o roles.d >roles.log 2>&1 || continue
        for file in roles.d/Cup.{frag*,ps.hlsl}; do
            [ ! -e "$file" ] || check "a run makes a file .${file#roles.d/Cup.} for the role $role" test -n "${written[${file#roles.d/Cup.}.$role]:-}"
        done
        rm -rf roles.d
    done
done
for file in "$golden"/*.vert "$golden"/*.frag "$golden"/*.comp "$golden"/*.{hlsl,slang,metal,wgsl,osl,oslgroup,mdl,json}; do # what no run makes any more
    [ -n "${kept[${file##*/}]:-}" ] && continue
    [ -n "$update" ] && rm -v "$file" || check "${file##*/} is made by a run" false
done
for target in "${!missing[@]}"; do
    skip "no compiler for $target is installed: its shaders are compared only"
done
finish golden
