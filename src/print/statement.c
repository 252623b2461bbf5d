// SPDX-License-Identifier: Apache-2.0
/* Printing functions: statements. */
#include "print/print_priv.h"
#include "tree/walk.h"

#include <assert.h>

static void print_statement(struct printer *p, const struct lang_node *node);

void print_indent(struct printer *p)
{
    static const char spaces[] = "                                ";
    size_t left = p->indent * 4u;
    for (; left > sizeof spaces - 1; left -= sizeof spaces - 1)
        text_mem(p->out, spaces, sizeof spaces - 1);
    text_mem(p->out, spaces, left);
}

static void print_declaration(struct printer *p, const struct lang_node *node)
{
    bool is_value = node->b && !ast_slot(p->layer, p->fn, node->a)->assigned;
    print_bring_into_scope(p, node->a);
    print_variable(p, is_value ? PHRASE_VALUE : PHRASE_LOCAL, node->a);
    if (node->b) {
        text_mem(p->out, " = ", 3);
        print_initialiser(p, node_at(p, node->b));
    }
}

static bool is_int_one(const struct printer *p, lang_ref ref)
{
    const struct lang_node *node = node_at(p, ref);
    return node->kind == LANG_CONST && node->type == IR_TYPE_INT
           && ast_words(p->layer, node)->i == 1;
}

/* Writes x = x + y if the target has its own + for these types. */
static bool print_typed_assignment(struct printer *p, const struct lang_node *node)
{
    if (!p->is_typed || node->op == IR_NUM_OPS)
        return false;
    const struct lang_node *operands[] = {node_at(p, node->a), node_at(p, node->b)};
    const struct lang_pieces *form =
        print_typed_form(p, node->op, 0, operands[0]->type, operands, 2);
    if (!form)
        return false;
    print_expression(p, operands[0], LANG_PREC_UNARY);
    text_mem(p->out, " = ", 3);
    print_form(p, form, operands[0]->type, operands);
    return true;
}

/* The value of an assignment: of `a += b` it is a + b. */
static void print_assigned(struct printer *p, const struct lang_node *node)
{
    const struct lang_node *operands[] = {node_at(p, node->a), node_at(p, node->b)};
    if (node->op == IR_NUM_OPS) {
        print_expression(p, operands[1], LANG_PREC_ASSIGN);
        return;
    }
    const struct lang_pieces *form =
        print_typed_form(p, node->op, 0, operands[0]->type, operands, 2);
    print_form(p, form ? form : lang_style_form(p->style, node->op), operands[0]->type, operands);
}

/* Writes whole = with_parts(whole, value) if the target cannot assign these parts. */
static bool print_part_assignment(struct printer *p, const struct lang_node *node)
{
    const struct lang_node *target = node_at(p, node->a);
    bool is_swizzle = target->op == IR_SWIZZLE;
    if (!p->is_typed || target->kind != LANG_OP || (!is_swizzle && target->op != IR_INDEX))
        return false;
    const struct lang_node *whole = node_at(p, target->a), *operands[] = {whole, whole, whole};
    unsigned n = is_swizzle ? 2 : 3;
    operands[1] = is_swizzle ? whole : node_at(p, whole->next);
    ir_type_id types[] = {whole->type, operands[1]->type, target->type};
    types[n - 1] = target->type;
    struct lang_use use = {.op = target->op,
                           .type = whole->type,
                           .attr = target->b,
                           .operands = types,
                           .num_operands = n,
                           .is_store = true};
    const struct lang_pieces *form =
        lang_typed_form(p->style->syntax, p->names, &use, p->out->arena);
    if (!form)
        return false;
    print_expression(p, whole, LANG_PREC_UNARY);
    text_mem(p->out, " = ", 3);
    for (unsigned i = 0; i < form->num; i++) {
        text_put(p->out, form->pieces[i].before);
        if (form->pieces[i].index + 1u == n)
            print_assigned(p, node);
        else
            print_expression(p, operands[form->pieces[i].index], LANG_PREC_ASSIGN);
    }
    text_put(p->out, form->rest);
    return true;
}

/* The form of a value that reads the variable to which it is assigned; NULL: it needs none. */
static const struct lang_pieces *own_value_form(struct printer *p, const struct lang_node *node)
{
    const struct lang_node *target = node_at(p, node->a);
    if (!p->is_typed || node->op != IR_NUM_OPS || target->kind != LANG_VAR
        || !lang_names_slot(p->layer, node->b, target->a))
        return NULL;
    struct lang_use use = {.op = IR_NUM_OPS,
                           .type = target->type,
                           .operands = &target->type,
                           .num_operands = 1,
                           .is_store = true};
    return lang_typed_form(p->style->syntax, p->names, &use, p->out->arena);
}

