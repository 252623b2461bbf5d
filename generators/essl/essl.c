// SPDX-License-Identifier: Apache-2.0
/*
 * GLSL ES 3.00, for WebGL 2: no initial values of uniforms, no blocks between stages, explicit
 * precision.
 */
#include "generators/glsl/glsl.h"

static const char *const versions[] = {"300 es", "310 es", "320 es", NULL};

const struct target target_essl = {
    .name = "essl",
    .materialx_name = "essl",
    .base = &target_glsl,
    .brief = "GLSL ES 3.00 for OpenGL ES and WebGL 2",
    .caps = GLSL_CAPS | CAP_BLOCK_OPTION | CAP_PRECISION | CAP_MEDIUMP,
    .max_textures = 16, /* OpenGL ES 3.0, table 6.32: MAX_TEXTURE_IMAGE_UNITS */
    .versions = versions,
    .syntax = &glsl_syntax,
    .stage_suffix = {"vert", "frag"},
};
