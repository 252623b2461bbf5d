// SPDX-License-Identifier: Apache-2.0
/*
 * Calls of a leaf's functions. Arguments: the node's inputs in order, then the values of the shaded
 * point that the function takes.
 */
#include "closure/closure_priv.h"

#include "ir/arithmetic.h"
#include "lower/lower.h"
#include "shader/formula.h"

#include <assert.h>

static ir_ref stream(struct shader *shader, str_id name)
{
    return shader_stream(shader, name, IR_TYPE_VEC3);
}

static ir_ref normal(struct shader *shader)
{
    return ir_op1(shader->graph, IR_NORMALIZE, stream(shader, STR_normalWorld));
}

static ir_ref view(struct shader *shader)
{
    if (shader->role->derivatives == DERIVATIVES_OF_RAYS)
        return stream(shader, STR_viewWorld);
    ir_ref viewer =
        shader_read(shader, shader_private_uniform(shader, STR_u_viewPosition, IR_TYPE_VEC3, 0));
    return ir_op1(shader->graph, IR_NORMALIZE,
                  ir_op2(shader->graph, IR_SUB, viewer, stream(shader, STR_positionWorld)));
}

static ir_ref position(struct shader *shader)
{
    return stream(shader, STR_positionWorld);
}

static ir_ref made_once(struct shader *shader, ir_ref *place, str_id name,
                        ir_ref make(struct shader *))
{
    if (!*place) {
        ir_push_name(shader->graph, name);
        *place = make(shader);
        ir_pop_origin(shader->graph);
    }
    return *place;
}

static ir_ref context_value(struct shader *shader, struct closure_point *point, str_id name,
                            const ir_ref *light)
{
    switch (name) {
    case STR_V: return made_once(shader, &point->view, name, view);
    case STR_N: return made_once(shader, &point->normal, name, normal);
    case STR_xi: return shader_stream(shader, STR_random, IR_TYPE_VEC3);
    case STR_P: return made_once(shader, &point->position, name, position);
    case STR_sample_index:
        return ir_build(shader->graph, IR_SAMPLE, IR_TYPE_INT, IR_SAMPLE_INDEX, NULL, 0);
    case STR_sample_turn:
        return ir_build(shader->graph, IR_SAMPLE, IR_TYPE_VEC2, IR_SAMPLE_TURN, NULL, 0);
    default: return name == STR_L && light ? *light : ir_poison(shader->graph, IR_TYPE_VEC3);
    }
}

ir_ref closure_view(struct shader *shader, const struct closure_host *host)
{
    return context_value(shader, host->point, STR_V, NULL);
}

ir_ref closure_normal(struct shader *shader, const struct closure_host *host)
{
    return context_value(shader, host->point, STR_N, NULL);
}

ir_ref closure_position(struct shader *shader, const struct closure_host *host)
{
    return context_value(shader, host->point, STR_P, NULL);
}

/*
 * A leaf function calls other functions. Inlined, its parts that depend only on the view are
 * computed once and shared with the leaf's other functions.
 */
enum { MAX_LEAF_NODES = 50 };

bool closure_has(const struct shader *shader, const struct closure_host *host, ir_ref leaf,
                 enum leaf_function which)
{
    const struct ir_node *node = ir_get(shader->graph, leaf);
    const struct source_leaf *source = closure_source(shader, leaf);
    assert(node->op == IR_LEAF && which < NUM_LEAF_FUNCTIONS);
    return source ? closure_source_has(source, node->type, which)
                  : host->leaf_functions(host->user_data, node->attr)[which] != LANG_NONE;
}