/* Writes a phrase with an expression. */
static void print_around(struct printer *p, enum lang_phrase phrase, lang_ref operand,
                         enum lang_precedence least)
{
    const char *rest = p->style->phrases[phrase];
    while (lang_next(&rest, p->out))
        print_expression(p, node_at(p, operand), least);
}

static void print_assignment(struct printer *p, const struct lang_node *node)
{
    if (print_part_assignment(p, node))
        return;
    if (print_typed_assignment(p, node))
        return;
    if ((node->op == IR_ADD || node->op == IR_SUB) && is_int_one(p, node->b)) {
        print_around(p, node->op == IR_ADD ? PHRASE_INCREMENT : PHRASE_DECREMENT, node->a,
                     LANG_PREC_UNARY);
        return;
    }
    print_expression(p, node_at(p, node->a), LANG_PREC_UNARY);
    const struct lang_pieces *form =
        node->op == IR_NUM_OPS ? NULL : lang_style_form(p->style, node->op);
    assert(!form || !form->infix || form->num == 2);
    text_char(p->out, ' ');
    if (form && form->infix) /* the operator is the text between "$0 " and " $1" */
        text_mem(p->out, form->text + 3, form->pieces[1].before.len - 2);
    text_mem(p->out, "= ", 2);
    if (form && !form->infix) { /* the form is no infix operator: x = f(x, y) */
        print_form(p, form, node_at(p, node->a)->type,
                   (const struct lang_node *[]){node_at(p, node->a), node_at(p, node->b)});
        return;
    }
    const struct lang_node *value = node_at(p, node->b);
    const struct lang_pieces *own = own_value_form(p, node);
    if (own)
        print_form(p, own, value->type, &value);
    else
        print_expression(p, value, LANG_PREC_ASSIGN);
}

/* Writes a statement without indentation, ';' and newline, also in the head of a `for`. */
static void print_simple(struct printer *p, const struct lang_node *node)
{
    switch (node->kind) {
    case LANG_DECLARE: print_declaration(p, node); break;
    case LANG_ASSIGN: print_assignment(p, node); break;
    case LANG_EXPR: print_expression(p, node_at(p, node->a), LANG_PREC_ASSIGN); break;
    case LANG_RETURN:
        if (p->has_results) {
            print_return_results(p, p->id, node->a);
            break;
        }
        text_str(p->out, node->a ? "return " : "return");
        if (node->a)
            print_expression(p, node_at(p, node->a), LANG_PREC_ASSIGN);
        break;
    case LANG_BREAK: text_str(p->out, "break"); break;
    default: assert(node->kind == LANG_CONTINUE); text_str(p->out, "continue");
    }
}

/* The expression that a statement evaluates once, before anything else; 0: it has none. */
static lang_ref evaluated(const struct lang_node *node, lang_ref ref)
{
    switch (node->kind) {
    case LANG_IF: return node->a;
    case LANG_DECLARE:
    case LANG_ASSIGN:
    case LANG_EXPR:
    case LANG_RETURN: return ref;
    default: return 0;
    }
}

/* A statement after the calls that it needs; an expression is such a call itself. */
static void print_with_calls(struct printer *p, const struct lang_node *node)
{
    bool has_calls = print_result_calls(p, evaluated(node, (lang_ref)(node - node_at(p, 0))));
    if (node->kind != LANG_EXPR || !has_calls)
        print_statement(p, node);
}

static void print_statements(struct printer *p, lang_ref first)
{
    for (lang_ref ref = first; ref;) {
        const struct lang_node *node = node_at(p, ref);
        print_with_calls(p, node);
        ref = node->next;
    }
}

void print_body(struct printer *p, const struct lang_node *body)
{
    uint32_t mark = p->num_visible;
    p->indent++;
    if (body && body->kind == LANG_BLOCK)
        print_statements(p, body->a);
    else if (body)
        print_with_calls(p, body);
    p->indent--;
    assert(p->num_visible >= mark);
    p->num_visible = mark;
}

/* The only statement of a body, or 0. */
static lang_ref only_statement(const struct printer *p, lang_ref body)
{
    const struct lang_node *node = body ? node_at(p, body) : NULL;
    if (!node || node->kind != LANG_BLOCK)
        return body;
    return node->a && !node_at(p, node->a)->next ? node->a : 0;
}

