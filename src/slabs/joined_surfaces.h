// SPDX-License-Identifier: Apache-2.0
/*
 * joined_surfaces.c: surfaces that are made of surfaces (mixes, and stacks of layers:
 * docs/slots.md) as one tree of closures. Parts beside each other become mixes, vertical layers
 * become layers of slabs.
 */
#ifndef MXG_SLABS_JOINED_SURFACES_H
#define MXG_SLABS_JOINED_SURFACES_H

#include "slabs/slabs.h"

/*
 * For a budget, which blends layers: replaces the stacks below a root. A stack stays as it is if a
 * layer is thin-walled, is not the surface of a BSDF or has AOVs, if slabs that are no coat let
 * light through, or if a coat emits or covers what emits. root 0: returns 0.
 */
ir_ref slabs_join_stacks(struct shader *shader, const struct slabs_host *host, ir_ref root);
/*
 * For light that walks through matter: a surface that is more than one, or has BSDFs as AOVs, gets
 * a MATTER node around it.
 */
ir_ref slabs_join_matter(struct shader *shader, const struct slabs_host *host, ir_ref root);

#endif
