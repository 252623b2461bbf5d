// out · output · mxgen 0.1 · hlsl · complete · 0 closures · 0 textures
// shader model 6.0

cbuffer PrivateUniforms : register(b0)
{
    row_major float4x4 u_worldMatrix : packoffset(c0);
    row_major float4x4 u_viewProjectionMatrix : packoffset(c4);
    float u_time : packoffset(c8);
};

// SPDX-License-Identifier: Apache-2.0 Notes of a scale, more than a constructor of a vector or matrix takes.
float scale(float x)
{
    float notes[20] = {0.0, 2.0, 4.0, 5.0, 7.0, 9.0, 11.0, 12.0, 14.0, 16.0, 17.0, 19.0, 21.0, 23.0, 24.0, 26.0, 28.0,
        29.0, 31.0, 33.0};
    return notes[int(clamp(x, 0.0, 19.0))];
}

void main(
    out float4 out1 : SV_Target0)
{
    // NG
    float s = scale(u_time);
    out1 = float4(s, s, s, 1.0);
}
