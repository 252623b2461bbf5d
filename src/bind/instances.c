// SPDX-License-Identifier: Apache-2.0
/*
 * Instances of a PointInstancer that a document names, "/set/forest[12]" (docs/slots.md,
 * "Instances"). A stage may have a million instances, so only these become primitives: one below
 * each primitive of the prototype, whose layers it inherits.
 */
#include "base/hash.h"
#include "base/num.h"
#include "bind/look.h"

#include <stdlib.h>

/* The integers of a property; the arena of the scene keeps them. */
static int64_t *read_integers(struct scene *scene, prim_id prim, const char *name,
                              uint32_t *out_num)
{
    const struct usda_property *property = scene_property(scene, prim, name, NULL);
    struct text_word rest = property ? usda_value(property) : (struct text_word){0}, item;
    VEC(int64_t) numbers = {0};
    for (int64_t number; property && usda_next_item(&rest, &item);)
        if (num_parse_int(item.bytes, item.len, &number) == item.len)
            vec_push(scene->arena, &numbers, number);
    *out_num = numbers.len;
    return numbers.items;
}

static bool is_instancer(const struct scene *scene, prim_id prim)
{
    for (uint32_t i = scene_source(scene, prim); i; i = scene->sources.items[i - 1].next)
        if (usda_is(scene->layer.prims.items[scene->sources.items[i - 1].prim].type,
                    "PointInstancer"))
            return true;
    return false;
}

static int64_t id_of(const struct scene_instancer *instancer, uint32_t number)
{
    return number < instancer->num_ids ? instancer->ids[number] : number;
}

static uint32_t hash_id(int64_t id)
{
    return hash_pair((uint32_t)id, (uint32_t)((uint64_t)id >> 32));
}

/* The number of the first instance with an id; `num`: there is none. */
static uint32_t number_of(const struct scene_instancer *instancer, int64_t id)
{
    uint32_t hash = hash_id(id);
    for (uint32_t at = hash, found; (found = table_next(&instancer->by_id, hash, &at));)
        if (id_of(instancer, found - 1) == id)
            return found - 1;
    return instancer->num;
}

/* The arrays of an instancer, which are read once. */
static const struct scene_instancer *instancer_of(struct scene *scene, prim_id prim)
{
    for (uint32_t i = 0; i < scene->instancers.len; i++)
        if (scene->instancers.items[i].prim == prim)
            return &scene->instancers.items[i];
    struct scene_instancer added = {.prim = prim};
    added.ids = read_integers(scene, prim, "ids", &added.num_ids);
    added.prototypes = read_integers(scene, prim, "protoIndices", &added.num);
    for (uint32_t i = 0; i < added.num; i++)
        table_add(&added.by_id, scene->arena, hash_id(id_of(&added, i)), i + 1);
    vec_push(scene->arena, &scene->instancers, added);
    return &vec_last(&scene->instancers);
}

bool scene_parse_instance(const struct scene *scene, struct text_word name, prim_id *out_instancer,
                          int64_t *out_id)
{
    size_t open = name.len;
    while (open && name.bytes[open - 1] != '[')
        open--;
    if (open < 2 || name.bytes[name.len - 1] != ']'
        || num_parse_int(name.bytes + open, name.len - open - 1, out_id) != name.len - open - 1)
        return false;
    *out_instancer = scene_find(scene, name.bytes, open - 1);
    return *out_instancer && is_instancer(scene, *out_instancer);
}

/* The root of the prototype that an instance shows; 0: there is no such instance. */
static prim_id prototype_of(struct scene *scene, prim_id prim, int64_t id)
{
    const struct scene_instancer *instancer = instancer_of(scene, prim);
    uint32_t number = number_of(instancer, id), source;
    const struct usda_property *targets = scene_property(scene, prim, "prototypes", &source);
    struct text_word rest = targets ? targets->value : (struct text_word){0}, path = {0};
    int64_t wanted = number < instancer->num ? instancer->prototypes[number] : -1;
    bool found = wanted >= 0;
    for (int64_t i = 0; found && i <= wanted; i++)
        found = usda_next_item(&rest, &path);
    return found ? scene_target(scene, source, path) : 0;
}

/* The run of primitives of an instance; NULL: it has none yet. */
static const struct scene_instance *find_instance(const struct scene *scene, prim_id instancer,
                                                  int64_t id, uint32_t *out_num)
{
    uint32_t hash = hash_pair(instancer, (uint32_t)id);
    for (uint32_t at = hash, found; (found = table_next(&scene->instance_table, hash, &at));) {
        const struct scene_instance *first = &scene->instances.items[found - 1],
                                    *end = scene->instances.items + scene->instances.len, *last;
        if (first->instancer != instancer || first->id != id)
            continue;
        for (last = first; last < end && last->instancer == instancer && last->id == id; last++)
            continue;
        *out_num = (uint32_t)(last - first);
        return first;
    }
    return NULL;
}

/* "set:forest[12]" */
static struct text_word name_instance(struct scene *scene, prim_id instancer, int64_t id)
{
    struct text name;
    text_init(&name, scene->arena);
    scene_path(scene, instancer, &name);
    for (size_t i = 0; i < name.len; i++)
        if (name.data[i] == '/')
            name.data[i] = ':';
    text_fmt(&name, "[%lld]", (long long)id);
    return (struct text_word){text_cstr(&name) + 1, name.len - 1};
}

