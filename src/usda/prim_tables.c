// SPDX-License-Identifier: Apache-2.0
/* The tables of a layer: from names to prims and properties. */
#include "usda/usda.h"

#include "base/hash.h"

static uint32_t hash_of(uint32_t owner, const char *name, size_t len)
{
    return hash_pair(owner, hash_bytes(name, len));
}

static bool is_equal(struct text_word word, const char *name, size_t len)
{
    return word.len == len && memcmp(word.bytes, name, len) == 0;
}

/* ---- Prims ---- */

static usda_prim_id find_child(const struct usda_layer *layer, usda_prim_id parent, uint32_t hash,
                               const char *name, size_t len)
{
    for (uint32_t at = hash, found; (found = table_next(&layer->children, hash, &at));)
        if (layer->prims.items[found].parent == parent
            && is_equal(layer->prims.items[found].name, name, len))
            return found;
    return 0;
}

usda_prim_id usda_index_prim(struct usda_layer *layer, usda_prim_id id)
{
    const struct usda_prim *prim = &layer->prims.items[id];
    uint32_t hash = hash_of(prim->parent, prim->name.bytes, prim->name.len);
    usda_prim_id before = find_child(layer, prim->parent, hash, prim->name.bytes, prim->name.len);
    if (!before)
        table_add(&layer->children, layer->arena, hash, id);
    return before;
}

/* The prim that a reference of a prim names; 0: none in this layer. */
static usda_prim_id referenced(const struct usda_layer *layer, usda_prim_id prim)
{
    struct text_word rest = layer->prims.items[prim].references, target;
    bool is_inside = rest.len && usda_next_item(&rest, &target) && *target.bytes == '/';
    return is_inside ? usda_find(layer, target.bytes, target.len) : 0;
}

/* Finds a prim; each name may lead through `max_hops` references. */
static usda_prim_id find(const struct usda_layer *layer, const char *path, size_t len,
                         unsigned max_hops)
{
    const char *end = path + len;
    usda_prim_id prim = 0;
    while (path < end) {
        path += *path == '/';
        const char *slash = memchr(path, '/', (size_t)(end - path));
        size_t name = (size_t)((slash ? slash : end) - path);
        usda_prim_id above = prim;
        prim = find_child(layer, above, hash_of(above, path, name), path, name);
        for (unsigned hop = 0; !prim && above && hop < max_hops; hop++) {
            above = referenced(layer, above);
            prim = above ? find_child(layer, above, hash_of(above, path, name), path, name) : 0;
        }
        if (!prim)
            return 0;
        path += name;
    }
    return prim;
}

usda_prim_id usda_find(const struct usda_layer *layer, const char *path, size_t len)
{
    return find(layer, path, len, 0);
}

usda_prim_id usda_find_composed(const struct usda_layer *layer, const char *path, size_t len)
{
    enum { MAX_HOPS = 64 };
    return find(layer, path, len, MAX_HOPS);
}

/* ---- Properties ---- */

const struct usda_named *usda_find_named(const struct usda_layer *layer, usda_prim_id prim,
                                         struct text_word name)
{
    uint32_t hash = hash_of(prim, name.bytes, name.len);
    for (uint32_t at = hash, found; (found = table_next(&layer->names, hash, &at));) {
        const struct usda_named *named = &layer->named.items[found - 1];
        if (named->prim == prim && is_equal(named->name, name.bytes, name.len))
            return named;
    }
    return NULL;
}

static struct usda_named *add_named(struct usda_layer *layer, usda_prim_id prim,
                                    struct text_word name)
{
    const struct usda_named *found = usda_find_named(layer, prim, name);
    if (found)
        return &layer->named.items[found - layer->named.items];
    vec_push(layer->arena, &layer->named, (struct usda_named){.prim = prim, .name = name});
    table_add(&layer->names, layer->arena, hash_of(prim, name.bytes, name.len), layer->named.len);
    return &vec_last(&layer->named);
}

/* How much a property says of a name: a value more than time samples, and these more than nothing.
 */
static unsigned rank_of(const struct usda_layer *layer, const struct usda_named *named,
                        uint32_t property)
{
    const struct usda_property *at = &layer->properties.items[property];
    return !property || !at->value.len ? 0 : at->name.len == named->name.len ? 2 : 1;
}

