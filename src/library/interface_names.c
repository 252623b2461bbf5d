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

bool library_graph_reads(const struct library *lib, elem_id graph, str_id input)
{
    for (elem_id at = doc_element(&lib->doc, graph)->first_child; at;
         at = doc_next_in_tree(&lib->doc, graph, at))
        if (doc_attr_value(&lib->doc, at, STR_interfacename) == input)
            return true;
    return false;
}

bool library_graph_says(const struct library *lib, elem_id graph, str_id input, str_id attr)
{
    for (elem_id at = doc_element(&lib->doc, graph)->first_child; at;
         at = doc_next_in_tree(&lib->doc, graph, at))
        if (doc_attr_value(&lib->doc, at, STR_interfacename) == input
            && doc_attr_value(&lib->doc, at, attr))
            return true;
    return false;
}

bool library_images_convert(const struct library *lib, uint32_t nodedef, str_id attr)
{
    const struct nodedef *def = library_nodedef(lib, nodedef);
    const struct port *outputs = library_ports(lib, nodedef, NULL) + def->num_inputs;
    bool is_any = false;
    assert(attr == STR_colorspace || attr == STR_unit);
    for (uint32_t i = 0; i < def->num_outputs; i++) {
        doc_type type = outputs[i].type;
        ir_type_id ir = library_type_ir(lib, type);
        if (ir_type_is_closure(ir) || ir_type_is_shader(ir))
            return true;
        is_any |= attr == STR_colorspace ? doc_type_is_color(type) : doc_type_is_measure(type);
    }
    return !is_any;
}

/* True if the node reads a file. */
static bool has_file(const struct library *lib, elem_id node)
{
    for (elem_id e = doc_element(&lib->doc, node)->first_child; e;
         e = doc_element(&lib->doc, e)->next)
        if (doc_attr_value(&lib->doc, e, STR_type) == STR_filename)
            return true;
    return false;
}

bool library_graph_has_border(const struct library *lib, elem_id graph, str_id input)
{
    for (elem_id at = doc_element(&lib->doc, graph)->first_child; at;
         at = doc_next_in_tree(&lib->doc, graph, at)) {
        if (doc_attr_value(&lib->doc, at, STR_interfacename) != input)
            continue;
        str_id name = doc_element(&lib->doc, at)->name;
        bool stands_in = name == STR_default || strcmp(text_of(lib, name), "fallback") == 0;
        if (stands_in && has_file(lib, doc_element(&lib->doc, at)->parent))
            return true;
    }
    return false;
}

uint32_t library_implemented_nodedef(const struct library *lib, elem_id graph)
{
    str_id name = graph ? doc_attr_value(&lib->doc, graph, STR_nodedef) : 0;
    if (name)
        return library_nodedef_by_name(lib, name);
    const struct library *layer;
    uint32_t own = graph ? library_element_info(lib, graph, &layer) : LIBRARY_NONE;
    return own != LIBRARY_NONE && doc_element(&lib->doc, graph)->kind == KIND_NODEGRAPH
               ? layer->impls.items[own].nodedef
               : LIBRARY_NONE;
}

enum { MAX_LISTED = 24 }; /* inputs in a note */

/* Calls `add` for the inputs of the nodegraph, or of its definition if it has one. */
static void for_inputs(const struct library *lib, elem_id graph, uint32_t nodedef,
                       void (*add)(void *user, const char *name), void *user)
{
    for (int i = 0; nodedef != LIBRARY_NONE && i < library_nodedef(lib, nodedef)->num_inputs; i++)
        add(user, text_of(lib, library_ports(lib, nodedef, NULL)[i].name));
    for (elem_id e = graph && nodedef == LIBRARY_NONE ? doc_element(&lib->doc, graph)->first_child
                                                      : 0;
         e; e = doc_element(&lib->doc, e)->next)
        if (doc_element(&lib->doc, e)->kind == KIND_INPUT)
            add(user, text_of(lib, doc_element(&lib->doc, e)->name));
}

static void guess(void *user, const char *name)
{
    diag_guess_add(user, name);
}

struct listing {
    struct text text;
    unsigned count;
};

static void list(void *user, const char *name)
{
    struct listing *listing = user;
    if (listing->count < MAX_LISTED)
        text_fmt(&listing->text, "%s%s", listing->count ? ", " : "", name);
    else if (listing->count == MAX_LISTED)
        text_str(&listing->text, ", …");
    listing->count++;
}

static void report_dangling(const struct library *lib, elem_id asker, uint32_t nodedef, str_id name,
                            struct diag_list *diags)
{
    elem_id graph = library_graph_around(lib, asker);
    const char *graph_name = graph ? text_of(lib, doc_element(&lib->doc, graph)->name) : "";
    struct text who;
    text_init(&who, diags->arena);
    if (graph)
        text_fmt(&who, "the nodegraph '%s'", graph_name);
    else
        text_str(&who, "the document");
    struct diag_guess suggestion;
    bool may_walk = diag_may_guess(diags);
    if (diag_guess_begin(&suggestion, diags, text_of(lib, name)))
        for_inputs(lib, graph, nodedef, guess, &suggestion);
    diag_add(diags, DIAG_ID_dangling_interfacename,
             doc_attr_place(&lib->doc, asker, STR_interfacename), text_cstr(&who),
             text_of(lib, name), diag_guess_text(&suggestion));
    struct listing inputs = {.count = 0};
    text_init(&inputs.text, diags->arena);
    if (may_walk) /* like suggestions, so that many faults take linear time */
        for_inputs(lib, graph, nodedef, list, &inputs);
    if (graph && inputs.count)
        diag_add(diags, DIAG_ID_graph_inputs,
                 doc_place(&lib->doc, nodedef == LIBRARY_NONE
                                          ? graph
                                          : library_nodedef(lib, nodedef)->element),
                 graph_name, text_cstr(&inputs.text));
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
    if (index < 0) {
        report_dangling(lib, asker, nodedef, name, diags);
        return -1;
    }
    bool is_output = doc_element(&lib->doc, asker)->kind == KIND_OUTPUT,
         is_fitting = port->type == DOC_TYPE_NONE || ports[index].type == port->type
                      || (!is_output && library_accepts(port->type, ports[index].type));
    if (!is_fitting) {
        diag_add(diags, DIAG_ID_type_mismatch, doc_attr_place(&lib->doc, asker, STR_interfacename),
                 is_output ? "output" : "input", text_of(lib, port->name),
                 text_of(lib, library_type_name(lib, port->type)),
                 text_of(lib, library_type_name(lib, ports[index].type)));
        diag_add(diags, DIAG_ID_connected_here, doc_name_place(&lib->doc, ports[index].element),
                 text_of(lib, name));
        return -1;
    }
    assert(index < library_nodedef(lib, nodedef)->num_inputs);
    return index;
}
