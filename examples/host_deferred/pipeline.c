// SPDX-License-Identifier: Apache-2.0
#include "pipeline.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TILE = 8, DECAL_LAYERS = 6 };

const struct resource *pipeline_resource(const struct pipeline *p, const char *name)
{
    for (uint32_t i = 0; i < p->num_resources; ++i)
        if (strcmp(p->resources[i].info.name, name) == 0)
            return &p->resources[i];
    check(false, name);
    return NULL;
}

/* ---- Resources ---- */

static VkDescriptorType type_of(const char *kind)
{
    static const struct {
        const char *kind;
        VkDescriptorType type;
    } types[] = {{"image2D", VK_DESCRIPTOR_TYPE_STORAGE_IMAGE},
                 {"image2DArray", VK_DESCRIPTOR_TYPE_STORAGE_IMAGE},
                 {"sampler2D", VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER},
                 {"buffer", VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
                 {"uniform", VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER}};
    for (size_t i = 0; i < sizeof types / sizeof *types; ++i)
        if (strcmp(types[i].kind, kind) == 0)
            return types[i].type;
    check(false, kind);
    return VK_DESCRIPTOR_TYPE_MAX_ENUM;
}

/* With its arrays per tile or pixel. */
static VkDeviceSize buffer_size(const struct pipeline *p, uint32_t index)
{
    VkDeviceSize size = p->resources[index].info.byte_size;
    for (uint32_t i = 0; i < p->resources[index].info.num_members; ++i) {
        mxg_pass_member m = MXG_INIT(mxg_pass_member);
        mxg_catalogue_pass_member(index, i, &m);
        VkDeviceSize bytes = (VkDeviceSize)m.array_length * m.array_stride;
        if (strcmp(m.per, "tile") == 0)
            size += bytes * p->num_tiles;
        else if (strcmp(m.per, "pixel") == 0)
            size += bytes * p->width * p->height;
    }
    return size;
}

/* All images stay in the layout GENERAL, which each use allows. */
static struct image make_image(const struct pipeline *p, const struct resource *r,
                               uint32_t num_words)
{
    bool is_words = strcmp(r->info.name, "words") == 0, is_lit = strcmp(r->info.name, "lit") == 0;
    uint32_t num_layers = r->info.num_layers ? r->info.num_layers : 1;
    if (is_words) /* words 0 to 2 are targets; decals need a few more */
        num_layers = (num_words > 3 ? num_words - 3 : 1) + DECAL_LAYERS;
    VkFormat format = strcmp(r->info.format, "r32ui") == 0 ? VK_FORMAT_R32_UINT
                      : is_lit                             ? VK_FORMAT_R32G32B32A32_SFLOAT
                                                           : VK_FORMAT_R16G16B16A16_SFLOAT;
    return device_make_image(p->device, format, p->width, p->height, num_layers,
                             VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT
                                 | VK_IMAGE_USAGE_TRANSFER_SRC_BIT
                                 | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
}

static void make_resources(struct pipeline *p, uint32_t num_words)
{
    p->num_resources = mxg_catalogue_num_pass_resources();
    check(p->num_resources <= MAX_RESOURCES, "too many resources");
    for (uint32_t i = 0; i < p->num_resources; ++i) {
        struct resource *r = &p->resources[i];
        r->info = (mxg_pass_resource)MXG_INIT(mxg_pass_resource);
        mxg_catalogue_pass_resource(i, &r->info);
        r->type = type_of(r->info.kind);
        bool is_sampled = r->type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
        if (strncmp(r->info.kind, "image", 5) == 0
            || (is_sampled && strcmp(r->info.name, "depth") != 0))
            r->image = make_image(p, r, num_words);
        else if (!is_sampled)
            r->buffer = device_make_buffer(p->device, buffer_size(p, i));
    }
    p->depth =
        device_make_image(p->device, VK_FORMAT_D32_SFLOAT, p->width, p->height, 1,
                          VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
    VkCommandBuffer commands = device_begin(p->device);
    for (uint32_t i = 0; i < p->num_resources; ++i)
        if (p->resources[i].image.image)
            device_change_layout(commands, &p->resources[i].image, VK_IMAGE_LAYOUT_UNDEFINED,
                                 VK_IMAGE_LAYOUT_GENERAL);
    device_change_layout(commands, &p->depth, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
    device_run(p->device, commands);
}

/* ---- Descriptor sets ---- */

static VkDescriptorSetLayout make_set_layout(const struct pipeline *p,
                                             const VkDescriptorType *types, uint32_t num)
{
    VkDescriptorSetLayoutBinding bindings[MAX_RESOURCES];
    VkDescriptorSetLayout layout;
    for (uint32_t i = 0; i < num; ++i)
        bindings[i] = (VkDescriptorSetLayoutBinding){.binding = i,
                                                     .descriptorType = types[i],
                                                     .descriptorCount = 1,
                                                     .stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT
                                                                   | VK_SHADER_STAGE_COMPUTE_BIT};
    VkDescriptorSetLayoutCreateInfo info = {.sType =
                                                VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                            .bindingCount = num,
                                            .pBindings = bindings};
    VK(vkCreateDescriptorSetLayout(p->device->device, &info, NULL, &layout));
    return layout;
}

static void write_set(const struct pipeline *p, VkDescriptorSet set, uint32_t binding,
                      VkDescriptorType type, VkImageView view, const struct buffer *buffer)
{
    VkDescriptorImageInfo image = {p->device->sampler, view, VK_IMAGE_LAYOUT_GENERAL};
    VkDescriptorBufferInfo bytes = {buffer ? buffer->buffer : VK_NULL_HANDLE, 0, VK_WHOLE_SIZE};
    VkWriteDescriptorSet write = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                  .dstSet = set,
                                  .dstBinding = binding,
                                  .descriptorCount = 1,
                                  .descriptorType = type,
                                  .pImageInfo = &image,
                                  .pBufferInfo = &bytes};
    vkUpdateDescriptorSets(p->device->device, 1, &write, 0, NULL);
}

static void make_sets(struct pipeline *p)
{
    VkDescriptorType types[MAX_RESOURCES], host = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    const VkDescriptorPoolSize sizes[] = {
        {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 4 * MAX_SETS},
        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, MAX_RESOURCES},
        {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, MAX_RESOURCES},
        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 8 * MAX_SETS}};
    p->pool = device_make_pool(p->device, MAX_SETS, sizes, 4);
    for (uint32_t i = 0; i < p->num_resources; ++i)
        types[i] = p->resources[i].type;
    p->sets[0] = make_set_layout(p, types, p->num_resources);
    p->sets[1] = make_set_layout(p, &host, 1);
    p->resource_set = device_make_set(p->device, p->pool, p->sets[0]);
    p->host_set = device_make_set(p->device, p->pool, p->sets[1]);
    for (uint32_t i = 0; i < p->num_resources; ++i) {
        const struct resource *r = &p->resources[i];
        bool is_array = strcmp(r->info.kind, "image2DArray") == 0;
        const struct image *image = strcmp(r->info.name, "depth") == 0 ? &p->depth : &r->image;
        write_set(p, p->resource_set, i, r->type, is_array ? image->array : image->view,
                  &r->buffer);
    }
    write_set(p, p->host_set, 0, host, pipeline_resource(p, "color")->image.view, NULL);
}

/* ---- Render passes ---- */

static VkRenderPass make_pass(const struct pipeline *p, const VkFormat *colors, uint32_t num_colors)
{
    enum { MAX_COLORS = 4 };
    VkAttachmentDescription attachments[MAX_COLORS + 1];
    VkAttachmentReference references[MAX_COLORS + 1];
    for (uint32_t i = 0; i <= num_colors; ++i) {
        bool keeps = i == num_colors && num_colors > 0; /* the depth of the pass before */
        attachments[i] = (VkAttachmentDescription){
            .format = i < num_colors ? colors[i] : p->depth.format,
            .samples = VK_SAMPLE_COUNT_1_BIT,
            .loadOp = keeps ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR,
            .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
            .initialLayout = VK_IMAGE_LAYOUT_GENERAL,
            .finalLayout = VK_IMAGE_LAYOUT_GENERAL};
        references[i] = (VkAttachmentReference){i, VK_IMAGE_LAYOUT_GENERAL};
    }
    VkSubpassDescription subpass = {.colorAttachmentCount = num_colors,
                                    .pColorAttachments = references,
                                    .pDepthStencilAttachment = &references[num_colors]};
    VkRenderPassCreateInfo info = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                   .attachmentCount = num_colors + 1,
                                   .pAttachments = attachments,
                                   .subpassCount = 1,
                                   .pSubpasses = &subpass};
    VkRenderPass pass;
    VK(vkCreateRenderPass(p->device->device, &info, NULL, &pass));
    return pass;
}

