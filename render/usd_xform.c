// SPDX-License-Identifier: Apache-2.0
/* Transforms of USD: the operations that xformOpOrder lists (UsdGeomXformable). */
#include "render/site.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* USD's matrices are for row vectors and stored by row: the same numbers in the same order. */
static struct matrix stored_matrix(const double v[16])
{
    struct matrix out;
    for (size_t i = 0; i < 16; ++i)
        out.m[i / 4][i % 4] = v[i];
    return out;
}

/* "rotateXYZ": about x first. */
static struct matrix rotation(const char *axes, const double angles[3])
{
    struct matrix out = matrix_identity();
    for (size_t i = 0; axes[i] && axes[i] != ':'; ++i) {
        size_t axis = (size_t)(axes[i] - 'X');
        double direction[3] = {axis == 0, axis == 1, axis == 2};
        out = matrix_multiply(matrix_rotation(direction, angles[axes[1] >= 'X' ? axis : 0]), out);
    }
    return out;
}

static bool is_op(const char *op, const char *type)
{
    size_t len = strlen(type);
    return strncmp(op, type, len) == 0 && (!op[len] || op[len] == ':');
}

/* The number of angles that a rotation has; 0: the operation is none. */
static size_t num_angles(const char *op)
{
    static const char *const types[] = {"rotateX",   "rotateY",   "rotateZ",
                                        "rotateXYZ", "rotateXZY", "rotateYXZ",
                                        "rotateYZX", "rotateZXY", "rotateZYX"};
    for (size_t i = 0; i < sizeof types / sizeof *types; ++i)
        if (is_op(op, types[i]))
            return i < 3 ? 1 : 3;
    return 0;
}

/* The matrix of an operation with its numbers; false: it is none. */
static bool make_matrix(const char *op, const double *v, size_t count, struct matrix *out)
{
    if (is_op(op, "translate") && count == 3)
        *out = matrix_translation(v[0], v[1], v[2]);
    else if (is_op(op, "scale") && count == 3)
        *out = matrix_scale(v[0], v[1], v[2]);
    else if (is_op(op, "orient") && count == 4)
        *out = matrix_orientation(v);
    else if (is_op(op, "transform") && count == 16)
        *out = stored_matrix(v);
    else if (count && count == num_angles(op))
        *out = rotation(op + strlen("rotate"), v);
    else
        return false;
    return true;
}

static struct matrix read_op(struct site *site, uint32_t primitive, const char *name)
{
    static const char inverse[] = "!invert!", prefix[] = "xformOp:";
    bool is_inverse = strncmp(name, inverse, strlen(inverse)) == 0;
    name += is_inverse ? strlen(inverse) : 0;
    double v[16];
    struct matrix out = matrix_identity();
    size_t count = mxg_scene_property_numbers(site->scene, primitive, name, v, 16);
    bool good = strncmp(name, prefix, strlen(prefix)) == 0
                && make_matrix(name + strlen(prefix), v, count, &out);
    if (!good)
        site_fail(site, primitive, "xformOpOrder",
                  "lists '%s', which is no operation of a transform; expected for example "
                  "xformOp:translate with three numbers",
                  name);
    return good && is_inverse ? matrix_inverse(out) : out;
}

struct matrix usd_transform(struct site *site, uint32_t primitive, bool *out_resets)
{
    enum { MAX_OPS = 64 }; /* each is found from the first word on */
    char name[256];
    struct matrix out = matrix_identity();
    *out_resets = false;
    for (uint32_t i = 0;
         mxg_scene_property_word(site->scene, primitive, "xformOpOrder", i, name, sizeof name);
         ++i) {
        if (i == MAX_OPS) {
            site_fail(site, primitive, "xformOpOrder", "lists more than %d operations", MAX_OPS);
            break;
        }
        if (strcmp(name, "!resetXformStack!") == 0) {
            *out_resets = true;
            out = matrix_identity();
        } else {
            out = matrix_multiply(out, read_op(site, primitive, name));
        }
    }
    return out;
}
