// SPDX-License-Identifier: Apache-2.0
/*
 * The forms of MDL that depend on types. MDL has no unsigned numbers, no parts of several
 * components, and takes vectors apart and together by numbers alone.
 */
#include "generators/mdl/mdl.h"

#include <assert.h>

static bool is_vector(ir_type_id type)
{
    return type < IR_TYPE_FIRST_USER && ir_type_is_vector(type);
}

static bool is_matrix(ir_type_id type)
{
    return type < IR_TYPE_FIRST_USER && ir_type_is_matrix(type);
}

static ir_type_id scalar_of(ir_type_id type)
{
    return is_vector(type) ? ir_type_info(type)->scalar : type;
}

static const char *type_name(const struct spell *spell, ir_type_id type)
{
    assert(type < IR_NUM_TYPES);
    return spell->style->types[type].bytes;
}

/* "name($0, $1)" */
static const struct lang_pieces *call_form(struct spell *spell, const char *name, unsigned n)
{
    struct text *text = spell_new_text(spell);
    text_str(text, name);
    for (unsigned i = 0; i < n; i++)
        text_fmt(text, "%s$%u", i ? ", " : "(", i);
    text_char(text, ')');
    return spell_call_form(spell, text_cstr(text));
}

/* ---- Helpers ---- */

static const struct helper {
    uint8_t op;
    const char *types, *text;
} helpers[] = {
#define HELPER(op, types, text) {IR_##op, types, text},
#include "generators/mdl/helpers.def"
};

static char letter_of(ir_type_id type)
{
    static const char letters[IR_NUM_TYPES] = {
        [IR_TYPE_BOOL] = 'b', [IR_TYPE_INT] = 'i',  [IR_TYPE_UINT] = 'u', [IR_TYPE_FLOAT] = 'f',
        [IR_TYPE_VEC2] = '2', [IR_TYPE_VEC3] = '3', [IR_TYPE_VEC4] = '4', [IR_TYPE_MAT2] = 'm',
        [IR_TYPE_MAT3] = 'M', [IR_TYPE_MAT4] = 'N',
    };
    return type < IR_NUM_TYPES && letters[type] ? letters[type] : '?';
}

static bool fits(const struct helper *row, const struct lang_use *use)
{
    unsigned i = 0;
    if (row->op != use->op || strlen(row->types) != use->num_operands)
        return false;
    if (row->op == IR_CONVERT && use->type != IR_TYPE_FLOAT)
        return false;
    while (i < use->num_operands
           && (row->types[i] == '*' || row->types[i] == letter_of(use->operands[i])))
        i++;
    return i == use->num_operands;
}

/* The name of a helper stands before its first parenthesis. */
static const char *helper_name(struct spell *spell, const char *text)
{
    const char *begin = strstr(text, MDL_PREFIX), *end = strchr(begin, '(');
    return arena_strndup(spell->scratch, begin, (size_t)(end - begin));
}

static const struct lang_pieces *helper_form(struct spell *spell, const struct lang_use *use)
{
    for (size_t i = 0; i < sizeof helpers / sizeof *helpers; i++) {
        if (!fits(&helpers[i], use))
            continue;
        spell_add_helper(spell, use, helpers[i].text);
        return call_form(spell, helper_name(spell, helpers[i].text), use->num_operands);
    }
    return NULL;
}

/* ---- By component ---- */

/* The names of operators, which have no word of their own. */
static const char *word_of(enum ir_op op)
{
    switch (op) {
    case IR_DIV: return "divided";
    case IR_REM: return "remainder";
    case IR_SHR: return "shifted";
    case IR_CONVERT: return "converted";
    case IR_CHOOSE: return "chosen";
    default: return ir_op_info(op)->text;
    }
}

