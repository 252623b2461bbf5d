// SPDX-License-Identifier: Apache-2.0
/* Colour spaces and units of values and files. */
#include "build/build_priv.h"

static str_id canonical_space(struct builder *b, str_id space)
{
    const char *name = build_text(b, space), *canonical = library_canonical_space(name);
    return canonical == name ? space : str_intern_z(b->shader->strings, canonical);
}

str_id build_colorspace(struct builder *b, elem_id element)
{
    str_id space = doc_inherited_attr(&b->lib->doc, element, STR_colorspace);
    if (!space || space == STR_none || space == b->options->colorspace)
        return 0;
    space = canonical_space(b, space);
    return space == STR_none || space == b->options->colorspace ? 0 : space;
}

/* 0: the library has no such transform. */
static ir_ref transform(struct builder *b, ir_ref value, doc_type type, const char *from,
                        const char *to)
{
    uint32_t nodedef =
        library_color_transform(b->lib, from, to, build_text(b, library_type_name(b->lib, type)));
    if (!value || nodedef == LIBRARY_NONE)
        return 0;
    ir_ref results[LIBRARY_MAX_OUTPUTS];
    build_apply(b, nodedef, b->document->node, &value, results);
    return results[0];
}

void build_check_colorspace(struct builder *b)
{
    const char *space = build_text(b, canonical_space(b, b->options->colorspace)),
               *hub = library_color_hub;
    ir_ref black = ir_const_splat(b->graph, IR_TYPE_VEC3, 0.0f);
    b->has_colorspace = strcmp(space, hub) == 0 || strcmp(space, "none") == 0
                        || transform(b, black, DOC_TYPE_color3, hub, space);
    if (!b->has_colorspace)
        diag_add(b->diags, DIAG_ID_bad_option, (struct diag_place){0}, space, "colorspace",
                 library_expect_working_space(b->lib, space, b->diags));
}

void build_check_distance_unit(struct builder *b)
{
    const char *unit = build_text(b, b->options->distance_unit);
    b->has_distance_unit =
        strcmp(unit, "meter") == 0
        || library_unit_type_of(b->lib, b->options->distance_unit) == STR_distance;
    if (!b->has_distance_unit)
        diag_add(b->diags, DIAG_ID_bad_option, (struct diag_place){0}, unit, "distance-unit",
                 "a distance unit of the library, for example meter or centimeter");
}

ir_ref build_find_transform(struct builder *b, ir_ref value, doc_type type, str_id space)
{
    assert(type == DOC_TYPE_color3 || type == DOC_TYPE_color4);
    const char *from = build_text(b, space),
               *to = build_text(b, canonical_space(b, b->options->colorspace)),
               *hub = library_color_hub;
    bool stays = strcmp(from, to) == 0 || strcmp(to, "none") == 0;
    ir_ref result = stays ? value : transform(b, value, type, from, to);
    if (!result)
        result = transform(b, strcmp(from, hub) == 0 ? value : transform(b, value, type, from, hub),
                           type, hub, to);
    return result;
}

ir_ref build_color_transform(struct builder *b, ir_ref value, doc_type type, str_id space,
                             struct diag_place place)
{
    ir_ref result = build_find_transform(b, value, type, space);
    if (!result && b->has_colorspace)
        library_report_space(b->lib, build_text(b, space), place, b->diags);
    return result ? result : ir_poison(b->graph, ir_type_of(b->graph, value));
}

/* ---- units ---- */

float build_unit_factor(struct builder *b, elem_id of_unit, elem_id declared)
{
    const struct document *doc = &b->lib->doc;
    str_id unit = doc_attr_value(doc, of_unit, STR_unit),
           type = declared ? doc_attr_value(doc, declared, STR_unittype) : 0;
    if (!type)
        type = doc_attr_value(doc, of_unit, STR_unittype);
    if (!type)
        type = library_unit_type_of(b->lib, unit);
    /* The unit that the definition declares, else the option's unit (specification, "Units"). Types
     * without an option have the unit whose scale is 1. */
    str_id target = !declared || declared == of_unit ? 0 : doc_attr_value(doc, declared, STR_unit);
    if (!target && type == STR_angle)
        target = b->options->angle_unit;
    if (!target && type == STR_distance)
        target = b->options->distance_unit;
    if (target && target == b->options->distance_unit && !b->has_distance_unit)
        return 1.0f;
    float from, to = 1.0f;
    if (!library_unit_scale(b->lib, type, unit, &from)
        || (target && !library_unit_scale(b->lib, type, target, &to))) {
        library_report_unit(b->lib, type, unit, doc_attr_place(doc, of_unit, STR_unit), b->diags);
        return 1.0f;
    }
    return from / to;
}

/* A value of a port in the unit that an element names, in the unit of the target. */
static ir_ref convert_unit(struct builder *b, ir_ref value, const struct build_meaning *meaning)
{
    float factor = build_unit_factor(b, meaning->of_unit, meaning->port->element);
    return factor == 1.0f ? value
                          : ir_op2(b->graph, IR_MUL, value, ir_const_float(b->graph, factor));
}

/* ---- what a value means ---- */

/* The first of these elements that has the attribute itself; 0: none. */
static elem_id first_with(const struct builder *b, str_id attr, const elem_id elements[3])
{
    for (unsigned i = 0; i < 3; i++)
        if (elements[i] && doc_attr_value(&b->lib->doc, elements[i], attr))
            return elements[i];
    return 0;
}

