// SPDX-License-Identifier: Apache-2.0
#define _XOPEN_SOURCE 700 /* realpath */
#include "render/site.h"

#include "import/gltf_source.h"
#include "program/files.h"
#include "program/memory.h"
#include "program/scene_file.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define DEGREE (3.14159265358979323846 / 180.0)

/* ---- Objects ---- */

bool site_has_room(struct site *site, uint32_t primitive, uint64_t num_triangles)
{
    enum { MAX_OBJECTS = 1 << 20, MAX_TRIANGLES = 1 << 26 };
    site->num_triangles += num_triangles;
    if (site->has_fault)
        return false;
    if (site->num_objects == MAX_OBJECTS)
        site_fail(site, primitive, NULL, "and others are more than %d objects", MAX_OBJECTS);
    else if (site->num_triangles > MAX_TRIANGLES)
        site_fail(site, primitive, NULL, "and others have more than %d triangles", MAX_TRIANGLES);
    return !site->has_fault;
}

struct scene_object *site_add(struct site *site, uint32_t primitive, struct matrix world)
{
    struct site_object added = {
        .object = {.world = world, .path = scene_file_path(site->scene, primitive)},
        .primitive = primitive};
    MEMORY_PUSH(site->objects, site->num_objects, added);
    return &site->objects[site->num_objects - 1].object;
}

bool site_share(struct site *site, uint32_t object, uint32_t primitive, struct matrix world)
{
    struct site_object again = site->objects[object];
    if (!site_has_room(site, primitive, again.object.mesh.num_indices / 3))
        return false;
    struct scene_object *added = site_add(site, primitive, world);
    struct site_object *last = &site->objects[site->num_objects - 1];
    again.object.path = added->path;
    again.object.world = world;
    again.object.num_primvars -= again.num_own_primvars;
    *added = again.object;
    last->made = again.made;
    last->shares_mesh = last->shares_primvars = true;
    return true;
}

void site_repeat(struct site *site, uint32_t first, uint32_t num, struct matrix world)
{
    for (uint32_t i = first; i < first + num; ++i)
        if (!site_share(site, i, site->objects[i].primitive, world))
            return;
}

/* Names the subject of a message: "'/a.points' (a.usda:3:5)", or the path. The caller frees it. */
static char *subject_of(const struct site *site, uint32_t primitive, const char *property)
{
    mxg_property at = {sizeof at};
    char *path = scene_file_path(site->scene, primitive), *subject;
    uint32_t index =
        property ? mxg_scene_find_property(site->scene, primitive, property) : MXG_NONE;
    if (mxg_scene_property(site->scene, primitive, index, &at) == MXG_OK)
        subject = cli_format("'%s.%s' (%s:%u:%u)", path, property, at.file, at.line, at.column);
    else if (mxg_scene_property(site->scene, primitive, 0, &at) == MXG_OK)
        subject = cli_format("'%s' (%s:%u)", path, at.file, at.line);
    else
        subject = cli_format("'%s'", path);
    free(path);
    return subject;
}

void site_fail(struct site *site, uint32_t primitive, const char *property, const char *format, ...)
{
    char reason[256], *subject = subject_of(site, primitive, property);
    va_list args;
    va_start(args, format);
    vsnprintf(reason, sizeof reason, format, args);
    va_end(args);
    report_error(site->report, "bad-geometry", "%s %s", subject, reason);
    free(subject);
    site->has_fault = true;
}

void site_warn(struct site *site, const char *id, uint32_t primitive, const char *property,
               const char *format, ...)
{
    char reason[256], *subject = subject_of(site, primitive, property);
    va_list args;
    va_start(args, format);
    vsnprintf(reason, sizeof reason, format, args);
    va_end(args);
    report_warning(site->report, id, "%s %s", subject, reason);
    free(subject);
}

void site_add_light(struct site *site, struct scene_light light)
{
    site->is_lit = true;
    MEMORY_PUSH(site->lights, site->num_lights, light);
}

void site_add_lamp(struct site *site, struct scene_light light)
{
    /* the radiance of a small sphere with the intensity I is I / (π r²) */
    const double radius = 1e-4, area = 3.14159265358979323846 * radius * radius;
    bool is_far = light.type == LIGHT_DIRECTIONAL;
    light.type = is_far ? LIGHT_DIRECTIONAL : LIGHT_SPHERE;
    light.intensity = is_far ? 1 : 1 / area;
    light.radius = radius;
    site_add_light(site, light);
}

void site_add_camera(struct site *site, struct site_camera camera)
{
    MEMORY_PUSH(site->cameras, site->num_cameras, camera);
}

/* ---- Files ---- */

static bool open_usd(struct site *site, struct cli *cli, const char *path, const char *purpose)
{
    site->scene = scene_file_load(cli, path, purpose);
    if (!site->scene)
        return false;
    struct stat info;
    site->file_size = stat(path, &info) == 0 ? (uint64_t)info.st_size : 0;
    site->meters_per_unit = mxg_scene_meters_per_unit(site->scene);
    site_read_usd(site);
    site->is_z_up = mxg_scene_up_axis(site->scene) == 'Z';
    return !site->has_fault;
}

