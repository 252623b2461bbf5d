#version 450
// surface · surface · mxgen 0.1 · glsl · complete · 1 closure · 0 textures

uniform float surface_opacity = 1.0;
uniform vec3 u_viewPosition = vec3(0.0);
uniform float u_time = 0.0;
uniform int u_numActiveLightSources = 0;
uniform mat4 u_envMatrix = mat4(-1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
uniform float u_envLightIntensity = 1.0;
uniform float u_alphaThreshold = 0.001;
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
uniform sampler2D u_envIrradiance;
in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
    vec2 texcoord_0;
} vd;
out vec4 out1;

float scatter_2()
{
    float sum = 0.0;
    for (int i = 0; i < 3; ++i)
        sum += sin(u_time * float(i));
    return sum;
}

float vd_2(const float x)
{
    float product = 1.0;
    for (int i = 0; i < 4; ++i)
        product *= cos(x * float(i));
    return product;
}

// atan(t) over pi for |t| <= 1, within 2.6e-5; the built-in function takes thrice as long.
float mx_half_turn(const float t)
{
    float t2 = t * t;
    return t * (0.3180596 + t2 * (t2 * (0.0465574 - 0.0124098 * t2) - 0.1022332));
}

// The point of the picture for a unit direction in it, to a tenth of a texel in 4096.
vec2 mx_map_point(const vec3 d)
{
    float radius = length(d.xz);
    float turn = mx_half_turn(d.x / max(abs(d.z) + radius, 1e-8));
    return vec2(fract(d.z > 0.0 ? -turn : 0.5 + turn), 0.5 - 2.0 * mx_half_turn(d.y / (1.0 + radius)));
}

void main()
{
    vec3 color = vec3(0.0);
    // lights
    float LightData_2 = scatter_2();
    vec3 normal_N = normalize(vd.normalWorld);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    vec3 diffuse_N = faceforward(normal_N, -V, normal_N);
    float PublicUniforms_2 = vd_2(vd.texcoord_0.y);
    vec2 ab = PublicUniforms_2 * PublicUniforms_2 * vec2(-0.5, 0.45)
        / (PublicUniforms_2 * PublicUniforms_2 + vec2(0.33, 0.09)) + vec2(1.0, 0.0);
    float cos_v = max(abs(dot(normal_N, V)), 1e-8);
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        // diffuse
        int type = u_lightData[i].type;
        vec3 d = u_lightData[i].position - vd.positionWorld;
        float ratio = u_lightData[i].intensity / pow(length(d) + 1.0, u_lightData[i].decay_rate);
        float spot_light_difference = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
        vec3 to_light = normalize(d);
        float spot_light_choice = type == 3
            ? smoothstep(spot_light_difference, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, to_light))
            * ratio : 0.0;
        float point_light_choice = type == 2 ? ratio : spot_light_choice;
        vec3 L = type == 1 ? -u_lightData[i].direction : to_light;
        float cos_l = max(dot(L, diffuse_N), 1e-8);
        float diffuse_response = LightData_2 * 0.18
            * (cos_l / 3.1415927 * (ab.x + ab.y * max(dot(L, V) - cos_l * cos_v, 0.0) / max(cos_l, cos_v)));
        color += u_lightData[i].color * ((type == 1 ? u_lightData[i].intensity : point_light_choice)
            * diffuse_response);
    }
    // environment
    // diffuse
    if (LightData_2 > 0.0) {
        vec3 diffuse_part = textureLod(u_envIrradiance,
            mx_map_point(normalize((u_envMatrix * vec4(diffuse_N, 0.0)).xyz)), 0.0).xyz;
        vec2 fit = PublicUniforms_2 * (cos_v * vec2(-0.7632, -0.4993) - vec2(0.4297, 0.6076) + PublicUniforms_2
            * vec2(1.4385, 2.0315)) + vec2(1.0);
        color += diffuse_part * (u_envLightIntensity * (LightData_2 * 0.18 * clamp(fit.x / fit.y, 0.0, 1.0)));
    }
    // opacity
    if (surface_opacity < u_alphaThreshold)
        discard;
    out1 = vec4(surface_opacity * color, surface_opacity);
}
