// SPDX-License-Identifier: Apache-2.0
/*
 * Structures (mxg_document_structure) of elements that were generated without a message: their
 * equals need no generation.
 */
#ifndef MXG_VALIDATE_STRUCTURES_H
#define MXG_VALIDATE_STRUCTURES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct structures {
    uint64_t *items; /* open addressing, 0: free */
    size_t len, capacity;
};

bool structures_have(const struct structures *structures, uint64_t structure);
/*
 * So many are kept that memory stays flat: then all are forgotten. Without memory nothing is kept.
 */
void structures_add(struct structures *structures, uint64_t structure);
void structures_finish(struct structures *structures);

#endif
