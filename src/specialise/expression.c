// SPDX-License-Identifier: Apache-2.0
/* The forward step over expressions. */
#include "specialise/spec.h"

#include <assert.h>

/* True for a literal longer than a name: a vector or matrix with different components. */
static bool is_long(const struct spec *s, const struct lang_node *constant)
{
    uint32_t count = ir_type_info(constant->type)->components;
    const union ir_word *words = ast_words(s->unit, constant);
    for (uint32_t i = 1; i < count; i++)
        if (words[i].u != words[0].u)
            return true;
    return false;
}

static lang_ref spec_variable(struct spec *s, struct lang_node node)
{
    assert(node.a < s->fn.num_slots);
    lang_ref known = s->known[node.a];
    if (!known || spec_node(s, known)->kind != LANG_CONST)
        return spec_add(s, node);
    s->changed = true;
    struct lang_node constant = *spec_node(s, known);
    constant.c = 0;
    if (!ast_slot(s->layer, &s->fn, node.a)->assigned && is_long(s, &constant))
        constant.c = node.a + 1; /* sweep.c may turn it into the variable again */
    return spec_add(s, constant);
}

static bool option_value(const struct lang_unit *unit, uint32_t global_id, struct ir_value *out)
{
    const struct lang_host *host = &unit->host;
    ir_ref ref = host->global ? host->global(host->user_data, unit->graph, unit, global_id) : 0;
    return ref && ir_get_const(unit->graph, ref, out);
}

static lang_ref spec_global(struct spec *s, struct lang_node node)
{
    const struct lang_unit *layer;
    const struct lang_global *global = lang_global(s->unit, node.a, &layer);
    struct ir_value value;
    if (global->kind == LANG_GLOBAL_CONST && !ast_is_user_type(node.type)) {
        s->changed = true;
        return spec_constant_words(s, node.type, layer->words.items + global->words);
    }
    if (global->kind == LANG_GLOBAL_OPTION && option_value(s->unit, node.a, &value)) {
        s->changed = true;
        return spec_constant(s, &value);
    }
    return spec_add(s, node);
}

/* Rebuilds the operands of a source node and chains them. */
static unsigned spec_operands(struct spec *s, lang_ref first, struct chain *chain, lang_ref *out,
                              unsigned max)
{
    unsigned count = 0;
    for (lang_ref ref = first; ref; ref = ast_node(s->layer, ref)->next, count++) {
        lang_ref operand = spec_expression(s, ref);
        spec_append(s, chain, operand);
        if (count < max)
            out[count] = operand;
    }
    return count;
}

static lang_ref spec_select(struct spec *s, struct lang_node node)
{
    lang_ref condition = spec_expression(s, node.a);
    lang_ref yes = ast_node(s->layer, node.a)->next, no = ast_node(s->layer, yes)->next;
    struct ir_value value;
    if (spec_get(s, condition, &value)) {
        s->changed = true;
        return spec_expression(s, value.w[0].u ? yes : no);
    }
    struct chain chain = {condition, condition};
    spec_append(s, &chain, spec_expression(s, yes));
    spec_append(s, &chain, spec_expression(s, no));
    node.a = condition;
    return spec_add(s, node);
}

/* && and || do not evaluate the right side if the left side decides. */
static lang_ref spec_logic(struct spec *s, struct lang_node node)
{
    lang_ref left = spec_expression(s, node.a), source = ast_node(s->layer, node.a)->next;
    struct ir_value value;
    if (spec_get(s, left, &value)) {
        s->changed = true;
        return (value.w[0].u != 0) == (node.op == IR_LOR) ? left : spec_expression(s, source);
    }
    lang_ref args[2] = {left, spec_expression(s, source)};
    struct chain chain = {left, left};
    spec_append(s, &chain, args[1]);
    node.a = left;
    lang_ref folded = spec_fold(s, &node, args, 2);
    s->changed |= folded != 0;
    return folded ? folded : spec_add(s, node);
}

