// SPDX-License-Identifier: Apache-2.0
/*
 * glTF 2.0 (Khronos, glTF 2.0 Specification, 2.0.1) of a flat document whose surfaces are gltf_pbr.
 * gltf.c has the whole and its files, gltf_material.c the materials, gltf_mesh.c the geometry,
 * gltf_stage.c that of a stage;
 * program/gltf_inputs.c says where each input goes.
 */
#ifndef MXG_EXPORT_GLTF_H
#define MXG_EXPORT_GLTF_H

#include "export/flat.h"
#include "export/texture_image.h"
#include "export/write.h"
#include "program/gltf_inputs.h"
#include "program/json_values.h"
#include "program/memory.h"

struct gltf_texture_file {
    char *key; /* texture_key */
    char *name;
    struct texture_file file;
};

struct gltf {
    const struct flat *flat;
    struct writing *writing;
    json_t *root;
    struct memory_bytes buffer;
    struct gltf_texture_file *files;
    size_t num_files;
};

/* The member of an object, made if it is missing. */
json_t *gltf_object(json_t *object, const char *key);
json_t *gltf_array(json_t *object, const char *key);
/* Appends `value`, which it takes, and returns its index. */
size_t gltf_append(json_t *array, json_t *value);
/* As gltf_append; equal values have one index. */
size_t gltf_add(json_t *array, json_t *value);
/* Appends a part of the buffer. `target`: what it is for; 0: an image. Returns its index. */
size_t gltf_add_view(struct gltf *gltf, const void *data, size_t size, int target);

/* Adds a material. *out_tangents: it has maps of normals, or highlights with a direction. false
 * after reporting an error. */
bool gltf_add_material(struct gltf *gltf, const struct flat_material *material, bool *out_tangents);

/* Adds the geometry. `tangents`: the materials that need some. */
void gltf_add_nodes(struct gltf *gltf, const bool *tangents);
/* An object as a primitive without a material. */
json_t *gltf_make_primitive(struct gltf *gltf, const struct scene_object *object,
                            bool has_tangents);
/* Adds a node to the scene. */
void gltf_add_root(struct gltf *gltf, size_t node);

/* gltf_stage.c: a node for each object of the stage. */
void gltf_add_stage(struct gltf *gltf, const bool *tangents);

#endif
