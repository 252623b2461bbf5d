// SPDX-License-Identifier: Apache-2.0
/* Values without a connection: constants, defaults and geometric properties. */
#include "build/build_priv.h"

#include "lower/lower.h"

#include <math.h>

static void report_infinite(struct builder *b, const struct ir_value *value, str_id text,
                            elem_id element)
{
    unsigned components = ir_type_is_float(value->type) ? ir_type_components(value->type) : 0;
    for (unsigned i = 0; i < components; i++)
        if (!isfinite(value->w[i].f)) {
            doc_report_infinite(build_text(b, text),
                                doc_attr_place(build_doc(b), element, STR_value), b->diags);
            return;
        }
}

/* A string as its element has it, and the name of a geometry with its prefix. */
static ir_ref words(struct builder *b, const struct port *port, str_id text, elem_id element)
{
    const struct document *doc = build_doc(b);
    if (port->type == DOC_TYPE_geomname && element && doc_attr_value(doc, element, STR_value))
        text = str_intern_z(b->shader->strings,
                            doc_prefixed_geometry(doc, element, STR_value, b->arena));
    return ir_const_string(b->graph, text);
}

ir_ref build_constant(struct builder *b, const struct port *port, str_id text, elem_id element)
{
    ir_type_id ir = build_type(b, port->type);
    struct ir_value value;
    if (ir == IR_TYPE_STRING) {
        library_check_enum(b->lib, port, text, doc_attr_place(build_doc(b), element, STR_value),
                           b->diags);
        return words(b, port, text, element);
    }
    if (doc_parse_value(port->type, build_text(b, text), str_len(b->shader->strings, text),
                        b->shader->strings, &value)) {
        report_infinite(b, &value, text, element);
        return ir_const(b->graph, &value);
    }
    if (text == doc_attr_value(build_doc(b), element, STR_value)
        && doc_read_loosely(port->type, build_text(b, text), str_len(&b->lib->strings, text),
                            &value)) {
        library_report_loose(b->lib, element, port->type, b->diags);
        report_infinite(b, &value, text, element);
        return ir_const(b->graph, &value);
    }
    doc_report_value(port->type, build_text(b, library_type_name(b->lib, port->type)),
                     build_text(b, text), doc_attr_place(build_doc(b), element, STR_value),
                     b->diags);
    return ir_poison(b->graph, ir);
}

/* A number of the host, such as the frame, is no input of the document. */
static void decide_by(struct builder *b, struct shader_variable *uniform)
{
    if (uniform->update == UPDATE_SHADER || !uniform->path || b->recorder)
        return;
    uniform->update = UPDATE_SHADER;
    vec_push(
        b->arena, &b->shader->reflection.compiled,
        (struct shader_compiled_input){uniform->element, uniform->definition, uniform->doc_type});
}

bool build_initial(struct builder *b, ir_ref value, struct ir_value *out)
{
    const struct ir_node *node = ir_get(b->graph, value);
    assert(node->op != IR_UNIFORM || node->attr < b->shader->interface.variables.len);
    if (node->op != IR_UNIFORM)
        return ir_get_const(b->graph, value, out);
    struct shader_variable *uniform = &b->shader->interface.variables.items[node->attr];
    decide_by(b, uniform);
    *out = uniform->value;
    return uniform->has_default;
}

static bool source(void *user_data, const struct ir_graph *graph, ir_ref ref, struct ir_value *out)
{
    (void)graph;
    return build_initial(user_data, ref, out);
}

static uint32_t call(void *user_data, const struct ir_graph *graph, ir_ref ref,
                     const struct ir_value *args, struct ir_value *out)
{
    struct builder *b = user_data;
    return lang_eval_node(b->shader->unit, graph, ref, args, &(uint32_t){LANG_MAX_STEPS}, b->arena,
                          out);
}

bool build_evaluate(struct builder *b, ir_ref value, struct ir_value *out)
{
    if (!b->initial.graph) {
        b->initial_env = (struct ir_eval_env){.user_data = b, .source = source, .call = call};
        ir_evaluator_init(&b->initial, b->graph, &b->initial_env, b->arena);
    }
    return ir_evaluate(&b->initial, value, out);
}

/* ---- defaults ---- */

static ir_ref geomprop_arg(struct builder *b, const struct geomprop *prop, const struct port *port)
{
    if (port->name == STR_space && prop->space)
        return ir_const_string(b->graph, prop->space);
    if (port->name == STR_index)
        return ir_const_int(b->graph, prop->index);
    if (port->name == STR_geomprop && prop->nodedef == LIBRARY_NONE)
        return ir_const_string(b->graph, prop->name);
    return build_default(b, port);
}

/*
 * A property with a node is this node, with the property's space and index. Any other property is a
 * stream of its name, or in a network the node that reads it.
 */
static ir_ref make_geomprop(struct builder *b, const struct geomprop *prop)
{
    uint32_t nodedef = prop->nodedef;
    assert(nodedef == LIBRARY_NONE || nodedef < library_num_nodedefs(b->lib));
    if (nodedef == LIBRARY_NONE && !b->recorder)
        return build_property(
            b, &(struct property){.name = prop->name, .type = build_type(b, prop->type)});
    if (nodedef == LIBRARY_NONE)
        nodedef = build_definition_of(b, "geompropvalue", library_type_name(b->lib, prop->type));
    if (nodedef == LIBRARY_NONE)
        return ir_poison(b->graph, build_type(b, prop->type));
    const struct nodedef *def = library_nodedef(b->lib, nodedef);
    const struct port *ports = library_ports(b->lib, nodedef, NULL);
    ir_ref *args = ARENA_ARRAY(b->arena, ir_ref, def->num_inputs);
    for (uint32_t i = 0; i < def->num_inputs; i++)
        args[i] = geomprop_arg(b, prop, &ports[i]);
    ir_push_name(b->graph, b->recorder ? prop->name : prop->geomprop);
    ir_ref results[LIBRARY_MAX_OUTPUTS];
    build_apply(b, nodedef, prop->element, args, results);
    ir_pop_origin(b->graph);
    return results[0];
}

ir_ref build_geomprop(struct builder *b, const struct geomprop *prop)
{
    assert(b->geomprops.len % 2 == 0);
    for (uint32_t i = 0; i < b->geomprops.len; i += 2)
        if (b->geomprops.items[i] == prop->name)
            return b->geomprops.items[i + 1];
    ir_ref value = make_geomprop(b, prop);
    vec_push(b->arena, &b->geomprops, prop->name);
    vec_push(b->arena, &b->geomprops, value);
    return value;
}

ir_ref build_default_geomprop(struct builder *b, elem_id element, doc_type type)
{
    const struct geomprop *prop = library_default_geomprop(b->lib, element, type, b->diags);
    return prop ? build_geomprop(b, prop) : ir_poison(b->graph, build_type(b, type));
}

static ir_ref zero(struct builder *b, ir_type_id type)
{
    struct ir_value value = {.type = type};
    return ir_const(b->graph, &value);
}

ir_ref build_default(struct builder *b, const struct port *port)
{
    if (port->geomprop)
        return build_default_geomprop(b, port->element, port->type);
    ir_type_id type = build_type(b, port->type);
    if (type == IR_TYPE_STRING)
        return words(b, port, port->value, port->element);
    if (type >= IR_NUM_TYPES)
        return build_struct(b, port, port->value, port->element);
    if (!ir_type_info(type)->components) /* the type has no values */
        return 0;
    return port->flags & PORT_HAS_VALUE && port->value
               ? build_constant(b, port, port->value, port->element)
               : zero(b, type);
}
