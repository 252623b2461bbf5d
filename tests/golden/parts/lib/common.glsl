// Included by several files, in the shader once.
#define HALF_PI (M_PI * 0.5)

float shape(float x)
{
    return mx_square(x) * HALF_PI;
}
