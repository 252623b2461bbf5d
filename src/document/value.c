// SPDX-License-Identifier: Apache-2.0
/* Values in document syntax: "0.5", "1, 0, 0", "true" (MaterialX 1.39, "MaterialX Data Types"). */
#include "base/num.h"
#include "document/document.h"

#include <assert.h>
#include <math.h>

static bool is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static size_t skip_spaces(const char *text, size_t len, size_t at)
{
    while (at < len && is_space(text[at]))
        at++;
    return at;
}

/*
 * A separator between numbers: a comma with optional spaces, or only spaces, which MaterialX
 * accepts, too. 0: none.
 */
static size_t skip_separator(const char *text, size_t len, size_t at)
{
    size_t start = at;
    at = skip_spaces(text, len, at);
    if (at < len && text[at] == ',')
        return skip_spaces(text, len, at + 1);
    return at > start ? at : 0;
}

static size_t parse_number(bool integer, const char *text, size_t len, union ir_word *out)
{
    if (!integer)
        return num_parse_float(text, len, &out->f);
    int64_t value;
    size_t read = num_parse_int(text, len, &value);
    if (read == 0 || value < INT32_MIN || value > INT32_MAX)
        return 0;
    out->i = (int32_t)value;
    return read;
}

struct number_text {
    const char *text;
    size_t len;
    bool integer;
    bool loose;              /* what stands behind a number up to the next separator is no fault */
    size_t fault;            /* found: where no number stands */
    size_t rest;             /* found: the first text behind a number; 0: none */
    struct text_word beyond; /* found: the first number that a float cannot hold */
};

/* The place behind a number and its rest. */
static size_t skip_rest(struct number_text *t, size_t at)
{
    size_t end = at;
    while (t->loose && end < t->len && t->text[end] != ',' && !is_space(t->text[end]))
        end++;
    if (end > at && !t->rest)
        t->rest = at;
    return end;
}

/* Reads numbers to the end of the text and returns their count, or -1 at a fault. */
static int64_t find_numbers(struct number_text *t, union ir_word *out, size_t max_kept)
{
    size_t at = skip_spaces(t->text, t->len, 0), count = 0;
    if (at == t->len)
        return 0;
    for (;;) {
        union ir_word word;
        size_t read = parse_number(t->integer, t->text + at, t->len - at, &word);
        t->fault = at;
        if (read == 0)
            return -1;
        if (!t->integer && !isfinite(word.f) && !t->beyond.len)
            t->beyond = (struct text_word){t->text + at, read};
        if (count < max_kept)
            out[count] = word;
        count++;
        at = skip_rest(t, at + read);
        if (skip_spaces(t->text, t->len, at) == t->len)
            return (int64_t)count;
        at = skip_separator(t->text, t->len, at);
        if (at == t->len)
            t->fault = at;
        if (at == 0 || at == t->len)
            return -1;
    }
}

static int64_t parse_numbers(bool integer, const char *text, size_t len, union ir_word *out,
                             size_t max_kept)
{
    struct number_text numbers = {.text = text, .len = len, .integer = integer};
    return find_numbers(&numbers, out, max_kept);
}

static bool parse_bool(const char *text, size_t len, union ir_word *out)
{
    size_t at = skip_spaces(text, len, 0);
    while (len > at && is_space(text[len - 1]))
        len--;
    out->u = len - at == 4 && memcmp(text + at, "true", 4) == 0;
    return out->u || (len - at == 5 && memcmp(text + at, "false", 5) == 0);
}

bool doc_parse_value(doc_type type, const char *text, size_t len, struct strpool *strings,
                     struct ir_value *out)
{
    out->type = doc_type_ir(type);
    switch (type) {
    case DOC_TYPE_boolean: return parse_bool(text, len, &out->w[0]);
    case DOC_TYPE_string:
    case DOC_TYPE_geomname:
        out->w[0].u = strings ? str_intern(strings, text, len) : STR_EMPTY;
        return true;
    default: break;
    }
    unsigned components = doc_type_components(type);
    assert(components <= sizeof out->w / sizeof *out->w);
    return components
           && parse_numbers(type == DOC_TYPE_integer, text, len, out->w, 16) == (int64_t)components;
}

