// SPDX-License-Identifier: Apache-2.0
/* The reference: paths through the scene, scattered by the closures of a shader that was generated for `--integrator scatter`. */
#ifndef MXG_RENDER_TRACE_H
#define MXG_RENDER_TRACE_H

#include "render/bind.h"

/* path.glsl, as lines in pieces; NULL behind the last. */
extern const char *const trace_source[];

/*
 * Traces `samples` paths through each pixel: RGBA, first row on top. `bind` as for render_open; light comes from the scene's
 * environment alone. False: see bind->id and bind->reason. bind_finish must follow in any case. `progress` may be NULL.
 */
bool trace_picture(struct gpu *gpu, struct bind *bind, uint32_t width, uint32_t height, uint32_t samples,
                   void (*progress)(void *user_data, uint32_t done, uint32_t of), void *user_data, float *out_pixels);

#endif