/* Why a file may not be read; NULL: it may. The sandbox does not hold for what the user names. */
static const char *file_fault(const mxg_context *context, const char *path)
{
    if (!files_is_regular(path)) /* a device or a pipe may never end */
        return access(path, F_OK) == 0 ? "it is not a file" : strerror(errno);
    char *real = realpath(path, NULL);
    const char *fault = real ? mxg_context_file_fault(context, real, real) : strerror(errno);
    free(real);
    return fault;
}

/* A file with paths and meshes alone. */
static bool open_other(struct site *site, const char *path)
{
    const char *fault = file_fault(site->context, path);
    if (fault) {
        report_error(site->report, "bad-mesh", "cannot use the mesh '%s': %s", path, fault);
        return false;
    }
    if (!report_status(site->report, mxg_scene_create(site->context, &site->scene)))
        return false;
    return gltf_source_is(path) ? site_read_gltf(site) : site_import(site);
}

bool site_open(struct site *site, struct cli *cli, const char *path, const char *purpose)
{
    struct report *report = &cli->report;
    *site = (struct site){.report = report, .context = cli->context, .file = path};
    if (!(scene_file_kind(path) == SCENE_FILE_USD ? open_usd(site, cli, path, purpose)
                                                  : open_other(site, path)))
        return false;
    if (!site->num_objects)
        report_error(report, "empty-mesh", "cannot use the mesh '%s': it has no visible geometry",
                     path);
    return site->num_objects != 0;
}

void site_list(const struct site *site)
{
    uint32_t num = mxg_scene_num_primitives(site->scene);
    for (uint32_t i = 0; i < num; ++i) {
        char *path = scene_file_path(site->scene, i);
        puts(path);
        free(path);
    }
}

void site_close(struct site *site)
{
    for (uint32_t i = 0; i < site->num_objects; ++i) {
        struct site_object *at = &site->objects[i];
        free((void *)(uintptr_t)at->object.path);
        if (!at->shares_mesh)
            mesh_finish(&at->object.mesh);
        object_finish_primvars(&at->object, at->shares_primvars ? at->num_own_primvars
                                                                : at->object.num_primvars);
    }
    names_finish(&site->shapes);
    for (uint32_t i = 0; i < site->num_cameras; ++i)
        free(site->cameras[i].path);
    free(site->cameras);
    free(site->instances);
    free(site->lights);
    image_finish(&site->dome);
    free(site->objects);
    mxg_scene_destroy(site->scene);
}

/* ---- Camera and light ---- */

/* The sphere around the box around all objects. */
static void bound(const struct site *site, double centre[3], double *out_radius)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t o = 0; o < site->num_objects; ++o) {
        const struct scene_object *object = &site->objects[o].object;
        for (uint32_t v = 0; v < object->mesh.num_vertices; ++v) {
            double at[3];
            for (size_t i = 0; i < 3; ++i)
                at[i] = object->mesh.vertices[v].position[i];
            matrix_point(object->world, at, at);
            for (size_t i = 0; i < 3; ++i) {
                low[i] = fmin(low[i], at[i]);
                high[i] = fmax(high[i], at[i]);
            }
        }
    }
    double square = 0;
    for (size_t i = 0; i < 3; ++i) {
        centre[i] = (low[i] + high[i]) / 2;
        square += (high[i] - low[i]) * (high[i] - low[i]) / 4;
    }
    *out_radius = square > 0 ? sqrt(square) : 1;
}

struct matrix site_upright(const struct site *site)
{
    return site->is_z_up ? matrix_rotation((const double[3]){1, 0, 0}, -90) : matrix_identity();
}

struct matrix site_rigid(struct matrix m)
{
    double x[3], y[3], z[3];
    memcpy(y, m.m[1], sizeof y);
    memcpy(z, m.m[2], sizeof z);
    vector_normalize(z);
    vector_cross(y, z, x);
    vector_normalize(x);
    vector_cross(z, x, y);
    memcpy(m.m[0], x, sizeof x);
    memcpy(m.m[1], y, sizeof y);
    memcpy(m.m[2], z, sizeof z);
    return m;
}

static void use_camera(const struct site_camera *camera, double aspect, double radius,
                       const double centre[3], struct scene *scene)
{
    struct matrix world = site_rigid(camera->world);
    double distance = 0;
    /* all of its frame is in the picture */
    double half = fmax(camera->height, camera->width / aspect);
    scene->view = matrix_inverse(world);
    for (size_t i = 0; i < 3; ++i) {
        scene->eye[i] = world.m[3][i];
        scene->target[i] = world.m[3][i] - world.m[2][i];
        distance += (centre[i] - scene->eye[i]) * (centre[i] - scene->eye[i]);
    }
    scene->projection = matrix_perspective(2 * atan(half) / DEGREE, aspect, radius / 1000,
                                           sqrt(distance) + 2 * radius);
    for (size_t i = 0; i < 2; ++i)
        scene->projection.m[2][i] = camera->centre[i] * scene->projection.m[i][i];
}

