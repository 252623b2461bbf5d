// SPDX-License-Identifier: Apache-2.0
/*
 * One draw call: a program, its inputs as plain data, and a picture of floats. Independent of
 * MaterialX.
 */
#ifndef MXG_RENDER_DRAW_H
#define MXG_RENDER_DRAW_H

#include "render/gpu.h"

#define DRAW_MAX_ATTRIBUTES 32
#define DRAW_MAX_BLOCKS 8
#define DRAW_MAX_TEXTURES 128
#define DRAW_MAX_SETS 4

struct draw_attribute {
    uint32_t location;
    VkFormat format; /* of the 16 bytes per vertex, as the shader reads them */
    void *data;      /* 16 bytes per vertex; malloc */
};

struct draw_block {
    uint32_t set, binding;
    unsigned char *data; /* malloc */
    size_t size;
};

struct draw_texture {
    uint32_t set, binding;
    const struct image *image;
    bool bottom_first;
    VkSamplerAddressMode u, v;
    VkFilter filter;
    bool has_mips;
};

struct draw {
    const uint32_t *code[2]; /* SPIR-V of the vertex and pixel stage */
    size_t code_words[2];
    uint32_t num_vertices, num_indices;
    const uint32_t *indices;
    struct draw_attribute attributes[DRAW_MAX_ATTRIBUTES];
    struct draw_block blocks[DRAW_MAX_BLOCKS];
    struct draw_texture textures[DRAW_MAX_TEXTURES];
    uint32_t num_attributes, num_blocks, num_textures;
    bool blend; /* colours are premultiplied, and triangles are sorted from far to near */
    uint32_t width, height;
};

struct draw_program;

/* Compiles the program and uploads its inputs; NULL: see gpu->reason. `draw` must outlive it. */
struct draw_program *draw_open(struct gpu *gpu, const struct draw *draw);

/*
 * Draws with the current blocks and indices to RGBA floats, top row first, cleared to 0. false: see
 * gpu->reason.
 */
bool draw_frame(struct draw_program *program, float *out_pixels);

void draw_close(struct draw_program *program);

#endif
