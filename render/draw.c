// SPDX-License-Identifier: Apache-2.0
#include "render/draw.h"

#include <string.h>

#define COLOR_FORMAT VK_FORMAT_R32G32B32A32_SFLOAT
#define DEPTH_FORMAT VK_FORMAT_D32_SFLOAT
#define MAX_PIPELINES 2

/* What a draw owns on the device. */
struct frame {
    struct gpu *gpu;
    const struct draw *draw;
    struct gpu_image color, depth;
    struct gpu_buffer readback, indices;
    struct gpu_buffer attributes[DRAW_MAX_ATTRIBUTES], blocks[DRAW_MAX_BLOCKS];
    struct gpu_image textures[DRAW_MAX_TEXTURES];
    VkSampler samplers[DRAW_MAX_TEXTURES];
    VkDescriptorSetLayout set_layouts[DRAW_MAX_SETS];
    VkDescriptorPool descriptor_pool;
    VkDescriptorSet sets[DRAW_MAX_SETS];
    uint32_t num_sets;
    VkPipelineLayout layout;
    VkShaderModule modules[2];
    VkPipeline pipelines[MAX_PIPELINES]; /* drawn in this order */
    int num_pipelines;
};

/* ---- Resources ---- */

static bool create_targets(struct frame *frame)
{
    struct gpu *gpu = frame->gpu;
    uint32_t width = frame->draw->width, height = frame->draw->height;
    return gpu_create_image(gpu, COLOR_FORMAT, width, height, 1,
                            VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                            VK_IMAGE_ASPECT_COLOR_BIT, &frame->color) &&
           gpu_create_image(gpu, DEPTH_FORMAT, width, height, 1, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                            VK_IMAGE_ASPECT_DEPTH_BIT, &frame->depth) &&
           gpu_create_buffer(gpu, VK_BUFFER_USAGE_TRANSFER_DST_BIT, NULL, (size_t)width * height * 4 * sizeof(float),
                             &frame->readback);
}

static bool create_buffers(struct frame *frame)
{
    const struct draw *draw = frame->draw;
    bool good = gpu_create_buffer(frame->gpu, VK_BUFFER_USAGE_INDEX_BUFFER_BIT, draw->indices,
                                  draw->num_indices * sizeof *draw->indices, &frame->indices);
    for (uint32_t i = 0; good && i < draw->num_attributes; ++i)
        good = gpu_create_buffer(frame->gpu, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, draw->attributes[i].data,
                                 (size_t)draw->num_vertices * 16, &frame->attributes[i]);
    for (uint32_t i = 0; good && i < draw->num_blocks; ++i)
        good = gpu_create_buffer(frame->gpu, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, draw->blocks[i].data,
                                 draw->blocks[i].size, &frame->blocks[i]);
    return good;
}

static bool create_textures(struct frame *frame)
{
    bool good = true;
    for (uint32_t i = 0; good && i < frame->draw->num_textures; ++i) {
        const struct draw_texture *texture = &frame->draw->textures[i];
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
        good = gpu_upload_texture(frame->gpu, texture->image, texture->bottom_first, &frame->textures[i]) &&
               gpu_check(frame->gpu, vkCreateSampler(frame->gpu->device, &info, NULL, &frame->samplers[i]),
                         "making a sampler");
    }
    return good;
}

/* ---- Descriptors ---- */

static bool create_set_layout(struct frame *frame, uint32_t set)
{
    const struct draw *draw = frame->draw;
    VkDescriptorSetLayoutBinding bindings[DRAW_MAX_BLOCKS + DRAW_MAX_TEXTURES];
    uint32_t count = 0;
    const VkShaderStageFlags stages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
    for (uint32_t i = 0; i < draw->num_blocks; ++i) {
        if (draw->blocks[i].set == set)
            bindings[count++] = (VkDescriptorSetLayoutBinding){draw->blocks[i].binding,
                                                               VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, stages, NULL};
    }
    for (uint32_t i = 0; i < draw->num_textures; ++i) {
        if (draw->textures[i].set == set)
            bindings[count++] = (VkDescriptorSetLayoutBinding){
                draw->textures[i].binding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, stages, NULL};
    }
    const VkDescriptorSetLayoutCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, .bindingCount = count, .pBindings = bindings};
    return gpu_check(frame->gpu, vkCreateDescriptorSetLayout(frame->gpu->device, &info, NULL, &frame->set_layouts[set]),
                     "making a descriptor set layout");
}

