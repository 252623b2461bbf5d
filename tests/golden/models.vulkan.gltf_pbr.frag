#version 450
// gltf_pbr · surfacematerial · mxgen 0.1 · vulkan · complete · 9 closures · 0 textures

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
    vec3 SR_gltf_pbr_base_color;
    float SR_gltf_pbr_metallic;
    float SR_gltf_pbr_roughness;
    float SR_gltf_pbr_transmission;
    float SR_gltf_pbr_specular;
    vec3 SR_gltf_pbr_specular_color;
    float SR_gltf_pbr_ior;
    float SR_gltf_pbr_alpha;
    int SR_gltf_pbr_alpha_mode;
    float SR_gltf_pbr_alpha_cutoff;
    float SR_gltf_pbr_iridescence;
    float SR_gltf_pbr_iridescence_ior;
    float SR_gltf_pbr_iridescence_thickness;
    vec3 SR_gltf_pbr_sheen_color;
    float SR_gltf_pbr_sheen_roughness;
    float SR_gltf_pbr_clearcoat;
    float SR_gltf_pbr_clearcoat_roughness;
    vec3 SR_gltf_pbr_emissive;
    float SR_gltf_pbr_emissive_strength;
    float SR_gltf_pbr_anisotropy_strength;
    float SR_gltf_pbr_anisotropy_rotation;
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

float mx_fresnel_dielectric(const float cosine, const float ior)
{
    float g = sqrt(max(ior * ior + cosine * cosine - 1.0, 0.0));
    vec2 a = cosine * vec2(1.0, ior * ior);
    vec2 r = (a - g) / (a + g);
    return 0.5 * dot(r, r);
}

vec3 mx_fresnel_schlick(const float cosine, const vec3 f0, const vec3 f90)
{
    float x = 1.0 - cosine;
    return mix(f0, f90, x * x * x * x * x);
}

vec3 mx_film_response(const float d, const vec3 re)
{
    vec4 xyzx = vec4(0.84659, 1.000222, 1.001122, 0.153868) * exp(vec4(-0.0043278, -0.0093046, -0.0066121, -0.0045282) * (d * d)) * (vec4(re, re.x) * cos(vec4(1.681, 1.7953, 2.2084, 2.2399) * d));
    return xyzx.xyz + vec3(xyzx.w, 0.0, 0.0);
}

vec3 mx_film_series(const float a, const vec3 re, const float d)
{
    vec3 r23 = re * re;
    float r12 = a * a;
    float t = 1.0 - r12;
    vec3 constant = t * t * r23 / (vec3(1.0) - r12 * r23);
    return r12 + constant + 2.0 * (constant - t) * (r12 * mx_film_response(2.0 * d, re * re) - a * mx_film_response(d, re));
}

vec2 mx_film_amplitudes(const float cosine, const float inside, const float ior)
{
    vec2 x = vec2(cosine, ior * cosine);
    vec2 u = vec2(ior * inside, inside);
    return (x - u) / (x + u);
}

vec3 mx_film_schlick(const float cosine, const vec3 f0, const vec3 f90, const float film, const float film_ior)
{
    float ior = max(film_ior, 1.0);
    float c = sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
    vec2 a = mx_film_amplitudes(cosine, c, ior);
    float d = 0.012566372 * ior * c * film;
    vec3 r = (vec3(1.0) - 2.0 * step(sqrt(clamp(f0, vec3(0.01), vec3(0.99))), vec3((ior - 1.0) / (ior + 1.0)))) * sqrt(max(0.5 * mx_fresnel_schlick(c, f0, f90), vec3(0.0)));
    return clamp(mat3(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949, -0.4706338, 0.0885814, 1.0093968) * (0.5 * (mx_film_series(a.x, -r, d) + mx_film_series(a.y, r, d))), vec3(0.0), vec3(1.0));
}

vec3 mx_fresnel(const float cosine, const vec3 n, const vec3 f90, const float film, const float film_ior)
{
    if (film > 0.0)
        return mx_film_schlick(cosine, n, f90, film, film_ior);
    return mx_fresnel_schlick(cosine, n, f90);
}