static VkFramebuffer make_frame(const struct pipeline *p, VkRenderPass pass,
                                const VkImageView *views, uint32_t num)
{
    VkFramebuffer frame;
    VkFramebufferCreateInfo info = {.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                    .renderPass = pass,
                                    .attachmentCount = num,
                                    .pAttachments = views,
                                    .width = p->width,
                                    .height = p->height,
                                    .layers = 1};
    VK(vkCreateFramebuffer(p->device->device, &info, NULL, &frame));
    return frame;
}

void pipeline_open(struct pipeline *p, struct device *device, uint32_t width, uint32_t height,
                   uint32_t num_words)
{
    *p = (struct pipeline){.device = device, .width = width, .height = height};
    p->num_tiles = (width + TILE - 1) / TILE * ((height + TILE - 1) / TILE);
    make_resources(p, num_words);
    make_sets(p);
    const char *names[] = {"color", "word0", "word1",
                           "word2"}; /* in the order of their locations */
    VkFormat formats[4];
    VkImageView views[5] = {[4] = p->depth.view};
    for (int i = 0; i < 4; ++i) {
        formats[i] = pipeline_resource(p, names[i])->image.format;
        views[i] = pipeline_resource(p, names[i])->image.view;
    }
    p->depth_pass = make_pass(p, NULL, 0);
    p->material_pass = make_pass(p, formats, 4);
    p->depth_frame = make_frame(p, p->depth_pass, &views[4], 1);
    p->material_frame = make_frame(p, p->material_pass, views, 5);
}

