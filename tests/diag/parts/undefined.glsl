void tint(vec3 color, out vec3 result)
{
    vec3 sum;
    result = color + sum;
}

float maybe(float x)
{
    float y;
    if (x > 0.5)
        y = x;
    return y;
}
