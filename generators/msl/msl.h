// SPDX-License-Identifier: Apache-2.0
/*
 * Metal Shading Language, whose names and order of bindings are those of MaterialX's generator.
 *
 * The language has no variables at file scope. Uniforms, textures, inputs and outputs are members
 * of a struct, GlobalContext, and what reads them is a member function. Functions of their
 * parameters alone stand above it.
 */
#ifndef MXG_GENERATORS_MSL_H
#define MXG_GENERATORS_MSL_H

#include "spell/spell.h"

extern const struct target target_msl;
extern const struct target_frame msl_frame; /* frame.c */

/* forms.c: hook of struct target. */
const struct lang_pieces *msl_form(void *user_data, const struct lang_use *use);

#endif
