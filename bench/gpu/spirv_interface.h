// SPDX-License-Identifier: Apache-2.0
/* The resources, vertex inputs and pixel outputs of a SPIR-V module, which a pipeline must know. */
#ifndef MXG_BENCH_GPU_SPIRV_INTERFACE_H
#define MXG_BENCH_GPU_SPIRV_INTERFACE_H

#include <stdbool.h>
#include <stddef.h>
#include <vulkan/vulkan.h>

enum { MAX_SETS = 8, MAX_RESOURCES = 64, MAX_INPUTS = 32, MAX_OUTPUTS = 8 };

struct resource {
    uint32_t set;
    VkDescriptorSetLayoutBinding layout;
};

struct shader_interface {
    struct resource resources[MAX_RESOURCES];
    uint32_t num_resources;
    struct {
        uint32_t location, components;
    } inputs[MAX_INPUTS];
    uint32_t num_inputs;
    uint32_t num_outputs;
    bool is_integer[MAX_OUTPUTS]; /* by location */
};

/*
 * Adds the interface of a module of `num_words` words to `out`: inputs of vertex modules and
 * outputs of pixel modules. False: it is no SPIR-V, or has more than the limits above.
 */
bool interface_of_module(const uint32_t *words, size_t num_words, VkShaderStageFlagBits stage,
                         struct shader_interface *out);

#endif
