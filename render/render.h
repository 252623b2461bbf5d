// SPDX-License-Identifier: Apache-2.0
/* From a generated shader of target "vulkan" or "hlsl" to a picture of floats: compiles, binds,
 * draws. */
#ifndef MXG_RENDER_RENDER_H
#define MXG_RENDER_RENDER_H

#include "render/bind.h"
#include "validate/compile.h"

/* A program on the device, for one picture or many. */
struct render {
    struct gpu *gpu;
    struct bind *bind;
    struct compiled compiled;
    struct draw_program *program;
};

/*
 * Prepares to draw bind->result on bind->scene. `bind` has the result, scene, document and values,
 * and outlives `render`. False: see bind->id and bind->reason. render_close must follow in any
 * case, and bind_finish after it.
 */
bool render_open(struct render *render, struct gpu *gpu, struct bind *bind, uint32_t width,
                 uint32_t height);

/*
 * Draws the scene as it is now: RGBA, first row on top, cleared to 0. `out_pixels` has room for
 * width * height * 4.
 */
bool render_frame(struct render *render, float *out_pixels);

void render_close(struct render *render);

/* One picture: the three of them. */
bool render_result(struct gpu *gpu, struct bind *bind, uint32_t width, uint32_t height,
                   float *out_pixels);

#endif
