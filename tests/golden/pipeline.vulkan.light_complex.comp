#version 450
// light_complex · pass · mxgen 0.1 · vulkan · 5 closures · 0 textures

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
layout(set = 0, binding = 0, std140) uniform PrivateUniforms {
    vec3 u_viewPosition;
    int u_numActiveLightSources;
    mat4 u_envMatrix;
    int u_envRadianceMips;
    int u_envRadianceSamples;
    float u_envLightIntensity;
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
struct VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
    float geomprop_is_thick;
    vec3 geomprop_diffuse_albedo;
    vec3 geomprop_f0;
    vec3 geomprop_f90;
    float geomprop_roughness;
    float geomprop_anisotropy;
    vec3 geomprop_normal;
    vec3 geomprop_tangent;
    float geomprop_second_roughness;
    float geomprop_second_roughness_weight;
    float geomprop_fuzz_amount;
    vec3 geomprop_fuzz_color;
    float geomprop_fuzz_roughness;
    vec3 geomprop_free_path;
    float geomprop_phase_anisotropy;
    vec3 geomprop_steady;
    vec3 geomprop_color;
    vec3 geomprop_decay;
    float geomprop_spreads;
};
VertexData vd;
vec4 out1;

// The numbers a and b of the linear transform that makes the sheen lobe of roughness r, at the cosine c of the viewer,
// of a clamped cosine (Zeltner, Burley and Chiang 2022):
//     M^-1 = [a 0 b; 0 a 0; 0 0 1] in the plane of V and N
vec2 mx_sheen_transform(const float c, const float r)
{
    return vec2((2.58126 * c + 0.813703 * r) * r / (1.0 + 0.310327 * c * c + 2.60994 * c * r),
        sqrt(1.0 - c) * (r - 1.0) * r * r * r / (0.0000254053 + 1.71228 * c - 1.71506 * c * r + 1.34174 * r * r));
}

// The direction w in the tangent space around N, whose x lies along the unit tangent `x`.
vec3 mx_enter_frame(const vec3 w, const vec3 N, const vec3 x)
{
    return vec3(dot(w, x), dot(w, cross(N, x)), dot(w, N));
}

// The unit tangent along X at the normal N.
vec3 mx_tangent(const vec3 N, const vec3 X)
{
    return normalize(X - dot(X, N) * N);
}

// The sheen lobe of roughness r from L to V, where V has the cosine c (Zeltner, Burley and Chiang 2022).
float mx_sheen_zeltner(const vec3 N, const vec3 V, const vec3 L, const float c, const float r)
{
    vec2 m = mx_sheen_transform(c, r);
    vec3 l = mx_enter_frame(L, N, mx_tangent(N, V + 0.00001 * N.yzx));
    vec3 w = vec3(m.x * l.x + m.y * l.z, m.x * l.y, l.z);
    float scale = m.x / dot(w, w);
    return max(w.z, 0.0) / 3.1415927 * scale * scale;
}

// Reflectance at grazing angles: the hue of f90 with the brightness 1. The interface fades out where f0 falls below
// 0.02, less than any matter reflects.
vec3 mx_slab_grazing(const vec3 f0, const vec3 f90)
{
    return max(f90, vec3(0.0)) / max(max(f90.x, max(f90.y, f90.z)), 1e-8)
        * clamp(50.0 * max(f0.x, max(f0.y, f0.z)), 0.0, 1.0);
}

// Axes of the tangent space around N with x along X: `w * frame` enters it, `frame * w` leaves it.
mat3 mx_frame(const vec3 N, const vec3 X)
{
    mat3 frame;
    frame[0] = normalize(X - dot(X, N) * N);
    frame[1] = cross(N, frame[0]);
    frame[2] = N;
    return frame;
}

