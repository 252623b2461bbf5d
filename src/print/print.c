// SPDX-License-Identifier: Apache-2.0
/* Printing functions: statements and expressions of one tree in the syntax of a target. */
#include "print/print_priv.h"
#include "tree/walk.h"

#include <assert.h>

struct printer {
    struct lang_style *style;
    const struct lang_names *names;
    const struct lang_unit *unit, *layer;
    const struct lang_function *fn;
    struct text *out;
    struct text_word *locals; /* by slot: its name in the output */
    uint32_t *visible;        /* slots in scope, innermost last */
    uint32_t num_visible;
    unsigned indent;
    bool is_typed; /* the target has forms that depend on types */
};

static void print_expression(struct printer *p, const struct lang_node *node,
                             enum lang_precedence least);
static void print_statement(struct printer *p, const struct lang_node *node);

static inline const struct lang_node *node_at(const struct printer *p, lang_ref ref)
{
    return ast_node(p->layer, ref);
}

/*
 * Names. Pruning moves declarations into outer scopes, so names from separate scopes may collide.
 * The later one then gets another name.
 */

static bool is_same(const char *a, const char *b)
{
    return a[0] == b[0] && strcmp(a, b) == 0;
}

/* Takes the names at file scope that the function uses: of callees, then of globals. */
static uint32_t num_outer(const struct printer *p)
{
    return p->fn->num_callees + p->fn->num_globals;
}

static const char *outer_name(const struct printer *p, uint32_t index)
{
    assert(index < num_outer(p));
    uint32_t id = ast_callees(p->layer, p->fn)[index];
    return index < p->fn->num_callees ? print_function_name(p->names, p->unit, id)
                                      : print_global_name(p->names, p->unit, id);
}

static bool is_taken(const struct printer *p, struct text_word name)
{
    for (uint32_t i = 0; i < p->num_visible; i++)
        if (is_same(p->locals[p->visible[i]].bytes, name.bytes))
            return true;
    for (uint32_t i = 0; i < num_outer(p); i++)
        if (is_same(outer_name(p, i), name.bytes))
            return true;
    return lang_syntax_is_reserved(p->style->syntax, name.bytes, name.len);
}

/* Makes "x_", "x_2", "x_3" from x, and "x_2" from x_, because GLSL reserves "__". */
static struct text_word variant(struct printer *p, struct text_word name, uint32_t number)
{
    bool ends_low = name.len && name.bytes[name.len - 1] == '_';
    struct text text;
    text_init(&text, p->out->arena);
    text_put(&text, name);
    if (!ends_low)
        text_char(&text, '_');
    if (ends_low || number > 1)
        text_u32(&text, number + ends_low);
    text_cstr(&text);
    return (struct text_word){text.data, text.len};
}

static void bring_into_scope(struct printer *p, uint32_t slot)
{
    assert(slot < p->fn->num_slots && p->num_visible < p->fn->num_slots);
    str_id id = ast_slot(p->layer, p->fn, slot)->name;
    struct text_word own = {str_text(p->unit->strings, id), str_len(p->unit->strings, id)};
    struct text_word name = own;
    for (uint32_t number = 1; is_taken(p, name); number++)
        name = variant(p, own, number);
    p->locals[slot] = name;
    p->visible[p->num_visible++] = slot;
}

static void print_local(struct printer *p, uint32_t slot)
{
    assert(slot < p->fn->num_slots);
    text_put(p->out, p->locals[slot]);
}

static void print_variable(struct printer *p, uint32_t slot)
{
    ir_type_id type = ast_slot(p->layer, p->fn, slot)->type;
    print_base_type(p->style, p->names, p->unit, type, p->out);
    text_char(p->out, ' ');
    print_local(p, slot);
    print_lengths(p->unit, type, p->out);
}

/* Expressions */

