// SPDX-License-Identifier: Apache-2.0
/*
 * Converts closures to effects: a tree of BSDFs becomes a flat list of weighted leaves, and the
 * list becomes the effects of the pixel stage: lights, environment, emission, opacity.
 */
#ifndef MXG_CLOSURE_CLOSURE_H
#define MXG_CLOSURE_CLOSURE_H

#include "ir/arithmetic.h"
#include "shader/verbatim.h"

/*
 * The functions of a leaf (lang ids; LANG_NONE: absent), in the order of enum family_member in
 * library/library.h.
 */
enum leaf_function {
    LEAF_EVAL,
    LEAF_ENVIRONMENT,
    LEAF_TRANSMISSION,
    LEAF_THROUGHPUT,
    LEAF_EMISSION,
    LEAF_FACTOR,
    LEAF_ABSORPTION,
    LEAF_SCATTERING,
    LEAF_ANISOTROPY,
    LEAF_ALBEDO,
    LEAF_REFRACTION,
    LEAF_SAMPLE,
    LEAF_PDF,
    LEAF_TRANSMITTANCE,
    LEAF_WAY,
    LEAF_TINT,
    LEAF_FACET,
    NUM_LEAF_FUNCTIONS
};

/* The shaded point in world space. The first use makes each node. */
struct closure_point {
    ir_ref position, normal, view; /* unit normal, unit direction to the viewer */
};

/* The weight of matter above a whole closure, for light on a way x: steady + color · decay^x. */
struct closure_above {
    ir_ref steady, color, decay; /* vec3 */
    ir_ref spreads; /* float, 1: it spreads the light of mirrors, see `spreads` below */
};

struct closure_list;

/* A surface to store. */
struct closure_stored {
    ir_ref bsdf;
    const struct closure_list *list; /* its leaves */
    ir_ref emission;                 /* vec3; 0: black */
    ir_ref alpha;                    /* 0: 1 */
    bool premultiplied;              /* the weights have the alpha */
    ir_ref open; /* the part of the environment that a map lets through; 0: all of it */
};

struct closure_host {
    void *user_data;
    const struct closure_above *above; /* NULL: nothing */
    /* For roles that store; otherwise NULL: why leaves have no room in a pixel. NULL: they have. */
    const char *(*why_no_room)(const struct shader *shader, const struct closure_list *list);
    /* Takes a surface instead of lighting it. */
    void (*store)(struct shader *shader, const struct closure_host *host,
                  const struct closure_stored *surface);
    const void *store_data;
    /* Where decals change it: a slab with its mark, below which nothing lies. NULL: nothing does */
    ir_ref (*painted)(struct shader *shader, const struct closure_host *host, ir_ref base);
    struct closure_point *point;
    /*
     * the question that throughputs answer, and the direction to the light for
     * SOURCE_REFLECTION; only closures in source differ by it
     */
    enum source_context context;
    const ir_ref *light;
    /* the option `transparency` is opaque or mask: opacity does not scale the colour of surfaces */
    bool keeps_color;
    bool occludes; /* an opaque leaf hides what lies below it, whatever its weight */
    /* The functions of the leaf family of a LEAF node, which is no leaf in source. */
    const uint32_t *(*leaf_functions)(void *user_data, uint32_t callee);
    /* The input name of operand `index` + 1 of a LEAF node; NULL after the last. */
    const char *(*leaf_input)(void *user_data, uint32_t callee, unsigned index);
    const struct lang_host *lang;
    struct arena *scratch; /* for evaluations; empty between them */
    /*
     * the direction to the light, for the throughput of layers under two-sided layering; NULL:
     * throughput depends only on the view direction
     */
    const ir_ref *way_in;
    /* the number of thicknesses that light goes through media on its way in: 0, 1 or 2 */
    unsigned way;
    /*
     * for lobes that mirror: media that scatter spread their light, so its way is the mean one,
     * and throughputs have it
     */
    bool spreads;
    bool asks_thickness; /* the way through a body is a function of the host */
};

/*
 * A leaf of the flattened tree. Its weight is scalar · color. If scalar is 0, the shader skips the
 * leaf. Below media the weight depends on the way x of light through them, in thicknesses:
 * scalar · (steady + color · decay^x).
 */
struct closure_leaf {
    ir_ref leaf;   /* LEAF node with weight 1 */
    ir_ref scalar; /* float */
    ir_ref color;  /* vec3; 0 = white */
    ir_ref decay;  /* vec3, 0 to 1; 0: no media above */
    ir_ref steady; /* vec3; 0 = black */
    /* vec3: transmittance of the volume behind, for the light that the leaf refracts; 0 = 1 */
    ir_ref medium;
    ir_ref interior; /* that volume: a VDF; 0: none */
};

struct closure_list {
    VEC(struct closure_leaf) leaves;
};

/*
 * Flattens a BSDF, EDF or VDF: returns leaves with their total weight, in the order of their nodes.
 * Merges equal leaves and drops leaves of weight 0. root 0: an empty list.
 */
