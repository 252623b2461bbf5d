// SPDX-License-Identifier: Apache-2.0
#include "lower/lower_priv.h"

#include <assert.h>

static inline void copy_leaves(const ir_ref *from, uint32_t count, ir_ref *out)
{
    for (uint32_t i = 0; i < count; i++)
        out[i] = from[i];
}

/* An operation or call that stands in the place of a variable or function has its name. */
static inline void name_value(struct lower *lo, const struct lang_node *node, const ir_ref *leaves)
{
    bool has_name = node->kind == LANG_OP || node->kind == LANG_CALL;
    if (!has_name || !node->c || lo->failed)
        return;
    bool is_function = node->c & LANG_OF_FUNCTION;
    lower_name(lo, node->type, *leaves, node->c & ~LANG_OF_FUNCTION,
               is_function ? IR_NAME_FUNCTION : IR_NAME_LOCAL);
}

/* True if one more tree node may run. */
static inline bool may_go_on(struct lower *lo)
{
    if (lo->frame->budget-- == 0 || lo->graph->nodes.len > lo->max_graph_nodes
        || (lo->depth > 0 && ++lo->num_steps > LOWER_MAX_STEPS))
        lo->failed = true;
    return !lo->failed;
}

static void lower_other(struct lower *lo, const struct lang_node *node, ir_ref *out);

ir_ref lower_single(struct lower *lo, const struct lang_node *node)
{
    assert(!ast_is_user_type(node->type));
    ir_ref result = 0;
    if (!may_go_on(lo))
        return 0;
    if (node->kind == LANG_VAR)
        result = lo->frame->leaves[lo->frame->offsets[node->a]];
    else if (node->kind == LANG_CONST)
        result = ir_const_words(lo->graph, node->type, ast_words(lo->frame->layer, node));
    else
        lower_other(lo, node, &result);
    return lo->failed ? result : lower_defined(lo, result, node->type);
}

/* Globals */

static void constant_leaves(struct lower *lo, ir_type_id type, const union ir_word **words,
                            ir_ref **out)
{
    if (ast_is_user_type(type)) { /* an array: constants are not structs */
        const struct ir_user_type *user = lang_user_type(lo->unit, type, NULL);
        for (uint32_t i = 0; i < user->array_length; i++)
            constant_leaves(lo, user->element, words, out);
        return;
    }
    *(*out)++ = ir_const_words(lo->graph, type, *words);
    *words += ir_type_info(type)->components;
}

static void lower_global(struct lower *lo, const struct lang_node *node, ir_ref *out)
{
    const struct lang_unit *layer;
    const struct lang_global *global = lang_global(lo->unit, node->a, &layer);
    if (global->kind == LANG_GLOBAL_CONST) {
        const union ir_word *words = layer->words.items + global->words;
        constant_leaves(lo, node->type, &words, &out);
    } else if (ast_is_user_type(node->type)) {
        lo->failed = true;
    } else {
        *out = lo->host->global(lo->host->user_data, lo->graph, lo->unit, node->a);
    }
}

/* Operators */

/* Tells the host of a constant index that is out of range. */
static void check_index(const struct lower *lo, uint32_t length, ir_ref index)
{
    const union ir_word *words = ir_constant_words(lo->graph, index);
    if (words && words->u >= length && lo->host->bad_index)
        lo->host->bad_index(lo->host->user_data, words->i, length);
}

static void lower_operands(struct lower *lo, const struct lang_node *node, ir_ref *out)
{
    ir_ref args[AST_MAX_OPERANDS];
    unsigned count = 0;
    for (lang_ref ref = node->a; ref && !lo->failed;) {
        const struct lang_node *operand = lower_node(lo, ref);
        if (count == AST_MAX_OPERANDS || ast_is_user_type(operand->type)) /* structs compared */
            lo->failed = true;
        else
            args[count++] = lower_single(lo, operand);
        ref = operand->next;
    }
    if (lo->failed)
        return;
    if (node->op == IR_INDEX)
        check_index(lo, ast_num_parts(lo->unit, lower_node(lo, node->a)->type), args[1]);
    bool is_special = node->op >= IR_TEX && node->op <= IR_TEX_FETCH
                      && ir_type_of(lo->graph, args[0]) != IR_TYPE_SAMPLER;
    *out = is_special && lo->host->texture ? lo->host->texture(lo->host->user_data, node->op, args)
                                           : 0;
    if (!*out)
        *out = ir_build(lo->graph, node->op, node->type, node->b, args, count);
}

