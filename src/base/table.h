// SPDX-License-Identifier: Apache-2.0
/*
 * The hash table: from keys to numbers, which are indices of the caller's. Open addressing, linear
 * probing. A slot has the hash beside the number, so a search reads a candidate only if all 32 bits
 * agree, and a growing table reads no candidate at all.
 *
 *     for (uint32_t at = hash, found; (found = table_next(&table, hash, &at));)
 *         if (is_equal(found))
 *             return found;
 *     table_add(&table, arena, hash, number);
 */
#ifndef MXG_BASE_TABLE_H
#define MXG_BASE_TABLE_H

#include "base/mem.h"

struct table_slot {
    uint32_t hash, number; /* number 0: the slot is free */
};

struct table { /* all zero: empty */
    struct table_slot *slots;
    const uint16_t *narrow; /* replaces `slots` in an image: numbers of 16 bits without hashes */
    uint32_t mask, num;     /* num: used slots, of `slots` */
};

/*
 * The next number that may have a key of this hash; 0: there is no more. *at is the hash at first.
 * The caller compares the key.
 */
static inline uint32_t table_next(const struct table *table, uint32_t hash, uint32_t *at)
{
    if (!table->slots)
        return table->narrow ? table->narrow[(*at)++ & table->mask] : 0;
    const struct table_slot *slot;
    do
        slot = &table->slots[(*at)++ & table->mask];
    while (slot->number && slot->hash != hash);
    return slot->number;
}

/* Adds a number, which is not 0. Growing takes memory from the arena, always the same one. */
void table_add(struct table *table, struct arena *arena, uint32_t hash, uint32_t number);

/* Another number for the key that table_next has just found. */
void table_replace(struct table *table, uint32_t at, uint32_t number);

/* Makes a number free: those from it on become one greater. */
void table_make_room(struct table *table, uint32_t number);

/* Room for this many numbers with half of the slots free. */
void table_reserve(struct table *table, struct arena *arena, uint32_t num);

#endif
