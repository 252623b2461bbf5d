// SPDX-License-Identifier: Apache-2.0
/* The tables of WGSL: words, types, forms, phrases. */
#include "generators/wgsl/wgsl.h"

#include "generators/rows.h"

static const char *const reserved[] = {
#include "generators/wgsl/reserved.def"
};

/* clang-format off */
static const char *const type_names[IR_NUM_TYPES] = {
    [IR_TYPE_INT] = "i32", [IR_TYPE_UINT] = "u32", [IR_TYPE_FLOAT] = "f32",
    [IR_TYPE_BVEC2] = "vec2<bool>", [IR_TYPE_BVEC3] = "vec3<bool>", [IR_TYPE_BVEC4] = "vec4<bool>",
    [IR_TYPE_IVEC2] = "vec2i", [IR_TYPE_IVEC3] = "vec3i", [IR_TYPE_IVEC4] = "vec4i",
    [IR_TYPE_UVEC2] = "vec2u", [IR_TYPE_UVEC3] = "vec3u", [IR_TYPE_UVEC4] = "vec4u",
    [IR_TYPE_VEC2] = "vec2f", [IR_TYPE_VEC3] = "vec3f", [IR_TYPE_VEC4] = "vec4f",
    [IR_TYPE_MAT2] = "mat2x2f", [IR_TYPE_MAT3] = "mat3x3f", [IR_TYPE_MAT4] = "mat4x4f",
    [IR_TYPE_SAMPLER] = "texture_2d<f32>", [IR_TYPE_SAMPLER_ARRAY] = "texture_2d_array<f32>",
};

static const char *const half_types[IR_NUM_TYPES] = {
    [IR_TYPE_FLOAT] = "f16", [IR_TYPE_VEC2] = "vec2h", [IR_TYPE_VEC3] = "vec3h", [IR_TYPE_VEC4] = "vec4h",
};

#define TEXTURE "$0, $0" LANG_SAMPLER_SUFFIX ", $1"

static const struct lang_form forms[IR_NUM_OPS] = {
    OPERATORS_OF_VECTORS,
    CALL(SELECT, "select($2, $1, $0)"),
    CALL(CHOOSE, "select($0, $1, $2)"),
    CALL(ATAN2, "atan2($0, $1)"), CALL(RSQRT, "inverseSqrt($0)"),
    CALL(FACEFORWARD, "faceForward($0, $1, $2)"),
    CALL(FLOAT_TO_INT_BITS, "bitcast<$T>($0)"), CALL(FLOAT_TO_UINT_BITS, "bitcast<$T>($0)"),
    CALL(INT_BITS_TO_FLOAT, "bitcast<$T>($0)"), CALL(UINT_BITS_TO_FLOAT, "bitcast<$T>($0)"),
    CALL(DFDX, "dpdx($0)"), CALL(DFDY, "dpdy($0)"),
    CALL(TEX, "textureSample(" TEXTURE ")"), CALL(TEX_LOD, "textureSampleLevel(" TEXTURE ", $2)"),
    CALL(TEX_GRAD, "textureSampleGrad(" TEXTURE ", $2, $3)"),
    CALL(TEX_FETCH, "textureLoad($0, $1, $2)"), CALL(TEX_SIZE, "$T(textureDimensions($0, $1))"),
};

/* No constants, because a quotient of two would be an error. */
#define ZERO(op) [IR_##op] = {"$0 * 0.0", LANG_PREC_PRODUCT, false}

static const struct lang_form forms_alone[IR_NUM_OPS] = {
    ZERO(DFDX), ZERO(DFDY), ZERO(FWIDTH),
    CALL(TEX, "textureSampleLevel(" TEXTURE ", 0.0)"),
};

