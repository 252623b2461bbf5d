// SPDX-License-Identifier: Apache-2.0
/* Names and other attributes of elements in an edit. */
#include "api/edit.h"

/* ---- Ports that have their names from a port of a definition ---- */

enum { MAX_ANCESTORS = 256 }; /* of definitions that inherit; they may be a circle */

struct renaming {
    struct edit_change *change;
    struct document *doc;
    struct library view;
    struct diag_list unheard;
    elem_id port, nodedef;
    VEC(elem_id) followers;
};

static elem_id named_nodedef(const struct renaming *r, elem_id user, str_id attr)
{
    return doc_top_level(r->doc, KIND_NODEDEF, doc_attr_value(r->doc, user, attr));
}

/* True for the definition of the port, and those that inherit it. */
static bool has_port(const struct renaming *r, elem_id nodedef)
{
    for (unsigned i = 0; i < MAX_ANCESTORS && nodedef && nodedef != r->nodedef; i++)
        nodedef = named_nodedef(r, nodedef, STR_inherit);
    return nodedef == r->nodedef;
}

static elem_id nodedef_of_node(struct renaming *r, elem_id node)
{
    if (doc_attr_value(r->doc, node, STR_nodedef))
        return named_nodedef(r, node, STR_nodedef);
    uint32_t found = library_match(&r->view, node, &r->unheard);
    return found == LIBRARY_NONE ? 0 : library_nodedef(&r->view, found)->element;
}

/* True if a set of variants is for definitions with the port, and no other has one of its name. */
static bool is_of_set(const struct renaming *r, elem_id set)
{
    const struct document *doc = r->doc;
    str_id node = doc_attr_value(doc, set, STR_node), port = doc_element(doc, r->port)->name;
    bool is_ours = false, is_others = false;
    if (doc_attr_value(doc, set, STR_nodedef))
        return has_port(r, named_nodedef(r, set, STR_nodedef));
    for (elem_id e = doc_element(doc, doc->root)->first_child; e; e = doc_element(doc, e)->next) {
        if (doc_element(doc, e)->kind != KIND_NODEDEF
            || (node && doc_attr_value(doc, e, STR_node) != node))
            continue;
        bool has = has_port(r, e);
        is_ours |= has;
        is_others |= !has && doc_child(doc, e, port);
    }
    return is_ours && !is_others;
}

static bool is_of_owner(struct renaming *r, elem_id owner)
{
    const struct element *e = doc_element(r->doc, owner);
    switch (e->kind) {
    case KIND_NODEDEF: return has_port(r, owner);
    case KIND_NODE: return has_port(r, nodedef_of_node(r, owner));
    case KIND_IMPLEMENTATION: return has_port(r, named_nodedef(r, owner, STR_nodedef));
    case KIND_VARIANT: return is_of_set(r, e->parent);
    default: return false;
    }
}

/* Lists them before the first change: the view ends with it. */
static void find_followers(struct renaming *r)
{
    const struct document *doc = r->doc;
    const struct element port = *doc_element(doc, r->port);
    for (elem_id e = doc->root; e; e = doc_next_in_tree(doc, doc->root, e)) {
        const struct element *other = doc_element(doc, e);
        if (other->name != port.name || other->kind != port.kind || e == r->port
            || !is_of_owner(r, other->parent))
            continue;
        if (edit_child(r->change->edit, other->parent, r->change->text))
            edit_fail(r->change, "'%s' has the port, too, and an element '%s' already",
                      edit_label(r->change->edit, other->parent), r->change->text);
        vec_push(doc->arena, &r->followers, e);
    }
}

static void rename_port(struct edit_change *c)
{
    struct document *doc = edit_tree(c->edit);
    struct renaming r = {.change = c,
                         .doc = doc,
                         .port = c->element,
                         .nodedef = doc_element(doc, c->element)->parent};
    diag_list_init_unheard(&r.unheard, doc->arena);
    edit_view(c->edit, &r.view);
    find_followers(&r);
    if (c->failed)
        return;
    doc_rename(doc, c->element, edit_word(c, c->text));
    for (uint32_t i = 0; i < r.followers.len; i++)
        doc_rename(doc, r.followers.items[i], edit_word(c, c->text));
}

/* ---- Attributes ---- */

static void rename_element(void *arg)
{
    struct edit_change *c = arg;
    if (!edit_check_element(c, &c->element, false))
        return;
    const struct document *doc = edit_tree(c->edit);
    const struct element *e = doc_element(doc, c->element);
    if ((c->text && strcmp(str_text(doc->strings, e->name), c->text) == 0)
        || !edit_check_new_name(c, e->parent, c->text))
        return;
    bool is_port = e->kind == KIND_INPUT || e->kind == KIND_TOKEN;
    if (is_port && e->name && doc_element(doc, e->parent)->kind == KIND_NODEDEF)
        rename_port(c);
    else
        doc_rename(edit_tree(c->edit), c->element, edit_word(c, c->text));
}

mxg_status mxg_edit_rename_element(mxg_edit *edit, mxg_element element, const char *name)
{
    struct edit_change change = {.edit = edit, .element = element, .text = name};
    return edit ? edit_run(&change, rename_element) : MXG_ERROR_ARGUMENT;
}

/* Attributes with two prefixes may be one to XML: prefixes of one namespace are equal there. */
static void check_prefix(struct edit_change *c)
{
    const struct document *doc = edit_tree(c->edit);
    const char *colon = strchr(c->name, ':');
    for (uint32_t i = 0; colon && i < doc_element(doc, c->element)->num_attrs; i++) {
        const char *other = str_text(doc->strings, doc_attrs(doc, c->element)[i].name),
                   *end = strchr(other, ':');
        if (end && strcmp(end, colon) == 0 && strcmp(other, c->name) != 0)
            edit_fail(c, "the element has '%s', which may be one with '%s' to XML", other, c->name);
    }
}

static void check_attribute(struct edit_change *c)
{
    const struct document *doc = edit_tree(c->edit);
    bool is_version = c->element == doc->root && strcmp(c->name, "version") == 0;
    if (is_version && !(c->text && doc_is_current_version(c->text)))
        edit_fail(c, "the version of a document is 1.39: an edit does not upgrade it");
    else if (c->text && edit_check_xml_name(c, "attribute", c->name))
        check_prefix(c);
}

static void set(void *arg)
{
    struct edit_change *c = arg;
    if (!edit_check_element(c, &c->element, true) || !edit_check_name(c, "attribute", c->name)
        || !edit_check_text(c, "value", c->text))
        return;
    check_attribute(c);
    if (c->failed)
        return;
    if (c->text)
        doc_set_attr(edit_tree(c->edit), c->element, edit_word(c, c->name), edit_word(c, c->text));
    else
        doc_remove_attr(edit_tree(c->edit), c->element, edit_word(c, c->name));
    doc_index_change(edit_tree(c->edit), c->element);
}

mxg_status mxg_edit_set_attribute(mxg_edit *edit, mxg_element element, const char *attribute,
                                  const char *value)
{
    if (attribute && strcmp(attribute, "name") == 0)
        return mxg_edit_rename_element(edit, element, value);
    struct edit_change change = {
        .edit = edit, .element = element, .name = attribute, .text = value};
    return edit ? edit_run(&change, set) : MXG_ERROR_ARGUMENT;
}
