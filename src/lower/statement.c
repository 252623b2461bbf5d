// SPDX-License-Identifier: Apache-2.0
/*
 * Executes statements with nodes as values. If a condition is not constant, both branches run on
 * copies of the variables, and a SELECT merges each difference. If one branch returns, the
 * statements after it belong to the other branch.
 */
#include "lower/lower_priv.h"

#include <assert.h>

static void lower_declare(struct lower *lo, const struct lang_node *node)
{
    assert(node->a < lo->frame->fn->num_slots);
    const uint32_t *offsets = lo->frame->offsets;
    ir_ref *leaves = lo->frame->leaves + offsets[node->a];
    if (!node->b) {
        memset(leaves, 0, (offsets[node->a + 1] - offsets[node->a]) * sizeof *leaves);
        return;
    }
    lower_expression(lo, lower_node(lo, node->b), leaves);
    if (!lo->failed)
        lower_name_slot(lo, node->a, IR_NAME_LOCAL);
}

static void lower_assignment(struct lower *lo, const struct lang_node *node)
{
    ir_ref leaves[LOWER_MAX_LEAVES];
    lower_expression(lo, lower_node(lo, node->b), leaves);
    if (node->op != IR_NUM_OPS && !lo->failed) {
        ir_ref old = lower_single(lo, lower_node(lo, node->a));
        if (lo->failed)
            return;
        ir_ref value = lower_defined(lo, leaves[0], lower_node(lo, node->b)->type);
        leaves[0] = ir_build(lo->graph, node->op, lower_node(lo, node->a)->type, 0,
                             (ir_ref[]){old, value}, 2);
    }
    lower_assign(lo, node->a, leaves);
}

/* Branches */

static bool lower_body(struct lower *lo, lang_ref body)
{
    if (!body)
        return false;
    lo->frame->nesting++;
    bool returned = lower_statements(
        lo, lower_node(lo, body)->kind == LANG_BLOCK ? lower_node(lo, body)->a : body);
    lo->frame->nesting--;
    return returned;
}

static ir_ref *save_leaves(struct lower *lo)
{
    size_t size = lo->frame->num_leaves * sizeof *lo->frame->leaves;
    ir_ref *copy = arena_alloc(lo->graph->arena, size);
    return size ? memcpy(copy, lo->frame->leaves, size) : copy;
}

static void restore_leaves(struct lower *lo, const ir_ref *saved)
{
    if (lo->frame->num_leaves)
        memcpy(lo->frame->leaves, saved, lo->frame->num_leaves * sizeof *saved);
}

/* The state of the graph at the start of a branch. */
struct mark {
    uint32_t nodes, calls;
};

static struct mark mark(const struct lower *lo)
{
    return (struct mark){lo->graph->nodes.len, lo->num_calls};
}

/* True if the body must become nodes: what differentiates nodes has no neighbouring pixels. */
static bool is_differentiated(const struct lower *lo)
{
    return lo->host->inlines_derivatives && (lo->frame->fn->flags & LANG_FN_DIFFERENCE) != 0;
}

/*
 * True if the shader may compute the nodes since `begin` without need. Excludes calls, even if an
 * equal one exists, and derivatives, which need all pixels; nodes that use their results are
 * allowed.
 */
static bool is_cheap(struct lower *lo, struct mark begin)
{
    if (is_differentiated(lo))
        return true;
    const struct ir_graph *graph = lo->graph;
    assert(begin.nodes <= graph->nodes.len && begin.calls <= lo->num_calls);
    uint32_t added = graph->nodes.len - begin.nodes;
    if (lo->num_calls != begin.calls)
        return false;
    for (uint32_t i = begin.nodes; i < graph->nodes.len; i++) {
        const struct ir_node *node = ir_get(graph, i);
        bool is_read_or_call = node->op >= IR_TEX && node->op <= IR_RESULT;
        if (is_read_or_call || ir_op_info(node->op)->flags & OP_DERIVATIVE)
            return false;
        added -= node->op == IR_CONST;
    }
    return added <= LOWER_MAX_BRANCH_NODES;
}

static bool is_selectable(ir_type_id type)
{
    return !ast_is_user_type(type) && type != IR_TYPE_STRING && ir_type_info(type)->components > 0;
}

/* Merges the branches; the variables now hold the values of the false branch. */
static void merge(struct lower *lo, ir_ref condition, const ir_ref *yes)
{
    for (uint32_t i = 0; i < lo->frame->num_leaves && !lo->failed; i++) {
        ir_ref *no = &lo->frame->leaves[i];
        if (yes[i] == *no || !yes[i])
            continue;
        if (!*no) { /* undefined in this branch: any value will do */
            *no = yes[i];
            continue;
        }
        ir_type_id type = ir_type_of(lo->graph, *no);
        assert(ir_type_of(lo->graph, yes[i]) == type);
        if (is_selectable(type))
            *no = ir_build(lo->graph, IR_SELECT, type, 0, (ir_ref[]){condition, yes[i], *no}, 3);
        else
            lo->failed = true;
    }
}

