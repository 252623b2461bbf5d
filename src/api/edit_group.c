// SPDX-License-Identifier: Apache-2.0
/*
 * A nodegraph of nodes of the root. Each source outside that they read becomes an input of the
 * nodegraph, and each result that others read becomes an output. All is found before the first
 * change, so a group that cannot be leaves the document as it is.
 */
#include "api/edit.h"

#include "base/hash.h"

#include <stdlib.h>

/* A port outside the group that reads a node of it. */
struct group_user {
    elem_id port, node;
    const char *type; /* of what it reads */
};

struct grouping {
    struct edit_change *c;
    elem_id *sorted; /* the nodes, each once */
    uint32_t num;
    elem_id graph;
    VEC(struct group_user) users;
    VEC(elem_id) readers;         /* ports of the nodes that read something outside */
    VEC(elem_id) ports;           /* inputs and outputs of the nodegraph */
    struct table inputs, outputs; /* of what they give, to `ports` + 1 */
};

static struct document *tree_of(struct grouping *g)
{
    return edit_tree(g->c->edit);
}

static struct arena *arena_of(struct grouping *g)
{
    return &g->c->edit->document->object.arena;
}

static int compare_elements(const void *x, const void *y)
{
    elem_id a = *(const elem_id *)x, b = *(const elem_id *)y;
    return (a > b) - (a < b);
}

static bool is_in_group(const struct grouping *g, elem_id element)
{
    return element && bsearch(&element, g->sorted, g->num, sizeof element, compare_elements);
}

/* ---- Checks ---- */

static void check_nodes(struct grouping *g)
{
    struct edit_change *c = g->c;
    const struct document *doc = tree_of(g);
    g->sorted = ARENA_ARRAY(arena_of(g), elem_id, c->num_nodes + 1);
    if (!c->num_nodes)
        edit_fail(c, "there is no node");
    for (uint32_t i = 0; i < c->num_nodes && !c->failed; i++) {
        elem_id node = c->nodes[i];
        if (!edit_check_element(c, &node, false))
            return;
        const struct element *e = doc_element(doc, node);
        if (e->kind != KIND_NODE || e->parent != doc->root)
            edit_fail(c, "'%s' is no node of the root; nodegraphs hold no nodegraphs",
                      edit_label(c->edit, node));
        g->sorted[g->num++] = node;
    }
    if (c->failed)
        return;
    qsort(g->sorted, g->num, sizeof *g->sorted, compare_elements);
    for (uint32_t i = 1; i < g->num && !c->failed; i++)
        if (g->sorted[i] == g->sorted[i - 1])
            edit_fail(c, "'%s' stands twice among the nodes", edit_label(c->edit, g->sorted[i]));
}

/* c->other is the node. */
static void note_user(void *arg, elem_id user, str_id attr)
{
    struct grouping *g = arg;
    struct edit_change *c = g->c;
    const struct document *doc = tree_of(g);
    bool is_frame = attr == STR_contains;
    if (is_frame || is_in_group(g, doc_element(doc, user)->parent) || c->failed)
        return;
    str_id output = doc_attr_value(doc, user, STR_output);
    c->text = output ? str_text(doc->strings, output) : NULL;
    struct group_user added = {user, c->other, edit_source_type(c)};
    if (attr != STR_nodename)
        edit_fail(c, "'%s' refers to '%s' by '%s', which can name no part of a nodegraph",
                  edit_label(c->edit, user), edit_label(c->edit, c->other),
                  str_text(doc->strings, attr));
    else if (!*added.type)
        edit_fail(c, "the type of what '%s' reads of '%s' is unknown", edit_label(c->edit, user),
                  edit_label(c->edit, c->other));
    vec_push(arena_of(g), &g->users, added);
}

/* Notes the ports of a node that read something outside of the group. */
static void note_readers(struct grouping *g, elem_id node)
{
    const struct document *doc = tree_of(g);
    for (elem_id e = doc_element(doc, node)->first_child; e; e = doc_element(doc, e)->next) {
        bool reads = doc_element(doc, e)->kind == KIND_INPUT && doc_is_connected(doc, e);
        if (reads && !is_in_group(g, doc_named_node(doc, e)))
            vec_push(arena_of(g), &g->readers, e);
    }
}

/* False after a reason. */
static bool find(struct grouping *g)
{
    struct edit_change *c = g->c;
    if (!edit_check_new_name(c, tree_of(g)->root, c->name))
        return false;
    check_nodes(g);
    for (uint32_t i = 0; i < g->num && !c->failed; i++) {
        c->other = c->nodes[i];
        doc_visit_users(tree_of(g), c->other, note_user, g);
        note_readers(g, c->other);
    }
    return !c->failed && edit_check_room(c, 1 + (uint64_t)g->users.len + g->readers.len);
}

/* ---- The nodegraph ---- */

static void move_nodes(struct grouping *g)
{
    struct document *doc = tree_of(g);
    g->graph = edit_add(g->c, doc->root, "nodegraph", g->c->name, NULL);
    doc_move_before(doc, g->graph, g->c->nodes[0]);
    for (uint32_t i = 0; i < g->num; i++) {
        edit_replace_in_frames(g->c, g->c->nodes[i], doc_element(doc, g->graph)->name);
        doc_move_element(doc, g->c->nodes[i], g->graph);
        doc_index_change(doc, g->c->nodes[i]);
    }
}

