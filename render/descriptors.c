// SPDX-License-Identifier: Apache-2.0
#include "render/descriptors.h"

#include <string.h>

struct maker {
    struct gpu *gpu;
    const struct draw *draw;
    VkDescriptorType block_type;
    struct inputs *inputs;
};

/* Every device takes such an offset into a uniform or storage buffer. */
#define OFFSET_ROUND 256u

static bool create_blocks(struct maker *maker)
{
    const struct draw *draw = maker->draw;
    bool good = true;
    for (uint32_t i = 0; good && i < draw->num_blocks; ++i) {
        uint32_t size = (uint32_t)draw->blocks[i].size,
                 stride = (size + OFFSET_ROUND - 1) / OFFSET_ROUND * OFFSET_ROUND;
        maker->inputs->strides[i] = stride;
        good = gpu_create_buffer(
            maker->gpu, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
            NULL, (size_t)stride * draw->num_objects, &maker->inputs->blocks[i]);
    }
    if (good)
        inputs_update(draw, maker->inputs);
    return good;
}

static bool create_textures(struct maker *maker)
{
    bool good = true;
    for (uint32_t i = 0; good && i < maker->draw->num_textures; ++i) {
        const struct draw_texture *texture = &maker->draw->textures[i];
        const VkSamplerCreateInfo info = {
            .sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
            .magFilter = texture->filter,
            .minFilter = texture->filter,
            .mipmapMode = texture->filter == VK_FILTER_LINEAR ? VK_SAMPLER_MIPMAP_MODE_LINEAR
                                                              : VK_SAMPLER_MIPMAP_MODE_NEAREST,
            .addressModeU = texture->u,
            .addressModeV = texture->v,
            .addressModeW = VK_SAMPLER_ADDRESS_MODE_REPEAT,
            .maxLod = texture->has_mips ? VK_LOD_CLAMP_NONE : 0.0f,
            .borderColor = VK_BORDER_COLOR_FLOAT_TRANSPARENT_BLACK,
        };
        good = gpu_upload_texture(maker->gpu, texture->image, texture->bottom_first,
                                  &maker->inputs->textures[i])
               && gpu_check(
                   maker->gpu,
                   vkCreateSampler(maker->gpu->device, &info, NULL, &maker->inputs->samplers[i]),
                   "making a sampler");
    }
    return good;
}

/* ---- Descriptors ---- */

static bool create_set_layout(struct maker *maker, uint32_t set)
{
    const struct draw *draw = maker->draw;
    VkDescriptorSetLayoutBinding bindings[DRAW_MAX_BLOCKS + DRAW_MAX_TEXTURES];
    uint32_t count = 0;
    const VkShaderStageFlags stages = VK_SHADER_STAGE_ALL_GRAPHICS | VK_SHADER_STAGE_COMPUTE_BIT;
    for (uint32_t i = 0; i < draw->num_blocks; ++i) {
        if (draw->blocks[i].set == set)
            bindings[count++] = (VkDescriptorSetLayoutBinding){draw->blocks[i].binding,
                                                               maker->block_type, 1, stages, NULL};
    }
    for (uint32_t i = 0; i < draw->num_textures; ++i) {
        if (draw->textures[i].set == set)
            bindings[count++] = (VkDescriptorSetLayoutBinding){
                draw->textures[i].binding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, stages,
                NULL};
    }
    const VkDescriptorSetLayoutCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = count,
        .pBindings = bindings};
    return gpu_check(maker->gpu,
                     vkCreateDescriptorSetLayout(maker->gpu->device, &info, NULL,
                                                 &maker->inputs->set_layouts[set]),
                     "making a descriptor set layout");
}

static bool allocate_sets(struct maker *maker)
{
    const VkDescriptorPoolSize sizes[] = {
        {maker->block_type, DRAW_MAX_BLOCKS},
        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, DRAW_MAX_TEXTURES}};
    const VkDescriptorPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                             .maxSets = DRAW_MAX_SETS,
                                             .poolSizeCount = 2,
                                             .pPoolSizes = sizes};
    if (!gpu_check(maker->gpu,
                   vkCreateDescriptorPool(maker->gpu->device, &pool, NULL,
                                          &maker->inputs->descriptor_pool),
                   "making a descriptor pool"))
        return false;
    const VkDescriptorSetAllocateInfo info = {.sType =
                                                  VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                              .descriptorPool = maker->inputs->descriptor_pool,
                                              .descriptorSetCount = maker->inputs->num_sets,
                                              .pSetLayouts = maker->inputs->set_layouts};
    return gpu_check(maker->gpu,
                     vkAllocateDescriptorSets(maker->gpu->device, &info, maker->inputs->sets),
                     "making descriptor sets");
}

