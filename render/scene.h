// SPDX-License-Identifier: Apache-2.0
/*
 * What is drawn, as a host of MaterialX sees it: a mesh with named attributes, a camera, lights, an environment. Values
 * are asked for by the names of the ShaderX convention, so a scene serves every shader that keeps them.
 */
#ifndef MXG_RENDER_SCENE_H
#define MXG_RENDER_SCENE_H

#include "render/image.h"
#include "render/matrix.h"

#define SCENE_NUM_LIGHTS 3

struct scene {
    struct matrix world, view, projection;
    double eye[3], target[3];
    uint32_t num_vertices, num_indices;
    float (*parameters)[2]; /* (s, t) of each vertex */
    uint32_t *indices;      /* triangles, counter-clockwise from outside */
    void (*geometry)(float s, float t, float position[3], float normal[3], float tangent[3], float bitangent[3]);
    void (*texcoord)(float s, float t, float out[2]); /* texcoord_0 */
    uint32_t num_lights;
    uint32_t environment_samples;
    struct image radiance, irradiance; /* latitude-longitude, first row towards +y */
    struct image texture;              /* what every texture of the document shows; may have none */
};

/* A unit sphere in daylight with three lights, seen by a camera of the given aspect ratio. */
bool scene_init_sphere(struct scene *scene, double aspect);

/* A quad over the whole picture, 4x4 cells, whose attributes are linear; what values of nodes are sampled on. */
bool scene_init_grid(struct scene *scene);

/* A quad over the whole picture, (s, t) from (0, 0) to (1, 1), with a texture instead of those of the document. */
bool scene_init_plane(struct scene *scene);

void scene_finish(struct scene *scene);

/* Attribute "i_texcoord_0", "i_geomprop_st"… of a vertex; unset components stay. False: the scene has no such
 * attribute. */
bool scene_attribute(const struct scene *scene, const char *name, uint32_t vertex, float out[4]);

/* Private uniform "u_worldMatrix"…; returns how many components it wrote, 0 where the scene has none. */
unsigned scene_uniform(const struct scene *scene, const char *name, float out[16]);

/* Member "direction"… of light `index` below num_lights; returns how many components it wrote, 0 where a light has
 * none. */
unsigned scene_light(uint32_t index, const char *member, float out[3]);

/* Texture "u_envRadiance"…; NULL where the scene has none. */
const struct image *scene_image(const struct scene *scene, const char *name);

/* environment.c: maps of a clear sky. False: out of memory. */
bool environment_make(struct image *radiance, struct image *irradiance);
/* The radiance from direction d (unit). */
void environment_radiance(const double d[3], float out[3]);
/* A smooth texture without symmetry, so that a wrong orientation shows. */
bool environment_make_test_texture(struct image *out);

#endif
