// SPDX-License-Identifier: Apache-2.0
/*
 * Functions of languages without parameters for results. The results are locals of the function,
 * which returns a struct of them; a call stands before the statement that it is part of:
 *
 *     mdl_results_f mdl_r1 = f(x);
 *     a = mdl_r1.a;
 *     y = 2.0 * mdl_r1.value;
 */
#include "print/print_priv.h"
#include "tree/walk.h"

#include <assert.h>

const char *lang_results_name(const struct lang_syntax *syntax, const char *function,
                              struct arena *arena)
{
    struct text name;
    text_init(&name, arena);
    const char *end = strstr(function, LANG_OF_MODULE),
               *own = end ? end + strlen(LANG_OF_MODULE) : function;
    text_mem(&name, function, (size_t)(own - function));
    text_fmt(&name, "%sresults_%s", syntax->reserved_prefix, own);
    return text_cstr(&name);
}

bool lang_has_results(const struct lang_syntax *syntax, const struct lang_unit *unit, uint32_t id)
{
    const struct lang_function *fn = lang_function(unit, id, NULL);
    bool has = false;
    for (uint32_t i = 0; syntax->results_in_struct && i < fn->num_params; i++)
        has |= ast_param_mode(unit, id, i) != LANG_IN;
    return has;
}

static const char *struct_name(struct printer *p, uint32_t id)
{
    return lang_results_name(p->style->syntax, print_function_name(p->names, p->unit, id),
                             p->out->arena);
}

struct lang_type_text print_results_type(struct printer *p, uint32_t id)
{
    return (struct lang_type_text){lang_word(struct_name(p, id)), 0};
}

/* The member for a parameter, by its name in the source. */
static const char *member_of(struct printer *p, const struct lang_slot *param)
{
    return lang_member_name(p->style, p->unit->strings, param->name);
}

static void print_member(struct printer *p, ir_type_id type, const char *name)
{
    text_str(p->out, "    ");
    lang_print_variable(p->style, p->names, p->unit, PHRASE_MEMBER, type, lang_word(name), p->out);
    text_char(p->out, '\n');
}

void print_results_struct(struct printer *p, uint32_t id)
{
    text_fmt(p->out, "%sstruct %s {\n", p->style->exports, struct_name(p, id));
    if (p->fn->return_type != IR_TYPE_VOID)
        print_member(p, p->fn->return_type, LANG_RESULTS_VALUE);
    for (uint32_t i = 0; i < p->fn->num_params; i++) {
        const struct lang_slot *param = ast_slot(p->layer, p->fn, i);
        if (param->mode != LANG_IN)
            print_member(p, param->type, member_of(p, param));
    }
    text_fmt(p->out, "%s\n", p->style->phrases[PHRASE_STRUCT_END]);
}

void print_result_locals(struct printer *p)
{
    for (uint32_t i = 0; i < p->fn->num_params; i++) {
        if (ast_slot(p->layer, p->fn, i)->mode != LANG_OUT)
            continue;
        text_str(p->out, "    ");
        print_variable(p, PHRASE_LOCAL, i);
        text_str(p->out, ";\n");
    }
}

void print_return_results(struct printer *p, uint32_t id, lang_ref value)
{
    bool is_first = !value;
    text_fmt(p->out, "return %s(", struct_name(p, id));
    if (value)
        print_expression(p, node_at(p, value), lang_argument_level(p->style->syntax));
    for (uint32_t i = 0; i < p->fn->num_params; i++) {
        if (ast_slot(p->layer, p->fn, i)->mode == LANG_IN)
            continue;
        text_str(p->out, is_first ? "" : ", ");
        text_put(p->out, p->locals[i]);
        is_first = false;
    }
    text_char(p->out, ')');
}

/* ---- Calls ---- */

static bool is_result_call(const struct printer *p, const struct lang_node *node)
{
    return node->kind == LANG_CALL && lang_has_results(p->style->syntax, p->unit, node->a);
}

static bool is_plain(void *user_data, lang_ref ref, unsigned access)
{
    struct printer *p = user_data;
    (void)access;
    return !is_result_call(p, node_at(p, ref));
}

bool print_has_result_calls(struct printer *p, lang_ref expression)
{
    return p->style->syntax->results_in_struct
           && !lang_walk(p->layer, expression, LANG_READ, is_plain, p);
}

