#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Help, the manual page and the completions of shells, which all come from the same tables. Arguments: mxgen, the folder with the page and
# the completions.
mxgen=$(realpath "$1")
files=$(realpath "$2")
. "$(cd "$(dirname "$0")" && pwd)/common.sh"
commands='generate check inspect validate explain library'

# --help has what people use, --help all the rest as well
for command in $commands; do
    "$mxgen" "$command" --help >"$command.short"
    check "$command --help all is accepted" exits 0 "$mxgen" "$command" --help all
    cp out "$command.all"
    check "help $command all prints the same" eval '"$mxgen" help $command all | cmp - $command.all'
    check "$command has more options behind all" test "$(wc -l <"$command.all")" -gt "$(wc -l <"$command.short")"
    check "limits stand behind all of $command" eval '! grep -q -- --max-nodes $command.short && grep -q -- --max-nodes $command.all'
    check "texts of $command fit into 100 columns" eval "! grep -E '^ {33}.{68}' $command.all"
done
check 'options of generation stand behind all' eval '! grep -q -- --interface generate.short && grep -q -- --interface generate.all'
check 'a command without generation has no options of it' eval '! grep -q -- --interface validate.all'
check 'an option that people use stands in both' eval 'grep -q -- --reflect generate.short && grep -q -- --reflect generate.all'
check '--help=all is accepted' eval '"$mxgen" check --help=all | cmp - check.all'
check 'another word of --help is wrong usage' exits 2 "$mxgen" check --help=everything
check 'a file behind --help is no word of it' eval '"$mxgen" check --help some.mtlx | cmp - check.short'

# The page has every option of every command
options_of() { grep -oE '^ {2}(-.,| {3}) --[a-z-]+' "$1" | grep -oE -- '--[a-z-]+'; }
sed 's/\\-/-/g' "$files/mxgen.1" >page
for command in $commands; do
    for option in $(options_of "$command.all"); do
        grep -qF -- "\\fB$option\\fR" page || { echo "$command $option"; }
    done
done >absent
check 'the page has every option' test ! -s absent
check 'the page has the options of the renderer' grep -qF -- '--turntable' page
if man --version >/dev/null 2>&1 && echo | groff -man -Tutf8 >/dev/null 2>&1; then
    man --warnings -l "$files/mxgen.1" >page.txt 2>warnings
    check 'man shows the page' grep -q 'compile MaterialX documents to shaders' page.txt
    check 'man gives no warning' test ! -s warnings
else
    skip 'there is no man or groff: the page was not shown'
fi

# bash completes words as its user types them
check 'bash reads the completion' bash -n "$files/mxgen"
completes() { # WORD... : prints what the last word may become
    bash -c '. "$1"; shift; COMP_WORDS=(mxgen "$@"); COMP_CWORD=$#; _mxgen; printf "%s\n" "${COMPREPLY[@]}"' - "$files/mxgen" "$@"
}
check 'commands are completed' test 'render' = "$(completes ren)"
check 'options of a command are completed' test '--shard' = "$(completes check --shar)"
check 'options of other commands are not completed' test '' = "$(completes validate --sha)"
check 'options without a command are completed' test '--stdout' = "$(completes --std)"
check 'options of generation are completed' test '--interface' = "$(completes check --interf)"
check 'values are completed' test 'complete authored reduced' = "$(completes check --interface '' | xargs)"
check 'values behind = are completed' test 'authored' = "$(completes check --interface = au)"
check 'targets behind -t are completed' test 'vulkan' = "$(completes a.mtlx -t vu)"
touch here.mtlx
check 'files are completed' test 'here.mtlx' = "$(completes check her)"
for shell in zsh fish; do
    file=$files/mxgen.fish
    [ $shell = fish ] || file=$files/_mxgen
    if command -v $shell >/dev/null; then
        check "$shell reads the completion" $shell -n "$file"
    else
        skip "there is no $shell: its completion was not read"
    fi
done
check 'the completion of zsh closes its quotes' python3 -c 'import shlex, sys; shlex.split(open(sys.argv[1]).read(), comments=True)' "$files/_mxgen"
check 'an unknown shell is wrong usage' exits 2 "$mxgen" help --completion tcsh
check 'a completion without a shell is wrong usage' exits 2 "$mxgen" help --completion
finish help
