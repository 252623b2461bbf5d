#version 450
// Worn · surfacematerial · mxgen 0.1 · glsl · reduced · 4 closures · 0 textures

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
    float reach;
    float step;
    float texels;
    float weight;
};
struct mx_GgxFacet {
    vec3 h;
    float cosine;
    float mirror;
    float texels;
};
struct mx_GgxLight {
    vec3 color;
    float weight;
    float cosine;
};
uniform vec3 u_viewPosition = vec3(0.0);
uniform int u_numActiveLightSources = 0;
uniform mat4 u_envMatrix = mat4(-1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
uniform int u_envRadianceMips = 1;
uniform int u_envRadianceSamples = 16;
uniform float u_envLightIntensity = 1.0;
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
uniform LightData u_lightData[3];
uniform sampler2D u_envRadiance;
uniform sampler2D u_envIrradiance;
in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
    vec2 texcoord_0;
} vd;
out vec4 out1;

// The dot product of p with one of the eight vectors (+-1, +-2), (+-2, +-1).
float mx_gradient(const uint hash, const vec2 p)
{
    bool swap = (hash & 4u) != 0u;
    float u = swap ? p.y : p.x;
    float v = swap ? p.x : p.y;
    return ((hash & 1u) != 0u ? -u : u) + 2.0 * ((hash & 2u) != 0u ? -v : v);
}

// Final scramble of a hash (Bob Jenkins, "lookup3.c", 2006).
// Here z = 3735928580u.
uint mx_hash_final(const uint x, const uint y)
{
    uint a = x;
    uint b = y;
    uint c = 3735928580u;
    c ^= b;
    c -= (b << 14) | (b >> 18);
    a ^= c;
    a -= (c << 11) | (c >> 21);
    b ^= a;
    b -= (a << 25) | (a >> 7);
    c ^= b;
    c -= (b << 16) | (b >> 16);
    a ^= c;
    a -= (c << 4) | (c >> 28);
    b ^= a;
    b -= (a << 14) | (a >> 18);
    c ^= b;
    c -= (b << 24) | (b >> 8);
    return c;
}

// The curve 6t^5 - 15t^4 + 10t^3 between lattice points (Perlin 2002, "Improving Noise").
vec2 mx_fade(const vec2 t)
{
    return t * t * t * (t * (t * 6.0 - vec2(15.0)) + vec2(10.0));
}

// Perlin noise at the point p, from -1 to 1.
float mx_noise_float(const vec2 p)
{
    vec2 cell = floor(p);
    vec2 f = p - cell;
    vec2 w = mx_fade(f);
    int x = int(cell.x);
    int y = int(cell.y);
    return 0.6616 * mix(mix(mx_gradient(mx_hash_final(3735928580u + uint(x), 3735928580u + uint(y)), f),
        mx_gradient(mx_hash_final(3735928580u + uint(x + 1), 3735928580u + uint(y)), f - vec2(1.0, 0.0)), w.x),
        mix(mx_gradient(mx_hash_final(3735928580u + uint(x), 3735928580u + uint(y + 1)), f - vec2(0.0, 1.0)),
        mx_gradient(mx_hash_final(3735928580u + uint(x + 1), 3735928580u + uint(y + 1)), f - vec2(1.0)), w.x), w.y);
}

// A cubic polynomial of x and y with the coefficients m, to which directional albedos are fitted.
float mx_bicubic(const mat4 m, const float x, const float y)
{
    return dot(vec4(1.0, x, x * x, x * x * x), m * vec4(1.0, y, y * y, y * y * y));
}

// The light that a white GGX lobe of roughness a reflects at the viewer's cosine c (x), and the mean of (1 - cos)^5
// over it (y).
vec2 mx_ggx_albedo_fit(const float a, const float c)
{
    float x = clamp(1.0 - c - a * mx_bicubic(mat4(-0.2174, 5.3819, -3.911, 0.2674, -9.7298, 3.9904, 3.8225, -0.0277,
        36.4897, -72.9122, 58.0878, -20.917, -31.4763, 79.0768, -73.9706, 26.5429), a / (a + c), a), 0.0, 1.0);
    float u = a / (a + 0.6 * c);
    return vec2(min(1.0017 - u * u * mx_bicubic(mat4(-0.0334, 3.1441, -6.1576, 3.0758, 0.6997, 7.8981, -14.3238, 8.7382,
        4.8322, -19.1128, 28.6679, -19.7386, -8.5929, 45.206, -83.1538, 52.7528), u, a * c), 1.0), x * x * x * x * x);
}

