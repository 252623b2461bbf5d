// SPDX-License-Identifier: Apache-2.0
/* The syntax of OSL by tables, and its types. */
#include "generators/osl/osl.h"

#include "generators/rows.h"

#include <assert.h>

static const char *const reserved[] = {
#include "generators/osl/reserved.def"
};

static const struct lang_form forms[IR_NUM_OPS] = {
    [IR_LXOR] = {"$0 != $1", LANG_PREC_EQUAL, true},
    [IR_CHOOSE] = {"$2 ? $1 : $0", LANG_PREC_TERNARY, false},
    CALL(ATAN2, "atan2($0, $1)"),
    CALL(RSQRT, "inversesqrt($0)"),
    CALL(INVERSE, "(1 / $0)"),
    CALL(DFDX, "Dx($0)"),
    CALL(DFDY, "Dy($0)"),
    CALL(LAYER, "layer($0, $1)"),
    CALL(CLOSURE_MIX, "mix($0, $1, $2)"),
    [IR_CLOSURE_ADD] = {"$0 + $1", LANG_PREC_SUM, true},
    [IR_CLOSURE_SCALE] = {"$0 * $1", LANG_PREC_PRODUCT, true},
};

static const char *const type_names[IR_NUM_TYPES] = {
    [IR_TYPE_BOOL] = "int",          [IR_TYPE_INT] = "int",
    [IR_TYPE_UINT] = "int",          [IR_TYPE_FLOAT] = "float",
    [IR_TYPE_BVEC2] = "bvector2",    [IR_TYPE_BVEC3] = "bvector3",
    [IR_TYPE_BVEC4] = "bvector4",    [IR_TYPE_IVEC2] = "ivector2",
    [IR_TYPE_IVEC3] = "ivector3",    [IR_TYPE_IVEC4] = "ivector4",
    [IR_TYPE_UVEC2] = "uvector2",    [IR_TYPE_UVEC3] = "uvector3",
    [IR_TYPE_UVEC4] = "uvector4",    [IR_TYPE_VEC2] = "vector2",
    [IR_TYPE_VEC3] = "vector",       [IR_TYPE_VEC4] = "vector4",
    [IR_TYPE_MAT2] = "matrix",       [IR_TYPE_MAT3] = "matrix",
    [IR_TYPE_MAT4] = "matrix",       [IR_TYPE_STRING] = "string",
    [IR_TYPE_SAMPLER] = "string",    [IR_TYPE_BSDF] = "closure color",
    [IR_TYPE_EDF] = "closure color", [IR_TYPE_VDF] = "closure color",
};

/* Writes structs and small matrices part by part. */
static bool write_value(const struct lang_style *style, ir_type_id type, const union ir_word *words,
                        struct text *out)
{
    bool is_small = type == IR_TYPE_MAT2 || type == IR_TYPE_MAT3;
    if (!osl_is_struct(type) && !is_small)
        return false;
    const struct ir_type_info *info = ir_type_info(type);
    unsigned rows = is_small ? info->columns : 0;
    text_fmt(out, "%s(", lang_syntax_type(&osl_syntax, type));
    for (unsigned i = 0; i < info->components; i++) {
        text_str(out, i ? ", " : "");
        lang_print_value(style, NULL, info->scalar, &words[i], LANG_PREC_COMMA, out);
        if (is_small && i % rows == rows - 1)
            text_str(out, rows == 2 ? ", 0, 0" : ", 0");
    }
    text_str(out, rows == 2 ? ", 0, 0, 1, 0, 0, 0, 0, 1)" : rows == 3 ? ", 0, 0, 0, 1)" : ")");
    return true;
}

/* There are no variables at file scope. */
static const char *const phrases[NUM_PHRASES] = {
    [PHRASE_LOCAL_CONSTANT] = "$T $N",
    [PHRASE_CONSTANT] = "#define $N $V",
    [PHRASE_PARAM_OUT] = "output $T $N",
    [PHRASE_PARAM_INOUT] = "output $T $N",
};

const struct lang_syntax osl_syntax = {
    .name = "osl",
    .base = &lang_syntax_portable,
    .type_names = type_names,
    .forms = forms,
    .reserved = reserved,
    .num_reserved = sizeof reserved / sizeof *reserved,
    .phrases = phrases,
    .copies_params = true,
    .plain_scalars = true,
    .arrays_are_local = true,
    .array_braces = true,
    .infinity = OSL_INFINITY,
    .nan = OSL_NAN,
    .write_value = write_value,
};

/* ---- Marks of use ---- */

void osl_note_type(void *user_data, ir_type_id type)
{
    struct osl *osl = ((struct spell *)user_data)->target_data;
    assert(type < IR_NUM_TYPES);
    osl->types |= 1u << type;
}

const char *osl_type(struct osl *osl, ir_type_id type)
{
    osl_note_type(osl->spell, type);
    return lang_syntax_type(&osl_syntax, type);
}

static bool has_helper(const struct osl *osl, const char *text)
{
    for (uint32_t i = 0; i < osl->helpers.len; i++)
        if (strcmp(osl->helpers.items[i], text) == 0)
            return true;
    return false;
}

void osl_add_helper(struct osl *osl, const char *text)
{
    if (!has_helper(osl, text))
        vec_push(osl->spell->scratch, &osl->helpers, text);
}

/* ---- Letters of types ---- */

/* A type as one letter, for helpers.def. */
char osl_type_letter(ir_type_id type)
{
    static const char letters[IR_NUM_TYPES] = {
        [IR_TYPE_BOOL] = 'b',  [IR_TYPE_INT] = 'i',     [IR_TYPE_UINT] = 'u',
        [IR_TYPE_FLOAT] = 'f', [IR_TYPE_BVEC2] = 'p',   [IR_TYPE_BVEC3] = 'q',
        [IR_TYPE_BVEC4] = 'r', [IR_TYPE_IVEC2] = 'I',   [IR_TYPE_IVEC3] = 'J',
        [IR_TYPE_IVEC4] = 'K', [IR_TYPE_UVEC2] = 'U',   [IR_TYPE_UVEC3] = 'V',
        [IR_TYPE_UVEC4] = 'W', [IR_TYPE_VEC2] = '2',    [IR_TYPE_VEC3] = '3',
        [IR_TYPE_VEC4] = '4',  [IR_TYPE_MAT2] = 'm',    [IR_TYPE_MAT3] = 'M',
        [IR_TYPE_MAT4] = 'N',  [IR_TYPE_SAMPLER] = 's', [IR_TYPE_STRING] = 't',
    };
    return type < IR_NUM_TYPES && letters[type] ? letters[type] : '?';
}
