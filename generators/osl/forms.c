// SPDX-License-Identifier: Apache-2.0
/*
 * Forms of operations that depend on types. OSL's vectors have three components, so vectors of two
 * and four are structs, and operations on them are functions that the file declares (helpers.def;
 * by component if it has no row). Operators of structs are OSL overloads: `a + b` calls
 * __operator__add__.
 */
#include "generators/osl/osl.h"

#include <assert.h>

static const char parts[] = "xyzw";

static bool is_vector(ir_type_id type)
{
    return osl_is_struct(type) || type == IR_TYPE_VEC3;
}

/* ---- Forms made here: they live until the file is complete ---- */

static const struct lang_pieces *usual_form(const struct osl *osl, enum ir_op op)
{
    return lang_style_form(osl->spell->style, op);
}

/* "name($0, $1)". `order` gives the operands as digits; NULL: in their own order. */
static const struct lang_pieces *call_form(struct osl *osl, const char *name, unsigned num_operands,
                                           const char *order)
{
    struct text text;
    text_init(&text, osl->spell->scratch);
    text_str(&text, name);
    for (unsigned i = 0; i < num_operands; i++)
        text_fmt(&text, "%s$%c", i ? ", " : "(", order ? order[i] : (char)('0' + i));
    text_char(&text, ')');
    return lang_form_of(osl->spell->scratch, text_cstr(&text), LANG_PREC_POSTFIX);
}

/* ---- Helpers ---- */

struct helper_row {
    uint8_t op; /* enum ir_op */
    const char *types, *name, *text;
};

static const struct helper_row helper_rows[] = {
#define HELPER(op, types, name, text) {IR_##op, types, name, text},
#include "generators/osl/helpers.def"
};

enum { NUM_HELPERS = sizeof helper_rows / sizeof *helper_rows };

void osl_index_helpers(struct osl *osl)
{
    static_assert(NUM_HELPERS < UINT8_MAX, "the index has bytes");
    for (unsigned i = NUM_HELPERS; i-- > 0;)
        osl->first_helper[helper_rows[i].op] = (uint8_t)(i + 1);
}

static bool fits(const struct helper_row *row, const struct lang_use *use)
{
    unsigned i = 0;
    /* of an unsigned number, only the conversion to float is a function */
    if (row->op == IR_CONVERT && use->operands[0] == IR_TYPE_UINT && use->type != IR_TYPE_FLOAT)
        return false;
    while (i < use->num_operands && row->types[i] == osl_type_letter(use->operands[i]))
        i++;
    return i == use->num_operands && !row->types[i];
}

static const struct helper_row *find_helper(const struct osl *osl, const struct lang_use *use)
{
    unsigned first = osl->first_helper[use->op];
    for (unsigned i = first; first && i <= NUM_HELPERS; i++)
        if (helper_rows[i - 1].op == use->op && fits(&helper_rows[i - 1], use))
            return &helper_rows[i - 1];
    return NULL;
}

/* The name of a helper contains the types of its operands and of its result. */
static void add_row(struct osl *osl, const struct helper_row *row, const struct lang_use *use)
{
    osl_type(osl, use->type);
    for (unsigned i = 0; i < use->num_operands; i++)
        osl_type(osl, use->operands[i]);
    osl_add_helper(osl, row->text);
}

static const struct lang_pieces *helper_form(struct osl *osl, const struct helper_row *row,
                                             const struct lang_use *use)
{
    add_row(osl, row, use);
    if (strncmp(row->name, "__operator__", 12) == 0)
        return usual_form(osl, use->op);
    return call_form(osl, row->name, use->num_operands, use->op == IR_SELECT ? "210" : NULL);
}

/* ---- By component ---- */

static const char *operator_word(enum ir_op op)
{
    switch (op) {
    case IR_NEG: return "__operator__neg__";
    case IR_ADD: return "__operator__add__";
    case IR_SUB: return "__operator__sub__";
    case IR_MUL: return "__operator__mul__";
    case IR_DIV: return "__operator__div__";
    case IR_REM: return "__operator__mod__";
    default: return NULL;
    }
}

