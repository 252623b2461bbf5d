// SPDX-License-Identifier: Apache-2.0
/* The arguments of a run: sizes, views, settings, and the options of generation that they set. */
#define _POSIX_C_SOURCE 200809L
#include "render/applies.h"
#include "render/job.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const struct {
    const char *name;
    /* factor for a white surface in the daylight of the scene; 1 for unchanged values */
    double exposure;
} scene_kinds[NUM_SCENES] = {[SCENE_STUDIO] = {"studio", 0.6},
                             [SCENE_SPHERE] = {"sphere", 0.6},
                             [SCENE_PLANE] = {"plane", 1.0},
                             [SCENE_GRID] = {"grid", 1.0}};

static const char *const background_names[] = {"backdrop", "environment", "none", NULL};

bool job_writes_channels(const struct job *job)
{
    const char *const files[] = {job->options.output, job->options.copy};
    for (size_t i = 0; i < 2; ++i)
        if (files[i] && strlen(files[i]) > 4
            && strcasecmp(files[i] + strlen(files[i]) - 4, ".exr") == 0)
            return true;
    return false;
}

/* "512" or "640x480" */
static bool parse_size(struct job *job)
{
    char *end;
    unsigned long width = strtoul(job->options.size, &end, 10), height = width;
    if (*end == 'x')
        height = strtoul(end + 1, &end, 10);
    if (*end || width < 1 || height < 1 || width > UINT16_MAX || height > UINT16_MAX) {
        fprintf(stderr, "mxgen: '%s' is not a size; write W or WxH, each from 1 to %d\n",
                job->options.size, UINT16_MAX);
        return false;
    }
    job->painter.width = (uint32_t)width;
    job->painter.height = (uint32_t)height;
    return true;
}

static bool parse_layer_sample(struct job *job)
{
    const char *text = job->options.layer_sample;
    char *end;
    job->layer_sample = -1;
    if (!text)
        return true;
    job->layer_sample = strtod(text, &end);
    if (end != text && !*end && job->layer_sample >= 0 && job->layer_sample < 1)
        return true;
    fprintf(stderr, "mxgen: '%s' picks no layer; write a number from 0 to below 1\n", text);
    return false;
}

/* Splits "path=value" in place. NULL after reporting an error. The caller frees the result. */
static struct bind_value *split_settings(const struct arg_list *settings)
{
    struct bind_value *values = calloc(settings->len + 1, sizeof *values);
    for (size_t i = 0; values && i < settings->len; ++i) {
        const char *equals = strchr(settings->items[i], '=');
        if (!equals) {
            fprintf(stderr, "mxgen: '--set %s' has no '='; write --set path=value\n",
                    settings->items[i]);
            free(values);
            return NULL;
        }
        values[i].path = cli_format("%.*s", (int)(equals - settings->items[i]), settings->items[i]);
        values[i].text = equals + 1;
    }
    return values;
}

void job_free_values(struct bind_value *values, size_t count)
{
    for (size_t i = 0; values && i < count; ++i)
        free((void *)(uintptr_t)values[i].path);
    free(values);
}

/* The index of a word in a list; after reporting an unknown word, the length of the list. */
static size_t find_word(const char *option, const char *word, const char *const *words)
{
    size_t i = 0;
    while (words[i] && strcmp(words[i], word) != 0)
        ++i;
    if (words[i])
        return i;
    fprintf(stderr, "mxgen: '%s' is no value of --%s; there are", word, option);
    for (size_t w = 0; words[w]; ++w)
        fprintf(stderr, "%s %s", w == 0 ? "" : words[w + 1] ? "," : " and", words[w]);
    fputc('\n', stderr);
    return i;
}

/* "--environment" takes a mode of generation or the file of a map, at most one of each. */
static void apply_environments(struct job *job)
{
    for (size_t i = 0; i < job->options.environments.len; ++i) {
        const char *word = job->options.environments.items[i];
        if (mxg_options_set(job->cli.options, "environment", word) != MXG_OK) {
            job->painter.studio.environment = word;
            continue;
        }
        job->painter.studio.prefiltered = strcmp(word, "prefiltered") == 0;
        job->painter.trace.dark = strcmp(word, "none") == 0;
    }
    if (job->options.path_trace) /* the tracer has the environment, not its shaders */
        mxg_options_set(job->cli.options, "environment", "importance");
}

/* Reduces the interface for a smaller shader: only the inputs that the user sets stay uniforms. */
static bool apply_interface(struct job *job)
{
    if (job->options.settings.len || args_is_given(&job->cli.parser, "interface"))
        return true;
    return report_status(&job->cli.report,
                         mxg_options_set(job->cli.options, "interface", "reduced"));
}

bool job_names_camera(const struct job *job)
{
    return job->options.stage && job->options.camera && *job->options.camera == '/';
}

bool job_shows_slots(const struct job *job)
{
    return job->options.show && job->painter.shown == UINT32_MAX;
}

/* --show: of a stage, or of what the deferred pipeline stores. false: there is no such view. */
static bool parse_view(struct job *job)
{
    enum { OF_SLOTS = 2, MAX_VIEWS = 16 };
    const char *views[MAX_VIEWS + 1] = {"slots", "weights"};
    for (size_t i = 0; pass_views[i]; ++i) {
        assert(OF_SLOTS + i < MAX_VIEWS);
        views[OF_SLOTS + i] = pass_views[i];
    }
    job->painter.shown = UINT32_MAX;
    if (!job->options.show)
        return true;
    size_t view = find_word("show", job->options.show, views);
    job->painter.exposure = 1;
    if (view >= OF_SLOTS)
        job->painter.shown = (uint32_t)(view - OF_SLOTS);
    else
        mxg_options_set(job->cli.options, "mattes", "true");
    return views[view] != NULL;
}

