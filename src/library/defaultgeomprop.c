// SPDX-License-Identifier: Apache-2.0
/* Geometric properties as defaults: defaultgeomprop (specification, "NodeDef Input Elements"). */
#include "library/library.h"

static const char *text_of(const struct library *lib, str_id id)
{
    return str_text(&lib->strings, id);
}

const struct geomprop *library_default_geomprop(const struct library *lib, elem_id element,
                                                doc_type type, struct diag_list *diags)
{
    str_id name = doc_attr_value(&lib->doc, element, STR_defaultgeomprop);
    const struct geomprop *prop = library_geomprop(lib, name);
    struct diag_place place = doc_attr_place(&lib->doc, element, STR_defaultgeomprop);
    if (!prop)
        diag_add(diags, DIAG_ID_unknown_geomprop, place, text_of(lib, name), "");
    else if (prop->type != type)
        diag_add(diags, DIAG_ID_type_mismatch, place, "input",
                 text_of(lib, doc_element(&lib->doc, element)->name),
                 text_of(lib, library_type_name(lib, type)),
                 text_of(lib, library_type_name(lib, prop->type)));
    return prop && prop->type == type ? prop : NULL;
}
