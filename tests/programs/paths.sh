#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Raster pictures against path-traced ones, of a sphere under the sky: the means agree within 3 percent. ../materials/paths.tsv lists the
# exceptions among MaterialX's examples: their ratio, options that make them agree (which proves the reason), and the reason.
# Arguments: mxgen-render, mean_ratio, the folder shared/materials.
render=$(realpath "$1") mean_ratio=$(realpath "$2") materials=$(realpath -m "$3")
here=$(cd "$(dirname "$0")" && pwd)
table=$here/../materials/paths.tsv
. "$here/light.sh"
export MESA_SHADER_CACHE_DISABLE=true

# compare NAME EXPECTED DOCUMENT [OF-WHAT-IS-DRAWN] [OF-WHAT-IS-TRACED] [LIGHTS]
compare() {
    local name=$1 expected=$2 document=$3 lights=${6:-none} samples='--samples 256'
    [[ ${4:-} != *'--environment none'* ]] || samples=
    rm -f drawn.exr traced.exr
    # shellcheck disable=SC2086 # arguments, divided by spaces
    check "$name is drawn" exits 0 "$render" "$document" -q -m sphere --lights "$lights" --size 64 $samples ${4:-} -o drawn.exr
    # shellcheck disable=SC2086
    check "$name is traced" exits 0 "$render" "$document" -q -m sphere --lights "$lights" --path-trace --paths 64 --size 64 ${5:-} -o traced.exr
    check "the means of $name agree" near "$("$mean_ratio" drawn.exr traced.exr)" "$expected" 0.03
}

# leaf NAME NODES [OF-WHAT-IS-DRAWN] [OF-WHAT-IS-TRACED] [LIGHTS]: a surface of the BSDF "bsdf".
leaf() {
    cat >"$1.mtlx" <<XML
<?xml version="1.0"?>
<materialx version="1.39">
  $2
  <surface name="S" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="bsdf"/></surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>
XML
    compare "$1" 1 "$1.mtlx" "${3:-}" "${4:-}" "${5:-none}"
}

if ! has_device "$render"; then
    skip 'there is no Vulkan device'
    finish paths
fi
leaf diffuse '<oren_nayar_diffuse_bsdf name="bsdf" type="BSDF"><input name="color" type="color3" value="0.8, 0.5, 0.2"/></oren_nayar_diffuse_bsdf>'
leaf mirror '<conductor_bsdf name="bsdf" type="BSDF"><input name="roughness" type="vector2" value="0.0004, 0.0004"/></conductor_bsdf>'
leaf layered '<dielectric_bsdf name="coat" type="BSDF"/><burley_diffuse_bsdf name="base" type="BSDF"/>
  <layer name="bsdf" type="BSDF"><input name="top" type="BSDF" nodename="coat"/><input name="base" type="BSDF" nodename="base"/></layer>'
leaf mixed '<conductor_bsdf name="metal" type="BSDF"/><oren_nayar_diffuse_bsdf name="base" type="BSDF"/>
  <mix name="bsdf" type="BSDF"><input name="fg" type="BSDF" nodename="metal"/><input name="bg" type="BSDF" nodename="base"/>
    <input name="mix" type="float" value="0.25"/></mix>'

# The second distribution of facets, narrow and wide, along and across.
beckmann='<input name="distribution" type="string" value="beckmann"/>'
leaf satin "<conductor_bsdf name='bsdf' type='BSDF'><input name='roughness' type='vector2' value='0.1, 0.1'/>$beckmann</conductor_bsdf>"
leaf brushed "<conductor_bsdf name='bsdf' type='BSDF'><input name='roughness' type='vector2' value='0.8, 0.3'/>$beckmann</conductor_bsdf>"

# The bound lights, which no sample finds: a drawn picture has no shadows, and a ball throws none on itself.
bound=directional_light,point_light,spot_light
leaf lit '<conductor_bsdf name="metal" type="BSDF"><input name="roughness" type="vector2" value="0.2, 0.2"/></conductor_bsdf>
  <oren_nayar_diffuse_bsdf name="base" type="BSDF"/><mix name="bsdf" type="BSDF"><input name="fg" type="BSDF" nodename="metal"/>
    <input name="bg" type="BSDF" nodename="base"/><input name="mix" type="float" value="0.25"/></mix>' '' '' $bound
