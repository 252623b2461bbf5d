// SPDX-License-Identifier: Apache-2.0
/* The tables of HLSL: words, types, forms (Microsoft's reference for shader model 5.1 and 6). */
#include "generators/hlsl/hlsl.h"

#include "generators/rows.h"

static const char *const reserved[] = {
#include "generators/hlsl/reserved.def"
};

static const struct lang_form forms[IR_NUM_OPS] = {
    OPERATORS_OF_VECTORS,
    [IR_MATCOMPMULT] = {"$0 * $1", LANG_PREC_PRODUCT, true},
    CALL(ATAN2, "atan2($0, $1)"),
    CALL(RSQRT, "rsqrt($0)"),
    CALL(FRACT, "frac($0)"),
    CALL(SIGN, "$T(sign($0))"), /* the function of HLSL returns integers */
    CALL(MIX, "lerp($0, $1, $2)"),
    CALL(FLOAT_TO_INT_BITS, "asint($0)"),
    CALL(FLOAT_TO_UINT_BITS, "asuint($0)"),
    CALL(INT_BITS_TO_FLOAT, "asfloat($0)"),
    CALL(UINT_BITS_TO_FLOAT, "asfloat($0)"),
    CALL(DFDX, "ddx($0)"),
    CALL(DFDY, "ddy($0)"),
    CALL(TEX, "$0.Sample($0" LANG_SAMPLER_SUFFIX ", $1)"),
    CALL(TEX_LOD, "$0.SampleLevel($0" LANG_SAMPLER_SUFFIX ", $1, $2)"),
    CALL(TEX_GRAD, "$0.SampleGrad($0" LANG_SAMPLER_SUFFIX ", $1, $2, $3)"),
    CALL(TEX_FETCH, "$0.Load(int3($1, $2))"),
};

static const struct lang_form forms_alone[IR_NUM_OPS] = {
    [IR_DFDX] = {"($T)0.0", LANG_PREC_UNARY, false},
    [IR_DFDY] = {"($T)0.0", LANG_PREC_UNARY, false},
    [IR_FWIDTH] = {"($T)0.0", LANG_PREC_UNARY, false},
    CALL(TEX, "$0.SampleLevel($0" LANG_SAMPLER_SUFFIX ", $1, 0.0)"),
};

static const char *const type_names[IR_NUM_TYPES] = {
    FLOAT3_TYPES,
    [IR_TYPE_SAMPLER] = "Texture2D",
    [IR_TYPE_SAMPLER_ARRAY] = "Texture2DArray",
};

static const char *const half_types[IR_NUM_TYPES] = {HALF_TYPES("min16float")};

static const char *const phrases[NUM_PHRASES] = {
    [PHRASE_CONSTANT] = "static const $T $N = $V;",
    [PHRASE_VARIABLE] = "static $T $N",
};

const struct lang_syntax hlsl_syntax = {
    .name = "hlsl",
    .base = &lang_syntax_portable,
    .type_names = type_names,
    .half_types = half_types,
    .forms = forms,
    .forms_alone = forms_alone,
    .reserved = reserved,
    .num_reserved = sizeof reserved / sizeof *reserved,
    .reserved_prefix = "GL_", /* macros of extensions; glslang has them in HLSL, too */
    .phrases = phrases,
    .lists_components = true,
    .array_braces = true,
    .exact_constructors = true,
    .splat = {"($T)$0", LANG_PREC_UNARY, false},
    .sampler_type = "SamplerState",
    .infinity = "asfloat(0x7f800000u)",
    .nan = "asfloat(0x7fc00000u)",
};

const struct target_function hlsl_functions[] = {
#include "generators/hlsl/functions.def"
    {NULL, NULL},
};

const struct target_image hlsl_images[] = {
#include "generators/hlsl/images.def"
    {.kind = NULL},
};

static const char *const versions[] = {"6.0", "5.1", NULL};

const struct target target_hlsl = {
    .name = "hlsl",
    .materialx_name = "genhlsl",
    .brief = "HLSL of shader model 5.1 and 6, for Direct3D 12 and Vulkan",
    .caps = CAP_VERTEX_STAGE | CAP_HOST_FILES | CAP_OVERLOADS | CAP_BITWISE | CAP_IMPLICIT_LOD
            | CAP_TEXTURE_ARRAYS | CAP_UNIFORM_BLOCKS | CAP_BINDINGS | CAP_SETS | CAP_BLOCK_STAGE_IO
            | CAP_SAMPLERS | CAP_VULKAN_ATTRIBUTES | CAP_STORES | CAP_PASSES | CAP_MEDIUMP
            | CAP_TWO_SOURCES,
    .versions = versions,
    .syntax = &hlsl_syntax,
    .frame = &hlsl_frame,
    .form = hlsl_form,
    .maker = spell_helper_maker,
    .array_type = "typedef $T $N[$L];",
    .functions = hlsl_functions,
    .images = hlsl_images,
    .packing = PACKING_CBUFFER,
    .position = ".position",
    .stage_suffix = {"vs.hlsl", "ps.hlsl"},
    .pass_suffix = {"cs.hlsl", "hlsl"},
};
