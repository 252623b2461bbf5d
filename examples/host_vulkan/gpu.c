// SPDX-License-Identifier: Apache-2.0
/* The part of the host that any Vulkan program has: device, memory, frame, mesh, and a texture. */
#include "gpu.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void check(bool good, const char *what)
{
    if (good)
        return;
    fprintf(stderr, "host_vulkan: failed: %s\n", what);
    exit(1);
}

/* ---- Device, memory, images ---- */

static void open_device(struct gpu *g)
{
    VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                     .apiVersion = VK_API_VERSION_1_1};
    VK(vkCreateInstance(&(VkInstanceCreateInfo){.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                                .pApplicationInfo = &application},
                        NULL, &g->instance));
    uint32_t num_gpus = 1;
    VkResult found = vkEnumeratePhysicalDevices(g->instance, &num_gpus, &g->card);
    check((found == VK_SUCCESS || found == VK_INCOMPLETE) && num_gpus == 1, "the search of a GPU");
    /* every driver's first family draws; a host with a window asks for presentation, too */
    VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                     .queueCount = 1,
                                     .pQueuePriorities = &(float){1}};
    VK(vkCreateDevice(g->card,
                      &(VkDeviceCreateInfo){.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                            .queueCreateInfoCount = 1,
                                            .pQueueCreateInfos = &queue},
                      NULL, &g->device));
    vkGetDeviceQueue(g->device, 0, 0, &g->queue);
    VK(vkCreateCommandPool(
        g->device, &(VkCommandPoolCreateInfo){.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO},
        NULL, &g->pool));
}

static VkDeviceMemory allocate(const struct gpu *g, VkMemoryRequirements needs,
                               VkMemoryPropertyFlags flags)
{
    VkPhysicalDeviceMemoryProperties memory;
    VkDeviceMemory result;
    uint32_t type = 0;
    vkGetPhysicalDeviceMemoryProperties(g->card, &memory);
    while (type < memory.memoryTypeCount
           && (!(needs.memoryTypeBits >> type & 1)
               || (memory.memoryTypes[type].propertyFlags & flags) != flags))
        ++type;
    check(type < memory.memoryTypeCount, "the search of memory");
    VK(vkAllocateMemory(g->device,
                        &(VkMemoryAllocateInfo){.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                                .allocationSize = needs.size,
                                                .memoryTypeIndex = type},
                        NULL, &result));
    return result;
}

struct buffer gpu_make_buffer(const struct gpu *g, VkDeviceSize size)
{
    struct buffer b;
    VkMemoryRequirements needs;
    VkBufferCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
        .size = size,
        .usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT
                 | VK_BUFFER_USAGE_INDEX_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT
                 | VK_BUFFER_USAGE_TRANSFER_SRC_BIT};
    VK(vkCreateBuffer(g->device, &info, NULL, &b.buffer));
    vkGetBufferMemoryRequirements(g->device, b.buffer, &needs);
    b.memory = allocate(g, needs,
                        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    VK(vkBindBufferMemory(g->device, b.buffer, b.memory, 0));
    VK(vkMapMemory(g->device, b.memory, 0, VK_WHOLE_SIZE, 0, (void **)&b.bytes));
    return b;
}

void gpu_free_buffer(const struct gpu *g, struct buffer b)
{
    vkDestroyBuffer(g->device, b.buffer, NULL);
    vkFreeMemory(g->device, b.memory, NULL);
}

static VkImageView make_view(const struct gpu *g, VkImage image, VkFormat format,
                             VkImageAspectFlags aspect, VkImageViewType type)
{
    VkImageView view;
    VkImageViewCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                  .image = image,
                                  .viewType = type,
                                  .format = format,
                                  .subresourceRange = {aspect, 0, 1, 0, 1}};
    VK(vkCreateImageView(g->device, &info, NULL, &view));
    return view;
}

