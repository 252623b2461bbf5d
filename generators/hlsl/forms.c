// SPDX-License-Identifier: Apache-2.0
/* How HLSL writes what depends on types, and the functions that it lacks (helpers). */
#include "generators/hlsl/hlsl.h"

#include <math.h>

static const char parts[] = "xyzw";

static unsigned components(ir_type_id type)
{
    return type < IR_NUM_TYPES ? ir_type_info(type)->components : 0;
}

static bool is_matrix(ir_type_id type)
{
    return type < IR_NUM_TYPES && ir_type_is_matrix(type);
}

static bool is_vector(ir_type_id type)
{
    return components(type) > 1 && !is_matrix(type);
}

static unsigned rows_of(ir_type_id matrix)
{
    return ir_type_info(matrix)->columns;
}

static const char *type_name(const struct spell *spell, ir_type_id type)
{
    return lang_syntax_type(spell->target->syntax, type);
}

/* ---- Forms and helpers made here live as long as the stage is written ---- */

static struct text *new_text(struct spell *spell)
{
    struct text *text = ARENA_NEW(spell->scratch, struct text);
    text_init(text, spell->scratch);
    return text;
}

static const struct lang_pieces *form_of(struct spell *spell, const char *text,
                                         enum lang_precedence precedence)
{
    struct lang_pieces *form = ARENA_NEW(spell->scratch, struct lang_pieces);
    lang_form_split(&(struct lang_form){text, (uint8_t)precedence, false}, spell->scratch, form);
    return form;
}

static const struct lang_pieces *call_of(struct spell *spell, const char *text)
{
    return form_of(spell, text, LANG_PREC_POSTFIX);
}

/* ---- Operators ---- */

/* Matrices are transposes: hlsl.h. */
static const struct lang_pieces *product(struct spell *spell, const struct lang_use *use)
{
    ir_type_id a = use->operands[0], b = use->operands[1];
    bool is_linear = (is_matrix(a) && components(b) > 1) || (components(a) > 1 && is_matrix(b));
    return is_linear ? call_of(spell, "mul($1, $0)") : NULL;
}

/* "bool equal(float3x3 a, float3x3 b)": all() takes vectors everywhere, but not matrices. */
static void add_equal(struct spell *spell, ir_type_id matrix)
{
    struct text *text = new_text(spell);
    const char *type = type_name(spell, matrix);
    text_fmt(text, "bool equal(%s a, %s b)\n{\n    return ", type, type);
    for (unsigned i = 0; i < rows_of(matrix); i++)
        text_fmt(text, "%sall(a[%u] == b[%u])", i ? " && " : "", i, i);
    text_str(text, ";\n}\n");
    spell_helper(spell, text_cstr(text));
}

static const struct lang_pieces *equality(struct spell *spell, const struct lang_use *use)
{
    ir_type_id type = use->operands[0];
    bool same = use->op == IR_EQ;
    if (is_vector(type))
        return call_of(spell, same ? "all($0 == $1)" : "any($0 != $1)");
    if (!is_matrix(type))
        return NULL;
    add_equal(spell, type);
    return same ? call_of(spell, "equal($0, $1)")
                : form_of(spell, "!equal($0, $1)", LANG_PREC_UNARY);
}

static const char *struct_name(struct spell *spell, const struct lang_use *use)
{
    if (!use->node)
        return spell->user_types[use->type - IR_TYPE_FIRST_USER];
    struct text *out = spell->out, *name = new_text(spell);
    spell->out = name;
    spell_type(spell, use->type);
    spell->out = out;
    return text_cstr(name);
}

/* "c ? a : b" takes numbers only. */
static const struct lang_pieces *choice(struct spell *spell, const struct lang_use *use)
{
    if (use->type < IR_TYPE_FIRST_USER)
        return NULL;
    const char *type = struct_name(spell, use);
    struct text *text = new_text(spell);
    text_fmt(
        text,
        "%s choose(bool condition, %s yes, %s no)\n{\n    if (condition)\n        return yes;\n"
        "    return no;\n}\n",
        type, type, type);
    spell_helper(spell, text_cstr(text));
    return call_of(spell, "choose($0, $1, $2)");
}

/* ---- Built-in functions ---- */

