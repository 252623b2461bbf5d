// SPDX-License-Identifier: Apache-2.0
#include "validate/structures.h"

#include <stdlib.h>
#include <string.h>

enum { FIRST_CAPACITY = 1 << 8, MAX_CAPACITY = 1 << 16 };

static uint64_t *find(const struct structures *structures, uint64_t structure)
{
    size_t mask = structures->capacity - 1, at = (size_t)structure & mask;
    while (structures->items[at] && structures->items[at] != structure)
        at = (at + 1) & mask;
    return &structures->items[at];
}

bool structures_have(const struct structures *structures, uint64_t structure)
{
    return structure && structures->capacity && *find(structures, structure);
}

static bool make_room(struct structures *structures)
{
    struct structures old = *structures,
                      grown = {.capacity = old.capacity ? old.capacity * 2 : FIRST_CAPACITY};
    if (old.capacity == MAX_CAPACITY) {
        memset(old.items, 0, old.capacity * sizeof *old.items);
        structures->len = 0;
        return true;
    }
    grown.items = calloc(grown.capacity, sizeof *grown.items);
    if (!grown.items)
        return false;
    for (size_t i = 0; i < old.capacity; ++i)
        if (old.items[i])
            *find(&grown, old.items[i]) = old.items[i];
    grown.len = old.len;
    free(old.items);
    *structures = grown;
    return true;
}

void structures_add(struct structures *structures, uint64_t structure)
{
    if (!structure || (structures->len * 2 >= structures->capacity && !make_room(structures)))
        return;
    uint64_t *place = find(structures, structure);
    structures->len += *place == 0;
    *place = structure;
}

void structures_finish(struct structures *structures)
{
    free(structures->items);
    *structures = (struct structures){0};
}
