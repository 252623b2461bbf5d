// SPDX-License-Identifier: Apache-2.0
/*
 * The deferred pipeline (docs/deferred.md): materials write their slabs into images, and passes
 * that belong to no material light them.
 *
 *     material pass: slabs ─walk, flatten→ values and weights ─write.glsl→ words
 *     lighting pass: words ─read.glsl→ values and weights ─slab_lobes→ lobes, lights, environment
 */
#ifndef MXG_DEFERRED_DEFERRED_H
#define MXG_DEFERRED_DEFERRED_H

#include "closure/closure.h"
#include "shader/role.h"

enum {
    DEFERRED_MAX_CLOSURES = 16,  /* of a pixel: word 1 has four bits for their number */
    DEFERRED_PAYLOAD_WORDS = 16, /* of a ray */
    DEFERRED_TARGET_WORDS = 3,   /* of a pixel: they are render targets */
    DEFERRED_TILE = 8            /* pixels across a tile, which a group of a pass covers */
};

/* The option `storage`. */
enum deferred_storage { STORAGE_DITHER, STORAGE_ROUND, STORAGE_FLOAT };

/* The texts of all passes agree by these values. */
struct deferred_layout {
    enum deferred_storage storage;
    uint32_t set;      /* of the resources below */
    bool sets;         /* the target has descriptor sets */
    bool has_bindings; /* the target says where resources are bound; otherwise its compiler does */
    bool tests_late;   /* a material pass that writes an image reads the depth of its pixel */
    const char *any_format; /* of images of any format of floats; NULL: the host chooses */
    uint32_t first;         /* the binding of the first resource */
    /*
     * Parses a program (parse/parse.h) without faults, in the shader's arena; NULL: the target's
     * language is that of the texts
     */
    const struct lang_unit *(*parse)(struct shader *shader, const struct text *text);
    uint32_t max_words; /* of a pixel of this material, by the cost of its slabs; 0: of a pass */
    const struct role *role; /* of the material, or of the pass */
    bool diffuses;           /* the option `sss`: the pass "diffuse" spreads the light of bodies */
    bool blurs;              /* the option `rough-refraction`: the pass "blur" */
    bool has_occlusion;      /* the option `occlusion-map`: the alpha of target 0 */
    bool has_decals;         /* the option `decals`: images of their own */
};

/* True for a payload that returns values for images of decals, in place of words. */
static inline bool deferred_is_decal(const struct deferred_layout *layout)
{
    return layout->has_decals && role_is_of_rays(layout->role);
}

/* A hash of the storage: materials and passes with equal ones fit together. */
uint32_t deferred_layout_number(const struct deferred_layout *layout);

/*
 * closure_host.why_no_room: a slab of a material pass may weigh more than the 1 that a pixel has
 * room for, as in a sum of equal slabs; or a sheet is lit from behind.
 */
const char *deferred_why_no_room(const struct shader *shader, const struct closure_list *list);

/*
 * closure_host.store, whose store_data is a deferred_layout: the effects that write the closures of
 * a surface, or that pack its only one. Each slab has a mark (build_options.marks_slabs). Sets
 * shader->stored_words and stored_classes.
 */
void deferred_store(struct shader *shader, const struct closure_host *host,
                    const struct closure_stored *surface);

/*
 * closure_host.painted of roles that pack pixels, with has_decals: a base with what decals change
 * of it.
 */
ir_ref deferred_painted(struct shader *shader, const struct closure_host *host, ir_ref base);

/* A closure that is no slab below a root, before the walk; 0: there is none. */
ir_ref deferred_misfit(const struct shader *shader, ir_ref root);

/* Returns what lies above a closure from storage, for closure_host.above. */
struct closure_above deferred_above(struct shader *shader);

/* The classes of pixels. */
enum deferred_class {
#define CLASS(id, name) CLASS_##id,
#include "deferred/classes.def"
#undef CLASS
    NUM_CLASSES
};

