// SPDX-License-Identifier: Apache-2.0
/* Declarations that the files of the closure room share. */
#ifndef MXG_CLOSURE_CLOSURE_PRIV_H
#define MXG_CLOSURE_CLOSURE_PRIV_H

#include "closure/closure.h"

/* output.c: the colour, a vec3, and its alpha: one output of a program, two members of a function.
 */
void closure_write_output(struct shader *shader, ir_ref color, ir_ref alpha, ir_ref through);
/*
 * Writes a plain value as a colour: scalars are grey, two components are red and green, an alpha is
 * kept. encodes: colours are written as sRGB. False: the type is no value.
 */
bool closure_emit_value(struct shader *shader, bool encodes, ir_ref root);
/* occlusion_maps.c: the part of the first light that reaches the shaded point, by the host's shadow
 * map.
 */
ir_ref closure_shadow(struct shader *shader, const struct closure_host *host);
/* The part of the current light, and of the environment, that arrives by functions of the host. */
ir_ref closure_host_shadow(struct shader *shader, const struct closure_host *host, ir_ref light);
ir_ref closure_host_occlusion(struct shader *shader, const struct closure_host *host);
/* By what the material pass stored: the stream geomprop_open, which a lighting pass fills. */
ir_ref closure_stored_occlusion(struct shader *shader);

/* weight_text.c: writes the weight of a leaf as an expression, with the names of inputs and nodes.
 */
void closure_describe_weight(const struct shader *shader, const struct closure_leaf *leaf,
                             struct text *out);

/* closure_call for functions with several results; false if the family lacks the function. */
bool closure_call_all(struct shader *shader, const struct closure_host *host, ir_ref leaf,
                      enum leaf_function which, const ir_ref *light, ir_ref *results);

/* verbatim_leaves.c: leaves whose functions are verbatim source. */

/* closure_call for such a leaf. */
ir_ref closure_call_source(struct shader *shader, const struct closure_host *host, ir_ref leaf,
                           enum leaf_function which, const ir_ref *light);
bool closure_source_has(const struct source_leaf *source, ir_type_id type,
                        enum leaf_function which);

/* A closure as two colours, for source that takes a closure. An EDF has no throughput. */
struct closure_value {
    ir_ref response, throughput;
};
/* two_colours.c: the value of a closure for host->context. root 0: no closure. */
struct closure_value closure_evaluate(struct shader *shader, const struct closure_host *host,
                                      ir_ref root);
/* Calls the functions of a source leaf over the values of its closure operands (by operand). */
struct closure_value closure_call_with(struct shader *shader, const struct closure_host *host,
                                       ir_ref leaf, enum source_context context,
                                       const ir_ref *light, const struct closure_value *operands);

/* The decay of a weight that is no single power of the way through media. */
#define CLOSURE_MIXED UINT32_MAX

/*
 * leaf_call.c: the throughput of a leaf with its weight, for host->way. Each further way multiplies
 * it by *out_decay; 0: the throughput does not depend on the way.
 */
ir_ref closure_leaf_throughput(struct shader *shader, const struct closure_host *host, ir_ref leaf,
                               ir_ref *out_decay);

/* ways.c: the decay of light that passes both. */
ir_ref closure_both_decays(struct ir_graph *graph, ir_ref a, ir_ref b);
/*
 * Gives leaves below several media, whose decay is CLOSURE_MIXED, a decay that fits. ways[k]: the
 * same leaves with host->way k.
 */
void closure_fit_decays(struct shader *shader, struct closure_list *list,
                        const struct closure_list ways[2]);
/* closure_fit_decays for one leaf; at[k] may be NULL: weight 0. */
void closure_fit_decay(struct shader *shader, struct closure_leaf *leaf,
                       const struct closure_leaf *const at[2]);
/* Puts all leaves of a list below other matter. No media lie above them yet. */
void closure_put_under(struct shader *shader, const struct closure_host *host,
                       const struct closure_above *above, struct closure_list *list);
/* The way of the light that a leaf reflects from the environment. */
ir_ref closure_environment_way(struct shader *shader, const struct closure_host *host, ir_ref leaf);
/* two_colours.c: the throughput of an operator whose operands let these fractions pass. */
ir_ref closure_operator_throughput(struct shader *shader, ir_ref operator_, ir_ref a, ir_ref b);