bool closure_call_all(struct shader *shader, const struct closure_host *host, ir_ref leaf,
                      enum leaf_function which, const ir_ref *light, ir_ref *results)
{
    struct ir_graph *g = shader->graph;
    const struct ir_node node = *ir_get(g, leaf);
    assert(node.op == IR_LEAF && which < NUM_LEAF_FUNCTIONS);
    const uint32_t *functions = host->leaf_functions(host->user_data, node.attr);
    uint32_t id = functions[which];
    if (id == LANG_NONE)
        return false;
    const struct lang_unit *unit;
    const struct lang_function *fn = lang_function(shader->unit, id, &unit);
    /* Operands: the weight, the inputs, and a modifier's base. */
    unsigned num_inputs = node.num_args - 1 - (functions[LEAF_FACTOR] != LANG_NONE);
    assert(num_inputs < node.num_args);
    ir_ref *args = ARENA_ARRAY(shader->arena, ir_ref, fn->num_params);
    for (unsigned i = 0; i < fn->num_params; i++) {
        const struct lang_slot *slot = &unit->slots.items[fn->first_slot + i];
        args[i] = i < num_inputs ? ir_arg(g, leaf, i + 1)
                                 : context_value(shader, host->point, slot->name, light);
    }
    ir_push_origin(g, node.origin);
    struct lang_host see_through = *host->lang;
    see_through.max_outer_nodes = MAX_LEAF_NODES;
    lang_lower_call(shader->unit, g, &see_through, id, args, results);
    ir_pop_origin(g);
    return true;
}

ir_ref closure_call(struct shader *shader, const struct closure_host *host, ir_ref leaf,
                    enum leaf_function which, const ir_ref *light)
{
    assert(which != LEAF_SAMPLE);
    if (closure_source(shader, leaf))
        return closure_call_source(shader, host, leaf, which, light);
    ir_ref result[1];
    return closure_call_all(shader, host, leaf, which, light, result) ? result[0] : 0;
}

/* True for a medium that scatters light, or may. */
static bool may_scatter(struct shader *shader, const struct closure_host *host, ir_ref leaf)
{
    ir_ref albedo = closure_call(shader, host, leaf, LEAF_ALBEDO, NULL);
    return albedo && !ir_const_is(shader->graph, albedo, 0.0f);
}

/* Returns what a leaf lets through with the weight 1; 0: nothing. */
static ir_ref unit_throughput(struct shader *shader, const struct closure_host *host, ir_ref leaf,
                              ir_ref *out_decay)
{
    struct ir_graph *g = shader->graph;
    ir_ref through = closure_call(shader, host, leaf, LEAF_THROUGHPUT, NULL);
    ir_ref decay = through ? closure_call(shader, host, leaf, LEAF_TRANSMITTANCE, NULL) : 0;
    if (!decay || ir_const_is(g, decay, 1.0f) || ir_const_is(g, through, 0.0f))
        return through;
    if (host->spreads && may_scatter(shader, host, leaf)) {
        ir_ref way = ir_const_float(g, CLOSURE_MEAN_WAY);
        return FORMULA(shader, "mx_decayed", through, decay, way);
    }
    *out_decay = decay;
    for (unsigned i = 0; i < host->way; i++)
        through = ir_mul(g, through, decay);
    return through;
}

ir_ref closure_leaf_throughput(struct shader *shader, const struct closure_host *host, ir_ref leaf,
                               ir_ref *out_decay)
{
    struct ir_graph *g = shader->graph;
    assert(ir_get(g, leaf)->op == IR_LEAF && host->way <= 2);
    *out_decay = 0;
    if (ir_type_of(g, leaf) == IR_TYPE_VDF) /* a volume fills the space and is no surface */
        return ir_white(g);
    ir_ref through = unit_throughput(shader, host, leaf, out_decay);
    ir_ref weight = ir_arg(g, leaf, 0);
    if (!through && host->occludes)
        return ir_black(g);
    if (!through) /* opaque: its weight is a coverage */
        return ir_one_minus(g, ir_convert(g, IR_TYPE_VEC3, weight));
    if (ir_const_is(g, weight, 1.0f))
        return through;
    if (*out_decay)
        *out_decay = CLOSURE_MIXED;
    return FORMULA(shader, "mx_weighted_throughput", through, weight);
}

void closure_name(struct shader *shader, ir_ref value, ir_ref closure, const char *role)
{
    str_id owner = shader->graph->origins.items[ir_get(shader->graph, closure)->origin].name;
    if (!owner || !value)
        return;
    struct text text;
    text_init(&text, shader->arena);
    text_mem(&text, str_text(shader->strings, owner), str_len(shader->strings, owner));
    text_char(&text, '_');
    text_str(&text, role);
    str_id name = str_intern(shader->strings, text.data, text.len);
    ir_suggest_name(shader->graph, value, name, IR_NAME_ROLE);
}
