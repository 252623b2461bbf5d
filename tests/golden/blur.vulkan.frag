#version 450
// out · output · mxgen 0.1 · vulkan · complete · 0 closures · 1 texture

layout(set = 0, binding = 3) uniform sampler2D wood_file;
layout(location = 0) in VertexData {
    vec2 texcoord_0;
} vd;
layout(location = 0) out vec4 out1;

void main()
{
    // NG
    vec2 soft = vd.texcoord_0 + vec2(0.028867513, 0.0);
    vec2 soft_2 = vd.texcoord_0 + vec2(-0.028867513, 0.0);
    vec2 soft_3 = abs((soft - soft_2) * 0.5) + abs(dFdx(vd.texcoord_0));
    vec2 soft_4 = vd.texcoord_0 + vec2(0.0, 0.028867513);
    vec2 soft_5 = vd.texcoord_0 + vec2(0.0, -0.028867513);
    vec2 soft_6 = abs((soft_4 - soft_5) * 0.5) + abs(dFdy(vd.texcoord_0));
    vec3 soft_7 = textureGrad(wood_file, vd.texcoord_0 - vec2(0.028867513), soft_3, soft_6).xyz * 0.01388889;
    vec3 soft_8 = textureGrad(wood_file, vd.texcoord_0 + vec2(0.028867513, -0.028867513), soft_3, soft_6).xyz * 0.01388889;
    vec3 soft_9 = soft_7 + textureGrad(wood_file, soft_5, soft_3, soft_6).xyz * 0.05555556 + soft_8;
    vec3 soft_10 = soft_9 + textureGrad(wood_file, soft_2, soft_3, soft_6).xyz * 0.05555556;
    vec3 soft_11 = soft_10 + textureGrad(wood_file, vd.texcoord_0, soft_3, soft_6).xyz * 0.22222224;
    vec3 soft_12 = textureGrad(wood_file, vd.texcoord_0 + vec2(-0.028867513, 0.028867513), soft_3, soft_6).xyz * 0.01388889;
    vec3 soft_13 = soft_11 + textureGrad(wood_file, soft, soft_3, soft_6).xyz * 0.05555556 + soft_12;
    vec3 soft_14 = soft_13 + textureGrad(wood_file, soft_4, soft_3, soft_6).xyz * 0.05555556;
    out1 = vec4(soft_14 + textureGrad(wood_file, vd.texcoord_0 + vec2(0.028867513), soft_3, soft_6).xyz * 0.01388889 + vec3(1.0, 0.0, 0.0), 1.0);
}
