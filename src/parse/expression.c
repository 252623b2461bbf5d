// SPDX-License-Identifier: Apache-2.0
/*
 * Expressions: precedence climbing with the symbol table. Every function reports its errors and
 * then returns 0.
 */
#include "parse/parse_priv.h"

#include <assert.h>

static lang_ref parse_unary(struct parser *p);

/* Parses arguments up to ')' onto the operand stack; false after an error. */
static bool parse_arguments(struct parser *p)
{
    bool good = true;
    if (parse_accept(p, TOKEN_CLOSE))
        return true;
    if (p->token.kind == TOKEN_NAME && p->token.len == 4 && memcmp(p->token.text, "void", 4) == 0) {
        parse_advance(p); /* f(void) */
        return parse_expect(p, TOKEN_CLOSE);
    }
    do {
        lang_ref arg = parse_expression(p);
        good &= arg != 0;
        vec_push(p->unit->arena, &p->operands, arg);
    } while (!p->panic && parse_accept(p, TOKEN_COMMA));
    return parse_expect(p, TOKEN_CLOSE) && good;
}

/* Parses NAME( or TYPE(; the current token is '('. */
static lang_ref parse_call(struct parser *p, const struct token *name, ir_type_id type)
{
    assert(p->token.kind == TOKEN_OPEN);
    parse_advance(p);
    uint32_t first = p->operands.len;
    lang_ref result = 0;
    if (parse_arguments(p)) {
        unsigned num_args = p->operands.len - first;
        lang_ref *args = num_args ? &p->operands.items[first] : NULL;
        result = type == IR_TYPE_VOID ? check_call(p, name, args, num_args)
                                      : check_construct(p, type, args, num_args, parse_place(name));
    }
    assert(p->operands.len >= first);
    p->operands.len = first;
    return result;
}

/* float[3](…) or float[](…) */
static lang_ref parse_array_constructor(struct parser *p, const struct token *name,
                                        ir_type_id element)
{
    bool unsized = false;
    ir_type_id type = parse_array_suffix(p, element, &unsized);
    if (type == IR_TYPE_VOID && !unsized)
        p->panic = true;
    if (!parse_expect(p, TOKEN_OPEN))
        return 0;
    uint32_t first = p->operands.len;
    lang_ref result = 0;
    if (parse_arguments(p)) {
        unsigned num_args = p->operands.len - first;
        if (unsized && num_args >= 1 && num_args <= PARSE_MAX_ARRAY)
            type = lookup_array(p->unit, element, num_args);
        if (type == IR_TYPE_VOID)
            PARSE_TYPE_ERROR(p, parse_place(name), "an array needs 1 to %d elements; here are %u",
                             PARSE_MAX_ARRAY, num_args);
        else
            result = check_construct(p, type, num_args ? &p->operands.items[first] : NULL, num_args,
                                     parse_place(name));
    }
    assert(p->operands.len >= first);
    p->operands.len = first;
    return result;
}

static lang_ref parse_literal(struct parser *p)
{
    struct ir_value value = {.type = IR_TYPE_FLOAT, .w = {p->token.value}};
    switch (p->token.kind) {
    case TOKEN_INT: value.type = IR_TYPE_INT; break;
    case TOKEN_UINT: value.type = IR_TYPE_UINT; break;
    case TOKEN_TRUE: value = ir_value_bool(true); break;
    case TOKEN_FALSE: value = ir_value_bool(false); break;
    case TOKEN_STRING:
        value.type = IR_TYPE_STRING;
        value.w[0].u = str_intern(p->unit->strings, p->token.text, p->token.len);
        break;
    default: break;
    }
    lang_ref ref = tree_const(p, &value, parse_place(&p->token));
    parse_advance(p);
    return ref;
}