static const char *const phrases[NUM_PHRASES] = {
    [PHRASE_PLAIN] = "$N: $T",
    [PHRASE_LOCAL] = "var $N: $T",
    [PHRASE_LOCAL_CONSTANT] = "let $N: $T",
    [PHRASE_VALUE] = "let $N: $T",
    [PHRASE_CONSTANT] = "const $N: $T = $V;",
    [PHRASE_VARIABLE] = "var<private> $N: $T",
    [PHRASE_MEMBER] = "$N: $T,",
    [PHRASE_STRUCT_END] = "}",
    [PHRASE_PARAM_IN] = "$N: $T",
    [PHRASE_PARAM_ASSIGNED] = "$N: $T",
    [PHRASE_PARAM_OUT] = "$N: ptr<function, $T>",
    [PHRASE_PARAM_INOUT] = "$N: ptr<function, $T>",
    [PHRASE_FUNCTION] = "fn $N($P) -> $T",
    [PHRASE_PROCEDURE] = "fn $N($P)",
    [PHRASE_ARRAY] = "array<$T, $L>",
    [PHRASE_REFERENCE] = "&$0",
    [PHRASE_REFERENCED] = "(*$0)",
    [PHRASE_DO] = "loop {",
    [PHRASE_DO_END] = "    continuing { break if !($0); } }",
    [PHRASE_INCREMENT] = "$0++",
    [PHRASE_DECREMENT] = "$0--",
};
/* clang-format on */

static const struct lang_syntax syntax = {
    .name = "wgsl",
    .base = &lang_syntax_portable,
    .type_names = type_names,
    .half_types = half_types,
    .forms = forms,
    .forms_alone = forms_alone,
    .reserved = reserved,
    .num_reserved = sizeof reserved / sizeof *reserved,
    .reserved_prefix = WGSL_PREFIX,
    .phrases = phrases,
    .argument_level = LANG_PREC_SHIFT, /* f(a < b, c > d) would be a template, a<b, c> */
    .copies_params = true,
    .one_per_declaration = true,
    .always_braces = true,
    .no_directives = true,
    .exact_constructors = true,
    .block_bool = "u32",
    .block_bool_value = {"$0 != 0u", LANG_PREC_EQUAL, false},
    .sampler_type = "sampler",
    .infinity = WGSL_INFINITY,
    .nan = WGSL_NAN,
};

static const char *const instances[NUM_BLOCKS] = {
    [BLOCK_PRIVATE_UNIFORMS] = "u_prv", [BLOCK_PUBLIC_UNIFORMS] = "u_pub"};

static const struct target_function functions[] = {
#include "generators/wgsl/functions.def"
    {NULL, NULL},
};

static const struct target_image images[] = {
#include "generators/wgsl/images.def"
    {.kind = NULL},
};

static const char *const versions[] = {"1", NULL};

const struct target target_wgsl = {
    .name = "wgsl",
    .materialx_name = "genwgsl",
    .brief = "WGSL for WebGPU",
    .caps = CAP_VERTEX_STAGE | CAP_BITWISE | CAP_IMPLICIT_LOD | CAP_TEXTURE_ARRAYS
            | CAP_UNIFORM_BLOCKS | CAP_BINDINGS | CAP_SETS | CAP_BLOCK_STAGE_IO | CAP_SAMPLERS
            | CAP_SAMPLER_BINDINGS | CAP_HOST_FILES | CAP_STORES | CAP_PASSES | CAP_MEDIUMP
            | CAP_TWO_SOURCES,
    .max_textures = 16, /* WebGPU, default of maxSampledTexturesPerShaderStage */
    .versions = versions,
    .syntax = &syntax,
    .frame = &wgsl_frame,
    .form = wgsl_form,
    .functions = functions,
    .images = images,
    .tests_late = true,
    .half_feature = "shader-f16",
    .sources_feature = "dual-source-blending",
    .any_format = "rgba16f",
    .instances = instances,
    .position = ".position",
    .stage_suffix = {"vert.wgsl", "frag.wgsl"},
    .pass_suffix = {"comp.wgsl", "wgsl"},
};
