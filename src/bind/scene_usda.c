// SPDX-License-Identifier: Apache-2.0
/* The primitives and bindings of a USD text layer (docs/slots.md, "In USD"). */
#include "base/hash.h"
#include "bind/name.h"
#include "bind/primitives.h"
#include "usda/usda.h"

#include <assert.h>

/* A prim of the layer that becomes a primitive; `above` is the number of its parent on the stack.
 */
struct visit {
    usda_prim_id prim, from; /* from, to: as in struct scene_source */
    prim_id parent, to;
    uint32_t above; /* 1 + index in `open`; 0: the prim is no part of an instance */
};

/* A prim whose children are visited, for cycles of references. */
struct open_prim {
    usda_prim_id prim;
    uint32_t above, depth;
};

/* A binding to a collection, whose members are known when all primitives are. */
struct pending {
    uint32_t binding, source;
    struct text_word collection; /* "/set.collection:metal" */
};

struct reader {
    struct scene *scene;
    const struct usda_layer *layer;
    const char *purpose;
    struct arena *scratch;
    struct diag_list *diags;
    VEC(struct visit) visits;
    VEC(struct open_prim) open;
    VEC(struct pending) pending;
    uint64_t work; /* of instances: WORK_OF_PRIM for each prim, 1 for each text and step beside */
};

/* Nested instances multiply whatever their prims have, so both have a limit. */
enum { MAX_REFERENCES = 64, MAX_INSTANCED = 1 << 22, WORK_OF_PRIM = 64 };
#define MAX_WORK ((uint64_t)MAX_INSTANCED * WORK_OF_PRIM)

static struct diag_place place_of(const struct reader *s, uint32_t line, uint32_t column)
{
    return (struct diag_place){s->layer->file, line, column, 0};
}

static const char *text_of(struct reader *s, struct text_word word)
{
    return arena_strndup(s->scene->arena, word.bytes, word.len);
}

/* ---- Bindings ---- */

static bool begins(struct text_word word, const char *prefix)
{
    size_t len = strlen(prefix);
    return word.len >= len && memcmp(word.bytes, prefix, len) == 0;
}

/* True if a purpose counts: none, or the asked one. */
static bool has_purpose(const struct reader *s, const char *rest, size_t len, bool *out_restricted)
{
    *out_restricted = len != 0;
    return !len || (len == strlen(s->purpose) && memcmp(rest, s->purpose, len) == 0);
}

/* The name of the last prim of a path. */
static struct text_word last_name(struct text_word path)
{
    size_t begin = path.len;
    while (begin && path.bytes[begin - 1] != '/')
        begin--;
    return (struct text_word){path.bytes + begin, path.len - begin};
}

static void report_binding(struct reader *s, const struct usda_property *property,
                           const char *fault)
{
    diag_add(s->diags, DIAG_ID_bad_binding, place_of(s, property->line, property->column),
             text_of(s, property->name), fault);
}

/*
 * Reads a relationship's name: the slot and the rest behind it, without ':'. false: it is no
 * direct binding.
 */
static bool read_binding_name(struct reader *s, const struct usda_property *property,
                              const char **out_slot, struct text_word *out_rest)
{
    static const char plain[] = "material:binding", slots[] = "material:slotBinding:";
    static const char collection[] = "collection:";
    const char *end = property->name.bytes + property->name.len, *rest;
    if (begins(property->name, slots)) {
        struct slot_name name;
        const char *code = property->name.bytes + strlen(slots);
        if (begins((struct text_word){code, (size_t)(end - code)}, collection))
            code += strlen(collection);
        rest = slot_decode(code, (size_t)(end - code), &name);
        if (!rest) {
            report_binding(s, property,
                           "is not the name of a slot; expected for example "
                           "material:slotBinding:_050:_:_010");
            return false;
        }
        struct text *text = &s->scene->written;
        text->len = 0;
        slot_write(&name, text);
        *out_slot = scene_keep_word(s->scene, (struct text_word){text->data, text->len});
    } else if (begins(property->name, plain)) {
        rest = property->name.bytes + strlen(plain);
        *out_slot = SLOT_DEFAULT;
        if (rest < end && *rest != ':')
            return false;
    } else {
        return false;
    }
    rest += rest < end;
    *out_rest = (struct text_word){rest, (size_t)(end - rest)};
    return true;
}

