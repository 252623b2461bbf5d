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
    float depth = u_volumeDepth * max(dot(V, normalize(vd.normalWorld)), 0.0);
    float t = 1.0 - vd.texcoord_0.x;
    vec3 optical_depth = t * vec3(0.3, 0.5, 0.9) + t * 1.2;
    vec3 optical_depth_2 = depth * (optical_depth + t * vec3(2.0, 1.0, 0.5));
    vec3 lost = vec3(1.0) - exp(-optical_depth_2);
    vec3 path = mix(vec3(1.0), lost / max(optical_depth_2, vec3(0.001)), step(vec3(0.001), optical_depth_2));
    vec3 color = depth * path * (vd.texcoord_0.x * vec3(0.2, 0.06, 0.01));
    vec3 smoke = path * (t * depth * 1.2);
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
        float smoke_2 = dot(V, type == 1 ? directional_light : spot_light_4) * 0.8 + 1.16;
        color += light_3 * (0.84 / (smoke_2 * 12.566371 * sqrt(smoke_2)) * smoke);
    }
    out1 = vec4(color, dot(lost, vec3(0.33333334)));
}
