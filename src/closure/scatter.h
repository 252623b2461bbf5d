// SPDX-License-Identifier: Apache-2.0
/*
 * The files that write the function for path tracers share this: scatter.c for a list of leaves,
 * matter_levels.c for a pile of matter.
 */
#ifndef MXG_CLOSURE_SCATTER_H
#define MXG_CLOSURE_SCATTER_H

#include "closure/closure_priv.h"

/* A leaf of a part or of several. */
struct scattering {
    ir_ref leaf;
    ir_ref share;                   /* p; 0: never picked */
    const struct closure_leaf **in; /* by part, with its weight there; NULL: absent */
};

/* Light that leaves the surface: that of the whole surface, or of the BSDF of an AOV. */
struct part {
    const struct closure_list *list; /* of the layer at hand */
    uint32_t aov;                    /* number of the AOV, unless it is the first part */
    uint32_t weight;                 /* a local: the weight of the sample */
    uint32_t seen_local, lit_local;  /* of a stack: locals for what the picked layer gives */
    ir_ref lit;                      /* what one of the lights gives */
};

struct closure_scatter {
    struct shader *shader;
    struct ir_graph *graph;
    const struct closure_host *host;
    const struct closure_lighting *lighting;
    struct part *parts; /* the first is the surface */
    uint32_t num_parts;
    VEC(struct scattering) leaves;                        /* of all parts of the layer at hand */
    uint32_t pick, direction, is_inside, density, medium; /* locals */
    /* locals of the medium inside a surface; UINT32_MAX: no medium of the shader scatters there */
    uint32_t scattering, extinction;
    ir_ref everywhere; /* VDF of the medium inside that differs from place to place; 0: none */
    ir_ref total;
    /* 1 / alpha, where the weights have the alpha that the tracer applies by chance; 0 = 1 */
    ir_ref scale;
    struct closure_copies copies; /* of the layer, whose light loop is its own */
    /* of a stack: locals for what the picked layer gives; of a surface: what it gives */
    bool is_stack, has_layer;
    uint32_t emission_local, to_light, away;
    uint32_t *aov_locals; /* by number of the AOV */
    struct closure_aovs aovs;
    ir_ref emission;
    const struct closure_pile *pile; /* NULL: a list of leaves */
    ir_ref level;                    /* of a pile: float, the level at hand */
    ir_ref enters, exits;            /* bools: light comes to the pile, and out of a solid */
};

void scatter_effect(struct closure_scatter *s, enum effect_kind kind, uint32_t index, ir_ref value);
/* A local variable with this value; its number. */
uint32_t scatter_local(struct closure_scatter *s, str_id name, ir_ref value);
ir_ref scatter_read(struct closure_scatter *s, uint32_t local);
ir_ref scatter_number(struct closure_scatter *s, float value);
ir_ref scatter_grey(struct closure_scatter *s, float value);
ir_ref scatter_op2(struct closure_scatter *s, enum ir_op op, ir_ref a, ir_ref b);
/* True where both are; 0: always. */
ir_ref scatter_both(struct ir_graph *graph, ir_ref a, ir_ref b);
/* Names a value of the shader; returns it. */
ir_ref scatter_named(struct closure_scatter *s, ir_ref value, const char *name);
ir_ref scatter_mean_of(struct closure_scatter *s, ir_ref color);
/*
 * How much of the light a lobe is likely to reflect, by an albedo (float or vec3): 0.1 + 0.9
 * albedo. The tenth is a reserve, because albedos are fits, and a lobe that is never picked loses
 * its light.
 */
ir_ref scatter_likely(struct closure_scatter *s, ir_ref albedo);
/*
 * The balance heuristic (see scatter.c) for the light of a direction that a light has drawn:
 * value / (1 + density * solid_angle), with the density of the same direction as a sample of the
 * surface, and one over that of the light.
 */
ir_ref scatter_balanced(struct closure_scatter *s, ir_ref value, ir_ref density,
                        ir_ref solid_angle);
/* The fourth random number. */
ir_ref scatter_random_number(struct shader *shader);
/* True if the light from there comes from the visible side. */
ir_ref scatter_is_in_front(struct closure_scatter *s, ir_ref direction);
/* True if a leaf sends light to the other side. */
bool scatter_refracts(struct closure_scatter *s, ir_ref leaf);
/*
 * Where a sample of a leaf that refracts goes: to the other side it is in the medium of the VDF
 * `interior`, 0 for none,
 * and its density is 0, because no light draws such a direction.
 */
void scatter_take_side(struct closure_scatter *s, ir_ref direction, ir_ref medium, ir_ref interior,
                       ir_ref *density);
/* The locals of the outputs 2 to 4; pick: the initial value of the local of this name. */
void scatter_declare_locals(struct closure_scatter *s, ir_ref pick);
void scatter_write_output(struct closure_scatter *s, str_id name, ir_ref rgb, ir_ref a);

/* ---- interior.c ---- */

/* The leaf in the first part where it has a medium behind it; NULL: in none. */
const struct closure_leaf *interior_behind(const struct closure_scatter *s,
                                           const struct scattering *leaf);
void interior_declare(struct closure_scatter *s); /* after the leaves are known */
/* Light goes into the medium of the VDF; 0: there is none. */
void interior_take(struct closure_scatter *s, ir_ref interior);
void interior_write(struct closure_scatter *s);

/* ---- matter_levels.c ---- */

/*
 * The response of the level at hand to light from a direction; 1 of a medium. solid_angle 0: the
 * light of a point, which no sample finds.
 */
ir_ref matter_response(struct closure_scatter *s, ir_ref direction, ir_ref solid_angle);
/* The emission of the level at hand, and its sample. */
void matter_sample(struct closure_scatter *s);
/* A float: 1 where the level at hand is a body, 2 where it refracts. */
ir_ref matter_inside(struct closure_scatter *s);
/* The outputs that only piles have. */
void matter_write(struct closure_scatter *s);

#endif
