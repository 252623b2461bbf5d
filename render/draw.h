// SPDX-License-Identifier: Apache-2.0
/*
 * Draw calls: programs, their inputs as plain data, and a picture of floats. Independent of
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
};

struct draw_block {
    uint32_t set, binding;
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

/* A mesh, with the values that the program reads for it. */
struct draw_object {
    /* 1 + an object before it, which has the attributes, and the indices unless programs blend */
    uint32_t twin;
    uint32_t num_vertices, num_indices;
    const uint32_t *indices;
    void *attributes[DRAW_MAX_ATTRIBUTES];  /* 16 bytes per vertex; malloc */
    unsigned char *blocks[DRAW_MAX_BLOCKS]; /* malloc */
    double distance;                        /* from the camera, where programs blend */
};

enum draw_role {
    DRAW_LIT,    /* draws to the picture */
    DRAW_STORES, /* writes to the images of stored.h */
    DRAW_CUTS    /* draws the depth of a program that stores and has holes */
};

/* A program for several objects. */
struct draw {
    const uint32_t *code[2]; /* SPIR-V of the vertex and pixel stage */
    size_t code_words[2];
    struct draw_attribute attributes[DRAW_MAX_ATTRIBUTES];
    struct draw_block blocks[DRAW_MAX_BLOCKS];
    struct draw_texture textures[DRAW_MAX_TEXTURES];
    uint32_t num_attributes, num_blocks, num_textures;
    struct draw_object *objects; /* malloc */
    uint32_t num_objects;
    bool has_holes;     /* of DRAW_STORES: another program draws its depth */
    bool stores_layers; /* of DRAW_STORES: in an image, where one fragment of a pixel may write */
    bool blends_twice;  /* with a second source: what the surface lets through */
    bool blend;         /* colours are premultiplied, and triangles are sorted from far to near */
    enum draw_role role;
};

struct stored;

struct draw_canvas;
struct draw_program;

/* A picture of this size on the device; NULL: see gpu->reason. */
struct draw_canvas *draw_open_canvas(struct gpu *gpu, uint32_t width, uint32_t height);
struct gpu *draw_gpu(const struct draw_canvas *canvas);
void draw_size(const struct draw_canvas *canvas, uint32_t *out_width, uint32_t *out_height);
/* Images for programs that store so many words per pixel. NULL: see gpu->reason. */
struct stored *draw_store(struct draw_canvas *canvas, uint32_t words);
void draw_close_canvas(struct draw_canvas *canvas);

/* How the fragments of a further output are put together. */
enum draw_output {
    DRAW_BLENDED, /* floats, which blend as the colour does */
    DRAW_FLOATS,  /* floats; the last fragment counts */
    DRAW_WHOLE    /* one integer; the last fragment counts */
};
#define DRAW_MAX_OUTPUTS 8 /* with the colour; every device has so many attachments */
/* Adds an output at the next location, from 1 on; before draw_open. false: see gpu->reason. */
bool draw_add_output(struct draw_canvas *canvas, enum draw_output kind);
/* The RGBA floats of output `location` of the last frame, top row first; an integer is red. */
void draw_read_output(const struct draw_canvas *canvas, uint32_t location, float *out_pixels);

/* Compiles the program and uploads its inputs; NULL: see gpu->reason. `draw` must outlive it. */
struct draw_program *draw_open(struct draw_canvas *canvas, const struct draw *draw);

/* Sets the colour where the next frames draw nothing; transparent black by default. */
void draw_clear_to(struct draw_canvas *canvas, const float rgba[4]);

/*
 * Draws all objects of the programs with the current blocks and indices to RGBA floats, top row
 * first: programs that store, with the passes over what they stored; opaque programs;
 * then the objects of the others from far to near. false: see gpu->reason.
 */
bool draw_frame(struct draw_canvas *canvas, struct draw_program *const *programs, size_t count,
                float *out_pixels);

/*
 * Measures the last frame on the device, in seconds, without the copy of its picture. false: the
 * device has no clock.
 */
bool draw_frame_seconds(const struct draw_canvas *canvas, double *out);

void draw_close(struct draw_program *program);

#endif
