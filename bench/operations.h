// SPDX-License-Identifier: Apache-2.0
/* Pixel stages that count what they do: SPIR-V with a counter in each block. */
#ifndef MXG_BENCH_OPERATIONS_H
#define MXG_BENCH_OPERATIONS_H

#include <stddef.h>
#include <stdint.h>

enum count_of {
    COUNT_OPERATIONS,   /* scalar ones: arithmetic, comparisons, functions, samples, branches */
    COUNT_INSTRUCTIONS, /* all of SPIR-V's, with the loads and stores that drivers remove */
    COUNT_READS         /* of textures */
};

/*
 * Makes a pixel stage of a fragment shader for Vulkan that does the same work, but whose output at
 * location 0, a vec4, is the number of what one pixel executed, with the alpha 1. Each block adds
 * its number to a counter, so branches count as they are taken, and loops as often as they run. A
 * vector operation counts as many as the components of the largest value that it takes or gives.
 * Malloc; NULL: no memory, or the stage has no such output.
 */
uint32_t *operations_instrument(const uint32_t *words, size_t num_words, enum count_of what,
                                size_t *out_num_words);

#endif