/*
 * scatter.c: writes the function for path tracers, of a surface, or of the layers of a stack, of
 * which one is picked.
 */
struct closure_scatter;
struct closure_scatter_layer {
    struct closure_list list;
    const struct closure_pile *pile; /* takes the place of the list; NULL: none */
    ir_ref emission;                 /* 0: black */
    ir_ref alpha;  /* that the list and the emission have, but the tracer applies; 0: none */
    ir_ref is_it;  /* a bool: this layer is picked; 0: always */
    ir_ref chance; /* a random number that picks a leaf; 0: that of the path tracer */
    /* values, and the emission of closures; they have the alpha, too */
    struct closure_aovs aovs;
    struct closure_list *aov_lists; /* the leaves of BSDFs, by number of the AOV; NULL: no AOVs */
};
struct closure_scatter *closure_scatter_begin(struct shader *shader,
                                              const struct closure_host *host,
                                              const struct closure_lighting *lighting);
void closure_scatter_layer(struct closure_scatter *s, const struct closure_scatter_layer *layer);
/* alpha 0: 1 */
void closure_scatter_end(struct closure_scatter *s, ir_ref alpha);
struct closure_medium;
/* The outputs of a volume, behind those of a point of it; varies: from place to place. */
void closure_scatter_medium(struct closure_scatter *s, const struct closure_medium *medium,
                            bool varies);
/* A random number from 0 to below alpha. */
ir_ref closure_scatter_number(struct shader *shader, ir_ref alpha);

/* pile.c: the leaves of a closure as levels from above, which light goes through at random. */
struct closure_level {
    ir_ref leaf;     /* 0: an EDF or a gate, which let all light through */
    ir_ref emission; /* of an EDF: vec3 */
    ir_ref gate;     /* vec3: multiplies the light that goes down; 0: 1 */
    ir_ref is_here;  /* a bool, by random; 0: always */
    ir_ref scale;    /* vec3: multiplies what the leaf reflects; 0: 1 */
    bool refracts;   /* light that the leaf sends to the other side is in a solid, or leaves one */
    ir_ref solid;    /* vec3: transmittance of the solid over a unit of length; 0: 1 */
    ir_ref interior; /* VDF of the solid; 0: none */
    /*
     * of a medium: vec3, over its thickness, and a float. 0: the leaf is none. Of a body: over a
     * unit of the world; light goes on inside the mesh.
     */
    ir_ref scattering, extinction, anisotropy;
    bool is_body;
};
struct closure_pile {
    VEC(struct closure_level) levels;
    ir_ref *is_part; /* bools: which of the closures light is in; NULL: there is one */
};
/*
 * The matter of a surface, and behind it that of BSDFs for AOVs; the host chooses one. False: no
 * level is a medium that light walks through, or a closure is no pile (see pile.c); then
 * shader->not_walked says why. is_seen_through: clear media count, too.
 */
bool closure_find_pile(struct shader *shader, const struct closure_host *host,
                       const ir_ref *closures, uint32_t num_closures, bool is_seen_through,
                       struct closure_pile *out);

/* flatten.c: two volumes in one place; a may be 0. */
ir_ref closure_joined(struct ir_graph *graph, ir_ref a, ir_ref b);
/* The transmittance of a VDF over a unit of length: exp(-absorption), Beer's law; 0: 1. */
ir_ref closure_transmittance(struct shader *shader, const struct closure_host *host, ir_ref volume);

/* volume.c: a volume behind the shaded point. */
struct closure_volume {
    struct closure_list scattering; /* leaves that scatter light; their weights include `path` */
    /* its parts, 0 if absent; edf: emission per unit length */
    ir_ref vdf, edf;
    ir_ref path; /* vec3: length of the path through the volume */
    ir_ref alpha;
};
void closure_volume(struct shader *shader, const struct closure_host *host, ir_ref root,
                    struct closure_volume *out);

/* A volume for path tracers: its parts, and vec3 over a unit of the world. */
struct closure_medium {
    ir_ref edf; /* 0: absent */
    struct closure_list list;
    ir_ref scattering, extinction;
    ir_ref anisotropy; /* float: the mean over the scattered light */
};
void closure_medium(struct shader *shader, const struct closure_host *host, ir_ref root,
                    struct closure_medium *out);

