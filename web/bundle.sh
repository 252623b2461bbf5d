#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Bundles the page: the module of WebAssembly goes into the worker, and the worker into the page, so that the page needs no server.
# Arguments: esbuild, the folder web, the built npm package, the module, the output.
set -eu
esbuild=$1 web=$2 package=$3 module=$4 output=$(realpath -m "$5")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# The built package lies where the sources expect it.
mkdir -p "$work/js" "$work/node_modules"
cp -r "$web" "$work/web"
cp -r "$package" "$work/js/mxgen"
cp -r "$web/../examples" "$work/examples"
gzip -9 -n -c "$module" >"$work/node_modules/mxgen.wasm.gz"
cd "$work"
bundle() { # OUTPUT INPUT
    "$esbuild" "$2" --bundle --minify --format=iife --target=es2022 --loader:.gz=binary --loader:.mtlx=text --loader:.bundle.js=text \
        --log-level=warning --outfile="$1"
}
bundle node_modules/worker.bundle.js web/worker.js
bundle "$output" web/page.js
