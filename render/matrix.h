// SPDX-License-Identifier: Apache-2.0
/*
 * 4x4 matrices for column vectors, stored by column as in shaders; in double, rounded when they are
 * bound.
 */
#ifndef MXG_RENDER_MATRIX_H
#define MXG_RENDER_MATRIX_H

struct matrix {
    double m[4][4]; /* [column][row] */
};

struct matrix matrix_identity(void);
struct matrix matrix_multiply(struct matrix a, struct matrix b);
struct matrix matrix_transpose(struct matrix a);
struct matrix matrix_inverse(struct matrix a); /* `a` must be invertible */
struct matrix matrix_translation(double x, double y, double z);
struct matrix matrix_scale(double x, double y, double z);
struct matrix matrix_rotation(const double axis[3], double degrees); /* right-handed */
/* The rotation of a quaternion w, x, y, z, of any length; of zeros: none. */
struct matrix matrix_orientation(const double q[4]);
/* From world space to a camera at `eye` that looks at `at` along its -z, with y upwards. */
struct matrix matrix_look_at(const double eye[3], const double at[3]);
/* Field of view in degrees; depth 0 at `near` to 1 at `far`, as in Vulkan. */
struct matrix matrix_perspective(double vertical_degrees, double aspect, double near, double far);

/* `out` may be `point`. */
void matrix_point(struct matrix m, const double point[3], double out[3]);
void matrix_direction(struct matrix m, const double direction[3], double out[3]);
/* A normal of a surface that `m` moves, of any length; also of a matrix that cannot be inverted. */
void matrix_normal(struct matrix m, const double normal[3], double out[3]);
/* The determinant of the part that turns and scales. */
double matrix_determinant(struct matrix m);

void vector_normalize(double v[3]);
double vector_dot(const double a[3], const double b[3]);
void vector_cross(const double a[3], const double b[3], double out[3]);

#endif
