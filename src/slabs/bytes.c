// SPDX-License-Identifier: Apache-2.0
#include "slabs/bytes.h"

#include "slabs/spots.h"

static bool has(uint32_t features, enum slab_feature feature)
{
    return features & 1u << feature;
}

uint32_t slab_bytes_of(uint32_t features)
{
    uint32_t bytes = 0;
    if (has(features, SLAB_SECOND_LOBE) || has(features, SLAB_F90))
        bytes += SLAB_BYTES_LOBE;
    bytes += has(features, SLAB_FUZZ) ? SLAB_BYTES_FUZZ : 0;
    bytes += has(features, SLAB_ANISOTROPY) ? SLAB_BYTES_ANISOTROPY : 0;
    bytes += has(features, SLAB_LUT) ? SLAB_BYTES_LUT : 0;
    bytes += has(features, SLAB_GLINTS) ? SLAB_BYTES_GLINTS : 0;
    return bytes;
}

uint32_t slab_bytes_of_pixel(uint32_t num_slabs, uint32_t part_bytes, bool is_plain)
{
    if (num_slabs == 0)
        return 0;
    uint32_t bytes = SLAB_BYTES_FIRST + part_bytes + (num_slabs - 1) * SLAB_BYTES_OTHER;
    return is_plain ? bytes : bytes + SLAB_BYTES_MORE;
}
