// SPDX-License-Identifier: Apache-2.0
#include "usda/usda.h"

void usda_lexer_init(struct usda_lexer *lexer, const char *text, size_t len)
{
    *lexer = (struct usda_lexer){.at = text, .end = text + len, .line_begin = text, .line = 1};
}

static void count_newline(struct usda_lexer *l)
{
    l->line++;
    l->line_begin = l->at;
}

static bool begins(const struct usda_lexer *l, const char *word)
{
    size_t len = strlen(word);
    return (size_t)(l->end - l->at) >= len && memcmp(l->at, word, len) == 0;
}

static void skip_line(struct usda_lexer *l)
{
    while (l->at < l->end && *l->at != '\n')
        l->at++;
}

static void skip_block(struct usda_lexer *l)
{
    while (l->at < l->end && !begins(l, "*/"))
        if (*l->at++ == '\n')
            count_newline(l);
    l->at += begins(l, "*/") ? 2 : 0;
}

/* Blanks and comments; not newlines. */
static void skip_space(struct usda_lexer *l)
{
    while (l->at < l->end) {
        if (*l->at == ' ' || *l->at == '\t' || *l->at == '\r')
            l->at++;
        else if (*l->at == '#' || begins(l, "//"))
            skip_line(l);
        else if (begins(l, "/*"))
            skip_block(l);
        else
            return;
    }
}

static enum usda_token_kind lex_newlines(struct usda_lexer *l)
{
    while (l->at < l->end && (*l->at == '\n' || *l->at == ';')) {
        if (*l->at++ == '\n')
            count_newline(l);
        skip_space(l);
    }
    return USDA_NEWLINE;
}

/* Identifiers joined by ':' (also "::") and '.'. */
static enum usda_token_kind lex_name(struct usda_lexer *l)
{
    while (l->at < l->end
           && (usda_is_letter(*l->at) || usda_is_digit(*l->at) || *l->at == ':' || *l->at == '.'))
        l->at++;
    return USDA_NAME;
}

static enum usda_token_kind lex_number(struct usda_lexer *l)
{
    const char *begin = l->at;
    l->at += *l->at == '-' || *l->at == '+';
    const char *digits = l->at;
    if (begins(l, "inf") || begins(l, "nan")) {
        l->at += 3;
        return USDA_NUMBER;
    }
    while (l->at < l->end
           && (usda_is_digit(*l->at) || *l->at == '.' || *l->at == 'e' || *l->at == 'E'
               || ((*l->at == '-' || *l->at == '+') && (l->at[-1] == 'e' || l->at[-1] == 'E')
                   && l->at > digits)))
        l->at++;
    if (l->at > digits && *digits != 'e' && *digits != 'E')
        return USDA_NUMBER;
    l->at = begin + 1;
    l->fault = "a sign without a number";
    return USDA_BAD;
}

/* From the opening delimiter to the closing one. */
static enum usda_token_kind lex_until(struct usda_lexer *l, const char *delimiter,
                                      bool may_have_lines, enum usda_token_kind kind,
                                      const char *fault)
{
    size_t len = strlen(delimiter);
    for (l->at += len; l->at < l->end && !begins(l, delimiter); l->at++) {
        if (*l->at == '\n' && !may_have_lines)
            break;
        if (*l->at == '\\' && kind == USDA_STRING && l->at + 1 < l->end)
            l->at++;
        if (*l->at == '\n') {
            l->line++;
            l->line_begin = l->at + 1;
        }
    }
    if (!begins(l, delimiter)) {
        l->fault = fault;
        return USDA_BAD;
    }
    l->at += len;
    return kind;
}

static enum usda_token_kind lex_quoted(struct usda_lexer *l)
{
    static const char *const quotes[] = {"\"\"\"", "'''", "\"", "'"};
    size_t i = 0;
    while (!begins(l, quotes[i]))
        i++;
    return lex_until(l, quotes[i], i < 2, USDA_STRING, "a string that does not end");
}

static enum usda_token_kind lex_path(struct usda_lexer *l)
{
    while (l->at < l->end && *l->at != '>' && *l->at != '\n')
        l->at++;
    if (l->at == l->end || *l->at != '>') {
        l->fault = "a path without '>'";
        return USDA_BAD;
    }
    l->at++;
    return USDA_PATH;
}

static enum usda_token_kind lex(struct usda_lexer *l)
{
    if (l->at == l->end)
        return USDA_END;
    if (*l->at == '\n' || *l->at == ';')
        return lex_newlines(l);
    if (usda_is_letter(*l->at))
        return lex_name(l);
    if (usda_is_digit(*l->at) || *l->at == '-' || *l->at == '+'
        || (*l->at == '.' && l->at + 1 < l->end && usda_is_digit(l->at[1])))
        return lex_number(l);
    if (*l->at == '"' || *l->at == '\'')
        return lex_quoted(l);
    if (*l->at == '<')
        return lex_path(l);
    if (*l->at == '@')
        return lex_until(l, begins(l, "@@@") ? "@@@" : "@", false, USDA_ASSET,
                         "an asset path without a closing '@'");
    l->at++;
    return USDA_MARK;
}

struct usda_token usda_next_token(struct usda_lexer *l)
{
    skip_space(l);
    struct usda_token token = {.begin = l->at, .line_begin = l->line_begin, .line = l->line};
    token.kind = (uint8_t)lex(l);
    token.end = l->at;
    return token;
}

uint32_t usda_column(const struct usda_token *token)
{
    enum { MAX_COLUMN = 4096 };
    uint32_t column = 1;
    for (const char *c = token->line_begin; c < token->begin && column < MAX_COLUMN; c++)
        column += ((unsigned char)*c & 0xc0) != 0x80;
    return column;
}