/* The first of properties that say as much counts; without a value, the last. */
static void offer(const struct usda_layer *layer, struct usda_named *named, uint32_t property)
{
    unsigned before = rank_of(layer, named, named->attribute),
             rank = rank_of(layer, named, property);
    if (rank > before || !before)
        named->attribute = property;
}

/* Copies metadata to a property that has none. */
static void copy_metadata(const struct usda_property *from, struct usda_property *to)
{
    to->bind_as = to->bind_as.len ? to->bind_as : from->bind_as;
    to->interpolation = to->interpolation.len ? to->interpolation : from->interpolation;
    to->color_space = to->color_space.len ? to->color_space : from->color_space;
}

/* The metadata of an attribute may stand at its value or at its time samples. */
static void share_metadata(struct usda_layer *layer, const struct usda_named *named)
{
    struct usda_property *value = &layer->properties.items[named->first],
                         *samples = &layer->properties.items[named->samples];
    if (!named->first || !named->samples)
        return;
    copy_metadata(value, samples);
    copy_metadata(samples, value);
}

void usda_index_property(struct usda_layer *layer, usda_prim_id prim, uint32_t property)
{
    size_t end = strlen(USDA_SAMPLES);
    struct text_word name = layer->properties.items[property].name;
    struct usda_named *named = add_named(layer, prim, name);
    if (!named->first)
        named->first = property;
    offer(layer, named, property);
    share_metadata(layer, named);
    if (name.len <= end || memcmp(name.bytes + name.len - end, USDA_SAMPLES, end) != 0)
        return;
    name.len -= end;
    named = add_named(layer, prim, name);
    if (!named->samples)
        named->samples = property;
    offer(layer, named, property);
    share_metadata(layer, named);
}

void usda_index_rows(struct usda_layer *layer, const usda_prim_id *prims, struct arena *scratch)
{
    uint32_t num = layer->properties.len, next = 1;
    uint32_t *places = ARENA_ARRAY(scratch, uint32_t, num);
    struct usda_property *sorted = ARENA_ARRAY(scratch, struct usda_property, num);
    for (uint32_t i = 1; i < num; i++)
        layer->prims.items[prims[i]].num_properties++;
    for (uint32_t i = 0; i < layer->prims.len; i++) {
        layer->prims.items[i].first_property = next;
        next += layer->prims.items[i].num_properties;
        layer->prims.items[i].num_properties = 0;
    }
    for (uint32_t i = 1; i < num; i++) {
        struct usda_prim *prim = &layer->prims.items[prims[i]];
        places[i] = prim->first_property + prim->num_properties++;
        sorted[places[i]] = layer->properties.items[i];
    }
    for (uint32_t i = 0; i < layer->named.len; i++) {
        struct usda_named *named = &layer->named.items[i];
        named->first = named->first ? places[named->first] : 0;
        named->samples = named->samples ? places[named->samples] : 0;
        named->attribute = places[named->attribute];
    }
    memcpy(layer->properties.items + 1, sorted + 1, (num - 1) * sizeof *sorted);
    arena_release(scratch, sorted, num * sizeof *sorted);
    arena_release(scratch, places, num * sizeof *places);
}

const struct usda_property *usda_find_property(const struct usda_layer *layer,
                                               const struct usda_prim *prim, const char *name)
{
    const struct usda_named *named = usda_find_named(
        layer, (usda_prim_id)(prim - layer->prims.items), (struct text_word){name, strlen(name)});
    return named && named->first ? &layer->properties.items[named->first] : NULL;
}

const struct usda_property *usda_find_attribute(const struct usda_layer *layer,
                                                const struct usda_prim *prim, const char *name)
{
    const struct usda_named *named = usda_find_named(
        layer, (usda_prim_id)(prim - layer->prims.items), (struct text_word){name, strlen(name)});
    return named && named->attribute ? &layer->properties.items[named->attribute] : NULL;
}

void usda_join(const struct usda_layer *layer, usda_prim_id prim, char between, struct text *out)
{
    const struct usda_prim *prims = layer->prims.items;
    usda_prim_id chain[USDA_MAX_DEPTH];
    uint32_t num = 0;
    for (; prim && num < USDA_MAX_DEPTH; prim = prims[prim].parent)
        chain[num++] = prim;
    while (num--) {
        text_put(out, prims[chain[num]].name);
        if (num)
            text_char(out, between);
    }
}
