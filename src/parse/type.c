// SPDX-License-Identifier: Apache-2.0
/* Parses types. */
#include "parse/parse_priv.h"

#include <assert.h>

bool parse_at_type(struct parser *p)
{
    if (p->token.kind != TOKEN_NAME)
        return false;
    struct token next = parse_peek(p);
    return next.kind == TOKEN_NAME
           || (next.kind == TOKEN_OPEN_INDEX
               && lookup_type(p->unit, p->token.text, p->token.len) != IR_TYPE_VOID);
}

ir_type_id parse_type(struct parser *p, bool may_be_void, bool *out_bad)
{
    struct token token = p->token;
    *out_bad = true;
    if (token.kind != TOKEN_NAME) {
        parse_unexpected(p, "a type");
        return IR_TYPE_VOID;
    }
    parse_advance(p);
    ir_type_id type = lookup_type(p->unit, token.text, token.len);
    *out_bad = type == IR_TYPE_VOID && !(may_be_void && parse_is_word(&token, "void"));
    if (!*out_bad)
        return type;
    const char *word = parse_token_text(p, &token);
    if (parse_is_word(&token, "void"))
        PARSE_TYPE_ERROR(p, parse_place(&token), "nothing but a function can have type void");
    else
        PARSE_ERROR(p, parse_where_token(p, &token), lang_unknown, "type", word,
                    lookup_suggest(p, word, LOOKUP_TYPES));
    return IR_TYPE_VOID;
}

static ir_type_id sized_array(struct parser *p, ir_type_id element, uint32_t place)
{
    struct parse_mark mark = parse_mark(p->unit);
    struct ir_value length = {0};
    lang_ref size = parse_expression(p);
    bool constant = size && check_value(p, size, &length);
    uint32_t size_place = size ? tree_place(p, size) : place;
    parse_drop_tree(p, &mark, 0);
    if (!size || element == IR_TYPE_VOID)
        return IR_TYPE_VOID;
    bool integer = constant && (length.type == IR_TYPE_INT || length.type == IR_TYPE_UINT);
    if (!integer || length.w[0].u == 0 || length.w[0].u > PARSE_MAX_ARRAY) {
        PARSE_TYPE_ERROR(p, size_place,
                         "the length of an array must be a constant int from 1 to %d",
                         PARSE_MAX_ARRAY);
        return IR_TYPE_VOID;
    }
    ir_type_id type = lookup_array(p->unit, element, length.w[0].u);
    if (type == IR_TYPE_VOID)
        PARSE_ERROR(p, parse_where(p, place, 0), lang_limit,
                    parse_say(p,
                              "there are too many structs and arrays, or this one has more "
                              "than %d numbers",
                              LANG_MAX_WORDS));
    return type;
}

ir_type_id parse_array_suffix(struct parser *p, ir_type_id element, bool *out_unsized)
{
    uint32_t place = parse_place(&p->token), length;
    ir_type_id inner, type = IR_TYPE_VOID;
    assert(p->token.kind == TOKEN_OPEN_INDEX);
    parse_advance(p);
    bool unsized = p->token.kind == TOKEN_CLOSE_INDEX;
    if (unsized && !out_unsized)
        PARSE_TYPE_ERROR(p, place, "this array needs a length");
    else if (!unsized)
        type = sized_array(p, element, place);
    bool nested = p->token.kind == TOKEN_CLOSE_INDEX && parse_peek(p).kind == TOKEN_OPEN_INDEX;
    bool opaque = element == IR_TYPE_STRING || element == IR_TYPE_SAMPLER;
    if (nested || opaque || check_is_array(p, element, &inner, &length)) {
        PARSE_TYPE_ERROR(p, place, "there are no arrays of %s",
                         nested ? "arrays" : parse_type_text(p, element));
        p->panic |= nested;
        type = IR_TYPE_VOID;
    } else if (unsized && out_unsized) {
        *out_unsized = element != IR_TYPE_VOID;
    }
    parse_expect(p, TOKEN_CLOSE_INDEX);
    return type;
}
