// SPDX-License-Identifier: Apache-2.0
/*
 * The elements around an element say in which colour space its values are, and where its files: an
 * element that goes to another place takes this along, where the new place says something else. So
 * does an include.
 */
#include "api/edit.h"

static const struct {
    str_id attr;
    const char *none; /* a value that is as good as none */
} kinds[EDIT_NUM_SCOPES] = {{STR_colorspace, "none"}, {STR_fileprefix, ""}, {STR_geomprefix, ""}};

static bool names_geometry(const struct document *doc, elem_id element)
{
    uint32_t i = 0, num = doc_element(doc, element)->num_attrs;
    while (i < num && !doc_is_geometry(doc, element, doc_attrs(doc, element)[i].name))
        i++;
    return i < num;
}

/* True if the attribute has a meaning for this element itself. */
static bool counts(const struct document *doc, elem_id element, str_id attr)
{
    if (attr == STR_geomprefix)
        return names_geometry(doc, element);
    doc_type type = doc_type_of(doc_attr_value(doc, element, STR_type));
    return doc_attr(doc, element, STR_value)
           && (type == DOC_TYPE_filename || (attr == STR_colorspace && doc_type_is_color(type)));
}

void edit_note_scope(const struct document *doc, elem_id element, struct edit_scope *out)
{
    for (unsigned i = 0; i < EDIT_NUM_SCOPES; i++) {
        bool is_needed = false;
        for (elem_id e = element; e && !is_needed; e = doc_next_in_tree(doc, element, e))
            is_needed = counts(doc, e, kinds[i].attr);
        out->values[i] =
            is_needed ? str_text(doc->strings, doc_inherited_attr(doc, element, kinds[i].attr))
                      : NULL;
    }
}

void edit_keep_scope(struct edit_change *c, elem_id element, const struct edit_scope *scope)
{
    struct document *doc = edit_tree(c->edit);
    for (unsigned i = 0; i < EDIT_NUM_SCOPES; i++) {
        const char *was = scope->values[i],
                   *is = str_text(doc->strings, doc_inherited_attr(doc, element, kinds[i].attr));
        if (was && strcmp(was, is) != 0)
            doc_set_attr(doc, element, kinds[i].attr, edit_word(c, *was ? was : kinds[i].none));
    }
}
