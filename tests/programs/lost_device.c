// SPDX-License-Identifier: Apache-2.0
/*
 * Preloaded in front of the Vulkan loader: the driver loses its device when work number LOST_DEVICE
 * is waited for, counted from 1.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdlib.h>
#include <vulkan/vulkan.h>

VkResult vkQueueWaitIdle(VkQueue queue)
{
    static int calls;
    static PFN_vkQueueWaitIdle real;
    if (!real)
        *(void **)&real = dlsym(RTLD_NEXT, "vkQueueWaitIdle");
    VkResult result = real(queue);
    const char *lost = getenv("LOST_DEVICE");
    return lost && ++calls >= atoi(lost) ? VK_ERROR_DEVICE_LOST : result;
}
