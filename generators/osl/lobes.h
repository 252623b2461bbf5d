// SPDX-License-Identifier: Apache-2.0
/*
 * Closures of stdosl.h whose light is known here. Sums of them stand for BSDFs that OSL has no
 * closure for (closure_fit.h). Directions are in a frame whose third axis is the normal, and the
 * view is above the surface.
 */
#ifndef MXG_GENERATORS_OSL_LOBES_H
#define MXG_GENERATORS_OSL_LOBES_H

#include <stdbool.h>

enum lobe_shape {
    LOBE_DIFFUSE,
    LOBE_ROUGH_DIFFUSE, /* Oren and Nayar's, of roughness 1 */
    LOBE_MIRROR,        /* facets around the normal, without Fresnel's curve */
    LOBE_RETRO,         /* facets around the view */
    LOBE_SHEEN,
    LOBE_THROUGH, /* diffuse light behind the surface */
};

struct lobe {
    enum lobe_shape shape;
    float roughness;
};

enum { OSL_NUM_LOBES = 23 };
extern const struct lobe osl_lobes[OSL_NUM_LOBES];

/* The value times the cosine. Lobes of facets lose what they scatter twice (closure_fit.c gives it
 * back).
 */
double osl_lobe_value(const struct lobe *lobe, const double v[3], const double l[3]);
/* True for lobes of which renderers give back what facets scatter twice. */
bool osl_lobe_is_compensated(const struct lobe *lobe);

/* A way to draw directions, as sharp as a lobe. */
void osl_lobe_draw(const struct lobe *lobe, const double v[3], const double xi[2], double out[3]);
double osl_lobe_density(const struct lobe *lobe, const double v[3], const double l[3]);

#endif
