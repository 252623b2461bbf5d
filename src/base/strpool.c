// SPDX-License-Identifier: Apache-2.0
#include "base/strpool.h"

#include "base/hash.h"

/* Texts of an image have no hash of their own beside them. */
static inline bool is_text(const struct strpool *pool, str_id id, const char *text, size_t len)
{
    assert(id >= pool->first && id - pool->first < pool->num);
    if (pool->offsets) {
        const uint32_t *at = &pool->offsets[id - pool->first];
        return at[1] - at[0] - 1 == len && memcmp(pool->bytes + at[0], text, len) == 0;
    }
    const struct str_entry *e = &pool->entries.items[id - pool->first];
    return e->len == len && memcmp(e->text, text, len) == 0;
}

static str_id find_hashed(const struct strpool *pool, const char *text, size_t len, uint32_t hash)
{
    for (; pool; pool = pool->base)
        for (uint32_t at = hash, id; (id = table_next(&pool->table, hash, &at));)
            if (is_text(pool, id, text, len))
                return id;
    return 0;
}

str_id str_find(const struct strpool *pool, const char *text, size_t len)
{
    return len ? find_hashed(pool, text, len, hash_bytes(text, len)) : 0;
}

static str_id add(struct strpool *pool, const char *text, size_t len, uint32_t hash)
{
    if (len > UINT32_MAX - 1 || pool->first + pool->num == UINT32_MAX)
        mem_fail(pool->arena->mem);
    str_id id = pool->first + pool->num;
    vec_push(pool->arena, &pool->entries,
             (struct str_entry){arena_strndup(pool->arena, text, len), (uint32_t)len});
    pool->num++;
    assert(pool->num == pool->entries.len);
    table_add(&pool->table, pool->arena, hash, id);
    return id;
}

str_id str_intern(struct strpool *pool, const char *text, size_t len)
{
    if (len == 0)
        return 0;
    uint32_t hash = hash_bytes(text, len);
    str_id id = find_hashed(pool, text, len, hash);
    return id ? id : add(pool, text, len, hash);
}

str_id str_intern_z(struct strpool *pool, const char *text)
{
    return str_intern(pool, text, strlen(text));
}

void strpool_leave_base(struct strpool *pool, const struct strpool *lowest)
{
    const struct strpool top = *pool, *level = NULL;
    *pool = (struct strpool){.base = lowest->base, .first = lowest->first, .arena = top.arena};
    while (level != &top) { /* from the lowest one up */
        const struct strpool *next = &top;
        while (next != lowest && next->base != level)
            next = next->base;
        level = next;
        assert(!level->offsets && level->first == pool->first + pool->num);
        for (uint32_t i = 0; i < level->num; i++) {
            const struct str_entry *e = &level->entries.items[i];
            add(pool, e->text, e->len, hash_bytes(e->text, e->len));
        }
    }
}

void strpool_init(struct strpool *pool, struct arena *arena, const struct strpool *base)
{
    *pool = (struct strpool){.base = base, .arena = arena};
    if (base) {
        pool->first = base->first + base->num;
        return;
    }
    vec_push(arena, &pool->entries, (struct str_entry){"", 0});
    pool->num = 1;
    static const char *const words[] = {
#define WORD(id, text) text,
#include "base/words.def"
#undef WORD
    };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        str_intern_z(pool, words[i]);
    assert(pool->num == STR_NUM_WORDS); /* words.def has a duplicate word */
}
