// SPDX-License-Identifier: Apache-2.0
/* The tables of Slang, where it differs from HLSL (User's Guide of Slang, shader-slang.org). */
#include "generators/slang/slang.h"

#include "generators/rows.h"

static const char *const reserved[] = {
#include "generators/slang/reserved.def"
};

static const struct lang_form forms[IR_NUM_OPS] = {
    /* The compiler takes one of two "?:" among the arguments of min or max for both:
       github.com/shader-slang/slang/issues/10278. */
    CALL(SELECT, "select($0, $1, $2)"),
    CALL(TEX, "$0.tex.Sample($0.sampler, $1)"),
    CALL(TEX_LOD, "$0.tex.SampleLevel($0.sampler, $1, $2)"),
    CALL(TEX_GRAD, "$0.tex.SampleGrad($0.sampler, $1, $2, $3)"),
    CALL(TEX_FETCH, "$0.tex.Load(int3($1, $2))"),
};

static const struct lang_form forms_alone[IR_NUM_OPS] = {
    [IR_DFDX] = {"$T(0.0)", LANG_PREC_POSTFIX, false},
    [IR_DFDY] = {"$T(0.0)", LANG_PREC_POSTFIX, false},
    [IR_FWIDTH] = {"$T(0.0)", LANG_PREC_POSTFIX, false},
    CALL(TEX, "$0.tex.SampleLevel($0.sampler, $1, 0.0)"),
};

static const char *const type_names[IR_NUM_TYPES] = {
    [IR_TYPE_SAMPLER] = "SamplerTexture2D",
    [IR_TYPE_SAMPLER_ARRAY] = "SamplerTexture2DArray",
};

static const char *const half_types[IR_NUM_TYPES] = {HALF_TYPES("half")};

static const struct lang_syntax syntax = {
    .name = "slang",
    .base = &hlsl_syntax,
    .type_names = type_names,
    .half_types = half_types,
    .forms = forms,
    .forms_alone = forms_alone,
    .reserved = reserved,
    .num_reserved = sizeof reserved / sizeof *reserved,
    .array_braces = true,
    .exact_constructors = true,
    .infinity = "asfloat(0x7f800000u)",
    .nan = "asfloat(0x7fc00000u)",
};

static const char *const helpers[NUM_HLSL_HELPERS] = {
#define HELPER(ID, text) [HELPER_##ID] = text,
#include "generators/slang/helpers.def"
#undef HELPER
};

static const char *const versions[] = {"2025.3", NULL};

const struct target target_slang = {
    .name = "slang",
    .materialx_name = "genslang",
    .brief = "Slang 2025.3, with the names of MaterialX's generator",
    .caps = CAP_VERTEX_STAGE | CAP_OVERLOADS | CAP_BITWISE | CAP_IMPLICIT_LOD | CAP_TEXTURE_ARRAYS
            | CAP_BLOCK_STAGE_IO | CAP_SAMPLERS | CAP_HOST_FILES | CAP_STORES | CAP_PASSES
            | CAP_MEDIUMP | CAP_TWO_SOURCES | CAP_PROGRAM_BINDINGS,
    .versions = versions,
    .syntax = &syntax,
    .frame = &slang_frame,
    .form = hlsl_form,
    .helpers = helpers,
    .array_type = "typealias $N = $T[$L];",
    .functions = hlsl_functions,
    .images = hlsl_images,
    .position = ".position",
    .stage_suffix = {"vert.slang", "frag.slang"},
    .pass_suffix = {"comp.slang", "slang"},
};