/* The studio's camera looks at the sphere as at a mesh of size 1. */
static void use_orbit(const struct studio *studio, double aspect, struct matrix up, double radius,
                      const double centre[3], struct scene *scene)
{
    double target[3];
    studio_aim(studio, aspect, 0, scene);
    matrix_point(up, centre, target);
    double eye[3], distance = 0;
    for (size_t i = 0; i < 3; ++i) {
        distance += scene->eye[i] * scene->eye[i];
        eye[i] = target[i] + radius * scene->eye[i];
    }
    distance = radius * sqrt(distance);
    scene->view = matrix_multiply(matrix_look_at(eye, target), up);
    matrix_point(matrix_inverse(up), eye, scene->eye);
    memcpy(scene->target, centre, sizeof scene->target);
    /* the depths of the projection: p.z = a z + b */
    double near = fmax(distance - 1.05 * radius, distance / 1000), far = distance + 2 * radius;
    scene->projection.m[2][2] = far / (near - far);
    scene->projection.m[3][2] = near * far / (near - far);
}

static const struct site_camera *find_camera(const struct site *site, const char *path)
{
    for (uint32_t i = 0; i < site->num_cameras; ++i)
        if (!path || strcmp(site->cameras[i].path, path) == 0)
            return &site->cameras[i];
    return NULL;
}

bool site_light(struct site *site, const struct studio *studio, struct scene *scene)
{
    struct studio_fault fault;
    struct image map = {0};
    site->lights_scene = site->is_lit && !studio->environment;
    if (site->lights_scene && site->has_dome) {
        map = site->dome;
        site->dome = (struct image){0};
    } else if (site->lights_scene && !environment_make_plain(0, &map)) {
        return report_status(site->report, MXG_ERROR_MEMORY);
    }
    if (!studio_open_light(studio, map, scene, &fault)) {
        report_error(site->report, fault.id, "%s", fault.text);
        return false;
    }
    if (!site->lights_scene)
        return true;
    scene->num_lights = site->num_lights;
    scene->site_lights = site->lights;
    scene->num_site_lights = site->num_lights;
    /* the middle of a map is at +z in USD, and at -z in MaterialX */
    if (site->has_dome)
        scene->environment =
            matrix_multiply(matrix_scale(-1, 1, -1), matrix_inverse(site->dome_world));
    return true;
}

/*
 * Moves the origin of the world near a camera that is far from it, where the floats of shaders have
 * too few digits: by a multiple of a step, so that a moving camera seldom moves the origin.
 */
static void move_origin(struct site *site, struct scene *scene)
{
    const double step = 16384;
    double origin[3];
    for (size_t i = 0; i < 3; ++i)
        origin[i] = step * round(scene->eye[i] / step);
    if (origin[0] == 0 && origin[1] == 0 && origin[2] == 0)
        return;
    const struct matrix there = matrix_translation(origin[0], origin[1], origin[2]),
                        back = matrix_translation(-origin[0], -origin[1], -origin[2]);
    scene->view = matrix_multiply(scene->view, there);
    scene->studio = matrix_multiply(back, scene->studio);
    matrix_point(back, scene->eye, scene->eye);
    matrix_point(back, scene->target, scene->target);
    for (uint32_t i = 0; i < site->num_objects; ++i)
        site->objects[i].object.world = matrix_multiply(back, site->objects[i].object.world);
    for (uint32_t i = 0; i < site->num_cameras; ++i)
        site->cameras[i].world = matrix_multiply(back, site->cameras[i].world);
    for (uint32_t i = 0; i < site->num_lights; ++i)
        matrix_point(back, site->lights[i].position, site->lights[i].position);
}

bool site_aim(struct site *site, const struct studio *studio, const char *camera, bool is_orbit,
              double aspect, struct scene *scene)
{
    double centre[3], radius;
    const struct site_camera *found = is_orbit ? NULL : find_camera(site, camera);
    if (camera && !found) {
        report_error(site->report, "unknown-camera", "the stage has no camera '%s'%s%s%s", camera,
                     site->num_cameras ? "; there is '" : "",
                     site->num_cameras ? site->cameras[0].path : "", site->num_cameras ? "'" : "");
        return false;
    }
    bound(site, centre, &radius);
    struct matrix up = site_upright(site);
    if (found)
        use_camera(found, aspect, radius, centre, scene);
    else
        use_orbit(studio, aspect, up, radius, centre, scene);
    scene->near = SCENE_NEAR * radius;
    if (!site->lights_scene) {
        scene->environment = up;
        scene->studio = matrix_multiply(
            matrix_translation(centre[0], centre[1], centre[2]),
            matrix_multiply(matrix_scale(radius, radius, radius), matrix_inverse(up)));
    }
    move_origin(site, scene);
    return true;
}
