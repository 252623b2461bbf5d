// SPDX-License-Identifier: Apache-2.0
/*
 * stack.c: a stack of layers (docs/slots.md) as one surface, so that a budget can blend its layers,
 * and traced light walks through them: horizontal layers become mixes, vertical ones layers of
 * slabs.
 */
#ifndef MXG_SLABS_STACK_H
#define MXG_SLABS_STACK_H

#include "slabs/slabs.h"

/*
 * Replaces the stacks below a root, except where a layer is a sheet, no BSDF, has AOVs or lets
 * light through its slabs, and where a coat lies on light. root 0: returns 0.
 */
ir_ref slabs_join_stacks(struct shader *shader, const struct slabs_host *host, ir_ref root);

#endif