void closure_flatten(struct shader *shader, const struct closure_host *host, ir_ref root,
                     struct closure_list *out);

/* weight_bound.c: the most that a leaf may weigh, without decay. INFINITY: it takes too long to
 * say. */
float closure_most_weight(const struct ir_graph *graph, const struct closure_leaf *leaf);

/* The option `transparency`. */
enum closure_transparency {
    TRANSPARENCY_AUTO,
    TRANSPARENCY_OPAQUE,
    TRANSPARENCY_MASK,
    TRANSPARENCY_BLEND,
    TRANSPARENCY_DUAL,
};

/* The option `layering`. */
enum closure_layering { LAYERING_VIEW, LAYERING_TWO_SIDED, LAYERING_OCCLUDING };

/*
 * Sources of darkness for light that arrives: occlusion_maps.c. STORED: the material pass of the
 * pixel read the map.
 */
enum closure_darkening {
    DARKENED_BY_NOTHING,
    DARKENED_BY_MAP,
    DARKENED_BY_HOST,
    DARKENED_AS_STORED
};

/* The lighting of the shaded point, from the options of the caller. */
struct closure_lighting {
    bool lights;      /* light shaders are bound */
    bool environment; /* `--environment` is not none */
    bool two_sided;   /* layers also attenuate the incoming light */
    /* transmitted light lowers the alpha, instead of being that of the environment */
    bool transmits_alpha;
    uint8_t transparency;                     /* enum closure_transparency */
    enum closure_darkening occlusion, shadow; /* of the environment, of lights */
    bool flips_v;                             /* textures of the host have v = 0 at their top */
    bool encodes; /* colours of the output have the transfer function of sRGB */
};

/*
 * Writes the effects of the pixel stage for a root of any type: a material, a surface or other
 * shader, a closure (treated as the closure of a surface), or a plain value, which becomes a
 * colour. false if the type has no meaning in a pixel stage; the caller reports it.
 */
bool closure_emit(struct shader *shader, const struct closure_host *host,
                  const struct closure_lighting *lighting, ir_ref root);

/*
 * The AOVs of a surface, by number in shader->aovs. Values have the weights and the alpha that the
 * other parts of the surface have; integers and booleans stay, and their weight stands beside them.
 */
struct closure_aov {
    ir_ref value; /* 0: absent */
    ir_ref weight;
};
struct closure_aovs {
    uint32_t num; /* 0: the shader has none */
    struct closure_aov *items;
};

/* The parts of a surface, each 0 where absent: mixed_shaders.c. */
struct closure_surface {
    ir_ref bsdf, edf;
    ir_ref unlit;       /* colour that does not depend on lights */
    ir_ref alpha;       /* 0 = 1 */
    ir_ref through;     /* vec3: what it lets through, for a second source; 0: 1 - alpha */
    bool premultiplied; /* alpha already scales the parts */
    bool is_matter;     /* and alpha is what the throughput of the bsdf says */
    struct closure_aovs aovs;
};
/*
 * blended_aovs.c: finds the AOVs that become outputs: those that the options list, else those of
 * the surfaces of a root.
 */
void closure_find_aovs(struct shader *shader, ir_ref root);
/* Closures and numbers times a factor; the operand stays. */
struct closure_aovs closure_aovs_scaled(struct ir_graph *graph, struct closure_aovs aovs,
                                        ir_ref factor);
/*
 * The outputs of an AOV: its value; for path tracers also the light of a BSDF, as vec3: the weight
 * of the sampled direction, the response to the host's direction, and the light of one bound light.
 */
enum aov_output { AOV_VALUE, AOV_WEIGHT, AOV_RESPONSE, AOV_LIGHT };
/* The variable of an output of an AOV; the caller chooses the type of the value. */
uint32_t closure_aov_output(struct shader *shader, uint32_t index, enum aov_output which,
                            ir_type_id type);
/* The type of its value: the light of a closure is vec3, and a boolean is int. */
ir_type_id closure_aov_type(const struct shader *shader, uint32_t index);
/* The value, of closure_aov_type: the light of a closure; 0: absent. */
ir_ref closure_aov_value(struct shader *shader, uint32_t index, ir_ref value);
/* The parts of a surface shader, which may be made of others. root 0: a black one. */
struct closure_surface closure_surface_of(struct shader *shader, const struct closure_host *host,
                                          ir_ref root);
/* Two surfaces, or a volume in front, and a displacement; 0: there is none. */
struct closure_sides {
    ir_ref front, back, displacement;
};
/* The sides of a material. A displacement is one alone; any other root is a front. */
struct closure_sides closure_sides_of(const struct ir_graph *graph, ir_ref root);

/* The surface below its AOVs; 0 stays 0. */
ir_ref closure_without_aovs(const struct ir_graph *graph, ir_ref surface);
/*
 * Its alpha alone, for stacks: the rest of the surface need not be complete. It is made of leaves,
 * mixes and AOVs.
 */