// The square of the length of the facet's normal H after the roughness divided its parts along the surface, times the
// product of the roughness along x and y; cos_h is its part along N.
// Here is_round = true, is_wide = true.
float mx_ggx_stretched(const mx_GgxLobe lobe, const float cos_h, const float square)
{
    return square - (1.0 - lobe.alpha.x * lobe.alpha.y) * (cos_h * cos_h);
}

// The GGX lobe towards the light L, without Fresnel's factor: distribution, visibility and the cosine over one divisor.
// Here is_round = true, is_wide = true.
float mx_ggx_light(const mx_GgxLobe lobe, const vec3 V, const vec3 L)
{
    float area = lobe.alpha.x * lobe.alpha.y;
    float cos_l = max(dot(lobe.N, L), 1e-8);
    float square = 2.0 + 2.0 * dot(V, L);
    float e = mx_ggx_stretched(lobe, lobe.cosine + dot(lobe.N, L), square);
    return area / 6.2831855 * square * square * cos_l
        / (e * e * (lobe.cosine * sqrt(area + (1.0 - area) * (cos_l * cos_l)) + cos_l * lobe.masking));
}

// Unpolarised reflectance of an interface whose squared index is `re`, with c for the cosine in front of it:
//     F = ((c - g)^2 / (c + g)^2) (1 + (cg - s)^2 / (cg + s)^2) / 2
//     s = 1 - c^2,  g^2 = c^2 + 2k,  2k = re - 1
// Here re = 2.25.
float mx_fresnel_permittivity(const float cosine)
{
    float c2 = cosine * cosine;
    float s = 1.0 - c2;
    float cg2 = c2 * (c2 + 1.25);
    float r = 0.625 / (1.625 * (c2 + sqrt(cg2)) + 0.625);
    return (cg2 + s * s) * (r * r);
}

// The angle, over pi, with this sine and cosine; the cosine is not negative. It errs by 2.9e-5 at most.
float mx_half_turn(const float sine, const float cosine)
{
    return sine * (0.4999709 + cosine * (cosine * (0.2302802 + cosine * (0.0398298 * cosine - 0.1351235)) - 0.3164252));
}

// The square of the distance of the unit direction d from the vertical axis, never 0.
float mx_map_square(const vec3 d)
{
    return d.x * d.x + (d.z * d.z + 1e-16);
}

// The point of the latitude-longitude picture for the unit direction d, to a tenth of a texel in 4096.
vec2 mx_map_point(const vec3 d)
{
    float square = mx_map_square(d);
    float stretch = inversesqrt(square);
    return vec2(fract((d.z > 0.0 ? -0.5 : 0.5) * (mx_half_turn(d.x * stretch, abs(d.z) * stretch) + 0.5) + 0.25),
        0.5 - mx_half_turn(d.y, square * stretch));
}

// The number of samples, from 1, that a lobe takes; roughness is that along two directions, squared.
int mx_sample_count(const vec2 roughness)
{
    float wide = max(roughness.x, roughness.y);
    float share = 0.5 * min(4.0 * sqrt(wide), 1.0);
    share = min(share * wide / min(roughness.x, roughness.y), 1.0);
    return max(int(ceil(share * float(u_envRadianceSamples))), 1);
}

// cos (1 + 2 Lambda) of a direction for GGX; `area` is the product of the roughness along x and y (Heitz 2014,
// "Understanding the Masking-Shadowing Function", equation 72).
float mx_ggx_masking(const float cosine, const float area)
{
    return sqrt(area + (1.0 - area) * (cosine * cosine));
}

// The GGX lobe of a surface as lights see it; roughness is that along X and across, squared.
// Here is_round = true.
mx_GgxLobe mx_ggx_lobe(const vec2 roughness, const vec3 N, const vec3 V)
{
    vec2 alpha = clamp(roughness, vec2(1e-8), vec2(1.0));
    float cosine = max(abs(dot(N, V)), 1e-8);
    return mx_GgxLobe(faceforward(N, -V, N), cosine, vec3(0.0), alpha, mx_ggx_masking(cosine, alpha.x * alpha.y));
}

