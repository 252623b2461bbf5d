// SPDX-License-Identifier: Apache-2.0
/*
 * Libraries of older versions. A definition of MaterialX before 1.39 has the interface of its time,
 * and many had code of MaterialX's generators in place of source, such as <convert> and <switch>.
 * The nodes of documents and graphs are upgraded to 1.39, so its definitions serve them.
 */
#include "base/hash.h"
#include "library/library.h"

enum { MAX_NAMED = 3 };

struct older {
    struct library *lib;
    struct table left; /* names of definitions */
    uint32_t num_left;
    elem_id first;
    struct text names;
};

static bool is_left(const struct older *o, str_id name)
{
    uint32_t hash = hash_pair(name, 0), at = hash, found;
    while ((found = table_next(&o->left, hash, &at)) != 0)
        if (found == name)
            return true;
    return false;
}

static void leave(struct older *o, elem_id definition)
{
    str_id name = doc_element(&o->lib->doc, definition)->name;
    o->first = o->num_left++ ? o->first : definition;
    if (o->num_left <= MAX_NAMED)
        text_fmt(&o->names, "%s%s", o->num_left > 1 ? ", " : "", str_text(&o->lib->strings, name));
    table_add(&o->left, o->lib->doc.arena, hash_pair(name, 0), name);
    doc_remove_element(&o->lib->doc, definition);
}

/* Definitions of the ranges that a lower layer has by name. */
static void leave_definitions(struct older *o)
{
    struct document *doc = &o->lib->doc;
    for (uint32_t i = 0; i < doc->older.len; i++)
        for (elem_id e = doc->older.items[i].first; e < doc->older.items[i].end; e++) {
            const struct element *element = doc_element(doc, e);
            if (element->kind == KIND_NODEDEF && element->parent == doc->root
                && library_nodedef_by_name(o->lib->base, element->name) != LIBRARY_NONE)
                leave(o, e);
        }
}

void library_leave_older(struct library *lib, struct diag_list *diags)
{
    struct document *doc = &lib->doc;
    struct older o = {.lib = lib};
    if (!lib->base || doc->older.len == 0)
        return;
    text_init(&o.names, doc->arena);
    leave_definitions(&o);
    elem_id next;
    for (elem_id e = doc_element(doc, doc->root)->first_child; e; e = next) {
        next = doc_element(doc, e)->next;
        str_id definition = doc_attr_value(doc, e, STR_nodedef);
        enum element_kind kind = doc_element(doc, e)->kind;
        if ((kind == KIND_IMPLEMENTATION || kind == KIND_NODEGRAPH) && is_left(&o, definition))
            doc_remove_element(doc, e);
    }
    if (o.num_left)
        diag_add(diags, DIAG_ID_older_definitions, doc_name_place(doc, o.first),
                 (unsigned)o.num_left, text_cstr(&o.names), o.num_left > MAX_NAMED ? ", …" : "");
}
