// SPDX-License-Identifier: Apache-2.0
/* The path tracer: traces paths through the scene with a shader for `--integrator scatter`. */
#ifndef MXG_RENDER_TRACE_H
#define MXG_RENDER_TRACE_H

#include "render/bind.h"

/* path.glsl, as lines in pieces; ends with NULL. */
extern const char *const trace_source[];

struct trace_options {
    uint32_t paths;   /* per pixel */
    uint32_t bounces; /* maximum number of bounces */
    bool dark;        /* no light from the environment */
    /*
     * one bounce without shadows; a path that enters a solid leaves it at the other side without
     * loss
     */
    bool as_drawn;
    void (*progress)(void *user_data, uint32_t done, uint32_t of); /* may be NULL */
    void *progress_data;
};

/*
 * Traces paths to RGBA, top row first. `bind` as for render_open. false: see bind->id and
 * bind->reason. Call bind_finish in any case.
 */
bool trace_picture(struct gpu *gpu, struct bind *bind, uint32_t width, uint32_t height,
                   const struct trace_options *options, float *out_pixels);

#endif