/* The material that a relationship names; false: it names none, or the binding does not count. */
static bool read_target(struct reader *s, const struct usda_property *property,
                        struct text_word *out_collection, struct scene_binding *out)
{
    struct text_word rest = property->value, target;
    bool is_slot = begins(property->name, "material:slotBinding:");
    out->material = "";
    /* on a plain binding it only clears what weaker layers say; flattening drops the None */
    if (!property->value.len || usda_is(property->value, "None") || usda_is(property->value, "[]"))
        return is_slot && !out_collection;
    if (out_collection && !usda_next_item(&rest, out_collection))
        return false;
    if (!usda_next_item(&rest, &target)) {
        if (out_collection)
            report_binding(s, property, "names no material behind its collection");
        return false;
    }
    const struct scene_material *material = scene_material_at(s->scene, target);
    out->leaf = scene_keep_word(s->scene, last_name(target));
    out->material = material ? material->name : out->leaf;
    if (usda_next_item(&rest, &target))
        report_binding(s, property, "names several materials; expected one");
    return true;
}

/* The words that follow the slot in the name of a binding. */
struct binding_rest {
    bool is_collection;
    struct text_word purpose;
};

static const char *after(struct text_word word, const char *prefix)
{
    return begins(word, prefix) ? word.bytes + strlen(prefix) : NULL;
}

static bool is_purpose(struct text_word word)
{
    return usda_is(word, "full") || usda_is(word, "preview");
}

/*
 * "full" of a direct binding; of UsdShade's collections "collection:full:name", and of those in
 * slots, whose "collection:" stands before the slot, "name:full".
 */
static struct binding_rest read_rest(const struct usda_property *property, struct text_word rest)
{
    struct binding_rest out = {.purpose = rest};
    const char *name = after(rest, "collection:"), *end = rest.bytes + rest.len;
    if (begins(property->name, "material:slotBinding:collection:")) {
        const char *colon = memchr(rest.bytes, ':', rest.len);
        struct text_word last = {colon ? colon + 1 : end, colon ? (size_t)(end - colon - 1) : 0};
        return (struct binding_rest){true, last};
    }
    if (!name || begins(property->name, "material:slotBinding:"))
        return out;
    const char *colon = memchr(name, ':', (size_t)(end - name));
    struct text_word first = {name, colon ? (size_t)(colon - name) : 0};
    return (struct binding_rest){true, is_purpose(first) ? first : (struct text_word){end, 0}};
}

static void report_ignored(struct reader *s, const struct usda_property *property,
                           const char *fault)
{
    diag_add(s->diags, DIAG_ID_ignored_binding, place_of(s, property->line, property->column),
             text_of(s, property->name), fault);
}

/* Reports what stands behind a slot and is no purpose. Plain bindings may have more purposes. */
static void check_purpose(struct reader *s, const struct usda_property *property,
                          struct text_word purpose)
{
    struct text fault;
    if (!purpose.len || is_purpose(purpose) || !begins(property->name, "material:slotBinding:"))
        return;
    text_init(&fault, s->scene->arena);
    text_fmt(&fault, "'%s' is no purpose; expected 'full' or 'preview'", text_of(s, purpose));
    if (*purpose.bytes == '_')
        text_fmt(&fault, ", or for an override ':_:%s'", text_of(s, purpose));
    report_ignored(s, property, text_cstr(&fault));
}

/* Reports a relationship among the materials' that is no binding: a misspelled one. */
static void check_name(struct reader *s, const struct usda_property *property)
{
    if (usda_is(property->type, "rel") && !begins(property->name, "material:binding")
        && !begins(property->name, "material:slotBinding:"))
        report_ignored(s, property,
                       "expected 'material:binding', or 'material:slotBinding:' and a slot such "
                       "as '_050'");
}

/* The work of a binding in an instance, which is told and found by a path of its own. */
static uint64_t work_of_path(const struct reader *s, prim_id prim)
{
    const struct scene *scene = s->scene;
    if (!scene->sources.items[scene_source(scene, prim) - 1].from)
        return 0;
    uint64_t work = WORK_OF_PRIM;
    for (; prim; prim = scene->prims.items[prim].parent)
        work += scene->prims.items[prim].name_len + 1;
    return work;
}

