// SPDX-License-Identifier: Apache-2.0
#include "base/mem.h"

#include <assert.h>
#include <stdalign.h>
#include <stdlib.h>

enum {
    /* bytes of an arena's first chunk; each further chunk is twice as large … */
    CHUNK_FIRST = 16 << 10,
    CHUNK_MAX = 1 << 20, /* … up to this */
};

struct arena_chunk {
    struct arena_chunk *next, *prev; /* prev only in the list of large blocks */
    size_t size;                     /* including this header */
    alignas(max_align_t) char data[];
};

static void *default_realloc(void *user_data, void *block, size_t old_size, size_t new_size)
{
    (void)user_data;
    (void)old_size;
    if (new_size == 0) {
        free(block);
        return NULL;
    }
    return realloc(block, new_size);
}

void mem_init(struct mem *mem, mem_realloc_fn *fn, void *user_data)
{
    *mem = (struct mem){.realloc = fn ? fn : default_realloc, .user_data = user_data};
}

void *mem_realloc(struct mem *mem, void *block, size_t old_size, size_t new_size)
{
    if (mem->limit && new_size > old_size && new_size - old_size > mem->limit - mem->used) {
        mem->over_limit = true;
        mem_fail(mem);
    }
    void *result = mem->realloc(mem->user_data, block, old_size, new_size);
    if (!result && new_size) {
        mem->over_limit = false;
        mem_fail(mem);
    }
    mem->used = mem->used - old_size + new_size;
    return result;
}

size_t mem_array_size(struct mem *mem, size_t n, size_t size)
{
    if (size && n > SIZE_MAX / 2 / size)
        mem_fail(mem);
    return n * size;
}

void arena_init(struct arena *arena, struct mem *mem)
{
    *arena = (struct arena){.mem = mem};
}

static void free_chunks(struct mem *mem, struct arena_chunk *chunk)
{
    while (chunk) {
        struct arena_chunk *next = chunk->next;
        mem_realloc(mem, chunk, chunk->size, 0);
        chunk = next;
    }
}

void arena_finish(struct arena *arena)
{
    free_chunks(arena->mem, arena->chunks);
    free_chunks(arena->mem, arena->large);
    arena_init(arena, arena->mem);
}

static_assert(alignof(max_align_t) <= ARENA_ALIGNMENT, "blocks are aligned for any object");

static size_t round_up(size_t size)
{
    return (size + ARENA_ALIGNMENT - 1) & ~(size_t)(ARENA_ALIGNMENT - 1);
}

static void *alloc_large(struct arena *arena, size_t size)
{
    struct arena_chunk *chunk = mem_realloc(arena->mem, NULL, 0, sizeof *chunk + size);
    *chunk = (struct arena_chunk){.next = arena->large, .size = sizeof *chunk + size};
    if (arena->large)
        arena->large->prev = chunk;
    arena->large = chunk;
    return chunk->data;
}

static void add_chunk(struct arena *arena)
{
    size_t size = CHUNK_FIRST;
    if (arena->chunks && arena->chunks->size < CHUNK_MAX)
        size = arena->chunks->size * 2;
    else if (arena->chunks)
        size = CHUNK_MAX;
    struct arena_chunk *chunk = mem_realloc(arena->mem, NULL, 0, size);
    *chunk = (struct arena_chunk){.next = arena->chunks, .size = size};
    arena->chunks = chunk;
    arena->cursor = chunk->data;
    arena->end = (char *)chunk + size;
}

/*
 * Larger blocks have their own chunk, so that vectors grow with realloc and leave no copies behind.
 */
static bool is_large(size_t size)
{
    return size > ARENA_SMALL;
}

void *arena_alloc_other(struct arena *arena, size_t size)
{
    if (size > SIZE_MAX / 2)
        mem_fail(arena->mem);
    size = round_up(size);
    if (is_large(size))
        return alloc_large(arena, size);
    if ((size_t)(arena->end - arena->cursor) < size || !arena->cursor)
        add_chunk(arena);
    void *block = arena->cursor;
    arena->cursor += size;
    return block;
}

void *arena_zalloc(struct arena *arena, size_t size)
{
    return memset(arena_alloc(arena, size), 0, size);
}

static void *grow_large(struct arena *arena, void *block, size_t new_size)
{
    struct arena_chunk *chunk =
        (struct arena_chunk *)((char *)block - offsetof(struct arena_chunk, data));
    size_t size = sizeof *chunk + round_up(new_size);
    chunk = mem_realloc(arena->mem, chunk, chunk->size, size);
    chunk->size = size;
    if (chunk->prev)
        chunk->prev->next = chunk;
    else
        arena->large = chunk;
    if (chunk->next)
        chunk->next->prev = chunk;
    return chunk->data;
}

void *arena_grow(struct arena *arena, void *block, size_t old_size, size_t new_size)
{
    if (!block || new_size > SIZE_MAX / 2)
        return arena_alloc(arena, new_size);
    size_t held = round_up(old_size);
    if (new_size <= held)
        return block;
    if (is_large(held))
        return grow_large(arena, block, new_size);
    size_t more = round_up(new_size) - held;
    if ((char *)block + held == arena->cursor && (size_t)(arena->end - arena->cursor) >= more
        && !is_large(new_size)) {
        arena->cursor += more;
        return block;
    }
    return memcpy(arena_alloc(arena, new_size), block, old_size);
}

void arena_release(struct arena *arena, void *block, size_t size)
{
    if (!block || !is_large(round_up(size)))
        return;
    struct arena_chunk *chunk =
        (struct arena_chunk *)((char *)block - offsetof(struct arena_chunk, data));
    assert(chunk->size == sizeof *chunk + round_up(size));
    if (chunk->prev)
        chunk->prev->next = chunk->next;
    else
        arena->large = chunk->next;
    if (chunk->next)
        chunk->next->prev = chunk->prev;
    mem_realloc(arena->mem, chunk, chunk->size, 0);
}

char *arena_strndup(struct arena *arena, const char *text, size_t len)
{
    char *copy = arena_alloc(arena, len + 1);
    if (len)
        memcpy(copy, text, len);
    copy[len] = '\0';
    return copy;
}

void *vec_more(struct arena *arena, void *items, uint32_t *cap, size_t item_size, uint32_t more)
{
    uint64_t want = (uint64_t)*cap + more;
    uint64_t grown = (uint64_t)*cap * 2;
    uint64_t new_cap = want > grown ? want : grown;
    if (new_cap < 8)
        new_cap = 8;
    if (new_cap > UINT32_MAX)
        mem_fail(arena->mem);
    items = arena_grow(arena, items, *cap * item_size,
                       mem_array_size(arena->mem, (size_t)new_cap, item_size));
    *cap = (uint32_t)new_cap;
    return items;
}
