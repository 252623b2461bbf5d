// SPDX-License-Identifier: Apache-2.0
#include "program/store.h"

#include "program/memory.h"

#include <stdlib.h>
#include <string.h>

#define BLOCK_SIZE ((size_t)16 << 10)

struct store_block {
    struct store_block *next;
    size_t used, capacity;
    max_align_t data[];
};

static struct store_block *add_block(struct store *store, size_t size)
{
    size_t capacity = size > BLOCK_SIZE ? size : BLOCK_SIZE;
    struct store_block *block = memory_resize(NULL, sizeof *block + capacity); /* not zeroed */
    block->used = 0;
    block->capacity = capacity;
    block->next = store->blocks;
    store->blocks = block;
    return block;
}

/* Not zeroed. */
static void *take(struct store *store, size_t size)
{
    size_t unit = sizeof(max_align_t), rounded = (size + unit - 1) / unit * unit;
    struct store_block *block = store->blocks;
    if (!block || block->capacity - block->used < rounded)
        block = add_block(store, rounded);
    void *data = (char *)block->data + block->used;
    block->used += rounded;
    return data;
}

void *store_alloc(struct store *store, size_t size)
{
    return memset(take(store, size), 0, size);
}

char *store_text(struct store *store, const char *text, size_t len)
{
    char *copy = take(store, len + 1);
    memcpy(copy, text, len);
    copy[len] = '\0';
    return copy;
}

void *store_grow(struct store *store, void *items, size_t len, size_t item_size)
{
    if (len & (len - 1)) /* the capacity doubles at powers of two */
        return items;
    void *more = store_alloc(store, (len ? len * 2 : 1) * item_size);
    if (len)
        memcpy(more, items, len * item_size);
    return more;
}

void *store_array(struct store *store, size_t len, size_t item_size)
{
    size_t capacity = 1;
    while (capacity < len)
        capacity *= 2;
    return len ? store_alloc(store, capacity * item_size) : NULL;
}

void store_finish(struct store *store)
{
    while (store->blocks) {
        struct store_block *block = store->blocks;
        store->blocks = block->next;
        free(block);
    }
}
