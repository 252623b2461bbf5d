// SPDX-License-Identifier: Apache-2.0
/*
 * The site of `--stage`: the objects of a scene, one for each primitive with geometry, and a
 * camera. Files of USD come through mxgen.h, those of glTF through import/, others through Assimp.
 */
#ifndef MXG_RENDER_SITE_H
#define MXG_RENDER_SITE_H

#include "program/cli.h"
#include "program/name_table.h"
#include "render/studio.h"

/* An instance of a PointInstancer, as long as objects are parts of it. */
struct site_instance {
    uint32_t instancer, above; /* above: the instance around it, 1 + index; 0: none */
    size_t number;
    double id;
};

struct site_object {
    struct scene_object object;
    uint32_t primitive;        /* of the scene */
    uint32_t instance;         /* the innermost one, 1 + index; 0: none */
    bool shares_mesh;          /* an object before it has the mesh */
    bool shares_primvars;      /* and the primvars, without the last ones: */
    uint32_t num_own_primvars; /* those of an instance alone */
    unsigned made;             /* parts that its mesh lacks in the file: bits of enum mesh_part */
};

struct site_camera {
    struct matrix world;  /* it looks along -z, with y upwards */
    double width, height; /* tangents of half its angles */
    double centre[2];     /* of the frame, as tangents: the shift of the lens */
    char *path;
};

struct site {
    struct report *report;
    mxg_context *context; /* which says what the stage may refer to */
    const char *file;
    uint64_t file_size; /* bytes of the file and of those that it refers to */
    mxg_scene *scene;
    struct site_object *objects;
    uint32_t num_objects;
    struct site_instance *instances; /* in the order of the walk */
    uint32_t num_instances;
    uint32_t num_primitives; /* of the scene, without those of instances that a look names */
    struct site_camera *cameras;
    uint32_t num_cameras;
    struct scene_light *lights;
    uint32_t num_lights;
    struct image dome;        /* the environment; no pixels: none */
    struct matrix dome_world; /* from USD's map to the world: a rotation */
    bool has_dome, is_lit;    /* is_lit: it has lights, also such as are left out */
    bool lights_scene;        /* they are the light of the picture */
    struct name_table shapes; /* by type and size: 1 + the first object with this mesh */
    double meters_per_unit;   /* 0: unknown */
    bool is_z_up;
    bool has_fault;         /* an error was reported */
    uint64_t num_triangles; /* of all objects */
};

/*
 * Reads a file, as scene_file_load does. `purpose` as for mxg_scene_load. false after reporting an
 * error. Call site_close in any case.
 */
bool site_open(struct site *site, struct cli *cli, const char *path, const char *purpose);
void site_close(struct site *site);
/* Prints the paths of the primitives, one in each line. */
void site_list(const struct site *site);

/*
 * Lights the scene: by the site where it has lights, unless `studio` has a map; by the studio
 * otherwise. false after reporting an error.
 */
bool site_light(struct site *site, const struct studio *studio, struct scene *scene);

/*
 * Places the camera around the site, and the light of the studio. `camera` is the path of
 * a camera; NULL: the first, or the studio's, which also stands in where the site has none;
 * `is_orbit` takes the studio's. The origin of the world moves near a camera that is far from it.
 * false after reporting an error.
 */
bool site_aim(struct site *site, const struct studio *studio, const char *camera, bool is_orbit,
              double aspect, struct scene *scene);

/* ---- Shared by the readers ---- */

/*
 * Counts what a new object has. false after an error: the stage is larger than mxgen draws, or a
 * fault came before.
 */
bool site_has_room(struct site *site, uint32_t primitive, uint64_t num_triangles);
/* A new object of a primitive, which the caller fills: its path is set. */
struct scene_object *site_add(struct site *site, uint32_t primitive, struct matrix world);
/* Adds an object again, for a primitive and in a place. false: there is no room. */
bool site_share(struct site *site, uint32_t object, uint32_t primitive, struct matrix world);
/*
 * Adds objects again in another place, as an instance does: `num` of them from `first` on.
 */