static bool known_condition(const struct lower *lo, ir_ref condition, bool *out)
{
    const union ir_word *words = ir_constant_words(lo->graph, condition);
    if (words)
        *out = words->u != 0;
    return words != NULL;
}

static void lower_select(struct lower *lo, const struct lang_node *node, ir_ref *out)
{
    const struct lang_node *first = lower_node(lo, node->a), *yes = lower_node(lo, first->next),
                           *no = lower_node(lo, yes->next);
    assert(no->next == 0 && yes->type == no->type);
    ir_ref condition = lower_single(lo, first);
    if (lo->failed)
        return;
    bool known;
    if (known_condition(lo, condition, &known)) {
        lower_expression(lo, known ? yes : no, out);
        return;
    }
    ir_ref others[LOWER_MAX_LEAVES];
    uint32_t count = lower_leaves(lo, node->type);
    lower_expression(lo, yes, out);
    lower_expression(lo, no, others);
    for (uint32_t i = 0; i < count && !lo->failed; i++)
        if (out[i] && others[i] && out[i] != others[i])
            out[i] = ir_build(lo->graph, IR_SELECT, ir_type_of(lo->graph, out[i]), 0,
                              (ir_ref[]){condition, out[i], others[i]}, 3);
        else if (!out[i])
            out[i] = others[i];
}

static void lower_logic(struct lower *lo, const struct lang_node *node, ir_ref *out)
{
    const struct lang_node *first = lower_node(lo, node->a);
    ir_ref left = lower_single(lo, first);
    if (lo->failed)
        return;
    bool known;
    if (known_condition(lo, left, &known) && known == (node->op == IR_LOR)) {
        *out = left;
        return;
    }
    ir_ref right = lower_single(lo, lower_node(lo, first->next));
    if (!lo->failed)
        *out = ir_build(lo->graph, node->op, IR_TYPE_BOOL, 0, (ir_ref[]){left, right}, 2);
}

static void lower_aggregate(struct lower *lo, const struct lang_node *node, ir_ref *out)
{
    for (lang_ref ref = node->a; ref && !lo->failed; ref = lower_node(lo, ref)->next) {
        lower_expression(lo, lower_node(lo, ref), out);
        out += lower_leaves(lo, lower_node(lo, ref)->type);
    }
}

/* The value of an index that is constant and in range; otherwise sets lo->failed. */
static uint32_t known_index(struct lower *lo, lang_ref ref, uint32_t length)
{
    ir_ref index = lower_single(lo, lower_node(lo, ref));
    const union ir_word *words = lo->failed ? NULL : ir_constant_words(lo->graph, index);
    lo->failed |= !words || words->u >= length;
    return lo->failed ? 0 : words->u;
}

/* The offset of a struct member or array element among the leaves of its variable. */
static uint32_t part_offset(struct lower *lo, const struct lang_node *node)
{
    const struct lang_node *whole = lower_node(lo, node->a);
    ir_type_id type;
    if (node->op == IR_MEMBER)
        return ast_member_offset(lo->unit, whole->type, node->b, ast_type_leaves, &type);
    uint32_t length = ast_num_parts(lo->unit, whole->type);
    return known_index(lo, whole->next, length) * lower_leaves(lo, node->type);
}

static void lower_part(struct lower *lo, const struct lang_node *node, ir_ref *out)
{
    const struct lang_node *whole = lower_node(lo, node->a);
    ir_ref leaves[LOWER_MAX_LEAVES];
    const ir_ref *from = leaves;
    uint32_t offset = part_offset(lo, node);
    if (lo->failed)
        return;
    if (whole->kind == LANG_VAR)
        from = lo->frame->leaves + lo->frame->offsets[whole->a];
    else
        lower_expression(lo, whole, leaves);
    copy_leaves(from + offset, lower_leaves(lo, node->type), out);
}

