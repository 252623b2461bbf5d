// SPDX-License-Identifier: Apache-2.0
/* Units (specification, "Units"): scales to the base unit of their type, from <unitdef> elements of any layer. */
#include "library/library.h"

static const char *text_of(const struct library *lib, str_id id)
{
    return str_text(&lib->strings, id);
}

bool library_unit_scale(const struct library *lib, str_id type, str_id unit, float *out_scale)
{
    for (const struct library *layer = lib; layer; layer = layer->base) {
        const struct document *doc = &layer->doc;
        for (elem_id e = doc_element(doc, doc->root)->first_child; e; e = doc_element(doc, e)->next) {
            if (doc_element(doc, e)->kind != KIND_UNITDEF || (type && doc_attr_value(doc, e, STR_unittype) != type))
                continue;
            elem_id found = doc_child_of_kind(doc, e, KIND_UNIT, unit);
            str_id scale = found ? doc_attr_value(doc, found, STR_scale) : 0;
            struct ir_value value;
            if (!scale || !doc_parse_value(DOC_TYPE_float, text_of(lib, scale), str_len(&lib->strings, scale), NULL, &value))
                continue;
            *out_scale = value.w[0].f;
            return true;
        }
    }
    return false;
}

str_id library_unit_type_of(const struct library *lib, str_id unit)
{
    for (const struct library *layer = lib; layer; layer = layer->base) {
        const struct document *doc = &layer->doc;
        for (elem_id e = doc_element(doc, doc->root)->first_child; e; e = doc_element(doc, e)->next)
            if (doc_element(doc, e)->kind == KIND_UNITDEF && doc_child_of_kind(doc, e, KIND_UNIT, unit))
                return doc_attr_value(doc, e, STR_unittype);
    }
    return 0;
}

void library_report_unit(const struct library *lib, str_id type, str_id unit, struct diag_place place, struct diag_list *diags)
{
    str_id other = library_unit_type_of(lib, unit);
    if (other && library_has_unit_type(lib, type))
        diag_add(diags, DIAG_ID_unit_of_other_type, place, text_of(lib, unit), text_of(lib, other), text_of(lib, type));
    else
        diag_add(diags, DIAG_ID_unknown_unit, place, text_of(lib, unit), library_suggest_unit(lib, unit, diags->arena));
}

bool library_has_unit_type(const struct library *lib, str_id type)
{
    for (const struct library *layer = lib; layer; layer = layer->base)
        if (doc_child_of_kind(&layer->doc, layer->doc.root, KIND_UNITTYPEDEF, type))
            return true;
    return false;
}

const char *library_suggest_unit_type(const struct library *lib, str_id type, struct arena *arena)
{
    VEC(const char *) names = {0};
    for (const struct library *layer = lib; layer; layer = layer->base) {
        const struct document *doc = &layer->doc;
        for (elem_id e = doc_element(doc, doc->root)->first_child; e; e = doc_element(doc, e)->next)
            if (doc_element(doc, e)->kind == KIND_UNITTYPEDEF)
                vec_push(arena, &names, text_of(lib, doc_element(doc, e)->name));
    }
    return diag_suggest(arena, text_of(lib, type), names.items, names.len);
}

const char *library_suggest_unit(const struct library *lib, str_id unit, struct arena *arena)
{
    VEC(const char *) names = {0};
    for (const struct library *layer = lib; layer; layer = layer->base) {
        const struct document *doc = &layer->doc;
        for (elem_id e = doc_element(doc, doc->root)->first_child; e; e = doc_element(doc, e)->next)
            for (elem_id u = doc_element(doc, e)->kind == KIND_UNITDEF ? doc_element(doc, e)->first_child : 0; u;
                 u = doc_element(doc, u)->next)
                vec_push(arena, &names, text_of(lib, doc_element(doc, u)->name));
    }
    return diag_suggest(arena, text_of(lib, unit), names.items, names.len);
}
