#version 450
// out · output · mxgen 0.1 · glsl · reduced · 0 closures · 1 texture

uniform sampler2D wood_file;
in VertexData {
    vec2 texcoord_0;
} vd;
out vec4 out1;

void main()
{
    // NG
    vec2 shifted_uv = vd.texcoord_0 + vec2(0.028867513, 0.0);
    vec2 shifted_uv_2 = vd.texcoord_0 + vec2(-0.028867513, 0.0);
    vec2 soft_sum = abs((shifted_uv - shifted_uv_2) * 0.5) + abs(dFdx(vd.texcoord_0));
    vec2 shifted_uv_3 = vd.texcoord_0 + vec2(0.0, 0.028867513);
    vec2 shifted_uv_4 = vd.texcoord_0 + vec2(0.0, -0.028867513);
    vec2 soft_sum_2 = abs((shifted_uv_3 - shifted_uv_4) * 0.5) + abs(dFdy(vd.texcoord_0));
    vec3 soft_product = textureGrad(wood_file, vd.texcoord_0 - vec2(0.028867513), soft_sum, soft_sum_2).xyz
        * 0.01388889;
    vec3 soft_product_2 = textureGrad(wood_file, vd.texcoord_0 + vec2(0.028867513, -0.028867513), soft_sum,
        soft_sum_2).xyz * 0.01388889;
    vec3 soft_sum_3 = soft_product + textureGrad(wood_file, shifted_uv_4, soft_sum, soft_sum_2).xyz * 0.05555556
        + soft_product_2;
    vec3 soft_sum_4 = soft_sum_3 + textureGrad(wood_file, shifted_uv_2, soft_sum, soft_sum_2).xyz * 0.05555556;
    vec3 soft_sum_5 = soft_sum_4 + textureGrad(wood_file, vd.texcoord_0, soft_sum, soft_sum_2).xyz * 0.22222224;
    vec3 soft_product_3 = textureGrad(wood_file, vd.texcoord_0 + vec2(-0.028867513, 0.028867513), soft_sum,
        soft_sum_2).xyz * 0.01388889;
    vec3 soft_sum_6 = soft_sum_5 + textureGrad(wood_file, shifted_uv, soft_sum, soft_sum_2).xyz * 0.05555556
        + soft_product_3;
    vec3 soft_sum_7 = soft_sum_6 + textureGrad(wood_file, shifted_uv_3, soft_sum, soft_sum_2).xyz * 0.05555556;
    out1 = vec4(soft_sum_7 + textureGrad(wood_file, vd.texcoord_0 + vec2(0.028867513), soft_sum, soft_sum_2).xyz
        * 0.01388889 + vec3(1.0, 0.0, 0.0), 1.0);
}
