#version 450
// wet_metal · slab_surface · mxgen 0.1 · glsl · reduced · 6 closures · 0 textures

struct mx_GgxLobe {
    vec3 N;
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
    float level;
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
    vec3 tangentWorld;
} vd;
out vec4 out1;

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

vec3 mx_fresnel_schlick(const float cosine, const vec3 f0)
{
    float x = 1.0 - cosine;
    return mix(f0, vec3(1.0), x * x * x * x * x);
}

// Heitz 2014, "Understanding the Masking-Shadowing Function", equation 72: cos (1 + 2 Lambda).
float mx_ggx_masking(const float cosine, const float area)
{
    return sqrt(mix(cosine * cosine, 1.0, area));
}

// N faces V.
mx_GgxLobe mx_ggx_lobe(const vec2 roughness, const vec3 N, const vec3 X, const vec3 V)
{
    vec2 alpha = clamp(roughness, vec2(1e-8), vec2(1.0));
    return mx_GgxLobe(N, normalize(X - dot(X, N) * N), alpha, mx_ggx_masking(max(dot(N, V), 1e-8), alpha.x * alpha.y));
}

// The lobe towards L, but for Fresnel's factor: distribution and visibility over one divisor.
float mx_ggx_light(const mx_GgxLobe lobe, const vec3 V, const vec3 L)
{
    vec3 H = V + L;
    vec2 slope = vec2(dot(H, lobe.x), dot(cross(H, lobe.N), lobe.x)) / lobe.alpha;
    float area = lobe.alpha.x * lobe.alpha.y;
    float cos_l = max(dot(lobe.N, L), 1e-8);
    float cos_h = dot(lobe.N, V) + dot(lobe.N, L);
    float square = 2.0 + 2.0 * dot(V, L);
    float e = dot(slope, slope) + cos_h * cos_h;
    return square * square * cos_l / (6.2831855 * area * e * e
        * (max(dot(lobe.N, V), 1e-8) * sqrt(mix(cos_l * cos_l, 1.0, area)) + cos_l * lobe.masking));
}

