#version 450
// S · surface · mxgen 0.1 · glsl · reduced · 1 closure · 1 texture

uniform vec3 u_viewPosition = vec3(0.0);
uniform int u_numActiveLightSources = 0;
uniform mat4 u_envMatrix = mat4(-1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
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
uniform sampler2D i_file;
uniform sampler2D u_envIrradiance;
in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
    vec2 texcoord_0;
} vd;
out vec4 out1;

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
    return vec2(fract((d.z > 0.0 ? -0.5 : 0.5) * (mx_half_turn(d.x * stretch, abs(d.z) * stretch) + 0.5) + 0.25), 0.5
        - mx_half_turn(d.y, square * stretch));
}

void main()
{
    vec3 color = vec3(0.0);
    // lights
    // G
    vec3 i = texture(i_file, vd.texcoord_0).xyz;
    vec3 normal_N = normalize(vd.normalWorld);
    vec3 d_N = faceforward(normal_N, -normalize(u_viewPosition - vd.positionWorld), normal_N);
    // from the last light, so that drivers do not unroll the loop
    for (int i_2 = min(u_numActiveLightSources, 3) - 1; i_2 >= 0; --i_2) {
        vec3 L;
        float intensity;
        int light_type = u_lightData[i_2].type;
        if (light_type == 1) {
            L = -u_lightData[i_2].direction;
            intensity = u_lightData[i_2].intensity;
        } else {
            vec3 d = u_lightData[i_2].position - vd.positionWorld;
            vec3 to_light = normalize(d);
            L = to_light;
            float ratio = u_lightData[i_2].intensity / pow(length(d) + 1.0, u_lightData[i_2].decay_rate);
            if (light_type == 2) {
                intensity = ratio;
            } else {
                float spot_light_difference = min(u_lightData[i_2].inner_angle, u_lightData[i_2].outer_angle) - 0.00001;
                intensity = light_type == 3
                    ? smoothstep(spot_light_difference, u_lightData[i_2].inner_angle,
                    -dot(u_lightData[i_2].direction, to_light)) * ratio : 0.0;
            }
        }
        // d
        color += u_lightData[i_2].color * (intensity * (i * (max(dot(L, d_N), 1e-8) * 0.31830987)));
    }
    // environment: d
    color += i * (textureLod(u_envIrradiance, mx_map_point(normalize(mat3(u_envMatrix) * d_N)), 0.0).xyz
        * u_envLightIntensity);
    out1 = vec4(color, 1.0);
}
