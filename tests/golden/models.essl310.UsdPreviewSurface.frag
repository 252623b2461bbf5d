#version 310 es
// UsdPreviewSurface · surfacematerial · mxgen 0.1 · essl310 · complete · 6 closures · 0 textures
precision highp float;
precision highp int;
precision highp sampler2D;

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
layout(binding = 1, std140) uniform PublicUniforms {
    vec3 SR_UsdPreviewSurface_diffuseColor;
    vec3 SR_UsdPreviewSurface_emissiveColor;
    int SR_UsdPreviewSurface_useSpecularWorkflow;
    vec3 SR_UsdPreviewSurface_specularColor;
    float SR_UsdPreviewSurface_metallic;
    float SR_UsdPreviewSurface_roughness;
    float SR_UsdPreviewSurface_clearcoat;
    float SR_UsdPreviewSurface_clearcoatRoughness;
    float SR_UsdPreviewSurface_opacity;
    int SR_UsdPreviewSurface_opacityMode;
    float SR_UsdPreviewSurface_opacityThreshold;
    float SR_UsdPreviewSurface_ior;
    vec3 SR_UsdPreviewSurface_normal;
};
layout(binding = 0, std140) uniform PrivateUniforms {
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
layout(binding = 2, std140) uniform LightData_block { LightData u_lightData[3]; };
layout(binding = 3) uniform sampler2D u_envRadiance;
layout(binding = 4) uniform sampler2D u_envIrradiance;
layout(location = 0) in vec3 vd_positionWorld;
layout(location = 1) in vec3 vd_normalWorld;
layout(location = 2) in vec3 vd_tangentWorld;
layout(location = 3) in vec3 vd_bitangentWorld;
layout(location = 0) out vec4 out1;

// A texel of zeros is a missing map, and means the normal itself.
vec3 mx_normalmap(const vec3 texel, const vec3 normal, const vec3 tangent, const vec3 bitangent)
{
    vec3 n = dot(texel, texel) == 0.0 ? vec3(0.0, 0.0, 1.0) : texel * 2.0 - vec3(1.0);
    return normalize(tangent * n.x + bitangent * n.y + normal * n.z);
}

// A polynomial of two variables, what directional albedos are fitted by (the programs in fits/).
float mx_bicubic(const mat4 m, const float x, const float y)
{
    return dot(vec4(1.0, x, x * x, x * x * x), m * vec4(1.0, y, y * y, y * y * y));
}

// The program fits/ggx.c makes the constants. x is never too small by more than 0.001, so that giving lost energy back
// adds none. `u` follows what happens where light grazes the facets.
vec2 mx_ggx_albedo_fit(const float a, const float u, const float c)
{
    float x = clamp(1.0 - c - a * mx_bicubic(mat4(-0.2006, 5.2916, -3.7565, 0.218, -10.2439, 6.6203, -0.9657, 2.5694,
        38.3042, -80.8059, 71.731, -28.5214, -34.2, 89.1079, -88.4065, 33.782), u, a), 0.0, 1.0);
    return vec2(min(1.0046 - u * mx_bicubic(mat4(-0.1447, 2.759, -5.4314, 2.8497, -0.9366, 1.4766, 0.5911, -1.0905,
        11.8506, -30.2645, 27.3289, -8.9414, -4.3199, 8.2596, -3.1648, -0.8054), u, a), 1.0), x * x * x * x * x);
}

vec3 mx_fresnel_schlick(const float cosine, const vec3 f0, const vec3 f90)
{
    float x = 1.0 - cosine;
    return mix(f0, f90, x * x * x * x * x);
}

mx_GgxLobe mx_ggx_lobe(const vec2 roughness, const vec3 N, const vec3 V)
{
    vec2 alpha = clamp(roughness, vec2(1e-8), vec2(1.0));
    float cosine = max(abs(dot(N, V)), 1e-8);
    return mx_GgxLobe(faceforward(N, -V, N), cosine, vec3(0.0), alpha,
        sqrt(cosine * cosine + alpha.x * alpha.y * (1.0 - cosine * cosine)));
}

// The lobe towards L, but for Fresnel's factor: distribution and visibility over one divisor.
float mx_ggx_light(const mx_GgxLobe lobe, const vec3 V, const vec3 L)
{
    vec3 slope = cross(V + L, lobe.N) / lobe.alpha.x;
    float area = lobe.alpha.x * lobe.alpha.y;
    float cos_l = max(dot(lobe.N, L), 1e-8);
    float cos_h = lobe.cosine + dot(lobe.N, L);
    float square = 2.0 + 2.0 * dot(V, L);
    float e = dot(slope, slope) + cos_h * cos_h;
    return square * square * cos_l / (6.2831855 * area * e * e
        * (lobe.cosine * sqrt(cos_l * cos_l + area * (1.0 - cos_l * cos_l)) + cos_l * lobe.masking));
}

// Gulbrandsen 2014, "Artist Friendly Metallic Fresnel": his r (n + 1)^2 - (n - 1)^2 is 0 at the greatest n and at 1
// over it, hence factors.
void mx_artistic_ior(const vec3 reflectivity, const vec3 edge_color, out vec3 ior, out vec3 extinction)
{
    vec3 s = sqrt(clamp(reflectivity, vec3(0.0), vec3(0.99)));
    vec3 greatest = (vec3(1.0) + s) / (vec3(1.0) - s);
    ior = mix(greatest, (vec3(1.0) - s * s) / (vec3(1.0) + s * s), edge_color);
    extinction = sqrt(max((greatest - ior) * (ior - vec3(1.0) / greatest), vec3(0.0)));
}

// The index times the cosine behind its interface: (u + iv)^2 = re + i im - sin^2.
vec2 mx_fresnel_refract(const float cosine, const float re, const float im)
{
    float t = re + (cosine * cosine - 1.0);
    float norm = sqrt(t * t + im * im);
    return sqrt(max(0.5 * vec2(norm + t, norm - t), vec2(0.0)));
}

// |(x + iy - u - iv) / (x + iy + u + iv)|^2
float mx_fresnel_ratio(const vec2 x, const vec2 u)
{
    return dot(x - u, x - u) / dot(x + u, x + u);
}

// Fresnel equations for a permittivity (Pharr et al. 2023, section 9.3.6): against u + iv stands the cosine in the
// perpendicular part, the permittivity times the cosine in the parallel part.
float mx_fresnel_conductor(const float cosine, const float re, const float im)
{
    vec2 u = mx_fresnel_refract(cosine, re, im);
    return 0.5 * (mx_fresnel_ratio(vec2(cosine, 0.0), u) + mx_fresnel_ratio(cosine * vec2(re, im), u));
}

// One channel after the other, which needs a third of the registers.
vec3 mx_fresnel_conductor(const float cosine, const vec3 re, const vec3 im)
{
    return vec3(mx_fresnel_conductor(cosine, re.x, im.x), mx_fresnel_conductor(cosine, re.y, im.y),
        mx_fresnel_conductor(cosine, re.z, im.z));
}

// The point of the picture for a unit direction in it.
vec2 mx_map_point(const vec3 d)
{
    vec2 a = abs(d.xz);
    float t = min(a.x, a.y) / max(max(a.x, a.y), 1e-8);
    float t2 = t * t;
    float turn = t * (0.1590298 + t2 * (t2 * (0.0232785 - 0.0062048 * t2) - 0.0511165));
    turn = a.x > a.y ? 0.25 - turn : turn;
    turn = d.z > 0.0 ? 0.5 - turn : turn;
    float y = abs(d.y);
    float height = sqrt(max(1.0 - y, 0.0)) * (0.4999879 + y * (y * (0.0244774 - 0.0066502 * y) - 0.0677603));
    return vec2(d.x < 0.0 ? 0.5 - turn : 0.5 + turn, d.y < 0.0 ? 1.0 - height : height);
}

// The frame of a round lobe has V above its x.
mx_GgxSamples mx_ggx_samples(const vec2 roughness, const vec3 N, const vec3 V)
{
    mx_GgxLobe lobe = mx_ggx_lobe(roughness, N, V);
    vec3 x = normalize(V - lobe.cosine * lobe.N + 1e-6 * lobe.N.yzx);
    vec3 v = vec3(vec2(sqrt(max(1.0 - lobe.cosine * lobe.cosine, 0.0)), 0.0), lobe.cosine);
    vec3 stretch = vec3(lobe.alpha, 1.0);
    vec3 top = normalize(v * stretch) + vec3(0.0, 0.0, 1.0);
    float share = 1.0 / float(max(u_envRadianceSamples, 1));
    return mx_GgxSamples(mat3(u_envMatrix) * mat3(x, cross(lobe.N, x), lobe.N), stretch, stretch.x * stretch.y, v,
        lobe.masking, top, share * top.z, share * (v.z + lobe.masking));
}

// Height-correlated masking and shadowing G2 (Heitz 2014, equation 99) over 2 cos_v cos_l; half is left of the divisor
// of the reflection model.
float mx_ggx_visibility(const float cos_v, const float masking, const float area, const float cos_l)
{
    return 1.0 / (cos_v * sqrt(cos_l * cos_l + area * (1.0 - cos_l * cos_l)) + cos_l * masking);
}

// Light of a unit direction in the picture, filtered over the solid angle of a sample, in hemispheres (Krivanek and
// Colbert 2008; the mip level is equation 13 of GPU Gems 3, section 20.4).
vec3 mx_filtered_light(const vec3 d, const float spread)
{
    return textureLod(u_envRadiance, mx_map_point(d),
        max(0.25 * log2(spread * spread / dot(d.xz, d.xz)) + float(u_envRadianceMips) - 1.17425, 0.0)).xyz;
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

// The light that the facet of sample i reflects, and in the fourth component the cosine at it.
vec4 mx_ggx_reflected(const mx_GgxSamples s, const int i, const vec2 turn)
{
    mx_GgxFacet facet = mx_ggx_facet(s, i, turn);
    float cosine = dot(s.v, facet.h);
    vec3 l = 2.0 * facet.shrink * cosine * facet.h - s.v;
    float cos_l = max(l.z, 1e-8);
    return vec4(s.weight * u_envLightIntensity * cos_l * mx_ggx_visibility(s.v.z, s.masking, s.area, cos_l)
        * mx_filtered_light(s.to_map * l, facet.spread), clamp(cosine * sqrt(facet.shrink), 1e-8, 1.0));
}

// Direction of the ray -v after it has entered the sphere at normal h and left it again.
vec3 mx_refract_sphere(const vec3 v, const vec3 h, const float ior)
{
    vec3 inside = refract(-v, h, 1.0 / ior);
    return refract(inside, normalize(inside * dot(inside, h) - 0.5 * h), ior);
}

// The light that comes through it and a solid sphere of an index behind it.
vec4 mx_ggx_transmitted(const mx_GgxSamples s, const float ior, const int i, const vec2 turn)
{
    mx_GgxFacet facet = mx_ggx_facet(s, i, turn);
    vec3 h = facet.h * sqrt(facet.shrink);
    return vec4(s.weight * u_envLightIntensity * 0.5 / s.v.z
        * mx_filtered_light(s.to_map * mx_refract_sphere(s.v, h, ior), facet.spread), clamp(dot(s.v, h), 1e-8, 1.0));
}

// Unpolarised Fresnel equations of a dielectric; the clamped root makes total internal reflection come out as 1.
float mx_fresnel_dielectric(const float cosine, const float ior)
{
    float g = sqrt(max(ior * ior + cosine * cosine - 1.0, 0.0));
    vec2 a = cosine * vec2(1.0, ior * ior);
    vec2 r = (a - g) / (a + g);
    return 0.5 * dot(r, r);
}

void main()
{
    vec3 color = SR_UsdPreviewSurface_emissiveColor;
    // lights
    // SR_UsdPreviewSurface
    vec3 shading_normal = mx_normalmap(SR_UsdPreviewSurface_normal * 0.5 + vec3(0.5), normalize(vd_normalWorld),
        normalize(vd_tangentWorld), normalize(vd_bitangentWorld));
    vec3 V = normalize(u_viewPosition - vd_positionWorld);
    vec3 N = faceforward(shading_normal, -V, shading_normal);
    float amplitude = (1.0 - SR_UsdPreviewSurface_ior) / (SR_UsdPreviewSurface_ior + 1.0);
    float coating_fresnel_facing = max(amplitude * amplitude, 0.0);
    float coat_roughness = clamp(SR_UsdPreviewSurface_clearcoatRoughness * SR_UsdPreviewSurface_clearcoatRoughness,
        1e-8, 1.0);
    float cos_v = max(abs(dot(shading_normal, V)), 1e-8);
    vec2 coating_albedo = mx_ggx_albedo_fit(coat_roughness, coat_roughness / (coat_roughness + cos_v), cos_v);
    float coating_scale = mix(coating_fresnel_facing, 1.0, 0.04761905) * (1.0 / coating_albedo.x - 1.0) + 1.0;
    float coating_difference = 1.0 - SR_UsdPreviewSurface_clearcoat
        * dot(vec3(mix(coating_fresnel_facing, 1.0, coating_albedo.y) * coating_albedo.x * coating_scale),
        vec3(0.33333334));
    bool is_equal_useSpecularWorkflow = SR_UsdPreviewSurface_useSpecularWorkflow == 1;
    vec3 grazing_metallic = mix(vec3(1.0), SR_UsdPreviewSurface_diffuseColor, SR_UsdPreviewSurface_metallic);
    vec3 reflection_fresnel_facing = max(is_equal_useSpecularWorkflow ? SR_UsdPreviewSurface_specularColor
        : mix(amplitude * amplitude * grazing_metallic, grazing_metallic, SR_UsdPreviewSurface_metallic), 0.0);
    vec3 f90 = max(is_equal_useSpecularWorkflow ? vec3(1.0) : grazing_metallic, 0.0);
    float specular_roughness = clamp(SR_UsdPreviewSurface_roughness * SR_UsdPreviewSurface_roughness, 1e-8, 1.0);
    vec2 albedo = mx_ggx_albedo_fit(specular_roughness, specular_roughness / (specular_roughness + cos_v), cos_v);
    float difference = 1.0 / albedo.x - 1.0;
    vec3 reflection_scale = mix(reflection_fresnel_facing, f90, 0.04761905) * difference + vec3(1.0);
    float body_weight = coating_difference
        * (1.0 - dot(mix(reflection_fresnel_facing, f90, albedo.y) * albedo.x * reflection_scale, vec3(0.33333334)));
    float metal_weight = is_equal_useSpecularWorkflow ? 0.0 : SR_UsdPreviewSurface_metallic;
    float diffuse_weight = 1.0 - metal_weight;
    float opaque_transparent = SR_UsdPreviewSurface_opacityThreshold > 0.0 ? 1.0 : SR_UsdPreviewSurface_opacity;
    float opaque_weight = 1 > SR_UsdPreviewSurface_opacityMode ? opaque_transparent : 2
        > SR_UsdPreviewSurface_opacityMode ? 1.0 : 0.0;
    float diffuse_weight_2 = diffuse_weight * (diffuse_weight * opaque_weight);
    vec3 diffuse_product = SR_UsdPreviewSurface_diffuseColor * (body_weight * diffuse_weight_2);
    mx_GgxLobe coating_lobe = mx_ggx_lobe(vec2(coat_roughness), shading_normal, V);
    vec3 metal_ior, metal_extinction;
    mx_artistic_ior(SR_UsdPreviewSurface_diffuseColor, SR_UsdPreviewSurface_diffuseColor, metal_ior, metal_extinction);
    vec3 re = metal_ior * metal_ior - metal_extinction * metal_extinction;
    vec3 im = metal_extinction * (metal_ior * 2.0);
    vec3 metal_product = (difference * mix(mx_fresnel_conductor(1.0, re, im), vec3(1.0), 0.04761905) + vec3(1.0))
        * (metal_weight * coating_difference);
    mx_GgxLobe lobe = mx_ggx_lobe(vec2(specular_roughness), shading_normal, V);
    vec3 reflection_product = reflection_scale * (diffuse_weight * coating_difference);
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        // diffuse
        int type = u_lightData[i].type;
        vec3 d = u_lightData[i].position - vd_positionWorld;
        float ratio = u_lightData[i].intensity / pow(length(d) + 1.0, u_lightData[i].decay_rate);
        float spot_light_difference = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
        vec3 to_light = normalize(d);
        float spot_light_choice = type == 3
            ? smoothstep(spot_light_difference, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, to_light))
            * ratio : 0.0;
        float point_light_choice = type == 2 ? ratio : spot_light_choice;
        vec3 directional_light_light = u_lightData[i].color
            * (type == 1 ? u_lightData[i].intensity : point_light_choice);
        vec3 L = type == 1 ? -u_lightData[i].direction : to_light;
        color += directional_light_light * (max(dot(L, N), 1e-8) / 3.1415927 * diffuse_product);
        // coating
        float cosine = sqrt(clamp(dot(V, L) * 0.5 + 0.5, 1e-8, 1.0));
        if (SR_UsdPreviewSurface_clearcoat > 0.0) {
            float coating_product = mx_ggx_light(coating_lobe, V, L) * (SR_UsdPreviewSurface_clearcoat * coating_scale);
            color += directional_light_light
                * (mx_fresnel_schlick(cosine, vec3(coating_fresnel_facing), vec3(1.0)) * coating_product);
        }
        // metal
        float ggx_light = mx_ggx_light(lobe, V, L);
        if (metal_weight > 0.0)
            color += directional_light_light * (metal_product * (ggx_light * mx_fresnel_conductor(cosine, re, im)));
        // reflection
        if (diffuse_weight > 0.0)
            color += directional_light_light
                * (reflection_product * (ggx_light * mx_fresnel_schlick(cosine, reflection_fresnel_facing, f90)));
    }
    // environment
    // diffuse
    if (diffuse_weight_2 > 0.0)
        color += u_envLightIntensity * (diffuse_product
            * textureLod(u_envIrradiance, mx_map_point(normalize((u_envMatrix * vec4(N, 0.0)).xyz)), 0.0).xyz);
    // coating
    if (SR_UsdPreviewSurface_clearcoat > 0.0) {
        mx_GgxSamples coating_ggx_samples = mx_ggx_samples(vec2(coat_roughness), shading_normal, V);
        vec2 turn = vec2(1.0, 0.0);
        for (int i = 0; i < u_envRadianceSamples; ++i) {
            vec4 coating_light = mx_ggx_reflected(coating_ggx_samples, i, turn);
            color += SR_UsdPreviewSurface_clearcoat * coating_scale
                * (mx_fresnel_schlick(coating_light.w, vec3(coating_fresnel_facing), vec3(1.0)) * coating_light.xyz);
            turn = turn * -0.7373689 + vec2(-turn.y, turn.x) * 0.6754903;
        }
    }
    // metal, reflection
    if (metal_weight > 0.0 || diffuse_weight > 0.0) {
        mx_GgxSamples ggx_samples = mx_ggx_samples(vec2(specular_roughness), shading_normal, V);
        vec2 turn = vec2(1.0, 0.0);
        for (int i = 0; i < u_envRadianceSamples; ++i) {
            // metal
            vec4 metal_ggx_reflected = mx_ggx_reflected(ggx_samples, i, turn);
            if (metal_weight > 0.0)
                color += metal_product * (mx_fresnel_conductor(metal_ggx_reflected.w, re, im)
                    * metal_ggx_reflected.xyz);
            // reflection
            if (diffuse_weight > 0.0)
                color += reflection_product
                    * (metal_ggx_reflected.xyz
                    * mx_fresnel_schlick(metal_ggx_reflected.w, reflection_fresnel_facing, f90));
            turn = turn * -0.7373689 + vec2(-turn.y, turn.x) * 0.6754903;
        }
    }
    // refraction
    float refraction_weight = diffuse_weight * (1.0 - opaque_weight);
    if (refraction_weight > 0.0) {
        mx_GgxSamples samples = mx_ggx_samples(vec2(0.0), shading_normal, V);
        vec2 turn = vec2(1.0, 0.0);
        for (int i = 0; i < u_envRadianceSamples; ++i) {
            vec4 refraction_ggx_transmitted = mx_ggx_transmitted(samples, SR_UsdPreviewSurface_ior, i, turn);
            color += refraction_ggx_transmitted.xyz
                * (body_weight * refraction_weight
                * (1.0 - mx_fresnel_dielectric(refraction_ggx_transmitted.w, SR_UsdPreviewSurface_ior)));
            turn = turn * -0.7373689 + vec2(-turn.y, turn.x) * 0.6754903;
        }
    }
    // opacity
    float mask = SR_UsdPreviewSurface_opacity >= SR_UsdPreviewSurface_opacityThreshold ? 1.0 : 0.0;
    float coverage_choice = 2 > SR_UsdPreviewSurface_opacityMode ? SR_UsdPreviewSurface_opacityThreshold > 0.0 ? mask
        : SR_UsdPreviewSurface_opacity : 0.0;
    float coverage = 1 > SR_UsdPreviewSurface_opacityMode ? mask : coverage_choice;
    if (coverage < u_alphaThreshold)
        discard;
    out1 = vec4(coverage * color, coverage);
}
