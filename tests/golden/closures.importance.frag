#version 450
// Varnish · surfacematerial · mxgen 0.1 · vulkan · complete · 2 closures · 0 textures

struct mx_GgxLobe {
    vec3 N;
    float cosine;
    vec3 x;
    vec2 alpha;
    float masking;
};
struct mx_GgxSamples {
    mat3 to_map;
    vec3 stretch;
    float area;
    vec3 v;
    float masking;
    vec3 top;
    float step;
    float weight;
};
struct mx_GgxFacet {
    vec3 h;
    float shrink;
    float spread;
};
struct mx_GgxLight {
    vec3 color;
    float weight;
    float cosine;
};
layout(set = 0, binding = 1, std140) uniform PublicUniforms {
    float SR_varnish_opacity;
};
layout(set = 0, binding = 0, std140) uniform PrivateUniforms {
    mat4 u_worldMatrix;
    mat4 u_worldInverseTransposeMatrix;
    mat4 u_viewProjectionMatrix;
    vec3 u_viewPosition;
    int u_numActiveLightSources;
    mat4 u_envMatrix;
    int u_envRadianceMips;
    int u_envRadianceSamples;
    float u_envLightIntensity;
    float u_alphaThreshold;
};
struct LightData {
    int type;
    vec3 direction;
    vec3 color;
    float intensity;
    vec3 position;
    float decay_rate;
    float inner_angle;
    float outer_angle;
};
layout(set = 0, binding = 2, std140) uniform LightData_block { LightData u_lightData[3]; };
layout(set = 0, binding = 3) uniform sampler2D u_envRadiance;
layout(set = 0, binding = 4) uniform sampler2D u_envIrradiance;
layout(location = 0) in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
} vd;
layout(location = 0) out vec4 out1;

// A polynomial of two variables, what directional albedos are fitted by (the programs in fits/).
float mx_bicubic(const mat4 m, const float x)
{
    return dot(vec4(1.0, x, x * x, x * x * x), m * vec4(1.0, 0.04, 0.0016, 0.000064));
}

// The program fits/ggx.c makes the constants. x is never too small by more than 0.001, so that giving lost energy back
// adds none. `u` follows what happens where light grazes the facets.
vec2 mx_ggx_albedo_fit(const float u, const float c)
{
    float x = clamp(1.0 - c - 0.04 * mx_bicubic(mat4(-0.2006, 5.2916, -3.7565, 0.218, -10.2439, 6.6203, -0.9657, 2.5694,
        38.3042, -80.8059, 71.731, -28.5214, -34.2, 89.1079, -88.4065, 33.782), u), 0.0, 1.0);
    return vec2(min(1.0046 - u * mx_bicubic(mat4(-0.1447, 2.759, -5.4314, 2.8497, -0.9366, 1.4766, 0.5911, -1.0905,
        11.8506, -30.2645, 27.3289, -8.9414, -4.3199, 8.2596, -3.1648, -0.8054), u), 1.0), x * x * x * x * x);
}

mx_GgxLobe mx_ggx_lobe(const vec3 N, const vec3 V)
{
    float cosine = max(abs(dot(N, V)), 1e-8);
    return mx_GgxLobe(faceforward(N, -V, N), cosine, vec3(0.0), vec2(0.04),
        sqrt(cosine * cosine + 0.0016 * (1.0 - cosine * cosine)));
}

// The square of the length of a facet's normal H after its parts along the surface are divided by the roughness.
float mx_ggx_stretched(const mx_GgxLobe lobe, const float cos_h, const float square)
{
    return cos_h * cos_h + (square - cos_h * cos_h) / (lobe.alpha.x * lobe.alpha.x);
}

// The lobe towards L, but for Fresnel's factor: distribution and visibility over one divisor.
float mx_ggx_light(const mx_GgxLobe lobe, const vec3 V, const vec3 L)
{
    float area = lobe.alpha.x * lobe.alpha.y;
    float cos_l = max(dot(lobe.N, L), 1e-8);
    float square = 2.0 + 2.0 * dot(V, L);
    float e = mx_ggx_stretched(lobe, lobe.cosine + dot(lobe.N, L), square);
    return square * square * cos_l / (6.2831855 * area * e * e
        * (lobe.cosine * sqrt(cos_l * cos_l + area * (1.0 - cos_l * cos_l)) + cos_l * lobe.masking));
}

