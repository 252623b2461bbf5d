// SPDX-License-Identifier: Apache-2.0
/*
 * Slabs of matter (docs/slabs.md): a tree of slabs under operators becomes a tree of lobes, which
 * the closure room draws like any other. A slab needs to know where it lies, so the tree changes
 * once it is complete.
 */
#ifndef MXG_SLABS_SLABS_H
#define MXG_SLABS_SLABS_H

#include "closure/closure.h"

/* The operands of a SLAB. */
enum slab_operand {
#define SLAB_INPUT(name, type) SLAB_##name,
#include "slabs/slabs.def"
#undef SLAB_INPUT
    NUM_SLAB_INPUTS,
    SLAB_coverage = NUM_SLAB_INPUTS, /* 1, unless parameter blending gives it another value */
    NUM_SLAB_OPERANDS
};

/* The parts of slabs that can be turned off. */
enum slab_feature {
#define SLAB_FEATURE(id, key, doc) SLAB_##id,
#include "slabs/features.def"
#undef SLAB_FEATURE
    NUM_SLAB_FEATURES
};

/*
 * The features of what lies below a slab, which no input of it tells: as bits of enum slab_feature,
 * the attribute of a SLAB has those that it lacks.
 */
enum { SLAB_FEATURES_BELOW = 1u << SLAB_ROUGHNESS | 1u << SLAB_REFRACTION };
/* The attribute of a SLAB whose medium is clear nowhere (regime.h). */
enum { SLAB_NEVER_CLEAR = 1u << NUM_SLAB_FEATURES };

/* Where a slab lies. */
struct slab_place {
    ir_ref thickness; /* float, centimetres */
    ir_ref below;     /* vec3: albedo of everything below */
    ir_ref is_body;   /* float: 1 at the bottom of a body, 0 in a layer or sheet */
    ir_ref scatters;  /* float: 1 where the medium is never clear (regime.h) */
    ir_ref is_sheet;  /* float: 0 in a body that is never clear */
    ir_ref walks;     /* float: 1 where light walks through the mesh of a body */
    ir_ref unit;      /* float: centimetres in a unit of the world */
    ir_ref blur; /* float, centimetres: deviation of light by rough interfaces above; 0: none */
};

struct slabs_host {
    void *user_data;
    /* The lobes of a slab: a tree of LEAF nodes. inputs: by enum slab_operand. */
    ir_ref (*lobes)(void *user_data, const ir_ref *inputs, const struct slab_place *place);
    /*
     * The SLAB that stands for a leaf; is_top: other matter lies below; loosely: without a film. 0:
     * no slab does.
     */
    ir_ref (*slab_of)(void *user_data, ir_ref leaf, bool is_top, bool loosely);
    /* An opaque SLAB without an interface, with the mean roughness of a leaf; 0: of none. */
    ir_ref (*slab_like)(void *user_data, ir_ref leaf, ir_ref albedo);
    /* The closure of a sheet that light from behind leaves evenly; 0: the library has none. */
    ir_ref (*lit_from_behind)(void *user_data, ir_ref color);
    /*
     * Means of a texture by its variable: SLABS_TEXELS rows from the top, as many RGBA each. NULL:
     * it cannot be read.
     */
    const float *(*texels)(void *user_data, uint32_t variable);
    /*
     * A value around the shaded point, with a deviation in units of the world. NULL: the shader
     * blurs no values; a pass blurs light instead, by slab_place.blur.
     */
    ir_ref (*blurred)(void *user_data, ir_ref value, ir_ref position, ir_ref deviation);
    const struct closure_host *closures;
    bool walks;            /* light walks through the meshes of bodies */
    bool is_on_matter;     /* surfaces lie on others, so no light comes from behind */
    bool asks_thickness;   /* the host of the shader tells how thick bodies are */
    struct arena *scratch; /* for estimates, which leave it empty; NULL: there are none */
};

#define SLABS_TEXELS 64             /* a part is about a pixel of a small picture */
#define SLABS_LAYER_THICKNESS 0.01f /* centimetres, of a layer without an input for it */
#define SLABS_CLEAR_PATH 1e6f       /* centimetres, of matter that is only an interface */

/* layers.c: where slabs lie. True for a layer of slabs or of any closures. */
bool slabs_is_layer(const struct ir_graph *graph, ir_ref ref);
/* The thickness of what is in the top of a layer. */
ir_ref slabs_layer_thickness(struct ir_graph *graph, ir_ref layer);
/* The thickness of a surface that is a sheet; 0: it is the boundary of a body, or no surface. */
ir_ref slabs_sheet_thickness(const struct ir_graph *graph, ir_ref surface);

/* True if a closure or shader has slabs. ref 0: it has none. */
bool slabs_has(const struct shader *shader, ir_ref ref);
/* True if light may go into one of its slabs. */
bool slabs_has_media(const struct shader *shader, ir_ref ref);

/*
 * Replaces all slabs below a root of any type by their lobes. Returns the root itself if it has no
 * slabs. The result has no SLAB, SLAB_LAYER and SLAB_SURFACE.
 */
ir_ref slabs_walk(struct shader *shader, const struct slabs_host *host, ir_ref root);

#endif
