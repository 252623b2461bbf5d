#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Documents that compile for all targets. Arguments: mxgen-compile, the documents.
here=$(cd "$(dirname "$0")" && pwd)
compile=$(realpath "$1")
shift
. "$here/common.sh"
for document in "$@"; do
    check "${document##*/}" exits 0 "$compile" "$document"
    check "${document##*/} has shaders" test -s out
done
finish shaderx-compile
