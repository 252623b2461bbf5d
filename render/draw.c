// SPDX-License-Identifier: Apache-2.0
#include "render/draw.h"

#include "render/inputs.h"

#include <stdlib.h>
#include <string.h>

#define COLOR_FORMAT VK_FORMAT_R32G32B32A32_SFLOAT
#define DEPTH_FORMAT VK_FORMAT_D32_SFLOAT

/* What it owns on the device. */
struct draw_program {
    struct gpu *gpu;
    const struct draw *draw;
    struct gpu_image color, depth;
    struct gpu_buffer readback, indices;
    struct gpu_buffer attributes[DRAW_MAX_ATTRIBUTES];
    struct inputs inputs;
    VkPipelineLayout layout;
    VkShaderModule modules[2];
    VkPipeline pipeline;
};

/* ---- Resources ---- */

static bool create_targets(struct draw_program *program)
{
    struct gpu *gpu = program->gpu;
    uint32_t width = program->draw->width, height = program->draw->height;
    return gpu_create_image(gpu, COLOR_FORMAT, width, height, 0, 1,
                            VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                            VK_IMAGE_ASPECT_COLOR_BIT, &program->color)
           && gpu_create_image(gpu, DEPTH_FORMAT, width, height, 0, 1,
                               VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                               VK_IMAGE_ASPECT_DEPTH_BIT, &program->depth)
           && gpu_create_buffer(gpu, VK_BUFFER_USAGE_TRANSFER_DST_BIT, NULL,
                                (size_t)width * height * 4 * sizeof(float), &program->readback);
}

static bool create_buffers(struct draw_program *program)
{
    const struct draw *draw = program->draw;
    bool good = gpu_create_buffer(program->gpu, VK_BUFFER_USAGE_INDEX_BUFFER_BIT, draw->indices,
                                  draw->num_indices * sizeof *draw->indices, &program->indices);
    for (uint32_t i = 0; good && i < draw->num_attributes; ++i)
        good = gpu_create_buffer(program->gpu, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
                                 draw->attributes[i].data, (size_t)draw->num_vertices * 16,
                                 &program->attributes[i]);
    return good;
}

static bool create_layout(struct draw_program *program)
{
    const VkPipelineLayoutCreateInfo info = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                             .setLayoutCount = program->inputs.num_sets,
                                             .pSetLayouts = program->inputs.set_layouts};
    return gpu_check(program->gpu,
                     vkCreatePipelineLayout(program->gpu->device, &info, NULL, &program->layout),
                     "making a pipeline layout");
}

/* ---- Pipeline ---- */

static bool create_modules(struct draw_program *program)
{
    bool good = true;
    for (int i = 0; good && i < 2; ++i) {
        const VkShaderModuleCreateInfo info = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                               .codeSize =
                                                   program->draw->code_words[i] * sizeof(uint32_t),
                                               .pCode = program->draw->code[i]};
        good =
            gpu_check(program->gpu,
                      vkCreateShaderModule(program->gpu->device, &info, NULL, &program->modules[i]),
                      "loading the shader");
    }
    return good;
}