// The round lobe that stands for an anisotropic one towards v, a direction in its frame: its roughness (x), its cosine
// of v (y), and how far facets face v more than those of the round lobe (z).
vec3 mx_ggx_round_like(const vec2 alpha, const vec3 v)
{
    vec2 slope = v.xy * alpha;
    float square = dot(slope, slope) + v.z * v.z;
    float m = 0.5 * (alpha.x + alpha.y);
    float shape = 0.5 * (alpha.x - alpha.y) / m;
    float d = shape * shape;
    float w = shape * (slope.x * slope.x - slope.y * slope.y) / square;
    float z = v.z * inversesqrt(square);
    float by_shape = 2.2948 + z * (0.4077 - z * 0.9768 - m * 1.2426) + m * (-0.3067 - m * 0.1914)
        + d * (-1.3213 + z * 0.8393 + m * 0.5168 - w * 0.4015 + d * 0.1179);
    float by_turn = -1.107 + z * (-2.1285 + z * (0.2635 - z * 1.0931) + m * 3.7599) + m * (1.5833 - m * 1.2029)
        + d * (0.9877 + z * 0.4531 - m * 0.6085) + w * (-0.6818 - z * 1.0142 + m * 0.6407 + d * 0.6879 - w * 0.1762);
    float a = m * sqrt(max(1.0 + d * by_shape + w * by_turn, 0.05));
    float stretch = sqrt(v.z * v.z + dot(slope, slope) / (a * a));
    return vec3(a, v.z / stretch, stretch);
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

// The albedo (x), and the mean of (1 - cos)^5 (y) where all cosines are as many times greater.
vec2 mx_ggx_facing_more(const vec2 albedo, const float times)
{
    float x = clamp(1.0 - (1.0 - pow(albedo.y, 0.2)) * times, 0.0, 1.0);
    return vec2(albedo.x, x * x * x * x * x);
}

// Schlick's curve from f0 to f90 at a cosine, less `bend` times cos (1 - cos)^6.
// Here bend = vec3(0.0), exponent = 5.0.
vec3 mx_fresnel_schlick(const float cosine, const vec3 f0, const vec3 f90)
{
    float x = 1.0 - cosine;
    return mix(f0, f90, x * x * x * x * x);
}

// GGX distribution of normals, at a normal that the roughness stretched to e; `area` is the product of the roughness
// along x and y (Burley 2012, appendix B.2, equation 13).
float mx_ggx_distribution(const vec3 e, const float area)
{
    return 1.0 / (3.1415927 * area * dot(e, e) * dot(e, e));
}

// Masking and shadowing of the directions v and l over 4 cos_v, each with the roughness in its direction (Heitz 2014,
// equations 80 and 99).
float mx_ggx_smith_visibility(const vec3 v, const vec3 l, const vec2 alpha)
{
    return 0.5 * l.z / (v.z * length(vec3(l.xy * alpha, l.z)) + l.z * length(vec3(v.xy * alpha, v.z)));
}

// The lobe of the facets from L to V, without Fresnel's factor, with masking by direction.
float mx_ggx_smith_lobe(const vec2 roughness, const mat3 frame, const vec3 V, const vec3 L)
{
    vec2 alpha = clamp(roughness, vec2(1e-8), vec2(1.0));
    return mx_ggx_distribution(normalize(V + L) * frame / vec3(alpha, 1.0), alpha.x * alpha.y)
        * mx_ggx_smith_visibility(max(V * frame, vec3(-1.0, -1.0, 1e-8)), max(L * frame, vec3(-1.0, -1.0, 1e-8)),
        alpha);
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
// Here is_round = false.
mx_GgxLobe mx_ggx_lobe(const vec2 roughness, const vec3 N, const vec3 X, const vec3 V)
{
    vec2 alpha = clamp(roughness, vec2(1e-8), vec2(1.0));
    float cosine = max(abs(dot(N, V)), 1e-8);
    return mx_GgxLobe(faceforward(N, -V, N), cosine, normalize(X - dot(X, N) * N), alpha,
        mx_ggx_masking(cosine, alpha.x * alpha.y));
}

// The GGX lobe of a surface as samples of the environment see it.
// Here is_round = false.
mx_GgxSamples mx_ggx_samples(const vec2 roughness, const int count, const vec3 N, const vec3 X, const vec3 V)
{
    mx_GgxLobe lobe = mx_ggx_lobe(roughness, N, X, V);
    vec3 x = lobe.x;
    mat3 frame = mat3(x, cross(lobe.N, x), lobe.N);
    vec3 v = vec3((V * frame).xy, lobe.cosine);
    vec3 stretch = vec3(lobe.alpha, 1.0);
    float reach = length(v * stretch);
    float area = stretch.x * stretch.y;
    float share = 1.0 / float(count);
    return mx_GgxSamples(mat3(u_envMatrix) * frame, stretch, area, v, lobe.masking, reach, share * (v.z + reach),
        area * (v.z + lobe.masking) * max(2.0 / float(count), 4.4 / float(max(u_envRadianceSamples, 1)))
        * exp2(2.0 * float(u_envRadianceMips) - 4.6485), u_envLightIntensity * (share * (v.z + lobe.masking)));
}

// Light of the environment from the unit direction d of its picture, filtered over as many texels.
vec3 mx_filtered_light(const vec3 d, const float texels)
{
    return textureLod(u_envRadiance, mx_map_point(d), 0.5 * log2(texels * inversesqrt(mx_map_square(d)))).xyz;
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

// The light that the facet of sample i reflects, with masking by direction.
mx_GgxLight mx_ggx_reflected_by_direction(const mx_GgxSamples s, const int i, const vec2 turn)
{
    mx_GgxFacet facet = mx_ggx_facet(s, i, turn);
    vec3 l = facet.mirror * facet.h - s.v;
    float cos_l = max(l.z, 1e-8);
    return mx_GgxLight(mx_filtered_light(s.to_map * l, facet.texels),
        u_envLightIntensity * s.step * cos_l / (s.v.z * length(vec3(l.xy * s.stretch.xy, l.z)) + cos_l * s.reach),
        sqrt(clamp(0.5 * (facet.mirror * facet.cosine), 1e-8, 1.0)));
}

// A body whose medium scatters is seen through nowhere.
float mx_slab_is_thick(const vec3 color, const vec3 mean_free_path, const float is_body, const float scatters)
{
    return max(mean_free_path.x, max(mean_free_path.y, mean_free_path.z)) <= 0.0
        || (scatters == 0.0 && max(color.x, max(color.y, color.z)) <= 0.0) ? 0.0 : is_body;
}

// Light that arrives at a point of a circle of this curvature by subsurface scattering, where the cosine of the light
// is cos_l: Burley's normalised diffusion (Christensen 2015) around the circle (after Penner 2011, "Pre-integrated skin
// shading").
// Here curvature = 1.0.
float mx_subsurface_light(const float radius, const float cos_l)
{
    float x = max(radius, 1e-6);
    vec3 bend = (vec3(0.1573, 0.0104, 0.1632) + x * (vec3(0.662, 0.1732, 0.6079) + x * vec3(0.6075, 0.4138, 0.8133)))
        / (6.2831855 * (0.1602 + x * (0.6652 + x)));
    return bend.x * cos_l + sqrt(bend.y * bend.y + (bend.z * bend.z - bend.y * bend.y) * (cos_l * cos_l));
}

// Light that arrives by subsurface scattering, with a radius for each channel.
// Here curvature = 1.0.
vec3 mx_subsurface_light(const vec3 radius, const float cos_l)
{
    vec3 light = vec3(0.0);
    for (int i = 0; i < 3; ++i)
        light[i] = mx_subsurface_light(radius[i], cos_l);
    return light;
}

// Light that the layer of a medium reflects and lets through (`transmitted`), with all orders of scattering, on a way:
// a is the albedo of one scattering, t the optical depth (after Kubelka and Munk 1931).
vec3 mx_medium_layer(const vec3 a, const vec3 t, const float way, out vec3 transmitted)
{
    vec3 u = t / (vec3(1.0) + t);
    float x = way - 1.0;
    vec3 s = 0.5 * a * way * (vec3(1.0) + u
        * (vec3(-1.029) + u * (vec3(0.5422) - 0.3924 * a) + a * (vec3(0.7451) + 0.3145 * a)
        + x * (vec3(1.1669) - 1.3629 * a)));
    vec3 k = (vec3(1.0) - a) * way * (vec3(1.0)
        + a * u * (vec3(0.604) + u * (vec3(-0.1979) - 0.4865 * a) + a * (vec3(1.393) - 0.5447 * a)
        + x * (vec3(0.2436) - 2.0559 * a) + a * a * a * a * (vec3(-0.0215) + 0.5896 * u)));
    vec3 g = sqrt(k * (k + 2.0 * s));
    vec3 e = exp(-g * t);
    vec3 ways = mix((vec3(1.0) - e * e) / max(g, vec3(1e-6)), 2.0 * t * (vec3(1.0) - g * t), step(g * t, vec3(0.001)));
    vec3 below = (k + s) * ways + vec3(1.0) + e * e;
    transmitted = 2.0 * e / below;
    return s * ways / below;
}

// Optical depth, along the normal, of the medium that scatters evenly and stands for one with the phase anisotropy g,
// by similarity.
// Here thickness = 1.0.
vec3 mx_medium_depth(const vec3 loss, const vec3 mean_free_path, const float g)
{
    float forward = clamp(g, -0.95, 0.95);
    return vec3(1.0) / max(mean_free_path, vec3(1e-6)) * (1.0 - forward) / (vec3(1.0) - forward * loss * loss);
}

// The number s of a medium that reflects `color` at infinite thickness: the albedo of one scattering is 1 - s^2 (Kulla
// and Conty 2017, "Revisiting Physically Based Shading at Imageworks").
vec3 mx_medium_loss(const vec3 color)
{
    vec3 c = clamp(color, vec3(0.0), vec3(1.0));
    return mix(clamp(vec3(4.09712) + 4.20863 * c - sqrt(vec3(9.59217) + c * (vec3(41.6808) + 17.7126 * c)), vec3(0.0),
        vec3(1.0)), vec3(1.0), step(c, vec3(0.0)));
}

// Light that the layer of a medium reflects on a way.
// Here thickness = 1.0.
vec3 mx_medium_reflected(const vec3 color, const vec3 mean_free_path, const float g, const float way)
{
    if (max(color.x, max(color.y, color.z)) <= 0.0)
        return vec3(0.0);
    vec3 ignored;
    vec3 loss = mx_medium_loss(color);
    return mx_medium_layer(vec3(1.0) - loss * loss, mx_medium_depth(loss, mean_free_path, g), way, ignored);
}

// How far light goes through a medium of index 1.5, over the thickness, on its way to or from V.
float mx_way(const vec3 N, const vec3 V)
{
    float c = dot(N, V);
    return 1.5 * inversesqrt(1.25 + c * c);
}

// Reciprocal, with the albedo of the viewer's way.
// Here thickness = 1.0.
vec3 mx_slab_thin_light(const vec3 color, const vec3 mean_free_path, const float phase_anisotropy, const vec3 N,
    const vec3 V, const vec3 L)
{
    return mx_medium_reflected(color, mean_free_path, phase_anisotropy, mx_way(N, V))
        / max(mx_medium_reflected(color, mean_free_path, phase_anisotropy, 1.145898), vec3(1e-8))
        * (mx_medium_reflected(color, mean_free_path, phase_anisotropy, mx_way(N, L))
        * (max(dot(faceforward(N, -V, N), L), 0.0) / 3.1415927));
}

// x^5.
float mx_power5(const float x)
{
    return x * x * x * x * x;
}

// Height and fall of the bump of light that a rough surface of gloss g sends back.
vec2 mx_chan_bump(const float g)
{
    return vec2((34.5 * g - 59.0) * g + 24.5, max(73.2 * g - 21.2, 8.9));
}

// Chan's diffuse lobe of gloss g, times its directional albedo, for a light whose half vector has the cosine cos_d to
// V; `even` is the part that a smooth surface lets out to the viewer.
float mx_chan_lobe(const float g, const float cos_v, const float cos_l, const float cos_d, const float even)
{
    vec2 bump = mx_chan_bump(g);
    return max(mix(cos_d + mx_power5(1.0 - cos_d), even * (1.0 - 0.75 * mx_power5(1.0 - cos_l)),
        clamp(2.2 * g - 0.5, 0.0, 1.0)) + bump.x * cos_d
        * exp2(-bump.y * sqrt(min((cos_l + cos_v) / (2.0 * cos_d), 1.0))), 0.0);
}

// 1 / (pi times the directional albedo) of Chan's lobe of gloss g at the cosine c, within 0.0012.
float mx_chan_share(const float c, const float g)
{
    vec4 fit = mat4(0.711052, 0.000476, 0.474855, 0.02628, 0.152583, 0.003146, 1.026027, -0.718545, 0.102579, -0.004832,
        -2.223248, 0.347306, -0.053764, 0.001611, 2.069558, -0.492125) * vec4(1.0, c, c * c, c * c * c);
    vec2 bump = mx_chan_bump(g);
    return 1.0 / (3.1415927 * (mix(fit.x, 0.96428573 * (1.0 - 0.75 * mx_power5(1.0 - c)),
        clamp(2.2 * g - 0.5, 0.0, 1.0)) + bump.x * exp2((8.9 - bump.y) * fit.z) * fit.y / (fit.w + c)));
}

// Chan's diffuse lobe over its directional albedo, times the cosine of L, for the albedo 1.
float mx_chan(const float g, const vec3 N, const vec3 V, const vec3 L)
{
    float cos_v = max(abs(dot(N, V)), 1e-8);
    float cos_l = max(dot(faceforward(N, -V, N), L), 1e-8);
    return mx_chan_lobe(g, cos_v, cos_l, sqrt(clamp(0.500001 + 0.5 * dot(V, L), 0.0, 1.0)),
        1.0 - 0.75 * mx_power5(1.0 - cos_v)) * cos_l * mx_chan_share(cos_v, g);
}

// Gloss of Chan's diffuse lobe for a roughness, 0 to 1 (Chan 2018, "Material Advances in Call of Duty: WWII").
float mx_chan_gloss(const float roughness)
{
    float square = clamp(roughness * roughness, 0.001, 1.0);
    return clamp(log2(2.0 / (square * square) - 1.0) / 18.0, 0.0, 1.0);
}

// The light from L that the closure reflects to V, without its weight.
// Here thickness = 1.0.
vec3 mx_slab_medium_bsdf_eval(const vec3 color, const float roughness, const vec3 mean_free_path,
    const float phase_anisotropy, const vec3 N, const vec3 V, const vec3 L)
{
    if (max(mean_free_path.x, max(mean_free_path.y, mean_free_path.z)) <= 0.0)
        return color * mx_chan(mx_chan_gloss(roughness), N, V, L);
    if (max(color.x, max(color.y, color.z)) <= 0.0)
        return vec3(0.0);
    return mx_slab_thin_light(color, mean_free_path, phase_anisotropy, N, V, L);
}

void surface()
{
    vec3 color = vec3(0.0);
    // lights: fuzz, second_reflection, reflection
    // complex_slab
    float fuzz_weight = clamp(vd.geomprop_fuzz_amount, 0.0, 1.0);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    float c = dot(vd.geomprop_normal, V);
    float cos_v = max(abs(c), 1e-8);
    float r = clamp(vd.geomprop_fuzz_roughness < 0.0 ? vd.geomprop_roughness : vd.geomprop_fuzz_roughness, 0.01, 1.0);
    float width = r * (r * 1.58491 + 0.0206607) / (r * (r + 1.32227) + 0.0379424);
    float x = (cos_v - r * (r * (r * (1.7932 - r * (r * 0.95943)) - 1.14885) - 0.193854) / (r + 0.046391)) / width;
    float fuzz_ratio = exp(x * (x * -0.5)) / (width * 2.5066283);
    float fuzz_product = r * (r * (r * 0.119681 - 0.0207818) + 0.000654023);
    float sheen_albedo = max(fuzz_ratio + fuzz_product / (r * (r - 1.92021) + 1.26264), 0.0);
    vec3 fuzz_factor = vd.geomprop_fuzz_color * sheen_albedo;
    vec3 Nf = faceforward(vd.geomprop_normal, -V, vd.geomprop_normal);
    float limited_cos_v = min(cos_v, 1.0);
    vec3 power_of_decay = pow(vd.geomprop_decay, vec3(1.145898));
    vec3 light = vd.geomprop_spreads > 0.0 ? vd.geomprop_color * power_of_decay : vd.geomprop_color;
    vec3 decay = vd.geomprop_spreads > 0.0 ? vec3(1.0) : vd.geomprop_decay;
    vec3 N = normalize(vd.normalWorld);
    float second_reflection_weight = clamp(vd.geomprop_second_roughness_weight, 0.0, 1.0);
    vec3 fresnel_f0 = max(vd.geomprop_f0, 0.0);
    vec3 grazing = mx_slab_grazing(vd.geomprop_f0, vd.geomprop_f90);
    vec3 mean_fresnel = mix(fresnel_f0, grazing, 0.04761905);
    vec2 vector = vec2(vd.geomprop_anisotropy + 1.0, 1.0 - vd.geomprop_anisotropy);
    vec2 second_alpha = vd.geomprop_second_roughness * vd.geomprop_second_roughness * vector;
    vec2 second_reflection_alpha = clamp(second_alpha, 1e-8, 1.0);
    mat3 frame = mx_frame(Nf, vd.geomprop_tangent);
    vec3 ggx_local = max(V * frame, vec3(-1.0, -1.0, 1e-8));
    vec3 second_reflection_round_lobe = mx_ggx_round_like(second_reflection_alpha, ggx_local);
    vec2 second_reflection_alpha_2 = clamp(second_reflection_round_lobe.xx, 1e-8, 1.0);
    vec2 second_reflection_albedo = mx_ggx_facing_more(mx_ggx_albedo_fit(sqrt(second_reflection_alpha_2.x
        * second_reflection_alpha_2.y), second_reflection_round_lobe.y), second_reflection_round_lobe.z);
    vec3 second_reflection_scale = mean_fresnel * (1.0 / second_reflection_albedo.x - 1.0) + vec3(1.0);
    float fuzz_throughput = 1.0 - fuzz_weight * sheen_albedo;
    bool reflection_visible = 1.0 - second_reflection_weight > 0.0;
    float scaled_roughness = vd.geomprop_roughness * vd.geomprop_roughness;
    vec2 alpha = vector * scaled_roughness;
    vec2 reflection_alpha = clamp(alpha, 1e-8, 1.0);
    vec3 reflection_round_lobe = mx_ggx_round_like(reflection_alpha, ggx_local);
    vec2 reflection_alpha_2 = clamp(reflection_round_lobe.xx, 1e-8, 1.0);
    vec2 reflection_albedo = mx_ggx_facing_more(mx_ggx_albedo_fit(sqrt(reflection_alpha_2.x * reflection_alpha_2.y),
        reflection_round_lobe.y), reflection_round_lobe.z);
    vec3 reflection_scale = mean_fresnel * (1.0 / reflection_albedo.x - 1.0) + vec3(1.0);
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
        // fuzz
        vec3 light_color = u_lightData[i].color;
        float cosine = dot(L, N);
        vec3 power = pow(decay, vec3(inversesqrt(cosine * cosine + 1.25) * 1.5));
        if (fuzz_weight > 0.0) {
            float fuzz_sheen_zeltner = mx_sheen_zeltner(Nf, V, L, limited_cos_v, r);
            color += light_color * (intensity
                * (fuzz_factor * (fuzz_sheen_zeltner * (fuzz_weight * (vd.geomprop_steady + light * power)))));
        }
        // second_reflection
        float half_cosine = sqrt(clamp(dot(V, L) * 0.5 + 0.500001, 0.0, 1.0));
        vec3 fresnel = mx_fresnel_schlick(half_cosine, fresnel_f0, grazing);
        vec3 sum = vd.geomprop_steady * fuzz_throughput + fuzz_throughput * light * power;
        if (second_reflection_weight > 0.0)
            color += light_color * (intensity
                * (second_reflection_scale
                * (fresnel * (mx_ggx_smith_lobe(second_alpha, frame, V, L) * (second_reflection_weight * sum)))));
        // reflection
        if (reflection_visible) {
            float reflection_ggx_smith_lobe = mx_ggx_smith_lobe(alpha, frame, V, L);
            color += light_color * (intensity
                * (reflection_scale * (fresnel
                * (reflection_ggx_smith_lobe * ((1.0 - second_reflection_weight) * sum)))));
        }
    }
    // environment: fuzz
    float cosine = dot(V, N);
    vec3 power = pow(decay, vec3(inversesqrt(cosine * cosine + 1.25) * 1.5));
    vec3 part = textureLod(u_envIrradiance, mx_map_point(normalize(mat3(u_envMatrix) * Nf)), 0.0).xyz;
    if (fuzz_weight > 0.0)
        color += fuzz_weight * (vd.geomprop_steady + light * power) * (vd.geomprop_fuzz_color * part)
            * (sheen_albedo * u_envLightIntensity);
    // environment: second_reflection
    vec3 sum = vd.geomprop_steady * fuzz_throughput + fuzz_throughput * light * power;
    if (second_reflection_weight > 0.0) {
        vec2 turn = vec2(1.0, 0.0);
        int second_reflection_count = mx_sample_count(second_reflection_alpha);
        vec3 second_reflection_factor = second_reflection_scale * (second_reflection_weight * sum);
        mx_GgxSamples second_reflection_ggx_samples = mx_ggx_samples(second_alpha, second_reflection_count,
            vd.geomprop_normal, vd.geomprop_tangent, V);
        for (int i = 0; i < second_reflection_count; ++i) {
            mx_GgxLight second_reflection_light = mx_ggx_reflected_by_direction(second_reflection_ggx_samples, i, turn);
            color += second_reflection_factor
                * (second_reflection_light.color
                * (second_reflection_light.weight
                * mx_fresnel_schlick(second_reflection_light.cosine, fresnel_f0, grazing)));
            turn = vec2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
        }
    }
    // environment: reflection
    if (reflection_visible) {
        vec2 turn = vec2(1.0, 0.0);
        int reflection_count = mx_sample_count(reflection_alpha);
        vec3 reflection_factor = reflection_scale * ((1.0 - second_reflection_weight) * sum);
        mx_GgxSamples reflection_ggx_samples = mx_ggx_samples(alpha, reflection_count, vd.geomprop_normal,
            vd.geomprop_tangent, V);
        for (int i = 0; i < reflection_count; ++i) {
            mx_GgxLight reflection_light = mx_ggx_reflected_by_direction(reflection_ggx_samples, i, turn);
            color += reflection_factor * (reflection_light.color
                * (reflection_light.weight * mx_fresnel_schlick(reflection_light.cosine, fresnel_f0, grazing)));
            turn = vec2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
        }
    }
    // lights: subsurface, medium
    float inside_subsurface_weight = clamp(mx_slab_is_thick(vd.geomprop_diffuse_albedo, vd.geomprop_free_path,
        vd.geomprop_is_thick, vd.geomprop_is_thick), 0.0, 1.0);
    vec3 reflection_throughput = vec3(1.0)
        - (vec3(1.0) - max(vec3(1.0) - mix(fresnel_f0, grazing, reflection_albedo.y) * reflection_albedo.x
        * reflection_scale, 0.0));
    vec3 inside_weight = fuzz_throughput
        * mix(reflection_throughput, vec3(1.0)
        - (vec3(1.0) - max(vec3(1.0) - mix(fresnel_f0, grazing, second_reflection_albedo.y) * second_reflection_albedo.x
        * second_reflection_scale, 0.0)), second_reflection_weight);
    vec3 product = vd.geomprop_steady * inside_weight;
    bool medium_visible = 1.0 - inside_subsurface_weight > 0.0;
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
        // subsurface
        float cosine_2 = dot(N, L);
        vec3 vector_closure_way = vec3(inversesqrt(cosine_2 * cosine_2 + 1.25) * 1.5);
        if (inside_subsurface_weight > 0.0) {
            vec3 subsurface_weight = inside_subsurface_weight
                * (product + inside_weight * light * pow(decay, vector_closure_way));
            color += u_lightData[i].color
                * (intensity * (vd.geomprop_diffuse_albedo
                * (mx_subsurface_light(vd.geomprop_free_path, dot(Nf, L)) * subsurface_weight)));
        }
        // medium
        if (medium_visible) {
            vec3 medium_slab_medium_bsdf_eval = mx_slab_medium_bsdf_eval(vd.geomprop_diffuse_albedo,
                vd.geomprop_roughness, vd.geomprop_free_path, vd.geomprop_phase_anisotropy, vd.geomprop_normal, V, L);
            color += u_lightData[i].color
                * (intensity * (medium_slab_medium_bsdf_eval
                * ((1.0 - inside_subsurface_weight)
                * (product + vd.geomprop_color * inside_weight * pow(vd.geomprop_decay, vector_closure_way)))));
        }
    }
    // environment: subsurface
    if (inside_subsurface_weight > 0.0)
        color += u_envLightIntensity * (inside_subsurface_weight * (product + inside_weight * light * power)
            * (vd.geomprop_diffuse_albedo * part));
    // environment: medium
    if (medium_visible) {
        bool is_black = max(vd.geomprop_free_path.x, max(vd.geomprop_free_path.y, vd.geomprop_free_path.z)) <= 0.0;
        float way = inversesqrt(c * c + 1.25) * 1.5;
        vec3 slab_medium_bsdf_albedo = is_black ? vd.geomprop_diffuse_albedo
            : mx_medium_reflected(vd.geomprop_diffuse_albedo, vd.geomprop_free_path, vd.geomprop_phase_anisotropy, way);
        float square = clamp(scaled_roughness, 0.001, 1.0);
        float chan_gloss = clamp(log2(2.0 / (square * square) - 1.0) / 18.0, 0.0, 1.0);
        float s = clamp(chan_gloss * 2.2 - 0.5, 0.0, 1.0);
        float medium_product = (1.0 - chan_gloss * 1.085) * (1.0 - s * (s * 1.1414));
        vec2 medium_map_point = mx_map_point(normalize(mat3(u_envMatrix)
            * (is_black ? Nf + V * ((cos_v * (cos_v * 0.5624 - 0.7155) + 0.4353) * medium_product) : Nf)));
        vec3 medium_light = slab_medium_bsdf_albedo
            * (u_envLightIntensity * textureLod(u_envIrradiance, medium_map_point, 0.0).xyz);
        vec3 slab_medium_bsdf_environment = max(vd.geomprop_diffuse_albedo.x,
            max(vd.geomprop_diffuse_albedo.y, vd.geomprop_diffuse_albedo.z)) <= 0.0 ? vec3(0.0) : medium_light;
        color += slab_medium_bsdf_environment
            * ((1.0 - inside_subsurface_weight) * (product + power_of_decay * (vd.geomprop_color * inside_weight)));
    }
    out1 = vec4(color, 1.0);
}

#define MX_CLASS 3
#define MX_NUM_CLASSES 5
#define MX_TILE 8
#define MX_SCATTERED 0
#define MX_BELOW 0
#define MX_STORAGE 0
#define MX_BLUR 0
#define MX_PAYLOAD_WORDS 16
#define MX_EMPTY 0
#define MX_SIMPLE 1
#define MX_SINGLE 2
#define MX_COMPLEX 3
#define MX_SPECIAL 4
// A slab, with what lies above it: light on a way x through media weighs steady + color * pow(decay, x).
struct MxClosure
{
    vec3 diffuse_albedo;
    vec3 f0;
    vec3 f90;
    float roughness;
    float anisotropy;
    vec3 normal;
    vec3 tangent;
    float second_roughness;
    float second_roughness_weight;
    float fuzz_amount;
    vec3 fuzz_color;
    float fuzz_roughness;
    vec3 free_path; // over the thickness of the medium, or over the radius of the surface of a body
    float phase_anisotropy;
    float is_thick;
    float glint_density;
    vec2 glint_uv;
    vec2 glint_extent; // how far a pixel goes along each coordinate
    float tint_index; // number of the table
    float tint_weight;
    float blur; // deviation on the surface, in the world
    vec3 steady;
    vec3 color;
    vec3 decay;
    float spreads;
};

// The storage of closures (docs/deferred.md): how values become bits, for those who write and those who read. MX_STORAGE: 0 rounds with
// dither, 1 rounds, 2 keeps whole floats. MX_BLUR: 1 where rough interfaces blur what lies below.

// Features that a closure has beside f0, albedo and roughness: one word each, two for weights. Bits 20 to 27 of its
// first word.
const uint MX_HAS_WEIGHTS = 1u, MX_HAS_MEDIUM = 2u, MX_HAS_LOBES = 4u, MX_HAS_FUZZ = 8u, MX_HAS_ANISOTROPY = 16u;
const uint MX_IS_SMOOTH = 32u;  // the closure on top, without a diffuse albedo: it has one word less
const uint MX_NORMAL_SHIFT = 6; // 0: the normal of the top, 1: in a word of its own, 2: the last such word, 3: the one before it

// A tint has one word more, glints have four. Bits 28 to 30 of the first word, where bit 30 is set; else bits 28 and 29
// of word 0 are the class.
const uint MX_HAS_TINT = 256u, MX_HAS_GLINTS = 512u, MX_IS_SPECIAL = 1024u;

// The words of a closure.
struct MxRecord
{
    uint core, body, weights[2], medium, lobes, fuzz, anisotropy, tint, glints[4], normal;
};

// The class of a pixel by its first word.
uint mx_class(uint first)
{
    return ((first >> 20u) & MX_IS_SPECIAL) != 0u ? uint(MX_SPECIAL) : first >> 28u;
}

// The features of a closure.
uint mx_features(uint core)
{
    return (core >> 20u) & (((core >> 20u) & MX_IS_SPECIAL) != 0u ? 0x3ffu : 0xffu);
}

// ---- numbers of few bits ---------------------------------------------------------------------------------------------

// Interleaved gradient noise of a pixel, from 0 to below 1 (Jimenez 2014, "Next Generation Post Processing in Call of
// Duty: Advanced Warfare").
float mx_gradient_noise(vec2 pixel)
{
    return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
}

#if MX_STORAGE == 0
// The noise of the pixel, from 0 to 7 eighths: what is added before a number is cut off.
uint mx_noise = 4u;

// Chooses the noise of a pixel, before its numbers are cut.
void mx_start_noise(vec2 pixel)
{
    mx_noise = uint(8.0 * mx_gradient_noise(pixel));
}

// The noise of a channel. Channels differ by 5 eighths, near the golden ratio.
uint mx_noise_of(uint channel)
{
    return (mx_noise + 5u * channel) & 7u;
}

// A number from 0 to 1 in eighths of the steps of its bits. Noise has no middle, so its mean is right half an eighth
// further.
uint mx_eighths(float value, uint bits)
{
    return uint(clamp(value, 0.0, 1.0) * 8.0 * float((1u << bits) - 1u) + 0.5);
}

// A number from 0 to 1 in so many bits. Each channel has noise of its own.
uint mx_cut(float value, uint bits, uint channel)
{
    return (mx_eighths(value, bits) + mx_noise_of(channel)) >> 3u;
}

// A colour in 7, 7 and 6 bits. Ten bits hold the eighths of a channel, so that one addition dithers all three.
uint mx_cut_color(vec3 color)
{
    uint eighths = mx_eighths(color.x, 7u) | (mx_eighths(color.y, 7u) << 10u) | (mx_eighths(color.z, 6u) << 20u);
    eighths += mx_noise_of(0u) | (mx_noise_of(1u) << 10u) | (mx_noise_of(2u) << 20u);
    return ((eighths >> 3u) & 0x7fu) | (((eighths >> 13u) & 0x7fu) << 7u) | (((eighths >> 23u) & 0x3fu) << 14u);
}
#else
// The nearest of the numbers from 0 to 1 that so many bits have, alike in all channels.
uint mx_cut(float value, uint bits, uint channel)
{
    return uint(clamp(value, 0.0, 1.0) * float((1u << bits) - 1u) + 0.5);
}

// A colour in 7, 7 and 6 bits.
uint mx_cut_color(vec3 color)
{
    return mx_cut(color.x, 7u, 0u) | (mx_cut(color.y, 7u, 1u) << 7u) | (mx_cut(color.z, 6u, 2u) << 14u);
}
#endif

// A number from 0 to 1 from its bits of a word.
float mx_uncut(uint word, uint shift, uint bits)
{
    return float((word >> shift) & ((1u << bits) - 1u)) / float((1u << bits) - 1u);
}

// A colour from its 20 bits.
vec3 mx_uncut_color(uint word)
{
    return vec3(mx_uncut(word, 0u, 7u), mx_uncut(word, 7u, 7u), mx_uncut(word, 14u, 6u));
}

// A number from -1 to 1 in so many bits. 0 has none of them.
uint mx_cut_signed(float value, uint bits)
{
    float most = float((1u << (bits - 1u)) - 1u);
    return uint(int(round(clamp(value, -1.0, 1.0) * most))) & ((1u << bits) - 1u);
}

// A number from -1 to 1 from its bits of a word.
float mx_uncut_signed(uint word, uint shift, uint bits)
{
    float most = float((1u << (bits - 1u)) - 1u);
    return float(int(word << (32u - bits - shift)) >> int(32u - bits)) / most;
}

// A colour in the encoding of IEC 61966-2-1.
vec3 mx_srgb(vec3 linear)
{
    vec3 c = clamp(linear, 0.0, 1.0);
    return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThan(c, vec3(0.0031308)));
}

