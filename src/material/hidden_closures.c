// SPDX-License-Identifier: Apache-2.0
/*
 * Closures that no slab stands for, where values of the document hide them: glass of a shader whose
 * transmission is 0. The deferred pipeline leaves them out. Uniforms that decide about it are
 * compiled in, because another value needs another shader.
 */
#include "material/changed_closures.h"

#include "lower/lower.h"

struct hider {
    struct builder *builder;
    struct ir_graph *graph;
    uint8_t *has_misfit; /* per node: in what is left below it */
    ir_ref *left;        /* per node: what takes its place; 0: nothing */
    struct ir_evaluator values;
    uint8_t *is_decided; /* per node: it decided about something */
    VEC(ir_ref) deciders;
};

/* ---- Values of the document ---- */

static bool source(void *user_data, const struct ir_graph *graph, ir_ref ref, struct ir_value *out)
{
    struct hider *h = user_data;
    const struct ir_node *node = ir_get(graph, ref);
    if (node->op != IR_UNIFORM)
        return false;
    const struct shader_variable *uniform =
        &h->builder->shader->interface.variables.items[node->attr];
    *out = uniform->value;
    return uniform->has_default && out->type == node->type;
}

static uint32_t call(void *user_data, const struct ir_graph *graph, ir_ref ref,
                     const struct ir_value *args, struct ir_value *out)
{
    const struct hider *h = user_data;
    return lang_eval_node(h->builder->shader->unit, graph, ref, args, &(uint32_t){LANG_MAX_STEPS},
                          h->builder->arena, out);
}

static void decide(struct hider *h, ir_ref ref)
{
    if (h->is_decided[ref])
        return;
    h->is_decided[ref] = 1;
    vec_push(h->builder->arena, &h->deciders, ref);
}

/* The uniforms that a value needs are compiled in. */
static void decide_by(struct hider *h, ir_ref root)
{
    struct ir_value value;
    h->deciders.len = 0;
    decide(h, root);
    for (uint32_t i = 0; i < h->deciders.len; i++) {
        ir_ref ref = h->deciders.items[i];
        build_initial(h->builder, ref, &value);
        for (uint32_t k = 0; k < ir_get(h->graph, ref)->num_args; k++)
            decide(h, ir_arg(h->graph, ref, k));
    }
}

/* True if all components have a value, which then is compiled in. */
static bool is_document_value(struct hider *h, ir_ref ref, float wanted)
{
    struct ir_value value;
    if (!ref || !ir_evaluate(&h->values, ref, &value))
        return false;
    for (unsigned i = 0; i < ir_type_info(value.type)->components; i++)
        if (value.w[i].f != wanted)
            return false;
    decide_by(h, ref);
    return true;
}

/* ---- The tree ---- */

static bool is_misfit(const struct hider *h, ir_ref ref)
{
    return ref && h->has_misfit[ref];
}

static ir_ref left_of(const struct hider *h, ir_ref ref)
{
    return ref ? h->left[ref] : 0;
}

/* Another node is all that is left of it. */
static ir_ref hidden(struct hider *h, ir_ref ref, ir_ref left)
{
    h->has_misfit[ref] = is_misfit(h, left);
    return left_of(h, left);
}

static ir_ref shown(struct hider *h, ir_ref ref)
{
    const struct ir_node node = *ir_get(h->graph, ref);
    ir_ref a = node.num_args > 0 ? ir_arg(h->graph, ref, 0) : 0,
           b = node.num_args > 1 ? ir_arg(h->graph, ref, 1) : 0;
    if (node.op == IR_LEAF && is_misfit(h, ref) && is_document_value(h, a, 0.0f))
        return hidden(h, ref, 0);
    if (node.op == IR_CLOSURE_SCALE && is_misfit(h, a) && is_document_value(h, b, 0.0f))
        return hidden(h, ref, 0);
    if (node.op == IR_CLOSURE_MIX) {
        ir_ref share = ir_arg(h->graph, ref, 2);
        if (is_misfit(h, b) && is_document_value(h, share, 0.0f))
            return hidden(h, ref, a);
        if (is_misfit(h, a) && is_document_value(h, share, 1.0f))
            return hidden(h, ref, b);
    }
    return build_over(h->builder, ref, h->left);
}

static bool any_misfit(const struct hider *h, ir_ref ref)
{
    const struct ir_node *node = ir_get(h->graph, ref);
    for (uint32_t i = 0; i < node->num_args; i++) {
        ir_ref arg = ir_arg(h->graph, ref, i);
        if (is_misfit(h, arg) && left_of(h, arg))
            return true;
    }
    return false;
}

static bool is_tree(const struct ir_graph *g, ir_ref ref)
{
    ir_type_id type = ir_type_of(g, ref);
    return type == IR_TYPE_BSDF || ir_type_is_shader(type);
}

ir_ref build_without_hidden(struct builder *b, ir_ref root)
{
    struct hider h = {.builder = b, .graph = b->graph};
    const struct ir_eval_env env = {.user_data = &h, .source = source, .call = call};
    ir_evaluator_init(&h.values, h.graph, &env, b->arena);
    h.is_decided = ARENA_ARRAY(b->arena, uint8_t, root + 1);
    const uint8_t *needed = ir_mark(h.graph, &root, 1, b->arena);
    h.has_misfit = ARENA_ARRAY(b->arena, uint8_t, root + 1);
    h.left = ARENA_ARRAY(b->arena, ir_ref, root + 1);
    for (ir_ref ref = 1; ref <= root; ref++) {
        h.left[ref] = ref;
        if (!needed[ref] || (ref != root && !is_tree(h.graph, ref)))
            continue;
        bool is_leaf = ir_get(h.graph, ref)->op == IR_LEAF;
        h.has_misfit[ref] = is_leaf ? !build_fits_slab(b, ref) : any_misfit(&h, ref);
        ir_push_origin_of(h.graph, ref);
        h.left[ref] = shown(&h, ref);
        ir_pop_origin(h.graph);
    }
    return h.left[root] ? h.left[root] : root;
}
