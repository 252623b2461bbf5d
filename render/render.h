// SPDX-License-Identifier: Apache-2.0
/* Renders a generated shader of a target for Vulkan to floats: compiles, binds, draws. */
#ifndef MXG_RENDER_RENDER_H
#define MXG_RENDER_RENDER_H

#include "render/bind_shader.h"
#include "compile/compile.h"

/* A program on the device, for one picture or several. */
struct render {
    struct gpu *gpu;
    struct bind *bind;
    struct compiled compiled;
    struct draw_program *program;
};

/*
 * Prepares to draw bind->result in bind->scene. `bind` has the result, scene, objects, document and
 * values, and outlives `render`. false: see bind->id and bind->reason. Call render_close in any
 * case, and bind_finish after it.
 */
bool render_open(struct render *render, struct draw_canvas *canvas, struct gpu *gpu,
                 struct bind *bind);

/*
 * Draws the programs in the current scene: RGBA, top row first, cleared to 0. `out_pixels` has room
 * for the canvas. false: see bind->id and bind->reason of the first one.
 */
bool render_frame(struct render *renders, size_t count, struct draw_canvas *canvas,
                  float *out_pixels);

void render_close(struct render *render);

/* Renders one picture with the three functions. */
bool render_result(struct gpu *gpu, struct bind *bind, uint32_t width, uint32_t height,
                   float *out_pixels);

#endif
