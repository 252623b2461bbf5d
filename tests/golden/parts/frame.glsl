// SPDX-License-Identifier: Apache-2.0
// Functions with names that shaders need for themselves. The loops keep them from being written in place.
float scatter(float x, int count)
{
    float sum = 0.0;
    for (int i = 0; i < count; i++)
        sum += sin(x * float(i));
    return sum;
}

float vd(float x, int count)
{
    float product = 1.0;
    for (int i = 0; i < count; i++)
        product *= cos(x * float(i));
    return product;
}
