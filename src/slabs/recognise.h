// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_SLABS_RECOGNISE_H
#define MXG_SLABS_RECOGNISE_H

#include "slabs/slabs.h"

/*
 * Slabs in the place of other closures, as the library describes them (slabs_host.slab_of), with
 * one slab for the layers that are one piece of matter: an interface over a medium, fuzz over both,
 * a coat with its colour. A closure that fits no slab stays; or, with takes_all, becomes an opaque
 * slab with its directional albedo.
 */
ir_ref slabs_recognise(struct shader *shader, const struct slabs_host *host, bool takes_all,
                       ir_ref root);

#endif
