#version 310 es
// open_pbr_surface · surfacematerial · mxgen 0.1 · essl310 · complete · 12 closures · 0 textures
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
    float SR_open_pbr_surface_base_weight;
    vec3 SR_open_pbr_surface_base_color;
    float SR_open_pbr_surface_base_diffuse_roughness;
    float SR_open_pbr_surface_base_metalness;
    float SR_open_pbr_surface_specular_weight;
    vec3 SR_open_pbr_surface_specular_color;
    float SR_open_pbr_surface_specular_roughness;
    float SR_open_pbr_surface_specular_ior;
    float SR_open_pbr_surface_specular_roughness_anisotropy;
    float SR_open_pbr_surface_transmission_weight;
    vec3 SR_open_pbr_surface_transmission_color;
    float SR_open_pbr_surface_transmission_depth;
    vec3 SR_open_pbr_surface_transmission_scatter;
    float SR_open_pbr_surface_subsurface_weight;
    vec3 SR_open_pbr_surface_subsurface_color;
    float SR_open_pbr_surface_subsurface_radius;
    vec3 SR_open_pbr_surface_subsurface_radius_scale;
    float SR_open_pbr_surface_subsurface_scatter_anisotropy;
    float SR_open_pbr_surface_fuzz_weight;
    vec3 SR_open_pbr_surface_fuzz_color;
    float SR_open_pbr_surface_fuzz_roughness;
    float SR_open_pbr_surface_coat_weight;
    vec3 SR_open_pbr_surface_coat_color;
    float SR_open_pbr_surface_coat_roughness;
    float SR_open_pbr_surface_coat_roughness_anisotropy;
    float SR_open_pbr_surface_coat_ior;
    float SR_open_pbr_surface_coat_darkening;
    float SR_open_pbr_surface_thin_film_weight;
    float SR_open_pbr_surface_thin_film_thickness;
    float SR_open_pbr_surface_thin_film_ior;
    float SR_open_pbr_surface_emission_luminance;
    vec3 SR_open_pbr_surface_emission_color;
    float SR_open_pbr_surface_geometry_opacity;
    bool SR_open_pbr_surface_geometry_thin_walled;
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
    bool u_refractionTwoSided;
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
layout(location = 0) out vec4 out1;

// Unpolarised Fresnel equations of a dielectric; the clamped root makes total internal reflection come out as 1.
float mx_fresnel_dielectric(const float cosine, const float ior)
{
    float g = sqrt(max(ior * ior + cosine * cosine - 1.0, 0.0));
    vec2 a = cosine * vec2(1.0, ior * ior);
    vec2 r = (a - g) / (a + g);
    return 0.5 * dot(r, r);
}