void site_repeat(struct site *site, uint32_t first, uint32_t num, struct matrix world);
/* The primitive whose layers an object has: that of its instance, if a look names it. */
uint32_t site_bound_primitive(const struct site *site, const struct site_object *object);
/* Reports a fault of a primitive, at the property's place if it is not NULL. */
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
void site_fail(struct site *site, uint32_t primitive, const char *property, const char *format,
                ...);

/* Reports a warning, with an id of its own. */
#if defined(__GNUC__)
__attribute__((format(printf, 5, 6)))
#endif
void site_warn(struct site *site, const char *id, uint32_t primitive, const char *property,
                const char *format, ...);
void site_add_light(struct site *site, struct scene_light light);
/*
 * Adds a light of glTF (KHR_lights_punctual) or Assimp: the colour of a directional one is its
 * illuminance, that of a LIGHT_POINT its intensity.
 */
void site_add_lamp(struct site *site, struct scene_light light);
/* Adds a camera, and takes the path, which it frees. */
void site_add_camera(struct site *site, struct site_camera camera);
/* From the site to a world with y upwards. */
struct matrix site_upright(const struct site *site);
/* Rotation and place without scale. */
struct matrix site_rigid(struct matrix m);

/* site_usd.c: adds the objects, cameras and lights of a scene of USD. */
void site_read_usd(struct site *site);
/*
 * site_gltf.c and site_import.c: read a file of glTF, or another one through Assimp, with its
 * hierarchy as paths. false after reporting an error.
 */
bool site_read_gltf(struct site *site);
bool site_import(struct site *site);

/* ---- One mesh ---- */

/*
 * site_mesh.c: reads a file, and joins its objects to one with their primvars, which fits into the
 * unit sphere. false after reporting an error. Call object_finish in any case.
 */
bool site_open_mesh(struct cli *cli, const char *path, struct scene_object *out,
                    struct mesh_parts *out_made);

/* A numeric value of USD, or `otherwise`; an error if it is not finite. */
double usd_number(struct site *site, uint32_t primitive, const char *name, double otherwise);
/*
 * The numbers of a property, and how many there are; the caller frees them. NULL: none, or an
 * error, because one is not finite.
 */
double *usd_numbers(struct site *site, uint32_t primitive, const char *name, size_t *out_count);
/* True if a token has this value. */
bool usd_is(const struct site *site, uint32_t primitive, const char *name, const char *value);

/* usd_xform.c: the matrix of a primitive, from its space to the parent's; *out_resets: to the
 * world. */
struct matrix usd_transform(struct site *site, uint32_t primitive, bool *out_resets);

/* usd_mesh.c: adds the objects of a Mesh: its own, and those of its subsets. */
void usd_add_mesh(struct site *site, uint32_t primitive, struct matrix world);

/* usd_points.c: adds the object of Points, a sphere for each. */
void usd_add_points(struct site *site, uint32_t primitive, struct matrix world);

/* usd_light.c: adds a light, or says why not; ignores other types. */
void usd_add_light(struct site *site, uint32_t primitive, const char *type, struct matrix world);

/* usd_shapes.c: adds Sphere, Cube, Cylinder, Cone, Capsule or Plane; false: another type. */
bool usd_add_shape(struct site *site, uint32_t primitive, const char *type, struct matrix world);

/*
 * usd_primvar.c: the primvars of a primitive, and the constant ones of those above it. They come
 * for corners: corner i belongs to face faces[i] and point points[i]; numbers[i] is its number in
 * the list of corners. NULLs: the geometry has constant primvars only.
 */
struct usd_corners {
    uint32_t count;
    const uint32_t *faces, *points, *numbers;
};
void usd_add_primvars(struct site *site, uint32_t primitive, const struct usd_corners *corners,
                      struct scene_object *object);
/* Adds the primvars that an instancer has for one of its instances; those of the object win. */
void usd_add_instance_primvars(struct site *site, uint32_t instancer, size_t instance,
                               struct site_object *object);
/* The components of a type: 3 of "color3f[]"; 0: it has no numbers. */
unsigned usd_components(const char *type, size_t len);
/* The word of an interpolation, `otherwise` if the property has none; NULL: it is none of USD. */
const char *usd_interpolation(const mxg_property *property, const char *otherwise);

#endif