static void add_binding(struct reader *s, prim_id prim, const struct usda_property *property,
                        bool with_collections)
{
    struct scene_binding added = {.prim = prim};
    struct text_word rest, collection = {0};
    if (!usda_is(property->type, "rel") || !read_binding_name(s, property, &added.name, &rest))
        return;
    struct binding_rest said = read_rest(property, rest);
    if (!with_collections)
        check_purpose(s, property, said.purpose);
    if (said.is_collection != with_collections
        || !has_purpose(s, said.purpose.bytes, said.purpose.len, &added.is_purpose)
        || !read_target(s, property, said.is_collection ? &collection : NULL, &added))
        return;
    added.property = scene_keep_word(s->scene, property->name);
    added.place = place_of(s, property->line, property->column);
    added.is_strong = usda_is(property->bind_as, "strongerThanDescendants");
    added.is_collection = said.is_collection;
    uint32_t index = scene_add_binding(s->scene, added);
    if (said.is_collection)
        vec_push(s->scratch, &s->pending,
                 (struct pending){index, scene_source(s->scene, prim), collection});
}

/*
 * The later one of equal bindings wins: a slot binding of 000 beats a plain binding of the same
 * prim, a collection a direct binding, and a collection those behind it.
 */
static void add_bindings(struct reader *s, prim_id prim, const struct usda_prim *source)
{
    const struct usda_property *properties = s->layer->properties.items;
    VEC(uint32_t) bindings = {0};
    for (uint32_t i = source->first_property; i < usda_end_property(source); i++)
        if (begins(properties[i].name, "material:")) {
            vec_push(s->scratch, &bindings, i);
            check_name(s, &properties[i]);
            s->work += work_of_path(s, prim);
        }
    for (unsigned with_slots = 0; with_slots < 2; with_slots++)
        for (unsigned with_collections = 0; with_collections < 2; with_collections++)
            for (uint32_t i = 0; i < bindings.len; i++) {
                uint32_t at = with_collections ? bindings.len - 1 - i : i;
                const struct usda_property *property = &properties[bindings.items[at]];
                if (begins(property->name, "material:slotBinding:") == (with_slots != 0))
                    add_binding(s, prim, property, with_collections != 0);
            }
}

/* ---- Prims ---- */

