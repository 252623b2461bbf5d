// UsdPreviewSurface · surfacematerial · mxgen 0.1 · hlsl · complete · 6 closures · 0 textures
// shader model 6.0

struct mx_GgxLobe {
    float3 N;
    float cosine;
    float3 x;
    float2 alpha;
    float masking;
};
struct mx_GgxSamples {
    float3x3 to_map;
    float3 stretch;
    float area;
    float3 v;
    float masking;
    float3 top;
    float step;
    float weight;
};
struct mx_GgxFacet {
    float3 h;
    float shrink;
    float spread;
};
cbuffer PublicUniforms : register(b1)
{
    float3 SR_UsdPreviewSurface_diffuseColor : packoffset(c0);
    float3 SR_UsdPreviewSurface_emissiveColor : packoffset(c1);
    int SR_UsdPreviewSurface_useSpecularWorkflow : packoffset(c1.w);
    float3 SR_UsdPreviewSurface_specularColor : packoffset(c2);
    float SR_UsdPreviewSurface_metallic : packoffset(c2.w);
    float SR_UsdPreviewSurface_roughness : packoffset(c3);
    float SR_UsdPreviewSurface_clearcoat : packoffset(c3.y);
    float SR_UsdPreviewSurface_clearcoatRoughness : packoffset(c3.z);
    float SR_UsdPreviewSurface_opacity : packoffset(c3.w);
    int SR_UsdPreviewSurface_opacityMode : packoffset(c4);
    float SR_UsdPreviewSurface_opacityThreshold : packoffset(c4.y);
    float SR_UsdPreviewSurface_ior : packoffset(c4.z);
    float3 SR_UsdPreviewSurface_normal : packoffset(c5);
};
cbuffer PrivateUniforms : register(b0)
{
    row_major float4x4 u_worldMatrix : packoffset(c0);
    row_major float4x4 u_worldInverseTransposeMatrix : packoffset(c4);
    row_major float4x4 u_viewProjectionMatrix : packoffset(c8);
    float3 u_viewPosition : packoffset(c12);
    int u_numActiveLightSources : packoffset(c12.w);
    row_major float4x4 u_envMatrix : packoffset(c13);
    int u_envRadianceMips : packoffset(c17);
    int u_envRadianceSamples : packoffset(c17.y);
    float u_envLightIntensity : packoffset(c17.z);
    float u_alphaThreshold : packoffset(c17.w);
};
struct LightData {
    float3 direction;
    float3 color;
    float3 position;
    int type;
    float intensity;
    float decay_rate;
    float inner_angle;
    float outer_angle;
};
cbuffer LightData_block : register(b2)
{
    LightData u_lightData[3];
};
Texture2D u_envRadiance : register(t3);
SamplerState u_envRadiance_sampler : register(s3);
Texture2D u_envIrradiance : register(t4);
SamplerState u_envIrradiance_sampler : register(s4);
struct VertexData {
    float4 position : SV_Position;
    float3 positionWorld : TEXCOORD0;
    float3 normalWorld : TEXCOORD1;
    float3 tangentWorld : TEXCOORD2;
    float3 bitangentWorld : TEXCOORD3;
};

mx_GgxLobe make_mx_GgxLobe(float3 N, float cosine, float3 x, float2 alpha, float masking)
{
    mx_GgxLobe made;
    made.N = N;
    made.cosine = cosine;
    made.x = x;
    made.alpha = alpha;
    made.masking = masking;
    return made;
}

mx_GgxSamples make_mx_GgxSamples(float3x3 to_map, float3 stretch, float area, float3 v, float masking, float3 top,
    float step, float weight)
{
    mx_GgxSamples made;
    made.to_map = to_map;
    made.stretch = stretch;
    made.area = area;
    made.v = v;
    made.masking = masking;
    made.top = top;
    made.step = step;
    made.weight = weight;
    return made;
}

