// SPDX-License-Identifier: Apache-2.0
/* Uniform blocks and textures of a program on the device, in descriptor sets for any pipeline. */
#ifndef MXG_RENDER_DESCRIPTORS_H
#define MXG_RENDER_DESCRIPTORS_H

#include "render/draw.h"

struct inputs {
    struct gpu_buffer blocks[DRAW_MAX_BLOCKS]; /* of all objects, one after the other */
    uint32_t strides[DRAW_MAX_BLOCKS];
    struct gpu_image textures[DRAW_MAX_TEXTURES];
    VkSampler samplers[DRAW_MAX_TEXTURES];
    VkDescriptorSetLayout set_layouts[DRAW_MAX_SETS];
    VkDescriptorPool descriptor_pool;
    VkDescriptorSet sets[DRAW_MAX_SETS];
    uint32_t num_sets;
};

/*
 * block_type: VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC or _STORAGE_BUFFER_DYNAMIC. false: see
 * gpu->reason. Call inputs_destroy in any case.
 */
bool inputs_create(struct gpu *gpu, const struct draw *draw, VkDescriptorType block_type,
                   struct inputs *out);
/* Uploads the current contents of the blocks. */
void inputs_update(const struct draw *draw, struct inputs *inputs);
/* Binds the sets from set 0 on, with the blocks of an object. */
void inputs_bind(VkCommandBuffer commands, VkPipelineBindPoint point, VkPipelineLayout layout,
                 const struct draw *draw, const struct inputs *inputs, uint32_t object);
void inputs_destroy(struct gpu *gpu, const struct draw *draw, struct inputs *inputs);

#endif