/* ---- Stages ---- */

static uint32_t value_of(void *user_data, const mxg_variable *variable, float values[16])
{
    const struct view *view = user_data;
    if (strcmp(variable->semantic, "viewPosition") != 0)
        return 0;
    memcpy(values, view->position, sizeof view->position);
    return 3;
}

static void fill_uniforms(struct pipeline *p, struct stage *s, const struct view *view)
{
    uint32_t offsets[NUM_UNIFORM_BLOCKS], size = program_place_blocks(s->result, 0, offsets);
    struct view of = *view;
    s->uniforms = device_make_buffer(p->device, size + 1);
    for (uint32_t i = 0; i < NUM_UNIFORM_BLOCKS; ++i)
        program_fill_block(s->result, uniform_blocks[i], value_of, &of,
                           s->uniforms.bytes + offsets[i]);
    program_bind(p->device, s->result, s->uniforms.buffer, offsets, s->set);
}

/* `result` stays with the stage. parts: of the source, one after the other. */
static void make_stage(struct pipeline *p, mxg_result *result, const char *const *parts,
                       size_t num_parts, struct stage *out)
{
    size_t length = 1;
    for (size_t i = 0; i < num_parts; ++i)
        length += strlen(parts[i]);
    char *source = calloc(length, 1);
    check(source, "memory");
    for (size_t i = 0; i < num_parts; ++i)
        strcat(source, parts[i]);
    out->result = result;
    program_make_layouts(p->device, result, VK_SHADER_STAGE_COMPUTE_BIT, p->sets, 2, &out->program);
    VkComputePipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = program_make_module(p->device, source, VK_SHADER_STAGE_COMPUTE_BIT),
                  .pName = "main"},
        .layout = out->program.layout};
    VK(vkCreateComputePipelines(p->device->device, VK_NULL_HANDLE, 1, &info, NULL,
                                &out->program.pipeline));
    vkDestroyShaderModule(p->device->device, info.stage.module, NULL);
    free(source);
    out->set = device_make_set(p->device, p->pool, out->program.set_layout);
}