bool doc_is_same_value(doc_type type, const char *one, const char *other)
{
    struct ir_value a, b;
    bool is_same = strcmp(one, other) == 0;
    if (is_same || !doc_type_components(type) || !doc_parse_value(type, one, strlen(one), NULL, &a)
        || !doc_parse_value(type, other, strlen(other), NULL, &b))
        return is_same;
    is_same = true;
    for (unsigned i = 0; i < ir_type_components(a.type) && is_same; i++)
        is_same = ir_type_is_float(a.type) ? a.w[i].f == b.w[i].f : a.w[i].u == b.w[i].u;
    return is_same;
}

static unsigned read_loosely(doc_type type, struct number_text *t, struct ir_value *out)
{
    unsigned components = doc_type_components(type);
    if (!components || type == DOC_TYPE_boolean)
        return 0;
    t->integer = type == DOC_TYPE_integer;
    t->loose = true;
    out->type = doc_type_ir(type);
    int64_t count = find_numbers(t, out->w, sizeof out->w / sizeof *out->w);
    return count > components || (count == components && t->rest) ? (unsigned)count : 0;
}

unsigned doc_read_loosely(doc_type type, const char *text, size_t len, struct ir_value *out)
{
    struct ir_value ignored;
    struct number_text numbers = {.text = text, .len = len};
    return read_loosely(type, &numbers, out ? out : &ignored);
}

/* " (a decimal number has a point: 0.5)" for a float such as "0,5"; otherwise "". */
static const char *decimal_hint(doc_type type, const char *text, unsigned count,
                                struct arena *arena)
{
    const char *comma = strchr(text, ',');
    if (type != DOC_TYPE_float || count != 2 || !comma || strpbrk(text, ". \t-"))
        return "";
    struct text hint;
    text_init(&hint, arena);
    text_fmt(&hint, "; a decimal number has a point: %.*s.%s", (int)(comma - text), text,
             comma + 1);
    return text_cstr(&hint);
}

/* "'0.5.0' is read as '0.5'": of the word around `rest`. */
static void report_rest(const char *text, size_t rest, struct diag_place place,
                        struct diag_list *diags)
{
    size_t start = rest, end = rest;
    while (start > 0 && text[start - 1] != ',' && !is_space(text[start - 1]))
        start--;
    while (text[end] && text[end] != ',' && !is_space(text[end]))
        end++;
    diag_add(diags, DIAG_ID_number_rest, place,
             arena_strndup(diags->arena, text + start, end - start),
             arena_strndup(diags->arena, text + start, rest - start));
}

void doc_report_loose(const struct document *doc, elem_id element, doc_type type,
                      const char *suggestion, struct diag_list *diags)
{
    str_id value = doc_attr_value(doc, element, STR_value);
    struct ir_value ignored;
    struct number_text numbers = {.text = str_text(doc->strings, value),
                                  .len = str_len(doc->strings, value)};
    unsigned count = read_loosely(type, &numbers, &ignored), used = doc_type_components(type);
    struct diag_place place = doc_attr_place(doc, element, STR_value);
    if (numbers.rest)
        report_rest(numbers.text, numbers.rest, place, diags);
    if (count <= used)
        return;
    struct text first;
    text_init(&first, diags->arena);
    text_str(&first, "first");
    if (used > 1)
        text_fmt(&first, " %u", used);
    diag_add(diags, DIAG_ID_excess_numbers, place, numbers.text, count, doc_name(doc, element),
             str_text(doc->strings, doc_type_name(type)), text_cstr(&first),
             used > 1 ? "are" : "is",
             *suggestion ? suggestion : decimal_hint(type, numbers.text, count, diags->arena));
}

