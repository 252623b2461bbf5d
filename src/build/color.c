// SPDX-License-Identifier: Apache-2.0
/* Colour spaces and units of literals. */
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

ir_ref build_color_transform(struct builder *b, ir_ref value, doc_type type, str_id space,
                             struct diag_place place)
{
    assert(type == DOC_TYPE_color3 || type == DOC_TYPE_color4);
    const char *from = build_text(b, space),
               *to = build_text(b, canonical_space(b, b->options->colorspace)),
               *hub = library_color_hub;
    ir_ref result = strcmp(from, to) == 0 ? value : transform(b, value, type, from, to);
    if (!result)
        result = transform(b, strcmp(from, hub) == 0 ? value : transform(b, value, type, from, hub),
                           type, hub, to);
    if (!result && b->has_colorspace)
        library_report_space(b->lib, from, place, b->diags);
    return result ? result : ir_poison(b->graph, ir_type_of(b->graph, value));
}

/* ---- units ---- */

ir_ref build_unit_conversion(struct builder *b, ir_ref value, elem_id element,
                             const struct port *port)
{
    const struct document *doc = &b->lib->doc;
    str_id unit = doc_attr_value(doc, element, STR_unit);
    if (!unit || !ir_type_is_float(ir_type_of(b->graph, value)))
        return value;
    str_id type = doc_attr_value(doc, port->element, STR_unittype);
    if (!type)
        type = doc_attr_value(doc, element, STR_unittype);
    if (!type)
        type = library_unit_type_of(b->lib, unit);
    /* The unit that the definition declares, else the option's unit (specification, "Units"). */
    str_id target = doc_attr_value(doc, port->element, STR_unit);
    if (!target)
        target = type == STR_angle ? b->options->angle_unit : b->options->distance_unit;
    if (target == b->options->distance_unit && !b->has_distance_unit)
        return value;
    float from, to;
    if (!library_unit_scale(b->lib, type, unit, &from)
        || !library_unit_scale(b->lib, type, target, &to)) {
        library_report_unit(b->lib, type, unit, doc_attr_place(doc, element, STR_unit), b->diags);
        return value;
    }
    return from == to ? value
                      : ir_op2(b->graph, IR_MUL, value, ir_const_float(b->graph, from / to));
}
