// UsdPreviewSurface · surfacematerial · mxgen 0.1 · msl · complete · 6 closures · 0 textures
// Metal Shading Language 2.3
#include <metal_stdlib>
using namespace metal;

struct mx_GgxLobe {
    float3 N;
    float cosine;
    float3 x;
    float2 alpha;
    float masking;
};
struct mx_GgxLight {
    float3 color;
    float weight;
    float cosine;
};
struct mx_GgxSamples {
    float3x3 to_map;
    float3 stretch;
    float area;
    float3 v;
    float masking;
    float reach;
    float step;
    float texels;
    float weight;
};
struct mx_GgxFacet {
    float3 h;
    float cosine;
    float mirror;
    float texels;
};
struct MetalTexture {
    texture2d<float> tex;
    sampler s;
};
struct PublicUniforms {
    float3 SR_UsdPreviewSurface_diffuseColor;
    float3 SR_UsdPreviewSurface_emissiveColor;
    int SR_UsdPreviewSurface_useSpecularWorkflow;
    float3 SR_UsdPreviewSurface_specularColor;
    float SR_UsdPreviewSurface_metallic;
    float SR_UsdPreviewSurface_roughness;
    float SR_UsdPreviewSurface_clearcoat;
    float SR_UsdPreviewSurface_clearcoatRoughness;
    float SR_UsdPreviewSurface_opacity;
    int SR_UsdPreviewSurface_opacityMode;
    float SR_UsdPreviewSurface_opacityThreshold;
    float SR_UsdPreviewSurface_ior;
    float3 SR_UsdPreviewSurface_normal;
};
struct PrivateUniforms {
    float4x4 u_worldMatrix;
    float4x4 u_worldInverseTransposeMatrix;
    float4x4 u_viewProjectionMatrix;
    float3 u_viewPosition;
    int u_numActiveLightSources;
    float4x4 u_envMatrix;
    int u_envRadianceMips;
    int u_envRadianceSamples;
    float u_envLightIntensity;
    float u_alphaThreshold;
};
struct alignas(16) LightData {
    float3 direction;
    float3 color;
    float3 position;
    int type;
    float intensity;
    float decay_rate;
    float inner_angle;
    float outer_angle;
};
struct LightData_pixel {
    LightData u_lightData[3];
};
struct VertexData {
    float4 pos [[position]];
    float3 positionWorld [[user(positionWorld)]];
    float3 normalWorld [[user(normalWorld)]];
    float3 tangentWorld [[user(tangentWorld)]];
    float3 bitangentWorld [[user(bitangentWorld)]];
};
struct PixelOutputs {
    float4 out1 [[color(0)]];
};

float3x3 cut_3(float4x4 m)
{
    return float3x3(m[0].xyz, m[1].xyz, m[2].xyz);
}

// A texel of zeros is a missing map, and means the normal itself.
// Here scale = float2(1.0).
float3 mx_normalmap(float3 texel, float3 normal, float3 tangent, float3 bitangent)
{
    float3 n = dot(texel, texel) == 0.0 ? float3(0.0, 0.0, 1.0) : texel * 2.0 - 1.0;
    return normalize(tangent * n.x + bitangent * n.y + normal * n.z);
}

// A cubic polynomial of x and y with the coefficients m, to which directional albedos are fitted.
float mx_bicubic(float4x4 m, float x, float y)
{
    return dot(float4(1.0, x, x * x, x * x * x), m * float4(1.0, y, y * y, y * y * y));
}

// The light that a white GGX lobe of roughness a reflects at the viewer's cosine c (x), and the mean of (1 - cos)^5
// over it (y).
float2 mx_ggx_albedo_fit(float a, float c)
{
    float x = clamp(1.0 - c - a * mx_bicubic(float4x4(-0.2174, 5.3819, -3.911, 0.2674, -9.7298, 3.9904, 3.8225, -0.0277,
        36.4897, -72.9122, 58.0878, -20.917, -31.4763, 79.0768, -73.9706, 26.5429), a / (a + c), a), 0.0, 1.0);
    float u = a / (a + 0.6 * c);
    return float2(min(1.0017 - u * u * mx_bicubic(float4x4(-0.0334, 3.1441, -6.1576, 3.0758, 0.6997, 7.8981, -14.3238,
        8.7382, 4.8322, -19.1128, 28.6679, -19.7386, -8.5929, 45.206, -83.1538, 52.7528), u, a * c), 1.0),
        x * x * x * x * x);
}