static void print_list(struct printer *p, lang_ref ref)
{
    while (ref) {
        const struct lang_node *node = node_at(p, ref);
        print_expression(p, node, LANG_PREC_ASSIGN);
        if (node->type == IR_TYPE_SAMPLER && p->style->syntax->sampler_type) {
            text_str(p->out, ", ");
            print_expression(p, node, LANG_PREC_POSTFIX);
            text_str(p->out, LANG_SAMPLER_SUFFIX);
        }
        ref = node->next;
        if (ref)
            text_mem(p->out, ", ", 2);
    }
}

static void print_construct(struct printer *p, const struct lang_node *node)
{
    bool is_array =
        ast_is_user_type(node->type) && lang_user_type(p->unit, node->type, NULL)->array_length;
    bool is_struct = ast_is_user_type(node->type) && !is_array;
    const char *maker = is_struct ? print_maker(p->names, p->unit, node->type) : NULL;
    if (is_array) {
        print_open_array(p->style, p->names, p->unit, node->type, p->out);
    } else if (maker) {
        text_str(p->out, maker);
        text_char(p->out, '(');
    } else {
        lang_print_type(p->style, p->names, p->unit, node->type, p->out);
        text_char(p->out, '(');
    }
    print_list(p, node->a);
    text_char(p->out, is_array && p->style->syntax->array_braces ? '}' : ')');
}

static void print_swizzle(struct printer *p, const struct lang_node *node)
{
    assert(node->b >> 8 >= 1 && node->b >> 8 <= 4);
    print_expression(p, node_at(p, node->a), LANG_PREC_POSTFIX);
    text_char(p->out, '.');
    for (unsigned i = 0; i < node->b >> 8; i++)
        text_char(p->out, "xyzw"[node->b >> 2 * i & 3]);
}

static void print_member(struct printer *p, const struct lang_node *node)
{
    const struct lang_node *whole = node_at(p, node->a);
    print_expression(p, whole, LANG_PREC_POSTFIX);
    const struct lang_unit *layer;
    const struct ir_user_type *user = lang_user_type(p->unit, whole->type, &layer);
    assert(node->b < user->num_members);
    text_char(p->out, '.');
    text_str(p->out, lang_member_name(p->style, p->unit->strings,
                                      layer->members.items[user->first_member + node->b].name));
}

/* Writes a constant beside a vector as a vector if the style spreads constants (style.c). */
static inline void print_operand(struct printer *p, const struct lang_node *operand,
                                 ir_type_id wide, enum lang_precedence least)
{
    if (!wide || operand->kind != LANG_CONST || operand->type != IR_TYPE_FLOAT) {
        print_expression(p, operand, least);
        return;
    }
    print_type_name(p->style, p->names, wide, p->out);
    text_char(p->out, '(');
    print_expression(p, operand, LANG_PREC_ASSIGN);
    text_char(p->out, ')');
}

static void print_form(struct printer *p, const struct lang_pieces *form, ir_type_id type,
                       const struct lang_node *const *operands)
{
    bool is_vector = type >= IR_TYPE_VEC2 && type <= IR_TYPE_VEC4;
    ir_type_id wide = form->spreads && is_vector ? type : IR_TYPE_VOID;
    const struct lang_piece *piece = form->pieces, *end = piece + form->num;
    for (; piece < end; piece++) {
        if (piece->before.len)
            text_put(p->out, piece->before);
        if (piece->index == LANG_PIECE_TYPE)
            lang_print_type(p->style, p->names, p->unit, type, p->out);
        else
            print_operand(p, operands[piece->index], wide, (enum lang_precedence)piece->least);
    }
    if (form->rest.len)
        text_put(p->out, form->rest);
}

static void print_formed(struct printer *p, const struct lang_pieces *form,
                         const struct lang_node *node, const struct lang_node *const *operands,
                         enum lang_precedence least)
{
    bool parenthesised = form->precedence < least;
    if (parenthesised)
        text_char(p->out, '(');
    print_form(p, form, node->type, operands);
    if (parenthesised)
        text_char(p->out, ')');
}

static void print_op(struct printer *p, const struct lang_node *node, enum lang_precedence least)
{
    const struct lang_node *operands[4] = {node_at(p, node->a)};
    for (unsigned i = 1; i < 4 && operands[i - 1]->next; i++)
        operands[i] = node_at(p, operands[i - 1]->next);
    print_formed(p, lang_style_form(p->style, node->op), node, operands, least);
}

