// SPDX-License-Identifier: Apache-2.0
// Functions that the nodes of bsdf.mtlx need beyond pbrlib.

#include "../pbrlib/shaders/optics.glsl"

// Roughness along tangent and bitangent. A negative anisotropy stretches along the bitangent.
vec2 mx_microfacet_roughness(float roughness, float anisotropy)
{
    vec2 alpha = mx_roughness_anisotropy(roughness, abs(anisotropy));
    return anisotropy < 0.0 ? alpha.yx : alpha;
}
