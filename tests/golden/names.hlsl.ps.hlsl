// out · output · mxgen 0.1 · hlsl · complete · 0 closures · 0 textures
// shader model 6.0

cbuffer PublicUniforms : register(b1)
{
    float texture_in : packoffset(c0);
    float texture_gl_x : packoffset(c0.y);
    float texture_a_b : packoffset(c0.z);
};

void main(
    out float4 out1 : SV_Target0)
{
    // texture
    float vd_2 = cos(sin(texture_in)) + texture_gl_x;
    float normal = (vd_2 + texture_a_b) / vd_2;
    out1 = float4(normal, normal, normal, 1.0);
}
