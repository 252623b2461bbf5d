#version 450
// standard_surface · surfacematerial · mxgen 0.1 · vulkan · complete · 9 closures · 0 textures

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
layout(set = 0, binding = 1, std140) uniform PublicUniforms {
    float SR_standard_surface_base;
    vec3 SR_standard_surface_base_color;
    float SR_standard_surface_diffuse_roughness;
    float SR_standard_surface_metalness;
    float SR_standard_surface_specular;
    vec3 SR_standard_surface_specular_color;
    float SR_standard_surface_specular_roughness;
    float SR_standard_surface_specular_IOR;
    float SR_standard_surface_specular_anisotropy;
    float SR_standard_surface_specular_rotation;
    float SR_standard_surface_transmission;
    vec3 SR_standard_surface_transmission_color;
    float SR_standard_surface_transmission_extra_roughness;
    float SR_standard_surface_subsurface;
    vec3 SR_standard_surface_subsurface_color;
    vec3 SR_standard_surface_subsurface_radius;
    float SR_standard_surface_subsurface_scale;
    float SR_standard_surface_sheen;
    vec3 SR_standard_surface_sheen_color;
    float SR_standard_surface_sheen_roughness;
    float SR_standard_surface_coat;
    vec3 SR_standard_surface_coat_color;
    float SR_standard_surface_coat_roughness;
    float SR_standard_surface_coat_anisotropy;
    float SR_standard_surface_coat_rotation;
    float SR_standard_surface_coat_IOR;
    float SR_standard_surface_coat_affect_color;
    float SR_standard_surface_coat_affect_roughness;
    float SR_standard_surface_thin_film_thickness;
    float SR_standard_surface_thin_film_IOR;
    float SR_standard_surface_emission;
    vec3 SR_standard_surface_emission_color;
    vec3 SR_standard_surface_opacity;
    bool SR_standard_surface_thin_walled;
};
layout(set = 0, binding = 0, std140) uniform PrivateUniforms {
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
layout(set = 0, binding = 2, std140) uniform LightData_block { LightData u_lightData[3]; };
layout(set = 0, binding = 3) uniform sampler2D u_envRadiance;
layout(set = 0, binding = 4) uniform sampler2D u_envIrradiance;
layout(location = 0) in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
    vec3 tangentWorld;
} vd;
layout(location = 0) out vec4 out1;

