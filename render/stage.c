// SPDX-License-Identifier: Apache-2.0
#include "render/stage.h"

#include "program/memory.h"
#include "program/stage.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#define DEGREE (3.14159265358979323846 / 180.0)

/* ---- Objects ---- */

char *stage_path(const mxg_scene *scene, uint32_t primitive)
{
    size_t size = mxg_scene_primitive_path(scene, primitive, NULL, 0) + 1;
    char *path = memory_alloc(size);
    mxg_scene_primitive_path(scene, primitive, path, size);
    return path;
}

struct scene_object *stage_add(struct stage *stage, uint32_t primitive, struct matrix world)
{
    if (stage->num_objects == stage->capacity) {
        stage->capacity = stage->capacity ? 2 * stage->capacity : 16;
        stage->objects = memory_resize(stage->objects, stage->capacity * sizeof *stage->objects);
    }
    struct stage_object *added = &stage->objects[stage->num_objects++];
    *added = (struct stage_object){
        .object = {.world = world, .path = stage_path(stage->scene, primitive)},
        .primitive = primitive};
    return &added->object;
}

/* What a message is about: "'/a.points' (a.usda:3:5)", or the path alone. The caller frees it. */
static char *subject_of(const struct stage *stage, uint32_t primitive, const char *property)
{
    mxg_property at = {sizeof at};
    char *path = stage_path(stage->scene, primitive), *subject;
    if (property && mxg_scene_find_property(stage->scene, primitive, property, &at))
        subject = cli_format("'%s.%s' (%s:%u:%u)", path, property, at.file, at.line, at.column);
    else if (mxg_scene_property(stage->scene, primitive, 0, &at) == MXG_OK)
        subject = cli_format("'%s' (%s:%u)", path, at.file, at.line);
    else
        subject = cli_format("'%s'", path);
    free(path);
    return subject;
}

void stage_fail(struct stage *stage, uint32_t primitive, const char *property, const char *format,
                ...)
{
    char reason[256], *subject = subject_of(stage, primitive, property);
    va_list args;
    va_start(args, format);
    vsnprintf(reason, sizeof reason, format, args);
    va_end(args);
    report_error(stage->report, "bad-geometry", "%s %s", subject, reason);
    free(subject);
    stage->has_fault = true;
}

void stage_warn(struct stage *stage, const char *id, uint32_t primitive, const char *property,
                const char *format, ...)
{
    char reason[256], *subject = subject_of(stage, primitive, property);
    va_list args;
    va_start(args, format);
    vsnprintf(reason, sizeof reason, format, args);
    va_end(args);
    report_warning(stage->report, id, "%s %s", subject, reason);
    free(subject);
}

void stage_add_light(struct stage *stage, struct scene_light light)
{
    stage->is_lit = true;
    stage->lights = memory_resize(stage->lights, (stage->num_lights + 1) * sizeof *stage->lights);
    stage->lights[stage->num_lights++] = light;
}

/* ---- Files ---- */

static bool open_usd(struct stage *stage, mxg_context *context, const char *path,
                     const char *purpose)
{
    mxg_status status = mxg_scene_load(context, path, purpose, &stage->scene);
    if (stage->scene)
        report_list(stage->report, mxg_scene_diagnostics(stage->scene));
    if (!report_status(stage->report, status))
        return false;
    stage->meters_per_unit = mxg_scene_meters_per_unit(stage->scene);
    stage_read_usd(stage);
    stage->is_z_up = mxg_scene_up_axis(stage->scene) == 'Z';
    return !stage->has_fault;
}

bool stage_open(struct stage *stage, mxg_context *context, struct report *report, const char *path,
                const char *purpose)
{
    *stage = (struct stage){.report = report, .file = path};
    if (!(stage_kind(path) == STAGE_USD ? open_usd(stage, context, path, purpose)
                                        : stage_import(stage, context, path)))
        return false;
    if (!stage->num_objects)
        report_error(report, "empty-mesh", "the stage '%s' has no visible geometry", path);
    return stage->num_objects != 0;
}

