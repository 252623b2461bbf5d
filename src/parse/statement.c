// SPDX-License-Identifier: Apache-2.0
/* Statements. A statement is a chain of nodes: `float a, b;` makes two, `;` none. */
#include "parse/parse_priv.h"

#include <assert.h>

static struct tree_chain parse_statement(struct parser *p);

static struct tree_chain chain_of(lang_ref ref)
{
    return (struct tree_chain){ref, ref};
}

static lang_ref block_of(struct parser *p, struct tree_chain statements, uint32_t place)
{
    lang_ref block = tree_new(p, LANG_BLOCK, IR_NUM_OPS, IR_TYPE_VOID, place);
    tree_node(p, block)->a = statements.first;
    return block;
}

/* Scopes */

struct scope {
    uint32_t outer, locals;
};

static struct scope open_scope(struct parser *p)
{
    assert(p->scope <= p->locals.len);
    struct scope scope = {p->scope, p->locals.len};
    p->scope = p->locals.len;
    return scope;
}

static void close_scope(struct parser *p, struct scope scope)
{
    assert(scope.outer <= p->scope && scope.locals <= p->locals.len);
    p->scope = scope.outer;
    p->locals.len = scope.locals;
}

/* Declarations */

/* Parses { a, b, … } of an array. `unsized`: any number of elements of `type`. */
static lang_ref parse_elements(struct parser *p, ir_type_id type, bool unsized)
{
    uint32_t place = parse_place(&p->last), first = p->operands.len;
    bool good = true;
    do {
        lang_ref value = parse_expression(p);
        good &= value != 0;
        vec_push(p->unit->arena, &p->operands, value);
    } while (!p->panic && parse_accept(p, TOKEN_COMMA) && p->token.kind != TOKEN_CLOSE_BLOCK);
    good &= parse_expect(p, TOKEN_CLOSE_BLOCK);
    assert(p->operands.len > first);
    uint32_t num = p->operands.len - first;
    if (unsized)
        type = num <= PARSE_MAX_ARRAY ? lookup_array(p->unit, type, num) : IR_TYPE_VOID;
    lang_ref value = good ? check_construct(p, type, p->operands.items + first, num, place) : 0;
    p->operands.len = first;
    return value;
}

lang_ref parse_initialiser(struct parser *p, ir_type_id type, bool unsized)
{
    ir_type_id element;
    uint32_t length;
    if ((unsized || check_is_array(p, type, &element, &length))
        && parse_accept(p, TOKEN_OPEN_BLOCK))
        return parse_elements(p, type, unsized);
    lang_ref value = parse_expression(p);
    if (!value || type == IR_TYPE_VOID)
        return 0;
    if (!unsized)
        return check_convert(p, value, type, "the initialiser");
    if (check_is_array(p, tree_type(p, value), &element, &length) && element == type)
        return value;
    PARSE_TYPE_ERROR(p, tree_place(p, value), "the initialiser is %s; an array of %s was expected",
                     parse_type_text(p, tree_type(p, value)), parse_type_text(p, type));
    return 0;
}

static bool check_local_type(struct parser *p, ir_type_id type, const struct token *at)
{
    if (type != IR_TYPE_STRING && type != IR_TYPE_SAMPLER)
        return true;
    PARSE_TYPE_ERROR(p, parse_place(at), "a variable cannot have type %s",
                     parse_type_text(p, type));
    return false;
}

/*
 * Parses NAME [n] = value; the name is in scope after its initialiser. `unsized`: an array of
 * `type` with the length of the initialiser.
 */
static lang_ref parse_declarator(struct parser *p, ir_type_id type, bool unsized, bool is_const)
{
    struct token name_token = p->token;
    str_id name = parse_name(p);
    if (!name)
        return 0;
    if (p->token.kind == TOKEN_OPEN_INDEX) {
        ir_type_id array = parse_array_suffix(p, type, &unsized);
        type = unsized ? type : array;
    }
    lang_ref value = 0;
    if (!check_local_type(p, type, &name_token))
        type = IR_TYPE_VOID;
    if (parse_accept(p, TOKEN_SET))
        value = parse_initialiser(p, type, unsized);
    else if (is_const || unsized)
        parse_unexpected(p, is_const ? "the value of the constant" : "the elements of the array");
    if (unsized)
        type = value ? tree_type(p, value) : IR_TYPE_VOID;
    struct local *local = parse_add_local(p, &name_token, name, type, is_const);
    uint32_t num_words;
    local->has_value = value && is_const && type < IR_NUM_TYPES
                       && check_words(p, value, &local->words, &num_words);
    lang_ref ref = tree_new(p, LANG_DECLARE, IR_NUM_OPS, IR_TYPE_VOID, local->place);
    tree_node(p, ref)->a = local->slot;
    tree_node(p, ref)->b = value;
    return ref;
}