static const struct scene_prototype *find_prototype(struct scene *scene, prim_id root)
{
    uint32_t hash = hash_pair(root, 0);
    for (uint32_t at = hash, found; (found = table_next(&scene->prototype_table, hash, &at));)
        if (scene->prototypes.items[found - 1].root == root)
            return &scene->prototypes.items[found - 1];
    struct scene_prototype added = {.root = root};
    for (prim_id prim = root;
         prim && (prim == root || scene_depth(scene, prim) > scene_depth(scene, root));
         prim = scene_next(scene, prim))
        if (!scene_is_instance(scene, prim) && !scene_is_group(scene, prim))
            vec_push(scene->arena, &added.drawn, prim);
    vec_push(scene->arena, &scene->prototypes, added);
    table_add(&scene->prototype_table, scene->arena, hash, scene->prototypes.len);
    return &vec_last(&scene->prototypes);
}

/* Adds the primitives of an instance: the last ones of the scene. */
static void add_instance(struct scene *scene, prim_id instancer, int64_t id)
{
    uint32_t num;
    prim_id root =
        find_instance(scene, instancer, id, &num) ? 0 : prototype_of(scene, instancer, id);
    if (!root)
        return;
    struct text_word name = name_instance(scene, instancer, id);
    const struct scene_prototype *prototype = find_prototype(scene, root);
    uint32_t first = scene->instances.len;
    for (uint32_t i = 0; i < prototype->drawn.len && scene->prims.len <= scene->max_prims; i++) {
        prim_id node = scene_child(scene, prototype->drawn.items[i], name.bytes, name.len);
        vec_push(scene->arena, &scene->instances, (struct scene_instance){node, instancer, id});
    }
    if (scene->instances.len > first)
        table_add(&scene->instance_table, scene->arena, hash_pair(instancer, (uint32_t)id),
                  first + 1);
}

static int compare_nodes(const void *key, const void *item)
{
    const prim_id *prim = key;
    const struct scene_instance *instance = item;
    return (*prim > instance->node) - (*prim < instance->node);
}

bool scene_is_instance(const struct scene *scene, prim_id prim)
{
    return scene->instances.len
           && bsearch(&prim, scene->instances.items, scene->instances.len,
                      sizeof *scene->instances.items, compare_nodes);
}

bool scene_is_leaf(const struct scene *scene, prim_id prim)
{
    const struct scene_prim *prims = scene->prims.items;
    for (prim_id child = prims[prim].first_child; child; child = prims[child].next)
        if (!scene_is_instance(scene, child))
            return false;
    return true;
}

/* ---- Documents ---- */

static void add_named(struct scene *scene, const struct document *doc, elem_id element, str_id attr)
{
    const char *list = str_text(doc->strings, doc_attr_value(doc, element, attr));
    const char *prefix = str_text(doc->strings, doc_inherited_attr(doc, element, STR_geomprefix));
    for (struct text_word name; strchr(list, '[') && (name = look_next_name(&list)).len;) {
        struct text whole;
        prim_id instancer;
        int64_t id;
        text_init(&whole, scene->arena);
        text_str(&whole, prefix);
        text_put(&whole, name);
        if (scene_parse_instance(scene, (struct text_word){whole.data, whole.len}, &instancer, &id))
            add_instance(scene, instancer, id);
    }
}

bool scene_has_instancers(const struct scene *scene)
{
    for (usda_prim_id i = 1; i < scene->layer.prims.len; i++)
        if (usda_is(scene->layer.prims.items[i].type, "PointInstancer"))
            return true;
    return false;
}

void scene_add_instances(struct scene *scene, const struct document *doc)
{
    static const str_id attrs[] = {STR_geom, STR_includegeom, STR_excludegeom};
    scene->prototypes.len = 0; /* the scene may have changed */
    scene->prototype_table = (struct table){0};
    for (elem_id e = doc->first_element; e < doc->first_element + doc_num_elements(doc); e++)
        for (size_t i = 0; i < sizeof attrs / sizeof *attrs; i++)
            if (doc_attr_value(doc, e, attrs[i]))
                add_named(scene, doc, e, attrs[i]);
}

/* ---- Looks ---- */

bool look_match_instance(struct bind_look *look, struct text_word name, uint32_t matcher)
{
    prim_id instancer;
    int64_t id;
    uint32_t num;
    if (!look->scene || !scene_parse_instance(look->scene, name, &instancer, &id))
        return false;
    const struct scene_instance *nodes = find_instance(look->scene, instancer, id, &num);
    for (uint32_t i = 0; nodes && i < num; i++)
        if (scene_has(look->scene, nodes[i].node))
            vec_push(look->arena, &look->instances, (struct look_instance){nodes[i].node, matcher});
    return true;
}

static int compare_instances(const void *a, const void *b)
{
    const struct look_instance *x = a, *y = b;
    if (x->prim != y->prim)
        return x->prim < y->prim ? -1 : 1;
    return (x->matcher > y->matcher) - (x->matcher < y->matcher);
}

void look_sort_instances(struct bind_look *look)
{
    if (look->instances.len > 1)
        qsort(look->instances.items, look->instances.len, sizeof *look->instances.items,
              compare_instances);
}

const struct look_instance *look_instances_of(const struct bind_look *look, prim_id prim,
                                              uint32_t *out_num)
{
    const struct look_instance *items = look->instances.items;
    uint32_t low = 0, high = look->instances.len;
    while (low < high) {
        uint32_t middle = (low + high) / 2;
        if (items[middle].prim < prim)
            low = middle + 1;
        else
            high = middle;
    }
    for (*out_num = 0; low + *out_num < look->instances.len && items[low + *out_num].prim == prim;)
        ++*out_num;
    return items + low;
}