static bool parse(struct job *job)
{
    const char *scene_names[NUM_SCENES + 1] = {0};
    for (size_t i = 0; i < NUM_SCENES; ++i)
        scene_names[i] = scene_kinds[i].name;
    size_t scene = find_word("scene", job->options.scene, scene_names);
    size_t background =
        scene < NUM_SCENES ? find_word("background", job->options.background, background_names) : 0;
    if (scene == NUM_SCENES || !background_names[background])
        return false;
    job->scene_kind = (enum scene_kind)scene;
    job->painter.background = (enum background)background;
    job->painter.exposure = scene_kinds[scene].exposure;
    job->painter.is_studio = scene == SCENE_STUDIO;
    job->painter.checker = strcmp(job->options.missing_texture, "checker") == 0;
    if (!job->painter.checker
        && find_word("missing-texture", job->options.missing_texture,
                     (const char *const[]){"error", "checker", NULL})
               != 0)
        return false;
    if (job->options.camera && !job_names_camera(job)
        && !studio_parse_camera(&job->painter.studio, job->options.camera)) {
        fprintf(stderr,
                "mxgen: '%s' is no camera; write AZIMUTH,ELEVATION[,DISTANCE[,FOV]], with an "
                "elevation between -90 and 90\n",
                job->options.camera);
        return false;
    }
    if (!parse_view(job))
        return false;
    /* AOVs are drawn as many as the device has attachments for, again and again */
    mxg_options_set(job->cli.options, "max-outputs", "64");
    if (!args_is_given(&job->cli.parser, "aovs") && !job_shows_slots(job)
        && !job_writes_channels(job))
        mxg_options_set(job->cli.options, "aovs", "none");
    /* there is no map of a stage */
    if (!job->options.path_trace && !args_is_given(&job->cli.parser, "ambient-occlusion"))
        mxg_options_set(job->cli.options, "ambient-occlusion", "primvar");
    /* the device's samplers have neither arbitrary border colours nor cubic filters */
    if (!args_is_given(&job->cli.parser, "texture-modes"))
        mxg_options_set(job->cli.options, "texture-modes", "shared");
    /* there is no picture of MaterialX to match */
    if (!job->options.path_trace && !args_is_given(&job->cli.parser, "quality"))
        mxg_options_set(job->cli.options, "quality", "reference");
    if (job->options.path_trace) {
        mxg_options_set(job->cli.options, "role", "scatter");
        job->painter.trace.paths = (uint32_t)job->options.paths;
        job->painter.trace.bounces = (uint32_t)job->options.bounces;
        job->painter.trace.picks = (uint32_t)job->options.picks;
        job->painter.trace.as_drawn = job->options.as_drawn;
    }
    job->values = split_settings(&job->options.settings);
    job->painter.values = job->values;
    job->painter.num_values = job->options.settings.len;
    apply_environments(job);
    return job->values && apply_interface(job);
}

static unsigned fact(bool is_true, enum render_fact fact)
{
    return is_true ? (unsigned)fact : 0u;
}

/* True if the shaders sample the environment. */
static bool is_sampled(const struct job *job)
{
    for (size_t i = 0; i < job->options.environments.len; ++i)
        if (strcmp(job->options.environments.items[i], "none") == 0
            || strcmp(job->options.environments.items[i], "prefiltered") == 0)
            return false;
    return !job->options.path_trace;
}

static bool is_role(const struct job *job, const char *role)
{
    return args_has_setting(&job->cli.parser, "role", role);
}

/* True if the role is one that a raster draws. */
static bool is_drawn(const struct job *job)
{
    return !args_is_given(&job->cli.parser, "role") || is_role(job, "raster")
           || is_role(job, "path") || is_role(job, "deferred");
}

unsigned job_find_facts(const struct job *job, bool is_grid, bool is_one)
{
    const struct render_options *options = &job->options;
    bool is_display = !options->output || !image_is_linear(options->output)
                      || (options->copy && !image_is_linear(options->copy));
    return fact(job->painter.is_studio, FACT_STUDIO)
           | fact(!job->painter.studio.environment, FACT_NO_MAP) | fact(!is_grid, FACT_PICTURE)
           | fact(is_display || !is_one, FACT_DISPLAY) | fact(is_one, FACT_ONE_FILE)
           | fact(is_one && !options->frames, FACT_ONE_PICTURE) | fact(!options->frames, FACT_STILL)
           | fact(options->path_trace, FACT_TRACED) | fact(!options->path_trace, FACT_RASTER)
           | fact(is_sampled(job), FACT_SAMPLED) | fact(!options->look, FACT_NO_LOOK)
           | fact(job_writes_channels(job), FACT_CHANNELS) | fact(options->stage, FACT_STAGE)
           | fact(!options->stage, FACT_NO_STAGE)
           | fact(job_shows_slots(job) ? options->stage != NULL : is_role(job, "deferred"),
                  FACT_SHOWN)
           | fact(is_drawn(job), FACT_DRAWN)
           | fact(!job->painter.studio.prefiltered, FACT_NOT_PREFILTERED);
}

bool job_parse(struct job *job)
{
    return parse_size(job) && parse_layer_sample(job) && parse(job);
}
