#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# glints.sh RENDER MEAN_RATIO GLINT: glints and tints of slabs (docs/slabs.md). GLINT is the library's file of functions.
render=$(realpath "$1") mean_ratio=$(realpath "$2") glint=$(realpath "$3")
. "$(dirname "$0")/light.sh"
export MESA_SHADER_CACHE_DISABLE=true

draw() { # picture, document, material, options
    local picture=$1 document=$2 material=$3
    shift 3
    exits 0 "$render" "$document" -e "$material" -q -s 64 "$@" -o "$picture"
}
compare() { # picture, other picture, least and most of the ratio of their means
    "$mean_ratio" "$2" "$1" >ratio && python3 -c 'import sys
ratio, least, most = map(float, [open("ratio").read().split()[0], *sys.argv[1:]])
sys.exit(None if least <= ratio <= most else f"the ratio of means is {ratio}, not {least} to {most}")' "$3" "$4"
}

# The functions alone: the mean over many places of what the facets with one slope send, over that of countless facets, and of its square.
cp "$glint" .
cat >moments.glsl <<'END'
#include "glint.glsl"
void moments(vec2 uv, float density, float slope, out vec3 mean, out vec3 square)
{
    const int COUNT = 256;
    float sum = 0.0;
    float squares = 0.0;
    for (int i = 0; i < COUNT; ++i)
    {
        vec2 place = uv + 0.37 * vec2(float(i), float(i - i / 16 * 16) * 0.61);
        float turn = 6.2831853 * fract(0.618 * float(i) + uv.x);
        float g = mx_glints(slope * vec2(cos(turn), sin(turn)), density, place, vec4(0.013, 0.004, 0.002, 0.009));
        sum += g / float(COUNT);
        squares += g * g / float(COUNT);
    }
    mean = vec3(sum);
    square = vec3(squares);
}
END
moments() { # name, logarithm of the facets in a pixel, slope
    cat <<END
  <moments name="m_$1" type="multioutput">
    <input name="density" type="float" value="$(python3 -c "import math; print($2 - math.log(0.013 * 0.009))")"/>
    <input name="slope" type="float" value="$3"/>
  </moments>
  <surface_unlit name="Mean$1" type="surfaceshader"><input name="emission_color" type="color3" nodename="m_$1" output="mean"/></surface_unlit>
  <surface_unlit name="Square$1" type="surfaceshader"><input name="emission_color" type="color3" nodename="m_$1" output="square"/></surface_unlit>
END
}
{
    cat <<'END'
<materialx version="1.39">
  <nodedef name="ND_moments" node="moments">
    <input name="texcoord" type="vector2" defaultgeomprop="UV0"/>
    <input name="density" type="float" value="10"/>
    <input name="slope" type="float" value="0.5"/>
    <output name="mean" type="color3"/>
    <output name="square" type="color3"/>
  </nodedef>
  <implementation name="IM_moments" nodedef="ND_moments" file="moments.glsl" function="moments"/>
  <surface_unlit name="One" type="surfaceshader"/>
END
    moments Few 3 0.5
    moments Many 8 0.5
    moments Slanted 6 3
    moments Lobe 11.513 0
    moments Million 13.816 0
    moments Countless 17 0.3
    echo '</materialx>'
} >moments.mtlx
front=(-m plane --camera 0,0,2.6,30 --environment none)
check 'the value one is drawn' draw one.exr moments.mtlx One "${front[@]}"
for kind in Few Many Slanted Lobe Million Countless; do
    check "the mean of $kind is drawn" draw mean.exr moments.mtlx "Mean$kind" "${front[@]}"
    check "the mean of $kind is one" compare one.exr mean.exr 0.98 1.02
    check "the square of $kind is drawn" draw "$kind.exr" moments.mtlx "Square$kind" "${front[@]}"
done
# 20 facets, 1 in 1257 of which has the slope: the square is near 1257 / 20 times the share of cells in a pixel
check 'few facets glint' compare one.exr Few.exr 10 200
check 'more facets glint less' compare one.exr Many.exr 1.05 2
# one part in 804 of them mirrors: the square is 1 + variance
check '100,000 facets stray by 4 to 6 %, where OSL has the lobe' compare one.exr Lobe.exr 1.0012 1.0045
check '1,000,000 facets stray by less than 2 %' compare one.exr Million.exr 1.0002 1.0004
check 'countless facets do not stray' compare one.exr Countless.exr 0.999 1.001

