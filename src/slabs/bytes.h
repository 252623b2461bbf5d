// SPDX-License-Identifier: Apache-2.0
/* bytes.c: the stored size of the slabs of a pixel, as bytes.def lists it. */
#ifndef MXG_SLABS_BYTES_H
#define MXG_SLABS_BYTES_H

#include "slabs/slabs.h"

enum slab_bytes {
#define SLAB_BYTES(part, bytes) SLAB_BYTES_##part = bytes,
#include "slabs/bytes.def"
#undef SLAB_BYTES
};

/* Of one slab, without the share of FIRST, MORE and OTHER. */
uint32_t slab_bytes_of(uint32_t features);

/* Of a pixel with so many slabs, whose parts take part_bytes; is_plain: one opaque slab. */
uint32_t slab_bytes_of_pixel(uint32_t num_slabs, uint32_t part_bytes, bool is_plain);

#endif
