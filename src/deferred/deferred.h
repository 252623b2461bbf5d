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

enum {
    DEFERRED_MAX_CLOSURES = 16, /* of a pixel: word 1 has four bits for their number */
    DEFERRED_PAYLOAD_WORDS = 16 /* of a ray: MX_PAYLOAD_WORDS in passes/record.glsl */
};

/* The option `pipeline`. */
enum deferred_pipeline { PIPELINE_FORWARD, PIPELINE_DEFERRED, PIPELINE_DEPTH };

/* The option `storage`. */
enum deferred_storage { STORAGE_DITHER, STORAGE_ROUND, STORAGE_FLOAT };

/* What the texts of all passes need to agree. */
struct deferred_layout {
    enum deferred_storage storage;
    uint32_t set;    /* of the resources below */
    bool sets;       /* the target has descriptor sets */
    bool is_payload; /* of a ray, in place of a pixel */
    bool diffuses;   /* the option `sss`: the pass "diffuse" spreads the light of bodies */
    bool blurs;      /* the option `rough-refraction`: the pass "blur" */
};

/* A hash of the storage: materials and passes with equal ones fit together. */
uint32_t deferred_layout_number(const struct deferred_layout *layout);

/*
 * closure_host.store, whose store_data is a deferred_layout: the effects that write the closures of
 * a surface, or that pack its only one. Each slab has a mark (build_options.marks_slabs). Sets
 * shader->stored_words and stored_classes.
 */
void deferred_store(struct shader *shader, const struct closure_host *host,
                    const struct closure_stored *surface);

/* A closure that is no slab below a root, before the walk; 0: there is none. */
ir_ref deferred_misfit(const struct shader *shader, ir_ref root);

/* What lies above a closure from storage, for closure_host.above. */
struct closure_above deferred_above(struct shader *shader);

/* The classes with a lighting pass, by number. */
enum deferred_class {
    CLASS_EMPTY,
    CLASS_SIMPLE,
    CLASS_SINGLE,
    CLASS_COMPLEX,
    CLASS_SPECIAL,
    NUM_CLASSES
};

/* The passes that belong to no material, in their order; not all run in one picture. */
enum deferred_pass {
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
    NUM_PASSES
};
const char *deferred_pass_name(enum deferred_pass pass);
/* The class of a lighting pass; CLASS_EMPTY: it is none. */
enum deferred_class deferred_pass_class(enum deferred_pass pass);

/* A resource of the passes beside uniforms and textures of lights; its binding is its number. */
struct deferred_resource {
    const char *name, *kind; /* "image2D", "sampler2D", "buffer"… */
    const char *format;      /* "" : any */
    const char *doc;
};
bool deferred_resource(uint32_t index, struct deferred_resource *out); /* false: none */
bool deferred_reads(enum deferred_pass pass, const struct deferred_layout *layout,
                    uint32_t resource);
/* True if the buffer `tiles` has the command of its dispatch; false: a group per tile. */
bool deferred_is_indirect(enum deferred_pass pass);

/*
 * Writes the text of a pass. surface: of a lighting pass, the shader of its function, with the
 * source of its pixel stage; else NULL.
 */
void deferred_write_pass(enum deferred_pass pass, const struct deferred_layout *layout,
                         const char *version, const struct shader *surface, const char *source,
                         struct text *out);

/* The document with the surfaces of the lighting passes. */
size_t deferred_closures_size(void);
void deferred_copy_closures(char *out); /* without a terminator */
/* The name of a class, and of its element in the document. */
const char *deferred_element(enum deferred_class which);

#endif
