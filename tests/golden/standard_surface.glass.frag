#version 450
// Glass · surfacematerial · mxgen 0.1 · glsl · reduced · 2 closures · 0 textures

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
in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
    vec3 tangentWorld;
} vd;
out vec4 out1;

// A polynomial of two variables, what directional albedos are fitted by (the programs in fits/).
float mx_bicubic(const mat4 m, const float x)
{
    return dot(vec4(1.0, x, x * x, x * x * x), m * vec4(1.0, 0.0001, 1e-8, 1e-12));
}

// The program fits/ggx.c makes the constants. x is never too small by more than 0.001, so that giving lost energy back
// adds none. `u` follows what happens where light grazes the facets.
vec2 mx_ggx_albedo_fit(const float u, const float c)
{
    float x = clamp(1.0 - c - 0.0001 * mx_bicubic(mat4(-0.2006, 5.2916, -3.7565, 0.218, -10.2439, 6.6203, -0.9657,
        2.5694, 38.3042, -80.8059, 71.731, -28.5214, -34.2, 89.1079, -88.4065, 33.782), u), 0.0, 1.0);
    return vec2(min(1.0046 - u * mx_bicubic(mat4(-0.1447, 2.759, -5.4314, 2.8497, -0.9366, 1.4766, 0.5911, -1.0905,
        11.8506, -30.2645, 27.3289, -8.9414, -4.3199, 8.2596, -3.1648, -0.8054), u), 1.0), x * x * x * x * x);
}

mx_GgxLobe mx_ggx_lobe_at(const mat3 frame, const vec3 v)
{
    float masking = sqrt(mix(v.z * v.z, 1.0, 1e-8));
    float step_ = 1.0 / float(max(u_envRadianceSamples, 1));
    float weight = step_ * (v.z + masking);
    return mx_GgxLobe(frame, vec3(0.0001, 0.0001, 1.0), 1e-8, v, masking, normalize(v * vec3(0.0001, 0.0001, 1.0)),
        step_, weight * u_envLightIntensity, weight * 1e-8 * exp2(2.0 * float(u_envRadianceMips) - 2.3485));
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
    float g = sqrt(max(2.3104 + cosine * cosine - 1.0, 0.0));
    vec2 a = cosine * vec2(1.0, 2.3104);
    vec2 r = (a - g) / (a + g);
    return 0.5 * dot(r, r);
}

// Where the light from a direction of the world lies in the environment's picture.
vec2 mx_latlong(const vec3 direction)
{
    vec3 d = normalize((u_envMatrix * vec4(direction, 0.0)).xyz);
    return vec2(atan(d.x, -d.z), -2.0 * asin(clamp(d.y, -1.0, 1.0))) * 0.15915494 + vec2(0.5);
}

// Light of a direction, filtered over the solid angle of a sample (Krivanek and Colbert 2008; the mip level is equation
// 13 of GPU Gems 3, section 20.4).
vec3 mx_filtered_light(const vec3 L, const float level)
{
    return textureLod(u_envRadiance, mx_latlong(L), max(0.25 * log2(level * level / dot(L.xz, L.xz)), 0.0)).xyz;
}

// Direction of the ray -v after it has entered the sphere at normal h and left it again.
vec3 mx_refract_sphere(const vec3 v, const vec3 h, const float ior)
{
    vec3 inside = refract(-v, h, 1.0 / ior);
    return refract(inside, normalize(inside * dot(inside, h) - 0.5 * h), ior);
}

// The light of a sample, and in the fourth component the cosine at its facet h.
vec4 mx_ggx_sample_at(const mx_GgxLobe lobe, const vec3 h, const float level, const float refract_ior)
{
    vec3 l = reflect(-lobe.v, h);
    float weight = mx_ggx_visibility(lobe, max(l.z, 1e-8));
    if (refract_ior > 0.0) {
        l = mx_refract_sphere(lobe.v, h, refract_ior);
        weight = 0.5 / lobe.v.z;
    }
    return vec4(weight * mx_filtered_light(lobe.frame * l, level), clamp(dot(lobe.v, h), 1e-8, 1.0));
}

// A normal of those visible from v, which is stretched by the roughness, before it is scaled to length 1 (Dupuy and
// Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps"): (cos, sin) of its turn around z, and how far the
// cap is below its top.
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

// A function for each interface: what has nothing left to choose needs no version of its own.
vec3 mx_ggx_gather_dielectric(const mx_GgxLobe lobe, const float refract_ior)
{
    vec2 around = vec2(1.0, 0.0);
    vec3 sum = vec3(0.0);
    for (float xi = 0.5 * lobe.step; xi < 1.0; xi += lobe.step) {
        vec4 light = mx_ggx_sample(lobe, around, xi, refract_ior);
        float f = mx_fresnel_dielectric(light.w);
        sum += (refract_ior > 0.0 ? 1.0 - f : f) * light.xyz;
        around = mat2(-0.7373689, 0.6754903, -0.6754903, -0.7373689) * around;
    }
    return lobe.weight * sum;
}

void main()
{
    vec3 color = vec3(0.0);
    // lights
    vec3 direction = normalize(vd.normalWorld);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    // SR_glass
    float c = max(abs(dot(direction, V)), 1e-8);
    vec2 albedo = mx_ggx_albedo_fit(0.0001 / (c + 0.0001), c);
    float scale = (1.0 / albedo.x - 1.0) * 0.08817142 + 1.0;
    mx_GgxLobe lobe = mx_ggx_lobe(faceforward(direction, -V, direction), normalize(vd.tangentWorld), V);
    for (int i = 0; i < min(u_numActiveLightSources, 3); ++i) {
        // reflection
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
        vec3 directional_light_to_light = -u_lightData[i].direction;
        vec3 L = type == 1 ? directional_light_to_light : to_light;
        vec3 H = normalize(V + L);
        float fresnel = mx_fresnel_dielectric(clamp(dot(V, H), 1e-8, 1.0));
        float reflection_response = scale * mx_ggx_light(lobe, L, H) * fresnel;
        color += u_lightData[i].color * (type == 1 ? intensity : point_light_choice) * reflection_response;
    }
    // environment
    // reflection, refraction
    vec3 reflection_response_2 = scale * mx_ggx_gather_dielectric(lobe, 0.0);
    float one_minus_ggx_reflectance = 1.0 - mix(0.042579994, 1.0, albedo.y) * albedo.x * scale;
    color += reflection_response_2 + one_minus_ggx_reflectance * mx_ggx_gather_dielectric(lobe, 1.52);
    out1 = vec4(color, 1.0);
}
