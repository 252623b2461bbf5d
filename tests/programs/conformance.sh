#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The value of every node at sample points, drawn by the generated Vulkan shaders, against the reference numbers of
# ../shared/conformance. Rows that differ for a reason stand in conformance.known. Arguments: mxgen-render, that folder.
render=$(realpath "$1")
numbers=$2
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"

if [ ! -d "$numbers/cases/public" ]; then
    skip "there is no folder $numbers"
    finish conformance
fi
export render MESA_SHADER_CACHE_DISABLE=true
find "$numbers/cases/public" -name '*.mtlx' | sort |
    xargs -P 2 -I{} sh -c '"$render" "$1" --scene grid --quiet >"$(basename "$1" .mtlx).csv" 2>"$(basename "$1").log"' - {}
if grep -q no-device ./*.log; then
    skip 'there is no Vulkan device'
    finish conformance
fi
cat ./*.csv >all
python3 "$numbers/check.py" --csv public all >result 2>&1
sed -n 's/^FAIL [^ ]* \([^ ]*\): \(.*\)/\1 \2/p' result | sort >differ
grep -v '^ *\(#.*\)\?$' "$here/conformance.known" | sort >known
# A row of the list that does not differ any more is a mistake in the list.
sort -m <(cut -d' ' -f1 differ | sort) known | uniq -d >expected
unexpected=$(cut -d' ' -f1 differ | sort | comm -23 - known)
passed=$(sed -n 's/^public: .* cases, \([0-9]*\) pass.*/\1/p' result)
skipped=$(wc -l <expected)
failed=$(printf '%s' "$unexpected" | grep -c .)
printf 'skip: %d rows that differ for a reason (conformance.known)\n' "$skipped"
printf '%s\n' "$unexpected" | head -20 | while read -r row; do [ -n "$row" ] && grep -F "$row " differ; done
comm -13 expected known | sed 's/^/does not differ any more: /'
finish conformance
