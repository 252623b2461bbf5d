# SPDX-License-Identifier: Apache-2.0
# The tests of programs source this file. `check` counts; `finish NAME` prints the line that script/test sums up and ends the test, with
# 77 (skipped) if nothing was checked.
set -u
passed=0 failed=0 skipped=0
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

# check WHAT COMMAND...: counts whether the command succeeds.
check() {
    local what=$1
    shift
    if "$@" >check.log 2>&1; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        printf 'failed: %s\n' "$what"
        sed 's/^/    /' check.log
    fi
}

# exits CODE COMMAND...: the command's output goes to the files out and err.
exits() {
    local code=$1 got=0
    shift
    "$@" >out 2>err || got=$?
    [ "$got" -eq "$code" ] && return
    printf 'exit code %s instead of %s of: %s\n' "$got" "$code" "$*"
    cat err
    return 1
}

# has FILE TEXT...: the file has all of the texts.
has() {
    local file=$1 text
    shift
    for text in "$@"; do grep -qF -- "$text" "$file" || { echo "no '$text' in:" && cat "$file" && return 1; }; done
}

skip() {
    skipped=$((skipped + 1))
    printf 'skip: %s\n' "$1"
}

# has_device RENDERER...: whether the program finds a Vulkan device.
has_device() {
    echo '<materialx version="1.39"><position name="p" type="vector3"/><output name="o" type="vector3" nodename="p"/></materialx>' >device.mtlx
    "$@" device.mtlx --scene grid >device.out 2>&1 || ! grep -q no-device device.out
}

finish() {
    printf '%s: %d passed, %d failed, %d skipped\n' "$1" "$passed" "$failed" "$skipped"
    [ $((passed + failed)) -gt 0 ] || exit 77
    [ "$failed" -eq 0 ]
    exit
}