/* The names of operators that are functions; some of the ops' own names are words of OSL. */
static const char *const function_names[IR_NUM_OPS] = {
    [IR_AND] = "bit_and",
    [IR_OR] = "bit_or",
    [IR_XOR] = "bit_xor",
    [IR_SHL] = "shift_left",
    [IR_SHR] = "shift_right",
    [IR_BITNOT] = "bit_not",
    [IR_FLOAT_TO_INT_BITS] = "int_bits",
    [IR_FLOAT_TO_UINT_BITS] = "unsigned_bits",
};

/*
 * "min" for the form "min($0, $1)"; the op's own name if the form is no call. A conversion has its
 * result in its name, because OSL does not choose a function by its result.
 */
static const char *function_name(struct osl *osl, enum ir_op op, ir_type_id type,
                                 const struct lang_pieces *scalar)
{
    if (op == IR_CONVERT) {
        struct text name;
        text_init(&name, osl->spell->scratch);
        text_fmt(&name, "to_%s", osl_type(osl, type));
        return text_cstr(&name);
    }
    if (function_names[op])
        return function_names[op];
    const char *end = strchr(scalar->text, '(');
    size_t len = end ? (size_t)(end - scalar->text) : 0;
    if (len == 0 || memchr(scalar->text, ' ', len) || memchr(scalar->text, '$', len))
        return ir_op_info(op)->text;
    return arena_strndup(osl->spell->scratch, scalar->text, len);
}

static ir_type_id scalar_of(ir_type_id type)
{
    return is_vector(type) ? ir_type_info(type)->scalar : type;
}

/*
 * A form of the operands ("$0", if `named`) or of the parameters a, b…; for operands with parts, a
 * form of one part.
 */
static void write_part(struct osl *osl, const char *form, const struct lang_use *use,
                       unsigned component, bool named, struct text *out)
{
    for (const char *p = form; *p; p++) {
        if (*p != '$') {
            text_char(out, *p);
            continue;
        }
        p++;
        if (*p == 'T') {
            text_str(out, osl_type(osl, scalar_of(use->type)));
            continue;
        }
        unsigned index = (unsigned)(*p - '0');
        text_fmt(out, named ? "$%u" : "%c", named ? index : 'a' + index);
        if (ir_type_components(use->operands[index]) > 1)
            text_fmt(out, ".%c", parts[component]);
    }
}

/* "vector2 min(vector2 a, float b)\n{\n    return vector2(min(a.x, b), min(a.y, b));\n}\n" */
static void write_component_function(struct osl *osl, const char *name, const struct lang_use *use,
                                     const struct lang_pieces *scalar, struct text *out)
{
    text_fmt(out, "%s %s(", osl_type(osl, use->type), name);
    for (unsigned i = 0; i < use->num_operands; i++)
        text_fmt(out, "%s%s %c", i ? ", " : "", osl_type(osl, use->operands[i]), (char)('a' + i));
    text_fmt(out, ")\n{\n    return %s(", osl_type(osl, use->type));
    for (unsigned i = 0; i < ir_type_components(use->type); i++) {
        text_str(out, i ? ", " : "");
        write_part(osl, scalar->text, use, i, false, out);
    }
    text_str(out, ");\n}\n");
}

/*
 * "vector2($0.x + $1.x, $0.y + $1.y)": names and numbers as operands need no function; NULL: other
 * operands do.
 */
