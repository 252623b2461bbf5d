#version 300 es
// standard_surface · surfacematerial · mxgen 0.1 · essl · complete · 9 closures · 0 textures
precision highp float;
precision highp int;
precision highp sampler2D;

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
uniform float SR_standard_surface_base;
uniform vec3 SR_standard_surface_base_color;
uniform float SR_standard_surface_diffuse_roughness;
uniform float SR_standard_surface_metalness;
uniform float SR_standard_surface_specular;
uniform vec3 SR_standard_surface_specular_color;
uniform float SR_standard_surface_specular_roughness;
uniform float SR_standard_surface_specular_IOR;
uniform float SR_standard_surface_specular_anisotropy;
uniform float SR_standard_surface_specular_rotation;
uniform float SR_standard_surface_transmission;
uniform vec3 SR_standard_surface_transmission_color;
uniform float SR_standard_surface_transmission_extra_roughness;
uniform float SR_standard_surface_subsurface;
uniform vec3 SR_standard_surface_subsurface_color;
uniform vec3 SR_standard_surface_subsurface_radius;
uniform float SR_standard_surface_subsurface_scale;
uniform float SR_standard_surface_sheen;
uniform vec3 SR_standard_surface_sheen_color;
uniform float SR_standard_surface_sheen_roughness;
uniform float SR_standard_surface_coat;
uniform vec3 SR_standard_surface_coat_color;
uniform float SR_standard_surface_coat_roughness;
uniform float SR_standard_surface_coat_anisotropy;
uniform float SR_standard_surface_coat_rotation;
uniform float SR_standard_surface_coat_IOR;
uniform float SR_standard_surface_coat_affect_color;
uniform float SR_standard_surface_coat_affect_roughness;
uniform float SR_standard_surface_thin_film_thickness;
uniform float SR_standard_surface_thin_film_IOR;
uniform float SR_standard_surface_emission;
uniform vec3 SR_standard_surface_emission_color;
uniform vec3 SR_standard_surface_opacity;
uniform bool SR_standard_surface_thin_walled;
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

float mx_fresnel_dielectric(const float cosine, const float ior)
{
    float g = sqrt(max(ior * ior + cosine * cosine - 1.0, 0.0));
    vec2 a = cosine * vec2(1.0, ior * ior);
    vec2 r = (a - g) / (a + g);
    return 0.5 * dot(r, r);
}