/* True if the text may repeat the expression. */
static bool is_named(const struct printer *p, const struct lang_node *node)
{
    while (node->kind == LANG_OP && node->op == IR_MEMBER)
        node = node_at(p, node->a);
    bool is_number = node->kind == LANG_CONST && !ast_is_user_type(node->type)
                     && ir_type_info(node->type)->components == 1;
    return node->kind == LANG_VAR || is_number;
}

/* The target's own form for the types of the operands; NULL: it has none. */
static const struct lang_pieces *typed_form(struct printer *p, enum ir_op op, uint32_t attr,
                                            ir_type_id type,
                                            const struct lang_node *const *operands,
                                            unsigned num_operands)
{
    assert(num_operands <= AST_MAX_OPERANDS);
    ir_type_id types[AST_MAX_OPERANDS];
    struct lang_use use = {
        .op = op, .type = type, .attr = attr, .operands = types, .num_operands = num_operands};
    for (unsigned i = 0; i < num_operands; i++) {
        types[i] = operands[i]->type;
        use.named |= (uint32_t)is_named(p, operands[i]) << i;
    }
    return p->names->form(p->names->user_data, &use);
}

static bool print_typed(struct printer *p, const struct lang_node *node, enum lang_precedence least)
{
    lang_ref refs[AST_MAX_OPERANDS];
    const struct lang_node *operands[AST_MAX_OPERANDS];
    unsigned n = ast_list(p->layer, node->a, refs, AST_MAX_OPERANDS);
    if (n > AST_MAX_OPERANDS) /* arrays and structs have no form that depends on types */
        return false;
    for (unsigned i = 0; i < n; i++)
        operands[i] = node_at(p, refs[i]);
    const struct lang_pieces *form = typed_form(p, node->op, node->b, node->type, operands, n);
    if (form)
        print_formed(p, form, node, operands, least);
    return form != NULL;
}

static void print_op_or_part(struct printer *p, const struct lang_node *node,
                             enum lang_precedence least)
{
    if (p->is_typed && print_typed(p, node, least))
        return;
    switch (node->op) {
    case IR_CONSTRUCT: print_construct(p, node); break;
    case IR_SWIZZLE: print_swizzle(p, node); break;
    case IR_MEMBER: print_member(p, node); break;
    default: print_op(p, node, least);
    }
}

static void print_expression(struct printer *p, const struct lang_node *node,
                             enum lang_precedence least)
{
    switch (node->kind) {
    case LANG_CONST:
        lang_print_value(p->style, p->unit->strings, node->type, ast_words(p->layer, node), least,
                         p->out);
        break;
    case LANG_VAR: print_local(p, node->a); break;
    case LANG_GLOBAL: text_str(p->out, print_global_name(p->names, p->unit, node->a)); break;
    case LANG_INPUT:
        text_str(p->out, "{{");
        text_str(p->out, str_text(p->unit->strings, ast_slot(p->layer, p->fn, node->a)->name));
        text_str(p->out, "}}");
        break;
    case LANG_CALL:
        text_str(p->out, print_function_name(p->names, p->unit, node->a));
        text_char(p->out, '(');
        print_list(p, node->b);
        text_char(p->out, ')');
        break;
    default: print_op_or_part(p, node, least);
    }
}

/* Statements */

static void print_indent(struct printer *p)
{
    static const char spaces[] = "                                ";
    size_t left = p->indent * 4u;
    for (; left > sizeof spaces - 1; left -= sizeof spaces - 1)
        text_mem(p->out, spaces, sizeof spaces - 1);
    text_mem(p->out, spaces, left);
}

