#version 300 es
// open_pbr_surface · surfacematerial · mxgen 0.1 · essl · complete · 12 closures · 0 textures
precision highp float;
precision highp int;
precision highp sampler2D;

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
uniform float SR_open_pbr_surface_base_weight;
uniform vec3 SR_open_pbr_surface_base_color;
uniform float SR_open_pbr_surface_base_diffuse_roughness;
uniform float SR_open_pbr_surface_base_metalness;
uniform float SR_open_pbr_surface_specular_weight;
uniform vec3 SR_open_pbr_surface_specular_color;
uniform float SR_open_pbr_surface_specular_roughness;
uniform float SR_open_pbr_surface_specular_ior;
uniform float SR_open_pbr_surface_specular_roughness_anisotropy;
uniform float SR_open_pbr_surface_transmission_weight;
uniform vec3 SR_open_pbr_surface_transmission_color;
uniform float SR_open_pbr_surface_transmission_depth;
uniform vec3 SR_open_pbr_surface_transmission_scatter;
uniform float SR_open_pbr_surface_subsurface_weight;
uniform vec3 SR_open_pbr_surface_subsurface_color;
uniform float SR_open_pbr_surface_subsurface_radius;
uniform vec3 SR_open_pbr_surface_subsurface_radius_scale;
uniform float SR_open_pbr_surface_subsurface_scatter_anisotropy;
uniform float SR_open_pbr_surface_fuzz_weight;
uniform vec3 SR_open_pbr_surface_fuzz_color;
uniform float SR_open_pbr_surface_fuzz_roughness;
uniform float SR_open_pbr_surface_coat_weight;
uniform vec3 SR_open_pbr_surface_coat_color;
uniform float SR_open_pbr_surface_coat_roughness;
uniform float SR_open_pbr_surface_coat_roughness_anisotropy;
uniform float SR_open_pbr_surface_coat_ior;
uniform float SR_open_pbr_surface_coat_darkening;
uniform float SR_open_pbr_surface_thin_film_weight;
uniform float SR_open_pbr_surface_thin_film_thickness;
uniform float SR_open_pbr_surface_thin_film_ior;
uniform float SR_open_pbr_surface_emission_luminance;
uniform vec3 SR_open_pbr_surface_emission_color;
uniform float SR_open_pbr_surface_geometry_opacity;
uniform bool SR_open_pbr_surface_geometry_thin_walled;
uniform vec3 u_viewPosition;
uniform int u_numActiveLightSources;
uniform mat4 u_envMatrix;
uniform int u_envRadianceMips;
uniform int u_envRadianceSamples;
uniform float u_envLightIntensity;
uniform float u_alphaThreshold;
uniform bool u_refractionTwoSided;
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
in vec3 vd_positionWorld;
in vec3 vd_normalWorld;
in vec3 vd_tangentWorld;
out vec4 out1;

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

// A channel after interference, the mean of both polarisations.
float mx_film_channel(const vec2 a, const vec2 re, const vec2 im, const vec2 terms)
{
    vec2 r23 = re * re + im * im;
    vec2 t = vec2(1.0) - a * a;
    vec2 even = t * t * r23 / (vec2(1.0) - a * a * r23);
    vec2 both = a * a + even + 2.0 * (even - t) * terms;
    return 0.5 * (both.x + both.y);
}

// Two terms of the series (section 3.3) for one Gaussian: amplitude `a` of the film's own interface, which from behind
// is -a, and re + i im of the one below, and light that goes further by d / (2 pi) micrometre.
vec2 mx_film_terms(const vec2 a, const vec2 re, const vec2 im, const float d, const vec3 gauss)
{
    float c = cos(gauss.x * d);
    float s = sin(gauss.x * d);
    float decay = exp(gauss.z * d * d);
    vec2 x = re * c - im * s;
    vec2 y = re * s + im * c;
    return gauss.y * decay * a * (a * (decay * decay * decay) * (x * x - y * y) - x);
}

// The index n + ik times the cosine behind its interface: (u + iv)^2 = (n + ik)^2 - sin^2.
vec2 mx_fresnel_refract(const float cosine, const float n, const float k)
{
    float t = n * n - k * k + (cosine * cosine - 1.0);
    float norm = sqrt(t * t + 4.0 * n * n * k * k);
    return sqrt(max(0.5 * vec2(norm + t, norm - t), vec2(0.0)));
}

