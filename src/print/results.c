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
    text_fmt(&name, "%sresults_%s", syntax->reserved_prefix, function);
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
    text_fmt(p->out, "struct %s {\n", struct_name(p, id));
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

static const struct printed_call *find_call(const struct printer *p, const struct lang_node *call)
{
    for (uint32_t i = 0; i < p->num_calls; i++)
        if (p->calls[i].call == call)
            return &p->calls[i];
    return NULL;
}

static void print_indent(struct printer *p)
{
    for (unsigned i = 0; i < p->indent; i++)
        text_str(p->out, "    ");
}

static void assign_results(struct printer *p, const struct lang_node *call, uint32_t number)
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
        text_fmt(p->out, " = %sr%u.%s;\n", p->style->syntax->reserved_prefix, (unsigned)number,
                 member_of(p, param));
    }
}

/* The calls in the arguments come first. */
static bool visit(void *user_data, lang_ref ref, unsigned access)
{
    struct printer *p = user_data;
    const struct lang_node *node = node_at(p, ref);
    (void)access;
    if (node->kind == LANG_CALL && lang_has_results(p->style->syntax, p->unit, node->a)) {
        assert(p->num_calls < p->max_calls);
        p->calls[p->num_calls++] = (struct printed_call){node, 0};
    }
    return true;
}

static bool count(void *user_data, lang_ref ref, unsigned access)
{
    (void)ref;
    (void)access;
    ++*(uint32_t *)user_data;
    return true;
}

void print_result_calls(struct printer *p, lang_ref ref)
{
    if (!p->style->syntax->results_in_struct)
        return;
    p->max_calls = p->num_calls = 0;
    lang_walk(p->layer, ref, LANG_READ, count, &p->max_calls);
    p->calls = arena_alloc(p->out->arena, p->max_calls * sizeof *p->calls);
    lang_walk(p->layer, ref, LANG_READ, visit, p);
    for (uint32_t i = p->num_calls; i-- > 0;) {
        struct printed_call *made = &p->calls[i];
        uint32_t number = ++p->num_results;
        print_indent(p);
        text_fmt(p->out, "%s %sr%u = %s(", struct_name(p, made->call->a),
                 p->style->syntax->reserved_prefix, (unsigned)number,
                 print_function_name(p->names, p->unit, made->call->a));
        print_arguments(p, made->call);
        text_str(p->out, ");\n");
        assign_results(p, made->call, number);
        made->number = number;
    }
}

bool print_result_value(struct printer *p, const struct lang_node *call)
{
    const struct printed_call *made = find_call(p, call);
    if (made)
        text_fmt(p->out, "%sr%u." LANG_RESULTS_VALUE, p->style->syntax->reserved_prefix,
                 (unsigned)made->number);
    return made != NULL;
}