cat >lamp.mtlx <<'XML'
<?xml version="1.0"?>
<materialx version="1.39">
  <conical_edf name="cone" type="EDF"><input name="inner_angle" type="float" value="10"/><input name="outer_angle" type="float" value="40"/></conical_edf>
  <light name="lamp" type="lightshader"><input name="edf" type="EDF" nodename="cone"/><input name="intensity" type="float" value="40"/></light>
  <standard_surface name="S" type="surfaceshader"/>
</materialx>
XML
compare lamp 1 lamp.mtlx '-e S --environment none' '-e S --environment none' lamp=2

# `--role path` keeps what MaterialX's rasters simplify.
leaf sheen '<sheen_bsdf name="bsdf" type="BSDF"/>' '--role path'
leaf zeltner '<sheen_bsdf name="bsdf" type="BSDF"><input name="mode" type="string" value="zeltner"/></sheen_bsdf>' \
    '--role path --size 96' # few pixels hold its rim
leaf burley '<burley_diffuse_bsdf name="bsdf" type="BSDF"><input name="roughness" type="float" value="1"/></burley_diffuse_bsdf>' '--role path'
leaf rough '<oren_nayar_diffuse_bsdf name="bsdf" type="BSDF"><input name="roughness" type="float" value="1"/></oren_nayar_diffuse_bsdf>' \
    '--role path'
leaf smooth '<oren_nayar_diffuse_bsdf name="bsdf" type="BSDF"/>' '--role path --interface complete' # that it is, the device alone knows
leaf film '<dielectric_bsdf name="coat" type="BSDF"><input name="thinfilm_thickness" type="float" value="420"/><input name="thinfilm_ior" type="float"
    value="2"/></dielectric_bsdf><oren_nayar_diffuse_bsdf name="base" type="BSDF"><input name="color" type="color3" value="0.8, 0.8, 0.8"/>
  </oren_nayar_diffuse_bsdf><layer name="bsdf" type="BSDF"><input name="top" type="BSDF" nodename="coat"/><input name="base" type="BSDF"
    nodename="base"/></layer>' '--role path'
leaf hair '<chiang_hair_bsdf name="bsdf" type="BSDF"/>' '--role path' '--as-drawn'

# A smooth solid, into which light goes and which it leaves.
leaf solid '<dielectric_bsdf name="bsdf" type="BSDF"><input name="roughness" type="vector2" value="0, 0"/><input name="scatter_mode"
    type="string" value="RT"/></dielectric_bsdf>' '' '--as-drawn'
leaf inner '<dielectric_bsdf name="bsdf" type="BSDF"><input name="roughness" type="vector2" value="0, 0"/><input name="scatter_mode"
    type="string" value="RT"/></dielectric_bsdf>' '--role path' # what is reflected inside of it, too

# Light that meets glass of one lobe that reflects over one that refracts comes out again: a ball of it is not seen in light from everywhere.
write_white white.hdr
cat >furnace.mtlx <<'XML'
<?xml version="1.0"?>
<materialx version="1.39">
  <standard_surface name="S" type="surfaceshader"><input name="base" type="float" value="0"/><input name="transmission" type="float" value="1"/>
    <input name="specular_roughness" type="float" value="0"/></standard_surface>
  <uniform_edf name="edf" type="EDF"/>
  <surface name="G" type="surfaceshader"><input name="edf" type="EDF" nodename="edf"/></surface>
</materialx>
XML
compare glass 1 furnace.mtlx '-e G' '-e S --environment white.hdr'
compare 'glass, drawn with the same laws,' 1 furnace.mtlx '-e S --environment white.hdr --role path' '-e S --environment white.hdr'

# A surface that moves: bumps, by their light, and a ball that shrinks, by its size.
compare displaced 1 "$here/../../examples/displaced.mtlx" '' '--bounces 1'
cat >ball.mtlx <<'XML'
<?xml version="1.0"?>
<materialx version="1.39">
  <uniform_edf name="edf" type="EDF"/>
  <surface name="S" type="surfaceshader"><input name="edf" type="EDF" nodename="edf"/></surface>
  <displacement name="D" type="displacementshader"><input name="displacement" type="float" value="-0.2"/></displacement>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/>
    <input name="displacementshader" type="displacementshader" nodename="D"/></surfacematerial>