bool build_meaning_of_property(struct builder *b, elem_id node, struct build_meaning *out)
{
    str_id category = doc_element(&b->lib->doc, node)->category;
    if ((category != STR_geomcolor && category != STR_geompropvalue)
        || !doc_attr_value(&b->lib->doc, node, STR_colorspace))
        return false;
    *out = (struct build_meaning){.of_space = node, .space = build_colorspace(b, node)};
    return true;
}

/* `holder` has the value; 0: it is an argument. The connection of the node's input ends at `end`.
 */
static struct build_meaning meaning_of(struct builder *b, elem_id node, const struct port *port,
                                       elem_id holder, elem_id end)
{
    const struct document *doc = &b->lib->doc;
    bool has_other_end =
        end && doc_element(doc, end)->parent != node && doc_element(doc, node)->kind == KIND_NODE;
    elem_id own = has_other_end ? doc_child_of_kind(doc, node, KIND_INPUT, port->name) : 0;
    const elem_id elements[] = {holder, own, end};
    /* arguments have the working space; files are read inside */
    bool may_say = holder || port->type == DOC_TYPE_filename;
    elem_id of_space = may_say ? first_with(b, STR_colorspace, elements) : 0;
    of_space = of_space ? of_space : holder;
    return (struct build_meaning){.port = port,
                                  .of_space = of_space,
                                  .space = of_space ? build_colorspace(b, of_space) : 0,
                                  .of_unit = first_with(b, STR_unit, elements)};
}

struct build_meaning build_meaning_of(struct builder *b, elem_id node, const struct port *port,
                                      const struct binding *binding)
{
    elem_id holder = binding->kind == BIND_VALUE ? binding->element : 0;
    return meaning_of(b, node, port, holder, binding->element);
}

struct build_meaning build_meaning_of_default(struct builder *b, const struct port *port)
{
    const struct document *doc = &b->lib->doc;
    bool says = port->element >= doc->first_element
                || (port->element && doc_attr_value(doc, port->element, STR_colorspace));
    return (struct build_meaning){.port = port,
                                  .of_space = port->element,
                                  .space = says ? build_colorspace(b, port->element) : 0};
}

/* The element that names the file of an argument; 0: it is not known here. */
static elem_id file_holder(const struct builder *b, const struct frame *frame, uint32_t input)
{
    const struct port *port = library_ports(b->lib, frame->node.nodedef, NULL) + input;
    const struct binding *binding = &frame->bindings[input];
    elem_id own = doc_child_of_kind(&b->lib->doc, frame->node.element, KIND_INPUT, port->name);
    ir_ref file = frame->args[input];
    bool is_texture = file && ir_get(b->graph, file)->op == IR_TEXTURE;
    if (!is_texture)
        return binding->kind == BIND_VALUE ? binding->element : 0;
    const struct shader_variable *texture =
        &b->shader->interface.variables.items[ir_get(b->graph, file)->attr];
    if (own && texture->element == own) /* also where a string names the file */
        return own;
    if (binding->kind == BIND_VALUE)
        return binding->element;
    if (binding->kind == BIND_NODE)
        return texture->element;
    /* a functional graph without a node that uses it has the defaults of its definition */
    return frame->scope->graph ? 0 : texture->definition;
}

/* The node that uses the graph says what the inputs inside of the graph do not say. */
static void add_argument(struct builder *b, const struct instance *scope, const struct port *port,
                         const struct binding *binding, struct build_meaning *meaning)
{
    int index = library_resolve_interface(b->lib, binding->element, scope->nodedef, binding, port,
                                          b->diags);
    if (index < 0)
        return;
    const struct build_meaning *argument = &scope->files[index];
    if (!meaning->of_space && argument->space) {
        meaning->of_space = argument->of_space;
        meaning->space = argument->space;
    }
    if (!meaning->of_unit && argument->of_unit) {
        meaning->of_unit = argument->of_unit;
        meaning->port = argument->port;
    }
}

struct build_meaning build_meaning_of_file(struct builder *b, const struct frame *frame,
                                           uint32_t input)
{
    const struct port *port = library_ports(b->lib, frame->node.nodedef, NULL) + input;
    const struct binding *binding = &frame->bindings[input];
    assert(port->type == DOC_TYPE_filename);
    if (binding->kind == BIND_DEFAULT)
        return build_meaning_of_default(b, port);
    elem_id holder = file_holder(b, frame, input);
    struct build_meaning meaning =
        meaning_of(b, frame->node.element, port, holder, binding->element);
    if (binding->kind != BIND_INTERFACE)
        return meaning;
    if (meaning.of_unit == holder)
        meaning.of_unit = 0; /* a default has the unit that its definition declares */
    if (frame->scope->files)
        add_argument(b, frame->scope, port, binding, &meaning);
    return meaning;
}

ir_ref build_convert(struct builder *b, ir_ref value, doc_type type,
                     const struct build_meaning *meaning)
{
    const struct document *doc = &b->lib->doc;
    if (value && doc_type_is_color(type) && meaning->space)
        return build_color_transform(
            b, value, type, meaning->space,
            doc_attr_place(doc, doc_attr_owner(doc, meaning->of_space, STR_colorspace),
                           STR_colorspace));
    return value && doc_type_is_measure(type) && meaning->of_unit ? convert_unit(b, value, meaning)
                                                                  : value;
}
