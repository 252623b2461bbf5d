// SPDX-License-Identifier: Apache-2.0
#include "base/strpool.h"

#include "base/hash.h"

static inline bool is_own_text(const struct strpool *pool, str_id id, const char *text, size_t len,
                               uint32_t hash)
{
    const struct str_entry *e = &pool->entries.items[id - pool->first];
    return e->hash == hash && e->len == len && memcmp(e->text, text, len) == 0;
}

static inline bool is_image_text(const struct strpool *pool, str_id id, const char *text,
                                 size_t len)
{
    const uint32_t *at = &pool->offsets[id - pool->first];
    return at[1] - at[0] - 1 == len && memcmp(pool->bytes + at[0], text, len) == 0;
}

static str_id find_in_image(const struct strpool *pool, const char *text, size_t len, uint32_t hash)
{
    const uint32_t *wide = pool->table;
    const uint16_t *narrow = pool->narrow;
    uint32_t mask = pool->table_mask, slot = hash & mask;
    str_id id;
    if (narrow)
        while ((id = narrow[slot]) && !is_image_text(pool, id, text, len))
            slot = (slot + 1) & mask;
    else
        while ((id = wide[slot]) && !is_image_text(pool, id, text, len))
            slot = (slot + 1) & mask;
    return id;
}

static str_id find_hashed(const struct strpool *pool, const char *text, size_t len, uint32_t hash)
{
    for (; pool; pool = pool->base) {
        if (pool->offsets)
            return find_in_image(pool, text, len, hash); /* an image has no base */
        if (!pool->table)
            continue;
        str_id id;
        for (uint32_t slot = hash & pool->table_mask; (id = pool->table[slot]);
             slot = (slot + 1) & pool->table_mask)
            if (is_own_text(pool, id, text, len, hash))
                return id;
    }
    return 0;
}

str_id str_find(const struct strpool *pool, const char *text, size_t len)
{
    return len ? find_hashed(pool, text, len, hash_bytes(text, len)) : 0;
}

static void grow_table(struct strpool *pool)
{
    uint32_t slots = pool->table ? (pool->table_mask + 1) * 2 : 64;
    uint32_t *table = ARENA_ARRAY(pool->arena, uint32_t, slots);
    for (uint32_t i = 0; i < pool->entries.len; i++) {
        if (pool->first + i == 0)
            continue;
        uint32_t slot = pool->entries.items[i].hash & (slots - 1);
        while (table[slot])
            slot = (slot + 1) & (slots - 1);
        table[slot] = pool->first + i;
    }
    pool->table = table;
    pool->table_mask = slots - 1;
}

static str_id add(struct strpool *pool, const char *text, size_t len, uint32_t hash)
{
    if (len > UINT32_MAX - 1 || pool->first + pool->num == UINT32_MAX)
        mem_fail(pool->arena->mem);
    if (!pool->table || (pool->num + 1) * 4 > (pool->table_mask + 1) * 3)
        grow_table(pool);
    str_id id = pool->first + pool->num;
    vec_push(pool->arena, &pool->entries,
             (struct str_entry){arena_strndup(pool->arena, text, len), (uint32_t)len, hash});
    pool->num++;
    uint32_t *table = (uint32_t *)(uintptr_t)pool->table; /* a growing pool owns its table */
    uint32_t slot = hash & pool->table_mask;
    while (table[slot])
        slot = (slot + 1) & pool->table_mask;
    table[slot] = id;
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

void strpool_init(struct strpool *pool, struct arena *arena, const struct strpool *base)
{
    *pool = (struct strpool){.base = base, .arena = arena};
    if (base) {
        pool->first = base->first + base->num;
        return;
    }
    vec_push(arena, &pool->entries, (struct str_entry){"", 0, 0});
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
