// SPDX-License-Identifier: Apache-2.0
#include "program/name_table.h"

#include "program/memory.h"

#include <assert.h>
#include <stdlib.h>

uint64_t names_hash(uint64_t hash, const char *text)
{
    for (; *text; ++text)
        hash = (hash ^ (unsigned char)*text) * 0x100000001b3u;
    return hash;
}

/* The entry for a hash, or the free entry for it. */
static struct name_entry *place_of(const struct name_table *table, uint64_t hash)
{
    assert(table->num_entries < table->capacity);
    size_t at = (size_t)hash & (table->capacity - 1);
    while (table->entries[at].hash && table->entries[at].hash != hash)
        at = (at + 1) & (table->capacity - 1);
    return &table->entries[at];
}

static void grow(struct name_table *table)
{
    struct name_table larger = {.num_entries = table->num_entries,
                                .capacity = table->capacity ? table->capacity * 2 : 64};
    larger.entries = memory_alloc(larger.capacity * sizeof *larger.entries);
    for (size_t i = 0; i < table->capacity; ++i)
        if (table->entries[i].hash)
            *place_of(&larger, table->entries[i].hash) = table->entries[i];
    free(table->entries);
    *table = larger;
}

struct name_entry *names_add_hash(struct name_table *table, uint64_t hash, bool *out_is_new)
{
    hash += hash == 0;
    if (table->num_entries * 2 >= table->capacity)
        grow(table);
    struct name_entry *entry = place_of(table, hash);
    *out_is_new = entry->hash == 0;
    table->num_entries += *out_is_new;
    entry->hash = hash;
    return entry;
}

struct name_entry *names_add(struct name_table *table, const char *name, bool *out_is_new)
{
    return names_add_hash(table, names_hash(NAMES_HASH_OF_NOTHING, name), out_is_new);
}

struct name_entry *names_find_hash(const struct name_table *table, uint64_t hash)
{
    struct name_entry *entry = table->capacity ? place_of(table, hash + (hash == 0)) : NULL;
    return entry && entry->hash ? entry : NULL;
}

struct name_entry *names_find(const struct name_table *table, const char *name)
{
    return names_find_hash(table, names_hash(NAMES_HASH_OF_NOTHING, name));
}

void names_finish(struct name_table *table)
{
    free(table->entries);
    *table = (struct name_table){0};
}
