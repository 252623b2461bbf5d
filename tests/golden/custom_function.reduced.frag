#version 450
// out · output · mxgen 0.1 · glsl · reduced · 0 closures · 0 textures

in VertexData {
    vec2 texcoord_0;
} vd;
out vec4 out1;

vec2 wave(const float x, const float frequency)
{
    float phase = 6.2831855 * frequency * x;
    return vec2(sin(phase), 6.2831855 * frequency * cos(phase)) / frequency;
}

// Here count = 3.
void waves(const vec2 uv, out float height, out float slope)
{
    vec2 sum = vec2(0.0);
    for (int i = 1; i <= 3; ++i)
        sum += wave(i % 2 == 0 ? uv.x : uv.y, float(i));
    height = sum.x;
    slope = sum.y;
}

void main()
{
    // NG
    float w_height, w_slope;
    waves(vd.texcoord_0, w_height, w_slope);
    out1 = vec4(w_height, w_slope, 0.0, 1.0);
}
