#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# `meson install` into an empty folder: a program finds the library there by pkg-config and by CMake. Arguments: the build folder, the examples.
build=$1 examples=$2
. "$(dirname "$0")/common.sh"
if [ -n "${SANITIZER:-}" ]; then
    skip 'a library with a sanitizer is not installed'
    finish install
fi
check "meson installs the project" meson install -C "$build" --no-rebuild --quiet --destdir "$work/system"
package=$(find system -name mxgen.pc)
prefix=$(dirname "$package")/../../..
lib=$work/$(dirname "$(find system -name libmxgen.so)")

flags=$(PKG_CONFIG_SYSROOT_DIR=$work/system PKG_CONFIG_PATH=$(dirname "$package") pkg-config --cflags --libs mxgen)
# shellcheck disable=SC2086
check "a program compiles with pkg-config" cc "$examples/c_minimal.c" -o by_pkgconfig $flags
check "the program of pkg-config runs" env LD_LIBRARY_PATH="$lib" ./by_pkgconfig "$examples/gold.mtlx"

if command -v cmake >/dev/null; then
    cat >CMakeLists.txt <<EOF
cmake_minimum_required(VERSION 3.20)
project(host C)
find_package(mxgen 0.1 REQUIRED)
add_executable(by_cmake "$examples/c_minimal.c")
target_link_libraries(by_cmake mxgen::mxgen)
EOF
    check "CMake finds the package" cmake -S . -B cmake -DCMAKE_PREFIX_PATH="$work/$prefix"
    check "a program compiles with CMake" cmake --build cmake
    check "the program of CMake runs" cmake/by_cmake "$examples/gold.mtlx"
    sed -i 's/mxgen 0.1/mxgen 1.0/' CMakeLists.txt
    check "CMake refuses another major version" exits 1 cmake -S . -B other -DCMAKE_PREFIX_PATH="$work/$prefix"
else
    skip "cmake is not installed"
fi
finish install
