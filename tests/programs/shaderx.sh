#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Documents that compile for all targets, and films on BSDFs. Arguments: mxgen, mxgen-compile, the document of films, more documents.
here=$(cd "$(dirname "$0")" && pwd)
mxgen=$(realpath "$1") compile=$(realpath "$2") films=$(realpath "$3")
shift 3
. "$here/common.sh"
for document in "$@" "$films"; do
    check "${document##*/} compiles" exits 0 "$compile" "$document"
    check "${document##*/} has shaders" test -s out
done

functions() { grep -o '\<mx_[a-z_]*(' "$1" | sort -u; } # FILE
for target in glsl osl; do
    check "films are generated for $target" exits 0 "$mxgen" "$films" --target $target --interface reduced --names neutral --no-comments -o $target
    for over in $target/Over_*; do
        own=${over/Over_/Own_}
        case $over in
            *varnished*) check "${over#*/} has the functions of ${own#*/}" diff <(functions "$over") <(functions "$own") ;; # in another order
            *) check "${over#*/} is ${own#*/}" diff <(sed 's/Over_/Own_/g' "$over") "$own" ;;
        esac
    done
done
check 'the film is over the closure' grep -q 'mx_film_index(.*\.cosine)' glsl/Over_varnished.frag
check 'the closure below has no film' grep -q 'mx_fresnel_conductor(.*\.cosine)' glsl/Over_varnished.frag
finish shaderx-compile
