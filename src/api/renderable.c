// SPDX-License-Identifier: Apache-2.0
/*
 * What of a document can be rendered: materials, shaders that nothing uses, and outputs that nothing uses. An element is used where an
 * input or output is connected to it.
 */
#include "api/api.h"

struct scan {
    const struct document *doc;
    uint8_t *used; /* per own element */
};

static void mark(struct scan *scan, elem_id target)
{
    if (target >= scan->doc->first_element)
        scan->used[target - scan->doc->first_element] = 1;
}

/* Marks the output of a graph that a port names; all of them where it names none. */
static void mark_outputs(struct scan *scan, elem_id graph, str_id name)
{
    const struct document *doc = scan->doc;
    for (elem_id e = doc_element(doc, graph)->first_child; e; e = doc_element(doc, e)->next)
        if (doc_element(doc, e)->kind == KIND_OUTPUT && (!name || doc_element(doc, e)->name == name))
            mark(scan, e);
}

static void mark_connection(struct scan *scan, elem_id port)
{
    const struct document *doc = scan->doc;
    const struct element *e = doc_element(doc, port);
    /* An input's connection is a name beside its node, an output's one beside itself. */
    elem_id scope = e->kind == KIND_OUTPUT ? e->parent : doc_element(doc, e->parent)->parent;
    str_id node = doc_attr_value(doc, port, STR_nodename), graph = doc_attr_value(doc, port, STR_nodegraph);
    str_id output = doc_attr_value(doc, port, STR_output);
    elem_id target = 0;
    if (node)
        target = doc_child(doc, scope, node);
    if (!target && graph && !(target = doc_child(doc, scope, graph)))
        target = doc_child(doc, doc->root, graph);
    if (target && doc_element(doc, target)->kind == KIND_NODEGRAPH)
        mark_outputs(scan, target, output);
    else if (target)
        mark(scan, target);
    else if (output && !node && !graph && e->kind == KIND_INPUT)
        mark_outputs(scan, doc->root, output);
}

static void mark_used(struct scan *scan)
{
    const struct document *doc = scan->doc;
    for (uint32_t i = 0; i < doc->elements.len; i++) {
        const struct element *e = &doc->elements.items[i];
        if (e->kind == KIND_IMPLEMENTATION) {
            str_id name = doc_attr_value(doc, doc->first_element + i, STR_nodegraph);
            elem_id graph = name ? doc_child_of_kind(doc, doc->root, KIND_NODEGRAPH, name) : 0;
            if (graph)
                mark_outputs(scan, graph, 0);
        }
        if (e->parent && (e->kind == KIND_OUTPUT || (e->kind == KIND_INPUT && doc_element(doc, e->parent)->parent)))
            mark_connection(scan, doc->first_element + i);
    }
}

static bool is_used(const struct scan *scan, elem_id element)
{
    return scan->used[element - scan->doc->first_element];
}

/* A material without a shader is of no use. */
static bool has_shader(const struct document *doc, elem_id material)
{
    for (elem_id e = doc_element(doc, material)->first_child; e; e = doc_element(doc, e)->next) {
        str_id type = doc_attr_value(doc, e, STR_type);
        if ((type == STR_surfaceshader || type == STR_volumeshader)
            && (doc_attr_value(doc, e, STR_nodename) || doc_attr_value(doc, e, STR_nodegraph) || doc_attr_value(doc, e, STR_output)))
            return true;
    }
    return false;
}

static bool is_renderable_node(const struct scan *scan, elem_id node)
{
    str_id type = doc_attr_value(scan->doc, node, STR_type);
    if (type == STR_material)
        return has_shader(scan->doc, node);
    return (type == STR_surfaceshader || type == STR_volumeshader) && !is_used(scan, node);
}

/* Closures and lights mean nothing by themselves, text cannot be seen, and a material is listed itself. */
static bool is_renderable_output(const struct scan *scan, elem_id output)
{
    const struct document *doc = scan->doc;
    str_id type = doc_attr_value(doc, output, STR_type);
    bool connected = doc_attr_value(doc, output, STR_nodename) || doc_attr_value(doc, output, STR_nodegraph);
    doc_type known = doc_type_of(type);
    return connected && !is_used(scan, output)
           && ((doc_type_components(known) && doc_type_components(known) <= 4) || known == DOC_TYPE_boolean || known == DOC_TYPE_surfaceshader
               || known == DOC_TYPE_volumeshader);
}

static void add_outputs(mxg_document *document, const struct scan *scan, elem_id graph)
{
    const struct document *doc = scan->doc;
    if (doc_attr(doc, graph, STR_nodedef))
        return; /* it defines a node */
    for (elem_id e = doc_element(doc, graph)->first_child; e; e = doc_element(doc, e)->next)
        if (doc_element(doc, e)->kind == KIND_OUTPUT && is_renderable_output(scan, e))
            vec_push(&document->object.arena, &document->renderables, e);
}

static void add_renderables(mxg_document *document, const struct scan *scan)
{
    const struct document *doc = scan->doc;
    for (elem_id e = doc_element(doc, doc->root)->first_child; e; e = doc_element(doc, e)->next) {
        enum element_kind kind = (enum element_kind)doc_element(doc, e)->kind;
        if (kind == KIND_NODEGRAPH)
            add_outputs(document, scan, e);
        else if (kind == KIND_OUTPUT ? is_renderable_output(scan, e) : kind == KIND_NODE && is_renderable_node(scan, e))
            vec_push(&document->object.arena, &document->renderables, e);
    }
}

void document_find_renderables(struct mxg_document *document, struct arena *scratch)
{
    const struct document *doc = &document->layer.doc;
    struct arena *arena = &document->object.arena;
    struct scan scan = {.doc = doc, .used = ARENA_ARRAY(scratch, uint8_t, doc->elements.len)};
    mark_used(&scan);
    add_renderables(document, &scan);
    document->renderable_paths = ARENA_ARRAY(arena, const char *, document->renderables.len);
    for (uint32_t i = 0; i < document->renderables.len; i++) {
        struct text path;
        text_init(&path, arena);
        doc_path(doc, document->renderables.items[i], '/', &path);
        document->renderable_paths[i] = text_cstr(&path);
    }
}
