// SPDX-License-Identifier: Apache-2.0
/*
 * Lowers calls to IR. A call becomes, in this order of preference: a constant, the nodes of the
 * callee's body, a CALL.
 */
#include "lower/lower_priv.h"
#include "tree/interpret.h"

#include <assert.h>

unsigned lang_num_results(const struct lang_unit *unit, uint32_t id)
{
    const struct lang_function *fn = lang_function(unit, id, NULL);
    unsigned count = fn->return_type != IR_TYPE_VOID;
    for (uint32_t i = 0; i < fn->num_params; i++)
        count += ast_param_mode(unit, id, i) != LANG_IN;
    return count;
}

/* ---- Structs and arrays: leaves to and from single nodes ---- */

ir_type_id lang_graph_type(const struct lang_unit *unit, struct ir_graph *graph, ir_type_id type)
{
    if (!ast_is_user_type(type))
        return type;
    const struct lang_unit *layer;
    const struct ir_user_type *user = lang_user_type(unit, type, &layer);
    if (user->array_length)
        return (ir_type_id)ir_add_array(graph, lang_graph_type(unit, graph, user->element),
                                        user->array_length);
    struct ir_member *members = ARENA_ARRAY(graph->arena, struct ir_member, user->num_members);
    for (uint32_t i = 0; i < user->num_members; i++) {
        members[i] = layer->members.items[user->first_member + i];
        members[i].type = lang_graph_type(unit, graph, members[i].type);
    }
    return (ir_type_id)ir_add_struct(graph, user->name, members, user->num_members);
}

static ir_type_id graph_type(struct lower *lo, ir_type_id type)
{
    return lang_graph_type(lo->unit, lo->graph, type);
}

static ir_type_id part_type(const struct lower *lo, ir_type_id type, uint32_t index,
                            uint32_t *out_count)
{
    const struct lang_unit *layer;
    const struct ir_user_type *user = lang_user_type(lo->unit, type, &layer);
    assert(user->array_length || index < user->num_members);
    *out_count = user->array_length ? user->array_length : user->num_members;
    return user->array_length ? user->element
                              : layer->members.items[user->first_member + index].type;
}

static const ir_ref *join(struct lower *lo, ir_type_id type, const ir_ref *leaves, ir_ref *out);

static const ir_ref *join_user_type(struct lower *lo, ir_type_id type, const ir_ref *leaves,
                                    ir_ref *out)
{
    uint32_t count;
    part_type(lo, type, 0, &count);
    ir_ref *parts = ARENA_ARRAY(lo->graph->arena, ir_ref, count);
    for (uint32_t i = 0; i < count; i++) {
        ir_type_id part = part_type(lo, type, i, &count);
        leaves = join(lo, part, leaves, &parts[i]);
        parts[i] = lower_defined(lo, parts[i], graph_type(lo, part));
    }
    *out = ir_construct(lo->graph, graph_type(lo, type), parts, count);
    return leaves;
}

static ir_ref *split_user_type(struct lower *lo, ir_type_id type, ir_ref node, ir_ref *leaves)
{
    uint32_t count;
    part_type(lo, type, 0, &count);
    bool is_array = lang_user_type(lo->unit, type, NULL)->array_length;
    for (uint32_t i = 0; i < count; i++) {
        ir_type_id part = part_type(lo, type, i, &count);
        ir_ref args[2] = {node, is_array ? ir_const_int(lo->graph, (int32_t)i) : 0};
        enum ir_op op = is_array ? IR_INDEX : IR_MEMBER;
        ir_ref value = node ? ir_build(lo->graph, op, graph_type(lo, part), is_array ? 0 : i, args,
                                       is_array ? 2 : 1)
                            : 0;
        leaves = lower_split(lo, part, value, leaves);
    }
    return leaves;
}

static inline const ir_ref *join(struct lower *lo, ir_type_id type, const ir_ref *leaves,
                                 ir_ref *out)
{
    if (ast_is_user_type(type))
        return join_user_type(lo, type, leaves, out);
    *out = *leaves;
    return leaves + 1;
}

ir_ref *lower_split(struct lower *lo, ir_type_id type, ir_ref node, ir_ref *leaves)
{
    if (ast_is_user_type(type))
        return split_user_type(lo, type, node, leaves);
    *leaves = node;
    return leaves + 1;
}

/* A constant */