// Unpolarised Fresnel equations of a dielectric; the clamped root makes total internal reflection come out as 1.
float mx_fresnel_dielectric(const float cosine, const float ior)
{
    float g = sqrt(max(ior * ior + cosine * cosine - 1.0, 0.0));
    vec2 a = cosine * vec2(1.0, ior * ior);
    vec2 r = (a - g) / (a + g);
    return 0.5 * dot(r, r);
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
vec3 mx_film_index(const float cosine, const vec3 n, const vec3 k, const float film, const float film_ior)
{
    float ior = max(film_ior, 1.0);
    float c = sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
    vec2 a = mx_film_amplitudes(cosine, c, ior);
    float d = 0.012566372 * ior * c * film;
    vec2 re;
    vec2 im;
    mx_film_base(c, n.x / ior, k.x / ior, re, im);
    float x = mx_film_channel(a, re, im, mx_film_terms(a, re, im, d, vec3(1.681, 0.84659, -0.0043278))
        + mx_film_terms(a, re, im, d, vec3(2.2399, 0.153868, -0.0045282)));
    mx_film_base(c, n.y / ior, k.y / ior, re, im);
    float y = mx_film_channel(a, re, im, mx_film_terms(a, re, im, d, vec3(1.7953, 1.000222, -0.0093046)));
    mx_film_base(c, n.z / ior, k.z / ior, re, im);
    float z = mx_film_channel(a, re, im, mx_film_terms(a, re, im, d, vec3(2.2084, 1.001122, -0.0066121)));
    return clamp(mat3(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949, -0.4706338, 0.0885814,
        1.0093968) * vec3(x, y, z), vec3(0.0), vec3(1.0));
}

vec3 mx_fresnel(const float cosine, const vec3 n, const float film, const float film_ior)
{
    if (film > 0.0)
        return mx_film_index(cosine, n, vec3(0.0), film, film_ior);
    return vec3(mx_fresnel_dielectric(cosine, n.x));
}

// Burley 2012, section 5.4: the aspect ratio stretches one axis and shrinks the other.
vec2 mx_roughness_anisotropy(const float roughness, const float anisotropy)
{
    float squared = clamp(roughness * roughness, 1e-8, 1.0);
    float aspect = sqrt(1.0 - clamp(anisotropy, 0.0, 0.98));
    return vec2(min(squared / aspect, 1.0), squared * aspect);
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

// Rodrigues' formula; the axis has unit length.
vec3 mx_rotate3d(const vec3 v, const float angle, const vec3 axis)
{
    float c = cos(angle);
    return v * c + cross(v, axis) * sin(angle) + axis * (dot(axis, v) * (1.0 - c));
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

// Gulbrandsen 2014, "Artist Friendly Metallic Fresnel": his r (n + 1)^2 - (n - 1)^2 is 0 at the greatest n and at 1
// over it, hence factors.
void mx_artistic_ior(const vec3 reflectivity, const vec3 edge_color, out vec3 ior, out vec3 extinction)
{
    vec3 s = sqrt(clamp(reflectivity, vec3(0.0), vec3(0.99)));
    vec3 greatest = (vec3(1.0) + s) / (vec3(1.0) - s);
    ior = mix(greatest, (vec3(1.0) - s * s) / (vec3(1.0) + s * s), edge_color);
    extinction = sqrt(max((greatest - ior) * (ior - vec3(1.0) / greatest), vec3(0.0)));
}

// |(x + iy - u - iv) / (x + iy + u + iv)|^2
float mx_fresnel_ratio(const vec2 x, const vec2 u)
{
    return dot(x - u, x - u) / dot(x + u, x + u);
}

// Fresnel equations for the index n + ik (Pharr et al. 2023, section 9.3.6): against u + iv stands the cosine in the
// perpendicular part, (n + ik)^2 times the cosine in the parallel part.
float mx_fresnel_conductor(const float cosine, const float n, const float k)
{
    vec2 u = mx_fresnel_refract(cosine, n, k);
    return 0.5 * (mx_fresnel_ratio(vec2(cosine, 0.0), u)
        + mx_fresnel_ratio(cosine * vec2(n * n - k * k, 2.0 * n * k), u));
}

// One channel after the other, which needs a third of the registers.
vec3 mx_fresnel_conductor(const float cosine, const vec3 n, const vec3 k)
{
    return vec3(mx_fresnel_conductor(cosine, n.x, k.x), mx_fresnel_conductor(cosine, n.y, k.y),
        mx_fresnel_conductor(cosine, n.z, k.z));
}

vec3 mx_fresnel(const float cosine, const vec3 n, const vec3 k, const float film, const float film_ior)
{
    if (film > 0.0)
        return mx_film_index(cosine, n, k, film, film_ior);
    return mx_fresnel_conductor(cosine, n, k);
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

// A film on an index of refraction, reflection alone: what most films are.
vec3 mx_ggx_gather_film_index(const mx_GgxLobe lobe, const vec3 V, const float limit, const vec3 n, const vec3 k,
    const float film, const float film_ior)
{
    mx_GgxSamples samples = mx_ggx_samples(lobe, V);
    vec2 around = vec2(1.0, 0.0);
    vec3 sum = vec3(0.0);
    for (float depth = 0.5 * samples.step; depth < limit * samples.top.z; depth += samples.step) {
        vec4 light = mx_ggx_sample(samples, around, depth, 0.0);
        sum += mx_film_index(light.w, n, k, film, film_ior) * light.xyz;
        around = mat2(-0.7373689, 0.6754903, -0.6754903, -0.7373689) * around;
    }
    return samples.weight * sum;
}

vec3 mx_ggx_gather_conductor(const mx_GgxLobe lobe, const vec3 V, const float limit, const vec3 n, const vec3 k)
{
    mx_GgxSamples samples = mx_ggx_samples(lobe, V);
    vec2 around = vec2(1.0, 0.0);
    vec3 sum = vec3(0.0);
    for (float depth = 0.5 * samples.step; depth < limit * samples.top.z; depth += samples.step) {
        vec4 light = mx_ggx_sample(samples, around, depth, 0.0);
        sum += mx_fresnel_conductor(light.w, n, k) * light.xyz;
        around = mat2(-0.7373689, 0.6754903, -0.6754903, -0.7373689) * around;
    }
    return samples.weight * sum;
}

void main()
{
    float coat = SR_standard_surface_coat;
    float coat_IOR = SR_standard_surface_coat_IOR;
    float coat_front = coat_IOR * 4.0 / ((coat_IOR + 1.0) * (coat_IOR + 1.0));
    vec3 N = normalize(vd.normalWorld);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    float absolute = abs(dot(N, V));
    vec3 color = SR_standard_surface_emission
        * (SR_standard_surface_emission_color
        * (1.0 - coat + SR_standard_surface_coat_color
        * (coat * (coat_front * (1.0 - pow(1.0 - min(absolute, 1.0), 5.0))))));
    // lights
    vec3 vector_coat_gamma = vec3(SR_standard_surface_coat_affect_color * clamp(coat, 0.0, 1.0) + 1.0);
    float specular_IOR = SR_standard_surface_specular_IOR;
    float thin_film_thickness = SR_standard_surface_thin_film_thickness;
    float thin_film_IOR = SR_standard_surface_thin_film_IOR;
    float coat_blur = SR_standard_surface_coat_roughness * (coat * SR_standard_surface_coat_affect_roughness);
    vec2 roughness = mx_roughness_anisotropy(mix(SR_standard_surface_specular_roughness, 1.0, coat_blur),
        SR_standard_surface_specular_anisotropy);
    vec2 alpha = clamp(roughness, 1e-8, 1.0);
    float a = sqrt(alpha.x * alpha.y);
    float cos_v = max(absolute, 1e-8);
    vec2 albedo = mx_ggx_albedo_fit(a, a / (cos_v + a), cos_v);
    float difference = 1.0 / albedo.x - 1.0;
    vec3 reflection_scale = mix(mx_fresnel(1.0, vec3(specular_IOR), thin_film_thickness, thin_film_IOR), vec3(1.0),
        0.04761905) * difference + vec3(1.0);
    float fresnel_bare = mx_fresnel_dielectric(1.0, coat_IOR);
    vec2 coat_lobe = mx_roughness_anisotropy(SR_standard_surface_coat_roughness, SR_standard_surface_coat_anisotropy);
    vec2 coating_alpha = clamp(coat_lobe, 1e-8, 1.0);
    float coating_a = sqrt(coating_alpha.x * coating_alpha.y);
    vec2 coating_albedo = mx_ggx_albedo_fit(coating_a, coating_a / (cos_v + coating_a), cos_v);
    float coating_scale = mix(fresnel_bare, 1.0, 0.04761905) * (1.0 / coating_albedo.x - 1.0) + 1.0;
    float coating_difference = 1.0 - coat
        * (mix(fresnel_bare, 1.0, coating_albedo.y) * coating_albedo.x * coating_scale);
    vec3 clamped_coat_tint = clamp(mix(vec3(1.0), SR_standard_surface_coat_color, coat), 0.0, 1.0);
    vec3 body_weight = (vec3(1.0) - reflection_scale
        * (SR_standard_surface_specular * (mix(mx_fresnel_dielectric(1.0, specular_IOR), 1.0, albedo.y) * albedo.x)))
        * (coating_difference * clamped_coat_tint);
    float sheen_albedo = clamp(mx_bicubic(mat4(3.7341, -15.9587, 23.621, -11.0989, -8.2265, 35.1081, -49.7137, 23.2945,
        4.0691, -17.882, 25.6639, -12.0167, -0.5833, 2.6552, -3.9393, 1.8999), 1.0 / (cos_v + 1.0), 1.0
        / (SR_standard_surface_sheen_roughness + 0.2)), 0.0, 1.0);
    float fuzz_throughput = 1.0 - SR_standard_surface_sheen * sheen_albedo;
    float dielectric_weight = 1.0 - SR_standard_surface_metalness;
    float opaque_weight = dielectric_weight * (1.0 - SR_standard_surface_transmission);
    vec3 diffuse_weight = body_weight * (fuzz_throughput
        * (SR_standard_surface_base * (opaque_weight * (1.0 - SR_standard_surface_subsurface))));
    vec3 diffuse_product = pow(max(SR_standard_surface_base_color, 0.0), vector_coat_gamma) * diffuse_weight;
    vec3 Nf = faceforward(N, -V, N);
    float r2 = SR_standard_surface_diffuse_roughness * SR_standard_surface_diffuse_roughness;
    vec2 ab = r2 * vec2(-0.5, 0.45) / (r2 + vec2(0.33, 0.09)) + vec2(1.0, 0.0);
    float s = 1.0 / max(SR_standard_surface_sheen_roughness, 0.005);
    float v_dot_nf = dot(V, Nf);
    vec3 fuzz_product = SR_standard_surface_sheen_color * (body_weight * (SR_standard_surface_sheen * opaque_weight));
    vec3 scatter_color = pow(max(SR_standard_surface_subsurface_color, 0.0), vector_coat_gamma);
    float thin = float(SR_standard_surface_thin_walled);
    float translucent_weight = thin * (SR_standard_surface_subsurface * opaque_weight);
    vec3 translucent_product = scatter_color * (body_weight * (fuzz_throughput * translucent_weight));
    vec3 tangent_direction = normalize(vd.tangentWorld);
    vec3 coat_tangent = mx_rotate3d(tangent_direction, radians(SR_standard_surface_coat_rotation * 360.0), N);
    mx_GgxLobe coating_lobe = mx_ggx_lobe(coat_lobe, Nf, coat_tangent, V);
    vec3 metal_ior, metal_extinction;
    mx_artistic_ior(SR_standard_surface_base * SR_standard_surface_base_color, SR_standard_surface_specular
        * SR_standard_surface_specular_color, metal_ior, metal_extinction);
    vec3 metal_scale = difference * mix(mx_fresnel(1.0, metal_ior, metal_extinction, thin_film_thickness,
        thin_film_IOR), vec3(1.0), 0.04761905) + vec3(1.0);
    vec3 metal_product = metal_scale * (clamped_coat_tint * (SR_standard_surface_metalness * coating_difference));
    vec3 specular_tangent = mx_rotate3d(tangent_direction, radians(SR_standard_surface_specular_rotation * 360.0), N);
    mx_GgxLobe lobe = mx_ggx_lobe(roughness, Nf, specular_tangent, V);
    bool reflection_visible = SR_standard_surface_specular * dielectric_weight > 0.0;
    vec3 reflection_weight = clamped_coat_tint
        * (coating_difference * (SR_standard_surface_specular * dielectric_weight));
    vec3 reflection_product = reflection_weight * (reflection_scale * max(SR_standard_surface_specular_color, 0.0));
    float scatter_weight = SR_standard_surface_subsurface * opaque_weight * (1.0 - thin);
    float scaled_curvature = max(length(fwidth(Nf)) / length(fwidth(vd.positionWorld)), 0.01) * 3.0;
    vec3 subsurface_falloff = vec3(-2.0)
        / (scaled_curvature * max(SR_standard_surface_subsurface_radius * SR_standard_surface_subsurface_scale, 0.1));
    vec3 scatter_product = scatter_color * (body_weight * (fuzz_throughput * scatter_weight));
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        // fuzz, translucent, diffuse
        int type = u_lightData[i].type;
        float intensity = u_lightData[i].intensity;
        vec3 d = u_lightData[i].position - vd.positionWorld;
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
        vec3 diffuse_response = diffuse_product
            * (cos_l / 3.1415927 * (ab.x + ab.y * max(v_dot_l - cos_v * cos_l, 0.0) / max(cos_l, cos_v)));
        float scaled_along = (l_dot_nf + v_dot_nf) * (l_dot_nf + v_dot_nf);
        float fuzz_product_2 = cos_l * ((s + 2.0)
            * pow(clamp(1.0 - scaled_along / max(v_dot_l * 2.0 + 2.0, 1e-8), 0.0, 1.0), s * 0.5) / 6.2831855);
        vec3 fuzz_response = fuzz_product_2 / ((cos_v + cos_l - cos_v * cos_l) * 4.0) * fuzz_product;
        color += light * (diffuse_response + (fuzz_response + max(-l_dot_nf, 0.0) / 3.1415927 * translucent_product));
        // coating
        float cosine = sqrt(clamp(v_dot_l * 0.5 + 0.5, 1e-8, 1.0));
        if (coat > 0.0)
            color += light * (coat * coating_scale
                * (mx_ggx_light(coating_lobe, V, L) * mx_fresnel_dielectric(cosine, coat_IOR)));
        // metal
        float ggx_light = mx_ggx_light(lobe, V, L);
        if (SR_standard_surface_metalness > 0.0)
            color += light * (metal_product
                * (ggx_light * mx_fresnel(cosine, metal_ior, metal_extinction, thin_film_thickness, thin_film_IOR)));
        // reflection
        if (reflection_visible)
            color += light * (reflection_product
                * (ggx_light * mx_fresnel(cosine, vec3(specular_IOR), thin_film_thickness, thin_film_IOR)));
        // scatter
        if (scatter_weight > 0.0)
            color += light * (mx_subsurface_light(subsurface_falloff, l_dot_nf) * scatter_product);
    }
    // environment
    // fuzz, scatter, diffuse
    vec3 part = textureLod(u_envIrradiance, mx_map_point(normalize((u_envMatrix * vec4(Nf, 0.0)).xyz)), 0.0).xyz;
    vec2 fit = SR_standard_surface_diffuse_roughness
        * (cos_v * vec2(-0.7632, -0.4993) - vec2(0.4297, 0.6076) + SR_standard_surface_diffuse_roughness
        * vec2(1.4385, 2.0315)) + vec2(1.0);
    vec3 diffuse_response_2 = diffuse_product * part * (u_envLightIntensity * clamp(fit.x / fit.y, 0.0, 1.0));
    vec3 fuzz_response_2 = fuzz_product * part * (sheen_albedo * u_envLightIntensity);
    color += diffuse_response_2 + (fuzz_response_2 + u_envLightIntensity * (scatter_product * part));
    // coating
    if (coat > 0.0)
        color += coat * coating_scale * mx_ggx_gather_dielectric(coating_lobe, V, 1.0, 0.0, coat_IOR);
    // metal
    float filmed = thin_film_thickness > 0.0 ? 1.0 : 0.0;
    float limit = thin_film_thickness > 0.0 ? 0.0 : 1.0;
    if (SR_standard_surface_metalness > 0.0) {
        vec3 metal_ggx_gather_film_index = mx_ggx_gather_film_index(lobe, V, filmed, metal_ior, metal_extinction,
            thin_film_thickness, thin_film_IOR);
        vec3 metal_bare = mx_ggx_gather_conductor(lobe, V, limit, metal_ior, metal_extinction);
        color += metal_product * (thin_film_thickness > 0.0 ? metal_ggx_gather_film_index : metal_bare);
    }
    // reflection
    if (reflection_visible) {
        vec3 reflection_ggx_gather_film_index = mx_ggx_gather_film_index(lobe, V, filmed, vec3(specular_IOR), vec3(0.0),
            thin_film_thickness, thin_film_IOR);
        vec3 reflection_bare = mx_ggx_gather_dielectric(lobe, V, limit, 0.0, specular_IOR);
        color += reflection_product * (thin_film_thickness > 0.0 ? reflection_ggx_gather_film_index : reflection_bare);
    }
    // refraction
    if (SR_standard_surface_transmission * dielectric_weight > 0.0) {
        vec3 tint = max(SR_standard_surface_transmission_color, 0.0);
        float transmission_blurred = mix(clamp(SR_standard_surface_specular_roughness
            + SR_standard_surface_transmission_extra_roughness, 0.0, 1.0), 1.0, coat_blur);
        mx_GgxLobe refraction_lobe = mx_ggx_lobe(mx_roughness_anisotropy(transmission_blurred,
            SR_standard_surface_specular_anisotropy), Nf, specular_tangent, V);
        vec3 ggx_refraction = mx_ggx_gather_dielectric(refraction_lobe, V, 1.0, specular_IOR, specular_IOR);
        vec3 dielectric_bsdf_transmission = tint * (u_refractionTwoSided ? tint : vec3(1.0)) * ggx_refraction;
        color += dielectric_bsdf_transmission * (body_weight * (SR_standard_surface_transmission * dielectric_weight));
    }
    // translucent
    if (translucent_weight > 0.0)
        color += u_envLightIntensity * (translucent_product
            * textureLod(u_envIrradiance, mx_map_point(normalize((u_envMatrix * vec4(-Nf, 0.0)).xyz)), 0.0).xyz);
    // opacity
    float opacity_grey = dot(SR_standard_surface_opacity, vec3(0.2722287, 0.6740818, 0.0536895));
    if (opacity_grey < u_alphaThreshold)
        discard;
    out1 = vec4(opacity_grey * color, opacity_grey);
}
