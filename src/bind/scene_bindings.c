// SPDX-License-Identifier: Apache-2.0
/* The bindings of a scene: those that a file brings, and those of a host, which come and go. */
#include "bind/primitives.h"

#include <assert.h>

/* Puts a binding behind the others of its primitive. */
static void link_binding(struct scene *scene, uint32_t index)
{
    struct scene_binding *items = scene->bindings.items;
    prim_id prim = items[index].prim;
    while (scene->last_binding.len <= prim)
        vec_push(scene->arena, &scene->last_binding, 0);
    while (scene->first_binding.len <= prim)
        vec_push(scene->arena, &scene->first_binding, 0);
    uint32_t *last = &scene->last_binding.items[prim];
    *(*last ? &items[*last - 1].next : &scene->first_binding.items[prim]) = index + 1;
    *last = index + 1;
    items[index].next = 0;
    scene->num_bindings++;
}

uint32_t scene_add_binding(struct scene *scene, struct scene_binding binding)
{
    uint32_t index = scene->removed_binding;
    assert(!binding.is_removed);
    if (index) {
        scene->removed_binding = scene->bindings.items[--index].next;
        scene->bindings.items[index] = binding;
    } else {
        index = scene->bindings.len;
        vec_push(scene->arena, &scene->bindings, binding);
    }
    link_binding(scene, index);
    return index;
}

/* Removes the direct bindings of a name. */
static void remove_bindings(struct scene *scene, prim_id prim, struct text_word name)
{
    struct scene_binding *items = scene->bindings.items;
    if (!scene_first_binding(scene, prim))
        return;
    uint32_t *link = &scene->first_binding.items[prim], last = 0;
    while (*link) {
        uint32_t index = *link - 1;
        struct scene_binding *binding = &items[index];
        if (binding->is_collection || strlen(binding->name) != name.len
            || memcmp(binding->name, name.bytes, name.len) != 0) {
            link = &binding->next;
            last = index + 1;
            continue;
        }
        *link = binding->next;
        *binding = (struct scene_binding){.is_removed = true, .next = scene->removed_binding};
        scene->removed_binding = index + 1;
        scene->num_bindings--;
    }
    scene->last_binding.items[prim] = last;
}

void scene_unbind_all(struct scene *scene, prim_id prim)
{
    struct scene_binding *items = scene->bindings.items;
    for (uint32_t at = scene_first_binding(scene, prim), next; at; at = next) {
        next = items[at - 1].next;
        items[at - 1] = (struct scene_binding){.is_removed = true, .next = scene->removed_binding};
        scene->removed_binding = at;
        scene->num_bindings--;
        scene->first_binding.items[prim] = next;
        if (!next)
            scene->last_binding.items[prim] = 0;
    }
}

/* The whole name of a slot; valid until the next call. */
static struct text_word write_name(struct scene *scene, const struct slot_name *slot)
{
    scene->written.len = 0;
    slot_write(slot, &scene->written);
    return (struct text_word){scene->written.data, scene->written.len};
}

void scene_write_binding(const struct scene *scene, const struct scene_binding *binding,
                         struct text *out)
{
    scene_path(scene, binding->prim, out);
    text_fmt(out, ".%s", binding->property);
}

/* "material:slotBinding:_050", as in a file. */
static struct text_word write_property(struct scene *scene, const struct slot_name *slot)
{
    scene->written.len = 0;
    text_str(&scene->written, "material:slotBinding:");
    slot_encode(slot, &scene->written);
    return (struct text_word){scene->written.data, scene->written.len};
}

void scene_bind(struct scene *scene, prim_id prim, const struct slot_name *slot,
                const char *material)
{
    struct text_word given = {material, strlen(material)};
    struct scene_binding added = {.prim = prim};
    added.material = scene_keep_word(scene, given);
    added.property = scene_keep_word(scene, write_property(scene, slot));
    added.name = scene_keep_word(scene, write_name(scene, slot));
    remove_bindings(scene, prim, write_name(scene, slot));
    scene_add_binding(scene, added);
}

void scene_unbind(struct scene *scene, prim_id prim, const struct slot_name *slot)
{
    remove_bindings(scene, prim, write_name(scene, slot));
}
