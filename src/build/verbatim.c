// SPDX-License-Identifier: Apache-2.0
/* Calls of source for one target, which mxgen copies into the shader. */
#include "build/build_priv.h"

/* "{{in1}}" becomes "{{0}}": verbatim expressions of the shader refer to operands by number. */
static str_id number_inputs(struct builder *b, const struct nodedef *def, const struct port *ports,
                            str_id source)
{
    struct text out;
    text_init(&out, b->arena);
    for (const char *p = build_text(b, source); *p;) {
        const char *end = p[0] == '{' && p[1] == '{' ? strstr(p, "}}") : NULL;
        str_id name = end ? str_find(b->shader->strings, p + 2, (size_t)(end - p - 2)) : 0;
        int index = -1;
        for (int i = 0; name && i < def->num_inputs; i++)
            index = ports[i].name == name ? i : index;
        if (index < 0) {
            text_char(&out, *p++);
            continue;
        }
        text_fmt(&out, "{{%d}}", index);
        p = end + 2;
    }
    return str_intern(b->shader->strings, out.data, out.len);
}

static uint32_t verbatim_of(struct builder *b, const struct implementation *impl,
                            const struct port *outputs, unsigned num_outputs)
{
    const struct verbatim *source = library_verbatim(b->lib, impl->ref);
    struct shader_verbatim v = {.first_result = b->shader->result_types.len};
    if (source->function) {
        v.source = source->source;
        v.function = source->function;
        v.num_results = num_outputs;
        for (unsigned i = 0; i < num_outputs; i++)
            vec_push(b->arena, &b->shader->result_types, library_type_ir(b->lib, outputs[i].type));
    } else {
        const struct port *ports = library_ports(b->lib, impl->nodedef, NULL);
        v.expression =
            number_inputs(b, library_nodedef(b->lib, impl->nodedef), ports, source->source);
    }
    assert(v.first_result + v.num_results == b->shader->result_types.len);
    for (uint32_t i = 0; i < b->shader->verbatim.len; i++) {
        const struct shader_verbatim *have = &b->shader->verbatim.items[i];
        if (have->source == v.source && have->function == v.function
            && have->expression == v.expression)
            return i;
    }
    vec_push(b->arena, &b->shader->verbatim, v);
    return b->shader->verbatim.len - 1;
}

/* The first input or output whose type is a closure or a shader; NULL: there is none. */
static const struct port *opaque_port(const struct builder *b, const struct nodedef *def,
                                      const struct port *ports)
{
    for (unsigned i = 0; i < def->num_inputs + def->num_outputs; i++) {
        ir_type_id type = library_type_ir(b->lib, ports[i].type);
        if (ir_type_is_closure(type) || ir_type_is_shader(type))
            return &ports[i];
    }
    return NULL;
}

/* Reports source that mxgen cannot call, with the reason why it is not portable. */
static void report_unusable(struct builder *b, const struct implementation *impl,
                            const struct port *port)
{
    const struct verbatim *source = library_verbatim(b->lib, impl->ref);
    diag_add(b->diags, DIAG_ID_unusable_source, doc_place(&b->lib->doc, impl->element),
             build_text(b, impl->name), build_text(b, port->name),
             build_text(b, library_type_name(b->lib, port->type)));
    if (source->reason)
        diag_add(b->diags, DIAG_ID_not_portable,
                 (struct diag_place){.file = source->reason_file
                                                 ? build_text(b, source->reason_file)
                                                 : NULL,
                                     .line = source->reason_line,
                                     .column = source->reason_column},
                 build_text(b, source->reason));
}

void build_verbatim(struct builder *b, const struct frame *frame, ir_ref *results)
{
    const struct implementation *impl = frame->impl;
    const ir_ref *args = frame->args;
    const struct nodedef *def = library_nodedef(b->lib, impl->nodedef);
    const struct port *outputs = library_ports(b->lib, impl->nodedef, NULL) + def->num_inputs;
    const struct port *opaque = opaque_port(b, def, outputs - def->num_inputs);
    if (opaque) {
        report_unusable(b, impl, opaque);
        for (uint32_t i = 0; i < def->num_outputs; i++)
            results[i] = ir_poison(b->graph, library_type_ir(b->lib, outputs[i].type));
        return;
    }
    uint32_t index = verbatim_of(b, impl, outputs, def->num_outputs);
    assert(index < b->shader->verbatim.len);
    bool function = b->shader->verbatim.items[index].function != 0;
    uint32_t callee = ir_add_callee(
        b->graph,
        (struct ir_callee){.kind = IR_CALLEE_VERBATIM, .index = index, .name = def->name});
    ir_type_id type = function ? IR_TYPE_VOID : library_type_ir(b->lib, outputs[0].type);
    ir_ref call = ir_build(b->graph, IR_VERBATIM, type, callee, args, def->num_inputs);
    for (uint32_t i = 0; i < def->num_outputs; i++)
        results[i] = function ? ir_build(b->graph, IR_RESULT,
                                         library_type_ir(b->lib, outputs[i].type), i + 1, &call, 1)
                              : call;
}
