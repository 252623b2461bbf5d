// SPDX-License-Identifier: Apache-2.0
/* GLSL for Vulkan: uniforms in std140 blocks, explicit sets, bindings and locations. */
#include "generators/glsl/glsl.h"

/* A parameter that is `const` becomes a SPIR-V value; others become variables, copied at every call. */
static const struct lang_syntax syntax = {
    .name = "vulkan",
    .base = &glsl_syntax,
    .param_in = "const ",
    .param_in_assigned = "",
    .param_out = "out ",
    .param_inout = "inout ",
};

static const char *const versions[] = {"450", "460", NULL};

const struct target target_vulkan = {
    .name = "vulkan",
    .materialx_name = "genglsl_vk",
    .base = &target_glsl,
    .brief = "GLSL 4.50 for SPIR-V and Vulkan",
    .caps = GLSL_CAPS | CAP_UNIFORM_BLOCKS | CAP_BINDINGS | CAP_BLOCK_STAGE_IO,
    .versions = versions,
    .syntax = &syntax,
    .stage_suffix = {"vert", "frag"},
};
