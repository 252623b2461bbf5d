// SPDX-License-Identifier: Apache-2.0
/* features.c: which parts a slab has, and slabs without them. */
#ifndef MXG_SLABS_FEATURES_H
#define MXG_SLABS_FEATURES_H

#include "slabs/spots.h"

/* The keys of the option `features`, and the names in reports. */
extern const char *const slab_feature_keys[NUM_SLAB_FEATURES];
extern const char *const slab_feature_names[NUM_SLAB_FEATURES];

/* The features of a slab, as bits of enum slab_feature; of another closure none. */
uint32_t slab_features(const struct ir_graph *graph, const struct slab_spot *spot);
/* The slab without features, as bits; the mean roughness replaces the second lobe. */
ir_ref slab_without(struct ir_graph *graph, const struct slab_spot *spot, uint32_t features);

#endif
