// SPDX-License-Identifier: Apache-2.0
#include "render/each.h"

/* A triangle that covers the area. */
static const char vertex_source[] =
    "#version 450\n"
    "void main()\n{\n"
    "    gl_Position = vec4(gl_VertexIndex % 2 * 4 - 1, gl_VertexIndex / 2 * 4 - 1, 0.0, 1.0);\n"
    "}\n";

bool each_compile(const char *pixel_source, struct compiled *out)
{
    const char *const sources[MXG_NUM_STAGES] = {
        [MXG_STAGE_VERTEX] = vertex_source, [MXG_STAGE_PIXEL] = pixel_source};
    return compile_program("vulkan", sources, out);
}

/* The state of a triangle without vertices, targets and depth. */
static const VkPipelineVertexInputStateCreateInfo no_vertices = {
    .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
static const VkPipelineViewportStateCreateInfo viewports = {
    .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
    .viewportCount = 1,
    .scissorCount = 1};
static const VkPipelineRasterizationStateCreateInfo raster = {
    .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
    .cullMode = VK_CULL_MODE_NONE,
    .lineWidth = 1.0f};
static const VkPipelineColorBlendStateCreateInfo no_targets = {
    .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
static const VkDynamicState set_by_run[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
static const VkPipelineDynamicStateCreateInfo dynamic = {
    .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
    .dynamicStateCount = 2,
    .pDynamicStates = set_by_run};

static bool create_pipeline(struct gpu *gpu, const VkShaderModule modules[MXG_NUM_STAGES],
                            VkPipelineLayout layout, VkPipeline *out)
{
    const VkPipelineShaderStageCreateInfo stages[] = {
        gpu_stage(VK_SHADER_STAGE_VERTEX_BIT, modules[MXG_STAGE_VERTEX]),
        gpu_stage(VK_SHADER_STAGE_FRAGMENT_BIT, modules[MXG_STAGE_PIXEL])};
    const VkPipelineRenderingCreateInfo rendering = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    const VkGraphicsPipelineCreateInfo info = {.sType =
                                                   VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                               .pNext = &rendering,
                                               .stageCount = 2,
                                               .pStages = stages,
                                               .pVertexInputState = &no_vertices,
                                               .pInputAssemblyState = &gpu_triangles,
                                               .pViewportState = &viewports,
                                               .pRasterizationState = &raster,
                                               .pMultisampleState = &gpu_one_sample,
                                               .pColorBlendState = &no_targets,
                                               .pDynamicState = &dynamic,
                                               .layout = layout};
    return gpu_check(gpu,
                     vkCreateGraphicsPipelines(gpu->device, VK_NULL_HANDLE, 1, &info, NULL, out),
                     "compiling the shader");
}

bool each_create(struct gpu *gpu, const VkPipelineLayoutCreateInfo *layout,
                 const struct compiled *compiled, VkPipelineLayout *out_layout, VkPipeline *out)
{
    VkShaderModule modules[MXG_NUM_STAGES] = {VK_NULL_HANDLE};
    bool good = gpu_check(gpu, vkCreatePipelineLayout(gpu->device, layout, NULL, out_layout),
                          "making a pipeline layout");
    for (int stage = 0; good && stage < MXG_NUM_STAGES; ++stage)
        good = gpu_load_shader(gpu, compiled->stages[stage].words,
                               compiled->stages[stage].num_words, &modules[stage]);
    good = good && create_pipeline(gpu, modules, *out_layout, out);
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage)
        vkDestroyShaderModule(gpu->device, modules[stage], NULL);
    return good;
}

void each_run(VkCommandBuffer commands, uint32_t width, uint32_t height)
{
    const VkRect2D area = {{0, 0}, {width, height}};
    const VkViewport viewport = {0, 0, (float)width, (float)height, 0, 1};
    const VkRenderingInfo info = {
        .sType = VK_STRUCTURE_TYPE_RENDERING_INFO, .renderArea = area, .layerCount = 1};
    vkCmdBeginRendering(commands, &info);
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &area);
    vkCmdDraw(commands, 3, 1, 0, 0);
    vkCmdEndRendering(commands);
}