static bool allocate_sets(struct frame *frame)
{
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, DRAW_MAX_BLOCKS},
                                          {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, DRAW_MAX_TEXTURES}};
    const VkDescriptorPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                             .maxSets = DRAW_MAX_SETS,
                                             .poolSizeCount = 2,
                                             .pPoolSizes = sizes};
    if (!gpu_check(frame->gpu, vkCreateDescriptorPool(frame->gpu->device, &pool, NULL, &frame->descriptor_pool),
                   "making a descriptor pool"))
        return false;
    const VkDescriptorSetAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                              .descriptorPool = frame->descriptor_pool,
                                              .descriptorSetCount = frame->num_sets,
                                              .pSetLayouts = frame->set_layouts};
    return gpu_check(frame->gpu, vkAllocateDescriptorSets(frame->gpu->device, &info, frame->sets),
                     "making descriptor sets");
}

static void write_sets(struct frame *frame)
{
    const struct draw *draw = frame->draw;
    for (uint32_t i = 0; i < draw->num_blocks; ++i) {
        const VkDescriptorBufferInfo buffer = {frame->blocks[i].buffer, 0, VK_WHOLE_SIZE};
        const VkWriteDescriptorSet write = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                            .dstSet = frame->sets[draw->blocks[i].set],
                                            .dstBinding = draw->blocks[i].binding,
                                            .descriptorCount = 1,
                                            .descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                                            .pBufferInfo = &buffer};
        vkUpdateDescriptorSets(frame->gpu->device, 1, &write, 0, NULL);
    }
    for (uint32_t i = 0; i < draw->num_textures; ++i) {
        const VkDescriptorImageInfo image = {frame->samplers[i], frame->textures[i].view,
                                             VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
        const VkWriteDescriptorSet write = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                            .dstSet = frame->sets[draw->textures[i].set],
                                            .dstBinding = draw->textures[i].binding,
                                            .descriptorCount = 1,
                                            .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                            .pImageInfo = &image};
        vkUpdateDescriptorSets(frame->gpu->device, 1, &write, 0, NULL);
    }
}

static bool create_descriptors(struct frame *frame)
{
    const struct draw *draw = frame->draw;
    for (uint32_t i = 0; i < draw->num_blocks; ++i)
        frame->num_sets = draw->blocks[i].set >= frame->num_sets ? draw->blocks[i].set + 1 : frame->num_sets;
    for (uint32_t i = 0; i < draw->num_textures; ++i)
        frame->num_sets = draw->textures[i].set >= frame->num_sets ? draw->textures[i].set + 1 : frame->num_sets;
    for (uint32_t set = 0; set < frame->num_sets; ++set) {
        if (!create_set_layout(frame, set))
            return false;
    }
    const VkPipelineLayoutCreateInfo info = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                             .setLayoutCount = frame->num_sets,
                                             .pSetLayouts = frame->set_layouts};
    if (!gpu_check(frame->gpu, vkCreatePipelineLayout(frame->gpu->device, &info, NULL, &frame->layout),
                   "making a pipeline layout"))
        return false;
    if (frame->num_sets == 0)
        return true;
    if (!allocate_sets(frame))
        return false;
    write_sets(frame);
    return true;
}

/* ---- Pipeline ---- */

static bool create_modules(struct frame *frame)
{
    bool good = true;
    for (int i = 0; good && i < 2; ++i) {
        const VkShaderModuleCreateInfo info = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                               .codeSize = frame->draw->code_words[i] * sizeof(uint32_t),
                                               .pCode = frame->draw->code[i]};
        good = gpu_check(frame->gpu, vkCreateShaderModule(frame->gpu->device, &info, NULL, &frame->modules[i]),
                         "loading the shader");
    }
    return good;
}

static VkPipelineVertexInputStateCreateInfo vertex_input(const struct draw *draw,
                                                         VkVertexInputBindingDescription *bindings,
                                                         VkVertexInputAttributeDescription *attributes)
{
    for (uint32_t i = 0; i < draw->num_attributes; ++i) {
        bindings[i] = (VkVertexInputBindingDescription){i, 16, VK_VERTEX_INPUT_RATE_VERTEX};
        attributes[i] = (VkVertexInputAttributeDescription){draw->attributes[i].location, i, draw->attributes[i].format,
                                                            0};
    }
    return (VkPipelineVertexInputStateCreateInfo){.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
                                                  .vertexBindingDescriptionCount = draw->num_attributes,
                                                  .pVertexBindingDescriptions = bindings,
                                                  .vertexAttributeDescriptionCount = draw->num_attributes,
                                                  .pVertexAttributeDescriptions = attributes};
}

