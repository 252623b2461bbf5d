// SPDX-License-Identifier: Apache-2.0
/* One node of a network: its definition over parameters, as a shader of its own. */
#include "build/build_priv.h"

/*
 * The type of an input from another layer: closures have any kind, and a displacement is its
 * offset.
 */
static ir_type_id parameter_type(ir_type_id type)
{
    return type == IR_TYPE_DISPLACEMENT                          ? IR_TYPE_VEC3
           : ir_type_is_closure(type) || ir_type_is_shader(type) ? IR_TYPE_BSDF
                                                                 : type;
}

static ir_ref add_parameter(struct builder *b, const struct port *port, str_id file,
                            str_id *out_name)
{
    ir_type_id type = library_type_ir(b->lib, port->type);
    struct shader_variable v = {.name = port->name,
                                .block = BLOCK_PUBLIC_UNIFORMS,
                                .type = parameter_type(type),
                                .doc_type = library_type_name(b->lib, port->type),
                                .definition = port->element};
    if (type == IR_TYPE_SAMPLER) {
        v.file = file;
        ir_ref texture = build_texture(b, v, port->element);
        *out_name = b->shader->interface.variables.items[ir_get(b->graph, texture)->attr].name;
        return texture;
    }
    v.has_default = build_is_number(type);
    v.value = build_network_default(b, port);
    uint32_t variable = shader_add_variable(b->shader, &v);
    *out_name = b->shader->interface.variables.items[variable].name;
    return ir_build(b->graph, IR_UNIFORM, type, variable, NULL, 0);
}

static ir_ref argument(struct builder *b, const struct implementation *impl,
                       const struct port *port, const struct ir_value *value, str_id *out_name)
{
    if (value->type == IR_TYPE_VOID
        || (value->type == IR_TYPE_SAMPLER && impl->kind != IMPL_DYNAMIC))
        return add_parameter(b, port, value->type == IR_TYPE_VOID ? port->value : value->w[0].u,
                             out_name);
    if (value->type == IR_TYPE_STRING)
        return ir_const_string(b->graph, value->w[0].u);
    if (value->type != IR_TYPE_SAMPLER)
        return ir_const(b->graph, value);
    struct shader_variable v = {.name = port->name, .type = IR_TYPE_SAMPLER, .file = value->w[0].u};
    return build_texture(b, v, b->document->node);
}

void build_network_node(struct builder *b, struct network_node *node, ir_ref *results)
{
    assert(node->num_inputs == library_nodedef(b->lib, node->definition)->num_inputs);
    const struct port *ports = library_ports(b->lib, node->definition, NULL);
    struct frame frame = {.node = {.nodedef = node->definition, .element = b->document->node}};
    str_id *names = ARENA_ARRAY(b->arena, str_id, node->num_inputs);
    frame.args = ARENA_ARRAY(b->arena, ir_ref, node->num_inputs);
    frame.impl = build_choose(b, node->definition, frame.node.element);
    assert(frame.impl->nodedef == node->definition);
    ir_push_name(b->graph, str_intern_z(b->shader->strings, "value"));
    for (uint32_t i = 0; i < node->num_inputs; i++)
        frame.args[i] = argument(b, frame.impl, &ports[i], &node->fixed[i], &names[i]);
    node->inputs = names;
    build_node(b, &frame, results);
    ir_pop_origin(b->graph);
}

str_id build_network_output(struct builder *b, const struct network_node *node, uint32_t index,
                            str_id *out_type)
{
    assert(index < node->num_outputs);
    const struct port *port =
        library_ports(b->lib, node->definition, NULL) + node->num_inputs + index;
    *out_type = library_type_name(b->lib, port->type);
    return port->name;
}
