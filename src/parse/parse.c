// SPDX-License-Identifier: Apache-2.0
/*
 * The parser's core: tokens, messages, error recovery, rollback.
 */
#include "parse/parse_priv.h"

#include <assert.h>
#include <stdarg.h>
#include <stdio.h>

/* Messages */

enum { MAX_COLUMN = 4095 }; /* 12 bits; a column that saturates is unknown */

uint32_t parse_place(const struct token *token)
{
    return token->line << 12 | (token->column < MAX_COLUMN ? token->column : MAX_COLUMN);
}

struct diag_place parse_where(const struct parser *p, uint32_t place, uint32_t length)
{
    uint32_t column = place & MAX_COLUMN;
    return (struct diag_place){.file = p->file_name,
                               .line = place >> 12,
                               .column = column < MAX_COLUMN ? column : 0,
                               .length = length};
}

struct diag_place parse_where_token(const struct parser *p, const struct token *token)
{
    return (struct diag_place){p->file_name, token->line, token->column, token->columns, NULL};
}

struct diag_place parse_where_function(const struct parser *p, const struct lang_function *function)
{
    struct diag_place where = parse_where(p, function->place, 0);
    if (function->file != LANG_NONE)
        where.file = parse_text(p, lang_file(p->unit, function->file, NULL)->name);
    return where;
}

bool parse_may_report(struct parser *p)
{
    p->reported = !p->panic && !p->stopped;
    p->num_errors += p->reported;
    if (p->num_errors >= PARSE_MAX_ERRORS) {
        p->stopped = true;
        p->lexer.at = p->lexer.end;
    }
    return p->reported;
}

const char *parse_say(struct parser *p, const char *format, ...)
{
    va_list args, again;
    va_start(args, format);
    va_copy(again, args);
    int len = vsnprintf(NULL, 0, format, args);
    va_end(args);
    size_t size = len < 0 ? 1 : (size_t)len + 1;
    char *text = arena_zalloc(p->diags->arena, size);
    vsnprintf(text, size, format, again);
    va_end(again);
    return text;
}

const char *parse_text(const struct parser *p, str_id name)
{
    return str_text(p->unit->strings, name);
}

const char *parse_token_text(struct parser *p, const struct token *token)
{
    if (token->kind == TOKEN_END)
        return p->reader ? "end of file" : "the end";
    return arena_strndup(p->diags->arena, token->text, token->len < 40 ? token->len : 40);
}

const char *parse_type_text(struct parser *p, ir_type_id type)
{
    if (type < IR_TYPE_FIRST_USER)
        return ir_type_text(type);
    const struct ir_user_type *user = lang_user_type(p->unit, type, NULL);
    if (user->array_length)
        return parse_say(p, "%s[%u]", parse_type_text(p, user->element), user->array_length);
    return parse_text(p, user->name);
}

/* Tokens */

bool parse_is_word(const struct token *token, const char *word)
{
    return token->kind == TOKEN_NAME && token->len == strlen(word)
           && memcmp(token->text, word, token->len) == 0;
}

static void report_bad_token(struct parser *p)
{
    const struct token *token = &p->token;
    unsigned char c = token->len ? (unsigned char)*token->text : ' ';
    if (token->len == 1 && (c < 0x20 || c >= 0x7f))
        PARSE_SYNTAX_ERROR(p, token, "a byte 0x%02x has no meaning here", c);
    else
        PARSE_SYNTAX_ERROR(p, token, "'%s' %s", parse_token_text(p, token), token->reason);
    p->panic = true;
}

void parse_advance(struct parser *p)
{
    p->last = p->token;
    for (lex_next(&p->lexer, &p->token); p->token.kind == TOKEN_BAD; lex_next(&p->lexer, &p->token))
        report_bad_token(p);
}

bool parse_accept(struct parser *p, enum token_kind kind)
{
    if (p->token.kind != kind)
        return false;
    parse_advance(p);
    return true;
}

void parse_unexpected(struct parser *p, const char *expected)
{
    const struct symbol *symbol = lex_symbol(p->token.kind);
    if (p->token.kind == TOKEN_REFUSED)
        PARSE_ERROR(p, parse_where_token(p, &p->token), lang_unsupported,
                    parse_token_text(p, &p->token), "");
    else if (symbol && (symbol->role == SYMBOL_SET || symbol->role == SYMBOL_STEP))
        PARSE_ERROR(p, parse_where_token(p, &p->token), lang_unsupported, symbol->text,
                    " inside of an expression; make it a statement of its own");
    else
        PARSE_ERROR(p, parse_where_token(p, &p->token), lang_expected, expected,
                    parse_token_text(p, &p->token));
    p->panic = true;
}

