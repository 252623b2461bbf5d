// SPDX-License-Identifier: Apache-2.0
/* mxgen-render: renders pictures of materials without a display. `mxgen render` starts it. */
#define _POSIX_C_SOURCE 200809L
#include "cli/cli.h"
#include "cli/files.h"
#include "cli/folder.h"
#include "cli/outputs.h"
#include "cli/parent.h"
#include "cli/render_options.h"
#include "cli/stage.h"
#include "render/applies.h"
#include "render/bake.h"
#include "render/picture.h"
#include "render/sheet.h"
#include "render/stage_picture.h"

#include <math.h>
#include <assert.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#define OVERSAMPLING 2  /* samples per pixel and axis */
#define MAX_LIGHTS 1024 /* of --max-lights */

/* The studio takes any mesh. The other scenes are fixed, for tests and patterns. */
enum scene_kind { SCENE_STUDIO, SCENE_SPHERE, SCENE_PLANE, SCENE_GRID, NUM_SCENES };

static const struct {
    const char *name;
    /* factor for a white surface in the daylight of the scene; 1 for unchanged values */
    double exposure;
} scene_kinds[NUM_SCENES] = {[SCENE_STUDIO] = {"studio", 0.6},
                             [SCENE_SPHERE] = {"sphere", 0.6},
                             [SCENE_PLANE] = {"plane", 1.0},
                             [SCENE_GRID] = {"grid", 1.0}};

static const char *const background_names[] = {"backdrop", "environment", "none", NULL};

struct job {
    struct cli cli;
    struct render_options options;
    struct painter painter;
    enum scene_kind scene_kind;
    double layer_sample; /* below 0: not given */
    struct stage stage;
    struct bind_value *values;
    struct arg_list found; /* documents, including those in folders; allocated */
    struct outputs files;  /* files that the command reads or writes */
};

/* ---- Arguments ---- */

/* True if a file of one picture has channels for AOVs. */
static bool writes_channels(const struct job *job)
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

static void free_values(struct bind_value *values, size_t count)
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
}

/* Reduces the interface for a smaller shader: only the inputs that the user sets stay uniforms. */
static bool apply_interface(struct job *job)
{
    if (job->options.settings.len || args_is_given(&job->cli.parser, "interface"))
        return true;
    return report_status(&job->cli.report,
                         mxg_options_set(job->cli.options, "interface", "reduced"));
}

/* True if --camera is the path of a camera on the stage. */
static bool names_camera(const struct job *job)
{
    return job->options.stage && job->options.camera && *job->options.camera == '/';
}

/* True if --show draws colours by slot, and not a view of what is stored. */
static bool shows_slots(const struct job *job)
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
    if (job->options.camera && !names_camera(job)
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
    if (!args_is_given(&job->cli.parser, "aovs") && !shows_slots(job) && !writes_channels(job))
        mxg_options_set(job->cli.options, "aovs", "none");
    if (!args_is_given(&job->cli.parser, "ambient-occlusion")) /* there is no map of a stage */
        mxg_options_set(job->cli.options, "ambient-occlusion", "primvar");
    /* the device's samplers have neither arbitrary border colours nor cubic filters */
    if (!args_is_given(&job->cli.parser, "texture-modes"))
        mxg_options_set(job->cli.options, "texture-modes", "shared");
    /* there is no picture of MaterialX to match */
    if (!job->options.path_trace && !args_is_given(&job->cli.parser, "sample-filter"))
        mxg_options_set(job->cli.options, "sample-filter", "narrow");
    if (job->options.path_trace) {
        mxg_options_set(job->cli.options, "integrator", "scatter");
        job->painter.trace.paths = (uint32_t)job->options.paths;
        job->painter.trace.bounces = (uint32_t)job->options.bounces;
        job->painter.trace.as_drawn = job->options.as_drawn;
    }
    job->values = split_settings(&job->options.settings);
    job->painter.values = job->values;
    job->painter.num_values = job->options.settings.len;
    apply_environments(job);
    return job->values && apply_interface(job);
}

/* ---- Scene ---- */

