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

static bool load(struct gpu *gpu, const struct compiled_stage *code, VkShaderModule *out)
{
    const VkShaderModuleCreateInfo info = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                           .codeSize = code->num_words * sizeof *code->words,
                                           .pCode = code->words};
    return gpu_check(gpu, vkCreateShaderModule(gpu->device, &info, NULL, out),
                     "loading the shader");
}

static VkPipelineShaderStageCreateInfo stage_of(VkShaderStageFlagBits stage, VkShaderModule module)
{
    return (VkPipelineShaderStageCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
        .stage = stage,
        .module = module,
        .pName = "main"};
}

/* The state of a triangle without vertices, targets and depth. */
static const VkPipelineVertexInputStateCreateInfo no_vertices = {
    .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
static const VkPipelineInputAssemblyStateCreateInfo assembly = {
    .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
    .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
static const VkPipelineViewportStateCreateInfo viewports = {
    .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
    .viewportCount = 1,
    .scissorCount = 1};
static const VkPipelineRasterizationStateCreateInfo raster = {
    .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
    .cullMode = VK_CULL_MODE_NONE,
    .lineWidth = 1.0f};
static const VkPipelineMultisampleStateCreateInfo samples = {
    .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
    .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
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
        stage_of(VK_SHADER_STAGE_VERTEX_BIT, modules[MXG_STAGE_VERTEX]),
        stage_of(VK_SHADER_STAGE_FRAGMENT_BIT, modules[MXG_STAGE_PIXEL])};
    const VkPipelineRenderingCreateInfo rendering = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    const VkGraphicsPipelineCreateInfo info = {.sType =
                                                   VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                               .pNext = &rendering,
                                               .stageCount = 2,
                                               .pStages = stages,
                                               .pVertexInputState = &no_vertices,
                                               .pInputAssemblyState = &assembly,
                                               .pViewportState = &viewports,
                                               .pRasterizationState = &raster,
                                               .pMultisampleState = &samples,
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
        good = load(gpu, &compiled->stages[stage], &modules[stage]);
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