mx_GgxFacet make_mx_GgxFacet(float3 h, float shrink, float spread)
{
    mx_GgxFacet made;
    made.h = h;
    made.shrink = shrink;
    made.spread = spread;
    return made;
}

// A texel of zeros is a missing map, and means the normal itself.
float3 mx_normalmap(float3 texel, float3 normal, float3 tangent, float3 bitangent)
{
    float3 n = dot(texel, texel) == 0.0 ? float3(0.0, 0.0, 1.0) : texel * 2.0 - 1.0;
    return normalize(tangent * n.x + bitangent * n.y + normal * n.z);
}

// A polynomial of two variables, what directional albedos are fitted by (the programs in fits/).
float mx_bicubic(float4x4 m, float x, float y)
{
    return dot(float4(1.0, x, x * x, x * x * x), mul(float4(1.0, y, y * y, y * y * y), m));
}

// The program fits/ggx.c makes the constants. x is never too small by more than 0.001, so that giving lost energy back
// adds none. `u` follows what happens where light grazes the facets.
float2 mx_ggx_albedo_fit(float a, float u, float c)
{
    float x = clamp(1.0 - c - a * mx_bicubic(float4x4(-0.2006, 5.2916, -3.7565, 0.218, -10.2439, 6.6203, -0.9657,
        2.5694, 38.3042, -80.8059, 71.731, -28.5214, -34.2, 89.1079, -88.4065, 33.782), u, a), 0.0, 1.0);
    return float2(min(1.0046 - u * mx_bicubic(float4x4(-0.1447, 2.759, -5.4314, 2.8497, -0.9366, 1.4766, 0.5911,
        -1.0905, 11.8506, -30.2645, 27.3289, -8.9414, -4.3199, 8.2596, -3.1648, -0.8054), u, a), 1.0), x * x * x * x
        * x);
}

float3 mx_fresnel_schlick(float cosine, float3 f0, float3 f90)
{
    float x = 1.0 - cosine;
    return lerp(f0, f90, x * x * x * x * x);
}

mx_GgxLobe mx_ggx_lobe(float2 roughness, float3 N, float3 V)
{
    float2 alpha = clamp(roughness, 1e-8, 1.0);
    float cosine = max(abs(dot(N, V)), 1e-8);
    return make_mx_GgxLobe(faceforward(N, -V, N), cosine, float3(0.0, 0.0, 0.0), alpha,
        sqrt(cosine * cosine + alpha.x * alpha.y * (1.0 - cosine * cosine)));
}

