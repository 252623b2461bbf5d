// SPDX-License-Identifier: Apache-2.0
/* Inputs that take a shader: a shader comes from a node, and a material needs at least one. */
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

/* The name of the only node of a type beside `node`; 0: there are none or several. */
static str_id only_node(const struct library *lib, elem_id node, str_id type,
                        struct diag_list *diags)
{
    enum { MAX_SEARCHED = 4096 };
    const struct document *doc = &lib->doc;
    if (!diag_may_guess(diags))
        return 0;
    diags->num_guesses++;
    str_id found = 0;
    elem_id e = doc_element(doc, doc_element(doc, node)->parent)->first_child;
    for (unsigned searched = 0; e; e = doc_element(doc, e)->next, searched++) {
        bool fits =
            doc_element(doc, e)->kind == KIND_NODE && doc_attr_value(doc, e, STR_type) == type;
        if ((fits && found) || searched == MAX_SEARCHED)
            return 0;
        found = fits ? doc_element(doc, e)->name : found;
    }
    return found;
}

static void report_missing(const struct library *lib, elem_id material, const struct port *port,
                           struct diag_list *diags)
{
    const struct element *e = doc_element(&lib->doc, material);
    str_id shader = only_node(lib, material, library_type_name(lib, port->type), diags);
    struct text source;
    text_init(&source, diags->arena);
    text_fmt(&source, shader ? "'%s'" : "a node", text_of(lib, shader));
    diag_add(diags, DIAG_ID_no_shader, doc_name_place(&lib->doc, material), text_of(lib, e->name),
             text_cstr(&source), text_of(lib, port->name));
}

/* True if a node, an interface or a fault of its own stands at the input. */
static bool is_given(const struct library *lib, elem_id node, const struct binding *binding)
{
    if (binding->kind != BIND_DEFAULT && binding->kind != BIND_VALUE)
        return true;
    /* the value of another port: the input is connected to it */
    return binding->element && doc_element(&lib->doc, binding->element)->parent != node;
}

void library_check_shaders(const struct library *lib, elem_id node, uint32_t nodedef,
                           const struct binding *bindings, struct diag_list *diags)
{
    assert(node >= lib->doc.first_element);
    const struct nodedef *def = library_nodedef(lib, nodedef);
    const struct port *ports = library_ports(lib, nodedef, NULL), *first = NULL;
    bool is_any_given = false;
    for (unsigned i = 0; i < def->num_inputs; i++) {
        const struct binding *binding = &bindings[i];
        if (!ir_type_is_shader(library_type_ir(lib, ports[i].type)))
            continue;
        first = first ? first : &ports[i];
        str_id value = binding->kind == BIND_VALUE
                           ? doc_attr_value(&lib->doc, binding->element, STR_value)
                           : 0;
        bool is_value = value && binding->element >= lib->doc.first_element;
        if (is_value)
            report_value(lib, &ports[i], binding->element, value, diags);
        is_any_given |= is_value || is_given(lib, node, binding);
    }
    bool needs_one = def->node == STR_surfacematerial || def->node == STR_volumematerial;
    if (needs_one && first && !is_any_given)
        report_missing(lib, node, first, diags);
}
