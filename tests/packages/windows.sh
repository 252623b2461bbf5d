#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The library for Windows: built by clang with mingw-w64 without warnings, its unit tests under wine, and a program in C with the DLL, which writes the
# shader that it writes here. Arguments: the root of the project, the packed node library, the same program for this machine.
root=$1 image=$(realpath "$2") program=$(realpath "$3")
. "$(dirname "$0")/../programs/common.sh"
for tool in clang x86_64-w64-mingw32-ld wine meson; do
    command -v "$tool" >/dev/null || { echo "skip: $tool is not installed (script/packages-reach.txt)"; exit 77; }
done
[ -d "$root/build-libxml2" ] || { echo "skip: script/sources has not run"; exit 77; }
export WINEPREFIX=$work/wine WINEDEBUG=-all

check "the build is configured" meson setup build "$root" --cross-file "$root/script/windows.ini" "-Dimage=$image" -Dwerror=true
check "the library and its tests compile without warnings" ninja -C build
wineboot >/dev/null 2>&1
check "the unit tests pass" meson test -C build --num-processes 2
grep -ho '^[a-z_]*: [0-9]* passed' build/meson-logs/testlog.txt | awk '{ sum += $2 } END { print "under wine: " sum " checks" }'
check "the library for Windows needs Windows alone" sh -c '! x86_64-w64-mingw32-objdump -p build/libmxgen-0.dll | grep "DLL Name" | grep -v "KERNEL32.dll\|msvcrt.dll"'
# shellcheck disable=SC2046
check "a program in C compiles" clang $(sed -n "s/^\(target\|libgcc\) = '\(.*\)'/\2/p" "$root/script/windows.ini") "-I$root/include" "$root/examples/c_minimal.c" \
    build/libmxgen.dll.a -o build/c_minimal.exe
# Paths with backslashes: the document includes a file beside it.
mkdir folder
cp "$root/examples/gold.mtlx" folder
echo '<materialx version="1.39"><xi:include xmlns:xi="http://www.w3.org/2001/XInclude" href="gold.mtlx"/></materialx>' >folder/main.mtlx
check "the program runs on Windows" exits 0 wine build/c_minimal.exe 'folder\main.mtlx'
tr -d '\r' <out >windows.out
check "it runs here" exits 0 "$program" folder/main.mtlx
check "the shader is the same" cmp out windows.out
wineserver -k
wineserver -w
finish windows
