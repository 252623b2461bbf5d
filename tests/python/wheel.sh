#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The wheel: built from the tracked files without network, installed in an empty environment, tested there; and the source archive.
# Arguments: Python, the root of the project, the program.
python=$1 root=$2 program=$(realpath "$3")
. "$(dirname "$0")/../programs/common.sh"
"$python" -c 'import pip, venv, ensurepip' 2>/dev/null || { echo "skip: pip or venv is not installed"; exit 77; }
git -C "$root" rev-parse --git-dir >/dev/null 2>&1 || { echo "skip: no git checkout, so no list of files"; exit 77; }

# Runs Python in the environment with the installed wheel.
installed() {
    "$work/empty/bin/python" "$@"
}

mkdir source
git -C "$root" ls-files -z | (cd "$root" && xargs -0 cp --parents -t "$work/source")
git -C source init -q && git -C source add .
if [ -d "$root/build-libxml2" ]; then
    cp -r "$root/build-libxml2" source
    tag=manylinux_2_
else
    skip "script/sources has not run: the wheel has no libxml2 inside"
    tag=linux_
fi
check "pip makes a wheel" "$python" -m pip wheel --no-index --no-deps --no-build-isolation --wheel-dir . ./source
check "its tag names no Python, and the C library where it needs no other" ls mxgen-*-py3-none-$tag*.whl
check "the files of the wheel can be listed" exits 0 "$python" -m zipfile -l mxgen-*.whl
awk 'NR > 1 { print $1 }' out >files
check "the wheel has the package only" exits 1 grep -v '^mxgen/\|^mxgen-[^/]*\.dist-info/' files
check "the wheel has the types" grep '^mxgen/py.typed$' files
check "an empty environment is made" "$python" -m venv empty
check "pip installs the wheel" installed -m pip install --no-index mxgen-*.whl
check "the tests pass with the installed wheel" installed "$root/tests/python/run.py" "$root" "" "$program"
check "the source archive is made" "$python" -c 'import sys; sys.path.insert(0, "source/python"); import backend; backend.build_sdist(".")'
tar -tzf mxgen-*.tar.gz | sed 's|^[^/]*/||' | sort >archived
(git -C source ls-files && echo PKG-INFO) | LC_ALL=C sort >tracked
check "the source archive has the tracked files" sh -c 'LC_ALL=C sort archived | cmp - tracked'

rm empty/lib/python3*/site-packages/mxgen/libmxgen.so
check "an import fails without the library" exits 1 installed -c 'import mxgen'
check "the error names the library" grep 'ImportError: mxgen cannot load its library' err
finish python-wheel
