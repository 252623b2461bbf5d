// SPDX-License-Identifier: Apache-2.0
/* Upgrades that documents of every version need: spellings of other programs, and removed types. */
#include "document/upgrade.h"

/* "True" and "FALSE" are what Python and Houdini write. */
static const char *const words[][2] = {
    {"True", "true"}, {"TRUE", "true"}, {"False", "false"}, {"FALSE", "false"}};
enum { NUM_WORDS = sizeof words / sizeof *words };

static void lower_boolean(struct upgrade *u, elem_id element, str_id attr)
{
    str_id value = doc_attr_value(u->doc, element, attr);
    for (size_t i = 0; value && i < NUM_WORDS; i++) {
        if (!upgrade_is(u, value, words[i][0]))
            continue;
        doc_set_attr(u->doc, element, attr, upgrade_word(u, words[i][1]));
        upgrade_note(u, element, "'%s' is written '%s'", words[i][0], words[i][1]);
    }
}

static bool reads_property(str_id category)
{
    return category == STR_geompropvalue || category == STR_geompropvalueuniform;
}

/* Names may have no index yet. */
static bool has_input(const struct document *doc, elem_id node, str_id name)
{
    for (elem_id e = doc_element(doc, node)->first_child; e; e = doc_element(doc, e)->next)
        if (doc_element(doc, e)->name == name)
            return true;
    return false;
}

/* The specification of geometry extensions writes these inputs as attributes. */
static void make_inputs(struct upgrade *u, elem_id node)
{
    static const str_id names[] = {STR_geomprop, STR_default};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        str_id value = doc_attr_value(u->doc, node, names[i]);
        if (!value || has_input(u->doc, node, names[i]))
            continue;
        const char *name = str_text(u->doc->strings, names[i]);
        str_id type = names[i] == STR_default ? doc_attr_value(u->doc, node, STR_type) : STR_string;
        doc_remove_attr(u->doc, node, names[i]);
        upgrade_add_input(u, node, name, type, value);
        upgrade_note(u, node, "the attribute '%s' of <%s> is now an input", name,
                     str_text(u->doc->strings, doc_element(u->doc, node)->category));
    }
}

/* Strings are uniform properties. */
static void make_uniform(struct upgrade *u, elem_id node)
{
    str_id type = doc_attr_value(u->doc, node, STR_type);
    if (doc_element(u->doc, node)->category != STR_geompropvalue
        || (type != STR_string && type != STR_filename))
        return;
    doc_set_category(u->doc, node, STR_geompropvalueuniform);
    doc_remove_attr(u->doc, node, STR_nodedef);
    upgrade_note(u, node, "<geompropvalue> of a %s is <geompropvalueuniform>",
                 str_text(u->doc->strings, type));
}

/* Libraries until 1.39.1 define the node for strings under the name of the others. */
static void make_definition_uniform(struct upgrade *u, elem_id nodedef)
{
    if (doc_attr_value(u->doc, nodedef, STR_node) != STR_geompropvalue)
        return;
    str_id type = 0; /* of the output; names have no index yet */
    for (elem_id e = doc_element(u->doc, nodedef)->first_child; e; e = doc_element(u->doc, e)->next)
        if (doc_element(u->doc, e)->kind == KIND_OUTPUT)
            type = doc_attr_value(u->doc, e, STR_type);
    if (type != STR_string && type != STR_filename)
        return;
    doc_set_attr(u->doc, nodedef, STR_node, STR_geompropvalueuniform);
    upgrade_note(u, nodedef, "<geompropvalue> of a %s is <geompropvalueuniform>",
                 str_text(u->doc->strings, type));
}

void upgrade_property(struct upgrade *u, elem_id element)
{
    if (!upgrade_is_node(u, element) || !reads_property(doc_element(u->doc, element)->category))
        return;
    make_inputs(u, element);
    make_uniform(u, element);
}

void upgrade_always(struct upgrade *u)
{
    static const str_id switches[] = {STR_uniform, STR_isdefaultversion, STR_uiadvanced,
                                      STR_uivisible};
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e)) {
        if (doc_attr_value(u->doc, e, STR_type) == STR_boolean)
            lower_boolean(u, e, STR_value);
        for (size_t i = 0; i < sizeof switches / sizeof *switches; i++)
            lower_boolean(u, e, switches[i]);
        if (doc_element(u->doc, e)->kind == KIND_NODEDEF)
            make_definition_uniform(u, e);
        else
            upgrade_property(u, e);
    }
}

bool upgrade_always_changes(const struct document *doc, elem_id element)
{
    const struct element *e = doc_element(doc, element);
    if (reads_property(e->category) || e->kind == KIND_NODEDEF)
        return true;
    for (uint32_t i = 0; i < e->num_attrs; i++)
        for (size_t k = 0; k < NUM_WORDS; k++)
            if (strcmp(str_text(doc->strings, doc_attrs(doc, element)[i].value), words[k][0]) == 0)
                return true;
    return false;
}
