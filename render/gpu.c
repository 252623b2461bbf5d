// SPDX-License-Identifier: Apache-2.0
#include "render/gpu.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define API_VERSION VK_API_VERSION_1_3
#define MAX_DEVICES 16
#define READ_BY_DRAWS \
    (VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT \
     | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT)

bool gpu_check(struct gpu *gpu, VkResult result, const char *what)
{
    static const struct {
        VkResult result;
        const char *id, *text;
    } known[] = {
        {VK_ERROR_DEVICE_LOST, "device-lost", "the Vulkan device was lost"},
        {VK_ERROR_OUT_OF_DEVICE_MEMORY, "device-memory", "the device is out of memory"},
        {VK_ERROR_OUT_OF_HOST_MEMORY, "device-memory", "out of memory"},
        {VK_ERROR_INITIALIZATION_FAILED, "no-device", "the driver does not start"},
    };
    if (result == VK_SUCCESS || gpu->reason[0])
        return result == VK_SUCCESS;
    gpu->id = "render-failed";
    snprintf(gpu->reason, sizeof gpu->reason, "%s failed (VkResult %d)", what, (int)result);
    for (size_t i = 0; i < sizeof known / sizeof *known; ++i) {
        if (result != known[i].result)
            continue;
        gpu->id = known[i].id;
        snprintf(gpu->reason, sizeof gpu->reason, "%s: %s", what, known[i].text);
    }
    return false;
}

/* ---- Device ---- */

static bool fail_no_device(struct gpu *gpu)
{
    gpu->id = "no-device";
    snprintf(gpu->reason, sizeof gpu->reason,
             "no device supports Vulkan 1.3; install a driver, for example the package "
             "mesa-vulkan-drivers, which needs no hardware");
    return false;
}

static bool create_instance(struct gpu *gpu)
{
    const VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                           .pApplicationName = "mxgen-render",
                                           .apiVersion = API_VERSION};
    const VkInstanceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                       .pApplicationInfo = &application};
    VkResult result = vkCreateInstance(&info, NULL, &gpu->instance);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) /* the loader found no driver */
        return fail_no_device(gpu);
    return gpu_check(gpu, result, "making a Vulkan instance");
}

/* The first queue family that draws; UINT32_MAX: none. */
static uint32_t find_queue_family(VkPhysicalDevice device)
{
    VkQueueFamilyProperties families[32];
    uint32_t count = 32;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families);
    for (uint32_t i = 0; i < count; ++i) {
        if (families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT)
            return i;
    }
    return UINT32_MAX;
}

bool gpu_is_processor(const struct gpu *gpu)
{
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(gpu->physical, &properties);
    return properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
}

/* 0: unfit */
static int rank_device(VkPhysicalDevice device)
{
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(device, &properties);
    if (properties.apiVersion < API_VERSION || find_queue_family(device) == UINT32_MAX)
        return 0;
    return properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU ? 1 : 2;
}

static bool choose_device(struct gpu *gpu)
{
    VkPhysicalDevice devices[MAX_DEVICES];
    uint32_t count = MAX_DEVICES;
    vkEnumeratePhysicalDevices(gpu->instance, &count, devices);
    int best = 0;
    for (uint32_t i = 0; i < count; ++i) {
        int rank = rank_device(devices[i]);
        if (rank > best) {
            best = rank;
            gpu->physical = devices[i];
        }
    }
    if (best == 0)
        return fail_no_device(gpu);
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(gpu->physical, &properties);
    gpu->max_size = properties.limits.maxImageDimension2D;
    return true;
}

static void find_clock(struct gpu *gpu, uint32_t family)
{
    VkQueueFamilyProperties families[32];
    VkPhysicalDeviceProperties properties;
    uint32_t count = 32;
    vkGetPhysicalDeviceProperties(gpu->physical, &properties);
    vkGetPhysicalDeviceQueueFamilyProperties(gpu->physical, &count, families);
    uint32_t bits = families[family].timestampValidBits;
    gpu->tick = bits ? 1e-9 * (double)properties.limits.timestampPeriod : 0;
    gpu->ticks = bits ? UINT64_MAX >> (64 - bits) : 0;
}