// What the layer of the medium reflects and lets through, with all orders of scattering, of light on a way x.
vec3 mx_medium_layer(const vec3 a, const vec3 t, const float way, out vec3 transmitted)
{
    vec3 u = t / (vec3(1.0) + t);
    float x = way - 1.0;
    vec3 s = 0.5 * a * way * (vec3(1.0) + u
        * (vec3(-1.029) + u * (vec3(0.5422) - 0.3924 * a) + a * (vec3(0.7451) + 0.3145 * a) + x
        * (vec3(1.1669) - 1.3629 * a)));
    vec3 k = (vec3(1.0) - a) * way * (vec3(1.0) + a * u
        * (vec3(0.604) + u * (vec3(-0.1979) - 0.4865 * a) + a * (vec3(1.393) - 0.5447 * a) + x
        * (vec3(0.2436) - 2.0559 * a) + a * a * a * a * (vec3(-0.0215) + 0.5896 * u)));
    vec3 g = sqrt(k * (k + 2.0 * s));
    vec3 e = exp(-g * t);
    vec3 ways = mix((vec3(1.0) - e * e) / max(g, vec3(1e-6)), 2.0 * t * (vec3(1.0) - g * t), step(g * t, vec3(0.001)));
    vec3 below = (k + s) * ways + vec3(1.0) + e * e;
    transmitted = 2.0 * e / below;
    return s * ways / below;
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

// s of Kulla and Conty 2017, "Revisiting Physically Based Shading at Imageworks": the albedo of one scattering is 1 -
// s^2 where the medium scatters evenly and reflects `color` at infinite thickness.
vec3 mx_medium_loss(const vec3 color)
{
    vec3 c = clamp(color, vec3(0.0), vec3(1.0));
    return mix(clamp(vec3(4.09712) + 4.20863 * c - sqrt(vec3(9.59217) + c * (vec3(41.6808) + 17.7126 * c)), vec3(0.0),
        vec3(1.0)), vec3(1.0), step(c, vec3(0.0)));
}

vec3 mx_medium_reflected(const vec3 color, const vec3 mean_free_path, const float thickness, const float way)
{
    if (max(color.x, max(color.y, color.z)) <= 0.0)
        return vec3(0.0);
    vec3 ignored;
    vec3 loss = mx_medium_loss(color);
    return mx_medium_layer(vec3(1.0) - loss * loss, max(thickness, 0.0) / max(mean_free_path, vec3(1e-6)), way,
        ignored);
}

// Light of a unit direction in the picture, filtered over the solid angle of a sample (Krivanek and Colbert 2008; the
// mip level is equation 13 of GPU Gems 3, section 20.4).
vec3 mx_filtered_light(const vec3 d, const float level)
{
    return textureLod(u_envRadiance, mx_map_point(d), max(0.25 * log2(level * level / dot(d.xz, d.xz)), 0.0)).xyz;
}

// Height-correlated masking and shadowing G2 (Heitz 2014, equation 99) over 2 cos_v cos_l; half is left of the divisor
// of the reflection model.
float mx_ggx_visibility(const float cos_v, const float masking, const float area, const float cos_l)
{
    return 1.0 / (cos_v * sqrt(mix(cos_l * cos_l, 1.0, area)) + cos_l * masking);
}

// The light of a sample, and in the fourth component the cosine at its facet h, of any length; `spread` is its level
// over that of the first.
vec4 mx_ggx_sample_at(const mx_GgxSamples s, const vec3 h, const float shrink, const float spread)
{
    float cosine = dot(s.v, h);
    vec3 l = 2.0 * shrink * cosine * h - s.v;
    float cos_l = max(l.z, 1e-8);
    return vec4(cos_l * mx_ggx_visibility(s.v.z, s.masking, s.area, cos_l)
        * mx_filtered_light(s.to_map * l, spread * spread * s.level), clamp(cosine * sqrt(shrink), 1e-8, 1.0));
}

// A normal of those visible from v, which is stretched by the roughness, before it is scaled to length 1 (Dupuy and
// Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps"): (cos, sin) of its turn around z, and how far the
// cap is below its top, `top` = v + z.
vec3 mx_ggx_cap(const vec2 around, const float depth, const vec3 top)
{
    return vec3(top.xy + sqrt(depth * (2.0 - depth)) * around, top.z - depth);
}

vec4 mx_ggx_sample(const mx_GgxSamples s, const vec2 around, const float depth)
{
    vec3 cap = mx_ggx_cap(around, depth, s.top);
    vec3 h = cap * s.stretch;
    float shrink = 1.0 / dot(h, h);
    return mx_ggx_sample_at(s, h, shrink, shrink * dot(cap, cap));
}

mx_GgxSamples mx_ggx_samples(const mx_GgxLobe lobe, const vec3 V)
{
    mat3 frame = mat3(lobe.x, cross(lobe.N, lobe.x), lobe.N);
    vec3 v = max(V * frame, vec3(-1.0, -1.0, 1e-8));
    float area = lobe.alpha.x * lobe.alpha.y;
    vec3 stretch = vec3(lobe.alpha, 1.0);
    vec3 top = normalize(v * stretch) + vec3(0.0, 0.0, 1.0);
    float share = 1.0 / float(max(u_envRadianceSamples, 1));
    float weight = share * (v.z + lobe.masking);
    return mx_GgxSamples(mat3(u_envMatrix) * frame, stretch, area, v, lobe.masking, top, share * top.z, weight
        * u_envLightIntensity, weight * area * exp2(2.0 * float(u_envRadianceMips) - 2.3485));
}

vec3 mx_ggx_gather_schlick(const mx_GgxLobe lobe, const vec3 V, const vec3 f0)
{
    mx_GgxSamples samples = mx_ggx_samples(lobe, V);
    vec2 around = vec2(1.0, 0.0);
    vec3 sum = vec3(0.0);
    for (float depth = 0.5 * samples.step; depth < samples.top.z; depth += samples.step) {
        vec4 light = mx_ggx_sample(samples, around, depth);
        sum += mx_fresnel_schlick(light.w, f0) * light.xyz;
        around = mat2(-0.7373689, 0.6754903, -0.6754903, -0.7373689) * around;
    }
    return samples.weight * sum;
}

void main()
{
    vec3 N = normalize(vd.normalWorld);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    // metal
    float c = dot(N, V);
    float c_2 = max(abs(c), 1e-8);
    // coat
    vec2 coat_reflection_albedo = mx_ggx_albedo_fit(0.01, 0.01 / (c_2 + 0.01), c_2);
    float coat_reflection_scale = (1.0 / coat_reflection_albedo.x - 1.0) * 0.08571428 + 1.0;
    float coat_reflection_greater = max(1.0 - mix(0.04, 1.0, coat_reflection_albedo.y) * coat_reflection_albedo.x
        * coat_reflection_scale, 0.0);
    // milk
    float way = inversesqrt(c * c + 1.25) * 1.5;
    vec3 coat_medium_throughput = exp(way * vec3(-0.05, -0.033333335, -0.025));
    vec3 blended_coat_bare_throughput = mix(vec3(1.0), coat_reflection_greater * coat_medium_throughput, 0.5);
    vec3 coat_medium_throughput_2 = coat_medium_throughput * vec3(0.9512294, 0.967216, 0.9753099);
    vec3 blended_coat_bare_throughput_2 = mix(vec3(1.0), coat_reflection_greater * coat_medium_throughput_2, 0.5);
    vec3 blended_coat_bare_throughput_3 = mix(vec3(1.0), coat_reflection_greater
        * (coat_medium_throughput_2 * vec3(0.9512294, 0.967216, 0.9753099)), 0.5);
    vec3 clamped = clamp((blended_coat_bare_throughput_2 - blended_coat_bare_throughput_3)
        / max(blended_coat_bare_throughput - blended_coat_bare_throughput_2, 1e-6), 0.0, 0.999);
    vec3 ratio = (blended_coat_bare_throughput - blended_coat_bare_throughput_2) / (vec3(1.0) - clamped);
    vec3 difference = blended_coat_bare_throughput - ratio;
    vec3 color = (ratio + difference) * vec3(0.0, 0.1, 0.0);
    // lights
    vec3 Nf = faceforward(N, -V, N);
    vec3 X = normalize(vd.tangentWorld);
    mx_GgxLobe coat_reflection_lobe = mx_ggx_lobe(vec2(0.01), Nf, X, V);
    vec3 milk_medium_transmitted;
    vec3 milk_medium = mx_medium_layer(vec3(0.990589, 0.99790716, 0.99950534), vec3(0.2), way, milk_medium_transmitted);
    vec2 albedo = mx_ggx_albedo_fit(0.25, 0.25 / (c_2 + 0.25), c_2);
    float difference_2 = 1.0 / albedo.x - 1.0;
    float milk_second_reflection_scale = difference_2 * 0.08571428 + 1.0;
    float milk_second_reflection_throughput = max(1.0 - albedo.x * mix(0.04, 1.0, albedo.y)
        * milk_second_reflection_scale, 0.0);
    vec3 milk_medium_difference = milk_second_reflection_throughput * blended_coat_bare_throughput
        - milk_second_reflection_throughput * blended_coat_bare_throughput_2;
    vec3 milk_medium_decay = clamp((milk_second_reflection_throughput * blended_coat_bare_throughput_2
        - milk_second_reflection_throughput * blended_coat_bare_throughput_3) / max(milk_medium_difference, 1e-6), 0.0,
        0.999);
    vec3 milk_medium_ratio = milk_medium_difference / (vec3(1.0) - milk_medium_decay);
    vec3 milk_medium_steady = milk_second_reflection_throughput * blended_coat_bare_throughput - milk_medium_ratio;
    vec3 metal_second_reflection_scale = difference_2 * vec3(0.9047619, 0.61904764, 0.33333334) + vec3(1.0);
    mx_GgxLobe lobe = mx_ggx_lobe(vec2(0.25), Nf, X, V);
    const vec3 metal_constant = vec3(0.9, 0.6, 0.3);
    vec3 milk_bare_product = milk_second_reflection_throughput
        * (milk_medium_transmitted / (vec3(1.0)
        - min(mix(metal_constant, vec3(1.0), albedo.y) * albedo.x * metal_second_reflection_scale
        * vec3(0.10193972, 0.102937125, 0.103155464), 0.999)) * vec3(0.895498, 0.89649165, 0.8967095));
    vec3 metal_second_reflection_difference = blended_coat_bare_throughput * milk_bare_product
        - blended_coat_bare_throughput_2 * milk_bare_product;
    vec3 metal_second_reflection_decay = clamp((blended_coat_bare_throughput_2 * milk_bare_product
        - blended_coat_bare_throughput_3 * milk_bare_product) / max(metal_second_reflection_difference, 1e-6), 0.0,
        0.999);
    vec3 metal_second_reflection_ratio = metal_second_reflection_difference
        / (vec3(1.0) - metal_second_reflection_decay);
    vec3 metal_second_reflection_steady = blended_coat_bare_throughput * milk_bare_product
        - metal_second_reflection_ratio;
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        // metal_second_reflection, milk_second_reflection, milk_medium, coat_reflection
        int type = u_lightData[i].type;
        float intensity = u_lightData[i].intensity;
        vec3 d = u_lightData[i].position - vd.positionWorld;
        float ratio_2 = intensity / pow(length(d) + 1.0, u_lightData[i].decay_rate);
        float spot_light_difference = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
        vec3 to_light = normalize(d);
        float spot_light_product = smoothstep(spot_light_difference, u_lightData[i].inner_angle,
            -dot(u_lightData[i].direction, to_light)) * ratio_2;
        float spot_light_choice = type == 3 ? spot_light_product : 0.0;
        float point_light_choice = type == 2 ? ratio_2 : spot_light_choice;
        vec3 directional_light_to_light = -u_lightData[i].direction;
        vec3 L = type == 1 ? directional_light_to_light : to_light;
        float cosine = sqrt(clamp(dot(V, L) * 0.5 + 0.5, 1e-8, 1.0));
        vec3 fresnel = mx_fresnel_schlick(cosine, vec3(0.04));
        vec3 coat_reflection_response = fresnel
            * (mx_ggx_light(coat_reflection_lobe, V, L) * (coat_reflection_scale * 0.5));
        float c_3 = dot(N, L);
        float way_2 = inversesqrt(c_3 * c_3 + 1.25) * 1.5;
        vec3 milk_medium_transmitted_2;
        vec3 milk_medium_2 = mx_medium_layer(vec3(0.990589, 0.99790716, 0.99950534), vec3(0.2), way_2,
            milk_medium_transmitted_2);
        vec3 milk_medium_weight = milk_medium_steady + milk_medium_ratio * pow(milk_medium_decay, vec3(way_2));
        vec3 milk_medium_product = milk_medium * milk_medium_2 / vec3(0.10193972, 0.102937125, 0.103155464)
            * milk_medium_weight;
        float ggx_light = mx_ggx_light(lobe, V, L);
        vec3 metal_second_reflection_weight = metal_second_reflection_steady + metal_second_reflection_ratio
            * pow(metal_second_reflection_decay, vec3(way_2));
        vec3 milk_second_reflection_response = milk_second_reflection_scale * ggx_light
            * (fresnel * (difference + ratio * pow(clamped, vec3(way_2))));
        vec3 sum = metal_second_reflection_scale
            * (ggx_light * (mx_fresnel_schlick(cosine, metal_constant) * metal_second_reflection_weight))
            + milk_second_reflection_response;
        vec3 sum_2 = coat_reflection_response + (max(dot(L, Nf), 0.0) / 3.1415927 * milk_medium_product + sum);
        color += u_lightData[i].color * (type == 1 ? intensity : point_light_choice) * sum_2;
    }
    // environment
    // milk_medium, coat_medium
    vec3 part = textureLod(u_envIrradiance, mx_map_point(normalize((u_envMatrix * vec4(Nf, 0.0)).xyz)), 0.0).xyz;
    vec3 milk_medium_product_2 = part * mx_medium_reflected(vec3(0.8, 0.9, 0.95), vec3(0.1), 0.02, way);
    vec3 milk_medium_response = u_envLightIntensity
        * ((milk_medium_steady + milk_medium_ratio * pow(milk_medium_decay, vec3(1.145898))) * milk_medium_product_2);
    vec3 coat_medium_product = part * mx_medium_reflected(vec3(0.0), vec3(0.2, 0.3, 0.4), 0.01, way);
    color += milk_medium_response + coat_medium_product * (u_envLightIntensity * (coat_reflection_greater * 0.5));
    // metal_second_reflection
    vec3 slab_reflection_bsdf_environment = metal_second_reflection_scale
        * mx_ggx_gather_schlick(lobe, V, metal_constant);
    color += slab_reflection_bsdf_environment
        * (metal_second_reflection_steady + metal_second_reflection_ratio
        * pow(metal_second_reflection_decay, vec3(way)));
    // milk_second_reflection
    vec3 milk_second_reflection_weight = difference + ratio * pow(clamped, vec3(way));
    color += milk_second_reflection_scale
        * (mx_ggx_gather_schlick(lobe, V, vec3(0.04)) * milk_second_reflection_weight);
    // coat_reflection
    color += coat_reflection_scale * 0.5 * mx_ggx_gather_schlick(coat_reflection_lobe, V, vec3(0.04));
    out1 = vec4(color, 1.0);
}
