// SPDX-License-Identifier: Apache-2.0
/* The texels of a document's textures, for estimates of budgets: the host reads them. */
#ifndef MXG_MATERIAL_TEXELS_H
#define MXG_MATERIAL_TEXELS_H

#include "build/build_priv.h"

/*
 * slabs_host.texels. Each texture is read once for a shader. NULL: the host reads none, or not this
 * one, or it is several files.
 */
const float *build_texels(struct builder *b, uint32_t variable);

#endif
