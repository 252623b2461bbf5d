// SPDX-License-Identifier: Apache-2.0
/*
 * Interned strings: one 32-bit id per distinct text, so a comparison of ids is a comparison of
 * texts.
 *
 * Pools stack: the pool of a document extends the pool of its library. A text in a lower pool keeps
 * its id, and a new text gets a higher id. A lower pool does not change while a higher one exists.
 * The lowest pool begins with the words of words.def, so STR_type, STR_value… are constants.
 *
 * A pool either grows (pointers into an arena) or is part of a library image (offsets into the
 * mapped file).
 */
#ifndef MXG_BASE_STRPOOL_H
#define MXG_BASE_STRPOOL_H

#include "base/table.h"

#include <assert.h>

typedef uint32_t str_id; /* 0 is the empty string, which also means "absent" */

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
};

struct strpool {
    const struct strpool *base; /* the pool below; NULL for the lowest */
    uint32_t first;             /* id of this pool's first string */
    uint32_t num;               /* number of strings in this pool */
    struct table table;
    /* growing pool */
    struct arena *arena;
    VEC(struct str_entry) entries;
    /* image: text i is at bytes + offsets[i], its NUL at offsets[i + 1] - 1 */
    const uint32_t *offsets; /* num + 1 entries; NULL in a growing pool */
    const char *bytes;
};

/* Makes an empty growing pool above `base`; without a base it contains the words of words.def. */
void strpool_init(struct strpool *pool, struct arena *arena, const struct strpool *base);

/*
 * Takes the texts of the growing pools below, down to `lowest`, into the pool, which then stands
 * above the base of that one. All ids stay.
 */
void strpool_leave_base(struct strpool *pool, const struct strpool *lowest);

/*
 * The id of a text; adds the text if no pool of the stack has it. Copies the bytes, which must not
 * contain NUL.
 */
str_id str_intern(struct strpool *pool, const char *text, size_t len);
str_id str_intern_z(struct strpool *pool, const char *text);

/* The id of a text, or 0 if no pool of the stack has it. */
str_id str_find(const struct strpool *pool, const char *text, size_t len);

/* The pool of an id. */
static inline const struct strpool *str_layer(const struct strpool *pool, str_id id)
{
    while (id < pool->first)
        pool = pool->base;
    assert(id - pool->first < pool->num);
    return pool;
}

/* The text of an id; valid as long as its pool. */
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
