// SPDX-License-Identifier: Apache-2.0
/*
 * The objects of a stage: nodes by their paths, and materials by looks, which are variants
 * (KHR_materials_variants). The first look that shows an object has its material without variants.
 */
#include "export/gltf.h"

#include "program/memory.h"

#include <stdlib.h>
#include <string.h>

static const char extension[] = "KHR_materials_variants";

/* ---- Nodes ---- */

/* The node of a path, "/house/door", made with those above it. */
static json_t *node_at(struct gltf *gltf, struct name_table *nodes, const char *path)
{
    bool is_new;
    struct name_entry *entry = names_add(nodes, path, &is_new);
    json_t *all = gltf_array(gltf->root, "nodes");
    if (!is_new)
        return json_array_get(all, entry->value);
    entry->value = json_array_size(all);
    const json_int_t index = (json_int_t)entry->value;
    const char *name = strrchr(path, '/');
    size_t len = name ? (size_t)(name - path) : 0;
    json_t *node = json_object();
    json_set_text(node, "name", name ? name + 1 : path);
    gltf_append(all, node);
    if (len) {
        char *above = cli_copy(path, len);
        json_t *parent = node_at(gltf, nodes, above);
        json_array_append_new(gltf_array(parent, "children"), json_integer(index));
        free(above);
    } else {
        gltf_add_root(gltf, (size_t)index);
    }
    return node;
}

/* Adds a primitive to the mesh of a node. */
static void add_primitive(struct gltf *gltf, json_t *node, json_t *primitive)
{
    json_t *meshes = gltf_array(gltf->root, "meshes");
    if (!json_object_get(node, "mesh"))
        json_set(node, "mesh", json_integer((json_int_t)gltf_append(meshes, json_object())));
    json_t *mesh = json_array_get(meshes, json_count_of(node, "mesh"));
    json_array_append_new(gltf_array(mesh, "primitives"), primitive);
}

/* ---- Looks ---- */

static void add_variants(struct gltf *gltf)
{
    const struct dressed_site *stage = gltf->writing->stage;
    json_t *variants =
        gltf_array(gltf_object(gltf_object(gltf->root, "extensions"), extension), "variants");
    gltf_add(gltf_array(gltf->root, "extensionsUsed"), json_string(extension));
    for (size_t i = 0; i < stage->num_looks; ++i)
        json_array_append_new(variants, json_pack("{s:s}", "name", stage->looks[i]));
}

/* The number of the material that a look gives to an object; num_materials: none. */
static size_t material_of(const struct gltf *gltf, size_t look, uint32_t object)
{
    return flat_find_material(gltf->flat,
                              dressed_site_dress(gltf->writing->stage, look, object)->material);
}

/* Adds a look to the mapping of its material. */
static void map(json_t *mappings, size_t material, size_t look)
{
    size_t i;
    json_t *mapping, *found = NULL;
    json_array_foreach(mappings, i, mapping) if (json_count_of(mapping, "material") == material)
        found = mapping;
    if (!found) {
        found = json_pack("{s:I}", "material", (json_int_t)material);
        json_array_append_new(mappings, found);
    }
    json_array_append_new(gltf_array(found, "variants"), json_integer((json_int_t)look));
}

/* A variant changes materials alone. */
static void tell_hidden(const struct gltf *gltf, uint32_t object, size_t look)
{
    const struct dressed_site *stage = gltf->writing->stage;
    report_warning(gltf->flat->report, "export-loss",
                   "'%s/%s' (%s) is not in the file as it is: the look hides it, and a variant "
                   "hides nothing",
                   stage->site.objects[object].object.path, stage->looks[look], stage->site.file);
}

/* Sets the material of a primitive, and those of its variants. */
static void dress(struct gltf *gltf, uint32_t object, json_t *primitive)
{
    const struct dressed_site *stage = gltf->writing->stage;
    const size_t none = gltf->flat->num_materials;
    json_t *mappings = json_array();
    size_t first = none;
    for (size_t i = stage->num_looks; i-- > 0;)
        if (!dressed_site_dress(stage, i, object)->is_hidden)
            first = material_of(gltf, i, object);
        else
            tell_hidden(gltf, object, i);
    for (size_t i = 0; i < stage->num_looks; ++i) {
        size_t material = material_of(gltf, i, object);
        if (stage->num_looks > 1 && material < none)
            map(mappings, material, i);
    }
    if (first < none)
        json_set(primitive, "material", json_integer((json_int_t)first));
    if (json_array_size(mappings))
        json_set(gltf_object(gltf_object(primitive, "extensions"), extension), "mappings",
                 mappings);
    else
        json_decref(mappings);
}

/* True if a material that a look gives to the object needs tangents. */
static bool needs_tangents(const struct gltf *gltf, uint32_t object, const bool *tangents)
{
    bool needs = false;
    for (size_t i = 0; i < gltf->writing->stage->num_looks; ++i) {
        size_t material = material_of(gltf, i, object);
        needs |= material < gltf->flat->num_materials && tangents[material];
    }
    return needs;
}

void gltf_add_stage(struct gltf *gltf, const bool *tangents)
{
    const struct dressed_site *stage = gltf->writing->stage;
    struct name_table nodes = {0};
    if (stage->num_looks > 1)
        add_variants(gltf);
    for (uint32_t i = 0; i < stage->site.num_objects; ++i) {
        if (!dressed_site_shows(stage, i))
            continue;
        const struct scene_object *object = &stage->site.objects[i].object;
        json_t *primitive = gltf_make_primitive(gltf, object, needs_tangents(gltf, i, tangents));
        dress(gltf, i, primitive);
        add_primitive(gltf, node_at(gltf, &nodes, object->path), primitive);
    }
    names_finish(&nodes);
}
