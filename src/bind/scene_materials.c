// SPDX-License-Identifier: Apache-2.0
/*
 * The materials of a stage and their names. Materials are prims: two of one name at two paths are
 * two materials. A document has no paths, so each gets a name of its own there.
 */
#include "bind/primitives.h"

#include "base/hash.h"

static bool is_same(struct text_word a, struct text_word b)
{
    return a.len == b.len && memcmp(a.bytes, b.bytes, a.len) == 0;
}

static struct text_word name_of(const struct scene *scene, const struct scene_material *material)
{
    return scene->layer.prims.items[material->prim].name;
}

const struct scene_material *scene_namesakes(const struct scene *scene, struct text_word name)
{
    uint32_t hash = hash_bytes(name.bytes, name.len);
    for (uint32_t at = hash, found; (found = table_next(&scene->namesakes, hash, &at));)
        if (is_same(name_of(scene, &scene->materials.items[found - 1]), name))
            return &scene->materials.items[found - 1];
    return NULL;
}

const struct scene_material *scene_next_namesake(const struct scene *scene,
                                                 const struct scene_material *material)
{
    return material->next ? &scene->materials.items[material->next - 1] : NULL;
}

/* Adds a prim to those of its name. */
static void add_material(struct scene *scene, usda_prim_id prim, bool is_graph)
{
    struct text_word name = scene->layer.prims.items[prim].name;
    const struct scene_material *found = scene_namesakes(scene, name);
    uint32_t first = found ? (uint32_t)(found - scene->materials.items) : scene->materials.len;
    vec_push(scene->arena, &scene->materials,
             (struct scene_material){.prim = prim, .is_graph = is_graph});
    uint32_t added = scene->materials.len;
    struct scene_material *head = &scene->materials.items[first];
    if (found)
        scene->materials.items[head->last - 1].next = added;
    else
        table_add(&scene->namesakes, scene->arena, hash_bytes(name.bytes, name.len), added);
    head->last = added;
    head->num += 1;
    head->num_graphs += is_graph;
    table_add(&scene->material_prims, scene->arena, hash_pair(prim, 0), added);
}

const struct scene_material *scene_material_named(const struct scene *scene, const char *name)
{
    uint32_t hash = hash_bytes(name, strlen(name));
    for (uint32_t at = hash, found; (found = table_next(&scene->material_names, hash, &at));)
        if (strcmp(scene->materials.items[found - 1].name, name) == 0)
            return &scene->materials.items[found - 1];
    return NULL;
}

/* The path of a prim with '_' in the place of '/', and a number behind one that is taken. */
static const char *long_name(struct scene *scene, usda_prim_id prim)
{
    struct text text;
    text_init(&text, scene->arena);
    usda_join(&scene->layer, prim, '_', &text);
    size_t len = text.len;
    for (unsigned suffix = 2;; suffix++) {
        const struct text_word name = {text_cstr(&text), text.len};
        if (!scene_material_named(scene, name.bytes) && !scene_namesakes(scene, name))
            return name.bytes;
        text.len = len;
        text_fmt(&text, "_%u", suffix);
    }
}

void scene_name_materials(struct scene *scene)
{
    for (usda_prim_id prim = 1; prim < scene->layer.prims.len; prim++) {
        const struct usda_prim *at = &scene->layer.prims.items[prim];
        bool is_graph = usda_is(at->type, "NodeGraph");
        if ((is_graph || usda_is(at->type, "Material")) && !at->is_variant && !at->is_inactive)
            add_material(scene, prim, is_graph);
    }
    for (uint32_t i = 0; i < scene->materials.len; i++) {
        struct scene_material *material = &scene->materials.items[i];
        struct text_word name = name_of(scene, material);
        const struct scene_material *head = scene_namesakes(scene, name);
        bool is_alone = material->is_graph ? head->num == 1 : head->num - head->num_graphs == 1;
        material->name = is_alone ? arena_strndup(scene->arena, name.bytes, name.len)
                                  : long_name(scene, material->prim);
        table_add(&scene->material_names, scene->arena,
                  hash_bytes(material->name, strlen(material->name)), i + 1);
    }
}

const struct scene_material *scene_material_at(const struct scene *scene, struct text_word path)
{
    usda_prim_id prim = usda_find_composed(&scene->layer, path.bytes, path.len);
    uint32_t hash = hash_pair(prim, 0);
    for (uint32_t at = hash, found;
         prim && (found = table_next(&scene->material_prims, hash, &at));)
        if (scene->materials.items[found - 1].prim == prim)
            return &scene->materials.items[found - 1];
    return NULL;
}