/* HLSL's own gives integers. */
static const struct lang_pieces *sign(struct spell *spell, const struct lang_use *use)
{
    bool is_integer = ir_type_info(use->type)->scalar == IR_TYPE_INT;
    return is_integer ? NULL : call_of(spell, "$T(sign($0))");
}

/* HLSL's fmod() has the sign of x, as C's. */
static const struct lang_pieces *modulo(struct spell *spell, const struct lang_use *use)
{
    struct text *text = new_text(spell);
    const char *type = type_name(spell, use->type);
    text_fmt(text, "%s mod(%s x, %s y)\n{\n    return x - y * floor(x / y);\n}\n", type, type,
             type_name(spell, use->operands[1]));
    spell_helper(spell, text_cstr(text));
    return call_of(spell, "mod($0, $1)");
}

/*
 * The inverse, of order 4 by Lengyel, Foundations of Game Engine Development 1 (2016), section
 * 1.7.5.
 */
static const struct lang_pieces *inverse(struct spell *spell, const struct lang_use *use)
{
    static const char order_2[] = "float2x2 inverse(float2x2 m)\n{\n"
                                  "    return float2x2(m[1].y, -m[0].y, -m[1].x, m[0].x)"
                                  " / determinant(m);\n}\n";
    static const char order_3[] =
        "float3x3 inverse(float3x3 m)\n{\n"
        "    float3x3 minors = float3x3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));\n"
        "    return transpose(minors) / dot(m[0], minors[0]);\n}\n";
    static const char order_4[] =
        "float4x4 inverse(float4x4 m)\n{\n"
        "    float4x4 t = transpose(m);\n"
        "    float3 a = t[0].xyz, b = t[1].xyz, c = t[2].xyz, d = t[3].xyz;\n"
        "    float4 w = float4(t[0].w, t[1].w, t[2].w, t[3].w);\n"
        "    float3 s = cross(a, b), q = cross(c, d), u = a * w.y - b * w.x, v = c * w.w - d * "
        "w.z;\n"
        "    return float4x4(float4(cross(b, v) + q * w.y, -dot(b, q)),\n"
        "                    float4(cross(v, a) - q * w.x, dot(a, q)),\n"
        "                    float4(cross(d, u) + s * w.w, -dot(d, s)),\n"
        "                    float4(cross(u, c) - s * w.z, dot(c, s))) / (dot(s, v) + dot(q, u));\n"
        "}\n";
    static const char *const by_rows[] = {[2] = order_2, [3] = order_3, [4] = order_4};
    spell_helper(spell, by_rows[rows_of(use->type)]);
    return call_of(spell, "inverse($0)");
}

/* ---- Textures ---- */

static const struct lang_pieces *texture_size(struct spell *spell, const struct lang_use *use)
{
    struct text *text = new_text(spell);
    const char *layers = use->operands[0] == IR_TYPE_SAMPLER_ARRAY ? "layers, " : "";
    text_fmt(text,
             "int2 texture_size(%s t, int level)\n{\n    uint width, height, %slevels;\n"
             "    t.GetDimensions(uint(level), width, height, %slevels);\n"
             "    return int2(width, height);\n}\n",
             type_name(spell, use->operands[0]), layers, layers);
    spell_helper(spell, text_cstr(text));
    return call_of(spell, "texture_size($0, $1)");
}

static const struct lang_pieces *texel(struct spell *spell, const struct lang_use *use)
{
    bool is_array = use->operands[0] == IR_TYPE_SAMPLER_ARRAY;
    return is_array ? call_of(spell, "$0.Load(int4($1, $2))") : NULL;
}

/* ---- Constructors and conversions ---- */

static void put_identity_row(struct text *out, const char *diagonal, unsigned row, unsigned columns)
{
    for (unsigned i = 0; i < columns; i++)
        text_fmt(out, "%s%s", i ? ", " : "", i == row ? diagonal : "0.0");
}

/* "(float3)$0", or a multiple of the identity. */
static const struct lang_pieces *from_scalar(struct spell *spell, ir_type_id type)
{
    if (is_vector(type))
        return form_of(spell, "($T)$0", LANG_PREC_UNARY);
    struct text *text = new_text(spell);
    text_str(text, "$0 * $T(");
    for (unsigned row = 0; row < rows_of(type); row++) {
        text_str(text, row ? ", " : "");
        put_identity_row(text, "1.0", row, rows_of(type));
    }
    text_char(text, ')');
    return form_of(spell, text_cstr(text), LANG_PREC_PRODUCT);
}