static void free_stage(struct pipeline *p, struct stage *s)
{
    if (!s->result)
        return;
    program_free(p->device, &s->program);
    if (s->uniforms.buffer)
        device_free_buffer(p->device, s->uniforms);
    mxg_result_destroy(s->result);
}

static void set_frame(const struct pipeline *p, const char *member, const void *value, size_t size)
{
    const struct resource *r = pipeline_resource(p, "frame");
    for (uint32_t i = 0; i < r->info.num_members; ++i) {
        mxg_pass_member m = MXG_INIT(mxg_pass_member);
        mxg_catalogue_pass_member((uint32_t)(r - p->resources), i, &m);
        if (strcmp(m.name, member) == 0)
            memcpy(r->buffer.bytes + m.offset, value, size);
    }
}

void pipeline_make_passes(struct pipeline *p, mxg_context *context, const mxg_options *options,
                          uint32_t classes, const char *host_functions, const struct view *view)
{
    check(mxg_catalogue_num_passes() <= MAX_PASSES, "too many passes");
    for (uint32_t i = 0; i < mxg_catalogue_num_passes(); ++i) {
        mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
        mxg_pass pass = MXG_INIT(mxg_pass);
        mxg_storage storage = MXG_INIT(mxg_storage);
        mxg_result *result = NULL;
        desc.target = "vulkan";
        desc.options = options;
        check(mxg_generate_pass(context, i, &desc, &result) == MXG_OK, mxg_catalogue_pass(i));
        const char *source = mxg_result_source(result, MXG_STAGE_PIXEL, NULL);
        mxg_result_storage(result, &storage);
        bool is_used = source && mxg_result_pass(result, &pass) == MXG_OK && pass.group_size[0]
                       && (!storage.classes || storage.classes & classes)
                       && strcmp(pass.name, "light_rays") != 0
                       && (p->decal.result || strcmp(pass.name, "over") != 0);
        if (!is_used) {
            mxg_result_destroy(result);
            continue;
        }
        bool calls_host = mxg_result_host_function(result, 0) != NULL;
        const char *parts[] = {source, calls_host ? host_functions : ""};
        make_stage(p, result, parts, 2, &p->passes[i]);
        fill_uniforms(p, &p->passes[i], view);
    }
    uint32_t size[2] = {p->width, p->height}, row = (p->width + TILE - 1) / TILE;
    set_frame(p, "mx_to_world", view->to_world, sizeof view->to_world);
    set_frame(p, "mx_size", size, sizeof size);
    set_frame(p, "mx_tiles_per_row", &row, sizeof row);
    set_frame(p, "mx_num_tiles", &p->num_tiles, sizeof p->num_tiles);
}

void pipeline_make_decal(struct pipeline *p, mxg_result *payload, const char *host_stage)
{
    char bindings[MAX_RESOURCES * 64] = "#version 450\n";
    for (uint32_t i = 0; i < p->num_resources; ++i)
        snprintf(bindings + strlen(bindings), sizeof bindings - strlen(bindings),
                 "#define BINDING_%s %u\n", p->resources[i].info.name, i);
    const char *parts[] = {bindings, mxg_result_source(payload, MXG_STAGE_PIXEL, NULL), host_stage};
    make_stage(p, payload, parts, 3, &p->decal);
    struct view nothing = {{0}, {0}};
    fill_uniforms(p, &p->decal, &nothing);
}

/* ---- A frame ---- */