static bool evaluate(struct lower *lo, uint32_t id, const ir_ref *in, ir_ref *out)
{
    const struct lang_unit *layer;
    const struct lang_function *fn = lang_function(lo->unit, id, &layer);
    if (!(fn->flags & LANG_FN_PURE) || fn->num_params > AST_MAX_OPERANDS * 2)
        return false;
    uint32_t num_in = 0, num_out = fn->return_type != IR_TYPE_VOID;
    for (uint32_t i = 0; i < fn->num_params; i++) {
        const struct lang_slot *slot = ast_slot(layer, fn, i);
        num_out += slot->mode != LANG_IN;
        if (slot->mode == LANG_OUT)
            continue;
        if (ast_is_user_type(slot->type) || !in[num_in] || !ir_is_const(lo->graph, in[num_in]))
            return false;
        num_in++;
    }
    assert(num_in <= fn->num_params && num_out <= fn->num_params + 1u);
    struct ir_value args[AST_MAX_OPERANDS * 2], results[AST_MAX_OPERANDS * 2 + 1];
    for (uint32_t i = 0; i < num_in; i++)
        if (!ir_get_const(lo->graph, in[i], &args[i]))
            return false;
    if (!lang_eval_constant(lo->unit, id, args, results, lo->graph->arena))
        return false;
    for (uint32_t i = 0; i < num_out; i++)
        out[i] = ir_const(lo->graph, &results[i]);
    return true;
}

/* The callee's body */

static void find_offsets(struct lower *lo, struct lower_frame *frame)
{
    uint32_t num_slots = frame->fn->num_slots;
    const struct lang_slot *slots = frame->layer->slots.items + frame->fn->first_slot;
    uint32_t *offsets = ARENA_ARRAY(lo->graph->arena, uint32_t, num_slots + 1);
    for (uint32_t i = 0; i < num_slots; i++)
        offsets[i + 1] = offsets[i] + lower_leaves(lo, slots[i].type);
    frame->offsets = offsets;
}

void lower_name(struct lower *lo, ir_type_id type, ir_ref first_leaf, str_id name,
                enum ir_name_rank rank)
{
    ir_ref value = first_leaf;
    if (value && ast_is_user_type(type)) {
        const struct ir_node *part = ir_get(lo->graph, value);
        value = part->op == IR_MEMBER || part->op == IR_INDEX ? ir_arg(lo->graph, value, 0) : 0;
    }
    unsigned depth = lo->depth < IR_NAME_MAX_DEPTH ? lo->depth : IR_NAME_MAX_DEPTH;
    if (value)
        ir_suggest_name(lo->graph, value, name, rank - depth);
}

void lower_name_slot(struct lower *lo, uint32_t slot, enum ir_name_rank rank)
{
    const struct lower_frame *frame = lo->frame;
    assert(slot < frame->fn->num_slots);
    const struct lang_slot *named = &frame->layer->slots.items[frame->fn->first_slot + slot];
    lower_name(lo, named->type, frame->leaves[frame->offsets[slot]], named->name, rank);
}

/* Parameters a, b and c are only counted, which says nothing about an argument. */
static bool says_something(str_id name)
{
    return name != STR_a && name != STR_b && name != STR_c;
}

static void name_parameters(struct lower *lo)
{
    const struct lower_frame *frame = lo->frame;
    for (uint32_t i = 0; i < frame->fn->num_params; i++)
        if (says_something(frame->layer->slots.items[frame->fn->first_slot + i].name))
            lower_name_slot(lo, i, IR_NAME_PARAMETER);
}

static void open_frame(struct lower *lo, struct lower_frame *frame, const ir_ref *in)
{
    find_offsets(lo, frame);
    const uint32_t *offsets = frame->offsets;
    const struct lang_slot *slots = frame->layer->slots.items + frame->fn->first_slot;
    frame->num_leaves = offsets[frame->fn->num_slots] + lower_leaves(lo, frame->fn->return_type);
    assert(offsets[frame->fn->num_params] <= offsets[frame->fn->num_slots]);
    frame->leaves = ARENA_ARRAY(lo->graph->arena, ir_ref, frame->num_leaves);
    for (uint32_t i = 0, k = 0; i < frame->fn->num_params; i++)
        for (; k < offsets[i + 1]; k++)
            frame->leaves[k] = slots[i].mode == LANG_OUT ? 0 : *in++;
}

static void collect_results(const struct lower_frame *frame, ir_ref *out)
{
    const struct lang_slot *slots = frame->layer->slots.items + frame->fn->first_slot;
    for (uint32_t k = frame->offsets[frame->fn->num_slots]; k < frame->num_leaves; k++)
        *out++ = frame->leaves[k];
    for (uint32_t i = 0; i < frame->fn->num_params; i++)
        for (uint32_t k = frame->offsets[i]; slots[i].mode != LANG_IN && k < frame->offsets[i + 1];
             k++)
            *out++ = frame->leaves[k];
}

