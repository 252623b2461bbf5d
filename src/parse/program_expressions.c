// SPDX-License-Identifier: Apache-2.0
/* Expressions with effects, which a program has beside the portable language: parse.h. */
#include "parse/parse_priv.h"
#include "tree/walk.h"

/* ---- Steps inside of expressions ---- */

/* Another tree of a variable or of a member of one. */
static lang_ref read_again(struct parser *p, lang_ref target)
{
    const struct lang_node node = *tree_node(p, target);
    uint32_t place = tree_place(p, target);
    if (node.kind == LANG_OP && node.op == IR_MEMBER) {
        lang_ref whole = read_again(p, node.a);
        return whole ? tree_op(p, IR_MEMBER, node.type, node.b, &whole, 1, place) : 0;
    }
    if (node.kind != LANG_VAR && node.kind != LANG_GLOBAL) {
        PARSE_TYPE_ERROR(p, place, "only a variable or its member steps inside of an expression");
        return 0;
    }
    lang_ref ref = tree_new(p, (enum lang_kind)node.kind, IR_NUM_OPS, node.type, place);
    tree_node(p, ref)->a = node.a;
    return ref;
}

/* Declares a local before the statement: "uint kept = reader.next". value: 0: without one. */
static uint32_t keep_value(struct parser *p, ir_type_id type, lang_ref value, uint32_t place)
{
    struct local *local =
        parse_add_local(p, &p->last, str_intern_z(p->unit->strings, "kept"), type, false);
    uint32_t slot = local->slot;
    local->name = 0; /* no text of the program means it */
    lang_ref ref = tree_new(p, LANG_DECLARE, IR_NUM_OPS, IR_TYPE_VOID, place);
    tree_node(p, ref)->a = slot;
    tree_node(p, ref)->b = value;
    tree_append(p, &p->before, ref);
    return slot;
}

static lang_ref read_kept(struct parser *p, uint32_t slot, ir_type_id type, uint32_t place)
{
    lang_ref ref = tree_new(p, LANG_VAR, IR_NUM_OPS, type, place);
    tree_node(p, ref)->a = slot;
    return ref;
}

static void step(struct parser *p, enum token_kind kind, lang_ref target, uint32_t place)
{
    struct ir_value one = ir_value_int(1);
    tree_append(p, &p->before,
                check_assign(p, (enum ir_op)lex_symbol(kind)->op, target,
                             tree_const(p, &one, place), place));
}

lang_ref parse_step_inside(struct parser *p, enum token_kind kind, lang_ref target, bool is_prefix,
                           uint32_t place)
{
    ir_type_id type = tree_type(p, target);
    lang_ref again = read_again(p, target);
    if (!again)
        return 0;
    if (is_prefix)
        step(p, kind, target, place);
    uint32_t slot = keep_value(p, type, again, place);
    if (!is_prefix)
        step(p, kind, target, place);
    return read_kept(p, slot, type, place);
}

/* ---- Choices whose arms have effects ---- */

/* A block that sets the local: "{ kept = value; }". */
static lang_ref block_with(struct parser *p, uint32_t slot, lang_ref value, uint32_t place)
{
    lang_ref target = read_kept(p, slot, tree_type(p, value), place),
             assign = check_assign(p, IR_NUM_OPS, target, value, place),
             block = tree_new(p, LANG_BLOCK, IR_NUM_OPS, IR_TYPE_VOID, place);
    tree_node(p, block)->a = assign;
    return block;
}

lang_ref parse_choice(struct parser *p, lang_ref choice)
{
    const struct lang_node node = *tree_node(p, choice);
    if (node.kind != LANG_OP || node.op != IR_SELECT)
        return choice;
    lang_ref yes = tree_node(p, node.a)->next, no = tree_node(p, yes)->next;
    if (!lang_has_effects(p->unit, yes) && !lang_has_effects(p->unit, no))
        return choice;
    uint32_t place = tree_place(p, choice), slot = keep_value(p, node.type, 0, place);
    tree_node(p, node.a)->next = tree_node(p, yes)->next = 0;
    lang_ref yes_block = block_with(p, slot, yes, place), no_block = block_with(p, slot, no, place),
             ref = tree_new(p, LANG_IF, IR_NUM_OPS, IR_TYPE_VOID, place);
    struct lang_node *branch = tree_node(p, ref);
    branch->a = node.a;
    branch->b = yes_block;
    branch->c = no_block;
    tree_append(p, &p->before, ref);
    return read_kept(p, slot, node.type, place);
}

void parse_flush(struct parser *p, struct tree_chain *chain)
{
    tree_join(p, chain, p->before);
    p->before = (struct tree_chain){0};
}
