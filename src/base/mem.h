// SPDX-License-Identifier: Apache-2.0
/*
 * Memory: an allocator hook, arenas above it, and the unwinding after a failure.
 *
 * Each piece of work (a library, a document, a generation) owns one arena, which one call frees.
 * Out of memory, or above a limit, is the only error that unwinds: the public entry point sets a
 * trap before its first allocation, and `mem_fail` jumps there. trap.c does this with setjmp, and
 * js/native/trap.c in WebAssembly, which has no setjmp. This is safe because
 *   1. the trap precedes the first allocation;
 *   2. the skipped frames own only arena memory, and the entry point reaches the arena;
 *   3. no jump crosses a foreign frame: a callback from libxml2 or from the host sets its own trap.
 * Errors in user input never jump; they are diagnostics.
 */
#ifndef MXG_BASE_MEM_H
#define MXG_BASE_MEM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/*
 * Like realloc, with the old size as well: new_size 0 frees and returns NULL; NULL for another size
 * is a failure.
 */
typedef void *mem_realloc_fn(void *user_data, void *block, size_t old_size, size_t new_size);

struct trap; /* a place to jump to */

struct mem {
    mem_realloc_fn *realloc; /* never NULL after mem_init */
    void *user_data;
    struct trap *trap; /* target of a failure; NULL only outside public calls */
    size_t used;       /* bytes in use */
    size_t limit;      /* maximum of `used`; 0 = unlimited */
    bool over_limit;   /* the last failure was due to the limit, not to the allocator */
};

/* fn NULL: the allocator of the C library. */
void mem_init(struct mem *mem, mem_realloc_fn *fn, void *user_data);

/* Never returns NULL for new_size > 0: a failure jumps to the trap. */
void *mem_realloc(struct mem *mem, void *block, size_t old_size, size_t new_size);

/* Jumps to the trap. */
_Noreturn void mem_fail(struct mem *mem);

/*
 * Runs work(arg) with its own trap, so that no jump leaves it, then restores the previous trap.
 * false: out of memory.
 */
bool mem_try(struct mem *mem, void (*work)(void *arg), void *arg);

struct arena_chunk;

struct arena {
    struct mem *mem;
    struct arena_chunk *chunks; /* newest first */
    struct arena_chunk *large;  /* blocks with their own chunk, doubly linked */
    char *cursor, *end;         /* free part of the newest chunk */
};

void arena_init(struct arena *arena, struct mem *mem);
void arena_finish(struct arena *arena); /* frees everything; the arena is then empty and usable */

/* larger blocks have their own chunk, so that vectors grow with realloc */
enum { ARENA_ALIGNMENT = 16, ARENA_SMALL = 4096 };
void *arena_alloc_other(struct arena *arena, size_t size); /* the slow path of arena_alloc */

/* Uninitialised memory with the alignment of any object; size 0 gives a valid pointer. */
static inline void *arena_alloc(struct arena *arena, size_t size)
{
    size_t rounded = (size + ARENA_ALIGNMENT - 1) & ~(size_t)(ARENA_ALIGNMENT - 1);
    if (size - 1 >= ARENA_SMALL || (size_t)(arena->end - arena->cursor) < rounded)
        return arena_alloc_other(arena, size);
    void *block = arena->cursor;
    arena->cursor += rounded;
    return block;
}
void *arena_zalloc(struct arena *arena, size_t size);

/*
 * Grows a block in place if it is the newest or has its own chunk, otherwise copies it. block may
 * be NULL.
 */
void *arena_grow(struct arena *arena, void *block, size_t old_size, size_t new_size);

/* Gives a block back early. A small one stays where it is until arena_finish. */
void arena_release(struct arena *arena, void *block, size_t size);

char *arena_strndup(struct arena *arena, const char *text, size_t len);

#define ARENA_NEW(arena, T) ((T *)arena_zalloc((arena), sizeof(T)))
#define ARENA_ARRAY(arena, T, n) \
    ((T *)arena_zalloc((arena), mem_array_size((arena)->mem, (n), sizeof(T))))

/* n * size; an overflow is a failure. */
size_t mem_array_size(struct mem *mem, size_t n, size_t size);

/*
 * Vectors: VEC(T) v = {0}; vec_push(&arena, &v, x); v.items[i]; v.len. Their memory belongs to an
 * arena. len and cap are 32-bit; an overflow is a failure.
 */
#define VEC(T) \
    struct { \
        T *items; \
        uint32_t len, cap; \
    }

#define vec_push(arena, v, ...) \
    ((v)->len == (v)->cap \
         ? (void)((v)->items = vec_more((arena), (v)->items, &(v)->cap, sizeof *(v)->items, 1)) \
         : (void)0, \
     (v)->items[(v)->len++] = (__VA_ARGS__))

/* Reserves room for n more items, so that the next n pushes do not move the vector. */
#define vec_reserve(arena, v, n) \
    ((v)->cap - (v)->len < (uint32_t)(n) \
         ? (void)((v)->items = vec_more((arena), (v)->items, &(v)->cap, sizeof *(v)->items, \
                                        (v)->len + (uint32_t)(n) - (v)->cap)) \
         : (void)0)

/* Adds n uninitialised items and returns the address of the first. */
#define vec_extend(arena, v, n) \
    (vec_reserve(arena, v, n), (v)->len += (uint32_t)(n), (v)->items + ((v)->len - (uint32_t)(n)))

#define vec_last(v) ((v)->items[(v)->len - 1])
#define vec_pop(v) ((v)->items[--(v)->len])

/* Used by the macros: grows to at least `more` items beyond *cap. */
void *vec_more(struct arena *arena, void *items, uint32_t *cap, size_t item_size, uint32_t more);

#endif
