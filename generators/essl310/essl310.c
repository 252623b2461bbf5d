// SPDX-License-Identifier: Apache-2.0
/* GLSL ES 3.10: uniforms in blocks, and bindings and locations as in Vulkan, without sets. */
#include "generators/glsl/glsl.h"

static const char *const versions[] = {"310 es", "320 es", NULL};

const struct target target_essl310 = {
    .name = "essl310",
    .materialx_name = "essl310",
    .base = &target_essl,
    .brief = "GLSL ES 3.10 for OpenGL ES 3.1 and later, with bindings",
    .caps = GLSL_CAPS | CAP_UNIFORM_BLOCKS | CAP_BINDINGS | CAP_PRECISION | CAP_MEDIUMP,
    .versions = versions,
    .syntax = &glsl_syntax,
    .stage_suffix = {"vert", "frag"},
};
