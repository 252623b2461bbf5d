// SPDX-License-Identifier: Apache-2.0
/*
 * Desktop OpenGL: loose uniforms with initial values, as MaterialX hosts bind them. The portable
 * language is a subset of its language.
 */
#include "generators/glsl/glsl.h"

static const char *const reserved[] = {
#include "generators/glsl/reserved.def"
};

/* round() of GLSL leaves halves to the implementation */
static const struct lang_form forms[IR_NUM_OPS] = {
    [IR_ROUND] = {"roundEven($0)", LANG_PREC_POSTFIX, false},
};

/*
 * A `const` parameter becomes a SPIR-V value. Other parameters are variables, which each call
 * copies.
 */
static const char *const phrases[NUM_PHRASES] = {
    [PHRASE_PARAM_IN] = "const $T $N",
};

const struct lang_syntax glsl_syntax = {
    .name = "glsl",
    .base = &lang_syntax_portable,
    .forms = forms,
    .reserved = reserved,
    .num_reserved = sizeof reserved / sizeof *reserved,
    .reserved_prefix = "GL_", /* macros, of extensions and others */
    .phrases = phrases,
    .wide_constants = true,
    .sizes_count_layers = true,
    .in_images = true,
    .infinity = LANG_INFINITY,
    .nan = LANG_NAN,
};

static const char *const versions[] = {"450", "330", "400", "410", "420",
                                       "430", "440", "460", NULL};

const struct target target_glsl = {
    .name = "glsl",
    .materialx_name = "genglsl",
    .brief = "GLSL for desktop OpenGL 3.3 and later",
    .caps = GLSL_CAPS | CAP_UNIFORM_DEFAULTS | CAP_BLOCK_OPTION | CAP_BLOCK_STAGE_IO | CAP_STORES
            | CAP_PASSES | CAP_TWO_SOURCES,
    .versions = versions,
    .since = {CAP_STORES | CAP_PASSES, "430"}, /* the passes are compute stages */
    .syntax = &glsl_syntax,
    .frame = &glsl_frame,
    .source = &glsl_source,
    .stage_suffix = {"vert", "frag"},
    .pass_suffix = {"comp", "glsl"},
};
