#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs a release on an empty machine, whose root it is given, and runs each part. /release has the artefacts, and the examples.
set -eux
export DEBIAN_FRONTEND=noninteractive
cd /release
apt-get update -q
apt-get install -q -y --no-install-recommends python3-venv nodejs

# without Debian's packages of mxgen
python3 -m venv /wheel
/wheel/bin/pip install --no-index ./*.whl
/wheel/bin/python examples/shader.py examples/gold.mtlx glsl | grep '^void main'
mkdir -p /app/node_modules/mxgen
tar -xzf mxgen-*.tgz --strip-components=1 -C /app/node_modules/mxgen
cp examples/shader.mjs /app
node /app/shader.mjs examples/gold.mtlx essl | grep '^void main'

apt-get install -q -y --no-install-recommends ./*.deb gcc libc6-dev pkg-config mesa-vulkan-drivers
cd /
mxgen /release/examples/gold.mtlx -o out
mxgen check --target glsl /release/examples/gold.mtlx
mxgen render /release/examples/gold.mtlx --size 32x32 -o gold.png
test -s gold.png
/usr/bin/python3 /release/examples/shader.py /release/examples/gold.mtlx glsl | grep '^void main'
# shellcheck disable=SC2046
cc /release/examples/c_minimal.c -o c_minimal $(pkg-config --cflags --libs mxgen)
cp /release/examples/gold.mtlx .
./c_minimal gold.mtlx | grep '^void main'
