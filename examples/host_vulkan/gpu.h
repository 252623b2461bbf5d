// SPDX-License-Identifier: Apache-2.0
/* A Vulkan device that draws balls into a picture. Nothing here knows mxgen. */
#ifndef HOST_VULKAN_GPU_H
#define HOST_VULKAN_GPU_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <vulkan/vulkan.h>

enum { SIZE = 640 }; /* pixels of the picture, in both directions */
enum { RINGS = 24, SECTORS = 48 };
enum { NUM_VERTICES = (RINGS + 1) * (SECTORS + 1), NUM_INDICES = RINGS * SECTORS * 6 };

/* Ends the program if `good` is false. A real host would, for example, replace a lost device. */
void check(bool good, const char *what);
#define VK(call) check((call) == VK_SUCCESS, #call)

struct vertex {
    float position[3], normal[3], tangent[3], texcoord[2];
};

struct buffer {
    VkBuffer buffer;
    VkDeviceMemory memory;
    unsigned char *bytes; /* mapped as long as the buffer exists */
};

struct image {
    VkImage image;
    VkDeviceMemory memory;
    VkImageView view, array; /* array: the image as an array of one layer */
};

struct gpu {
    VkInstance instance;
    VkPhysicalDevice card;
    VkDevice device;
    VkQueue queue;
    VkCommandPool pool;
    VkRenderPass pass;
    VkFramebuffer frame;
    VkSampler sampler;
    struct image color, depth, checker;
    struct buffer mesh, indices, readback;
};

void gpu_open(struct gpu *g);
void gpu_close(struct gpu *g);

/* A buffer for uniforms, vertices or indices. The caller frees it. */
struct buffer gpu_make_buffer(const struct gpu *g, VkDeviceSize size);
void gpu_free_buffer(const struct gpu *g, struct buffer b);

VkCommandBuffer gpu_begin(const struct gpu *g);
/* Runs the commands, waits, and frees them. */
void gpu_run(const struct gpu *g, VkCommandBuffer commands);
/* Runs the commands, too, and writes the drawn picture as PPM. */
void gpu_write_picture(struct gpu *g, VkCommandBuffer commands, const char *path);

#endif
