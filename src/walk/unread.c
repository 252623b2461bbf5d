// SPDX-License-Identifier: Apache-2.0
/*
 * Inputs of a surface that the nodegraph of its model does not read. A displacement, which
 * UsdPreviewSurface has, moves the vertices of a material that has no displacement shader. All
 * others are for other programs, as the occlusion and the volume of glTF are, and no shader can
 * show them.
 */
#include "build/build_priv.h"

/* True if the document connects the input, or gives it another value than its default. */
static bool is_authored(const struct builder *b, elem_id input, const struct port *port)
{
    const struct document *doc = build_doc(b);
    str_id value = doc_attr_value(doc, input, STR_value);
    return doc_is_connected(doc, input)
           || (value
               && !doc_is_same_value(port->type, build_text(b, value),
                                     port->value ? build_text(b, port->value) : ""));
}

/* The binding of an input; NULL: the definition of the node has no such input. */
static const struct binding *binding_of(const struct builder *b, const struct frame *node,
                                        str_id input)
{
    int index = library_find_input(b->lib, node->node.nodedef, input);
    return index >= 0 && node->bindings ? &node->bindings[index] : NULL;
}

/* True if a surface is built for a material that has no displacement shader. */
static bool serves_flat_material(const struct builder *b, elem_id surface)
{
    if (b->frames.len < 2)
        return false;
    const struct frame *user = &b->frames.items[b->frames.len - 2];
    const struct binding *front = binding_of(b, user, STR_surfaceshader),
                         *displacement = binding_of(b, user, STR_displacementshader);
    return front && front->ref == surface && displacement && displacement->kind == BIND_DEFAULT;
}

static bool is_height(doc_type type)
{
    return type == DOC_TYPE_float || type == DOC_TYPE_vector3;
}

/* Keeps the displacement of a surface for its material. False: no material needs it now. */
static bool keep_displacement(struct builder *b, const struct frame *frame, uint32_t input,
                              const struct port *port)
{
    if (port->name != STR_displacement || !is_height(port->type))
        return false;
    struct own_displacement own = {frame->scope, frame->node.element, frame->args[input],
                                   port->type};
    vec_push(b->arena, &b->own_displacements, own);
    return serves_flat_material(b, own.surface);
}

void build_unread_inputs(struct builder *b, const struct frame *frame, elem_id graph)
{
    const struct document *doc = build_doc(b);
    const struct graph_node *node = &frame->node;
    const struct nodedef *def = library_nodedef(b->lib, node->nodedef);
    const struct port *ports = library_ports(b->lib, node->nodedef, NULL);
    for (elem_id e = doc_element(doc, node->element)->first_child; e;
         e = doc_element(doc, e)->next) {
        str_id name = doc_element(doc, e)->name;
        int index = doc_element(doc, e)->kind == KIND_INPUT
                        ? library_find_input(b->lib, node->nodedef, name)
                        : -1;
        if (index >= 0 && is_authored(b, e, &ports[index])
            && !library_graph_reads(b->lib, graph, name)
            && !keep_displacement(b, frame, (uint32_t)index, &ports[index]))
            diag_add(b->diags, DIAG_ID_unread_input, doc_name_place(doc, e), build_text(b, name),
                     build_text(b, def->node));
    }
}

ir_ref build_own_displacement(struct builder *b, const struct frame *material)
{
    const struct binding *front = binding_of(b, material, STR_surfaceshader);
    for (uint32_t i = 0; front && i < b->own_displacements.len; i++) {
        const struct own_displacement own = b->own_displacements.items[i];
        if (own.scope != material->scope || own.surface != front->ref)
            continue;
        uint32_t nodedef =
            build_definition_of(b, "displacement", library_type_name(b->lib, own.type));
        ir_ref args[] = {own.height, ir_const_float(b->graph, 1.0f)}, results[LIBRARY_MAX_OUTPUTS];
        if (nodedef == LIBRARY_NONE)
            return 0;
        build_apply(b, nodedef, own.surface, args, results);
        return results[0];
    }
    return 0;
}
