// SPDX-License-Identifier: Apache-2.0
#include "render/matrix.h"

#include <math.h>
#include <stddef.h>

#define DEGREE (3.14159265358979323846 / 180.0)

struct matrix matrix_identity(void)
{
    return matrix_scale(1, 1, 1);
}

struct matrix matrix_multiply(struct matrix a, struct matrix b)
{
    struct matrix out = {0};
    for (size_t c = 0; c < 4; ++c)
        for (size_t r = 0; r < 4; ++r)
            for (size_t k = 0; k < 4; ++k)
                out.m[c][r] += a.m[k][r] * b.m[c][k];
    return out;
}

struct matrix matrix_transpose(struct matrix a)
{
    struct matrix out;
    for (size_t c = 0; c < 4; ++c)
        for (size_t r = 0; r < 4; ++r)
            out.m[c][r] = a.m[r][c];
    return out;
}

/* Gauss-Jordan elimination with the largest pivot of each column. */
struct matrix matrix_inverse(struct matrix a)
{
    struct matrix out = matrix_identity();
    for (size_t k = 0; k < 4; ++k) {
        size_t pivot = k;
        for (size_t r = k + 1; r < 4; ++r)
            if (fabs(a.m[k][r]) > fabs(a.m[k][pivot]))
                pivot = r;
        double scale = 1.0 / a.m[k][pivot];
        for (size_t c = 0; c < 4; ++c) {
            double t = a.m[c][pivot], u = out.m[c][pivot];
            a.m[c][pivot] = a.m[c][k], out.m[c][pivot] = out.m[c][k];
            a.m[c][k] = t * scale, out.m[c][k] = u * scale;
        }
        for (size_t r = 0; r < 4; ++r) {
            double factor = a.m[k][r];
            for (size_t c = 0; r != k && c < 4; ++c) {
                a.m[c][r] -= factor * a.m[c][k];
                out.m[c][r] -= factor * out.m[c][k];
            }
        }
    }
    return out;
}

struct matrix matrix_translation(double x, double y, double z)
{
    struct matrix out = matrix_identity();
    out.m[3][0] = x, out.m[3][1] = y, out.m[3][2] = z;
    return out;
}

struct matrix matrix_scale(double x, double y, double z)
{
    return (struct matrix){{{x, 0, 0, 0}, {0, y, 0, 0}, {0, 0, z, 0}, {0, 0, 0, 1}}};
}

/* Rodrigues: R = cos·1 + (1 - cos)·a aᵀ + sin·[a]× */
struct matrix matrix_rotation(const double axis[3], double degrees)
{
    double a[3] = {axis[0], axis[1], axis[2]}, c = cos(degrees * DEGREE), s = sin(degrees * DEGREE),
           k = 1 - c;
    vector_normalize(a);
    return (struct matrix){
        {{c + k * a[0] * a[0], k * a[0] * a[1] + s * a[2], k * a[0] * a[2] - s * a[1], 0},
         {k * a[0] * a[1] - s * a[2], c + k * a[1] * a[1], k * a[1] * a[2] + s * a[0], 0},
         {k * a[0] * a[2] + s * a[1], k * a[1] * a[2] - s * a[0], c + k * a[2] * a[2], 0},
         {0, 0, 0, 1}}};
}

struct matrix matrix_orientation(const double q[4])
{
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    double w = q[0] / length, x = q[1] / length, y = q[2] / length, z = q[3] / length;
    if (!(length > 0))
        return matrix_identity();
    return (struct matrix){{{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), 0},
                            {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x), 0},
                            {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y), 0},
                            {0, 0, 0, 1}}};
}

struct matrix matrix_look_at(const double eye[3], const double at[3])
{
    const double up[3] = {0, 1, 0};
    double z[3] = {eye[0] - at[0], eye[1] - at[1], eye[2] - at[2]}, x[3], y[3];
    vector_normalize(z);
    vector_cross(up, z, x);
    vector_normalize(x);
    vector_cross(z, x, y);
    struct matrix rotation = {
        {{x[0], y[0], z[0], 0}, {x[1], y[1], z[1], 0}, {x[2], y[2], z[2], 0}, {0, 0, 0, 1}}};
    return matrix_multiply(rotation, matrix_translation(-eye[0], -eye[1], -eye[2]));
}

struct matrix matrix_perspective(double vertical_degrees, double aspect, double near, double far)
{
    double f = 1.0 / tan(vertical_degrees * DEGREE / 2), depth = far / (near - far);
    return (struct matrix){
        {{f / aspect, 0, 0, 0}, {0, f, 0, 0}, {0, 0, depth, -1}, {0, 0, depth * near, 0}}};
}

void vector_normalize(double v[3])
{
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (size_t i = 0; i < 3; ++i)
        v[i] /= length;
}

double vector_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void vector_cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

void matrix_direction(struct matrix m, const double direction[3], double out[3])
{
    const double d[3] = {direction[0], direction[1], direction[2]};
    for (int r = 0; r < 3; ++r)
        out[r] = m.m[0][r] * d[0] + m.m[1][r] * d[1] + m.m[2][r] * d[2];
}

void matrix_point(struct matrix m, const double point[3], double out[3])
{
    matrix_direction(m, point, out);
    for (int r = 0; r < 3; ++r)
        out[r] += m.m[3][r];
}

double matrix_determinant(struct matrix m)
{
    double across[3];
    vector_cross(m.m[0], m.m[1], across);
    return vector_dot(across, m.m[2]);
}

/* The inverse transpose is the matrix of cofactors, over the determinant. */
void matrix_normal(struct matrix m, const double normal[3], double out[3])
{
    const double n[3] = {normal[0], normal[1], normal[2]},
                 side = matrix_determinant(m) < 0 ? -1 : 1;
    double x[3], y[3], z[3];
    vector_cross(m.m[1], m.m[2], x);
    vector_cross(m.m[2], m.m[0], y);
    vector_cross(m.m[0], m.m[1], z);
    for (size_t i = 0; i < 3; ++i)
        out[i] = side * (x[i] * n[0] + y[i] * n[1] + z[i] * n[2]);
}
