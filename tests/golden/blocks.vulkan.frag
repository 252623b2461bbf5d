#version 450
// out · output · mxgen 0.1 · vulkan · complete · 0 closures · 0 textures

layout(set = 0, binding = 1, std140) uniform PublicUniforms {
    vec3 NG_c3;
    mat3 NG_m3;
    int NG_i;
    bool NG_b;
    vec2 NG_v2;
    float NG_f;
    float NG_g;
    vec4 NG_v4;
};
layout(location = 0) out vec4 out1;

void main()
{
    out1 = vec4(NG_m3 * NG_c3 * (NG_g - (NG_f - (float(NG_i) + float(NG_b) + NG_v2.x))), 1.0) + NG_v4;
}
