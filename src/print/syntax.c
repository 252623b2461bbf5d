// SPDX-License-Identifier: Apache-2.0
/*
 * The spelling of the portable language, which GLSL shares, and look-ups through a chain of syntax
 * tables.
 */
#include "print/print.h"

#include <assert.h>

#define PREFIX(op, text) [IR_##op] = {text "$0", LANG_PREC_UNARY, false}
#define INFIX(op, text, level) [IR_##op] = {"$0 " text " $1", LANG_PREC_##level, true}
#define CALL1(op, text) [IR_##op] = {text "($0)", LANG_PREC_POSTFIX, false}
#define CALL2(op, text) [IR_##op] = {text "($0, $1)", LANG_PREC_POSTFIX, false}
#define CALL3(op, text) [IR_##op] = {text "($0, $1, $2)", LANG_PREC_POSTFIX, false}
#define CALL4(op, text) [IR_##op] = {text "($0, $1, $2, $3)", LANG_PREC_POSTFIX, false}

/* Related operations stand on one line. */
// clang-format off
static const struct lang_form forms[IR_NUM_OPS] = {
    PREFIX(NEG, "-"), PREFIX(NOT, "!"), PREFIX(BITNOT, "~"),
    INFIX(ADD, "+", SUM), INFIX(SUB, "-", SUM),
    INFIX(MUL, "*", PRODUCT), INFIX(DIV, "/", PRODUCT), INFIX(REM, "%", PRODUCT),
    INFIX(SHL, "<<", SHIFT), INFIX(SHR, ">>", SHIFT),
    INFIX(AND, "&", AND), INFIX(OR, "|", OR), INFIX(XOR, "^", XOR),
    INFIX(LT, "<", COMPARE), INFIX(LE, "<=", COMPARE), INFIX(GT, ">", COMPARE), INFIX(GE, ">=", COMPARE),
    INFIX(EQ, "==", EQUAL), INFIX(NE, "!=", EQUAL),
    INFIX(LAND, "&&", LAND), INFIX(LOR, "||", LOR), INFIX(LXOR, "^^", LXOR),
    [IR_SELECT] = {"$0 ? $1 : $2", LANG_PREC_TERNARY, false},
    [IR_CONVERT] = {"$T($0)", LANG_PREC_POSTFIX, false},
    [IR_INDEX] = {"$0[$1]", LANG_PREC_POSTFIX, false},
    CALL1(RADIANS, "radians"), CALL1(DEGREES, "degrees"),
    CALL1(SIN, "sin"), CALL1(COS, "cos"), CALL1(TAN, "tan"),
    CALL1(ASIN, "asin"), CALL1(ACOS, "acos"), CALL1(ATAN, "atan"), CALL2(ATAN2, "atan"),
    CALL1(SINH, "sinh"), CALL1(COSH, "cosh"), CALL1(TANH, "tanh"),
    CALL1(ASINH, "asinh"), CALL1(ACOSH, "acosh"), CALL1(ATANH, "atanh"),
    CALL2(POW, "pow"), CALL1(EXP, "exp"), CALL1(LOG, "log"), CALL1(EXP2, "exp2"), CALL1(LOG2, "log2"),
    CALL1(SQRT, "sqrt"), CALL1(RSQRT, "inversesqrt"),
    CALL1(ABS, "abs"), CALL1(SIGN, "sign"), CALL1(FLOOR, "floor"), CALL1(TRUNC, "trunc"), CALL1(ROUND, "round"),
    CALL1(CEIL, "ceil"), CALL1(FRACT, "fract"), CALL2(MOD, "mod"),
    CALL2(MIN, "min"), CALL2(MAX, "max"), CALL3(CLAMP, "clamp"), CALL3(MIX, "mix"), CALL2(STEP, "step"),
    CALL3(SMOOTHSTEP, "smoothstep"), CALL1(ISNAN, "isnan"), CALL1(ISINF, "isinf"),
    CALL2(LESS, "lessThan"), CALL2(LESS_EQUAL, "lessThanEqual"),
    CALL2(GREATER, "greaterThan"), CALL2(GREATER_EQUAL, "greaterThanEqual"),
    CALL2(EQUAL, "equal"), CALL2(NOT_EQUAL, "notEqual"),
    CALL1(ANY, "any"), CALL1(ALL, "all"), CALL1(NOT_EACH, "not"), CALL3(CHOOSE, "mix"),
    CALL1(LENGTH, "length"), CALL2(DISTANCE, "distance"), CALL2(DOT, "dot"), CALL2(CROSS, "cross"),
    CALL1(NORMALIZE, "normalize"), CALL3(FACEFORWARD, "faceforward"), CALL2(REFLECT, "reflect"),
    CALL3(REFRACT, "refract"),
    CALL2(MATCOMPMULT, "matrixCompMult"), CALL1(TRANSPOSE, "transpose"), CALL1(DETERMINANT, "determinant"),
    CALL1(INVERSE, "inverse"),
    CALL1(FLOAT_TO_INT_BITS, "floatBitsToInt"), CALL1(FLOAT_TO_UINT_BITS, "floatBitsToUint"),
    CALL1(INT_BITS_TO_FLOAT, "intBitsToFloat"), CALL1(UINT_BITS_TO_FLOAT, "uintBitsToFloat"),
    CALL1(DFDX, "dFdx"), CALL1(DFDY, "dFdy"), CALL1(FWIDTH, "fwidth"),
    CALL2(TEX, "texture"), CALL3(TEX_LOD, "textureLod"), CALL4(TEX_GRAD, "textureGrad"),
    CALL2(TEX_SIZE, "textureSize"), CALL3(TEX_FETCH, "texelFetch"),
};
// clang-format on

