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
    // lights
    vec3 N = normalize(vd.normalWorld);
    vec3 facing = faceforward(N, -normalize(u_viewPosition - vd.positionWorld), N);
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        vec3 L;
        vec3 intensity;
        vec3 difference = u_lightData[i].position - vd.positionWorld;
        float way = length(difference);
        L = difference / way;
        if (u_lightData[i].type == 2) {
            vec3 conical_edf_emission = smoothstep(0.8660254, 0.9848077,
                dot(normalize(u_lightData[i].direction), -(difference / way))) * vec3(1.0, 0.5, 0.2);
            intensity = conical_edf_emission * (60.0 / (way * way));
        } else {
            float bulb_ratio = u_lightData[i].power / (way * way);
            intensity = u_lightData[i].tint * (u_lightData[i].type == 4 ? bulb_ratio : 0.0);
        }
        // bsdf
        color += intensity * (max(dot(L, facing), 1e-8) * 0.31830987 * 0.8);
    }
    out1 = vec4(color, 1.0);
}
