#version 450
// open_pbr_surface · surfacematerial · mxgen 0.1 · vulkan · complete · 12 closures · 0 textures

struct mx_GgxLobe {
    mat3 frame;
    vec3 stretch;
    float area;
    vec3 v;
    float masking;
    vec3 cap;
    float step;
    float weight;
    float level;
    mat4 map;
};
layout(set = 0, binding = 1, std140) uniform PublicUniforms {
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

vec2 mx_sheen_transform(const float c, const float r)
{
    return vec2((2.58126 * c + 0.813703 * r) * r / (1.0 + 0.310327 * c * c + 2.60994 * c * r), sqrt(1.0 - c) * (r - 1.0) * r * r * r / (0.0000254053 + 1.71228 * c - 1.71506 * c * r + 1.34174 * r * r));
}

vec3 mx_enter_frame(const vec3 w, const vec3 N, const vec3 x)
{
    return vec3(dot(w, x), dot(w, cross(N, x)), dot(w, N));
}

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

float mx_fresnel_dielectric(const float cosine, const float ior)
{
    float g = sqrt(max(ior * ior + cosine * cosine - 1.0, 0.0));
    vec2 a = cosine * vec2(1.0, ior * ior);
    vec2 r = (a - g) / (a + g);
    return 0.5 * dot(r, r);
}

vec2 mx_open_pbr_anisotropy(const float roughness, const float anisotropy)
{
    float aspect = 1.0 - anisotropy;
    return roughness * roughness * sqrt(2.0 / (1.0 + aspect * aspect)) * vec2(1.0, aspect);
}

float mx_bicubic(const mat4 m, const float x, const float y)
{
    return dot(vec4(1.0, x, x * x, x * x * x), m * vec4(1.0, y, y * y, y * y * y));
}

vec2 mx_ggx_albedo_fit(const float a, const float u, const float c)
{
    float x = clamp(1.0 - c - a * mx_bicubic(mat4(-0.2006, 5.2916, -3.7565, 0.218, -10.2439, 6.6203, -0.9657, 2.5694, 38.3042, -80.8059, 71.731, -28.5214, -34.2, 89.1079, -88.4065, 33.782), u, a), 0.0, 1.0);
    return vec2(min(1.0046 - u * mx_bicubic(mat4(-0.1447, 2.759, -5.4314, 2.8497, -0.9366, 1.4766, 0.5911, -1.0905, 11.8506, -30.2645, 27.3289, -8.9414, -4.3199, 8.2596, -3.1648, -0.8054), u, a), 1.0), x * x * x * x * x);
}

mx_GgxLobe mx_ggx_lobe_at(const mat3 frame, const vec2 alpha, const vec3 v)
{
    float area = alpha.x * alpha.y;
    float masking = sqrt(mix(v.z * v.z, 1.0, area));
    float step_ = 1.0 / float(max(u_envRadianceSamples, 1));
    float weight = step_ * (v.z + masking);
    return mx_GgxLobe(frame, vec3(alpha, 1.0), area, v, masking, normalize(v * vec3(alpha, 1.0)), step_, weight * u_envLightIntensity, weight * area * exp2(2.0 * float(u_envRadianceMips) - 2.3485), u_envMatrix);
}

mat3 mx_frame(const vec3 N, const vec3 X)
{
    mat3 frame;
    frame[0] = normalize(X - dot(X, N) * N);
    frame[1] = cross(N, frame[0]);
    frame[2] = N;
    return frame;
}

mx_GgxLobe mx_ggx_lobe(const vec2 roughness, const vec3 N, const vec3 X, const vec3 V)
{
    mat3 frame = mx_frame(N, X);
    return mx_ggx_lobe_at(frame, clamp(roughness, vec2(1e-8), vec2(1.0)), max(V * frame, vec3(-1.0, -1.0, 1e-8)));
}

float mx_ggx_distribution(const vec3 e, const float area)
{
    return 1.0 / (3.1415927 * area * dot(e, e) * dot(e, e));
}

float mx_ggx_visibility(const mx_GgxLobe lobe, const float cos_l)
{
    return cos_l / (lobe.v.z * sqrt(mix(cos_l * cos_l, 1.0, lobe.area)) + cos_l * lobe.masking);
}

float mx_ggx_light(const mx_GgxLobe lobe, const vec3 L, const vec3 H)
{
    return 0.5 * mx_ggx_distribution(H * lobe.frame / lobe.stretch, lobe.area) * mx_ggx_visibility(lobe, max(dot(L, lobe.frame[2]), 1e-8));
}

vec3 mx_fresnel_schlick(const float cosine, const vec3 f0, const vec3 bend)
{
    float x = 1.0 - cosine;
    float x3 = x * x * x;
    return mix(f0, vec3(1.0), x3 * x * x) - bend * (cosine * x3 * x3);
}

vec3 mx_film_response(const float d, const vec3 re, const vec3 im)
{
    vec4 a = vec4(1.681, 1.7953, 2.2084, 2.2399) * d;
    vec4 xyzx = vec4(0.84659, 1.000222, 1.001122, 0.153868) * exp(vec4(-0.0043278, -0.0093046, -0.0066121, -0.0045282) * (d * d)) * (vec4(re, re.x) * cos(a) - vec4(im, im.x) * sin(a));
    return xyzx.xyz + vec3(xyzx.w, 0.0, 0.0);
}

vec3 mx_film_series(const float a, const vec3 re, const vec3 im, const float d)
{
    vec3 r23 = re * re + im * im;
    float r12 = a * a;
    float t = 1.0 - r12;
    vec3 constant = t * t * r23 / (vec3(1.0) - r12 * r23);
    vec3 terms = r12 * mx_film_response(2.0 * d, re * re - im * im, 2.0 * re * im) - a * mx_film_response(d, re, im);
    return r12 + constant + 2.0 * (constant - t) * terms;
}

vec2 mx_film_amplitudes(const float cosine, const float inside, const float ior)
{
    vec2 x = vec2(cosine, ior * cosine);
    vec2 u = vec2(ior * inside, inside);
    return (x - u) / (x + u);
}

vec3 mx_film_schlick(const float cosine, const vec3 f0, const vec3 bend, const float film, const float film_ior)
{
    float ior = max(film_ior, 1.0);
    float c = sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
    vec2 a = mx_film_amplitudes(cosine, c, ior);
    float d = 0.012566372 * ior * c * film;
    vec3 r = (vec3(1.0) - 2.0 * step(sqrt(clamp(f0, vec3(0.01), vec3(0.99))), vec3((ior - 1.0) / (ior + 1.0)))) * sqrt(max(0.5 * mx_fresnel_schlick(c, f0, bend), vec3(0.0)));
    return clamp(mat3(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949, -0.4706338, 0.0885814, 1.0093968) * (0.5 * (mx_film_series(a.x, -r, vec3(0.0), d) + mx_film_series(a.y, r, vec3(0.0), d))), vec3(0.0), vec3(1.0));
}

vec3 mx_fresnel(const float cosine, const vec3 n, const vec3 k, const float film, const float film_ior)
{
    if (film > 0.0)
        return mx_film_schlick(cosine, n, k, film, film_ior);
    return mx_fresnel_schlick(cosine, n, k);
}

vec3 mx_film_polarized(const float a, const vec3 x, const vec3 y, const vec3 u, const vec3 v, const float d)
{
    vec3 norm = (x + u) * (x + u) + (y + v) * (y + v);
    return mx_film_series(a, (x * x + y * y - u * u - v * v) / norm, 2.0 * (y * u - x * v) / norm, d);
}

void mx_fresnel_refract(const float cosine, const vec3 n, const vec3 k, out vec3 u, out vec3 v)
{
    vec3 t = n * n - k * k + (cosine * cosine - 1.0);
    vec3 norm = sqrt(t * t + 4.0 * n * n * k * k);
    u = sqrt(max(0.5 * (norm + t), vec3(0.0)));
    v = sqrt(max(0.5 * (norm - t), vec3(0.0)));
}

vec3 mx_film_index(const float cosine, const vec3 n, const float film, const float film_ior)
{
    float ior = max(film_ior, 1.0);
    float c = sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
    vec2 a = mx_film_amplitudes(cosine, c, ior);
    float d = 0.012566372 * ior * c * film;
    vec3 m = n / ior;
    vec3 l = vec3(0.0) / ior;
    vec3 u;
    vec3 v;
    mx_fresnel_refract(c, m, l, u, v);
    return clamp(mat3(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949, -0.4706338, 0.0885814, 1.0093968) * (0.5 * (mx_film_polarized(a.x, vec3(c), vec3(0.0), u, v, d) + mx_film_polarized(a.y, c * (m * m - l * l), 2.0 * c * m * l, u, v, d))), vec3(0.0), vec3(1.0));
}

vec3 mx_fresnel(const float cosine, const vec3 n, const float film, const float film_ior)
{
    if (film > 0.0)
        return mx_film_index(cosine, n, film, film_ior);
    return vec3(mx_fresnel_dielectric(cosine, n.x));
}

vec3 mx_subsurface_light(const vec3 falloff, const float cos_l)
{
    float theta = acos(cos_l);
    vec3 light = vec3(0.0);
    vec3 sum = vec3(0.0);
    for (float x = -3.043418; x < 3.1415927; x += 0.19634955) {
        float d = abs(sin(0.5 * x));
        vec3 e = exp(falloff * d);
        vec3 profile = (e + e * e * e) / d;
        light += profile * max(cos(theta + x), 0.0);
        sum += profile;
    }
    return light / (3.1415927 * sum);
}

float mx_fujii_albedo(const float cosine, const float r)
{
    float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    float g = sine * (acos(min(cosine, 1.0)) - sine * cosine) + 0.6666667 * (sine / cosine * (1.0 - sine * sine * sine) - sine);
    return (1.0 + r * g / 3.1415927) / (1.0 + 0.28779334 * r);
}

vec2 mx_latlong(const mat4 map, const vec3 direction)
{
    vec3 d = normalize((map * vec4(direction, 0.0)).xyz);
    return vec2(atan(d.x, -d.z), -2.0 * asin(clamp(d.y, -1.0, 1.0))) * 0.15915494 + vec2(0.5);
}

vec3 mx_filtered_light(const mat4 map, const vec3 L, const float level)
{
    return textureLod(u_envRadiance, mx_latlong(map, L), max(0.25 * log2(level * level / dot(L.xz, L.xz)), 0.0)).xyz;
}

vec3 mx_refract_sphere(const vec3 v, const vec3 h, const float ior)
{
    vec3 inside = refract(-v, h, 1.0 / ior);
    return refract(inside, normalize(inside * dot(inside, h) - 0.5 * h), ior);
}

vec4 mx_ggx_sample_at(const mx_GgxLobe lobe, const vec3 h, const float level, const float refract_ior)
{
    vec3 l = reflect(-lobe.v, h);
    float weight = mx_ggx_visibility(lobe, max(l.z, 1e-8));
    if (refract_ior > 0.0) {
        l = mx_refract_sphere(lobe.v, h, refract_ior);
        weight = 0.5 / lobe.v.z;
    }
    return vec4(weight * mx_filtered_light(lobe.map, lobe.frame * l, level), clamp(dot(lobe.v, h), 1e-8, 1.0));
}

vec3 mx_ggx_cap(const vec2 around, const float depth, const vec3 v)
{
    return vec3(v.xy + sqrt(depth * (2.0 - depth)) * around, v.z + 1.0 - depth);
}

vec4 mx_ggx_sample(const mx_GgxLobe lobe, const vec2 around, const float xi, const float refract_ior)
{
    vec3 cap = mx_ggx_cap(around, xi * (1.0 + lobe.cap.z), lobe.cap);
    vec3 h = cap * lobe.stretch;
    float s = dot(cap, cap) / dot(h, h);
    return mx_ggx_sample_at(lobe, normalize(h), s * s * lobe.level, refract_ior);
}

vec3 mx_ggx_gather_dielectric(const mx_GgxLobe lobe, const float limit, const float refract_ior, const float ior)
{
    vec2 around = vec2(1.0, 0.0);
    vec3 sum = vec3(0.0);
    for (float xi = 0.5 * lobe.step; xi < limit; xi += lobe.step) {
        vec4 light = mx_ggx_sample(lobe, around, xi, refract_ior);
        float f = mx_fresnel_dielectric(light.w, ior);
        sum += (refract_ior > 0.0 ? 1.0 - f : f) * light.xyz;
        around = mat2(-0.7373689, 0.6754903, -0.6754903, -0.7373689) * around;
    }
    return lobe.weight * sum;
}

vec3 mx_ggx_gather_film(const mx_GgxLobe lobe, const float limit, const vec3 n, const vec3 k, const float film, const float film_ior)
{
    vec2 around = vec2(1.0, 0.0);
    vec3 sum = vec3(0.0);
    for (float xi = 0.5 * lobe.step; xi < limit; xi += lobe.step) {
        vec4 light = mx_ggx_sample(lobe, around, xi, 0.0);
        sum += mx_film_schlick(light.w, n, k, film, film_ior) * light.xyz;
        around = mat2(-0.7373689, 0.6754903, -0.6754903, -0.7373689) * around;
    }
    return lobe.weight * sum;
}

vec3 mx_ggx_gather_schlick(const mx_GgxLobe lobe, const float limit, const vec3 f0, const vec3 bend)
{
    vec2 around = vec2(1.0, 0.0);
    vec3 sum = vec3(0.0);
    for (float xi = 0.5 * lobe.step; xi < limit; xi += lobe.step) {
        vec4 light = mx_ggx_sample(lobe, around, xi, 0.0);
        sum += mx_fresnel_schlick(light.w, f0, bend) * light.xyz;
        around = mat2(-0.7373689, 0.6754903, -0.6754903, -0.7373689) * around;
    }
    return lobe.weight * sum;
}

vec3 mx_ggx_gather_film_index(const mx_GgxLobe lobe, const float limit, const vec3 n, const float film, const float film_ior)
{
    vec2 around = vec2(1.0, 0.0);
    vec3 sum = vec3(0.0);
    for (float xi = 0.5 * lobe.step; xi < limit; xi += lobe.step) {
        vec4 light = mx_ggx_sample(lobe, around, xi, 0.0);
        sum += mx_film_index(light.w, n, film, film_ior) * light.xyz;
        around = mat2(-0.7373689, 0.6754903, -0.6754903, -0.7373689) * around;
    }
    return lobe.weight * sum;
}

vec3 mx_fujii_multiple(const vec3 color, const float mean)
{
    return color * mean / (vec3(1.0) - color * max(1.0 - mean, 0.0));
}

void main()
{
    float coat_weight = SR_open_pbr_surface_coat_weight;
    float coat_ior = SR_open_pbr_surface_coat_ior;
    float coat_front = coat_ior * 4.0 / ((coat_ior + 1.0) * (coat_ior + 1.0));
    vec3 normal = normalize(vd.normalWorld);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    float fuzz = abs(dot(normal, V));
    vec3 color = SR_open_pbr_surface_emission_luminance * SR_open_pbr_surface_emission_color * (1.0 - coat_weight + SR_open_pbr_surface_coat_color * (coat_weight * (coat_front * (1.0 - pow(1.0 - min(fuzz, 1.0), 5.0)))));
    vec3 fuzz_2 = faceforward(normal, -V, normal);
    float fuzz_3 = max(fuzz, 1e-8);
    float fuzz_4 = min(fuzz_3, 1.0);
    float fuzz_5 = clamp(SR_open_pbr_surface_fuzz_roughness, 0.01, 1.0);
    float fuzz_6 = fuzz_5 * (fuzz_5 * 1.58491 + 0.0206607) / (fuzz_5 * (fuzz_5 + 1.32227) + 0.0379424);
    float fuzz_7 = (fuzz_3 - fuzz_5 * (fuzz_5 * (fuzz_5 * (1.7932 - fuzz_5 * (fuzz_5 * 0.95943)) - 1.14885) - 0.193854) / (fuzz_5 + 0.046391)) / fuzz_6;
    float fuzz_8 = exp(fuzz_7 * (fuzz_7 * -0.5)) / (fuzz_6 * 2.5066283);
    float fuzz_9 = fuzz_5 * (fuzz_5 * (fuzz_5 * 0.119681 - 0.0207818) + 0.000654023);
    float fuzz_10 = max(fuzz_8 + fuzz_9 / (fuzz_5 * (fuzz_5 - 1.92021) + 1.26264), 0.0);
    vec3 fuzz_11 = SR_open_pbr_surface_fuzz_color * (SR_open_pbr_surface_fuzz_weight * fuzz_10);
    float coating = mx_fresnel_dielectric(1.0, coat_ior);
    vec2 coat_lobe = mx_open_pbr_anisotropy(SR_open_pbr_surface_coat_roughness, SR_open_pbr_surface_coat_roughness_anisotropy);
    vec2 coating_2 = clamp(coat_lobe, 1e-8, 1.0);
    float coating_3 = sqrt(coating_2.x * coating_2.y);
    vec2 coating_4 = mx_ggx_albedo_fit(coating_3, coating_3 / (fuzz_3 + coating_3), fuzz_3);
    float coating_5 = mix(coating, 1.0, 0.04761905) * (1.0 / coating_4.x - 1.0) + 1.0;
    float fuzz_12 = 1.0 - SR_open_pbr_surface_fuzz_weight * fuzz_10;
    float coating_6 = coating_5 * (coat_weight * fuzz_12);
    vec3 tangent = normalize(vd.tangentWorld);
    mx_GgxLobe coating_7 = mx_ggx_lobe(coat_lobe, fuzz_2, tangent, V);
    float metal_film = SR_open_pbr_surface_specular_weight * (SR_open_pbr_surface_base_metalness * SR_open_pbr_surface_thin_film_weight);
    vec2 roughness = mx_open_pbr_anisotropy(mix(SR_open_pbr_surface_specular_roughness, pow(min(pow(SR_open_pbr_surface_coat_roughness, 4.0) * 2.0 + pow(SR_open_pbr_surface_specular_roughness, 4.0), 1.0), 0.25), coat_weight), SR_open_pbr_surface_specular_roughness_anisotropy);
    vec2 reflection_film = clamp(roughness, 1e-8, 1.0);
    float reflection_film_2 = sqrt(reflection_film.x * reflection_film.y);
    vec2 reflection_film_3 = mx_ggx_albedo_fit(reflection_film_2, reflection_film_2 / (fuzz_3 + reflection_film_2), fuzz_3);
    float reflection_film_4 = 1.0 / reflection_film_3.x - 1.0;
    vec3 metal_film_2 = max(SR_open_pbr_surface_base_weight * SR_open_pbr_surface_base_color, 0.0);
    vec3 metal_film_3 = max(SR_open_pbr_surface_specular_color, 0.0);
    vec3 metal_film_4 = mix(metal_film_2, vec3(1.0), 0.4626644) * (vec3(1.0) - metal_film_3) * 17.651384;
    float film_thickness = SR_open_pbr_surface_thin_film_thickness * 1000.0;
    float thin_film_ior = SR_open_pbr_surface_thin_film_ior;
    float coat = fuzz_12 * (1.0 - coat_weight * (mix(coating, 1.0, coating_4.y) * coating_4.x * coating_5));
    vec3 coated = coat * clamp(mix(vec3(1.0), SR_open_pbr_surface_coat_color, coat_weight), 0.0, 1.0);
    float coat_escape = coat_front / (coat_ior * coat_ior);
    vec3 darkening = coat_escape / (vec3(1.0) - mix(mix(SR_open_pbr_surface_base_color, SR_open_pbr_surface_subsurface_color, SR_open_pbr_surface_subsurface_weight), SR_open_pbr_surface_base_color * SR_open_pbr_surface_specular_weight, SR_open_pbr_surface_base_metalness) * (1.0 - coat_escape));
    vec3 substrate_darkened = coated * clamp(mix(vec3(1.0), darkening, coat_weight * SR_open_pbr_surface_coat_darkening), 0.0, 1.0);
    vec3 metal_film_5 = (reflection_film_4 * mix(mx_fresnel(1.0, metal_film_2, metal_film_4, film_thickness, thin_film_ior), vec3(1.0), 0.04761905) + vec3(1.0)) * (substrate_darkened * metal_film);
    mx_GgxLobe metal_film_6 = mx_ggx_lobe(roughness, fuzz_2, tangent, V);
    float metal_bare = SR_open_pbr_surface_specular_weight * (SR_open_pbr_surface_base_metalness * (1.0 - SR_open_pbr_surface_thin_film_weight));
    vec3 metal_bare_2 = (reflection_film_4 * mix(mx_fresnel_schlick(1.0, metal_film_2, metal_film_4), vec3(1.0), 0.04761905) + vec3(1.0)) * (substrate_darkened * metal_bare);
    float substrate = 1.0 - SR_open_pbr_surface_base_metalness;
    bool b = SR_open_pbr_surface_thin_film_weight * substrate > 0.0;
    float ior_relative = mix(SR_open_pbr_surface_specular_ior, max(SR_open_pbr_surface_specular_ior / coat_ior, coat_ior / SR_open_pbr_surface_specular_ior), coat_weight);
    float amplitude_bound = clamp((ior_relative - 1.0) / (ior_relative + 1.0) * sqrt(SR_open_pbr_surface_specular_weight), -0.999995, 0.999995);
    float ior = (amplitude_bound + 1.0) / (1.0 - amplitude_bound);
    vec3 reflection_film_5 = mix(mx_fresnel(1.0, vec3(ior), film_thickness, thin_film_ior), vec3(1.0), 0.04761905) * reflection_film_4 + vec3(1.0);
    vec3 reflection_film_6 = substrate_darkened * (SR_open_pbr_surface_thin_film_weight * substrate) * (reflection_film_5 * metal_film_3);
    float gloss = substrate * (1.0 - SR_open_pbr_surface_thin_film_weight);
    float reflection_film_7 = mx_fresnel_dielectric(1.0, ior);
    float reflection = reflection_film_4 * mix(reflection_film_7, 1.0, 0.04761905) + 1.0;
    vec3 reflection_2 = metal_film_3 * (substrate_darkened * gloss);
    float body = substrate * (1.0 - SR_open_pbr_surface_transmission_weight);
    float thin = float(SR_open_pbr_surface_geometry_thin_walled);
    float scatter_or_sheet = SR_open_pbr_surface_subsurface_weight * body * (1.0 - thin);
    float scatter = max(length(fwidth(fuzz_2)) / length(fwidth(vd.positionWorld)), 0.01) * 3.0;
    vec3 scatter_2 = vec3(-2.0) / (scatter * max(SR_open_pbr_surface_subsurface_radius * SR_open_pbr_surface_subsurface_radius_scale, 0.1));
    vec3 subsurface_positive = max(SR_open_pbr_surface_subsurface_color, 0.0);
    float reflection_film_8 = mix(reflection_film_7, 1.0, reflection_film_3.y) * reflection_film_3.x;
    vec3 reflection_3 = vec3(1.0 - reflection_film_8 * reflection);
    vec3 dielectric = mix(reflection_3, vec3(1.0) - reflection_film_8 * reflection_film_5, SR_open_pbr_surface_thin_film_weight) * substrate_darkened;
    vec3 scatter_3 = subsurface_positive * (dielectric * scatter_or_sheet);
    float diffuse = SR_open_pbr_surface_base_weight * (body * (1.0 - SR_open_pbr_surface_subsurface_weight));
    vec3 base_positive = max(SR_open_pbr_surface_base_color, 0.0);
    vec3 diffuse_2 = base_positive * (dielectric * diffuse);
    float base_diffuse_roughness = SR_open_pbr_surface_base_diffuse_roughness;
    float diffuse_3 = base_diffuse_roughness * 0.28779334 + 1.0;
    float diffuse_4 = (base_diffuse_roughness * 0.07248821 + 1.0) / diffuse_3;
    vec3 diffuse_5 = base_positive * diffuse_4 / (vec3(1.0) - base_positive * max(1.0 - diffuse_4, 0.0));
    float diffuse_6 = mx_fujii_albedo(fuzz_3, base_diffuse_roughness);
    float diffuse_7 = max(1.0 - diffuse_6, 1e-8);
    float diffuse_8 = max(1.0 - diffuse_4, 1e-8);
    float sheet = thin * (SR_open_pbr_surface_subsurface_weight * body) * 0.5;
    vec3 sheet_front = sheet * (dielectric * clamp(SR_open_pbr_surface_subsurface_color * (1.0 - SR_open_pbr_surface_subsurface_scatter_anisotropy), 0.0, 1.0));
    vec2 sheet_front_2 = base_diffuse_roughness * base_diffuse_roughness * vec2(-0.5, 0.45) / (base_diffuse_roughness * base_diffuse_roughness + vec2(0.33, 0.09)) + vec2(1.0, 0.0);
    vec3 sheet_back = subsurface_positive * (sheet * (dielectric * clamp(SR_open_pbr_surface_subsurface_color * (SR_open_pbr_surface_subsurface_scatter_anisotropy + 1.0), 0.0, 1.0)));
    for (int i = 0; i < min(u_numActiveLightSources, 3); ++i) {
        int type = u_lightData[i].type;
        float intensity = u_lightData[i].intensity;
        vec3 spot_light = u_lightData[i].position - vd.positionWorld;
        float spot_light_2 = intensity / pow(length(spot_light) + 1.0, u_lightData[i].decay_rate);
        float spot_light_3 = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
        vec3 spot_light_4 = normalize(spot_light);
        float spot_light_5 = smoothstep(spot_light_3, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, spot_light_4)) * spot_light_2;
        float light = type == 3 ? spot_light_5 : 0.0;
        float light_2 = type == 2 ? spot_light_2 : light;
        vec3 light_3 = u_lightData[i].color * (type == 1 ? intensity : light_2);
        vec3 directional_light = -u_lightData[i].direction;
        vec3 L = type == 1 ? directional_light : spot_light_4;
        if (SR_open_pbr_surface_fuzz_weight > 0.0)
            color += light_3 * (mx_sheen_zeltner(fuzz_2, V, L, fuzz_4, fuzz_5) * fuzz_11);
        vec3 coating_8 = normalize(V + L);
        float coating_9 = clamp(dot(V, coating_8), 1e-8, 1.0);
        if (coat_weight > 0.0)
            color += light_3 * (coating_6 * (mx_ggx_light(coating_7, L, coating_8) * mx_fresnel_dielectric(coating_9, coat_ior)));
        float metal_film_7 = mx_ggx_light(metal_film_6, L, coating_8);
        if (metal_film > 0.0)
            color += light_3 * (metal_film_5 * (metal_film_7 * mx_fresnel(coating_9, metal_film_2, metal_film_4, film_thickness, thin_film_ior)));
        if (metal_bare > 0.0)
            color += light_3 * (metal_bare_2 * (metal_film_7 * mx_fresnel_schlick(coating_9, metal_film_2, metal_film_4)));
        if (b)
            color += light_3 * (reflection_film_6 * (metal_film_7 * mx_fresnel(coating_9, vec3(ior), film_thickness, thin_film_ior)));
        if (gloss > 0.0)
            color += light_3 * (reflection * reflection_2 * (metal_film_7 * mx_fresnel_dielectric(coating_9, ior)));
        float sheet_front_3 = dot(L, fuzz_2);
        if (scatter_or_sheet > 0.0)
            color += light_3 * (mx_subsurface_light(scatter_2, sheet_front_3) * scatter_3);
        float sheet_front_4 = max(sheet_front_3, 1e-8);
        float sheet_front_5 = dot(V, L) - fuzz_3 * sheet_front_4;
        float sheet_front_6 = max(sheet_front_4, fuzz_3);
        if (diffuse > 0.0) {
            float diffuse_9 = sheet_front_5 / sheet_front_6;
            vec3 diffuse_10 = diffuse_5 * (diffuse_7 * max(1.0 - mx_fujii_albedo(sheet_front_4, base_diffuse_roughness), 1e-8) / diffuse_8);
            color += light_3 * (diffuse_2 * (sheet_front_4 / 3.1415927 * ((base_diffuse_roughness * (sheet_front_5 > 0.0 ? diffuse_9 : sheet_front_5) + 1.0) / diffuse_3 + diffuse_10)));
        }
        vec3 sheet_front_7 = subsurface_positive * sheet_front * (sheet_front_4 / 3.1415927 * (sheet_front_2.x + sheet_front_2.y * max(sheet_front_5, 0.0) / sheet_front_6));
        color += light_3 * (sheet_front_7 + max(-sheet_front_3, 0.0) / 3.1415927 * sheet_back);
    }
    if (coat_weight > 0.0)
        color += coating_6 * mx_ggx_gather_dielectric(coating_7, 1.0, 0.0, coat_ior);
    float metal_film_8 = film_thickness > 0.0 ? 1.0 : 0.0;
    float metal_film_9 = film_thickness > 0.0 ? 0.0 : 1.0;
    if (metal_film > 0.0) {
        vec3 metal_film_10 = mx_ggx_gather_film(metal_film_6, metal_film_8, metal_film_2, metal_film_4, film_thickness, thin_film_ior);
        vec3 metal_film_11 = mx_ggx_gather_schlick(metal_film_6, metal_film_9, metal_film_2, metal_film_4);
        color += metal_film_5 * (film_thickness > 0.0 ? metal_film_10 : metal_film_11);
    }
    if (metal_bare > 0.0)
        color += metal_bare_2 * mx_ggx_gather_schlick(metal_film_6, 1.0, metal_film_2, metal_film_4);
    if (b) {
        vec3 reflection_film_9 = mx_ggx_gather_film_index(metal_film_6, metal_film_8, vec3(ior), film_thickness, thin_film_ior);
        vec3 reflection_film_10 = mx_ggx_gather_dielectric(metal_film_6, metal_film_9, 0.0, ior);
        color += reflection_film_6 * (film_thickness > 0.0 ? reflection_film_9 : reflection_film_10);
    }
    if (gloss > 0.0)
        color += reflection_2 * (reflection * mx_ggx_gather_dielectric(metal_film_6, 1.0, 0.0, ior));
    if (SR_open_pbr_surface_transmission_weight * substrate > 0.0) {
        vec3 refraction = mx_ggx_gather_dielectric(metal_film_6, 1.0, ior, ior);
        vec3 refraction_2 = max(SR_open_pbr_surface_transmission_depth > 0.0 ? vec3(1.0) : SR_open_pbr_surface_transmission_color, 0.0);
        vec3 absorbed = -(SR_open_pbr_surface_transmission_scatter + log(SR_open_pbr_surface_transmission_color)) / SR_open_pbr_surface_transmission_depth;
        vec3 refraction_3 = exp(-(SR_open_pbr_surface_transmission_depth > 0.0 ? absorbed - min(min(min(absorbed.x, absorbed.y), absorbed.z), 0.0) : vec3(0.0))) * refraction_2;
        vec3 refraction_4 = refraction * ((u_refractionTwoSided ? refraction_2 : vec3(1.0)) * refraction_3);
        color += dielectric * (SR_open_pbr_surface_transmission_weight * substrate) * refraction_4;
    }
    if (sheet > 0.0)
        color += sheet_back * (u_envLightIntensity * textureLod(u_envIrradiance, mx_latlong(u_envMatrix, -fuzz_2), 0.0).xyz);
    vec3 fuzz_13 = textureLod(u_envIrradiance, mx_latlong(u_envMatrix, fuzz_2), 0.0).xyz * u_envLightIntensity;
    if (diffuse > 0.0)
        color += mix(mx_fujii_multiple(base_positive, diffuse_4), vec3(1.0), diffuse_6) * (diffuse_2 * fuzz_13);
    vec2 sheet_front_8 = base_diffuse_roughness * (fuzz_3 * vec2(-0.7632, -0.4993) - vec2(0.4297, 0.6076) + base_diffuse_roughness * vec2(1.4385, 2.0315)) + vec2(1.0);
    vec3 sheet_front_9 = subsurface_positive * clamp(sheet_front_8.x / sheet_front_8.y, 0.0, 1.0) * (sheet_front * fuzz_13);
    color += scatter_3 * fuzz_13 + (SR_open_pbr_surface_fuzz_weight * (SR_open_pbr_surface_fuzz_color * fuzz_10 * fuzz_13) + sheet_front_9);
    if (SR_open_pbr_surface_geometry_opacity < u_alphaThreshold)
        discard;
    out1 = vec4(SR_open_pbr_surface_geometry_opacity * color, SR_open_pbr_surface_geometry_opacity);
}
