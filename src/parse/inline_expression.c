// SPDX-License-Identifier: Apache-2.0
/* Inline expressions: a text of one expression, which becomes a function. */
#include "parse/parse_priv.h"

#include <assert.h>

static void declare_inputs(struct parser *p, const struct lang_input *inputs, unsigned num_inputs)
{
    p->inputs = inputs;
    p->num_inputs = num_inputs;
    p->first_slot = p->unit->slots.len;
    for (unsigned i = 0; i < num_inputs; i++)
        vec_push(p->unit->arena, &p->unit->slots,
                 (struct lang_slot){.name = inputs[i].name, .type = inputs[i].type});
}

static lang_ref parse_whole_expression(struct parser *p, ir_type_id type)
{
    lang_ref value = parse_expression(p);
    if (p->token.kind != TOKEN_END)
        parse_unexpected(p, "an operator or the end of the expression");
    if (!value || p->num_errors)
        return 0;
    return type == IR_TYPE_VOID ? value : check_convert(p, value, type, "the expression");
}

uint32_t lang_parse_expression(struct lang_unit *unit, const char *text, size_t len,
                               const struct lang_input *inputs, unsigned num_inputs,
                               ir_type_id type, uint32_t file, struct diag_place where,
                               struct diag_list *diags)
{
    struct parse_mark mark = parse_mark(unit);
    struct parser p;
    parse_init(&p, unit, diags);
    if (file != LANG_NONE) {
        const struct lang_unit *layer;
        const struct lang_file *seen = lang_file(unit, file, &layer);
        vec_push(unit->arena, &p.visible, file);
        for (uint32_t i = 0; i < seen->num_includes; i++)
            vec_push(unit->arena, &p.visible, layer->refs.items[seen->first_include + i]);
    }
    parse_begin(&p, where.file, text, len, where.line ? where.line : 1,
                where.column ? where.column : 1, true);
    declare_inputs(&p, inputs, num_inputs);
    assert(unit->slots.len == p.first_slot + num_inputs);
    uint32_t place = parse_place(&p.token);

    lang_ref value = parse_whole_expression(&p, type);
    assert(p.depth == 0 && p.operands.len == 0);
    if (!value) {
        parse_roll_back(unit, &mark);
        return LANG_NONE;
    }
    lang_ref result = tree_new(&p, LANG_RETURN, IR_NUM_OPS, IR_TYPE_VOID, place);
    tree_node(&p, result)->a = value;
    lang_ref body = tree_new(&p, LANG_BLOCK, IR_NUM_OPS, IR_TYPE_VOID, place);
    tree_node(&p, body)->a = result;
    vec_push(unit->arena, &unit->functions,
             (struct lang_function){.flags = LANG_FN_EXPRESSION,
                                    .return_type = tree_type(&p, value),
                                    .num_params = (uint16_t)num_inputs,
                                    .num_slots = (uint16_t)num_inputs,
                                    .first_slot = p.first_slot,
                                    .body = body,
                                    .file = file,
                                    .place = place});
    check_finish_functions(&p, unit->base_functions + unit->functions.len - 1);
    return unit->base_functions + unit->functions.len - 1;
}
