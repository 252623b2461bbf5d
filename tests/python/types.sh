#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Type checkers accept the package and the examples, and see its types. Arguments: the root of the project, a folder with the package.
. "$(dirname "$0")/../programs/common.sh"
root=$1
export MYPYPATH=$2
command -v mypy >/dev/null || { echo "skip: mypy is not installed"; exit 77; }

# Checks the types of a file or package.
types() {
    mypy --strict --cache-dir=cache "$@"
}

check "the package has its types" types -p mxgen
for example in "$root"/examples/*.py; do
    check "the types of $example are right" types "$example"
done
echo 'import mxgen
number: int = mxgen.Context().parse("").generate("glsl").pixel' >wrong.py
check "a wrong type is an error" exits 1 types wrong.py
check "the error names the type" grep -q 'expression has type "Optional\[str\]"' out
finish python-types
