// SPDX-License-Identifier: Apache-2.0
// sheen_bsdf: Conty and Kulla 2017, or Zeltner, Burley and Chiang 2022.

#include "environment.glsl"

// Directional albedo: a rational fit for Conty and Kulla, the Gaussian fit of Zeltner et al.'s table.
float mx_sheen_albedo(float c, float roughness, string mode)
{
    if (mode == "conty_kulla")
    {
        float r = roughness;
        vec2 fit = vec2(13.67300, 1.0)
                 + c * (vec2(-68.78018, 61.57746) + c * vec2(60.28956, 121.81241) + r * vec2(-905.00061, 2597.49308))
                 + r * (vec2(799.08825, 442.78211) + r * vec2(1086.96473, 3045.55075));
        return clamp(fit.x / fit.y, 0.0, 1.0);
    }
    float r = clamp(roughness, 0.01, 1.0);
    float width = r * (0.0206607 + 1.58491 * r) / (0.0379424 + r * (1.32227 + r));
    float mean = r * (-0.193854 + r * (-1.14885 + r * (1.7932 - 0.95943 * r * r))) / (0.046391 + r);
    float offset = r * (0.000654023 + r * (-0.0207818 + 0.119681 * r)) / (1.26264 + r * (-1.92021 + r));
    float x = (c - mean) / width;
    return exp(-0.5 * x * x) / (width * sqrt(2.0 * MX_PI)) + offset;
}

// Zeltner et al.: clamped cosine under the linear transform M^-1 = [a 0 b; 0 a 0; 0 0 1] in the plane of V and N.
float mx_sheen_zeltner(vec3 N, vec3 V, vec3 L, float c, float r)
{
    float a = (2.58126 * c + 0.813703 * r) * r / (1.0 + 0.310327 * c * c + 2.60994 * c * r);
    float b = sqrt(1.0 - c) * (r - 1.0) * r * r * r
            / (0.0000254053 + 1.71228 * c - 1.71506 * c * r + 1.34174 * r * r);
    vec3 l = mx_enter_frame(L, N, mx_tangent(N, V + 1e-5 * N.yzx));
    vec3 w = vec3(a * l.x + b * l.z, a * l.y, l.z);
    float scale = a / dot(w, w);
    return max(w.z, 0.0) / MX_PI * scale * scale;
}

vec3 mx_sheen_bsdf_eval(vec3 color, float roughness, vec3 N, string mode, vec3 V, vec3 L)
{
    vec3 n = mx_facing(N, V);
    float cos_v = mx_view_cosine(N, V);
    if (mode == "zeltner")
        return color * (mx_sheen_albedo(cos_v, roughness, mode)
                        * mx_sheen_zeltner(n, V, L, min(cos_v, 1.0), clamp(roughness, 0.01, 1.0)));

    // Distribution of Conty and Kulla, equation 2, over the smooth denominator of Neubelt and Pettineo 2013
    float cos_l = max(dot(n, L), MX_EPSILON);
    float cos_h = dot(n, normalize(L + V));
    float s = 1.0 / max(roughness, 0.005);
    float d = (2.0 + s) * pow(max(1.0 - cos_h * cos_h, 0.0), 0.5 * s) / (2.0 * MX_PI);
    return color * (d * cos_l / (4.0 * (cos_l + cos_v - cos_l * cos_v)));
}

vec3 mx_sheen_bsdf_environment(vec3 color, float roughness, vec3 N, string mode, vec3 V)
{
    vec3 n = mx_facing(N, V);
    return color * (mx_sheen_albedo(mx_view_cosine(N, V), roughness, mode) * mx_environment_irradiance(n));
}

vec3 mx_sheen_bsdf_throughput(vec3 color, float roughness, vec3 N, string mode, vec3 V)
{
    return vec3(1.0 - mx_sheen_albedo(mx_view_cosine(N, V), roughness, mode));
}
