// SPDX-License-Identifier: Apache-2.0
/*
 * The emitter: writes the code of a surface or volume into the pixel stage. lit.c writes its light,
 * picked_layers.c one layer of a stack, surface.c the rest. All values are nodes of `graph`; 0 is
 * absent.
 */
#ifndef MXG_CLOSURE_EMITTER_H
#define MXG_CLOSURE_EMITTER_H

#include "closure/closure_priv.h"

/* The light of a surface. */
struct closure_lit {
    uint32_t color; /* index of the mutable variable; UINT32_MAX before its declaration */
    ir_ref base;    /* initial value of the colour; 0 = black */
    struct closure_light light; /* the current light; 0: unused so far */
    struct closure_parts at[NUM_PLACES];
};

struct emitter {
    struct shader *shader;
    struct ir_graph *graph;
    const struct closure_host *host;
    const struct closure_lighting *lighting;
    struct closure_lit lit;
    struct closure_copies copies; /* of the current loop */
    ir_ref through;               /* vec3: the transmitted part, with transmits_alpha; 0: none */
};

/* ---- lit.c ---- */

void emitter_effect(struct emitter *e, enum effect_kind kind, uint32_t index, ir_ref value);
void emitter_comment(struct emitter *e, str_id text);
ir_ref emitter_vec3(struct emitter *e, ir_ref value);
/* Declares the variable of the colour, unless it exists. */
void emitter_declare_color(struct emitter *e);
/* The colour so far: the variable, or the base. */
ir_ref emitter_color(struct emitter *e);

/* The emission of an EDF; 0: black. */
ir_ref emitter_emission(struct emitter *e, ir_ref edf);
/* The leaves of a surface; its emission becomes the base. */
void emitter_flatten(struct emitter *e, const struct closure_surface *s, struct closure_list *out);
/* Finds the parts under lights and environment. Returns which leaves contribute there. */
const bool *emitter_find_parts(struct emitter *e, ir_ref bsdf, const struct closure_list *list);
/* emitter_find_parts; reports the leaves that contribute. */
void emitter_light_list(struct emitter *e, ir_ref bsdf, struct closure_list *list);
/* emitter_flatten, then emitter_light_list. */
void emitter_light_surface(struct emitter *e, const struct closure_surface *s);
/* Writes the parts as effects. */
void emitter_write_lit(struct emitter *e);

/* ---- picked_layers.c ---- */

/* Path tracers always pick a layer. slots: IR_SLOTS, also in emitter_pick_layer. */
void emitter_scatter_stack(struct emitter *e, ir_ref slots);
void emitter_pick_layer(struct emitter *e, ir_ref slots);

/* ---- surface.c ---- */

/* The leaves, the emission and the AOVs of a surface, for path tracers. A pile stays as it is. */
void emitter_find_scattering(struct emitter *e, const struct closure_surface *s,
                             struct closure_scatter_layer *out);
/*
 * Adds the light of a closure, as if it were the whole surface, to the current colour. Its loops
 * are its own.
 */
void emitter_light_aov(struct emitter *e, ir_ref closure);
bool emitter_is_output(const struct emitter *e, uint32_t aov);
/* Writes the outputs: the colour, the alpha and the AOVs. */
void emitter_finish_surface(struct emitter *e, const struct closure_surface *s);

#endif
