// SPDX-License-Identifier: Apache-2.0
/* Constant expressions. Their trees are at most PARSE_MAX_DEPTH high, so recursion is bounded. */
#include "parse/parse_priv.h"

#include <assert.h>

static bool load(const struct lang_unit *unit, ir_type_id type, uint32_t words,
                 struct ir_value *out)
{
    *out = (struct ir_value){.type = type};
    assert(words + ir_type_info(type)->components <= unit->words.len);
    memcpy(out->w, unit->words.items + words, ir_type_info(type)->components * sizeof out->w[0]);
    return true;
}

static bool is_value_type(ir_type_id type)
{
    return ir_type_components(type) > 0;
}

static bool global_value(const struct parser *p, const struct lang_node *node, struct ir_value *out)
{
    const struct lang_unit *layer;
    const struct lang_global *global = lang_global(p->unit, node->a, &layer);
    if (global->kind != LANG_GLOBAL_CONST || !is_value_type(global->type))
        return false;
    return load(layer, global->type, global->words, out);
}

static bool local_value(const struct parser *p, const struct lang_node *node, struct ir_value *out)
{
    for (uint32_t i = p->locals.len; i-- > 0;) {
        const struct local *local = &p->locals.items[i];
        if (local->slot == node->a)
            return local->has_value && load(p->unit, local->type, local->words, out);
    }
    return false;
}

/* An element of a constant global array. */
static bool element_value(struct parser *p, const struct lang_node *node, struct ir_value *out)
{
    const struct lang_node *array = tree_node(p, node->a);
    struct ir_value index;
    if (array->kind != LANG_GLOBAL || !is_value_type(node->type)
        || !check_value(p, array->next, &index))
        return false;
    const struct lang_unit *layer;
    const struct lang_global *global = lang_global(p->unit, array->a, &layer);
    unsigned size = ir_type_info(node->type)->components;
    if (global->kind != LANG_GLOBAL_CONST || index.w[0].u >= global->num_words / size)
        return false;
    assert(global->num_words % size == 0);
    return load(layer, node->type, global->words + index.w[0].u * size, out);
}

static bool op_value(struct parser *p, const struct lang_node *node, struct ir_value *out)
{
    enum { MAX_ARGS = 16 };
    struct ir_value args[MAX_ARGS];
    unsigned num_args = 0;
    if (node->op == IR_INDEX && tree_type(p, node->a) >= IR_TYPE_FIRST_USER)
        return element_value(p, node, out);
    if (!(ir_op_info((enum ir_op)node->op)->flags & OP_PURE) || !is_value_type(node->type))
        return false;
    for (lang_ref arg = node->a; arg; arg = tree_node(p, arg)->next, num_args++)
        if (num_args == MAX_ARGS || !check_value(p, arg, &args[num_args]))
            return false;
    return ir_eval_op((enum ir_op)node->op, node->type, node->b, args, num_args, out);
}

bool check_value(struct parser *p, lang_ref ref, struct ir_value *out_value)
{
    const struct lang_node *node = tree_node(p, ref);
    switch ((enum lang_kind)node->kind) {
    case LANG_CONST: return load(p->unit, node->type, node->a, out_value);
    case LANG_GLOBAL: return global_value(p, node, out_value);
    case LANG_VAR: return local_value(p, node, out_value);
    case LANG_OP: return op_value(p, node, out_value);
    default: return false;
    }
}

static void push_words(struct parser *p, const union ir_word *from, uint32_t num)
{
    for (uint32_t i = 0; i < num; i++)
        vec_push(p->unit->arena, &p->unit->words, from[i]);
}

static bool array_words(struct parser *p, lang_ref ref)
{
    const struct lang_node *node = tree_node(p, ref);
    if (node->kind == LANG_GLOBAL) {
        const struct lang_unit *layer;
        const struct lang_global *global = lang_global(p->unit, node->a, &layer);
        if (global->kind != LANG_GLOBAL_CONST)
            return false;
        assert(global->words + global->num_words <= layer->words.len);
        for (uint32_t i = 0; i < global->num_words; i++) { /* pushing may move the words */
            union ir_word word = layer->words.items[global->words + i];
            vec_push(p->unit->arena, &p->unit->words, word);
        }
        return true;
    }
    if (node->kind != LANG_OP || node->op != IR_CONSTRUCT)
        return false;
    for (lang_ref element = node->a; element; element = tree_node(p, element)->next) {
        struct ir_value value;
        if (!is_value_type(tree_type(p, element)) || !check_value(p, element, &value))
            return false;
        push_words(p, value.w, ir_type_info(value.type)->components);
    }
    return true;
}

bool check_words(struct parser *p, lang_ref ref, uint32_t *out_words, uint32_t *out_num_words)
{
    ir_type_id type = tree_type(p, ref), element;
    uint32_t length, first = p->unit->words.len;
    struct ir_value value;
    if (is_value_type(type) && check_value(p, ref, &value))
        push_words(p, value.w, ir_type_info(type)->components);
    else if (!check_is_array(p, type, &element, &length) || !array_words(p, ref))
        return false;
    assert(p->unit->words.len >= first);
    *out_words = first;
    *out_num_words = p->unit->words.len - first;
    return true;
}