// The lobe towards L, but for Fresnel's factor: distribution and visibility over one divisor.
float mx_ggx_light(mx_GgxLobe lobe, float3 V, float3 L)
{
    float3 slope = cross(V + L, lobe.N) / lobe.alpha.x;
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
void mx_artistic_ior(float3 reflectivity, float3 edge_color, out float3 ior, out float3 extinction)
{
    float3 s = sqrt(clamp(reflectivity, 0.0, 0.99));
    float3 greatest = (1.0 + s) / (1.0 - s);
    ior = lerp(greatest, (1.0 - s * s) / (1.0 + s * s), edge_color);
    extinction = sqrt(max((greatest - ior) * (ior - 1.0 / greatest), 0.0));
}

// The index times the cosine behind its interface: (u + iv)^2 = re + i im - sin^2.
float2 mx_fresnel_refract(float cosine, float re, float im)
{
    float t = re + (cosine * cosine - 1.0);
    float norm = sqrt(t * t + im * im);
    return sqrt(max(0.5 * float2(norm + t, norm - t), 0.0));
}

// |(x + iy - u - iv) / (x + iy + u + iv)|^2
float mx_fresnel_ratio(float2 x, float2 u)
{
    return dot(x - u, x - u) / dot(x + u, x + u);
}

// Fresnel equations for a permittivity (Pharr et al. 2023, section 9.3.6): against u + iv stands the cosine in the
// perpendicular part, the permittivity times the cosine in the parallel part.
float mx_fresnel_conductor(float cosine, float re, float im)
{
    float2 u = mx_fresnel_refract(cosine, re, im);
    return 0.5 * (mx_fresnel_ratio(float2(cosine, 0.0), u) + mx_fresnel_ratio(cosine * float2(re, im), u));
}

// One channel after the other, which needs a third of the registers.
float3 mx_fresnel_conductor(float cosine, float3 re, float3 im)
{
    return float3(mx_fresnel_conductor(cosine, re.x, im.x), mx_fresnel_conductor(cosine, re.y, im.y),
        mx_fresnel_conductor(cosine, re.z, im.z));
}

// The point of the picture for a unit direction in it.
float2 mx_map_point(float3 d)
{
    float2 a = abs(d.xz);
    float t = min(a.x, a.y) / max(max(a.x, a.y), 1e-8);
    float t2 = t * t;
    float turn = t * (0.1590298 + t2 * (t2 * (0.0232785 - 0.0062048 * t2) - 0.0511165));
    turn = a.x > a.y ? 0.25 - turn : turn;
    turn = d.z > 0.0 ? 0.5 - turn : turn;
    float y = abs(d.y);
    float height = sqrt(max(1.0 - y, 0.0)) * (0.4999879 + y * (y * (0.0244774 - 0.0066502 * y) - 0.0677603));
    return float2(d.x < 0.0 ? 0.5 - turn : 0.5 + turn, d.y < 0.0 ? 1.0 - height : height);
}

// The frame of a round lobe has V above its x.
mx_GgxSamples mx_ggx_samples(float2 roughness, float3 N, float3 V)
{
    mx_GgxLobe lobe = mx_ggx_lobe(roughness, N, V);
    float3 x = normalize(V - lobe.cosine * lobe.N + 1e-6 * lobe.N.yzx);
    float3 v = float3(float2(sqrt(max(1.0 - lobe.cosine * lobe.cosine, 0.0)), 0.0), lobe.cosine);
    float3 stretch = float3(lobe.alpha, 1.0);
    float3 top = normalize(v * stretch) + float3(0.0, 0.0, 1.0);
    float share = 1.0 / float(max(u_envRadianceSamples, 1));
    return make_mx_GgxSamples(mul(float3x3(x, cross(lobe.N, x), lobe.N), (float3x3)u_envMatrix), stretch, stretch.x
        * stretch.y, v, lobe.masking, top, share * top.z, share * (v.z + lobe.masking));
}

// Height-correlated masking and shadowing G2 (Heitz 2014, equation 99) over 2 cos_v cos_l; half is left of the divisor
// of the reflection model.
float mx_ggx_visibility(float cos_v, float masking, float area, float cos_l)
{
    return 1.0 / (cos_v * sqrt(cos_l * cos_l + area * (1.0 - cos_l * cos_l)) + cos_l * masking);
}

// Light of a unit direction in the picture, filtered over the solid angle of a sample, in hemispheres (Krivanek and
// Colbert 2008; the mip level is equation 13 of GPU Gems 3, section 20.4).
float3 mx_filtered_light(float3 d, float spread)
{
    return u_envRadiance.SampleLevel(u_envRadiance_sampler, mx_map_point(d),
        max(0.25 * log2(spread * spread / dot(d.xz, d.xz)) + float(u_envRadianceMips) - 1.17425, 0.0)).xyz;
}

// A normal of those visible from v, which is stretched by the roughness, before it is scaled to length 1 (Dupuy and
// Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps"): (cos, sin) of its turn around z, and how far the
// cap is below its top, `top` = v + z.
float3 mx_ggx_cap(float2 around, float depth, float3 top)
{
    return float3(top.xy + sqrt(depth * (2.0 - depth)) * around, top.z - depth);
}

// Samples are spherical Fibonacci points (Marques et al. 2013): each is the golden angle further around the one before,
// by its `turn`.
mx_GgxFacet mx_ggx_facet(mx_GgxSamples s, int i, float2 turn)
{
    float3 cap = mx_ggx_cap(turn, (float(i) + 0.5) * s.step, s.top);
    float3 h = cap * s.stretch;
    float shrink = 1.0 / dot(h, h);
    float spread = shrink * dot(cap, cap);
    return make_mx_GgxFacet(h, shrink, spread * spread * s.weight * s.area);
}

// The light that the facet of sample i reflects, and in the fourth component the cosine at it.
float4 mx_ggx_reflected(mx_GgxSamples s, int i, float2 turn)
{
    mx_GgxFacet facet = mx_ggx_facet(s, i, turn);
    float cosine = dot(s.v, facet.h);
    float3 l = 2.0 * facet.shrink * cosine * facet.h - s.v;
    float cos_l = max(l.z, 1e-8);
    return float4(s.weight * u_envLightIntensity * cos_l * mx_ggx_visibility(s.v.z, s.masking, s.area, cos_l)
        * mx_filtered_light(mul(l, s.to_map), facet.spread), clamp(cosine * sqrt(facet.shrink), 1e-8, 1.0));
}

// Direction of the ray -v after it has entered the sphere at normal h and left it again.
float3 mx_refract_sphere(float3 v, float3 h, float ior)
{
    float3 inside = refract(-v, h, 1.0 / ior);
    return refract(inside, normalize(inside * dot(inside, h) - 0.5 * h), ior);
}

// The light that comes through it and a solid sphere of an index behind it.
float4 mx_ggx_transmitted(mx_GgxSamples s, float ior, int i, float2 turn)
{
    mx_GgxFacet facet = mx_ggx_facet(s, i, turn);
    float3 h = facet.h * sqrt(facet.shrink);
    return float4(s.weight * u_envLightIntensity * 0.5 / s.v.z
        * mx_filtered_light(mul(mx_refract_sphere(s.v, h, ior), s.to_map), facet.spread),
        clamp(dot(s.v, h), 1e-8, 1.0));
}

// Unpolarised Fresnel equations of a dielectric; the clamped root makes total internal reflection come out as 1.
float mx_fresnel_dielectric(float cosine, float ior)
{
    float g = sqrt(max(ior * ior + cosine * cosine - 1.0, 0.0));
    float2 a = cosine * float2(1.0, ior * ior);
    float2 r = (a - g) / (a + g);
    return 0.5 * dot(r, r);
}

void main(
    VertexData vd,
    out float4 out1 : SV_Target0)
{
    float3 color = SR_UsdPreviewSurface_emissiveColor;
    // lights
    // SR_UsdPreviewSurface
    float3 shading_normal = mx_normalmap(SR_UsdPreviewSurface_normal * 0.5 + float3(0.5, 0.5, 0.5),
        normalize(vd.normalWorld), normalize(vd.tangentWorld), normalize(vd.bitangentWorld));
    float3 V = normalize(u_viewPosition - vd.positionWorld);
    float3 N = faceforward(shading_normal, -V, shading_normal);
    float amplitude = (1.0 - SR_UsdPreviewSurface_ior) / (SR_UsdPreviewSurface_ior + 1.0);
    float coating_fresnel_facing = max(amplitude * amplitude, 0.0);
    float coat_roughness = clamp(SR_UsdPreviewSurface_clearcoatRoughness * SR_UsdPreviewSurface_clearcoatRoughness,
        1e-8, 1.0);
    float cos_v = max(abs(dot(shading_normal, V)), 1e-8);
    float2 coating_albedo = mx_ggx_albedo_fit(coat_roughness, coat_roughness / (coat_roughness + cos_v), cos_v);
    float coating_scale = lerp(coating_fresnel_facing, 1.0, 0.04761905) * (1.0 / coating_albedo.x - 1.0) + 1.0;
    float coating_difference = 1.0 - SR_UsdPreviewSurface_clearcoat
        * dot((float3)(lerp(coating_fresnel_facing, 1.0, coating_albedo.y) * coating_albedo.x * coating_scale),
        float3(0.33333334, 0.33333334, 0.33333334));
    bool is_equal_useSpecularWorkflow = SR_UsdPreviewSurface_useSpecularWorkflow == 1;
    float3 grazing_metallic = lerp(float3(1.0, 1.0, 1.0), SR_UsdPreviewSurface_diffuseColor,
        SR_UsdPreviewSurface_metallic);
    float3 reflection_fresnel_facing = max(is_equal_useSpecularWorkflow ? SR_UsdPreviewSurface_specularColor
        : lerp(amplitude * amplitude * grazing_metallic, grazing_metallic, SR_UsdPreviewSurface_metallic), 0.0);
    float3 f90 = max(is_equal_useSpecularWorkflow ? float3(1.0, 1.0, 1.0) : grazing_metallic, 0.0);
    float specular_roughness = clamp(SR_UsdPreviewSurface_roughness * SR_UsdPreviewSurface_roughness, 1e-8, 1.0);
    float2 albedo = mx_ggx_albedo_fit(specular_roughness, specular_roughness / (specular_roughness + cos_v), cos_v);
    float difference = 1.0 / albedo.x - 1.0;
    float3 reflection_scale = lerp(reflection_fresnel_facing, f90, 0.04761905) * difference + float3(1.0, 1.0, 1.0);
    float body_weight = coating_difference
        * (1.0 - dot(lerp(reflection_fresnel_facing, f90, albedo.y) * albedo.x * reflection_scale,
        float3(0.33333334, 0.33333334, 0.33333334)));
    float metal_weight = is_equal_useSpecularWorkflow ? 0.0 : SR_UsdPreviewSurface_metallic;
    float diffuse_weight = 1.0 - metal_weight;
    float opaque_transparent = SR_UsdPreviewSurface_opacityThreshold > 0.0 ? 1.0 : SR_UsdPreviewSurface_opacity;
    float opaque_weight = 1 > SR_UsdPreviewSurface_opacityMode ? opaque_transparent : 2
        > SR_UsdPreviewSurface_opacityMode ? 1.0 : 0.0;
    float diffuse_weight_2 = diffuse_weight * (diffuse_weight * opaque_weight);
    float3 diffuse_product = SR_UsdPreviewSurface_diffuseColor * (body_weight * diffuse_weight_2);
    mx_GgxLobe coating_lobe = mx_ggx_lobe((float2)coat_roughness, shading_normal, V);
    float3 metal_ior, metal_extinction;
    mx_artistic_ior(SR_UsdPreviewSurface_diffuseColor, SR_UsdPreviewSurface_diffuseColor, metal_ior, metal_extinction);
    float3 re = metal_ior * metal_ior - metal_extinction * metal_extinction;
    float3 im = metal_extinction * (metal_ior * 2.0);
    float3 metal_product = (difference * lerp(mx_fresnel_conductor(1.0, re, im), float3(1.0, 1.0, 1.0), 0.04761905)
        + float3(1.0, 1.0, 1.0)) * (metal_weight * coating_difference);
    mx_GgxLobe lobe = mx_ggx_lobe((float2)specular_roughness, shading_normal, V);
    float3 reflection_product = reflection_scale * (diffuse_weight * coating_difference);
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        // diffuse
        int type = u_lightData[i].type;
        float3 d = u_lightData[i].position - vd.positionWorld;
        float ratio = u_lightData[i].intensity / pow(length(d) + 1.0, u_lightData[i].decay_rate);
        float spot_light_difference = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
        float3 to_light = normalize(d);
        float spot_light_choice = type == 3
            ? smoothstep(spot_light_difference, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, to_light))
            * ratio : 0.0;
        float point_light_choice = type == 2 ? ratio : spot_light_choice;
        float3 directional_light_light = u_lightData[i].color
            * (type == 1 ? u_lightData[i].intensity : point_light_choice);
        float3 L = type == 1 ? -u_lightData[i].direction : to_light;
        color += directional_light_light * (max(dot(L, N), 1e-8) / 3.1415927 * diffuse_product);
        // coating
        float cosine = sqrt(clamp(dot(V, L) * 0.5 + 0.5, 1e-8, 1.0));
        if (SR_UsdPreviewSurface_clearcoat > 0.0) {
            float coating_product = mx_ggx_light(coating_lobe, V, L) * (SR_UsdPreviewSurface_clearcoat * coating_scale);
            color += directional_light_light
                * (mx_fresnel_schlick(cosine, (float3)coating_fresnel_facing, float3(1.0, 1.0, 1.0)) * coating_product);
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
            * u_envIrradiance.SampleLevel(u_envIrradiance_sampler,
            mx_map_point(normalize(mul(float4(N, 0.0), u_envMatrix).xyz)), 0.0).xyz);
    // coating
    if (SR_UsdPreviewSurface_clearcoat > 0.0) {
        mx_GgxSamples coating_ggx_samples = mx_ggx_samples((float2)coat_roughness, shading_normal, V);
        float2 turn = float2(1.0, 0.0);
        for (int i = 0; i < u_envRadianceSamples; ++i) {
            float4 coating_light = mx_ggx_reflected(coating_ggx_samples, i, turn);
            color += SR_UsdPreviewSurface_clearcoat * coating_scale
                * (mx_fresnel_schlick(coating_light.w, (float3)coating_fresnel_facing, float3(1.0, 1.0, 1.0))
                * coating_light.xyz);
            turn = turn * -0.7373689 + float2(-turn.y, turn.x) * 0.6754903;
        }
    }
    // metal, reflection
    if (metal_weight > 0.0 || diffuse_weight > 0.0) {
        mx_GgxSamples ggx_samples = mx_ggx_samples((float2)specular_roughness, shading_normal, V);
        float2 turn = float2(1.0, 0.0);
        for (int i = 0; i < u_envRadianceSamples; ++i) {
            // metal
            float4 metal_ggx_reflected = mx_ggx_reflected(ggx_samples, i, turn);
            if (metal_weight > 0.0)
                color += metal_product * (mx_fresnel_conductor(metal_ggx_reflected.w, re, im)
                    * metal_ggx_reflected.xyz);
            // reflection
            if (diffuse_weight > 0.0)
                color += reflection_product
                    * (metal_ggx_reflected.xyz
                    * mx_fresnel_schlick(metal_ggx_reflected.w, reflection_fresnel_facing, f90));
            turn = turn * -0.7373689 + float2(-turn.y, turn.x) * 0.6754903;
        }
    }
    // refraction
    float refraction_weight = diffuse_weight * (1.0 - opaque_weight);
    if (refraction_weight > 0.0) {
        mx_GgxSamples samples = mx_ggx_samples(float2(0.0, 0.0), shading_normal, V);
        float2 turn = float2(1.0, 0.0);
        for (int i = 0; i < u_envRadianceSamples; ++i) {
            float4 refraction_ggx_transmitted = mx_ggx_transmitted(samples, SR_UsdPreviewSurface_ior, i, turn);
            color += refraction_ggx_transmitted.xyz
                * (body_weight * refraction_weight
                * (1.0 - mx_fresnel_dielectric(refraction_ggx_transmitted.w, SR_UsdPreviewSurface_ior)));
            turn = turn * -0.7373689 + float2(-turn.y, turn.x) * 0.6754903;
        }
    }
    // opacity
    float mask = SR_UsdPreviewSurface_opacity >= SR_UsdPreviewSurface_opacityThreshold ? 1.0 : 0.0;
    float coverage_choice = 2 > SR_UsdPreviewSurface_opacityMode ? SR_UsdPreviewSurface_opacityThreshold > 0.0 ? mask
        : SR_UsdPreviewSurface_opacity : 0.0;
    float coverage = 1 > SR_UsdPreviewSurface_opacityMode ? mask : coverage_choice;
    if (coverage < u_alphaThreshold)
        discard;
    out1 = float4(coverage * color, coverage);
}
