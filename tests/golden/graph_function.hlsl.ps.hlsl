// out · output · mxgen 0.1 · hlsl · reduced · 0 closures · 0 textures
// shader model 6.0

struct VertexData {
    float4 position : SV_Position;
    float2 texcoord_0 : TEXCOORD0;
};
static VertexData vd;

float fold(float p0)
{
    return abs(abs(p0 * 2.0 - 1.0) * 2.0 - 1.0);
}

void main(
    VertexData vd_in,
    out float4 out1 : SV_Target0)
{
    vd = vd_in;
    // six/left/left/left/right/right
    float scaled_left = abs(abs(abs(abs(abs(abs(abs(vd.texcoord_0.x * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0)
        * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0;
    // six/left/left/right/right/right
    float left = abs(abs(abs(abs(abs(abs(abs(abs(scaled_left - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0)
        * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0);
    // six/left/right/left/right/right
    float scaled_right = abs(abs(abs(abs(abs(abs(abs(left * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0
        - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0;
    // six/left/right/right/right/left
    float right = abs(abs(abs(abs(abs(abs(abs(abs(scaled_right - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0
        - 1.0) * 2.0 - 1.0) * 2.0 - 1.0) * 2.0 - 1.0);
    // six/right/right/right/right
    float right_2 = fold(fold(fold(fold(fold(fold(fold(fold(fold(fold(fold(fold(fold(fold(fold(fold(abs(abs(right * 2.0
        - 1.0) * 2.0 - 1.0)))))))))))))))));
    out1 = float4(right_2, right_2, right_2, 1.0);
}
