#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds mxgen from the sources of the action, for a machine with Debian or Ubuntu, and adds it to the path of the next steps. A machine
# that has mxgen keeps it.
set -euo pipefail
command -v mxgen >/dev/null && exit
source=$(realpath "$(dirname "$0")/..") build=${RUNNER_TEMP:-/tmp}/mxgen-build
packages=(gcc g++ meson ninja-build pkg-config libxml2-dev libjansson-dev libmd-dev glslang-dev glslang-tools spirv-tools)
root=()
[ "$(id -u)" -eq 0 ] || root=(sudo)
"${root[@]}" apt-get update -q
"${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${packages[@]}"
meson setup "$build" "$source" -Dbuildtype=release -Drender=disabled -Dpython=disabled -Dwasm=disabled
ninja -C "$build" mxgen mxgen-check
echo "$build" >>"$GITHUB_PATH"