static struct image make_image(const struct gpu *g, VkFormat format, uint32_t size,
                               VkImageUsageFlags usage)
{
    struct image i;
    VkMemoryRequirements needs;
    VkImageCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                              .imageType = VK_IMAGE_TYPE_2D,
                              .format = format,
                              .extent = {size, size, 1},
                              .mipLevels = 1,
                              .arrayLayers = 1,
                              .samples = VK_SAMPLE_COUNT_1_BIT,
                              .usage = usage};
    VkImageAspectFlags aspect = usage & VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                    ? VK_IMAGE_ASPECT_DEPTH_BIT
                                    : VK_IMAGE_ASPECT_COLOR_BIT;
    VK(vkCreateImage(g->device, &info, NULL, &i.image));
    vkGetImageMemoryRequirements(g->device, i.image, &needs);
    i.memory = allocate(g, needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    VK(vkBindImageMemory(g->device, i.image, i.memory, 0));
    i.view = make_view(g, i.image, format, aspect, VK_IMAGE_VIEW_TYPE_2D);
    i.array = make_view(g, i.image, format, aspect, VK_IMAGE_VIEW_TYPE_2D_ARRAY);
    return i;
}

static void free_image(const struct gpu *g, struct image i)
{
    vkDestroyImageView(g->device, i.view, NULL);
    vkDestroyImageView(g->device, i.array, NULL);
    vkDestroyImage(g->device, i.image, NULL);
    vkFreeMemory(g->device, i.memory, NULL);
}

VkCommandBuffer gpu_begin(const struct gpu *g)
{
    VkCommandBuffer commands;
    VkCommandBufferAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                        .commandPool = g->pool,
                                        .commandBufferCount = 1};
    VK(vkAllocateCommandBuffers(g->device, &info, &commands));
    VK(vkBeginCommandBuffer(commands, &(VkCommandBufferBeginInfo){
                                          .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO}));
    return commands;
}

void gpu_run(const struct gpu *g, VkCommandBuffer commands)
{
    VK(vkEndCommandBuffer(commands));
    VK(vkQueueSubmit(g->queue, 1,
                     &(VkSubmitInfo){.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                                     .commandBufferCount = 1,
                                     .pCommandBuffers = &commands},
                     VK_NULL_HANDLE));
    VK(vkQueueWaitIdle(g->queue));
    vkFreeCommandBuffers(g->device, g->pool, 1, &commands);
}

/* ---- The scene: a ball, a frame, a checkerboard ---- */

static void make_ball(struct gpu *g)
{
    const float pi = 3.14159265f;
    g->mesh = gpu_make_buffer(g, NUM_VERTICES * sizeof(struct vertex));
    g->indices = gpu_make_buffer(g, NUM_INDICES * sizeof(uint32_t));
    struct vertex *v = (struct vertex *)(void *)g->mesh.bytes;
    uint32_t *index = (uint32_t *)(void *)g->indices.bytes;
    for (uint32_t ring = 0; ring <= RINGS; ++ring)
        for (uint32_t sector = 0; sector <= SECTORS; ++sector, ++v) {
            float s = (float)sector / SECTORS, t = (float)ring / RINGS;
            float r = sinf(t * pi), x = sinf(2 * pi * s), z = cosf(2 * pi * s);
            *v = (struct vertex){
                {r * x, cosf(t * pi), r * z}, {r * x, cosf(t * pi), r * z}, {z, 0, -x}, {s, 1 - t}};
        }
    for (uint32_t ring = 0; ring < RINGS; ++ring)
        for (uint32_t sector = 0; sector < SECTORS; ++sector) {
            uint32_t a = ring * (SECTORS + 1) + sector, b = a + SECTORS + 1;
            const uint32_t quad[] = {a, b, a + 1, a + 1, b, b + 1};
            memcpy(index, quad, sizeof quad);
            index += 6;
        }
}

