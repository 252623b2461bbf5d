// SPDX-License-Identifier: Apache-2.0
/* GLSL for Vulkan: uniforms in std140 blocks, explicit sets, bindings and locations. */
#include "generators/glsl/glsl.h"

static const char *const versions[] = {"450", "460", NULL};

const struct target target_vulkan = {
    .name = "vulkan",
    .materialx_name = "genglsl_vk",
    .base = &target_glsl,
    .brief = "GLSL 4.50 for SPIR-V and Vulkan",
    .caps = GLSL_CAPS | CAP_UNIFORM_BLOCKS | CAP_BINDINGS | CAP_SETS | CAP_BLOCK_STAGE_IO
            | CAP_STORES | CAP_PASSES | CAP_MEDIUMP | CAP_TWO_SOURCES,
    .versions = versions,
    .syntax = &glsl_syntax,
    .stage_suffix = {"vert", "frag"},
    .pass_suffix = {"comp", "glsl"},
};
