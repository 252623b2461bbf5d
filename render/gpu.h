// SPDX-License-Identifier: Apache-2.0
/*
 * Vulkan 1.3 without a window: a device, its buffers and images, and synchronous commands. `reason`
 * keeps the first failure, and functions return false after it.
 */
#ifndef MXG_RENDER_GPU_H
#define MXG_RENDER_GPU_H

#include "render/image.h"

#include <vulkan/vulkan.h>

struct gpu {
    VkInstance instance;
    VkPhysicalDevice physical;
    VkDevice device;
    VkQueue queue;
    VkCommandPool pool;
    VkPhysicalDeviceMemoryProperties memory;
    bool can_store;    /* pixel stages may write images and buffers: stored.h, each.h */
    bool blends_twice; /* pixel stages may have a second source for blending */
    uint32_t max_size; /* of pictures and textures, in pixels */
    double tick;       /* of the device's clock, in seconds; 0: it has none */
    uint64_t ticks;    /* its largest number, after which it goes on from 0 */
    const char *id;    /* id of the first failure: "device-lost"… */
    char reason[256];  /* "" without a failure */
};

struct gpu_buffer {
    VkBuffer buffer;
    VkDeviceMemory memory;
    void *mapped;
    size_t size;
};

struct gpu_image {
    VkImage image;
    VkImageView view;
    VkDeviceMemory memory;
    VkFormat format;
    uint32_t width, height, mips;
    uint32_t layers; /* 0: not an array */
};

/* Opens the first device that can draw, hardware before software. Call gpu_close in any case. */
bool gpu_open(struct gpu *gpu);
void gpu_close(struct gpu *gpu);
/* True where the device is the processor, as lavapipe is: programs beside this one slow it. */
bool gpu_is_processor(const struct gpu *gpu);

/* Keeps the reason of a failure; returns result == VK_SUCCESS. */
bool gpu_check(struct gpu *gpu, VkResult result, const char *what);

/* Loads SPIR-V. False: see gpu->reason. */
bool gpu_load_shader(struct gpu *gpu, const uint32_t *code, size_t num_words, VkShaderModule *out);
VkPipelineShaderStageCreateInfo gpu_stage(VkShaderStageFlagBits stage, VkShaderModule module);

/* State of every pipeline that draws. */
extern const VkPipelineInputAssemblyStateCreateInfo gpu_triangles;
extern const VkPipelineMultisampleStateCreateInfo gpu_one_sample;

/* A compute program of SPIR-V and its layout, which the caller destroys, also after a failure. */
bool gpu_create_compute(struct gpu *gpu, const VkPipelineLayoutCreateInfo *layout,
                        const uint32_t *code, size_t num_words, VkPipelineLayout *out_layout,
                        VkPipeline *out);

/*
 * Mapped memory that the processor can read and write: of the device, where draws read it and the
 * device has such memory, else such that the processor reads fast. `data` may be NULL.
 */
bool gpu_create_buffer(struct gpu *gpu, VkBufferUsageFlags usage, const void *data, size_t size,
                       struct gpu_buffer *out);
void gpu_destroy_buffer(struct gpu *gpu, struct gpu_buffer *buffer);

/* An array if layers is above 0. */
bool gpu_create_image(struct gpu *gpu, VkFormat format, uint32_t width, uint32_t height,
                      uint32_t layers, uint32_t mips, VkImageUsageFlags usage,
                      VkImageAspectFlags aspect, struct gpu_image *out);
void gpu_destroy_image(struct gpu *gpu, struct gpu_image *image);

/* A texture with box-filtered mip levels. bottom_first: the last row of the image becomes v = 0. */
bool gpu_upload_texture(struct gpu *gpu, const struct image *image, bool bottom_first,
                        struct gpu_image *out);

/* The commands from begin to end run synchronously. NULL on failure. */
VkCommandBuffer gpu_begin(struct gpu *gpu);
bool gpu_end(struct gpu *gpu, VkCommandBuffer commands);

void gpu_image_barrier(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect,
                       uint32_t first_mip, uint32_t num_mips, VkImageLayout from, VkImageLayout to);

#endif