/*
 * A single plain statement needs no braces. Compound statements keep them, which also decides the
 * `if` of an `else`.
 */
static bool needs_braces(const struct printer *p, lang_ref body)
{
    if (p->style->syntax->always_braces)
        return true;
    lang_ref only = only_statement(p, body);
    unsigned kind = only ? node_at(p, only)->kind : LANG_BLOCK;
    return kind == LANG_BLOCK || kind == LANG_IF || kind == LANG_FOR || kind == LANG_WHILE
           || kind == LANG_DO || kind == LANG_DECLARE;
}

/*
 * Writes the end of a head like "if (x)", and its body. The line stays open after the closing
 * brace.
 */
static void print_governed(struct printer *p, lang_ref body, bool braces)
{
    text_str(p->out, braces ? " {\n" : "\n");
    print_body(p, body ? node_at(p, body) : NULL);
    if (braces) {
        print_indent(p);
        text_char(p->out, '}');
    }
}

static lang_ref else_if(const struct printer *p, const struct lang_node *node)
{
    lang_ref only = node->c ? only_statement(p, node->c) : 0;
    return only && node_at(p, only)->kind == LANG_IF ? only : 0;
}

/* The `if` of an `else` whose condition needs no statements before it; 0: there is none. */
static lang_ref chained_if(struct printer *p, const struct lang_node *node)
{
    lang_ref next = else_if(p, node);
    return next && !print_has_result_calls(p, node_at(p, next)->a) ? next : 0;
}

/* If one branch of a chain needs braces, all have them. */
static bool chain_needs_braces(struct printer *p, const struct lang_node *node)
{
    for (;;) {
        lang_ref next = chained_if(p, node);
        if (needs_braces(p, node->b) || (node->c && !next && needs_braces(p, node->c)))
            return true;
        if (!next)
            return false;
        node = node_at(p, next);
    }
}

static void print_if(struct printer *p, const struct lang_node *node)
{
    bool braces = chain_needs_braces(p, node);
    for (;;) {
        text_str(p->out, "if (");
        print_expression(p, node_at(p, node->a), LANG_PREC_COMMA);
        text_char(p->out, ')');
        print_governed(p, node->b, braces);
        if (!node->c)
            break;
        if (braces)
            text_char(p->out, ' ');
        else
            print_indent(p);
        text_str(p->out, "else");
        lang_ref next = chained_if(p, node);
        if (!next) {
            print_governed(p, node->c, braces);
            break;
        }
        text_char(p->out, ' ');
        node = node_at(p, next);
    }
    if (braces)
        text_char(p->out, '\n');
}

/* Writes the head of a `for`; a part that is absent needs no space before it. */
static void print_for_head(struct printer *p, const struct lang_node *node)
{
    const char *rest = p->style->phrases[PHRASE_FOR];
    lang_ref parts[] = {node->a, node->b, node_at(p, node->c)->b};
    for (char mark; (mark = lang_next(&rest, p->out));) {
        lang_ref part = parts[mark - '0'];
        if (!part)
            p->out->len -= p->out->data[p->out->len - 1] == ' ';
        else if (mark == '1')
            print_expression(p, node_at(p, part), LANG_PREC_COMMA);
        else
            print_simple(p, node_at(p, part));
    }
}

static void print_for(struct printer *p, const struct lang_node *node)
{
    uint32_t mark = p->num_visible;
    print_for_head(p, node);
    bool braces = needs_braces(p, node->c);
    print_governed(p, node->c, braces);
    if (braces)
        text_char(p->out, '\n');
    assert(p->num_visible >= mark);
    p->num_visible = mark;
}

static void print_while(struct printer *p, const struct lang_node *node)
{
    assert(node_at(p, node->c)->kind == LANG_BLOCK);
    print_around(p, PHRASE_WHILE, node->b, LANG_PREC_COMMA);
    bool braces = needs_braces(p, node->c);
    print_governed(p, node->c, braces);
    if (braces)
        text_char(p->out, '\n');
}

static void print_do(struct printer *p, const struct lang_node *node)
{
    assert(node_at(p, node->c)->kind == LANG_BLOCK);
    text_str(p->out, p->style->phrases[PHRASE_DO]);
    text_char(p->out, '\n');
    print_body(p, node_at(p, node->c));
    print_indent(p);
    print_around(p, PHRASE_DO_END, node->b, LANG_PREC_COMMA);
    text_char(p->out, '\n');
}

