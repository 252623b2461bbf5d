#version 450
// Varnish · surfacematerial · mxgen 0.1 · glsl · reduced · 2 closures · 0 textures

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
};
uniform vec3 u_viewPosition = vec3(0.0);
uniform int u_numActiveLightSources = 0;
uniform mat4 u_envMatrix = mat4(-1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
uniform int u_envRadianceMips = 1;
uniform float u_envLightIntensity = 1.0;
struct LightData {
    int type;
    vec3 direction;
    vec3 color;
    float intensity;
};
uniform LightData u_lightData[1];
uniform sampler2D u_envRadiance;
uniform sampler2D u_envIrradiance;
in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
    vec3 tangentWorld;
} vd;
out vec4 out1;

// A polynomial of two variables, what directional albedos are fitted by (the programs in fits/).
float mx_bicubic(const mat4 m, const float x)
{
    return dot(vec4(1.0, x, x * x, x * x * x), m * vec4(1.0, 0.04, 0.0016, 0.000064));
}

// The program fits/ggx.c makes the constants. x is never too small by more than 0.001, so that giving lost energy back
// adds none. `u` follows what happens where light grazes the facets.
vec2 mx_ggx_albedo_fit(const float u, const float c)
{
    float x = clamp(1.0 - c - 0.04 * mx_bicubic(mat4(-0.2006, 5.2916, -3.7565, 0.218, -10.2439, 6.6203, -0.9657, 2.5694,
        38.3042, -80.8059, 71.731, -28.5214, -34.2, 89.1079, -88.4065, 33.782), u), 0.0, 1.0);
    return vec2(min(1.0046 - u * mx_bicubic(mat4(-0.1447, 2.759, -5.4314, 2.8497, -0.9366, 1.4766, 0.5911, -1.0905,
        11.8506, -30.2645, 27.3289, -8.9414, -4.3199, 8.2596, -3.1648, -0.8054), u), 1.0), x * x * x * x * x);
}