// Schlick's curve from f0 to f90 at a cosine, less `bend` times cos (1 - cos)^6.
// Here bend = float3(0.0), exponent = 5.0.
float3 mx_fresnel_schlick(float cosine, float3 f0, float3 f90)
{
    float x = 1.0 - cosine;
    return mix(f0, f90, x * x * x * x * x);
}

// The square of the length of the facet's normal H after the roughness divided its parts along the surface, times the
// product of the roughness along x and y; cos_h is its part along N.
// Here is_round = true, is_wide = false.
float mx_ggx_stretched(mx_GgxLobe lobe, float3 H, float cos_h)
{
    float3 slope = H - cos_h * lobe.N;
    return dot(slope, slope) + lobe.alpha.x * lobe.alpha.y * (cos_h * cos_h);
}

// The GGX lobe towards the light L, without Fresnel's factor: distribution, visibility and the cosine over one divisor.
// Here is_round = true, is_wide = false.
float mx_ggx_light(mx_GgxLobe lobe, float3 V, float3 L)
{
    float area = lobe.alpha.x * lobe.alpha.y;
    float cos_l = max(dot(lobe.N, L), 1e-8);
    float square = 2.0 + 2.0 * dot(V, L);
    float e = mx_ggx_stretched(lobe, V + L, lobe.cosine + dot(lobe.N, L));
    return area / 6.2831855 * square * square * cos_l
        / (e * e * (lobe.cosine * sqrt(area + (1.0 - area) * (cos_l * cos_l)) + cos_l * lobe.masking));
}

// Index and extinction of a conductor with this reflectivity facing the viewer, and this colour at the edge
// (Gulbrandsen 2014, "Artist Friendly Metallic Fresnel").
void mx_artistic_ior(float3 reflectivity, float3 edge_color, thread float3& ior, thread float3& extinction)
{
    float3 s = sqrt(clamp(reflectivity, 0.0, 0.99));
    float3 greatest = (1.0 + s) / (1.0 - s);
    ior = mix(greatest, (1.0 - s * s) / (1.0 + s * s), edge_color);
    extinction = sqrt(max((greatest - ior) * (ior - 1.0 / greatest), 0.0));
}

// Unpolarised reflectance of an interface with the permittivity re + i im, with c for the cosine and u + iv for the
// index times the cosine behind (Born and Wolf 1999, "Principles of Optics", section 14.4):
//     F = (P + P Q) / 2,  P = (a - g) / (a + g),  Q = (b - g s) / (b + g s)
//     a = |u + iv|^2 + c^2,  g = 2uc,  s = 1 - c^2,  b = |u + iv|^2 c^2 + s^2
float mx_fresnel_conductor(float cosine, float re, float im)
{
    float c2 = cosine * cosine;
    float s = 1.0 - c2;
    float t = re - s;
    float norm = sqrt(t * t + im * im);
    float g = cosine * sqrt(max(2.0 * (norm + t), 0.0));
    float b = norm * c2 + s * s;
    float a = norm + c2;
    return (a - g) * b / ((a + g) * (b + g * s));
}

// Unpolarised reflectance of a conductor with the permittivity re + i im of each channel.
float3 mx_fresnel_conductor(float cosine, float3 re, float3 im)
{
    float3 color = float3(0.0);
    for (int i = 0; i < 3; ++i)
        color[i] = mx_fresnel_conductor(cosine, re[i], im[i]);
    return color;
}

// The angle, over pi, with this sine and cosine; the cosine is not negative. It errs by 2.9e-5 at most.
float mx_half_turn(float sine, float cosine)
{
    return sine * (0.4999709 + cosine * (cosine * (0.2302802 + cosine * (0.0398298 * cosine - 0.1351235)) - 0.3164252));
}

// The square of the distance of the unit direction d from the vertical axis, never 0.
float mx_map_square(float3 d)
{
    return d.x * d.x + (d.z * d.z + 1e-16);
}

// The point of the latitude-longitude picture for the unit direction d, to a tenth of a texel in 4096.
float2 mx_map_point(float3 d)
{
    float square = mx_map_square(d);
    float stretch = rsqrt(square);
    return float2(fract((d.z > 0.0 ? -0.5 : 0.5) * (mx_half_turn(d.x * stretch, abs(d.z) * stretch) + 0.5) + 0.25),
        0.5 - mx_half_turn(d.y, square * stretch));
}