static struct tree_chain parse_declaration(struct parser *p)
{
    struct tree_chain chain = {0};
    bool is_const = parse_accept(p, TOKEN_CONST), bad = false, unsized = false;
    ir_type_id type = parse_type(p, false, &bad);
    if (bad && p->token.kind != TOKEN_NAME)
        return chain;
    if (p->token.kind == TOKEN_OPEN_INDEX) {
        ir_type_id array = parse_array_suffix(p, type, &unsized);
        type = unsized ? type : array;
    }
    do {
        lang_ref ref = parse_declarator(p, type, unsized, is_const);
        parse_flush(p, &chain);
        tree_append(p, &chain, ref);
    } while (!p->panic && parse_accept(p, TOKEN_COMMA));
    return chain;
}

/* Expressions as statements */

static lang_ref step_by_one(struct parser *p, enum token_kind kind, lang_ref target, uint32_t place)
{
    struct ir_value one = ir_value_int(1);
    lang_ref value = target ? tree_const(p, &one, place) : 0;
    return target ? check_assign(p, (enum ir_op)lex_symbol(kind)->op, target, value, place) : 0;
}

static lang_ref parse_effect(struct parser *p, lang_ref value, const struct token *start)
{
    if (p->token.kind == TOKEN_COMMA)
        PARSE_ERROR(p, parse_where_token(p, &p->token), lang_unsupported, ",",
                    " operator; write one statement for each");
    else if (p->token.kind != TOKEN_SEMICOLON && p->token.kind != TOKEN_CLOSE)
        parse_unexpected(p, "';'");
    else if (value && tree_node(p, value)->kind != LANG_CALL)
        PARSE_SYNTAX_ERROR(p, start,
                           "the statement has no effect: a call or an assignment was expected");
    if (!value || p->panic || tree_node(p, value)->kind != LANG_CALL)
        return 0;
    lang_ref ref = tree_new(p, LANG_EXPR, IR_NUM_OPS, IR_TYPE_VOID, parse_place(start));
    tree_node(p, ref)->a = value;
    return ref;
}

static bool at_assignment(const struct parser *p)
{
    const struct symbol *symbol = lex_symbol(p->token.kind);
    return symbol && symbol->role == SYMBOL_SET;
}

static lang_ref read_again(struct parser *p, lang_ref variable)
{
    const struct lang_node node = *tree_node(p, variable);
    assert(node.kind == LANG_VAR);
    lang_ref ref = tree_new(p, LANG_VAR, IR_NUM_OPS, node.type, tree_place(p, variable));
    tree_node(p, ref)->a = node.a;
    return ref;
}

/*
 * Parses from the operator on. `a = b = x` is two statements, b = x and a = b, so the targets after
 * the first are variables.
 */
static struct tree_chain parse_assignment(struct parser *p, lang_ref target)
{
    struct tree_chain chain = {0};
    enum ir_op op = (enum ir_op)lex_symbol(p->token.kind)->op;
    uint32_t place = parse_place(&p->token);
    parse_advance(p);
    if (!parse_enter(p))
        return chain;
    lang_ref value = parse_expression(p);
    if (value && !p->panic && at_assignment(p) && tree_node(p, value)->kind == LANG_VAR) {
        chain = parse_assignment(p, value);
        value = chain.first ? read_again(p, value) : 0;
    }
    if (target && value)
        tree_append(p, &chain, check_assign(p, op, target, value, place));
    parse_leave(p);
    return chain;
}

/* Parses assignments, ++, -- or a call, without the ';'. */
static struct tree_chain parse_simple(struct parser *p)
{
    struct token start = p->token;
    const struct symbol *symbol = lex_symbol(start.kind);
    if (symbol && symbol->role == SYMBOL_STEP) {
        parse_advance(p);
        return chain_of(step_by_one(p, start.kind, parse_expression(p), parse_place(&start)));
    }
    lang_ref target = parse_expression(p);
    if (p->panic)
        return chain_of(0);
    struct token at = p->token;
    symbol = lex_symbol(at.kind);
    if (symbol && symbol->role == SYMBOL_STEP) {
        parse_advance(p);
        return chain_of(step_by_one(p, at.kind, target, parse_place(&at)));
    }
    return at_assignment(p) ? parse_assignment(p, target)
                            : chain_of(parse_effect(p, target, &start));
}