/* An element of a constant table at a constant index. */
static lang_ref element_of_global(struct spec *s, const struct lang_node *node, uint32_t global_id,
                                  uint32_t index)
{
    const struct lang_unit *layer;
    const struct lang_global *global = lang_global(s->unit, global_id, &layer);
    uint32_t size = ir_type_info(node->type)->components;
    if (global->kind != LANG_GLOBAL_CONST || size == 0 || index >= global->num_words / size)
        return 0;
    assert(global->words + global->num_words <= layer->words.len);
    return spec_constant_words(s, node->type, layer->words.items + global->words + index * size);
}

/* A member or element of a struct or array of constants. */
static lang_ref part_of_known(struct spec *s, uint32_t slot, uint32_t index)
{
    if (!s->known[slot] || spec_node(s, s->known[slot])->kind != LANG_OP)
        return 0;
    lang_ref part = spec_node(s, s->known[slot])->a;
    while (part && index--)
        part = spec_node(s, part)->next;
    if (!part || spec_node(s, part)->kind != LANG_CONST)
        return 0;
    struct lang_node constant = *spec_node(s, part);
    return spec_add(s, constant);
}

static lang_ref fold_part(struct spec *s, const struct lang_node *node, const lang_ref *args)
{
    struct lang_node whole = *spec_node(s, args[0]);
    struct ir_value index = {.w = {{.u = node->b}}};
    if (!ast_is_user_type(whole.type) || ast_is_user_type(node->type)
        || (node->op == IR_INDEX && !spec_get(s, args[1], &index)))
        return 0;
    if (whole.kind == LANG_VAR)
        return part_of_known(s, whole.a, index.w[0].u);
    return whole.kind == LANG_GLOBAL ? element_of_global(s, node, whole.a, index.w[0].u) : 0;
}

/*
 * GLSL refuses a constant index that is out of range, even in code that never runs: the last part
 * stands for those beyond it.
 */
static void clamp_index(struct spec *s, lang_ref whole, lang_ref index)
{
    struct ir_value value;
    uint32_t length = ast_num_parts(s->unit, spec_node(s, whole)->type);
    if (!spec_get(s, index, &value) || value.w[0].u < length)
        return;
    spec_node(s, index)->a = s->unit->words.len;
    vec_push(s->unit->arena, &s->unit->words, (union ir_word){.u = length - 1});
}

static lang_ref spec_op(struct spec *s, struct lang_node node)
{
    if (node.op == IR_SELECT)
        return spec_select(s, node);
    if (node.op == IR_LAND || node.op == IR_LOR)
        return spec_logic(s, node);
    struct chain chain = {0};
    lang_ref args[AST_MAX_OPERANDS];
    unsigned count = spec_operands(s, node.a, &chain, args, AST_MAX_OPERANDS);
    node.a = chain.first;
    if (node.op == IR_INDEX)
        clamp_index(s, args[0], args[1]);
    bool is_part = node.op == IR_MEMBER || node.op == IR_INDEX;
    lang_ref folded = is_part ? fold_part(s, &node, args) : 0;
    if (!folded)
        folded = spec_fold(s, &node, args, count);
    s->changed |= folded != 0;
    return folded ? folded : spec_add(s, node);
}

lang_ref spec_target(struct spec *s, lang_ref ref)
{
    struct lang_node node = *ast_node(s->layer, ref);
    if (node.kind == LANG_OP) {
        lang_ref source_index = node.op == IR_INDEX ? ast_node(s->layer, node.a)->next : 0;
        struct chain chain = {0};
        spec_append(s, &chain, spec_target(s, node.a));
        if (source_index) {
            spec_append(s, &chain, spec_expression(s, source_index));
            clamp_index(s, chain.first, chain.last);
        }
        node.a = chain.first;
    }
    return spec_add(s, node);
}

lang_ref spec_expression(struct spec *s, lang_ref ref)
{
    struct lang_node node = *ast_node(s->layer, ref);
    switch (node.kind) {
    case LANG_CONST: return spec_constant_words(s, node.type, s->layer->words.items + node.a);
    case LANG_VAR: return spec_variable(s, node);
    case LANG_GLOBAL: return spec_global(s, node);
    case LANG_OP: return spec_op(s, node);
    case LANG_CALL: return spec_call(s, node);
    default: return spec_add(s, node);
    }
}