// Unpolarised reflectance of an interface whose squared index is `re`, with c for the cosine in front of it:
//     F = ((c - g)^2 / (c + g)^2) (1 + (cg - s)^2 / (cg + s)^2) / 2
//     s = 1 - c^2,  g^2 = c^2 + 2k,  2k = re - 1
float mx_fresnel_permittivity(float cosine, float re)
{
    float k = 0.5 * (re - 1.0);
    float c2 = max(cosine * cosine, -2.0 * k);
    float s = 1.0 - c2;
    float cg2 = c2 * (c2 + 2.0 * k);
    float r = k / max((1.0 + k) * (c2 + sqrt(cg2)) + k, 1e-8);
    return (cg2 + s * s) * (r * r);
}

// cos (1 + 2 Lambda) of a direction for GGX; `area` is the product of the roughness along x and y (Heitz 2014,
// "Understanding the Masking-Shadowing Function", equation 72).
float mx_ggx_masking(float cosine, float area)
{
    return sqrt(area + (1.0 - area) * (cosine * cosine));
}

// The GGX lobe of a surface as lights see it; roughness is that along X and across, squared.
// Here is_round = true.
mx_GgxLobe mx_ggx_lobe(float2 roughness, float3 N, float3 V)
{
    float2 alpha = clamp(roughness, 1e-8, 1.0);
    float cosine = max(abs(dot(N, V)), 1e-8);
    return mx_GgxLobe{faceforward(N, -V, N), cosine, float3(0.0), alpha, mx_ggx_masking(cosine, alpha.x * alpha.y)};
}

// Height-correlated masking and shadowing G2 over 2 cos_v cos_l (Heitz 2014, equation 99); `masking` is that of the
// viewer.
float mx_ggx_visibility(float cos_v, float masking, float area, float cos_l)
{
    return 1.0 / (cos_v * sqrt(area + (1.0 - area) * (cos_l * cos_l)) + cos_l * masking);
}

// A normal of those visible from v, at any length (Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical
// Caps"): v is stretched by the roughness and has the length `reach`, `around` is (cos, sin) of the turn around z, and
// `depth` how far the normal lies below the top of the cap, v.z + reach at most.
float3 mx_ggx_cap(float2 around, float depth, float3 v, float reach)
{
    return v + float3(sqrt(depth * (2.0 * reach - depth)) * around, reach - depth);
}

// The facet of sample i. Samples are spherical Fibonacci points (Marques et al. 2013): each is the golden angle further
// around than the one before, by its `turn`.
mx_GgxFacet mx_ggx_facet(mx_GgxSamples s, int i, float2 turn)
{
    float3 h = mx_ggx_cap(turn, (float(i) + 0.5) * s.step, s.v * s.stretch, s.reach) * s.stretch;
    float cosine = dot(s.v, h);
    float mirror = 2.0 * cosine / dot(h, h);
    return mx_GgxFacet{h, cosine, mirror, mirror * mirror * s.texels};
}