enum constant_kind { NO_CONSTANT, CONSTANT_NUMBER, CONSTANT_CHOICE };

/*
 * The kind of constant in the arguments of a call. Constant strings, flags and options choose code.
 */
static enum constant_kind constant_kind(const struct lower *lo, const struct lang_unit *layer,
                                        const struct lang_function *fn, const ir_ref *in)
{
    enum constant_kind kind = NO_CONSTANT;
    for (uint32_t i = 0; i < fn->num_globals; i++)
        if (lang_global(lo->unit, ast_globals(layer, fn)[i], NULL)->kind == LANG_GLOBAL_OPTION)
            return CONSTANT_CHOICE;
    for (uint32_t i = 0; i < fn->num_params; i++) {
        const struct lang_slot *slot = ast_slot(layer, fn, i);
        uint32_t count = slot->mode == LANG_OUT ? 0 : lower_leaves(lo, slot->type);
        for (uint32_t k = 0; k < count; k++) {
            if (!in[k] || !ir_is_const(lo->graph, in[k]))
                continue;
            if (slot->type == IR_TYPE_BOOL || slot->type == IR_TYPE_STRING)
                return CONSTANT_CHOICE;
            kind = CONSTANT_NUMBER;
        }
        in += count;
    }
    return kind;
}

static bool has_special_texture(const struct lower *lo, const struct lang_unit *layer,
                                const struct lang_function *fn, const ir_ref *in)
{
    for (uint32_t i = 0; i < fn->num_params; i++) {
        const struct lang_slot *slot = ast_slot(layer, fn, i);
        if (slot->type == IR_TYPE_SAMPLER && *in && ir_type_of(lo->graph, *in) != IR_TYPE_SAMPLER)
            return true;
        in += slot->mode == LANG_OUT ? 0 : lower_leaves(lo, slot->type);
    }
    return false;
}

/*
 * True if the body of a function can replace its call. Small functions always do. Larger ones get a
 * trial, because constant arguments may shrink them: with a constant choice, until the trial has
 * run as many tree nodes as a small function has; with a constant number, until it has added too
 * many nodes to the graph.
 */
static bool is_worth_trying(struct lower *lo, const struct lang_unit *layer,
                            const struct lang_function *fn, const ir_ref *in, uint32_t *out_budget)
{
    bool is_outer = lo->depth < LOWER_OUTER_DEPTH;
    uint32_t limit = is_outer && lo->host->max_outer_nodes ? lo->host->max_outer_nodes
                                                           : lo->host->max_inline_nodes;
    if (limit < LANG_TINY)
        limit = LANG_TINY;
    *out_budget = UINT32_MAX;
    if (fn->num_nodes <= limit)
        return true;
    if (has_special_texture(lo, layer, fn, in)
        || (lo->host->inlines_derivatives && (fn->flags & LANG_FN_DERIVATIVE))) {
        lo->max_graph_nodes = UINT32_MAX;
        return true;
    }
    enum constant_kind kind = constant_kind(lo, layer, fn, in);
    if (kind == CONSTANT_CHOICE)
        *out_budget = 2 * limit;
    else if (kind == CONSTANT_NUMBER && is_outer && fn->num_nodes <= LOWER_MAX_TRIED
             && lo->max_graph_nodes == UINT32_MAX)
        lo->max_graph_nodes = lo->graph->nodes.len + LOWER_TRIED_NODES;
    return kind == CONSTANT_CHOICE
           || (kind == CONSTANT_NUMBER && is_outer && fn->num_nodes <= LOWER_MAX_TRIED);
}

/*
 * False if the body cannot become nodes; the nodes that it has made by then stay unused.
 */
