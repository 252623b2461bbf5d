// SPDX-License-Identifier: Apache-2.0
/* Nodegraphs that implement definitions: resolves `interfacename` inside them. */
#include "library/library.h"

#include <assert.h>

static const char *text_of(const struct library *lib, str_id id)
{
    return str_text(&lib->strings, id);
}

elem_id library_graph_around(const struct library *lib, elem_id element)
{
    while (element && doc_element(&lib->doc, element)->kind != KIND_NODEGRAPH)
        element = doc_element(&lib->doc, element)->parent;
    return element;
}

uint32_t library_implemented_nodedef(const struct library *lib, elem_id graph)
{
    str_id name = graph ? doc_attr_value(&lib->doc, graph, STR_nodedef) : 0;
    if (name)
        return library_nodedef_by_name(lib, name);
    for (uint32_t i = 0; graph && i < lib->impls.len; i++)
        if (lib->impls.items[i].kind == IMPL_GRAPH && lib->impls.items[i].ref == graph)
            return lib->impls.items[i].nodedef;
    return LIBRARY_NONE;
}

/* Suggests an interface input of the nodegraph, or of its definition if it has one. */
static const char *suggest(const struct library *lib, elem_id graph, uint32_t nodedef, str_id name,
                           struct diag_list *diags)
{
    struct diag_guess guess;
    if (!diag_guess_begin(&guess, diags, text_of(lib, name)))
        return "";
    for (int i = 0; nodedef != LIBRARY_NONE && i < library_nodedef(lib, nodedef)->num_inputs; i++)
        diag_guess_add(&guess, text_of(lib, library_ports(lib, nodedef, NULL)[i].name));
    for (elem_id e = graph ? doc_element(&lib->doc, graph)->first_child : 0; e;
         e = doc_element(&lib->doc, e)->next)
        if (doc_element(&lib->doc, e)->kind == KIND_INPUT)
            diag_guess_add(&guess, text_of(lib, doc_element(&lib->doc, e)->name));
    return diag_guess_text(&guess);
}

int library_resolve_interface(const struct library *lib, elem_id asker, uint32_t nodedef,
                              const struct binding *binding, const struct port *port,
                              struct diag_list *diags)
{
    assert(binding->kind == BIND_INTERFACE);
    str_id name = binding->ref;
    const struct port *ports = nodedef != LIBRARY_NONE ? library_ports(lib, nodedef, NULL) : NULL;
    int index =
        ports && binding->input < library_nodedef(lib, nodedef)->num_inputs ? binding->input : -1;
    if (ports && (index < 0 || ports[index].name != name))
        index = library_find_input(lib, nodedef, name);
    struct diag_place place = doc_attr_place(&lib->doc, asker, STR_interfacename);
    if (index < 0) {
        diag_add(diags, DIAG_ID_dangling_interfacename, place, text_of(lib, name),
                 suggest(lib, library_graph_around(lib, asker), nodedef, name, diags));
        return -1;
    }
    if (port->type != DOC_TYPE_NONE && ports[index].type != port->type) {
        diag_add(diags, DIAG_ID_type_mismatch, place, text_of(lib, port->name),
                 text_of(lib, library_type_name(lib, port->type)),
                 text_of(lib, library_type_name(lib, ports[index].type)));
        return -1;
    }
    assert(index < library_nodedef(lib, nodedef)->num_inputs);
    return index;
}
