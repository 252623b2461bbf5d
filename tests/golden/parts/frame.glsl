// SPDX-License-Identifier: Apache-2.0
// Functions with names that every shader needs. The loops keep them from being inlined; the first one has no parameter.
uniform float u_time;

float scatter()
{
    float sum = 0.0;
    for (int i = 0; i < 3; i++)
        sum += sin(u_time * float(i));
    return sum;
}

float vd(float x, int count)
{
    float product = 1.0;
    for (int i = 0; i < count; i++)
        product *= cos(x * float(i));
    return product;
}
