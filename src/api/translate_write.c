// SPDX-License-Identifier: Apache-2.0
/*
 * Writes the new surface in the place of the old one. Its nodes stand in a nodegraph of their own,
 * whose inputs are connected as those of the old surface were; a surface inside a nodegraph has its
 * nodes beside it.
 */
#include "api/translate.h"

struct writing {
    struct translation *t;
    mxg_element scope; /* of the nodes: a new nodegraph, or what is around the surface */
    bool has_own_graph;
    mxg_element *elements; /* by node of t->nodes */
    bool *is_needed;       /* by node, too */
    mxg_element surface;   /* the new one */
};

/* Marks the nodes that the inputs of the surface need; false: none. */
static bool find_needed(struct writing *w)
{
    bool has_any = false;
    const struct value_nodes *nodes = &w->t->nodes;
    w->is_needed = ARENA_ARRAY(w->t->arena, bool, nodes->nodes.len + 1);
    for (uint32_t i = 0; i < w->t->inputs.len; i++)
        if (w->t->inputs.items[i].is_set && w->t->inputs.items[i].value.kind == OPERAND_NODE)
            has_any = w->is_needed[w->t->inputs.items[i].value.index] = true;
    for (uint32_t i = nodes->nodes.len; i-- > 0;)
        for (unsigned k = 0; w->is_needed[i] && k < nodes->nodes.items[i].num_inputs; k++)
            if (nodes->nodes.items[i].inputs[k].kind == OPERAND_NODE)
                w->is_needed[nodes->nodes.items[i].inputs[k].index] = true;
    return has_any;
}

static const char *name_of(const struct translation *t, elem_id element)
{
    const struct document *doc = &t->document->layer.doc;
    return doc_name(doc, element);
}

/* "prefix_suffix", with a number if the scope has that name already. */
static const char *free_name(const struct writing *w, mxg_element scope, const char *prefix,
                             const char *suffix)
{
    struct text name;
    text_init(&name, w->t->arena);
    text_fmt(&name, "%s%s", prefix, suffix);
    for (unsigned i = 2; mxg_edit_find_element(w->t->edit, scope, text_cstr(&name)); i++) {
        name.len = 0;
        text_fmt(&name, "%s%s%u", prefix, suffix, i);
    }
    return text_cstr(&name);
}

const char *translate_text_of(const struct translation *t, const struct operand *constant)
{
    struct text text;
    text_init(&text, t->arena);
    value_write(constant, &text);
    return text_cstr(&text);
}

void translate_set_constant(const struct translation *t, mxg_element node, const char *input,
                            const struct operand *value)
{
    const struct document *doc = &t->document->layer.doc;
    translate_expect(t, mxg_edit_set_value(t->edit, node, input, value_type_name(value->type),
                                           translate_text_of(t, value))
                            == MXG_OK);
    str_id space = doc_inherited_attr(doc, t->surface, STR_colorspace);
    bool is_color = value->type == VALUE_COLOR3 || value->type == VALUE_COLOR4;
    if (is_color && space && strcmp(str_text(doc->strings, space), library_color_hub) != 0)
        mxg_edit_set_attribute(t->edit, mxg_edit_find_element(t->edit, node, input), "colorspace",
                               library_color_hub);
}

/* Gives the graph of a map an output for what the map reads. */
static const char *add_map_output(const struct writing *w, mxg_element graph,
                                  const struct source_input *source)
{
    static const str_id kept[] = {STR_nodename, STR_nodegraph, STR_output};
    const struct document *doc = &w->t->document->layer.doc;
    const char *name = free_name(w, graph, "map", "_out");
    mxg_element output =
        mxg_edit_add_element(w->t->edit, graph, "output", name, value_type_name(source->type));
    translate_expect(w->t, output != 0);
    for (size_t i = 0; i < sizeof kept / sizeof *kept; i++) {
        str_id value = doc_attr_value(doc, source->map, kept[i]);
        if (value)
            mxg_edit_set_attribute(w->t->edit, output, str_text(doc->strings, kept[i]),
                                   str_text(doc->strings, value));
    }
    return name;
}

/* The connection of the old surface, or what its map reads, at an input of another element. */
static void copy_leaf(const struct writing *w, mxg_element to, const char *input, uint32_t leaf)
{
    struct source_input *source = &w->t->sources.items[leaf];
    const struct document *doc = &w->t->document->layer.doc;
    elem_id from = source->map ? source->map : source->element;
    elem_id graph = source->map ? doc_element(doc, doc_element(doc, from)->parent)->parent : 0;
    if (!graph || graph == doc_element(doc, w->t->surface)->parent) {
        translate_expect(w->t,
                         mxg_edit_copy_element(w->t->edit, to, w->t->document, from, input) != 0);
        return;
    }
    if (!source->map_output)
        source->map_output = add_map_output(w, graph, source);
    translate_expect(w->t, mxg_edit_connect_input(w->t->edit, to, input, graph, source->map_output)
                               == MXG_OK);
}

/* ---- Nodes ---- */

static void set_input(const struct writing *w, mxg_element node, const char *input,
                      const struct operand *value)
{
    mxg_edit *edit = w->t->edit;
    if (value->kind == OPERAND_CONSTANT) {
        translate_set_constant(w->t, node, input, value);
    } else if (value->kind == OPERAND_NODE) {
        translate_expect(w->t,
                         mxg_edit_connect_input(edit, node, input, w->elements[value->index], NULL)
                             == MXG_OK);
    } else if (!w->has_own_graph) {
        copy_leaf(w, node, input, value->index);
    } else {
        const char *name = w->t->sources.items[value->index].port.name;
        mxg_element port = mxg_edit_find_element(edit, w->scope, name);
        translate_expect(w->t, mxg_edit_connect_input(edit, node, input, port, NULL) == MXG_OK);
    }
}