// OpenPBR Surface specification, "Microfacet model".
vec2 mx_open_pbr_anisotropy(const float roughness, const float anisotropy)
{
    float aspect = 1.0 - anisotropy;
    return roughness * roughness * sqrt(2.0 / (1.0 + aspect * aspect)) * vec2(1.0, aspect);
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

// A channel of one polarisation after interference.
float mx_film_channel(const float a, const vec2 r, const float terms)
{
    float r23 = dot(r, r);
    float t = 1.0 - a * a;
    float even = t * t * r23 / (1.0 - a * a * r23);
    return a * a + even + 2.0 * (even - t) * terms;
}

// Two terms of the series (section 3.3) for one Gaussian: amplitude `a` of the film's own interface, which from behind
// is -a, and the complex amplitude r of the one below, and light that goes further by d / (2 pi) micrometre.
float mx_film_terms(const float a, const vec2 r, const float d, const vec3 gauss)
{
    float c = cos(gauss.x * d);
    float s = sin(gauss.x * d);
    float decay = exp(gauss.z * d * d);
    float x = r.x * c - r.y * s;
    float y = r.x * s + r.y * c;
    return gauss.y * decay * a * (a * (decay * decay * decay) * (x * x - y * y) - x);
}

float mx_film_x(const float a, const vec2 r, const float d)
{
    return mx_film_channel(a, r, mx_film_terms(a, r, d, vec3(1.681, 0.84659, -0.0043278))
        + mx_film_terms(a, r, d, vec3(2.2399, 0.153868, -0.0045282)));
}

// Complex amplitude of an interface in one polarisation, with x and u as in mx_fresnel_ratio.
vec2 mx_film_amplitude(const vec2 x, const vec2 u)
{
    return vec2(dot(x, x) - dot(u, u), 2.0 * (x.y * u.x - x.x * u.y)) / dot(x + u, x + u);
}

// The index times the cosine behind its interface: (u + iv)^2 = re + i im - sin^2.
vec2 mx_fresnel_refract(const float cosine, const float re, const float im)
{
    float t = re + (cosine * cosine - 1.0);
    float norm = sqrt(t * t + im * im);
    return sqrt(max(0.5 * vec2(norm + t, norm - t), vec2(0.0)));
}

float mx_film_y(const float a, const vec2 r, const float d)
{
    return mx_film_channel(a, r, mx_film_terms(a, r, d, vec3(1.7953, 1.000222, -0.0093046)));
}

float mx_film_z(const float a, const vec2 r, const float d)
{
    return mx_film_channel(a, r, mx_film_terms(a, r, d, vec3(2.2084, 1.001122, -0.0066121)));
}

// Facing the viewer both polarisations are alike.
vec3 mx_film_index_facing(const vec3 re, const float film, const float film_ior)
{
    float ior = max(film_ior, 1.0);
    float a = (1.0 - ior) / (1.0 + ior);
    float d = 0.012566372 * ior * film;
    vec2 across = vec2(1.0, 0.0);
    vec3 r = re / (ior * ior);
    vec3 i = vec3(0.0) / (ior * ior);
    return clamp(mat3(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949, -0.4706338, 0.0885814,
        1.0093968) * vec3(mx_film_x(a, mx_film_amplitude(across, mx_fresnel_refract(1.0, r.x, i.x)), d),
        mx_film_y(a, mx_film_amplitude(across, mx_fresnel_refract(1.0, r.y, i.y)), d),
        mx_film_z(a, mx_film_amplitude(vec2(1.0, 0.0), mx_fresnel_refract(1.0, r.z, i.z)), d)), vec3(0.0), vec3(1.0));
}

vec3 mx_fresnel_facing(const vec3 n, const float film, const float film_ior)
{
    if (film > 0.0)
        return mx_film_index_facing(n * n, film, film_ior);
    return vec3(mx_fresnel_dielectric(1.0, n.x));
}

// Zeltner et al.: clamped cosine under the linear transform M^-1 = [a 0 b; 0 a 0; 0 0 1] in the plane of V and N.
vec2 mx_sheen_transform(const float c, const float r)
{
    return vec2((2.58126 * c + 0.813703 * r) * r / (1.0 + 0.310327 * c * c + 2.60994 * c * r), sqrt(1.0 - c) * (r - 1.0)
        * r * r * r / (0.0000254053 + 1.71228 * c - 1.71506 * c * r + 1.34174 * r * r));
}

// Into the tangent space around N with x along the unit tangent `x`, and out of it.
vec3 mx_enter_frame(const vec3 w, const vec3 N, const vec3 x)
{
    return vec3(dot(w, x), dot(w, cross(N, x)), dot(w, N));
}

// Unit tangent along X.
vec3 mx_tangent(const vec3 N, const vec3 X)
{
    return normalize(X - dot(X, N) * N);
}

float mx_sheen_zeltner(const vec3 N, const vec3 V, const vec3 L, const float c, const float r)
{
    vec2 m = mx_sheen_transform(c, r);
    vec3 l = mx_enter_frame(L, N, mx_tangent(N, V + 0.00001 * N.yzx));
    vec3 w = vec3(m.x * l.x + m.y * l.z, m.x * l.y, l.z);
    float scale = m.x / dot(w, w);
    return max(w.z, 0.0) / 3.1415927 * scale * scale;
}

mx_GgxLobe mx_ggx_lobe(const vec2 roughness, const vec3 N, const vec3 X, const vec3 V)
{
    vec2 alpha = clamp(roughness, vec2(1e-8), vec2(1.0));
    float cosine = max(abs(dot(N, V)), 1e-8);
    return mx_GgxLobe(faceforward(N, -V, N), cosine, normalize(X - dot(X, N) * N), alpha,
        sqrt(cosine * cosine + alpha.x * alpha.y * (1.0 - cosine * cosine)));
}

// The lobe towards L, but for Fresnel's factor: distribution and visibility over one divisor.
float mx_ggx_light(const mx_GgxLobe lobe, const vec3 V, const vec3 L)
{
    vec3 H = V + L;
    vec3 slope = vec3(vec2(dot(H, lobe.x), dot(cross(H, lobe.N), lobe.x)) / lobe.alpha, 0.0);
    float area = lobe.alpha.x * lobe.alpha.y;
    float cos_l = max(dot(lobe.N, L), 1e-8);
    float cos_h = lobe.cosine + dot(lobe.N, L);
    float square = 2.0 + 2.0 * dot(V, L);
    float e = dot(slope, slope) + cos_h * cos_h;
    return square * square * cos_l / (6.2831855 * area * e * e
        * (lobe.cosine * sqrt(cos_l * cos_l + area * (1.0 - cos_l * cos_l)) + cos_l * lobe.masking));
}

// Amplitudes of a colour below a film, which has no phase: light turns where its colour says that the index behind the
// film is lower.
vec3 mx_film_turned(const vec3 f0, const vec3 f, const float ior)
{
    return (vec3(1.0) - 2.0 * step(sqrt(clamp(f0, vec3(0.01), vec3(0.99))), vec3((ior - 1.0) / (ior + 1.0))))
        * sqrt(max(0.5 * f, vec3(0.0)));
}

vec3 mx_film_schlick_facing(const vec3 f0, const float film, const float film_ior)
{
    float ior = max(film_ior, 1.0);
    float a = (1.0 - ior) / (1.0 + ior);
    float d = 0.012566372 * ior * film;
    vec3 r = -mx_film_turned(f0, f0, ior);
    return clamp(mat3(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949, -0.4706338, 0.0885814,
        1.0093968) * vec3(mx_film_x(a, vec2(r.x, 0.0), d), mx_film_y(a, vec2(r.y, 0.0), d),
        mx_film_z(a, vec2(r.z, 0.0), d)), vec3(0.0), vec3(1.0));
}

vec3 mx_fresnel_facing_2(const vec3 n, const float film, const float film_ior)
{
    if (film > 0.0)
        return mx_film_schlick_facing(n, film, film_ior);
    return n;
}

vec3 mx_fresnel_schlick(const float cosine, const vec3 f0, const vec3 bend)
{
    float x = 1.0 - cosine;
    float x3 = x * x * x;
    return mix(f0, vec3(1.0), x3 * x * x) - bend * (cosine * x3 * x3);
}

// Amplitudes of the film's own interface: perpendicular, parallel.
vec2 mx_film_amplitudes(const float cosine, const float inside, const float ior)
{
    vec2 x = vec2(cosine, ior * cosine);
    vec2 u = vec2(ior * inside, inside);
    return (x - u) / (x + u);
}

// A film on a colour.
vec3 mx_film_schlick(const float cosine, const vec3 f0, const vec3 bend, const float film, const float film_ior)
{
    float ior = max(film_ior, 1.0);
    float c = sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
    vec2 a = mx_film_amplitudes(cosine, c, ior);
    float d = 0.012566372 * ior * c * film;
    vec3 r = mx_film_turned(f0, mx_fresnel_schlick(c, f0, bend), ior);
    return clamp(mat3(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949, -0.4706338, 0.0885814,
        1.0093968) * (0.5 * vec3(mx_film_x(a.x, vec2(-r.x, 0.0), d) + mx_film_x(a.y, vec2(r.x, 0.0), d),
        mx_film_y(a.x, vec2(-r.y, 0.0), d) + mx_film_y(a.y, vec2(r.y, 0.0), d), mx_film_z(a.x, vec2(-r.z, 0.0), d)
        + mx_film_z(a.y, vec2(r.z, 0.0), d))), vec3(0.0), vec3(1.0));
}

vec3 mx_fresnel(const float cosine, const vec3 n, const vec3 k, const float film, const float film_ior)
{
    if (film > 0.0)
        return mx_film_schlick(cosine, n, k, film, film_ior);
    return mx_fresnel_schlick(cosine, n, k);
}

// A film on a permittivity.
vec3 mx_film_index(const float cosine, const vec3 re, const float film, const float film_ior)
{
    float ior = max(film_ior, 1.0);
    float c = sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
    vec2 a = mx_film_amplitudes(cosine, c, ior);
    float d = 0.012566372 * ior * c * film;
    vec2 across = vec2(c, 0.0);
    vec2 below = vec2(re.x, 0.0) / (ior * ior);
    vec2 u = mx_fresnel_refract(c, below.x, below.y);
    float x = mx_film_x(a.x, mx_film_amplitude(across, u), d) + mx_film_x(a.y, mx_film_amplitude(c * below, u), d);
    below = vec2(re.y, 0.0) / (ior * ior);
    u = mx_fresnel_refract(c, below.x, below.y);
    float y = mx_film_y(a.x, mx_film_amplitude(across, u), d) + mx_film_y(a.y, mx_film_amplitude(c * below, u), d);
    below = vec2(re.z, 0.0) / (ior * ior);
    u = mx_fresnel_refract(c, below.x, below.y);
    float z = mx_film_z(a.x, mx_film_amplitude(across, u), d) + mx_film_z(a.y, mx_film_amplitude(c * below, u), d);
    return clamp(mat3(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949, -0.4706338, 0.0885814,
        1.0093968) * (0.5 * vec3(x, y, z)), vec3(0.0), vec3(1.0));
}

vec3 mx_fresnel(const float cosine, const vec3 n, const float film, const float film_ior)
{
    if (film > 0.0)
        return mx_film_index(cosine, n * n, film, film_ior);
    return vec3(mx_fresnel_dielectric(cosine, n.x));
}

vec3 mx_subsurface_light(const vec3 falloff, const float cos_l)
{
    float sin_l = sqrt(max(1.0 - cos_l * cos_l, 0.0));
    vec3 light = vec3(0.0);
    vec3 sum = vec3(0.0);
    vec2 middle = vec2(0.9987955, 0.04906767);
    while (middle.x > 0.0) {
        float d = middle.y;
        vec3 e = exp(falloff * d);
        vec3 profile = (e + e * e * e) / d;
        float along = cos_l * (1.0 - 2.0 * d * d);
        float across = sin_l * (2.0 * d * middle.x);
        light += profile * (max(along - across, 0.0) + max(along + across, 0.0));
        sum += 2.0 * profile;
        middle = mat2(0.9951847, 0.09801714, -0.09801714, 0.9951847) * middle;
    }
    return light / (3.1415927 * sum);
}

// Directional albedo of Fujii's lobe.
float mx_fujii_albedo(const float cosine, const float r)
{
    float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    float g = sine * (acos(min(cosine, 1.0)) - sine * cosine) + 0.6666667
        * (sine / cosine * (1.0 - sine * sine * sine) - sine);
    return (1.0 + r * g / 3.1415927) / (1.0 + 0.28779334 * r);
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

// Albedo of what the lobe scatters more than once, relative to `color`.
vec3 mx_fujii_multiple(const vec3 color, const float mean)
{
    return color * mean / (vec3(1.0) - color * max(1.0 - mean, 0.0));
}

// The frame of a round lobe has V above its x.
mx_GgxSamples mx_ggx_samples(const vec2 roughness, const vec3 N, const vec3 X, const vec3 V)
{
    mx_GgxLobe lobe = mx_ggx_lobe(roughness, N, X, V);
    vec3 x = lobe.x;
    mat3 frame = mat3(x, cross(lobe.N, x), lobe.N);
    vec3 v = vec3((V * frame).xy, lobe.cosine);
    vec3 stretch = vec3(lobe.alpha, 1.0);
    vec3 top = normalize(v * stretch) + vec3(0.0, 0.0, 1.0);
    float share = 1.0 / float(max(u_envRadianceSamples, 1));
    return mx_GgxSamples(mat3(u_envMatrix) * frame, stretch, stretch.x * stretch.y, v, lobe.masking, top, share * top.z,
        share * (v.z + lobe.masking));
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

void main()
{
    float coat_weight = SR_open_pbr_surface_coat_weight;
    float coat_ior = SR_open_pbr_surface_coat_ior;
    float coat_front = coat_ior * 4.0 / ((coat_ior + 1.0) * (coat_ior + 1.0));
    vec3 N = normalize(vd_normalWorld);
    vec3 V = normalize(u_viewPosition - vd_positionWorld);
    float absolute = abs(dot(N, V));
    vec3 color = SR_open_pbr_surface_emission_luminance
        * (SR_open_pbr_surface_emission_color
        * (1.0 - coat_weight + SR_open_pbr_surface_coat_color
        * (coat_weight * (coat_front * (1.0 - pow(1.0 - min(absolute, 1.0), 5.0))))));
    // lights
    vec3 subsurface_positive = max(SR_open_pbr_surface_subsurface_color, 0.0);
    float thin = float(SR_open_pbr_surface_geometry_thin_walled);
    float dielectric_weight = 1.0 - SR_open_pbr_surface_base_metalness;
    float opaque_weight = dielectric_weight * (1.0 - SR_open_pbr_surface_transmission_weight);
    float scaled_sheet_weight = thin * (SR_open_pbr_surface_subsurface_weight * opaque_weight) * 0.5;
    float ior_relative = mix(SR_open_pbr_surface_specular_ior,
        max(SR_open_pbr_surface_specular_ior / coat_ior, coat_ior / SR_open_pbr_surface_specular_ior), coat_weight);
    float amplitude_bound = clamp((ior_relative - 1.0) / (ior_relative + 1.0)
        * sqrt(SR_open_pbr_surface_specular_weight), -0.999995, 0.999995);
    float ior = (amplitude_bound + 1.0) / (1.0 - amplitude_bound);
    float fresnel_bare = mx_fresnel_dielectric(1.0, ior);
    vec2 roughness = mx_open_pbr_anisotropy(mix(SR_open_pbr_surface_specular_roughness,
        pow(min(pow(SR_open_pbr_surface_coat_roughness, 4.0) * 2.0 + pow(SR_open_pbr_surface_specular_roughness, 4.0),
        1.0), 0.25), coat_weight), SR_open_pbr_surface_specular_roughness_anisotropy);
    vec2 alpha = clamp(roughness, 1e-8, 1.0);
    float a = sqrt(alpha.x * alpha.y);
    float cos_v = max(absolute, 1e-8);
    vec2 albedo = mx_ggx_albedo_fit(a, a / (cos_v + a), cos_v);
    float product = mix(fresnel_bare, 1.0, albedo.y) * albedo.x;
    float difference = 1.0 / albedo.x - 1.0;
    float reflection_scale = difference * mix(fresnel_bare, 1.0, 0.04761905) + 1.0;
    vec3 reflection_throughput = vec3(1.0 - product * reflection_scale);
    float film_thickness = SR_open_pbr_surface_thin_film_thickness * 1000.0;
    float thin_film_ior = SR_open_pbr_surface_thin_film_ior;
    vec3 reflection_film_scale = mix(mx_fresnel_facing(vec3(ior), film_thickness, thin_film_ior), vec3(1.0), 0.04761905)
        * difference + vec3(1.0);
    float r = clamp(SR_open_pbr_surface_fuzz_roughness, 0.01, 1.0);
    float width = r * (r * 1.58491 + 0.0206607) / (r * (r + 1.32227) + 0.0379424);
    float x = (cos_v - r * (r * (r * (1.7932 - r * (r * 0.95943)) - 1.14885) - 0.193854) / (r + 0.046391)) / width;
    float fuzz_ratio = exp(x * (x * -0.5)) / (width * 2.5066283);
    float fuzz_product = r * (r * (r * 0.119681 - 0.0207818) + 0.000654023);
    float fuzz_product_2 = SR_open_pbr_surface_fuzz_weight
        * max(fuzz_ratio + fuzz_product / (r * (r - 1.92021) + 1.26264), 0.0);
    float coating_fresnel_bare = mx_fresnel_dielectric(1.0, coat_ior);
    vec2 coat_lobe = mx_open_pbr_anisotropy(SR_open_pbr_surface_coat_roughness,
        SR_open_pbr_surface_coat_roughness_anisotropy);
    vec2 coating_alpha = clamp(coat_lobe, 1e-8, 1.0);
    float coating_a = sqrt(coating_alpha.x * coating_alpha.y);
    vec2 coating_albedo = mx_ggx_albedo_fit(coating_a, coating_a / (cos_v + coating_a), cos_v);
    float coating_scale = mix(coating_fresnel_bare, 1.0, 0.04761905) * (1.0 / coating_albedo.x - 1.0) + 1.0;
    float coated_weight = (1.0 - fuzz_product_2)
        * (1.0 - coat_weight * (mix(coating_fresnel_bare, 1.0, coating_albedo.y) * coating_albedo.x * coating_scale));
    vec3 substrate_darkened_weight = coated_weight
        * clamp(mix(vec3(1.0), SR_open_pbr_surface_coat_color, coat_weight), 0.0, 1.0);
    float coat_escape = coat_front / (coat_ior * coat_ior);
    vec3 darkening = coat_escape / (vec3(1.0)
        - mix(mix(SR_open_pbr_surface_base_color, SR_open_pbr_surface_subsurface_color,
        SR_open_pbr_surface_subsurface_weight), SR_open_pbr_surface_base_color * SR_open_pbr_surface_specular_weight,
        SR_open_pbr_surface_base_metalness) * (1.0 - coat_escape));
    vec3 substrate_weight = substrate_darkened_weight
        * clamp(mix(vec3(1.0), darkening, coat_weight * SR_open_pbr_surface_coat_darkening), 0.0, 1.0);
    vec3 body_weight = mix(reflection_throughput, vec3(1.0) - product * reflection_film_scale,
        SR_open_pbr_surface_thin_film_weight) * substrate_weight;
    vec3 sheet_front_product = subsurface_positive
        * (scaled_sheet_weight * (body_weight
        * clamp(SR_open_pbr_surface_subsurface_color * (1.0 - SR_open_pbr_surface_subsurface_scatter_anisotropy), 0.0,
        1.0)));
    vec3 Nf = faceforward(N, -V, N);
    float base_diffuse_roughness = SR_open_pbr_surface_base_diffuse_roughness;
    vec2 ab = base_diffuse_roughness * base_diffuse_roughness * vec2(-0.5, 0.45)
        / (base_diffuse_roughness * base_diffuse_roughness + vec2(0.33, 0.09)) + vec2(1.0, 0.0);
    vec3 sheet_back_product = subsurface_positive
        * (scaled_sheet_weight * (body_weight
        * clamp(SR_open_pbr_surface_subsurface_color * (SR_open_pbr_surface_subsurface_scatter_anisotropy + 1.0), 0.0,
        1.0)));
    float limited_cos_v = min(cos_v, 1.0);
    vec3 fuzz_product_3 = SR_open_pbr_surface_fuzz_color * fuzz_product_2;
    float coating_product = coating_scale * (coat_weight * (1.0 - fuzz_product_2));
    vec3 X = normalize(vd_tangentWorld);
    mx_GgxLobe coating_lobe = mx_ggx_lobe(coat_lobe, N, X, V);
    float metal_film_weight = SR_open_pbr_surface_specular_weight
        * (SR_open_pbr_surface_base_metalness * SR_open_pbr_surface_thin_film_weight);
    vec3 fresnel_facing = max(SR_open_pbr_surface_base_weight * SR_open_pbr_surface_base_color, 0.0);
    vec3 metal_film_product = (difference
        * mix(mx_fresnel_facing_2(fresnel_facing, film_thickness, thin_film_ior), vec3(1.0), 0.04761905) + vec3(1.0))
        * (substrate_weight * metal_film_weight);
    mx_GgxLobe lobe = mx_ggx_lobe(roughness, N, X, V);
    vec3 limited_specular_color = max(SR_open_pbr_surface_specular_color, 0.0);
    vec3 schlick_bend = mix(fresnel_facing, vec3(1.0), 0.4626644) * (vec3(1.0) - limited_specular_color) * 17.651384;
    float metal_bare_weight = SR_open_pbr_surface_specular_weight
        * (SR_open_pbr_surface_base_metalness * (1.0 - SR_open_pbr_surface_thin_film_weight));
    vec3 metal_bare_product = (difference * mix(fresnel_facing, vec3(1.0), 0.04761905) + vec3(1.0))
        * (substrate_weight * metal_bare_weight);
    bool reflection_film_visible = SR_open_pbr_surface_thin_film_weight * dielectric_weight > 0.0;
    vec3 reflection_film_product = substrate_weight * (SR_open_pbr_surface_thin_film_weight * dielectric_weight)
        * (reflection_film_scale * limited_specular_color);
    float reflection_weight = dielectric_weight * (1.0 - SR_open_pbr_surface_thin_film_weight);
    vec3 reflection_product = reflection_scale * (limited_specular_color * (substrate_weight * reflection_weight));
    float scatter_weight = SR_open_pbr_surface_subsurface_weight * opaque_weight * (1.0 - thin);
    float scaled_curvature = max(length(fwidth(Nf)) / length(fwidth(vd_positionWorld)), 0.01) * 3.0;
    vec3 subsurface_falloff = vec3(-2.0)
        / (scaled_curvature * max(SR_open_pbr_surface_subsurface_radius * SR_open_pbr_surface_subsurface_radius_scale,
        0.1));
    vec3 scatter_product = subsurface_positive * (body_weight * scatter_weight);
    float diffuse_weight = SR_open_pbr_surface_base_weight
        * (opaque_weight * (1.0 - SR_open_pbr_surface_subsurface_weight));
    vec3 base_positive = max(SR_open_pbr_surface_base_color, 0.0);
    vec3 diffuse_product = base_positive * (body_weight * diffuse_weight);
    float diffuse_sum = base_diffuse_roughness * 0.28779334 + 1.0;
    float mean = (base_diffuse_roughness * 0.0724882 + 1.0) / diffuse_sum;
    vec3 fujii_multiple = base_positive * mean / (vec3(1.0) - base_positive * max(1.0 - mean, 0.0));
    float diffuse_fujii_albedo = mx_fujii_albedo(cos_v, base_diffuse_roughness);
    float diffuse_greater = max(1.0 - diffuse_fujii_albedo, 1e-8);
    float diffuse_greater_2 = max(1.0 - mean, 1e-8);
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        // sheet_front, sheet_back
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
        float l_dot_nf = dot(L, Nf);
        float cos_l = max(l_dot_nf, 1e-8);
        float v_dot_l = dot(V, L);
        float s = v_dot_l - cos_v * cos_l;
        float greater = max(cos_l, cos_v);
        vec3 sheet_front_response = sheet_front_product * (cos_l / 3.1415927 * (ab.x + ab.y * max(s, 0.0) / greater));
        color += directional_light_light
            * (sheet_front_response + max(-l_dot_nf, 0.0) / 3.1415927 * sheet_back_product);
        // fuzz
        if (SR_open_pbr_surface_fuzz_weight > 0.0)
            color += directional_light_light * (mx_sheen_zeltner(Nf, V, L, limited_cos_v, r) * fuzz_product_3);
        // coating
        float cosine = sqrt(clamp(v_dot_l * 0.5 + 0.5, 1e-8, 1.0));
        if (coat_weight > 0.0)
            color += directional_light_light
                * (coating_product * (mx_ggx_light(coating_lobe, V, L) * mx_fresnel_dielectric(cosine, coat_ior)));
        // metal_film
        float ggx_light = mx_ggx_light(lobe, V, L);
        if (metal_film_weight > 0.0)
            color += directional_light_light
                * (metal_film_product * (ggx_light
                * mx_fresnel(cosine, fresnel_facing, schlick_bend, film_thickness, thin_film_ior)));
        // metal_bare
        if (metal_bare_weight > 0.0)
            color += directional_light_light
                * (metal_bare_product * (ggx_light * mx_fresnel_schlick(cosine, fresnel_facing, schlick_bend)));
        // reflection_film
        if (reflection_film_visible)
            color += directional_light_light
                * (reflection_film_product
                * (ggx_light * mx_fresnel(cosine, vec3(ior), film_thickness, thin_film_ior)));
        // reflection
        if (reflection_weight > 0.0)
            color += directional_light_light * (reflection_product * (ggx_light * mx_fresnel_dielectric(cosine, ior)));
        // scatter
        if (scatter_weight > 0.0)
            color += directional_light_light * (mx_subsurface_light(subsurface_falloff, l_dot_nf) * scatter_product);
        // diffuse
        if (diffuse_weight > 0.0) {
            float diffuse_s = s / greater;
            vec3 diffuse_product_2 = fujii_multiple
                * (diffuse_greater * max(1.0 - mx_fujii_albedo(cos_l, base_diffuse_roughness), 1e-8)
                / diffuse_greater_2);
            color += directional_light_light
                * (diffuse_product * (cos_l / 3.1415927
                * ((base_diffuse_roughness * (s > 0.0 ? diffuse_s : s) + 1.0) / diffuse_sum + diffuse_product_2)));
        }
    }
    // environment
    // fuzz, sheet_front, scatter
    float envLightIntensity = u_envLightIntensity;
    vec3 part = textureLod(u_envIrradiance, mx_map_point(normalize((u_envMatrix * vec4(Nf, 0.0)).xyz)), 0.0).xyz;
    vec2 fit = base_diffuse_roughness * (cos_v * vec2(-0.7632, -0.4993) - vec2(0.4297, 0.6076) + base_diffuse_roughness
        * vec2(1.4385, 2.0315)) + vec2(1.0);
    vec3 sheet_front_response = sheet_front_product * part * (envLightIntensity * clamp(fit.x / fit.y, 0.0, 1.0));
    vec3 sum = SR_open_pbr_surface_fuzz_color * part * (fuzz_product_2 * envLightIntensity) + sheet_front_response;
    color += envLightIntensity * (scatter_product * part) + sum;
    // sheet_back
    if (scaled_sheet_weight > 0.0)
        color += envLightIntensity * (sheet_back_product
            * textureLod(u_envIrradiance, mx_map_point(normalize((u_envMatrix * vec4(-Nf, 0.0)).xyz)), 0.0).xyz);
    // diffuse
    if (diffuse_weight > 0.0)
        color += envLightIntensity * (mix(mx_fujii_multiple(base_positive, mean), vec3(1.0), diffuse_fujii_albedo)
            * (diffuse_product * part));
    // coating
    if (coat_weight > 0.0) {
        mx_GgxSamples coating_ggx_samples = mx_ggx_samples(coat_lobe, N, X, V);
        vec2 turn = vec2(1.0, 0.0);
        for (int i = 0; i < u_envRadianceSamples; ++i) {
            vec4 coating_light = mx_ggx_reflected(coating_ggx_samples, i, turn);
            color += coating_light.xyz * (coating_product * mx_fresnel_dielectric(coating_light.w, coat_ior));
            turn = turn * -0.7373689 + vec2(-turn.y, turn.x) * 0.6754903;
        }
    }
    // metal_film, metal_bare, reflection_film, reflection
    mx_GgxSamples samples = mx_ggx_samples(roughness, N, X, V);
    if (reflection_weight > 0.0 || (reflection_film_visible || (metal_film_weight > 0.0 || metal_bare_weight > 0.0))) {
        if (film_thickness > 0.0) {
            vec3 reflection_film_vector = vec3(ior * ior);
            vec2 turn = vec2(1.0, 0.0);
            for (int i = 0; i < u_envRadianceSamples; ++i) {
                // metal_film
                vec4 metal_film_ggx_reflected = mx_ggx_reflected(samples, i, turn);
                if (metal_film_weight > 0.0)
                    color += metal_film_product
                        * (mx_film_schlick(metal_film_ggx_reflected.w, fresnel_facing, schlick_bend, film_thickness,
                        thin_film_ior) * metal_film_ggx_reflected.xyz);
                // metal_bare
                if (metal_bare_weight > 0.0)
                    color += metal_bare_product
                        * (metal_film_ggx_reflected.xyz
                        * mx_fresnel_schlick(metal_film_ggx_reflected.w, fresnel_facing, schlick_bend));
                // reflection_film
                if (reflection_film_visible)
                    color += reflection_film_product
                        * (metal_film_ggx_reflected.xyz
                        * mx_film_index(metal_film_ggx_reflected.w, reflection_film_vector, film_thickness,
                        thin_film_ior));
                // reflection
                if (reflection_weight > 0.0)
                    color += reflection_product
                        * (metal_film_ggx_reflected.xyz * mx_fresnel_dielectric(metal_film_ggx_reflected.w, ior));
                turn = turn * -0.7373689 + vec2(-turn.y, turn.x) * 0.6754903;
            }
        } else {
            vec2 turn = vec2(1.0, 0.0);
            for (int i = 0; i < u_envRadianceSamples; ++i) {
                // metal_film
                vec4 metal_film_ggx_reflected = mx_ggx_reflected(samples, i, turn);
                vec3 metal_bare_product_2 = mx_fresnel_schlick(metal_film_ggx_reflected.w, fresnel_facing, schlick_bend)
                    * metal_film_ggx_reflected.xyz;
                if (metal_film_weight > 0.0)
                    color += metal_film_product * metal_bare_product_2;
                // metal_bare
                if (metal_bare_weight > 0.0)
                    color += metal_bare_product * metal_bare_product_2;
                // reflection_film
                vec3 reflection_product_2 = metal_film_ggx_reflected.xyz
                    * mx_fresnel_dielectric(metal_film_ggx_reflected.w, ior);
                if (reflection_film_visible)
                    color += reflection_film_product * reflection_product_2;
                // reflection
                if (reflection_weight > 0.0)
                    color += reflection_product * reflection_product_2;
                turn = turn * -0.7373689 + vec2(-turn.y, turn.x) * 0.6754903;
            }
        }
    }
    // refraction
    if (SR_open_pbr_surface_transmission_weight * dielectric_weight > 0.0) {
        vec3 tint = max(SR_open_pbr_surface_transmission_depth > 0.0 ? vec3(1.0)
            : SR_open_pbr_surface_transmission_color, 0.0);
        vec3 absorbed = -(SR_open_pbr_surface_transmission_scatter + log(SR_open_pbr_surface_transmission_color))
            / SR_open_pbr_surface_transmission_depth;
        vec3 refraction_product = exp(-(SR_open_pbr_surface_transmission_depth > 0.0 ? absorbed
            - min(min(min(absorbed.x, absorbed.y), absorbed.z), 0.0) : vec3(0.0))) * tint;
        vec3 refraction_product_2 = (u_refractionTwoSided ? tint : vec3(1.0)) * refraction_product;
        vec3 refraction_product_3 = body_weight * (SR_open_pbr_surface_transmission_weight * dielectric_weight)
            * refraction_product_2;
        vec2 turn = vec2(1.0, 0.0);
        for (int i = 0; i < u_envRadianceSamples; ++i) {
            vec4 refraction_ggx_transmitted = mx_ggx_transmitted(samples, ior, i, turn);
            color += refraction_product_3
                * ((1.0 - mx_fresnel_dielectric(refraction_ggx_transmitted.w, ior)) * refraction_ggx_transmitted.xyz);
            turn = turn * -0.7373689 + vec2(-turn.y, turn.x) * 0.6754903;
        }
    }
    // opacity
    if (SR_open_pbr_surface_geometry_opacity < u_alphaThreshold)
        discard;
    out1 = vec4(SR_open_pbr_surface_geometry_opacity * color, SR_open_pbr_surface_geometry_opacity);
}
