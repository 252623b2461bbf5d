// SPDX-License-Identifier: Apache-2.0
/*
 * places.c: where an estimate looks at a ball. A value per place of the ball says what the matter
 * is there; of places with like values one stands for all.
 */
#ifndef MXG_SLABS_PLACES_H
#define MXG_SLABS_PLACES_H

#include "ir/ir.h"

enum { SLAB_NUM_PLACES = 256, SLAB_NUM_VIEWS = 6, SLAB_NUM_SIDES = 32 };

/* A look at a place from one side. */
struct slab_glance {
    unsigned at;                   /* below SLAB_NUM_PLACES */
    unsigned view;                 /* below SLAB_NUM_VIEWS */
    float weights[SLAB_NUM_SIDES]; /* the parts that it stands for of what each side of the ball
                                      shows; all glances are 1 together */
};

struct slab_glances {
    VEC(struct slab_glance) items;
};

/* Gives what the pixel stage knows of a place. Its normal is that of the eye's frame. */
void slabs_place_stream(unsigned at, str_id name, struct ir_value *out);

/* values: SLAB_NUM_PLACES triples; NULL: the ball is even. */
void slabs_choose_glances(const float *values, struct arena *arena, struct slab_glances *out);

#endif
