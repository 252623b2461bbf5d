// SPDX-License-Identifier: Apache-2.0
/* A module of SPIR-V holds instructions in functions; this header finds whose they are. */
#ifndef MXG_COMPILE_SPIRV_H
#define MXG_COMPILE_SPIRV_H

#include <stddef.h>
#include <stdint.h>

/* Instructions of a function; of the entry point, those of one line. */
struct spirv_part {
    /* its name and '(' with the types of its parameters, in the words; "" where it has none */
    const char *function;
    /* of the source, in the entry point; 0 elsewhere and where it is unknown */
    uint32_t line;
    uint32_t instructions;
};

/*
 * Counts the instructions between OpFunction and OpFunctionEnd, the marks of lines left out: what
 * an optimiser or driver has to go through. *out_parts (may be NULL) gets them in order, to be
 * freed; NULL without memory.
 */
uint32_t spirv_count(const uint32_t *words, size_t num_words, struct spirv_part **out_parts,
                     size_t *out_num_parts);

/* Makes the language of OpSource unknown: readers refuse languages that are newer than they are. */
void spirv_hide_language(uint32_t *words, size_t num_words);

/*
 * Makes storage buffers of the uniform blocks in a module of SPIR-V 1.0, where all blocks are in
 * uniform storage: pipelines then bind storage buffers in their places. For compute stages, which
 * have no other blocks.
 */
void spirv_store_uniforms(uint32_t *words, size_t num_words);

#endif