mx_GgxLobe mx_ggx_lobe_at(const mat3 frame, const vec3 v)
{
    return mx_GgxLobe(frame, vec3(0.04, 0.04, 1.0), 0.0016, v, sqrt(mix(v.z * v.z, 1.0, 0.0016)),
        normalize(v * vec3(0.04, 0.04, 1.0)), 0.0, 0.0, 0.0);
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

// N faces V.
mx_GgxLobe mx_ggx_lobe(const vec3 N, const vec3 X, const vec3 V)
{
    mat3 frame = mx_frame(N, X);
    return mx_ggx_lobe_at(frame, max(V * frame, vec3(-1.0, -1.0, 1e-8)));
}

// Distribution of normals (Burley 2012, appendix B.2, equation 13) at a normal that is stretched to that of a unit
// sphere; `area` is the product of the roughness along x and y.
float mx_ggx_distribution(const vec3 e, const float area)
{
    return 1.0 / (3.1415927 * area * dot(e, e) * dot(e, e));
}

// Height-correlated masking and shadowing G2 (Heitz 2014, equation 99) over 2 cos_v; half is left of the divisor of the
// reflection model.
float mx_ggx_visibility(const mx_GgxLobe lobe, const float cos_l)
{
    return cos_l / (lobe.v.z * sqrt(mix(cos_l * cos_l, 1.0, lobe.area)) + cos_l * lobe.masking);
}

// The lobe towards L, but for Fresnel's factor.
float mx_ggx_light(const mx_GgxLobe lobe, const vec3 L, const vec3 H)
{
    return 0.5 * mx_ggx_distribution(H * lobe.frame / lobe.stretch, lobe.area)
        * mx_ggx_visibility(lobe, max(dot(L, lobe.frame[2]), 1e-8));
}

// Unpolarised Fresnel equations of a dielectric; the clamped root makes total internal reflection come out as 1.
float mx_fresnel_dielectric(const float cosine)
{
    float g = sqrt(max(2.1025 + cosine * cosine - 1.0, 0.0));
    vec2 a = cosine * vec2(1.0, 2.1025);
    vec2 r = (a - g) / (a + g);
    return 0.5 * dot(r, r);
}

// Where the light from a direction of the world lies in the environment's picture.
vec2 mx_latlong(const vec3 direction)
{
    vec3 d = normalize((u_envMatrix * vec4(direction, 0.0)).xyz);
    return vec2(atan(d.x, -d.z), -2.0 * asin(clamp(d.y, -1.0, 1.0))) * 0.15915494 + vec2(0.5);
}

// What a white lobe reflects at the viewer's cosine c (x), and the mean of Schlick's (1 - cos)^5 over it (y).
vec2 mx_ggx_albedo(const float c)
{
    return mx_ggx_albedo_fit(0.04 / (0.04 + c), c);
}

// A map whose mip levels are filtered for rising roughness.
vec3 mx_ggx_prefiltered(const vec3 N, const vec3 V)
{
    vec2 albedo = mx_ggx_albedo(max(abs(dot(N, V)), 1e-8));
    return mix(vec3(0.033735953), vec3(1.0), albedo.y) * albedo.x
        * (textureLod(u_envRadiance, mx_latlong(reflect(-V, faceforward(N, -V, N))), 0.2
        * float(u_envRadianceMips - 1)).xyz * u_envLightIntensity);
}

void main()
{
    vec3 color = vec3(0.0);
    // lights
    vec3 N = normalize(vd.normalWorld);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    float cos_v = max(abs(dot(N, V)), 1e-8);
    vec2 coat_albedo = mx_ggx_albedo_fit(0.04 / (cos_v + 0.04), cos_v);
    float scale = (1.0 / coat_albedo.x - 1.0) * 0.079748526 + 1.0;
    vec3 h = faceforward(N, -V, N);
    mx_GgxLobe coat_ggx_lobe = mx_ggx_lobe(h, normalize(vd.tangentWorld), V);
    float coat_throughput = 1.0 - mix(0.033735953, 1.0, coat_albedo.y) * coat_albedo.x * scale;
    for (int i = 0; i < min(u_numActiveLightSources, 1); ++i) {
        // coat, paint
        float intensity = u_lightData[i].intensity;
        vec3 L = -u_lightData[i].direction;
        vec3 H = normalize(V - u_lightData[i].direction);
        float fresnel = mx_fresnel_dielectric(clamp(dot(V, H), 1e-8, 1.0));
        float c = max(abs(dot(N, L)), 1e-8);
        vec2 coat_albedo_2 = mx_ggx_albedo_fit(0.04 / (c + 0.04), c);
        float ggx_compensation = (1.0 / coat_albedo_2.x - 1.0) * 0.079748526 + 1.0;
        float cos_l = max(dot(L, h), 1e-8);
        float paint_product = cos_l / 3.1415927
            * (max(dot(V, L) - cos_v * cos_l, 0.0) * 0.225 / max(cos_l, cos_v) + 0.89285713);
        vec3 paint_response = coat_throughput
            * (1.0 - mix(0.033735953, 1.0, coat_albedo_2.y) * coat_albedo_2.x * ggx_compensation) * 0.75 * paint_product
            * vec3(0.6, 0.1, 0.05);
        vec3 sum = scale * mx_ggx_light(coat_ggx_lobe, L, H) * fresnel + paint_response;
        color += u_lightData[i].color * (u_lightData[i].type == 1 ? intensity : 0.0) * sum;
    }
    // environment
    // coat, paint
    vec3 coat_response = scale * mx_ggx_prefiltered(N, V);
    vec2 fit = (cos_v * vec2(-0.7632, -0.4993) - vec2(0.4297, 0.6076) + vec2(0.43155, 0.60945)) * 0.3 + vec2(1.0);
    vec3 oren_nayar_diffuse_bsdf_albedo = clamp(fit.x / fit.y, 0.0, 1.0) * vec3(0.6, 0.1, 0.05);
    vec3 even = oren_nayar_diffuse_bsdf_albedo
        * (textureLod(u_envIrradiance, mx_latlong(h), 0.0).xyz * u_envLightIntensity);
    color += coat_response + even * (coat_throughput * coat_throughput * 0.75);
    out1 = vec4(color, 1.0);
}