static const struct lang_pieces *pair_form(struct osl *osl, const struct lang_use *use,
                                           const struct lang_pieces *scalar)
{
    uint32_t all = (1u << use->num_operands) - 1;
    if (use->type != IR_TYPE_VEC2 || (use->named & all) != all || 2 * scalar->num > LANG_MAX_PIECES)
        return NULL;
    struct text text;
    text_init(&text, osl->spell->scratch);
    text_fmt(&text, "%s(", osl_type(osl, use->type));
    write_part(osl, scalar->text, use, 0, true, &text);
    text_str(&text, ", ");
    write_part(osl, scalar->text, use, 1, true, &text);
    text_char(&text, ')');
    return lang_form_of(osl->spell->scratch, text_cstr(&text), LANG_PREC_POSTFIX);
}

static const struct lang_pieces *component_form(struct osl *osl, const struct lang_use *use)
{
    ir_type_id scalars[16];
    struct lang_use each = *use;
    each.op = ir_op_of_component(use->op);
    each.type = scalar_of(use->type);
    each.operands = scalars;
    each.node = 0;
    for (unsigned i = 0; i < use->num_operands; i++)
        scalars[i] = scalar_of(use->operands[i]);
    const struct lang_pieces *scalar = osl_form(osl->spell, &each);
    if (!scalar)
        scalar = usual_form(osl, each.op);
    if (!scalar || !scalar->text)
        return NULL;
    const struct lang_pieces *pair = pair_form(osl, use, scalar);
    if (pair)
        return pair;
    const char *word = operator_word(use->op),
               *name = word ? word : function_name(osl, use->op, use->type, scalar);
    struct text text;
    text_init(&text, osl->spell->scratch);
    write_component_function(osl, name, use, scalar, &text);
    const char *body = text_cstr(&text);
    osl_add_helper(osl, body);
    return word ? usual_form(osl, use->op) : call_form(osl, name, use->num_operands, NULL);
}

/* ---- Taking apart and putting together ---- */

static bool is_color_operand(const struct osl *osl, const struct lang_use *use, unsigned index)
{
    return use->node
           && osl->kinds[ir_arg(osl->spell->shader->graph, use->node, index)] == OSL_COLOR;
}

/* "$0.x", "vector2($0.y, $0.x)". An operand that is no variable needs a function. */
static const struct lang_pieces *swizzle_form(struct osl *osl, const struct lang_use *use)
{
    unsigned count = use->attr >> 8;
    bool named = use->named & 1;
    struct text text, name;
    text_init(&text, osl->spell->scratch);
    text_init(&name, osl->spell->scratch);
    const char *letters = named && is_color_operand(osl, use, 0) ? "rgba" : parts,
               *whole = named ? "$0" : "v";
    if (count > 1)
        text_fmt(&text, "%s(", osl_type(osl, use->type));
    for (unsigned i = 0; i < count; i++) {
        unsigned index = use->attr >> 2 * i & 3;
        text_fmt(&text, "%s%s.%c", i ? ", " : "", whole, letters[index]);
        text_char(&name, parts[index]);
    }
    if (count > 1)
        text_char(&text, ')');
    if (named)
        return lang_form_of(osl->spell->scratch, text_cstr(&text), LANG_PREC_POSTFIX);
    struct text function;
    text_init(&function, osl->spell->scratch);
    text_fmt(&function, "%s %s_of(%s v)\n{\n    return %s;\n}\n", osl_type(osl, use->type),
             text_cstr(&name), osl_type(osl, use->operands[0]), text_cstr(&text));
    osl_add_helper(osl, text_cstr(&function));
    text_str(&name, "_of");
    return call_form(osl, text_cstr(&name), 1, NULL);
}

/*
 * The parts of all operands in sequence: of "$0", "$1"… if `named`, else of the parameters a, b…
 */
static void write_parts(const struct osl *osl, const struct lang_use *use, bool named,
                        struct text *out)
{
    unsigned left = ir_type_components(use->type), wanted = use->num_operands == 1 ? 1 : left;
    for (unsigned i = 0; i < use->num_operands; i++) {
        unsigned n = ir_type_components(use->operands[i]);
        for (unsigned k = 0; k < n && left; k++, left--) {
            text_str(out, left == ir_type_components(use->type) ? "" : ", ");
            text_fmt(out, named ? "$%u" : "%c", named ? i : 'a' + i);
            if (n > 1)
                text_fmt(out, ".%c", (named && is_color_operand(osl, use, i) ? "rgba" : parts)[k]);
        }
    }
    /* one scalar fills all components */
    for (; wanted == 1 && left && ir_type_components(use->operands[0]) == 1; left--)
        text_str(out, named ? ", $0" : ", a");
}

