# SPDX-License-Identifier: Apache-2.0
# Sourced by the tests of programs: `check` counts, `finish NAME` prints the line that script/test sums up.
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

skip() {
    skipped=$((skipped + 1))
    printf 'skip: %s\n' "$1"
}

finish() {
    printf '%s: %d passed, %d failed, %d skipped\n' "$1" "$passed" "$failed" "$skipped"
    [ "$failed" -eq 0 ]
    exit
}
