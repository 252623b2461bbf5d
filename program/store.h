// SPDX-License-Identifier: Apache-2.0
/*
 * Memory for one task of a program, freed in one call. A program ends if memory is exhausted.
 */
#ifndef MXG_PROGRAM_STORE_H
#define MXG_PROGRAM_STORE_H

#include <stddef.h>

struct store {
    struct store_block *blocks;
};

/* Zeroed memory, aligned for any object. */
void *store_alloc(struct store *store, size_t size);

/* A copy with a NUL after it. */
char *store_text(struct store *store, const char *text, size_t len);

/*
 * Reserves one more item after `len` items: returns the array itself, or a copy of twice the size.
 * `items` is NULL at first.
 */
void *store_grow(struct store *store, void *items, size_t len, size_t item_size);

/* Memory for `len` items, which store_grow can extend. */
void *store_array(struct store *store, size_t len, size_t item_size);

/* Frees all memory; the store stays usable. */
void store_finish(struct store *store);

#endif