// A colour from its encoding of IEC 61966-2-1.
vec3 mx_linear(vec3 srgb)
{
    return mix(pow((srgb + 0.055) / 1.055, vec3(2.4)), srgb / 12.92, lessThan(srgb, vec3(0.04045)));
}

// The place of a direction in the octahedral square (Cigolle et al. 2014, "A Survey of Efficient Representations for
// Independent Unit Vectors").
vec2 mx_octahedral(vec3 n)
{
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    vec2 folded = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
    return (n.z < 0.0 ? folded : p) * 0.5 + 0.5;
}

// A direction from its place in the octahedral square.
vec3 mx_of_octahedral(vec2 square)
{
    vec2 p = square * 2.0 - 1.0;
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    float fold = max(-n.z, 0.0);
    n.xy += vec2(n.x < 0.0 ? fold : -fold, n.y < 0.0 ? fold : -fold);
    return normalize(n);
}

// A direction in so many bits for each axis of the octahedral square.
uint mx_cut_normal(vec3 normal, uint bits)
{
    uvec2 p = uvec2(round(mx_octahedral(normal) * float((1u << bits) - 1u)));
    return p.x | (p.y << bits);
}

// A direction from its bits.
vec3 mx_uncut_normal(uint word, uint bits)
{
    return mx_of_octahedral(vec2(mx_uncut(word, 0u, bits), mx_uncut(word, bits, bits)));
}

