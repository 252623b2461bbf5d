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
    vec2 soft_behind = vd.texcoord_0 + vec2(0.028867513, 0.0);
    vec2 soft_before = vd.texcoord_0 + vec2(-0.028867513, 0.0);
    vec2 soft_blur_footprint = abs(dFdx(vd.texcoord_0)) + abs((soft_behind - soft_before) * 0.5);
    vec2 soft_behind_2 = vd.texcoord_0 + vec2(0.0, 0.028867513);
    vec2 soft_before_2 = vd.texcoord_0 + vec2(0.0, -0.028867513);
    vec2 soft_blur_footprint_2 = abs(dFdy(vd.texcoord_0)) + abs((soft_behind_2 - soft_before_2) * 0.5);
    vec3 scaled_wood = textureGrad(wood_file, vd.texcoord_0 - vec2(0.028867513), soft_blur_footprint,
        soft_blur_footprint_2).xyz * 0.01388889;
    vec3 scaled_wood_2 = textureGrad(wood_file, vd.texcoord_0 + vec2(0.028867513, -0.028867513), soft_blur_footprint,
        soft_blur_footprint_2).xyz * 0.01388889;
    vec3 soft_sum = scaled_wood + textureGrad(wood_file, soft_before_2, soft_blur_footprint, soft_blur_footprint_2).xyz
        * 0.05555556 + scaled_wood_2;
    vec3 soft_sum_2 = soft_sum + textureGrad(wood_file, soft_before, soft_blur_footprint, soft_blur_footprint_2).xyz
        * 0.05555556;
    vec3 soft_sum_3 = soft_sum_2 + textureGrad(wood_file, vd.texcoord_0, soft_blur_footprint, soft_blur_footprint_2).xyz
        * 0.22222224;
    vec3 scaled_wood_3 = textureGrad(wood_file, vd.texcoord_0 + vec2(-0.028867513, 0.028867513), soft_blur_footprint,
        soft_blur_footprint_2).xyz * 0.01388889;
    vec3 soft_sum_4 = soft_sum_3 + textureGrad(wood_file, soft_behind, soft_blur_footprint, soft_blur_footprint_2).xyz
        * 0.05555556 + scaled_wood_3;
    vec3 soft_sum_5 = soft_sum_4 + textureGrad(wood_file, soft_behind_2, soft_blur_footprint, soft_blur_footprint_2).xyz
        * 0.05555556;
    out1 = vec4(soft_sum_5 + textureGrad(wood_file, vd.texcoord_0 + vec2(0.028867513), soft_blur_footprint,
        soft_blur_footprint_2).xyz * 0.01388889 + vec3(1.0, 0.0, 0.0), 1.0);
}
