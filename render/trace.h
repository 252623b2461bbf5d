// SPDX-License-Identifier: Apache-2.0
/*
 * The reference: paths through the scene, scattered by the closures of a shader that was generated
 * for `--integrator scatter`.
 */
#ifndef MXG_RENDER_TRACE_H
#define MXG_RENDER_TRACE_H

#include "render/bind.h"

/* path.glsl, as lines in pieces; NULL behind the last. */
extern const char *const trace_source[];

struct trace_options {
    uint32_t paths;   /* through each pixel */
    uint32_t bounces; /* how often a path may turn */
    bool dark;        /* there is no light from around */
    /* once, without shadows; what goes into a solid leaves it at the other side, whole */
    bool as_drawn;
    void (*progress)(void *user_data, uint32_t done, uint32_t of); /* may be NULL */
    void *progress_data;
};

/*
 * Traces paths: RGBA, first row on top. `bind` as for render_open. False: see bind->id and
 * bind->reason. bind_finish must follow in any case.
 */
bool trace_picture(struct gpu *gpu, struct bind *bind, uint32_t width, uint32_t height,
                   const struct trace_options *options, float *out_pixels);

#endif
