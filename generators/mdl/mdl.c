// SPDX-License-Identifier: Apache-2.0
/*
 * NVIDIA's Material Definition Language, 1.8 to 1.10: a material per file, whose closures are
 * functions of the module df (docs/mdl.md). Tables: words, types, forms, phrases.
 */
#include "generators/mdl/mdl.h"

#include "generators/rows.h"

static const char *const reserved[] = {
#include "generators/mdl/reserved.def"
};

/* clang-format off */
static const char *const type_names[IR_NUM_TYPES] = {
    [IR_TYPE_UINT] = "int",
    [IR_TYPE_BVEC2] = "bool2", [IR_TYPE_BVEC3] = "bool3", [IR_TYPE_BVEC4] = "bool4",
    [IR_TYPE_IVEC2] = "int2", [IR_TYPE_IVEC3] = "int3", [IR_TYPE_IVEC4] = "int4",
    [IR_TYPE_UVEC2] = "int2", [IR_TYPE_UVEC3] = "int3", [IR_TYPE_UVEC4] = "int4",
    [IR_TYPE_VEC2] = "float2", [IR_TYPE_VEC3] = "float3", [IR_TYPE_VEC4] = "float4",
    [IR_TYPE_MAT2] = "float2x2", [IR_TYPE_MAT3] = "float3x3", [IR_TYPE_MAT4] = "float4x4",
    [IR_TYPE_SAMPLER] = "uniform texture_2d",
    [IR_TYPE_BSDF] = "bsdf", [IR_TYPE_EDF] = "edf", [IR_TYPE_VDF] = "vdf",
};

#define MATH1(op, name) CALL(op, "math::" name "($0)")
#define MATH2(op, name) CALL(op, "math::" name "($0, $1)")
#define MATH3(op, name) CALL(op, "math::" name "($0, $1, $2)")

static const struct lang_form forms[IR_NUM_OPS] = {
    [IR_LXOR] = {"$0 != $1", LANG_PREC_EQUAL, true},
    [IR_NOT_EACH] = {"!$0", LANG_PREC_UNARY, false},
    MATH1(RADIANS, "radians"), MATH1(DEGREES, "degrees"),
    MATH1(SIN, "sin"), MATH1(COS, "cos"), MATH1(TAN, "tan"),
    MATH1(ASIN, "asin"), MATH1(ACOS, "acos"), MATH1(ATAN, "atan"), MATH2(ATAN2, "atan2"),
    MATH1(SINH, "sinh"), MATH1(COSH, "cosh"), MATH1(TANH, "tanh"),
    MATH2(POW, "pow"), MATH1(EXP, "exp"), MATH1(LOG, "log"), MATH1(EXP2, "exp2"), MATH1(LOG2, "log2"),
    MATH1(SQRT, "sqrt"), MATH1(RSQRT, "rsqrt"),
    MATH1(ABS, "abs"), MATH1(SIGN, "sign"), MATH1(FLOOR, "floor"), MATH1(ROUND, "round"), MATH1(CEIL, "ceil"),
    MATH1(FRACT, "frac"), MATH2(MIN, "min"), MATH2(MAX, "max"), MATH3(CLAMP, "clamp"), MATH3(MIX, "lerp"),
    MATH2(STEP, "step"), MATH3(SMOOTHSTEP, "smoothstep"), MATH1(ISNAN, "isnan"),
    MATH1(ANY, "any"), MATH1(ALL, "all"),
    MATH1(LENGTH, "length"), MATH2(DISTANCE, "distance"), MATH2(DOT, "dot"), MATH2(CROSS, "cross"),
    MATH1(NORMALIZE, "normalize"), MATH1(TRANSPOSE, "transpose"),
    MATH1(FLOAT_TO_INT_BITS, "float_bits_to_int"), MATH1(FLOAT_TO_UINT_BITS, "float_bits_to_int"),
    MATH1(INT_BITS_TO_FLOAT, "int_bits_to_float"), MATH1(UINT_BITS_TO_FLOAT, "int_bits_to_float"),
    CALL(TEX_SIZE, "int2(tex::width($0), tex::height($0))"), CALL(TEX_FETCH, "tex::texel_float4($0, $1)"),
    CALL(DFDX, "$T(0.0)"), CALL(DFDY, "$T(0.0)"), CALL(FWIDTH, "$T(0.0)"),
};

static const char *const phrases[NUM_PHRASES] = {
    [PHRASE_LOCAL_CONSTANT] = "$T $N",
    [PHRASE_ARRAY] = "$T[$L]",
};
/* clang-format on */

/* Unsigned numbers are int. */
static bool write_value(const struct lang_style *style, ir_type_id type, const union ir_word *words,
                        struct text *out)
{
    const struct ir_type_info *info = ir_type_info(type);
    if (info->scalar != IR_TYPE_UINT)
        return false;
    if (info->components > 1)
        text_fmt(out, "%s(", style->types[type].bytes);
    for (unsigned i = 0; i < info->components; i++) {
        bool is_lowest = words[i].u == 1u << 31; /* no literal is as low */
        text_fmt(out, is_lowest ? "%s(-2147483647 - 1)" : "%s%d", i ? ", " : "",
                 words[i].i + is_lowest);
    }
    text_str(out, info->components > 1 ? ")" : "");
    return true;
}

static const struct lang_syntax syntax = {
    .name = "mdl",
    .base = &lang_syntax_portable,
    .type_names = type_names,
    .forms = forms,
    .reserved = reserved,
    .num_reserved = sizeof reserved / sizeof *reserved,
    .reserved_prefix = MDL_PREFIX,
    .begins_with_letter = true,
    .phrases = phrases,
    .always_braces = true,
    .results_in_struct = true,
    .infinity = MDL_INFINITY,
    .nan = MDL_NAN,
    .write_value = write_value,
};

static bool is_hair(const struct shader *shader, ir_ref ref)
{
    const struct ir_node *node = ir_get(shader->graph, ref);
    if (node->op != IR_LEAF)
        return false;
    const char *form = str_text(shader->strings, shader->graph->callees.items[node->attr].name);
    if (strncmp(form, MDL_TINT, strlen(MDL_TINT)) == 0)
        return is_hair(shader, ir_arg(shader->graph, ref, 1));
    return strncmp(form, MDL_HAIR_BSDF, strlen(MDL_HAIR_BSDF)) == 0;
}

static const char *node_type(const struct spell *spell, ir_ref ref)
{
    return is_hair(spell->shader, ref) ? "hair_bsdf" : NULL;
}

static const char *const versions[] = {"1.8", "1.9", "1.10", NULL};

/* The modules of MDL 1.10. */
static const char *const modules[] = {"anno",  "base",  "debug", "df",  "limits", "math",
                                      "scene", "state", "std",   "tex", NULL};

const struct target target_mdl = {
    .name = "mdl",
    .materialx_name = "mdl", /* sources for genmdl need modules of MaterialX */
    .brief = "NVIDIA's Material Definition Language 1.8 and later",
    .caps = CAP_BITWISE | CAP_IMPLICIT_LOD | CAP_STRINGS | CAP_NAMED_WHOLES | CAP_TYPED_TEXTURES
            | CAP_MISSING_COLORS | CAP_SCOPED_PARAMETERS | CAP_METADATA,
    .lacks_aovs = "a material of MDL has no outputs beside its closures",
    .versions = versions,
    .modules = modules,
    .closures = &mdl_closures,
    .syntax = &syntax,
    .frame = &mdl_frame,
    .form = mdl_form,
    .node_type = node_type,
    .position = "state::position()",
    .stage_suffix = {NULL, "mdl"},
};
