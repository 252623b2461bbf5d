// SPDX-License-Identifier: Apache-2.0
/* Values in document syntax: "0.5", "1, 0, 0", "true" (MaterialX 1.39, "MaterialX Data Types"). */
#include "base/num.h"
#include "document/document.h"

#include <assert.h>

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

/*
 * Reads numbers to the end of the text and returns their count, or -1 if the text at *out_fault is
 * not a number.
 */
static int64_t find_numbers(bool integer, const char *text, size_t len, union ir_word *out,
                            size_t max_kept, size_t *out_fault)
{
    size_t at = skip_spaces(text, len, 0), count = 0;
    if (at == len)
        return 0;
    for (;;) {
        union ir_word word;
        size_t read = parse_number(integer, text + at, len - at, &word);
        *out_fault = at;
        if (read == 0)
            return -1;
        if (count < max_kept)
            out[count] = word;
        count++;
        if (skip_spaces(text, len, at + read) == len)
            return (int64_t)count;
        at = skip_separator(text, len, at + read);
        if (at == len)
            *out_fault = at;
        if (at == 0 || at == len)
            return -1;
    }
}

static int64_t parse_numbers(bool integer, const char *text, size_t len, union ir_word *out,
                             size_t max_kept)
{
    size_t fault;
    return find_numbers(integer, text, len, out, max_kept, &fault);
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

unsigned doc_excess_numbers(doc_type type, const char *text, size_t len, struct ir_value *out)
{
    struct ir_value ignored;
    unsigned components = doc_type_components(type);
    if (!components || type == DOC_TYPE_boolean)
        return 0;
    out = out ? out : &ignored;
    out->type = doc_type_ir(type);
    int64_t count =
        parse_numbers(type == DOC_TYPE_integer, text, len, out->w, sizeof out->w / sizeof *out->w);
    return count > components ? (unsigned)count : 0;
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

void doc_report_excess(const struct document *doc, elem_id element, doc_type type,
                       const char *suggestion, struct diag_list *diags)
{
    str_id value = doc_attr_value(doc, element, STR_value);
    const char *text = str_text(doc->strings, value);
    unsigned count = doc_excess_numbers(type, text, str_len(doc->strings, value), NULL),
             used = doc_type_components(type);
    struct text first;
    text_init(&first, diags->arena);
    text_str(&first, "first");
    if (used > 1)
        text_fmt(&first, " %u", used);
    diag_add(diags, DIAG_ID_excess_numbers, doc_attr_place(doc, element, STR_value), text, count,
             str_text(doc->strings, doc_element(doc, element)->name),
             str_text(doc->strings, doc_type_name(type)), text_cstr(&first),
             used > 1 ? "are" : "is",
             *suggestion ? suggestion : decimal_hint(type, text, count, diags->arena));
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

const char *doc_value_fault(doc_type type, const char *text, size_t len, struct arena *arena)
{
    struct text message;
    size_t fault = 0, end;
    bool integer = type == DOC_TYPE_integer || type == DOC_TYPE_integerarray;
    text_init(&message, arena);
    if (type == DOC_TYPE_boolean)
        return ": it is 'true' or 'false'";
    int64_t count = find_numbers(integer, text, len, NULL, 0, &fault);
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
    float number;
    if (integer && num_parse_float(text + fault, end - fault, &number) == end - fault)
        return ": an integer has no fraction and no exponent";
    unsigned components = doc_type_components(type);
    if (!fault && end == len && components) { /* the message has the word already */
        text_fmt(&message, components > 1 ? ": it is %u numbers" : ": it is a number", components);
        return text_cstr(&message);
    }
    text_fmt(&message, ": '%.*s' is not a valid %s", (int)(end - fault), text + fault,
             integer ? "integer" : "number");
    return text_cstr(&message);
}
