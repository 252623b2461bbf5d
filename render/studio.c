// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "render/studio.h"

#include "render/prefilter.h"
#include "render/site.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "program/args.h"
#include "program/files.h"

#define DEGREE (3.14159265358979323846 / 180.0)
#define FINE_DETAIL 4             /* multiplies the cells of a shape in each direction */
#define FINE_TRIANGLES (1u << 18) /* for a mesh from a file */

bool studio_parse_camera(struct studio *studio, const char *text)
{
    double *const values[] = {&studio->azimuth, &studio->elevation, &studio->distance,
                              &studio->fov};
    const size_t capacity = sizeof values / sizeof *values;
    size_t count = 0;
    for (char *end; count < capacity; text = end + 1) {
        *values[count] = strtod(text, &end);
        if (end == text || (*end && *end != ','))
            return false;
        ++count;
        if (!*end)
            break;
        if (count == capacity)
            return false;
    }
    return count >= 2 && fabs(studio->azimuth) <= 1e6 && fabs(studio->elevation) < 90
           && studio->distance >= 0 && studio->distance <= 1000 && studio->fov >= 1
           && studio->fov <= 150;
}

static bool fail(struct studio_fault *fault, const char *id, const char *what, const char *name,
                 const char *why)
{
    fault->id = id;
    snprintf(fault->text, sizeof fault->text, "%s '%s': %s", what, name, why);
    return false;
}

static bool open_mesh(const struct studio *studio, struct scene_object *out,
                      struct mesh_parts *out_made, struct studio_fault *fault)
{
    *out_made = (struct mesh_parts){0};
    *out = (struct scene_object){0};
    *fault = (struct studio_fault){0};
    if (args_is_one_of(studio->mesh, shape_names())) {
        shape_make(studio->mesh, 1, &out->mesh);
        return true;
    }
    if (!strpbrk(studio->mesh, "./") && !files_is_regular(studio->mesh))
        return fail(fault, "bad-mesh", "there is no shape", studio->mesh,
                    "write ball, sphere, plane, cube, cloth, or the name of a file");
    return site_open_mesh(studio->cli, studio->mesh, out, out_made);
}

bool studio_read_map(const struct studio *studio, struct image *out, struct studio_fault *fault)
{
    char reason[256];
    if (studio->environment)
        return environment_read(studio->environment, out, reason, sizeof reason)
               || fail(fault, "bad-environment", "cannot use the environment", studio->environment,
                       reason);
    struct image stand_in;
    bool good = environment_make(out, &stand_in);
    image_finish(&stand_in);
    return good || fail(fault, "render-failed", "cannot make the", "sky", "out of memory");
}

/*
 * Provides the maps for the shader: baked before, baked now, or with box-averaged mip levels. The
 * scene may have the map.
 */
static bool open_environment(const struct studio *studio, struct scene *scene,
                             struct studio_fault *fault)
{
    char reason[256] = "out of memory";
    struct baked baked = {0};
    bool is_baked = studio->environment && files_is_folder(studio->environment);
    bool good =
        is_baked || scene->radiance.pixels || studio_read_map(studio, &scene->radiance, fault);
    uint64_t num_bad = scene->radiance.num_bad;
    if (good && is_baked)
        good = baked_read(studio->environment, &baked, reason, sizeof reason);
    else if (good && studio->prefiltered)
        good = bake_environment(&scene->radiance, &baked);
    else if (good)
        return environment_irradiance(&scene->radiance, &scene->irradiance)
               || fail(fault, "render-failed", "cannot make the", "irradiance", reason);
    else
        return false;
    if (!good) {
        baked_finish(&baked);
        return fail(fault, "bad-environment", "cannot use the environment",
                    studio->environment ? studio->environment : "sky", reason);
    }
    image_finish(&scene->radiance);
    scene->radiance = baked.radiance;
    scene->radiance.num_bad += num_bad;
    scene->irradiance = baked.irradiance;
    scene->albedo = baked.albedo;
    if (!studio->prefiltered)
        scene->radiance.levels = 0; /* the level 0 map only */
    return true;
}

bool studio_open_light(const struct studio *studio, struct image map, struct scene *scene,
                       struct studio_fault *fault)
{
    *scene = (struct scene){.num_lights = studio->environment ? 0 : SCENE_NUM_LIGHTS,
                            .object.world = matrix_identity(),
                            .studio = matrix_identity(),
                            .near = SCENE_NEAR,
                            .radiance = map,
                            .environment = matrix_identity()};
    return open_environment(studio, scene, fault);
}

bool studio_open(const struct studio *studio, double aspect, struct scene *scene,
                 struct mesh_parts *out_made, struct studio_fault *fault)
{
    struct scene_object object;
    *scene = (struct scene){0};
    bool good = open_mesh(studio, &object, out_made, fault);
    good = good && studio_open_light(studio, (struct image){0}, scene, fault);
    scene->object = object;
    scene->object.world = matrix_identity();
    scene->object.path = studio->mesh;
    scene->object.names_texcoords = true;
    if (good)
        studio_aim(studio, aspect, 0, scene);
    return good;
}

void studio_aim(const struct studio *studio, double aspect, double turn, struct scene *scene)
{
    double azimuth = (studio->azimuth + turn) * DEGREE, elevation = studio->elevation * DEGREE;
    double half = tan(studio->fov * DEGREE / 2); /* of the shorter side */
    double distance = studio->distance > 0 ? studio->distance : 1.04 / sin(atan(half));
    const double eye[3] = {distance * sin(azimuth) * cos(elevation), distance * sin(elevation),
                           distance * cos(azimuth) * cos(elevation)};
    scene_set_camera(scene, eye, (const double[3]){0, 0, 0});
    double vertical = 2 * atan(aspect < 1 ? half / aspect : half) / DEGREE;
    scene->projection = matrix_perspective(vertical, aspect, distance / 100, distance + 10);
}

void studio_refine(const struct studio *studio, const struct mesh *mesh, struct mesh *out)
{
    if (args_is_one_of(studio->mesh, shape_names())) {
        shape_make(studio->mesh, FINE_DETAIL, out);
    } else {
        mesh_allocate(out, mesh->num_vertices, mesh->num_indices);
        memcpy(out->vertices, mesh->vertices, mesh->num_vertices * sizeof *mesh->vertices);
        memcpy(out->indices, mesh->indices, mesh->num_indices * sizeof *mesh->indices);
        mesh_subdivide(out, FINE_TRIANGLES);
    }
    mesh_weld(out);
}
