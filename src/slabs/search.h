// SPDX-License-Identifier: Apache-2.0
/* search.c: the steps that lead to the smallest tree of slabs within an error. */
#ifndef MXG_SLABS_SEARCH_H
#define MXG_SLABS_SEARCH_H

#include "slabs/steps.h"

/*
 * Steps after which a search tries no more trees; it takes 1 to 3 s for so many. A material of 8
 * closures needs up to half of them.
 */
enum { SLAB_SEARCH_STEPS = 40000000 };

/*
 * Finds the steps, the first one first, from the saver's tree to the smallest one that keeps to the
 * limits of a budget: with the fewest closures, then bytes, then features, then the least error.
 * Where none does, to the nearest one that keeps to closures and bytes, or else to the smallest
 * one. The host has estimates; the caller gives an empty vector. False: the tree is so large that
 * the search was cut short, so that more steps may help.
 */
bool slabs_search(const struct slab_saver *saver, const struct slab_budget *limits,
                  struct slab_candidates *out_steps);

#endif
