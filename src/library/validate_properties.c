// SPDX-License-Identifier: Apache-2.0
/*
 * Checks of geometric properties: their definitions ("Geometric Properties"), their values and
 * their readers have one type.
 */
#include "library/validate_nodes.h"

static const char *text_of(const struct validate *v, str_id id)
{
    return str_text(&v->lib->strings, id);
}

static bool has(const struct validate *v, elem_id element, str_id attr)
{
    return doc_attr(v->doc, element, attr) != NULL;
}

/* The nodes of standard properties; that of the library npr is among them. */
static const char *const standard[] = {"position", "normal",    "tangent",      "bitangent",
                                       "texcoord", "geomcolor", "viewdirection"};
static const char *const spaces[] = {"model", "object", "world"};

/* An attribute that is an input of the property's node, too. */
static void check_placed(struct validate *v, elem_id element, uint32_t nodedef, str_id attr)
{
    if (has(v, element, attr) && library_find_input(v->lib, nodedef, attr) < 0)
        validate_report(v, element,
                        attr == STR_space ? "has a space, and its property has none"
                                          : "has an index, and its property has one set");
}

static void check_standard(struct validate *v, elem_id element)
{
    size_t num = sizeof standard / sizeof *standard;
    const char *name = text_of(v, doc_attr_value(v->doc, element, STR_geomprop)),
               *space = text_of(v, doc_attr_value(v->doc, element, STR_space)),
               *index = text_of(v, doc_attr_value(v->doc, element, STR_index));
    if (!validate_is_among(name, standard, num)) {
        validate_report(v, element,
                        "has a geomprop that is no standard property; expected position, normal, "
                        "tangent, bitangent, texcoord, geomcolor or viewdirection");
        return;
    }
    const struct geomprop *prop = library_geomprop(v->lib, doc_element(v->doc, element)->name);
    if (!prop || prop->nodedef == LIBRARY_NONE) {
        validate_report(v, element, "has a type that the property of its geomprop does not have");
        return;
    }
    check_placed(v, element, prop->nodedef, STR_space);
    check_placed(v, element, prop->nodedef, STR_index);
    if (*space && !validate_is_among(space, spaces, sizeof spaces / sizeof *spaces))
        validate_report(v, element, "has an unknown space; expected model, object or world");
    if (*index == '-')
        validate_report(v, element, "has an index below 0");
}

void validate_geompropdef(struct validate *v, elem_id element)
{
    doc_type type = library_type(v->lib, doc_attr_value(v->doc, element, STR_type));
    bool is_uniform = doc_attr_is_true(v->doc, element, STR_uniform),
         is_standard = has(v, element, STR_geomprop);
    bool is_placed = has(v, element, STR_space) || has(v, element, STR_index);
    if (validate_is_uniform_type(type) && !is_uniform)
        validate_report(v, element,
                        "has a type that cannot vary over a surface; write uniform=\"true\"");
    if (is_uniform && (is_standard || is_placed))
        validate_report(v, element, "is uniform and cannot have a geomprop, space or index");
    else if (is_placed && !is_standard)
        validate_report(
            v, element,
            "has a space or index, which need a standard property; name it with geomprop");
    else if (is_standard)
        check_standard(v, element);
}

void validate_type_of_property(struct validate *v, elem_id element, str_id name)
{
    const struct geomprop *prop = library_geomprop(v->lib, name);
    if (!prop || prop->type == library_type(v->lib, doc_attr_value(v->doc, element, STR_type)))
        return;
    validate_report(v, element, "has another type than the <geompropdef> of its property");
    if (prop->element >= v->doc->first_element)
        diag_add(v->diags, DIAG_ID_defined_here, doc_place(v->doc, prop->element),
                 text_of(v, prop->name));
}

void validate_reader(struct validate *v, elem_id node)
{
    str_id category = doc_element(v->doc, node)->category;
    if (category != STR_geompropvalue && category != STR_geompropvalueuniform)
        return;
    elem_id input = doc_child_of_kind(v->doc, node, KIND_INPUT, STR_geomprop);
    str_id name = input ? doc_attr_value(v->doc, input, STR_value) : 0;
    if (name)
        validate_type_of_property(v, node, name);
}
