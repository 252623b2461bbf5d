// SPDX-License-Identifier: Apache-2.0
/* The passes of the deferred pipeline that belong to no material: made, bound, and run on a canvas.
 */
#ifndef MXG_RENDER_DEFERRED_PASSES_H
#define MXG_RENDER_DEFERRED_PASSES_H

#include "render/render.h"
#include "render/stored.h"

/* The debug views of the pass "show", by number. */
extern const char *const pass_views[]; /* NULL-terminated */

struct pass_part {
    mxg_result *result;
    struct bind bind;
    struct compiled compiled;
};

struct passes {
    struct stored *stored; /* NULL: nothing is stored */
    const struct scene *scene;
    uint32_t width, height;
    uint32_t shown;     /* number of a view; UINT32_MAX: pictures are lit */
    uint32_t *payloads; /* words of rays, row by row; NULL: there are none */
    struct pass_part parts[STORED_MAX_PASSES];
    uint32_t num_parts;
    struct tints tints;
    const char *id;
    char reason[512];
};

enum { PASSES_MAX_PAINTED = 2 };

/* The description from which passes are made. */
struct passes_setup {
    mxg_context *context;
    const mxg_options *options;
    const char *target; /* of the passes; NULL: "vulkan" */
    const struct scene *scene;
    struct draw_canvas *canvas;
    const char *host; /* functions that the passes ask the host for; NULL: they ask for none */
    uint32_t words, shown;
    uint32_t classes; /* that the materials may store, as bits of mxg_shader_info */
    /* a compute shader that writes rays with payloads, which are lit; NULL: materials are stored */
    const char *hits;
    /* the same, whose payloads are stored over the materials; NULL: nothing is */
    const char *decals;
    /*
     * compute shaders that put decals into images of their own, which the set of the passes has
     * behind its resources; NULL: the images are empty
     */
    const char *painted[PASSES_MAX_PAINTED];
    struct bind *const *binds; /* of materials that store; the passes have their tables of tints */
    size_t num_binds;
};

/* false: see passes->reason. Zeroes `out` first. Call passes_close in any case, after the canvas
 * closed. */
bool passes_open(const struct passes_setup *setup, struct passes *out);
/* Updates what depends on the camera. */
bool passes_aim(struct passes *passes);
void passes_close(struct passes *passes);

#endif