static bool create_device(struct gpu *gpu)
{
    uint32_t family = find_queue_family(gpu->physical);
    const float priority = 1.0f;
    const VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                           .queueFamilyIndex = family,
                                           .queueCount = 1,
                                           .pQueuePriorities = &priority};
    VkPhysicalDeviceVulkan13Features wanted = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES,
        .dynamicRendering = VK_TRUE};
    VkPhysicalDeviceFeatures has, features = {0};
    vkGetPhysicalDeviceFeatures(gpu->physical, &has);
    gpu->can_store = has.fragmentStoresAndAtomics && has.shaderStorageImageWriteWithoutFormat;
    if (gpu->can_store)
        features = (VkPhysicalDeviceFeatures){.fragmentStoresAndAtomics = VK_TRUE,
                                              .shaderStorageImageWriteWithoutFormat = VK_TRUE};
    features.dualSrcBlend = has.dualSrcBlend;
    gpu->blends_twice = has.dualSrcBlend;
    const VkDeviceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                     .pNext = &wanted,
                                     .pEnabledFeatures = &features,
                                     .queueCreateInfoCount = 1,
                                     .pQueueCreateInfos = &queue};
    if (!gpu_check(gpu, vkCreateDevice(gpu->physical, &info, NULL, &gpu->device),
                   "opening the device"))
        return false;
    vkGetDeviceQueue(gpu->device, family, 0, &gpu->queue);
    vkGetPhysicalDeviceMemoryProperties(gpu->physical, &gpu->memory);
    find_clock(gpu, family);
    const VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                          .queueFamilyIndex = family};
    return gpu_check(gpu, vkCreateCommandPool(gpu->device, &pool, NULL, &gpu->pool),
                     "making a command pool");
}

bool gpu_open(struct gpu *gpu)
{
    *gpu = (struct gpu){0};
    return create_instance(gpu) && choose_device(gpu) && create_device(gpu);
}

void gpu_close(struct gpu *gpu)
{
    if (gpu->device) {
        vkDestroyCommandPool(gpu->device, gpu->pool, NULL);
        vkDestroyDevice(gpu->device, NULL);
    }
    if (gpu->instance)
        vkDestroyInstance(gpu->instance, NULL);
}

/* ---- Memory ---- */

/* memoryTypeCount: none. */
static uint32_t find_memory(const struct gpu *gpu, VkMemoryRequirements needs,
                            VkMemoryPropertyFlags flags)
{
    uint32_t i = 0;
    while (i < gpu->memory.memoryTypeCount
           && !((needs.memoryTypeBits >> i & 1)
                && (gpu->memory.memoryTypes[i].propertyFlags & flags) == flags))
        ++i;
    return i;
}

static VkResult allocate_from(struct gpu *gpu, VkMemoryRequirements needs,
                              VkMemoryPropertyFlags flags, VkDeviceMemory *out)
{
    const VkMemoryAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                       .allocationSize = needs.size,
                                       .memoryTypeIndex = find_memory(gpu, needs, flags)};
    if (info.memoryTypeIndex == gpu->memory.memoryTypeCount)
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    return vkAllocateMemory(gpu->device, &info, NULL, out);
}

/* preferred: flags of memory that the device may lack, or not have enough of. */
static bool allocate(struct gpu *gpu, VkMemoryRequirements needs, VkMemoryPropertyFlags flags,
                     VkMemoryPropertyFlags preferred, VkDeviceMemory *out)
{
    return allocate_from(gpu, needs, flags | preferred, out) == VK_SUCCESS
           || gpu_check(gpu, allocate_from(gpu, needs, flags, out), "allocating device memory");
}

bool gpu_load_shader(struct gpu *gpu, const uint32_t *code, size_t num_words, VkShaderModule *out)
{
    const VkShaderModuleCreateInfo info = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                           .codeSize = num_words * sizeof *code,
                                           .pCode = code};
    return gpu_check(gpu, vkCreateShaderModule(gpu->device, &info, NULL, out),
                     "loading the shader");
}

VkPipelineShaderStageCreateInfo gpu_stage(VkShaderStageFlagBits stage, VkShaderModule module)
{
    return (VkPipelineShaderStageCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
        .stage = stage,
        .module = module,
        .pName = "main"};
}

const VkPipelineInputAssemblyStateCreateInfo gpu_triangles = {
    .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
    .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST,
};
const VkPipelineMultisampleStateCreateInfo gpu_one_sample = {
    .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
    .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT,
};

bool gpu_create_compute(struct gpu *gpu, const VkPipelineLayoutCreateInfo *layout,
                        const uint32_t *code, size_t num_words, VkPipelineLayout *out_layout,
                        VkPipeline *out)
{
    VkShaderModule module;
    if (!gpu_check(gpu, vkCreatePipelineLayout(gpu->device, layout, NULL, out_layout),
                   "making a pipeline layout")
        || !gpu_load_shader(gpu, code, num_words, &module))
        return false;
    const VkComputePipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = gpu_stage(VK_SHADER_STAGE_COMPUTE_BIT, module),
        .layout = *out_layout};
    VkResult result = vkCreateComputePipelines(gpu->device, VK_NULL_HANDLE, 1, &info, NULL, out);
    vkDestroyShaderModule(gpu->device, module, NULL);
    return gpu_check(gpu, result, "compiling the shader");
}

