// SPDX-License-Identifier: Apache-2.0
/*
 * Uniform blocks and textures of a program on the device, in descriptor sets that any pipeline can
 * bind.
 */
#ifndef MXG_RENDER_INPUTS_H
#define MXG_RENDER_INPUTS_H

#include "render/draw.h"

struct inputs {
    struct gpu_buffer blocks[DRAW_MAX_BLOCKS];
    struct gpu_image textures[DRAW_MAX_TEXTURES];
    VkSampler samplers[DRAW_MAX_TEXTURES];
    VkDescriptorSetLayout set_layouts[DRAW_MAX_SETS];
    VkDescriptorPool descriptor_pool;
    VkDescriptorSet sets[DRAW_MAX_SETS];
    uint32_t num_sets;
};

/* False: see gpu->reason. inputs_destroy must follow in any case; `out` is zeroed before. */
bool inputs_create(struct gpu *gpu, const struct draw *draw, struct inputs *out);
/* What the blocks hold now. */
void inputs_update(const struct draw *draw, struct inputs *inputs);
void inputs_destroy(struct gpu *gpu, const struct draw *draw, struct inputs *inputs);

#endif
