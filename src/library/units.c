// SPDX-License-Identifier: Apache-2.0
/*
 * Units (specification, "Units"): scales to the base unit of their type, from the <unitdef>
 * elements of all layers.
 */
#include "library/library.h"

#include <assert.h>
#include <stdlib.h>

static const char *text_of(const struct library *lib, str_id id)
{
    return str_text(&lib->strings, id);
}

static int compare(const void *left, const void *right)
{
    const struct unit *a = left, *b = right;
    if (a->name != b->name)
        return a->name < b->name ? -1 : 1;
    return a->element < b->element ? -1 : a->element > b->element;
}

static void add_unit(struct library *lib, elem_id element, str_id type)
{
    str_id scale = doc_attr_value(&lib->doc, element, STR_scale);
    struct unit unit = {
        .name = doc_element(&lib->doc, element)->name, .type = type, .element = element};
    struct ir_value value;
    if (scale
        && doc_parse_value(DOC_TYPE_float, text_of(lib, scale), str_len(&lib->strings, scale), NULL,
                           &value)
        && value.w[0].f > 0.0f)
        unit.scale = value.w[0].f;
    vec_push(lib->doc.arena, &lib->units, unit);
}

void library_index_units(struct library *lib, elem_id unitdef)
{
    const struct document *doc = &lib->doc;
    str_id type = doc_attr_value(doc, unitdef, STR_unittype);
    for (elem_id e = doc_element(doc, unitdef)->first_child; e; e = doc_element(doc, e)->next)
        if (doc_element(doc, e)->kind == KIND_UNIT)
            add_unit(lib, e, type);
}

void library_sort_units(struct library *lib)
{
    if (lib->units.len > 1)
        qsort(lib->units.items, lib->units.len, sizeof *lib->units.items, compare);
}

/* The first unit of a layer with this name, or the end of the array. */
static const struct unit *first_unit(const struct library *layer, str_id name)
{
    uint32_t first = 0, end = layer->units.len;
    while (first < end) {
        uint32_t middle = first + (end - first) / 2;
        if (layer->units.items[middle].name < name)
            first = middle + 1;
        else
            end = middle;
    }
    assert(first == layer->units.len || layer->units.items[first].name >= name);
    assert(first == 0 || layer->units.items[first - 1].name < name);
    return layer->units.items + first;
}

/*
 * A unit of this name and type (0: any type) with a valid scale, unless `any` accepts all. NULL:
 * none.
 */
static const struct unit *find_unit(const struct library *lib, str_id type, str_id name,
                                    bool needs_scale)
{
    for (const struct library *layer = lib; layer; layer = layer->base) {
        const struct unit *end = layer->units.items + layer->units.len;
        for (const struct unit *unit = first_unit(layer, name); unit < end && unit->name == name;
             unit++)
            if ((!type || unit->type == type) && (unit->scale != 0.0f || !needs_scale))
                return unit;
    }
    return NULL;
}

bool library_unit_scale(const struct library *lib, str_id type, str_id unit, float *out_scale)
{
    const struct unit *found = find_unit(lib, type, unit, true);
    if (found)
        *out_scale = found->scale;
    return found;
}

str_id library_unit_type_of(const struct library *lib, str_id unit)
{
    const struct unit *found = find_unit(lib, 0, unit, false);
    return found ? found->type : 0;
}

void library_report_unit(const struct library *lib, str_id type, str_id unit,
                         struct diag_place place, struct diag_list *diags)
{
    str_id other = library_unit_type_of(lib, unit);
    if (type && find_unit(lib, type, unit, false))
        diag_add(diags, DIAG_ID_unit_without_scale, place, text_of(lib, unit));
    else if (other && library_has_unit_type(lib, type))
        diag_add(diags, DIAG_ID_unit_of_other_type, place, text_of(lib, unit), text_of(lib, other),
                 text_of(lib, type));
    else
        diag_add(diags, DIAG_ID_unknown_unit, place, text_of(lib, unit),
                 library_suggest_unit(lib, unit, diags));
}

bool library_has_unit_type(const struct library *lib, str_id type)
{
    for (const struct library *layer = lib; layer; layer = layer->base)
        if (doc_child_of_kind(&layer->doc, layer->doc.root, KIND_UNITTYPEDEF, type))
            return true;
    return false;
}

const char *library_suggest_unit_type(const struct library *lib, str_id type,
                                      struct diag_list *diags)
{
    struct diag_guess guess;
    bool may_guess = diag_guess_begin(&guess, diags, text_of(lib, type));
    for (const struct library *layer = may_guess ? lib : NULL; layer; layer = layer->base) {
        const struct document *doc = &layer->doc;
        for (elem_id e = doc_element(doc, doc->root)->first_child; e; e = doc_element(doc, e)->next)
            if (doc_element(doc, e)->kind == KIND_UNITTYPEDEF)
                diag_guess_add(&guess, text_of(lib, doc_element(doc, e)->name));
    }
    return diag_guess_text(&guess);
}

const char *library_suggest_unit(const struct library *lib, str_id unit, struct diag_list *diags)
{
    struct diag_guess guess;
    bool may_guess = diag_guess_begin(&guess, diags, text_of(lib, unit));
    for (const struct library *layer = may_guess ? lib : NULL; layer; layer = layer->base)
        for (uint32_t i = 0; i < layer->units.len; i++)
            diag_guess_add(&guess, text_of(lib, layer->units.items[i].name));
    return diag_guess_text(&guess);
}
