// SPDX-License-Identifier: Apache-2.0
/* Materials on an object, drawn forward or through storage: for tests of the deferred pipeline. */
#ifndef MXG_TESTS_DEFERRED_DRAWING_H
#define MXG_TESTS_DEFERRED_DRAWING_H

#include "render/deferred_passes.h"

#include <mxgen/scene.h>

enum { SIZE = 96, PIXELS = SIZE * SIZE, MAX_WORDS = 48, PAYLOAD_WORDS = 16 };
#define MARK 0xdeadbeefu

struct bench {
    struct gpu gpu;
    struct scene scene;
    mxg_context *context;
    mxg_options *options;
    mxg_document *document;
    const char *target;     /* of materials and passes: DEFERRED_TARGET of the environment */
    char path[1024];        /* of the document */
    const char *host;       /* NULL, or the functions that the passes ask their host for */
    const char *decals;     /* NULL, or a compute shader whose payloads are stored over materials */
    const char *painted[2]; /* NULL, or compute shaders that put decals into images */
    uint32_t words;         /* more words per pixel than the materials store */
    mxg_bindings *bindings; /* NULL, or the stack 0 of these takes the place of elements */
};

/* Shaders have the reduced interface. False: nothing can store, told. With a ball of the radius 1.
 */
bool bench_open_ball(struct bench *b);
/* As above with a plane below one lamp, without an environment. */
bool bench_open_plane(struct bench *b);
/* Documents take the place of the one before. */
bool bench_load(struct bench *b, const char *root, const char *path);
bool bench_parse(struct bench *b, const char *name, const char *text);
/* With the scene and the document. */
void bench_close(struct bench *b);

/* A material on the sphere. */
struct drawing {
    struct draw_canvas *canvas;
    struct passes passes;
    struct bind binds[2];
    struct render renders[2];
    mxg_result *results[2];
    size_t count;
    uint32_t stored_words, stored_classes, layout;
    float *pixels;
};

/* Generates a shader; reports what it says. */
bool drawing_generate(struct bench *b, const char *element, const char *role_name,
                      const char *storage, mxg_result **out);
/* Opens passes on the canvas; the caller sets what is stored, shown or traced. */
bool drawing_open_passes(struct bench *b, struct drawing *d, const struct passes_setup *what);
/* Draws the picture by the first programs, 0 for passes alone; each value is finite. */
bool drawing_frame(struct drawing *d, size_t num_programs);
/* Draws an element; storage NULL: forward. Call drawing_close in any case. */
bool drawing_open(struct bench *b, const char *element, const char *storage, uint32_t shown,
                  struct drawing *d);
/* A material on an object of its own. */
struct drawing_part {
    const char *element;
    struct scene_object object;
};
/* Draws two stored materials without holes, in this order. Call drawing_close in any case. */
bool drawing_open_both(struct bench *b, const struct drawing_part parts[2], struct drawing *d);
/* One that is all zeros is closed. */
void drawing_close(struct drawing *d);

#endif
