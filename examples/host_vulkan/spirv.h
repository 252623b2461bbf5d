// SPDX-License-Identifier: Apache-2.0
#ifndef HOST_VULKAN_SPIRV_H
#define HOST_VULKAN_SPIRV_H

#include <stddef.h>
#include <stdint.h>
#include <vulkan/vulkan.h>

/* Compiles a stage of Vulkan's GLSL. The caller frees the words. NULL: an error, which is printed.
 */
uint32_t *compile_spirv(const char *source, VkShaderStageFlagBits stage, size_t *out_bytes);

#endif