/* The step of a loop: one statement. */
static lang_ref parse_step(struct parser *p)
{
    struct token start = p->token;
    struct tree_chain chain = parse_simple(p);
    if (chain.first != chain.last)
        PARSE_SYNTAX_ERROR(p, &start, "the step of a loop has one assignment");
    return chain.first;
}

/* Control flow */

/* Parses the body of a branch or loop, as a block with its own scope. */
static lang_ref parse_body(struct parser *p)
{
    struct scope scope = open_scope(p);
    uint32_t place = parse_place(&p->token);
    lang_ref block =
        p->token.kind == TOKEN_OPEN_BLOCK ? parse_block(p) : block_of(p, parse_statement(p), place);
    close_scope(p, scope);
    return block;
}

static lang_ref parse_condition(struct parser *p)
{
    lang_ref condition = parse_expression(p);
    return condition ? check_convert(p, condition, IR_TYPE_BOOL, "the condition") : 0;
}

static lang_ref parse_if(struct parser *p, uint32_t place)
{
    lang_ref condition = parse_expect(p, TOKEN_OPEN) ? parse_condition(p) : 0;
    if (!parse_expect(p, TOKEN_CLOSE))
        return 0;
    lang_ref yes = parse_body(p), no = 0;
    if (!p->panic && parse_accept(p, TOKEN_ELSE))
        no = parse_body(p);
    lang_ref ref = tree_new(p, LANG_IF, IR_NUM_OPS, IR_TYPE_VOID, place);
    struct lang_node *node = tree_node(p, ref);
    node->a = condition;
    node->b = yes;
    node->c = no;
    return ref;
}

/* Each turn of a loop computes the condition, so nothing can come before it. */
static lang_ref parse_loop_condition(struct parser *p)
{
    struct token at = p->token;
    lang_ref condition = parse_condition(p);
    if (p->before.first)
        PARSE_SYNTAX_ERROR(p, &at, "the condition of a loop changes a variable");
    return condition;
}

static lang_ref parse_loop_body(struct parser *p)
{
    p->loops++;
    lang_ref body = parse_body(p);
    assert(p->loops > 0);
    p->loops--;
    return body;
}

static lang_ref loop_node(struct parser *p, enum lang_kind kind, lang_ref condition, lang_ref body,
                          uint32_t place)
{
    assert(kind == LANG_FOR || kind == LANG_WHILE || kind == LANG_DO);
    lang_ref ref = tree_new(p, kind, IR_NUM_OPS, IR_TYPE_VOID, place);
    tree_node(p, ref)->b = condition;
    tree_node(p, ref)->c = body;
    return ref;
}

/* A loop with several variables becomes a block: their declarations, then the loop. */
static struct tree_chain parse_for(struct parser *p, uint32_t place)
{
    struct tree_chain init = {0}, none = {0};
    if (!parse_expect(p, TOKEN_OPEN))
        return none;
    struct scope scope = open_scope(p);
    if (parse_at_type(p))
        init = parse_declaration(p);
    else if (p->token.kind != TOKEN_SEMICOLON)
        init = parse_simple(p);
    lang_ref condition = 0, step = 0;
    bool good = parse_expect(p, TOKEN_SEMICOLON);
    if (good && p->token.kind != TOKEN_SEMICOLON)
        condition = parse_loop_condition(p);
    good = good && parse_expect(p, TOKEN_SEMICOLON);
    if (good && p->token.kind != TOKEN_CLOSE)
        step = parse_step(p);
    good = good && parse_expect(p, TOKEN_CLOSE);
    lang_ref loop = good ? loop_node(p, LANG_FOR, condition, parse_loop_body(p), place) : 0;
    close_scope(p, scope);
    if (!good)
        return none;
    if (tree_node(p, loop)->c)
        tree_node(p, tree_node(p, loop)->c)->b = step;
    if (init.first == init.last) {
        tree_node(p, loop)->a = init.first;
        return chain_of(loop);
    }
    tree_append(p, &init, loop);
    return chain_of(block_of(p, init, place));
}

static lang_ref parse_while(struct parser *p, uint32_t place)
{
    lang_ref condition = parse_expect(p, TOKEN_OPEN) ? parse_loop_condition(p) : 0;
    if (!parse_expect(p, TOKEN_CLOSE))
        return 0;
    return loop_node(p, LANG_WHILE, condition, parse_loop_body(p), place);
}