/* ---- Loops whose heads have calls of results.c ---- */

static void print_line(struct printer *p, const char *before, const char *name, const char *after)
{
    print_indent(p);
    text_fmt(p->out, "%s%s%s\n", before, name, after);
}

/* Leaves the loop unless the condition is true. */
static void print_exit(struct printer *p, lang_ref condition)
{
    (void)print_result_calls(p, condition);
    print_indent(p);
    text_str(p->out, "if (!(");
    print_expression(p, node_at(p, condition), LANG_PREC_COMMA);
    text_str(p->out, ")) {\n");
    p->indent++;
    print_line(p, "break;", "", "");
    p->indent--;
    print_line(p, "}", "", "");
}

/* Writes the part between two rounds: the step of a `for`, the condition of a `do`. */
static void print_between(struct printer *p, const struct lang_node *loop, const char *again)
{
    lang_ref step = ast_step(p->layer, loop);
    print_line(p, "if (", again, ") {");
    p->indent++;
    if (step)
        print_with_calls(p, node_at(p, step));
    else
        print_exit(p, loop->b);
    p->indent--;
    print_line(p, "}", "", "");
    print_line(p, again, " = true;", "");
}

/*
 * Writes a loop whose head has such calls, with the head in the body. false: it has none.
 *
 *     bool again = false;
 *     while (true) {
 *         if (again) { … }
 *         again = true;
 *         if (!(condition)) { break; }
 *         …
 *     }
 */
static bool print_loop_with_calls(struct printer *p, const struct lang_node *loop)
{
    lang_ref init = loop->kind == LANG_FOR ? loop->a : 0, step = ast_step(p->layer, loop);
    if (!print_has_result_calls(p, loop->b) && !print_has_result_calls(p, init)
        && !print_has_result_calls(p, step))
        return false;
    uint32_t mark = p->num_visible;
    const char *again = step || loop->kind == LANG_DO ? print_result_name(p) : NULL;
    text_str(p->out, "{\n");
    p->indent++;
    if (init)
        print_with_calls(p, node_at(p, init));
    if (again)
        print_line(p, "bool ", again, " = false;");
    print_line(p, "while (true) {", "", "");
    p->indent++;
    if (again)
        print_between(p, loop, again);
    if (loop->kind != LANG_DO && loop->b)
        print_exit(p, loop->b);
    p->indent--;
    print_body(p, node_at(p, loop->c));
    print_line(p, "}", "", "");
    p->indent--;
    print_line(p, "}", "", "");
    p->num_visible = mark;
    return true;
}

/*
 * Writes "{ float made[2] = {a, b}; x = made; }". In these languages, braces initialise a variable,
 * but are no value for an assignment.
 */
static bool print_array_assignment(struct printer *p, const struct lang_node *node)
{
    const struct lang_node *value = node->kind == LANG_ASSIGN ? node_at(p, node->b) : NULL;
    bool is_array = value && value->kind == LANG_OP && value->op == IR_CONSTRUCT
                    && ast_is_user_type(value->type)
                    && lang_user_type(p->unit, value->type, NULL)->array_length;
    if (!is_array || !p->style->syntax->array_braces || p->style->phrases[PHRASE_ARRAY])
        return false;
    struct text_word made = print_free_name(p, lang_word("made"));
    text_str(p->out, "{ ");
    lang_print_variable(p->style, p->names, p->unit, PHRASE_LOCAL, value->type, made, p->out);
    text_str(p->out, " = ");
    print_initialiser(p, value);
    text_str(p->out, "; ");
    print_expression(p, node_at(p, node->a), LANG_PREC_UNARY);
    text_fmt(p->out, " = %s; }\n", made.bytes);
    return true;
}

static void print_statement(struct printer *p, const struct lang_node *node)
{
    print_indent(p);
    bool is_loop = node->kind == LANG_FOR || node->kind == LANG_WHILE || node->kind == LANG_DO;
    if (print_array_assignment(p, node) || (is_loop && print_loop_with_calls(p, node)))
        return;
    switch (node->kind) {
    case LANG_IF: print_if(p, node); break;
    case LANG_FOR: print_for(p, node); break;
    case LANG_WHILE: print_while(p, node); break;
    case LANG_DO: print_do(p, node); break;
    case LANG_BLOCK:
        text_str(p->out, "{\n");
        print_body(p, node);
        print_indent(p);
        text_str(p->out, "}\n");
        break;
    default: print_simple(p, node); text_str(p->out, ";\n");
    }
}
