// SPDX-License-Identifier: Apache-2.0
/* A Vulkan device, its memory and commands, and a ball. Nothing here knows mxgen. */
#ifndef HOST_VULKAN_DEVICE_H
#define HOST_VULKAN_DEVICE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <vulkan/vulkan.h>

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
    VkDeviceSize size;
    unsigned char *bytes; /* mapped as long as the buffer exists */
};

struct image {
    VkImage image;
    VkDeviceMemory memory;
    VkFormat format;
    uint32_t width, height, num_layers;
    VkImageView view, array; /* array: the image as an array of its layers */
};

struct device {
    VkInstance instance;
    VkPhysicalDevice card;
    VkDevice device;
    VkQueue queue;
    VkCommandPool pool;
    VkSampler sampler;
    struct image checker;
    struct buffer mesh, indices;
};

/* Opens a device with these features, which the program ends without. */
void device_open(struct device *d, const VkPhysicalDeviceFeatures *features);
void device_close(struct device *d);

/* A buffer of any use. The caller frees it. */
struct buffer device_make_buffer(const struct device *d, VkDeviceSize size);
void device_free_buffer(const struct device *d, struct buffer b);
struct image device_make_image(const struct device *d, VkFormat format, uint32_t width,
                               uint32_t height, uint32_t num_layers, VkImageUsageFlags usage);
void device_free_image(const struct device *d, struct image i);

VkCommandBuffer device_begin(const struct device *d);
/* Runs the commands, waits, and frees them. */
void device_run(const struct device *d, VkCommandBuffer commands);
/* All writes before it are seen after it; the image also changes its layout. */
void device_wait(VkCommandBuffer commands);
void device_change_layout(VkCommandBuffer commands, const struct image *image, VkImageLayout from,
                          VkImageLayout to);
/* Pools of descriptor sets: for so many sets, of these types. */
VkDescriptorPool device_make_pool(const struct device *d, uint32_t num_sets,
                                  const VkDescriptorPoolSize *sizes, uint32_t num_sizes);
VkDescriptorSet device_make_set(const struct device *d, VkDescriptorPool pool,
                                VkDescriptorSetLayout layout);
void device_draw_ball(const struct device *d, VkCommandBuffer commands);

#endif
