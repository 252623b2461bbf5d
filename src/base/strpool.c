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

void strpool_copy(struct strpool *pool, const struct strpool *from)
{
    assert(pool->base == from->base && pool->first == from->first && pool->num == 0);
    assert(!from->offsets && from->num == from->entries.len);
    size_t size = 0;
    for (uint32_t i = 0; i < from->num; i++)
        size += (size_t)from->entries.items[i].len + 1;
    char *text = arena_alloc(pool->arena, size);
    struct str_entry *entries = vec_extend(pool->arena, &pool->entries, from->num);
    for (uint32_t i = 0; i < from->num; i++) {
        entries[i] = (struct str_entry){text, from->entries.items[i].len};
        memcpy(text, from->entries.items[i].text, (size_t)entries[i].len + 1);
        text += (size_t)entries[i].len + 1;
    }
    pool->num = from->num;
    table_copy(&pool->table, pool->arena, &from->table);
}

void strpool_leave_base(struct strpool *pool)
{
    const struct strpool above = *pool, *base = above.base;
    *pool = (struct strpool){.base = base->base, .first = base->first, .arena = above.arena};
    strpool_copy(pool, base);
    for (uint32_t i = 0; i < above.num; i++) {
        const struct str_entry *e = &above.entries.items[i];
        add(pool, e->text, e->len, hash_bytes(e->text, e->len));
    }
    assert(pool->first + pool->num == above.first + above.num);
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
