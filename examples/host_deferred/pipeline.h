// SPDX-License-Identifier: Apache-2.0
/* The deferred pipeline of mxgen on Vulkan: its resources and passes, from the reflection alone. */
#ifndef HOST_DEFERRED_PIPELINE_H
#define HOST_DEFERRED_PIPELINE_H

#include "../host_vulkan/program.h"

#include <mxgen/passes.h>
#include <mxgen/storage.h>

enum { MAX_RESOURCES = 24, MAX_PASSES = 24, MAX_SETS = 2 * MAX_PASSES };

/* A resource that the passes share; `image` or `buffer`, as its kind says. */
struct resource {
    mxg_pass_resource info;
    VkDescriptorType type;
    struct image image;
    struct buffer buffer;
};

/* A compute stage, with the uniforms and textures of its result. */
struct stage {
    mxg_result *result;
    struct program program;
    struct buffer uniforms;
    VkDescriptorSet set;
};

struct pipeline {
    struct device *device;
    uint32_t width, height, num_tiles;
    struct resource resources[MAX_RESOURCES];
    uint32_t num_resources;
    struct image depth;
    VkDescriptorPool pool;
    VkDescriptorSetLayout sets[2]; /* set 1: the resources; set 2: of the host, target 0 */
    VkDescriptorSet resource_set, host_set;
    VkRenderPass depth_pass, material_pass;
    VkFramebuffer depth_frame, material_frame;
    struct stage passes[MAX_PASSES]; /* by index of the catalogue; without result: not needed */
    struct stage decal;
};

/* num_words: the most of all materials. */
void pipeline_open(struct pipeline *p, struct device *device, uint32_t width, uint32_t height,
                   uint32_t num_words);
void pipeline_close(struct pipeline *p);

/*
 * The passes for these classes of pixels, and for the decal if there is one, with the functions of
 * the host behind their texts; takes what the passes know of the viewer from `view`.
 */
struct view {
    float position[3];
    float to_world[16]; /* from pixels and depth: a matrix by columns */
};
void pipeline_make_passes(struct pipeline *p, mxg_context *context, const mxg_options *options,
                          uint32_t classes, const char *host_functions, const struct view *view);
/* The decal stage: the source of a payload, then that of the host. Takes the result. */
void pipeline_make_decal(struct pipeline *p, mxg_result *payload, const char *host_stage);

/* show: a word of mx_show, or NULL for the picture. The material pass has ended. */
void pipeline_light(struct pipeline *p, VkCommandBuffer commands, const char *show);

const struct resource *pipeline_resource(const struct pipeline *p, const char *name);

#endif
