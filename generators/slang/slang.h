// SPDX-License-Identifier: Apache-2.0
/*
 * Slang: a dialect of HLSL (generators/hlsl). The names are those of MaterialX's generator, whose
 * hosts find entry points, buffers and textures by Slang's reflection. A texture is a struct with
 * its sampler, and one constant buffer has all that a stage reads, so this target has no bindings.
 */
#ifndef MXG_GENERATORS_SLANG_H
#define MXG_GENERATORS_SLANG_H

#include "generators/hlsl/hlsl.h"

extern const struct target target_slang;
extern const struct target_frame slang_frame; /* frame.c */

#endif