static bool note_parts(struct job *job, unsigned made)
{
    static const struct {
        enum mesh_part part;
        const char *name;
    } parts[] = {{MESH_NORMALS, "normals"},
                 {MESH_TEXCOORDS, "texture coordinates"},
                 {MESH_TANGENTS, "tangents"}};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; ++i) {
        if ((made & parts[i].part) && !job->cli.quiet)
            fprintf(stderr, "note: the mesh '%s' has no %s; they were made\n",
                    job->painter.studio.mesh, parts[i].name);
    }
    return true;
}

static void tell_bad_environment(struct job *job, const char *name, const struct image *map)
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
        unsigned made = 0;
        struct studio_fault fault;
        if (studio_open(&painter->studio, aspect, &painter->scene, &made, &fault)) {
            tell_bad_environment(job, painter->studio.environment, &painter->scene.radiance);
            return note_parts(job, made);
        }
        report_error(&job->cli.report, fault.id, "%s", fault.text);
        return false;
    }
    bool good = job->scene_kind == SCENE_GRID    ? scene_init_grid(&painter->scene)
                : job->scene_kind == SCENE_PLANE ? scene_init_plane(&painter->scene)
                                                 : scene_init_sphere(&painter->scene, aspect);
    return good || report_status(&job->cli.report, MXG_ERROR_MEMORY);
}

/* Lengths of documents are in the unit of the stage, where it is one of MaterialX's. */
static void apply_unit(struct job *job)
{
    static const struct {
        const char *name;
        double meters;
    } units[] = {{"meter", 1},     {"centimeter", 0.01}, {"millimeter", 0.001}, {"kilometer", 1000},
                 {"inch", 0.0254}, {"foot", 0.3048},     {"micron", 1e-6},      {"nanometer", 1e-9},
                 {"yard", 0.9144}, {"mile", 1609.344}};
    double unit = job->stage.meters_per_unit;
    if (args_is_given(&job->cli.parser, "distance-unit") || unit <= 0)
        return;
    for (size_t i = 0; i < sizeof units / sizeof *units; ++i)
        if (fabs(unit / units[i].meters - 1) < 1e-5)
            mxg_options_set(job->cli.options, "distance-unit", units[i].name);
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
    const struct stage *stage = &job->stage;
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
        mxg_options_set(job->cli.options, "environment", "none");
        job->painter.trace.dark = true;
    }
}