// Two axes across a normal (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
void mx_across(vec3 n, out vec3 x, out vec3 y)
{
    float side = n.z < 0.0 ? -1.0 : 1.0, a = -1.0 / (side + n.z), b = n.x * n.y * a;
    x = vec3(1.0 + side * n.x * n.x * a, side * b, -side * n.x);
    y = vec3(b, side + n.y * n.y * a, -n.y);
}

// ---- words -----------------------------------------------------------------------------------------------------------

// The third word of a pixel: normal and roughness of the closure on top.
uint mx_top(vec3 normal, float roughness)
{
    return mx_cut_normal(normal, 12u) | (mx_cut(roughness, 8u, 3u) << 24u);
}

// The normal of the closure on top.
vec3 mx_top_normal(uint word)
{
    return mx_uncut_normal(word & 0xffffffu, 12u);
}

// The roughness of the closure on top.
float mx_top_roughness(uint word)
{
    return mx_uncut(word, 24u, 8u);
}

// The word of a medium: free path, anisotropy of its phase function, and whether it is a body. 0 for opaque matter.
uint mx_medium_word(MxClosure c)
{
    if (max(c.free_path.x, max(c.free_path.y, c.free_path.z)) <= 0.0
        || max(c.diffuse_albedo.x, max(c.diffuse_albedo.y, c.diffuse_albedo.z)) <= 0.0)
        return 0u;
    return max(mx_cut_color(c.free_path / (1.0 + c.free_path)), 1u) | (mx_cut_signed(c.phase_anisotropy, 6u) << 20u)
         | (c.is_thick > 0.0 ? 1u << 26u : 0u);
}

