#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The examples in Rust and .NET say what c_minimal.c says. Arguments: the root of the project, the shared library, c_minimal.
root=$1 library=$(realpath "$2") c_minimal=$(realpath "$3")
. "$(dirname "$0")/../programs/common.sh"
folder=$(dirname "$library")
export LD_LIBRARY_PATH=$folder

# same LANGUAGE COMMAND...: compares the output for a good, a broken and a missing document.
same() {
    local language=$1
    shift
    check "$language generates a shader" exits 0 "$@" gold.mtlx
    check "$language gives the bytes of C" cmp out gold.c
    check "$language reports errors" exits 1 "$@" broken.mtlx
    check "$language gives the messages of C" diff -B err broken.c
    check "$language fails without a document" exits 1 "$@" none.mtlx
    check "$language reports the missing document" grep -q 'file-missing' err
}

cp "$root/examples/gold.mtlx" .
sed 's/1.0, 0.766, 0.336/red/' gold.mtlx >broken.mtlx
"$c_minimal" gold.mtlx >gold.c
"$c_minimal" broken.mtlx 2>broken.c
check "C has an error to compare" grep -q bad-value broken.c

if command -v rustc >/dev/null && rustc --version >/dev/null 2>&1; then
    check "rustc compiles minimal.rs" rustc --edition 2021 -D warnings "$root/examples/minimal.rs" -L "$folder" -l mxgen -o minimal
    same Rust ./minimal
else
    skip "rustc is not installed (Debian: rustc): minimal.rs was not compiled"
fi
if command -v mcs >/dev/null && command -v mono >/dev/null; then
    check "mcs compiles Minimal.cs" mcs -warnaserror -out:Minimal.exe "$root/examples/Minimal.cs"
    same .NET mono Minimal.exe
else
    skip "mono is not installed (Debian: mono-mcs): Minimal.cs was not compiled"
fi
finish bindings