static void lower_op(struct lower *lo, const struct lang_node *node, ir_ref *out)
{
    switch (node->op) {
    case IR_SELECT: lower_select(lo, node, out); break;
    case IR_LAND:
    case IR_LOR: lower_logic(lo, node, out); break;
    case IR_MEMBER: lower_part(lo, node, out); break;
    case IR_INDEX:
        if (ast_is_user_type(lower_node(lo, node->a)->type))
            lower_part(lo, node, out);
        else
            lower_operands(lo, node, out);
        break;
    case IR_CONSTRUCT:
        if (ast_is_user_type(node->type))
            lower_aggregate(lo, node, out);
        else
            lower_operands(lo, node, out);
        break;
    default: lower_operands(lo, node, out);
    }
}

/* Assignment */

/* Component `index` of a vector. If the vector is undefined, any value will do. */
static ir_ref component(struct lower *lo, ir_ref vector, ir_type_id type, unsigned index)
{
    ir_type_id scalar = ir_type_info(type)->scalar;
    if (!vector)
        return ir_const(lo->graph, &(struct ir_value){.type = scalar});
    return ir_type_info(type)->components == 1 ? vector : ir_component(lo->graph, vector, index);
}

static ir_ref with_components(struct lower *lo, ir_ref vector, ir_type_id type, uint32_t attr,
                              ir_ref value, ir_type_id value_type)
{
    ir_ref parts[4];
    unsigned count = ir_type_info(type)->components;
    assert(attr >> 8 <= count);
    for (unsigned i = 0; i < count; i++)
        parts[i] = component(lo, vector, type, i);
    for (unsigned i = 0; i < attr >> 8; i++)
        parts[attr >> 2 * i & 3] = component(lo, value, value_type, i);
    return ir_construct(lo->graph, type, parts, count);
}

/* Replaces one column of a matrix, or one component of a vector. */
static ir_ref with_element(struct lower *lo, ir_ref whole, ir_type_id type, uint32_t index,
                           ir_ref value, ir_type_id value_type)
{
    if (!ir_type_is_matrix(type))
        return with_components(lo, whole, type, 1u << 8 | index, value, value_type);
    ir_ref columns[4];
    unsigned count = ir_type_info(type)->columns;
    assert(index < count);
    for (unsigned i = 0; i < count; i++) {
        ir_ref at = ir_const_int(lo->graph, (int32_t)i);
        columns[i] = i == index ? value
                     : whole
                         ? ir_build(lo->graph, IR_INDEX, value_type, 0, (ir_ref[]){whole, at}, 2)
                         : ir_const(lo->graph, &(struct ir_value){.type = value_type});
    }
    return ir_construct(lo->graph, type, columns, count);
}

static void assign_element(struct lower *lo, const struct lang_node *node, ir_ref value)
{
    ir_type_id type = lower_node(lo, node->a)->type;
    ir_ref whole = 0;
    lower_expression(lo, lower_node(lo, node->a), &whole);
    if (node->op == IR_SWIZZLE) {
        whole = with_components(lo, whole, type, node->b, value, node->type);
    } else {
        uint32_t length = ast_num_parts(lo->unit, type);
        uint32_t index = known_index(lo, lower_node(lo, node->a)->next, length);
        if (lo->failed)
            return;
        whole = with_element(lo, whole, type, index, value, node->type);
    }
    lower_assign(lo, node->a, &whole);
}

/* Assigns to a struct member or array element inside a variable. */
static void assign_part(struct lower *lo, const struct lang_node *node, const ir_ref *leaves)
{
    ir_ref whole[LOWER_MAX_LEAVES];
    uint32_t offset = part_offset(lo, node);
    if (lo->failed)
        return;
    lower_expression(lo, lower_node(lo, node->a), whole);
    copy_leaves(leaves, lower_leaves(lo, node->type), whole + offset);
    lower_assign(lo, node->a, whole);
}

