// standard_surface · surfacematerial · mxgen 0.1 · hlsl · reduced · 2 closures · 0 textures

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
    float3 u_viewPosition : packoffset(c0);
    row_major float4x4 u_envMatrix : packoffset(c1);
    int u_envRadianceMips : packoffset(c5);
    int u_envRadianceSamples : packoffset(c5.y);
    float u_envLightIntensity : packoffset(c5.z);
};
Texture2D u_envRadiance : register(t3);
SamplerState u_envRadiance_sampler : register(s3);
Texture2D u_envIrradiance : register(t4);
SamplerState u_envIrradiance_sampler : register(s4);
#ifndef MXG_LIGHTS
#define MXG_LIGHTS
int mxg_light_count();
void mxg_light(int i, float3 P, out float3 L, out float3 radiance);
#endif
struct Surface {
    float3 color;
    float alpha;
};

#ifndef MXG_d14b82caf4372ff8
#define MXG_d14b82caf4372ff8
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
#endif

#ifndef MXG_a0fc555dcaa42e0c
#define MXG_a0fc555dcaa42e0c
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
#endif

#ifndef MXG_607c48ef72585817
#define MXG_607c48ef72585817
mx_GgxFacet make_mx_GgxFacet(float3 h, float cosine, float mirror, float texels)
{
    mx_GgxFacet made;
    made.h = h;
    made.cosine = cosine;
    made.mirror = mirror;
    made.texels = texels;
    return made;
}
#endif

#ifndef MXG_192ecbf40731213a
#define MXG_192ecbf40731213a
mx_GgxLight make_mx_GgxLight(float3 color, float weight, float cosine)
{
    mx_GgxLight made;
    made.color = color;
    made.weight = weight;
    made.cosine = cosine;
    return made;
}
#endif

// A cubic polynomial of x and y with the coefficients m, to which directional albedos are fitted.
float mx_bicubic(float4x4 m, float x, float y)
{
    return dot(float4(1.0, x, x * x, x * x * x), mul(float4(1.0, y, y * y, y * y * y), m));
}

// The light that a white GGX lobe of roughness a reflects at the viewer's cosine c (x), and the mean of (1 - cos)^5
// over it (y).
// Here a = 0.04.
float2 mx_ggx_albedo_fit(float c)
{
    float x = clamp(1.0 - c - 0.04 * mx_bicubic(float4x4(-0.2174, 5.3819, -3.911, 0.2674, -9.7298, 3.9904, 3.8225,
        -0.0277, 36.4897, -72.9122, 58.0878, -20.917, -31.4763, 79.0768, -73.9706, 26.5429), 0.04 / (0.04 + c), 0.04),
        0.0, 1.0);
    float u = 0.04 / (0.04 + 0.6 * c);
    return float2(min(1.0017 - u * u * mx_bicubic(float4x4(-0.0334, 3.1441, -6.1576, 3.0758, 0.6997, 7.8981, -14.3238,
        8.7382, 4.8322, -19.1128, 28.6679, -19.7386, -8.5929, 45.206, -83.1538, 52.7528), u, 0.04 * c), 1.0),
        x * x * x * x * x);
}

// Unpolarised reflectance of an interface whose squared index is `re`, with c for the cosine in front of it:
//     F = ((c - g)^2 / (c + g)^2) (1 + (cg - s)^2 / (cg + s)^2) / 2
//     s = 1 - c^2,  g^2 = c^2 + 2k,  2k = re - 1
// Here re = 2.25.
float mx_fresnel_permittivity(float cosine)
{
    float c2 = cosine * cosine;
    float s = 1.0 - c2;
    float cg2 = c2 * (c2 + 1.25);
    float r = 0.625 / (1.625 * (c2 + sqrt(cg2)) + 0.625);
    return (cg2 + s * s) * (r * r);
}

// The square of the length of the facet's normal H after the roughness divided its parts along the surface, times the
// product of the roughness along x and y; cos_h is its part along N.
// Here is_round = true, is_wide = true.
float mx_ggx_stretched(mx_GgxLobe lobe, float cos_h, float square)
{
    return square - (1.0 - lobe.alpha.x * lobe.alpha.y) * (cos_h * cos_h);
}

