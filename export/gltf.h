// SPDX-License-Identifier: Apache-2.0
/*
 * glTF 2.0 (Khronos, glTF 2.0 Specification, 2.0.1) of a flat document whose surfaces are gltf_pbr.
 * gltf.c has the whole and its files, gltf_material.c the materials, gltf_inputs.c where each input
 * goes, gltf_mesh.c the geometry.
 */
#ifndef MXG_EXPORT_GLTF_H
#define MXG_EXPORT_GLTF_H

#include "export/flat.h"
#include "export/texture.h"
#include "export/write.h"
#include "program/json.h"

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
    bool is_open;         /* it may be greater than 1, also in a texture */
    float value;          /* without the input */
    float omitted;        /* the value that glTF has without the member */
    const char *needs[2]; /* inputs that must not be 0, or this one does nothing */
};
extern const struct gltf_input gltf_inputs[];
extern const size_t gltf_num_inputs;

struct gltf_texture_file {
    char *key; /* texture_key */
    char *name;
    struct texture_file file;
};

struct gltf {
    const struct flat *flat;
    struct writing *writing;
    json_t *root;
    uint8_t *bytes; /* of the buffer */
    size_t num_bytes, capacity;
    struct gltf_texture_file *files;
    size_t num_files;
};

/* The member of an object, made if it is missing. */
json_t *gltf_object(json_t *object, const char *key);
json_t *gltf_array(json_t *object, const char *key);
/* Appends `value`, which it takes, and returns its index; equal values are one. */
size_t gltf_add(json_t *array, json_t *value);
/* Appends a part of the buffer. `target`: what it is for; 0: an image. Returns its index. */
size_t gltf_add_view(struct gltf *gltf, const void *data, size_t size, int target);

/* Adds a material. *out_tangents: it has maps of normals, or highlights with a direction. false
 * after reporting an error. */
bool gltf_add_material(struct gltf *gltf, const struct flat_material *material, bool *out_tangents);

/* Adds a node for each material, side by side, with the objects of the surface. */
void gltf_add_nodes(struct gltf *gltf, const bool *tangents);

#endif