static bool all_named(const struct lang_use *use)
{
    for (unsigned i = 0; i < use->num_operands; i++)
        if (ir_type_components(use->operands[i]) > 1 && !(use->named >> i & 1))
            return false;
    return use->num_operands > 1 || (use->named & 1);
}

static const struct lang_pieces *construct_form(struct osl *osl, const struct lang_use *use)
{
    if (use->type == IR_TYPE_MAT2 && use->num_operands == 4)
        return lang_form_of(osl->spell->scratch,
                            "matrix($0, $1, 0, 0, $2, $3, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)",
                            LANG_PREC_POSTFIX);
    if (use->type == IR_TYPE_MAT2 && use->num_operands == 2) {
        osl_add_helper(osl, "matrix matrix_of_rows(vector2 a, vector2 b)\n{\n    return matrix("
                            "a.x, a.y, 0, 0, b.x, b.y, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);\n}\n");
        return call_form(osl, "matrix_of_rows", 2, NULL);
    }
    if (use->type == IR_TYPE_MAT3 && use->num_operands == 9)
        return lang_form_of(osl->spell->scratch,
                            "matrix($0, $1, $2, 0, $3, $4, $5, 0, $6, $7, $8, 0, 0, 0, 0, 1)",
                            LANG_PREC_POSTFIX);
    if (!is_vector(use->type))
        return NULL;
    bool scalars = use->num_operands == ir_type_components(use->type)
                   || (use->type == IR_TYPE_VEC3 && use->num_operands == 1);
    for (unsigned i = 0; i < use->num_operands; i++)
        scalars &= ir_type_components(use->operands[i]) == 1;
    if (scalars)
        return NULL;
    struct text text;
    text_init(&text, osl->spell->scratch);
    if (all_named(use)) {
        text_fmt(&text, "%s(", osl_type(osl, use->type));
        write_parts(osl, use, true, &text);
        text_char(&text, ')');
        return lang_form_of(osl->spell->scratch, text_cstr(&text), LANG_PREC_POSTFIX);
    }
    struct text name;
    text_init(&name, osl->spell->scratch);
    text_fmt(&name, "make_%s", osl_type(osl, use->type));
    text_fmt(&text, "%s %s(", osl_type(osl, use->type), text_cstr(&name));
    for (unsigned i = 0; i < use->num_operands; i++)
        text_fmt(&text, "%s%s %c", i ? ", " : "", osl_type(osl, use->operands[i]), (char)('a' + i));
    text_fmt(&text, ")\n{\n    return %s(", osl_type(osl, use->type));
    write_parts(osl, use, false, &text);
    text_str(&text, ");\n}\n");
    osl_add_helper(osl, text_cstr(&text));
    return call_form(osl, text_cstr(&name), use->num_operands, NULL);
}