// Amplitudes re + i im of the interface below: (x + iy - u - iv) / (x + iy + u + iv), as in mx_fresnel_conductor.
void mx_film_base(const float cosine, const float n, const float k, out vec2 re, out vec2 im)
{
    vec2 u = mx_fresnel_refract(cosine, n, k);
    vec2 x = cosine * vec2(1.0, n * n - k * k);
    vec2 y = vec2(0.0, 2.0 * cosine * n * k);
    vec2 norm = (x + u.x) * (x + u.x) + (y + u.y) * (y + u.y);
    re = (x * x + y * y - dot(u, u)) / norm;
    im = 2.0 * (y * u.x - x * u.y) / norm;
}

// Amplitudes of the film's own interface.
vec2 mx_film_amplitudes(const float cosine, const float inside, const float ior)
{
    vec2 x = vec2(cosine, ior * cosine);
    vec2 u = vec2(ior * inside, inside);
    return (x - u) / (x + u);
}

// A film on the index n + ik.
vec3 mx_film_index(const float cosine, const vec3 n, const float film, const float film_ior)
{
    float ior = max(film_ior, 1.0);
    float c = sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
    vec2 a = mx_film_amplitudes(cosine, c, ior);
    float d = 0.012566372 * ior * c * film;
    vec2 re;
    vec2 im;
    mx_film_base(c, n.x / ior, 0.0 / ior, re, im);
    float x = mx_film_channel(a, re, im, mx_film_terms(a, re, im, d, vec3(1.681, 0.84659, -0.0043278))
        + mx_film_terms(a, re, im, d, vec3(2.2399, 0.153868, -0.0045282)));
    mx_film_base(c, n.y / ior, 0.0 / ior, re, im);
    float y = mx_film_channel(a, re, im, mx_film_terms(a, re, im, d, vec3(1.7953, 1.000222, -0.0093046)));
    mx_film_base(c, n.z / ior, 0.0 / ior, re, im);
    float z = mx_film_channel(a, re, im, mx_film_terms(a, re, im, d, vec3(2.2084, 1.001122, -0.0066121)));
    return clamp(mat3(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949, -0.4706338, 0.0885814,
        1.0093968) * vec3(x, y, z), vec3(0.0), vec3(1.0));
}

