// SPDX-License-Identifier: Apache-2.0
/* From the arguments of a node to its results, by the implementation for the target. */
#include "dynamic/code.h"
#include "ir/arithmetic.h"
#include "lower/lower.h"

static void call_expressions(struct builder *b, const struct implementation *impl,
                             const ir_ref *args, ir_ref *results)
{
    const struct library *layer = library_of_element(b->lib, impl->element);
    assert(impl->count == library_nodedef(b->lib, impl->nodedef)->num_outputs);
    assert(impl->ref + impl->count <= layer->refs.len);
    for (uint32_t i = 0; i < impl->count; i++)
        lang_lower_call(b->shader->unit, b->graph, &b->host, layer->refs.items[impl->ref + i], args,
                        &results[i]);
}

uint32_t build_leaf_callee(struct builder *b, uint32_t family)
{
    return ir_add_callee(b->graph,
                         (struct ir_callee){.kind = IR_CALLEE_FAMILY,
                                            .index = family,
                                            .name = library_family(b->lib, family)->name});
}

/* True if it is known that a lobe has one roughness. */
static bool is_round(struct builder *b, const struct nodedef *def, const struct port *ports,
                     const ir_ref *args)
{
    for (unsigned i = 0; i < def->num_inputs; i++) {
        if (ports[i].name != STR_roughness || ir_type_of(b->graph, args[i]) != IR_TYPE_VEC2)
            continue;
        ir_ref along = ir_component(b->graph, args[i], 0),
               across = ir_component(b->graph, args[i], 1);
        const union ir_word *known =
            ir_constant_words(b->graph, ir_op2(b->graph, IR_EQ, along, across));
        return known && known->u != 0;
    }
    return false;
}

/* An argument of a lobe. One that is round needs no tangent of its own. */
static ir_ref lobe_argument(struct builder *b, const struct nodedef *def, const struct port *ports,
                            const ir_ref *args, unsigned index)
{
    const struct port *port = &ports[index];
    bool is_idle = port->name == STR_tangent && port->geomprop && is_round(b, def, ports, args);
    return is_idle ? build_default_geomprop(b, port->element, port->type) : args[index];
}

/*
 * Weight first if the definition has one (else 1), then the inputs in order without closures, then
 * the base of a modifier. So equal lobes with different weights differ only in the first operand.
 */
static void build_leaf(struct builder *b, const struct implementation *impl, const ir_ref *args,
                       ir_ref *results)
{
    const struct family *family = library_family(b->lib, impl->ref);
    const struct nodedef *def = library_nodedef(b->lib, impl->nodedef);
    assert(family->nodedef == impl->nodedef);
    const struct port *ports = library_ports(b->lib, impl->nodedef, NULL);
    ir_ref base = 0;
    ir_ref *operands = ARENA_ARRAY(b->arena, ir_ref, def->num_inputs + 2u);
    unsigned n = 1;
    operands[0] = ir_const_float(b->graph, 1.0f);
    for (unsigned i = 0; i < def->num_inputs; i++) {
        if (ir_type_is_closure(build_type(b, ports[i].type)))
            base = args[i];
        else if (ports[i].name == STR_weight)
            operands[0] = args[i];
        else
            operands[n++] = lobe_argument(b, def, ports, args, i);
    }
    if (family->functions[FAMILY_FACTOR] != LANG_NONE) {
        if (!base) {
            results[0] = 0;
            return;
        }
        operands[n++] = base;
    }
    uint32_t callee = build_leaf_callee(b, impl->ref);
    ir_type_id type = build_type(b, ports[def->num_inputs].type);
    if (type == IR_TYPE_BSDF)
        operands[0] = ir_share(b->graph, operands[0]);
    bool is_absent = ir_const_is(b->graph, operands[0], 0.0f) && !b->options->keeps_absent;
    results[0] = is_absent ? 0 : ir_build(b->graph, IR_LEAF, type, callee, operands, n);
}

const struct family *build_leaf_family(struct builder *b, uint32_t callee)
{
    assert(b->graph->callees.items[callee].kind == IR_CALLEE_FAMILY);
    return library_family(b->lib, b->graph->callees.items[callee].index);
}

const char *build_leaf_input(struct builder *b, uint32_t callee, unsigned index)
{
    uint32_t nodedef = build_leaf_family(b, callee)->nodedef;
    const struct port *ports = library_ports(b->lib, nodedef, NULL);
    for (unsigned i = 0; i < library_nodedef(b->lib, nodedef)->num_inputs; i++) {
        bool is_operand =
            ports[i].name != STR_weight && !ir_type_is_closure(build_type(b, ports[i].type));
        if (is_operand && index-- == 0)
            return build_text(b, ports[i].name);
    }
    return NULL;
}

/*
 * A light function needs the shaded point, which only the light loop has. Outside it, such a node
 * is a light without emission.
 */
