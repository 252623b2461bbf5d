// SPDX-License-Identifier: Apache-2.0
/*
 * matter.c: a surface as shading models hold it: one slab of matter under one coat, and the light
 * that it emits and lets through.
 */
#ifndef MXG_MATERIAL_MATTER_H
#define MXG_MATERIAL_MATTER_H

#include "build/build.h"
#include "slabs/budget.h"

struct matter {
    ir_ref base;                     /* SLAB; 0: there is none */
    ir_ref coat;                     /* SLAB, clear; 0: there is none */
    ir_ref coat_coverage, thickness; /* of the coat, floats; centimetres */
    ir_ref transmits;                /* vec3: refracted light, along the normal */
    ir_ref emits;   /* vec3: light of the surface on top of its slabs, along the normal */
    ir_ref opacity; /* float */
    ir_ref is_thin; /* bool */
    bool had_slabs; /* before other closures became slabs */
    struct slab_report report; /* what was blended */
    /* vec3, vec3, float: the medium behind refracted light, absorption and scattering per unit */
    ir_ref absorption, scattering, phase_anisotropy; /* 0: there is none */
    ir_ref film_thickness, film_ior;  /* floats, of a film on an interface; nanometres. 0: none */
    const char *lost_input, *lost_of; /* an input that no slab has, and its closure; or NULL */
    const char *other; /* a closure that became a diffuse slab: "chiang_hair_bsdf"; NULL: none */
};

/* The matter of a root that is a surface, or a material with one; false: it is no surface. */
bool build_matter(struct builder *builder, const struct closure_host *closures,
                  struct arena *scratch, ir_ref root, struct matter *out);

/*
 * Applies a definition to matter. Its inputs have the names of those of <slab>, of the coat with
 * "coat_", and the others those of input_of_matter. results: one per output.
 */
void build_apply_to_matter(struct builder *builder, const char *definition,
                           const struct matter *matter, ir_ref *results);

#endif
