// SPDX-License-Identifier: Apache-2.0
/*
 * bytes.c: the stored size of the slabs of a pixel, as bytes.def lists it. Budgets and reports ask
 * for it before the walk, the deferred pipeline after it.
 */
#ifndef MXG_SLABS_BYTES_H
#define MXG_SLABS_BYTES_H

#include "slabs/slabs.h"

enum { SLAB_WORD_BYTES = 4 };

/* These facts decide about the parts of a slab. */
struct stored_slab {
    ir_ref diffuse_albedo, f90, anisotropy, second_roughness_weight, fuzz_amount, free_path, normal;
    bool has_tint, has_glints;
    bool is_whole; /* all light reaches it: its weight is 1 */
    bool is_other; /* a closure that is no slab yet: it has all parts, and no values */
};

/* Before the walk. The closure is a SLAB or another BSDF. */
struct stored_slab slab_stored(const struct ir_graph *graph, ir_ref closure, bool is_whole);

/*
 * The words of one slab. is_over: it is the top of several slabs; has_normal: it has a normal that
 * no slab above it has.
 */
uint32_t slab_stored_words(const struct ir_graph *graph, const struct stored_slab *slab,
                           bool is_over, bool has_normal);

/*
 * The most words of a pixel that has all slabs, the top first. A slab refers to one of the last
 * three normals, so each normal is stored once only where there are no more.
 */
uint32_t slab_stored_pixel(const struct ir_graph *graph, const struct stored_slab *slabs,
                           uint32_t num_slabs);

/* A pixel may have this beside f0, albedo and roughness of one slab. */
struct stored_features {
    bool any;     /* a word of a feature */
    bool many;    /* several slabs, weights or anisotropy */
    bool special; /* glints or a tint */
};
struct stored_features slab_stored_features(const struct ir_graph *graph,
                                            const struct stored_slab *slabs, uint32_t num_slabs);

#endif
