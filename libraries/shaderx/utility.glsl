// SPDX-License-Identifier: Apache-2.0
// reflectivity and edgetint: the way back from mx_artistic_ior (optics.glsl).

#include "../pbrlib/shaders/fresnel.glsl"

vec3 mx_reflectivity(vec3 ior, vec3 extinction)
{
    vec3 re, im;
    mx_permittivity(ior, extinction, re, im);
    return mx_fresnel_f0("conductor", re, im);
}

// Gulbrandsen 2014, section 3: where the index lies between the largest, (1 + sqrt r) / (1 - sqrt r), and the smallest,
// (1 - r) / (1 + r), that give the reflectance r. Both are 1 for r = 0, where any colour will do.
vec3 mx_edgetint(vec3 ior, vec3 reflectivity)
{
    vec3 r = clamp(reflectivity, 0.0, 0.99);
    vec3 s = sqrt(r);
    vec3 largest = (1.0 + s) * (1.0 + s) / (1.0 - r);
    vec3 smallest = (1.0 - r) / (1.0 + r);
    return clamp((largest - ior) / max(largest - smallest, MX_EPSILON), 0.0, 1.0);
}