// The word of the lobes: the second roughness with its weight, and the hue of f90.
uint mx_lobes_word(MxClosure c)
{
    uint weight = mx_cut(c.second_roughness_weight, 6u, 4u);
    uint roughness = weight == 0u ? 0u : mx_cut(c.second_roughness, 8u, 5u);
    vec3 hue = max(c.f90, 0.0) / max(max(c.f90.x, max(c.f90.y, c.f90.z)), 1e-6);
    return roughness | (weight << 8u) | (mx_cut(1.0 - hue.x, 6u, 6u) << 14u) | (mx_cut(1.0 - hue.y, 6u, 7u) << 20u)
         | (mx_cut(1.0 - hue.z, 6u, 8u) << 26u);
}

// The word of fuzz: amount, colour and roughness. 0 without fuzz.
uint mx_fuzz_word(MxClosure c)
{
    uint amount = mx_cut(c.fuzz_amount, 6u, 9u);
    return amount == 0u ? 0u : amount | (mx_cut_color(mx_srgb(c.fuzz_color)) << 6u) | (mx_cut(c.fuzz_roughness, 6u, 10u) << 26u);
}

// The word of the anisotropy: amount and tangent, as an angle from the first axis across the normal, below half a
// turn: both its directions are one.
uint mx_anisotropy_word(MxClosure c, vec3 normal)
{
    uint amount = mx_cut_signed(c.anisotropy, 16u);
    vec3 x, y;
    mx_across(normal, x, y);
    float turn = atan(dot(c.tangent, y), dot(c.tangent, x)) / 3.14159265;
    return amount == 0u ? 0u : (uint(round(fract(turn) * 65536.0)) & 0xffffu) | (amount << 16u);
}

