// SPDX-License-Identifier: Apache-2.0
/*
 * A definition of a nodegraph, which then implements it. What read the nodegraph reads a node of
 * the definition, so the document draws as before. All is found before the first change, so a
 * definition that cannot be leaves the document as it is.
 */
#include "api/edit.h"

struct defining {
    struct edit_change *c; /* `element` is the nodegraph, `category` the kind of node */
    elem_id nodedef, node; /* node 0: nothing takes part in the nodegraph from outside */
    VEC(elem_id) users;    /* ports that read the nodegraph */
    VEC(elem_id) ports;    /* inputs and tokens of the nodegraph */
    VEC(elem_id) outputs;
    bool is_connected; /* one of its inputs is */
};

static struct document *tree_of(struct defining *d)
{
    return edit_tree(d->c->edit);
}

static struct arena *arena_of(struct defining *d)
{
    return &d->c->edit->document->object.arena;
}

static bool stands_in_graph(const struct document *doc, elem_id port)
{
    elem_id parent = doc_element(doc, port)->parent;
    return parent != doc->root && doc_element(doc, parent)->parent != doc->root;
}

static void note_user(void *arg, elem_id user, str_id attr)
{
    struct defining *d = arg;
    struct edit_change *c = d->c;
    const struct document *doc = tree_of(d);
    uint16_t kind = doc_element(doc, user)->kind;
    if (attr == STR_contains)
        return;
    if (attr != STR_nodegraph || (kind != KIND_INPUT && kind != KIND_OUTPUT)
        || stands_in_graph(doc, user))
        edit_fail(c, "'%s' refers to '%s' by '%s', which can name no node beside it",
                  edit_label(c->edit, user), edit_label(c->edit, c->element),
                  str_text(doc->strings, attr));
    vec_push(arena_of(d), &d->users, user);
}

static void note_interface(struct defining *d)
{
    const struct document *doc = tree_of(d);
    for (elem_id e = doc_element(doc, d->c->element)->first_child; e;
         e = doc_element(doc, e)->next) {
        uint16_t kind = doc_element(doc, e)->kind;
        if (kind == KIND_INPUT || kind == KIND_TOKEN)
            vec_push(arena_of(d), &d->ports, e);
        if (kind == KIND_OUTPUT)
            vec_push(arena_of(d), &d->outputs, e);
        d->is_connected |= kind == KIND_INPUT && doc_is_connected(doc, e);
    }
}

/* The element beside the nodegraph that a port reads; 0: none. */
static elem_id source_of(const struct document *doc, elem_id port)
{
    static const str_id names[] = {STR_nodename, STR_nodegraph, STR_output};
    elem_id source = 0;
    for (unsigned i = 0; i < 3 && !source; i++) {
        str_id name = doc_attr_value(doc, port, names[i]);
        source = name ? doc_child(doc, doc->root, name) : 0;
    }
    return source;
}

struct search {
    struct defining *d;
    bool *seen; /* by the number of an element of this document */
    VEC(elem_id) next;
};

static void follow(struct search *s, elem_id reader, elem_id port)
{
    struct edit_change *c = s->d->c;
    const struct document *doc = tree_of(s->d);
    elem_id source = source_of(doc, port);
    if (source && source == c->element)
        edit_fail(c, "'%s' reads its own output through '%s', and no node can",
                  edit_label(c->edit, source), edit_label(c->edit, reader));
    if (!source || s->seen[source - doc->first_element])
        return;
    s->seen[source - doc->first_element] = true;
    vec_push(arena_of(s->d), &s->next, source);
}

/*
 * A nodegraph may read its own outputs through nodes beside it, as long as no node reads itself;
 * but a node of its definition would read itself.
 */
static void check_cycle(struct defining *d)
{
    const struct document *doc = tree_of(d);
    size_t size = doc_num_elements(doc) * sizeof(bool);
    struct search s = {.d = d, .seen = arena_alloc(arena_of(d), size)};
    memset(s.seen, 0, size);
    vec_push(arena_of(d), &s.next, d->c->element);
    while (s.next.len && !d->c->failed) {
        elem_id reader = vec_pop(&s.next);
        if (doc_element(doc, reader)->kind == KIND_OUTPUT)
            follow(&s, reader, reader);
        for (elem_id port = doc_element(doc, reader)->first_child; port && !d->c->failed;
             port = doc_element(doc, port)->next)
            if (doc_element(doc, port)->kind == KIND_INPUT)
                follow(&s, reader, port);
    }
}