/* Derivatives are 0 without neighbours. */
static const struct lang_form forms_alone[IR_NUM_OPS] = {
    [IR_DFDX] = {"$T(0.0)", LANG_PREC_POSTFIX, false},
    [IR_DFDY] = {"$T(0.0)", LANG_PREC_POSTFIX, false},
    [IR_FWIDTH] = {"$T(0.0)", LANG_PREC_POSTFIX, false},
    [IR_TEX] = {"textureLod($0, $1, 0.0)", LANG_PREC_POSTFIX, false},
};

static const char *const type_names[IR_NUM_TYPES] = {
#define IR_TYPE(ID, text, scalar, components, columns) text,
#include "ir/types.def"
#undef IR_TYPE
};

static const char *const phrases[NUM_PHRASES] = {
    [PHRASE_PLAIN] = "$T $N",
    [PHRASE_LOCAL] = "$T $N",
    [PHRASE_LOCAL_CONSTANT] = "const $T $N",
    [PHRASE_VALUE] = "$T $N",
    [PHRASE_CONSTANT] = "const $T $N = $V;",
    [PHRASE_VARIABLE] = "$T $N",
    [PHRASE_MEMBER] = "$T $N;",
    [PHRASE_STRUCT_END] = "};",
    [PHRASE_PARAM_IN] = "$T $N",
    [PHRASE_PARAM_ASSIGNED] = "$T $N",
    [PHRASE_PARAM_OUT] = "out $T $N",
    [PHRASE_PARAM_INOUT] = "inout $T $N",
    [PHRASE_FUNCTION] = "$T $N($P)",
    [PHRASE_PROCEDURE] = "void $N($P)",
    [PHRASE_REFERENCE] = "$0",
    [PHRASE_REFERENCED] = "$0",
    [PHRASE_FOR] = "for ($0; $1; $2)",
    [PHRASE_WHILE] = "while ($0)",
    [PHRASE_DO] = "do {",
    [PHRASE_DO_END] = "} while ($0);",
    [PHRASE_INCREMENT] = "++$0",
    [PHRASE_DECREMENT] = "--$0",
    [PHRASE_DISCARD] = "discard",
};

static const char *const keywords[] = {
    "bool",      "break",  "bvec2",  "bvec3", "bvec4", "const",   "continue", "do",
    "else",      "false",  "float",  "for",   "if",    "in",      "inout",    "int",
    "ivec2",     "ivec3",  "ivec4",  "mat2",  "mat3",  "mat4",    "out",      "return",
    "sampler2D", "string", "struct", "true",  "uint",  "uniform", "uvec2",    "uvec3",
    "uvec4",     "vec2",   "vec3",   "vec4",  "void",  "while"};

const struct lang_syntax lang_syntax_portable = {
    .name = "portable",
    .type_names = type_names,
    .forms = forms,
    .forms_alone = forms_alone,
    .phrases = phrases,
    .reserved = keywords,
    .num_reserved = sizeof keywords / sizeof *keywords,
    .infinity = LANG_INFINITY,
    .nan = LANG_NAN,
};

const struct lang_form *lang_syntax_form(const struct lang_syntax *syntax, enum ir_op op)
{
    assert(op < IR_NUM_OPS);
    const struct lang_form *form = NULL;
    for (; syntax; syntax = syntax->base) {
        if (!syntax->forms)
            continue;
        form = &syntax->forms[op];
        if (form->text)
            break;
    }
    return form;
}

const struct lang_form *lang_syntax_forms_alone(const struct lang_syntax *syntax)
{
    while (!syntax->forms_alone)
        syntax = syntax->base;
    return syntax->forms_alone;
}

const char *lang_syntax_type(const struct lang_syntax *syntax, ir_type_id type)
{
    assert(type < IR_NUM_TYPES);
    for (; syntax; syntax = syntax->base)
        if (syntax->type_names && syntax->type_names[type])
            return syntax->type_names[type];
    return ir_type_text(type);
}

const char *lang_syntax_phrase(const struct lang_syntax *syntax, enum lang_phrase phrase)
{
    assert(phrase < NUM_PHRASES);
    for (; syntax; syntax = syntax->base)
        if (syntax->phrases && syntax->phrases[phrase])
            return syntax->phrases[phrase];
    return NULL;
}

const char *lang_syntax_beginning(const struct lang_syntax *syntax, const char *name)
{
    const char *prefix = syntax->reserved_prefix;
    bool is_refused = (syntax->begins_with_letter && *name == '_')
                      || (prefix && *name == *prefix && strncmp(name, prefix, strlen(prefix)) == 0);
    return is_refused ? "x" : "";
}

static inline int first_two(const char *text, size_t len)
{
    return (unsigned char)text[0] << 8 | (len > 1 ? (unsigned char)text[1] : 0);
}

/* The list of a target replaces that of its base: a word may be reserved in the base alone. */
bool lang_syntax_is_reserved(const struct lang_syntax *syntax, const char *name, size_t len)
{
    size_t suffix = strlen(LANG_SAMPLER_SUFFIX);
    if (syntax->sampler_type && len > suffix
        && memcmp(name + len - suffix, LANG_SAMPLER_SUFFIX, suffix) == 0)
        return true;
    if (*lang_syntax_beginning(syntax, name))
        return true;
    while (!syntax->reserved && syntax->base)
        syntax = syntax->base;
    int begin = first_two(name, len);
    for (uint32_t low = 0, high = syntax->num_reserved; low < high;) {
        uint32_t middle = (low + high) / 2;
        const char *word = syntax->reserved[middle];
        int order = begin - first_two(word, 2);
        if (order == 0)
            order = strncmp(name, word, len);
        if (order == 0 && word[len] == '\0')
            return true;
        if (order <= 0)
            high = middle;
        else
            low = middle + 1;
    }
    return false;
}
