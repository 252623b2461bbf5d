// SPDX-License-Identifier: Apache-2.0
#include "import/gltf_nodes.h"

#include "program/memory.h"
#include "program/node_path.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_DEPTH = 1000, PATH_WORK = 16 /* of a byte of a path, which stages look up by name */ };

/* A node to visit, with those above it. */
struct visit {
    size_t node, parent;
    const char *path; /* of the parent */
    unsigned depth;
};

struct visits {
    struct visit *items;
    size_t len;
};

/* ---- Paths ---- */

/* A path of its own below another one. NULL after a fault. */
static const char *add_path(struct gltf_nodes *nodes, const char *parent, const char *name)
{
    if (!gltf_source_spend(nodes->source, PATH_WORK * (strlen(parent) + strlen(name) + 1)))
        return NULL;
    return MEMORY_PUSH(nodes->paths, nodes->num_paths, node_path_add(&nodes->known, parent, name));
}

/* A name, or "nodes[3]". */
static char *name_of(const json_t *object, const char *array, size_t index)
{
    const char *name = json_text_of(object, "name");
    return *name ? cli_format("%s", name) : cli_format("%s[%zu]", array, index);
}

const char *gltf_nodes_add_part(struct gltf_nodes *nodes, const struct gltf_node *node,
                                size_t primitive)
{
    size_t index = gltf_index_of(node->json, "mesh");
    const json_t *mesh = gltf_source_item(nodes->source, "meshes", index);
    if (json_array_size(json_object_get(mesh, "primitives")) < 2)
        return node->path;
    char *name = name_of(mesh, "meshes", index), *part = cli_format("%s-%zu", name, primitive);
    const char *path = add_path(nodes, node->path, part);
    free(part);
    free(name);
    return path;
}

/* ---- The walk ---- */

/* Adds a list of nodes, the first of which is visited first. */
static void push(struct visits *visits, const json_t *list, struct visit below)
{
    for (size_t i = json_array_size(list); i-- > 0;) {
        const json_t *node = json_array_get(list, i);
        bool is_index = json_is_integer(node) && json_integer_value(node) >= 0;
        below.node = is_index ? (size_t)json_integer_value(node) : SIZE_MAX;
        MEMORY_PUSH(visits->items, visits->len, below);
    }
}

/* A node has one parent, so it is visited once. */
static bool is_new(struct gltf_source *source, const struct visit *visit, bool *are_visited,
                   size_t num)
{
    if (visit->node >= num)
        return gltf_source_fail(
            source, "a list of children, or its scene, has a node that is none of its %zu", num);
    if (are_visited[visit->node])
        return gltf_source_fail(source, "nodes[%zu] stands below two nodes, or below itself",
                                visit->node);
    return are_visited[visit->node] = true;
}

static bool walk(struct gltf_nodes *nodes, struct visits *visits, bool *are_visited,
                 bool (*visit)(void *user_data, const struct gltf_node *node), void *user_data)
{
    struct gltf_source *source = nodes->source;
    const size_t num = json_array_size(json_object_get(source->root, "nodes"));
    while (visits->len) {
        struct visit at = visits->items[--visits->len];
        if (at.depth > MAX_DEPTH)
            return gltf_source_fail(source, "its nodes are nested more than %d deep", MAX_DEPTH);
        if (!is_new(source, &at, are_visited, num))
            continue;
        struct gltf_node node = {at.node, at.parent, gltf_source_item(source, "nodes", at.node),
                                 NULL};
        char *name = name_of(node.json, "nodes", at.node);
        node.path = add_path(nodes, at.path, name);
        free(name);
        if (!node.path)
            return false;
        if (!visit(user_data, &node))
            return false;
        push(visits, json_object_get(node.json, "children"),
             (struct visit){.parent = at.node, .path = node.path, .depth = at.depth + 1});
    }
    return true;
}

bool gltf_nodes_walk(struct gltf_nodes *nodes, struct gltf_source *source,
                     bool (*visit)(void *user_data, const struct gltf_node *node), void *user_data)
{
    const json_t *scene =
        gltf_source_item(source, "scenes", (size_t)json_count_of(source->root, "scene"));
    bool *are_visited = memory_alloc(json_array_size(json_object_get(source->root, "nodes")) + 1);
    struct visits visits = {0};
    *nodes = (struct gltf_nodes){.source = source};
    push(&visits, json_object_get(scene, "nodes"),
         (struct visit){.parent = SIZE_MAX, .path = "", .depth = 1});
    bool good = walk(nodes, &visits, are_visited, visit, user_data);
    free(visits.items);
    free(are_visited);
    return good;
}

void gltf_nodes_finish(struct gltf_nodes *nodes)
{
    for (size_t i = 0; i < nodes->num_paths; ++i)
        free(nodes->paths[i]);
    free(nodes->paths);
    names_finish(&nodes->known);
}
