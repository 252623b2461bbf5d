#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Typical faults with their complete messages: DOCUMENT.mtlx, and DOCUMENT.txt with the output of `mxgen validate` and of generation.
# Arguments: the program, the folder; --update rewrites the texts.
mxgen=$(realpath "$1") folder=$(realpath "$2") update=${3:-}
. "$folder/../programs/common.sh"

say() { # document
    echo "$ mxgen validate $1"
    (cd "$folder" && "$mxgen" validate "$1" 2>&1)
    echo "$ mxgen $1"
    (cd "$folder" && "$mxgen" "$1" -o "$work/shaders" 2>&1)
}
for document in "$folder"/*.mtlx; do
    name=$(basename "$document" .mtlx)
    say "$name.mtlx" >said.txt
    [ -z "$update" ] || cp said.txt "$folder/$name.txt"
    check "the messages of $name stay as they are" diff -u "$folder/$name.txt" said.txt
done

finish messages
