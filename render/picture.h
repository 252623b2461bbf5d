// SPDX-License-Identifier: Apache-2.0
/*
 * Renders a document element to a picture: generates, binds, draws, averages, and adds the
 * background.
 */
#ifndef MXG_RENDER_PICTURE_H
#define MXG_RENDER_PICTURE_H

#include "program/cli.h"
#include "program/name_table.h"
#include "program/output_files.h"
#include "render/aovs.h"
#include "render/deferred_passes.h"
#include "render/render.h"
#include "render/studio.h"
#include "render/trace.h"

enum background { BACKGROUND_BACKDROP, BACKGROUND_ENVIRONMENT, BACKGROUND_NONE };

/* Settings for pictures. */
struct painter {
    struct cli *cli;
    struct gpu gpu;
    struct studio studio;
    struct scene scene;
    bool is_studio;        /* the scene is the studio */
    struct mesh fine;      /* for displaced materials; made on first use */
    struct outputs *files; /* files that the command reads or writes */
    bool has_clash;        /* a texture is one of the latter: no picture may be written */
    const struct bind_value *values;
    size_t num_values;
    bool unwraps;                      /* surfaces are flat, at their texture coordinates */
    bool checker;                      /* replaces missing textures by a checker */
    bool told_occlusion;               /* that rasters compute none */
    const mxg_document *told_document; /* the last document with textures that cannot be read */
    struct name_table told_textures;   /* what was printed of them; names_finish frees it */
    enum background background;
    double exposure;
    uint32_t width, height;
    unsigned oversampling;      /* samples per pixel and axis */
    uint32_t shown;             /* number of a debug view; UINT32_MAX: pictures are lit */
    struct trace_options trace; /* no paths: use the rasteriser */
    bool wants_aovs;            /* of one picture */
    struct aovs aovs;           /* of the last picture; aovs_finish frees it */
    size_t first_aov, num_aovs; /* those that are drawn together */
};

struct subject {
    const mxg_document *document;
    const char *path;             /* of the file */
    const char *element;          /* NULL: the first renderable; of a stack, its name */
    const mxg_bindings *bindings; /* of a stack; NULL: the element */
    uint32_t stack;
    const struct scene_object *objects; /* what has it */
    uint32_t num_objects;               /* 0: the object of the scene */
    const struct bind_tokens *tokens;   /* of the names of files; NULL: there are none */
};

/* The name of a subject in messages. */
static inline const char *subject_name(const struct subject *subject)
{
    return subject->element ? subject->element : subject->path;
}

/* A subject on the device. */
struct part {
    const struct subject *subject;
    mxg_result *result;
    struct bind *bind;
    struct bind_tokens defaults; /* of the names of files, where the subject has none */
    struct render render;
    struct scene_object *fine; /* the objects for displaced materials; NULL: those of the subject */
    uint32_t num_fine;
};

/* Subjects in one picture. */
struct painting {
    struct painter *painter;
    struct scene scene; /* the scene of the painter, with the mesh for this shader */
    struct part *parts;
    size_t num_parts;
    struct draw_canvas *canvas;
    struct passes passes;
    float *samples;
};

/* false after reporting an error. Call painting_close in any case. */
bool painting_open(struct painter *painter, const struct subject *subjects, size_t count,
                   struct painting *painting);
/* Call after moving the painter's camera. */
void painting_aim(struct painting *painting);
/*
 * Renders the picture in linear light, premultiplied, without background. false after reporting an
 * error.
 */
bool painting_draw(struct painting *painting, struct image *out);
void painting_close(struct painting *painting);

/* Open, draw and close, for AOVs again and again. */
bool picture_draw(struct painter *painter, const struct subject *subjects, size_t count,
                  struct image *out);

/* Converts the picture for display: exposure, background, sRGB. false: out of memory. */
bool picture_develop(const struct painter *painter, const struct image *linear, struct image *out);

/*
 * Writes the picture: linear light for EXR and HDR, otherwise display values. false after reporting
 * an error.
 */
bool picture_write(struct painter *painter, const char *path, const struct image *linear);

#endif
