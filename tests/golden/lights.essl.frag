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
    // lights
    vec3 N = normalize(vd_normalWorld);
    vec3 facing = faceforward(N, -normalize(u_viewPosition - vd_positionWorld), N);
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        vec3 L;
        vec3 intensity;
        vec3 d = u_lightData[i].position - vd_positionWorld;
        float way = length(d);
        if (u_lightData[i].type == 1) {
            L = d / way;
            intensity = u_lightData[i].tint * (u_lightData[i].power / (way * way));
        } else {
            L = normalize(d);
            float falloff = u_lightData[i].intensity / pow(way + 1.0, u_lightData[i].decay_rate);
            intensity = u_lightData[i].color * (u_lightData[i].type == 2 ? falloff : 0.0);
        }
        // bsdf
        color += intensity * (max(dot(L, facing), 1e-8) * 0.31830987 * 0.8);
    }
    // opacity
    float opacity = clamp(S_opacity, 0.0, 1.0);
    if (opacity < u_alphaThreshold)
        discard;
    out1 = vec4(opacity * color, opacity);
}