/*
 * The statements after a branch that returned: they must return as well, or end a void function.
 */
static void lower_rest(struct lower *lo, lang_ref rest)
{
    struct mark begin = mark(lo);
    bool returned = lower_statements(lo, rest);
    bool ends = lo->frame->nesting == 0 && lo->frame->fn->return_type == IR_TYPE_VOID;
    lo->failed |= (!returned && !ends) || !is_cheap(lo, begin);
}

/* Lowers an `if` with a variable condition, and the statements after it. */
static bool lower_branches(struct lower *lo, const struct lang_node *node, ir_ref condition)
{
    struct mark begin = mark(lo);
    const ir_ref *before = save_leaves(lo);
    bool yes_returned = lower_body(lo, node->b);
    lo->failed |= !is_cheap(lo, begin);
    /* `if (c) return x;`: the remaining statements are the other branch */
    if (yes_returned && !node->c && !lo->failed) {
        const ir_ref *yes = save_leaves(lo);
        restore_leaves(lo, before);
        lower_rest(lo, node->next);
        merge(lo, condition, yes);
        return true;
    }
    if (lo->failed)
        return true;
    const ir_ref *yes = save_leaves(lo);
    begin = mark(lo);
    restore_leaves(lo, before);
    bool no_returned = lower_body(lo, node->c);
    lo->failed |= !is_cheap(lo, begin);
    if (yes_returned != no_returned && !lo->failed) {
        if (yes_returned) {
            lower_rest(lo, node->next);
        } else {
            const ir_ref *no = save_leaves(lo);
            restore_leaves(lo, yes);
            lower_rest(lo, node->next);
            yes = save_leaves(lo);
            restore_leaves(lo, no);
        }
    }
    if (lo->failed)
        return true;
    merge(lo, condition, yes);
    return yes_returned || no_returned || lower_statements(lo, node->next);
}

static bool lower_if(struct lower *lo, const struct lang_node *node)
{
    ir_ref condition = lower_single(lo, lower_node(lo, node->a));
    if (lo->failed)
        return true;
    const union ir_word *known = ir_constant_words(lo->graph, condition);
    if (!known)
        return lower_branches(lo, node, condition);
    return lower_body(lo, known->u ? node->b : node->c) || lower_statements(lo, node->next);
}

/* False if the loop ends here. */
static bool goes_round(struct lower *lo, lang_ref condition)
{
    ir_ref value = condition ? lower_single(lo, lower_node(lo, condition)) : 0;
    const union ir_word *known = value ? ir_constant_words(lo->graph, value) : NULL;
    lo->failed |= condition && !known;
    return !lo->failed && (!known || known->u);
}

/*
 * A loop round by round, for what derives nodes; constants decide the rounds. Elsewhere a function
 * with a loop stays a call.
 */
static bool lower_loop(struct lower *lo, const struct lang_node *node)
{
    enum { MAX_ROUNDS = 64 };
    lang_ref step = ast_step(lo->frame->layer, node);
    bool returned = false;
    lo->failed |= !is_differentiated(lo);
    if (!lo->failed && node->kind == LANG_FOR && node->a)
        lower_statements(lo, node->a);
    for (unsigned round = 0; !lo->failed && !returned; round++) {
        if ((round || node->kind != LANG_DO) && !goes_round(lo, node->b))
            break;
        lo->failed |= round == MAX_ROUNDS;
        returned = lower_body(lo, node->c);
        if (step && !returned)
            lower_statements(lo, step);
    }
    return returned || lo->failed;
}

bool lower_statements(struct lower *lo, lang_ref first)
{
    const struct lang_node *node;
    for (lang_ref ref = first; ref && !lo->failed; ref = node->next) {
        node = lower_node(lo, ref);
        ir_ref unused[LOWER_MAX_LEAVES];
        switch (node->kind) {
        case LANG_DECLARE: lower_declare(lo, node); break;
        case LANG_ASSIGN: lower_assignment(lo, node); break;
        case LANG_EXPR: lower_expression(lo, lower_node(lo, node->a), unused); break;
        case LANG_BLOCK:
            if (lower_body(lo, ref))
                return true;
            break;
        case LANG_IF: return lower_if(lo, node);
        case LANG_RETURN:
            if (node->a)
                lower_expression(lo, lower_node(lo, node->a),
                                 lo->frame->leaves + lo->frame->offsets[lo->frame->fn->num_slots]);
            return true;
        case LANG_FOR:
        case LANG_WHILE:
        case LANG_DO:
            if (lower_loop(lo, node))
                return true;
            break;
        default: lo->failed = true;
        }
    }
    return lo->failed;
}
