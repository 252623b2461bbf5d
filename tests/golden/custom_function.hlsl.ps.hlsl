// out · output · mxgen 0.1 · hlsl · complete · 0 closures · 0 textures
// shader model 6.0

cbuffer PublicUniforms : register(b1)
{
    int NG_count : packoffset(c0);
};
struct VertexData {
    float4 position : SV_Position;
    float2 texcoord_0 : TEXCOORD0;
};

float2 wave(float x, float frequency)
{
    float phase = 6.2831855 * frequency * x;
    return float2(sin(phase), 6.2831855 * frequency * cos(phase)) / frequency;
}

void waves(float2 uv, int count, out float height, out float slope)
{
    float2 sum = float2(0.0, 0.0);
    for (int i = 1; i <= count; ++i)
        sum += wave(i % 2 == 0 ? uv.x : uv.y, float(i));
    height = sum.x;
    slope = sum.y;
}

void main(
    VertexData vd,
    out float4 out1 : SV_Target0)
{
    // NG
    float w_height, w_slope;
    waves(vd.texcoord_0, NG_count, w_height, w_slope);
    out1 = float4(w_height, w_slope, 0.0, 1.0);
}