struct GlobalContext {
    constant LightData_pixel& u_lightData;
    MetalTexture u_envRadiance;
    MetalTexture u_envIrradiance;
    constant PrivateUniforms& u_prv;
    constant PublicUniforms& u_pub;
    VertexData vd;
    PixelOutputs out;

// The light that comes through a smooth solid sphere of index `ior`.
mx_GgxLight mx_transmitted(float ior, float3 N, float3 V)
{
    return mx_GgxLight{u_envRadiance.tex.sample(u_envRadiance.s,
        mx_map_point(normalize(cut_3(u_prv.u_envMatrix) * reflect(V, refract(-V, faceforward(N, -V, N), 1.0 / ior)))),
        level(0.0)).xyz * u_prv.u_envLightIntensity, 1.0, max(abs(dot(N, V)), 1e-8)};
}

// The number of samples, from 1, that a lobe takes; roughness is that along two directions, squared.
int mx_sample_count(float2 roughness)
{
    float wide = max(roughness.x, roughness.y);
    float share = 0.5 * min(4.0 * sqrt(wide), 1.0);
    share = min(share * wide / min(roughness.x, roughness.y), 1.0);
    return max(int(ceil(share * float(u_prv.u_envRadianceSamples))), 1);
}

// The GGX lobe of a surface as samples of the environment see it.
// Here is_round = true.
mx_GgxSamples mx_ggx_samples(float2 roughness, int count, float3 N, float3 V)
{
    mx_GgxLobe lobe = mx_ggx_lobe(roughness, N, V);
    float3 x = normalize(V - lobe.cosine * lobe.N + 1e-6 * lobe.N.yzx);
    float3 v = float3(sqrt(max(1.0 - lobe.cosine * lobe.cosine, 0.0)), 0.0, lobe.cosine);
    float3 stretch = float3(lobe.alpha, 1.0);
    float reach = lobe.masking;
    float area = stretch.x * stretch.y;
    float share = 1.0 / float(count);
    return mx_GgxSamples{cut_3(u_prv.u_envMatrix) * float3x3(x, cross(lobe.N, x), lobe.N), stretch, area, v,
        lobe.masking, reach, share * (v.z + reach),
        area * (v.z + lobe.masking) * max(2.0 / float(count), 4.4 / float(max(u_prv.u_envRadianceSamples, 1)))
        * exp2(2.0 * float(u_prv.u_envRadianceMips) - 4.6485),
        u_prv.u_envLightIntensity * (share * (v.z + lobe.masking))};
}

// Light of the environment from the unit direction d of its picture, filtered over as many texels.
float3 mx_filtered_light(float3 d, float texels)
{
    return u_envRadiance.tex.sample(u_envRadiance.s, mx_map_point(d),
        level(0.5 * log2(texels * rsqrt(mx_map_square(d))))).xyz;
}

// The light that the facet of sample i reflects.
mx_GgxLight mx_ggx_reflected(mx_GgxSamples s, int i, float2 turn)
{
    mx_GgxFacet facet = mx_ggx_facet(s, i, turn);
    float3 l = facet.mirror * facet.h - s.v;
    float cos_l = max(l.z, 1e-8);
    return mx_GgxLight{mx_filtered_light(s.to_map * l, facet.texels),
        s.weight * cos_l * mx_ggx_visibility(s.v.z, s.masking, s.area, cos_l),
        sqrt(clamp(0.5 * (facet.mirror * facet.cosine), 1e-8, 1.0))};
}

void FragmentMain()
{
    float3 color = u_pub.SR_UsdPreviewSurface_emissiveColor;
    // lights
    // SR_UsdPreviewSurface
    float3 shading_normal = mx_normalmap(u_pub.SR_UsdPreviewSurface_normal * 0.5 + float3(0.5),
        normalize(vd.normalWorld), normalize(vd.tangentWorld), normalize(vd.bitangentWorld));
    float3 V = normalize(u_prv.u_viewPosition - vd.positionWorld);
    float3 facing = faceforward(shading_normal, -V, shading_normal);
    float3 diffuseColor = u_pub.SR_UsdPreviewSurface_diffuseColor;
    float coating_weight = clamp(u_pub.SR_UsdPreviewSurface_clearcoat, 0.0, 1.0);
    float ior = u_pub.SR_UsdPreviewSurface_ior;
    float amplitude = (1.0 - ior) / (ior + 1.0);
    float coating_fresnel_f0 = max(amplitude * amplitude, 0.0);
    float coat_roughness = clamp(u_pub.SR_UsdPreviewSurface_clearcoatRoughness
        * u_pub.SR_UsdPreviewSurface_clearcoatRoughness, 1e-8, 1.0);
    float cos_v = max(abs(dot(shading_normal, V)), 1e-8);
    float2 coating_albedo = mx_ggx_albedo_fit(coat_roughness, cos_v);
    float coating_scale = mix(coating_fresnel_f0, 1.0, 0.04761905) * (1.0 / coating_albedo.x - 1.0) + 1.0;
    float coating_throughput = 1.0 - coating_weight
        * (mix(coating_fresnel_f0, 1.0, coating_albedo.y) * coating_albedo.x * coating_scale);
    bool is_equal_useSpecularWorkflow = u_pub.SR_UsdPreviewSurface_useSpecularWorkflow == 1;
    float3 grazing_metallic = mix(float3(1.0), diffuseColor, u_pub.SR_UsdPreviewSurface_metallic);
    float3 reflection_fresnel_f0 = max(is_equal_useSpecularWorkflow ? u_pub.SR_UsdPreviewSurface_specularColor
        : mix(amplitude * amplitude * grazing_metallic, grazing_metallic, u_pub.SR_UsdPreviewSurface_metallic), 0.0);
    float3 f90 = max(is_equal_useSpecularWorkflow ? float3(1.0) : grazing_metallic, 0.0);
    float specular_roughness = clamp(u_pub.SR_UsdPreviewSurface_roughness * u_pub.SR_UsdPreviewSurface_roughness, 1e-8,
        1.0);
    float2 albedo = mx_ggx_albedo_fit(specular_roughness, cos_v);
    float lost = 1.0 / albedo.x - 1.0;
    float3 reflection_scale = mix(reflection_fresnel_f0, f90, 0.04761905) * lost + float3(1.0);
    float body_weight = coating_throughput
        * (1.0 - dot(mix(reflection_fresnel_f0, f90, albedo.y) * albedo.x * reflection_scale, float3(0.33333334)));
    float metal_weight = is_equal_useSpecularWorkflow ? 0.0 : u_pub.SR_UsdPreviewSurface_metallic;
    float opaque_transparent = u_pub.SR_UsdPreviewSurface_opacityThreshold > 0.0 ? 1.0
        : u_pub.SR_UsdPreviewSurface_opacity;
    float clamped_opaque_weight = clamp(1 > u_pub.SR_UsdPreviewSurface_opacityMode ? opaque_transparent
        : 2 > u_pub.SR_UsdPreviewSurface_opacityMode ? 1.0 : 0.0, 0.0, 1.0);
    float substrate_metal_weight = clamp(metal_weight, 0.0, 1.0);
    float diffuse_weight = clamp(1.0 - metal_weight, 0.0, 1.0)
        * (clamped_opaque_weight * (1.0 - substrate_metal_weight));
    float3 diffuse_factor = diffuseColor * (body_weight * diffuse_weight * 0.31830987);
    float coating_ggx_masking = sqrt(coat_roughness * coat_roughness
        + (1.0 - coat_roughness * coat_roughness) * (cos_v * cos_v));
    mx_GgxLobe coating_ggx_lobe = mx_GgxLobe{facing, cos_v, float3(0.0), float2(coat_roughness), coating_ggx_masking};
    float3 metal_ior, metal_extinction;
    mx_artistic_ior(diffuseColor, diffuseColor, metal_ior, metal_extinction);
    float3 re = metal_ior * metal_ior - metal_extinction * metal_extinction;
    float3 im = metal_extinction * (metal_ior * 2.0);
    float3 metal_factor = (lost * mix(mx_fresnel_conductor(1.0, re, im), float3(1.0), 0.04761905) + float3(1.0))
        * (substrate_metal_weight * coating_throughput);
    float ggx_masking = sqrt(specular_roughness * specular_roughness
        + cos_v * cos_v * (1.0 - specular_roughness * specular_roughness));
    mx_GgxLobe ggx_lobe = mx_GgxLobe{facing, cos_v, float3(0.0), float2(specular_roughness), ggx_masking};
    bool reflection_visible = 1.0 - substrate_metal_weight > 0.0;
    float3 reflection_factor = reflection_scale * (coating_throughput * (1.0 - substrate_metal_weight));
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_prv.u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        float3 L;
        float intensity;
        int light_type = u_lightData.u_lightData[i].type;
        if (light_type == 1) {
            L = -u_lightData.u_lightData[i].direction;
            intensity = u_lightData.u_lightData[i].intensity;
        } else {
            float3 d = u_lightData.u_lightData[i].position - vd.positionWorld;
            float3 to_light = normalize(d);
            L = to_light;
            float falloff = u_lightData.u_lightData[i].intensity
                / pow(length(d) + 1.0, u_lightData.u_lightData[i].decay_rate);
            if (light_type == 2) {
                intensity = falloff;
            } else {
                float edge = min(u_lightData.u_lightData[i].inner_angle, u_lightData.u_lightData[i].outer_angle)
                    - 0.00001;
                intensity = light_type == 3
                    ? smoothstep(edge, u_lightData.u_lightData[i].inner_angle,
                    -dot(u_lightData.u_lightData[i].direction, to_light)) * falloff : 0.0;
            }
        }
        // diffuse
        float3 light_color = u_lightData.u_lightData[i].color;
        color += light_color * (intensity * (max(dot(L, facing), 1e-8) * diffuse_factor));
        // coating
        float half_cosine = sqrt(clamp(dot(V, L) * 0.5 + 0.500001, 0.0, 1.0));
        if (coating_weight > 0.0) {
            float coating_product = mx_ggx_light(coating_ggx_lobe, V, L) * (coating_weight * coating_scale);
            color += light_color * (intensity
                * (mx_fresnel_schlick(half_cosine, float3(coating_fresnel_f0), float3(1.0)) * coating_product));
        }
        // metal
        float ggx_light = mx_ggx_light(ggx_lobe, V, L);
        if (substrate_metal_weight > 0.0)
            color += light_color * (intensity
                * (metal_factor * (mx_fresnel_conductor(half_cosine, re, im) * ggx_light)));
        // reflection
        if (reflection_visible)
            color += light_color * (intensity
                * (reflection_factor * (ggx_light * mx_fresnel_schlick(half_cosine, reflection_fresnel_f0, f90))));
    }
    // environment: diffuse
    if (diffuse_weight > 0.0) {
        float3 diffuse_product = diffuseColor
            * u_envIrradiance.tex.sample(u_envIrradiance.s, mx_map_point(normalize(cut_3(u_prv.u_envMatrix) * facing)),
            level(0.0)).xyz;
        color += diffuse_product * (body_weight * diffuse_weight * u_prv.u_envLightIntensity);
    }
    // environment: refraction
    float refraction_weight = (1.0 - substrate_metal_weight) * (1.0 - clamped_opaque_weight);
    if (refraction_weight > 0.0) {
        mx_GgxLight refraction_light = mx_transmitted(ior, shading_normal, V);
        color += refraction_light.color * (refraction_light.weight
            * (1.0 - mx_fresnel_permittivity(refraction_light.cosine, ior * ior)) * (body_weight * refraction_weight));
    }
    // environment: coating
    if (coating_weight > 0.0) {
        float2 turn = float2(1.0, 0.0);
        int coating_count = mx_sample_count(float2(coat_roughness));
        mx_GgxSamples coating_ggx_samples = mx_ggx_samples(float2(coat_roughness), coating_count, shading_normal, V);
        for (int i = 0; i < coating_count; ++i) {
            mx_GgxLight coating_light = mx_ggx_reflected(coating_ggx_samples, i, turn);
            float3 fresnel_bare = mx_fresnel_schlick(coating_light.cosine, float3(coating_fresnel_f0), float3(1.0));
            color += coating_light.color * (fresnel_bare * (coating_weight * coating_scale * coating_light.weight));
            turn = float2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
        }
    }
    // environment: metal, reflection
    if (substrate_metal_weight > 0.0 || reflection_visible) {
        float2 turn = float2(1.0, 0.0);
        int count = mx_sample_count(float2(specular_roughness));
        mx_GgxSamples ggx_samples = mx_ggx_samples(float2(specular_roughness), count, shading_normal, V);
        for (int i = 0; i < count; ++i) {
            mx_GgxLight light = mx_ggx_reflected(ggx_samples, i, turn);
            if (substrate_metal_weight > 0.0)
                color += metal_factor * (light.color * (light.weight * mx_fresnel_conductor(light.cosine, re, im)));
            if (reflection_visible)
                color += reflection_factor
                    * (light.color * (light.weight * mx_fresnel_schlick(light.cosine, reflection_fresnel_f0, f90)));
            turn = float2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
        }
    }
    // opacity
    float mask = u_pub.SR_UsdPreviewSurface_opacity >= u_pub.SR_UsdPreviewSurface_opacityThreshold ? 1.0 : 0.0;
    float coverage_choice = 2 > u_pub.SR_UsdPreviewSurface_opacityMode
        ? u_pub.SR_UsdPreviewSurface_opacityThreshold > 0.0 ? mask : u_pub.SR_UsdPreviewSurface_opacity : 0.0;
    float opacity = clamp(1 > u_pub.SR_UsdPreviewSurface_opacityMode ? mask : coverage_choice, 0.0, 1.0);
    if (opacity < u_prv.u_alphaThreshold)
        discard_fragment();
    out.out1 = float4(opacity * color, opacity);
}
};

fragment PixelOutputs FragmentMain(
    VertexData vd [[stage_in]],
    constant LightData_pixel& u_lightData [[buffer(0)]],
    texture2d<float> u_envRadiance_tex [[texture(0)]],
    sampler u_envRadiance_sampler [[sampler(0)]],
    texture2d<float> u_envIrradiance_tex [[texture(1)]],
    sampler u_envIrradiance_sampler [[sampler(1)]],
    constant PrivateUniforms& u_prv [[buffer(1)]],
    constant PublicUniforms& u_pub [[buffer(2)]])
{
    GlobalContext context = {u_lightData, {u_envRadiance_tex, u_envRadiance_sampler},
        {u_envIrradiance_tex, u_envIrradiance_sampler}, u_prv, u_pub, vd, {}};
    context.FragmentMain();
    return context.out;
}
