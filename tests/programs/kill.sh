#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Killed at any moment, mxgen leaves complete files or none: each file with its final name equals the file of an undisturbed run.
# Argument: the program.
mxgen=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"

{
    echo '<materialx version="1.39">'
    for i in $(seq 24); do
        echo "<standard_surface name='SR_$i' type='surfaceshader'><input name='coat' type='float' value='0.$i'/></standard_surface>"
        echo "<surfacematerial name='M_$i' type='material'><input name='surfaceshader' type='surfaceshader' nodename='SR_$i'/></surfacematerial>"
    done
    echo '</materialx>'
} >many.mtlx
check 'an undisturbed run writes all files' exits 0 "$mxgen" many.mtlx --reflect -o whole --depfile whole.d
start=$(date +%s%N)
"$mxgen" many.mtlx --reflect -o timed >/dev/null 2>&1
duration=$((($(date +%s%N) - start) / 1000000))

# A run that ends before it is killed shows that the delays are too long for this machine: they shrink until enough are killed.
killed=0 longest=$((duration + 2))
RANDOM=1
for round in $(seq 200); do
    [ "$killed" -lt 25 ] || break
    rm -rf made made.d
    # A shell of its own, so that nobody tells of the killed one.
    bash -c "exec '$mxgen' many.mtlx --reflect -o made --depfile made.d" >/dev/null 2>&1 &
    victim=$!
    delay=$((RANDOM % longest))
    sleep "$(printf '%d.%03d' $((delay / 1000)) $((delay % 1000)))"
    kill -9 "$victim" 2>/dev/null
    if wait "$victim" 2>/dev/null; then
        [ "$longest" -le 2 ] || longest=$((longest * 9 / 10))
        continue
    fi
    killed=$((killed + 1))
    while read -r file; do
        check "$file is whole in round $round" cmp "made/$file" "whole/$file"
    done < <(cd made 2>/dev/null && find . -type f \( -name '*.frag' -o -name '*.vert' -o -name '*.json' \))
    [ ! -e made.d ] || check "round $round: depfile" eval 'sed "s|made/|whole/|g" made.d | cmp - whole.d'
done
check 'some runs were killed' test "$killed" -ge 5
check 'a run after a killed one is not disturbed' exits 0 "$mxgen" many.mtlx --reflect -o made
check 'a run after a killed one writes everything' eval 'for file in whole/*; do cmp "$file" "made/${file#whole/}" || exit 1; done'

finish kill