const char *print_result_name(struct printer *p)
{
    struct text name;
    text_init(&name, p->out->arena);
    text_fmt(&name, "%sr%u", p->style->syntax->reserved_prefix, (unsigned)++p->num_results);
    return text_cstr(&name);
}

static void assign_results(struct printer *p, const struct lang_node *call, const char *made)
{
    const struct lang_unit *layer;
    const struct lang_function *callee = lang_function(p->unit, call->a, &layer);
    lang_ref ref = call->b;
    for (uint32_t i = 0; ref; i++) {
        const struct lang_node *argument = node_at(p, ref);
        const struct lang_slot *param = ast_slot(layer, callee, i);
        ref = argument->next;
        if (param->mode == LANG_IN)
            continue;
        print_indent(p);
        print_expression(p, argument, LANG_PREC_UNARY);
        text_fmt(p->out, " = %s.%s;\n", made, member_of(p, param));
    }
}

static void print_call(struct printer *p, const struct lang_node *call)
{
    const char *made = print_result_name(p);
    struct text value;
    print_indent(p);
    text_fmt(p->out, "%s %s = %s(", struct_name(p, call->a), made,
             print_function_name(p->names, p->unit, call->a));
    print_arguments(p, call);
    text_str(p->out, ");\n");
    assign_results(p, call, made);
    text_init(&value, p->out->arena);
    text_fmt(&value, "%s." LANG_RESULTS_VALUE, made);
    vec_push(p->out->arena, &p->values, (struct printed_value){call, text_cstr(&value)});
}

static void print_calls_of(struct printer *p, lang_ref ref);

/* "bool mdl_r1 = a; if (mdl_r1) { …; mdl_r1 = b; }": a && b, whose right side is not always
 * evaluated. */
static void print_logic(struct printer *p, const struct lang_node *node)
{
    const struct lang_node *left = node_at(p, node->a), *right = node_at(p, left->next);
    print_calls_of(p, node->a);
    const char *made = print_result_name(p);
    print_indent(p);
    text_fmt(p->out, "bool %s = ", made);
    print_expression(p, left, LANG_PREC_ASSIGN);
    text_str(p->out, ";\n");
    print_indent(p);
    text_fmt(p->out, node->op == IR_LAND ? "if (%s) {\n" : "if (!%s) {\n", made);
    p->indent++;
    print_calls_of(p, left->next);
    print_indent(p);
    text_fmt(p->out, "%s = ", made);
    print_expression(p, right, LANG_PREC_ASSIGN);
    text_str(p->out, ";\n");
    p->indent--;
    print_indent(p);
    text_str(p->out, "}\n");
    vec_push(p->out->arena, &p->values, (struct printed_value){node, made});
}

/* The operands of an expression or simple statement, in the order in which they are evaluated. */
static lang_ref first_operand(const struct lang_node *node)
{
    switch (node->kind) {
    case LANG_OP:
    case LANG_EXPR:
    case LANG_RETURN:
    case LANG_ASSIGN: return node->a;
    case LANG_CALL:
    case LANG_DECLARE: return node->b;
    default: return 0;
    }
}

static void print_calls_of(struct printer *p, lang_ref ref)
{
    const struct lang_node *node = node_at(p, ref);
    if (!print_has_result_calls(p, ref))
        return;
    bool is_logic = node->kind == LANG_OP && (node->op == IR_LAND || node->op == IR_LOR);
    if (is_logic && print_has_result_calls(p, node_at(p, node->a)->next)) {
        print_logic(p, node);
        return;
    }
    for (lang_ref operand = first_operand(node); operand; operand = node_at(p, operand)->next)
        print_calls_of(p, operand);
    if (node->kind == LANG_ASSIGN)
        print_calls_of(p, node->b);
    if (is_result_call(p, node))
        print_call(p, node);
}

bool print_result_calls(struct printer *p, lang_ref ref)
{
    p->values.len = 0;
    if (!print_has_result_calls(p, ref))
        return false;
    print_calls_of(p, ref);
    return true;
}

bool print_result_value(struct printer *p, const struct lang_node *node)
{
    for (uint32_t i = 0; i < p->values.len; i++)
        if (p->values.items[i].node == node) {
            text_str(p->out, p->values.items[i].text);
            return true;
        }
    return false;
}