static const struct lang_pieces *convert_form(struct osl *osl, const struct lang_use *use)
{
    ir_type_id from = use->operands[0], to = use->type;
    if (from == IR_TYPE_FLOAT && to == IR_TYPE_UINT) {
        osl_add_helper(
            osl, "int unsigned_of_float(float x)\n{\n"
                 "    return x < 2147483648.0 ? int(x) : int(x - 2147483648.0) ^ (1 << 31);\n}\n");
        return call_form(osl, "unsigned_of_float", 1, NULL);
    }
    if (to == IR_TYPE_BOOL)
        return lang_form_of(osl->spell->scratch, from == IR_TYPE_BOOL ? "$0" : "$0 != 0",
                            from == IR_TYPE_BOOL ? LANG_PREC_ASSIGN : LANG_PREC_EQUAL);
    if (ir_type_components(from) == 1 && strcmp(osl_type(osl, from), osl_type(osl, to)) == 0)
        return lang_form_of(osl->spell->scratch, "$0",
                            LANG_PREC_ASSIGN); /* conversion between int, uint and bool */
    if (from == IR_TYPE_MAT3 && to == IR_TYPE_MAT4)
        return lang_form_of(osl->spell->scratch, "$0", LANG_PREC_ASSIGN);
    if (is_vector(from) && is_vector(to) && scalar_of(from) == scalar_of(to)) { /* cut */
        struct lang_use cut = *use;
        cut.op = IR_SWIZZLE;
        cut.attr = ir_type_components(to) << 8 | 0xe4; /* xyzw */
        return swizzle_form(osl, &cut);
    }
    if (is_vector(from) && is_vector(to)) /* ivec2 and vec2 */
        return component_form(osl, use);
    return osl_is_struct(to) || (to == IR_TYPE_VEC3 && from != IR_TYPE_FLOAT)
               ? construct_form(osl, use)
               : NULL;
}

static const struct lang_pieces *index_form(struct osl *osl, const struct lang_use *use)
{
    ir_type_id whole = use->operands[0];
    if (whole >= IR_NUM_TYPES || (whole == IR_TYPE_VEC3 && use->named & 1))
        return NULL;               /* arrays, and `v[i]` */
    struct lang_use by_int = *use; /* an unsigned index is an int, too */
    by_int.operands = (ir_type_id[]){whole, IR_TYPE_INT};
    const struct helper_row *row = find_helper(osl, &by_int);
    assert(row);
    return helper_form(osl, row, &by_int);
}

/* ---- Assignments to parts ---- */

/* "vector with_yx(vector v, vector2 parts)": the whole with new values of some components. */
static const struct lang_pieces *store_swizzle_form(struct osl *osl, const struct lang_use *use)
{
    unsigned count = use->attr >> 8;
    const char *type = osl_type(osl, use->type);
    struct text name, text;
    if (count == 1)
        return NULL; /* v.x = … */
    text_init(&name, osl->spell->scratch);
    text_str(&name, "with_");
    for (unsigned i = 0; i < count; i++)
        text_char(&name, parts[use->attr >> 2 * i & 3]);
    text_init(&text, osl->spell->scratch);
    text_fmt(&text, "%s %s(%s v, %s parts)\n{\n    %s result = v;\n", type, text_cstr(&name), type,
             osl_type(osl, use->operands[1]), type);
    for (unsigned i = 0; i < count; i++)
        text_fmt(&text, "    result.%c = parts.%c;\n", parts[use->attr >> 2 * i & 3], parts[i]);
    text_str(&text, "    return result;\n}\n");
    osl_add_helper(osl, text_cstr(&text));
    return call_form(osl, text_cstr(&name), 2, NULL);
}

/* "vector4 with_component(vector4 v, int i, float part)", or with another column of a matrix. */
static const struct lang_pieces *store_index_form(struct osl *osl, const struct lang_use *use)
{
    bool is_matrix = use->type < IR_NUM_TYPES && ir_type_is_matrix(use->type);
    if (!is_matrix && !osl_is_struct(use->type))
        return NULL; /* v[i] = … of arrays and of three components */
    const char *type = osl_type(osl, use->type), *part = osl_type(osl, use->operands[2]);
    unsigned count = is_matrix ? ir_type_info(use->type)->columns : ir_type_components(use->type);
    struct text text;
    text_init(&text, osl->spell->scratch);
    text_fmt(&text, "%s with_part(%s whole, int i, %s part)\n{\n    %s result = whole;\n", type,
             type, part, type);
    for (unsigned i = 0; i < count; i++)
        text_fmt(&text,
                 is_matrix ? "    result[i][%u] = part.%c;\n"
                           : "    if (i == %u)\n        result.%c = part;\n",
                 i, parts[i]);
    text_str(&text, "    return result;\n}\n");
    osl_add_helper(osl, text_cstr(&text));
    return call_form(osl, "with_part", 3, NULL);
}

