// SPDX-License-Identifier: Apache-2.0
/*
 * Binds a shader like any host, from the reflection alone: fills its attributes, blocks and
 * textures with values of a scene, the document's defaults, and values of the user.
 */
#ifndef MXG_RENDER_BIND_SHADER_H
#define MXG_RENDER_BIND_SHADER_H

#include "program/output_files.h"
#include "render/draw.h"
#include "render/scene.h"
#include "render/tints.h"

#include <mxgen/mxgen.h>

struct compiled_place; /* compile/compile.h */

/*
 * A value for an input of the document: "SR_gold/base_color" = "1, 0, 0", or a file for a texture.
 */
struct bind_value {
    const char *path, *text;
};

/* A part of the names of files: "<id>" stands for the value. */
struct bind_token {
    const char *name, *value;
};
struct bind_tokens {
    const mxg_context *context; /* its sandbox holds for the names that tokens make */
    struct bind_token *items;
    size_t num;
};

/* A file of a texture that cannot be read. */
struct bind_fault {
    const char *file; /* as the document names it; NULL: the user does, see the reason */
    char reason[512];
};

/*
 * A shader that mxgen did not write, for Vulkan. Of its variables are read: name, semantic, block,
 * type, set, binding, location, offset, byte_size, matrix_stride, values, file and path.
 */
struct bind_program {
    const char *sources[MXG_NUM_STAGES];
    const mxg_variable *variables; /* no text of them is NULL */
    uint32_t num_variables;
    uint32_t num_lights; /* length of the array of lights */
};

/* A primvar of another type than the shader reads. */
struct bind_mistyped {
    const struct primvar *primvar;
    const char *object;
    unsigned num_read; /* numbers that the shader reads of it */
};
enum { BIND_MAX_MISTYPED = 8 };

struct bind {
    const mxg_result *result;
    const struct bind_program *program; /* in place of the result; NULL: there is none */
    const struct scene *scene;
    const struct scene_object *objects; /* what is drawn */
    uint32_t num_objects;               /* 0: the scene's object */
    const char *document;               /* files that the user names are relative to it */
    const struct outputs *files;        /* none of them may be a texture */
    const struct bind_value *values;
    size_t num_values;
    const struct bind_tokens *tokens; /* of what is drawn; NULL: there are none */
    bool is_opaque;                   /* replaces the background, also for transparent materials */
    bool unwraps; /* draws the surface flat, at its texture coordinates (unwrap.h) */
    bool checker; /* a checker replaces an unreadable texture; otherwise it is an error */
    struct bind_fault *faults; /* the files that cannot be read, also where that is an error */
    size_t num_faults;

    /* where the compiler put variables (compile.h); none: where the reflection says */
    const struct compiled_place *places;
    size_t num_places;

    const struct tints *tints; /* tables of stored materials; NULL: there are none */

    mxg_variable *variables; /* of the shader, once they are read */
    uint32_t num_variables;
    uint32_t light_stride;                  /* bytes from a light to the next one */
    struct draw draw;                       /* the result */
    struct image images[DRAW_MAX_TEXTURES]; /* images for the textures */
    uint32_t num_images;
    uint32_t **orders;   /* by object: triangles from far to near, if the shader blends */
    const char *lacking; /* an object, and a property that it lacks: "st" */
    char lacked[SCENE_MAX_NAME];
    const char *lacking_slot;                         /* the slot that reads it, or "" */
    uint32_t num_lacking;                             /* how many there are */
    struct bind_mistyped mistyped[BIND_MAX_MISTYPED]; /* the first ones */
    uint32_t num_mistyped;
    uint32_t max_lights; /* array length in the shader */
    const char *id;      /* id of the error: "missing-texture"… */
    char reason[512];    /* why it failed */
};

/*
 * Fills bind->draw except its code and size. false: see bind->reason. Call bind_finish in any case.
 */
bool bind_shader(struct bind *bind);
/* Sets the id and the reason of an error. Returns false. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
bool
bind_fail_as(struct bind *bind, const char *id, const char *format, ...);
#define bind_fail(bind, ...) bind_fail_as(bind, "render-failed", __VA_ARGS__)
/* True if a variable of the shader has this semantic (docs/reflection.md). */
bool bind_has_semantic(const mxg_result *result, const char *semantic);
/* Returns what the user says of an input; NULL: nothing. */
const char *bind_user_value(const struct bind *bind, const mxg_variable *variable);
/* The location of the attribute with the texture coordinates of a surface that is drawn flat. */
uint32_t bind_unwrapped_location(const struct bind *bind);
/* Updates the data that depends on the camera and other uniforms of the scene. */
bool bind_scene(struct bind *bind);
/*
 * texture_files.c: the image of a texture; the caller frees it. `file` is the user's file; NULL:
 * the document's. *out_checker: a checker replaces a file that cannot be read, which bind->faults
 * lists. false: see bind->reason.
 */
bool bind_read_texture(struct bind *bind, uint32_t index, const mxg_variable *variable,
                       const char *file, struct image *out, bool *out_checker);
void bind_finish(struct bind *bind);

/* ---- bind_places.c ---- */

/*
 * Gives the variables the places that bind->places has; one that both stages read stands once more,
 * behind the others. There is room for so many more as there are places. false: see bind->reason.
 */
bool bind_place_variables(struct bind *bind);
/* Draws the texture that was bound last at its other places, too. false: see bind->reason. */
bool bind_place_texture(struct bind *bind, const mxg_variable *variable);

/* ---- bind_notes.c ---- */

/* Notes that an object lacks what the shader reads, so that its default stands in. */
void bind_note_lack(struct bind *bind, uint32_t object, const mxg_variable *variable);
/* Notes a primvar of another number of numbers than the shader reads; false: the object has none.
 */
bool bind_note_type(struct bind *bind, uint32_t object, const char *attribute, uint32_t num_read);

#endif
