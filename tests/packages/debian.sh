#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The Debian packages: built from the tracked files, judged by lintian, unpacked together in an empty folder, and used there.
# Argument: the root of the project.
root=$1
. "$(dirname "$0")/../programs/common.sh"
for tool in dpkg-buildpackage dh dh_python3 lintian; do
    command -v "$tool" >/dev/null || { echo "skip: $tool is not installed"; exit 77; }
done
git -C "$root" rev-parse --git-dir >/dev/null 2>&1 || { echo "skip: no git checkout, so no list of files"; exit 77; }

# Runs a command with the unpacked packages.
unpacked() {
    LD_LIBRARY_PATH=$(dirname "$work"/system/usr/lib/*/libmxgen.so.0) PYTHONPATH=$work/system/usr/lib/python3/dist-packages \
        PATH=$work/system/usr/bin:$PATH "$@"
}

mkdir source system
git -C "$root" ls-files -z | (cd "$root" && xargs -0 cp --parents -t "$work/source")
check "dpkg-buildpackage makes the packages" env -C source dpkg-buildpackage -us -uc -b
for package in libmxgen0 libmxgen-dev mxgen python3-mxgen; do
    check "$package is made" ls "$package"_*.deb
    check "the package $package unpacks" dpkg-deb -x "$package"_*.deb system
    dpkg-deb -c "$package"_*.deb | awk '$6 !~ /\/$/ { print $6 }' >>files
done
check "lintian finds no fault" lintian --allow-root --fail-on error,warning ./*.changes
sort files | uniq -d >twice
check "no file is in two packages" cmp twice /dev/null
check "the program runs" unpacked mxgen "$root/examples/gold.mtlx" -o program
check "the Python package runs" unpacked /usr/bin/python3 "$root/examples/shader.py" "$root/examples/gold.mtlx" glsl
sed -i 's|prefix=/usr|prefix='"$work"'/system/usr|' system/usr/lib/*/pkgconfig/mxgen.pc
flags=$(PKG_CONFIG_PATH=$(echo system/usr/lib/*/pkgconfig) pkg-config --cflags --libs mxgen)
# shellcheck disable=SC2086
check "a program in C compiles" cc "$root/examples/c_minimal.c" -o c_minimal $flags
cp "$root/examples/gold.mtlx" .
check "the program in C runs" unpacked ./c_minimal gold.mtlx
check "the program in C uses the shared library" sh -c 'objdump -p c_minimal | grep -q "NEEDED *libmxgen.so.0"'
dpkg-deb -f mxgen_*.deb Built-Using >built-using
for library in glslang jansson libmd spirv-tools; do
    check "the programs name $library, which they contain" grep -q "\<$library (= " built-using
done
check "its licence comes with them" grep -q 'BSD-3-clause' system/usr/share/doc/mxgen/copyright.glslang-dev
check "the man page is there" ls system/usr/share/man/man1/mxgen.1.gz
finish debian