bool parse_expect(struct parser *p, enum token_kind kind)
{
    if (parse_accept(p, kind))
        return true;
    const struct symbol *symbol = lex_symbol(kind);
    const char *expected = symbol ? parse_say(p, "'%s'", symbol->text) : "a name";
    bool on_later_line = kind == TOKEN_SEMICOLON && p->last.line && p->last.line < p->token.line;
    if (!on_later_line || p->token.kind == TOKEN_REFUSED) {
        parse_unexpected(p, expected);
        return false;
    }
    /* Reports a missing ';' after the last token. The parser continues as if it were there. */
    struct diag_place where = parse_where_token(p, &p->last);
    where.column += p->last.columns;
    where.length = 1;
    PARSE_ERROR(p, where, lang_expected, expected, parse_token_text(p, &p->token));
    return false;
}

struct token parse_peek(const struct parser *p)
{
    struct lexer ahead = p->lexer;
    struct token token;
    lex_next(&ahead, &token);
    return token;
}

str_id parse_name(struct parser *p)
{
    if (p->token.kind != TOKEN_NAME) {
        parse_unexpected(p, "a name");
        return 0;
    }
    str_id name = str_intern(p->unit->strings, p->token.text, p->token.len);
    parse_advance(p);
    return name;
}

void parse_recover(struct parser *p, bool at_file_level)
{
    p->panic = true;
    unsigned open = 0;
    for (; p->token.kind != TOKEN_END; parse_advance(p)) {
        if (p->token.kind == TOKEN_OPEN_BLOCK)
            open++;
        if (p->token.kind == TOKEN_CLOSE_BLOCK && open == 0 && !at_file_level)
            break;
        bool closes = p->token.kind == TOKEN_CLOSE_BLOCK && (open == 0 || --open == 0);
        if (closes || (p->token.kind == TOKEN_SEMICOLON && open == 0)) {
            parse_advance(p);
            break;
        }
    }
    p->panic = false;
}

bool parse_enter(struct parser *p)
{
    if (p->depth >= PARSE_MAX_DEPTH) {
        PARSE_ERROR(p, parse_where_token(p, &p->token), lang_limit,
                    parse_say(p, "nested more than %d deep", PARSE_MAX_DEPTH));
        p->panic = true;
        return false;
    }
    p->depth++;
    return true;
}

void parse_leave(struct parser *p)
{
    assert(p->depth > 0);
    p->depth--;
}

/* Begin and end */

struct parse_mark parse_mark(const struct lang_unit *unit)
{
    return (struct parse_mark){unit->nodes.len,   unit->slots.len,      unit->functions.len,
                               unit->globals.len, unit->files.len,      unit->words.len,
                               unit->refs.len,    unit->user_types.len, unit->members.len};
}

void parse_roll_back(struct lang_unit *unit, const struct parse_mark *mark)
{
    assert(mark->nodes <= unit->nodes.len && mark->functions <= unit->functions.len);
    assert(mark->words <= unit->words.len && mark->refs <= unit->refs.len);
    unit->nodes.len = mark->nodes;
    unit->slots.len = mark->slots;
    unit->functions.len = mark->functions;
    unit->globals.len = mark->globals;
    unit->files.len = mark->files;
    unit->words.len = mark->words;
    unit->refs.len = mark->refs;
    unit->user_types.len = mark->user_types;
    unit->members.len = mark->members;
}

void parse_drop_tree(struct parser *p, const struct parse_mark *mark, uint32_t keep)
{
    union ir_word *words = p->unit->words.items;
    assert(mark->words + keep <= p->unit->words.len && mark->nodes >= p->first_node);
    if (keep)
        memmove(words + mark->words, words + p->unit->words.len - keep, keep * sizeof *words);
    p->unit->words.len = mark->words + keep;
    p->unit->nodes.len = mark->nodes;
    p->origins.len = mark->nodes - p->first_node;
}

void parse_init(struct parser *p, struct lang_unit *unit, struct diag_list *diags)
{
    *p = (struct parser){
        .unit = unit, .diags = diags, .file = LANG_NONE, .first_node = unit->nodes.len};
}

void parse_begin(struct parser *p, const char *file_name, const char *text, size_t len,
                 uint32_t line, uint32_t column, bool inputs)
{
    p->file_name = file_name;
    lex_begin(&p->lexer, text, len, line, column);
    p->lexer.inputs = inputs;
    parse_advance(p);
}
