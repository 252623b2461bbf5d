#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Killed at any moment, mxgen leaves complete files or none: each file with its final name equals the file of an undisturbed run.
# Nothing else stays, of programs that give files to libraries, too. Argument: the program.
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
# A killed process leaves a file where it replaces one: the next run removes it, but nothing that a process locks, and nothing of others.
touch made/M_1.frag.0123abcd.mxgen.tmp made/M_2.frag.0123abcd.mxgen.tmp made/M_3.frag.0123abcd.tmp
mkdir made/folder.0123abcd.mxgen.tmp
ln -s ../whole.d made/link.0123abcd.mxgen.tmp
mkfifo made/pipe.0123abcd.mxgen.tmp
exec 9<>made/M_2.frag.0123abcd.mxgen.tmp
flock 9
check 'a run beside files of a killed one writes everything' exits 0 timeout 60 "$mxgen" many.mtlx --reflect -o made
check 'the file of the killed one is gone' test ! -e made/M_1.frag.0123abcd.mxgen.tmp
check 'a file that a process locks stays' test -e made/M_2.frag.0123abcd.mxgen.tmp
check 'files, folders and links of others stay' test -e made/M_3.frag.0123abcd.tmp -a -d made/folder.0123abcd.mxgen.tmp -a -L made/link.0123abcd.mxgen.tmp
exec 9<&-
rm -r made/*tmp
check 'no other file stays in a folder that files were new in' eval '[ -z "$(find . -name "*tmp*")" ]'

# ---- Files that libraries write, which have no names until they are complete ----

# Kills a command as soon as it has an open file without a name in the folder `drawn`. A shell of its own, so that nobody tells of it.
kill_writing() {
    bash -c 'exec "$@"' - "$@" >/dev/null 2>&1 &
    local victim=$! writes=false process
    while [ -e /proc/$victim/fd ] && ! $writes; do
        for process in $victim $(pgrep -P $victim); do ls -l /proc/$process/fd; done 2>/dev/null | grep -q "$PWD/drawn/.*(deleted)" && writes=true
        sleep 0.01
    done
    kill -9 $victim 2>/dev/null
    wait $victim 2>/dev/null
    $writes
}

if [ -x "$(dirname "$mxgen")/mxgen-render" ] && mkdir -p drawn; then
    cat >varied.mtlx <<'XML'
<materialx version="1.39"><fractal2d name="noise" type="color3"/>
<standard_surface name="S" type="surfaceshader"><input name="base_color" type="color3" nodename="noise"/></standard_surface>
<surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial></materialx>
XML
    # On a busy machine a run may end before it is seen: then it runs again.
    caught_writing() {
        local try
        for try in $(seq 10); do
            rm -rf drawn/*
            kill_writing "$@" && return
        done
        return 1
    }
    check 'a bake is killed while it writes' caught_writing "$mxgen" bake varied.mtlx -o drawn --size 1024
    check 'nothing of it stays' test -z "$(ls -A drawn)"
    check 'a picture is killed while it is written' caught_writing "$mxgen" render varied.mtlx --mesh plane --size 1024 -o drawn/picture.png
    check 'nothing of it stays' test -z "$(ls -A drawn)"

    # A killed command leaves its folder of temporary files, which the next one removes, but no folder that is in use.
    mkdir -p temporary temporary/mxgen-scratch-killed/deep && touch temporary/mxgen-scratch-killed/deep/file
    mkdir temporary/mxgen-scratch-in-use temporary/other
    exec 9<temporary/mxgen-scratch-in-use && flock -x 9
    check 'an export makes a folder for temporary files' exits 0 env TMPDIR=temporary "$mxgen" export varied.mtlx -o drawn/varied.glb --size 16
    check 'it removes those of killed runs alone' test "$(ls temporary | paste -sd' ')" = 'mxgen-scratch-in-use other'
else
    skip 'mxgen-render is not built'
fi

finish kill
