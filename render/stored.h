// SPDX-License-Identifier: Apache-2.0
/*
 * The images of the deferred pipeline on the device, and its compute passes over them
 * (docs/deferred.md). Independent of MaterialX. All images stay in the layout GENERAL.
 */
#ifndef MXG_RENDER_STORED_H
#define MXG_RENDER_STORED_H

#include "render/draw.h"
#include "render/descriptors.h"

enum {
    STORED_TARGETS = 3,
    STORED_DECAL_IMAGES = 4,
    STORED_CLASSES = 5,
    STORED_TILE = 8,
    STORED_MAX_PASSES = 12
};
enum { STORED_PAYLOAD_SIZE = 64 }; /* bytes of a ray */

enum {
    STORED_ALL_TILES = -1,
    STORED_FIRST = -2 /* all tiles, before the materials: decals in images of their own */
};

/* A compute pass. Its draw has no code. */
struct stored_pass {
    const uint32_t *code;
    size_t code_words;
    const struct draw *draw; /* blocks and textures; outlives the pass */
    int which;               /* the class of its tiles, or: */
};

struct stored;

/* The values that all passes share. */
struct stored_frame {
    float to_world[16]; /* from (x, y, depth, 1), in pixels, column by column */
    uint32_t shown;     /* number of the debug view */
};

/*
 * Images for pictures of this size, with so many words per pixel beside the targets. color and
 * depth belong to the caller: passes write the former. NULL: see gpu->reason.
 */
struct stored *stored_open(struct gpu *gpu, uint32_t width, uint32_t height, uint32_t words,
                           const struct gpu_image *color, const struct gpu_image *depth);
void stored_close(struct stored *stored);
/*
 * Makes room for the payload of a ray per pixel, which a pass writes and another one lights. The
 * words of all payloads, row by row, as the last frame wrote them. NULL: see gpu->reason.
 */
uint32_t *stored_hold_rays(struct stored *stored);
bool stored_add_pass(struct stored *stored, const struct stored_pass *pass);

/* Set 1 of the material passes and of the compute passes. */
VkDescriptorSetLayout stored_set_layout(const struct stored *stored);
VkDescriptorSet stored_set(const struct stored *stored);
/* The targets of a material pass: the colour, then three words. Cleared to 0 by the pass. */
VkImageView stored_target(const struct stored *stored, unsigned target);
VkFormat stored_target_format(unsigned target);

/* For tests: what no material writes has this word, and the words of a pixel after a frame. */
void stored_mark(struct stored *stored, uint32_t mark);
bool stored_read(struct stored *stored, uint32_t x, uint32_t y, uint32_t *out, uint32_t count);

void stored_update(struct stored *stored, const struct stored_frame *frame);
/*
 * Makes images and lists of tiles ready to be written, except the images of the caller, and runs
 * the first passes.
 */
void stored_begin(const struct stored *stored, VkCommandBuffer commands);
/* Runs the other passes. All run in the order in which they were added. */
void stored_run(const struct stored *stored, VkCommandBuffer commands);
/* Writes before the barrier are visible to reads after it. */
void stored_barrier(VkCommandBuffer commands);

#endif
