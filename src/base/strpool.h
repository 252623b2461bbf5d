// SPDX-License-Identifier: Apache-2.0
/*
 * Interned strings: one 32-bit id per distinct text, compared by id.
 *
 * Pools form layers. A document's pool stands on its library's: text which the library knows has
 * the library's id, new text gets an id beyond. A lower layer does not change while a higher one
 * exists. The lowest layer begins with the words of words.def, so that STR_type, STR_value… are
 * constants.
 *
 * A layer is either growing (pointers into an arena) or an image (offsets into a mapped block, see
 * library/image.c).
 */
#ifndef MXG_BASE_STRPOOL_H
#define MXG_BASE_STRPOOL_H

#include "base/mem.h"

#include <assert.h>

typedef uint32_t str_id; /* 0 is the empty string, which also stands for "absent" */

enum str_word {
    STR_EMPTY,
#define WORD(id, text) STR_##id,
#include "base/words.def"
#undef WORD
    STR_NUM_WORDS
};

struct str_entry {
    const char *text; /* NUL-terminated */
    uint32_t len;
    uint32_t hash;
};

struct strpool {
    const struct strpool *base; /* the layer below; NULL for the lowest */
    uint32_t first;             /* id of this layer's first string */
    uint32_t num;               /* strings of this layer */
    uint32_t table_mask;        /* slots - 1; slots is a power of two; 0 = no table yet */
    const uint32_t *table;      /* open addressing: id or 0 */
    /* growing layer */
    struct arena *arena;
    VEC(struct str_entry) entries;
    /* image layer: text i at bytes + offsets[i], its end (NUL) at offsets[i + 1] - 1 */
    const uint32_t *offsets; /* num + 1 of them; NULL in a growing layer */
    const uint16_t *narrow;  /* in place of `table` where all ids fit */
    const char *bytes;
};

/* An empty growing layer on `base`; with no base it holds the words of words.def. */
void strpool_init(struct strpool *pool, struct arena *arena, const struct strpool *base);

/*
 * The id of a text, which is added where no layer has it. The bytes are copied; they must hold no
 * NUL.
 */
str_id str_intern(struct strpool *pool, const char *text, size_t len);
str_id str_intern_z(struct strpool *pool, const char *text);

/* The id of a text, or 0 where no layer has it. */
str_id str_find(const struct strpool *pool, const char *text, size_t len);

/* The layer that an id is of. */
static inline const struct strpool *str_layer(const struct strpool *pool, str_id id)
{
    while (id < pool->first)
        pool = pool->base;
    assert(id - pool->first < pool->num);
    return pool;
}

/* The text of an id; valid as long as its layer. */
static inline const char *str_text(const struct strpool *pool, str_id id)
{
    pool = str_layer(pool, id);
    uint32_t i = id - pool->first;
    return pool->offsets ? pool->bytes + pool->offsets[i] : pool->entries.items[i].text;
}

static inline size_t str_len(const struct strpool *pool, str_id id)
{
    pool = str_layer(pool, id);
    uint32_t i = id - pool->first;
    return pool->offsets ? pool->offsets[i + 1] - pool->offsets[i] - 1 : pool->entries.items[i].len;
}

#endif
