#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The wheel: built from the tracked files without network, installed in an empty folder, tested there.
# Arguments: Python, the root of the project, the program.
python=$1 root=$2 program=$(realpath "$3")
. "$(dirname "$0")/../programs/common.sh"
"$python" -c 'import mesonpy, pip' 2>/dev/null || { echo "skip: meson-python or pip is not installed"; exit 77; }
git -C "$root" rev-parse --git-dir >/dev/null 2>&1 || { echo "skip: no git checkout, so no list of files"; exit 77; }

# Runs Python in the folder with the installed wheel.
installed() {
    PYTHONPATH=$work/installed "$python" "$@"
}

mkdir source installed
git -C "$root" ls-files -z | (cd "$root" && xargs -0 cp --parents -t "$work/source")
check "pip makes a wheel" "$python" -m pip wheel --no-index --no-deps --no-build-isolation --wheel-dir . ./source
check "the files of the wheel can be listed" exits 0 "$python" -m zipfile -l mxgen-*.whl
awk 'NR > 1 { print $1 }' out >files
check "the wheel has the package only" exits 1 grep -v '^mxgen/\|^mxgen-[^/]*\.dist-info/' files
check "the wheel has the types" grep '^mxgen/py.typed$' files
check "pip installs the wheel" "$python" -m pip install --no-index --no-deps --target installed mxgen-*.whl
check "the tests pass with the installed wheel" installed "$root/tests/python/run.py" "$root" "" "$program"

rm installed/mxgen/_native.*.so
check "an import fails without the native module" exits 1 installed -c 'import mxgen'
check "the error names the native module" grep 'ImportError: mxgen cannot load its native module' err
finish python-wheel
