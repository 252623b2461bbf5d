#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Values of shaders in MSL that call functions of their host, computed on the CPU. Argument: mxgen.

The numbers follow from the closures: a diffuse surface sends color / pi of a light, and color of an even sky; a white mirror sends what is
in the direction of the mirror ray."""
import ctypes
import math
import shutil
import subprocess
import sys
import tempfile

from draw import COMPILE

HOST = """#include <metal_stdlib>
using namespace metal;
struct MxgHost {
    int2 mxg_pixel;
    float strength;
    int mxg_light_count() { return 2; }
    void mxg_light(int i, float3 P, thread float3& L, thread float3& radiance)
    {
        L = i == 0 ? float3(0.0, 0.6, 0.8) : float3(0.6, 0.0, -0.8);
        radiance = strength * float3(1.0, 2.0, 4.0);
    }
    float mxg_shadow(int i, float3 P, float3 N, float3 L) { return i == 0 ? 0.25 * N.z : 0.5 * L.z; }
    float mxg_ambient_occlusion(float3 P, float3 N) { return 0.5 * N.z; }
    float3 mxg_irradiance(float3 P, float3 N) { return strength * (N + float3(mxg_pixel.x, 0.0, 0.0)); }
    float3 mxg_radiance(float3 P, float3 L, float roughness) { return strength * float3(L.z, mxg_pixel.y, roughness); }
};
"""
# The view is along z, and the pixel (3, 5). Directional lights shine along -z.
RUN = """
extern "C" void run(float *out)
{
    const MxgHost host = {{0, 0}, 0.5};
    UNIFORMS
    VertexData vd{};
    vd.pos = {3.5, 5.5, 0.5, 1.0};
    vd.normalWorld = {0.0, 0.0, 1.0};
    float4 color = FragmentMain(vd, ARGUMENTS).out1;
    __builtin_memcpy(out, &color, sizeof color);
}
"""
VIEW = """PrivateUniforms u_prv{};
    u_prv.u_viewPosition = {0.0, 0.0, 3.0};"""
LIGHTS = VIEW + """
    u_prv.u_numActiveLightSources = 2;
    LightData_pixel u_lightData{};
    for (int i = 0; i < 2; i++) {
        u_lightData.u_lightData[i].type = 1;
        u_lightData.u_lightData[i].direction = {0.0, 0.0, -1.0};
        u_lightData.u_lightData[i].color = {1.0, 2.0, 4.0};
        u_lightData.u_lightData[i].intensity = 1.0;
    }"""
DOCUMENT = """<materialx version="1.39">
  <oren_nayar_diffuse_bsdf name="chalk" type="BSDF"><input name="color" type="color3" value="0.8, 0.4, 0.2"/></oren_nayar_diffuse_bsdf>
  <generalized_schlick_bsdf name="mirror" type="BSDF"><input name="color0" type="color3" value="1, 1, 1"/>
    <input name="roughness" type="vector2" value="0, 0"/></generalized_schlick_bsdf>
  <surface name="Chalk" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="chalk"/></surface>
  <surface name="Mirror" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="mirror"/></surface>
</materialx>
"""
CHALK, LIGHT = (0.8, 0.4, 0.2), (1.0, 2.0, 4.0)
CASES = [
    ('lights: the second is below the surface', 'Chalk', ['--host-lights', '--environment', 'none'], [0.5 * 0.8 * c * l / math.pi for c, l in zip(CHALK, LIGHT)]),
    ('shadows', 'Chalk', ['--host-shadows', '--environment', 'none'], [(0.25 + 0.5) * c * l / math.pi for c, l in zip(CHALK, LIGHT)]),
    ('an even sky and its occlusion, in a pixel', 'Chalk', ['--host-environment', '--host-occlusion', '--lights', 'none'], [0.5 * 0.5 * 0.8 * 3.0, 0.0, 0.5 * 0.5 * 0.2]),
    ('the ray of a mirror, in a pixel', 'Mirror', ['--host-environment', '--lights', 'none'], [0.5, 0.5 * 5.0, 0.0]),
]


def color_of(mxgen, folder, element, options):
    subprocess.run([mxgen, f'{folder}/host.mtlx', '-e', element, '--target', 'msl', '--interface', 'reduced', '-q', '-o', folder] + options, check=True)
    with open(f'{folder}/{element}.frag.metal', encoding='utf-8') as file:
        source = file.read()
    parameters = source[source.index('fragment PixelOutputs FragmentMain('):].split(')\n{', 1)[0].split(',\n')[1:]
    names = [parameter.split(' [[')[0].split()[-1] for parameter in parameters]
    assert 'mxg_host' in names, names
    uniforms = LIGHTS if 'u_lightData' in names else VIEW if 'u_prv' in names else ''
    arguments = ', '.join('host' if name == 'mxg_host' else name for name in names)
    with open(f'{folder}/host.cpp', 'w', encoding='utf-8') as file:
        file.write(HOST + source + RUN.replace('UNIFORMS', uniforms).replace('ARGUMENTS', arguments))
    subprocess.run(COMPILE + [f'{folder}/host.cpp', '-lm', '-o', f'{folder}/{element}{len(options)}{options[0]}.so'], check=True)
    out = (ctypes.c_float * 4)()
    ctypes.CDLL(f'{folder}/{element}{len(options)}{options[0]}.so').run(out)
    return list(out)[:3]


def main():
    if not shutil.which('clang'):
        print('skip: without clang no MSL is computed')
        sys.exit(77)
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        with open(f'{folder}/host.mtlx', 'w', encoding='utf-8') as file:
            file.write(DOCUMENT)
        for name, element, options, expected in CASES:
            got = color_of(sys.argv[1], folder, element, options)
            good = all(abs(g - e) < 2e-3 * max(abs(e), 0.1) for g, e in zip(got, expected))
            failed += not good
            if not good:
                print(f'{name}: {got} instead of {expected}')
    print(f'msl-host: {len(CASES) - failed} passed, {failed} failed')
    sys.exit(1 if failed else 0)


main()
