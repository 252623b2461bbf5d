// Coloured · surfacematerial · mxgen 0.1 · hlsl · reduced · 2 closures · 3 textures
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
struct mx_GgxLight {
    float3 color;
    float weight;
    float cosine;
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
Texture2D albedo_file : register(t3);
SamplerState albedo_file_sampler : register(s3);
Texture2D rough_file : register(t4);
SamplerState rough_file_sampler : register(s4);
Texture2D bumps_file : register(t5);
SamplerState bumps_file_sampler : register(s5);
Texture2D u_envRadiance : register(t6);
SamplerState u_envRadiance_sampler : register(s6);
struct VertexData {
    float4 position : SV_Position;
    float3 positionWorld : TEXCOORD0;
    float3 normalWorld : TEXCOORD1;
    float3 tangentWorld : TEXCOORD2;
    float3 bitangentWorld : TEXCOORD3;
    float2 texcoord_0 : TEXCOORD4;
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

mx_GgxSamples make_mx_GgxSamples(float3x3 to_map, float3 stretch, float area, float3 v, float masking, float reach,
    float step, float texels, float weight)
{
    mx_GgxSamples made;
    made.to_map = to_map;
    made.stretch = stretch;
    made.area = area;
    made.v = v;
    made.masking = masking;
    made.reach = reach;
    made.step = step;
    made.texels = texels;
    made.weight = weight;
    return made;
}

mx_GgxFacet make_mx_GgxFacet(float3 h, float cosine, float mirror, float texels)
{
    mx_GgxFacet made;
    made.h = h;
    made.cosine = cosine;
    made.mirror = mirror;
    made.texels = texels;
    return made;
}

mx_GgxLight make_mx_GgxLight(float3 color, float weight, float cosine)
{
    mx_GgxLight made;
    made.color = color;
    made.weight = weight;
    made.cosine = cosine;
    return made;
}

// IEC 61966-2-1
float3 mx_srgb_texture_to_lin_rec709(float3 color)
{
    return lerp(color / 12.92, pow(max((color + 0.055) / 1.055, 0.0), float3(2.4, 2.4, 2.4)), step(0.04045, color));
}

// A texel of zeros is a missing map, and means the normal itself.
// Here scale = float2(1.0, 1.0).
float3 mx_normalmap(float3 texel, float3 normal, float3 tangent, float3 bitangent)
{
    float3 n = dot(texel, texel) == 0.0 ? float3(0.0, 0.0, 1.0) : texel * 2.0 - 1.0;
    return normalize(tangent * n.x + bitangent * n.y + normal * n.z);
}

// A cubic polynomial of x and y with the coefficients m, to which directional albedos are fitted.
float mx_bicubic(float4x4 m, float x, float y)
{
    return dot(float4(1.0, x, x * x, x * x * x), mul(float4(1.0, y, y * y, y * y * y), m));
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
// Here bend = float3(0.0, 0.0, 0.0), f90 = float3(1.0, 1.0, 1.0), exponent = 5.0.
float3 mx_fresnel_schlick(float cosine, float3 f0)
{
    float x = 1.0 - cosine;
    return lerp(f0, float3(1.0, 1.0, 1.0), x * x * x * x * x);
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

// The number of samples, from 1, that a lobe takes; roughness is that along two directions, squared.
int mx_sample_count(float2 roughness)
{
    float wide = max(roughness.x, roughness.y);
    float share = 0.5 * min(4.0 * sqrt(wide), 1.0);
    share = min(share * wide / min(roughness.x, roughness.y), 1.0);
    return max(int(ceil(share * float(u_envRadianceSamples))), 1);
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
    return make_mx_GgxLobe(faceforward(N, -V, N), cosine, float3(0.0, 0.0, 0.0), alpha,
        mx_ggx_masking(cosine, alpha.x * alpha.y));
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
    return make_mx_GgxSamples(mul(float3x3(x, cross(lobe.N, x), lobe.N), (float3x3)u_envMatrix), stretch, area, v,
        lobe.masking, reach, share * (v.z + reach),
        area * (v.z + lobe.masking) * max(2.0 / float(count), 4.4 / float(max(u_envRadianceSamples, 1)))
        * exp2(2.0 * float(u_envRadianceMips) - 4.6485), u_envLightIntensity * (share * (v.z + lobe.masking)));
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
    return float2(frac((d.z > 0.0 ? -0.5 : 0.5) * (mx_half_turn(d.x * stretch, abs(d.z) * stretch) + 0.5) + 0.25),
        0.5 - mx_half_turn(d.y, square * stretch));
}

// Light of the environment from the unit direction d of its picture, filtered over as many texels.
float3 mx_filtered_light(float3 d, float texels)
{
    return u_envRadiance.SampleLevel(u_envRadiance_sampler, mx_map_point(d),
        0.5 * log2(texels * rsqrt(mx_map_square(d)))).xyz;
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
    return make_mx_GgxFacet(h, cosine, mirror, mirror * mirror * s.texels);
}

// The light that the facet of sample i reflects.
mx_GgxLight mx_ggx_reflected(mx_GgxSamples s, int i, float2 turn)
{
    mx_GgxFacet facet = mx_ggx_facet(s, i, turn);
    float3 l = facet.mirror * facet.h - s.v;
    float cos_l = max(l.z, 1e-8);
    return make_mx_GgxLight(mx_filtered_light(mul(l, s.to_map), facet.texels),
        s.weight * cos_l * mx_ggx_visibility(s.v.z, s.masking, s.area, cos_l),
        sqrt(clamp(0.5 * (facet.mirror * facet.cosine), 1e-8, 1.0)));
}

void main(
    VertexData vd,
    out float4 out1 : SV_Target0)
{
    // NG_coloured
    float2 uv = vd.texcoord_0 * float2(3.0, 2.0);
    min16float3 tinted = min16float3(mx_srgb_texture_to_lin_rec709(albedo_file.Sample(albedo_file_sampler, uv).xyz))
        * min16float3(0.9, 0.5, 0.3);
    float3 color = float3(tinted) * 2000.0;
    // lights
    // SR_coloured
    min16float3 fresnel_facing = max(lerp(min16float3(0.9, 0.5, 0.3), tinted, 0.75), 0.0);
    float rough = rough_file.Sample(rough_file_sampler, uv).x;
    float specular_roughness = clamp(rough * rough, 0.00001, 1.0);
    float alpha = clamp(specular_roughness, 1e-8, 1.0);
    float3 bent = mx_normalmap(bumps_file.Sample(bumps_file_sampler, uv).xyz, normalize(vd.normalWorld),
        normalize(vd.tangentWorld), normalize(vd.bitangentWorld));
    float3 V = normalize(u_viewPosition - vd.positionWorld);
    float cosine = max(abs(dot(bent, V)), 1e-8);
    float3 scale = float3(lerp(fresnel_facing, min16float3(1.0, 1.0, 1.0), 0.04761905))
        * (1.0 / mx_ggx_albedo_fit(alpha, cosine).x - 1.0) + float3(1.0, 1.0, 1.0);
    float3 facing = faceforward(bent, -V, bent);
    float ggx_masking = sqrt(alpha * alpha + (1.0 - alpha * alpha) * (cosine * cosine));
    mx_GgxLobe metal_bare_ggx_lobe = make_mx_GgxLobe(facing, cosine, float3(0.0, 0.0, 0.0), (float2)alpha, ggx_masking);
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        float3 L;
        float intensity;
        int light_type = u_lightData[i].type;
        if (light_type == 1) {
            L = -u_lightData[i].direction;
            intensity = u_lightData[i].intensity;
        } else {
            float3 d = u_lightData[i].position - vd.positionWorld;
            float3 to_light = normalize(d);
            L = to_light;
            float falloff = u_lightData[i].intensity / pow(length(d) + 1.0, u_lightData[i].decay_rate);
            if (light_type == 2) {
                intensity = falloff;
            } else {
                float edge = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
                intensity = light_type == 3
                    ? smoothstep(edge, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, to_light)) * falloff
                    : 0.0;
            }
        }
        // metal_bare
        float3 metal_bare_product = scale
            * mx_fresnel_schlick(sqrt(clamp(dot(L, V) * 0.5 + 0.500001, 0.0, 1.0)), float3(fresnel_facing));
        color += u_lightData[i].color * (intensity * (metal_bare_product * mx_ggx_light(metal_bare_ggx_lobe, V, L)));
    }
    // environment: metal_bare
    float2 turn = float2(1.0, 0.0);
    int count = mx_sample_count((float2)alpha);
    mx_GgxSamples metal_bare_ggx_samples = mx_ggx_samples((float2)specular_roughness, count, bent, V);
    for (int i = 0; i < count; ++i) {
        mx_GgxLight light = mx_ggx_reflected(metal_bare_ggx_samples, i, turn);
        color += light.color * (light.weight * (scale * mx_fresnel_schlick(light.cosine, float3(fresnel_facing))));
        turn = float2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
    }
    out1 = float4(color, 1.0);
}