void doc_report_infinite(const char *text, struct diag_place place, struct diag_list *diags)
{
    struct number_text numbers = {.text = text, .len = strlen(text), .loose = true};
    find_numbers(&numbers, NULL, 0);
    if (numbers.beyond.len)
        diag_add(diags, DIAG_ID_infinite_number, place,
                 arena_strndup(diags->arena, numbers.beyond.bytes, numbers.beyond.len));
}

bool doc_type_is_float(doc_type type)
{
    bool is_array = type >= DOC_TYPE_integerarray && type <= DOC_TYPE_vector4array;
    return (doc_type_components(type) || is_array) && type != DOC_TYPE_integer
           && type != DOC_TYPE_boolean && type != DOC_TYPE_integerarray;
}

bool doc_value_is_valid(doc_type type, const char *text, size_t len)
{
    struct ir_value value;
    if (doc_type_components(type) || type == DOC_TYPE_boolean)
        return doc_parse_value(type, text, len, NULL, &value);
    if (type < DOC_TYPE_integerarray || type > DOC_TYPE_vector4array)
        return true; /* a string, or a type without a value syntax */
    static const uint8_t group[] = {1, 1, 3, 4, 2, 3, 4};
    assert((size_t)(type - DOC_TYPE_integerarray) < sizeof group);
    int64_t count = parse_numbers(type == DOC_TYPE_integerarray, text, len, NULL, 0);
    return count >= 0 && count % group[type - DOC_TYPE_integerarray] == 0;
}

bool doc_type_is_color(doc_type type)
{
    return type == DOC_TYPE_color3 || type == DOC_TYPE_color4;
}

/* Why a number is no integer; NULL: the word is no number. */
static const char *fault_of_integer(const char *word, size_t len)
{
    float number;
    if (num_parse_float(word, len, &number) != len)
        return NULL;
    return strspn(word, "+-0123456789") >= len
               ? "it is beyond the integers, which are -2147483648 to 2147483647"
               : "an integer has no fraction and no exponent";
}

const char *doc_value_fault(doc_type type, const char *text, size_t len, struct arena *arena)
{
    struct text message;
    size_t end;
    bool integer = type == DOC_TYPE_integer || type == DOC_TYPE_integerarray;
    struct number_text numbers = {.text = text, .len = len, .integer = integer};
    text_init(&message, arena);
    if (type == DOC_TYPE_boolean)
        return ": expected 'true' or 'false'";
    int64_t count = find_numbers(&numbers, NULL, 0);
    size_t fault = numbers.fault;
    if (count >= 0) {
        text_fmt(&message, ": it has %d number%s", (int)count, count == 1 ? "" : "s");
        if (doc_type_components(type))
            text_fmt(&message, " instead of %u", doc_type_components(type));
        return text_cstr(&message);
    }
    assert(fault <= len);
    for (end = fault; end < len && text[end] != ',' && !is_space(text[end]);)
        end++;
    if (end == fault)
        return ": a number is missing after a comma";
    unsigned components = doc_type_components(type);
    bool is_all = !fault && end == len; /* the message has the word already */
    const char *of_integer = integer ? fault_of_integer(text + fault, end - fault) : NULL;
    if (of_integer)
        text_fmt(&message, ": %s", of_integer);
    else if (is_all && components)
        text_fmt(&message, components > 1 ? ": expected %u numbers" : ": expected a number",
                 components);
    else
        text_fmt(&message, ": '%.*s' is not a valid %s", (int)(end - fault), text + fault,
                 integer ? "integer" : "number");
    return text_cstr(&message);
}

void doc_report_value(doc_type type, const char *type_name, const char *text,
                      struct diag_place place, struct diag_list *diags)
{
    diag_add(diags, DIAG_ID_bad_value, place, text, type_name,
             doc_value_fault(type, text, strlen(text), diags->arena));
}