static bool make_stage(struct job *job)
{
    struct painter *painter = &job->painter;
    double aspect = (double)painter->width / painter->height;
    if (!stage_open(&job->stage, job->cli.context, &job->cli.report, job->options.stage,
                    job->options.purpose))
        return false;
    apply_unit(job);
    if (!stage_light(&job->stage, &painter->studio, &painter->scene))
        return false;
    apply_lights(job);
    tell_bad_environment(job, painter->studio.environment, &painter->scene.radiance);
    return stage_aim(&job->stage, &painter->studio, names_camera(job) ? job->options.camera : NULL,
                     job->options.camera && !names_camera(job), aspect, &painter->scene);
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

static bool prepare(struct job *job)
{
    struct painter *painter = &job->painter;
    painter->oversampling = job->scene_kind == SCENE_GRID ? 1 : OVERSAMPLING;
    if (!(job->options.stage ? make_stage(job) : make_scene(job)))
        return false;
    painter->scene.environment_samples = (uint32_t)job->options.samples;
    painter->scene.frame = (int32_t)job->options.frame;
    painter->scene.layer_sample = job->layer_sample;
    return open_gpu(job);
}

/* ---- Work ---- */

/* Prints "[3/40] Gold" on a terminal, over the previous line; prints nothing to a pipe. */
static void report_progress(const struct job *job, size_t done, size_t count, const char *name)
{
    if (job->cli.quiet || count < 2 || !isatty(STDERR_FILENO))
        return;
    if (done == count)
        fputs("\r\033[K", stderr);
    else
        fprintf(stderr, "\r\033[K[%zu/%zu] %s", done + 1, count, name);
    fflush(stderr);
}

static void draw_one(struct job *job, const struct subject *subject)
{
    struct image picture;
    job->painter.wants_aovs = writes_channels(job);
    if (picture_draw(&job->painter, subject, 1, &picture)) {
        picture_write(&job->painter, job->options.output, &picture);
        if (job->options.copy)
            picture_write(&job->painter, job->options.copy, &picture);
    }
    image_finish(&picture);
}

/* "turn.png" becomes "turn.0007.png". */
static char *frame_name(const char *output, size_t frame)
{
    const char *base = files_base_name(output), *dot = strrchr(base, '.');
    int stem = (int)(dot ? (size_t)(dot - output) : strlen(output));
    return cli_format("%.*s.%04zu%s", stem, output, frame, output + stem);
}

static void draw_turntable(struct job *job, const struct subject *subject)
{
    struct painter *painter = &job->painter;
    struct painting painting;
    bool good = painting_open(painter, subject, 1, &painting);
    for (size_t i = 0; good && i < job->options.frames; ++i) {
        struct image picture;
        char *name = frame_name(job->options.output, i);
        report_progress(job, i, job->options.frames, name);
        studio_aim(&painter->studio, (double)painter->width / painter->height,
                   360.0 * (double)i / (double)job->options.frames, &painter->scene);
        painting_aim(&painting);
        good = painting_draw(&painting, &picture) && picture_write(painter, name, &picture);
        image_finish(&picture);
        free(name);
    }
    report_progress(job, job->options.frames, job->options.frames, "");
    painting_close(&painting);
}

static void print_slot(void *user_data, const char *slot, const unsigned char color[3])
{
    const struct job *job = user_data;
    if (!job->cli.quiet)
        fprintf(stderr, "slot %s: #%02x%02x%02x\n", slot, color[0], color[1], color[2]);
}

static void draw_stage(struct job *job, const mxg_document *document, const char *path)
{
    struct stage_subjects subjects;
    struct image picture = {0};
    const char *show = shows_slots(job) ? job->options.show : NULL;
    job->painter.wants_aovs = show || writes_channels(job);
    if (stage_subjects_make(&job->painter, &job->stage, document, path, job->options.look,
                            &subjects)
        && picture_draw(&job->painter, subjects.items, subjects.len, &picture)) {
        if (show)
            aovs_show(&job->painter.aovs, strcmp(show, "weights") == 0, &picture, print_slot, job);
        picture_write(&job->painter, job->options.output, &picture);
        if (job->options.copy)
            picture_write(&job->painter, job->options.copy, &picture);
    }
    image_finish(&picture);
    stage_subjects_finish(&subjects);
}

/* ---- Contact sheets ---- */

struct item {
    struct subject subject;
    char *name;
};

struct items {
    struct item *items;
    mxg_document **documents;
    size_t len, num_documents;
};

static void add_item(struct items *list, const mxg_document *document, const char *path,
                     const char *element)
{
    struct item *more = realloc(list->items, (list->len + 1) * sizeof *more);
    if (!more)
        return;
    list->items = more;
    more[list->len++] = (struct item){{.document = document, .path = path, .element = element},
                                      cli_format("%s", element)};
}

/* Adds the materials of the requested look, or the renderables. */
static void add_elements(struct job *job, struct items *list, const mxg_document *document,
                         const char *path)
{
    mxg_renderable renderable = {sizeof renderable};
    uint32_t i = 0;
    if (job->options.look) {
        for (; mxg_document_look_material(document, job->options.look, i, &renderable) == MXG_OK;
             ++i)
            add_item(list, document, path, renderable.path);
        if (i == 0)
            report_error(&job->cli.report, "no-look",
                         "'%s' has no look '%s' that assigns a material", path, job->options.look);
        return;
    }
    for (; i < mxg_document_num_renderables(document); ++i) {
        mxg_document_renderable(document, i, &renderable);
        if (!job->options.element || strcmp(job->options.element, renderable.path) == 0)
            add_item(list, document, path, renderable.path);
    }
    if (i == 0 || (list->len == 0 && job->options.element)) /* generation reports the error */
        add_item(list, document, path, job->options.element);
}

/* Loads a document and notes its files. */
static mxg_document *load(struct job *job, const char *path)
{
    mxg_document *document = cli_load(&job->cli, path);
    bool good = true;
    for (uint32_t i = 0; i < mxg_document_num_files(document); ++i)
        good = outputs_read(&job->files, &job->cli.report, mxg_document_file(document, i)) && good;
    if (good)
        return document;
    job->painter.has_clash = true;
    mxg_document_destroy(document);
    return NULL;
}

static void load_items(struct job *job, struct items *list)
{
    list->documents = calloc(job->found.len + 1, sizeof *list->documents);
    for (size_t i = 0; list->documents && i < job->found.len; ++i) {
        mxg_document *document = load(job, job->found.items[i]);
        if (!document)
            continue;
        list->documents[list->num_documents++] = document;
        add_elements(job, list, document, job->found.items[i]);
    }
}

static void free_items(struct items *list)
{
    for (size_t i = 0; i < list->len; ++i)
        free(list->items[i].name);
    for (size_t i = 0; i < list->num_documents; ++i)
        mxg_document_destroy(list->documents[i]);
    free(list->items);
    free(list->documents);
}

static void place(struct job *job, struct sheet *sheet, size_t index, const struct item *item)
{
    struct image linear, shown = {0};
    bool good = picture_draw(&job->painter, &item->subject, 1, &linear)
                && picture_develop(&job->painter, &linear, &shown);
    sheet_place(sheet, (uint32_t)index, good ? &shown : NULL, item->name);
    image_finish(&linear);
    image_finish(&shown);
}

static void draw_sheet(struct job *job, const struct items *list)
{
    struct sheet sheet;
    char reason[256];
    if (!sheet_init(&sheet, (uint32_t)list->len, job->painter.width, job->painter.height)) {
        report_status(&job->cli.report, MXG_ERROR_MEMORY);
        return;
    }
    for (size_t i = 0; i < list->len; ++i) {
        report_progress(job, i, list->len, list->items[i].name);
        place(job, &sheet, i, &list->items[i]);
    }
    report_progress(job, list->len, list->len, "");
    if (!job->painter.has_clash
        && !image_write(job->options.output, &sheet.image, reason, sizeof reason))
        report_error(&job->cli.report, "output-failed", "cannot write '%s': %s",
                     job->options.output, reason);
    sheet_finish(&sheet);
}

/* ---- Values ---- */

/* Number of components that a pixel shows; a non-vector type becomes a colour. */
static unsigned num_components(const char *type)
{
    if (strcmp(type, "float") == 0)
        return 1;
    if (strcmp(type, "vector2") == 0)
        return 2;
    return strcmp(type, "color4") == 0 || strcmp(type, "vector4") == 0 ? 4 : 3;
}

static void print_values(const char *element, unsigned components, const struct image *image)
{
    fputs(element, stdout);
    for (uint32_t y = image->height; y-- > 0;)
        for (uint32_t x = 0; x < image->width; ++x)
            for (unsigned c = 0; c < components; ++c)
                printf(",%.9g",
                       (double)((float *)image->pixels)[4 * ((size_t)y * image->width + x) + c]);
    putchar('\n');
}

/* Prints a line per element: its path, then the values of the 16 pixels in rows from the bottom. */
static void draw_grid(struct job *job, const mxg_document *document, const char *path)
{
    for (uint32_t i = 0; i < mxg_document_num_renderables(document); ++i) {
        mxg_renderable renderable = {sizeof renderable};
        mxg_document_renderable(document, i, &renderable);
        if (job->options.element && strcmp(job->options.element, renderable.path) != 0)
            continue;
        const struct subject subject = {
            .document = document, .path = path, .element = renderable.path};
        struct image pixels;
        if (picture_draw(&job->painter, &subject, 1, &pixels))
            print_values(renderable.path, num_components(renderable.type), &pixels);
        image_finish(&pixels);
    }
}

/* ---- Commands ---- */

/* A picture shows one element; with several, the user learns which one. */
static void tell_choice(const struct job *job, const mxg_document *document)
{
    mxg_renderable first = {sizeof first};
    uint32_t count = mxg_document_num_renderables(document);
    if (job->options.element || job->cli.quiet || job->scene_kind == SCENE_GRID || count < 2
        || mxg_document_renderable(document, 0, &first) != MXG_OK)
        return;
    fprintf(stderr,
            "note: '%s' is rendered, the first of %u elements; -e PATH selects another, and a "
            "folder gives a sheet of all\n",
            first.path, count);
}

/* Renders one picture of the first element, or of the requested one. */
static void render_file(struct job *job, const char *path)
{
    mxg_document *document = load(job, path);
    struct subject subject = {.document = document, .path = path, .element = job->options.element};
    if (document && prepare(job)) {
        tell_choice(job, document);
        if (job->scene_kind == SCENE_GRID)
            draw_grid(job, document, path);
        else if (job->options.frames)
            draw_turntable(job, &subject);
        else
            draw_one(job, &subject);
    }
    mxg_document_destroy(document);
}

/* Renders the stage. `path` is the document of the look; NULL: the stage brings all. */
static void render_stage(struct job *job, const char *path)
{
    mxg_document *own = path ? load(job, path) : NULL, *document = NULL;
    if ((!path || own) && prepare(job))
        document = stage_document(job->cli.context, job->cli.library, &job->cli.report, own,
                                  job->stage.scene);
    if (document)
        draw_stage(job, document, path ? path : job->options.stage);
    mxg_document_destroy(document);
    mxg_document_destroy(own);
}

static void render_all(struct job *job)
{
    struct items list = {0};
    load_items(job, &list);
    if (list.len && !job->painter.has_clash && prepare(job)) {
        if (list.len == 1)
            draw_one(job, &list.items[0].subject);
        else
            draw_sheet(job, &list);
    }
    free_items(&list);
}

/* Collects the documents, including those in folders. */
static bool find_documents(struct job *job)
{
    const char *reason = NULL,
               *path = folder_documents(&job->cli.parser.inputs, &job->found, &reason);
    if (path)
        report_error(&job->cli.report, "nothing-to-render", "'%s': %s", path, reason);
    return !path;
}

/* mxgen render --bake-environment FILE -o FOLDER */
static int bake(struct job *job)
{
    struct studio_fault fault;
    struct baked baked = {0};
    struct image map = {0};
    char reason[256] = "out of memory";
    struct studio studio = {.environment =
                                strcmp(job->options.baked, "sky") == 0 ? NULL : job->options.baked};
    if (!job->options.output) {
        fputs("usage: mxgen render --bake-environment FILE -o FOLDER\n", stderr);
        return EXIT_USAGE;
    }
    const char *why = NULL;
    if (!studio_read_map(&studio, &map, &fault))
        report_error(&job->cli.report, fault.id, "%s", fault.text);
    else if (!bake_environment(&map, &baked))
        report_status(&job->cli.report, MXG_ERROR_MEMORY);
    else if ((why = files_make_folder(job->options.output)) != NULL
             || !baked_write(&baked, job->options.output, reason, sizeof reason))
        report_error(&job->cli.report, "output-failed", "cannot write to '%s': %s",
                     job->options.output, why ? why : reason);
    tell_bad_environment(job, job->options.baked, &map);
    baked_finish(&baked);
    image_finish(&map);
    return job->cli.report.errors ? EXIT_FAULT : EXIT_DONE;
}

/* Notes the files that every picture needs. */
static bool claim_inputs(struct job *job)
{
    struct report *report = &job->cli.report;
    bool good = true;
    for (size_t i = 0; i < job->found.len; ++i)
        good = outputs_read(&job->files, report, job->found.items[i]) && good;
    for (uint32_t i = 0; i < mxg_library_num_files(job->cli.library); ++i)
        good = outputs_read(&job->files, report, mxg_library_file(job->cli.library, i)) && good;
    if (job->painter.studio.environment)
        good = outputs_read(&job->files, report, job->painter.studio.environment) && good;
    if (job->options.stage)
        good = outputs_read(&job->files, report, job->options.stage) && good;
    if (files_is_regular(job->painter.studio.mesh))
        good = outputs_read(&job->files, report, job->painter.studio.mesh) && good;
    return good;
}

/* Notes the pictures; false after an error: one of them is an input, or two are one file. */
static bool claim_outputs(struct job *job)
{
    struct report *report = &job->cli.report;
    bool good = true;
    for (size_t i = 0; i < job->options.frames; ++i) {
        char *name = frame_name(job->options.output, i);
        good = good && outputs_write(&job->files, report, name, "the turntable");
        free(name);
    }
    if (job->options.output && !job->options.frames)
        good = outputs_write(&job->files, report, job->options.output, "-o") && good;
    if (job->options.copy)
        good = outputs_write(&job->files, report, job->options.copy, "--copy") && good;
    return claim_inputs(job) && good;
}

/* Checked before rendering, which may take long. */
static bool can_write(struct job *job, const char *path)
{
    char reason[256];
    if (!path || image_can_write(path, reason, sizeof reason))
        return true;
    report_error(&job->cli.report, "output-failed", "cannot write '%s': %s", path, reason);
    return false;
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

static unsigned find_facts(const struct job *job, bool is_grid, bool is_one)
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
           | fact(writes_channels(job), FACT_CHANNELS) | fact(options->stage, FACT_STAGE)
           | fact(!options->stage, FACT_NO_STAGE)
           | fact(shows_slots(job) ? options->stage != NULL
                                   : args_is_given(&job->cli.parser, "pipeline"),
                  FACT_SHOWN);
}

/* mxgen render --stage FILE --list */
static int list_stage(struct job *job)
{
    if (!job->options.stage) {
        fputs("usage: mxgen render --stage FILE --list\n", stderr);
        return EXIT_USAGE;
    }
    if (stage_open(&job->stage, job->cli.context, &job->cli.report, job->options.stage,
                   job->options.purpose))
        stage_list(&job->stage);
    stage_close(&job->stage);
    return job->cli.report.errors ? EXIT_FAULT : EXIT_DONE;
}

static int run(struct job *job)
{
    const struct arg_list *inputs = &job->cli.parser.inputs;
    if (job->options.baked && inputs->len == 0)
        return applies_to_bake(&job->cli.parser) ? bake(job) : EXIT_USAGE;
    if (job->options.baked || (inputs->len == 0 && !job->options.stage)) {
        fputs(job->options.baked ? "usage: mxgen render --bake-environment FILE -o FOLDER\n"
                                 : "usage: mxgen render FILE|FOLDER... -o PICTURE.png\n",
              stderr);
        return EXIT_USAGE;
    }
    if (job->options.list)
        return list_stage(job);
    bool is_grid = !strcmp(job->options.scene, "grid"),
         is_one = job->options.stage ? inputs->len < 2
                                     : inputs->len == 1 && !files_is_folder(inputs->items[0])
                                           && !job->options.look;
    if (!job->options.output && !is_grid) {
        fputs("mxgen: where to? say -o PICTURE.png\n", stderr);
        return EXIT_USAGE;
    }
    if (!job->options.size)
        job->options.size = is_grid ? "4" : is_one ? "512" : "160";
    if (!cli_options_apply(&job->cli, (const char *const[]){"vulkan"}, 1) || !parse_size(job)
        || !parse_layer_sample(job) || !parse(job)
        || !applies_all(&job->cli.parser, find_facts(job, is_grid, is_one)))
        return EXIT_USAGE;
    if (can_write(job, job->options.output) && can_write(job, job->options.copy)
        && find_documents(job) && claim_outputs(job)) {
        compile_begin();
        if (job->options.stage)
            render_stage(job, job->found.len ? job->found.items[0] : NULL);
        else if (is_one)
            render_file(job, job->found.items[0]);
        else
            render_all(job);
        compile_end();
        gpu_close(&job->painter.gpu);
        mesh_finish(&job->painter.fine);
        scene_finish(&job->painter.scene);
        stage_close(&job->stage);
    }
    return job->cli.report.errors ? EXIT_FAULT : EXIT_DONE;
}

int main(int argc, char **argv)
{
    static const struct command command = {
        "render", "render FILE|FOLDER... -o PICTURE.png [options]",
        "Renders materials without a display: one picture, or a sheet of several.", NULL};
    struct job job = {.options = RENDER_OPTIONS_DEFAULTS, .painter.studio = STUDIO_DEFAULTS};
    struct arg args[MAX_RENDER_ARGS];
    size_t num_args = render_args(&job.options, args);
    int code;
    parent_follow();
    if (cli_start(&job.cli, &command, args, num_args, CLI_GENERATES, argc, argv, &code)) {
        job.painter.cli = &job.cli;
        job.painter.files = &job.files;
        job.painter.studio.mesh = job.options.mesh;
        /*
         * llvmpipe's optimiser takes minutes for large shaders. Without it the pictures are the
         * same after seconds.
         */
        if (!job.options.path_trace)
            setenv("GALLIVM_PERF", "nopt", 0);
        code = run(&job);
    }
    cli_finish(&job.cli);
    args_free(&job.found);
    names_finish(&job.painter.told_textures);
    aovs_finish(&job.painter.aovs);
    outputs_finish(&job.files);
    free_values(job.values, job.options.settings.len);
    free(job.options.settings.items);
    free(job.options.environments.items);
    return code;
}
