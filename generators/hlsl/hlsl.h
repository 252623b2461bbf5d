// SPDX-License-Identifier: Apache-2.0
/*
 * High Level Shading Language, for Direct3D and Vulkan.
 *
 * A matrix in HLSL is the transpose: its rows are the columns of the portable language. So M[i] is
 * the same vector in both, constructors take the same values in the same order, and a host writes
 * the same bytes into buffers. M * v is mul(v, M), and A * B is mul(B, A).
 */
#ifndef MXG_GENERATORS_HLSL_H
#define MXG_GENERATORS_HLSL_H

#include "spell/spell.h"

extern const struct target target_hlsl;
extern const struct target_frame hlsl_frame; /* frame.c */

/* forms.c: hooks of struct target. */
const struct lang_pieces *hlsl_form(void *user_data, const struct lang_use *use);
const char *hlsl_maker(void *user_data, const char *type);

#endif