static ir_ref dark_light(struct builder *b)
{
    ir_ref args[3] = {0, ir_const_float(b->graph, 1.0f), ir_const_float(b->graph, 0.0f)};
    return ir_build(b->graph, IR_LIGHT_SHADER, IR_TYPE_LIGHT, 0, args, 3);
}

/* The node whose function is called; of a leaf's functions, the node that new nodes come from. */
static elem_id caller(const struct builder *b)
{
    const struct ir_origin *origins = b->graph->origins.items;
    uint32_t origin = b->graph->origin;
    while (origin && !origins[origin].element)
        origin = origins[origin].parent;
    elem_id leaf = origin ? origins[origin].element : build_doc(b)->root;
    return b->called ? b->called : leaf;
}

void build_report_large(void *user_data)
{
    struct builder *b = user_data;
    diag_add(b->diags, DIAG_ID_lang_limit, doc_place(build_doc(b), caller(b)),
             "the arguments and results of the function have more than 128 numbers and vectors");
}

void build_report_index(void *user_data, int32_t index, uint32_t length)
{
    struct builder *b = user_data;
    const struct document *doc = build_doc(b);
    elem_id input = b->called ? doc_child_of_kind(doc, b->called, KIND_INPUT, STR_index) : 0;
    if (b->called) /* else the function is one of a closure or of the interface */
        diag_add(b->diags, DIAG_ID_index_out_of_range,
                 input ? doc_attr_place(doc, input, STR_value) : doc_place(doc, b->called), index,
                 length, length - 1);
}

/* False after a report. */
static void call(struct builder *b, const struct frame *of_node, ir_ref *results)
{
    struct frame own = *of_node, *frame = &own;
    const struct implementation *impl = frame->impl;
    const struct nodedef *def = library_nodedef(b->lib, impl->nodedef);
    ir_type_id type =
        build_type(b, library_ports(b->lib, impl->nodedef, NULL)[def->num_inputs].type);
    bool is_usable = impl->kind != IMPL_VERBATIM || build_is_light_source(b, impl);
    if (type == IR_TYPE_LIGHT && is_usable) {
        results[0] = dark_light(b);
        return;
    }
    uint32_t first_node = b->graph->nodes.len;
    b->called = frame->node.element;
    frame->args = build_source_arguments(b, of_node);
    bool has_tiles = build_note_textures(b, frame);
    assert(frame->node.nodedef == impl->nodedef);
    if (impl->kind == IMPL_EXPRESSION)
        call_expressions(b, impl, frame->args, results);
    else if (impl->kind == IMPL_FUNCTION)
        lang_lower_call(b->shader->unit, b->graph, &b->host, impl->ref,
                        build_function_arguments(b, frame), results);
    else
        build_verbatim(b, frame, results);
    if (has_tiles)
        build_check_tiles(b, frame, first_node);
    b->called = 0;
}

/*
 * Reports source that mxgen's own code for an operator replaces. Source beside the definition, as
 * in MaterialX's libraries, says the same as this code; source of a later library wants something
 * else.
 */
static void report_operator(struct builder *b, const struct implementation *impl,
                            const struct nodedef *def)
{
    const struct document *layer = &b->lib->doc;
    struct diag_place place = doc_place(layer, impl->element);
    while (impl->element < layer->first_element)
        layer = layer->base;
    if (def->element < layer->first_element)
        diag_add(b->diags, DIAG_ID_ignored_operator, place, build_text(b, impl->name),
                 build_text(b, def->node));
    else
        diag_add(b->diags, DIAG_ID_builtin_operator, place, build_text(b, def->node),
                 build_text(b, impl->name));
}

static void build_by_implementation(struct builder *b, const struct frame *frame, ir_ref *results)
{
    const struct implementation *impl = frame->impl;
    const struct nodedef *def = library_nodedef(b->lib, frame->node.nodedef);
    const struct port *ports = library_ports(b->lib, frame->node.nodedef, NULL);
    switch ((enum impl_kind)impl->kind) {
    case IMPL_VERBATIM:
        if (build_is_combined(b, frame)) {
            report_operator(b, impl, def);
            build_dynamic(b, frame, results);
        } else {
            call(b, frame, results);
        }
        return;
    case IMPL_EXPRESSION:
    case IMPL_FUNCTION: call(b, frame, results); return;
    case IMPL_FAMILY: build_leaf(b, impl, frame->args, results); return;
    case IMPL_DYNAMIC: build_dynamic(b, frame, results); return;
    case IMPL_CODE: code_build(b, frame, results); return;
    case IMPL_GRAPH:
    case IMPL_FOREIGN:
    case IMPL_BROKEN: break;
    }
    for (uint32_t i = 0; i < def->num_outputs; i++)
        results[i] = ir_poison(b->graph, build_type(b, ports[def->num_inputs + i].type));
}

void build_node(struct builder *b, const struct frame *frame, ir_ref *results)
{
    build_by_implementation(b, frame, results);
    if (b->recorder)
        build_record_node(b, frame, results);
}