static void run_stage(const struct pipeline *p, VkCommandBuffer commands, const struct stage *s,
                      const mxg_pass *indirect)
{
    const VkDescriptorSet sets[] = {s->set, p->resource_set, p->host_set};
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, s->program.pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, s->program.layout, 0, 3, sets,
                            0, NULL);
    if (indirect)
        vkCmdDispatchIndirect(commands, pipeline_resource(p, "tiles")->buffer.buffer,
                              indirect->dispatch_offset);
    else
        vkCmdDispatch(commands, (p->width + TILE - 1) / TILE, (p->height + TILE - 1) / TILE, 1);
    device_wait(commands);
}

/* The number of a word in "classes|bytes|...". */
static uint32_t show_number(const struct pipeline *p, const char *word)
{
    const struct resource *r = pipeline_resource(p, "frame");
    for (uint32_t i = 0; i < r->info.num_members; ++i) {
        mxg_pass_member m = MXG_INIT(mxg_pass_member);
        mxg_catalogue_pass_member((uint32_t)(r - p->resources), i, &m);
        uint32_t number = 0;
        size_t length;
        for (const char *at = m.values; *at; at += length + (at[length] == '|'), ++number)
            if ((length = strcspn(at, "|")) == strlen(word) && strncmp(at, word, length) == 0)
                return number;
    }
    check(false, word);
    return 0;
}

/* Each command of the buffer `tiles` begins as no group of 1 x 1. */
static void clear_tiles(const struct pipeline *p)
{
    const struct resource *tiles = pipeline_resource(p, "tiles");
    static const uint32_t none[4] = {0, 1, 1, 0};
    for (uint32_t at = 0; at < tiles->info.byte_size; at += sizeof none)
        memcpy(tiles->buffer.bytes + at, none, sizeof none);
}

/* True for a pass that comes in the picture, or in the view of it. */
static bool is_run(const struct pipeline *p, const mxg_pass *pass, bool is_view)
{
    bool is_show = strcmp(pass->name, "show") == 0;
    bool writes_lit = pass->writes >> (pipeline_resource(p, "lit") - p->resources) & 1;
    return is_view ? is_show || !writes_lit : !is_show;
}

void pipeline_light(struct pipeline *p, VkCommandBuffer commands, const char *show)
{
    uint32_t number = show ? show_number(p, show) : 0;
    set_frame(p, "mx_show", &number, sizeof number);
    clear_tiles(p);
    device_wait(commands);
    if (p->decal.result)
        run_stage(p, commands, &p->decal, NULL);
    for (uint32_t i = 0; i < mxg_catalogue_num_passes(); ++i) {
        const struct stage *s = &p->passes[i];
        mxg_pass pass = MXG_INIT(mxg_pass);
        if (s->result && mxg_result_pass(s->result, &pass) == MXG_OK
            && is_run(p, &pass, show != NULL))
            run_stage(p, commands, s, pass.is_indirect ? &pass : NULL);
    }
}

void pipeline_close(struct pipeline *p)
{
    VkDevice device = p->device->device;
    for (uint32_t i = 0; i < MAX_PASSES; ++i)
        free_stage(p, &p->passes[i]);
    free_stage(p, &p->decal);
    for (uint32_t i = 0; i < p->num_resources; ++i) {
        if (p->resources[i].image.image)
            device_free_image(p->device, p->resources[i].image);
        if (p->resources[i].buffer.buffer)
            device_free_buffer(p->device, p->resources[i].buffer);
    }
    device_free_image(p->device, p->depth);
    vkDestroyFramebuffer(device, p->depth_frame, NULL);
    vkDestroyFramebuffer(device, p->material_frame, NULL);
    vkDestroyRenderPass(device, p->depth_pass, NULL);
    vkDestroyRenderPass(device, p->material_pass, NULL);
    vkDestroyDescriptorSetLayout(device, p->sets[0], NULL);
    vkDestroyDescriptorSetLayout(device, p->sets[1], NULL);
    vkDestroyDescriptorPool(device, p->pool, NULL);
}
