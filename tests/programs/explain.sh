#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The example of every message: the wrong version reports the message, the right one does not. The page of all messages.
# Arguments: the program, the page, the root of the project.
mxgen=$(realpath "$1")
page=$(realpath "$2")
root=$(realpath "$3")
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"

# Files that an example cannot contain; tests/diag/elsewhere.txt names their tests.
without_example='bake-look budget-unjudged look-part occlusion-left-out needed-by fault-of-source closures-not-stored too-many-slabs code-error code-fault removed-reference bad-geometry not-drawn light-left-out light-unread look-unread missing-primvar primvar-type unknown-camera usda-loss usda-shader inherit-depth network-limit blur-left-out film-left-out bad-pixels check-crashed check-failed check-memory check-timeout file-too-large graph-depth output-limit too-many-ports too-many-variants xml-attributes render-failed shader-invalid
failed no-renderer no-device device-lost device-memory size-limit bad-mesh empty-mesh bad-environment bad-shader no-look no-uniform no-picture translation-error nothing-to-bake bake-view bake-mesh bake-type bake-clamped bake-output bake-degenerate bake-overlap export-loss export-clamped export-space export-tiles import-file import-loss no-texcoords usda-size usd-flatten'

# The messages about an example: ids of all messages, with the notes' too.
says() { # folder
    local arguments
    read -ra arguments <"$1/arguments"
    (cd "$1" && "$mxgen" "${arguments[@]}" 2>&1)
}
# A note is told without its id: the text of its message before what is put in, or between.
mentions() { # output, id
    local message=${message_of[$2]}
    [[ $1 != *"[$2]"* ]] || return 0 # also a note of a message of its own
    [ "${severity_of[$2]}" = note ] || return
    [ "$message" = … ] && message=.
    message=$(sed 's/…/.*/g; s/[][(]/\\&/g' <<<"$message")
    grep -Eq "note: $message" <<<"$1"
}
try() { # id
    if [ ! -d "examples/$1" ]; then
        [[ " ${without_example//$'\n'/ } " == *" $1 "* ]] || { echo "no example"; return 1; }
        return 0
    fi
    local wrong right
    wrong=$(says "examples/$1/wrong")
    right=$(says "examples/$1/right")
    mentions "$wrong" "$1" || { echo "the wrong one says: $wrong"; return 1; }
    ! mentions "$right" "$1" || { echo "the right one says: $right"; return 1; }
    [[ $right != *'error: '* ]] || { echo "the right one has errors: $right"; return 1; }
}

declare -A severity_of message_of
ids=
while read -r id severity message; do
    severity_of[$id]=$severity message_of[$id]=$message ids+=${ids:+$'\n'}$id
done < <("$mxgen" explain)
check 'the examples of all messages are written' exits 0 "$mxgen" explain -o examples
for id in $ids; do
    check "the example of $id has its message" try "$id"
done
# Messages that the programs print by themselves are explained as well
printed=$(cd "$root" && grep -rhoE '(report_(error|warning)\([^"]*|\bfail(_as)?\([^"]*|\bid = |VK_ERROR_[A-Z_]+, )"[a-z]+(-[a-z]+)*"' program cli check compile doc render | grep -oE '"[^"]*"$' | tr -d '"' | sort -u)
for id in $printed; do
    check "$id has an explanation" grep -qx "$id" <<<"$ids"
done
check 'the programs print at least 25 ids' test "$(wc -w <<<"$printed")" -ge 25
check "there are at least 100 ids" test "$(wc -w <<<"$ids")" -ge 100
check 'the example of one message is written' exits 0 "$mxgen" explain type-mismatch -o one
check 'it is the one among all' diff -r one/type-mismatch examples/type-mismatch
check 'an unknown id is wrong usage' exits 2 "$mxgen" explain typ-mismatch
check 'an unknown id has a suggestion' grep -q "did you mean 'type-mismatch'" err
check 'a message can be printed as Markdown' eval '"$mxgen" explain cycle --markdown | sed -n 2p | grep -qx "## cycle"'
check 'the page of messages has a section for each' eval 'diff <(sed -n "s/^## //p" "$page") <(echo "$ids")'
check 'the table of the page links to each section' eval 'diff <(sed -n "s/^| \[\([a-z0-9-]*\)\](#\1) |.*/\1/p" "$page") <(echo "$ids")'

finish explain
