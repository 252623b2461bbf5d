#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Limits of a material of MDL, and its versions. Argument: mxgen.
mxgen=$(realpath "$1")
. "$(dirname "$0")/../programs/common.sh"

cat >gold.mtlx <<'END'
<materialx version="1.39">
  <standard_surface name="gold" type="surfaceshader"><input name="metalness" type="float" value="1"/></standard_surface>
  <viewdirection name="view" type="vector3"/>
  <output name="seen" type="vector3" nodename="view"/>
  <UsdUVTexture name="height" type="multioutput"/>
  <heighttonormal name="bumps" type="vector3"><input name="in" type="float" nodename="height" output="r"/></heighttonormal>
  <output name="slopes" type="vector3" nodename="bumps"/>
  <tangent name="second" type="vector3"><input name="index" type="integer" value="1"/></tangent>
  <output name="along" type="vector3" nodename="second"/>
  <constant name="word" type="string"><input name="value" type="string" value="x"/></constant>
  <output name="text" type="string" nodename="word"/>
  <constant name="grey" type="float"><input name="value" type="float" value="0.5"/></constant>
  <output name="glow" type="float" nodename="grey"/>
</materialx>
END
check 'a material knows no view' exits 1 "$mxgen" gold.mtlx --target mdl --element seen -o none
check 'the error says so' grep -q 'gold.mtlx:.*mdl has no viewPosition' err
check 'a material has no derivatives' exits 1 "$mxgen" gold.mtlx --target mdl --element slopes -o none
check 'the error says so' grep -q 'gold.mtlx:.*mdl has no slopes' err
check 'a tangent is that of the first coordinates, without derivatives' eval '"$mxgen" gold.mtlx --target mdl --element along -q -o along && grep -q "texture_tangent_u(0)" along/along.mdl && ! grep -q "slope" along/along.mdl'
check 'an AOV that a material cannot have is told' eval 'exits 0 "$mxgen" "$(dirname "$(realpath "$0")")/../golden/aov.mtlx" --target mdl -o aovs && grep -q "aov.mtlx:.* is left out: a material of MDL.*\[aov-left-out\]" err'
check 'a text is no light' exits 1 "$mxgen" gold.mtlx --target mdl --element text -o none
check 'a value is light' exits 0 "$mxgen" gold.mtlx --target mdl --element glow -o glow
check 'a value is the intensity of an edf' grep -q 'emission: material_emission(emission: surface_emission' glow/glow.mdl

# The colour of gltf_pbr's sheen is divided by its weight, which is 0 by default.
echo '<materialx version="1.39"><gltf_pbr name="plain" type="surfaceshader"/></materialx>' >plain.mtlx
check 'a colour over a weight of 0 is a number' eval '"$mxgen" plain.mtlx --target mdl --element plain -q -o plain && grep -q "tint: color(weight > 0.0 ? float3(sheen_color) / sheen_weight : float3(0.0))" plain/plain.mdl'

# Glass that is clear, and a body that scatters where it is asked for: shares of the light that enters.
check 'a surface refracts or scatters below' exits 0 "$mxgen" gold.mtlx --target mdl --element gold -o body
check 'a medium takes the share of the closure that has it' eval 'tr -d "\n " <body/gold.mdl | grep -q "product=(1.0-clamped_transmission/math::max(clamped_transmission+clamped_subsurface\*(1.0-thin)\*(1.0-clamped_transmission),1e-6))"'
check 'glass has no medium' eval 'sed "s/name=.metalness./name=\"transmission\"/" gold.mtlx >clear.mtlx && "$mxgen" clear.mtlx --target mdl --interface reduced --element gold -q -o clear && ! grep -q _coefficient clear/gold.mdl'

# A hard range holds the default: MDL refuses a value outside.
sed 's/name="metalness" type="float" value="1"/name="metalness" type="float" value="1.5"/' gold.mtlx >outside.mtlx
check 'a value outside of its range' exits 0 "$mxgen" outside.mtlx --target mdl --element gold --interface authored -o outside
check 'it has no hard range' eval 'grep -q "float metalness = 1.5 " outside/gold.mdl && ! grep -q "float metalness .*hard_range" outside/gold.mdl'
check 'a value inside of it has one' eval '"$mxgen" gold.mtlx --target mdl --element gold --interface authored -q -o inside && grep -q "float metalness = 1.0 .*hard_range(0.0, 1.0)" inside/gold.mdl'

# Names that begin as no identifier of MDL, and results in structs: the compiler of MDL reads the file where it is installed.
cat >names.mtlx <<'END'
<materialx version="1.39">
  <nodegraph name="_graph">
    <input name="_k" type="float" value="0.5"/>
    <sin name="mdl_s" type="float"><input name="in" type="float" interfacename="_k"/></sin>
    <multiply name="_m" type="float"><input name="in1" type="float" nodename="mdl_s"/><input name="in2" type="float" nodename="mdl_s"/></multiply>
    <output name="_o" type="float" nodename="_m"/>
  </nodegraph>
</materialx>
END
check 'names that begin with an underscore are generated' exits 0 "$mxgen" names.mtlx --target mdl --element _graph/_o -o made
check 'a material is exported by its name' grep -q '^export material x_graph_o(' made/_graph._o.mdl
check 'an input is a parameter with its default' grep -q 'float x_k = 0.5' made/_graph._o.mdl

cat >drive.mtlx <<'END'
<materialx version="1.39">
  <image name="picture" type="color3"><input name="file" type="filename" value="D:/textures/a:b.png"/></image>
  <output name="shown" type="color3" nodename="picture"/>
</materialx>
END
check 'a path with a drive is generated' exits 0 "$mxgen" drive.mtlx --target mdl --element shown -o made
check 'a path of MDL has no colon' grep -qF 'texture_2d("/D/textures/a_b.png", tex::gamma_linear)' made/shown.mdl

for version in 1.8 1.9 1.10; do
    check "a material in version $version is generated" exits 0 "$mxgen" gold.mtlx --target mdl --target-version "$version" --element gold -o made
    check "it is version $version" grep -qx "mdl $version;" made/gold.mdl
done
finish mdl-limits