/* How values differ: of several, the last one of these. */
enum closure_variation {
    VARIES_NOT,
    VARIES_BY_PLACE,  /* they read positions alone */
    VARIES_BY_SURFACE /* they read what a surface has: its texture coordinates, the viewer */
};
enum closure_variation closure_variation_of(struct shader *shader, const ir_ref *values,
                                            uint32_t num_values);

/* lights.c: the current light, for effects inside EFFECT_LIGHTS. */
struct closure_light {
    ir_ref direction;          /* unit, to the light */
    ir_ref intensity;          /* radiance that arrives */
    ir_ref distance;           /* for RETURNS_PATH; lights without a position are infinitely far */
    struct effect_list choice; /* what sets the variables of these, first in the loop */
};
void closure_sample_light(struct shader *shader, const struct closure_host *host,
                          struct closure_light *out);

/* A contribution of a leaf: a value and its weight. */
struct closure_part {
    ir_ref leaf;    /* its operands after the first are the inputs */
    uint32_t order; /* of the leaf among those of the surface */
    ir_ref scalar;  /* if 0, the leaf is skipped */
    ir_ref value;
    ir_ref count;    /* of a value per sample: the number of samples that bring light */
    bool is_guarded; /* needs a branch around the leaf */
};

/* The places of contributions: per light, once, and per environment sample. */
enum closure_place { PLACE_LIGHT, PLACE_WHOLE, PLACE_SAMPLE, NUM_PLACES };

struct closure_parts {
    VEC(struct closure_part) parts;
};

/* batches.c: leaves that share a loop over the lights, by the order after the last one of each. */
struct closure_batches {
    VEC(uint32_t) ends;
};
/* lit: the parts per light. */
void closure_find_batches(struct shader *shader, const struct closure_parts *lit,
                          struct closure_batches *out);

/*
 * displacement.c: moves the shaded point and the vertices, and returns the surface with the
 * displaced normal. Either may be 0.
 */
ir_ref closure_displace(struct shader *shader, const struct closure_host *host, ir_ref surface,
                        ir_ref displacement);

/* pick.c: one layer of a stack. */

/* A number from 0 to below 1 that picks a layer at a point. */
ir_ref closure_layer_number(struct shader *shader, ir_ref point);
/*
 * A stack whose layers read textures with explicit derivatives, so that not all neighbours need to
 * run a layer; except textures that the weights read, too.
 */
ir_ref closure_own_textures(struct shader *shader, ir_ref slots);
/* copies.c: copies of nodes, which the values that are copied one after the other share. */
struct closure_copies {
    struct shader *shader;
    VEC(ir_ref) became; /* by node: its copy; 0: itself */
    uint32_t loop;      /* of lights or samples */
    ir_ref first;       /* the oldest node with a copy */
};
/* `became` with room for the nodes up to `last`. */
ir_ref *closure_room_for_copies(struct closure_copies *c, ir_ref last);
/* The copy of a node, with one more operand if `last` is not 0. The room suffices for the node. */
ir_ref closure_over_copies(struct closure_copies *c, ir_ref ref, ir_ref last);
/* The next values share no copies with earlier ones. */
void closure_forget_copies(struct closure_copies *c);
/* The next values are those of another loop. */
void closure_enter_loop(struct closure_copies *c, uint32_t loop);
/*
 * The value in the current loop over the lights or samples: 0 is the first one. The current light
 * of one loop is not that of another.
 */
ir_ref closure_in_loop(struct closure_copies *c, ir_ref root);
/* A value of a sample where the choice is true, or false: always the same for one `c`. */
ir_ref closure_chosen(struct closure_copies *c, ir_ref root, ir_ref choice, bool is_true);
/* The value of the first sample. */
ir_ref closure_at_first_sample(struct closure_copies *c, ir_ref root);
/* True if the value reads the turn of the sample, unless an earlier value of `c` told that. */
bool closure_reads_turn(struct closure_copies *c, ir_ref root);
/* A condition `index of the sample < count` that chooses in the value; 0: there is none. */
ir_ref closure_last_sample(struct closure_copies *c, ir_ref root);