/* The last operand may have more components than are left: HLSL wants these cut off. */
static const struct lang_pieces *construct(struct spell *spell, const struct lang_use *use)
{
    unsigned left = components(use->type), last = use->num_operands - 1;
    if (left <= 1)
        return NULL;
    if (use->num_operands == 1 && components(use->operands[0]) == 1)
        return from_scalar(spell, use->type);
    for (unsigned i = 0; i < last; i++)
        left -= components(use->operands[i]);
    if (components(use->operands[last]) == left)
        return NULL;
    struct text *text = new_text(spell);
    text_str(text, "$T(");
    for (unsigned i = 0; i < last; i++)
        text_fmt(text, "$%u, ", i);
    text_fmt(text, "$%u.%.*s)", last, (int)left, parts);
    return call_of(spell, text_cstr(text));
}

/* A larger matrix: the rows of the smaller one, then those of the identity. */
static const struct lang_pieces *grow(struct spell *spell, ir_type_id from, ir_type_id to)
{
    unsigned have = rows_of(from), want = rows_of(to);
    struct text *text = new_text(spell);
    text_fmt(text, "%s grow_%u(%s m)\n{\n    return %s(", type_name(spell, to), want,
             type_name(spell, from), type_name(spell, to));
    for (unsigned row = 0; row < want; row++) {
        text_str(text, row ? ", " : "");
        if (row < have)
            text_fmt(text, "m[%u]%s", row, want - have == 1 ? ", 0.0" : ", 0.0, 0.0");
        else
            put_identity_row(text, "1.0", row, want);
    }
    text_str(text, ");\n}\n");
    spell_helper(spell, text_cstr(text));
    struct text *call = new_text(spell);
    text_fmt(call, "grow_%u($0)", want);
    return call_of(spell, text_cstr(call));
}

static const struct lang_pieces *convert(struct spell *spell, const struct lang_use *use)
{
    ir_type_id from = use->operands[0], to = use->type;
    if (is_matrix(from) && is_matrix(to))
        return rows_of(from) < rows_of(to) ? grow(spell, from, to)
                                           : form_of(spell, "($T)$0", LANG_PREC_UNARY);
    if (components(from) <= components(to) || !is_vector(to))
        return NULL;
    struct text *text = new_text(spell);
    text_fmt(text, "$0.%.*s", (int)components(to), parts);
    return call_of(spell, text_cstr(text));
}

/* ---- Hooks ---- */

typedef const struct lang_pieces *form_writer(struct spell *spell, const struct lang_use *use);

static form_writer *const writers[IR_NUM_OPS] = {
    [IR_MUL] = product,         [IR_EQ] = equality,
    [IR_NE] = equality,         [IR_SELECT] = choice,
    [IR_SIGN] = sign,           [IR_MOD] = modulo,
    [IR_INVERSE] = inverse,     [IR_TEX_SIZE] = texture_size,
    [IR_TEX_FETCH] = texel,     [IR_CONVERT] = convert,
    [IR_CONSTRUCT] = construct,
};

const struct lang_pieces *hlsl_form(void *user_data, const struct lang_use *use)
{
    return writers[use->op] ? writers[use->op](user_data, use) : NULL;
}

const char *hlsl_maker(void *user_data, const char *type)
{
    struct spell *spell = user_data;
    const struct spell_maker *maker = spell_find_maker(spell, type);
    struct text *text = new_text(spell);
    spell_write_maker(spell, maker, text);
    spell_helper(spell, text_cstr(text));
    return maker->name;
}

/* Every component is written; no literal is infinite or no number. */
bool hlsl_write_value(const struct lang_style *style, ir_type_id type, const union ir_word *words,
                      struct text *out)
{
    const struct ir_type_info *info = ir_type_info(type);
    if (info->components == 1) {
        bool is_written = type == IR_TYPE_FLOAT && !isfinite(words->f);
        if (is_written)
            text_fmt(out, "asfloat(0x%08xu)", (unsigned)words->u);
        return is_written;
    }
    text_put(out, style->types[type]);
    for (unsigned i = 0; i < info->components; i++) {
        text_str(out, i ? ", " : "(");
        lang_print_value(style, NULL, info->scalar, &words[i], LANG_PREC_COMMA, out);
    }
    text_char(out, ')');
    return true;
}
