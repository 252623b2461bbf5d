// SPDX-License-Identifier: Apache-2.0
/*
 * Finds the renderables of a document, as MaterialX defines them: its materials, or without
 * materials its outputs and the outputs of its graphs. Beyond MaterialX, shaders without a user are
 * renderables too. A connection to an element is a use of it.
 */
#include "api/api.h"

/*
 * Any node of type material. One without a shader counts, because its generation reports it; one
 * with a displacement alone moves the vertices of a black surface.
 */
static bool is_material(const struct document *doc, elem_id node)
{
    return doc_element(doc, node)->kind == KIND_NODE
           && doc_attr_value(doc, node, STR_type) == STR_material && !doc_is_outdated(doc, node);
}

static bool is_loose_shader(const struct document *doc, elem_id node)
{
    str_id type = doc_attr_value(doc, node, STR_type);
    return doc_element(doc, node)->kind == KIND_NODE
           && (type == STR_surfaceshader || type == STR_volumeshader) && !doc_is_used(doc, node);
}

/* True if an output has something to give: a connection, or a value of its own. */
static bool is_set(const struct document *doc, elem_id output)
{
    static const str_id sources[] = {STR_nodename, STR_nodegraph, STR_interfacename, STR_value};
    bool is = false;
    for (size_t i = 0; i < sizeof sources / sizeof *sources; i++)
        is = is || doc_attr_value(doc, output, sources[i]);
    return is;
}

/*
 * True if an output can be a renderable: closures and lights have no meaning alone, and strings
 * have no colour.
 */
static bool is_renderable_output(const struct document *doc, elem_id output)
{
    str_id type = doc_attr_value(doc, output, STR_type);
    doc_type known = doc_type_of(type);
    bool is_value = (doc_type_components(known) && doc_type_components(known) <= 4)
                    || known == DOC_TYPE_boolean;
    return doc_element(doc, output)->kind == KIND_OUTPUT && is_set(doc, output)
           && (is_value || type == STR_material || type == STR_surfaceshader
               || type == STR_volumeshader);
}

bool renderable_is_listed(const struct document *doc, elem_id element, bool are_materials)
{
    elem_id parent = doc_element(doc, element)->parent;
    if (are_materials || !parent)
        return parent == doc->root && is_material(doc, element);
    if (parent == doc->root)
        return is_renderable_output(doc, element) || is_loose_shader(doc, element);
    return doc_element(doc, parent)->parent == doc->root
           && doc_element(doc, parent)->kind == KIND_NODEGRAPH
           && is_renderable_output(doc, element);
}

const char *renderable_new_path(const struct document *doc, elem_id element, struct arena *arena)
{
    struct text path;
    if (doc_element(doc, element)->parent == doc->root)
        return NULL;
    text_init(&path, arena);
    doc_path(doc, element, '/', &path);
    return text_cstr(&path);
}

struct found {
    VEC(elem_id) elements;
    VEC(const char *) paths;
};

static void add(struct found *found, const struct mxg_document *document, elem_id element,
                bool are_materials)
{
    const struct document *doc = &document->layer.doc;
    struct arena *arena = document->layer.doc.arena;
    if (!renderable_is_listed(doc, element, are_materials))
        return;
    vec_push(arena, &found->elements, element);
    vec_push(arena, &found->paths, renderable_new_path(doc, element, arena));
}

static void add_all(struct found *found, const struct mxg_document *document, bool are_materials)
{
    const struct document *doc = &document->layer.doc;
    for (elem_id e = doc_element(doc, doc->root)->first_child; e; e = doc_element(doc, e)->next) {
        bool is_graph = doc_element(doc, e)->kind == KIND_NODEGRAPH && !are_materials;
        add(found, document, e, are_materials);
        for (elem_id port = is_graph ? doc_element(doc, e)->first_child : 0; port;
             port = doc_element(doc, port)->next)
            add(found, document, port, false);
    }
}

void document_find_renderables(struct mxg_document *document)
{
    struct found found = {0};
    add_all(&found, document, true);
    bool are_materials = found.elements.len > 0;
    if (!are_materials)
        add_all(&found, document, false);
    document->renderables = (struct renderables){.found = found.elements.items,
                                                 .paths = found.paths.items,
                                                 .num = found.elements.len,
                                                 .are_materials = are_materials};
    if (found.elements.len)
        vec_push(document->layer.doc.arena, &document->renderables.runs,
                 (struct renderable_run){0});
}
