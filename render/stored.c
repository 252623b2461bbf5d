// SPDX-License-Identifier: Apache-2.0
#include "render/stored.h"

#include <stdlib.h>
#include <string.h>

/* The bindings of set 1, as the passes name them (src/deferred/pass_texts.c). */
enum {
    STORED_IMAGE,
    WORD_0,
    WORD_1,
    WORD_2,
    DEPTH,
    COLOR,
    LIT,
    TILES,
    FRAME,
    PAYLOADS,
    RAYS,
    SCATTERED,
    BELOW,
    DECALS,
    DECALS_TO_WRITE = DECALS + STORED_DECAL_IMAGES, /* the same images, for those who paint them */
    NUM_BINDINGS = DECALS_TO_WRITE + STORED_DECAL_IMAGES
};

static const VkDescriptorType types[NUM_BINDINGS] = {
    [STORED_IMAGE] = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
    [WORD_0] = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
    [WORD_1] = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
    [WORD_2] = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
    [DEPTH] = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    [COLOR] = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    [LIT] = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
    [TILES] = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
    [FRAME] = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
    [PAYLOADS] = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
    [RAYS] = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
    [SCATTERED] = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
    [BELOW] = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
    [DECALS] = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    [DECALS + 1] = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    [DECALS + 2] = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    [DECALS + 3] = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    [DECALS_TO_WRITE] = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
    [DECALS_TO_WRITE + 1] = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
    [DECALS_TO_WRITE + 2] = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
    [DECALS_TO_WRITE + 3] = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
};

struct frame { /* as the passes declare it */
    float to_world[16];
    uint32_t size[2], tiles_per_row, num_tiles, shown, unused[3];
};

struct pass {
    struct stored_pass source;
    struct inputs inputs;
    VkPipelineLayout layout;
    VkPipeline pipeline;
};

struct stored {
    struct gpu *gpu;
    uint32_t width, height, tiles_x, tiles_y;
    bool marks; /* fills the words with `mark` first */
    uint32_t mark;
    const struct gpu_image *lit, *depth;
    struct gpu_image color, targets[STORED_TARGETS], words, scattered, below,
        decals[STORED_DECAL_IMAGES];
    struct gpu_buffer tiles, frame;
    struct gpu_buffer payloads, rays; /* of stored_hold_rays */
    VkSampler sampler;
    VkDescriptorSetLayout empty_layout, set_layout;
    VkDescriptorPool pool;
    VkDescriptorSet set;
    struct pass passes[STORED_MAX_PASSES];
    uint32_t num_passes;
};

/* ---- Images ---- */

static bool create_images(struct stored *stored, uint32_t words)
{
    const VkImageUsageFlags target = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT
                                     | VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    struct gpu *gpu = stored->gpu;
    uint32_t width = stored->width, height = stored->height;
    bool good = gpu_create_image(gpu, stored_target_format(0), width, height, 0, 1,
                                 VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                                 VK_IMAGE_ASPECT_COLOR_BIT, &stored->color);
    for (unsigned i = 0; good && i < STORED_TARGETS; ++i)
        good = gpu_create_image(gpu, stored_target_format(i + 1), width, height, 0, 1, target,
                                VK_IMAGE_ASPECT_COLOR_BIT, &stored->targets[i]);
    for (unsigned i = 0; good && i < STORED_DECAL_IMAGES; ++i)
        good = gpu_create_image(gpu, VK_FORMAT_R16G16B16A16_SFLOAT, width, height, 0, 1,
                                VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT
                                    | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                                VK_IMAGE_ASPECT_COLOR_BIT, &stored->decals[i]);
    return good
           && gpu_create_image(gpu, VK_FORMAT_R16G16B16A16_SFLOAT, width, height, 2, 1,
                               VK_IMAGE_USAGE_STORAGE_BIT, VK_IMAGE_ASPECT_COLOR_BIT,
                               &stored->scattered)
           && gpu_create_image(gpu, VK_FORMAT_R16G16B16A16_SFLOAT, width, height, 2, 1,
                               VK_IMAGE_USAGE_STORAGE_BIT, VK_IMAGE_ASPECT_COLOR_BIT,
                               &stored->below)
           && gpu_create_image(gpu, VK_FORMAT_R32_UINT, width, height, words ? words : 1, 1,
                               VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT
                                   | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                               VK_IMAGE_ASPECT_COLOR_BIT, &stored->words);
}