bool gpu_create_buffer(struct gpu *gpu, VkBufferUsageFlags usage, const void *data, size_t size,
                       struct gpu_buffer *out)
{
    *out = (struct gpu_buffer){.size = size};
    const VkBufferCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = size, .usage = usage};
    if (!gpu_check(gpu, vkCreateBuffer(gpu->device, &info, NULL, &out->buffer), "making a buffer"))
        return false;
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(gpu->device, out->buffer, &needs);
    if (!allocate(gpu, needs,
                  VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                  usage & READ_BY_DRAWS ? VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT
                                        : VK_MEMORY_PROPERTY_HOST_CACHED_BIT,
                  &out->memory)
        || !gpu_check(gpu, vkBindBufferMemory(gpu->device, out->buffer, out->memory, 0),
                      "binding memory")
        || !gpu_check(gpu, vkMapMemory(gpu->device, out->memory, 0, VK_WHOLE_SIZE, 0, &out->mapped),
                      "mapping memory"))
        return false;
    if (data)
        memcpy(out->mapped, data, size);
    return true;
}

void gpu_destroy_buffer(struct gpu *gpu, struct gpu_buffer *buffer)
{
    vkDestroyBuffer(gpu->device, buffer->buffer, NULL);
    vkFreeMemory(gpu->device, buffer->memory, NULL);
}

static uint32_t num_layers(const struct gpu_image *image)
{
    return image->layers ? image->layers : 1;
}

bool gpu_create_image(struct gpu *gpu, VkFormat format, uint32_t width, uint32_t height,
                      uint32_t layers, uint32_t mips, VkImageUsageFlags usage,
                      VkImageAspectFlags aspect, struct gpu_image *out)
{
    *out = (struct gpu_image){
        .format = format, .width = width, .height = height, .mips = mips, .layers = layers};
    const VkImageCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = format,
        .extent = {width, height, 1},
        .mipLevels = mips,
        .arrayLayers = num_layers(out),
        .samples = VK_SAMPLE_COUNT_1_BIT,
        .usage = usage,
    };
    if (!gpu_check(gpu, vkCreateImage(gpu->device, &info, NULL, &out->image), "making an image"))
        return false;
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(gpu->device, out->image, &needs);
    if (!allocate(gpu, needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0, &out->memory)
        || !gpu_check(gpu, vkBindImageMemory(gpu->device, out->image, out->memory, 0),
                      "binding memory"))
        return false;
    const VkImageViewCreateInfo view = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .image = out->image,
        .viewType = layers ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D,
        .format = format,
        .subresourceRange = {aspect, 0, mips, 0, VK_REMAINING_ARRAY_LAYERS},
    };
    return gpu_check(gpu, vkCreateImageView(gpu->device, &view, NULL, &out->view),
                     "making an image view");
}

void gpu_destroy_image(struct gpu *gpu, struct gpu_image *image)
{
    vkDestroyImageView(gpu->device, image->view, NULL);
    vkDestroyImage(gpu->device, image->image, NULL);
    vkFreeMemory(gpu->device, image->memory, NULL);
}

/* ---- Commands ---- */

VkCommandBuffer gpu_begin(struct gpu *gpu)
{
    const VkCommandBufferAllocateInfo info = {.sType =
                                                  VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                              .commandPool = gpu->pool,
                                              .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                              .commandBufferCount = 1};
    VkCommandBuffer commands;
    if (!gpu_check(gpu, vkAllocateCommandBuffers(gpu->device, &info, &commands), "making commands"))
        return NULL;
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                            .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    return gpu_check(gpu, vkBeginCommandBuffer(commands, &begin), "recording commands") ? commands
                                                                                        : NULL;
}

bool gpu_end(struct gpu *gpu, VkCommandBuffer commands)
{
    const VkSubmitInfo submit = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                                 .commandBufferCount = 1,
                                 .pCommandBuffers = &commands};
    bool good = gpu_check(gpu, vkEndCommandBuffer(commands), "recording commands")
                && gpu_check(gpu, vkQueueSubmit(gpu->queue, 1, &submit, VK_NULL_HANDLE),
                             "submitting commands")
                && gpu_check(gpu, vkQueueWaitIdle(gpu->queue), "running commands");
    vkFreeCommandBuffers(gpu->device, gpu->pool, 1, &commands);
    return good;
}

void gpu_image_barrier(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect,
                       uint32_t first_mip, uint32_t num_mips, VkImageLayout from, VkImageLayout to)
{
    const VkImageMemoryBarrier barrier = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
        .srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT,
        .dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT,
        .oldLayout = from,
        .newLayout = to,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = image,
        .subresourceRange = {aspect, first_mip, num_mips, 0, VK_REMAINING_ARRAY_LAYERS},
    };
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, NULL, 0, NULL, 1, &barrier);
}

