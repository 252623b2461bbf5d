// SPDX-License-Identifier: Apache-2.0
/*
 * The data that a host of MaterialX provides: a mesh with named attributes, a camera, lights, an
 * environment. Lookups use the names of the ShaderX convention, so a scene serves every shader with
 * these names.
 */
#ifndef MXG_RENDER_SCENE_H
#define MXG_RENDER_SCENE_H

#include "render/image.h"
#include "render/matrix.h"
#include "render/mesh.h"

#define SCENE_NUM_LIGHTS 3
#define SCENE_FRAME 33
#define SCENE_NEAR 1e-4 /* of a scene of size 1 */

/* Values of a geometric property. */
struct primvar {
    char *name;
    unsigned components; /* 0: it is no number, and has no values */
    bool is_integer;
    const char *type, *file; /* of USD, with its place; NULL: it comes from another file */
    int type_len;
    uint32_t line, column;
    uint32_t num;       /* 1: constant; otherwise those of the mesh's vertices */
    float (*values)[4]; /* malloc; an integer is a whole number */
};

/* An object that a draw call draws. */
struct scene_object {
    struct mesh mesh;
    struct matrix world; /* from the mesh to the world */
    struct primvar *primvars;
    uint32_t num_primvars;
    /*
     * its path on a stage, or its name: shaders get their defaults for attributes that it lacks.
     * NULL: an object for comparisons, with stand-ins for all attributes
     */
    const char *path;
    /* the texture coordinates are also the properties st, UVMap, uv and map1 */
    bool names_texcoords;
};

/* The types of lights, as numbers of --lights. */
enum light_type { LIGHT_DIRECTIONAL = 1, LIGHT_POINT, LIGHT_SPHERE = 4, LIGHT_DISK };

/* A light; each type uses some of the members. */
struct scene_light {
    enum light_type type;
    double direction[3]; /* not unit */
    double position[3], color[3], intensity, decay_rate;
    double radius, inner, outer; /* cosines of the angles of a cone; NO_CONE: none */
};
#define NO_CONE (-2.0)

struct scene {
    struct scene_object object;
    struct matrix view, projection;
    double eye[3], target[3];
    struct matrix studio; /* from the space of the lights to the world */
    double near;          /* a distance that nothing has */
    double unit;          /* centimetres in a unit of the world; 0: 1 */
    uint32_t num_lights;
    const struct scene_light *site_lights; /* NULL: the studio's */
    uint32_t num_site_lights;
    uint32_t environment_samples;
    int32_t frame;
    double layer_sample; /* picks a layer of each stack; below 0: another number at each point */
    struct matrix environment;         /* rotates world directions to directions in the map */
    struct image radiance, irradiance; /* latitude-longitude, first row towards +y */
    struct image albedo;               /* of GGX; only for shaders that read it */
    struct image texture;              /* replaces every texture of the document; may be empty */
};

/*
 * A unit sphere in daylight with three lights, and a camera of the given aspect ratio: the scene of
 * shading comparisons.
 */
bool scene_init_sphere(struct scene *scene, double aspect);

/*
 * A quad that fills the picture, 4x4 cells, with linear attributes: the scene of value comparisons.
 */
bool scene_init_grid(struct scene *scene);

/*
 * A quad that fills the picture, (s, t) from (0, 0) to (1, 1), with a texture in place of the
 * document's.
 */
bool scene_init_plane(struct scene *scene);

void scene_finish(struct scene *scene);
void object_finish(struct scene_object *object);
/* The primvar of an object by its name; NULL: there is none. */
const struct primvar *object_primvar(const struct scene_object *object, const char *name);
/* Frees the last primvars of an object, and the list if there are any. */
void object_finish_primvars(struct scene_object *object, uint32_t num);
/* Adds a primvar of zeros for each vertex of the object's mesh. `type` is a constant. */
struct primvar *object_add_primvar(struct scene_object *object, const char *name, const char *type,
                                   unsigned components);
/*
 * Adds the parts that its mesh lacks (mesh_complete), with its primvars. A flat object gets a
 * vertex for each corner first.
 */
void object_complete(struct scene_object *object, unsigned missing, bool is_flat);
/* A copy of an object for displacement: with at least so many triangles, welded. */
void object_refine(const struct scene_object *object, uint32_t wanted, struct scene_object *out);

/* Moves the camera, and points it at the target. */
void scene_set_camera(struct scene *scene, const double eye[3], const double target[3]);

/*
 * The name under which the scene has a variable: "i_geomprop_st" for the semantic "geomprop:st",
 * which several variables may have; else its own. It may be written to the buffer, cut off there.
 */
enum { SCENE_MAX_NAME = 256 };
const char *scene_name(const char *name, const char *semantic, char buffer[SCENE_MAX_NAME]);
/* The name of the primvar that an attribute reads: "st1" of "i_texcoord_1". */
void scene_primvar_name(const char *attribute, char out[SCENE_MAX_NAME]);
/* Attributes that are the texture coordinates by another name, "i_geomprop_st"…; NULL after the
 * last. */
extern const char *const scene_texcoords[];
bool scene_is_texcoord(const char *attribute);
/* The primvar that an attribute reads; NULL: the object has none. */
const struct primvar *scene_primvar(const struct scene_object *object, const char *attribute);

/*
 * Attribute "i_texcoord_0", "i_geomprop_st"… of a vertex; keeps other components. false: the object
 * has no such attribute.
 */
bool scene_attribute(const struct scene_object *object, const char *name, uint32_t vertex,
                     float out[4]);

/*
 * Private uniform "u_worldMatrix"…; returns the number of written components, 0 if the scene has
 * none.
 */
unsigned scene_uniform(const struct scene *scene, const struct scene_object *object,
                       const char *name, float out[16]);

/*
 * Member "direction"… of a light of any index; the studio's three, or those of a stage, repeat.
 * Returns the number of written components, 0 if the light has none.
 */
unsigned scene_light(const struct scene *scene, uint32_t index, const char *member, float out[3]);

/* Texture "u_envRadiance"…; NULL if the scene has none. */
const struct image *scene_image(const struct scene *scene, const char *name);

/* The radiance of the environment at (x, y) of the picture, from -1 to 1, y upwards. */
void scene_backdrop(const struct scene *scene, double x, double y, double out[3]);

/* environment.c: maps of a clear sky. False: out of memory. */
bool environment_make(struct image *radiance, struct image *irradiance);
/* A map of one value all around. */
bool environment_make_plain(float value, struct image *out);
/* The radiance from direction d (unit). */
void environment_radiance(const double d[3], float out[3]);
/* The direction of a texel's centre. */
void environment_direction(const struct image *map, uint32_t x, uint32_t y, double out[3]);
/* The radiance of the map from direction d (unit), interpolated. */
void environment_lookup(const struct image *map, const double d[3], double out[3]);
/*
 * Reads a latitude-longitude map of linear values; 8-bit files are sRGB. On failure returns false
 * and the reason.
 */
bool environment_read(const char *path, struct image *out, char *reason, size_t capacity);
/* The cosine-weighted average of a map around each direction. */
bool environment_irradiance(const struct image *radiance, struct image *out);
/* A smooth texture without symmetry, so that a wrong orientation is visible. */
bool environment_make_test_texture(struct image *out);

#endif
