// SPDX-License-Identifier: Apache-2.0
/*
 * A sum of closures for a BSDF that OSL has no closure for. The weights are tables over the cosine
 * of the view, so what the BSDF reflects to all directions together is right for each view; the
 * shape is as near as the closures come.
 */
#ifndef MXG_GENERATORS_OSL_CLOSURE_FIT_H
#define MXG_GENERATORS_OSL_CLOSURE_FIT_H

#include "base/mem.h"
#include "generators/osl/lobes.h"

enum {
    OSL_KNOTS = 8, /* of a table, evenly from the cosine 0 to 1 */
    OSL_MAX_PARTS = 5,
    OSL_MAX_TURNS = 4,
};

/* A BSDF: the value times the cosine. */
struct osl_target {
    void *user_data;
    /* Views at angles around the normal, as a number of quarters of a half turn. false: unknown */
    bool (*value)(void *user_data, const double v[3], const double l[3], unsigned turn,
                  double out[3]);
    unsigned num_turns; /* 1: it is the same at all angles */
    bool passes;        /* light goes through it, too */
};

struct osl_part {
    const struct lobe *lobe;
    float weights[OSL_KNOTS][3];
};

struct osl_fit {
    struct osl_part parts[OSL_MAX_PARTS];
    unsigned num;
    double error; /* the share of light that goes elsewhere, between the knots, over all views */
};

/* False if a value is unknown, or no number. */
bool osl_fit(const struct osl_target *target, struct arena *arena, struct osl_fit *out);

#endif