static bool lower_inline(struct lower *lo, uint32_t id, const ir_ref *in, ir_ref *out)
{
    struct lower_frame frame = {0}, *caller = lo->frame;
    frame.fn = lang_function(lo->unit, id, &frame.layer);
    uint32_t max_graph_nodes = lo->max_graph_nodes;
    if (lo->depth == LOWER_MAX_DEPTH || !frame.fn->body
        || !is_worth_trying(lo, frame.layer, frame.fn, in, &frame.budget))
        return false;
    open_frame(lo, &frame, in);
    lo->frame = &frame;
    bool is_trial = frame.budget != UINT32_MAX; /* one that fails names nothing */
    if (!is_trial)
        name_parameters(lo);
    lo->depth++;
    lower_statements(lo, lower_node(lo, frame.fn->body)->a);
    lo->depth--;
    assert(lo->frame == &frame && frame.nesting == 0);
    if (is_trial && !lo->failed)
        name_parameters(lo);
    lo->frame = caller;
    bool done = !lo->failed;
    if (done) {
        collect_results(&frame, out);
        if (frame.fn->return_type != IR_TYPE_VOID && frame.fn->name)
            lower_name(lo, frame.fn->return_type, out[0], frame.fn->name, IR_NAME_FUNCTION);
    }
    lo->failed = false;
    lo->max_graph_nodes = max_graph_nodes;
    return done;
}

/* A CALL */

/* The operands of a CALL: one node per in and inout parameter; false if one has no value. */
static bool join_arguments(struct lower *lo, uint32_t id, const ir_ref *in, ir_ref *args,
                           uint32_t *out_count)
{
    const struct lang_unit *layer;
    const struct lang_function *fn = lang_function(lo->unit, id, &layer);
    *out_count = 0;
    for (uint32_t i = 0; i < fn->num_params; i++) {
        const struct lang_slot *slot = ast_slot(layer, fn, i);
        if (slot->mode == LANG_OUT)
            continue;
        in = join(lo, slot->type, in, &args[*out_count]);
        if (!args[(*out_count)++])
            return false;
    }
    assert(*out_count <= fn->num_params);
    return true;
}

static ir_ref *poison(struct lower *lo, ir_type_id type, ir_ref *out)
{
    return lower_split(lo, type, ir_poison(lo->graph, graph_type(lo, type)), out);
}

static void poison_results(struct lower *lo, uint32_t id, ir_ref *out)
{
    const struct lang_unit *layer;
    const struct lang_function *fn = lang_function(lo->unit, id, &layer);
    if (fn->return_type != IR_TYPE_VOID)
        out = poison(lo, fn->return_type, out);
    for (uint32_t i = 0; i < fn->num_params; i++)
        if (ast_slot(layer, fn, i)->mode != LANG_IN)
            out = poison(lo, ast_slot(layer, fn, i)->type, out);
}

/* The callee index in the graph of a function. */
static uint32_t callee(struct lower *lo, uint32_t id)
{
    const struct lang_function *fn = lang_function(lo->unit, id, NULL);
    return ir_add_callee(lo->graph,
                         (struct ir_callee){.kind = IR_CALLEE_FUNCTION,
                                            .index = id,
                                            .name = fn->name,
                                            .derivative = (fn->flags & LANG_FN_DERIVATIVE) != 0,
                                            .pure = (fn->flags & LANG_FN_PURE) != 0});
}

static void build_call(struct lower *lo, uint32_t id, const ir_ref *in, ir_ref *out)
{
    ir_ref args[LOWER_MAX_LEAVES];
    uint32_t num_args;
    lo->num_calls++;
    if (!join_arguments(lo, id, in, args, &num_args)) {
        poison_results(lo, id, out);
        return;
    }
    const struct lang_unit *layer;
    const struct lang_function *fn = lang_function(lo->unit, id, &layer);
    ir_type_id type = graph_type(lo, fn->return_type);
    ir_ref call = ir_build(lo->graph, IR_CALL, type, callee(lo, id), args, num_args);
    bool is_single = fn->return_type != IR_TYPE_VOID && lang_num_results(lo->unit, id) == 1;
    if (fn->return_type != IR_TYPE_VOID) {
        ir_ref value = is_single ? call : ir_build(lo->graph, IR_RESULT, type, 0, &call, 1);
        out = lower_split(lo, fn->return_type, value, out);
    }
    uint32_t number = 0;
    for (uint32_t i = 0; i < fn->num_params; i++) {
        const struct lang_slot *slot = ast_slot(layer, fn, i);
        if (slot->mode == LANG_IN)
            continue;
        ir_ref value =
            ir_build(lo->graph, IR_RESULT, graph_type(lo, slot->type), ++number, &call, 1);
        out = lower_split(lo, slot->type, value, out);
    }
}

void lower_call(struct lower *lo, uint32_t id, const ir_ref *in, ir_ref *out)
{
    if (evaluate(lo, id, in, out) || lower_inline(lo, id, in, out))
        return;
    build_call(lo, id, in, out);
}

/* The entry */

static void report_large(const struct lower *lo)
{
    if (lo->host->too_large)
        lo->host->too_large(lo->host->user_data);
}