/* "mdl_less_float3": the types of operands and result tell apart what MDL's int does not. */
static const char *component_name(struct spell *spell, const struct lang_use *use)
{
    struct text *name = spell_new_text(spell);
    text_fmt(name, MDL_PREFIX "%s_%s", word_of(use->op), ir_type_text(use->operands[0]));
    if (use->op == IR_CONVERT)
        text_fmt(name, "_to_%s", ir_type_text(use->type));
    for (unsigned i = 1; i < use->num_operands; i++)
        if (use->operands[i] != use->operands[0])
            text_fmt(name, "_%s", ir_type_text(use->operands[i]));
    return text_cstr(name);
}

/* A form with "a.x" in the place of $0, and so on. */
static void write_component(struct spell *spell, const char *form, const struct lang_use *use,
                            unsigned component, struct text *out)
{
    for (const char *p = form; *p; p++) {
        if (*p != '$') {
            text_char(out, *p);
        } else if (*++p == 'T') {
            text_str(out, type_name(spell, scalar_of(use->type)));
        } else {
            unsigned index = (unsigned)(*p - '0');
            text_char(out, (char)('a' + index));
            if (is_vector(use->operands[index]))
                text_fmt(out, ".%c", "xyzw"[component]);
        }
    }
}

static const struct lang_pieces *component_form(struct spell *spell, const struct lang_use *use)
{
    ir_type_id scalars[4];
    struct lang_use each = *use;
    each.op = ir_op_of_component(use->op);
    each.type = scalar_of(use->type);
    each.operands = scalars;
    each.node = 0;
    for (unsigned i = 0; i < use->num_operands; i++)
        scalars[i] = scalar_of(use->operands[i]);
    const struct lang_pieces *scalar = mdl_form(spell, &each);
    scalar = scalar ? scalar : lang_style_form(spell->style, each.op);
    const char *name = component_name(spell, use);
    struct text *text = spell_new_text(spell);
    text_fmt(text, "%s %s(", type_name(spell, use->type), name);
    for (unsigned i = 0; i < use->num_operands; i++)
        text_fmt(text, "%s%s %c", i ? ", " : "", type_name(spell, use->operands[i]),
                 (char)('a' + i));
    text_fmt(text, ")\n{\n    return %s(", type_name(spell, use->type));
    for (unsigned i = 0; i < ir_type_components(use->type); i++) {
        text_str(text, i ? ", " : "");
        write_component(spell, scalar->text, use, i, text);
    }
    text_str(text, ");\n}\n");
    spell_helper(spell, text_cstr(text));
    return call_form(spell, name, use->num_operands);
}

/* ---- Taking apart and putting together ---- */

static bool all_named(const struct lang_use *use)
{
    for (unsigned i = 0; i < use->num_operands; i++)
        if (ir_type_components(use->operands[i]) > 1 && !(use->named >> i & 1))
            return false;
    return true;
}

/*
 * The parts of all operands in sequence, up to `left`: of "$0", "$1" if `named`, else of the
 * parameters a, b…
 */
static void write_parts(const struct lang_use *use, unsigned left, bool named, struct text *out)
{
    unsigned wanted = left;
    for (unsigned i = 0; i < use->num_operands; i++) {
        unsigned n = ir_type_components(use->operands[i]);
        for (unsigned k = 0; k < n && left; k++, left--) {
            text_str(out, left == wanted ? "" : ", ");
            text_fmt(out, named ? "$%u" : "%c", named ? i : 'a' + i);
            if (n > 1)
                text_fmt(out, ".%c", "xyzw"[k]);
        }
    }
}

/* "float3($0.x, $0.y, $1)", or a function of the operands if one of them is no name. */
static const struct lang_pieces *together(struct spell *spell, const struct lang_use *use)
{
    const char *type = type_name(spell, use->type);
    unsigned n = ir_type_components(use->type);
    struct text *text = spell_new_text(spell), *name = spell_new_text(spell);
    if (all_named(use)) {
        text_fmt(text, "%s(", type);
        write_parts(use, n, true, text);
        text_char(text, ')');
        return lang_form_of(spell->scratch, text_cstr(text), LANG_PREC_POSTFIX);
    }
    text_fmt(name, MDL_PREFIX "%s_of", ir_type_text(use->type));
    for (unsigned i = 0; i < use->num_operands; i++)
        text_fmt(name, "_%s", ir_type_text(use->operands[i]));
    text_fmt(text, "%s %s(", type, text_cstr(name));
    for (unsigned i = 0; i < use->num_operands; i++)
        text_fmt(text, "%s%s %c", i ? ", " : "", type_name(spell, use->operands[i]),
                 (char)('a' + i));
    text_fmt(text, ")\n{\n    return %s(", type);
    write_parts(use, n, false, text);
    text_str(text, ");\n}\n");
    spell_helper(spell, text_cstr(text));
    return call_form(spell, text_cstr(name), use->num_operands);
}

