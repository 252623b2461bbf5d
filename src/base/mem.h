// SPDX-License-Identifier: Apache-2.0
/*
 * Memory: one allocator hook, arenas above it, and the way out when it fails.
 *
 * Every piece of work (a library, a document, a generation) owns one arena and is freed in one
 * call. Running out of memory, or of a limit, is the only error that unwinds: the public entry
 * point sets a trap (setjmp) before its first allocation and `mem_fail` jumps there. This is sound
 * because
 *   1. the trap is set before the first allocation;
 *   2. nothing but arena memory is owned in between, and the arena is reachable from the entry
 * point;
 *   3. no jump crosses a foreign frame: a callback from libxml2 or from the host sets its own trap.
 * Errors of the user's input never jump; they are diagnostics.
 */
#ifndef MXG_BASE_MEM_H
#define MXG_BASE_MEM_H

#include <setjmp.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/*
 * As realloc, with both sizes told: new_size 0 frees and returns NULL. NULL for another size means
 * failure.
 */
typedef void *mem_realloc_fn(void *user_data, void *block, size_t old_size, size_t new_size);

struct mem {
    mem_realloc_fn *realloc; /* never NULL after mem_init */
    void *user_data;
    jmp_buf *trap;   /* where a failure goes; NULL only outside of public calls */
    size_t used;     /* bytes held now */
    size_t limit;    /* bytes that may be held; 0 = unlimited */
    bool over_limit; /* the last failure was the limit, not the allocator */
};

/* fn NULL: the C library's allocator. */
void mem_init(struct mem *mem, mem_realloc_fn *fn, void *user_data);

/* Never returns NULL for new_size > 0: failure jumps to the trap. */
void *mem_realloc(struct mem *mem, void *block, size_t old_size, size_t new_size);

/* Jumps to the trap. */
_Noreturn void mem_fail(struct mem *mem);

/*
 * Runs work(arg) with a trap of its own, so that no jump leaves it; the trap before is set again.
 * false: memory ran out.
 */
bool mem_try(struct mem *mem, void (*work)(void *arg), void *arg);

struct arena_chunk;

struct arena {
    struct mem *mem;
    struct arena_chunk *chunks; /* newest first */
    struct arena_chunk *large;  /* blocks with a chunk of their own, doubly linked */
    char *cursor, *end;         /* free part of the newest chunk */
};

void arena_init(struct arena *arena, struct mem *mem);
void arena_finish(struct arena *arena); /* frees everything; the arena may be used again */

/* larger blocks stand alone, so that vectors grow by realloc */
enum { ARENA_ALIGNMENT = 16, ARENA_SMALL = 4096 };
void *arena_alloc_other(struct arena *arena, size_t size); /* what arena_alloc does not do itself */

/* Uninitialised memory aligned for any object; size 0 gives a valid pointer. */
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
 * Grows a block in place where it is the newest or stands alone, else by copying. block may be
 * NULL.
 */
void *arena_grow(struct arena *arena, void *block, size_t old_size, size_t new_size);

char *arena_strndup(struct arena *arena, const char *text, size_t len);

#define ARENA_NEW(arena, T) ((T *)arena_zalloc((arena), sizeof(T)))
#define ARENA_ARRAY(arena, T, n) \
    ((T *)arena_zalloc((arena), mem_array_size((arena)->mem, (n), sizeof(T))))

/* n * size, or a failure where that overflows. */
size_t mem_array_size(struct mem *mem, size_t n, size_t size);

/*
 * Vectors: VEC(T) v = {0}; vec_push(&arena, &v, x); v.items[i]; v.len.
 * They live in an arena, so nothing frees them. len and cap are 32-bit; overflow is a failure.
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

/* Room for n more items, so that the next n do not move the vector. */
#define vec_reserve(arena, v, n) \
    ((v)->cap - (v)->len < (uint32_t)(n) \
         ? (void)((v)->items = vec_more((arena), (v)->items, &(v)->cap, sizeof *(v)->items, \
                                        (v)->len + (uint32_t)(n) - (v)->cap)) \
         : (void)0)

/* The same; returns the address of the first, and they are counted already but not initialised. */
#define vec_extend(arena, v, n) \
    (vec_reserve(arena, v, n), (v)->len += (uint32_t)(n), (v)->items + ((v)->len - (uint32_t)(n)))

#define vec_last(v) ((v)->items[(v)->len - 1])
#define vec_pop(v) ((v)->items[--(v)->len])

/* Used by the macros: at least `more` items beyond *cap. */
void *vec_more(struct arena *arena, void *items, uint32_t *cap, size_t item_size, uint32_t more);

#endif
