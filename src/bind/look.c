// SPDX-License-Identifier: Apache-2.0
/* Chooses a look and reads it. */
#include "base/hash.h"
#include "base/table.h"
#include "bind/look.h"

#include <assert.h>

const char *const bind_product_names[NUM_PRODUCTS] = {
#define PRODUCT(id, word) [PRODUCT_##id] = #word,
#include "bind/products.def"
#undef PRODUCT
};

static const char *text_of(const struct document *doc, str_id id)
{
    return str_text(doc->strings, id);
}

/* ---- The choice ---- */

enum { MAX_GROUPS = 64 }; /* nested look groups */

static void guess_looks(const struct document *doc, struct diag_guess *guess)
{
    for (elem_id e = doc_element(doc, doc->root)->first_child; e; e = doc_element(doc, e)->next)
        if (doc_element(doc, e)->kind == KIND_LOOK || doc_element(doc, e)->kind == KIND_LOOKGROUP)
            diag_guess_add(guess, text_of(doc, doc_element(doc, e)->name));
}

static void report_unknown_look(const struct document *doc, const char *name,
                                struct diag_place place, struct diag_list *diags)
{
    struct diag_guess guess;
    const char *near = "";
    if (diag_guess_begin(&guess, diags, name)) {
        guess_looks(doc, &guess);
        near = diag_guess_text(&guess);
    }
    diag_add(diags, DIAG_ID_unknown_look, place, name, near);
}

uint32_t look_count(const struct document *doc)
{
    uint32_t num = 0;
    for (elem_id e = doc_element(doc, doc->root)->first_child; e; e = doc_element(doc, e)->next)
        num += doc_element(doc, e)->kind == KIND_LOOK;
    return num;
}

/* Without a name: the only look. */
static elem_id only_look(const struct document *doc, struct diag_list *diags)
{
    elem_id found = 0;
    uint32_t num = 0;
    struct text list;
    text_init(&list, diags->arena);
    for (elem_id e = doc_element(doc, doc->root)->first_child; e; e = doc_element(doc, e)->next) {
        if (doc_element(doc, e)->kind != KIND_LOOK)
            continue;
        text_fmt(&list, "%s%s", num++ ? ", " : "", text_of(doc, doc_element(doc, e)->name));
        found = e;
    }
    if (num > 1)
        diag_add(diags, DIAG_ID_look_needed, doc_place(doc, doc->root),
                 "the document has several looks", text_cstr(&list));
    if (num == 0)
        diag_add(diags, DIAG_ID_look_missing, doc_place(doc, doc->root));
    return num == 1 ? found : 0;
}

static elem_id look_or_group(const struct document *doc, str_id name)
{
    elem_id found = doc_top_level(doc, KIND_LOOK, name);
    return found ? found : doc_top_level(doc, KIND_LOOKGROUP, name);
}

struct chain { /* elements, each once */
    elem_id *items;
    uint32_t len, cap;
    struct table table;
};

static bool is_in(const struct chain *chain, elem_id element)
{
    uint32_t hash = hash_pair(element, 0);
    for (uint32_t at = hash, found; (found = table_next(&chain->table, hash, &at));)
        if (found == element)
            return true;
    return false;
}

static void add_to(struct chain *chain, elem_id element, struct arena *arena)
{
    vec_push(arena, chain, element);
    table_add(&chain->table, arena, hash_pair(element, 0), element);
}

/* True if the list of a group names the member; adds the groups in it to the chain. */
static bool list_has(const struct document *doc, elem_id group, str_id member, struct chain *groups,
                     struct arena *arena)
{
    const char *list = text_of(doc, doc_attr_value(doc, group, STR_looks));
    while (*list) {
        list += strspn(list, ", ");
        size_t len = strcspn(list, ", ");
        str_id name = str_find(doc->strings, list, len);
        elem_id inner = name ? doc_top_level(doc, KIND_LOOKGROUP, name) : 0;
        if (name && name == member)
            return true;
        if (inner && !is_in(groups, inner))
            add_to(groups, inner, arena);
        list += len;
    }
    return false;
}

/* True if a group has a member of this name, at any depth. */
static bool group_has(const struct document *doc, elem_id group, str_id member, struct arena *arena)
{
    struct chain groups = {0};
    bool found = false;
    add_to(&groups, group, arena);
    for (uint32_t i = 0; i < groups.len && !found; i++)
        found = list_has(doc, groups.items[i], member, &groups, arena);
    return found;
}

static elem_id default_of_group(const struct document *doc, elem_id group, struct diag_list *diags)
{
    str_id name = doc_attr_value(doc, group, STR_default);
    const char *looks = text_of(doc, doc_attr_value(doc, group, STR_looks));
    struct text reason;
    text_init(&reason, diags->arena);
    text_fmt(&reason, "the look group '%s' has no default",
             text_of(doc, doc_element(doc, group)->name));
    if (!name) {
        diag_add(diags, DIAG_ID_look_needed, doc_place(doc, group), text_cstr(&reason), looks);
        return 0;
    }
    elem_id found = group_has(doc, group, name, diags->arena) ? look_or_group(doc, name) : 0;
    if (!found)
        report_unknown_look(doc, text_of(doc, name), doc_attr_place(doc, group, STR_default),
                            diags);
    return found;
}

