// SPDX-License-Identifier: Apache-2.0
#include "ir_text.h"

#include "base/num.h"
#include "ir/ir_priv.h"

#include <math.h>

struct parser {
    struct ir_graph *graph;
    const char *at, *end;
    struct strpool labels;
    VEC(ir_ref) label_refs; /* node by label id; 0 = not defined */
    VEC(ir_ref) roots;
    VEC(ir_ref) operands; /* operands of the current statement */
};

static void skip_blanks(struct parser *p)
{
    while (p->at < p->end && (*p->at == ' ' || *p->at == '\t' || *p->at == '\r'))
        p->at++;
}

static char peek(struct parser *p)
{
    skip_blanks(p);
    return p->at < p->end ? *p->at : '\n';
}

/* This function and those below return false if something else stands there. */
static bool accept(struct parser *p, char c)
{
    if (peek(p) != c || p->at == p->end)
        return false;
    p->at++;
    return true;
}

static bool at_line_end(struct parser *p)
{
    char c = peek(p);
    return c == '\n' || c == ';';
}

static bool is_word_char(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

struct word {
    const char *text;
    size_t len;
};

static struct word read_word(struct parser *p)
{
    skip_blanks(p);
    struct word word = {p->at, 0};
    while (p->at < p->end && is_word_char(*p->at))
        p->at++;
    word.len = (size_t)(p->at - word.text);
    return word;
}

static bool is_word(struct word word, const char *text)
{
    return strlen(text) == word.len && memcmp(word.text, text, word.len) == 0;
}

static bool accept_word(struct parser *p, const char *text)
{
    const char *start = p->at;
    if (is_word(read_word(p), text))
        return true;
    p->at = start;
    return false;
}

static bool read_u32(struct parser *p, uint32_t *out)
{
    int64_t value;
    skip_blanks(p);
    size_t n = num_parse_int(p->at, (size_t)(p->end - p->at), &value);
    if (n == 0 || value < 0 || value > UINT32_MAX)
        return false;
    p->at += n;
    *out = (uint32_t)value;
    return true;
}

static int hex_digit(char c)
{
    return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/*
 * The character of an escape: '"', '\\' or u00XX, as text_json_string writes them. 0 for any other
 * escape.
 */
static char read_escape(struct parser *p)
{
    if (p->at == p->end)
        return 0;
    char c = *p->at++;
    if (c != 'u')
        return c == '"' || c == '\\' ? c : 0;
    if (p->end - p->at < 4 || p->at[0] != '0' || p->at[1] != '0' || hex_digit(p->at[2]) < 0
        || hex_digit(p->at[3]) < 0)
        return 0;
    c = (char)(hex_digit(p->at[2]) << 4 | hex_digit(p->at[3]));
    p->at += 4;
    return c;
}

static bool read_string(struct parser *p, str_id *out)
{
    if (!p->graph->strings || !accept(p, '"'))
        return false;
    struct text text;
    text_init(&text, p->graph->arena);
    for (;;) {
        if (p->at == p->end || *p->at == '\n')
            return false;
        char c = *p->at++;
        if (c == '"')
            break;
        if (c == '\\')
            c = read_escape(p);
        if (c == '\0')
            return false;
        text_char(&text, c);
    }
    *out = str_intern(p->graph->strings, text.data, text.len);
    return true;
}

static bool read_type(struct parser *p, ir_type_id *out)
{
    if (accept(p, '$')) {
        uint32_t index;
        if (!read_u32(p, &index) || index >= p->graph->user_types.len)
            return false;
        *out = (ir_type_id)(IR_TYPE_FIRST_USER + index);
        return true;
    }
    struct word word = read_word(p);
    for (unsigned type = 0; type < IR_NUM_TYPES; type++) {
        if (is_word(word, ir_type_text((ir_type_id)type))) {
            *out = (ir_type_id)type;
            return true;
        }
    }
    return false;
}

/* ---- Constants ---- */

static bool read_float(struct parser *p, union ir_word *out)
{
    skip_blanks(p);
    if (accept_word(p, "nan"))
        return accept(p, '#') && read_u32(p, &out->u) && isnan(out->f);
    const char *start = p->at;
    bool negative = accept(p, '-');
    if (accept_word(p, "inf")) {
        out->f = negative ? -INFINITY : INFINITY;
        return true;
    }
    p->at = start;
    size_t n = num_parse_float(p->at, (size_t)(p->end - p->at), &out->f);
    p->at += n;
    return n > 0;
}

static bool read_integer(struct parser *p, ir_type_id scalar, union ir_word *out)
{
    int64_t value, least = scalar == IR_TYPE_INT ? INT32_MIN : 0,
                   most = scalar == IR_TYPE_INT ? INT32_MAX : UINT32_MAX;
    skip_blanks(p);
    size_t n = num_parse_int(p->at, (size_t)(p->end - p->at), &value);
    if (n == 0 || value < least || value > most)
        return false;
    p->at += n;
    out->u = (uint32_t)value;
    return scalar == IR_TYPE_INT || accept(p, 'u');
}

static bool read_bool(struct parser *p, union ir_word *out)
{
    out->u = accept_word(p, "true");
    return out->u || accept_word(p, "false");
}

static bool read_scalar(struct parser *p, ir_type_id scalar, union ir_word *out)
{
    switch (scalar) {
    case IR_TYPE_BOOL: return read_bool(p, out);
    case IR_TYPE_INT:
    case IR_TYPE_UINT: return read_integer(p, scalar, out);
    case IR_TYPE_STRING: return read_string(p, &out->u);
    case IR_TYPE_FLOAT: return read_float(p, out);
    default: return false;
    }
}

/*
 * The type of the number that begins here: digits alone are an int, digits and 'u' a uint, all else
 * a float.
 */
static ir_type_id number_type(const struct parser *p)
{
    const char *c = p->at;
    if (c < p->end && *c == '-')
        c++;
    const char *digits = c;
    while (c < p->end && *c >= '0' && *c <= '9')
        c++;
    bool ends = c == p->end || (!is_word_char(*c) && *c != '.');
    if (c > digits && c < p->end && *c == 'u')
        return IR_TYPE_UINT;
    return c > digits && ends ? IR_TYPE_INT : IR_TYPE_FLOAT;
}

static bool read_const(struct parser *p, ir_ref *out)
{
    char c = peek(p);
    const char *start = p->at;
    struct word word = read_word(p);
    bool has_parts = word.len && peek(p) == '(';
    p->at = start;
    ir_type_id type = IR_TYPE_STRING;
    union ir_word words[16];
    if (has_parts) {
        if (!read_type(p, &type) || type >= IR_TYPE_FIRST_USER || !accept(p, '('))
            return false;
    } else if (is_word(word, "true") || is_word(word, "false")) {
        type = IR_TYPE_BOOL;
    } else if (c != '"') {
        type = number_type(p);
    }
    const struct ir_type_info *info = ir_type_info(type);
    for (unsigned i = 0; i < info->components; i++)
        if ((i && !accept(p, ',')) || !read_scalar(p, info->scalar, &words[i]))
            return false;
    if (info->components == 0 || (has_parts && !accept(p, ')')))
        return false;
    *out = ir_intern_const(p->graph, type, words);
    return true;
}

/* ---- Operands ---- */

static ir_ref *label_place(struct parser *p)
{
    struct word word = read_word(p);
    if (word.len == 0)
        return NULL;
    str_id id = str_intern(&p->labels, word.text, word.len);
    while (p->label_refs.len <= id)
        vec_push(p->graph->arena, &p->label_refs, 0);
    return &p->label_refs.items[id];
}

static bool read_operand(struct parser *p, ir_ref *out)
{
    if (accept(p, '%')) {
        const ir_ref *place = label_place(p);
        *out = place ? *place : 0;
        return *out != 0;
    }
    *out = 0;
    return accept_word(p, "_") || read_const(p, out);
}

static bool read_operands(struct parser *p)
{
    p->operands.len = 0;
    if (at_line_end(p))
        return true;
    do {
        ir_ref ref;
        if (!read_operand(p, &ref))
            return false;
        vec_push(p->graph->arena, &p->operands, ref);
    } while (accept(p, ','));
    return true;
}

/* Operands of `return` and `results`, which must exist. */
static bool read_refs(struct parser *p)
{
    if (!read_operands(p))
        return false;
    for (uint32_t i = 0; i < p->operands.len; i++)
        if (p->operands.items[i] == 0)
            return false;
    return p->operands.len > 0;
}

/* ---- Statements ---- */

static bool read_swizzle(struct parser *p, uint32_t *out)
{
    struct word word = read_word(p);
    if (word.len < 1 || word.len > 4)
        return false;
    *out = (uint32_t)word.len << 8;
    for (size_t i = 0; i < word.len; i++) {
        const char *letter = memchr("xyzw", word.text[i], 4);
        if (!letter)
            return false;
        *out |= (uint32_t)(letter - "xyzw") << (2 * i);
    }
    return true;
}

static bool read_attr(struct parser *p, enum ir_op op, uint32_t *out)
{
    *out = 0;
    if (op == IR_SWIZZLE)
        return accept(p, '.') && read_swizzle(p, out);
    if (!accept(p, '@'))
        return true;
    if (!read_u32(p, out) || op != IR_PARAM)
        return op != IR_PARAM;
    uint32_t index;
    if (!accept(p, ':') || !read_u32(p, &index) || *out > 0xffff || index > 0xffff)
        return false;
    *out = *out << 16 | index;
    return true;
}

static bool read_op(struct parser *p, enum ir_op *out)
{
    struct word word = read_word(p);
    for (unsigned op = 0; op < IR_NUM_OPS; op++) {
        if (is_word(word, ir_op_info((enum ir_op)op)->text)) {
            *out = (enum ir_op)op;
            return true;
        }
    }
    return false;
}

static bool parse_node(struct parser *p)
{
    ir_ref *label = label_place(p);
    enum ir_op op;
    ir_type_id type;
    uint32_t attr;
    if (!label || *label || !accept(p, '='))
        return false;
    size_t index = (size_t)(label - p->label_refs.items); /* reading operands may move the array */
    if (!read_op(p, &op) || !read_type(p, &type) || !read_attr(p, op, &attr) || !read_operands(p)
        || ir_node_problem(p->graph, op, type, attr, p->operands.items, p->operands.len))
        return false;
    p->label_refs.items[index] =
        ir_build(p->graph, op, type, attr, p->operands.items, p->operands.len);
    return true;
}

static bool parse_array(struct parser *p)
{
    ir_type_id element;
    uint32_t length, num_types = p->graph->user_types.len;
    return read_type(p, &element) && read_u32(p, &length) && length
           && ir_add_array(p->graph, element, length) == IR_TYPE_FIRST_USER + num_types;
}

static bool parse_struct(struct parser *p)
{
    VEC(struct ir_member) members = {0};
    str_id name;
    uint32_t num_types = p->graph->user_types.len;
    if (!read_string(p, &name))
        return false;
    do {
        struct ir_member member;
        if (!read_type(p, &member.type) || !read_string(p, &member.name))
            return false;
        vec_push(p->graph->arena, &members, member);
    } while (accept(p, ','));
    return members.len <= UINT16_MAX
           && ir_add_struct(p->graph, name, members.items, members.len)
                  == IR_TYPE_FIRST_USER + num_types;
}

static bool parse_callee(struct parser *p)
{
    struct ir_callee callee = {0};
    uint32_t num_callees = p->graph->callees.len;
    if (!read_string(p, &callee.name))
        return false;
    struct word kind = read_word(p);
    while (callee.kind < IR_NUM_CALLEE_KINDS && !is_word(kind, ir_callee_kinds[callee.kind]))
        callee.kind++;
    if (callee.kind == IR_NUM_CALLEE_KINDS || !read_u32(p, &callee.index))
        return false;
    callee.derivative = accept_word(p, "derivative");
    callee.pure = accept_word(p, "pure");
    return ir_add_callee(p->graph, callee) == num_callees;
}

static bool parse_function(struct parser *p)
{
    VEC(ir_type_id) types = {0};
    str_id name;
    if (!read_string(p, &name))
        return false;
    while (types.len ? accept(p, ',') : !at_line_end(p)) {
        ir_type_id type;
        if (!read_type(p, &type))
            return false;
        vec_push(p->graph->arena, &types, type);
    }
    if (types.len > 0xffff || p->graph->functions.len > 0xffff)
        return false;
    ir_add_function(p->graph, name, types.items, types.len);
    return true;
}

static bool parse_results(struct parser *p)
{
    uint32_t function;
    if (!read_u32(p, &function) || function >= p->graph->functions.len
        || p->graph->functions.items[function].num_results || !accept(p, '=') || !read_refs(p))
        return false;
    ir_set_results(p->graph, function, p->operands.items, p->operands.len);
    return true;
}

static bool parse_return(struct parser *p)
{
    if (!read_refs(p))
        return false;
    memcpy(vec_extend(p->graph->arena, &p->roots, p->operands.len), p->operands.items,
           p->operands.len * sizeof *p->operands.items);
    return true;
}

static bool parse_statement(struct parser *p)
{
    static const struct {
        const char *word;
        bool (*parse)(struct parser *p);
    } statements[] = {
        {"struct", parse_struct},     {"array", parse_array},     {"callee", parse_callee},
        {"function", parse_function}, {"results", parse_results}, {"return", parse_return},
    };
    if (accept(p, '%'))
        return parse_node(p);
    struct word word = read_word(p);
    for (size_t i = 0; i < sizeof statements / sizeof *statements; i++)
        if (is_word(word, statements[i].word))
            return statements[i].parse(p);
    return false;
}

static void skip_comment(struct parser *p)
{
    if (peek(p) == ';')
        while (p->at < p->end && *p->at != '\n')
            p->at++;
}

uint32_t ir_text_read(struct ir_graph *graph, const char *text, ir_ref **out_roots,
                      uint32_t *out_num_roots)
{
    struct parser p = {.graph = graph, .at = text, .end = text + strlen(text)};
    strpool_init(&p.labels, graph->arena, NULL);
    for (uint32_t line = 1; p.at < p.end; line++) {
        if (!at_line_end(&p) && !parse_statement(&p))
            return line;
        skip_comment(&p);
        if (p.at < p.end && *p.at++ != '\n')
            return line;
    }
    *out_roots = p.roots.items;
    *out_num_roots = p.roots.len;
    return 0;
}