void lower_assign(struct lower *lo, lang_ref target, const ir_ref *leaves)
{
    const struct lang_node *node = lower_node(lo, target);
    if (lo->failed)
        return;
    assert(node->kind != LANG_VAR || node->a < lo->frame->fn->num_slots);
    if (node->kind == LANG_VAR) {
        copy_leaves(leaves, lower_leaves(lo, node->type),
                    lo->frame->leaves + lo->frame->offsets[node->a]);
        lower_name_slot(lo, node->a, IR_NAME_LOCAL);
    } else if (ast_is_user_type(lower_node(lo, node->a)->type))
        assign_part(lo, node, leaves);
    else
        assign_element(lo, node, lower_defined(lo, leaves[0], node->type));
}

/* Calls */

static void assign_outputs(struct lower *lo, const struct lang_node *node, const ir_ref *out)
{
    uint32_t i = 0;
    for (lang_ref ref = node->b; ref && !lo->failed; ref = lower_node(lo, ref)->next, i++) {
        if (ast_param_mode(lo->unit, node->a, i) == LANG_IN)
            continue;
        lower_assign(lo, ref, out);
        out += lower_leaves(lo, lower_node(lo, ref)->type);
    }
}

static void lower_nested_call(struct lower *lo, const struct lang_node *node, ir_ref *out)
{
    ir_ref in[LOWER_MAX_LEAVES], results[LOWER_MAX_LEAVES];
    const struct lang_unit *layer;
    const struct lang_function *fn = lang_function(lo->unit, node->a, &layer);
    uint32_t num_in = 0, num_results = lower_leaves(lo, node->type), num_returned = num_results;
    const struct lang_slot *slots = layer->slots.items + fn->first_slot;
    for (lang_ref ref = node->b, next; ref && !lo->failed; ref = next, slots++) {
        const struct lang_node *argument = lower_node(lo, ref);
        uint8_t mode = slots->mode;
        uint32_t count = lower_leaves(lo, argument->type);
        next = argument->next;
        num_results += mode == LANG_IN ? 0 : count;
        if (num_in + count > LOWER_MAX_LEAVES || num_results > LOWER_MAX_LEAVES) {
            lo->failed = true;
            return;
        }
        if (mode == LANG_OUT)
            continue;
        lower_expression(lo, argument, in + num_in);
        num_in += count;
    }
    if (lo->failed)
        return;
    assert(slots == layer->slots.items + fn->first_slot + fn->num_params);
    assert(num_in <= LOWER_MAX_LEAVES && num_results <= LOWER_MAX_LEAVES);
    lower_call(lo, node->a, in, results);
    copy_leaves(results, num_returned, out);
    if (num_results > num_returned)
        assign_outputs(lo, node, results + num_returned);
}

static void lower_other(struct lower *lo, const struct lang_node *node, ir_ref *out)
{
    assert(node->kind != LANG_INPUT || node->a < lo->frame->fn->num_params);
    switch (node->kind) {
    case LANG_CONST:
        *out = ir_const_words(lo->graph, node->type, ast_words(lo->frame->layer, node));
        break;
    case LANG_INPUT: lower_split(lo, node->type, lo->inputs[node->a], out); break;
    case LANG_GLOBAL: lower_global(lo, node, out); break;
    case LANG_CALL: lower_nested_call(lo, node, out); break;
    default: lower_op(lo, node, out);
    }
    name_value(lo, node, out);
}

void lower_expression(struct lower *lo, const struct lang_node *node, ir_ref *out)
{
    uint32_t count = lower_leaves(lo, node->type);
    lo->failed |= count > LOWER_MAX_LEAVES;
    if (!may_go_on(lo))
        return;
    if (node->kind == LANG_VAR)
        copy_leaves(lo->frame->leaves + lo->frame->offsets[node->a], count, out);
    else
        lower_other(lo, node, out);
}