// The GGX lobe of a surface as samples of the environment see it.
// Here is_round = true.
mx_GgxSamples mx_ggx_samples(const vec2 roughness, const int count, const vec3 N, const vec3 V)
{
    mx_GgxLobe lobe = mx_ggx_lobe(roughness, N, V);
    vec3 x = normalize(V - lobe.cosine * lobe.N + 1e-6 * lobe.N.yzx);
    vec3 v = vec3(sqrt(max(1.0 - lobe.cosine * lobe.cosine, 0.0)), 0.0, lobe.cosine);
    vec3 stretch = vec3(lobe.alpha, 1.0);
    float reach = lobe.masking;
    float area = stretch.x * stretch.y;
    float share = 1.0 / float(count);
    return mx_GgxSamples(mat3(u_envMatrix) * mat3(x, cross(lobe.N, x), lobe.N), stretch, area, v, lobe.masking, reach,
        share * (v.z + reach), area * (v.z + lobe.masking)
        * max(2.0 / float(count), 4.4 / float(max(u_envRadianceSamples, 1)))
        * exp2(2.0 * float(u_envRadianceMips) - 4.6485), u_envLightIntensity * (share * (v.z + lobe.masking)));
}

// Light of the environment from the unit direction d of its picture, filtered over as many texels.
vec3 mx_filtered_light(const vec3 d, const float texels)
{
    return textureLod(u_envRadiance, mx_map_point(d), 0.5 * log2(texels * inversesqrt(mx_map_square(d)))).xyz;
}

// Height-correlated masking and shadowing G2 over 2 cos_v cos_l (Heitz 2014, equation 99); `masking` is that of the
// viewer.
float mx_ggx_visibility(const float cos_v, const float masking, const float area, const float cos_l)
{
    return 1.0 / (cos_v * sqrt(area + (1.0 - area) * (cos_l * cos_l)) + cos_l * masking);
}

// A normal of those visible from v, at any length (Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical
// Caps"): v is stretched by the roughness and has the length `reach`, `around` is (cos, sin) of the turn around z, and
// `depth` how far the normal lies below the top of the cap, v.z + reach at most.
vec3 mx_ggx_cap(const vec2 around, const float depth, const vec3 v, const float reach)
{
    return v + vec3(sqrt(depth * (2.0 * reach - depth)) * around, reach - depth);
}

// The facet of sample i. Samples are spherical Fibonacci points (Marques et al. 2013): each is the golden angle further
// around than the one before, by its `turn`.
mx_GgxFacet mx_ggx_facet(const mx_GgxSamples s, const int i, const vec2 turn)
{
    vec3 h = mx_ggx_cap(turn, (float(i) + 0.5) * s.step, s.v * s.stretch, s.reach) * s.stretch;
    float cosine = dot(s.v, h);
    float mirror = 2.0 * cosine / dot(h, h);
    return mx_GgxFacet(h, cosine, mirror, mirror * mirror * s.texels);
}

// The light that the facet of sample i reflects.
mx_GgxLight mx_ggx_reflected(const mx_GgxSamples s, const int i, const vec2 turn)
{
    mx_GgxFacet facet = mx_ggx_facet(s, i, turn);
    vec3 l = facet.mirror * facet.h - s.v;
    float cos_l = max(l.z, 1e-8);
    return mx_GgxLight(mx_filtered_light(s.to_map * l, facet.texels),
        s.weight * cos_l * mx_ggx_visibility(s.v.z, s.masking, s.area, cos_l),
        sqrt(clamp(0.5 * (facet.mirror * facet.cosine), 1e-8, 1.0)));
}