/* ---- Textures ---- */

static uint32_t half(uint32_t size)
{
    return size > 1 ? size / 2 : 1;
}

/* Each level is the one above it at half the size; ends with all levels readable by shaders. */
static void make_mips(VkCommandBuffer commands, const struct gpu_image *image)
{
    uint32_t width = image->width, height = image->height;
    for (uint32_t mip = 1; mip < image->mips; ++mip) {
        gpu_image_barrier(commands, image->image, VK_IMAGE_ASPECT_COLOR_BIT, mip - 1, 1,
                          VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                          VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        const VkImageBlit blit = {
            .srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, mip - 1, 0, num_layers(image)},
            .srcOffsets = {{0, 0, 0}, {(int32_t)width, (int32_t)height, 1}},
            .dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, mip, 0, num_layers(image)},
            .dstOffsets = {{0, 0, 0}, {(int32_t)half(width), (int32_t)half(height), 1}},
        };
        vkCmdBlitImage(commands, image->image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, image->image,
                       VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &blit, VK_FILTER_LINEAR);
        width = half(width);
        height = half(height);
    }
    if (image->mips > 1)
        gpu_image_barrier(commands, image->image, VK_IMAGE_ASPECT_COLOR_BIT, 0, image->mips - 1,
                          VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                          VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    gpu_image_barrier(commands, image->image, VK_IMAGE_ASPECT_COLOR_BIT, image->mips - 1, 1,
                      VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                      VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

static bool fill_texture(struct gpu *gpu, const struct gpu_buffer *staging,
                         const struct gpu_image *image, uint32_t levels)
{
    VkCommandBuffer commands = gpu_begin(gpu);
    if (!commands)
        return false;
    gpu_image_barrier(commands, image->image, VK_IMAGE_ASPECT_COLOR_BIT, 0, image->mips,
                      VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    VkDeviceSize offset = 0;
    size_t texel = image->format == VK_FORMAT_R8G8B8A8_UNORM ? 4 : 16;
    for (uint32_t level = 0; level < levels; ++level) {
        uint32_t width = image_level_size(image->width, level),
                 height = image_level_size(image->height, level);
        const VkBufferImageCopy copy = {
            .bufferOffset = offset,
            .imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level, 0, num_layers(image)},
            .imageExtent = {width, height, 1}};
        vkCmdCopyBufferToImage(commands, staging->buffer, image->image,
                               VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
        offset += (VkDeviceSize)texel * width * height;
    }
    if (levels > 1)
        gpu_image_barrier(commands, image->image, VK_IMAGE_ASPECT_COLOR_BIT, 0, image->mips,
                          VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                          VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    else
        make_mips(commands, image);
    return gpu_end(gpu, commands);
}

/* Copies levels and layers, each turned upside down where the last row comes first. */
static void stage(const struct image *image, bool bottom_first, char *to)
{
    const char *from = image->pixels;
    uint32_t levels = image->levels ? image->levels : 1, layers = image->layers ? image->layers : 1;
    for (uint32_t i = 0; i < levels * layers; ++i) {
        uint32_t level = i / layers, height = image_level_size(image->height, level);
        size_t row = (size_t)image_level_size(image->width, level) * 4
                     * (image->is_float ? sizeof(float) : 1);
        for (uint32_t y = 0; y < height; ++y)
            memcpy(to + row * y, from + row * (bottom_first ? height - 1 - y : y), row);
        from += row * height;
        to += row * height;
    }
}

bool gpu_upload_texture(struct gpu *gpu, const struct image *image, bool bottom_first,
                        struct gpu_image *out)
{
    uint32_t levels = image->levels ? image->levels : 1, layers = image->layers ? image->layers : 1;
    size_t size = 0;
    for (uint32_t level = 0; level < levels; ++level)
        size += (size_t)image_level_size(image->width, level)
                * image_level_size(image->height, level) * layers * 4
                * (image->is_float ? sizeof(float) : 1);
    struct gpu_buffer staging;
    bool good = gpu_create_buffer(gpu, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, NULL, size, &staging);
    if (good)
        stage(image, bottom_first, staging.mapped);
    VkFormat format = image->is_float ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R8G8B8A8_UNORM;
    *out = (struct gpu_image){0};
    good = good
           && gpu_create_image(gpu, format, image->width, image->height, image->layers,
                               image_num_mips(image),
                               VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT
                                   | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                               VK_IMAGE_ASPECT_COLOR_BIT, out)
           && fill_texture(gpu, &staging, out, levels);
    gpu_destroy_buffer(gpu, &staging);
    return good;
}
