// SPDX-License-Identifier: Apache-2.0
#include "render/twins.h"

#include "program/memory.h"
#include "program/name_table.h"

/* True if two objects have the same values at their vertices. */
static bool are_twins(const struct scene_object *a, const struct scene_object *b)
{
    return a->mesh.vertices == b->mesh.vertices && a->num_primvars == b->num_primvars
           && (!a->num_primvars || a->primvars == b->primvars)
           && a->names_texcoords == b->names_texcoords;
}

uint32_t *twins_find(const struct scene_object *objects, uint32_t num)
{
    struct name_table first = {0};
    uint32_t *twins = memory_alloc(num * sizeof *twins + 1);
    for (uint32_t o = 0; o < num; ++o) {
        bool is_new;
        uint64_t primvars = objects[o].num_primvars ? (uintptr_t)objects[o].primvars : 0;
        struct name_entry *entry = names_add_hash(
            &first, (uintptr_t)objects[o].mesh.vertices * UINT64_C(31) + primvars, &is_new);
        if (is_new)
            entry->value = o + 1;
        else if (are_twins(&objects[o], &objects[entry->value - 1]))
            twins[o] = (uint32_t)entry->value;
    }
    names_finish(&first);
    return twins;
}
