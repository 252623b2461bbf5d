// SPDX-License-Identifier: Apache-2.0
/*
 * The files that a node reads: their colour space and unit, and the input that stands in for them.
 *
 * The results of an image are converted from the space and the unit of its file. They pass the
 * image's `default`, too, which has a space and a unit of its own (specification, "Color Spaces"):
 * it is the border of the texture, so it has to be in the space of the file. A property of the
 * geometry that is a colour has a default likewise.
 */
#include "build/build_priv.h"

/* The first input for a file that has one, else the first input for a file; their number: none. */
static uint32_t first_file(const struct builder *b, const struct frame *frame)
{
    const struct nodedef *def = library_nodedef(b->lib, frame->node.nodedef);
    const struct port *ports = library_ports(b->lib, frame->node.nodedef, NULL);
    uint32_t found = def->num_inputs;
    for (uint32_t i = 0; i < def->num_inputs; i++) {
        if (ports[i].type != DOC_TYPE_filename)
            continue;
        if (frame->bindings[i].kind != BIND_DEFAULT)
            return i;
        found = found < i ? found : i;
    }
    return found;
}

/* True if the results of a node are not converted from the space or the unit of its file. */
static bool images_convert(const struct builder *b, const struct frame *frame,
                           const struct port *port, str_id attr)
{
    return frame->impl->kind == IMPL_GRAPH
           && (library_graph_says(b->lib, frame->impl->ref, port->name, attr)
               || library_images_convert(b->lib, frame->node.nodedef, attr));
}

static bool meaning_of_files(struct builder *b, const struct frame *frame,
                             struct build_meaning *out)
{
    const struct port *ports = library_ports(b->lib, frame->node.nodedef, NULL);
    uint32_t i = first_file(b, frame);
    if (i == library_nodedef(b->lib, frame->node.nodedef)->num_inputs)
        return false;
    *out = build_meaning_of_file(b, frame, i);
    if (images_convert(b, frame, &ports[i], STR_colorspace))
        out->space = 0;
    if (images_convert(b, frame, &ports[i], STR_unit))
        out->of_unit = 0;
    return true;
}

const struct build_meaning *build_meaning_inside(struct builder *b, const struct frame *frame)
{
    const struct nodedef *def = library_nodedef(b->lib, frame->node.nodedef);
    const struct port *ports = library_ports(b->lib, frame->node.nodedef, NULL);
    bool has_space = library_images_convert(b->lib, frame->node.nodedef, STR_colorspace),
         has_unit = library_images_convert(b->lib, frame->node.nodedef, STR_unit), says = false;
    if ((!has_space && !has_unit) || first_file(b, frame) == def->num_inputs)
        return NULL;
    struct build_meaning *files = ARENA_ARRAY(b->arena, struct build_meaning, def->num_inputs);
    for (uint32_t i = 0; i < def->num_inputs; i++) {
        if (ports[i].type != DOC_TYPE_filename)
            continue;
        files[i] = build_meaning_of_file(b, frame, i);
        if (!has_space)
            files[i].space = 0;
        if (!has_unit)
            files[i].of_unit = 0;
        says |= files[i].space || files[i].of_unit;
    }
    return says ? files : NULL;
}

bool build_meaning_of_results(struct builder *b, const struct frame *frame,
                              struct build_meaning *out)
{
    return meaning_of_files(b, frame, out)
           || build_meaning_of_property(b, frame->node.element, out);
}

bool build_is_border(const struct builder *b, const struct frame *frame, const struct port *port)
{
    if (!doc_type_is_color(port->type) && !doc_type_is_measure(port->type))
        return false;
    return frame->impl->kind == IMPL_GRAPH
               ? library_graph_has_border(b->lib, frame->impl->ref, port->name)
               : port->name == STR_default;
}

/* True if both have one space, or one unit, which ever counts for the type. */
static bool is_alike(struct builder *b, const struct port *port, const struct build_meaning *one,
                     const struct build_meaning *other)
{
    if (doc_type_is_color(port->type))
        return one->space == other->space;
    return one->of_unit && other->of_unit
           && build_unit_factor(b, one->of_unit, one->port->element)
                  == build_unit_factor(b, other->of_unit, other->port->element);
}

/* A value of the working space and the target's unit as one of the file; stays after a warning. */
static ir_ref into_file(struct builder *b, const struct frame *frame, const struct port *port,
                        ir_ref value, const struct build_meaning *file)
{
    if (!value || ir_get(b->graph, value)->op == IR_POISON)
        return value;
    const char *fault;
    ir_ref border = build_unconvert(b, value, port->type, file, &fault);
    if (border)
        return border;
    elem_id node = frame->node.element,
            own = doc_child_of_kind(build_doc(b), node, KIND_INPUT, port->name);
    diag_add(b->diags, DIAG_ID_image_default, doc_place(build_doc(b), own ? own : node),
             build_text(b, port->name), build_text(b, doc_element(build_doc(b), node)->category),
             fault);
    return value;
}

ir_ref build_border(struct builder *b, const struct frame *frame, uint32_t input)
{
    const struct port *port = library_ports(b->lib, frame->node.nodedef, NULL) + input;
    const struct binding *binding = &frame->bindings[input];
    elem_id node = frame->node.element;
    struct build_meaning file;
    bool is_converted = build_meaning_of_results(b, frame, &file);
    assert(is_converted);
    if (!is_converted || !(doc_type_is_color(port->type) ? file.space : file.of_unit))
        return build_input(b, frame->scope, node, port, binding);
    if (binding->kind == BIND_VALUE || binding->kind == BIND_INTERFACE) {
        struct build_meaning own = build_meaning_of(b, node, port, binding);
        if (is_alike(b, port, &own, &file))
            return build_written_input(b, frame->scope, node, port, binding);
    }
    return into_file(b, frame, port, build_input(b, frame->scope, node, port, binding), &file);
}
