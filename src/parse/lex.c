// SPDX-License-Identifier: Apache-2.0
#include "parse/parse_priv.h"

#include "base/num.h"

#include <assert.h>

static const struct symbol symbols[] = {
#define SYMBOL(ID, text, role, op, precedence) \
    {text, sizeof text - 1, SYMBOL_##role, op, precedence},
    LANG_SYMBOLS(SYMBOL)
#undef SYMBOL
};
enum { FIRST_SYMBOL = TOKEN_DIRECTIVE + 1, NUM_SYMBOLS = sizeof symbols / sizeof symbols[0] };

static const struct {
    const char *text;
    enum token_kind kind;
} keywords[] = {
#define KEYWORD(ID, text) {text, TOKEN_##ID},
    LANG_KEYWORDS(KEYWORD)
#undef KEYWORD
};

const struct symbol *lex_symbol(enum token_kind kind)
{
    int i = (int)kind - FIRST_SYMBOL;
    return i >= 0 && i < NUM_SYMBOLS ? &symbols[i] : NULL;
}

void lex_begin(struct lexer *lexer, const char *text, size_t len, uint32_t line, uint32_t column)
{
    *lexer = (struct lexer){
        .at = text, .end = text + len, .line = line, .column = column, .line_begins = true};
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool is_word(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || is_digit(c);
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
}

static bool begins(const struct lexer *lexer, const char *text, size_t len)
{
    return (size_t)(lexer->end - lexer->at) >= len && memcmp(lexer->at, text, len) == 0;
}

static void step(struct lexer *lexer)
{
    char c = *lexer->at++;
    if (c == '\n') {
        lexer->line++;
        lexer->column = 1;
        lexer->line_begins = true;
    } else if (((unsigned char)c & 0xc0) != 0x80) { /* a column is a code point */
        lexer->column++;
    }
}

static void step_to(struct lexer *lexer, const char *at)
{
    assert(at <= lexer->end);
    while (lexer->at < at)
        step(lexer);
}

/* A backslash before a line end joins the lines. */
static size_t continuation(const struct lexer *lexer)
{
    return begins(lexer, "\\\n", 2) ? 2 : begins(lexer, "\\\r\n", 3) ? 3 : 0;
}

static void skip_line(struct lexer *lexer)
{
    while (lexer->at < lexer->end && *lexer->at != '\n') {
        size_t joined = continuation(lexer);
        step_to(lexer, lexer->at + (joined ? joined : 1));
    }
}

/*
 * Skips blanks and comments; false if a comment does not end. `token` gets the line comments right
 * above it: whole-line comments without an empty line between or after them.
 */
static bool skip_blanks(struct lexer *lexer, struct token *token)
{
    unsigned line_ends = 0; /* line ends since the last line comment */
    while (lexer->at < lexer->end) {
        size_t joined = continuation(lexer);
        if (joined) {
            bool begins_line = lexer->line_begins;
            step_to(lexer, lexer->at + joined);
            lexer->line_begins = begins_line;
        } else if (is_blank(*lexer->at)) {
            line_ends += *lexer->at == '\n';
            if (line_ends > 1)
                token->comment = NULL;
            step(lexer);
        } else if (begins(lexer, "//", 2)) {
            if (!token->comment && lexer->line_begins)
                token->comment = lexer->at;
            line_ends = 0;
            skip_line(lexer);
            if (token->comment)
                token->comment_len = (size_t)(lexer->at - token->comment);
        } else if (begins(lexer, "/*", 2)) {
            struct lexer start = *lexer;
            step_to(lexer, lexer->at + 2);
            while (lexer->at < lexer->end && !begins(lexer, "*/", 2))
                step(lexer);
            if (lexer->at == lexer->end) {
                *lexer = start;
                return false;
            }
            step_to(lexer, lexer->at + 2);
        } else {
            break;
        }
    }
    return true;
}

static void bad(struct token *token, const char *reason)
{
    token->kind = TOKEN_BAD;
    token->reason = reason;
}

static void read_float(struct token *token)
{
    size_t len = token->len;
    if (token->text[len - 1] == 'f' || token->text[len - 1] == 'F')
        len--;
    token->kind = TOKEN_FLOAT;
    if (num_parse_float(token->text, len, &token->value.f) != len)
        bad(token, "is not a number");
    else if (token->value.f - token->value.f != 0.0f)
        bad(token, "is beyond the range of float");
}

static void read_integer(struct token *token)
{
    size_t len = token->len;
    bool is_unsigned = token->text[len - 1] == 'u' || token->text[len - 1] == 'U';
    len -= is_unsigned;
    token->kind = is_unsigned ? TOKEN_UINT : TOKEN_INT;
    int64_t value = 0;
    if (len > 1 && token->text[0] == '0' && is_digit(token->text[1]))
        bad(token, "is octal in GLSL; write it without the leading zero");
    else if (num_parse_int(token->text, len, &value) != len)
        bad(token, "is not a number");
    /* GLSL 4.50, 4.1.3: any 32-bit pattern is valid, for int too */
    else if (value > UINT32_MAX)
        bad(token, "does not fit in 32 bits");
    token->value.u = (uint32_t)value;
}

/*
 * Reads letters, digits, points, and signs of exponents; the text is a number only as a whole.
 */
static bool is_of_number(const char *start, const char *at, bool hex)
{
    if (is_word(*at) || *at == '.')
        return true;
    return !hex && at > start && (*at == '+' || *at == '-') && (at[-1] == 'e' || at[-1] == 'E');
}

static void lex_number(struct lexer *lexer, struct token *token)
{
    const char *at = lexer->at;
    bool hex = lexer->end - at > 1 && at[0] == '0' && (at[1] == 'x' || at[1] == 'X');
    bool is_float = false;
    for (; at < lexer->end && is_of_number(lexer->at, at, hex); at++)
        is_float |= !hex && strchr(".eEfF", *at) != NULL;
    token->len = (size_t)(at - lexer->at);
    if (is_float)
        read_float(token);
    else
        read_integer(token);
    step_to(lexer, at);
}

static void lex_word(struct lexer *lexer, struct token *token)
{
    const char *at = lexer->at;
    while (at < lexer->end && is_word(*at))
        at++;
    token->len = (size_t)(at - lexer->at);
    assert(token->len > 0);
    token->kind = TOKEN_NAME;
    for (size_t i = 0; i < sizeof keywords / sizeof keywords[0]; i++)
        if (strlen(keywords[i].text) == token->len
            && memcmp(keywords[i].text, token->text, token->len) == 0)
            token->kind = keywords[i].kind;
    step_to(lexer, at);
}

static void lex_string(struct lexer *lexer, struct token *token)
{
    const char *at = lexer->at + 1;
    while (at < lexer->end && *at != '"' && (unsigned char)*at >= 0x20 && *at != '\\')
        at++;
    token->kind = TOKEN_STRING;
    token->text = lexer->at + 1;
    token->len = (size_t)(at - token->text);
    if (at < lexer->end && *at == '"') {
        step_to(lexer, at + 1);
        return;
    }
    bad(token, at < lexer->end && *at == '\\' ? "has a backslash: strings have no escapes"
                                              : "has no closing quote");
    step_to(lexer, at);
}

static bool lex_input(struct lexer *lexer, struct token *token)
{
    const char *at = lexer->at + 2;
    while (at < lexer->end && *at == ' ')
        at++;
    const char *name = at;
    while (at < lexer->end && (is_word(*at) || *at == ':')) /* NAMESPACE:NAME */
        at++;
    const char *name_end = at;
    while (at < lexer->end && *at == ' ')
        at++;
    if (name == name_end || lexer->end - at < 2 || memcmp(at, "}}", 2) != 0)
        return false;
    token->kind = TOKEN_INPUT;
    token->text = name;
    token->len = (size_t)(name_end - name);
    step_to(lexer, at + 2);
    return true;
}

static bool lex_symbol_at(struct lexer *lexer, struct token *token)
{
    for (int i = 0; i < NUM_SYMBOLS; i++)
        if (begins(lexer, symbols[i].text, symbols[i].len)) {
            token->kind = (enum token_kind)(FIRST_SYMBOL + i);
            token->len = symbols[i].len;
            step_to(lexer, lexer->at + symbols[i].len);
            return true;
        }
    return false;
}

static void lex_token(struct lexer *lexer, struct token *token, bool line_begins)
{
    char c = *lexer->at;
    bool point = c == '.' && lexer->end - lexer->at > 1 && is_digit(lexer->at[1]);
    if (c == '#' && line_begins) {
        token->kind = TOKEN_DIRECTIVE;
        skip_line(lexer);
        token->len = (size_t)(lexer->at - token->text);
    } else if (is_digit(c) || point) {
        lex_number(lexer, token);
    } else if (is_word(c)) {
        lex_word(lexer, token);
    } else if (c == '"') {
        lex_string(lexer, token);
    } else if (lexer->inputs && begins(lexer, "{{", 2) && lex_input(lexer, token)) {
        return;
    } else if (!lex_symbol_at(lexer, token)) {
        do /* consumes all bytes of a code point */
            step(lexer);
        while (lexer->at < lexer->end && ((unsigned char)*lexer->at & 0xc0) == 0x80);
        token->len = (size_t)(lexer->at - token->text);
        bad(token, "has no meaning here");
    }
}

void lex_next(struct lexer *lexer, struct token *out_token)
{
    *out_token = (struct token){.kind = TOKEN_END};
    bool closed = skip_blanks(lexer, out_token);
    out_token->text = lexer->at;
    out_token->line = lexer->line;
    out_token->column = lexer->column;
    if (!closed) {
        out_token->len = 2;
        out_token->columns = 2;
        bad(out_token, "begins a comment that does not end");
        lexer->at = lexer->end;
        return;
    }
    if (lexer->at == lexer->end)
        return;
    bool line_begins = lexer->line_begins;
    lexer->line_begins = false;
    lex_token(lexer, out_token, line_begins);
    assert(out_token->text + out_token->len <= lexer->at && lexer->at <= lexer->end);
    out_token->columns = lexer->line == out_token->line ? lexer->column - out_token->column : 1;
}
