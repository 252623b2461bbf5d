// SPDX-License-Identifier: Apache-2.0
/* Vulkan pipelines from results of mxgen: what a host reads in the reflection. */
#ifndef HOST_VULKAN_PROGRAM_H
#define HOST_VULKAN_PROGRAM_H

#include "device.h"

#include <mxgen/mxgen.h>

/* The blocks of uniforms, whose binding is their index here in every shader. */
enum { NUM_UNIFORM_BLOCKS = 3 };
extern const mxg_block uniform_blocks[NUM_UNIFORM_BLOCKS];

/* Where a program draws. */
struct target {
    VkRenderPass pass;
    uint32_t width, height, num_colors;
    VkCompareOp depth_test;
    bool writes_depth;
    VkDescriptorSetLayout set_1; /* of the host; NULL: there is none */
};

struct program {
    uint64_t topology; /* of all results that it draws */
    VkDescriptorSetLayout set_layout;
    VkPipelineLayout layout;
    VkPipeline pipeline;
};

/* A stage from source. */
VkShaderModule program_make_module(const struct device *d, const char *source,
                                   VkShaderStageFlagBits stage);
/* The layouts of the uniforms and textures of a result, and of the host's set 1 and 2, or NULL. */
void program_make_layouts(const struct device *d, const mxg_result *result,
                          VkShaderStageFlags stages, const VkDescriptorSetLayout *host_sets,
                          uint32_t num_host_sets, struct program *p);
/* `result` has its source; without a pixel stage only its depth is drawn. Ends the program if the
 * source does not compile. */
void program_make(const struct device *d, const mxg_result *result, const struct target *target,
                  struct program *out);
void program_free(const struct device *d, struct program *p);

/* The bytes that a block takes in a buffer: 0 if the shader lacks it, else a multiple of 256. */
uint32_t program_block_size(const mxg_result *result, mxg_block block);
/* Gives the blocks their places in a buffer, from `first` on. Returns where they end. */
uint32_t program_place_blocks(const mxg_result *result, uint32_t first, uint32_t *out_offsets);
/*
 * Fills a block: defaults first, which are the document's values for the public block, then the
 * values of the host. `value_of` returns their number; 0: the default stays.
 */
typedef uint32_t program_value_of(void *user_data, const mxg_variable *variable, float values[16]);
void program_fill_block(const mxg_result *result, mxg_block block, program_value_of *value_of,
                        void *user_data, unsigned char *bytes);
/* Geometry attributes that the mesh lacks; each takes 16 bytes in a buffer. */
uint32_t program_num_constants(const mxg_result *result);
/* Writes the values of these attributes. */
void program_write_constants(const mxg_result *result, unsigned char *out);

/* Fills a descriptor set: blocks at `offsets` of a buffer, the checkerboard for textures. */
void program_bind(const struct device *d, const mxg_result *result, VkBuffer uniforms,
                  const uint32_t *offsets, VkDescriptorSet set);
/* Draws a ball. The buffer of its uniforms has its constant attributes at this offset. */
void program_draw_ball(const struct device *d, VkCommandBuffer commands, const struct program *p,
                       const VkDescriptorSet *sets, uint32_t num_sets, VkBuffer uniforms,
                       VkDeviceSize constants);

/* Prints diagnostics that are at least so severe. */
void program_print(const mxg_diagnostics *list, mxg_severity least);

#endif
