// SPDX-License-Identifier: Apache-2.0
/* Reads the values of properties. */
#include "usda/usda.h"

#include "base/num.h"

#include <math.h>

struct text_word usda_unquoted(struct text_word word)
{
    size_t quotes = word.len >= 6 && memcmp(word.bytes, word.bytes + 1, 2) == 0 ? 3 : 1;
    return (struct text_word){word.bytes + quotes, word.len - 2 * quotes};
}

bool usda_next_item(struct text_word *at, struct text_word *out)
{
    struct usda_lexer lexer;
    usda_lexer_init(&lexer, at->bytes, at->len);
    for (;;) {
        struct usda_token token = usda_next_token(&lexer);
        *at = (struct text_word){lexer.at, (size_t)(lexer.end - lexer.at)};
        if (token.kind == USDA_END || token.kind == USDA_BAD)
            return false;
        *out = (struct text_word){token.begin, (size_t)(token.end - token.begin)};
        if (token.kind == USDA_PATH)
            *out = (struct text_word){out->bytes + 1, out->len - 2};
        if (token.kind == USDA_STRING)
            *out = usda_unquoted(*out);
        if (token.kind != USDA_MARK && token.kind != USDA_NEWLINE)
            return true;
    }
}

bool usda_next_number(struct text_word *at, double *out)
{
    struct text_word word;
    while (usda_next_item(at, &word)) {
        float value;
        int64_t whole;
        if (usda_is(word, "true") || usda_is(word, "false"))
            *out = *word.bytes == 't';
        else if (usda_is(word, "inf") || usda_is(word, "-inf"))
            *out = *word.bytes == '-' ? -INFINITY : INFINITY;
        else if (usda_is(word, "nan") || usda_is(word, "-nan"))
            *out = NAN;
        else if (num_parse_int(word.bytes, word.len, &whole) == word.len)
            *out = (double)whole; /* an id has more digits than a float */
        else if (num_parse_float(word.bytes, word.len, &value))
            *out = (double)value;
        else
            continue;
        return true;
    }
    return false;
}

/* The first value of "{ 1: value, 2: value }". */
static struct text_word first_sample(struct text_word samples)
{
    struct usda_lexer lexer;
    struct usda_token token;
    unsigned depth = 0;
    usda_lexer_init(&lexer, samples.bytes, samples.len);
    do
        token = usda_next_token(&lexer);
    while (token.kind != USDA_END && token.kind != USDA_BAD
           && !(token.kind == USDA_MARK && *token.begin == ':'));
    const char *begin = NULL;
    for (;;) {
        token = usda_next_token(&lexer);
        begin = begin ? begin : token.begin;
        bool is_mark = token.kind == USDA_MARK;
        if (token.kind == USDA_END || token.kind == USDA_BAD
            || (!depth && is_mark && strchr(",}", *token.begin)))
            return (struct text_word){begin, (size_t)(token.begin - begin)};
        depth += is_mark && strchr("[({", *token.begin);
        depth -= is_mark && strchr("])}", *token.begin);
    }
}

static bool ends_with(struct text_word word, const char *end)
{
    size_t len = strlen(end);
    return word.len > len && memcmp(word.bytes + word.len - len, end, len) == 0;
}

struct text_word usda_value(const struct usda_property *property)
{
    return ends_with(property->name, USDA_SAMPLES) ? first_sample(property->value)
                                                   : property->value;
}
