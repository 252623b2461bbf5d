#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Every C and C++ file is formatted as .clang-format says. Argument: the root of the project.
cd "$1" || exit 1
command -v clang-format >/dev/null || { echo "skip: clang-format is not installed"; exit 77; }
git rev-parse --git-dir >/dev/null 2>&1 || { echo "skip: no git checkout, so no list of files"; exit 77; }
files=$(git ls-files '*.c' '*.h' '*.cpp' | wc -l)
if script/format --check; then
    echo "format: $files passed, 0 failed"
else
    echo "format: 0 passed, 1 failed"
    exit 1
fi