vec3 mx_fresnel(const float cosine, const vec3 n, const float film, const float film_ior)
{
    if (film > 0.0)
        return mx_film_index(cosine, n, film, film_ior);
    return vec3(mx_fresnel_dielectric(cosine, n.x));
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

vec3 mx_fresnel_schlick(const float cosine, const vec3 f0, const vec3 bend)
{
    float x = 1.0 - cosine;
    float x3 = x * x * x;
    return mix(f0, vec3(1.0), x3 * x * x) - bend * (cosine * x3 * x3);
}

// A film on a colour, which has no phase: light turns where its colour says that the index behind the film is lower.
vec3 mx_film_schlick(const float cosine, const vec3 f0, const vec3 bend, const float film, const float film_ior)
{
    float ior = max(film_ior, 1.0);
    float c = sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
    vec2 a = mx_film_amplitudes(cosine, c, ior);
    float d = 0.012566372 * ior * c * film;
    vec3 r = (vec3(1.0) - 2.0 * step(sqrt(clamp(f0, vec3(0.01), vec3(0.99))), vec3((ior - 1.0) / (ior + 1.0))))
        * sqrt(max(0.5 * mx_fresnel_schlick(c, f0, bend), vec3(0.0)));
    vec2 re = vec2(-r.x, r.x);
    float x = mx_film_channel(a, re, vec2(0.0), mx_film_terms(a, re, vec2(0.0), d, vec3(1.681, 0.84659, -0.0043278))
        + mx_film_terms(a, re, vec2(0.0), d, vec3(2.2399, 0.153868, -0.0045282)));
    re = vec2(-r.y, r.y);
    float y = mx_film_channel(a, re, vec2(0.0), mx_film_terms(a, re, vec2(0.0), d, vec3(1.7953, 1.000222, -0.0093046)));
    re = vec2(-r.z, r.z);
    return clamp(mat3(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949, -0.4706338, 0.0885814,
        1.0093968) * vec3(x, y, mx_film_channel(a, re, vec2(0.0),
        mx_film_terms(a, re, vec2(0.0), d, vec3(2.2084, 1.001122, -0.0066121)))), vec3(0.0), vec3(1.0));
}

vec3 mx_fresnel(const float cosine, const vec3 n, const vec3 k, const float film, const float film_ior)
{
    if (film > 0.0)
        return mx_film_schlick(cosine, n, k, film, film_ior);
    return mx_fresnel_schlick(cosine, n, k);
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

// Light of a unit direction in the picture, filtered over the solid angle of a sample (Krivanek and Colbert 2008; the
// mip level is equation 13 of GPU Gems 3, section 20.4).
vec3 mx_filtered_light(const vec3 d, const float level)
{
    return textureLod(u_envRadiance, mx_map_point(d), max(0.25 * log2(level * level / dot(d.xz, d.xz)), 0.0)).xyz;
}

// Direction of the ray -v after it has entered the sphere at normal h and left it again.
vec3 mx_refract_sphere(const vec3 v, const vec3 h, const float ior)
{
    vec3 inside = refract(-v, h, 1.0 / ior);
    return refract(inside, normalize(inside * dot(inside, h) - 0.5 * h), ior);
}

// Height-correlated masking and shadowing G2 (Heitz 2014, equation 99) over 2 cos_v cos_l; half is left of the divisor
// of the reflection model.
float mx_ggx_visibility(const float cos_v, const float masking, const float area, const float cos_l)
{
    return 1.0 / (cos_v * sqrt(mix(cos_l * cos_l, 1.0, area)) + cos_l * masking);
}

// The light of a sample, and in the fourth component the cosine at its facet h, of any length; `spread` is its level
// over that of the first.
vec4 mx_ggx_sample_at(const mx_GgxSamples s, const vec3 h, const float shrink, const float spread,
    const float refract_ior)
{
    float cosine = dot(s.v, h);
    vec3 l = 2.0 * shrink * cosine * h - s.v;
    float cos_l = max(l.z, 1e-8);
    float weight = cos_l * mx_ggx_visibility(s.v.z, s.masking, s.area, cos_l);
    if (refract_ior > 0.0) {
        l = mx_refract_sphere(s.v, h * sqrt(shrink), refract_ior);
        weight = 0.5 / s.v.z;
    }
    return vec4(weight * mx_filtered_light(s.to_map * l, spread * spread * s.level),
        clamp(cosine * sqrt(shrink), 1e-8, 1.0));
}

// A normal of those visible from v, which is stretched by the roughness, before it is scaled to length 1 (Dupuy and
// Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps"): (cos, sin) of its turn around z, and how far the
// cap is below its top, `top` = v + z.
vec3 mx_ggx_cap(const vec2 around, const float depth, const vec3 top)
{
    return vec3(top.xy + sqrt(depth * (2.0 - depth)) * around, top.z - depth);
}

vec4 mx_ggx_sample(const mx_GgxSamples s, const vec2 around, const float depth, const float refract_ior)
{
    vec3 cap = mx_ggx_cap(around, depth, s.top);
    vec3 h = cap * s.stretch;
    float shrink = 1.0 / dot(h, h);
    return mx_ggx_sample_at(s, h, shrink, shrink * dot(cap, cap), refract_ior);
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

// A function for each interface: what has nothing left to choose needs no version of its own.
vec3 mx_ggx_gather_dielectric(const mx_GgxLobe lobe, const vec3 V, const float limit, const float refract_ior,
    const float ior)
{
    mx_GgxSamples samples = mx_ggx_samples(lobe, V);
    vec2 around = vec2(1.0, 0.0);
    vec3 sum = vec3(0.0);
    for (float depth = 0.5 * samples.step; depth < limit * samples.top.z; depth += samples.step) {
        vec4 light = mx_ggx_sample(samples, around, depth, refract_ior);
        float f = mx_fresnel_dielectric(light.w, ior);
        sum += (refract_ior > 0.0 ? 1.0 - f : f) * light.xyz;
        around = mat2(-0.7373689, 0.6754903, -0.6754903, -0.7373689) * around;
    }
    return samples.weight * sum;
}

// Any other: on a colour, or what it lets through.
vec3 mx_ggx_gather_film(const mx_GgxLobe lobe, const vec3 V, const float limit, const vec3 n, const vec3 k,
    const float film, const float film_ior)
{
    mx_GgxSamples samples = mx_ggx_samples(lobe, V);
    vec2 around = vec2(1.0, 0.0);
    vec3 sum = vec3(0.0);
    for (float depth = 0.5 * samples.step; depth < limit * samples.top.z; depth += samples.step) {
        vec4 light = mx_ggx_sample(samples, around, depth, 0.0);
        sum += mx_film_schlick(light.w, n, k, film, film_ior) * light.xyz;
        around = mat2(-0.7373689, 0.6754903, -0.6754903, -0.7373689) * around;
    }
    return samples.weight * sum;
}

vec3 mx_ggx_gather_schlick(const mx_GgxLobe lobe, const vec3 V, const float limit, const vec3 f0, const vec3 bend)
{
    mx_GgxSamples samples = mx_ggx_samples(lobe, V);
    vec2 around = vec2(1.0, 0.0);
    vec3 sum = vec3(0.0);
    for (float depth = 0.5 * samples.step; depth < limit * samples.top.z; depth += samples.step) {
        vec4 light = mx_ggx_sample(samples, around, depth, 0.0);
        sum += mx_fresnel_schlick(light.w, f0, bend) * light.xyz;
        around = mat2(-0.7373689, 0.6754903, -0.6754903, -0.7373689) * around;
    }
    return samples.weight * sum;
}

// A film on an index of refraction, reflection alone: what most films are.
vec3 mx_ggx_gather_film_index(const mx_GgxLobe lobe, const vec3 V, const float limit, const vec3 n, const float film,
    const float film_ior)
{
    mx_GgxSamples samples = mx_ggx_samples(lobe, V);
    vec2 around = vec2(1.0, 0.0);
    vec3 sum = vec3(0.0);
    for (float depth = 0.5 * samples.step; depth < limit * samples.top.z; depth += samples.step) {
        vec4 light = mx_ggx_sample(samples, around, depth, 0.0);
        sum += mx_film_index(light.w, n, film, film_ior) * light.xyz;
        around = mat2(-0.7373689, 0.6754903, -0.6754903, -0.7373689) * around;
    }
    return samples.weight * sum;
}

// Albedo of what the lobe scatters more than once, relative to `color`.
vec3 mx_fujii_multiple(const vec3 color, const float mean)
{
    return color * mean / (vec3(1.0) - color * max(1.0 - mean, 0.0));
}

void main()
{
    // SR_open_pbr_surface
    float coat_front = SR_open_pbr_surface_coat_ior * 4.0
        / ((SR_open_pbr_surface_coat_ior + 1.0) * (SR_open_pbr_surface_coat_ior + 1.0));
    vec3 N = normalize(vd_normalWorld);
    vec3 V = normalize(u_viewPosition - vd_positionWorld);
    float absolute = abs(dot(N, V));
    vec3 color = SR_open_pbr_surface_emission_luminance
        * (SR_open_pbr_surface_emission_color
        * (1.0 - SR_open_pbr_surface_coat_weight + SR_open_pbr_surface_coat_color
        * (SR_open_pbr_surface_coat_weight * (coat_front * (1.0 - pow(1.0 - min(absolute, 1.0), 5.0))))));
    // lights
    vec3 subsurface_positive = max(SR_open_pbr_surface_subsurface_color, 0.0);
    float thin = float(SR_open_pbr_surface_geometry_thin_walled);
    float dielectric_weight = 1.0 - SR_open_pbr_surface_base_metalness;
    float opaque_weight = dielectric_weight * (1.0 - SR_open_pbr_surface_transmission_weight);
    float scaled_sheet_weight = thin * (SR_open_pbr_surface_subsurface_weight * opaque_weight) * 0.5;
    float ior_relative = mix(SR_open_pbr_surface_specular_ior,
        max(SR_open_pbr_surface_specular_ior / SR_open_pbr_surface_coat_ior, SR_open_pbr_surface_coat_ior
        / SR_open_pbr_surface_specular_ior), SR_open_pbr_surface_coat_weight);
    float amplitude_bound = clamp((ior_relative - 1.0) / (ior_relative + 1.0)
        * sqrt(SR_open_pbr_surface_specular_weight), -0.999995, 0.999995);
    float ior = (amplitude_bound + 1.0) / (1.0 - amplitude_bound);
    float fresnel_bare = mx_fresnel_dielectric(1.0, ior);
    vec2 roughness = mx_open_pbr_anisotropy(mix(SR_open_pbr_surface_specular_roughness,
        pow(min(pow(SR_open_pbr_surface_coat_roughness, 4.0) * 2.0 + pow(SR_open_pbr_surface_specular_roughness, 4.0),
        1.0), 0.25), SR_open_pbr_surface_coat_weight), SR_open_pbr_surface_specular_roughness_anisotropy);
    vec2 alpha = clamp(roughness, 1e-8, 1.0);
    float a = sqrt(alpha.x * alpha.y);
    float cos_v = max(absolute, 1e-8);
    vec2 albedo = mx_ggx_albedo_fit(a, a / (cos_v + a), cos_v);
    float product = mix(fresnel_bare, 1.0, albedo.y) * albedo.x;
    float difference = 1.0 / albedo.x - 1.0;
    float reflection_scale = difference * mix(fresnel_bare, 1.0, 0.04761905) + 1.0;
    vec3 reflection_throughput = vec3(1.0 - product * reflection_scale);
    float film_thickness = SR_open_pbr_surface_thin_film_thickness * 1000.0;
    vec3 reflection_film_scale = mix(mx_fresnel(1.0, vec3(ior), film_thickness, SR_open_pbr_surface_thin_film_ior),
        vec3(1.0), 0.04761905) * difference + vec3(1.0);
    float r = clamp(SR_open_pbr_surface_fuzz_roughness, 0.01, 1.0);
    float width = r * (r * 1.58491 + 0.0206607) / (r * (r + 1.32227) + 0.0379424);
    float x = (cos_v - r * (r * (r * (1.7932 - r * (r * 0.95943)) - 1.14885) - 0.193854) / (r + 0.046391)) / width;
    float fuzz_ratio = exp(x * (x * -0.5)) / (width * 2.5066283);
    float fuzz_product = r * (r * (r * 0.119681 - 0.0207818) + 0.000654023);
    float fuzz_product_2 = SR_open_pbr_surface_fuzz_weight
        * max(fuzz_ratio + fuzz_product / (r * (r - 1.92021) + 1.26264), 0.0);
    float coating_fresnel_bare = mx_fresnel_dielectric(1.0, SR_open_pbr_surface_coat_ior);
    vec2 coat_lobe = mx_open_pbr_anisotropy(SR_open_pbr_surface_coat_roughness,
        SR_open_pbr_surface_coat_roughness_anisotropy);
    vec2 coating_alpha = clamp(coat_lobe, 1e-8, 1.0);
    float coating_a = sqrt(coating_alpha.x * coating_alpha.y);
    vec2 coating_albedo = mx_ggx_albedo_fit(coating_a, coating_a / (cos_v + coating_a), cos_v);
    float coating_scale = mix(coating_fresnel_bare, 1.0, 0.04761905) * (1.0 / coating_albedo.x - 1.0) + 1.0;
    float coated_weight = (1.0 - fuzz_product_2)
        * (1.0 - SR_open_pbr_surface_coat_weight
        * (mix(coating_fresnel_bare, 1.0, coating_albedo.y) * coating_albedo.x * coating_scale));
    vec3 substrate_darkened_weight = coated_weight
        * clamp(mix(vec3(1.0), SR_open_pbr_surface_coat_color, SR_open_pbr_surface_coat_weight), 0.0, 1.0);
    float coat_escape = coat_front / (SR_open_pbr_surface_coat_ior * SR_open_pbr_surface_coat_ior);
    vec3 darkening = coat_escape / (vec3(1.0)
        - mix(mix(SR_open_pbr_surface_base_color, SR_open_pbr_surface_subsurface_color,
        SR_open_pbr_surface_subsurface_weight), SR_open_pbr_surface_base_color * SR_open_pbr_surface_specular_weight,
        SR_open_pbr_surface_base_metalness) * (1.0 - coat_escape));
    vec3 substrate_weight = substrate_darkened_weight
        * clamp(mix(vec3(1.0), darkening, SR_open_pbr_surface_coat_weight * SR_open_pbr_surface_coat_darkening), 0.0,
        1.0);
    vec3 body_weight = mix(reflection_throughput, vec3(1.0) - product * reflection_film_scale,
        SR_open_pbr_surface_thin_film_weight) * substrate_weight;
    vec3 sheet_front_product = subsurface_positive
        * (scaled_sheet_weight * (body_weight
        * clamp(SR_open_pbr_surface_subsurface_color * (1.0 - SR_open_pbr_surface_subsurface_scatter_anisotropy), 0.0,
        1.0)));
    vec3 Nf = faceforward(N, -V, N);
    float r2 = SR_open_pbr_surface_base_diffuse_roughness * SR_open_pbr_surface_base_diffuse_roughness;
    vec2 ab = r2 * vec2(-0.5, 0.45) / (r2 + vec2(0.33, 0.09)) + vec2(1.0, 0.0);
    vec3 sheet_back_product = subsurface_positive
        * (scaled_sheet_weight * (body_weight
        * clamp(SR_open_pbr_surface_subsurface_color * (SR_open_pbr_surface_subsurface_scatter_anisotropy + 1.0), 0.0,
        1.0)));
    float limited_cos_v = min(cos_v, 1.0);
    vec3 fuzz_product_3 = SR_open_pbr_surface_fuzz_color * fuzz_product_2;
    float coating_product = coating_scale * (SR_open_pbr_surface_coat_weight * (1.0 - fuzz_product_2));
    vec3 X = normalize(vd_tangentWorld);
    mx_GgxLobe coating_lobe = mx_ggx_lobe(coat_lobe, Nf, X, V);
    float metal_film_weight = SR_open_pbr_surface_specular_weight
        * (SR_open_pbr_surface_base_metalness * SR_open_pbr_surface_thin_film_weight);
    vec3 n = max(SR_open_pbr_surface_base_weight * SR_open_pbr_surface_base_color, 0.0);
    vec3 limited_specular_color = max(SR_open_pbr_surface_specular_color, 0.0);
    vec3 schlick_bend = mix(n, vec3(1.0), 0.4626644) * (vec3(1.0) - limited_specular_color) * 17.651384;
    vec3 metal_film_product = (difference
        * mix(mx_fresnel(1.0, n, schlick_bend, film_thickness, SR_open_pbr_surface_thin_film_ior), vec3(1.0),
        0.04761905) + vec3(1.0)) * (substrate_weight * metal_film_weight);
    mx_GgxLobe lobe = mx_ggx_lobe(roughness, Nf, X, V);
    float metal_bare_weight = SR_open_pbr_surface_specular_weight
        * (SR_open_pbr_surface_base_metalness * (1.0 - SR_open_pbr_surface_thin_film_weight));
    vec3 metal_bare_product = (difference * mix(mx_fresnel_schlick(1.0, n, schlick_bend), vec3(1.0), 0.04761905)
        + vec3(1.0)) * (substrate_weight * metal_bare_weight);
    bool reflection_film_visible = SR_open_pbr_surface_thin_film_weight * dielectric_weight > 0.0;
    vec3 reflection_film_product = substrate_weight * (SR_open_pbr_surface_thin_film_weight * dielectric_weight)
        * (reflection_film_scale * limited_specular_color);
    float reflection_weight = dielectric_weight * (1.0 - SR_open_pbr_surface_thin_film_weight);
    vec3 reflection_product = limited_specular_color * (substrate_weight * reflection_weight);
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
    float diffuse_sum = SR_open_pbr_surface_base_diffuse_roughness * 0.28779334 + 1.0;
    float mean = (SR_open_pbr_surface_base_diffuse_roughness * 0.0724882 + 1.0) / diffuse_sum;
    vec3 fujii_multiple = base_positive * mean / (vec3(1.0) - base_positive * max(1.0 - mean, 0.0));
    float diffuse_fujii_albedo = mx_fujii_albedo(cos_v, SR_open_pbr_surface_base_diffuse_roughness);
    float diffuse_greater = max(1.0 - diffuse_fujii_albedo, 1e-8);
    float diffuse_greater_2 = max(1.0 - mean, 1e-8);
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        // sheet_front, sheet_back
        int type = u_lightData[i].type;
        float intensity = u_lightData[i].intensity;
        vec3 d = u_lightData[i].position - vd_positionWorld;
        float ratio = intensity / pow(length(d) + 1.0, u_lightData[i].decay_rate);
        float spot_light_difference = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
        vec3 to_light = normalize(d);
        float spot_light_product = smoothstep(spot_light_difference, u_lightData[i].inner_angle,
            -dot(u_lightData[i].direction, to_light)) * ratio;
        float spot_light_choice = type == 3 ? spot_light_product : 0.0;
        float point_light_choice = type == 2 ? ratio : spot_light_choice;
        vec3 light = u_lightData[i].color * (type == 1 ? intensity : point_light_choice);
        vec3 directional_light_to_light = -u_lightData[i].direction;
        vec3 L = type == 1 ? directional_light_to_light : to_light;
        float l_dot_nf = dot(L, Nf);
        float cos_l = max(l_dot_nf, 1e-8);
        float v_dot_l = dot(V, L);
        float s = v_dot_l - cos_v * cos_l;
        float greater = max(cos_l, cos_v);
        vec3 sheet_front_response = sheet_front_product * (cos_l / 3.1415927 * (ab.x + ab.y * max(s, 0.0) / greater));
        color += light * (sheet_front_response + max(-l_dot_nf, 0.0) / 3.1415927 * sheet_back_product);
        // fuzz
        if (SR_open_pbr_surface_fuzz_weight > 0.0)
            color += light * (mx_sheen_zeltner(Nf, V, L, limited_cos_v, r) * fuzz_product_3);
        // coating
        float cosine = sqrt(clamp(v_dot_l * 0.5 + 0.5, 1e-8, 1.0));
        if (SR_open_pbr_surface_coat_weight > 0.0)
            color += light * (coating_product
                * (mx_ggx_light(coating_lobe, V, L) * mx_fresnel_dielectric(cosine, SR_open_pbr_surface_coat_ior)));
        // metal_film
        float ggx_light = mx_ggx_light(lobe, V, L);
        if (metal_film_weight > 0.0)
            color += light * (metal_film_product
                * (ggx_light * mx_fresnel(cosine, n, schlick_bend, film_thickness, SR_open_pbr_surface_thin_film_ior)));
        // metal_bare
        if (metal_bare_weight > 0.0)
            color += light * (metal_bare_product * (ggx_light * mx_fresnel_schlick(cosine, n, schlick_bend)));
        // reflection_film
        if (reflection_film_visible)
            color += light * (reflection_film_product
                * (ggx_light * mx_fresnel(cosine, vec3(ior), film_thickness, SR_open_pbr_surface_thin_film_ior)));
        // reflection
        if (reflection_weight > 0.0)
            color += light * (reflection_scale * reflection_product * (ggx_light * mx_fresnel_dielectric(cosine, ior)));
        // scatter
        if (scatter_weight > 0.0)
            color += light * (mx_subsurface_light(subsurface_falloff, l_dot_nf) * scatter_product);
        // diffuse
        if (diffuse_weight > 0.0) {
            float diffuse_s = s / greater;
            vec3 diffuse_product_2 = fujii_multiple
                * (diffuse_greater * max(1.0 - mx_fujii_albedo(cos_l, SR_open_pbr_surface_base_diffuse_roughness), 1e-8)
                / diffuse_greater_2);
            color += light * (diffuse_product
                * (cos_l / 3.1415927 * ((SR_open_pbr_surface_base_diffuse_roughness * (s > 0.0 ? diffuse_s : s) + 1.0)
                / diffuse_sum + diffuse_product_2)));
        }
    }
    // environment
    // fuzz, sheet_front, scatter
    vec3 part = textureLod(u_envIrradiance, mx_map_point(normalize((u_envMatrix * vec4(Nf, 0.0)).xyz)), 0.0).xyz;
    vec2 fit = SR_open_pbr_surface_base_diffuse_roughness
        * (cos_v * vec2(-0.7632, -0.4993) - vec2(0.4297, 0.6076) + SR_open_pbr_surface_base_diffuse_roughness
        * vec2(1.4385, 2.0315)) + vec2(1.0);
    vec3 sheet_front_response_2 = sheet_front_product * part * (u_envLightIntensity * clamp(fit.x / fit.y, 0.0, 1.0));
    vec3 sum = SR_open_pbr_surface_fuzz_color * part * (fuzz_product_2 * u_envLightIntensity) + sheet_front_response_2;
    color += u_envLightIntensity * (scatter_product * part) + sum;
    // coating
    if (SR_open_pbr_surface_coat_weight > 0.0)
        color += coating_product * mx_ggx_gather_dielectric(coating_lobe, V, 1.0, 0.0, SR_open_pbr_surface_coat_ior);
    // metal_film
    float filmed = film_thickness > 0.0 ? 1.0 : 0.0;
    float limit = film_thickness > 0.0 ? 0.0 : 1.0;
    if (metal_film_weight > 0.0) {
        vec3 metal_film_ggx_gather_film = mx_ggx_gather_film(lobe, V, filmed, n, schlick_bend, film_thickness,
            SR_open_pbr_surface_thin_film_ior);
        vec3 metal_film_bare = mx_ggx_gather_schlick(lobe, V, limit, n, schlick_bend);
        color += metal_film_product * (film_thickness > 0.0 ? metal_film_ggx_gather_film : metal_film_bare);
    }
    // metal_bare
    if (metal_bare_weight > 0.0)
        color += metal_bare_product * mx_ggx_gather_schlick(lobe, V, 1.0, n, schlick_bend);
    // reflection_film
    if (reflection_film_visible) {
        vec3 reflection_film_ggx_gather_film_index = mx_ggx_gather_film_index(lobe, V, filmed, vec3(ior),
            film_thickness, SR_open_pbr_surface_thin_film_ior);
        vec3 reflection_film_bare = mx_ggx_gather_dielectric(lobe, V, limit, 0.0, ior);
        color += reflection_film_product
            * (film_thickness > 0.0 ? reflection_film_ggx_gather_film_index : reflection_film_bare);
    }
    // reflection
    if (reflection_weight > 0.0)
        color += reflection_scale * (reflection_product * mx_ggx_gather_dielectric(lobe, V, 1.0, 0.0, ior));
    // refraction
    if (SR_open_pbr_surface_transmission_weight * dielectric_weight > 0.0) {
        vec3 ggx_refraction = mx_ggx_gather_dielectric(lobe, V, 1.0, ior, ior);
        vec3 tint = max(SR_open_pbr_surface_transmission_depth > 0.0 ? vec3(1.0)
            : SR_open_pbr_surface_transmission_color, 0.0);
        vec3 absorbed = -(SR_open_pbr_surface_transmission_scatter + log(SR_open_pbr_surface_transmission_color))
            / SR_open_pbr_surface_transmission_depth;
        vec3 refraction_product = exp(-(SR_open_pbr_surface_transmission_depth > 0.0 ? absorbed
            - min(min(min(absorbed.x, absorbed.y), absorbed.z), 0.0) : vec3(0.0))) * tint;
        vec3 refraction_product_2 = ggx_refraction * ((u_refractionTwoSided ? tint : vec3(1.0)) * refraction_product);
        color += body_weight * (SR_open_pbr_surface_transmission_weight * dielectric_weight) * refraction_product_2;
    }
    // sheet_back
    if (scaled_sheet_weight > 0.0)
        color += u_envLightIntensity * (sheet_back_product
            * textureLod(u_envIrradiance, mx_map_point(normalize((u_envMatrix * vec4(-Nf, 0.0)).xyz)), 0.0).xyz);
    // diffuse
    if (diffuse_weight > 0.0)
        color += u_envLightIntensity * (mix(mx_fujii_multiple(base_positive, mean), vec3(1.0), diffuse_fujii_albedo)
            * (diffuse_product * part));
    // opacity
    if (SR_open_pbr_surface_geometry_opacity < u_alphaThreshold)
        discard;
    out1 = vec4(SR_open_pbr_surface_geometry_opacity * color, SR_open_pbr_surface_geometry_opacity);
}
