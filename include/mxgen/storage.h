// SPDX-License-Identifier: Apache-2.0
/*
 * The storage of the deferred pipeline: what shaders store, and where (docs/deferred.md of the
 * project).
 */
#include <mxgen/mxgen.h>

#ifndef MXGEN_STORAGE_H
#define MXGEN_STORAGE_H

#ifdef __cplusplus
extern "C" {
#endif

/* A shader stores this per pixel for the passes, or a pass reads it. */
typedef struct mxg_storage {
    size_t size; /* in */
    /* of 32 bits per pixel, at most, or of the payload; 0: the shader lights itself */
    uint32_t words;
    uint32_t layout; /* of the words: equal in all materials and passes that fit together */
    /*
     * Classes of pixels, as bits, by the number of their command in the buffer `tiles`: those that
     * a material may store, or that a pass lights. A pass whose classes no material of a picture
     * has need not run. 0: of other passes.
     */
    uint32_t classes;
} mxg_storage;
/* MXG_ERROR_ARGUMENT: the result has no shader. */
MXG_API mxg_status mxg_result_storage(const mxg_result *result, mxg_storage *out);

/*
 * A resource that the passes share, and material passes write, in descriptor set binding-set + 1 of
 * the target vulkan. Its binding is its index. The JSON of a pass has the same.
 */
typedef struct mxg_pass_resource {
    size_t size;      /* in */
    const char *name; /* "words" */
    const char *kind; /* "image2D", "image2DArray", "sampler2D", "buffer" or "uniform" */
    /* "r32ui"; "any": every format of floats; "std430", "std140": of buffers; "": of samplers */
    const char *format;
    const char *doc;
    uint32_t num_layers;  /* of "image2DArray"; 0 of "words": as many as the materials need */
    uint32_t byte_size;   /* of a buffer, without its arrays per tile or pixel */
    uint32_t num_members; /* of a buffer */
} mxg_pass_resource;
MXG_API uint32_t mxg_catalogue_num_pass_resources(void);
MXG_API mxg_status mxg_catalogue_pass_resource(uint32_t index, mxg_pass_resource *out);

/* A member of a buffer. */
typedef struct mxg_pass_member {
    size_t size;        /* in */
    const char *name;   /* as in the source: "mx_to_world" */
    const char *type;   /* "mat4", or the name of a struct */
    const char *values; /* the words of its numbers, from 0, separated by '|'; "": any number */
    const char *doc;
    const char *per; /* "tile" or "pixel": the array is as long for each of them; "": one array */
    uint32_t offset; /* in bytes, from the buffer or the struct */
    uint32_t array_length, array_stride; /* 0: no array */
    uint32_t matrix_stride;              /* 0: no matrix */
    /* in the struct that is the type of the last member before that is not nested */
    bool is_nested;
} mxg_pass_member;
MXG_API mxg_status mxg_catalogue_pass_member(uint32_t resource, uint32_t index,
                                             mxg_pass_member *out);

#ifdef __cplusplus
}
#endif

#endif