// Unpolarised Fresnel equations of a dielectric; the clamped root makes total internal reflection come out as 1.
float mx_fresnel_dielectric(const float cosine)
{
    float g = sqrt(2.1025 + cosine * cosine - 1.0);
    vec2 a = cosine * vec2(1.0, 2.1025);
    vec2 r = (a - g) / (a + g);
    return 0.5 * dot(r, r);
}

// atan(t) over pi for |t| <= 1, within 2.6e-5; the built-in function takes thrice as long.
float mx_half_turn(const float t)
{
    float t2 = t * t;
    return t * (0.3180596 + t2 * (t2 * (0.0465574 - 0.0124098 * t2) - 0.1022332));
}

// The point of the picture for a unit direction in it, to a tenth of a texel in 4096.
vec2 mx_map_point(const vec3 d)
{
    float radius = length(d.xz);
    float turn = mx_half_turn(d.x / max(abs(d.z) + radius, 1e-8));
    return vec2(fract(d.z > 0.0 ? -turn : 0.5 + turn), 0.5 - 2.0 * mx_half_turn(d.y / (1.0 + radius)));
}

// The frame of a round lobe has V above its x.
mx_GgxSamples mx_ggx_samples(const vec3 N, const vec3 V)
{
    mx_GgxLobe lobe = mx_ggx_lobe(N, V);
    vec3 x = normalize(V - lobe.cosine * lobe.N + 1e-6 * lobe.N.yzx);
    vec3 v = vec3(vec2(sqrt(max(1.0 - lobe.cosine * lobe.cosine, 0.0)), 0.0), lobe.cosine);
    vec3 stretch = vec3(lobe.alpha, 1.0);
    vec3 top = normalize(v * stretch) + vec3(0.0, 0.0, 1.0);
    float share = 1.0 / float(max(u_envRadianceSamples, 1));
    return mx_GgxSamples(mat3(u_envMatrix) * mat3(x, cross(lobe.N, x), lobe.N), stretch, stretch.x * stretch.y, v,
        lobe.masking, top, share * top.z, share * (v.z + lobe.masking));
}

// Light of a unit direction in the picture, filtered over the solid angle of a sample, in hemispheres (Krivanek and
// Colbert 2008; the mip level is equation 13 of GPU Gems 3, section 20.4).
vec3 mx_filtered_light(const vec3 d, const float spread)
{
    float level = 0.5 * log2(spread / length(d.xz));
    level += float(u_envRadianceMips) - 1.17425;
    return textureLod(u_envRadiance, mx_map_point(d), level).xyz;
}

// Height-correlated masking and shadowing G2 (Heitz 2014, equation 99) over 2 cos_v cos_l; half is left of the divisor
// of the reflection model.
float mx_ggx_visibility(const float cos_v, const float masking, const float area, const float cos_l)
{
    return 1.0 / (cos_v * sqrt(cos_l * cos_l + area * (1.0 - cos_l * cos_l)) + cos_l * masking);
}

// A normal of those visible from v, which is stretched by the roughness, before it is scaled to length 1 (Dupuy and
// Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps"): (cos, sin) of its turn around z, and how far the
// cap is below its top, `top` = v + z.
vec3 mx_ggx_cap(const vec2 around, const float depth, const vec3 top)
{
    return vec3(top.xy + sqrt(depth * (2.0 - depth)) * around, top.z - depth);
}

// Samples are spherical Fibonacci points (Marques et al. 2013): each is the golden angle further around the one before,
// by its `turn`.
mx_GgxFacet mx_ggx_facet(const mx_GgxSamples s, const int i, const vec2 turn)
{
    vec3 cap = mx_ggx_cap(turn, (float(i) + 0.5) * s.step, s.top);
    vec3 h = cap * s.stretch;
    float shrink = 1.0 / dot(h, h);
    float spread = shrink * dot(cap, cap);
    return mx_GgxFacet(h, shrink, spread * spread * s.weight * s.area);
}

