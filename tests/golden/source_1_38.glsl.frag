#version 450
// M · surfacematerial · mxgen 0.1 · glsl · reduced · 2 closures · 0 textures

uniform vec3 u_viewPosition = vec3(0.0);
uniform sampler2D u_envIrradiance;
in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
} vd;
out vec4 out1;

struct BSDF { vec3 response; vec3 throughput; float thickness; float ior; };
#define EDF vec3
void cloth_bsdf_reflection(vec3 L, vec3 V, vec3 P, float occlusion, float weight, vec3 color, inout BSDF bsdf)
{
    bsdf.throughput = vec3(1.0 - weight);
    bsdf.response = color * weight * occlusion * abs(dot(L, V)) * (bsdf.thickness > 0.0 ? bsdf.ior : 1.0) + 0.0 * P;
}

void cloth_bsdf_transmission(vec3 V, float weight, vec3 color, inout BSDF bsdf)
{
    bsdf.throughput = vec3(1.0 - weight);
}

void cloth_bsdf_indirect(vec3 V, float weight, vec3 color, inout BSDF bsdf)
{
    bsdf.throughput = vec3(1.0 - weight);
    bsdf.response = color * weight * textureLod(u_envIrradiance, V.xy, 0.0).rgb;
}

void lamp_edf(vec3 N, vec3 V, vec3 color, out EDF result)
{
    result = color * abs(dot(N, V));
}

void main()
{
    vec3 V_direction = normalize(u_viewPosition - vd.positionWorld);
    vec3 lamp = vec3(0.0);
    lamp_edf(normalize(vd.normalWorld), V_direction, vec3(1.0), lamp);
    vec3 color = lamp;
    // environment: cloth
    BSDF cloth = BSDF(vec3(0.0), vec3(1.0), 0.0, 1.5);
    cloth_bsdf_indirect(V_direction, 0.5, vec3(0.5), cloth);
    color += cloth.response;
    out1 = vec4(color, 1.0);
}
