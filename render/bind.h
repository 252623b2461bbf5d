// SPDX-License-Identifier: Apache-2.0
/*
 * Binding as a host does it, from reflection alone: attributes, blocks and textures of a generated
 * shader are filled with the values of a scene, the document's defaults, and what the user sets.
 */
#ifndef MXG_RENDER_BIND_H
#define MXG_RENDER_BIND_H

#include "render/draw.h"
#include "render/scene.h"

#include <mxgen/mxgen.h>

/*
 * A value for an input of the document: "SR_gold/base_color" = "1, 0, 0", or a file for a texture.
 */
struct bind_value {
    const char *path, *text;
};

struct bind {
    const mxg_result *result;
    const struct scene *scene;
    const char *document; /* texture files are beside it */
    const struct bind_value *values;
    size_t num_values;
    bool is_opaque; /* colours replace what is behind, also those of transparent materials */
    bool checker; /* what a texture that cannot be read is replaced by; otherwise it is an error */

    struct draw draw;                       /* the outcome */
    struct image images[DRAW_MAX_TEXTURES]; /* read for it */
    uint32_t num_images;
    uint32_t *order;     /* triangles from far to near, where the shader blends */
    uint32_t max_lights; /* that the shader has room for */
    const char *id;      /* of the failure: "missing-texture"… */
    char reason[512];    /* why it failed */
};

/*
 * Fills bind->draw but for its code and size. False: see bind->reason. bind_finish must follow in
 * any case.
 */
bool bind_shader(struct bind *bind);
/* Again what depends on the camera and other uniforms of the scene. */
bool bind_scene(struct bind *bind);
/*
 * texture_files.c: the image of a texture, to be finished; `file` is the user's, NULL: the
 * document's. *out_checker where a checker stands for a missing file. False: see bind->reason.
 */
bool bind_read_texture(struct bind *bind, uint32_t index, const mxg_variable *variable,
                       const char *file, struct image *out, bool *out_checker);
void bind_finish(struct bind *bind);

#endif
