// SPDX-License-Identifier: Apache-2.0
/* Shared by the files of this room. */
#ifndef MXG_CLOSURE_CLOSURE_PRIV_H
#define MXG_CLOSURE_CLOSURE_PRIV_H

#include "closure/closure.h"

/*
 * The value of one function of a leaf's family for the leaf's inputs; 0 where the family has none.
 * `light` gives L for LEAF_EVAL; view direction, normal and position are the shaded point's.
 */
ir_ref closure_call(struct shader *shader, const struct closure_host *host, ir_ref leaf,
                    enum leaf_function which, const ir_ref *light);

/* The shaded point. */
ir_ref closure_position(struct shader *shader, const struct closure_host *host);

/* Its unit normal. */
ir_ref closure_normal(struct shader *shader, const struct closure_host *host);

/* Unit direction to the viewer. */
ir_ref closure_view(struct shader *shader, const struct closure_host *host);

/* The same for functions that give several values; false where the family has none. */
bool closure_call_all(struct shader *shader, const struct closure_host *host, ir_ref leaf,
                      enum leaf_function which, const ir_ref *light, ir_ref *results);

/* scatter.c: what a path tracer's function does. Emission and alpha may be 0: black and 1. */
void closure_scatter(struct shader *shader, const struct closure_host *host,
                     const struct closure_list *list, const struct closure_lighting *lighting,
                     ir_ref emission, ir_ref alpha);

/* volume.c: a volume as what stands behind the shaded point. */
struct closure_volume {
    struct closure_list scattering; /* leaves that scatter light, with weights that count `path` */
    /* what it was made of, each 0 where absent; edf: light that is emitted per unit length */
    ir_ref vdf, edf;
    ir_ref path; /* vec3: length over which light is gathered */
    ir_ref alpha;
};
void closure_volume(struct shader *shader, const struct closure_host *host, ir_ref root,
                    struct closure_volume *out);

/* lights.c: the light at hand, for effects inside of EFFECT_LIGHTS. */
struct closure_light {
    ir_ref direction; /* unit, to the light */
    ir_ref intensity; /* that arrives from there */
};
void closure_sample_light(struct shader *shader, const struct closure_host *host,
                          struct closure_light *out);
/* How far it is from the shaded point: lights without a position are far. */
ir_ref closure_light_distance(struct shader *shader, const struct closure_host *host);

/* What a leaf adds to the colour in one place: a value with its weight. */
struct closure_part {
    ir_ref leaf;   /* operands behind the first are its inputs */
    ir_ref scalar; /* decides whether the leaf is computed at all */
    ir_ref value;
    bool is_guarded; /* a branch is needed where the leaf's weight is 0 */
};

/* The places: under each light, once, and for each sample of the environment. */
enum closure_place { PLACE_LIGHT, PLACE_WHOLE, PLACE_SAMPLE, NUM_PLACES };

struct closure_parts {
    VEC(struct closure_part) parts;
};

/* How a surface is lit: surface.c. */
struct closure_lit {
    uint32_t color;             /* index of the mutable variable; UINT32_MAX while there is none */
    ir_ref base;                /* what the colour begins with; 0 = black */
    struct closure_light light; /* the one at hand; 0: none was asked for */
    struct closure_parts at[NUM_PLACES];
};

/* displacement.c: how far a displacement shader moves a point; 0: nothing moves. */
ir_ref closure_offset(struct shader *shader, ir_ref displacement);

/*
 * displacement.c: moves the shaded point and the vertices, and returns the surface with the normal
 * bent. Either may be 0.
 */
ir_ref closure_displace(struct shader *shader, const struct closure_host *host, ir_ref surface,
                        ir_ref displacement);

/* differentials.c: `root` with derivatives along the screen written out, for path tracers. */
ir_ref closure_differentials(struct shader *shader, ir_ref root);

/* alpha.c: what an alpha that is not always 1 can be. */
enum shader_alpha closure_alpha(struct shader *shader, ir_ref alpha);

/* a · b, where 0 stands for 1. */
ir_ref closure_mul(struct ir_graph *graph, ir_ref a, ir_ref b);
/* product.c: the same, arranged for values that change from turn to turn of a loop. */
ir_ref closure_product(struct ir_graph *graph, ir_ref value, ir_ref weight);
/* guard.c: finds which parts need one. in_loop: only what is computed in each turn counts. */
void closure_find_guarded(struct shader *shader, struct closure_parts *list, bool in_loop);
ir_ref closure_one_minus(struct ir_graph *graph, ir_ref a);

/*
 * fresnel.c: an interface by Schlick's colours, as a conductor (`extinction`), or as a dielectric;
 * 0: it has no such input.
 */
struct closure_interface {
    ir_ref color0, color90, exponent, ior, extinction;
};
/* By how much more it reflects at a cosine than head-on. */
ir_ref closure_fresnel_rise(struct ir_graph *graph, const struct closure_interface *of,
                            ir_ref cosine);
/* Two closures of one type, either of which may be 0: none. */
ir_ref closure_mixed(struct ir_graph *graph, ir_ref bg, ir_ref fg, ir_ref mix);

/* Names a value after its part for a leaf or operator: "coat_weight" of the leaf "coat". */
void closure_name(struct shader *shader, ir_ref value, ir_ref closure, const char *role);

#endif