// The light that the facet of sample i reflects.
mx_GgxLight mx_ggx_reflected(const mx_GgxSamples s, const int i, const vec2 turn)
{
    mx_GgxFacet facet = mx_ggx_facet(s, i, turn);
    float cosine = dot(s.v, facet.h);
    vec3 l = 2.0 * facet.shrink * cosine * facet.h - s.v;
    float cos_l = max(l.z, 1e-8);
    return mx_GgxLight(mx_filtered_light(s.to_map * l, facet.spread), s.weight * u_envLightIntensity * cos_l
        * mx_ggx_visibility(s.v.z, s.masking, s.area, cos_l), clamp(cosine * sqrt(facet.shrink), 1e-8, 1.0));
}

void main()
{
    vec3 color = vec3(0.0);
    // lights
    vec3 normal_N = normalize(vd.normalWorld);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    float cos_v = max(abs(dot(normal_N, V)), 1e-8);
    vec2 albedo = mx_ggx_albedo_fit(0.04 / (cos_v + 0.04), cos_v);
    float scale = (1.0 / albedo.x - 1.0) * 0.079748526 + 1.0;
    mx_GgxLobe lobe = mx_ggx_lobe(normal_N, V);
    vec3 scaled_paint_weight = (1.0 - mix(0.033735953, 1.0, albedo.y) * albedo.x * scale) * 0.75 * vec3(0.6, 0.1, 0.05);
    vec3 N = faceforward(normal_N, -V, normal_N);
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        // coat, paint
        int type = u_lightData[i].type;
        vec3 d = u_lightData[i].position - vd.positionWorld;
        float ratio = u_lightData[i].intensity / pow(length(d) + 1.0, u_lightData[i].decay_rate);
        float spot_light_difference = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
        vec3 to_light = normalize(d);
        float spot_light_choice = type == 3
            ? smoothstep(spot_light_difference, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, to_light))
            * ratio : 0.0;
        float point_light_choice = type == 2 ? ratio : spot_light_choice;
        vec3 L = type == 1 ? -u_lightData[i].direction : to_light;
        float v_dot_l = dot(V, L);
        float fresnel = mx_fresnel_dielectric(sqrt(clamp(v_dot_l * 0.5 + 0.5, 1e-8, 1.0)));
        float cos_l = max(dot(L, N), 1e-8);
        vec3 paint_response = scaled_paint_weight
            * (cos_l / 3.1415927 * (max(v_dot_l - cos_v * cos_l, 0.0) * 0.225 / max(cos_l, cos_v) + 0.89285713));
        vec3 product = u_lightData[i].color * (scale * mx_ggx_light(lobe, V, L) * fresnel + paint_response);
        color += (type == 1 ? u_lightData[i].intensity : point_light_choice) * product;
    }
    // environment
    // paint
    vec3 paint_product = scaled_paint_weight
        * textureLod(u_envIrradiance, mx_map_point(normalize((u_envMatrix * vec4(N, 0.0)).xyz)), 0.0).xyz;
    vec2 fit = (cos_v * vec2(-0.7632, -0.4993) - vec2(0.4297, 0.6076) + vec2(0.43155, 0.60945)) * 0.3 + vec2(1.0);
    color += paint_product * (clamp(fit.x / fit.y, 0.0, 1.0) * u_envLightIntensity);
    // coat
    mx_GgxSamples coat_ggx_samples = mx_ggx_samples(normal_N, V);
    vec2 turn = vec2(1.0, 0.0);
    for (int i = 0; i < u_envRadianceSamples; ++i) {
        mx_GgxLight light = mx_ggx_reflected(coat_ggx_samples, i, turn);
        color += light.color * (light.weight * (scale * mx_fresnel_dielectric(light.cosine)));
        turn = turn * -0.7373689 + vec2(-turn.y, turn.x) * 0.6754903;
    }
    // opacity
    if (SR_varnish_opacity < u_alphaThreshold)
        discard;
    out1 = vec4(SR_varnish_opacity * color, SR_varnish_opacity);
}
