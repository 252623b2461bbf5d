// SPDX-License-Identifier: Apache-2.0
#include "parse/parse_priv.h"

#include <assert.h>

uint32_t tree_place(const struct parser *p, lang_ref ref)
{
    assert(ref - p->first_node < p->origins.len);
    return p->origins.items[ref - p->first_node].place;
}

static lang_ref push(struct parser *p, struct lang_node node, unsigned height, uint32_t place)
{
    vec_push(p->unit->arena, &p->unit->nodes, node);
    vec_push(p->unit->arena, &p->origins, (struct tree_origin){place, (uint8_t)height});
    assert(p->origins.len == p->unit->nodes.len - p->first_node);
    return p->unit->nodes.len - 1;
}

lang_ref tree_new(struct parser *p, enum lang_kind kind, enum ir_op op, ir_type_id type,
                  uint32_t place)
{
    return push(p, (struct lang_node){.kind = (uint8_t)kind, .op = (uint8_t)op, .type = type}, 1,
                place);
}

lang_ref tree_const(struct parser *p, const struct ir_value *value, uint32_t place)
{
    uint32_t words = p->unit->words.len;
    unsigned num_words = ir_type_info(value->type)->components;
    memcpy(vec_extend(p->unit->arena, &p->unit->words, num_words), value->w,
           num_words * sizeof value->w[0]);
    lang_ref ref = tree_new(p, LANG_CONST, IR_NUM_OPS, value->type, place);
    tree_node(p, ref)->a = words;
    return ref;
}

/*
 * Chains the operands and returns the height of a node above them; 0, after a message, if it
 * exceeds the limit.
 */
static unsigned chain_operands(struct parser *p, const lang_ref *args, unsigned num_args,
                               uint32_t place)
{
    unsigned height = 0;
    for (unsigned i = 0; i < num_args; i++) {
        assert(args[i] - p->first_node < p->origins.len);
        tree_node(p, args[i])->next = i + 1 < num_args ? args[i + 1] : 0;
        unsigned h = p->origins.items[args[i] - p->first_node].height;
        height = h > height ? h : height;
    }
    if (height < PARSE_MAX_DEPTH)
        return height + 1;
    PARSE_ERROR(p, parse_where(p, place, 0), lang_limit,
                parse_say(p, "the expression has more than %d levels; give its parts names",
                          PARSE_MAX_DEPTH));
    p->panic = true;
    return 0;
}

static bool all_literals(struct parser *p, const lang_ref *args, unsigned num_args)
{
    for (unsigned i = 0; i < num_args; i++)
        if (tree_node(p, args[i])->kind != LANG_CONST)
            return false;
    return true;
}

lang_ref tree_op(struct parser *p, enum ir_op op, ir_type_id type, uint32_t attr,
                 const lang_ref *args, unsigned num_args, uint32_t place)
{
    assert(num_args > 0);
    unsigned height = chain_operands(p, args, num_args, place);
    if (!height)
        return 0;
    lang_ref ref =
        push(p,
             (struct lang_node){
                 .kind = LANG_OP, .op = (uint8_t)op, .type = type, .a = args[0], .b = attr},
             height, place);
    struct ir_value value;
    if (!all_literals(p, args, num_args) || !check_value(p, ref, &value))
        return ref;
    p->unit->nodes.len--;
    p->origins.len--;
    return tree_const(p, &value, place);
}

lang_ref tree_call(struct parser *p, uint32_t function, ir_type_id type, const lang_ref *args,
                   unsigned num_args, uint32_t place)
{
    unsigned height = chain_operands(p, args, num_args, place);
    if (!height)
        return 0;
    return push(p,
                (struct lang_node){.kind = LANG_CALL,
                                   .op = IR_NUM_OPS,
                                   .type = type,
                                   .a = function,
                                   .b = num_args ? args[0] : 0},
                height, place);
}

lang_ref tree_swizzle(struct parser *p, lang_ref a, const uint8_t *components, unsigned count,
                      uint32_t place)
{
    assert(count >= 1 && count <= 4);
    uint32_t attr = (uint32_t)count << 8;
    for (unsigned i = 0; i < count; i++)
        attr |= (uint32_t)components[i] << (2 * i);
    return tree_op(p, IR_SWIZZLE, ir_type_vector(ir_type_scalar(tree_type(p, a)), count), attr, &a,
                   1, place);
}

void tree_append(struct parser *p, struct tree_chain *chain, lang_ref ref)
{
    if (!ref)
        return;
    assert(!chain->first == !chain->last);
    if (chain->last)
        tree_node(p, chain->last)->next = ref;
    else
        chain->first = ref;
    chain->last = ref;
}

void tree_join(struct parser *p, struct tree_chain *chain, struct tree_chain more)
{
    if (!more.first)
        return;
    tree_append(p, chain, more.first);
    chain->last = more.last;
}
