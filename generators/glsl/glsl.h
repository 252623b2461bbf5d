// SPDX-License-Identifier: Apache-2.0
/* The GLSL family: one syntax for desktop OpenGL, Vulkan and OpenGL ES. */
#ifndef MXG_GENERATORS_GLSL_H
#define MXG_GENERATORS_GLSL_H

#include "spell/target.h"

extern const struct lang_syntax glsl_syntax;
extern const struct target_frame glsl_frame;     /* frame.c */
extern const struct source_language glsl_source; /* genglsl.c */
extern const struct target target_glsl, target_vulkan, target_essl, target_essl310;

/* The capabilities of every GLSL version. */
#define GLSL_CAPS \
    (CAP_VERTEX_STAGE | CAP_HOST_FILES | CAP_OVERLOADS | CAP_BITWISE | CAP_IMPLICIT_LOD \
     | CAP_TEXTURE_ARRAYS | CAP_SAMPLERS)

#endif