/* Declares the inputs of the graph: the leaves that nodes read. */
static void add_graph_inputs(const struct writing *w)
{
    const struct value_nodes *nodes = &w->t->nodes;
    for (uint32_t leaf = 0; leaf < w->t->sources.len; leaf++) {
        bool is_read = false;
        for (uint32_t i = 0; i < nodes->nodes.len && !is_read; i++)
            for (unsigned k = 0; w->is_needed[i] && k < nodes->nodes.items[i].num_inputs; k++)
                is_read = is_read
                          || (nodes->nodes.items[i].inputs[k].kind == OPERAND_LEAF
                              && nodes->nodes.items[i].inputs[k].index == leaf);
        if (is_read)
            copy_leaf(w, w->scope, w->t->sources.items[leaf].port.name, leaf);
    }
}

static void add_nodes(struct writing *w)
{
    struct translation *t = w->t;
    w->elements = ARENA_ARRAY(t->arena, mxg_element, t->nodes.nodes.len);
    for (uint32_t i = 0; i < t->nodes.nodes.len; i++) {
        const struct value_node *node = &t->nodes.nodes.items[i];
        if (!w->is_needed[i])
            continue;
        const char *prefix = w->has_own_graph ? "" : name_of(t, t->surface);
        struct text name;
        text_init(&name, t->arena);
        text_fmt(&name, "%s%s%s", prefix, *prefix ? "_" : "", node->category);
        w->elements[i] = mxg_edit_add_element(t->edit, w->scope, node->category,
                                              free_name(w, w->scope, text_cstr(&name), ""),
                                              value_type_name(node->type));
        translate_expect(t, w->elements[i] != 0);
        for (unsigned k = 0; k < node->num_inputs; k++)
            set_input(w, w->elements[i], node->names[k], &node->inputs[k]);
    }
}

static void add_scope(struct writing *w)
{
    struct translation *t = w->t;
    const struct document *doc = &t->document->layer.doc;
    elem_id parent = doc_element(doc, t->surface)->parent;
    w->has_own_graph = parent == doc->root;
    w->scope = parent;
    if (!find_needed(w))
        return;
    if (w->has_own_graph) {
        struct text name;
        text_init(&name, t->arena);
        text_fmt(&name, "NG_%s_", name_of(t, t->surface));
        w->scope = mxg_edit_add_element(t->edit, 0, "nodegraph",
                                        free_name(w, 0, text_cstr(&name), t->model), NULL);
        translate_expect(t, w->scope != 0);
        mxg_edit_move_element(t->edit, w->scope, 0, t->surface);
        add_graph_inputs(w);
    }
    add_nodes(w);
}

/* ---- The surface ---- */

/* An output of the graph for an input of the surface. */
static void connect_through_graph(const struct writing *w, const char *input,
                                  const struct operand *value)
{
    mxg_edit *edit = w->t->edit;
    const char *name = free_name(w, w->scope, input, "_out");
    mxg_element output =
        mxg_edit_add_element(edit, w->scope, "output", name, value_type_name(value->type));
    translate_expect(
        w->t,
        output != 0
            && mxg_edit_connect_input(edit, output, NULL, w->elements[value->index], NULL) == MXG_OK
            && mxg_edit_connect_input(edit, w->surface, input, w->scope, name) == MXG_OK);
}

static bool is_default(const struct writing *w, const struct translated_input *input)
{
    return input->value.kind == OPERAND_CONSTANT
           && translate_is_default(&input->port, w->t->document->layer.doc.strings,
                                   translate_text_of(w->t, &input->value));
}

static void set_surface_input(const struct writing *w, const struct translated_input *input)
{
    const struct operand *value = &input->value;
    if (value->kind == OPERAND_LEAF)
        copy_leaf(w, w->surface, input->port.name, value->index);
    else if (value->kind == OPERAND_NODE && w->has_own_graph)
        connect_through_graph(w, input->port.name, value);
    else if (value->kind == OPERAND_NODE || !is_default(w, input))
        set_input(w, w->surface, input->port.name, value);
}

void translate_write(struct translation *t)
{
    struct writing w = {.t = t};
    const struct document *doc = &t->document->layer.doc;
    elem_id parent = doc_element(doc, t->surface)->parent;
    const char *name = name_of(t, t->surface);
    add_scope(&w);
    w.surface = mxg_edit_add_element(t->edit, parent, t->model,
                                     free_name(&w, parent, name, "_translated"), "surfaceshader");
    translate_expect(t, w.surface != 0);
    for (uint32_t i = 0; i < t->inputs.len; i++)
        if (t->inputs.items[i].is_set)
            set_surface_input(&w, &t->inputs.items[i]);
    translate_expect(t, mxg_edit_move_element(t->edit, w.surface, parent, t->surface) == MXG_OK);
    /* elements of the same name behind the surface are ignored, but they would have its name now */
    for (mxg_element old = t->surface; old; old = mxg_edit_find_element(t->edit, parent, name))
        translate_expect(t, mxg_edit_remove_element(t->edit, old) == MXG_OK);
    translate_expect(t, mxg_edit_set_attribute(t->edit, w.surface, "name", name) == MXG_OK);
}