ir_ref closure_surface_alpha(struct shader *shader, ir_ref root);
/* Returns what the parts of a surface let through: its colour, or 1 - alpha as one. */
ir_ref closure_surface_through(struct ir_graph *graph, const struct closure_surface *surface);
/* The layers of a SLOTS node with their vertical ones, by slot; a vertical one itself is empty. */
struct closure_surface *closure_slot_surfaces(struct shader *shader,
                                              const struct closure_host *host, ir_ref slots);
/* A layer of a stack times its own opacity and its weight. */
struct closure_surface closure_weighted(struct ir_graph *graph, struct closure_surface layer,
                                        ir_ref weight);
/* A layer without its opacity, as it is where it is picked. */
struct closure_surface closure_picked(struct ir_graph *graph, struct closure_surface layer);
/* The layers of a stack from the top down, for a number that picks one. */
struct closure_choice {
    struct closure_surface layer; /* closure_picked */
    ir_ref low, high;             /* the numbers of the layer: from low to below high */
    ir_ref share;                 /* high - low */
    ir_ref is_it;                 /* a bool; 0: always */
};
struct closure_choices {
    VEC(struct closure_choice) items;
    ir_ref covered; /* the numbers from it on pick none; 0: all pick a layer */
};
void closure_choose(struct shader *shader, const struct closure_host *host, ir_ref slots,
                    ir_ref number, struct closure_choices *out);
/*
 * layer_normals.c: a SLOTS node whose layers are shaded with their normals, and no longer have any.
 * moved: the normal of the displaced surface; 0: the stream's.
 */
ir_ref closure_shade_slots(struct shader *shader, ir_ref slots, ir_ref moved);

/* True if the root is lit as a surface; closure_emit then succeeds. */
bool closure_is_surface(const struct shader *shader, ir_ref root);

/* ---- For targets with closures of their own ---- */

/*
 * The value of one function of a leaf's family for the leaf's inputs; 0 if the family lacks the
 * function. `light` gives L for LEAF_EVAL; view direction, normal and position come from the shaded
 * point.
 */
ir_ref closure_call(struct shader *shader, const struct closure_host *host, ir_ref leaf,
                    enum leaf_function which, const ir_ref *light);

/* The shaded point. */
ir_ref closure_position(struct shader *shader, const struct closure_host *host);
/* The way through the body in a direction, in units of the world, as the host says it. */
ir_ref closure_host_thickness(struct shader *shader, const struct closure_host *host,
                              ir_ref direction);

/* The fraction of light on a way through media that a closure lets through. root 0: all light. */
ir_ref closure_throughput(struct shader *shader, const struct closure_host *host, ir_ref root,
                          ir_ref way);

/*
 * ways.c: the weight of a leaf for light on a way (float). Ways are those of a medium with index
 * 1.5 for a direction: 1.5 / sqrt(1.25 + cos²).
 */
ir_ref closure_weight(struct shader *shader, const struct closure_leaf *leaf, ir_ref way);
ir_ref closure_way(struct shader *shader, const struct closure_host *host, ir_ref direction);
/* The mean over cosine-weighted directions: 4.5 - 1.5 sqrt(5). */
#define CLOSURE_MEAN_WAY 1.1458980f

/* ---- probe.c: for the evaluator ---- */

/* A host at a point of its own, whose functions the evaluator computes. It must stay in its place.
 */
struct closure_probe {
    struct closure_host host;
    struct closure_point point;
    struct lang_host lang;
};
void closure_probe(const struct closure_host *host, ir_ref view, struct closure_probe *out);
/* A variable that no shader has, for the evaluator alone: a vec3; equal numbers give one variable.
 */
ir_ref closure_probe_direction(struct ir_graph *graph, uint32_t number);

/* The source of a LEAF; NULL: its functions are portable. */
const struct source_leaf *closure_source(const struct shader *shader, ir_ref leaf);

/*
 * The part of the light from behind that passes a leaf straight on, by throughput and tint; 0: the
 * leaf transmits none.
 */
ir_ref closure_through(struct shader *shader, const struct closure_host *host, ir_ref leaf);

/* True if a leaf has a function. */
bool closure_has(const struct shader *shader, const struct closure_host *host, ir_ref leaf,
                 enum leaf_function which);

/* Unit direction to the viewer, and the unit normal. */
ir_ref closure_view(struct shader *shader, const struct closure_host *host);
ir_ref closure_normal(struct shader *shader, const struct closure_host *host);

/* occlusion_maps.c: the part of the environment's light that reaches the point, by the host's map.
 */
ir_ref closure_occlusion(struct shader *shader, bool flips_v);

/* displacement.c: how far a displacement shader moves a point; 0: nothing moves. */
ir_ref closure_offset(struct shader *shader, ir_ref displacement);

/* Writes the leaves and weights as text: `mxgen inspect --closures`. */
void closure_describe(struct shader *shader, const struct closure_host *host, ir_ref root,
                      struct text *out);

#endif