vec3 mx_rotate3d(const vec3 v, const float angle, const vec3 axis)
{
    float c = cos(angle);
    return v * c + cross(v, axis) * sin(angle) + axis * (dot(axis, v) * (1.0 - c));
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

vec3 mx_ggx_gather_dielectric(const mx_GgxLobe lobe, const float refract_ior, const float ior)
{
    vec2 around = vec2(1.0, 0.0);
    vec3 sum = vec3(0.0);
    for (float xi = 0.5 * lobe.step; xi < 1.0; xi += lobe.step) {
        vec4 light = mx_ggx_sample(lobe, around, xi, refract_ior);
        float f = mx_fresnel_dielectric(light.w, ior);
        sum += (refract_ior > 0.0 ? 1.0 - f : f) * light.xyz;
        around = mat2(-0.7373689, 0.6754903, -0.6754903, -0.7373689) * around;
    }
    return lobe.weight * sum;
}

vec3 mx_ggx_gather_film(const mx_GgxLobe lobe, const float limit, const vec3 n, const vec3 f90, const float film, const float film_ior)
{
    vec2 around = vec2(1.0, 0.0);
    vec3 sum = vec3(0.0);
    for (float xi = 0.5 * lobe.step; xi < limit; xi += lobe.step) {
        vec4 light = mx_ggx_sample(lobe, around, xi, 0.0);
        sum += mx_film_schlick(light.w, n, f90, film, film_ior) * light.xyz;
        around = mat2(-0.7373689, 0.6754903, -0.6754903, -0.7373689) * around;
    }
    return lobe.weight * sum;
}

vec3 mx_ggx_gather_schlick(const mx_GgxLobe lobe, const float limit, const vec3 f0, const vec3 f90)
{
    vec2 around = vec2(1.0, 0.0);
    vec3 sum = vec3(0.0);
    for (float xi = 0.5 * lobe.step; xi < limit; xi += lobe.step) {
        vec4 light = mx_ggx_sample(lobe, around, xi, 0.0);
        sum += mx_fresnel_schlick(light.w, f0, f90) * light.xyz;
        around = mat2(-0.7373689, 0.6754903, -0.6754903, -0.7373689) * around;
    }
    return lobe.weight * sum;
}

void main()
{
    vec3 color = SR_gltf_pbr_emissive * SR_gltf_pbr_emissive_strength;
    // SR_gltf_pbr
    float coat_lobe = clamp(SR_gltf_pbr_clearcoat_roughness * SR_gltf_pbr_clearcoat_roughness, 1e-8, 1.0);
    vec3 normal = normalize(vd.normalWorld);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    float coating = max(abs(dot(normal, V)), 1e-8);
    vec2 coating_2 = mx_ggx_albedo_fit(coat_lobe, coat_lobe / (coat_lobe + coating), coating);
    float coating_3 = (1.0 / coating_2.x - 1.0) * 0.08571429 + 1.0;
    vec3 coating_4 = faceforward(normal, -V, normal);
    vec3 tangent = normalize(vd.tangentWorld);
    mx_GgxLobe coating_5 = mx_ggx_lobe(vec2(coat_lobe), coating_4, tangent, V);
    float sheen_weight = max(max(SR_gltf_pbr_sheen_color.x, SR_gltf_pbr_sheen_color.y), SR_gltf_pbr_sheen_color.z);
    float sheen_rough = SR_gltf_pbr_sheen_roughness * SR_gltf_pbr_sheen_roughness;
    float fuzz = 1.0 / max(sheen_rough, 0.005);
    float coating_6 = 1.0 - SR_gltf_pbr_clearcoat * (mix(0.040000003, 1.0, coating_2.y) * coating_2.x * coating_3);
    vec3 fuzz_2 = SR_gltf_pbr_sheen_color / sheen_weight * (sheen_weight * coating_6);
    float metal = SR_gltf_pbr_metallic * SR_gltf_pbr_iridescence;
    float alpha_bitangent = SR_gltf_pbr_roughness * SR_gltf_pbr_roughness;
    vec2 specular_roughness = clamp(vec2(mix(alpha_bitangent, 1.0, SR_gltf_pbr_anisotropy_strength * SR_gltf_pbr_anisotropy_strength), alpha_bitangent), 0.00001, 1.0);
    vec2 reflection_film = clamp(specular_roughness, 1e-8, 1.0);
    float reflection_film_2 = sqrt(reflection_film.x * reflection_film.y);
    vec2 reflection_film_3 = mx_ggx_albedo_fit(reflection_film_2, reflection_film_2 / (coating + reflection_film_2), coating);
    float reflection_film_4 = 1.0 / reflection_film_3.x - 1.0;
    vec3 metal_film = max(SR_gltf_pbr_base_color, 0.0);
    float iridescence_thickness = SR_gltf_pbr_iridescence_thickness;
    float iridescence_ior = SR_gltf_pbr_iridescence_ior;
    float fuzz_3 = clamp(mx_bicubic(mat4(3.7341, -15.9587, 23.621, -11.0989, -8.2265, 35.1081, -49.7137, 23.2945, 4.0691, -17.882, 25.6639, -12.0167, -0.5833, 2.6552, -3.9393, 1.8999), 1.0 / (coating + 1.0), 1.0 / (sheen_rough + 0.2)), 0.0, 1.0);
    float fuzzy = coating_6 * (1.0 - sheen_weight * fuzz_3);
    vec3 metal_film_2 = (reflection_film_4 * mix(mx_fresnel(1.0, metal_film, vec3(1.0), iridescence_thickness, iridescence_ior), vec3(1.0), 0.04761905) + vec3(1.0)) * (fuzzy * metal);
    vec3 specular_tangent = mx_rotate3d(tangent, radians(SR_gltf_pbr_anisotropy_rotation * -57.29578), normal);
    mx_GgxLobe metal_film_3 = mx_ggx_lobe(specular_roughness, coating_4, specular_tangent, V);
    float metal_2 = SR_gltf_pbr_metallic * (1.0 - SR_gltf_pbr_iridescence);
    vec3 metal_bare = (reflection_film_4 * mix(mx_fresnel_schlick(1.0, metal_film, vec3(1.0)), vec3(1.0), 0.04761905) + vec3(1.0)) * (fuzzy * metal_2);
    float substrate = 1.0 - SR_gltf_pbr_metallic;
    bool b = SR_gltf_pbr_iridescence * substrate > 0.0;
    float amplitude = (1.0 - SR_gltf_pbr_ior) / (SR_gltf_pbr_ior + 1.0);
    vec3 reflection_film_5 = max(SR_gltf_pbr_specular * min(SR_gltf_pbr_specular_color * (amplitude * amplitude), 1.0), 0.0);
    vec3 reflection_film_6 = vec3(max(SR_gltf_pbr_specular, 0.0));
    vec3 reflection_film_7 = mix(mx_fresnel(1.0, reflection_film_5, reflection_film_6, iridescence_thickness, iridescence_ior), reflection_film_6, 0.04761905) * reflection_film_4 + vec3(1.0);
    vec3 reflection_film_8 = reflection_film_7 * (fuzzy * (SR_gltf_pbr_iridescence * substrate));
    float gloss = substrate * (1.0 - SR_gltf_pbr_iridescence);
    vec3 reflection = reflection_film_4 * mix(mx_fresnel_schlick(1.0, reflection_film_5, reflection_film_6), reflection_film_6, 0.04761905) + vec3(1.0);
    vec3 reflection_2 = reflection * (fuzzy * gloss);
    vec3 reflection_film_9 = mix(reflection_film_5, reflection_film_6, reflection_film_3.y) * reflection_film_3.x;
    float reflection_3 = 1.0 - dot(reflection_film_9 * reflection, vec3(0.33333334));
    float dielectric = mix(reflection_3, 1.0 - dot(reflection_film_9 * reflection_film_7, vec3(0.33333334)), SR_gltf_pbr_iridescence) * fuzzy;
    vec3 diffuse = SR_gltf_pbr_base_color * (dielectric * (substrate * (1.0 - SR_gltf_pbr_transmission)));
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
        vec3 coating_7 = normalize(V + L);
        float coating_8 = clamp(dot(V, coating_7), 1e-8, 1.0);
        if (SR_gltf_pbr_clearcoat > 0.0)
            color += light_3 * (SR_gltf_pbr_clearcoat * coating_3 * (mx_ggx_light(coating_5, L, coating_7) * mx_fresnel_dielectric(coating_8, 1.5)));
        float fuzz_4 = max(dot(L, coating_4), 1e-8);
        if (sheen_weight > 0.0) {
            float fuzz_5 = dot(coating_7, coating_4);
            float fuzz_6 = fuzz_4 * ((fuzz + 2.0) * pow(max(1.0 - fuzz_5 * fuzz_5, 0.0), fuzz * 0.5) / 6.2831855);
            color += light_3 * (fuzz_6 / ((coating + fuzz_4 - coating * fuzz_4) * 4.0) * fuzz_2);
        }
        float metal_film_4 = mx_ggx_light(metal_film_3, L, coating_7);
        if (metal > 0.0)
            color += light_3 * (metal_film_2 * (metal_film_4 * mx_fresnel(coating_8, metal_film, vec3(1.0), iridescence_thickness, iridescence_ior)));
        if (metal_2 > 0.0)
            color += light_3 * (metal_bare * (metal_film_4 * mx_fresnel_schlick(coating_8, metal_film, vec3(1.0))));
        if (b)
            color += light_3 * (reflection_film_8 * (metal_film_4 * mx_fresnel(coating_8, reflection_film_5, reflection_film_6, iridescence_thickness, iridescence_ior)));
        if (gloss > 0.0)
            color += light_3 * (reflection_2 * (metal_film_4 * mx_fresnel_schlick(coating_8, reflection_film_5, reflection_film_6)));
        color += light_3 * (fuzz_4 / 3.1415927 * diffuse);
    }
    if (SR_gltf_pbr_clearcoat > 0.0)
        color += SR_gltf_pbr_clearcoat * coating_3 * mx_ggx_gather_dielectric(coating_5, 0.0, 1.5);
    vec3 fuzz_7 = textureLod(u_envIrradiance, mx_latlong(u_envMatrix, coating_4), 0.0).xyz * u_envLightIntensity;
    if (sheen_weight > 0.0)
        color += fuzz_7 * (SR_gltf_pbr_sheen_color / sheen_weight * (fuzz_3 * (sheen_weight * coating_6)));
    float metal_film_5 = iridescence_thickness > 0.0 ? 1.0 : 0.0;
    float metal_film_6 = iridescence_thickness > 0.0 ? 0.0 : 1.0;
    if (metal > 0.0) {
        vec3 metal_film_7 = mx_ggx_gather_film(metal_film_3, metal_film_5, metal_film, vec3(1.0), iridescence_thickness, iridescence_ior);
        vec3 metal_film_8 = mx_ggx_gather_schlick(metal_film_3, metal_film_6, metal_film, vec3(1.0));
        color += metal_film_2 * (iridescence_thickness > 0.0 ? metal_film_7 : metal_film_8);
    }
    if (metal_2 > 0.0)
        color += metal_bare * mx_ggx_gather_schlick(metal_film_3, 1.0, metal_film, vec3(1.0));
    if (b) {
        vec3 reflection_film_10 = mx_ggx_gather_film(metal_film_3, metal_film_5, reflection_film_5, reflection_film_6, iridescence_thickness, iridescence_ior);
        vec3 reflection_film_11 = mx_ggx_gather_schlick(metal_film_3, metal_film_6, reflection_film_5, reflection_film_6);
        color += reflection_film_8 * (iridescence_thickness > 0.0 ? reflection_film_10 : reflection_film_11);
    }
    if (gloss > 0.0)
        color += reflection_2 * mx_ggx_gather_schlick(metal_film_3, 1.0, reflection_film_5, reflection_film_6);
    if (SR_gltf_pbr_transmission * substrate > 0.0) {
        vec3 refraction = mx_ggx_gather_dielectric(metal_film_3, SR_gltf_pbr_ior, SR_gltf_pbr_ior);
        vec3 refraction_2 = metal_film * (u_refractionTwoSided ? metal_film : vec3(1.0)) * refraction;
        color += refraction_2 * (dielectric * (SR_gltf_pbr_transmission * substrate));
    }
    color += diffuse * fuzz_7;
    float mask = SR_gltf_pbr_alpha >= SR_gltf_pbr_alpha_cutoff ? 1.0 : 0.0;
    float opacity = 1 > SR_gltf_pbr_alpha_mode ? 1.0 : 2 > SR_gltf_pbr_alpha_mode ? mask : 3 > SR_gltf_pbr_alpha_mode ? SR_gltf_pbr_alpha : 0.0;
    if (opacity < u_alphaThreshold)
        discard;
    out1 = vec4(opacity * color, opacity);
}
