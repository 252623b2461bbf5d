// SPDX-License-Identifier: Apache-2.0
/* The end of a connection: a node, a value, a texture or a default. */
#include "build/build_priv.h"

static ir_ref texture(struct builder *b, const struct instance *scope, elem_id node,
                      const struct port *port, elem_id element, str_id input)
{
    struct shader_variable v =
        build_describe(b, node, port, element, input, build_input_path(b, node, input, element));
    bool has_value = element && doc_attr(build_doc(b), element, STR_value);
    v.file = has_value ? build_file_name(b, scope, element)
                       : build_default_file_name(b, scope, node, port);
    return build_texture(b, v, has_value ? element : port->element ? port->element : node);
}

/* The value attribute of an element of the document or of a graph, as it stands there. */
static ir_ref literal(struct builder *b, const struct instance *scope, elem_id owner,
                      const struct port *port, elem_id element, bool outermost)
{
    str_id name = doc_element(build_doc(b), element)->name;
    ir_type_id type = build_type(b, port->type);
    if (type == IR_TYPE_SAMPLER)
        return texture(b, scope, owner, port, element, name);
    if (ir_type_is_closure(type) || ir_type_is_shader(type))
        return 0; /* documents write value="" for "no value" */
    str_id text = doc_attr_value(build_doc(b), element, STR_value);
    if (type >= IR_NUM_TYPES) {
        build_compile_in(b, owner, port, element);
        return build_struct(b, port, text, element);
    }
    ir_ref value = build_constant(b, port, text, element);
    if (outermost)
        return build_publish(b, owner, port, element, name, value, true);
    if (ir_is_const(b->graph, value))
        build_compile_in(b, owner, port, element);
    return value;
}

static str_id own_geomprop(const struct builder *b, elem_id element)
{
    return element ? doc_attr_value(build_doc(b), element, STR_defaultgeomprop) : 0;
}

static ir_ref unset(struct builder *b, const struct instance *scope, elem_id owner,
                    const struct port *port, elem_id element, bool outermost)
{
    if (build_type(b, port->type) == IR_TYPE_SAMPLER)
        return texture(b, scope, owner, port, element, port->name);
    if (own_geomprop(b, element))
        return build_default_geomprop(b, element, port->type);
    ir_ref value = build_default(b, port);
    if (!value || port->geomprop || ir_type_of(b->graph, value) >= IR_NUM_TYPES)
        return value;
    struct build_meaning meaning = build_meaning_of_default(b, port);
    if (!outermost && ir_is_const(b->graph, value))
        build_compile_in(b, owner, port, element);
    if (outermost)
        value = build_publish(b, owner, port, element,
                              element ? doc_element(build_doc(b), element)->name : port->name,
                              value, false);
    return build_convert(b, value, port->type, &meaning);
}

static elem_id graph_around(const struct builder *b, elem_id element)
{
    while (element && doc_element(build_doc(b), element)->kind != KIND_NODEGRAPH)
        element = doc_element(build_doc(b), element)->parent;
    return element;
}

/*
 * A functional graph that is generated directly, without a node that uses it, has the defaults of
 * its definition.
 */
static ir_ref interface_arg(struct builder *b, struct instance *scope, const struct port *port,
                            const struct binding *binding)
{
    elem_id alone = scope->graph ? 0 : graph_around(b, binding->element);
    uint32_t nodedef = alone ? library_implemented_nodedef(b->lib, alone) : scope->nodedef;
    /* the reader of the document has reported it */
    if (nodedef == LIBRARY_NONE && alone && doc_attr_value(build_doc(b), alone, STR_nodedef))
        return unset(b, scope, doc_element(build_doc(b), binding->element)->parent, port,
                     binding->element, true);
    int index =
        library_resolve_interface(b->lib, binding->element, nodedef, binding, port, b->diags);
    if (index < 0)
        return ir_poison(b->graph, build_type(b, port->type));
    const struct port *have = library_ports(b->lib, nodedef, NULL) + index;
    assert(have->name == binding->ref);
    return alone ? unset(b, scope, alone, have, 0, true) : scope->args[index];
}

/*
 * True after a warning: the input has a geometric property, so its value does not count. All
 * MaterialX generators do so, and materials depend on it. The port's property is one of its node.
 */
static bool ignores_value(struct builder *b, elem_id node, elem_id owner, const struct port *port,
                          elem_id element)
{
    str_id name = own_geomprop(b, element);
    if (!name && owner == node)
        name = port->geomprop;
    if (!name)
        return false;
    diag_add(b->diags, DIAG_ID_geomprop_literal, doc_attr_place(build_doc(b), element, STR_value),
             build_text(b, doc_element(build_doc(b), element)->name), build_text(b, name));
    return true;
}

/* The node or graph whose input an element is; for other elements the node that asks. */
static elem_id owner_of(const struct builder *b, elem_id node, elem_id element)
{
    return element && doc_element(build_doc(b), element)->kind == KIND_INPUT
               ? doc_element(build_doc(b), element)->parent
               : node;
}

