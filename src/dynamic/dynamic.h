// SPDX-License-Identifier: Apache-2.0
/* Code of mxgen for nodes: what its files share. */
#ifndef MXG_DYNAMIC_DYNAMIC_H
#define MXG_DYNAMIC_DYNAMIC_H

#include "dynamic/code.h"

/* The argument of an input; 0: absent, or the definition has no such input. */
ir_ref dynamic_arg(const mxg_build *build, str_id name);
/* Reports that the definition differs from the needs of the code; false. */
bool dynamic_misfit(const mxg_build *build, const char *fault);

/* aov.c: <aov> and <aovpass>, each an mxg_build_fn. */
bool dynamic_aov(void *user_data, mxg_build *build, mxg_ref *results);
bool dynamic_aovpass(void *user_data, mxg_build *build, mxg_ref *results);

/* geompropvalue.c: <geompropvalue> and <geompropvalueuniform>, an mxg_build_fn. */
bool dynamic_geomprop(void *user_data, mxg_build *build, mxg_ref *results);
/* geompropvalue.c: <UsdPrimvarReader>, whose names are those of primvars alone. */
bool dynamic_primvar(void *user_data, mxg_build *build, mxg_ref *results);

/* ambient_occlusion.c: <ambientocclusion>, an mxg_build_fn. */
bool dynamic_occlusion(void *user_data, mxg_build *build, mxg_ref *results);

/* dynamic_slabs.c: the constructors of slabs, each an mxg_build_fn. */
bool dynamic_slab(void *user_data, mxg_build *build, mxg_ref *results);
bool dynamic_slab_layer(void *user_data, mxg_build *build, mxg_ref *results);
bool dynamic_slab_mix(void *user_data, mxg_build *build, mxg_ref *results);
bool dynamic_slab_coverage(void *user_data, mxg_build *build, mxg_ref *results);
bool dynamic_slab_select(void *user_data, mxg_build *build, mxg_ref *results);
bool dynamic_slab_surface(void *user_data, mxg_build *build, mxg_ref *results);
/* True if the light of a slab in a closure depends on the thickness that the closure gets. */
bool dynamic_needs_thickness(const mxg_build *build, ir_ref closure);
/*
 * Warns of a layer without a base, and of one whose top hides the base. A base that the values of
 * the document hide is one, too.
 */
void dynamic_check_base(const mxg_build *build, ir_ref top);
/* Warns that the node gives none. instead: what the thickness is, for the message: "0.01 cm". */
void dynamic_warn_of_thickness(const mxg_build *build, const char *instead);

#endif
