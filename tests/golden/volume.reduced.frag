#version 450
// Fog · volumematerial · mxgen 0.1 · glsl · reduced · 3 closures · 0 textures

uniform vec3 u_viewPosition = vec3(0.0);
uniform int u_numActiveLightSources = 0;
uniform float u_volumeDepth = 1.0;
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
in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
    vec2 texcoord_0;
} vd;
out vec4 out1;

void main()
{
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    float volume_depth = u_volumeDepth * max(dot(V, normalize(vd.normalWorld)), 0.0);
    float glow_weight = clamp(vd.texcoord_0.x, 0.0, 1.0);
    vec3 optical_depth_sum = (1.0 - glow_weight) * vec3(0.3, 0.5, 0.9) + (1.0 - glow_weight) * 1.2;
    vec3 optical_depth = volume_depth * (optical_depth_sum + (1.0 - glow_weight) * vec3(2.0, 1.0, 0.5));
    vec3 volume_lost = vec3(1.0) - exp(-optical_depth);
    vec3 path_blend = mix(vec3(1.0), volume_lost / max(optical_depth, 0.001), step(vec3(0.001), optical_depth));
    vec3 color = volume_depth * path_blend * (glow_weight * vec3(0.2, 0.06, 0.01));
    // lights
    vec3 smoke_factor = path_blend * ((1.0 - glow_weight) * volume_depth * 1.2);
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
        // smoke
        float smoke_d = dot(V, L) * 0.8 + 1.16;
        color += u_lightData[i].color * (intensity * (0.84 / (smoke_d * 12.566371 * sqrt(smoke_d)) * smoke_factor));
    }
    out1 = vec4(color, dot(volume_lost, vec3(0.33333334)));
}
