// SPDX-License-Identifier: Apache-2.0
/* From a generated shader of target "vulkan" to a picture of floats: compiles, binds, draws. */
#ifndef MXG_RENDER_RENDER_H
#define MXG_RENDER_RENDER_H

#include "render/bind.h"

/*
 * Draws the result on the scene: RGBA, first row on top, cleared to 0. `bind` has the result, scene, document and
 * values. False: see bind->reason. `out_pixels` has room for width * height * 4.
 */
bool render_result(struct gpu *gpu, struct bind *bind, uint32_t width, uint32_t height, float *out_pixels);

#endif
