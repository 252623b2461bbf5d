// SPDX-License-Identifier: Apache-2.0
#include "device.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void check(bool good, const char *what)
{
    if (good)
        return;
    fprintf(stderr, "failed: %s\n", what);
    exit(1);
}

/* ---- Device and memory ---- */

static void open_device(struct device *d, const VkPhysicalDeviceFeatures *features)
{
    VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                     .apiVersion = VK_API_VERSION_1_1};
    VK(vkCreateInstance(&(VkInstanceCreateInfo){.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                                .pApplicationInfo = &application},
                        NULL, &d->instance));
    uint32_t num_gpus = 1;
    VkResult found = vkEnumeratePhysicalDevices(d->instance, &num_gpus, &d->card);
    check((found == VK_SUCCESS || found == VK_INCOMPLETE) && num_gpus == 1, "the search of a GPU");
    /* every driver's first family draws; a host with a window asks for presentation, too */
    VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                     .queueCount = 1,
                                     .pQueuePriorities = &(float){1}};
    VK(vkCreateDevice(d->card,
                      &(VkDeviceCreateInfo){.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                            .queueCreateInfoCount = 1,
                                            .pQueueCreateInfos = &queue,
                                            .pEnabledFeatures = features},
                      NULL, &d->device));
    vkGetDeviceQueue(d->device, 0, 0, &d->queue);
    VK(vkCreateCommandPool(
        d->device, &(VkCommandPoolCreateInfo){.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO},
        NULL, &d->pool));
}

static VkDeviceMemory allocate(const struct device *d, VkMemoryRequirements needs,
                               VkMemoryPropertyFlags flags)
{
    VkPhysicalDeviceMemoryProperties memory;
    VkDeviceMemory result;
    uint32_t type = 0;
    vkGetPhysicalDeviceMemoryProperties(d->card, &memory);
    while (type < memory.memoryTypeCount
           && (!(needs.memoryTypeBits >> type & 1)
               || (memory.memoryTypes[type].propertyFlags & flags) != flags))
        ++type;
    check(type < memory.memoryTypeCount, "the search of memory");
    VK(vkAllocateMemory(d->device,
                        &(VkMemoryAllocateInfo){.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                                .allocationSize = needs.size,
                                                .memoryTypeIndex = type},
                        NULL, &result));
    return result;
}

struct buffer device_make_buffer(const struct device *d, VkDeviceSize size)
{
    struct buffer b = {.size = size};
    VkMemoryRequirements needs;
    VkBufferCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
        .size = size,
        .usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT
                 | VK_BUFFER_USAGE_INDEX_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT
                 | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT
                 | VK_BUFFER_USAGE_TRANSFER_SRC_BIT};
    VK(vkCreateBuffer(d->device, &info, NULL, &b.buffer));
    vkGetBufferMemoryRequirements(d->device, b.buffer, &needs);
    b.memory = allocate(d, needs,
                        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    VK(vkBindBufferMemory(d->device, b.buffer, b.memory, 0));
    VK(vkMapMemory(d->device, b.memory, 0, VK_WHOLE_SIZE, 0, (void **)&b.bytes));
    return b;
}

void device_free_buffer(const struct device *d, struct buffer b)
{
    vkDestroyBuffer(d->device, b.buffer, NULL);
    vkFreeMemory(d->device, b.memory, NULL);
}

/* ---- Images ---- */

static VkImageAspectFlags aspect_of(VkFormat format)
{
    return format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

static VkImageView make_view(const struct device *d, const struct image *i, VkImageViewType type)
{
    VkImageView view;
    uint32_t num_layers = type == VK_IMAGE_VIEW_TYPE_2D ? 1 : i->num_layers;
    VkImageViewCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                  .image = i->image,
                                  .viewType = type,
                                  .format = i->format,
                                  .subresourceRange = {aspect_of(i->format), 0, 1, 0, num_layers}};
    VK(vkCreateImageView(d->device, &info, NULL, &view));
    return view;
}

struct image device_make_image(const struct device *d, VkFormat format, uint32_t width,
                               uint32_t height, uint32_t num_layers, VkImageUsageFlags usage)
{
    struct image i = {.format = format, .width = width, .height = height, .num_layers = num_layers};
    VkMemoryRequirements needs;
    VkImageCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                              .imageType = VK_IMAGE_TYPE_2D,
                              .format = format,
                              .extent = {width, height, 1},
                              .mipLevels = 1,
                              .arrayLayers = num_layers,
                              .samples = VK_SAMPLE_COUNT_1_BIT,
                              .usage = usage};
    VK(vkCreateImage(d->device, &info, NULL, &i.image));
    vkGetImageMemoryRequirements(d->device, i.image, &needs);
    i.memory = allocate(d, needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    VK(vkBindImageMemory(d->device, i.image, i.memory, 0));
    i.view = make_view(d, &i, VK_IMAGE_VIEW_TYPE_2D);
    i.array = make_view(d, &i, VK_IMAGE_VIEW_TYPE_2D_ARRAY);
    return i;
}

void device_free_image(const struct device *d, struct image i)
{
    vkDestroyImageView(d->device, i.view, NULL);
    vkDestroyImageView(d->device, i.array, NULL);
    vkDestroyImage(d->device, i.image, NULL);
    vkFreeMemory(d->device, i.memory, NULL);
}

