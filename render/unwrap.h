// SPDX-License-Identifier: Apache-2.0
/* Surfaces that are drawn flat, at their texture coordinates. */
#ifndef MXG_RENDER_UNWRAP_H
#define MXG_RENDER_UNWRAP_H

#include <stdint.h>

/*
 * The vertex stage of a shader of the target vulkan, with the place of a vertex from a further
 * attribute at `location` in place of the position; all else stays. The matrix from the world to
 * the clip space maps texture coordinates, too. The caller frees it. NULL: the text has no place to
 * replace.
 */
char *unwrap_stage(const char *source, uint32_t location);

#endif