/*
 * oslc (1.15.6) assigns structs part by part, so the second part of `v = vector2(v.y, v.x)` reads
 * the new first one. A function has the whole value before it returns it.
 */
static const struct lang_pieces *own_value_form(struct osl *osl, const struct lang_use *use)
{
    bool is_of_library = osl_is_library_struct(osl->spell, use->type);
    if (!is_of_library && !osl_is_struct(use->type))
        return NULL;
    const char *type = is_of_library ? osl->spell->user_types[use->type - IR_TYPE_FIRST_USER]
                                     : osl_type(osl, use->type);
    struct text text;
    text_init(&text, osl->spell->scratch);
    text_fmt(&text, "%s copied(%s value)\n{\n    %s copy = value;\n    return copy;\n}\n", type,
             type, type);
    if (is_of_library)
        osl_add_copier(osl, use->type, text_cstr(&text));
    else
        osl_add_helper(osl, text_cstr(&text));
    return call_form(osl, "copied", 1, NULL);
}

/* ---- Entry ---- */

static bool touches_struct(const struct lang_use *use)
{
    bool any = osl_is_struct(use->type);
    for (unsigned i = 0; i < use->num_operands; i++)
        any |= osl_is_struct(use->operands[i]);
    return any;
}

/*
 * The operand of a sum or product whose kind the result has in OSL: the first of three components;
 * 0: other ops.
 */
static ir_ref leading_operand(const struct ir_graph *graph, ir_ref ref)
{
    const struct ir_node *node = ir_get(graph, ref);
    ir_ref leading = 0;
    if (node->op < IR_ADD || node->op > IR_DIV)
        return 0;
    for (uint32_t i = node->num_args; i-- > 0;) {
        ir_ref arg = ir_arg(graph, ref, i);
        if (ir_type_is_matrix(ir_type_of(graph, arg)))
            return 0;
        leading = ir_type_of(graph, arg) == IR_TYPE_VEC3 ? arg : leading;
    }
    return leading;
}

static enum osl_kind operand_kind(const struct osl *osl, const struct lang_use *use, unsigned index)
{
    if (!use->node || use->operands[index] != IR_TYPE_VEC3)
        return OSL_ANY;
    const struct ir_graph *graph = osl->spell->shader->graph;
    ir_ref operand = ir_arg(graph, use->node, index), inner = operand;
    while (inner && !osl->spell->local_of[operand]) {
        operand = inner;
        inner = leading_operand(graph, operand);
    }
    enum osl_kind kind = (enum osl_kind)osl->kinds[operand];
    bool is_local = osl->spell->local_of[operand]; /* the shader declares it as vector or color */
    return is_local && (kind == OSL_POINT || kind == OSL_NORMAL) ? OSL_VECTOR : kind;
}

static bool is_no_vector(const struct osl *osl, const struct lang_use *use, unsigned index)
{
    enum osl_kind kind = operand_kind(osl, use, index);
    return kind == OSL_COLOR || kind == OSL_POINT || kind == OSL_NORMAL;
}

/* In sums of a number and a matrix the matrix comes first. */
static const struct lang_pieces *turned_sum_form(struct osl *osl, const struct lang_use *use)
{
    if (use->op != IR_ADD || use->operands[0] != IR_TYPE_FLOAT
        || !ir_type_is_matrix(use->operands[1]))
        return NULL;
    struct lang_use turned = *use;
    turned.operands = (ir_type_id[]){use->operands[1], use->operands[0]};
    const struct helper_row *row = find_helper(osl, &turned);
    if (!row)
        return NULL;
    add_row(osl, row, use);
    return call_form(osl, row->name, 2, "10");
}

