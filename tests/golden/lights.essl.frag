#version 300 es
// M · surfacematerial · mxgen 0.1 · essl · complete · 1 closure · 0 textures
precision highp float;
precision highp int;
precision highp sampler2D;

uniform float S_opacity;
uniform vec3 u_viewPosition;
uniform int u_numActiveLightSources;
uniform float u_alphaThreshold;
struct LightData {
    int type;
    vec3 tint;
    float power;
    vec3 position;
    vec3 color;
    float intensity;
    float decay_rate;
};
uniform LightData u_lightData[3];
in vec3 vd_positionWorld;
in vec3 vd_normalWorld;
out vec4 out1;

void main()
{
    vec3 color = vec3(0.0);
    vec3 normal = normalize(vd_normalWorld);
    vec3 bsdf = faceforward(normal, -normalize(u_viewPosition - vd_positionWorld), normal);
    for (int i = 0; i < min(u_numActiveLightSources, 3); ++i) {
        bool bulb = u_lightData[i].type == 1;
        vec3 point_light = u_lightData[i].position - vd_positionWorld;
        float point_light_2 = length(point_light);
        vec3 bulb_2 = u_lightData[i].tint * (u_lightData[i].power / (point_light_2 * point_light_2));
        float point_light_3 = u_lightData[i].intensity / pow(point_light_2 + 1.0, u_lightData[i].decay_rate);
        vec3 light = u_lightData[i].color * (u_lightData[i].type == 2 ? point_light_3 : 0.0);
        vec3 bulb_3 = point_light / point_light_2;
        vec3 point_light_4 = normalize(point_light);
        float bsdf_2 = max(dot(bulb ? bulb_3 : point_light_4, bsdf), 1e-8) / 3.1415927 * 0.8;
        color += (bulb ? bulb_2 : light) * bsdf_2;
    }
    if (S_opacity < u_alphaThreshold)
        discard;
    out1 = vec4(S_opacity * color, S_opacity);
}
