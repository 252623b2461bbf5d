#version 450
// UsdPreviewSurface · surfacematerial · mxgen 0.1 · vulkan · complete · 6 closures · 0 textures

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
    vec3 SR_UsdPreviewSurface_diffuseColor;
    vec3 SR_UsdPreviewSurface_emissiveColor;
    int SR_UsdPreviewSurface_useSpecularWorkflow;
    vec3 SR_UsdPreviewSurface_specularColor;
    float SR_UsdPreviewSurface_metallic;
    float SR_UsdPreviewSurface_roughness;
    float SR_UsdPreviewSurface_clearcoat;
    float SR_UsdPreviewSurface_clearcoatRoughness;
    float SR_UsdPreviewSurface_opacity;
    int SR_UsdPreviewSurface_opacityMode;
    float SR_UsdPreviewSurface_opacityThreshold;
    float SR_UsdPreviewSurface_ior;
    vec3 SR_UsdPreviewSurface_normal;
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
    vec3 bitangentWorld;
} vd;
layout(location = 0) out vec4 out1;

vec3 mx_fresnel_schlick(const float cosine, const vec3 f0, const vec3 f90)
{
    float x = 1.0 - cosine;
    return mix(f0, f90, x * x * x * x * x);
}

vec3 mx_normalmap(const vec3 texel, const vec3 normal, const vec3 tangent, const vec3 bitangent)
{
    vec3 n = dot(texel, texel) == 0.0 ? vec3(0.0, 0.0, 1.0) : texel * 2.0 - vec3(1.0);
    return normalize(tangent * n.x + bitangent * n.y + normal * n.z);
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

vec3 mx_ggx_gather_schlick(const mx_GgxLobe lobe, const vec3 f0, const vec3 f90)
{
    vec2 around = vec2(1.0, 0.0);
    vec3 sum = vec3(0.0);
    for (float xi = 0.5 * lobe.step; xi < 1.0; xi += lobe.step) {
        vec4 light = mx_ggx_sample(lobe, around, xi, 0.0);
        sum += mx_fresnel_schlick(light.w, f0, f90) * light.xyz;
        around = mat2(-0.7373689, 0.6754903, -0.6754903, -0.7373689) * around;
    }
    return lobe.weight * sum;
}

vec3 mx_ggx_gather_conductor(const mx_GgxLobe lobe, const vec3 n, const vec3 k)
{
    vec2 around = vec2(1.0, 0.0);
    vec3 sum = vec3(0.0);
    for (float xi = 0.5 * lobe.step; xi < 1.0; xi += lobe.step) {
        vec4 light = mx_ggx_sample(lobe, around, xi, 0.0);
        sum += mx_fresnel_conductor(light.w, n, k) * light.xyz;
        around = mat2(-0.7373689, 0.6754903, -0.6754903, -0.7373689) * around;
    }
    return lobe.weight * sum;
}

float mx_fresnel_dielectric(const float cosine, const float ior)
{
    float g = sqrt(max(ior * ior + cosine * cosine - 1.0, 0.0));
    vec2 a = cosine * vec2(1.0, ior * ior);
    vec2 r = (a - g) / (a + g);
    return 0.5 * dot(r, r);
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

void main()
{
    vec3 color = SR_UsdPreviewSurface_emissiveColor;
    // SR_UsdPreviewSurface
    float amplitude = (1.0 - SR_UsdPreviewSurface_ior) / (SR_UsdPreviewSurface_ior + 1.0);
    float coating = max(amplitude * amplitude, 0.0);
    vec3 coating_2 = mix(mx_fresnel_schlick(1.0, vec3(coating), vec3(1.0)), vec3(1.0), 0.04761905);
    float coat_roughness = clamp(SR_UsdPreviewSurface_clearcoatRoughness * SR_UsdPreviewSurface_clearcoatRoughness, 1e-8, 1.0);
    vec3 tangent = normalize(vd.tangentWorld);
    vec3 shading_normal = mx_normalmap(SR_UsdPreviewSurface_normal * 0.5 + vec3(0.5), normalize(vd.normalWorld), tangent, normalize(vd.bitangentWorld));
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    float coating_3 = max(abs(dot(shading_normal, V)), 1e-8);
    vec2 coating_4 = mx_ggx_albedo_fit(coat_roughness, coat_roughness / (coat_roughness + coating_3), coating_3);
    vec3 coating_5 = coating_2 * (1.0 / coating_4.x - 1.0) + vec3(1.0);
    vec3 coating_6 = SR_UsdPreviewSurface_clearcoat * coating_5;
    vec3 coating_7 = faceforward(shading_normal, -V, shading_normal);
    mx_GgxLobe coating_8 = mx_ggx_lobe(vec2(coat_roughness), coating_7, tangent, V);
    bool front = SR_UsdPreviewSurface_useSpecularWorkflow == 1;
    float metal_weight = front ? 0.0 : SR_UsdPreviewSurface_metallic;
    float specular_roughness = clamp(SR_UsdPreviewSurface_roughness * SR_UsdPreviewSurface_roughness, 1e-8, 1.0);
    vec2 reflection = mx_ggx_albedo_fit(specular_roughness, specular_roughness / (specular_roughness + coating_3), coating_3);
    float reflection_2 = 1.0 / reflection.x - 1.0;
    vec3 metal_ior, metal_extinction;
    mx_artistic_ior(SR_UsdPreviewSurface_diffuseColor, SR_UsdPreviewSurface_diffuseColor, metal_ior, metal_extinction);
    float coating_9 = 1.0 - SR_UsdPreviewSurface_clearcoat * dot(mix(coating, 1.0, coating_4.y) * coating_4.x * coating_5, vec3(0.33333334));
    vec3 metal = (reflection_2 * mix(mx_fresnel_conductor(1.0, metal_ior, metal_extinction), vec3(1.0), 0.04761905) + vec3(1.0)) * (metal_weight * coating_9);
    mx_GgxLobe metal_2 = mx_ggx_lobe(vec2(specular_roughness), coating_7, tangent, V);
    float diffuse_weight = 1.0 - metal_weight;
    vec3 grazing_metallic = mix(vec3(1.0), SR_UsdPreviewSurface_diffuseColor, SR_UsdPreviewSurface_metallic);
    vec3 reflection_3 = max(front ? SR_UsdPreviewSurface_specularColor : mix(amplitude * amplitude * grazing_metallic, grazing_metallic, SR_UsdPreviewSurface_metallic), 0.0);
    vec3 reflection_4 = max(front ? vec3(1.0) : grazing_metallic, 0.0);
    vec3 reflection_5 = mix(mx_fresnel_schlick(1.0, reflection_3, reflection_4), reflection_4, 0.04761905) * reflection_2 + vec3(1.0);
    vec3 reflection_6 = reflection_5 * (diffuse_weight * coating_9);
    float dielectric = coating_9 * (1.0 - dot(mix(reflection_3, reflection_4, reflection.y) * reflection.x * reflection_5, vec3(0.33333334)));
    float opaque_transparent = SR_UsdPreviewSurface_opacityThreshold > 0.0 ? 1.0 : SR_UsdPreviewSurface_opacity;
    float opaque_weight = 1 > SR_UsdPreviewSurface_opacityMode ? opaque_transparent : 2 > SR_UsdPreviewSurface_opacityMode ? 1.0 : 0.0;
    float diffuse = diffuse_weight * (diffuse_weight * opaque_weight);
    vec3 diffuse_2 = SR_UsdPreviewSurface_diffuseColor * (dielectric * diffuse);
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
        vec3 coating_10 = normalize(V + L);
        float coating_11 = clamp(dot(V, coating_10), 1e-8, 1.0);
        if (SR_UsdPreviewSurface_clearcoat > 0.0) {
            vec3 coating_12 = mx_fresnel_schlick(coating_11, vec3(coating), vec3(1.0));
            color += light_3 * (coating_6 * (mx_ggx_light(coating_8, L, coating_10) * coating_12));
        }
        float metal_3 = mx_ggx_light(metal_2, L, coating_10);
        if (metal_weight > 0.0)
            color += light_3 * (metal * (metal_3 * mx_fresnel_conductor(coating_11, metal_ior, metal_extinction)));
        if (diffuse_weight > 0.0)
            color += light_3 * (reflection_6 * (metal_3 * mx_fresnel_schlick(coating_11, reflection_3, reflection_4)));
        color += light_3 * (max(dot(L, coating_7), 1e-8) / 3.1415927 * diffuse_2);
    }
    if (SR_UsdPreviewSurface_clearcoat > 0.0)
        color += SR_UsdPreviewSurface_clearcoat * (coating_5 * mx_ggx_gather_schlick(coating_8, vec3(coating), vec3(1.0)));
    if (metal_weight > 0.0)
        color += metal * mx_ggx_gather_conductor(metal_2, metal_ior, metal_extinction);
    if (diffuse_weight > 0.0)
        color += reflection_6 * mx_ggx_gather_schlick(metal_2, reflection_3, reflection_4);
    if (diffuse > 0.0)
        color += diffuse_2 * (textureLod(u_envIrradiance, mx_latlong(u_envMatrix, coating_7), 0.0).xyz * u_envLightIntensity);
    float body = diffuse_weight * (1.0 - opaque_weight);
    if (body > 0.0) {
        mx_GgxLobe refraction = mx_ggx_lobe(vec2(0.0), coating_7, tangent, V);
        color += mx_ggx_gather_dielectric(refraction, SR_UsdPreviewSurface_ior, SR_UsdPreviewSurface_ior) * (dielectric * body);
    }
    float mask = SR_UsdPreviewSurface_opacity >= SR_UsdPreviewSurface_opacityThreshold ? 1.0 : 0.0;
    float coverage = 2 > SR_UsdPreviewSurface_opacityMode ? SR_UsdPreviewSurface_opacityThreshold > 0.0 ? mask : SR_UsdPreviewSurface_opacity : 0.0;
    float coverage_2 = 1 > SR_UsdPreviewSurface_opacityMode ? mask : coverage;
    if (coverage_2 < u_alphaThreshold)
        discard;
    out1 = vec4(coverage_2 * color, coverage_2);
}
