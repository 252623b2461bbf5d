#version 300 es
// Paint · surfacematerial · mxgen 0.1 · essl · reduced · 4 closures · 0 textures
precision highp float;
precision highp int;
precision highp sampler2D;

uniform vec3 u_viewPosition;
uniform int u_numActiveLightSources;
uniform float u_alphaThreshold;
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
in vec3 vd_positionWorld;
in vec3 vd_normalObject;
in vec3 vd_normalWorld;
in vec2 vd_texcoord_0;
layout(location = 0) out vec4 out1;
layout(location = 1) out vec4 aov_diffuse;
layout(location = 2) out vec4 aov_glow;
layout(location = 3) out vec4 aov_base_albedo;
layout(location = 4) out vec4 aov_uv;
layout(location = 5) out vec4 aov_weights;
layout(location = 6) out int aov_is_paint;
layout(location = 7) out int aov_id;
layout(location = 8) out vec4 aov_normal;

void main()
{
    vec3 color = vec3(0.1, 0.2, 0.3);
    // lights
    vec3 Ng = normalize(vd_normalWorld);
    vec3 P = Ng * vd_texcoord_0.x + vd_positionWorld;
    vec3 facet = normalize(cross(dFdx(P), dFdy(P)));
    vec3 facet_normal = faceforward(facet, -Ng, facet);
    vec3 facet_2 = normalize(cross(dFdx(vd_positionWorld), dFdy(vd_positionWorld)));
    vec3 displaced_normal = normalize(Ng + (facet_normal - faceforward(facet_2, -Ng, facet_2)));
    // SR/base
    vec3 facing = faceforward(displaced_normal, -normalize(u_viewPosition - P), displaced_normal);
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        vec3 L;
        float intensity;
        int light_type = u_lightData[i].type;
        if (light_type == 1) {
            L = -u_lightData[i].direction;
            intensity = u_lightData[i].intensity;
        } else {
            vec3 d = u_lightData[i].position - P;
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
        color += u_lightData[i].color * (intensity * (max(dot(L, facing), 1e-8) * 0.31830987 * vec3(0.8, 0.1, 0.1)));
    }
    vec3 color_2 = vec3(0.0);
    // lights (2)
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        vec3 L;
        float intensity;
        int light_type = u_lightData[i].type;
        if (light_type == 1) {
            L = -u_lightData[i].direction;
            intensity = u_lightData[i].intensity;
        } else {
            vec3 d = u_lightData[i].position - P;
            vec3 to_light = normalize(d);
            L = to_light;
            float falloff = u_lightData[i].intensity / pow(length(d) + 1.0, u_lightData[i].decay_rate);
            if (light_type == 2) {
                intensity = falloff;
            } else {
                float edge = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
                intensity = light_type == 3
                    ? falloff * smoothstep(edge, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, to_light))
                    : 0.0;
            }
        }
        // diffuse (2)
        color_2 += u_lightData[i].color * (intensity * (max(dot(facing, L), 1e-8) * 0.31830987 * vec3(0.8, 0.1, 0.1)));
    }
    // opacity
    if (0.5 < u_alphaThreshold)
        discard;
    out1 = vec4(color * 0.5, 0.5);
    aov_diffuse = vec4(color_2 * 0.5, 0.5);
    aov_glow = vec4(0.05, 0.1, 0.15, 0.5);
    aov_base_albedo = vec4(0.4, 0.05, 0.05, 0.5);
    aov_uv = vec4(vd_texcoord_0 * 0.5, 0.0, 0.5);
    aov_weights = vec4(0.05, 0.1, 0.15, 0.2);
    aov_is_paint = 1;
    aov_id = 7;
    aov_normal = vec4(normalize(vd_normalObject) * 0.5, 0.5);
}
