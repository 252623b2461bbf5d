// SPDX-License-Identifier: Apache-2.0
/* The light that facets of GGX reflect once, without mxgen. */
#ifndef MXG_TESTS_UNIT_SLAB_FACETS_H
#define MXG_TESTS_UNIT_SLAB_FACETS_H

#include <math.h>

static const double pi = 3.14159265358979323846;

struct vector {
    double x, y, z;
};

static inline struct vector vector_to(double cosine, double turn)
{
    double sine = sqrt(1.0 - cosine * cosine);
    return (struct vector){sine * cos(turn), sine * sin(turn), cosine};
}

/* A lobe of GGX's facets with the roughness along x and y. */
struct facets {
    double x, y;
};

static inline struct facets facets_of(double roughness, double anisotropy)
{
    double width = roughness * roughness;
    return (struct facets){fmin(width * (1.0 + anisotropy), 1.0),
                           fmin(width * (1.0 - anisotropy), 1.0)};
}

/* cos (1 + 2 Lambda) (Heitz 2014, equations 72 and 80). */
static inline double masking(struct facets a, struct vector v)
{
    return sqrt(a.x * a.x * v.x * v.x + a.y * a.y * v.y * v.y + v.z * v.z);
}

/* The part of the light from l that one reflection sends to v, times the cosine of l (Heitz 2014,
 * equation 99). */
static inline double reflected_once(struct facets a, struct vector v, struct vector l)
{
    struct vector h = {v.x + l.x, v.y + l.y, v.z + l.z};
    double square = h.x * h.x + h.y * h.y + h.z * h.z,
           stretched = h.x * h.x / (a.x * a.x) + h.y * h.y / (a.y * a.y) + h.z * h.z;
    return square * square / (pi * a.x * a.y * stretched * stretched)
           * (0.5 * l.z / (v.z * masking(a, l) + l.z * masking(a, v)));
}

/* Its integral over light, by normals that are visible from v (Heitz 2018, by the caps of Dupuy and
 * Benyoub 2023). */
static inline double returned_once(struct facets a, struct vector v)
{
    enum { COUNT = 4096 };
    double sum = 0.0, reach = masking(a, v);
    for (int i = 0; i < COUNT; ++i) {
        double turn = 2.0 * pi * 0.618033988749895 * i, part = (i + 0.5) / COUNT,
               top = part * (1.0 + v.z / reach), z = top - v.z / reach,
               around = sqrt(fmax(1.0 - z * z, 0.0));
        struct vector h = {a.x * (a.x * v.x / reach + around * cos(turn)),
                           a.y * (a.y * v.y / reach + around * sin(turn)), top};
        double mirror =
            2.0 * (v.x * h.x + v.y * h.y + v.z * h.z) / (h.x * h.x + h.y * h.y + h.z * h.z);
        struct vector l = {mirror * h.x - v.x, mirror * h.y - v.y, mirror * h.z - v.z};
        if (l.z > 0.0)
            sum += l.z * (v.z + reach) / (v.z * masking(a, l) + l.z * reach);
    }
    return sum / COUNT;
}

#endif
