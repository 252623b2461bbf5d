#version 450
// out · output · mxgen 0.1 · glsl · complete · 0 closures · 0 textures

in VertexData {
    vec2 texcoord_0;
} vd;
out vec4 out1;

// bitCount is not in the portable language
void bits(float x, out float result)
{
    result = float(bitCount(floatBitsToInt(x)));
}

void main()
{
    // NG
    float b;
    bits((uintBitsToFloat(packHalf2x16(vd.texcoord_0))), b);
    out1 = vec4(b, b, b, 1.0);
}