static bool create_buffers(struct stored *stored)
{
    size_t tiles = (size_t)stored->tiles_x * stored->tiles_y;
    return gpu_create_buffer(stored->gpu,
                             VK_BUFFER_USAGE_STORAGE_BUFFER_BIT
                                 | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT,
                             NULL, STORED_CLASSES * (4 + tiles) * sizeof(uint32_t), &stored->tiles)
           && gpu_create_buffer(stored->gpu, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, NULL,
                                sizeof(struct frame), &stored->frame);
}

/* ---- Descriptors ---- */

static bool create_layouts(struct stored *stored)
{
    VkDescriptorSetLayoutBinding bindings[NUM_BINDINGS];
    VkDescriptorPoolSize sizes[NUM_BINDINGS];
    for (uint32_t i = 0; i < NUM_BINDINGS; ++i) {
        bindings[i] = (VkDescriptorSetLayoutBinding){
            i, types[i], 1, VK_SHADER_STAGE_COMPUTE_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, NULL};
        sizes[i] = (VkDescriptorPoolSize){types[i], 1};
    }
    const VkDescriptorSetLayoutCreateInfo
        empty = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO},
        full = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                .bindingCount = NUM_BINDINGS,
                .pBindings = bindings};
    const VkDescriptorPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                             .maxSets = 1,
                                             .poolSizeCount = NUM_BINDINGS,
                                             .pPoolSizes = sizes};
    VkDevice device = stored->gpu->device;
    return gpu_check(stored->gpu,
                     vkCreateDescriptorSetLayout(device, &empty, NULL, &stored->empty_layout),
                     "making a set layout")
           && gpu_check(stored->gpu,
                        vkCreateDescriptorSetLayout(device, &full, NULL, &stored->set_layout),
                        "making a set layout")
           && gpu_check(stored->gpu, vkCreateDescriptorPool(device, &pool, NULL, &stored->pool),
                        "making a descriptor pool");
}

static VkImageView view_of(const struct stored *stored, uint32_t binding)
{
    switch (binding) {
    case STORED_IMAGE: return stored->words.view;
    case DEPTH: return stored->depth->view;
    case COLOR: return stored->color.view;
    case LIT: return stored->lit->view;
    case SCATTERED: return stored->scattered.view;
    case BELOW: return stored->below.view;
    case WORD_0:
    case WORD_1:
    case WORD_2: return stored->targets[binding - WORD_0].view;
    default: return stored->decals[(binding - DECALS) % STORED_DECAL_IMAGES].view;
    }
}

static const struct gpu_buffer *buffer_of(const struct stored *stored, uint32_t binding)
{
    switch (binding) {
    case TILES: return &stored->tiles;
    case PAYLOADS: return &stored->payloads;
    case RAYS: return &stored->rays;
    default: return &stored->frame;
    }
}

static void write_set(struct stored *stored, uint32_t first, uint32_t end)
{
    for (uint32_t i = first; i < end; ++i) {
        const struct gpu_buffer *from = buffer_of(stored, i);
        const VkDescriptorBufferInfo buffer = {from->buffer, 0, VK_WHOLE_SIZE};
        VkDescriptorImageInfo image = {.sampler = stored->sampler,
                                       .imageLayout = VK_IMAGE_LAYOUT_GENERAL};
        if (i < TILES || i >= SCATTERED)
            image.imageView = view_of(stored, i);
        const VkWriteDescriptorSet write = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                            .dstSet = stored->set,
                                            .dstBinding = i,
                                            .descriptorCount = 1,
                                            .descriptorType = types[i],
                                            .pBufferInfo = &buffer,
                                            .pImageInfo = &image};
        vkUpdateDescriptorSets(stored->gpu->device, 1, &write, 0, NULL);
    }
}