vec2 mx_roughness_anisotropy(const float roughness, const float anisotropy)
{
    float squared = clamp(roughness * roughness, 1e-8, 1.0);
    float aspect = sqrt(1.0 - clamp(anisotropy, 0.0, 0.98));
    return vec2(min(squared / aspect, 1.0), squared * aspect);
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

vec3 mx_rotate3d(const vec3 v, const float angle, const vec3 axis)
{
    float c = cos(angle);
    return v * c + cross(v, axis) * sin(angle) + axis * (dot(axis, v) * (1.0 - c));
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

void mx_artistic_ior(const vec3 reflectivity, const vec3 edge_color, out vec3 ior, out vec3 extinction)
{
    vec3 s = sqrt(clamp(reflectivity, vec3(0.0), vec3(0.99)));
    vec3 greatest = (vec3(1.0) + s) / (vec3(1.0) - s);
    ior = mix(greatest, (vec3(1.0) - s * s) / (vec3(1.0) + s * s), edge_color);
    extinction = sqrt(max((greatest - ior) * (ior - vec3(1.0) / greatest), vec3(0.0)));
}

void mx_fresnel_refract(const float cosine, const vec3 n, const vec3 k, out vec3 u, out vec3 v)
{
    vec3 t = n * n - k * k + (cosine * cosine - 1.0);
    vec3 norm = sqrt(t * t + 4.0 * n * n * k * k);
    u = sqrt(max(0.5 * (norm + t), vec3(0.0)));
    v = sqrt(max(0.5 * (norm - t), vec3(0.0)));
}

vec3 mx_fresnel_ratio(const vec3 x, const vec3 y, const vec3 u, const vec3 v)
{
    return ((x - u) * (x - u) + (y - v) * (y - v)) / ((x + u) * (x + u) + (y + v) * (y + v));
}

vec3 mx_fresnel_conductor(const float cosine, const vec3 n, const vec3 k)
{
    vec3 u;
    vec3 v;
    mx_fresnel_refract(cosine, n, k, u, v);
    return 0.5 * (mx_fresnel_ratio(vec3(cosine), vec3(0.0), u, v) + mx_fresnel_ratio(cosine * (n * n - k * k), 2.0 * cosine * n * k, u, v));
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

vec3 mx_film_polarized(const float a, const vec3 x, const vec3 y, const vec3 u, const vec3 v, const float d)
{
    vec3 norm = (x + u) * (x + u) + (y + v) * (y + v);
    return mx_film_series(a, (x * x + y * y - u * u - v * v) / norm, 2.0 * (y * u - x * v) / norm, d);
}

vec2 mx_film_amplitudes(const float cosine, const float inside, const float ior)
{
    vec2 x = vec2(cosine, ior * cosine);
    vec2 u = vec2(ior * inside, inside);
    return (x - u) / (x + u);
}

vec3 mx_film_index(const float cosine, const vec3 n, const vec3 k, const float film, const float film_ior)
{
    float ior = max(film_ior, 1.0);
    float c = sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
    vec2 a = mx_film_amplitudes(cosine, c, ior);
    float d = 0.012566372 * ior * c * film;
    vec3 m = n / ior;
    vec3 l = k / ior;
    vec3 u;
    vec3 v;
    mx_fresnel_refract(c, m, l, u, v);
    return clamp(mat3(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949, -0.4706338, 0.0885814, 1.0093968) * (0.5 * (mx_film_polarized(a.x, vec3(c), vec3(0.0), u, v, d) + mx_film_polarized(a.y, c * (m * m - l * l), 2.0 * c * m * l, u, v, d))), vec3(0.0), vec3(1.0));
}

vec3 mx_fresnel(const float cosine, const vec3 n, const vec3 k, const float film, const float film_ior)
{
    if (film > 0.0)
        return mx_film_index(cosine, n, k, film, film_ior);
    return mx_fresnel_conductor(cosine, n, k);
}

vec3 mx_fresnel(const float cosine, const vec3 n, const float film, const float film_ior)
{
    if (film > 0.0)
        return mx_film_index(cosine, n, vec3(0.0), film, film_ior);
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

vec3 mx_ggx_gather_film_index(const mx_GgxLobe lobe, const float limit, const vec3 n, const vec3 k, const float film, const float film_ior)
{
    vec2 around = vec2(1.0, 0.0);
    vec3 sum = vec3(0.0);
    for (float xi = 0.5 * lobe.step; xi < limit; xi += lobe.step) {
        vec4 light = mx_ggx_sample(lobe, around, xi, 0.0);
        sum += mx_film_index(light.w, n, k, film, film_ior) * light.xyz;
        around = mat2(-0.7373689, 0.6754903, -0.6754903, -0.7373689) * around;
    }
    return lobe.weight * sum;
}

vec3 mx_ggx_gather_conductor(const mx_GgxLobe lobe, const float limit, const vec3 n, const vec3 k)
{
    vec2 around = vec2(1.0, 0.0);
    vec3 sum = vec3(0.0);
    for (float xi = 0.5 * lobe.step; xi < limit; xi += lobe.step) {
        vec4 light = mx_ggx_sample(lobe, around, xi, 0.0);
        sum += mx_fresnel_conductor(light.w, n, k) * light.xyz;
        around = mat2(-0.7373689, 0.6754903, -0.6754903, -0.7373689) * around;
    }
    return lobe.weight * sum;
}

void main()
{
    // SR_standard_surface
    float coat_front = SR_standard_surface_coat_IOR * 4.0 / ((SR_standard_surface_coat_IOR + 1.0) * (SR_standard_surface_coat_IOR + 1.0));
    vec3 normal = normalize(vd_normalWorld);
    vec3 V = normalize(u_viewPosition - vd_positionWorld);
    float coating = abs(dot(normal, V));
    vec3 color = SR_standard_surface_emission * SR_standard_surface_emission_color * (1.0 - SR_standard_surface_coat + SR_standard_surface_coat_color * (SR_standard_surface_coat * (coat_front * (1.0 - pow(1.0 - min(coating, 1.0), 5.0)))));
    float coating_2 = mx_fresnel_dielectric(1.0, SR_standard_surface_coat_IOR);
    vec2 coat_lobe = mx_roughness_anisotropy(SR_standard_surface_coat_roughness, SR_standard_surface_coat_anisotropy);
    vec2 coating_3 = clamp(coat_lobe, 1e-8, 1.0);
    float coating_4 = sqrt(coating_3.x * coating_3.y);
    float coating_5 = max(coating, 1e-8);
    vec2 coating_6 = mx_ggx_albedo_fit(coating_4, coating_4 / (coating_5 + coating_4), coating_5);
    float coating_7 = mix(coating_2, 1.0, 0.04761905) * (1.0 / coating_6.x - 1.0) + 1.0;
    vec3 coating_8 = faceforward(normal, -V, normal);
    vec3 tangent = normalize(vd_tangentWorld);
    vec3 coat_tangent = mx_rotate3d(tangent, radians(SR_standard_surface_coat_rotation * 360.0), normal);
    mx_GgxLobe coating_9 = mx_ggx_lobe(coat_lobe, coating_8, coat_tangent, V);
    float coat_blur = SR_standard_surface_coat_roughness * (SR_standard_surface_coat * SR_standard_surface_coat_affect_roughness);
    vec2 roughness = mx_roughness_anisotropy(mix(SR_standard_surface_specular_roughness, 1.0, coat_blur), SR_standard_surface_specular_anisotropy);
    vec2 reflection = clamp(roughness, 1e-8, 1.0);
    float reflection_2 = sqrt(reflection.x * reflection.y);
    vec2 reflection_3 = mx_ggx_albedo_fit(reflection_2, reflection_2 / (coating_5 + reflection_2), coating_5);
    float reflection_4 = 1.0 / reflection_3.x - 1.0;
    vec3 metal_ior, metal_extinction;
    mx_artistic_ior(SR_standard_surface_base * SR_standard_surface_base_color, SR_standard_surface_specular * SR_standard_surface_specular_color, metal_ior, metal_extinction);
    vec3 metal = reflection_4 * mix(mx_fresnel(1.0, metal_ior, metal_extinction, SR_standard_surface_thin_film_thickness, SR_standard_surface_thin_film_IOR), vec3(1.0), 0.04761905) + vec3(1.0);
    vec3 coated = clamp(mix(vec3(1.0), SR_standard_surface_coat_color, SR_standard_surface_coat), 0.0, 1.0);
    float coating_10 = 1.0 - SR_standard_surface_coat * (mix(coating_2, 1.0, coating_6.y) * coating_6.x * coating_7);
    vec3 metal_2 = metal * (coated * (SR_standard_surface_metalness * coating_10));
    vec3 specular_tangent = mx_rotate3d(tangent, radians(SR_standard_surface_specular_rotation * 360.0), normal);
    mx_GgxLobe metal_3 = mx_ggx_lobe(roughness, coating_8, specular_tangent, V);
    float substrate = 1.0 - SR_standard_surface_metalness;
    bool b = SR_standard_surface_specular * substrate > 0.0;
    vec3 reflection_5 = coated * (coating_10 * (SR_standard_surface_specular * substrate));
    vec3 reflection_6 = vec3(SR_standard_surface_specular_IOR);
    vec3 reflection_7 = mix(mx_fresnel(1.0, reflection_6, SR_standard_surface_thin_film_thickness, SR_standard_surface_thin_film_IOR), vec3(1.0), 0.04761905) * reflection_4 + vec3(1.0);
    vec3 reflection_8 = reflection_5 * (reflection_7 * max(SR_standard_surface_specular_color, 0.0));
    float body = substrate * (1.0 - SR_standard_surface_transmission);
    float thin = float(SR_standard_surface_thin_walled);
    float scatter_or_translucent = SR_standard_surface_subsurface * body * (1.0 - thin);
    float scatter = max(length(fwidth(coating_8)) / length(fwidth(vd_positionWorld)), 0.01) * 3.0;
    vec3 scatter_2 = vec3(-2.0) / (scatter * max(SR_standard_surface_subsurface_radius * SR_standard_surface_subsurface_scale, 0.1));
    vec3 scatter_color = vec3(SR_standard_surface_coat_affect_color * clamp(SR_standard_surface_coat, 0.0, 1.0) + 1.0);
    vec3 scatter_color_2 = pow(max(SR_standard_surface_subsurface_color, 0.0), scatter_color);
    vec3 dielectric = (vec3(1.0) - reflection_7 * (SR_standard_surface_specular * (mix(mx_fresnel_dielectric(1.0, SR_standard_surface_specular_IOR), 1.0, reflection_3.y) * reflection_3.x))) * (coating_10 * coated);
    float fuzz = clamp(mx_bicubic(mat4(3.7341, -15.9587, 23.621, -11.0989, -8.2265, 35.1081, -49.7137, 23.2945, 4.0691, -17.882, 25.6639, -12.0167, -0.5833, 2.6552, -3.9393, 1.8999), 1.0 / (coating_5 + 1.0), 1.0 / (SR_standard_surface_sheen_roughness + 0.2)), 0.0, 1.0);
    float fuzz_2 = 1.0 - SR_standard_surface_sheen * fuzz;
    vec3 scatter_3 = scatter_color_2 * (dielectric * (fuzz_2 * scatter_or_translucent));
    vec3 diffuse_color = pow(max(SR_standard_surface_base_color, 0.0), scatter_color);
    vec3 diffuse = dielectric * (fuzz_2 * (SR_standard_surface_base * (body * (1.0 - SR_standard_surface_subsurface))));
    float diffuse_2 = SR_standard_surface_diffuse_roughness * SR_standard_surface_diffuse_roughness;
    vec2 diffuse_3 = diffuse_2 * vec2(-0.5, 0.45) / (diffuse_2 + vec2(0.33, 0.09)) + vec2(1.0, 0.0);
    float fuzz_3 = 1.0 / max(SR_standard_surface_sheen_roughness, 0.005);
    vec3 fuzz_4 = dielectric * (SR_standard_surface_sheen * body);
    vec3 fuzz_5 = SR_standard_surface_sheen_color * fuzz_4;
    float scatter_or_translucent_2 = thin * (SR_standard_surface_subsurface * body);
    vec3 translucent = scatter_color_2 * (dielectric * (fuzz_2 * scatter_or_translucent_2));
    for (int i = 0; i < min(u_numActiveLightSources, 3); ++i) {
        int type = u_lightData[i].type;
        float intensity = u_lightData[i].intensity;
        vec3 spot_light = u_lightData[i].position - vd_positionWorld;
        float spot_light_2 = intensity / pow(length(spot_light) + 1.0, u_lightData[i].decay_rate);
        float spot_light_3 = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
        vec3 spot_light_4 = normalize(spot_light);
        float spot_light_5 = smoothstep(spot_light_3, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, spot_light_4)) * spot_light_2;
        float light = type == 3 ? spot_light_5 : 0.0;
        float light_2 = type == 2 ? spot_light_2 : light;
        vec3 light_3 = u_lightData[i].color * (type == 1 ? intensity : light_2);
        vec3 directional_light = -u_lightData[i].direction;
        vec3 L = type == 1 ? directional_light : spot_light_4;
        vec3 coating_11 = normalize(V + L);
        float coating_12 = clamp(dot(V, coating_11), 1e-8, 1.0);
        if (SR_standard_surface_coat > 0.0)
            color += light_3 * (SR_standard_surface_coat * coating_7 * (mx_ggx_light(coating_9, L, coating_11) * mx_fresnel_dielectric(coating_12, SR_standard_surface_coat_IOR)));
        float metal_4 = mx_ggx_light(metal_3, L, coating_11);
        if (SR_standard_surface_metalness > 0.0)
            color += light_3 * (metal_2 * (metal_4 * mx_fresnel(coating_12, metal_ior, metal_extinction, SR_standard_surface_thin_film_thickness, SR_standard_surface_thin_film_IOR)));
        if (b)
            color += light_3 * (reflection_8 * (metal_4 * mx_fresnel(coating_12, reflection_6, SR_standard_surface_thin_film_thickness, SR_standard_surface_thin_film_IOR)));
        float fuzz_6 = dot(L, coating_8);
        if (scatter_or_translucent > 0.0)
            color += light_3 * (mx_subsurface_light(scatter_2, fuzz_6) * scatter_3);
        float fuzz_7 = max(fuzz_6, 1e-8);
        float diffuse_4 = fuzz_7 / 3.1415927 * (diffuse_3.x + diffuse_3.y * max(dot(V, L) - coating_5 * fuzz_7, 0.0) / max(fuzz_7, coating_5));
        float fuzz_8 = dot(coating_11, coating_8);
        float fuzz_9 = fuzz_7 * ((fuzz_3 + 2.0) * pow(max(1.0 - fuzz_8 * fuzz_8, 0.0), fuzz_3 * 0.5) / 6.2831855);
        vec3 fuzz_10 = fuzz_9 / ((coating_5 + fuzz_7 - coating_5 * fuzz_7) * 4.0) * fuzz_5;
        vec3 t = fuzz_10 + max(-fuzz_6, 0.0) / 3.1415927 * translucent;
        color += light_3 * (diffuse_color * diffuse * diffuse_4 + t);
    }
    if (SR_standard_surface_coat > 0.0)
        color += SR_standard_surface_coat * coating_7 * mx_ggx_gather_dielectric(coating_9, 1.0, 0.0, SR_standard_surface_coat_IOR);
    bool reflection_9 = SR_standard_surface_thin_film_thickness > 0.0;
    float metal_5 = reflection_9 ? 1.0 : 0.0;
    float metal_6 = reflection_9 ? 0.0 : 1.0;
    if (SR_standard_surface_metalness > 0.0) {
        vec3 metal_7 = mx_ggx_gather_film_index(metal_3, metal_5, metal_ior, metal_extinction, SR_standard_surface_thin_film_thickness, SR_standard_surface_thin_film_IOR);
        color += metal_2 * (reflection_9 ? metal_7 : mx_ggx_gather_conductor(metal_3, metal_6, metal_ior, metal_extinction));
    }
    if (b) {
        vec3 reflection_10 = mx_ggx_gather_film_index(metal_3, metal_5, reflection_6, vec3(0.0), SR_standard_surface_thin_film_thickness, SR_standard_surface_thin_film_IOR);
        color += reflection_8 * (reflection_9 ? reflection_10 : mx_ggx_gather_dielectric(metal_3, metal_6, 0.0, SR_standard_surface_specular_IOR));
    }
    if (SR_standard_surface_transmission * substrate > 0.0) {
        vec3 refraction = max(SR_standard_surface_transmission_color, 0.0);
        float transmission_blurred = mix(clamp(SR_standard_surface_specular_roughness + SR_standard_surface_transmission_extra_roughness, 0.0, 1.0), 1.0, coat_blur);
        mx_GgxLobe refraction_2 = mx_ggx_lobe(mx_roughness_anisotropy(transmission_blurred, SR_standard_surface_specular_anisotropy), coating_8, specular_tangent, V);
        vec3 refraction_3 = mx_ggx_gather_dielectric(refraction_2, 1.0, SR_standard_surface_specular_IOR, SR_standard_surface_specular_IOR);
        vec3 refraction_4 = refraction * (u_refractionTwoSided ? refraction : vec3(1.0)) * refraction_3;
        color += refraction_4 * (dielectric * (SR_standard_surface_transmission * substrate));
    }
    if (scatter_or_translucent_2 > 0.0)
        color += translucent * (u_envLightIntensity * textureLod(u_envIrradiance, mx_latlong(u_envMatrix, -coating_8), 0.0).xyz);
    vec2 diffuse_5 = SR_standard_surface_diffuse_roughness * (coating_5 * vec2(-0.7632, -0.4993) - vec2(0.4297, 0.6076) + SR_standard_surface_diffuse_roughness * vec2(1.4385, 2.0315)) + vec2(1.0);
    vec3 fuzz_11 = textureLod(u_envIrradiance, mx_latlong(u_envMatrix, coating_8), 0.0).xyz * u_envLightIntensity;
    vec3 diffuse_6 = diffuse_color * clamp(diffuse_5.x / diffuse_5.y, 0.0, 1.0) * (diffuse * fuzz_11);
    color += diffuse_6 + (fuzz_11 * (fuzz_4 * (SR_standard_surface_sheen_color * fuzz)) + scatter_3 * fuzz_11);
    float opacity_grey = dot(SR_standard_surface_opacity, vec3(0.2722287, 0.6740818, 0.0536895));
    if (opacity_grey < u_alphaThreshold)
        discard;
    out1 = vec4(opacity_grey * color, opacity_grey);
}
