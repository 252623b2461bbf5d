// SPDX-License-Identifier: Apache-2.0
#include "program/names.h"

#include "program/cli.h"
#include "program/memory.h"

#include <assert.h>
#include <stdlib.h>

static uint64_t hash_of(const char *name)
{
    uint64_t hash = cli_hash(CLI_HASH_OF_NOTHING, name);
    return hash ? hash : 1;
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

struct name_entry *names_add(struct name_table *table, const char *name, bool *out_is_new)
{
    if (table->num_entries * 2 >= table->capacity)
        grow(table);
    struct name_entry *entry = place_of(table, hash_of(name));
    *out_is_new = entry->hash == 0;
    table->num_entries += *out_is_new;
    entry->hash = hash_of(name);
    return entry;
}

struct name_entry *names_find(const struct name_table *table, const char *name)
{
    struct name_entry *entry = table->capacity ? place_of(table, hash_of(name)) : NULL;
    return entry && entry->hash ? entry : NULL;
}

void names_finish(struct name_table *table)
{
    free(table->entries);
    *table = (struct name_table){0};
}