# Pictures
paint() { # density
    sed "s/DENSITY/$1/" <<'END'
<materialx version="1.39">
  <slab name="flakes" type="BSDF">
    <input name="diffuse_albedo" type="color3" value="0, 0, 0"/>
    <input name="f0" type="color3" value="0.6, 0.3, 0.1"/>
    <input name="roughness" type="float" value="0.6"/>
    <input name="glint_density" type="float" value="DENSITY"/>
    <input name="specular_lut" type="filename" value="TABLE"/>
  </slab>
  <slab_surface name="Paint" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="flakes"/></slab_surface>
</materialx>
END
}
for density in 0 18 28; do
    paint "$density" | grep -v TABLE >"paint$density.mtlx"
    check "paint of density $density is drawn" draw "paint$density.exr" "paint$density.mtlx" Paint -m sphere --environment none
done
check 'paint from far away is GGX' compare paint0.exr paint28.exr 0.98 1.02
check 'paint from near has the mean of GGX' compare paint0.exr paint18.exr 0.85 1.15
check 'glints change the picture' eval '! cmp -s paint0.exr paint18.exr'
check 'paint is traced' draw traced.exr paint28.mtlx Paint -m sphere -s 24 --path-trace --paths 64
check 'paint is traced without glints' draw traced0.exr paint0.mtlx Paint -m sphere -s 24 --path-trace --paths 64
check 'traced glints do not change the mean' compare traced0.exr traced.exr 0.98 1.02

# White glints in a white furnace lose no light: pixels with about 40,000 and with 500 facets.
write_white white.hdr
for density in 20 17; do
    paint "$density" | grep -v TABLE | sed 's/0.6, 0.3, 0.1/1, 1, 1/' >white.mtlx
    check "white glints of density $density are traced" exits 0 "$render" white.mtlx -e Paint -q -m plane --camera 0,0,2.6,30 \
        --environment white.hdr --lights none -s $((density == 17 ? 160 : 80)) --path-trace --paths 96 -o white.exr
    check "white glints of density $density return all light" near "$(channel white.exr R)" 1 0.005
done

# Tints: an even one; one that follows the light; one that follows the view
table() { # name, value of the texel at view x and light y, 0 to 31
    python3 -c 'import sys
texels = [int(eval(sys.argv[1])) for y in reversed(range(32)) for x in range(32)]
open(sys.argv[2], "wb").write(b"P6 32 32 255\n" + bytes(t for t in texels for _ in range(3)))' "$2" "$1.ppm"
    paint 0 | sed "s/TABLE/$1.ppm/" >"$1.mtlx"
}
table even 102
table light 'y * 255 / 31'
table view 'x * 255 / 31'
paint 0 | grep -v TABLE >plain.mtlx
for kind in plain even; do
    check "a ball with the tint $kind is drawn" draw "$kind.exr" "$kind.mtlx" Paint -m sphere
done
check 'an even tint takes its part' compare plain.exr even.exr 0.39 0.41
for kind in plain light view; do
    for light in 0,0,-1 0.8,0,-0.6; do
        [ $kind != view ] || [ $light != 0,0,-1 ] || continue
        check "the tint $kind is drawn in light along $light" draw "$kind$light.exr" "$kind.mtlx" Paint "${front[@]}" --lights directional_light --set "u_lightData[0].direction=$light"
    done
done
check 'a tint has light along the normal' compare plain0,0,-1.exr light0,0,-1.exr 0.96 1
check 'a tint has slanted light' compare plain0.8,0,-0.6.exr light0.8,0,-0.6.exr 0.57 0.63
check 'a tint has the view along the normal' compare plain0.8,0,-0.6.exr view0.8,0,-0.6.exr 0.93 1
check 'an even tint is traced' draw traced.exr even.mtlx Paint -m sphere -s 24 --path-trace --paths 64
check 'a traced tint takes its part' compare traced0.exr traced.exr 0.39 0.41

finish glints