// The GGX lobe towards the light L, without Fresnel's factor: distribution, visibility and the cosine over one divisor.
// Here is_round = true, is_wide = true.
float mx_ggx_light(mx_GgxLobe lobe, float3 V, float3 L)
{
    float area = lobe.alpha.x * lobe.alpha.y;
    float cos_l = max(dot(lobe.N, L), 1e-8);
    float square = 2.0 + 2.0 * dot(V, L);
    float e = mx_ggx_stretched(lobe, lobe.cosine + dot(lobe.N, L), square);
    return area / 6.2831855 * square * square * cos_l
        / (e * e * (lobe.cosine * sqrt(area + (1.0 - area) * (cos_l * cos_l)) + cos_l * lobe.masking));
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

// The number of samples, from 1, that a lobe takes; roughness is that along two directions, squared.
// Here roughness = float2(0.04, 0.04).
int mx_sample_count()
{
    return max(int(ceil(0.4 * float(u_envRadianceSamples))), 1);
}

// The GGX lobe of a surface as lights see it; roughness is that along X and across, squared.
// Here roughness = float2(0.04, 0.04), is_round = true.
mx_GgxLobe mx_ggx_lobe(float3 N, float3 V)
{
    float cosine = max(abs(dot(N, V)), 1e-8);
    return make_mx_GgxLobe(faceforward(N, -V, N), cosine, float3(0.0, 0.0, 0.0), float2(0.04, 0.04),
        sqrt(0.0016000002 + 0.9984 * (cosine * cosine)));
}

// The GGX lobe of a surface as samples of the environment see it.
// Here roughness = float2(0.04, 0.04), is_round = true.
mx_GgxSamples mx_ggx_samples(int count, float3 N, float3 V)
{
    mx_GgxLobe lobe = mx_ggx_lobe(N, V);
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

Surface surface(float3 positionWorld, float3 normalWorld)
{
    Surface result;
    float3 color = float3(0.0, 0.0, 0.0);
    // lights
    float3 axis = normalize(normalWorld);
    float3 V = normalize(u_viewPosition - positionWorld);
    // SR_standard_surface
    float cos_v = max(abs(dot(axis, V)), 1e-8);
    float2 albedo = mx_ggx_albedo_fit(cos_v);
    float scale = (1.0 / albedo.x - 1.0) * 0.08571429 + 1.0;
    float3 facing = faceforward(axis, -V, axis);
    float ggx_masking = sqrt(cos_v * cos_v * 0.9984 + 0.0016000002);
    mx_GgxLobe reflection_ggx_lobe = make_mx_GgxLobe(facing, cos_v, float3(0.0, 0.0, 0.0), float2(0.04, 0.04),
        ggx_masking);
    float reflection_throughput = 1.0 - lerp(0.04, 1.0, albedo.y) * albedo.x * scale;
    float diffuse_factor = reflection_throughput * 0.31830987 * 0.8;
    // from the last light, so that drivers do not unroll the loop
    for (int i = mxg_light_count() - 1; i >= 0; --i) {
        // reflection, diffuse
        float3 light_L, light_radiance;
        mxg_light(i, positionWorld, light_L, light_radiance);
        float reflection_product = scale
            * mx_fresnel_permittivity(sqrt(clamp(dot(V, light_L) * 0.5 + 0.500001, 0.0, 1.0)));
        float reflection_response = reflection_product * mx_ggx_light(reflection_ggx_lobe, V, light_L);
        color += light_radiance * (reflection_response + max(dot(light_L, facing), 1e-8) * diffuse_factor);
    }
    // environment: diffuse
    float3 diffuse_part = u_envIrradiance.SampleLevel(u_envIrradiance_sampler,
        mx_map_point(normalize(mul(facing, (float3x3)u_envMatrix))), 0.0).xyz;
    color += diffuse_part * (u_envLightIntensity * (reflection_throughput * 0.8));
    // environment: reflection
    float2 turn = float2(1.0, 0.0);
    int count = mx_sample_count();
    mx_GgxSamples reflection_ggx_samples = mx_ggx_samples(count, axis, V);
    for (int i = 0; i < count; ++i) {
        mx_GgxLight light = mx_ggx_reflected(reflection_ggx_samples, i, turn);
        color += light.color * (light.weight * (scale * mx_fresnel_permittivity(light.cosine)));
        turn = float2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
    }
    result.color = color;
    result.alpha = 1.0;
    return result;
}