static bool create_set(struct stored *stored)
{
    const VkSamplerCreateInfo sampler = {.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    const VkDescriptorSetAllocateInfo info = {.sType =
                                                  VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                              .descriptorPool = stored->pool,
                                              .descriptorSetCount = 1,
                                              .pSetLayouts = &stored->set_layout};
    VkDevice device = stored->gpu->device;
    if (!gpu_check(stored->gpu, vkCreateSampler(device, &sampler, NULL, &stored->sampler),
                   "making a sampler")
        || !gpu_check(stored->gpu, vkAllocateDescriptorSets(device, &info, &stored->set),
                      "making a descriptor set"))
        return false;
    write_set(stored, 0, PAYLOADS);
    write_set(stored, SCATTERED, NUM_BINDINGS);
    return true;
}

uint32_t *stored_hold_rays(struct stored *stored)
{
    size_t pixels = (size_t)stored->width * stored->height;
    VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    if (!gpu_create_buffer(stored->gpu, usage, NULL, pixels * STORED_PAYLOAD_SIZE,
                           &stored->payloads)
        || !gpu_create_buffer(stored->gpu, usage, NULL, pixels * 8 * sizeof(float), &stored->rays))
        return NULL;
    memset(stored->payloads.mapped, 0, pixels * STORED_PAYLOAD_SIZE);
    write_set(stored, PAYLOADS, SCATTERED);
    return stored->payloads.mapped;
}

struct stored *stored_open(struct gpu *gpu, uint32_t width, uint32_t height, uint32_t words,
                           const struct gpu_image *color, const struct gpu_image *depth)
{
    struct stored *stored = calloc(1, sizeof *stored);
    if (!stored) {
        gpu_check(gpu, VK_ERROR_OUT_OF_HOST_MEMORY, "preparing to draw");
        return NULL;
    }
    *stored = (struct stored){.gpu = gpu,
                              .width = width,
                              .height = height,
                              .tiles_x = (width + STORED_TILE - 1) / STORED_TILE,
                              .tiles_y = (height + STORED_TILE - 1) / STORED_TILE,
                              .lit = color,
                              .depth = depth};
    if (create_images(stored, words) && create_buffers(stored) && create_layouts(stored)
        && create_set(stored))
        return stored;
    stored_close(stored);
    return NULL;
}

void stored_close(struct stored *stored)
{
    if (!stored)
        return;
    struct gpu *gpu = stored->gpu;
    for (uint32_t i = 0; i < stored->num_passes; ++i) {
        struct pass *pass = &stored->passes[i];
        vkDestroyPipeline(gpu->device, pass->pipeline, NULL);
        vkDestroyPipelineLayout(gpu->device, pass->layout, NULL);
        inputs_destroy(gpu, pass->source.draw, &pass->inputs);
    }
    vkDestroyDescriptorPool(gpu->device, stored->pool, NULL);
    vkDestroyDescriptorSetLayout(gpu->device, stored->set_layout, NULL);
    vkDestroyDescriptorSetLayout(gpu->device, stored->empty_layout, NULL);
    vkDestroySampler(gpu->device, stored->sampler, NULL);
    gpu_destroy_buffer(gpu, &stored->rays);
    gpu_destroy_buffer(gpu, &stored->payloads);
    gpu_destroy_buffer(gpu, &stored->frame);
    gpu_destroy_buffer(gpu, &stored->tiles);
    gpu_destroy_image(gpu, &stored->words);
    gpu_destroy_image(gpu, &stored->scattered);
    gpu_destroy_image(gpu, &stored->below);
    for (unsigned i = 0; i < STORED_DECAL_IMAGES; ++i)
        gpu_destroy_image(gpu, &stored->decals[i]);
    for (unsigned i = 0; i < STORED_TARGETS; ++i)
        gpu_destroy_image(gpu, &stored->targets[i]);
    gpu_destroy_image(gpu, &stored->color);
    free(stored);
}

/* ---- Passes ---- */

static bool create_pipeline(struct stored *stored, struct pass *pass)
{
    const VkDescriptorSetLayout layouts[2] = {pass->inputs.num_sets ? pass->inputs.set_layouts[0]
                                                                    : stored->empty_layout,
                                              stored->set_layout};
    const VkPipelineLayoutCreateInfo layout = {.sType =
                                                   VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                               .setLayoutCount = 2,
                                               .pSetLayouts = layouts};
    return gpu_create_compute(stored->gpu, &layout, pass->source.code, pass->source.code_words,
                              &pass->layout, &pass->pipeline);
}

bool stored_add_pass(struct stored *stored, const struct stored_pass *source)
{
    struct pass *pass = &stored->passes[stored->num_passes++];
    *pass = (struct pass){.source = *source};
    return inputs_create(stored->gpu, source->draw, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC,
                         &pass->inputs)
           && create_pipeline(stored, pass);
}

VkDescriptorSetLayout stored_set_layout(const struct stored *stored)
{
    return stored->set_layout;
}

VkDescriptorSet stored_set(const struct stored *stored)
{
    return stored->set;
}

VkImageView stored_target(const struct stored *stored, unsigned target)
{
    return target == 0 ? stored->color.view : stored->targets[target - 1].view;
}

VkFormat stored_target_format(unsigned target)
{
    return target == 0 ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R32_UINT;
}

/* ---- Running ---- */

void stored_update(struct stored *stored, const struct stored_frame *from)
{
    struct frame *frame = stored->frame.mapped;
    memcpy(frame->to_world, from->to_world, sizeof frame->to_world);
    frame->size[0] = stored->width;
    frame->size[1] = stored->height;
    frame->tiles_per_row = stored->tiles_x;
    frame->num_tiles = stored->tiles_x * stored->tiles_y;
    frame->shown = from->shown;
    for (uint32_t i = 0; i < stored->num_passes; ++i)
        inputs_update(stored->passes[i].source.draw, &stored->passes[i].inputs);
}

static void make_general(VkCommandBuffer commands, const struct gpu_image *image,
                         VkImageAspectFlags aspect)
{
    gpu_image_barrier(commands, image->image, aspect, 0, 1, VK_IMAGE_LAYOUT_UNDEFINED,
                      VK_IMAGE_LAYOUT_GENERAL);
}

/* The lists of tiles are empty at the begin of a frame; one frame runs at a time. */
static void reset_tiles(const struct stored *stored)
{
    uint32_t *commands = stored->tiles.mapped;
    for (unsigned i = 0; i < STORED_CLASSES; ++i) {
        commands[4 * i] = 0;
        commands[4 * i + 1] = commands[4 * i + 2] = 1;
    }
}

/* Decals leave all of the base at first. */
static void clear_decals(const struct stored *stored, VkCommandBuffer commands)
{
    const VkClearColorValue nothing = {.float32 = {0, 0, 0, 1}};
    const VkImageSubresourceRange all = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    for (unsigned i = 0; i < STORED_DECAL_IMAGES; ++i) {
        make_general(commands, &stored->decals[i], VK_IMAGE_ASPECT_COLOR_BIT);
        vkCmdClearColorImage(commands, stored->decals[i].image, VK_IMAGE_LAYOUT_GENERAL, &nothing,
                             1, &all);
    }
}

static void run_pass(const struct stored *stored, VkCommandBuffer commands, const struct pass *pass)
{
    stored_barrier(commands);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass->pipeline);
    inputs_bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass->layout, pass->source.draw,
                &pass->inputs, 0);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass->layout, 1, 1,
                            &stored->set, 0, NULL);
    if (pass->source.which < 0)
        vkCmdDispatch(commands, stored->tiles_x, stored->tiles_y, 1);
    else
        vkCmdDispatchIndirect(commands, stored->tiles.buffer,
                              (VkDeviceSize)pass->source.which * 4 * sizeof(uint32_t));
}