static VkPipelineColorBlendAttachmentState premultiplied_blending(bool enabled)
{
    return (VkPipelineColorBlendAttachmentState){
        .blendEnable = enabled,
        .srcColorBlendFactor = VK_BLEND_FACTOR_ONE,
        .dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
        .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
        .dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
        .colorWriteMask = 0xf,
    };
}

static VkPipelineShaderStageCreateInfo shader_stage(VkShaderStageFlagBits stage, VkShaderModule module)
{
    return (VkPipelineShaderStageCreateInfo){.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                             .stage = stage,
                                             .module = module,
                                             .pName = "main"};
}

/* What is the same in every pipeline. */
static const VkPipelineInputAssemblyStateCreateInfo assembly = {
    .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
    .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST,
};
static const VkPipelineMultisampleStateCreateInfo samples = {
    .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
    .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT,
};
static const VkFormat color_format = COLOR_FORMAT;
static const VkPipelineRenderingCreateInfo rendering = {
    .sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
    .colorAttachmentCount = 1,
    .pColorAttachmentFormats = &color_format,
    .depthAttachmentFormat = DEPTH_FORMAT,
};

static bool create_pipeline(struct frame *frame, VkCullModeFlags cull)
{
    const struct draw *draw = frame->draw;
    const VkPipelineShaderStageCreateInfo stages[2] = {
        shader_stage(VK_SHADER_STAGE_VERTEX_BIT, frame->modules[0]),
        shader_stage(VK_SHADER_STAGE_FRAGMENT_BIT, frame->modules[1]),
    };
    VkVertexInputBindingDescription bindings[DRAW_MAX_ATTRIBUTES];
    VkVertexInputAttributeDescription attributes[DRAW_MAX_ATTRIBUTES];
    const VkPipelineVertexInputStateCreateInfo input = vertex_input(draw, bindings, attributes);
    /* A negative height turns the picture so that clip space has y upwards, as in OpenGL. */
    const VkViewport viewport = {0, (float)draw->height, (float)draw->width, -(float)draw->height, 0, 1};
    const VkRect2D scissor = {{0, 0}, {draw->width, draw->height}};
    const VkPipelineViewportStateCreateInfo viewports = {.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
                                                         .viewportCount = 1,
                                                         .pViewports = &viewport,
                                                         .scissorCount = 1,
                                                         .pScissors = &scissor};
    const VkPipelineRasterizationStateCreateInfo raster = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .cullMode = cull,
        .frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE,
        .lineWidth = 1.0f};
    const VkPipelineDepthStencilStateCreateInfo depth = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = !draw->blend,
        .depthWriteEnable = !draw->blend,
        .depthCompareOp = VK_COMPARE_OP_LESS};
    const VkPipelineColorBlendAttachmentState blend = premultiplied_blending(draw->blend);
    const VkPipelineColorBlendStateCreateInfo blending = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = 1,
        .pAttachments = &blend};
    const VkGraphicsPipelineCreateInfo info = {.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                               .pNext = &rendering,
                                               .stageCount = 2,
                                               .pStages = stages,
                                               .pVertexInputState = &input,
                                               .pInputAssemblyState = &assembly,
                                               .pViewportState = &viewports,
                                               .pRasterizationState = &raster,
                                               .pMultisampleState = &samples,
                                               .pDepthStencilState = &depth,
                                               .pColorBlendState = &blending,
                                               .layout = frame->layout};
    VkPipeline *out = &frame->pipelines[frame->num_pipelines++];
    return gpu_check(frame->gpu, vkCreateGraphicsPipelines(frame->gpu->device, VK_NULL_HANDLE, 1, &info, NULL, out),
                     "compiling the shader");
}

/* What can be seen through has its far side drawn before its near side. */
static bool create_pipelines(struct frame *frame)
{
    if (!frame->draw->blend)
        return create_pipeline(frame, VK_CULL_MODE_NONE);
    return create_pipeline(frame, VK_CULL_MODE_FRONT_BIT) && create_pipeline(frame, VK_CULL_MODE_BACK_BIT);
}

/* ---- Drawing ---- */