static lang_ref parse_do(struct parser *p, uint32_t place)
{
    lang_ref body = parse_loop_body(p), condition = 0;
    if (!p->panic && p->token.kind != TOKEN_WHILE)
        parse_unexpected(p, "'while'");
    else
        parse_advance(p);
    if (parse_expect(p, TOKEN_OPEN))
        condition = parse_loop_condition(p);
    return parse_expect(p, TOKEN_CLOSE) && parse_expect(p, TOKEN_SEMICOLON)
               ? loop_node(p, LANG_DO, condition, body, place)
               : 0;
}

static lang_ref parse_return(struct parser *p, const struct token *at)
{
    lang_ref value = p->token.kind == TOKEN_SEMICOLON ? 0 : parse_expression(p);
    bool is_void = p->return_type == IR_TYPE_VOID;
    if (value && is_void)
        PARSE_TYPE_ERROR(p, tree_place(p, value), "the function is void; it returns no value");
    else if (value)
        value = check_convert(p, value, p->return_type, "the returned value");
    else if (p->token.kind == TOKEN_SEMICOLON && p->last.kind == TOKEN_RETURN && !is_void)
        PARSE_TYPE_ERROR(p, parse_place(at), "a value of type %s must be returned",
                         parse_type_text(p, p->return_type));
    parse_expect(p, TOKEN_SEMICOLON);
    lang_ref ref = tree_new(p, LANG_RETURN, IR_NUM_OPS, IR_TYPE_VOID, parse_place(at));
    tree_node(p, ref)->a = value;
    return ref;
}

static lang_ref parse_jump(struct parser *p, const struct token *at)
{
    if (p->loops == 0)
        PARSE_SYNTAX_ERROR(p, at, "'%s' outside of a loop", parse_token_text(p, at));
    parse_expect(p, TOKEN_SEMICOLON);
    return tree_new(p, at->kind == TOKEN_BREAK ? LANG_BREAK : LANG_CONTINUE, IR_NUM_OPS,
                    IR_TYPE_VOID, parse_place(at));
}

static struct tree_chain parse_plain(struct parser *p)
{
    bool declares = p->token.kind == TOKEN_CONST || parse_at_type(p);
    struct tree_chain chain = declares ? parse_declaration(p) : parse_simple(p);
    if (!p->panic)
        parse_expect(p, TOKEN_SEMICOLON);
    return chain;
}

static struct tree_chain parse_by_keyword(struct parser *p)
{
    struct token at = p->token;
    uint32_t place = parse_place(&at);
    switch (at.kind) {
    case TOKEN_IF: parse_advance(p); return chain_of(parse_if(p, place));
    case TOKEN_FOR: parse_advance(p); return parse_for(p, place);
    case TOKEN_WHILE: parse_advance(p); return chain_of(parse_while(p, place));
    case TOKEN_DO: parse_advance(p); return chain_of(parse_do(p, place));
    case TOKEN_RETURN: parse_advance(p); return chain_of(parse_return(p, &at));
    case TOKEN_BREAK:
    case TOKEN_CONTINUE: parse_advance(p); return chain_of(parse_jump(p, &at));
    case TOKEN_SEMICOLON: parse_advance(p); return chain_of(0);
    case TOKEN_OPEN_BLOCK: return chain_of(parse_body(p));
    default: return parse_plain(p);
    }
}

static struct tree_chain parse_statement(struct parser *p)
{
    struct tree_chain chain = {0}, all = {0}, outer = p->before;
    p->before = all;
    if (parse_enter(p)) {
        chain = parse_by_keyword(p);
        parse_leave(p);
    }
    parse_flush(p, &all);
    tree_join(p, &all, chain);
    p->before = outer;
    if (p->panic)
        parse_recover(p, false);
    return all;
}

lang_ref parse_block(struct parser *p)
{
    uint32_t place = parse_place(&p->token);
    struct tree_chain chain = {0};
    if (!parse_expect(p, TOKEN_OPEN_BLOCK))
        return 0;
    while (p->token.kind != TOKEN_CLOSE_BLOCK && p->token.kind != TOKEN_END) {
        tree_join(p, &chain, parse_statement(p));
    }
    parse_expect(p, TOKEN_CLOSE_BLOCK);
    assert(!chain.first == !chain.last);
    return block_of(p, chain, place);
}

bool parse_returns(const struct parser *p, lang_ref ref)
{
    const struct lang_node *nodes = p->unit->nodes.items;
    for (; ref; ref = nodes[ref].next) {
        const struct lang_node *node = &nodes[ref];
        if (node->kind == LANG_RETURN || (node->kind == LANG_BLOCK && parse_returns(p, node->a))
            || (node->kind == LANG_IF && node->c && parse_returns(p, node->b)
                && parse_returns(p, node->c)))
            return true;
    }
    return false;
}
