// SPDX-License-Identifier: Apache-2.0
#include "program.h"

#include "spirv.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_ATTRIBUTES = 16, MAX_BINDINGS = 32, ALIGNMENT = 256, CONSTANT_SIZE = 16 };

const mxg_block uniform_blocks[NUM_UNIFORM_BLOCKS] = {
    MXG_BLOCK_PRIVATE_UNIFORMS, MXG_BLOCK_PUBLIC_UNIFORMS, MXG_BLOCK_LIGHT_DATA};

/* The attributes of the mesh. */
static const struct stream {
    const char *semantic;
    VkFormat format;
    uint32_t offset;
} mesh_streams[] = {
    {"position:object", VK_FORMAT_R32G32B32_SFLOAT, offsetof(struct vertex, position)},
    {"normal:object", VK_FORMAT_R32G32B32_SFLOAT, offsetof(struct vertex, normal)},
    {"tangent:object", VK_FORMAT_R32G32B32_SFLOAT, offsetof(struct vertex, tangent)},
    {"texcoord:0", VK_FORMAT_R32G32_SFLOAT, offsetof(struct vertex, texcoord)},
};

static const struct stream *find_stream(const char *semantic)
{
    for (size_t i = 0; i < sizeof mesh_streams / sizeof *mesh_streams; ++i)
        if (strcmp(mesh_streams[i].semantic, semantic) == 0)
            return &mesh_streams[i];
    return NULL;
}

static mxg_block_info block_of(const mxg_result *result, mxg_block block)
{
    mxg_block_info info = MXG_INIT(mxg_block_info);
    mxg_result_block(result, block, &info);
    return info;
}

static mxg_variable variable_of(const mxg_result *result, uint32_t index)
{
    mxg_variable v = MXG_INIT(mxg_variable);
    mxg_result_variable(result, index, &v);
    return v;
}

uint32_t program_block_size(const mxg_result *result, mxg_block block)
{
    return (block_of(result, block).byte_size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
}

/* ---- Attributes ---- */

uint32_t program_num_constants(const mxg_result *result)
{
    mxg_block_info block = block_of(result, MXG_BLOCK_APP_DATA);
    uint32_t num = 0;
    for (uint32_t i = 0; i < block.num_variables; ++i)
        num += !find_stream(variable_of(result, block.first_variable + i).semantic);
    return num;
}

/* A geometric property that is missing has its default in the reflection. */
void program_write_constants(const mxg_result *result, unsigned char *out)
{
    mxg_block_info block = block_of(result, MXG_BLOCK_APP_DATA);
    for (uint32_t i = 0; i < block.num_variables; ++i) {
        mxg_variable v = variable_of(result, block.first_variable + i);
        if (find_stream(v.semantic))
            continue;
        memcpy(out, v.values, CONSTANT_SIZE);
        out += CONSTANT_SIZE;
    }
}

static VkFormat constant_format(const char *type)
{
    if (strcmp(type, "int") == 0)
        return VK_FORMAT_R32_SINT;
    switch (strncmp(type, "vec", 3) == 0 ? type[3] : '1') {
    case '2': return VK_FORMAT_R32G32_SFLOAT;
    case '3': return VK_FORMAT_R32G32B32_SFLOAT;
    case '4': return VK_FORMAT_R32G32B32A32_SFLOAT;
    default: return VK_FORMAT_R32_SFLOAT;
    }
}

/* Buffer 0 is the mesh; buffer 1 has the constants, and one step in it is 0 bytes. */
static uint32_t describe_attributes(const mxg_result *result,
                                    VkVertexInputAttributeDescription *out)
{
    mxg_block_info block = block_of(result, MXG_BLOCK_APP_DATA);
    uint32_t num_constants = 0;
    check(block.num_variables <= MAX_ATTRIBUTES, "too many attributes");
    for (uint32_t i = 0; i < block.num_variables; ++i) {
        mxg_variable v = variable_of(result, block.first_variable + i);
        const struct stream *stream = find_stream(v.semantic);
        out[i] = (VkVertexInputAttributeDescription){
            .location = v.location,
            .binding = stream ? 0 : 1,
            .format = stream ? stream->format : constant_format(v.type),
            .offset = stream ? stream->offset : CONSTANT_SIZE * num_constants};
        num_constants += !stream;
    }
    return block.num_variables;
}

/* ---- Pipelines ---- */

static VkShaderModule make_module(const struct gpu *g, const mxg_result *result, mxg_stage stage)
{
    size_t size;
    VkShaderModule module;
    uint32_t *words =
        compile_spirv(mxg_result_source(result, stage, NULL), stage == MXG_STAGE_VERTEX, &size);
    check(words, "the compilation of a shader");
    VkShaderModuleCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = size, .pCode = words};
    VK(vkCreateShaderModule(g->device, &info, NULL, &module));
    free(words);
    return module;
}