/* False after a reason. */
static bool find(struct defining *d)
{
    struct edit_change *c = d->c;
    const struct document *doc = tree_of(d);
    if (!edit_check_element(c, &c->element, false) || !edit_check_new_name(c, doc->root, c->name)
        || !edit_check_name(c, "kind of node", c->category))
        return false;
    if (doc_kind_of(edit_word(c, c->category)) != KIND_NODE) {
        edit_fail(c, "'%s' is an element of MaterialX, and no kind of node", c->category);
        return false;
    }
    const struct element *graph = doc_element(doc, c->element);
    str_id defined = doc_attr_value(doc, c->element, STR_nodedef);
    const char *label = edit_label(c->edit, c->element);
    if (graph->kind != KIND_NODEGRAPH || graph->parent != doc->root) {
        edit_fail(c, "'%s' is no nodegraph of the root", label);
        return false;
    }
    note_interface(d);
    doc_visit_users(tree_of(d), c->element, note_user, d);
    if (defined)
        edit_fail(c, "'%s' implements '%s' already", label, str_text(doc->strings, defined));
    else if (!d->outputs.len)
        edit_fail(c, "'%s' has no output", label);
    else
        check_cycle(d);
    return !c->failed && edit_check_room(c, 2 + (uint64_t)d->ports.len + d->outputs.len);
}

/* ---- The definition ---- */

static const char *type_of(struct defining *d, elem_id port)
{
    const struct document *doc = tree_of(d);
    return str_text(doc->strings, doc_attr_value(doc, port, STR_type));
}

/* Attributes of the nodegraph about the values of its inputs go where these go. */
static void add_nodedef(struct defining *d)
{
    static const str_id inherited[] = {STR_colorspace, STR_fileprefix};
    struct document *doc = tree_of(d);
    d->nodedef = edit_add(d->c, doc->root, "nodedef", d->c->name, NULL);
    doc_set_attr(doc, d->nodedef, STR_node, edit_word(d->c, d->c->category));
    for (size_t i = 0; i < sizeof inherited / sizeof *inherited; i++) {
        str_id value = doc_attr_value(doc, d->c->element, inherited[i]);
        if (value)
            doc_set_attr(doc, d->nodedef, inherited[i], value);
    }
    doc_move_before(doc, d->nodedef, d->c->element);
    doc_set_attr(doc, d->c->element, STR_nodedef, doc_element(doc, d->nodedef)->name);
    doc_index_change(doc, d->c->element);
}

/* The node that stands in for the nodegraph: the name of its kind, with a number if it is taken. */
static void add_node(struct defining *d)
{
    struct document *doc = tree_of(d);
    struct text name;
    text_init(&name, arena_of(d));
    text_str(&name, d->c->category);
    size_t len = name.len;
    for (unsigned i = 2; edit_child(d->c->edit, doc->root, text_cstr(&name)); i++) {
        name.len = len;
        text_fmt(&name, "%u", i);
    }
    d->node = edit_add(d->c, doc->root, d->c->category, text_cstr(&name),
                       d->outputs.len == 1 ? type_of(d, d->outputs.items[0]) : "multioutput");
    elem_id next = doc_element(doc, d->c->element)->next;
    if (next != d->node)
        doc_move_before(doc, d->node, next);
    edit_replace_in_frames(d->c, d->c->element, doc_element(doc, d->node)->name);
}

/* Moves the connections of a port to another one. */
static void move_connections(struct defining *d, elem_id from, elem_id to)
{
    struct document *doc = tree_of(d);
    for (size_t i = 0; i < DOC_NUM_CONNECTIONS; i++) {
        str_id value = doc_attr_value(doc, from, doc_connections[i]);
        if (value)
            doc_set_attr(doc, to, doc_connections[i], value);
    }
    doc_disconnect(doc, from);
    doc_index_change(doc, to);
}

static void move_ports(struct defining *d)
{
    struct document *doc = tree_of(d);
    for (uint32_t i = 0; i < d->ports.len; i++) {
        elem_id port = d->ports.items[i];
        if (doc_is_connected(doc, port))
            move_connections(
                d, port, edit_add(d->c, d->node, "input", doc_name(doc, port), type_of(d, port)));
        doc_move_element(doc, port, d->nodedef);
        doc_index_change(doc, port);
    }
    for (uint32_t i = 0; i < d->outputs.len; i++) {
        elem_id output = d->outputs.items[i];
        edit_add(d->c, d->nodedef, "output", doc_name(doc, output), type_of(d, output));
    }
}

static void connect_users(struct defining *d)
{
    struct document *doc = tree_of(d);
    for (uint32_t i = 0; i < d->users.len; i++) {
        elem_id port = d->users.items[i];
        str_id output = d->outputs.len > 1 ? doc_attr_value(doc, port, STR_output) : 0;
        doc_disconnect(doc, port);
        doc_set_attr(doc, port, STR_nodename, doc_element(doc, d->node)->name);
        if (output)
            doc_set_attr(doc, port, STR_output, output);
        doc_index_change(doc, port);
    }
}

static void define(void *arg)
{
    struct defining d = {.c = arg};
    if (!find(&d))
        return;
    add_nodedef(&d);
    if (d.users.len || d.is_connected)
        add_node(&d);
    move_ports(&d);
    connect_users(&d);
    d.c->result = d.nodedef;
}

mxg_element mxg_edit_define_nodegraph(mxg_edit *edit, mxg_element nodegraph, const char *name,
                                      const char *node)
{
    struct edit_change change = {
        .edit = edit, .element = nodegraph, .name = name, .category = node};
    return edit && edit_run(&change, define) == MXG_OK ? change.result : 0;
}
