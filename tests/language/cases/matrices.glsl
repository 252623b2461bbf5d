// SPDX-License-Identifier: Apache-2.0
// Matrices of two columns in the portable language.

// x = 0.5: two rounds. By hand: m has the columns (0.5, 1) and (-1, 1), then (0.5, 2.5) and (-2, 2), then (0, 6) and (-4, 4);
// v is (-1.5, 3), then (-6.75, 2.25); the sum is (2.25, 4.5), then (4.5, 22.5).
vec3 turned(float x)
{
    mat2 m = mat2(x, 1.0, -1.0, 2.0 * x);
    vec2 v = vec2(1.0, 2.0), sum = vec2(0.0);
    for (int i = 0; i < int(4.0 * x); i++)
    {
        v = m * v;
        sum += v * m;
        m = m * mat2(vec2(1.0, x), vec2(0.0, 1.0)) + m;
    }
    return vec3(sum + m[1], determinant(m));
}

// x = 0.5: the transpose of (2, 1 | 1, 3) minus 0.5 each, times (2, 4), and its second column times 2.
vec4 parts(float x)
{
    mat2 m = transpose(mat2(2.0, 2.0 * x, 1.0, 6.0 * x)) - x;
    m[1] *= 4.0 * x;
    return vec4(m * vec2(2.0, 8.0 * x), m[0]);
}