static void print_declaration(struct printer *p, const struct lang_node *node)
{
    bring_into_scope(p, node->a);
    print_variable(p, node->a);
    if (node->b) {
        text_mem(p->out, " = ", 3);
        print_expression(p, node_at(p, node->b), LANG_PREC_ASSIGN);
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
    const struct lang_pieces *form = typed_form(p, node->op, 0, operands[0]->type, operands, 2);
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
    const struct lang_pieces *form = typed_form(p, node->op, 0, operands[0]->type, operands, 2);
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
    const struct lang_pieces *form = p->names->form(p->names->user_data, &use);
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
    return p->names->form(p->names->user_data, &use);
}

static void print_assignment(struct printer *p, const struct lang_node *node)
{
    if (print_part_assignment(p, node))
        return;
    if (print_typed_assignment(p, node))
        return;
    if ((node->op == IR_ADD || node->op == IR_SUB) && is_int_one(p, node->b)) {
        text_str(p->out, node->op == IR_ADD ? "++" : "--");
        print_expression(p, node_at(p, node->a), LANG_PREC_UNARY);
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
        text_str(p->out, node->a ? "return " : "return");
        if (node->a)
            print_expression(p, node_at(p, node->a), LANG_PREC_ASSIGN);
        break;
    case LANG_BREAK: text_str(p->out, "break"); break;
    default: assert(node->kind == LANG_CONTINUE); text_str(p->out, "continue");
    }
}

static void print_statements(struct printer *p, lang_ref first)
{
    for (lang_ref ref = first; ref;) {
        const struct lang_node *node = node_at(p, ref);
        print_statement(p, node);
        ref = node->next;
    }
}

/*
 * Writes the statements between braces in their own scope. `body` is a block or a single statement;
 * NULL: it is empty.
 */
static void print_body(struct printer *p, const struct lang_node *body)
{
    uint32_t mark = p->num_visible;
    p->indent++;
    if (body && body->kind == LANG_BLOCK)
        print_statements(p, body->a);
    else if (body)
        print_statement(p, body);
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

/* If one branch of a chain needs braces, all have them. */
static bool chain_needs_braces(const struct printer *p, const struct lang_node *node)
{
    for (;;) {
        lang_ref next = else_if(p, node);
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
        lang_ref next = else_if(p, node);
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

static void print_for(struct printer *p, const struct lang_node *node)
{
    uint32_t mark = p->num_visible;
    text_str(p->out, "for (");
    if (node->a)
        print_simple(p, node_at(p, node->a));
    text_char(p->out, ';');
    if (node->b) {
        text_char(p->out, ' ');
        print_expression(p, node_at(p, node->b), LANG_PREC_COMMA);
    }
    text_char(p->out, ';');
    lang_ref step = node_at(p, node->c)->b;
    if (step) {
        text_char(p->out, ' ');
        print_simple(p, node_at(p, step));
    }
    text_char(p->out, ')');
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
    text_str(p->out, "while (");
    print_expression(p, node_at(p, node->b), LANG_PREC_COMMA);
    text_char(p->out, ')');
    bool braces = needs_braces(p, node->c);
    print_governed(p, node->c, braces);
    if (braces)
        text_char(p->out, '\n');
}

static void print_do(struct printer *p, const struct lang_node *node)
{
    assert(node_at(p, node->c)->kind == LANG_BLOCK);
    text_str(p->out, "do");
    print_governed(p, node->c, true);
    text_str(p->out, " while (");
    print_expression(p, node_at(p, node->b), LANG_PREC_COMMA);
    text_str(p->out, ");\n");
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
    if (!is_array || !p->style->syntax->array_braces)
        return false;
    const struct text_word wanted = {"made", strlen("made")};
    struct text_word made = wanted;
    for (uint32_t number = 1; is_taken(p, made); number++)
        made = variant(p, wanted, number);
    text_str(p->out, "{ ");
    lang_print_variable(p->style, p->names, p->unit, value->type, made.bytes, p->out);
    text_str(p->out, " = ");
    print_expression(p, value, LANG_PREC_ASSIGN);
    text_str(p->out, "; ");
    print_expression(p, node_at(p, node->a), LANG_PREC_UNARY);
    text_fmt(p->out, " = %s; }\n", made.bytes);
    return true;
}

static void print_statement(struct printer *p, const struct lang_node *node)
{
    print_indent(p);
    if (print_array_assignment(p, node))
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

/* Functions */

static struct printer start(struct lang_style *style, const struct lang_names *names,
                            const struct lang_unit *unit, uint32_t id, struct text *out)
{
    struct printer p = {.style = style, .names = names, .unit = unit, .out = out};
    p.is_typed = names && names->form;
    p.fn = lang_function(unit, id, &p.layer);
    p.locals = arena_alloc(out->arena, p.fn->num_slots * sizeof *p.locals);
    p.visible = arena_alloc(out->arena, p.fn->num_slots * sizeof *p.visible);
    for (uint32_t i = 0; i < p.fn->num_params; i++)
        bring_into_scope(&p, i);
    assert(p.num_visible == p.fn->num_params);
    return p;
}

static const char *param_prefix(const struct lang_syntax *syntax, const struct lang_slot *slot)
{
    if (slot->mode != LANG_IN)
        return slot->mode == LANG_OUT ? syntax->param_out : syntax->param_inout;
    if (slot->type == IR_TYPE_SAMPLER)
        return "";
    return slot->assigned ? syntax->param_in_assigned : syntax->param_in;
}

/* A copied parameter has the name of its slot with the suffix "_in". */
static bool is_copied(const struct printer *p, const struct lang_slot *param)
{
    return p->style->syntax->copies_params && param->assigned && param->mode == LANG_IN;
}

static void print_param(struct printer *p, uint32_t slot)
{
    const struct lang_slot *param = ast_slot(p->layer, p->fn, slot);
    text_str(p->out, param_prefix(p->style->syntax, param));
    if (!is_copied(p, param)) {
        print_variable(p, slot);
        if (param->type == IR_TYPE_SAMPLER && p->style->syntax->sampler_type) {
            text_fmt(p->out, ", %s ", p->style->syntax->sampler_type);
            print_local(p, slot);
            text_str(p->out, LANG_SAMPLER_SUFFIX);
        }
        return;
    }
    lang_print_type(p->style, p->names, p->unit, param->type, p->out);
    text_char(p->out, ' ');
    print_local(p, slot);
    text_str(p->out, "_in");
}

/* Arrays cannot be macros. */
static void print_constant_arrays(struct printer *p)
{
    for (uint32_t i = 0; p->style->syntax->defines_constants && i < p->fn->num_globals; i++) {
        uint32_t id = ast_globals(p->layer, p->fn)[i];
        const struct lang_global *global = lang_global(p->unit, id, NULL);
        if (!ast_is_user_type(global->type) || !global->num_words)
            continue;
        text_str(p->out, "    ");
        lang_print_constant(p->style, p->names, p->unit, id, p->out);
    }
}

static void print_copies(struct printer *p)
{
    for (uint32_t i = 0; i < p->fn->num_params; i++) {
        if (!is_copied(p, ast_slot(p->layer, p->fn, i)))
            continue;
        text_str(p->out, "    ");
        print_variable(p, i);
        text_str(p->out, " = ");
        print_local(p, i);
        text_str(p->out, "_in;\n");
    }
}

static void print_head(struct printer *p, uint32_t id)
{
    lang_print_type(p->style, p->names, p->unit, p->fn->return_type, p->out);
    text_char(p->out, ' ');
    text_str(p->out, print_function_name(p->names, p->unit, id));
    text_char(p->out, '(');
    for (uint32_t i = 0; i < p->fn->num_params; i++) {
        if (i)
            text_mem(p->out, ", ", 2);
        print_param(p, i);
    }
    text_char(p->out, ')');
}

void lang_print_function(struct lang_style *style, const struct lang_names *names,
                         const struct lang_unit *unit, uint32_t id, struct text *out)
{
    if (print_from_image(style, names, unit, id, out))
        return;
    struct printer p = start(style, names, unit, id, out);
    print_head(&p, id);
    text_str(out, "\n{\n");
    print_constant_arrays(&p);
    print_copies(&p);
    print_body(&p, node_at(&p, p.fn->body));
    assert(p.num_visible == p.fn->num_params && p.indent == 0);
    text_str(out, "}\n");
}
