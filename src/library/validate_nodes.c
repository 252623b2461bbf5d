// SPDX-License-Identifier: Apache-2.0
/* Checks a document against the definitions: nodes, connections, unused nodes. */
#include "library/validate_nodes.h"

#include <assert.h>

static const char *text_of(const struct validate *v, str_id id)
{
    return str_text(&v->lib->strings, id);
}

static void note_use(struct validate *v, const struct binding *binding)
{
    elem_id first = v->doc->first_element;
    assert(binding->kind != BIND_NODE || binding->ref < first + doc_num_elements(v->doc));
    if (binding->kind == BIND_NODE && binding->ref >= first)
        v->used[binding->ref - first] = 1;
}

/* ---- Connections ---- */

static void check_interface(struct validate *v, const struct port *port,
                            const struct binding *binding)
{
    elem_id graph = library_graph_around(v->lib, binding->element);
    uint32_t nodedef = library_implemented_nodedef(v->lib, graph);
    /* unknown-nodedef */
    bool is_reported =
        graph && nodedef == LIBRARY_NONE && doc_attr_value(v->doc, graph, STR_nodedef);
    if (!is_reported)
        library_resolve_interface(v->lib, binding->element, nodedef, binding, port, v->diags);
}

static void check_binding(struct validate *v, const struct port *port,
                          const struct binding *binding)
{
    note_use(v, binding);
    if (binding->kind == BIND_INTERFACE)
        check_interface(v, port, binding);
}

/* Checks a port without a definition. The type is NONE if the port's own type may be wrong. */
static void check_connection(struct validate *v, elem_id element, doc_type type)
{
    struct port port = {
        .name = doc_element(v->doc, element)->name, .type = type, .element = element};
    struct binding binding =
        library_resolve_port(v->lib, element, port.type, &v->resolved, v->diags);
    check_binding(v, &port, &binding);
}

/* ---- Nodes ---- */

static void check_node(struct validate *v, elem_id node)
{
    v->resolved.bindings.len = 0;
    uint32_t nodedef = library_resolve_node(v->lib, node, &v->resolved, v->diags).nodedef;
    for (elem_id e = doc_element(v->doc, node)->first_child; e; e = doc_element(v->doc, e)->next) {
        const struct element *child = doc_element(v->doc, e);
        bool is_defined =
            nodedef != LIBRARY_NONE && library_find_input(v->lib, nodedef, child->name) >= 0;
        if (child->kind == KIND_INPUT && !is_defined)
            check_connection(v, e, DOC_TYPE_NONE);
    }
    if (nodedef == LIBRARY_NONE)
        return;
    const struct nodedef *def = library_nodedef(v->lib, nodedef);
    assert(v->resolved.bindings.len == def->num_inputs);
    const struct port *ports = library_ports(v->lib, nodedef, NULL);
    for (uint32_t i = 0; i < def->num_inputs; i++) {
        check_binding(v, &ports[i], &v->resolved.bindings.items[i]);
        validate_input(v, node, nodedef, &ports[i], &v->resolved.bindings.items[i]);
        validate_uniform(v, node, &ports[i], &v->resolved.bindings.items[i]);
    }
    library_check_shaders(v->lib, node, nodedef, v->resolved.bindings.items, v->diags);
}

static bool is_connected(const struct document *doc, elem_id port)
{
    return doc_attr_value(doc, port, STR_nodename) || doc_attr_value(doc, port, STR_nodegraph)
           || doc_attr_value(doc, port, STR_interfacename) || doc_attr_value(doc, port, STR_output);
}

static void check_element(struct validate *v, elem_id element)
{
    const struct element *e = doc_element(v->doc, element);
    enum element_kind kind = (enum element_kind)e->kind;
    enum element_kind parent =
        e->parent ? (enum element_kind)doc_element(v->doc, e->parent)->kind : KIND_NODE;
    bool is_in_graph = parent == KIND_MATERIALX || parent == KIND_NODEGRAPH;
    if (is_in_graph && kind == KIND_NODE && doc_is_outdated(v->doc, element))
        return; /* doc_validate reports it */
    if (is_in_graph && kind == KIND_NODE)
        check_node(v, element);
    else if (is_in_graph
             && (kind == KIND_OUTPUT || (kind == KIND_INPUT && is_connected(v->doc, element))))
        check_connection(v, element,
                         library_type(v->lib, doc_attr_value(v->doc, element, STR_type)));
    if (kind == KIND_INPUT && parent != KIND_NODEDEF && !is_connected(v->doc, element)
        && doc_attr_value(v->doc, element, STR_defaultgeomprop))
        library_default_geomprop(v->lib, element,
                                 library_type(v->lib, doc_attr_value(v->doc, element, STR_type)),
                                 v->diags);
    library_check_struct(v->lib, element, v->resolved.arena, v->diags);
    validate_attributes_of(v, element);
    validate_declaration(v, element);
}

/* ---- Unused nodes ---- */

/* Materials, shaders, AOVs, and nodes that a look or an output uses are entry points. */
static bool is_end(const struct validate *v, elem_id node)
{
    str_id category = doc_element(v->doc, node)->category;
    if (category == STR_aov || category == STR_aovpass)
        return true;
    doc_type type = library_type(v->lib, doc_attr_value(v->doc, node, STR_type));
    bool is_top_level = doc_element(v->doc, node)->parent == v->doc->root;
    return type == DOC_TYPE_material
           || (is_top_level && ir_type_is_shader(library_type_ir(v->lib, type)));
}

static void check_use(struct validate *v)
{
    for (uint32_t i = 0; i < v->doc->bases.len; i++)
        v->used[v->doc->bases.items[i] - v->doc->first_element] = 1;
    for (elem_id e = v->doc->root; e; e = doc_next_in_tree(v->doc, v->doc->root, e)) {
        const struct element *element = doc_element(v->doc, e);
        bool is_used = element->kind != KIND_NODE || !element->name
                       || v->used[e - v->doc->first_element] || is_end(v, e);
        enum element_kind parent =
            element->parent ? (enum element_kind)doc_element(v->doc, element->parent)->kind
                            : KIND_NODE;
        if (!is_used && (parent == KIND_MATERIALX || parent == KIND_NODEGRAPH))
            diag_add(v->diags, DIAG_ID_unused_node, doc_name_place(v->doc, e),
                     text_of(v, element->name));
    }
}

void library_validate(const struct library *lib, struct arena *scratch, struct diag_list *diags)
{
    assert(lib->element_info.len <= doc_num_elements(&lib->doc));
    struct validate v = {.lib = lib, .doc = &lib->doc, .diags = diags, .resolved.arena = scratch};
    v.used = ARENA_ARRAY(scratch, uint8_t, doc_num_elements(&lib->doc));
    doc_validate(v.doc, diags);
    for (elem_id e = v.doc->root; e; e = doc_next_in_tree(v.doc, v.doc->root, e))
        check_element(&v, e);
    validate_implementations(&v, scratch);
    validate_default_versions(&v);
    if (diags->num_errors == 0) /* errors hide connections */
        check_use(&v);
    for (uint32_t i = 0; lib->deferred && i < lib->deferred->items.len; i++)
        diag_repeat(diags, &lib->deferred->items.items[i]);
}
