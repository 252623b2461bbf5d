// SPDX-License-Identifier: Apache-2.0
/*
 * Finds the renderables of a document, as MaterialX defines them: its materials, or without
 * materials its outputs and the outputs of its graphs. Beyond MaterialX, shaders without a user are
 * renderables too. A connection to an element is a use of it.
 */
#include "api/api.h"

#include <assert.h>

struct scan {
    const struct document *doc;
    uint8_t *used; /* per own element */
};

static void mark_connection(struct scan *scan, elem_id port)
{
    const struct document *doc = scan->doc;
    const struct element *e = doc_element(doc, port);
    str_id node = doc_attr_value(doc, port, STR_nodename);
    /* An input names its node and the output beside it; an output names itself. */
    elem_id target =
        node ? doc_child(
            doc, e->kind == KIND_OUTPUT ? e->parent : doc_element(doc, e->parent)->parent, node)
             : 0;
    assert(target < doc->first_element + doc->elements.len);
    if (target >= doc->first_element)
        scan->used[target - doc->first_element] = 1;
}

static void mark_used(struct scan *scan)
{
    const struct document *doc = scan->doc;
    for (uint32_t i = 0; i < doc->elements.len; i++) {
        const struct element *e = &doc->elements.items[i];
        if (e->parent
            && (e->kind == KIND_OUTPUT
                || (e->kind == KIND_INPUT && doc_element(doc, e->parent)->parent)))
            mark_connection(scan, doc->first_element + i);
    }
}

static bool is_used(const struct scan *scan, elem_id element)
{
    assert(element - scan->doc->first_element < scan->doc->elements.len);
    return scan->used[element - scan->doc->first_element];
}

/*
 * Any node of type material. One without a shader counts, because its generation reports it; one
 * with a displacement alone moves the vertices of a black surface.
 */
static bool is_material(const struct document *doc, elem_id node)
{
    return doc_element(doc, node)->kind == KIND_NODE
           && doc_attr_value(doc, node, STR_type) == STR_material && !doc_is_outdated(doc, node);
}

static bool is_loose_shader(const struct scan *scan, elem_id node)
{
    str_id type = doc_attr_value(scan->doc, node, STR_type);
    return doc_element(scan->doc, node)->kind == KIND_NODE
           && (type == STR_surfaceshader || type == STR_volumeshader) && !is_used(scan, node);
}

/*
 * True if an output can be a renderable: closures and lights have no meaning alone, and strings
 * have no colour.
 */
static bool is_renderable_output(const struct document *doc, elem_id output)
{
    str_id type = doc_attr_value(doc, output, STR_type);
    bool connected =
        doc_attr_value(doc, output, STR_nodename) || doc_attr_value(doc, output, STR_nodegraph);
    doc_type known = doc_type_of(type);
    bool is_value = (doc_type_components(known) && doc_type_components(known) <= 4)
                    || known == DOC_TYPE_boolean;
    return doc_element(doc, output)->kind == KIND_OUTPUT && connected
           && (is_value || type == STR_material || type == STR_surfaceshader
               || type == STR_volumeshader);
}

static void add(mxg_document *document, elem_id element)
{
    assert(element > document->layer.doc.root);
    vec_push(&document->object.arena, &document->renderables, element);
}

static void add_materials(mxg_document *document)
{
    const struct document *doc = &document->layer.doc;
    for (elem_id e = doc_element(doc, doc->root)->first_child; e; e = doc_element(doc, e)->next)
        if (is_material(doc, e))
            add(document, e);
}

static void add_outputs(mxg_document *document, elem_id graph)
{
    const struct document *doc = &document->layer.doc;
    for (elem_id e = doc_element(doc, graph)->first_child; e; e = doc_element(doc, e)->next)
        if (is_renderable_output(doc, e))
            add(document, e);
}

static void add_shaders_and_outputs(mxg_document *document, const struct scan *scan)
{
    const struct document *doc = scan->doc;
    for (elem_id e = doc_element(doc, doc->root)->first_child; e; e = doc_element(doc, e)->next) {
        if (doc_element(doc, e)->kind == KIND_NODEGRAPH)
            add_outputs(document, e);
        else if (is_renderable_output(doc, e) || is_loose_shader(scan, e))
            add(document, e);
    }
}

void document_find_renderables(struct mxg_document *document, struct arena *scratch)
{
    assert(document->renderables.len == 0);
    const struct document *doc = &document->layer.doc;
    struct arena *arena = &document->object.arena;
    add_materials(document);
    if (!document->renderables.len) {
        struct scan scan = {.doc = doc, .used = ARENA_ARRAY(scratch, uint8_t, doc->elements.len)};
        mark_used(&scan);
        add_shaders_and_outputs(document, &scan);
    }
    document->renderable_paths = ARENA_ARRAY(arena, const char *, document->renderables.len);
    for (uint32_t i = 0; i < document->renderables.len; i++) {
        struct text path;
        text_init(&path, arena);
        doc_path(doc, document->renderables.items[i], '/', &path);
        document->renderable_paths[i] = text_cstr(&path);
    }
}
