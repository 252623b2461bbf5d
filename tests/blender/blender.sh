#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A test in Blender, without a display. Arguments: a folder with the Python package, the root of the project, the program, the script.
package=$1 root=$2 program=$(realpath "$3") script=$4
command -v blender >/dev/null || { echo "skip: blender is not installed"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Blender's own Python decides whether the package fits.
PYTHONPATH=$package PATH=$(dirname "$program"):$PATH HOME=$work blender --background --factory-startup --python-use-system-env --python-exit-code 1 \
    --python "$script" -- "$root" "$program" "$work" >"$work/log" 2>&1
status=$?
grep -v '^Info:\|^Blender \|^Fra:\|^Saved: \| Time: \|^$' "$work/log"
grep -q '^blender.* passed' "$work/log" || exit 1
exit $status
