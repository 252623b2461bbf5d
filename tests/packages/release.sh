#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A release: made twice with equal bytes, checked, and its parts installed and run where nothing of mxgen is. Arguments: the root of the
# project, the program that the tests of packages compare with, Chromium or ''.
root=$1 program=$(realpath "$2") chromium=$3
. "$(dirname "$0")/../programs/common.sh"
for tool in dpkg-buildpackage dh dh_python3 npm esbuild zopfli wasm-ld; do
    command -v "$tool" >/dev/null || { echo "skip: $tool is not installed (script/packages-release.txt)"; exit 77; }
done
git -C "$root" rev-parse HEAD >/dev/null 2>&1 || { echo "skip: no git checkout, so no commit to release"; exit 77; }
[ -d "$root/build-libxml2" ] || { echo "skip: script/sources has not run"; exit 77; }
npm ping >/dev/null 2>&1 || { echo "skip: no registry of npm, so nothing to build the extension for VS Code with"; exit 77; }

check "two runs give the same bytes" "$root/script/release" --check release
check "a folder that exists stays as it is" exits 2 "$root/script/release" release
check "the checksums are right" env -C release sha256sum --strict -c SHA256SUMS
ls release | grep -v SHA256SUMS | sort >files
awk '{ print $2 }' release/SHA256SUMS | sort >summed
check "they are those of all files" diff files summed
check "the bill of materials names all files" "$root/tests/packages/sbom.py" release
git -C "$root" ls-tree -r --name-only HEAD | sort >tracked
grep -o 'release/mxgen[^ ]*' "$root/action/release.yml" >named
check "the workflow names files that are there" sh -c '[ -s named ] && ls -d $(cat named)'
tar -tJf release/mxgen-*.tar.xz | grep -v '/$' | sed 's|^[^/]*/||' | sort >archived
check "the source archive has the files of the commit" diff tracked archived
if command -v lintian >/dev/null; then
    check "lintian finds no fault" lintian --allow-root --fail-on error,warning release/*.deb
else
    skip "lintian is not installed"
fi

# An empty machine
cp -r "$root/examples" release
cp "$root/tests/packages/machine.sh" release
suite=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
if ! command -v mmdebstrap >/dev/null; then
    skip "mmdebstrap is not installed: nothing was installed on an empty machine"
elif ! mmdebstrap --variant=apt --include=ca-certificates "$suite" base.tar >base.log 2>&1; then
    skip "mmdebstrap makes no machine: $(tail -1 base.log)"
else
    check "an empty machine installs and runs all" mmdebstrap --variant=custom --setup-hook='tar -C "$1" -xf base.tar' \
        --customize-hook='copy-in release /' --customize-hook='chroot "$1" sh /release/machine.sh' --format=null "$suite"
fi

# Empty projects, with the tests of each package
check "an empty environment is made" python3 -m venv empty
check "pip installs the wheel" empty/bin/python -m pip install --no-index release/mxgen-*.whl
check "the tests pass with the installed wheel" empty/bin/python "$root/tests/python/run.py" "$root" "" "$program"
mkdir app page
echo '{ "type": "module" }' >app/package.json
check "npm installs the package" npm install --prefix app --offline --no-save ./release/mxgen-*.tgz
check "the tests pass with the installed package" node "$root/tests/js/run.mjs" app/node_modules/mxgen "$root" "$program"
if [ -n "$chromium" ]; then
    check "the page unpacks" python3 -m zipfile -e release/mxgen-page-*.zip page
    check "the tests pass with the page" node "$root/tests/web/run.mjs" "$work/page" "$chromium" "$root" "$program"
    check "the tests pass with the editor of the page" node "$root/tests/web/editor.mjs" "$work/page" "$chromium" "$root"
    check "the tests pass with the extension for VS Code" node "$root/tests/vscode/run.mjs" release/mxgen-vscode-*.vsix "$root" "$chromium" "$program"
else
    skip "chromium is not installed: the page and the extension for VS Code were not run"
fi
finish release