static lang_ref parse_input(struct parser *p)
{
    assert(p->token.kind == TOKEN_INPUT);
    struct token token = p->token;
    parse_advance(p);
    str_id name = str_find(p->unit->strings, token.text, token.len);
    for (unsigned i = 0; i < p->num_inputs; i++)
        if (name && p->inputs[i].name == name) {
            lang_ref ref =
                tree_new(p, LANG_INPUT, IR_NUM_OPS, p->inputs[i].type, parse_place(&token));
            tree_node(p, ref)->a = i;
            return ref;
        }
    const char **names = ARENA_ARRAY(p->unit->arena, const char *, p->num_inputs);
    for (unsigned i = 0; i < p->num_inputs; i++)
        names[i] = parse_text(p, p->inputs[i].name);
    const char *word = parse_token_text(p, &token);
    PARSE_ERROR(p, parse_where_token(p, &token), lang_unknown, "input", word,
                diag_suggest(p->diags, word, names, p->num_inputs));
    return 0;
}

static lang_ref parse_local(struct parser *p, const struct local *local, const struct token *token)
{
    if (local->type == IR_TYPE_VOID) /* the declaration has reported the error */
        return 0;
    assert(p->first_slot + local->slot < p->unit->slots.len);
    lang_ref ref = tree_new(p, LANG_VAR, IR_NUM_OPS, local->type, parse_place(token));
    tree_node(p, ref)->a = local->slot;
    return ref;
}

static lang_ref parse_global(struct parser *p, uint32_t id, const struct token *token)
{
    const struct lang_unit *layer;
    const struct lang_global *global = lang_global(p->unit, id, &layer);
    /*
     * A matrix stays a reference, because its name reads best; a scalar or vector becomes its
     * value, which folds.
     */
    bool is_small = global->type < IR_TYPE_FIRST_USER && !ir_type_is_matrix(global->type);
    if (global->kind == LANG_GLOBAL_CONST && is_small) {
        assert(global->num_words <= ir_type_info(global->type)->components);
        struct ir_value value = {.type = global->type};
        memcpy(value.w, layer->words.items + global->words, global->num_words * sizeof value.w[0]);
        return tree_const(p, &value, parse_place(token));
    }
    ir_type_id type = global->array_length
                          ? lookup_array(p->unit, global->type, global->array_length)
                          : global->type;
    lang_ref ref = tree_new(p, LANG_GLOBAL, IR_NUM_OPS, type, parse_place(token));
    tree_node(p, ref)->a = id;
    return ref;
}

static lang_ref parse_named(struct parser *p)
{
    struct token token = p->token;
    parse_advance(p);
    str_id name = str_find(p->unit->strings, token.text, token.len);
    const struct local *local = name ? lookup_local(p, name) : NULL;
    if (local && p->token.kind != TOKEN_OPEN)
        return parse_local(p, local, &token);
    if (local) {
        PARSE_TYPE_ERROR(p, parse_place(&token), "'%s' is a variable; it cannot be called",
                         parse_text(p, name));
        p->panic = true;
        return 0;
    }
    ir_type_id type = lookup_type(p->unit, token.text, token.len);
    if (p->token.kind == TOKEN_OPEN)
        return parse_call(p, &token, type);
    if (type != IR_TYPE_VOID && p->token.kind == TOKEN_OPEN_INDEX)
        return parse_array_constructor(p, &token, type);
    uint32_t global =
        name ? lookup_global(p->unit, p->visible.items, p->visible.len, name) : LANG_NONE;
    if (global != LANG_NONE)
        return parse_global(p, global, &token);
    const char *word = parse_token_text(p, &token);
    if (type != IR_TYPE_VOID)
        PARSE_ERROR(p, parse_where_token(p, &token), lang_expected, "an expression", word);
    else
        PARSE_ERROR(p, parse_where_token(p, &token), lang_unknown, "name", word,
                    lookup_suggest(p, word, LOOKUP_VALUES));
    return 0;
}

static lang_ref parse_primary(struct parser *p)
{
    lang_ref inner;
    switch (p->token.kind) {
    case TOKEN_INT:
    case TOKEN_UINT:
    case TOKEN_FLOAT:
    case TOKEN_STRING:
    case TOKEN_TRUE:
    case TOKEN_FALSE: return parse_literal(p);
    case TOKEN_INPUT: return parse_input(p);
    case TOKEN_NAME: return parse_named(p);
    case TOKEN_OPEN:
        parse_advance(p);
        inner = parse_expression(p);
        return parse_expect(p, TOKEN_CLOSE) ? inner : 0;
    default: parse_unexpected(p, "an expression"); return 0;
    }
}