// The word of a tint: the number of its table, and how much it tints.
uint mx_tint_word(MxClosure c)
{
    uint weight = mx_cut(c.tint_weight, 8u, 11u);
    return weight == 0u ? 0u : (uint(c.tint_index) & 0xffffu) | (weight << 16u);
}

// The words of glints. Facets need exact places and slopes, so they are not dithered: coordinates; logarithms of the
// extents and of the number; whole turn of the tangent, roughness, what 12 bits of the normal leave, in sixteenths of
// their steps.
uint[4] mx_glint_words(MxClosure c, vec3 normal)
{
    vec2 extent = clamp((log2(max(c.glint_extent, 1e-12)) + 24.0) / 32.0, 0.0, 1.0); // from 2^-24 to 2^8
    vec3 x, y;
    mx_across(normal, x, y);
    float turn = atan(dot(c.tangent, y), dot(c.tangent, x)) / 6.2831853;
    ivec2 rest = ivec2(round(clamp((mx_octahedral(c.normal) - mx_octahedral(normal)) * 65520.0, -8.0, 7.0))) & 15;
    return uint[4](floatBitsToUint(c.glint_uv.x), floatBitsToUint(c.glint_uv.y),
                   uint(round(extent.x * 1023.0)) | (uint(round(extent.y * 1023.0)) << 10u)
                 | (max(uint(round(clamp(c.glint_density / 32.0, 0.0, 1.0) * 4095.0)), 1u) << 20u),
                   (uint(round(fract(turn) * 4096.0)) & 0xfffu) | (uint(round(clamp(c.roughness, 0.0, 1.0) * 4095.0)) << 12u)
                 | (uint(rest.x) << 24u) | (uint(rest.y) << 28u));
}

// The three bits of a blur: 0 for none, else its logarithm, in seven steps up to a half.
uint mx_blur_bits(float blur)
{
    float steps = clamp(log2(max(blur, 1e-12)) + 8.0, 0.0, 7.0);
    return mx_cut(steps / 7.0, 3u, 12u);
}

// The blur from its three bits.
float mx_blur_of(uint bits)
{
    return bits == 0u ? 0.0 : exp2(float(bits) - 8.0);
}

// The class of a pixel or ray with one closure that has these features.
uint mx_class_of(uint has)
{
    if ((has & MX_IS_SPECIAL) != 0u)
        return uint(MX_SPECIAL);
    return (has & (MX_HAS_ANISOTROPY | MX_HAS_WEIGHTS)) != 0u ? MX_COMPLEX : has != 0u ? MX_SINGLE : MX_SIMPLE;
}

// The first word of a closure, without its features: the roots of f0.
uint mx_core(MxClosure c)
{
    return mx_cut_color(sqrt(clamp(c.f0, 0.0, 1.0)));
}

// The second word of a closure: diffuse albedo and roughness.
uint mx_body(MxClosure c)
{
    return mx_cut_color(mx_srgb(c.diffuse_albedo)) | (mx_cut(c.roughness, 8u, 3u) << 20u);
}

