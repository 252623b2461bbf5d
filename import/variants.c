// SPDX-License-Identifier: Apache-2.0
/*
 * KHR_materials_variants as looks: each assigns a material to each primitive, by the paths that
 * `--stage` gives to the same file (import/gltf_nodes.c).
 */
#include "import/gltf_nodes.h"
#include "import/import.h"
#include "program/memory.h"

#include <stdlib.h>
#include <string.h>

static const char extension[] = "KHR_materials_variants";

/* A primitive has a material in a look. */
struct assigned {
    size_t look, material, order;
    const char *path;
};

struct walk {
    struct importing *importing;
    struct gltf_nodes nodes;
    struct assigned *items;
    size_t num_items;
    size_t *mapped_by; /* by look: the number of the last primitive that maps it */
    size_t num_primitives, num_looks, num_materials;
    size_t left; /* bytes of assignments that the document may still have */
    bool is_full;
};

/* ---- Limits ---- */

/* False: the looks are too large, because each may assign to all primitives. */
static bool spend(struct walk *walk, size_t size)
{
    walk->is_full = walk->is_full || size > walk->left;
    walk->left -= walk->is_full ? 0 : size;
    return !walk->is_full;
}

/* ---- Primitives ---- */

static void assign(struct walk *walk, size_t look, size_t material, const char *path)
{
    struct assigned assigned = {look, material, walk->num_items, path};
    if (material < walk->num_materials && spend(walk, strlen(path) + sizeof assigned))
        MEMORY_PUSH(walk->items, walk->num_items, assigned);
}

/* The first mapping of a variant counts; a look without one has the primitive's own material. */
static void add_primitive(struct walk *walk, const json_t *primitive, const char *path)
{
    const json_t *own = json_object_get(json_object_get(primitive, "extensions"), extension),
                 *mappings = json_object_get(own, "mappings");
    ++walk->num_primitives;
    for (size_t m = 0; m < json_array_size(mappings); ++m) {
        const json_t *mapping = json_array_get(mappings, m),
                     *variants = json_object_get(mapping, "variants");
        size_t material = gltf_index_of(mapping, "material");
        for (size_t i = 0; i < json_array_size(variants); ++i) {
            const json_t *variant = json_array_get(variants, i);
            size_t look = json_is_integer(variant) ? (size_t)json_integer_value(variant) : SIZE_MAX;
            if (look >= walk->num_looks || walk->mapped_by[look] == walk->num_primitives)
                continue;
            walk->mapped_by[look] = walk->num_primitives;
            assign(walk, look, material, path);
        }
    }
    size_t material = gltf_index_of(primitive, "material");
    for (size_t look = 0; look < walk->num_looks && material < walk->num_materials; ++look)
        if (walk->mapped_by[look] != walk->num_primitives && !walk->is_full)
            assign(walk, look, material, path);
}

static bool visit_node(void *user_data, const struct gltf_node *node)
{
    struct walk *walk = user_data;
    const json_t *mesh = gltf_source_item(&walk->importing->source, "meshes",
                                          gltf_index_of(node->json, "mesh")),
                 *primitives = json_object_get(mesh, "primitives");
    for (size_t i = 0; i < json_array_size(primitives) && !walk->is_full; ++i) {
        const char *path = gltf_nodes_add_part(&walk->nodes, node, i);
        if (!path)
            return false;
        add_primitive(walk, json_array_get(primitives, i), path);
    }
    return !walk->is_full;
}

/* ---- Looks ---- */

static int compare(const void *a, const void *b)
{
    const struct assigned *one = a, *other = b;
    return one->look != other->look           ? (one->look < other->look ? -1 : 1)
           : one->material != other->material ? (one->material < other->material ? -1 : 1)
           : one->order < other->order        ? -1
                                              : one->order > other->order;
}

/* Assigns a material to the primitives of some items, which differ in their paths alone. */
static void add_assign(struct importing *importing, mxg_element look, const struct assigned *items,
                       size_t num)
{
    const char *material = importing->materials[items->material];
    char *name = import_name(importing, look, material);
    mxg_element element = mxg_edit_add_element(importing->edit, look, "materialassign", name, NULL);
    size_t size = 1, len = 0;
    for (size_t i = 0; i < num; ++i)
        size += strlen(items[i].path) + 2;
    char *geom = memory_alloc(size);
    for (size_t i = 0; i < num; ++i)
        len += (size_t)sprintf(geom + len, "%s%s", i ? ", " : "", items[i].path);
    mxg_edit_set_attribute(importing->edit, element, "material", material);
    mxg_edit_set_attribute(importing->edit, element, "geom", geom);
    free(geom);
    free(name);
}

/* Adds a look with the items from `first` on. Returns the first item of the next look. */
static size_t add_look(const struct walk *walk, size_t index, const char *wanted, size_t first)
{
    struct importing *importing = walk->importing;
    char *name = import_name(importing, 0, *wanted ? wanted : "look");
    mxg_element look = mxg_edit_add_element(importing->edit, 0, "look", name, NULL);
    while (first < walk->num_items && walk->items[first].look == index) {
        size_t end = first;
        while (end < walk->num_items && walk->items[end].look == index
               && walk->items[end].material == walk->items[first].material)
            ++end;
        add_assign(importing, look, walk->items + first, end - first);
        first = end;
    }
    free(name);
    return first;
}

static void finish(struct walk *walk)
{
    gltf_nodes_finish(&walk->nodes);
    free(walk->items);
    free(walk->mapped_by);
}

void import_add_looks(struct importing *importing)
{
    struct cli *cli = importing->cli;
    const json_t *own = json_object_get(importing->source.root, "extensions"),
                 *variants = json_object_get(json_object_get(own, extension), "variants");
    struct walk walk = {.importing = importing,
                        .num_looks = json_array_size(variants),
                        .num_materials = importing->num_materials,
                        .left = cli_max_output_size(cli) << 20};
    if (!walk.num_looks || !walk.num_materials)
        return;
    walk.mapped_by = memory_alloc(walk.num_looks * sizeof *walk.mapped_by);
    bool good = gltf_nodes_walk(&walk.nodes, &importing->source, visit_node, &walk);
    if (walk.is_full)
        report_error(&cli->report, "output-limit",
                     "the looks have more than %zu MiB; raise the limit 'max-output-size' if this "
                     "is intended",
                     cli_max_output_size(cli));
    else if (!good)
        report_error(&cli->report, "import-file", "cannot read '%s': %s", importing->source.path,
                     importing->source.fault);
    else if (walk.num_items)
        qsort(walk.items, walk.num_items, sizeof *walk.items, compare);
    for (size_t i = 0, first = 0; i < walk.num_looks && !cli->report.errors; ++i)
        first = add_look(&walk, i, json_text_of(json_array_get(variants, i), "name"), first);
    finish(&walk);
}