static const struct lang_pieces *construct(struct spell *spell, const struct lang_use *use)
{
    if (!is_vector(use->type))
        return NULL;
    bool is_plain = true;
    for (unsigned i = 0; i < use->num_operands; i++)
        is_plain &= ir_type_components(use->operands[i]) == 1;
    return is_plain ? NULL : together(spell, use);
}

/* "float2($0.y, $0.x)", or a function if the operand is no name. One part needs neither. */
static const struct lang_pieces *swizzle(struct spell *spell, const struct lang_use *use)
{
    unsigned count = use->attr >> 8;
    bool named = use->named & 1;
    if (count == 1)
        return NULL;
    struct text *text = spell_new_text(spell), *name = spell_new_text(spell);
    text_fmt(text, "%s(", type_name(spell, use->type));
    for (unsigned i = 0; i < count; i++) {
        char part = "xyzw"[use->attr >> 2 * i & 3];
        text_fmt(text, named ? "%s$0.%c" : "%sv.%c", i ? ", " : "", part);
        text_char(name, part);
    }
    text_char(text, ')');
    if (named)
        return lang_form_of(spell->scratch, text_cstr(text), LANG_PREC_POSTFIX);
    struct text *function = spell_new_text(spell), *full = spell_new_text(spell);
    text_fmt(full, MDL_PREFIX "%s_of_%s", text_cstr(name), ir_type_text(use->operands[0]));
    text_fmt(function, "%s %s(%s v)\n{\n    return %s;\n}\n", type_name(spell, use->type),
             text_cstr(full), type_name(spell, use->operands[0]), text_cstr(text));
    spell_helper(spell, text_cstr(function));
    return call_form(spell, text_cstr(full), 1);
}

/* "mdl_with_xz_vec3(v, parts)": the whole with new values of some components. */
static const struct lang_pieces *store(struct spell *spell, const struct lang_use *use)
{
    unsigned count = use->attr >> 8;
    if (use->op != IR_SWIZZLE || count == 1)
        return NULL;
    const char *type = type_name(spell, use->type);
    struct text *name = spell_new_text(spell), *text = spell_new_text(spell);
    text_str(name, MDL_PREFIX "with_");
    for (unsigned i = 0; i < count; i++)
        text_char(name, "xyzw"[use->attr >> 2 * i & 3]);
    text_fmt(name, "_%s", ir_type_text(use->type));
    text_fmt(text, "%s %s(%s v, %s parts)\n{\n    %s result = v;\n", type, text_cstr(name), type,
             type_name(spell, use->operands[1]), type);
    for (unsigned i = 0; i < count; i++)
        text_fmt(text, "    result.%c = parts.%c;\n", "xyzw"[use->attr >> 2 * i & 3], "xyzw"[i]);
    text_str(text, "    return result;\n}\n");
    spell_helper(spell, text_cstr(text));
    return call_form(spell, text_cstr(name), 2);
}

