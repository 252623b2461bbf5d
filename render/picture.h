// SPDX-License-Identifier: Apache-2.0
/*
 * From an element of a document to a picture: generates, binds, draws, averages, and puts it over
 * its background.
 */
#ifndef MXG_RENDER_PICTURE_H
#define MXG_RENDER_PICTURE_H

#include "cli/cli.h"
#include "render/render.h"
#include "render/studio.h"
#include "render/trace.h"

enum background { BACKGROUND_BACKDROP, BACKGROUND_ENVIRONMENT, BACKGROUND_NONE };

/* How pictures are made. */
struct painter {
    struct cli *cli;
    struct gpu gpu;
    struct studio studio;
    struct scene scene;
    bool is_studio;   /* the scene is the studio's */
    struct mesh fine; /* for shaders that displace it; made when first needed */
    const struct bind_value *values;
    size_t num_values;
    bool checker; /* instead of a texture that is missing */
    enum background background;
    double exposure;
    uint32_t width, height;
    unsigned oversampling;      /* samples for each pixel and axis */
    struct trace_options trace; /* no paths: pictures are drawn */
};

struct subject {
    const mxg_document *document;
    const char *path;    /* of its file */
    const char *element; /* NULL: the first that can be rendered */
};

/* A subject on the device. */
struct painting {
    struct painter *painter;
    mxg_result *result;
    struct scene scene; /* the painter's, with the mesh that the shader needs */
    struct bind *bind;
    struct render render;
    float *samples;
};

/* False after telling why. painting_close must follow in both cases. */
bool painting_open(struct painter *painter, const struct subject *subject,
                   struct painting *painting);
/* After the painter's camera has moved. */
void painting_aim(struct painting *painting);
/* The picture in linear light, premultiplied, over nothing. False after telling why. */
bool painting_draw(struct painting *painting, struct image *out);
void painting_close(struct painting *painting);

/* Open, draw and close. */
bool picture_draw(struct painter *painter, const struct subject *subject, struct image *out);

/* The picture as it is shown: exposed, over the background, in sRGB. False: out of memory. */
bool picture_develop(const struct painter *painter, const struct image *linear, struct image *out);

/*
 * Writes it: what the file's format keeps in linear light (EXR, HDR) as it was drawn, everything
 * else developed. False after telling why.
 */
bool picture_write(struct painter *painter, const char *path, const struct image *linear);

#endif
