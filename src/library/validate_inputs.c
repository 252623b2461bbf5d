// SPDX-License-Identifier: Apache-2.0
/*
 * Checks values against the definition of the input, and against other attributes of the element.
 */
#include "library/validate_nodes.h"

static const char *text_of(const struct validate *v, str_id id)
{
    return str_text(&v->lib->strings, id);
}

static bool parse(const struct validate *v, doc_type type, str_id text, struct ir_value *out)
{
    return text && doc_type_components(type)
           && doc_parse_value(type, text_of(v, text), str_len(&v->lib->strings, text), NULL, out);
}

/* True if a component of `a` is greater than that of `b`. */
static bool is_above(doc_type type, const struct ir_value *a, const struct ir_value *b)
{
    for (unsigned i = 0; i < doc_type_components(type); i++)
        if (type == DOC_TYPE_integer ? a->w[i].i > b->w[i].i : a->w[i].f > b->w[i].f)
            return true;
    return false;
}

/* ---- An input of a node ---- */

static void check_range(struct validate *v, elem_id element, const struct port *port, str_id text)
{
    str_id low = doc_attr_value(v->doc, port->element, STR_uimin),
           high = doc_attr_value(v->doc, port->element, STR_uimax);
    struct ir_value value, least, most;
    if ((!low && !high) || !parse(v, port->type, text, &value))
        return;
    bool is_below = parse(v, port->type, low, &least) && is_above(port->type, &least, &value);
    bool is_beyond = parse(v, port->type, high, &most) && is_above(port->type, &value, &most);
    if (is_below || is_beyond)
        diag_add(v->diags, DIAG_ID_out_of_range, doc_attr_place(v->doc, element, STR_value),
                 text_of(v, text), text_of(v, port->name), low ? text_of(v, low) : "any",
                 high ? text_of(v, high) : "any");
}

/*
 * "Node Definition Elements": an input without a default needs a value. Closures are exempt:
 * definitions of our own library give them an empty value. An image needs a file.
 */
static bool must_be_given(const struct validate *v, uint32_t nodedef, const struct port *port)
{
    const struct library *layer;
    if (port->type == DOC_TYPE_filename)
        return !port->value && strcmp(text_of(v, port->name), "file") == 0;
    if (port->flags & PORT_HAS_VALUE || port->geomprop)
        return false;
    library_ports(v->lib, nodedef, &layer);
    bool is_of_image = !layer->doc.arena;
    return !is_of_image;
}

void validate_input(struct validate *v, elem_id node, uint32_t nodedef, const struct port *port,
                    const struct binding *binding)
{
    str_id text =
        binding->kind == BIND_VALUE ? doc_attr_value(v->doc, binding->element, STR_value) : 0;
    bool is_empty = binding->kind == BIND_DEFAULT
                    || (binding->kind == BIND_VALUE && !text && port->type == DOC_TYPE_filename);
    if (is_empty && must_be_given(v, nodedef, port))
        diag_add(v->diags, DIAG_ID_unconnected_input, doc_place(v->doc, node),
                 text_of(v, doc_element(v->doc, node)->category), text_of(v, port->name));
    if (binding->kind == BIND_NODE && binding->element >= v->doc->first_element)
        validate_connected_meaning(v, port, binding->element);
    if (!text || binding->element < v->doc->first_element)
        return;
    if (doc_read_loosely(port->type, text_of(v, text), str_len(&v->lib->strings, text), NULL)
        && doc_element(v->doc, doc_element(v->doc, binding->element)->parent)->kind == KIND_NODE)
        library_report_loose(v->lib, binding->element, port->type, v->diags);
    if (port->type == DOC_TYPE_string)
        library_check_enum(v->lib, port, text, doc_attr_place(v->doc, binding->element, STR_value),
                           v->diags);
    validate_space(v, node, port, binding->element);
    check_range(v, binding->element, port, text);
    validate_unit(v, node, port, binding->element);
}

/* ---- Attributes ---- */

static void check_unit(struct validate *v, elem_id element)
{
    str_id unit = doc_attr_value(v->doc, element, STR_unit),
           type = doc_attr_value(v->doc, element, STR_unittype);
    float scale;
    if (type && !library_has_unit_type(v->lib, type))
        diag_add(v->diags, DIAG_ID_unknown_unittype, doc_attr_place(v->doc, element, STR_unittype),
                 text_of(v, type), library_suggest_unit_type(v->lib, type, v->diags));
    else if (unit && !library_unit_scale(v->lib, type, unit, &scale))
        library_report_unit(v->lib, type, unit, doc_attr_place(v->doc, element, STR_unit),
                            v->diags);
}

/* A library without colour transforms knows no spaces, so the check needs at least one. */
static void check_space(struct validate *v, elem_id element)
{
    str_id attribute = doc_attr_value(v->doc, element, STR_colorspace);
    const char *hub = library_color_hub;
    if (!attribute || attribute == v->known_space
        || library_color_transform(v->lib, "srgb_texture", hub, "color3") == LIBRARY_NONE)
        return;
    const char *space = library_canonical_space(text_of(v, attribute));
    bool is_known = strcmp(space, "none") == 0 || strcmp(space, hub) == 0
                    || library_color_transform(v->lib, space, hub, "color3") != LIBRARY_NONE;
    struct diag_place place = doc_attr_place(v->doc, element, STR_colorspace);
    if (is_known && strcmp(space, text_of(v, attribute)) != 0)
        diag_add(v->diags, DIAG_ID_colorspace_alias, place, text_of(v, attribute), space);
    else if (is_known)
        v->known_space = attribute;
    else
        library_report_space(v->lib, space, place, v->diags);
}