/* a.name, or a.length() of an array */
static lang_ref parse_selector(struct parser *p, lang_ref a)
{
    struct token name = p->token;
    if (!parse_name(p) || !a)
        return 0;
    ir_type_id element;
    uint32_t length;
    bool is_length = name.len == 6 && memcmp(name.text, "length", 6) == 0;
    if (!is_length || !check_is_array(p, tree_type(p, a), &element, &length))
        return check_member(p, a, &name);
    if (!parse_expect(p, TOKEN_OPEN) || !parse_expect(p, TOKEN_CLOSE))
        return 0;
    struct ir_value value = ir_value_int((int32_t)length);
    return tree_const(p, &value, parse_place(&name));
}

static bool is_step(enum token_kind kind)
{
    return kind == TOKEN_INCREMENT || kind == TOKEN_DECREMENT;
}

static lang_ref parse_postfix(struct parser *p)
{
    lang_ref a = parse_primary(p);
    while (!p->panic) {
        uint32_t place = parse_place(&p->token);
        if (parse_accept(p, TOKEN_DOT)) {
            a = parse_selector(p, a);
        } else if (parse_accept(p, TOKEN_OPEN_INDEX)) {
            lang_ref index = parse_expression(p);
            if (!parse_expect(p, TOKEN_CLOSE_INDEX))
                return 0;
            a = a && index ? check_index(p, a, index, place) : 0;
        } else if (p->is_program && is_step(p->token.kind)) {
            enum token_kind kind = p->token.kind;
            parse_advance(p);
            a = a ? parse_step_inside(p, kind, a, false, place) : 0;
        } else {
            break;
        }
    }
    return p->panic ? 0 : a;
}

static lang_ref parse_prefix(struct parser *p)
{
    uint32_t place = parse_place(&p->token);
    enum token_kind kind = p->token.kind;
    parse_advance(p);
    lang_ref a = parse_unary(p);
    enum ir_op op = kind == TOKEN_SUB     ? IR_NEG
                    : kind == TOKEN_NOT   ? IR_NOT
                    : kind == TOKEN_TILDE ? IR_BITNOT
                                          : IR_NUM_OPS;
    return a ? check_unary(p, op, a, place) : 0;
}

static lang_ref parse_unary(struct parser *p)
{
    switch (p->token.kind) {
    case TOKEN_SUB:
    case TOKEN_ADD:
    case TOKEN_NOT:
    case TOKEN_TILDE: {
        if (!parse_enter(p))
            return 0;
        lang_ref a = parse_prefix(p);
        parse_leave(p);
        return a;
    }
    default: break;
    }
    enum token_kind kind = p->token.kind;
    uint32_t place = parse_place(&p->token);
    if (!p->is_program || !is_step(kind))
        return parse_postfix(p);
    parse_advance(p);
    lang_ref a = parse_postfix(p);
    return a ? parse_step_inside(p, kind, a, true, place) : 0;
}

static lang_ref parse_binary(struct parser *p, unsigned min_precedence)
{
    lang_ref a = parse_unary(p);
    for (;;) {
        const struct symbol *symbol = lex_symbol(p->token.kind);
        if (p->panic || !symbol || symbol->role != SYMBOL_BINARY
            || symbol->precedence < min_precedence)
            return p->panic ? 0 : a;
        uint32_t place = parse_place(&p->token);
        parse_advance(p);
        lang_ref b = parse_binary(p, symbol->precedence + 1u);
        a = a && b ? check_binary(p, (enum ir_op)symbol->op, a, b, place) : 0;
    }
}

lang_ref parse_expression(struct parser *p)
{
    if (!parse_enter(p))
        return 0;
    lang_ref a = parse_binary(p, LANG_PREC_LOR);
    uint32_t place = parse_place(&p->token);
    if (!p->panic && parse_accept(p, TOKEN_QUESTION)) {
        lang_ref b = parse_expression(p);
        lang_ref c = parse_expect(p, TOKEN_COLON) ? parse_expression(p) : 0;
        a = a && b && c ? check_select(p, a, b, c, place) : 0;
        a = a && p->is_program ? parse_choice(p, a) : a;
    }
    parse_leave(p);
    return p->panic ? 0 : a;
}