static void run_passes(const struct stored *stored, VkCommandBuffer commands, bool are_first)
{
    for (uint32_t i = 0; i < stored->num_passes; ++i)
        if ((stored->passes[i].source.which == STORED_FIRST) == are_first)
            run_pass(stored, commands, &stored->passes[i]);
    stored_barrier(commands);
}

static void mark_words(const struct stored *stored, VkCommandBuffer commands)
{
    const VkClearColorValue mark = {.uint32 = {stored->mark}};
    const VkImageSubresourceRange all = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0,
                                         VK_REMAINING_ARRAY_LAYERS};
    vkCmdClearColorImage(commands, stored->words.image, VK_IMAGE_LAYOUT_GENERAL, &mark, 1, &all);
}

void stored_begin(const struct stored *stored, VkCommandBuffer commands)
{
    reset_tiles(stored);
    make_general(commands, &stored->color, VK_IMAGE_ASPECT_COLOR_BIT);
    for (unsigned i = 0; i < STORED_TARGETS; ++i)
        make_general(commands, &stored->targets[i], VK_IMAGE_ASPECT_COLOR_BIT);
    make_general(commands, &stored->words, VK_IMAGE_ASPECT_COLOR_BIT);
    make_general(commands, &stored->scattered, VK_IMAGE_ASPECT_COLOR_BIT);
    make_general(commands, &stored->below, VK_IMAGE_ASPECT_COLOR_BIT);
    clear_decals(stored, commands);
    if (stored->marks)
        mark_words(stored, commands);
    run_passes(stored, commands, true);
}