void stage_list(const struct stage *stage)
{
    uint32_t num = mxg_scene_num_primitives(stage->scene);
    for (uint32_t i = 0; i < num; ++i) {
        char *path = stage_path(stage->scene, i);
        puts(path);
        free(path);
    }
}

void stage_close(struct stage *stage)
{
    for (uint32_t i = 0; i < stage->num_objects; ++i) {
        free((void *)(uintptr_t)stage->objects[i].object.path);
        object_finish(&stage->objects[i].object);
    }
    for (uint32_t i = 0; i < stage->num_cameras; ++i)
        free(stage->cameras[i].path);
    free(stage->cameras);
    free(stage->lights);
    image_finish(&stage->dome);
    free(stage->objects);
    mxg_scene_destroy(stage->scene);
}

/* ---- Camera and light ---- */

/* The sphere around the box around all objects. */
static void bound(const struct stage *stage, double centre[3], double *out_radius)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t o = 0; o < stage->num_objects; ++o) {
        const struct scene_object *object = &stage->objects[o].object;
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

/* From the stage to a world with y upwards. */
static struct matrix upright(const struct stage *stage)
{
    return stage->is_z_up ? matrix_rotation((const double[3]){1, 0, 0}, -90) : matrix_identity();
}

struct matrix stage_rigid(struct matrix m)
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

static void use_camera(const struct stage_camera *camera, double aspect, double radius,
                       const double centre[3], struct scene *scene)
{
    struct matrix world = stage_rigid(camera->world);
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

static const struct stage_camera *find_camera(const struct stage *stage, const char *path)
{
    for (uint32_t i = 0; i < stage->num_cameras; ++i)
        if (!path || strcmp(stage->cameras[i].path, path) == 0)
            return &stage->cameras[i];
    return NULL;
}

bool stage_light(struct stage *stage, const struct studio *studio, struct scene *scene)
{
    struct studio_fault fault;
    struct image map = {0};
    stage->lights_scene = stage->is_lit && !studio->environment;
    if (stage->lights_scene && stage->has_dome) {
        map = stage->dome;
        stage->dome = (struct image){0};
    } else if (stage->lights_scene && !environment_make_plain(0, &map)) {
        return report_status(stage->report, MXG_ERROR_MEMORY);
    }
    if (!studio_open_light(studio, map, scene, &fault)) {
        report_error(stage->report, fault.id, "%s", fault.text);
        return false;
    }
    if (!stage->lights_scene)
        return true;
    scene->num_lights = stage->num_lights;
    scene->stage_lights = stage->lights;
    scene->num_stage_lights = stage->num_lights;
    /* the middle of a map is at +z in USD, and at -z in MaterialX */
    if (stage->has_dome)
        scene->environment =
            matrix_multiply(matrix_scale(-1, 1, -1), matrix_inverse(stage->dome_world));
    return true;
}

bool stage_aim(const struct stage *stage, const struct studio *studio, const char *camera,
               bool is_orbit, double aspect, struct scene *scene)
{
    double centre[3], radius;
    const struct stage_camera *found = is_orbit ? NULL : find_camera(stage, camera);
    if (camera && !found) {
        report_error(stage->report, "unknown-camera", "the stage has no camera '%s'%s%s%s", camera,
                     stage->num_cameras ? "; there is '" : "",
                     stage->num_cameras ? stage->cameras[0].path : "",
                     stage->num_cameras ? "'" : "");
        return false;
    }
    bound(stage, centre, &radius);
    struct matrix up = upright(stage);
    if (found)
        use_camera(found, aspect, radius, centre, scene);
    else
        use_orbit(studio, aspect, up, radius, centre, scene);
    scene->near = SCENE_NEAR * radius;
    if (stage->lights_scene)
        return true;
    scene->environment = up;
    scene->studio =
        matrix_multiply(matrix_translation(centre[0], centre[1], centre[2]),
                        matrix_multiply(matrix_scale(radius, radius, radius), matrix_inverse(up)));
    return true;
}
