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

// Here count = 4.
float vd_2(const float x)
{
    float product = 1.0;
    for (int i = 0; i < 4; ++i)
        product *= cos(x * float(i));
    return product;
}

float scatter_2()
{
    float sum = 0.0;
    for (int i = 0; i < 3; ++i)
        sum += sin(u_time * float(i));
    return sum;
}

// The angle, over pi, with this sine and cosine; the cosine is not negative. It errs by 2.9e-5 at most.
float mx_half_turn(const float sine, const float cosine)
{
    return sine * (0.4999709 + cosine * (cosine * (0.2302802 + cosine * (0.0398298 * cosine - 0.1351235)) - 0.3164252));
}

// The square of the distance of the unit direction d from the vertical axis, never 0.
float mx_map_square(const vec3 d)
{
    return d.x * d.x + (d.z * d.z + 1e-16);
}

// The point of the latitude-longitude picture for the unit direction d, to a tenth of a texel in 4096.
vec2 mx_map_point(const vec3 d)
{
    float square = mx_map_square(d);
    float stretch = inversesqrt(square);
    return vec2(fract((d.z > 0.0 ? -0.5 : 0.5) * (mx_half_turn(d.x * stretch, abs(d.z) * stretch) + 0.5) + 0.25),
        0.5 - mx_half_turn(d.y, square * stretch));
}

void main()
{
    vec3 color = vec3(0.0);
    // lights
    float PublicUniforms_2 = vd_2(vd.texcoord_0.y);
    vec2 ab = PublicUniforms_2 * PublicUniforms_2 * vec2(-0.5, 0.45)
        / (PublicUniforms_2 * PublicUniforms_2 + vec2(0.33, 0.09)) + vec2(1.0, 0.0);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    vec3 N = normalize(vd.normalWorld);
    vec3 facing = faceforward(N, -V, N);
    float cos_v = max(abs(dot(N, V)), 1e-8);
    float diffuse_weight = clamp(scatter_2(), 0.0, 1.0);
    float diffuse_factor = diffuse_weight * 0.31830987 * 0.18;
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        vec3 L;
        float intensity;
        int light_type = u_lightData[i].type;
        if (light_type == 1) {
            L = -u_lightData[i].direction;
            intensity = u_lightData[i].intensity;
        } else {
            vec3 d = u_lightData[i].position - vd.positionWorld;
            vec3 to_light = normalize(d);
            L = to_light;
            float falloff = u_lightData[i].intensity / pow(length(d) + 1.0, u_lightData[i].decay_rate);
            if (light_type == 2) {
                intensity = falloff;
            } else {
                float edge = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
                intensity = light_type == 3
                    ? smoothstep(edge, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, to_light)) * falloff
                    : 0.0;
            }
        }
        // diffuse
        float cos_l = max(dot(L, facing), 1e-8);
        float diffuse_product = intensity
            * ((ab.x + ab.y * max(dot(L, V) - cos_l * cos_v, 0.0) / max(cos_l, cos_v)) * (cos_l * diffuse_factor));
        color += u_lightData[i].color * diffuse_product;
    }
    // environment: diffuse
    if (diffuse_weight > 0.0) {
        vec2 fit = PublicUniforms_2 * (cos_v * vec2(-0.7632, -0.4993) - vec2(0.4297, 0.6076)
            + PublicUniforms_2 * vec2(1.4385, 2.0315)) + vec2(1.0);
        float diffuse_product = u_envLightIntensity * (clamp(fit.x / fit.y, 0.0, 1.0) * (diffuse_weight * 0.18));
        color += textureLod(u_envIrradiance, mx_map_point(normalize(mat3(u_envMatrix) * facing)), 0.0).xyz
            * diffuse_product;
    }
    // opacity
    float opacity = clamp(surface_opacity, 0.0, 1.0);
    if (opacity < u_alphaThreshold)
        discard;
    out1 = vec4(opacity * color, opacity);
}
