// SPDX-License-Identifier: Apache-2.0
/*
 * The last pass over the graph, when all remaining calls are known. Each portable function gets the
 * version that its calls share (specialise/plan.c). The pass builds the graph again with calls of
 * these versions, without the arguments that a version lacks. A version that shrank to a constant
 * is the constant, and the nodes above it fold. If the target has typed textures, a read of a
 * texture gets the type of its use.
 */
#include "shader/shader.h"
#include "specialise/specialise.h"
#include "tree/ast.h"

#include <assert.h>

struct final_pass {
    struct shader *shader;
    const uint32_t *planned; /* by call: the result of lang_plan_call */
    bool typed_textures;
    VEC(ir_ref) constants; /* that calls became, and what folds with them */
};

/* Visits the value of each effect of all stages. */
static void for_each_root(struct shader *shader, void (*visit)(void *user_data, ir_ref *root),
                          void *user_data)
{
    for (unsigned stage = 0; stage < NUM_STAGES; stage++) {
        const struct effect_list *effects = &shader->stages[stage].effects;
        for (uint32_t i = 0; i < effects->len; i++)
            visit(user_data, &effects->items[i].value);
    }
}

struct ref_list { /* a vector */
    struct arena *arena;
    ir_ref *items;
    uint32_t len, cap;
};

static void add_root(void *user_data, ir_ref *root)
{
    struct ref_list *roots = user_data;
    vec_push(roots->arena, roots, *root);
}

static void move_root(void *user_data, ir_ref *root)
{
    const ir_ref *copies = user_data;
    assert(!*root == !copies[*root]);
    *root = copies[*root];
}

/* `in` and `inout` parameters have an operand each, in order. */
static bool has_operand(const struct lang_unit *layer, const struct lang_function *fn,
                        uint32_t param)
{
    return layer->slots.items[fn->first_slot + param].mode != LANG_OUT;
}

/* Returns the call's number for lang_plan_version. */
static uint32_t plan_call(struct shader *shader, ir_ref call)
{
    const struct ir_graph *graph = shader->graph;
    const struct lang_unit *layer;
    uint32_t id = shader_callee(shader, call);
    const struct lang_function *fn = lang_function(shader->unit, id, &layer);
    const union ir_word **known = ARENA_ARRAY(shader->arena, const union ir_word *, fn->num_params);
    const ir_ref *args = ir_args(graph, call);
    for (uint32_t i = 0; i < fn->num_params; i++)
        if (has_operand(layer, fn, i))
            known[i] = ir_constant_words(graph, *args++);
    assert(args == ir_args(graph, call) + ir_get(graph, call)->num_args);
    return lang_plan_call(shader->unit, id, known);
}

static const uint32_t *plan_calls(struct shader *shader, const uint8_t *needed)
{
    const struct ir_graph *graph = shader->graph;
    uint32_t *planned = ARENA_ARRAY(shader->arena, uint32_t, graph->nodes.len), num_calls = 0;
    for (ir_ref ref = 1; ref < graph->nodes.len; ref++)
        if (needed[ref] && ir_get(graph, ref)->op == IR_CALL) {
            planned[ref] = plan_call(shader, ref);
            num_calls++;
        }
    if (num_calls)
        lang_plan_finish(shader->unit);
    return planned;
}

/* The constant that a version without parameters returns; 0: another version. */
static ir_ref constant_result(struct ir_graph *graph, const struct lang_unit *unit,
                              uint32_t version)
{
    const struct lang_unit *layer;
    const struct lang_function *fn = lang_function(unit, version, &layer);
    lang_ref returned = fn->num_params ? 0 : ast_returned(layer, fn);
    const struct lang_node *value = returned ? ast_node(layer, returned) : NULL;
    if (!value || value->kind != LANG_CONST)
        return 0;
    struct ir_value constant = ast_value(value->type, ast_words(layer, value));
    return ir_const(graph, &constant);
}

static ir_ref build_call(struct final_pass *pass, struct ir_graph *graph, ir_ref old,
                         const struct ir_node *node, ir_ref *args)
{
    const struct lang_unit *unit = pass->shader->unit, *layer;
    struct ir_callee callee = graph->callees.items[node->attr];
    uint32_t given = callee.index, version = lang_plan_version(unit, pass->planned[old]), read = 0,
             kept = 0;
    const struct lang_function *fn = lang_function(unit, given, &layer);
    ir_ref constant = constant_result(graph, unit, version);
    if (constant) {
        vec_push(pass->shader->arena, &pass->constants, constant);
        return constant;
    }
    for (uint32_t i = 0; i < fn->num_params; i++) {
        if (!has_operand(layer, fn, i))
            continue;
        ir_ref arg = args[read++];
        if (!lang_param_dropped(unit, version, given, i))
            args[kept++] = arg;
    }
    assert(read == node->num_args);
    assert(version == given || kept <= lang_function(unit, version, NULL)->num_params);
    uint16_t flags = lang_function(unit, version, NULL)->flags;
    callee.index = version;
    callee.derivative = (flags & LANG_FN_DERIVATIVE) != 0;
    callee.pure = (flags & LANG_FN_PURE) != 0;
    return ir_build(graph, IR_CALL, node->type, ir_add_callee(graph, callee), args, kept);
}

/* True for x or xyz of a texture's value. */
static bool is_first_part(const struct ir_node *swizzle)
{
    return swizzle->attr == 0x100 || swizzle->attr == (0x300 | 0x24);
}

static bool may_fold(const struct final_pass *pass, const ir_ref *args, uint32_t num_args)
{
    for (uint32_t i = 0; i < pass->constants.len; i++)
        for (uint32_t k = 0; k < num_args; k++)
            if (args[k] == pass->constants.items[i])
                return true;
    return false;
}

static ir_ref build_folded(struct final_pass *pass, struct ir_graph *graph,
                           const struct ir_node *node, const ir_ref *args)
{
    ir_ref ref =
        ir_build(graph, (enum ir_op)node->op, node->type, node->attr, args, node->num_args);
    if (ir_get(graph, ref)->op == IR_CONST)
        vec_push(pass->shader->arena, &pass->constants, ref);
    return ref;
}

static ir_ref build_node(void *user_data, struct ir_graph *graph, ir_ref old,
                         const struct ir_node *node, ir_ref *args)
{
    struct final_pass *pass = user_data;
    if (node->op == IR_CALL)
        return build_call(pass, graph, old, node, args);
    if (node->op == IR_SWIZZLE && pass->typed_textures && is_first_part(node)
        && ir_get(graph, *args)->op == IR_TEX)
        return ir_build(graph, IR_TEX, node->type, 0, ir_args(graph, *args), 2);
    if (may_fold(pass, args, node->num_args))
        return build_folded(pass, graph, node, args);
    return 0;
}

void shader_specialise_calls(struct shader *shader, bool typed_textures)
{
    struct ref_list roots = {.arena = shader->arena};
    for_each_root(shader, add_root, &roots);
    const uint8_t *needed = ir_mark(shader->graph, roots.items, roots.len, shader->arena);
    struct final_pass final = {
        .shader = shader, .planned = plan_calls(shader, needed), .typed_textures = typed_textures};
    const struct ir_pass pass = {.user_data = &final, .build = build_node};
    const ir_ref *copies = ir_rebuild(shader->graph, needed, &pass, shader->arena);
    for_each_root(shader, move_root, (void *)(uintptr_t)copies);
}
