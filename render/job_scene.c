// SPDX-License-Identifier: Apache-2.0
/* The scene of a run: the studio, a fixed scene or a stage, with its lights. */
#include "render/job.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define OVERSAMPLING 2  /* samples per pixel and axis */
#define MAX_LIGHTS 1024 /* of --max-lights */

static bool note_parts(struct job *job, struct mesh_parts made)
{
    static const struct {
        enum mesh_part part;
        const char *name;
    } parts[] = {{MESH_NORMALS, "normals"},
                 {MESH_TEXCOORDS, "texture coordinates"},
                 {MESH_TANGENTS, "tangents"}};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; ++i)
        if ((made.some & parts[i].part) && !job->cli.quiet)
            fprintf(stderr, "note: %s '%s' %s no %s; they were made\n",
                    made.all & parts[i].part ? "the mesh" : "parts of the mesh",
                    job->painter.studio.mesh, made.all & parts[i].part ? "has" : "have",
                    parts[i].name);
    return true;
}

void job_tell_bad_environment(struct job *job, const char *name, const struct image *map)
{
    if (map->num_bad)
        report_warning(&job->cli.report, "bad-pixels",
                       "the environment '%s' has pixels that are NaN, infinite or larger than 1e9 "
                       "(%llu); they are 0 here",
                       name, (unsigned long long)map->num_bad);
}

static bool make_scene(struct job *job)
{
    struct painter *painter = &job->painter;
    double aspect = (double)painter->width / painter->height;
    if (job->scene_kind == SCENE_STUDIO) {
        struct mesh_parts made;
        struct studio_fault fault;
        if (studio_open(&painter->studio, aspect, &painter->scene, &made, &fault)) {
            job_tell_bad_environment(job, painter->studio.environment, &painter->scene.radiance);
            return note_parts(job, made);
        }
        if (fault.id)
            report_error(&job->cli.report, fault.id, "%s", fault.text);
        return false;
    }
    bool good = job->scene_kind == SCENE_GRID    ? scene_init_grid(&painter->scene)
                : job->scene_kind == SCENE_PLANE ? scene_init_plane(&painter->scene)
                                                 : scene_init_sphere(&painter->scene, aspect);
    return good || report_status(&job->cli.report, MXG_ERROR_MEMORY);
}

static const struct unit {
    const char *name;
    double meters;
} units[] = {{"meter", 1},     {"centimeter", 0.01}, {"millimeter", 0.001}, {"kilometer", 1000},
             {"inch", 0.0254}, {"foot", 0.3048},     {"micron", 1e-6},      {"nanometer", 1e-9},
             {"yard", 0.9144}, {"mile", 1609.344}};
enum { NUM_UNITS = sizeof units / sizeof *units };

/* Lengths of documents are in the unit of the stage, where it is one of MaterialX's. */
static void apply_unit(struct job *job)
{
    double unit = job->site.meters_per_unit;
    if (args_is_given(&job->cli.parser, "distance-unit") || unit <= 0)
        return;
    for (size_t i = 0; i < NUM_UNITS; ++i)
        if (fabs(unit / units[i].meters - 1) < 1e-5)
            mxg_options_set(job->cli.options, "distance-unit", units[i].name);
}

/* Metres in a unit of the world; 0: nobody says. */
static double meters_per_unit(const struct job *job)
{
    const struct arg_parser *parser = &job->cli.parser;
    for (size_t s = parser->num_settings; s-- > 0;)
        for (size_t i = 0; i < NUM_UNITS; ++i)
            if (strcmp(parser->settings[s].key, "distance-unit") == 0
                && strcmp(parser->settings[s].value, units[i].name) == 0)
                return units[i].meters;
    return job->options.stage ? job->site.meters_per_unit : 0;
}

/* Shaders have the types of the stage's lights alone, and no environment where it has none. */
static void apply_lights(struct job *job)
{
    static const struct {
        enum light_type type;
        const char *name;
    } types[] = {{LIGHT_DIRECTIONAL, "directional_light"},
                 {LIGHT_SPHERE, "sphere_light"},
                 {LIGHT_DISK, "disk_light"}};
    const struct site *stage = &job->site;
    char text[128] = "", number[16];
    if (!stage->lights_scene)
        return;
    for (size_t t = 0; t < sizeof types / sizeof *types; ++t)
        for (uint32_t i = 0; i < stage->num_lights; ++i)
            if (stage->lights[i].type == types[t].type) {
                size_t len = strlen(text);
                snprintf(text + len, sizeof text - len, "%s%s=%d", len ? "," : "", types[t].name,
                         types[t].type);
                break;
            }
    if (args_is_given(&job->cli.parser, "lights") && stage->num_lights)
        report_warning(&job->cli.report, "light-left-out",
                       "--lights has other types than the lights of the stage, which are dark");
    else if (!args_is_given(&job->cli.parser, "lights"))
        mxg_options_set(job->cli.options, "lights", *text ? text : "none");
    snprintf(number, sizeof number, "%u",
             stage->num_lights < MAX_LIGHTS ? stage->num_lights : MAX_LIGHTS);
    if (stage->num_lights > SCENE_NUM_LIGHTS && !args_is_given(&job->cli.parser, "max-lights"))
        mxg_options_set(job->cli.options, "max-lights", number);
    if (stage->num_lights > MAX_LIGHTS)
        report_warning(&job->cli.report, "light-left-out",
                       "the stage has %u lights; the first %d light the picture", stage->num_lights,
                       MAX_LIGHTS);
    if (!stage->has_dome && !job->options.environments.len) {
        if (!job->options.path_trace)
            mxg_options_set(job->cli.options, "environment", "none");
        job->painter.trace.dark = true;
    }
}

static bool make_stage(struct job *job)
{
    struct painter *painter = &job->painter;
    double aspect = (double)painter->width / painter->height;
    if (!site_open(&job->site, &job->cli, job->options.stage, job->options.purpose))
        return false;
    apply_unit(job);
    if (!site_light(&job->site, &painter->studio, &painter->scene))
        return false;
    apply_lights(job);
    job_tell_bad_environment(job, painter->studio.environment, &painter->scene.radiance);
    return site_aim(&job->site, &painter->studio,
                    job_names_camera(job) ? job->options.camera : NULL,
                    job->options.camera && !job_names_camera(job), aspect, &painter->scene);
}

static bool open_gpu(struct job *job)
{
    struct painter *painter = &job->painter;
    if (!gpu_open(&painter->gpu)) {
        report_error(&job->cli.report, painter->gpu.id, "cannot draw: %s", painter->gpu.reason);
        return false;
    }
    uint32_t most = painter->gpu.max_size / painter->oversampling;
    if (painter->width > most || painter->height > most)
        report_error(&job->cli.report, "size-limit",
                     "a picture of %ux%u is too large; this device renders up to %ux%u",
                     painter->width, painter->height, most, most);
    return painter->width <= most && painter->height <= most;
}

bool job_prepare(struct job *job)
{
    struct painter *painter = &job->painter;
    painter->oversampling = job->scene_kind == SCENE_GRID ? 1 : OVERSAMPLING;
    if (!(job->options.stage ? make_stage(job) : make_scene(job)))
        return false;
    painter->scene.environment_samples = (uint32_t)job->options.samples;
    painter->scene.frame = (int32_t)job->options.frame;
    painter->scene.layer_sample = job->layer_sample;
    painter->scene.unit = 100 * meters_per_unit(job);
    return open_gpu(job);
}
