// SPDX-License-Identifier: Apache-2.0
/* A Vulkan device with a picture that is drawn at once. Nothing here knows mxgen. */
#ifndef HOST_VULKAN_GPU_H
#define HOST_VULKAN_GPU_H

#include "device.h"

enum { SIZE = 640 }; /* pixels of the picture, in both directions */

struct gpu {
    struct device device;
    VkRenderPass pass;
    VkFramebuffer frame;
    struct image color, depth;
    struct buffer readback;
};

void gpu_open(struct gpu *g);
void gpu_close(struct gpu *g);

/* Runs the commands, and writes the drawn picture as PPM. */
void gpu_write_picture(struct gpu *g, VkCommandBuffer commands, const char *path);

#endif