// All words of a closure but its normal, which the caller chooses. stored_normal: as it will be read.
MxRecord mx_pack(MxClosure c, vec3 stored_normal)
{
    MxRecord r;
    uint steady = mx_cut_color(1.0 - c.steady), color = mx_cut_color(c.color), decay = color == 0u ? 0u : mx_cut_color(c.decay);
    r.weights[0] = steady | (color << 20u);
    r.weights[1] = (color >> 12u) | (decay << 8u) | (decay != 0u && c.spreads > 0.0 ? 1u << 28u : 0u);
#if MX_BLUR == 1
    r.weights[1] |= mx_blur_bits(c.blur) << 29u;
#endif
    r.medium = mx_medium_word(c);
    r.lobes = mx_lobes_word(c);
    r.fuzz = mx_fuzz_word(c);
    r.anisotropy = mx_anisotropy_word(c, stored_normal);
    r.tint = mx_tint_word(c);
    r.normal = 0u;
    bool has_glints = c.glint_density > 0.0 && max(c.glint_extent.x, c.glint_extent.y) > 0.0;
    r.glints = uint[4](0u, 0u, 0u, 0u);
    if (has_glints)
        r.glints = mx_glint_words(c, stored_normal);
    uint has = ((r.weights[0] | r.weights[1]) != 0u ? MX_HAS_WEIGHTS : 0u) | (r.medium != 0u ? MX_HAS_MEDIUM : 0u)
             | (r.lobes != 0u ? MX_HAS_LOBES : 0u) | (r.fuzz != 0u ? MX_HAS_FUZZ : 0u)
             | (r.anisotropy != 0u ? MX_HAS_ANISOTROPY : 0u) | (r.tint != 0u ? MX_HAS_TINT | MX_IS_SPECIAL : 0u)
             | (has_glints ? MX_HAS_GLINTS | MX_IS_SPECIAL : 0u);
    r.core = mx_core(c) | (has << 20u);
    r.body = mx_body(c);
    return r;
}

// A closure from its words, with the normal and roughness that other words have.
MxClosure mx_unpack(MxRecord r, vec3 normal, float roughness)
{
    MxClosure c;
    vec3 root = mx_uncut_color(r.core);
    c.f0 = root * root;
    c.diffuse_albedo = mx_linear(mx_uncut_color(r.body));
    c.normal = normal;
    c.f90 = 1.0 - vec3(mx_uncut(r.lobes, 14u, 6u), mx_uncut(r.lobes, 20u, 6u), mx_uncut(r.lobes, 26u, 6u));
    c.second_roughness = mx_uncut(r.lobes, 0u, 8u);
    c.second_roughness_weight = mx_uncut(r.lobes, 8u, 6u);
    c.fuzz_amount = mx_uncut(r.fuzz, 0u, 6u);
    c.fuzz_color = mx_linear(mx_uncut_color(r.fuzz >> 6u));
    c.fuzz_roughness = mx_uncut(r.fuzz, 26u, 6u);
    vec3 part = mx_uncut_color(r.medium);
    c.free_path = part / max(1.0 - part, 1e-6);
    c.phase_anisotropy = mx_uncut_signed(r.medium, 20u, 6u);
    c.is_thick = float((r.medium >> 26u) & 1u);
    c.anisotropy = mx_uncut_signed(r.anisotropy, 16u, 16u);
    vec3 x, y;
    mx_across(normal, x, y);
    bool has_glints = r.glints[2] != 0u;
    float turn = has_glints ? float(r.glints[3] & 0xfffu) / 4096.0 * 6.2831853 : float(r.anisotropy & 0xffffu) / 65536.0 * 3.14159265;
    c.roughness = has_glints ? mx_uncut(r.glints[3], 12u, 12u) : roughness;
    ivec2 rest = ivec2(int(r.glints[3] << 4u) >> 28, int(r.glints[3]) >> 28);
    if (has_glints)
        c.normal = mx_of_octahedral(mx_octahedral(normal) + vec2(rest) / 65520.0);
    c.glint_density = mx_uncut(r.glints[2], 20u, 12u) * 32.0;
    c.glint_uv = vec2(uintBitsToFloat(r.glints[0]), uintBitsToFloat(r.glints[1]));
    c.glint_extent = exp2(vec2(mx_uncut(r.glints[2], 0u, 10u), mx_uncut(r.glints[2], 10u, 10u)) * 32.0 - 24.0);
    c.tint_index = float(r.tint & 0xffffu);
    c.tint_weight = mx_uncut(r.tint, 16u, 8u);
    c.tangent = cos(turn) * x + sin(turn) * y;
    c.steady = 1.0 - mx_uncut_color(r.weights[0]);
    c.color = mx_uncut_color((r.weights[0] >> 20u) | (r.weights[1] << 12u));
    c.decay = mx_uncut_color(r.weights[1] >> 8u);
    c.spreads = float((r.weights[1] >> 28u) & 1u);
    c.blur = mx_blur_of(r.weights[1] >> 29u);
    return c;
}
layout(set = 1, binding = 0, r32ui) uniform readonly restrict uimage2DArray mx_words;
layout(set = 1, binding = 1, r32ui) uniform readonly restrict uimage2D mx_word0;
layout(set = 1, binding = 2, r32ui) uniform readonly restrict uimage2D mx_word1;
layout(set = 1, binding = 3, r32ui) uniform readonly restrict uimage2D mx_word2;
layout(set = 1, binding = 4) uniform sampler2D mx_depth;
layout(set = 1, binding = 5) uniform sampler2D mx_color;
layout(set = 1, binding = 6) uniform writeonly restrict image2D mx_lit;
layout(set = 1, binding = 7, std430) readonly buffer MxTiles
{
    uvec4 mx_dispatch[5];
    uint mx_tile[];
};
layout(set = 1, binding = 8, std140) uniform MxFrame
{
    mat4 mx_to_world;
    uvec2 mx_size;
    uint mx_tiles_per_row;
    uint mx_num_tiles;
    uint mx_show;
};
// The tile number i of the list of the pass.
uint mx_tile_at(uint i)
{
    return mx_tile[i];
}
// The closures of a pixel, from the top down.

struct MxReader
{
    ivec2 pixel;
    uint class_, num_closures, next; // number of the closure that comes next
    uint core, body, top;            // words 0 to 2
    uint at;                         // words of the image that were read
    vec3 normals[3];                 // of the top, and the last two with words of their own
};

// Reads the next word behind the targets.
uint mx_get(inout MxReader reader)
{
    return imageLoad(mx_words, ivec3(reader.pixel, int(reader.at++))).x;
}

#if MX_STORAGE == 2
// Reads a number that is stored whole.
void mx_get(inout MxReader reader, out float value)
{
    value = uintBitsToFloat(mx_get(reader));
}

// Reads two numbers that are stored whole.
void mx_get(inout MxReader reader, out vec2 value)
{
    value.x = uintBitsToFloat(mx_get(reader));
    value.y = uintBitsToFloat(mx_get(reader));
}

// Reads three numbers that are stored whole.
void mx_get(inout MxReader reader, out vec3 value)
{
    value.x = uintBitsToFloat(mx_get(reader));
    value.y = uintBitsToFloat(mx_get(reader));
    value.z = uintBitsToFloat(mx_get(reader));
}

MxClosure mx_get_whole(inout MxReader reader);
#endif

// Begins to read the closures of a pixel, from the top down.
MxReader mx_open(ivec2 pixel)
{
    MxReader reader;
    reader.pixel = pixel;
    reader.core = imageLoad(mx_word0, pixel).x;
    reader.body = imageLoad(mx_word1, pixel).x;
    reader.top = imageLoad(mx_word2, pixel).x;
    reader.class_ = mx_class(reader.core);
    reader.num_closures = reader.class_ == MX_EMPTY ? 0u : (reader.body >> 28u) + 1u;
    reader.next = 0u;
    reader.at = 0u;
    reader.normals = vec3[3](mx_top_normal(reader.top), vec3(0.0), vec3(0.0));
    return reader;
}

