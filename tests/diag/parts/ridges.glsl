// SPDX-License-Identifier: Apache-2.0
float ridges(vec2 st, int rounds)
{
    float sum = 0.0;
    for (int i = 0; i < rounds; ++i)
        sum += dFdx(st.x * float(i + 1)) * float(i + 1);
    return sum;
}

float bends(vec2 st)
{
    if (st.y > 0.75)
        return 3.0 * dFdy(st.y * st.x);
    float slope = 0.5;
    if (st.y > 0.5)
        slope = dFdx(st.x * st.y);
    else
        slope = fwidth(sin(st.x) * cos(st.y) * exp(st.x));
    return slope;
}

float stripes(int rounds)
{
    float sum = 0.0;
    for (int i = 0; i < rounds; ++i)
        sum += sin(float(i));
    return sum;
}
