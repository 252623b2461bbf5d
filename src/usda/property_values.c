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

/* Reads on to a mark that is in no brackets; the token before it is the last. */
static struct text_word read_until(struct usda_lexer *lexer, const char *marks, char *out_mark)
{
    const char *begin = NULL;
    for (unsigned depth = 0;;) {
        struct usda_token token = usda_next_token(lexer);
        bool is_mark = token.kind == USDA_MARK;
        begin = begin ? begin : token.begin;
        *out_mark = is_mark ? *token.begin : '\0';
        if (token.kind == USDA_END || token.kind == USDA_BAD
            || (!depth && is_mark && strchr(marks, *token.begin)))
            return (struct text_word){begin, (size_t)(token.begin - begin)};
        depth += is_mark && strchr("[({", *token.begin);
        depth -= is_mark && strchr("])}", *token.begin);
    }
}

/* The value of "{ 2: value, 1: value }" with the least time. */
static struct text_word first_sample(struct text_word samples)
{
    struct usda_lexer lexer;
    struct text_word first = {0};
    double first_time = INFINITY;
    char mark;
    usda_lexer_init(&lexer, samples.bytes, samples.len);
    read_until(&lexer, "{", &mark);
    while (mark == '{' || mark == ',') {
        double time = INFINITY;
        struct text_word at = read_until(&lexer, ":}", &mark);
        if (mark != ':')
            break;
        usda_next_number(&at, &time);
        struct text_word value = read_until(&lexer, ",}", &mark);
        if (!first.bytes || time < first_time) {
            first = value;
            first_time = time;
        }
    }
    return first;
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
