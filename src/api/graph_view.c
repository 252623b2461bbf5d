// SPDX-License-Identifier: Apache-2.0
/*
 * Prints the graph of a document: nodes with their definitions, and inputs with their connections.
 */
#include "api/generation.h"

#include <assert.h>

struct graph_view {
    struct generation *g;
    const struct library *layer;
    const struct document *doc;
    struct text *out;
    struct resolve_out resolved;
    uint8_t *wanted; /* per own element; NULL: all */
};

static const char *text_of(const struct graph_view *view, str_id id)
{
    return str_text(view->doc->strings, id);
}

static bool is_shown(const struct graph_view *view, elem_id element)
{
    assert(element - view->doc->first_element < doc_num_elements(view->doc));
    const struct element *e = doc_element(view->doc, element);
    bool in_graph = e->parent == view->doc->root
                    || (e->parent && doc_element(view->doc, e->parent)->kind == KIND_NODEGRAPH);
    return in_graph && (e->kind == KIND_NODE || e->kind == KIND_OUTPUT)
           && (!view->wanted || view->wanted[element - view->doc->first_element]);
}

static void write_path(const struct graph_view *view, elem_id element)
{
    size_t begin = view->out->len;
    doc_path(view->doc, element, '/', view->out);
    text_show(view->out, begin);
}

/* The name of a node's output if the node has several; else NULL. */
static const char *output_name(const struct graph_view *view, const struct binding *binding)
{
    assert(binding->kind == BIND_NODE);
    struct diag_list ignored;
    diag_list_init_unheard(&ignored, &view->g->scratch);
    uint32_t id = doc_attr_value(view->doc, binding->ref, STR_type) == STR_multioutput
                      ? library_match(view->layer, binding->ref, &ignored)
                      : LIBRARY_NONE;
    if (id == LIBRARY_NONE)
        return NULL;
    return text_of(
        view, library_ports(view->layer, id,
                            NULL)[library_nodedef(view->layer, id)->num_inputs + binding->output]
                  .name);
}

/* A node with its definition and bindings, which are valid until the next call. */
static struct graph_node resolve(struct graph_view *view, elem_id node)
{
    struct diag_list ignored; /* validation reports faults; a view shows the document as it is */
    diag_list_init_unheard(&ignored, &view->g->scratch);
    view->resolved.bindings.len = 0;
    return library_resolve_node(view->layer, node, &view->resolved, &ignored);
}

static struct binding resolve_output(struct graph_view *view, elem_id output)
{
    struct diag_list ignored;
    diag_list_init_unheard(&ignored, &view->g->scratch);
    return library_resolve_port(view->layer, output, DOC_TYPE_NONE, &view->resolved, &ignored);
}

/* ---- Text ---- */

static void write_binding(struct graph_view *view, const char *name, const struct binding *binding)
{
    if (binding->kind == BIND_DEFAULT)
        return;
    size_t begin = view->out->len;
    text_fmt(view->out, "    %s = ", name);
    if (binding->kind == BIND_NODE) {
        const char *output = output_name(view, binding);
        write_path(view, binding->ref);
        if (output)
            text_fmt(view->out, ".%s", output);
    } else if (binding->kind == BIND_INTERFACE) {
        text_fmt(view->out, "interface %s", text_of(view, binding->ref));
    } else if (binding->kind == BIND_VALUE) {
        text_fmt(view->out, "%s",
                 text_of(view, doc_attr_value(view->doc, binding->element, STR_value)));
    } else {
        text_str(view->out, "?");
    }
    text_show(view->out, begin);
    text_char(view->out, '\n');
}

static void write_node(struct graph_view *view, elem_id node)
{
    struct graph_node resolved = resolve(view, node);
    write_path(view, node);
    text_fmt(view->out, " : %s", text_of(view, doc_element(view->doc, node)->category));
    if (resolved.nodedef == LIBRARY_NONE) {
        text_str(view->out, " (no definition)\n");
        return;
    }
    const struct nodedef *def = library_nodedef(view->layer, resolved.nodedef);
    const struct port *ports = library_ports(view->layer, resolved.nodedef, NULL);
    text_fmt(view->out, " (%s)\n", text_of(view, def->name));
    for (unsigned i = 0; i < def->num_inputs; i++)
        write_binding(view, text_of(view, ports[i].name),
                      &view->resolved.bindings.items[resolved.first_binding + i]);
}

static void write_output(struct graph_view *view, elem_id output)
{
    struct binding binding = resolve_output(view, output);
    write_path(view, output);
    text_str(view->out, " : output\n");
    write_binding(view, "in", &binding);
}

/* ---- Graphviz ---- */