/*
 * A row vector times a matrix in OSL is a matrix times a column vector in the IR, so products of
 * matrices swap their operands.
 */
static const struct lang_pieces *product_form(struct osl *osl, const struct lang_use *use)
{
    ir_type_id a = use->operands[0], b = use->operands[1];
    if (ir_type_is_matrix(a) && ir_type_is_matrix(b))
        return lang_form_of(osl->spell->scratch, "$1 * $0", LANG_PREC_POSTFIX);
    /* transform() returns a vector */
    bool is_color = use->node && osl->kinds[use->node] == OSL_COLOR;
    if (a == IR_TYPE_MAT3 && b == IR_TYPE_VEC3)
        return lang_form_of(osl->spell->scratch,
                            is_color                    ? "color(transform($0, vector($1)))"
                            : is_no_vector(osl, use, 1) ? "transform($0, vector($1))"
                                                        : "transform($0, $1)",
                            LANG_PREC_POSTFIX);
    if (a == IR_TYPE_VEC3 && b == IR_TYPE_MAT3)
        return lang_form_of(osl->spell->scratch,
                            is_color ? "color(transform(transpose($1), vector($0)))"
                            : is_no_vector(osl, use, 0) ? "transform(transpose($1), vector($0))"
                                                        : "transform(transpose($1), $0)",
                            LANG_PREC_POSTFIX);
    if ((a == IR_TYPE_VEC4 && b == IR_TYPE_MAT4) || (a == IR_TYPE_VEC2 && b == IR_TYPE_MAT2)) {
        ir_type_id turned[2] = {b, a};
        struct lang_use transform = *use;
        transform.operands = turned;
        add_row(osl, find_helper(osl, &transform), use);
        return lang_form_of(osl->spell->scratch, "transform(transpose($1), $0)", LANG_PREC_POSTFIX);
    }
    return NULL;
}

/* True if a call has operands of several kinds: oslc cannot choose among overloads then. */
static bool mixes_kinds(const struct osl *osl, const struct lang_use *use)
{
    enum osl_kind first = OSL_ANY;
    for (unsigned i = 0; i < use->num_operands; i++) {
        if (use->operands[i] != IR_TYPE_VEC3)
            continue;
        enum osl_kind kind = operand_kind(osl, use, i);
        kind = kind == OSL_ANY ? OSL_VECTOR : kind;
        if (first != OSL_ANY && kind != first)
            return true;
        first = kind;
    }
    return false;
}

/* True if stdosl.h has the function for vectors alone, to which oslc turns normals and points. */
static bool takes_vectors(enum ir_op op)
{
    return op == IR_CROSS || op == IR_REFLECT || op == IR_REFRACT || op == IR_FACEFORWARD;
}

/*
 * The type to which a form must cast an operand, so that calls do not mix colours and vectors;
 * NULL: no cast.
 */
static const char *cast_of(const struct osl *osl, const struct lang_use *use, unsigned index)
{
    enum osl_kind have = operand_kind(osl, use, index);
    if (use->op == IR_NORMALIZE) /* overloads exist for vectors and for normals */
        return have == OSL_COLOR || have == OSL_POINT ? "vector" : NULL;
    bool is_color = use->node && osl->kinds[use->node] == OSL_COLOR;
    bool is_call = ir_op_info(use->op)->flags & OP_BUILTIN || use->op == IR_SELECT;
    if (use->op == IR_CLOSURE_SCALE || use->op == IR_CLOSURE_MIX)
        is_color = is_call = true;
    if (!is_call)
        return NULL;
    if (is_color)
        return have != OSL_ANY && have != OSL_COLOR ? "color" : NULL;
    if (takes_vectors(use->op))
        return have == OSL_COLOR ? "vector" : NULL;
    bool is_ambiguous = use->type == IR_TYPE_VEC3 && mixes_kinds(osl, use);
    return is_ambiguous && is_no_vector(osl, use, index) ? "vector" : NULL;
}