static void make_frame(struct gpu *g)
{
    const VkFormat formats[] = {VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_D32_SFLOAT};
    g->color = make_image(g, formats[0], SIZE,
                          VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    g->depth = make_image(g, formats[1], SIZE, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
    g->readback = gpu_make_buffer(g, SIZE * SIZE * 4);
    VkAttachmentDescription attachments[2];
    for (int i = 0; i < 2; ++i)
        attachments[i] = (VkAttachmentDescription){
            .format = formats[i],
            .samples = VK_SAMPLE_COUNT_1_BIT,
            .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
            .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
            .finalLayout = i ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL
                             : VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
    VkSubpassDescription subpass = {
        .colorAttachmentCount = 1,
        .pColorAttachments = &(VkAttachmentReference){0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
        .pDepthStencilAttachment =
            &(VkAttachmentReference){1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL}};
    VkRenderPassCreateInfo pass = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                   .attachmentCount = 2,
                                   .pAttachments = attachments,
                                   .subpassCount = 1,
                                   .pSubpasses = &subpass};
    VK(vkCreateRenderPass(g->device, &pass, NULL, &g->pass));
    VkImageView views[] = {g->color.view, g->depth.view};
    VkFramebufferCreateInfo frame = {.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                     .renderPass = g->pass,
                                     .attachmentCount = 2,
                                     .pAttachments = views,
                                     .width = SIZE,
                                     .height = SIZE,
                                     .layers = 1};
    VK(vkCreateFramebuffer(g->device, &frame, NULL, &g->frame));
}

static void change_layout(VkCommandBuffer commands, VkImage image, VkImageLayout from,
                          VkImageLayout to)
{
    VkImageMemoryBarrier barrier = {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
                                    .srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT,
                                    .dstAccessMask =
                                        VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT,
                                    .oldLayout = from,
                                    .newLayout = to,
                                    .image = image,
                                    .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, NULL, 0, NULL, 1, &barrier);
}

static void make_checkerboard(struct gpu *g)
{
    enum { TEXELS = 8 };
    g->checker = make_image(g, VK_FORMAT_R8G8B8A8_SRGB, TEXELS,
                            VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    struct buffer texels = gpu_make_buffer(g, TEXELS * TEXELS * 4);
    for (int i = 0; i < TEXELS * TEXELS; ++i)
        memset(texels.bytes + 4 * i, (i + i / TEXELS) % 2 ? 230 : 60, 4);
    VkCommandBuffer commands = gpu_begin(g);
    change_layout(commands, g->checker.image, VK_IMAGE_LAYOUT_UNDEFINED,
                  VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    vkCmdCopyBufferToImage(
        commands, texels.buffer, g->checker.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
        &(VkBufferImageCopy){.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                             .imageExtent = {TEXELS, TEXELS, 1}});
    change_layout(commands, g->checker.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                  VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    gpu_run(g, commands);
    gpu_free_buffer(g, texels);
    VK(vkCreateSampler(g->device,
                       &(VkSamplerCreateInfo){.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                              .maxLod = VK_LOD_CLAMP_NONE},
                       NULL, &g->sampler));
}

void gpu_open(struct gpu *g)
{
    open_device(g);
    make_ball(g);
    make_frame(g);
    make_checkerboard(g);
}

void gpu_write_picture(struct gpu *g, VkCommandBuffer commands, const char *path)
{
    vkCmdCopyImageToBuffer(
        commands, g->color.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, g->readback.buffer, 1,
        &(VkBufferImageCopy){.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                             .imageExtent = {SIZE, SIZE, 1}});
    gpu_run(g, commands);
    FILE *file = fopen(path, "wb");
    check(file, path);
    fprintf(file, "P6 %d %d 255\n", SIZE, SIZE);
    for (int i = 0; i < SIZE * SIZE; ++i)
        fwrite(g->readback.bytes + 4 * i, 1, 3, file);
    check(fclose(file) == 0, path);
}

void gpu_close(struct gpu *g)
{
    free_image(g, g->color);
    free_image(g, g->depth);
    free_image(g, g->checker);
    gpu_free_buffer(g, g->mesh);
    gpu_free_buffer(g, g->indices);
    gpu_free_buffer(g, g->readback);
    vkDestroySampler(g->device, g->sampler, NULL);
    vkDestroyFramebuffer(g->device, g->frame, NULL);
    vkDestroyRenderPass(g->device, g->pass, NULL);
    vkDestroyCommandPool(g->device, g->pool, NULL);
    vkDestroyDevice(g->device, NULL);
    vkDestroyInstance(g->instance, NULL);
}