/* True if the call's arguments and results fit into the fixed arrays. */
static bool fits(const struct lower *lo)
{
    const struct lang_function *fn = lo->frame->fn;
    uint32_t leaves = lower_leaves(lo, fn->return_type);
    for (uint32_t i = 0; i < fn->num_params; i++)
        leaves += lower_leaves(lo, ast_slot(lo->frame->layer, fn, i)->type);
    return leaves <= LOWER_MAX_LEAVES;
}

static const ir_ref *join_result(struct lower *lo, ir_type_id type, const ir_ref *leaves,
                                 ir_ref *out)
{
    leaves = join(lo, type, leaves, out);
    *out = lower_defined(lo, *out, graph_type(lo, type));
    return leaves;
}

/* True if each value that an expression reads, and its own, fits into a fixed array. */
static bool each_fits(const struct lower *lo)
{
    const struct lang_function *fn = lo->frame->fn;
    bool good = lower_leaves(lo, fn->return_type) <= LOWER_MAX_LEAVES;
    for (uint32_t i = 0; i < fn->num_params && good; i++)
        good = lower_leaves(lo, ast_slot(lo->frame->layer, fn, i)->type) <= LOWER_MAX_LEAVES;
    return good;
}

static void lower_inline_expression(struct lower *lo, const ir_ref *args, ir_ref *results)
{
    lo->inputs = args; /* the inputs of the expression; it has no variables */
    ir_type_id type = lo->frame->fn->return_type;
    ir_ref leaves[LOWER_MAX_LEAVES];
    if (!each_fits(lo)) {
        results[0] = ir_poison(lo->graph, graph_type(lo, type));
        return;
    }
    lower_expression(lo, lower_node(lo, ast_returned(lo->frame->layer, lo->frame->fn)), leaves);
    join_result(lo, type, leaves, results);
    if (!lo->failed)
        return;
    results[0] = ir_poison(lo->graph, graph_type(lo, type));
    report_large(lo);
}

static void lower_function(struct lower *lo, uint32_t id, const ir_ref *args, ir_ref *results)
{
    const struct lang_unit *layer = lo->frame->layer;
    const struct lang_function *fn = lo->frame->fn;
    ir_ref in[LOWER_MAX_LEAVES], out[LOWER_MAX_LEAVES], *end = in;
    for (uint32_t i = 0; i < fn->num_params; i++)
        if (ast_slot(layer, fn, i)->mode != LANG_OUT)
            end = lower_split(lo, ast_slot(layer, fn, i)->type, *args++, end);
    assert(end <= in + LOWER_MAX_LEAVES);
    lower_call(lo, id, in, out);
    const ir_ref *from = out;
    unsigned count = 0;
    if (fn->return_type != IR_TYPE_VOID)
        from = join_result(lo, fn->return_type, from, &results[count++]);
    for (uint32_t i = 0; i < fn->num_params; i++)
        if (ast_slot(layer, fn, i)->mode != LANG_IN)
            from = join_result(lo, ast_slot(layer, fn, i)->type, from, &results[count++]);
}

static void poison_whole_results(struct lower *lo, ir_ref *results)
{
    report_large(lo);
    const struct lang_function *fn = lo->frame->fn;
    if (fn->return_type != IR_TYPE_VOID)
        *results++ = ir_poison(lo->graph, graph_type(lo, fn->return_type));
    for (uint32_t i = 0; i < fn->num_params; i++)
        if (ast_slot(lo->frame->layer, fn, i)->mode != LANG_IN)
            *results++ =
                ir_poison(lo->graph, graph_type(lo, ast_slot(lo->frame->layer, fn, i)->type));
}

void lang_lower_call(struct lang_unit *generated, struct ir_graph *graph,
                     const struct lang_host *host, uint32_t id, const ir_ref *args, ir_ref *results)
{
    struct lower_frame frame = {.budget = UINT32_MAX};
    struct lower lo = {.unit = generated,
                       .graph = graph,
                       .host = host,
                       .frame = &frame,
                       .max_graph_nodes = UINT32_MAX};
    generated->host = *host;
    generated->graph = graph;
    frame.fn = lang_function(generated, id, &frame.layer);
    if (frame.fn->flags & LANG_FN_EXPRESSION)
        lower_inline_expression(&lo, args, results);
    else if (!fits(&lo))
        poison_whole_results(&lo, results);
    else
        lower_function(&lo, id, args, results);
    assert(lo.depth == 0 && lo.frame == &frame);
}
