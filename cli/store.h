// SPDX-License-Identifier: Apache-2.0
/*
 * Memory of one piece of work of a program, freed in one call. A program ends where there is none.
 */
#ifndef MXG_CLI_STORE_H
#define MXG_CLI_STORE_H

#include <stddef.h>

struct store {
    struct store_block *blocks;
};

/* Zeroed memory, aligned for any object. */
void *store_alloc(struct store *store, size_t size);

/* A copy with a NUL behind it. */
char *store_text(struct store *store, const char *text, size_t len);

/*
 * Room for one more item behind `len` items: the array itself, or a copy twice as large. `items` is
 * NULL at first.
 */
void *store_grow(struct store *store, void *items, size_t len, size_t item_size);

/* Room for `len` items, which store_grow can go on with. */
void *store_array(struct store *store, size_t len, size_t item_size);

/* Frees everything; the store can be used again. */
void store_finish(struct store *store);

#endif