void stored_barrier(VkCommandBuffer commands)
{
    const VkMemoryBarrier barrier = {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                     .srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT,
                                     .dstAccessMask =
                                         VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 1, &barrier, 0, NULL, 0, NULL);
}

void stored_run(const struct stored *stored, VkCommandBuffer commands)
{
    run_passes(stored, commands, false);
}

/* ---- Tests ---- */

void stored_mark(struct stored *stored, uint32_t mark)
{
    stored->marks = true;
    stored->mark = mark;
}

static void copy_word(const struct stored *stored, VkCommandBuffer commands, uint32_t word,
                      uint32_t x, uint32_t y, VkBuffer to)
{
    bool is_target = word < STORED_TARGETS;
    const VkBufferImageCopy copy = {.bufferOffset = word * sizeof(uint32_t),
                                    .imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0,
                                                         is_target ? 0 : word - STORED_TARGETS, 1},
                                    .imageOffset = {(int32_t)x, (int32_t)y, 0},
                                    .imageExtent = {1, 1, 1}};
    vkCmdCopyImageToBuffer(commands, is_target ? stored->targets[word].image : stored->words.image,
                           VK_IMAGE_LAYOUT_GENERAL, to, 1, &copy);
}

bool stored_read(struct stored *stored, uint32_t x, uint32_t y, uint32_t *out, uint32_t count)
{
    struct gpu_buffer buffer;
    VkCommandBuffer commands = NULL;
    if (gpu_create_buffer(stored->gpu, VK_BUFFER_USAGE_TRANSFER_DST_BIT, NULL, count * sizeof *out,
                          &buffer))
        commands = gpu_begin(stored->gpu);
    for (uint32_t i = 0; commands && i < count; ++i)
        copy_word(stored, commands, i, x, y, buffer.buffer);
    bool good = commands && gpu_end(stored->gpu, commands);
    if (good)
        memcpy(out, buffer.mapped, count * sizeof *out);
    gpu_destroy_buffer(stored->gpu, &buffer);
    return good;
}
