// SPDX-License-Identifier: Apache-2.0
/*
 * Runs a pixel shader for each element of an area: gl_FragCoord says which, and it writes to
 * buffers, not to a picture. A compute shader would do the same, but lavapipe makes a coroutine of
 * it, which for a path tracer is three quarters of the time of compiling.
 */
#ifndef MXG_RENDER_EACH_H
#define MXG_RENDER_EACH_H

#include "compile/compile.h"
#include "render/gpu.h"

/* Compiles the shader. False: out->messages say why, or there are none and memory ran out. */
bool each_compile(const char *pixel_source, struct compiled *out);

/* Makes the pipeline of what was compiled. False: see gpu->reason. */
bool each_create(struct gpu *gpu, const VkPipelineLayoutCreateInfo *layout,
                 const struct compiled *compiled, VkPipelineLayout *out_layout, VkPipeline *out);

/* Runs the pipeline that is bound. A viewport may have both sizes; each device takes 4,096. */
void each_run(VkCommandBuffer commands, uint32_t width, uint32_t height);

#endif