/* The passes that belong to no material, in their order; not all run in one picture. */
enum deferred_pass {
    PASS_OVER, /* payloads over what pixels store: decals */
    PASS_CLASSIFY,
    PASS_COMPOSE,
    PASS_SIMPLE,
    PASS_SINGLE,
    PASS_COMPLEX,
    PASS_SPECIAL,
    PASS_DIFFUSE,
    PASS_BLUR,
    PASS_SHOW,
    PASS_LIGHT_RAYS, /* over payloads, not pixels */
    PASS_READ,       /* functions for passes of the host: what pixels store */
    NUM_PASSES
};
const char *deferred_pass_name(enum deferred_pass pass);
/* The class of a lighting pass; CLASS_EMPTY: it is none. */
enum deferred_class deferred_pass_class(enum deferred_pass pass);

/* True if the options ask for the pass. */
bool deferred_has_pass(enum deferred_pass pass, const struct deferred_layout *layout);
/* True if it has no main: its functions are for passes of the host. */
bool deferred_is_part(enum deferred_pass pass);
/* True if the buffer `tiles` has the command of its dispatch; false: a group per tile. */
bool deferred_is_indirect(enum deferred_pass pass);
/* Where that command stands in the buffer, in bytes. */
uint32_t deferred_dispatch_offset(enum deferred_pass pass);

/* The resources of the passes beside uniforms and textures of lights, by binding. */
enum deferred_binding {
    RESOURCE_WORDS,
    RESOURCE_WORD0,
    RESOURCE_WORD1,
    RESOURCE_WORD2,
    RESOURCE_DEPTH,
    RESOURCE_COLOR,
    RESOURCE_LIT,
    RESOURCE_TILES,
    RESOURCE_FRAME,
    RESOURCE_PAYLOADS,
    RESOURCE_RAYS,
    RESOURCE_SCATTERED,
    RESOURCE_BELOW,
    RESOURCE_DECAL_ALBEDO,
    RESOURCE_DECAL_F0,
    RESOURCE_DECAL_NORMAL,
    RESOURCE_DECAL_ROUGHNESS,
    NUM_RESOURCES,
    NUM_DECAL_IMAGES = NUM_RESOURCES - RESOURCE_DECAL_ALBEDO
};

#define DEFERRED_ANY_FORMAT "any"

/* A member of a buffer, or of the struct that is the type of the member before. */
struct deferred_member {
    const char *name, *type;
    uint32_t offset;
    uint32_t array_length, array_stride, matrix_stride; /* 0: no array, no matrix */
    const char *per;    /* "tile", "pixel": the array is as long for each; NULL: one array */
    const char *values; /* the words of its numbers, as in options.def; NULL: any number */
    const char *doc;
    bool is_nested; /* in the struct */
};

struct deferred_resource {
    const char *name, *kind; /* "image2D", "sampler2D", "buffer"… */
    const char *format; /* "r32ui"; "any": every format of floats; "std430"…; "": of a sampler */
    uint32_t layers;    /* of an array of images; 0: none, or as many as materials need */
    uint32_t size;      /* in bytes, of a buffer without arrays per tile or pixel */
    const struct deferred_member *members; /* of a buffer */
    uint32_t num_members;
    const char *doc;
};
const struct deferred_resource *deferred_resource(enum deferred_binding binding);
/* The resources of a pass, as bits by binding. */
uint32_t deferred_reads(enum deferred_pass pass, const struct deferred_layout *layout);
uint32_t deferred_writes(enum deferred_pass pass, const struct deferred_layout *layout);

/*
 * Writes the text of a pass, in the language of the texts. surface: of a lighting pass, the shader
 * of its function, with the source of its pixel stage; else NULL.
 */
void deferred_write_pass(enum deferred_pass pass, const struct deferred_layout *layout,
                         const char *version, const struct shader *surface, const char *source,
                         struct text *out);

/*
 * Makes a pass in another language of a shader, whose program (shader_sources.pass) is the text.
 * After shader_finish; of a lighting pass, the shader has the function of its surface.
 */
void deferred_add_pass(enum deferred_pass pass, const struct deferred_layout *layout,
                       struct shader *shader);

/* The resources of a material that takes so many words per pixel. */
struct source_resources deferred_of_material(const struct deferred_layout *layout, uint32_t words);

/* The document with the surfaces of the lighting passes. */
size_t deferred_closures_size(void);
void deferred_copy_closures(char *out); /* without a terminator */
/* The name of a class, and of its element in that document. */
const char *deferred_element(enum deferred_class which);

#endif