</materialx>
XML
compare shrunk 1 ball.mtlx
mv traced.exr shrunk.exr
sed -i 's/value="-0.2"/value="0"/' ball.mtlx
compare 'not displaced' 1 ball.mtlx
check 'a ball that shrinks covers 0.8 squared, and a little less in perspective' near "$("$mean_ratio" shrunk.exr traced.exr)" 0.62 0.03

# Derivatives along the screen: a slope that glows in the colour of its normal (flat, it were 1.7 times as bright), and bumps.
cat >slope.mtlx <<'XML'
<?xml version="1.0"?>
<materialx version="1.39">
  <texcoord name="st" type="vector2"/>
  <separate2 name="s" type="multioutput"><input name="in" type="vector2" nodename="st"/></separate2>
  <multiply name="height" type="float"><input name="in1" type="float" nodename="s" output="outx"/><input name="in2" type="float" value="3"/></multiply>
  <heighttonormal name="n" type="vector3"><input name="in" type="float" nodename="height"/><input name="scale" type="float" value="16"/></heighttonormal>
  <convert name="color" type="color3"><input name="in" type="vector3" nodename="n"/></convert>
  <uniform_edf name="edf" type="EDF"><input name="color" type="color3" nodename="color"/></uniform_edf>
  <surface name="S" type="surfaceshader"><input name="edf" type="EDF" nodename="edf"/></surface>
  <noise2d name="bumps" type="float"><input name="texcoord" type="vector2" nodename="uv"/></noise2d>
  <multiply name="uv" type="vector2"><input name="in1" type="vector2" nodename="st"/><input name="in2" type="float" value="20"/></multiply>
  <heighttonormal name="bumpy" type="vector3"><input name="in" type="float" nodename="bumps"/><input name="scale" type="float" value="1.5"/></heighttonormal>
  <normalmap name="normal" type="vector3"><input name="in" type="vector3" nodename="bumpy"/></normalmap>
  <standard_surface name="B" type="surfaceshader"><input name="normal" type="vector3" nodename="normal"/>
    <input name="metalness" type="float" value="1"/></standard_surface>
</materialx>
XML
compare slope 1 slope.mtlx '-e S' '-e S'
compare bumps 1 slope.mtlx '-e B --size 64' '-e B --size 64 --as-drawn'

# A surface that is not there, and one that glows.
cat >clear.mtlx <<'XML'
<?xml version="1.0"?>
<materialx version="1.39">
  <uniform_edf name="edf" type="EDF"><input name="color" type="color3" value="3, 2, 1"/></uniform_edf>
  <surface name="S" type="surfaceshader"><input name="edf" type="EDF" nodename="edf"/><input name="opacity" type="float" value="1"/></surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>
XML
compare glow 1 clear.mtlx
sed -i 's/"opacity" type="float" value="1"/"opacity" type="float" value="0"/' clear.mtlx
check 'a clear ball is traced' exits 0 "$render" clear.mtlx -m sphere --path-trace --paths 4 --size 8 -o clear.ppm --background none
check 'a clear ball is invisible' test "$(tail -c 192 clear.ppm | od -An -tu1 -v | tr -d ' 0\n')" = ''
check 'no paths are wrong usage' exits 2 "$render" clear.mtlx --path-trace --paths 0 -o x.png
check 'a turntable of paths is wrong usage' exits 2 "$render" clear.mtlx --path-trace --turntable 2 -o x.png

examples=$materials/resources/Materials/Examples
[ -d "$examples" ] || { skip "there is no folder $examples"; finish paths; }
declare -A row
while IFS= read -r line; do
    name=${line%%$'\t'*}
    row[$name]=${line//$'\t'/|}
done < <(sed 1d "$table")
for document in "$examples"/*/*.mtlx; do
    name=${document#"$examples"/}
    case $name in *chess_set* | *look*) continue ;; esac
    IFS=\| read -r -a columns <<<"${row[$name]:-}"
    compare "$name" "${columns[1]:-1}" "$document"
    [ -z "${columns[1]:-}" ] || compare "$name, like with like" 1 "$document" "${columns[2]:-}" "${columns[3]:-}"
done

finish paths