static void begin_rendering(const struct frame *frame, VkCommandBuffer commands)
{
    gpu_image_barrier(commands, frame->color.image, VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, VK_IMAGE_LAYOUT_UNDEFINED,
                      VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    gpu_image_barrier(commands, frame->depth.image, VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, VK_IMAGE_LAYOUT_UNDEFINED,
                      VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
    const VkRenderingAttachmentInfo color = {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                             .imageView = frame->color.view,
                                             .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                             .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                             .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
    const VkRenderingAttachmentInfo depth = {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                             .imageView = frame->depth.view,
                                             .imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
                                             .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                             .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
                                             .clearValue = {.depthStencil = {.depth = 1.0f}}};
    const VkRenderingInfo info = {.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                  .renderArea = {{0, 0}, {frame->draw->width, frame->draw->height}},
                                  .layerCount = 1,
                                  .colorAttachmentCount = 1,
                                  .pColorAttachments = &color,
                                  .pDepthAttachment = &depth};
    vkCmdBeginRendering(commands, &info);
}

static void record(const struct frame *frame, VkCommandBuffer commands)
{
    const struct draw *draw = frame->draw;
    begin_rendering(frame, commands);
    if (frame->num_sets)
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, frame->layout, 0, frame->num_sets,
                                frame->sets, 0, NULL);
    const VkDeviceSize zero = 0;
    for (uint32_t i = 0; i < draw->num_attributes; ++i)
        vkCmdBindVertexBuffers(commands, i, 1, &frame->attributes[i].buffer, &zero);
    vkCmdBindIndexBuffer(commands, frame->indices.buffer, 0, VK_INDEX_TYPE_UINT32);
    for (int i = 0; i < frame->num_pipelines; ++i) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, frame->pipelines[i]);
        vkCmdDrawIndexed(commands, draw->num_indices, 1, 0, 0, 0);
    }
    vkCmdEndRendering(commands);
    gpu_image_barrier(commands, frame->color.image, VK_IMAGE_ASPECT_COLOR_BIT, 0, 1,
                      VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    const VkBufferImageCopy copy = {.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                    .imageExtent = {draw->width, draw->height, 1}};
    vkCmdCopyImageToBuffer(commands, frame->color.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, frame->readback.buffer,
                           1, &copy);
}

static bool run(struct frame *frame, float *out_pixels)
{
    if (!create_targets(frame) || !create_buffers(frame) || !create_textures(frame) || !create_descriptors(frame) ||
        !create_modules(frame) || !create_pipelines(frame))
        return false;
    VkCommandBuffer commands = gpu_begin(frame->gpu);
    if (!commands)
        return false;
    record(frame, commands);
    if (!gpu_end(frame->gpu, commands))
        return false;
    memcpy(out_pixels, frame->readback.mapped, frame->readback.size);
    return true;
}

static void destroy(struct frame *frame)
{
    VkDevice device = frame->gpu->device;
    for (int i = 0; i < frame->num_pipelines; ++i)
        vkDestroyPipeline(device, frame->pipelines[i], NULL);
    for (int i = 0; i < 2; ++i)
        vkDestroyShaderModule(device, frame->modules[i], NULL);
    vkDestroyPipelineLayout(device, frame->layout, NULL);
    vkDestroyDescriptorPool(device, frame->descriptor_pool, NULL);
    for (uint32_t i = 0; i < DRAW_MAX_SETS; ++i)
        vkDestroyDescriptorSetLayout(device, frame->set_layouts[i], NULL);
    for (uint32_t i = 0; i < frame->draw->num_textures; ++i) {
        vkDestroySampler(device, frame->samplers[i], NULL);
        gpu_destroy_image(frame->gpu, &frame->textures[i]);
    }
    for (uint32_t i = 0; i < frame->draw->num_blocks; ++i)
        gpu_destroy_buffer(frame->gpu, &frame->blocks[i]);
    for (uint32_t i = 0; i < frame->draw->num_attributes; ++i)
        gpu_destroy_buffer(frame->gpu, &frame->attributes[i]);
    gpu_destroy_buffer(frame->gpu, &frame->indices);
    gpu_destroy_buffer(frame->gpu, &frame->readback);
    gpu_destroy_image(frame->gpu, &frame->depth);
    gpu_destroy_image(frame->gpu, &frame->color);
}

bool draw_run(struct gpu *gpu, const struct draw *draw, float *out_pixels)
{
    struct frame frame = {.gpu = gpu, .draw = draw};
    bool good = run(&frame, out_pixels);
    destroy(&frame);
    return good;
}
