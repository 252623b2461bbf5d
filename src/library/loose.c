// SPDX-License-Identifier: Apache-2.0
/*
 * Values with more numbers than their input has, or with text behind a number. The reader takes the
 * first numbers, as MaterialX does.
 */
#include "library/library.h"

static const char *text_of(const struct library *lib, str_id id)
{
    return str_text(&lib->strings, id);
}

/* " (did you mean 'x', …?)": an input of the node's definition with room for all numbers. */
static const char *suggest(const struct library *lib, elem_id node, str_id name, unsigned count,
                           struct diag_list *diags)
{
    struct diag_list unheard; /* the match reports its own faults elsewhere */
    diag_list_init_unheard(&unheard, diags->arena);
    uint32_t nodedef = doc_element(&lib->doc, node)->kind == KIND_NODE
                           ? library_match(lib, node, &unheard)
                           : LIBRARY_NONE;
    struct diag_guess guess;
    if (nodedef == LIBRARY_NONE || !diag_guess_begin(&guess, diags, text_of(lib, name)))
        return "";
    const struct port *ports = library_ports(lib, nodedef, NULL);
    for (uint32_t i = 0; i < library_nodedef(lib, nodedef)->num_inputs; i++)
        if (doc_type_components(ports[i].type) == count)
            diag_guess_add(&guess, text_of(lib, ports[i].name));
    return diag_guess_text(&guess);
}

void library_report_loose(const struct library *lib, elem_id element, doc_type type,
                          struct diag_list *diags)
{
    const struct element *e = doc_element(&lib->doc, element);
    str_id value = doc_attr_value(&lib->doc, element, STR_value);
    unsigned count =
        doc_read_loosely(type, text_of(lib, value), str_len(&lib->strings, value), NULL);
    bool is_excess = count > doc_type_components(type);
    doc_report_loose(&lib->doc, element, type,
                     is_excess ? suggest(lib, e->parent, e->name, count, diags) : "", diags);
}