/* "dot(vector($0), $1)"; NULL: no operand needs a cast. */
static const struct lang_pieces *cast_form(struct osl *osl, const struct lang_use *use)
{
    const struct lang_pieces *own = usual_form(osl, use->op);
    bool any = false;
    for (unsigned i = 0; i < use->num_operands; i++)
        any |= cast_of(osl, use, i) != NULL;
    if (!any || !own)
        return NULL;
    struct text text;
    text_init(&text, osl->spell->scratch);
    for (const char *p = own->text; *p; p++) {
        const char *cast = *p == '$' ? cast_of(osl, use, (unsigned)(p[1] - '0')) : NULL;
        if (cast) {
            text_fmt(&text, "%s($%c)", cast, p[1]);
            p++;
        } else {
            text_char(&text, *p);
        }
    }
    return lang_form_of(osl->spell->scratch, text_cstr(&text),
                        (enum lang_precedence)own->precedence);
}

/* A colour made of numbers: "color(1.0)", "color($0, $1, $2)"; NULL: the node is a vector. */
static const struct lang_pieces *color_form(struct osl *osl, const struct lang_use *use)
{
    if (use->type != IR_TYPE_VEC3 || !use->node || osl->kinds[use->node] != OSL_COLOR)
        return NULL;
    struct text text;
    text_init(&text, osl->spell->scratch);
    struct ir_value value;
    if (ir_get_const(osl->spell->shader->graph, use->node, &value)) {
        lang_print_value(osl->spell->style, NULL, value.type, value.w, LANG_PREC_COMMA, &text);
        const char *parts_of_value = text_cstr(&text) + strlen("vector");
        struct text literal;
        text_init(&literal, osl->spell->scratch);
        text_fmt(&literal, "color%s", parts_of_value);
        return lang_form_of(osl->spell->scratch, text_cstr(&literal), LANG_PREC_POSTFIX);
    }
    bool scalars = use->num_operands == 1 || use->num_operands == 3;
    for (unsigned i = 0; i < use->num_operands; i++)
        scalars &= ir_type_components(use->operands[i]) == 1;
    return scalars ? call_form(osl, "color", use->num_operands, NULL) : NULL;
}

const struct lang_pieces *osl_form(void *user_data, const struct lang_use *use)
{
    struct osl *osl = ((struct spell *)user_data)->target_data;
    if (use->is_store)
        return use->op == IR_NUM_OPS   ? own_value_form(osl, use)
               : use->op == IR_SWIZZLE ? store_swizzle_form(osl, use)
                                       : store_index_form(osl, use);
    bool makes = use->op == IR_CONST || use->op == IR_CONVERT || use->op == IR_CONSTRUCT;
    const struct lang_pieces *color = makes ? color_form(osl, use) : NULL;
    if (color || use->op == IR_CONST)
        return color;
    const struct lang_pieces *product =
        use->op == IR_MUL ? product_form(osl, use) : turned_sum_form(osl, use);
    if (product)
        return product;
    if (use->op == IR_SWIZZLE)
        return swizzle_form(osl, use);
    if (use->op == IR_INDEX)
        return index_form(osl, use);
    if (use->op == IR_MEMBER)
        return NULL;
    const char *texture = use->op == IR_TEX ? osl_texture_call(osl, use) : NULL;
    if (texture)
        return lang_form_of(osl->spell->scratch, texture,
                            use->type == IR_TYPE_VEC4 ? LANG_PREC_POSTFIX : LANG_PREC_UNARY);
    const struct helper_row *row = find_helper(osl, use);
    if (row)
        return helper_form(osl, row, use);
    if (use->op == IR_CONSTRUCT)
        return construct_form(osl, use);
    if (use->op == IR_CONVERT)
        return convert_form(osl, use);
    bool by_component = touches_struct(use) || (use->op == IR_ROUND && use->type == IR_TYPE_VEC3);
    if (by_component)
        return component_form(osl, use);
    return cast_form(osl, use);
}
