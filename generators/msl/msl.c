// SPDX-License-Identifier: Apache-2.0
/* The tables of MSL: words, types, forms (Metal Shading Language Specification, version 3.0). */
#include "generators/msl/msl.h"

#include "generators/rows.h"

static const char *const reserved[] = {
#include "generators/msl/reserved.def"
};

static const struct lang_form forms[IR_NUM_OPS] = {
    OPERATORS_OF_VECTORS,
    [IR_RADIANS] = {"$0 * 0.017453292", LANG_PREC_PRODUCT, true},
    [IR_DEGREES] = {"$0 * 57.29578", LANG_PREC_PRODUCT, true},
    CALL(ATAN2, "atan2($0, $1)"),
    CALL(RSQRT, "rsqrt($0)"),
    CALL(ROUND, "rint($0)"), /* round() rounds halves away from zero */
    CALL(CHOOSE, "select($0, $1, $2)"),
    CALL(FLOAT_TO_INT_BITS, "as_type<$T>($0)"),
    CALL(FLOAT_TO_UINT_BITS, "as_type<$T>($0)"),
    CALL(INT_BITS_TO_FLOAT, "as_type<$T>($0)"),
    CALL(UINT_BITS_TO_FLOAT, "as_type<$T>($0)"),
    CALL(DFDX, "dfdx($0)"),
    CALL(DFDY, "dfdy($0)"),
    CALL(TEX, "$0.tex.sample($0.s, $1)"),
    CALL(TEX_LOD, "$0.tex.sample($0.s, $1, level($2))"),
    CALL(TEX_GRAD, "$0.tex.sample($0.s, $1, gradient2d($2, $3))"),
    CALL(TEX_FETCH, "$0.tex.read(uint2($1), uint($2))"),
};

static const struct lang_form forms_alone[IR_NUM_OPS] = {
    CALL(DFDX, "$T(0.0)"),
    CALL(DFDY, "$T(0.0)"),
    CALL(FWIDTH, "$T(0.0)"),
    CALL(TEX, "$0.tex.sample($0.s, $1, level(0.0))"),
};

static const char *const type_names[IR_NUM_TYPES] = {
    FLOAT3_TYPES,
    [IR_TYPE_SAMPLER] = "MetalTexture",
    [IR_TYPE_SAMPLER_ARRAY] = "MetalTextureArray",
};

static const char *const half_types[IR_NUM_TYPES] = {HALF_TYPES("half")};

static const char *const phrases[NUM_PHRASES] = {
    [PHRASE_CONSTANT] = "constant $T $N = $V;", [PHRASE_ARRAY] = "array<$T, $L>",
    [PHRASE_PARAM_OUT] = "thread $T& $N",       [PHRASE_PARAM_INOUT] = "thread $T& $N",
    [PHRASE_DISCARD] = "discard_fragment()",
};

static const struct lang_syntax syntax = {
    .name = "msl",
    .base = &lang_syntax_portable,
    .type_names = type_names,
    .half_types = half_types,
    .half_suffix = "h",
    .forms = forms,
    .forms_alone = forms_alone,
    .reserved = reserved,
    .num_reserved = sizeof reserved / sizeof *reserved,
    .phrases = phrases,
    .array_braces = true,
    .struct_braces = true,
    .exact_constructors = true,
    .infinity = "INFINITY",
    .nan = "NAN",
};

/* The names of MaterialX's generator. */
static const char *const instances[NUM_BLOCKS] = {
    [BLOCK_PUBLIC_UNIFORMS] = "u_pub",
    [BLOCK_PRIVATE_UNIFORMS] = "u_prv",
    [BLOCK_LIGHT_DATA] = "u_lightData",
    [BLOCK_APP_DATA] = "vi",
    [BLOCK_OUTPUTS] = "out",
};

static const struct target_function functions[] = {
#include "generators/msl/functions.def"
    {NULL, NULL},
};

static const struct target_image images[] = {
#include "generators/msl/images.def"
    {.kind = NULL},
};

static const char *const versions[] = {"2.3", "3.0", NULL};

const struct target target_msl = {
    .name = "msl",
    .materialx_name = "genmsl",
    .brief = "Metal Shading Language 2.3 and 3.0",
    .caps = CAP_VERTEX_STAGE | CAP_OVERLOADS | CAP_BITWISE | CAP_IMPLICIT_LOD | CAP_TEXTURE_ARRAYS
            | CAP_UNIFORM_BLOCKS | CAP_BINDINGS | CAP_OWN_NUMBERS | CAP_BLOCK_STAGE_IO
            | CAP_SAMPLERS | CAP_HOST_FILES | CAP_STORES | CAP_PASSES | CAP_MEDIUMP
            | CAP_TWO_SOURCES,
    .max_attributes = 24, /* each has a buffer before those of blocks; there are 31 in all */
    .max_textures = 16,   /* section 2.10: samplers of a function */
    .versions = versions,
    .syntax = &syntax,
    .frame = &msl_frame,
    .form = msl_form,
    .functions = functions,
    .first_resource = 16, /* behind the textures that have samplers, and buffers of uniforms */
    .images = images,
    .packing = PACKING_METAL,
    .instances = instances,
    .position = ".pos",
    .stage_suffix = {"vert.metal", "frag.metal"},
    .pass_suffix = {"comp.metal", "metal"},
};