static void make_layouts(const struct gpu *g, const mxg_result *result, struct program *p)
{
    VkDescriptorSetLayoutBinding bindings[MAX_BINDINGS];
    uint32_t num = 0;
    for (uint32_t i = 0; i < NUM_UNIFORM_BLOCKS; ++i)
        if (program_block_size(result, uniform_blocks[i]))
            bindings[num++] = (VkDescriptorSetLayoutBinding){
                .binding = block_of(result, uniform_blocks[i]).binding,
                .descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                .descriptorCount = 1,
                .stageFlags = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT};
    mxg_block_info textures = block_of(result, MXG_BLOCK_TEXTURES);
    check(num + textures.num_variables <= MAX_BINDINGS, "too many textures");
    for (uint32_t i = 0; i < textures.num_variables; ++i)
        bindings[num++] = (VkDescriptorSetLayoutBinding){
            .binding = variable_of(result, textures.first_variable + i).binding,
            .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
            .descriptorCount = 1,
            .stageFlags = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT};
    VkDescriptorSetLayoutCreateInfo set = {.sType =
                                               VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                           .bindingCount = num,
                                           .pBindings = bindings};
    VK(vkCreateDescriptorSetLayout(g->device, &set, NULL, &p->set_layout));
    VkPipelineLayoutCreateInfo layout = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                         .setLayoutCount = 1,
                                         .pSetLayouts = &p->set_layout};
    VK(vkCreatePipelineLayout(g->device, &layout, NULL, &p->layout));
}

/* Colours are premultiplied. */
static VkPipelineColorBlendAttachmentState blending(const mxg_result *result)
{
    mxg_shader_info info = MXG_INIT(mxg_shader_info);
    mxg_result_info(result, &info);
    return (VkPipelineColorBlendAttachmentState){
        .blendEnable = info.alpha == MXG_ALPHA_BLEND,
        .srcColorBlendFactor = VK_BLEND_FACTOR_ONE,
        .dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
        .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
        .dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
        .colorWriteMask = 0xf};
}

