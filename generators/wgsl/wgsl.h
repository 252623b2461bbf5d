// SPDX-License-Identifier: Apache-2.0
/*
 * The WebGPU Shading Language (W3C's specification of WGSL). Each stage is a module with one entry
 * point, main.
 *
 * Names of the helpers begin with "wgsl_", which no other name does.
 */
#ifndef MXG_GENERATORS_WGSL_H
#define MXG_GENERATORS_WGSL_H

#include "spell/spell.h"

extern const struct target target_wgsl;
extern const struct target_frame wgsl_frame; /* frame.c */

#define WGSL_PREFIX "wgsl_"
#define WGSL_INFINITY WGSL_PREFIX "infinity()"
#define WGSL_NAN WGSL_PREFIX "nan()"

/* ---- forms.c ---- */

/* Hook of struct target. */
const struct lang_pieces *wgsl_form(void *user_data, const struct lang_use *use);
/* Declares the functions of infinity and NaN that the text of the stage calls. */
void wgsl_add_numbers(struct spell *spell);

#endif
