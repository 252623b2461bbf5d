// SPDX-License-Identifier: Apache-2.0
// Constant arrays at file scope and in functions, which languages have that know no variables at file scope.
const float WEIGHTS[3] = float[3](0.25, 0.5, 0.25);
const vec3 COLORS[2] = vec3[2](vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0));

float weight_of(int shift)
{
    float sum = 0.0;
    for (int k = 0; k < 3; ++k)
        sum += WEIGHTS[k] * float(k + shift);
    return sum;
}

vec3 pick(float x, int i)
{
    const vec2 pairs[2] = vec2[2](vec2(1.0, 2.0), vec2(3.0, 4.0));
    float t[2];
    t[0] = x;
    t[1] = 2.0 * x;
    return COLORS[i] * weight_of(i) * t[i] * pairs[i].y;
}