void look_check_group(const struct document *doc, elem_id group, struct diag_list *diags)
{
    if (doc_attr_value(doc, group, STR_default))
        default_of_group(doc, group, diags);
}

elem_id look_choose(const struct document *doc, const char *name, struct diag_list *diags)
{
    if (!name)
        return only_look(doc, diags);
    str_id id = str_find(doc->strings, name, strlen(name));
    elem_id found = id ? look_or_group(doc, id) : 0;
    if (!found)
        report_unknown_look(doc, name, doc_place(doc, doc->root), diags);
    for (unsigned depth = 0; found && doc_element(doc, found)->kind == KIND_LOOKGROUP; depth++) {
        if (depth == MAX_GROUPS) {
            diag_add(diags, DIAG_ID_look_cycle, doc_place(doc, found),
                     text_of(doc, doc_element(doc, found)->name), "as default");
            return 0;
        }
        found = default_of_group(doc, found, diags);
    }
    return found;
}

/* ---- Reading ---- */

/* The chain gets the look and its parents, the look first. */
static void find_parents(struct bind_look *look, struct chain *chain)
{
    const struct document *doc = look->doc;
    for (elem_id e = look->element; e;) {
        add_to(chain, e, look->arena);
        str_id base = doc_attr_value(doc, e, STR_inherit);
        elem_id parent = base ? doc_top_level(doc, KIND_LOOK, base) : 0;
        const char *name = text_of(doc, doc_element(doc, e)->name);
        if (base && !parent && strchr(text_of(doc, base), ','))
            diag_add(look->diags, DIAG_ID_inherit_several, doc_attr_place(doc, e, STR_inherit),
                     name, text_of(doc, base));
        else if (base && !parent)
            diag_add(look->diags, DIAG_ID_inherit_missing, doc_attr_place(doc, e, STR_inherit),
                     name, text_of(doc, base));
        if (parent && is_in(chain, parent)) {
            diag_add(look->diags, DIAG_ID_inherit_cycle, doc_attr_place(doc, e, STR_inherit), name);
            return;
        }
        e = parent;
    }
}

void look_begin(struct bind_look *look, const struct library *lib, elem_id element,
                const struct scene *scene, struct arena *arena, struct diag_list *diags)
{
    *look = (struct bind_look){.lib = lib,
                               .doc = &lib->doc,
                               .arena = arena,
                               .diags = diags,
                               .element = element,
                               .scene = scene};
    pattern_set_init(&look->patterns, arena);
    text_init(&look->written, arena);
}

void look_each_ancestor(struct bind_look *look,
                        void (*visit)(struct bind_look *look, elem_id element))
{
    struct chain chain = {0};
    struct diag_list ignored, *diags = look->diags; /* look_read reports them */
    diag_list_init_unheard(&ignored, look->arena);
    look->diags = &ignored;
    find_parents(look, &chain);
    look->diags = diags;
    for (uint32_t i = chain.len; i-- > 0;)
        visit(look, chain.items[i]);
}

static void read_variants(struct bind_look *look, elem_id parent)
{
    const struct document *doc = look->doc;
    for (elem_id e = doc_element(doc, parent)->first_child; e; e = doc_element(doc, e)->next)
        if (doc_element(doc, e)->kind == KIND_VARIANTASSIGN)
            look_read_variant(look, e);
}

static void read_assigns(struct bind_look *look, elem_id element)
{
    const struct document *doc = look->doc;
    uint32_t ordinal = 0;
    for (elem_id e = doc_element(doc, element)->first_child; e; e = doc_element(doc, e)->next)
        if (doc_element(doc, e)->kind == KIND_MATERIALASSIGN)
            look_read_assign(look, e, ++ordinal);
}

void look_read(struct bind_look *look, const struct library *lib, elem_id element,
               const struct scene *scene, struct arena *arena, struct diag_list *diags)
{
    const struct document *doc = &lib->doc;
    struct chain chain = {0};
    look_begin(look, lib, element, scene, arena, diags);
    /* at one primitive a collection beats a direct binding */
    for (unsigned is_collection = 0; is_collection < 2; is_collection++)
        for (uint32_t i = 0; i < scene->bindings.len; i++)
            if (!scene->bindings.items[i].is_removed
                && scene->bindings.items[i].is_collection == is_collection)
                look_read_binding(look, i);
    find_parents(look, &chain);
    for (uint32_t i = 0; i < chain.len && !look->order; i++)
        if (doc_attr(doc, chain.items[i], STR_slotorder))
            look->order = chain.items[i];
    for (uint32_t i = chain.len; i-- > 0;)
        read_variants(look, chain.items[i]);
    look->num_look_variants = look->variants.len;
    for (uint32_t i = chain.len; i-- > 0;)
        read_assigns(look, chain.items[i]);
    look_apply_variants(look);
    look_close_collections(look);
    look_sort_names(look);
}

void look_finish(struct bind_look *look)
{
    pattern_set_finish(&look->patterns);
}