/* A name inside of a quoted string, where a backslash begins an escape (Graphviz, escString). */
static void put_label(struct graph_view *view, const char *name)
{
    size_t begin = view->out->len;
    for (; *name; name++) {
        if (*name == '"' || *name == '\\')
            text_char(view->out, '\\');
        text_char(view->out, *name);
    }
    text_show(view->out, begin);
}

static void put_path_label(struct graph_view *view, elem_id element)
{
    struct text path;
    text_init(&path, &view->g->scratch);
    doc_path(view->doc, element, '/', &path);
    put_label(view, text_cstr(&path));
}

static void write_edge(struct graph_view *view, elem_id to, const char *input,
                       const struct binding *binding)
{
    assert(binding->kind != BIND_NODE
           || binding->ref - view->doc->first_element < doc_num_elements(view->doc));
    if (binding->kind != BIND_NODE)
        return;
    text_fmt(view->out, "    n%u -> n%u [label=\"", (unsigned)binding->ref, (unsigned)to);
    put_label(view, input);
    text_str(view->out, "\"]\n");
}

static void draw_node(struct graph_view *view, elem_id node)
{
    struct graph_node resolved = resolve(view, node);
    text_fmt(view->out, "    n%u [label=\"", (unsigned)node);
    put_path_label(view, node);
    text_str(view->out, "\\n");
    put_label(view, text_of(view, doc_element(view->doc, node)->category));
    text_str(view->out, "\"]\n");
    if (resolved.nodedef == LIBRARY_NONE)
        return;
    const struct port *ports = library_ports(view->layer, resolved.nodedef, NULL);
    for (unsigned i = 0; i < library_nodedef(view->layer, resolved.nodedef)->num_inputs; i++)
        write_edge(view, node, text_of(view, ports[i].name),
                   &view->resolved.bindings.items[resolved.first_binding + i]);
}

static void draw_output(struct graph_view *view, elem_id output)
{
    struct binding binding = resolve_output(view, output);
    text_fmt(view->out, "    n%u [shape=ellipse, label=\"", (unsigned)output);
    put_path_label(view, output);
    text_str(view->out, "\"]\n");
    write_edge(view, output, "", &binding);
}

/* ---- Both ---- */

/* Marks the elements that an element needs. */
static void mark_upstream(struct graph_view *view, elem_id root)
{
    struct arena *scratch = &view->g->scratch;
    VEC(elem_id) open = {0};
    view->wanted = ARENA_ARRAY(scratch, uint8_t, doc_num_elements(view->doc));
    vec_push(scratch, &open, root);
    while (open.len) {
        elem_id element = vec_pop(&open);
        assert(element - view->doc->first_element < doc_num_elements(view->doc));
        if (view->wanted[element - view->doc->first_element])
            continue;
        view->wanted[element - view->doc->first_element] = 1;
        if (doc_element(view->doc, element)->kind == KIND_OUTPUT) {
            struct binding binding = resolve_output(view, element);
            if (binding.kind == BIND_NODE)
                vec_push(scratch, &open, binding.ref);
            continue;
        }
        if (resolve(view, element).nodedef == LIBRARY_NONE)
            continue;
        for (uint32_t i = 0; i < view->resolved.bindings.len; i++)
            if (view->resolved.bindings.items[i].kind == BIND_NODE)
                vec_push(scratch, &open, view->resolved.bindings.items[i].ref);
    }
}

static bool start_view(struct graph_view *view, struct generation *g, struct text *out)
{
    *view = (struct graph_view){.g = g,
                                .layer = &g->document->layer,
                                .doc = &g->document->layer.doc,
                                .out = out,
                                .resolved = {.arena = &g->scratch}};
    if (!g->desc.element)
        return true;
    struct diag_list *diags = &g->result->object.diagnostics.list;
    elem_id element =
        document_find_element(g->document, g->desc.element, diags, &g->output_name, &g->output);
    if (element)
        mark_upstream(view, element);
    return element != 0;
}

static void each_shown(struct graph_view *view, void (*node)(struct graph_view *, elem_id),
                       void (*output)(struct graph_view *, elem_id))
{
    for (elem_id e = view->doc->root; e; e = doc_next_in_tree(view->doc, view->doc->root, e))
        if (is_shown(view, e))
            (doc_element(view->doc, e)->kind == KIND_NODE ? node : output)(view, e);
}

void graph_view_text(struct generation *g, struct text *out)
{
    struct graph_view view;
    if (start_view(&view, g, out))
        each_shown(&view, write_node, write_output);
}

void graph_view_dot(struct generation *g, struct text *out)
{
    struct graph_view view;
    if (!start_view(&view, g, out))
        return;
    text_str(out, "digraph {\n    rankdir=LR\n    node [shape=box]\n");
    each_shown(&view, draw_node, draw_output);
    text_str(out, "}\n");
}
