#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Bundles a script of the page. Arguments: esbuild, the folder web, the built npm package, the output: page.js, with its worker in it, or
# editor.js or studio.js, which need the packages of npm (package.json).
set -eu
esbuild=$1 web=$2 package=$3 output=$(realpath -m "$4")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# The built package lies where the sources expect it.
mkdir -p "$work/js" "$work/node_modules"
cp -r "$package" "$work/js/mxgen"
cp -r "$web/../examples" "$work/examples"
mkdir "$work/web"
cp -r "$web"/*.js "$web/editor" "$web/studio" "$work/web"
cd "$work"
bundle() { # OUTPUT INPUT
    NODE_PATH=$web/node_modules "$esbuild" "$2" --bundle --minify --format=iife --target=es2022 --loader:.mtlx=text --loader:.bundle.js=text \
        --log-level=warning --outfile="$1"
}
case $output in
*/editor.js) bundle "$output" web/editor/editor.js ;;
*/studio.js)
    bundle node_modules/reader.bundle.js web/studio/reader.js
    bundle "$output" web/studio/studio.js
    ;;
*)
    bundle worker.js web/worker.js
    gzip -9n <worker.js | base64 -w0 >node_modules/worker.bundle.js # a third of its bytes
    bundle "$output" web/page.js
    ;;
esac