/*
 * The value at the end of a chain of connections, as its element has it, or without a meaning the
 * default. In the document it exists once for all readers,
 * and belongs to the element with the value attribute. This can be an interface input further up;
 * the host changes that one.
 */
static ir_ref end_of_chain(struct builder *b, struct instance *scope, elem_id node,
                           const struct port *port, const struct binding *binding,
                           const struct build_meaning *meaning)
{
    elem_id element = binding->element, owner = owner_of(b, node, element);
    bool outermost = !scope->graph, says_value = meaning != NULL;
    uint32_t *slot = element && outermost ? &scope->slots[element - scope->first] : NULL;
    assert(!slot || *slot < SLOT_RESULTS + b->results.len);
    assert(!slot || element - scope->first < scope->num_slots);
    if (slot && *slot >= SLOT_RESULTS)
        return b->results.items[*slot - SLOT_RESULTS];
    b->reader.node = node;
    b->reader.input = port->name;
    b->reader.transforms = meaning && doc_type_is_color(port->type) && meaning->space;
    ir_ref value = says_value ? literal(b, scope, owner, port, element, outermost)
                              : unset(b, scope, owner, port, element, outermost);
    b->reader.transforms = false;
    if (slot) {
        assert(*slot == SLOT_EMPTY);
        *slot = SLOT_RESULTS + b->results.len;
        vec_push(b->arena, &b->results, value);
    }
    return value;
}

ir_ref build_written_input(struct builder *b, struct instance *scope, elem_id node,
                           const struct port *port, const struct binding *binding)
{
    assert(binding->kind == BIND_INTERFACE || binding->kind == BIND_VALUE);
    if (binding->kind == BIND_INTERFACE)
        return interface_arg(b, scope, port, binding);
    struct build_meaning meaning = build_meaning_of(b, node, port, binding);
    bool is_ignored =
        ignores_value(b, node, owner_of(b, node, binding->element), port, binding->element);
    return end_of_chain(b, scope, node, port, binding, is_ignored ? NULL : &meaning);
}

static ir_ref source_value(struct builder *b, struct instance *scope, elem_id node,
                           const struct port *port, const struct binding *binding)
{
    struct build_meaning meaning;
    switch ((enum binding_kind)binding->kind) {
    case BIND_NODE: return build_result(b, scope, binding->ref, binding->output, port->type);
    case BIND_INTERFACE:
        meaning = build_meaning_of(b, node, port, binding);
        return build_convert(b, interface_arg(b, scope, port, binding), port->type, &meaning);
    case BIND_ERROR: return ir_poison(b->graph, build_type(b, port->type));
    case BIND_VALUE:
        if (ignores_value(b, node, owner_of(b, node, binding->element), port, binding->element))
            break;
        meaning = build_meaning_of(b, node, port, binding);
        return build_convert(b, end_of_chain(b, scope, node, port, binding, &meaning), port->type,
                             &meaning);
    case BIND_DEFAULT: break;
    }
    return end_of_chain(b, scope, node, port, binding, NULL);
}

/* ---- Strings as names of files ---- */

/* True if a value is written for a string. */
static bool is_string(const struct builder *b, const struct binding *binding)
{
    bool is_written = binding->kind == BIND_VALUE || binding->kind == BIND_DEFAULT;
    return is_written && binding->element
           && doc_attr_value(build_doc(b), binding->element, STR_type) == STR_string;
}

/*
 * The file that a string names, as it is: prefixes and tokens are for values of the type filename.
 * It belongs to the input, because a string may have other readers.
 */
static ir_ref file_of(struct builder *b, elem_id node, const struct port *port, ir_ref string)
{
    elem_id own = doc_child_of_kind(build_doc(b), node, KIND_INPUT, port->name);
    struct ir_value name;
    if (ir_get(b->graph, string)->op == IR_POISON)
        return ir_poison(b->graph, IR_TYPE_SAMPLER);
    if (!ir_get_const(b->graph, string, &name)) {
        diag_add(b->diags, DIAG_ID_input_must_be_constant,
                 doc_place(build_doc(b), own ? own : node), build_text(b, port->name),
                 build_text(b, doc_element(build_doc(b), node)->category));
        return ir_poison(b->graph, IR_TYPE_SAMPLER);
    }
    struct shader_variable v =
        build_describe(b, node, port, own, port->name, build_input_path(b, node, port->name, own));
    v.file = name.w[0].u;
    return build_texture(b, v, own ? own : node);
}

ir_ref build_input(struct builder *b, struct instance *scope, elem_id node, const struct port *port,
                   const struct binding *binding)
{
    bool is_file = port->type == DOC_TYPE_filename;
    struct port as_string = *port;
    as_string.type = DOC_TYPE_string;
    ir_ref value =
        source_value(b, scope, node, is_file && is_string(b, binding) ? &as_string : port, binding);
    bool is_named = is_file && value && ir_type_of(b->graph, value) == IR_TYPE_STRING;
    return is_named ? file_of(b, node, port, value) : value;
}