/* True for what a scene is drawn of: groups and geometry, but no shading, and no settings. */
static bool is_primitive(const struct reader *s, const struct usda_prim *prim, prim_id parent)
{
    static const char *const others[] = {"Material",       "Shader",        "NodeGraph",
                                         "RenderSettings", "RenderProduct", "RenderVar"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (usda_is(prim->type, others[i]))
            return false;
    if (prim->is_variant || prim->is_inactive || prim->specifier == USDA_CLASS)
        return false;
    if (usda_is(prim->type, "GeomSubset")) {
        const struct usda_property *family = usda_find_property(s->layer, prim, "familyName");
        struct text_word rest = family ? family->value : (struct text_word){0}, name;
        return family && usda_next_item(&rest, &name) && usda_is(name, "materialBind");
    }
    /* an over changes what a reference has brought */
    return prim->specifier == USDA_DEF
           || scene_find_child(s->scene, parent, prim->name.bytes, prim->name.len);
}

/* True if a prim is open already: its reference leads to itself. */
static bool is_open(struct reader *s, uint32_t above, usda_prim_id prim)
{
    for (; above; above = s->open.items[above - 1].above, s->work++)
        if (s->open.items[above - 1].prim == prim)
            return true;
    return false;
}

/* The prim that an internal reference names; 0: none. Reports other arcs. */
static usda_prim_id reference_of(struct reader *s, usda_prim_id id, uint32_t above)
{
    const struct usda_prim *prim = &s->layer->prims.items[id];
    struct diag_place place = place_of(s, prim->line, prim->column);
    struct text_word rest = prim->references, target;
    if (prim->arc.len)
        diag_add(s->diags, DIAG_ID_usda_arc, place, text_of(s, prim->name), text_of(s, prim->arc));
    if (!rest.len || usda_is(rest, "None") || !usda_next_item(&rest, &target))
        return 0;
    usda_prim_id found = *target.bytes == '/' ? usda_find(s->layer, target.bytes, target.len) : 0;
    bool is_cycle = found
                    && (found == id || is_open(s, above, found)
                        || (above && s->open.items[above - 1].depth > MAX_REFERENCES));
    if (!found || is_cycle)
        diag_add(s->diags, is_cycle ? DIAG_ID_usda_cycle : DIAG_ID_usda_reference, place,
                 text_of(s, prim->name), text_of(s, target));
    return is_cycle ? 0 : found;
}

/* Children are visited in their order: the last one is pushed first. */
static void push_children(struct reader *s, usda_prim_id source, struct visit below)
{
    uint32_t first = s->visits.len;
    const struct usda_prim *prims = s->layer->prims.items;
    for (below.prim = prims[source].first_child; below.prim; below.prim = prims[below.prim].next)
        vec_push(s->scratch, &s->visits, below);
    for (uint32_t i = first, k = s->visits.len; i + 1 < k; i++) {
        k--;
        struct visit swapped = s->visits.items[i];
        s->visits.items[i] = s->visits.items[k];
        s->visits.items[k] = swapped;
    }
}

/* Notes that a primitive has the properties of a prim; a later one is stronger. */
static void add_source(struct reader *s, prim_id prim, struct scene_source source)
{
    struct scene *scene = s->scene;
    s->work += source.from ? s->layer->prims.items[source.prim].num_properties : 0;
    while (scene->first_source.len <= prim)
        vec_push(scene->arena, &scene->first_source, 0);
    source.next = scene->first_source.items[prim];
    vec_push(scene->arena, &scene->sources, source);
    scene->first_source.items[prim] = scene->sources.len;
    scene_find_kind(scene, prim);
    add_bindings(s, prim, &s->layer->prims.items[source.prim]);
}

static void visit(struct reader *s, struct visit at)
{
    enum { MAX_CHAIN = 64 };
    const struct usda_prim *prim = &s->layer->prims.items[at.prim];
    struct open_prim chain[MAX_CHAIN];
    uint32_t num = 0, depth = at.above ? s->open.items[at.above - 1].depth + 1 : 1;
    s->work += at.above ? WORK_OF_PRIM + prim->name.len + prim->references.len : 0;
    if (!is_primitive(s, prim, at.parent))
        return;
    if (s->scene->prims.items[at.parent].depth == SCENE_MAX_DEPTH) {
        diag_add(s->diags, DIAG_ID_usda_cycle, place_of(s, prim->line, prim->column),
                 text_of(s, prim->name), text_of(s, prim->name));
        return;
    }
    prim_id added = scene_child(s->scene, at.parent, prim->name.bytes, prim->name.len);
    uint32_t above = at.above;
    for (usda_prim_id next = at.prim; num < MAX_CHAIN && (next = reference_of(s, next, above));) {
        chain[num++] = (struct open_prim){next, above, depth};
        vec_push(s->scratch, &s->open, chain[num - 1]);
        above = s->open.len;
    }
    /* what is visited last is pushed first; what a prim says itself is stronger, so it comes last
     */
    push_children(s, at.prim, (struct visit){0, at.from, added, at.to, at.above});
    for (uint32_t i = 0; i < num; i++)
        push_children(s, chain[i].prim,
                      (struct visit){0, chain[i].prim, added, added, s->open.len - num + i + 1});
    for (uint32_t i = num; i-- > 0;)
        add_source(s, added, (struct scene_source){chain[i].prim, chain[i].prim, added, 0});
    add_source(s, added, (struct scene_source){at.prim, at.from, at.to, 0});
}

/* ---- Properties ---- */

const struct usda_property *scene_property(const struct scene *scene, prim_id prim,
                                           const char *name, uint32_t *out_source)
{
    for (uint32_t i = scene_source(scene, prim); i; i = scene->sources.items[i - 1].next) {
        const struct usda_property *found = usda_find_attribute(
            &scene->layer, &scene->layer.prims.items[scene->sources.items[i - 1].prim], name);
        if (!found)
            continue;
        if (out_source)
            *out_source = i;
        return found;
    }
    return NULL;
}

prim_id scene_target(const struct scene *scene, uint32_t source, struct text_word path)
{
    const struct scene_source *at = &scene->sources.items[source - 1];
    const struct usda_prim *prims = scene->layer.prims.items;
    usda_prim_id target = usda_find(&scene->layer, path.bytes, path.len);
    size_t below = path.len;
    /* up to the prim that is referenced; the names passed are the rest of the path */
    for (usda_prim_id prim = target; prim && prim != at->from; prim = prims[prim].parent)
        below -= prims[prim].name.len + 1;
    bool is_inside = false;
    for (usda_prim_id prim = target; prim && at->from && !is_inside; prim = prims[prim].parent)
        is_inside = prim == at->from;
    prim_id found = is_inside
                        ? scene_find_below(scene, at->to, path.bytes + below, path.len - below)
                        : scene_find(scene, path.bytes, path.len);
    return scene_has(scene, found) ? found : 0;
}

/* ---- Collections ---- */

enum { MAX_COLLECTIONS = 256 }; /* that one includes, at any depth */

/* Splits "/set.collection:metal"; false: it names no collection. */
static bool split_collection(struct reader *s, uint32_t source, struct text_word path,
                             prim_id *out_prim, const char **out_name)
{
    static const char word[] = ".collection:";
    const char *dot = memchr(path.bytes, '.', path.len);
    size_t len = dot ? (size_t)(dot - path.bytes) : path.len;
    if (!dot || path.len - len < strlen(word) || memcmp(dot, word, strlen(word)) != 0)
        return false;
    *out_prim = scene_target(s->scene, source, (struct text_word){path.bytes, len});
    *out_name = text_of(s, (struct text_word){dot + 1, path.len - len - 1});
    return true;
}

static const struct usda_property *collection_property(struct reader *s, prim_id prim,
                                                       const char *name, const char *end,
                                                       uint32_t *out_source)
{
    struct text text;
    text_init(&text, s->scratch);
    text_fmt(&text, "%s:%s", name, end);
    return scene_property(s->scene, prim, text_cstr(&text), out_source);
}

static void add_member(struct reader *s, prim_id prim, bool is_excluded)
{
    vec_push(s->scene->arena, &s->scene->members, (struct scene_member){prim, is_excluded});
}

/* A prim alone: what is below it is out. */
static void exclude_children(struct reader *s, prim_id prim)
{
    const struct scene_prim *prims = s->scene->prims.items;
    for (prim_id child = prims[prim].first_child; child; child = prims[child].next)
        add_member(s, child, true);
}

/* Adds the paths of a property of a collection; nested collections go to `todo`. */
static void add_paths(struct reader *s, prim_id prim, const char *name, const char *property_name,
                      bool is_explicit, struct text_word *todo, uint32_t *sources, uint32_t *num)
{
    uint32_t source;
    const struct usda_property *property =
        collection_property(s, prim, name, property_name, &source);
    struct text_word rest = property ? property->value : (struct text_word){0}, path;
    bool is_excluded = *property_name == 'e';
    s->work += property && s->scene->sources.items[source - 1].from ? rest.len : 0;
    while (property && !usda_is(property->value, "None") && usda_next_item(&rest, &path)) {
        if (memchr(path.bytes, '.', path.len)) {
            if (*num < MAX_COLLECTIONS && !is_excluded) {
                todo[*num] = path;
                sources[(*num)++] = source;
            }
            continue;
        }
        prim_id member = scene_target(s->scene, source, path);
        if (!member && path.len > 1 && !usda_find_composed(s->layer, path.bytes, path.len))
            diag_add(s->diags, DIAG_ID_pattern_unmatched,
                     place_of(s, property->line, property->column), text_of(s, path), "");
        if (member || path.len == 1) {
            add_member(s, member, is_excluded);
            if (is_explicit && !is_excluded)
                exclude_children(s, member);
        }
    }
}

static bool has_includes(struct reader *s, prim_id prim, const char *name)
{
    return collection_property(s, prim, name, "includes", NULL) != NULL;
}

/* The members of a collection with those that it includes; each of these once, so cycles end. */
static void read_members(struct reader *s, const struct pending *pending)
{
    struct text_word todo[MAX_COLLECTIONS] = {pending->collection};
    uint32_t sources[MAX_COLLECTIONS] = {pending->source}, num = 1;
    struct scene_binding *binding = &s->scene->bindings.items[pending->binding];
    binding->first_member = s->scene->members.len;
    for (uint32_t i = 0; i < num; i++) {
        prim_id prim;
        const char *name;
        bool is_again = false;
        for (uint32_t k = 0; k < i && !is_again; k++)
            is_again = todo[k].len == todo[i].len
                       && memcmp(todo[k].bytes, todo[i].bytes, todo[i].len) == 0;
        if (is_again)
            continue;
        bool is_named = split_collection(s, sources[i], todo[i], &prim, &name);
        const struct usda_property *root =
            is_named && prim ? collection_property(s, prim, name, "includeRoot", NULL) : NULL;
        if (root && (usda_is(root->value, "true") || usda_is(root->value, "1")))
            add_member(s, 0, false);
        if (!is_named || !prim || (!root && !has_includes(s, prim, name))) {
            struct text label;
            text_init(&label, s->scratch);
            scene_write_binding(s->scene, binding, &label);
            diag_add(s->diags, DIAG_ID_bad_binding, binding->place, text_cstr(&label),
                     "names a collection that the stage does not have");
            break;
        }
        const struct usda_property *rule =
            collection_property(s, prim, name, "expansionRule", NULL);
        bool is_explicit = rule && usda_is(rule->value, "\"explicitOnly\"");
        add_paths(s, prim, name, "includes", is_explicit, todo, sources, &num);
        add_paths(s, prim, name, "excludes", is_explicit, todo, sources, &num);
    }
    binding->num_members = s->scene->members.len - binding->first_member;
}

/* True if two bindings name a collection of one prim. */
static bool is_same_collection(const struct reader *s, const struct pending *a,
                               const struct pending *b)
{
    const struct scene_source *sources = s->scene->sources.items;
    return a->collection.len == b->collection.len
           && memcmp(a->collection.bytes, b->collection.bytes, a->collection.len) == 0
           && sources[a->source - 1].from == sources[b->source - 1].from
           && sources[a->source - 1].to == sources[b->source - 1].to;
}

/* Many primitives may name one collection: its members are read once. */
static void read_collections(struct reader *s)
{
    struct table known = {0};
    for (uint32_t i = 0; i < s->pending.len && s->work <= MAX_WORK; i++) {
        const struct pending *pending = &s->pending.items[i];
        struct scene_binding *bindings = s->scene->bindings.items;
        uint32_t hash = hash_pair(s->scene->sources.items[pending->source - 1].to,
                                  hash_bytes(pending->collection.bytes, pending->collection.len));
        uint32_t at = hash, found;
        while ((found = table_next(&known, hash, &at))
               && !is_same_collection(s, pending, &s->pending.items[found - 1]))
            continue;
        if (found) {
            const struct scene_binding *same = &bindings[s->pending.items[found - 1].binding];
            bindings[pending->binding].first_member = same->first_member;
            bindings[pending->binding].num_members = same->num_members;
            continue;
        }
        table_add(&known, s->scratch, hash, i + 1);
        read_members(s, pending);
    }
}

/* uniform token[] material:slotOrder on the default prim. */
static void read_slot_order(struct reader *s)
{
    struct text_word prim = s->layer->default_prim, rest, item;
    usda_prim_id id = prim.len ? usda_find(s->layer, prim.bytes, prim.len) : 0;
    const struct usda_property *order =
        id ? usda_find_property(s->layer, &s->layer->prims.items[id], "material:slotOrder") : NULL;
    struct text text;
    if (!order)
        return;
    text_init(&text, s->scene->arena);
    for (rest = order->value; usda_next_item(&rest, &item);) {
        text_str(&text, text.len ? "," : "");
        text_put(&text, item);
    }
    s->scene->slot_order = text_cstr(&text);
    s->scene->slot_order_place = place_of(s, order->line, order->column);
}

void scene_read_usda(struct scene *scene, const char *file, const char *text, size_t len,
                     const char *purpose, struct arena *scratch, struct diag_list *diags)
{
    struct reader s = {.scene = scene,
                       .layer = &scene->layer,
                       .purpose = purpose,
                       .scratch = scratch,
                       .diags = diags};
    if (!usda_read(&scene->layer, file, text, len, scene->max_prims, scene->arena, diags))
        return;
    if (s.layer->prims.items[0].arc.len)
        diag_add(diags, DIAG_ID_usda_arc, place_of(&s, 1, 1), file,
                 text_of(&s, s.layer->prims.items[0].arc));
    scene->purpose = scene_keep_word(scene, (struct text_word){purpose, strlen(purpose)});
    scene_name_materials(scene);
    read_slot_order(&s);
    push_children(&s, 0, (struct visit){0});
    while (s.visits.len && scene->prims.len <= scene->max_prims && s.work <= MAX_WORK) {
        struct visit at = vec_pop(&s.visits);
        visit(&s, at);
    }
    read_collections(&s);
    if (s.work > MAX_WORK)
        diag_add(diags, DIAG_ID_usda_size, place_of(&s, 0, 0), file, (unsigned)MAX_INSTANCED);
    else if (s.visits.len)
        diag_add(diags, DIAG_ID_scene_size, place_of(&s, 0, 0), (unsigned)scene->max_prims);
}
