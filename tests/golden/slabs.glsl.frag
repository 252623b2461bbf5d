#version 450
// wet_metal · slab_surface · mxgen 0.1 · glsl · reduced · 6 closures · 0 textures

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
} vd;
out vec4 out1;

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

// Schlick's curve from f0 to f90 at a cosine, less `bend` times cos (1 - cos)^6.
// Here bend = vec3(0.0), f90 = vec3(1.0), exponent = 5.0.
vec3 mx_fresnel_schlick(const float cosine, const vec3 f0)
{
    float x = 1.0 - cosine;
    return mix(f0, vec3(1.0), x * x * x * x * x);
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

// Light that the layer of a medium reflects and lets through (`transmitted`), with all orders of scattering, on a way:
// a is the albedo of one scattering, t the optical depth (after Kubelka and Munk 1931).
// Here a = vec3(0.990589, 0.99790716, 0.99950534), t = vec3(0.2).
vec3 mx_medium_layer(const float way, out vec3 transmitted)
{
    float x = way - 1.0;
    vec3 s = vec3(0.49529448, 0.49895358, 0.49975267) * way
        * (vec3(1.0) + 0.16666666 * (vec3(0.043278337, 0.052829146, 0.054919362)
        + x * vec3(-0.18317366, -0.19314766, -0.19532585)));
    vec3 k = vec3(0.009411037, 0.0020928383, 0.000494659) * way
        * (vec3(1.0) + vec3(0.16509815, 0.16631785, 0.16658421)
        * (vec3(1.3360909, 1.3377652, 1.3381231) + x * vec3(-1.792952, -1.8079973, -1.8112832)
        + vec3(0.0739174, 0.07612604, 0.07661489)));
    vec3 g = sqrt(k * (k + 2.0 * s));
    vec3 e = exp(-g * 0.2);
    vec3 ways = mix((vec3(1.0) - e * e) / max(g, vec3(1e-6)), 0.4 * (vec3(1.0) - g * 0.2), step(g * 0.2, vec3(0.001)));
    vec3 below = (k + s) * ways + vec3(1.0) + e * e;
    transmitted = 2.0 * e / below;
    return s * ways / below;
}

// x^5.
float mx_power5(const float x)
{
    return x * x * x * x * x;
}

// 1 / (pi times the directional albedo) of Chan's lobe of gloss g at the cosine c, within 0.0012.
// Here g = 0.24549508.
float mx_chan_share(const float c)
{
    vec4 fit = mat4(0.711052, 0.000476, 0.474855, 0.02628, 0.152583, 0.003146, 1.026027, -0.718545, 0.102579, -0.004832,
        -2.223248, 0.347306, -0.053764, 0.001611, 2.069558, -0.492125) * vec4(1.0, c, c * c, c * c * c);
    return 1.0 / (3.1415927 * (mix(fit.x, 0.96428573 * (1.0 - 0.75 * mx_power5(1.0 - c)), 0.04008919)
        + 12.095031 * fit.y / (fit.w + c)));
}

// Chan's diffuse lobe of gloss g, times its directional albedo, for a light whose half vector has the cosine cos_d to
// V; `even` is the part that a smooth surface lets out to the viewer.
// Here g = 0.24549508.
float mx_chan_lobe(const float cos_v, const float cos_l, const float cos_d, const float even)
{
    return max(mix(cos_d + mx_power5(1.0 - cos_d), even * (1.0 - 0.75 * mx_power5(1.0 - cos_l)), 0.04008919)
        + 12.095031 * cos_d * exp2(-8.9 * sqrt(min((cos_l + cos_v) / (2.0 * cos_d), 1.0))), 0.0);
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

// Light that the layer of a medium reflects on a way.
// Here color = vec3(0.8, 0.9, 0.95), mean_free_path = vec3(0.1), g = 0.0, thickness = 0.02.
vec3 mx_medium_reflected(const float way)
{
    vec3 ignored;
    return mx_medium_layer(way, ignored);
}

// The square of the length of the facet's normal H after the roughness divided its parts along the surface, times the
// product of the roughness along x and y; cos_h is its part along N.
// Here is_round = true, is_wide = false.
float mx_ggx_stretched(const mx_GgxLobe lobe, const vec3 H, const float cos_h)
{
    vec3 slope = H - cos_h * lobe.N;
    return dot(slope, slope) + lobe.alpha.x * lobe.alpha.y * (cos_h * cos_h);
}

// The GGX lobe towards the light L, without Fresnel's factor: distribution, visibility and the cosine over one divisor.
// Here is_round = true, is_wide = false.
float mx_ggx_light_2(const mx_GgxLobe lobe, const vec3 V, const vec3 L)
{
    float area = lobe.alpha.x * lobe.alpha.y;
    float cos_l = max(dot(lobe.N, L), 1e-8);
    float square = 2.0 + 2.0 * dot(V, L);
    float e = mx_ggx_stretched(lobe, V + L, lobe.cosine + dot(lobe.N, L));
    return area / 6.2831855 * square * square * cos_l
        / (e * e * (lobe.cosine * sqrt(area + (1.0 - area) * (cos_l * cos_l)) + cos_l * lobe.masking));
}

void main()
{
    vec3 N = normalize(vd.normalWorld);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    // metal
    float cosine = dot(N, V);
    float cos_v = max(abs(cosine), 1e-8);
    // coat
    vec2 coat_reflection_albedo = mx_ggx_albedo_fit(0.01, cos_v);
    float coat_reflection_scale = (1.0 / coat_reflection_albedo.x - 1.0) * 0.08571428 + 1.0;
    float coat_reflection_throughput = max(1.0
        - mix(0.04, 1.0, coat_reflection_albedo.y) * coat_reflection_albedo.x * coat_reflection_scale, 0.0);
    // milk
    float closure_way = inversesqrt(cosine * cosine + 1.25) * 1.5;
    vec3 coat_medium_throughput = exp(closure_way * vec3(-0.05, -0.033333335, -0.025));
    vec3 drops_throughput = mix(vec3(1.0), coat_reflection_throughput * coat_medium_throughput, 0.5);
    vec3 coat_medium_throughput_2 = coat_medium_throughput * vec3(0.9512294, 0.967216, 0.9753099);
    vec3 drops_throughput_2 = mix(vec3(1.0), coat_reflection_throughput * coat_medium_throughput_2, 0.5);
    vec3 drops_throughput_3 = mix(vec3(1.0),
        coat_reflection_throughput * (coat_medium_throughput_2 * vec3(0.9512294, 0.967216, 0.9753099)), 0.5);
    vec3 milk_reflection_decay = clamp((drops_throughput_2 - drops_throughput_3)
        / max(drops_throughput - drops_throughput_2, 1e-6), 0.0, 0.999);
    vec3 decaying = (drops_throughput - drops_throughput_2) / (vec3(1.0) - milk_reflection_decay);
    vec3 milk_reflection_steady = drops_throughput - decaying;
    vec3 color = (decaying + milk_reflection_steady) * vec3(0.0, 0.1, 0.0);
    // lights: metal_reflection, metal_medium, milk_reflection
    vec2 milk_reflection_albedo = mx_ggx_albedo_fit(0.25071993, cos_v);
    float milk_reflection_scale = (1.0 / milk_reflection_albedo.x - 1.0) * 0.08571428 + 1.0;
    vec3 facing = faceforward(N, -V, N);
    float scaled_cos_v = cos_v * cos_v;
    mx_GgxLobe milk_reflection_ggx_lobe = mx_GgxLobe(facing, cos_v, vec3(0.0), vec2(0.25071993),
        sqrt(scaled_cos_v * 0.9371395 + 0.0628605));
    vec2 metal_reflection_albedo = mx_ggx_albedo_fit(0.29886922, cos_v);
    vec3 metal_reflection_scale = (1.0 / metal_reflection_albedo.x - 1.0) * vec3(0.6821221, 0.48832548, 0.27722293)
        + vec3(1.0);
    const vec3 metal_constant = vec3(0.66622823, 0.46274176, 0.24108408);
    mx_GgxLobe metal_reflection_ggx_lobe = mx_GgxLobe(facing, cos_v, vec3(0.0), vec2(0.29886922),
        sqrt(scaled_cos_v * 0.9106772 + 0.08932281));
    float milk_reflection_throughput = max(1.0
        - mix(0.04, 1.0, milk_reflection_albedo.y) * milk_reflection_albedo.x * milk_reflection_scale, 0.0);
    vec3 milk_medium_transmitted;
    vec3 milk_medium = mx_medium_layer(closure_way, milk_medium_transmitted);
    vec3 slab_reflection_bsdf_albedo = mix(metal_constant, vec3(1.0), metal_reflection_albedo.y)
        * metal_reflection_albedo.x * metal_reflection_scale;
    vec3 metal_reflection_throughput = max(vec3(1.0) - slab_reflection_bsdf_albedo, 0.0);
    const vec3 metal_constant_2 = vec3(0.700394, 0.2554791, 0.0776317);
    vec3 milk_medium_throughput = milk_medium_transmitted
        / (vec3(1.0) - min((slab_reflection_bsdf_albedo + metal_reflection_throughput * metal_constant_2)
        * vec3(0.10193972, 0.102937125, 0.103155464), 0.999));
    vec3 milk_bare_throughput = milk_reflection_throughput
        * (milk_medium_throughput * vec3(0.895498, 0.89649165, 0.8967095));
    vec3 metal_reflection_difference = drops_throughput * milk_bare_throughput
        - drops_throughput_2 * milk_bare_throughput;
    vec3 metal_reflection_decay = clamp((drops_throughput_2 * milk_bare_throughput
        - drops_throughput_3 * milk_bare_throughput) / max(metal_reflection_difference, 1e-6), 0.0, 0.999);
    vec3 metal_reflection_decaying = metal_reflection_difference / (vec3(1.0) - metal_reflection_decay);
    vec3 metal_reflection_steady = drops_throughput * milk_bare_throughput - metal_reflection_decaying;
    vec3 metal_medium_factor = mx_chan_share(cos_v) * metal_constant_2;
    float x = 1.0 - cos_v;
    float chan_even = 1.0 - x * (x * (x * (x * x))) * 0.75;
    vec3 metal_bare_metal_medium_weight = metal_reflection_throughput
        * (milk_reflection_throughput * milk_medium_throughput * drops_throughput);
    vec3 milk_medium_throughput_2 = milk_medium_throughput * vec3(0.9081714, 0.9090508, 0.9092436);
    vec3 metal_bare_metal_medium_weight_2 = metal_reflection_throughput
        * (milk_reflection_throughput * milk_medium_throughput_2 * drops_throughput_2);
    vec3 metal_medium_difference = metal_bare_metal_medium_weight_2
        - metal_reflection_throughput * (milk_reflection_throughput
        * (milk_medium_throughput_2 * vec3(0.9081714, 0.9090508, 0.9092436)) * drops_throughput_3);
    vec3 metal_medium_decay = clamp(metal_medium_difference
        / max(metal_bare_metal_medium_weight - metal_bare_metal_medium_weight_2, 1e-6), 0.0, 0.999);
    vec3 metal_medium_decaying = (metal_bare_metal_medium_weight - metal_bare_metal_medium_weight_2)
        / (vec3(1.0) - metal_medium_decay);
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
                float spot_light_edge = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
                intensity = light_type == 3
                    ? smoothstep(spot_light_edge, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, to_light))
                    * falloff : 0.0;
            }
        }
        // metal_reflection, metal_medium, milk_reflection
        float half_cosine = sqrt(clamp(dot(V, L) * 0.5 + 0.500001, 0.0, 1.0));
        float cosine_2 = dot(N, L);
        vec3 vector_closure_way = vec3(inversesqrt(cosine_2 * cosine_2 + 1.25) * 1.5);
        vec3 milk_reflection_weight = milk_reflection_steady
            + decaying * pow(milk_reflection_decay, vector_closure_way);
        vec3 milk_reflection_product = milk_reflection_weight
            * (milk_reflection_scale * mx_ggx_light(milk_reflection_ggx_lobe, V, L));
        vec3 metal_reflection_weight = metal_reflection_steady
            + metal_reflection_decaying * pow(metal_reflection_decay, vector_closure_way);
        vec3 metal_reflection_product = mx_ggx_light(metal_reflection_ggx_lobe, V, L) * metal_reflection_weight;
        float cos_l = max(dot(L, facing), 1e-8);
        float metal_medium_product = cos_l * mx_chan_lobe(cos_v, cos_l, half_cosine, chan_even);
        vec3 metal_medium_response = metal_medium_factor
            * (metal_medium_product * (metal_bare_metal_medium_weight - metal_medium_decaying
            + metal_medium_decaying * pow(metal_medium_decay, vector_closure_way)));
        vec3 response = metal_reflection_scale
            * (mx_fresnel_schlick(half_cosine, metal_constant) * metal_reflection_product) + metal_medium_response;
        color += u_lightData[i].color * (intensity
            * (mx_fresnel_schlick(half_cosine, vec3(0.04)) * milk_reflection_product + response));
    }
    // environment: metal_medium
    vec3 metal_medium_product = textureLod(u_envIrradiance,
        mx_map_point(normalize(mat3(u_envMatrix)
        * (facing + V * ((cos_v * (cos_v * 0.5624 - 0.7155) + 0.4353) * 0.732292)))), 0.0).xyz * metal_constant_2;
    color += u_envLightIntensity * ((metal_bare_metal_medium_weight - metal_medium_decaying
        + metal_medium_decaying * pow(metal_medium_decay, vec3(1.145898))) * metal_medium_product);
    // environment: metal_reflection
    vec2 turn = vec2(1.0, 0.0);
    int metal_reflection_count = mx_sample_count(vec2(0.29886922));
    vec3 metal_reflection_factor = metal_reflection_scale
        * (metal_reflection_steady + metal_reflection_decaying * pow(metal_reflection_decay, vec3(closure_way)));
    mx_GgxSamples metal_reflection_ggx_samples = mx_ggx_samples(vec2(0.29886922), metal_reflection_count, N, V);
    for (int i = 0; i < metal_reflection_count; ++i) {
        mx_GgxLight metal_reflection_light = mx_ggx_reflected(metal_reflection_ggx_samples, i, turn);
        color += metal_reflection_factor
            * (metal_reflection_light.color
            * (metal_reflection_light.weight * mx_fresnel_schlick(metal_reflection_light.cosine, metal_constant)));
        turn = vec2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
    }
    // environment: milk_reflection
    vec2 milk_reflection_turn = vec2(1.0, 0.0);
    int milk_reflection_count = mx_sample_count(vec2(0.25071993));
    vec3 milk_reflection_factor = milk_reflection_scale
        * (milk_reflection_steady + decaying * pow(milk_reflection_decay, vec3(closure_way)));
    mx_GgxSamples milk_reflection_ggx_samples = mx_ggx_samples(vec2(0.25071993), milk_reflection_count, N, V);
    for (int i = 0; i < milk_reflection_count; ++i) {
        mx_GgxLight milk_reflection_light = mx_ggx_reflected(milk_reflection_ggx_samples, i, milk_reflection_turn);
        color += milk_reflection_factor * (milk_reflection_light.color
            * (milk_reflection_light.weight * mx_fresnel_schlick(milk_reflection_light.cosine, vec3(0.04))));
        milk_reflection_turn = vec2(-milk_reflection_turn.y, milk_reflection_turn.x) * 0.6754903
            - milk_reflection_turn * 0.7373689;
    }
    // lights: milk_medium, coat_reflection
    vec3 slab_medium_bsdf_albedo = mx_medium_reflected(closure_way);
    vec3 milk_medium_factor = slab_medium_bsdf_albedo / vec3(0.10193972, 0.102937125, 0.103155464);
    vec3 milk_medium_difference = milk_reflection_throughput * drops_throughput
        - milk_reflection_throughput * drops_throughput_2;
    vec3 milk_medium_decay = clamp((milk_reflection_throughput * drops_throughput_2
        - milk_reflection_throughput * drops_throughput_3) / max(milk_medium_difference, 1e-6), 0.0, 0.999);
    vec3 milk_medium_decaying = milk_medium_difference / (vec3(1.0) - milk_medium_decay);
    vec3 milk_medium_steady = milk_reflection_throughput * drops_throughput - milk_medium_decaying;
    mx_GgxLobe coat_reflection_ggx_lobe = mx_GgxLobe(facing, cos_v, vec3(0.0), vec2(0.01),
        sqrt(scaled_cos_v * 0.9999 + 0.00010000001));
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
                float spot_light_edge = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
                intensity = light_type == 3
                    ? falloff * smoothstep(spot_light_edge, u_lightData[i].inner_angle,
                    -dot(u_lightData[i].direction, to_light)) : 0.0;
            }
        }
        // milk_medium, coat_reflection
        float cosine_3 = dot(N, L);
        float closure_way_2 = inversesqrt(cosine_3 * cosine_3 + 1.25) * 1.5;
        vec3 milk_medium_weight = milk_medium_steady
            + milk_medium_decaying * pow(milk_medium_decay, vec3(closure_way_2));
        vec3 milk_medium_response = milk_medium_factor
            * (mx_medium_reflected(closure_way_2) * (max(dot(facing, L), 0.0) / 3.1415927 * milk_medium_weight));
        vec3 fresnel = mx_fresnel_schlick(sqrt(clamp(dot(V, L) * 0.5 + 0.500001, 0.0, 1.0)), vec3(0.04));
        color += u_lightData[i].color * (intensity
            * (milk_medium_response + fresnel
            * (coat_reflection_scale * 0.5 * mx_ggx_light_2(coat_reflection_ggx_lobe, V, L))));
    }
    // environment: milk_medium
    vec3 milk_medium_product = slab_medium_bsdf_albedo
        * textureLod(u_envIrradiance, mx_map_point(normalize(mat3(u_envMatrix) * facing)), 0.0).xyz;
    color += u_envLightIntensity * ((milk_medium_steady + milk_medium_decaying * pow(milk_medium_decay, vec3(1.145898)))
        * milk_medium_product);
    // environment: coat_reflection
    vec2 coat_reflection_turn = vec2(1.0, 0.0);
    int coat_reflection_count = mx_sample_count(vec2(0.01));
    mx_GgxSamples coat_reflection_ggx_samples = mx_ggx_samples(vec2(0.01), coat_reflection_count, N, V);
    for (int i = 0; i < coat_reflection_count; ++i) {
        mx_GgxLight coat_reflection_light = mx_ggx_reflected(coat_reflection_ggx_samples, i, coat_reflection_turn);
        color += coat_reflection_light.color
            * (mx_fresnel_schlick(coat_reflection_light.cosine, vec3(0.04))
            * (coat_reflection_scale * 0.5 * coat_reflection_light.weight));
        coat_reflection_turn = vec2(-coat_reflection_turn.y, coat_reflection_turn.x) * 0.6754903
            - coat_reflection_turn * 0.7373689;
    }
    out1 = vec4(color, 1.0);
}