/* A new port of the nodegraph: `name`, with a number if the nodegraph has that name. */
static elem_id add_port(struct grouping *g, const char *category, const char *name,
                        const char *type)
{
    struct text text;
    text_init(&text, arena_of(g));
    text_str(&text, name);
    size_t len = text.len;
    for (unsigned i = 2; edit_child(g->c->edit, g->graph, text_cstr(&text)); i++) {
        text.len = len;
        text_fmt(&text, "_%u", i);
    }
    elem_id port = edit_add(g->c, g->graph, category, text_cstr(&text), type);
    vec_push(arena_of(g), &g->ports, port);
    return port;
}

static uint32_t hash_source(const struct document *doc, elem_id port)
{
    uint32_t hash = doc_attr_value(doc, port, STR_type);
    for (size_t i = 0; i < DOC_NUM_CONNECTIONS; i++)
        hash = hash_pair(hash, doc_attr_value(doc, port, doc_connections[i]));
    return hash;
}

static bool have_same_source(const struct document *doc, elem_id a, elem_id b)
{
    bool are_same = doc_attr_value(doc, a, STR_type) == doc_attr_value(doc, b, STR_type);
    for (size_t i = 0; i < DOC_NUM_CONNECTIONS; i++)
        are_same &= doc_attr_value(doc, a, doc_connections[i])
                    == doc_attr_value(doc, b, doc_connections[i]);
    return are_same;
}

/* The input of the nodegraph that gives what a port of a node reads. */
static elem_id input_for(struct grouping *g, elem_id reader)
{
    struct document *doc = tree_of(g);
    uint32_t hash = hash_source(doc, reader);
    for (uint32_t at = hash, found; (found = table_next(&g->inputs, hash, &at));)
        if (have_same_source(doc, g->ports.items[found - 1], reader))
            return g->ports.items[found - 1];
    elem_id input = add_port(g, "input", doc_name(doc, reader),
                             str_text(doc->strings, doc_attr_value(doc, reader, STR_type)));
    table_add(&g->inputs, arena_of(g), hash, g->ports.len);
    for (size_t i = 0; i < DOC_NUM_CONNECTIONS; i++) {
        str_id value = doc_attr_value(doc, reader, doc_connections[i]);
        if (value)
            doc_set_attr(doc, input, doc_connections[i], value);
    }
    doc_index_change(doc, input);
    doc_move_before(doc, input, g->c->nodes[0]);
    return input;
}

static void connect_readers(struct grouping *g)
{
    struct document *doc = tree_of(g);
    for (uint32_t i = 0; i < g->readers.len; i++) {
        elem_id reader = g->readers.items[i], input = input_for(g, reader);
        doc_disconnect(doc, reader);
        doc_set_attr(doc, reader, STR_interfacename, doc_element(doc, input)->name);
        doc_index_change(doc, reader);
    }
}

/* The output of the nodegraph that gives what a port outside reads. */
static elem_id output_for(struct grouping *g, const struct group_user *user)
{
    struct document *doc = tree_of(g);
    str_id of = doc_attr_value(doc, user->port, STR_output);
    uint32_t hash = hash_pair(user->node, of);
    for (uint32_t at = hash, found; (found = table_next(&g->outputs, hash, &at));) {
        elem_id output = g->ports.items[found - 1];
        if (doc_named_node(doc, output) == user->node
            && doc_attr_value(doc, output, STR_output) == of)
            return output;
    }
    struct text name;
    text_init(&name, arena_of(g));
    text_fmt(&name, "%s_%s", edit_label(g->c->edit, user->node),
             of ? str_text(doc->strings, of) : "out");
    elem_id output = add_port(g, "output", text_cstr(&name), user->type);
    table_add(&g->outputs, arena_of(g), hash, g->ports.len);
    doc_set_attr(doc, output, STR_nodename, doc_element(doc, user->node)->name);
    if (of)
        doc_set_attr(doc, output, STR_output, of);
    doc_index_change(doc, output);
    return output;
}

static void connect_users(struct grouping *g)
{
    struct document *doc = tree_of(g);
    for (uint32_t i = 0; i < g->users.len; i++) {
        elem_id port = g->users.items[i].port, output = output_for(g, &g->users.items[i]);
        doc_disconnect(doc, port);
        doc_set_attr(doc, port, STR_nodegraph, doc_element(doc, g->graph)->name);
        doc_set_attr(doc, port, STR_output, doc_element(doc, output)->name);
        doc_index_change(doc, port);
    }
}

static void group(void *arg)
{
    struct grouping g = {.c = arg};
    if (!find(&g))
        return;
    move_nodes(&g);
    connect_readers(&g);
    connect_users(&g);
    g.c->result = g.graph;
}

mxg_element mxg_edit_group_nodes(mxg_edit *edit, const mxg_element *nodes, uint32_t num_nodes,
                                 const char *name)
{
    struct edit_change change = {
        .edit = edit, .nodes = nodes, .num_nodes = nodes ? num_nodes : 0, .name = name};
    return edit && edit_run(&change, group) == MXG_OK ? change.result : 0;
}