static VkPipelineVertexInputStateCreateInfo vertex_input(
    const struct draw *draw, VkVertexInputBindingDescription *bindings,
    VkVertexInputAttributeDescription *attributes)
{
    for (uint32_t i = 0; i < draw->num_attributes; ++i) {
        bindings[i] = (VkVertexInputBindingDescription){i, 16, VK_VERTEX_INPUT_RATE_VERTEX};
        attributes[i] = (VkVertexInputAttributeDescription){draw->attributes[i].location, i,
                                                            draw->attributes[i].format, 0};
    }
    return (VkPipelineVertexInputStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
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

static VkPipelineShaderStageCreateInfo shader_stage(VkShaderStageFlagBits stage,
                                                    VkShaderModule module)
{
    return (VkPipelineShaderStageCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
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

static bool create_pipeline(struct draw_program *program)
{
    const struct draw *draw = program->draw;
    const VkPipelineShaderStageCreateInfo stages[2] = {
        shader_stage(VK_SHADER_STAGE_VERTEX_BIT, program->modules[0]),
        shader_stage(VK_SHADER_STAGE_FRAGMENT_BIT, program->modules[1]),
    };
    VkVertexInputBindingDescription bindings[DRAW_MAX_ATTRIBUTES];
    VkVertexInputAttributeDescription attributes[DRAW_MAX_ATTRIBUTES];
    const VkPipelineVertexInputStateCreateInfo input = vertex_input(draw, bindings, attributes);
    /* A negative height turns the picture so that clip space has y upwards, as in OpenGL. */
    const VkViewport viewport = {
        0, (float)draw->height, (float)draw->width, -(float)draw->height, 0, 1};
    const VkRect2D scissor = {{0, 0}, {draw->width, draw->height}};
    const VkPipelineViewportStateCreateInfo viewports = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .pViewports = &viewport,
        .scissorCount = 1,
        .pScissors = &scissor};
    const VkPipelineRasterizationStateCreateInfo raster = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .cullMode = VK_CULL_MODE_NONE,
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
    const VkGraphicsPipelineCreateInfo info = {.sType =
                                                   VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
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
                                               .layout = program->layout};
    VkResult result = vkCreateGraphicsPipelines(program->gpu->device, VK_NULL_HANDLE, 1, &info,
                                                NULL, &program->pipeline);
    return gpu_check(program->gpu, result, "compiling the shader");
}

/* ---- Drawing ---- */

static void begin_rendering(const struct draw_program *program, VkCommandBuffer commands)
{
    gpu_image_barrier(commands, program->color.image, VK_IMAGE_ASPECT_COLOR_BIT, 0, 1,
                      VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    gpu_image_barrier(commands, program->depth.image, VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1,
                      VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
    const VkRenderingAttachmentInfo color = {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                             .imageView = program->color.view,
                                             .imageLayout =
                                                 VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                             .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                             .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
    const VkRenderingAttachmentInfo depth = {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                             .imageView = program->depth.view,
                                             .imageLayout =
                                                 VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
                                             .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                             .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
                                             .clearValue = {.depthStencil = {.depth = 1.0f}}};
    const VkRenderingInfo info = {
        .sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
        .renderArea = {{0, 0}, {program->draw->width, program->draw->height}},
        .layerCount = 1,
        .colorAttachmentCount = 1,
        .pColorAttachments = &color,
        .pDepthAttachment = &depth};
    vkCmdBeginRendering(commands, &info);
}

static void record(const struct draw_program *program, VkCommandBuffer commands)
{
    const struct draw *draw = program->draw;
    begin_rendering(program, commands);
    if (program->inputs.num_sets)
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, program->layout, 0,
                                program->inputs.num_sets, program->inputs.sets, 0, NULL);
    const VkDeviceSize zero = 0;
    for (uint32_t i = 0; i < draw->num_attributes; ++i)
        vkCmdBindVertexBuffers(commands, i, 1, &program->attributes[i].buffer, &zero);
    vkCmdBindIndexBuffer(commands, program->indices.buffer, 0, VK_INDEX_TYPE_UINT32);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, program->pipeline);
    vkCmdDrawIndexed(commands, draw->num_indices, 1, 0, 0, 0);
    vkCmdEndRendering(commands);
    gpu_image_barrier(commands, program->color.image, VK_IMAGE_ASPECT_COLOR_BIT, 0, 1,
                      VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                      VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    const VkBufferImageCopy copy = {.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                    .imageExtent = {draw->width, draw->height, 1}};
    vkCmdCopyImageToBuffer(commands, program->color.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           program->readback.buffer, 1, &copy);
}

bool draw_frame(struct draw_program *program, float *out_pixels)
{
    const struct draw *draw = program->draw;
    inputs_update(draw, &program->inputs);
    memcpy(program->indices.mapped, draw->indices, draw->num_indices * sizeof *draw->indices);
    VkCommandBuffer commands = gpu_begin(program->gpu);
    if (!commands)
        return false;
    record(program, commands);
    if (!gpu_end(program->gpu, commands))
        return false;
    memcpy(out_pixels, program->readback.mapped, program->readback.size);
    return true;
}

struct draw_program *draw_open(struct gpu *gpu, const struct draw *draw)
{
    struct draw_program *program = calloc(1, sizeof *program);
    if (!program) {
        gpu_check(gpu, VK_ERROR_OUT_OF_HOST_MEMORY, "preparing to draw");
        return NULL;
    }
    program->gpu = gpu;
    program->draw = draw;
    if (create_targets(program) && create_buffers(program)
        && inputs_create(program->gpu, draw, &program->inputs) && create_layout(program)
        && create_modules(program) && create_pipeline(program))
        return program;
    draw_close(program);
    return NULL;
}

void draw_close(struct draw_program *program)
{
    if (!program)
        return;
    VkDevice device = program->gpu->device;
    vkDestroyPipeline(device, program->pipeline, NULL);
    for (int i = 0; i < 2; ++i)
        vkDestroyShaderModule(device, program->modules[i], NULL);
    vkDestroyPipelineLayout(device, program->layout, NULL);
    inputs_destroy(program->gpu, program->draw, &program->inputs);
    for (uint32_t i = 0; i < program->draw->num_attributes; ++i)
        gpu_destroy_buffer(program->gpu, &program->attributes[i]);
    gpu_destroy_buffer(program->gpu, &program->indices);
    gpu_destroy_buffer(program->gpu, &program->readback);
    gpu_destroy_image(program->gpu, &program->depth);
    gpu_destroy_image(program->gpu, &program->color);
    free(program);
}
