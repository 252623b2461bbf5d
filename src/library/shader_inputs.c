// SPDX-License-Identifier: Apache-2.0
/* Inputs that take a shader: a shader comes from a node; materials and dots need at least one. */
#include "library/library.h"

#include <assert.h>

static const char *text_of(const struct library *lib, str_id id)
{
    return str_text(&lib->strings, id);
}

/* Authors write value="SR" for nodename="SR". */
static void report_value(const struct library *lib, const struct port *port, elem_id element,
                         str_id value, struct diag_list *diags)
{
    elem_id graph = doc_element(&lib->doc, doc_element(&lib->doc, element)->parent)->parent;
    bool is_node = doc_child_of_kind(&lib->doc, graph, KIND_NODE, value) != 0;
    struct text advice;
    text_init(&advice, diags->arena);
    if (is_node)
        text_fmt(&advice, " (did you mean nodename=\"%s\"?)", text_of(lib, value));
    else
        text_str(&advice, "; connect a node with 'nodename'");
    diag_add(diags, DIAG_ID_shader_value, doc_attr_place(&lib->doc, element, STR_value),
             text_of(lib, port->name), text_of(lib, library_type_name(lib, port->type)),
             text_cstr(&advice));
}

/* The name of the only node of a type beside `owner` but `node`; 0: there are none or several. */
static str_id only_node(const struct library *lib, elem_id owner, elem_id node, str_id type,
                        struct diag_list *diags)
{
    enum { MAX_SEARCHED = 4096 };
    const struct document *doc = &lib->doc;
    if (!diag_may_guess(diags))
        return 0;
    diags->num_guesses++;
    str_id found = 0;
    elem_id e = doc_element(doc, doc_element(doc, owner)->parent)->first_child;
    for (unsigned searched = 0; e; e = doc_element(doc, e)->next, searched++) {
        bool fits = e != node && doc_element(doc, e)->kind == KIND_NODE
                    && doc_attr_value(doc, e, STR_type) == type;
        if ((fits && found) || searched == MAX_SEARCHED)
            return 0;
        found = fits ? doc_element(doc, e)->name : found;
    }
    return found;
}

/* `owner` has the input that needs a node: the node that asks, or a graph around it. */
static void report_missing(const struct library *lib, elem_id node, elem_id owner, str_id input,
                           str_id type, struct diag_list *diags)
{
    const struct document *doc = &lib->doc;
    bool is_dot = doc_element(doc, node)->category == STR_dot;
    const char *input_name = text_of(lib, input);
    str_id shader = only_node(lib, owner, node, type, diags);
    struct text source, target;
    text_init(&source, diags->arena);
    text_fmt(&source, shader ? "'%s'" : "a node", text_of(lib, shader));
    text_init(&target, diags->arena);
    if (owner == node)
        text_fmt(&target, "its input '%s'", input_name);
    else
        text_fmt(&target, "the input '%s' of '%s'", input_name,
                 text_of(lib, doc_element(doc, owner)->name));
    diag_add(diags, DIAG_ID_no_shader, doc_name_place(doc, node), is_dot ? "dot" : "material",
             text_of(lib, doc_element(doc, node)->name), text_cstr(&source), text_cstr(&target));
}

/* The input of a graph around the node that should have its shader; 0: it is not a graph's. */
static elem_id unset_interface(const struct library *lib, elem_id node,
                               const struct binding *binding)
{
    bool is_foreign = binding->kind == BIND_DEFAULT && binding->element
                      && doc_element(&lib->doc, binding->element)->parent != node;
    return is_foreign ? binding->element : 0;
}

void library_check_shaders(const struct library *lib, elem_id node, uint32_t nodedef,
                           const struct binding *bindings, struct diag_list *diags)
{
    assert(node >= lib->doc.first_element);
    const struct nodedef *def = library_nodedef(lib, nodedef);
    const struct port *ports = library_ports(lib, nodedef, NULL);
    elem_id owner = 0;
    str_id input = 0, type = 0;
    bool is_any_given = false;
    for (unsigned i = 0; i < def->num_inputs; i++) {
        const struct binding *binding = &bindings[i];
        if (!ir_type_is_shader(library_type_ir(lib, ports[i].type)))
            continue;
        elem_id interface = unset_interface(lib, node, binding);
        if (!input || (owner == node && interface)) {
            owner = interface ? doc_element(&lib->doc, interface)->parent : node;
            input = interface ? doc_element(&lib->doc, interface)->name : ports[i].name;
            type = library_type_name(lib, ports[i].type);
        }
        str_id value = binding->kind == BIND_VALUE
                           ? doc_attr_value(&lib->doc, binding->element, STR_value)
                           : 0;
        bool is_value = value && binding->element >= lib->doc.first_element;
        if (is_value)
            report_value(lib, &ports[i], binding->element, value, diags);
        /* a node, the input of a definition, or a fault of its own */
        bool is_connected = binding->kind != BIND_DEFAULT && binding->kind != BIND_VALUE;
        is_any_given |= is_value || is_connected;
    }
    bool needs_one =
        def->node == STR_surfacematerial || def->node == STR_volumematerial || def->node == STR_dot;
    if (needs_one && input && !is_any_given)
        report_missing(lib, node, owner, input, type, diags);
}
