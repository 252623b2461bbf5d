// SPDX-License-Identifier: Apache-2.0
/* Vulkan pipelines from results of mxgen: what a host reads in the reflection. */
#ifndef HOST_VULKAN_PROGRAM_H
#define HOST_VULKAN_PROGRAM_H

#include "gpu.h"

#include <mxgen/mxgen.h>

/* The blocks of uniforms, whose binding is their index here in every shader. */
enum { NUM_UNIFORM_BLOCKS = 3 };
extern const mxg_block uniform_blocks[NUM_UNIFORM_BLOCKS];

struct program {
    uint64_t topology; /* of all results that it draws */
    VkDescriptorSetLayout set_layout;
    VkPipelineLayout layout;
    VkPipeline pipeline;
};

/* `result` has its source. Ends the program if the source does not compile. */
void program_make(const struct gpu *g, const mxg_result *result, struct program *out);
void program_free(const struct gpu *g, struct program *p);

/* The bytes that a block takes in a buffer: 0 if the shader lacks it, else a multiple of 256. */
uint32_t program_block_size(const mxg_result *result, mxg_block block);
/* Geometry attributes that the mesh lacks; each takes 16 bytes in a buffer. */
uint32_t program_num_constants(const mxg_result *result);
/* Writes the values of these attributes. */
void program_write_constants(const mxg_result *result, unsigned char *out);

/* Fills a descriptor set: blocks at `offsets` of a buffer, the checkerboard for textures. */
void program_bind(const struct gpu *g, const mxg_result *result, VkBuffer uniforms,
                  const uint32_t *offsets, VkDescriptorSet set);

#endif
