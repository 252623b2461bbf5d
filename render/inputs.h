// SPDX-License-Identifier: Apache-2.0
/* Uniform blocks and textures of a program on the device, in descriptor sets for any pipeline. */
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

/* false: see gpu->reason. Zeroes `out` first. Call inputs_destroy in any case. */
bool inputs_create(struct gpu *gpu, const struct draw *draw, struct inputs *out);
/* Uploads the current contents of the blocks. */
void inputs_update(const struct draw *draw, struct inputs *inputs);
void inputs_destroy(struct gpu *gpu, const struct draw *draw, struct inputs *inputs);

#endif