/* A matrix of another size: from the smaller one the rest is that of the identity. */
static const struct lang_pieces *resized(struct spell *spell, const struct lang_use *use)
{
    unsigned from = ir_type_info(use->operands[0])->columns, to = ir_type_info(use->type)->columns;
    const char *type = type_name(spell, use->type), *old = type_name(spell, use->operands[0]);
    if (from == to)
        return lang_form_of(spell->scratch, "$0", LANG_PREC_ASSIGN);
    struct text *text = spell_new_text(spell), *name = spell_new_text(spell);
    text_fmt(name, MDL_PREFIX "%s_of_%s", type, old);
    text_fmt(text, "%s %s(%s m)\n{\n    return %s(", type, text_cstr(name), old, type);
    for (unsigned i = 0; i < to * to; i++) {
        unsigned column = i / to, row = i % to;
        text_str(text, i ? ", " : "");
        if (column < from && row < from)
            text_fmt(text, "m[%u].%c", column, "xyzw"[row]);
        else
            text_str(text, column == row ? "1.0" : "0.0");
    }
    text_str(text, ");\n}\n");
    spell_helper(spell, text_cstr(text));
    return call_form(spell, text_cstr(name), 1);
}

static const struct lang_pieces *convert(struct spell *spell, const struct lang_use *use)
{
    ir_type_id from = use->operands[0], to = use->type;
    if (is_matrix(from) && is_matrix(to))
        return resized(spell, use);
    if (is_vector(from) && is_vector(to)) {
        bool cuts = ir_type_components(from) > ir_type_components(to);
        if (cuts)
            return together(spell, use);
        bool same = strcmp(type_name(spell, from), type_name(spell, to)) == 0;
        return same ? lang_form_of(spell->scratch, "$0", LANG_PREC_ASSIGN)
                    : component_form(spell, use);
    }
    if (is_matrix(to) || is_vector(to) || from >= IR_NUM_TYPES)
        return NULL;
    if (to == IR_TYPE_BOOL)
        return from == IR_TYPE_BOOL
                   ? lang_form_of(spell->scratch, "$0", LANG_PREC_ASSIGN)
                   : lang_form_of(spell->scratch, from == IR_TYPE_FLOAT ? "$0 != 0.0" : "$0 != 0",
                                  LANG_PREC_EQUAL);
    if (from == IR_TYPE_FLOAT && to == IR_TYPE_UINT) {
        spell_helper(spell, "int mdl_unsigned_of_float(float x)\n{\n    return x < 2147483648.0 ? "
                            "int(x) : int(x - 2147483648.0) ^ (1 << 31);\n}\n");
        return call_form(spell, "mdl_unsigned_of_float", 1);
    }
    bool same = strcmp(type_name(spell, from), type_name(spell, to)) == 0;
    return same ? lang_form_of(spell->scratch, "$0", LANG_PREC_ASSIGN) : NULL;
}

/* ---- Functions and operators ---- */

/* step and smoothstep take no scalar beside vectors: "math::step($T($0), $1)". */
static const struct lang_pieces *spread(struct spell *spell, const struct lang_use *use)
{
    struct text *text = spell_new_text(spell);
    if (!is_vector(use->type))
        return NULL;
    text_fmt(text, "math::%s(", ir_op_info(use->op)->text);
    for (unsigned i = 0; i < use->num_operands; i++)
        text_fmt(text, is_vector(use->operands[i]) ? "%s$%u" : "%s$T($%u)", i ? ", " : "", i);
    text_char(text, ')');
    return spell_call_form(spell, text_cstr(text));
}

/* "$0", or the matrix whose components are all this number; MDL has it on the diagonal. */
static const char *as_matrix(struct spell *spell, const struct lang_use *use, unsigned operand)
{
    struct text *text = spell_new_text(spell);
    if (is_matrix(use->operands[operand])) {
        text_fmt(text, "$%u", operand);
        return text_cstr(text);
    }
    const char *type = type_name(spell, use->type);
    unsigned n = ir_type_components(use->type);
    struct text *function = spell_new_text(spell);
    text_fmt(function, "%s mdl_fill_%s(float x)\n{\n    return %s(", type, type, type);
    for (unsigned i = 0; i < n; i++)
        text_str(function, i ? ", x" : "x");
    text_str(function, ");\n}\n");
    spell_helper(spell, text_cstr(function));
    text_fmt(text, "mdl_fill_%s($%u)", type, operand);
    return text_cstr(text);
}