static void write_sets(struct maker *maker)
{
    const struct draw *draw = maker->draw;
    for (uint32_t i = 0; i < draw->num_blocks; ++i) {
        const VkDescriptorBufferInfo buffer = {maker->inputs->blocks[i].buffer, 0,
                                               draw->blocks[i].size};
        const VkWriteDescriptorSet write = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                            .dstSet = maker->inputs->sets[draw->blocks[i].set],
                                            .dstBinding = draw->blocks[i].binding,
                                            .descriptorCount = 1,
                                            .descriptorType = maker->block_type,
                                            .pBufferInfo = &buffer};
        vkUpdateDescriptorSets(maker->gpu->device, 1, &write, 0, NULL);
    }
    for (uint32_t i = 0; i < draw->num_textures; ++i) {
        const VkDescriptorImageInfo image = {maker->inputs->samplers[i],
                                             maker->inputs->textures[i].view,
                                             VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
        const VkWriteDescriptorSet write = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                            .dstSet = maker->inputs->sets[draw->textures[i].set],
                                            .dstBinding = draw->textures[i].binding,
                                            .descriptorCount = 1,
                                            .descriptorType =
                                                VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                            .pImageInfo = &image};
        vkUpdateDescriptorSets(maker->gpu->device, 1, &write, 0, NULL);
    }
}

static bool create_descriptors(struct maker *maker)
{
    const struct draw *draw = maker->draw;
    for (uint32_t i = 0; i < draw->num_blocks; ++i)
        maker->inputs->num_sets = draw->blocks[i].set >= maker->inputs->num_sets
                                      ? draw->blocks[i].set + 1
                                      : maker->inputs->num_sets;
    for (uint32_t i = 0; i < draw->num_textures; ++i)
        maker->inputs->num_sets = draw->textures[i].set >= maker->inputs->num_sets
                                      ? draw->textures[i].set + 1
                                      : maker->inputs->num_sets;
    for (uint32_t set = 0; set < maker->inputs->num_sets; ++set) {
        if (!create_set_layout(maker, set))
            return false;
    }
    if (maker->inputs->num_sets == 0)
        return true;
    if (!allocate_sets(maker))
        return false;
    write_sets(maker);
    return true;
}

bool inputs_create(struct gpu *gpu, const struct draw *draw, VkDescriptorType block_type,
                   struct inputs *out)
{
    struct maker maker = {gpu, draw, block_type, out};
    return create_blocks(&maker) && create_textures(&maker) && create_descriptors(&maker);
}

void inputs_update(const struct draw *draw, struct inputs *inputs)
{
    for (uint32_t i = 0; i < draw->num_blocks; ++i)
        for (uint32_t k = 0; k < draw->num_objects; ++k)
            memcpy((unsigned char *)inputs->blocks[i].mapped + (size_t)k * inputs->strides[i],
                   draw->objects[k].blocks[i], draw->blocks[i].size);
}

/* Offsets come in the order of sets, then of bindings. */
static bool is_before(const struct draw_block *a, const struct draw_block *b)
{
    return a->set != b->set ? a->set < b->set : a->binding < b->binding;
}

void inputs_bind(VkCommandBuffer commands, VkPipelineBindPoint point, VkPipelineLayout layout,
                 const struct draw *draw, const struct inputs *inputs, uint32_t object)
{
    uint32_t offsets[DRAW_MAX_BLOCKS];
    for (uint32_t i = 0; i < draw->num_blocks; ++i) {
        uint32_t rank = 0;
        for (uint32_t k = 0; k < draw->num_blocks; ++k)
            rank += is_before(&draw->blocks[k], &draw->blocks[i]);
        offsets[rank] = object * inputs->strides[i];
    }
    if (inputs->num_sets)
        vkCmdBindDescriptorSets(commands, point, layout, 0, inputs->num_sets, inputs->sets,
                                draw->num_blocks, offsets);
}

void inputs_destroy(struct gpu *gpu, const struct draw *draw, struct inputs *inputs)
{
    vkDestroyDescriptorPool(gpu->device, inputs->descriptor_pool, NULL);
    for (uint32_t i = 0; i < DRAW_MAX_SETS; ++i)
        vkDestroyDescriptorSetLayout(gpu->device, inputs->set_layouts[i], NULL);
    for (uint32_t i = 0; i < draw->num_textures; ++i) {
        vkDestroySampler(gpu->device, inputs->samplers[i], NULL);
        gpu_destroy_image(gpu, &inputs->textures[i]);
    }
    for (uint32_t i = 0; i < draw->num_blocks; ++i)
        gpu_destroy_buffer(gpu, &inputs->blocks[i]);
}
