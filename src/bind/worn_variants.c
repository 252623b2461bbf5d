// SPDX-License-Identifier: Apache-2.0
/* The variants that apply to the materials of assignments. */
#include "bind/bind.h"
#include "bind/substance.h"

#include "base/hash.h"

/* A material with the variants of the look that apply to it. */
struct known_material {
    elem_id target;
    struct substance substance;
    struct variant_list variants;
};

struct applying {
    struct bind_look *look;
    VEC(struct known_material *) known;
    struct table table; /* of `known`, by target */
    bool is_restricted; /* a set is for some nodes alone, so that substances are needed */
};

/* The variants of a set exclude each other: the last one that is assigned counts alone. */
static void add_variant(struct variant_list *list, const struct look_variant *variant,
                        struct arena *arena)
{
    uint32_t num = 0;
    for (uint32_t i = 0; i < list->len; i++)
        if (list->items[i].set != variant->set)
            list->items[num++] = list->items[i];
    list->len = num;
    vec_push(arena, list, *variant);
}

static bool is_restricted(const struct bind_look *look, elem_id set)
{
    return doc_attr_value(look->doc, set, STR_node) || doc_attr_value(look->doc, set, STR_nodedef);
}

static void add_variants(struct applying *a, struct known_material *material, uint32_t first,
                         uint32_t num, struct variant_list *list)
{
    for (uint32_t i = first; i < first + num; i++) {
        const struct look_variant *variant = &a->look->variants.items[i];
        if (!is_restricted(a->look, variant->set)
            || substance_set_applies(&material->substance, variant->set))
            add_variant(list, variant, a->look->arena);
    }
}

static struct known_material *know(struct applying *a, elem_id target)
{
    uint32_t hash = hash_pair(target, 0);
    for (uint32_t at = hash, found; (found = table_next(&a->table, hash, &at));)
        if (a->known.items[found - 1]->target == target)
            return a->known.items[found - 1];
    struct known_material *material = ARENA_NEW(a->look->arena, struct known_material);
    material->target = target;
    if (a->is_restricted)
        substance_find(&material->substance, a->look->lib, target, a->look->arena);
    vec_push(a->look->arena, &a->known, material);
    table_add(&a->table, a->look->arena, hash, a->known.len);
    add_variants(a, material, 0, a->look->num_look_variants, &material->variants);
    return material;
}

static void apply_to(struct applying *a, struct look_assign *assign)
{
    struct known_material *material = know(a, assign->target);
    struct variant_list *list = &assign->variants;
    if (!assign->num_variants) {
        *list = material->variants; /* which such assignments share */
        return;
    }
    for (uint32_t i = 0; i < material->variants.len; i++)
        vec_push(a->look->arena, list, material->variants.items[i]);
    add_variants(a, material, assign->first_variant, assign->num_variants, list);
}

void look_apply_variants(struct bind_look *look)
{
    struct applying a = {.look = look};
    for (uint32_t i = 0; i < look->variants.len; i++)
        a.is_restricted |= is_restricted(look, look->variants.items[i].set);
    for (uint32_t i = 0; look->variants.len && i < look->assigns.len; i++) {
        struct look_assign *assign = &look->assigns.items[i];
        if (assign->target && assign->kind != ASSIGN_GRAPH)
            apply_to(&a, assign);
    }
}
