// SPDX-License-Identifier: Apache-2.0
// Diffuse reflection of an opaque medium: the lobe of Chan 2018, "Material Advances in Call of Duty: WWII", over its directional albedo, which
// is 0.31 to 1.12. g is the gloss, 0 to 1.

#include "../pbrlib/shaders/diffuse.glsl"
#include "../pbrlib/shaders/ggx.glsl"

// Gloss of Chan's diffuse lobe for a roughness, 0 to 1 (Chan 2018, "Material Advances in Call of Duty: WWII").
float mx_chan_gloss(float roughness)
{
    float square = clamp(roughness * roughness, 1e-3, 1.0);
    return clamp(log2(2.0 / (square * square) - 1.0) / 18.0, 0.0, 1.0);
}

// Share of the smooth surface in Chan's lobe of gloss g.
float mx_chan_smoothness(float g)
{
    return clamp(2.2 * g - 0.5, 0.0, 1.0);
}

// Height and fall of the bump of light that a rough surface of gloss g sends back.
vec2 mx_chan_bump(float g)
{
    return vec2((34.5 * g - 59.0) * g + 24.5, max(73.2 * g - 21.2, 8.9));
}

// Part of the light that a smooth surface lets in or out at the cosine c.
float mx_chan_even(float c)
{
    return 1.0 - 0.75 * mx_power5(1.0 - c);
}

// 1 / (pi times the directional albedo) of Chan's lobe of gloss g at the cosine c, within 0.0012.
//
// The program fits/chan.c makes the constants.
float mx_chan_share(float c, float g)
{
    const mat4 FIT = mat4(0.711052, 0.000476, 0.474855, 0.026280, 0.152583, 0.003146, 1.026027, -0.718545, 0.102579, -0.004832, -2.223248,
                          0.347306, -0.053764, 0.001611, 2.069558, -0.492125);
    vec4 fit = FIT * vec4(1.0, c, c * c, c * c * c);
    vec2 bump = mx_chan_bump(g);
    float plain = mix(fit.x, 27.0 / 28.0 * mx_chan_even(c), mx_chan_smoothness(g)); // even: exactly, the mean of (1 - x)^5 is 1/21
    return 1.0 / (MX_PI * (plain + bump.x * exp2((8.9 - bump.y) * fit.z) * fit.y / (fit.w + c)));
}

// Chan's diffuse lobe of gloss g, times its directional albedo, for a light whose half vector has the cosine cos_d
// to V; `even` is the part that a smooth surface lets out to the viewer.
float mx_chan_lobe(float g, float cos_v, float cos_l, float cos_d, float even)
{
    vec2 bump = mx_chan_bump(g);
    float cos_h = min((cos_l + cos_v) / (2.0 * cos_d), 1.0); // V + L is 2 cos_d long
    float rough = cos_d + mx_power5(1.0 - cos_d);
    return max(mix(rough, even * mx_chan_even(cos_l), mx_chan_smoothness(g)) + bump.x * cos_d * exp2(-bump.y * sqrt(cos_h)), 0.0);
}

// Chan's diffuse lobe over its directional albedo, times the cosine of L, for the albedo 1.
float mx_chan(float g, vec3 N, vec3 V, vec3 L)
{
    float cos_v = mx_view_cosine(N, V);
    float cos_l = mx_facing_cosine(N, V, L);
    return mx_chan_lobe(g, cos_v, cos_l, mx_half_cosine(V, L), mx_chan_even(cos_v)) * cos_l * mx_chan_share(cos_v, g);
}

// The direction around which Chan's lobe of gloss g receives light: the normal, bent to the viewer as far as the
// mean direction of the lobe.
//
// Within 0.023 radians by the program fits/chan.c. A smooth surface does not bend it.
vec3 mx_chan_axis(float g, vec3 N, vec3 V)
{
    float s = mx_chan_smoothness(g);
    float c = mx_view_cosine(N, V);
    float bend = (0.4353 + c * (-0.7155 + 0.5624 * c)) * ((1.0 - 1.0850 * g) * (1.0 - 1.1414 * s * s));
    return mx_facing(N, V) + bend * V;
}