/* ---- Commands ---- */

VkCommandBuffer device_begin(const struct device *d)
{
    VkCommandBuffer commands;
    VkCommandBufferAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                        .commandPool = d->pool,
                                        .commandBufferCount = 1};
    VK(vkAllocateCommandBuffers(d->device, &info, &commands));
    VK(vkBeginCommandBuffer(commands, &(VkCommandBufferBeginInfo){
                                          .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO}));
    return commands;
}

void device_run(const struct device *d, VkCommandBuffer commands)
{
    VK(vkEndCommandBuffer(commands));
    VK(vkQueueSubmit(d->queue, 1,
                     &(VkSubmitInfo){.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                                     .commandBufferCount = 1,
                                     .pCommandBuffers = &commands},
                     VK_NULL_HANDLE));
    VK(vkQueueWaitIdle(d->queue));
    vkFreeCommandBuffers(d->device, d->pool, 1, &commands);
}

static void wait_for(VkCommandBuffer commands, const VkImageMemoryBarrier *image)
{
    VkMemoryBarrier memory = {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                              .srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT,
                              .dstAccessMask =
                                  VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 1, &memory, 0, NULL, image ? 1 : 0,
                         image);
}

void device_wait(VkCommandBuffer commands)
{
    wait_for(commands, NULL);
}

void device_change_layout(VkCommandBuffer commands, const struct image *image, VkImageLayout from,
                          VkImageLayout to)
{
    VkImageMemoryBarrier barrier = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
        .srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT,
        .dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT,
        .oldLayout = from,
        .newLayout = to,
        .image = image->image,
        .subresourceRange = {aspect_of(image->format), 0, 1, 0, image->num_layers}};
    wait_for(commands, &barrier);
}

/* ---- A ball, a checkerboard ---- */

static void make_ball(struct device *d)
{
    const float pi = 3.14159265f;
    d->mesh = device_make_buffer(d, NUM_VERTICES * sizeof(struct vertex));
    d->indices = device_make_buffer(d, NUM_INDICES * sizeof(uint32_t));
    struct vertex *v = (struct vertex *)(void *)d->mesh.bytes;
    uint32_t *index = (uint32_t *)(void *)d->indices.bytes;
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

static void make_checkerboard(struct device *d)
{
    enum { TEXELS = 8 };
    d->checker = device_make_image(d, VK_FORMAT_R8G8B8A8_SRGB, TEXELS, TEXELS, 1,
                                   VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    struct buffer texels = device_make_buffer(d, TEXELS * TEXELS * 4);
    for (int i = 0; i < TEXELS * TEXELS; ++i)
        memset(texels.bytes + 4 * i, (i + i / TEXELS) % 2 ? 230 : 60, 4);
    VkCommandBuffer commands = device_begin(d);
    device_change_layout(commands, &d->checker, VK_IMAGE_LAYOUT_UNDEFINED,
                         VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    vkCmdCopyBufferToImage(
        commands, texels.buffer, d->checker.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
        &(VkBufferImageCopy){.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                             .imageExtent = {TEXELS, TEXELS, 1}});
    device_change_layout(commands, &d->checker, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                         VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    device_run(d, commands);
    device_free_buffer(d, texels);
    VK(vkCreateSampler(d->device,
                       &(VkSamplerCreateInfo){.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                              .maxLod = VK_LOD_CLAMP_NONE},
                       NULL, &d->sampler));
}

VkDescriptorPool device_make_pool(const struct device *d, uint32_t num_sets,
                                  const VkDescriptorPoolSize *sizes, uint32_t num_sizes)
{
    VkDescriptorPool pool;
    VkDescriptorPoolCreateInfo info = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                       .maxSets = num_sets,
                                       .poolSizeCount = num_sizes,
                                       .pPoolSizes = sizes};
    VK(vkCreateDescriptorPool(d->device, &info, NULL, &pool));
    return pool;
}

VkDescriptorSet device_make_set(const struct device *d, VkDescriptorPool pool,
                                VkDescriptorSetLayout layout)
{
    VkDescriptorSet set;
    VkDescriptorSetAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                        .descriptorPool = pool,
                                        .descriptorSetCount = 1,
                                        .pSetLayouts = &layout};
    VK(vkAllocateDescriptorSets(d->device, &info, &set));
    return set;
}

void device_draw_ball(const struct device *d, VkCommandBuffer commands)
{
    vkCmdBindIndexBuffer(commands, d->indices.buffer, 0, VK_INDEX_TYPE_UINT32);
    vkCmdDrawIndexed(commands, NUM_INDICES, 1, 0, 0, 0);
}

void device_open(struct device *d, const VkPhysicalDeviceFeatures *features)
{
    open_device(d, features);
    make_ball(d);
    make_checkerboard(d);
}

void device_close(struct device *d)
{
    device_free_image(d, d->checker);
    device_free_buffer(d, d->mesh);
    device_free_buffer(d, d->indices);
    vkDestroySampler(d->device, d->sampler, NULL);
    vkDestroyCommandPool(d->device, d->pool, NULL);
    vkDestroyDevice(d->device, NULL);
    vkDestroyInstance(d->instance, NULL);
}