/* samples.c: the loops over the samples of the environment, in the order of their first parts. */
struct closure_sample_loop {
    struct closure_parts list;
    ir_ref choice; /* a bool, the same for all samples, that chooses between values; 0: none */
};
struct closure_sample_loops {
    VEC(struct closure_sample_loop) loops;
};
void closure_find_sample_loops(struct shader *shader, const struct closure_parts *list,
                               struct closure_sample_loops *out);
/*
 * The number of samples that a value is to be added up for; 0: it is no value per sample, and
 * whole. Where the value is `index < count ? x : 0`, it becomes x, and where the count is 1, x of
 * the first sample, which is whole. Other values per sample are added up for all samples. Forgets
 * the copies.
 */
ir_ref closure_num_samples(struct closure_copies *c, ir_ref *value);
/*
 * The turn of samples, a unit vector: the golden angle further around from sample to sample. That
 * of the first sample, and that of the next one; 0: the parts do not read it.
 */
ir_ref closure_first_turn(struct ir_graph *graph);
ir_ref closure_next_turn(struct shader *shader, const struct closure_parts *list);
/* The sum of a value over all samples, for code that does more than add it up: adds effects. */
ir_ref closure_gathered(struct shader *shader, ir_ref value);

/* blended_aovs.c: the algebra of closure_aovs. Nothing changes an operand. */

/* All absent, of weight 1. */
struct closure_aovs closure_aovs_of(struct shader *shader);
/* With a value, times alpha; alpha 0: 1. */
struct closure_aovs closure_aovs_with(struct ir_graph *graph, struct closure_aovs aovs,
                                      uint32_t index, ir_ref value, ir_ref alpha);
struct closure_aovs closure_aovs_sum(struct ir_graph *graph, struct closure_aovs a,
                                     struct closure_aovs b);
struct closure_aovs closure_aovs_mixed(struct ir_graph *graph, struct closure_aovs bg,
                                       struct closure_aovs fg, ir_ref mix);
/* base·(1 - presence) + top for the AOVs that the top has; the others stay. */
struct closure_aovs closure_aovs_coated(struct ir_graph *graph, struct closure_aovs base,
                                        struct closure_aovs top, ir_ref presence);
/* With these weights, 0: 1; a sum leaves that of its greatest part. */
struct closure_aovs closure_aovs_weighing(struct ir_graph *graph, struct closure_aovs aovs,
                                          ir_ref weight);

/* mixed_shaders.c: 0 is 1. */
bool closure_is_opaque(const struct ir_graph *graph, ir_ref opacity);

/* differentials.c: rewrites screen derivatives in `root` as differences, for path tracers. */
ir_ref closure_differentials(struct shader *shader, ir_ref root);

/* alpha.c: the possible values of an alpha that is not constant 1. */
enum shader_alpha closure_alpha(struct shader *shader, ir_ref alpha);

/*
 * product.c: ir_product with the loop-invariant factors first. out_invariant, if not NULL: their
 * product, 0 if there is none.
 */
ir_ref closure_product(struct ir_graph *graph, ir_ref value, ir_ref weight, ir_ref *out_invariant);
/* guard.c: finds the parts that need a branch. in_loop: considers only code inside the loop. */
void closure_find_guarded(struct shader *shader, struct closure_parts *list, bool in_loop);
/* Mixes two closures of one type; 0 is an absent closure. */
ir_ref closure_mixed(struct ir_graph *graph, ir_ref bg, ir_ref fg, ir_ref mix);

/* Names a value after its role for a leaf or operator: "coat_weight" of the leaf "coat". */
void closure_name(struct shader *shader, ir_ref value, ir_ref closure, const char *role);

/* ---- merge_layers.c ---- */

/* A variable of a merged surface; the values of the members begin at `first_value`. */
struct closure_variable {
    uint32_t local, first_value;
};
struct closure_merged {
    struct closure_surface surface; /* over the variables; without AOVs */
    VEC(struct closure_variable) variables;
    VEC(ir_ref) values;
};
/* True if two surfaces have the same closures, perhaps with other values. */
bool closure_are_alike(struct shader *shader, struct closure_surface *a, struct closure_surface *b);
/* One surface for members that are alike, each with the first. */
void closure_merge(struct shader *shader, const struct closure_host *host,
                   struct closure_surface *const *members, uint32_t num,
                   struct closure_merged *out);

#endif
