// SPDX-License-Identifier: Apache-2.0
const float TAU = 6.2831855;

float unused(float x)
{
    return x * TAU;
}

vec2 wave(float x, float frequency)
{
    float phase = TAU * frequency * x;
    return vec2(sin(phase), TAU * frequency * cos(phase)) / frequency;
}

void waves(vec2 uv, int count, out float height, out float slope)
{
    vec2 sum = vec2(0.0);
    for (int i = 1; i <= count; ++i)
        sum += wave(i % 2 == 0 ? uv.x : uv.y, float(i));
    height = sum.x;
    slope = sum.y;
}
