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

uint32_t program_place_blocks(const mxg_result *result, uint32_t first, uint32_t *out_offsets)
{
    for (uint32_t i = 0; i < NUM_UNIFORM_BLOCKS; ++i) {
        out_offsets[i] = first;
        first += program_block_size(result, uniform_blocks[i]);
    }
    return first;
}

void program_fill_block(const mxg_result *result, mxg_block number, program_value_of *value_of,
                        void *user_data, unsigned char *bytes)
{
    mxg_block_info block = block_of(result, number);
    mxg_result_pack_block(result, NULL, number, bytes, block.byte_size);
    for (uint32_t i = 0; i < block.num_variables; ++i) {
        mxg_variable v = variable_of(result, block.first_variable + i);
        float values[16];
        uint32_t num = value_of(user_data, &v, values);
        if (num)
            mxg_result_pack_value(result, block.first_variable + i, 0, values, num, bytes,
                                  block.byte_size);
    }
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

VkShaderModule program_make_module(const struct device *d, const char *source,
                                   VkShaderStageFlagBits stage)
{
    size_t size;
    VkShaderModule module;
    uint32_t *words = compile_spirv(source, stage, &size);
    check(words, "the compilation of a shader");
    VkShaderModuleCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = size, .pCode = words};
    VK(vkCreateShaderModule(d->device, &info, NULL, &module));
    free(words);
    return module;
}

void program_make_layouts(const struct device *d, const mxg_result *result,
                          VkShaderStageFlags stages, const VkDescriptorSetLayout *host_sets,
                          uint32_t num_host_sets, struct program *p)
{
    VkDescriptorSetLayoutBinding bindings[MAX_BINDINGS];
    uint32_t num = 0;
    for (uint32_t i = 0; i < NUM_UNIFORM_BLOCKS; ++i)
        if (program_block_size(result, uniform_blocks[i]))
            bindings[num++] = (VkDescriptorSetLayoutBinding){
                .binding = block_of(result, uniform_blocks[i]).binding,
                .descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                .descriptorCount = 1,
                .stageFlags = stages};
    mxg_block_info textures = block_of(result, MXG_BLOCK_TEXTURES);
    check(num + textures.num_variables <= MAX_BINDINGS, "too many textures");
    for (uint32_t i = 0; i < textures.num_variables; ++i)
        bindings[num++] = (VkDescriptorSetLayoutBinding){
            .binding = variable_of(result, textures.first_variable + i).binding,
            .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
            .descriptorCount = 1,
            .stageFlags = stages};
    VkDescriptorSetLayoutCreateInfo set = {.sType =
                                               VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                           .bindingCount = num,
                                           .pBindings = bindings};
    VK(vkCreateDescriptorSetLayout(d->device, &set, NULL, &p->set_layout));
    VkDescriptorSetLayout sets[3] = {p->set_layout};
    check(num_host_sets < 3, "too many descriptor sets");
    for (uint32_t i = 0; i < num_host_sets; ++i)
        sets[1 + i] = host_sets[i];
    VkPipelineLayoutCreateInfo layout = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                         .setLayoutCount = 1 + num_host_sets,
                                         .pSetLayouts = sets};
    VK(vkCreatePipelineLayout(d->device, &layout, NULL, &p->layout));
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

static VkPipeline make_pipeline(const struct device *d, const mxg_result *result,
                                const struct target *target, VkPipelineLayout layout,
                                const VkPipelineShaderStageCreateInfo *stages, uint32_t num_stages)
{
    enum { MAX_COLORS = 4 };
    VkVertexInputAttributeDescription attributes[MAX_ATTRIBUTES];
    const VkVertexInputBindingDescription inputs[] = {
        {0, sizeof(struct vertex), VK_VERTEX_INPUT_RATE_VERTEX},
        {1, 0, VK_VERTEX_INPUT_RATE_VERTEX}};
    VkPipelineColorBlendAttachmentState blend[MAX_COLORS] = {blending(result)};
    for (uint32_t i = 1; i < MAX_COLORS; ++i)
        blend[i].colorWriteMask = 0xf;
    VkGraphicsPipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
        .stageCount = num_stages,
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
                .pViewports =
                    &(VkViewport){0, 0, (float)target->width, (float)target->height, 0, 1},
                .scissorCount = 1,
                .pScissors = &(VkRect2D){{0, 0}, {target->width, target->height}}},
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
                .depthWriteEnable = target->writes_depth,
                .depthCompareOp = target->depth_test},
        .pColorBlendState =
            &(VkPipelineColorBlendStateCreateInfo){
                .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
                .attachmentCount = target->num_colors,
                .pAttachments = blend},
        .layout = layout,
        .renderPass = target->pass};
    VkPipeline pipeline;
    VK(vkCreateGraphicsPipelines(d->device, VK_NULL_HANDLE, 1, &info, NULL, &pipeline));
    return pipeline;
}