/* Sums of matrices and numbers, and numbers over matrices. */
static const struct lang_pieces *matrix_form(struct spell *spell, const struct lang_use *use)
{
    bool divides = use->op == IR_DIV, is_first = is_matrix(use->operands[0]);
    if (!is_matrix(use->type) || (is_first && (divides || is_matrix(use->operands[1]))))
        return NULL;
    struct text *text = spell_new_text(spell);
    const char *a = as_matrix(spell, use, 0), *b = as_matrix(spell, use, 1);
    if (!divides) {
        text_fmt(text, "%s %s %s", a, use->op == IR_ADD ? "+" : "-", b);
        return lang_form_of(spell->scratch, text_cstr(text), LANG_PREC_SUM);
    }
    struct lang_use each = *use;
    each.operands = (ir_type_id[]){use->type, use->type};
    const struct lang_pieces *both = helper_form(spell, &each);
    text_fmt(text, "%.*s(%s, %s)", (int)strcspn(both->text, "("), both->text, a, b);
    return spell_call_form(spell, text_cstr(text));
}

static bool is_unsigned(ir_type_id type)
{
    return type < IR_NUM_TYPES && ir_type_info(type)->scalar == IR_TYPE_UINT;
}

/* Ops whose meaning unsigned numbers change. */
static bool differs_unsigned(enum ir_op op)
{
    return op == IR_LT || op == IR_LE || op == IR_GT || op == IR_GE || op == IR_MIN || op == IR_MAX
           || op == IR_CLAMP || op == IR_DIV || op == IR_REM;
}

static bool is_by_component(const struct lang_use *use)
{
    switch (use->op) {
    case IR_LESS:
    case IR_LESS_EQUAL:
    case IR_GREATER:
    case IR_GREATER_EQUAL:
    case IR_EQUAL:
    case IR_NOT_EQUAL:
    case IR_CHOOSE:
    case IR_MOD:
    case IR_TRUNC:
    case IR_ROUND:
    case IR_ASINH:
    case IR_ACOSH:
    case IR_ATANH:
    case IR_ISINF:
    case IR_FLOAT_TO_INT_BITS:
    case IR_FLOAT_TO_UINT_BITS:
    case IR_INT_BITS_TO_FLOAT:
    case IR_UINT_BITS_TO_FLOAT: return true;
    default: return differs_unsigned(use->op) && is_unsigned(use->operands[0]);
    }
}

static const struct lang_pieces *by_op(struct spell *spell, const struct lang_use *use)
{
    switch (use->op) {
    case IR_SWIZZLE: return swizzle(spell, use);
    case IR_CONSTRUCT: return construct(spell, use);
    case IR_CONVERT: return convert(spell, use);
    case IR_STEP:
    case IR_SMOOTHSTEP: return spread(spell, use);
    case IR_CHOOSE:
        return is_vector(use->type)
                   ? NULL
                   : lang_form_of(spell->scratch, "$2 ? $1 : $0", LANG_PREC_TERNARY);
    case IR_SHR:
        return is_unsigned(use->type) ? lang_form_of(spell->scratch, "$0 >>> $1", LANG_PREC_SHIFT)
                                      : NULL;
    case IR_ADD:
    case IR_SUB:
    case IR_DIV: return matrix_form(spell, use);
    case IR_TEX:
    case IR_TEX_LOD:
    case IR_TEX_GRAD: return mdl_texture_form(spell, use);
    default: return NULL;
    }
}

const struct lang_pieces *mdl_form(void *user_data, const struct lang_use *use)
{
    struct spell *spell = user_data;
    if (use->is_store)
        return use->op == IR_NUM_OPS ? NULL : store(spell, use);
    if (use->op == IR_CONST || use->op == IR_INDEX || use->op == IR_MEMBER)
        return NULL;
    const struct lang_pieces *form = helper_form(spell, use);
    form = form ? form : by_op(spell, use);
    if (form || use->op == IR_CONSTRUCT || use->op == IR_CONVERT || use->op == IR_SWIZZLE)
        return form;
    return is_by_component(use) && is_vector(use->operands[0]) ? component_form(spell, use) : NULL;
}