static void check_bounds(struct validate *v, elem_id element, str_id low, str_id high)
{
    doc_type type = doc_type_of(doc_attr_value(v->doc, element, STR_type));
    str_id low_text = doc_attr_value(v->doc, element, low),
           high_text = doc_attr_value(v->doc, element, high);
    struct ir_value least, most;
    if (parse(v, type, low_text, &least) && parse(v, type, high_text, &most)
        && is_above(type, &least, &most))
        diag_add(v->diags, DIAG_ID_bad_range, doc_attr_place(v->doc, element, low), text_of(v, low),
                 text_of(v, low_text), text_of(v, high), text_of(v, high_text));
}

static uint32_t count_words(const char *list)
{
    uint32_t count = *list != '\0';
    for (; *list; list++)
        count += *list == ',';
    return count;
}

/*
 * The words that the values of an <input> are for: its own, or in an <implementation>, those of the
 * definition, with another type.
 */
static str_id words_of(const struct validate *v, elem_id element, doc_type *type)
{
    elem_id parent = doc_element(v->doc, element)->parent;
    *type = doc_type_of(doc_attr_value(v->doc, element, STR_type));
    if (!parent || doc_element(v->doc, parent)->kind != KIND_IMPLEMENTATION)
        return doc_attr_value(v->doc, element, STR_enum);
    uint32_t nodedef = library_nodedef_by_name(v->lib, doc_attr_value(v->doc, parent, STR_nodedef));
    int index = nodedef == LIBRARY_NONE
                    ? -1
                    : library_find_input(v->lib, nodedef, doc_element(v->doc, element)->name);
    if (index < 0)
        return 0;
    const struct port *port = &library_ports(v->lib, nodedef, NULL)[index];
    *type = library_source_type(v->lib, parent, port);
    return doc_attr_value(v->doc, port->element, STR_enum);
}

/* Generation takes these values as they are. */
static void check_values_of_source(struct validate *v, elem_id element, doc_type type, str_id list)
{
    struct ir_value value;
    struct text_word text;
    for (unsigned i = 0; (text = library_enum_value(text_of(v, list), type, i)).len; i++) {
        if (!doc_type_components(type) || doc_parse_value(type, text.bytes, text.len, NULL, &value))
            continue;
        doc_report_value(type, text_of(v, library_type_name(v->lib, type)),
                         arena_strndup(v->resolved.arena, text.bytes, text.len),
                         doc_attr_place(v->doc, element, STR_enumvalues), v->diags);
        return;
    }
}

/* A value of several numbers takes as many places in the list. */
static void check_enum_values(struct validate *v, elem_id element)
{
    str_id values = doc_attr_value(v->doc, element, STR_enumvalues);
    doc_type type;
    str_id words = values ? words_of(v, element, &type) : 0;
    if (!words)
        return;
    if (words != doc_attr_value(v->doc, element, STR_enum))
        check_values_of_source(v, element, type, values);
    uint32_t components = doc_type_components(type);
    uint32_t num_words = count_words(text_of(v, words)),
             num_values = count_words(text_of(v, values));
    components = components ? components : 1;
    if (num_words * components != num_values)
        diag_add(v->diags, DIAG_ID_bad_enum, doc_attr_place(v->doc, element, STR_enumvalues),
                 num_words, num_values / components);
}

static bool is_version(const char *text)
{
    for (;;) {
        size_t digits = strspn(text, "0123456789");
        if (!digits)
            return false;
        if (!text[digits])
            return true;
        if (text[digits] != '.')
            return false;
        text += digits + 1;
    }
}

/* Few elements have more than a type and a value. */
static bool has_more_to_say(const struct document *doc, elem_id element)
{
    const struct attribute *attrs = doc_attrs(doc, element);
    for (uint32_t i = 0; i < doc_element(doc, element)->num_attrs; i++) {
        switch (attrs[i].name) {
        case STR_version:
        case STR_unit:
        case STR_unittype:
        case STR_colorspace:
        case STR_uimin:
        case STR_uisoftmin:
        case STR_enum:
        case STR_enumvalues: return true;
        default: break;
        }
    }
    return false;
}

void validate_attributes_of(struct validate *v, elem_id element)
{
    const struct element *e = doc_element(v->doc, element);
    if (!has_more_to_say(v->doc, element))
        return;
    str_id version = e->kind == KIND_NODEDEF ? doc_attr_value(v->doc, element, STR_version) : 0;
    if (version && !is_version(text_of(v, version)))
        diag_add(v->diags, DIAG_ID_bad_nodedef_version,
                 doc_attr_place(v->doc, element, STR_version), text_of(v, version));
    check_unit(v, element);
    validate_type_of_meaning(v, element);
    check_space(v, element);
    check_bounds(v, element, STR_uimin, STR_uimax);
    check_bounds(v, element, STR_uisoftmin, STR_uisoftmax);
    check_enum_values(v, element);
}
