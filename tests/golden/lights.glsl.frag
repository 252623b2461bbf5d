#version 450
// M · surfacematerial · mxgen 0.1 · glsl · reduced · 1 closure · 0 textures

uniform vec3 u_viewPosition = vec3(0.0);
uniform int u_numActiveLightSources = 0;
struct LightData {
    int type;
    vec3 position;
    vec3 direction;
    vec3 tint;
    float power;
};
uniform LightData u_lightData[3];
in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
} vd;
out vec4 out1;

void main()
{
    vec3 color = vec3(0.0);
    vec3 normal = normalize(vd.normalWorld);
    vec3 bsdf = faceforward(normal, -normalize(u_viewPosition - vd.positionWorld), normal);
    for (int i = 0; i < min(u_numActiveLightSources, 3); ++i) {
        vec3 bulb = u_lightData[i].position - vd.positionWorld;
        float bulb_2 = length(bulb);
        vec3 cone = smoothstep(0.8660254, 0.9848077, dot(normalize(u_lightData[i].direction), -(bulb / bulb_2))) * vec3(1.0, 0.5, 0.2);
        vec3 lamp = cone * (60.0 / (bulb_2 * bulb_2));
        float bulb_3 = u_lightData[i].power / (bulb_2 * bulb_2);
        vec3 light = u_lightData[i].tint * (u_lightData[i].type == 4 ? bulb_3 : 0.0);
        float bsdf_2 = max(dot(bulb / bulb_2, bsdf), 1e-8) / 3.1415927 * 0.8;
        color += (u_lightData[i].type == 2 ? lamp : light) * bsdf_2;
    }
    out1 = vec4(color, 1.0);
}
