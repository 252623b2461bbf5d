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
    assert(target < doc->first_element + doc_num_elements(doc));
    if (target >= doc->first_element)
        scan->used[target - doc->first_element] = 1;
}

static void mark_used(struct scan *scan)
{
    const struct document *doc = scan->doc;
    for (uint32_t i = 0; i < doc_num_elements(doc); i++) {
        const struct element *e = doc_element(doc, doc->first_element + i);
        if (e->parent
            && (e->kind == KIND_OUTPUT
                || (e->kind == KIND_INPUT && doc_element(doc, e->parent)->parent)))
            mark_connection(scan, doc->first_element + i);
    }
}

static bool is_used(const struct scan *scan, elem_id element)
{
    assert(element - scan->doc->first_element < doc_num_elements(scan->doc));
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

/* ---- Those of an edited document ---- */

static bool is_material_in(const struct document *doc, elem_id element)
{
    return element - doc->first_element < doc_num_elements(doc)
           && doc_element(doc, element)->parent == doc->root && is_material(doc, element);
}

/* The element at the top level that is an element or its parent; 0: it is deeper, or removed. */
static elem_id top_of(const struct document *doc, elem_id element)
{
    if (element - doc->first_element >= doc_num_elements(doc))
        return 0;
    elem_id parent = doc_element(doc, element)->parent;
    return parent == doc->root                                       ? element
           : parent && doc_element(doc, parent)->parent == doc->root ? parent
                                                                     : 0;
}

/* True if an element at the top level is a material in both documents or in none, in its place. */
static bool stays(const struct document *doc, elem_id top)
{
    bool now = top && is_material_in(doc, top), before = top && is_material_in(doc->origin, top);
    return now == before
           && (!now
               || (doc_element(doc, top)->name == doc_element(doc->origin, top)->name
                   && doc_link(doc, top)->previous == doc_link(doc->origin, top)->previous));
}

/* True if no connection of an input changes, and the element is nothing else. */
static bool is_value(const struct document *doc, const struct doc_change *change)
{
    static const str_id attrs[] = {STR_type, STR_nodename, STR_nodegraph, STR_output};
    elem_id element = doc->first_element + change->index;
    bool is_new = change->index >= doc->origin->elements.len;
    if (change->element.kind != KIND_INPUT
        || (!is_new && change->element.parent != doc->origin->elements.items[change->index].parent))
        return false;
    for (size_t i = 0; i < sizeof attrs / sizeof *attrs; i++) {
        str_id now = doc_attr_value(doc, element, attrs[i]);
        if (is_new ? i > 0 && now : now != doc_attr_value(doc->origin, element, attrs[i]))
            return false;
    }
    return true;
}

static bool has_materials(const mxg_document *document)
{
    return document->renderables.len
           && is_material(&document->layer.doc, document->renderables.items[0]);
}

bool document_share_renderables(struct mxg_document *document)
{
    const struct document *doc = &document->layer.doc;
    const mxg_document *origin = document->origin;
    bool of_materials = has_materials(origin);
    if (document->has_own_renderables)
        return false;
    document->has_own_renderables = true;
    for (uint32_t i = 0; i < doc->changes.len; i++) {
        const struct doc_change *change = doc->changes.items[i];
        if (!change->is_fresh)
            continue;
        elem_id element = doc->first_element + change->index;
        bool good = of_materials ? stays(doc, top_of(doc, element))
                                       && stays(doc, top_of(doc->origin, element))
                                 : doc_is_same(doc, change) || is_value(doc, change);
        if (!good)
            return false;
    }
    document->renderables.items = origin->renderables.items;
    document->renderables.len = origin->renderables.len;
    document->renderable_paths = origin->renderable_paths;
    document->has_own_renderables = false;
    return true;
}

void document_find_renderables(struct mxg_document *document, struct arena *scratch)
{
    assert(document->renderables.len == 0);
    const struct document *doc = &document->layer.doc;
    struct arena *arena = &document->object.arena;
    add_materials(document);
    if (!document->renderables.len) {
        struct scan scan = {.doc = doc,
                            .used = ARENA_ARRAY(scratch, uint8_t, doc_num_elements(doc))};
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