void program_make(const struct device *d, const mxg_result *result, const struct target *target,
                  struct program *out)
{
    static const VkShaderStageFlagBits bits[MXG_NUM_STAGES] = {
        [MXG_STAGE_VERTEX] = VK_SHADER_STAGE_VERTEX_BIT,
        [MXG_STAGE_PIXEL] = VK_SHADER_STAGE_FRAGMENT_BIT};
    mxg_shader_info info = MXG_INIT(mxg_shader_info);
    mxg_result_info(result, &info);
    out->topology = info.topology;
    program_make_layouts(d, result, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT,
                         &target->set_1, target->set_1 ? 1 : 0, out);
    VkPipelineShaderStageCreateInfo stages[MXG_NUM_STAGES];
    uint32_t num = 0;
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage)
        if (stage == MXG_STAGE_VERTEX || target->num_colors || info.alpha == MXG_ALPHA_MASK)
            stages[num++] = (VkPipelineShaderStageCreateInfo){
                .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                .stage = bits[stage],
                .module = program_make_module(d, mxg_result_source(result, (mxg_stage)stage, NULL),
                                              bits[stage]),
                .pName = "main"};
    out->pipeline = make_pipeline(d, result, target, out->layout, stages, num);
    for (uint32_t i = 0; i < num; ++i)
        vkDestroyShaderModule(d->device, stages[i].module, NULL);
}

void program_free(const struct device *d, struct program *p)
{
    vkDestroyPipeline(d->device, p->pipeline, NULL);
    vkDestroyPipelineLayout(d->device, p->layout, NULL);
    vkDestroyDescriptorSetLayout(d->device, p->set_layout, NULL);
}

void program_bind(const struct device *d, const mxg_result *result, VkBuffer uniforms,
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
        vkUpdateDescriptorSets(d->device, 1, &write, 0, NULL);
    }
    mxg_block_info textures = block_of(result, MXG_BLOCK_TEXTURES);
    for (uint32_t i = 0; i < textures.num_variables; ++i) {
        mxg_variable v = variable_of(result, textures.first_variable + i);
        VkImageView view = strstr(v.type, "Array") ? d->checker.array : d->checker.view;
        VkDescriptorImageInfo image = {d->sampler, view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
        write.dstBinding = v.binding;
        write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
        write.pImageInfo = &image;
        vkUpdateDescriptorSets(d->device, 1, &write, 0, NULL);
    }
}

void program_draw_ball(const struct device *d, VkCommandBuffer commands, const struct program *p,
                       const VkDescriptorSet *sets, uint32_t num_sets, VkBuffer uniforms,
                       VkDeviceSize constants)
{
    const VkBuffer buffers[] = {d->mesh.buffer, uniforms};
    const VkDeviceSize offsets[] = {0, constants};
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, p->pipeline);
    vkCmdBindVertexBuffers(commands, 0, 2, buffers, offsets);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, p->layout, 0, num_sets, sets,
                            0, NULL);
    device_draw_ball(d, commands);
}

void program_print(const mxg_diagnostics *list, mxg_severity least)
{
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(list); ++i) {
        char text[1024];
        mxg_diagnostic item = MXG_INIT(mxg_diagnostic);
        mxg_diagnostics_item(list, i, &item);
        if (item.severity <= least
            && mxg_diagnostics_format(list, i, NULL, 0, false, text, sizeof text))
            fprintf(stderr, "%s\n", text);
    }
}