void main()
{
    vec3 color = vec3(0.0);
    // lights
    vec3 axis = normalize(vd.normalWorld);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    // rust
    vec3 facing = faceforward(axis, -V, axis);
    float rust_dielectric_weight = clamp(mx_noise_float(vd.texcoord_0), 0.0, 1.0);
    float cos_v = max(abs(dot(axis, V)), 1e-8);
    vec2 rust_reflection_albedo = mx_ggx_albedo_fit(0.64, cos_v);
    float rust_reflection_scale = (1.0 / rust_reflection_albedo.x - 1.0) * 0.08571429 + 1.0;
    float rust_diffuse_weight = rust_dielectric_weight
        * (1.0 - mix(0.04, 1.0, rust_reflection_albedo.y) * rust_reflection_albedo.x * rust_reflection_scale);
    vec3 rust_diffuse_factor = rust_diffuse_weight * 0.31830987 * vec3(0.4, 0.2, 0.1);
    // paint
    vec2 paint_reflection_albedo = mx_ggx_albedo_fit(0.04, cos_v);
    float paint_reflection_scale = (1.0 / paint_reflection_albedo.x - 1.0) * 0.08571429 + 1.0;
    float paint_diffuse_weight = (1.0 - mix(0.04, 1.0, paint_reflection_albedo.y) * paint_reflection_albedo.x
        * paint_reflection_scale) * (1.0 - rust_dielectric_weight);
    vec3 paint_diffuse_factor = paint_diffuse_weight * 0.31830987 * vec3(0.1, 0.2, 0.7);
    float rust_reflection_ggx_masking = sqrt(cos_v * cos_v * 0.5904 + 0.40960005);
    mx_GgxLobe rust_reflection_ggx_lobe = mx_GgxLobe(facing, cos_v, vec3(0.0), vec2(0.64), rust_reflection_ggx_masking);
    bool paint_reflection_visible = 1.0 - rust_dielectric_weight > 0.0;
    float paint_reflection_ggx_masking = sqrt(cos_v * cos_v * 0.9984 + 0.0016000002);
    mx_GgxLobe paint_reflection_ggx_lobe = mx_GgxLobe(facing, cos_v, vec3(0.0), vec2(0.04),
        paint_reflection_ggx_masking);
    float paint_reflection_factor = paint_reflection_scale * (1.0 - rust_dielectric_weight);
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        vec3 L;
        float intensity;
        int light_type = u_lightData[i].type;
        if (light_type == 1) {
            L = -u_lightData[i].direction;
            intensity = u_lightData[i].intensity;
        } else {
            vec3 d = u_lightData[i].position - vd.positionWorld;
            vec3 to_light = normalize(d);
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
        // rust_diffuse, paint_diffuse
        vec3 light_color = u_lightData[i].color;
        float cos_l = max(dot(L, facing), 1e-8);
        color += light_color * (intensity * (cos_l * rust_diffuse_factor + cos_l * paint_diffuse_factor));
        // rust_reflection
        float fresnel = mx_fresnel_permittivity(sqrt(clamp(dot(V, L) * 0.5 + 0.500001, 0.0, 1.0)));
        if (rust_dielectric_weight > 0.0)
            color += light_color * (intensity
                * (mx_ggx_light(rust_reflection_ggx_lobe, V, L)
                * (fresnel * (rust_dielectric_weight * rust_reflection_scale))));
        // paint_reflection
        if (paint_reflection_visible)
            color += light_color * (intensity
                * (mx_ggx_light(paint_reflection_ggx_lobe, V, L) * (fresnel * paint_reflection_factor)));
    }
    // environment: rust_diffuse
    vec3 part = textureLod(u_envIrradiance, mx_map_point(normalize(mat3(u_envMatrix) * facing)), 0.0).xyz;
    if (rust_dielectric_weight > 0.0)
        color += part * vec3(0.4, 0.2, 0.1) * (rust_diffuse_weight * u_envLightIntensity);
    // environment: paint_diffuse
    if (paint_reflection_visible)
        color += part * vec3(0.1, 0.2, 0.7) * (paint_diffuse_weight * u_envLightIntensity);
    // environment: rust_reflection
    if (rust_dielectric_weight > 0.0) {
        vec2 turn = vec2(1.0, 0.0);
        int rust_reflection_count = mx_sample_count(vec2(0.64));
        mx_GgxSamples rust_reflection_ggx_samples = mx_ggx_samples(vec2(0.64), rust_reflection_count, axis, V);
        for (int i = 0; i < rust_reflection_count; ++i) {
            mx_GgxLight rust_reflection_light = mx_ggx_reflected(rust_reflection_ggx_samples, i, turn);
            color += rust_reflection_light.color
                * (mx_fresnel_permittivity(rust_reflection_light.cosine)
                * (rust_dielectric_weight * rust_reflection_scale * rust_reflection_light.weight));
            turn = vec2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
        }
    }
    // environment: paint_reflection
    if (paint_reflection_visible) {
        vec2 turn = vec2(1.0, 0.0);
        int paint_reflection_count = mx_sample_count(vec2(0.04));
        mx_GgxSamples paint_reflection_ggx_samples = mx_ggx_samples(vec2(0.04), paint_reflection_count, axis, V);
        for (int i = 0; i < paint_reflection_count; ++i) {
            mx_GgxLight paint_reflection_light = mx_ggx_reflected(paint_reflection_ggx_samples, i, turn);
            color += paint_reflection_light.color
                * (mx_fresnel_permittivity(paint_reflection_light.cosine)
                * (paint_reflection_factor * paint_reflection_light.weight));
            turn = vec2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
        }
    }
    out1 = vec4(color, 1.0);
}
