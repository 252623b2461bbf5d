// SPDX-License-Identifier: Apache-2.0
/*
 * KHR_materials_variants as looks: each assigns a material to each primitive, by the paths that
 * `--stage` gives to the same file (render/site_import.c).
 */
#include "import/import.h"
#include "program/memory.h"
#include "program/node_path.h"

#include <stdlib.h>
#include <string.h>

static const char extension[] = "KHR_materials_variants";

/* Paths with commas between them. */
struct geom {
    char *text;
    size_t len, capacity;
};

struct walk {
    const struct gltf_source *source;
    struct name_table paths;
    struct geom *geoms; /* of a look by material, then of the next one */
    size_t num_looks, num_materials;
};

/* A node to visit, with the path of its parent. */
struct visit {
    size_t node;
    char *parent;
};

/* Names as Assimp has them. */
static char *name_of(const json_t *object, const char *array, size_t index)
{
    const char *name = json_text_of(object, "name");
    return *name ? cli_format("%s", name) : cli_format("%s[%zu]", array, index);
}

/* ---- Materials ---- */

/* True if the mapping of a material is for the variant of a look. */
static bool is_mapped(const json_t *mapping, size_t look)
{
    const json_t *variants = json_object_get(mapping, "variants");
    for (size_t i = 0; i < json_array_size(variants); ++i) {
        const json_t *variant = json_array_get(variants, i);
        if (json_is_integer(variant) && json_integer_value(variant) == (json_int_t)look)
            return true;
    }
    return false;
}

/* The material of a primitive in a look; SIZE_MAX: none. */
static size_t material_of(const json_t *primitive, size_t look)
{
    const json_t *mappings = json_object_get(
        json_object_get(json_object_get(primitive, "extensions"), extension), "mappings");
    for (size_t i = 0; i < json_array_size(mappings); ++i)
        if (is_mapped(json_array_get(mappings, i), look))
            return gltf_index_of(json_array_get(mappings, i), "material");
    return gltf_index_of(primitive, "material");
}

static void append(struct geom *geom, const char *path)
{
    size_t len = strlen(path);
    if (geom->len + len + 3 > geom->capacity) {
        geom->capacity = 2 * geom->capacity + len + 3;
        geom->text = memory_resize(geom->text, geom->capacity);
    }
    geom->len += (size_t)sprintf(geom->text + geom->len, "%s%s", geom->len ? ", " : "", path);
}

static void add_primitive(struct walk *walk, const json_t *primitive, const char *path)
{
    for (size_t look = 0; look < walk->num_looks; ++look) {
        size_t material = material_of(primitive, look);
        if (material < walk->num_materials)
            append(&walk->geoms[look * walk->num_materials + material], path);
    }
}

/* A mesh with one primitive is that of its node; others have one below it for each. */
static void add_mesh(struct walk *walk, size_t index, const char *path)
{
    const json_t *mesh = gltf_source_item(walk->source, "meshes", index),
                 *primitives = json_object_get(mesh, "primitives");
    size_t num = json_array_size(primitives);
    char *name = name_of(mesh, "meshes", index);
    for (size_t i = 0; i < num; ++i) {
        char *part = cli_format("%s-%zu", name, i),
             *below = num > 1 ? node_path_add(&walk->paths, path, part) : NULL;
        add_primitive(walk, json_array_get(primitives, i), below ? below : path);
        free(part);
        free(below);
    }
    free(name);
}

/* ---- Nodes ---- */

struct visits {
    struct visit *items;
    size_t len, capacity;
};

/* Adds a list of nodes, the first of which is visited first. */
static void push(struct visits *visits, const json_t *nodes, const char *parent)
{
    for (size_t i = json_array_size(nodes); i-- > 0;) {
        const json_t *node = json_array_get(nodes, i);
        if (!json_is_integer(node) || json_integer_value(node) < 0)
            continue;
        if (visits->len == visits->capacity) {
            visits->capacity = 2 * visits->capacity + 16;
            visits->items = memory_resize(visits->items, visits->capacity * sizeof *visits->items);
        }
        visits->items[visits->len++] =
            (struct visit){(size_t)json_integer_value(node), cli_format("%s", parent)};
    }
}

/* A node has one parent, so it is visited once. */
static void visit_nodes(struct walk *walk)
{
    const json_t *root = walk->source->root;
    const size_t num = json_array_size(json_object_get(root, "nodes"));
    const json_t *scene =
        gltf_source_item(walk->source, "scenes", (size_t)json_count_of(root, "scene"));
    bool *are_visited = memory_alloc(num + 1);
    struct visits visits = {0};
    push(&visits, json_object_get(scene, "nodes"), "");
    while (visits.len) {
        struct visit visit = visits.items[--visits.len];
        if (visit.node < num && !are_visited[visit.node]) {
            const json_t *node = gltf_source_item(walk->source, "nodes", visit.node);
            char *name = name_of(node, "nodes", visit.node),
                 *path = node_path_add(&walk->paths, visit.parent, name);
            are_visited[visit.node] = true;
            add_mesh(walk, gltf_index_of(node, "mesh"), path);
            push(&visits, json_object_get(node, "children"), path);
            free(name);
            free(path);
        }
        free(visit.parent);
    }
    free(visits.items);
    free(are_visited);
}

/* ---- Looks ---- */

static void add_look(struct importing *importing, const struct walk *walk, size_t index,
                     const char *wanted)
{
    char *name = import_name(importing, 0, *wanted ? wanted : "look");
    mxg_element look = mxg_edit_add_element(importing->edit, 0, "look", name, NULL);
    for (size_t i = 0; i < walk->num_materials; ++i) {
        const struct geom *geom = &walk->geoms[index * walk->num_materials + i];
        if (!geom->len)
            continue;
        char *assign = import_name(importing, look, importing->materials[i]);
        mxg_element element =
            mxg_edit_add_element(importing->edit, look, "materialassign", assign, NULL);
        mxg_edit_set_attribute(importing->edit, element, "material", importing->materials[i]);
        mxg_edit_set_attribute(importing->edit, element, "geom", geom->text);
        free(assign);
    }
    free(name);
}

void import_add_looks(struct importing *importing)
{
    const struct gltf_source *source = &importing->source;
    const json_t *variants = json_object_get(
        json_object_get(json_object_get(source->root, "extensions"), extension), "variants");
    struct walk walk = {.source = source,
                        .num_looks = json_array_size(variants),
                        .num_materials = importing->num_materials};
    const size_t num = walk.num_looks * walk.num_materials;
    if (!num)
        return;
    walk.geoms = memory_alloc(num * sizeof *walk.geoms);
    visit_nodes(&walk);
    for (size_t i = 0; i < walk.num_looks; ++i)
        add_look(importing, &walk, i, json_text_of(json_array_get(variants, i), "name"));
    for (size_t i = 0; i < num; ++i)
        free(walk.geoms[i].text);
    free(walk.geoms);
    names_finish(&walk.paths);
}