static VkPipeline make_pipeline(const struct gpu *g, const mxg_result *result,
                                VkPipelineLayout layout,
                                const VkPipelineShaderStageCreateInfo *stages)
{
    VkVertexInputAttributeDescription attributes[MAX_ATTRIBUTES];
    const VkVertexInputBindingDescription inputs[] = {
        {0, sizeof(struct vertex), VK_VERTEX_INPUT_RATE_VERTEX},
        {1, 0, VK_VERTEX_INPUT_RATE_VERTEX}};
    VkPipelineColorBlendAttachmentState blend = blending(result);
    VkGraphicsPipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
        .stageCount = 2,
        .pStages = stages,
        .pVertexInputState =
            &(VkPipelineVertexInputStateCreateInfo){
                .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
                .vertexBindingDescriptionCount = 2,
                .pVertexBindingDescriptions = inputs,
                .vertexAttributeDescriptionCount = describe_attributes(result, attributes),
                .pVertexAttributeDescriptions = attributes},
        .pInputAssemblyState =
            &(VkPipelineInputAssemblyStateCreateInfo){
                .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
                .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST},
        .pViewportState =
            &(VkPipelineViewportStateCreateInfo){
                .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
                .viewportCount = 1,
                .pViewports = &(VkViewport){0, 0, SIZE, SIZE, 0, 1},
                .scissorCount = 1,
                .pScissors = &(VkRect2D){{0, 0}, {SIZE, SIZE}}},
        .pRasterizationState =
            &(VkPipelineRasterizationStateCreateInfo){
                .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
                .lineWidth = 1},
        .pMultisampleState =
            &(VkPipelineMultisampleStateCreateInfo){
                .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
                .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT},
        .pDepthStencilState =
            &(VkPipelineDepthStencilStateCreateInfo){
                .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
                .depthTestEnable = VK_TRUE,
                .depthWriteEnable = VK_TRUE,
                .depthCompareOp = VK_COMPARE_OP_LESS},
        .pColorBlendState =
            &(VkPipelineColorBlendStateCreateInfo){
                .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
                .attachmentCount = 1,
                .pAttachments = &blend},
        .layout = layout,
        .renderPass = g->pass};
    VkPipeline pipeline;
    VK(vkCreateGraphicsPipelines(g->device, VK_NULL_HANDLE, 1, &info, NULL, &pipeline));
    return pipeline;
}

void program_make(const struct gpu *g, const mxg_result *result, struct program *out)
{
    mxg_shader_info info = MXG_INIT(mxg_shader_info);
    mxg_result_info(result, &info);
    out->topology = info.topology;
    make_layouts(g, result, out);
    VkPipelineShaderStageCreateInfo stages[MXG_NUM_STAGES];
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage)
        stages[stage] = (VkPipelineShaderStageCreateInfo){
            .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
            .stage = stage == MXG_STAGE_VERTEX ? VK_SHADER_STAGE_VERTEX_BIT
                                               : VK_SHADER_STAGE_FRAGMENT_BIT,
            .module = make_module(g, result, (mxg_stage)stage),
            .pName = "main"};
    out->pipeline = make_pipeline(g, result, out->layout, stages);
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage)
        vkDestroyShaderModule(g->device, stages[stage].module, NULL);
}

void program_free(const struct gpu *g, struct program *p)
{
    vkDestroyPipeline(g->device, p->pipeline, NULL);
    vkDestroyPipelineLayout(g->device, p->layout, NULL);
    vkDestroyDescriptorSetLayout(g->device, p->set_layout, NULL);
}

void program_bind(const struct gpu *g, const mxg_result *result, VkBuffer uniforms,
                  const uint32_t *offsets, VkDescriptorSet set)
{
    VkWriteDescriptorSet write = {
        .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET, .dstSet = set, .descriptorCount = 1};
    for (uint32_t i = 0; i < NUM_UNIFORM_BLOCKS; ++i) {
        mxg_block_info block = block_of(result, uniform_blocks[i]);
        if (!block.byte_size)
            continue;
        VkDescriptorBufferInfo buffer = {uniforms, offsets[i], block.byte_size};
        write.dstBinding = block.binding;
        write.descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
        write.pBufferInfo = &buffer;
        vkUpdateDescriptorSets(g->device, 1, &write, 0, NULL);
    }
    mxg_block_info textures = block_of(result, MXG_BLOCK_TEXTURES);
    for (uint32_t i = 0; i < textures.num_variables; ++i) {
        mxg_variable v = variable_of(result, textures.first_variable + i);
        VkImageView view = strstr(v.type, "Array") ? g->checker.array : g->checker.view;
        VkDescriptorImageInfo image = {g->sampler, view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
        write.dstBinding = v.binding;
        write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
        write.pImageInfo = &image;
        vkUpdateDescriptorSets(g->device, 1, &write, 0, NULL);
    }
}
