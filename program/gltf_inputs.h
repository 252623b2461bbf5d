// SPDX-License-Identifier: Apache-2.0
/*
 * The inputs of gltf_pbr as members of glTF: materials of the specification (section 5.19), and the
 * ratified extensions KHR_materials_…
 * (github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Khronos). For export and import.
 */
#ifndef MXG_PROGRAM_GLTF_INPUTS_H
#define MXG_PROGRAM_GLTF_INPUTS_H

#include <stdbool.h>
#include <stddef.h>

/* Images that textures of a material share, by channels. */
enum gltf_image {
    GLTF_BASE,
    GLTF_SURFACE, /* occlusion, roughness, metallic */
    GLTF_NORMAL,
    GLTF_EMISSIVE,
    GLTF_CLEARCOAT,
    GLTF_CLEARCOAT_NORMAL,
    GLTF_SHEEN,
    GLTF_TRANSMISSION, /* and thickness */
    GLTF_SPECULAR,
    GLTF_IRIDESCENCE,
    GLTF_ANISOTROPY,
    GLTF_NUM_IMAGES
};
extern const struct gltf_image_kind {
    const char *name; /* of its file */
    bool is_srgb;
} gltf_images[GLTF_NUM_IMAGES];

/* Where an input of gltf_pbr goes. */
struct gltf_input {
    const char *name;
    const char *object;  /* of the material's JSON; "KHR_…": an extension; NULL: itself */
    const char *factor;  /* the member with its value; NULL: only a texture has it */
    const char *texture; /* the member with its texture; NULL: it must be a value */
    enum gltf_image image;
    unsigned channel;     /* of the image: its first */
    unsigned count;       /* of its numbers */
    unsigned at;          /* of the factor: its first number there */
    bool has_array;       /* the factor is an array, of which other inputs may be a part */
    float low, high;      /* the range of its numbers, a texture's too; an end may be infinite */
    bool or_zero;         /* 0 is allowed below the range, too */
    float value;          /* without the input */
    float omitted;        /* the value that glTF has without the member */
    const char *needs[2]; /* inputs that must not be 0, or this one does nothing */
};
extern const struct gltf_input gltf_inputs[];
extern const size_t gltf_num_inputs;
/* The row of an input, which the table has. */
const struct gltf_input *gltf_find_input(const char *name);

#endif
