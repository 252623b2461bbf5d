# SPDX-License-Identifier: Apache-2.0
# The tests of mxgen-render source this file. Their first arguments are mxgen-render and mean_ratio.
render=$(realpath "$1") mean_ratio=$(realpath "$2")
here=$(cd "$(dirname "$0")" && pwd)
. "$here/light.sh"

# The driver would write its cache to the home folder.
export MESA_SHADER_CACHE_DISABLE=true

cat >plain.mtlx <<'X'
<?xml version="1.0"?>
<materialx version="1.39">
  <standard_surface name="SR" type="surfaceshader">
    <input name="base_color" type="color3" value="0.8, 0.8, 0.8"/>
  </standard_surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SR"/></surfacematerial>
</materialx>
X