// The next closure; there is one.
MxClosure mx_next(inout MxReader reader)
{
#if MX_STORAGE == 2
    MxClosure c = mx_get_whole(reader);
    if (reader.next++ == 0u)
        reader.normals[0] = c.normal;
    return c;
#else
    MxRecord r = MxRecord(reader.core, reader.body, uint[2](0u, 0u), 0u, 0u, 0u, 0u, 0u, uint[4](0u, 0u, 0u, 0u), 0u);
    bool is_top = reader.next == 0u, is_last = ++reader.next == reader.num_closures;
    if (!is_last) {
        r.core = mx_get(reader);
        r.body = ((r.core >> 20u) & MX_IS_SMOOTH) != 0u ? 0u : mx_get(reader);
    }
    uint has = mx_features(r.core);
    if ((has & MX_HAS_WEIGHTS) != 0u) {
        r.weights[0] = mx_get(reader);
        r.weights[1] = mx_get(reader);
    }
    if ((has & MX_HAS_MEDIUM) != 0u)
        r.medium = mx_get(reader);
    if ((has & MX_HAS_LOBES) != 0u)
        r.lobes = mx_get(reader);
    if ((has & MX_HAS_FUZZ) != 0u)
        r.fuzz = mx_get(reader);
    if ((has & MX_HAS_ANISOTROPY) != 0u)
        r.anisotropy = mx_get(reader);
    if ((has & MX_HAS_TINT) != 0u)
        r.tint = mx_get(reader);
    if ((has & MX_HAS_GLINTS) != 0u)
        for (int i = 0; i < 4; ++i)
            r.glints[i] = mx_get(reader);
    uint number = (has >> MX_NORMAL_SHIFT) & 3u;
    if (number == 1u) {
        reader.normals[2] = reader.normals[1];
        reader.normals[1] = mx_uncut_normal(mx_get(reader), 16u);
    }
    vec3 normal = reader.normals[number > 1u ? number - 1u : number];
    return mx_unpack(r, normal, is_top ? mx_top_roughness(reader.top) : mx_uncut(r.body, 20u, 8u));
#endif
}

// The part that all passes share: a group covers a tile.

// True beyond the edge of the picture, where tiles may reach.
bool mx_is_outside(ivec2 pixel)
{
    return any(greaterThanEqual(pixel, ivec2(mx_size)));
}

// The pixel of an invocation, in a pass over all tiles.
ivec2 mx_pixel_in(uvec2 group, uvec2 place)
{
    return MX_TILE * ivec2(group) + ivec2(place);
}

// The pixel of an invocation, in a pass that runs over the tiles of a class.
ivec2 mx_pixel_of(uint class_, uint group, uvec2 place)
{
    uint tile = mx_tile_at(class_ * mx_num_tiles + group);
    return MX_TILE * ivec2(tile % mx_tiles_per_row, tile / mx_tiles_per_row) + ivec2(place);
}

// Gives surface() a closure at a point, below a top with this normal and opacity.
void mx_fill(MxClosure closure, vec3 point, vec3 top, float open)
{
    vd.positionWorld = point;
    vd.normalWorld = top;
    vd.geomprop_is_thick = closure.is_thick;
    vd.geomprop_diffuse_albedo = closure.diffuse_albedo;
    vd.geomprop_f0 = closure.f0;
    vd.geomprop_f90 = closure.f90;
    vd.geomprop_roughness = closure.roughness;
    vd.geomprop_anisotropy = closure.anisotropy;
    vd.geomprop_normal = closure.normal;
    vd.geomprop_tangent = closure.tangent;
    vd.geomprop_second_roughness = closure.second_roughness;
    vd.geomprop_second_roughness_weight = closure.second_roughness_weight;
    vd.geomprop_fuzz_amount = closure.fuzz_amount;
    vd.geomprop_fuzz_color = closure.fuzz_color;
    vd.geomprop_fuzz_roughness = closure.fuzz_roughness;
    vd.geomprop_free_path = closure.free_path;
    vd.geomprop_phase_anisotropy = closure.phase_anisotropy;
    vd.geomprop_steady = closure.steady;
    vd.geomprop_color = closure.color;
    vd.geomprop_decay = closure.decay;
    vd.geomprop_spreads = closure.spreads;
}

// One group per tile of class MX_CLASS: lights its pixels by the function surface(), which stands above with mx_fill().

#if MX_SCATTERED == 1
// The part of out1 that is light from below the surface: what the same closure without a body does not send.
vec3 mx_split(MxClosure closure, vec3 point, vec3 top, float open)
{
    vec3 all = out1.xyz;
    closure.diffuse_albedo = vec3(0.0);
    mx_fill(closure, point, top, open);
    surface();
    return max(all - out1.xyz, 0.0);
}
#endif

// Lights a pixel of the class.
void mx_run(uvec2 group, uvec2 place)
{
    ivec2 pixel = mx_pixel_of(uint(MX_CLASS), group.x, place);
    if (mx_is_outside(pixel))
        return;
    MxReader reader = mx_open(pixel);
    if (reader.class_ != MX_CLASS)
        return;
    vec4 point = mx_to_world * vec4(vec2(pixel) + 0.5, texelFetch(mx_depth, pixel, 0).x, 1.0);
    vec4 stored = texelFetch(mx_color, pixel, 0); // what the surface emits, and the part of the environment that arrives
    vec4 lit = vec4(stored.xyz, 1.0);
#if MX_SCATTERED == 1
    vec3 inside = vec3(0.0), albedo = vec3(0.0);
#endif
#if MX_BELOW == 1
    const float MX_LEAST_BLUR = 1.0 / 256.0; // half of the least that few bits store; the image has halves
    vec4 below = vec4(0.0); // light that is blurred, and how wide
#endif
    while (reader.next < reader.num_closures) {
        MxClosure closure = mx_next(reader);
        mx_fill(closure, point.xyz / point.w, reader.normals[0], stored.w);
        surface();
#if MX_SCATTERED == 1
        if (closure.is_thick > 0.0) {
            inside += mx_split(closure, point.xyz / point.w, reader.normals[0], stored.w);
            albedo = closure.diffuse_albedo;
        }
#endif
#if MX_BELOW == 1
        if (closure.blur > MX_LEAST_BLUR) {
            below = vec4(below.xyz + out1.xyz, max(below.w, closure.blur));
            continue;
        }
#endif
        lit.xyz += out1.xyz;
#if MX_CLASS < MX_COMPLEX
        break; // the only closure
#endif
    }
#if MX_BELOW == 1
    imageStore(mx_below, ivec3(pixel, 0), below);
#endif
#if MX_SCATTERED == 1
    if (max(albedo.x, max(albedo.y, albedo.z)) > 0.0) {
        imageStore(mx_scattered, ivec3(pixel, 0), vec4(inside / max(albedo, 1e-3), 1.0));
#if MX_BELOW == 1
        lit.w = below.w > 0.0 ? 0.0 : 1.0; // the pass "diffuse" does not read that image
#endif
        imageStore(mx_scattered, ivec3(pixel, 1), lit);
        return;
    }
#endif
#if MX_BELOW == 1
    if (below.w > 0.0) {
        imageStore(mx_below, ivec3(pixel, 1), lit);
        return;
    }
#endif
    imageStore(mx_lit, pixel, lit);
}
layout(local_size_x = MX_TILE, local_size_y = MX_TILE) in;

void main()
{
    mx_run(gl_WorkGroupID.xy, gl_LocalInvocationID.xy);
}
