// SPDX-License-Identifier: Apache-2.0
#include "base/table.h"

#include <assert.h>

enum { FIRST_SLOTS = 16 };

static void put(struct table *table, struct table_slot added)
{
    uint32_t at = added.hash & table->mask;
    while (table->slots[at].number)
        at = (at + 1) & table->mask;
    table->slots[at] = added;
}

/* The old slots are read in order, and land in two runs of the new ones. */
static void resize(struct table *table, struct arena *arena, uint32_t num_slots)
{
    struct table old = *table;
    uint32_t num_old = old.slots ? old.mask + 1 : 0;
    assert((num_slots & (num_slots - 1)) == 0 && num_slots > old.num);
    table->slots = ARENA_ARRAY(arena, struct table_slot, num_slots);
    table->mask = num_slots - 1;
    for (uint32_t i = 0; i < num_old; i++)
        if (old.slots[i].number)
            put(table, old.slots[i]);
    arena_release(arena, old.slots, num_old * sizeof *old.slots);
}

void table_add(struct table *table, struct arena *arena, uint32_t hash, uint32_t number)
{
    assert(number && !table->narrow);
    uint32_t num_slots = table->slots ? table->mask + 1 : 0;
    if (num_slots / 8 * 5 <= table->num) {
        if (num_slots > UINT32_MAX / 2)
            mem_fail(arena->mem);
        resize(table, arena, num_slots ? num_slots * 2 : FIRST_SLOTS);
    }
    put(table, (struct table_slot){hash, number});
    table->num++;
    assert(table->num <= table->mask);
}

void table_replace(struct table *table, uint32_t at, uint32_t number)
{
    struct table_slot *slot = &table->slots[(at - 1) & table->mask];
    assert(number && slot->number);
    slot->number = number;
}

void table_make_room(struct table *table, uint32_t number)
{
    for (uint32_t i = 0; table->slots && i <= table->mask; i++)
        table->slots[i].number += table->slots[i].number >= number;
}

void table_reserve(struct table *table, struct arena *arena, uint32_t num)
{
    uint32_t num_slots = FIRST_SLOTS;
    while (num_slots / 2 < num) {
        if (num_slots > UINT32_MAX / 2)
            mem_fail(arena->mem);
        num_slots *= 2;
    }
    if (!table->slots || num_slots > table->mask + 1)
        resize(table, arena, num_slots);
}
