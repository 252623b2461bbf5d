// SPDX-License-Identifier: Apache-2.0
#include "program/memory.h"
#include "render/default_tokens.h"
#include "render/picture_tell.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Shaders ---- */

static mxg_status generate_for(struct painter *painter, const struct subject *subject,
                               bool without_source, mxg_result **out)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = "vulkan";
    desc.element = subject->bindings ? NULL : subject->element;
    desc.bindings = subject->bindings;
    desc.stack = subject->stack;
    desc.options = painter->cli->options;
    desc.without_source = without_source;
    return mxg_generate(painter->cli->context, subject->document, &desc, out);
}

static bool generate(struct painter *painter, const struct subject *subject, mxg_result **out)
{
    mxg_status status = generate_for(painter, subject, false, out);
    if (*out)
        report_list(&painter->cli->report, mxg_result_diagnostics(*out));
    return report_status(&painter->cli->report, status);
}

/* ---- Drawing ---- */

/* Objects of a stage with triangles small enough for displacement. */
static void refine_objects(struct part *part, const struct subject *subject)
{
    enum { FINE_TRIANGLES = 1 << 14 };
    part->fine = memory_alloc(subject->num_objects * sizeof *part->fine);
    for (uint32_t i = 0; i < subject->num_objects; ++i, ++part->num_fine)
        object_refine(&subject->objects[i], FINE_TRIANGLES, &part->fine[i]);
}

/* A displaced surface needs a mesh with small triangles. */
static void choose_mesh(struct painting *painting, struct part *part, const struct subject *subject)
{
    struct painter *painter = painting->painter;
    mxg_shader_info info = {sizeof info};
    mxg_result_info(part->result, &info);
    if (!info.displaced || !painter->is_studio)
        return;
    if (subject->num_objects) {
        refine_objects(part, subject);
        return;
    }
    if (!painter->fine.vertices)
        studio_refine(&painter->studio, &painter->scene.object.mesh, &painter->fine);
    painting->scene.object.mesh = painter->fine;
}

/* ---- Textures that cannot be read ---- */

static size_t count_files(const struct bind *bind)
{
    struct name_table files = {0};
    bool is_new;
    for (size_t i = 0; i < bind->num_faults; ++i)
        names_add(&files, bind->faults[i].reason, &is_new);
    size_t count = files.num_entries;
    names_finish(&files);
    return count;
}

static bool fail_for_textures(struct painter *painter, const struct bind *bind,
                              const struct subject *subject)
{
    size_t count = count_files(bind);
    picture_tell_textures(painter, bind, subject);
    report_error(&painter->cli->report, bind->id,
                 "%s: %zu texture file%s cannot be read; '--missing-texture checker' draws %s",
                 subject_name(subject), count, count == 1 ? "" : "s",
                 count == 1 ? "a checker in its place" : "checkers in their place");
    return false;
}

/* ---- Values that no input has ---- */

static const char *name_of_path(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* The public input of the same node that the path may mean; NULL: none. */
static const char *closest_input(const mxg_result *result, const char *path)
{
    struct arg_list paths = {0};
    size_t owner = (size_t)(name_of_path(path) - path);
    for (uint32_t i = 0; i < mxg_result_num_variables(result); ++i) {
        mxg_variable variable = {sizeof variable};
        mxg_result_variable(result, i, &variable);
        /* a misspelling rarely changes the first letter, but another input often has another one */
        if (strncmp(variable.path, path, owner + 1) == 0)
            args_append(&paths, variable.path);
    }
    const char *near = args_closest(path, paths.items, paths.len);
    near = near && strncmp(near, path, owner + 1) == 0 ? near : NULL;
    free(paths.items);
    return near;
}

static const char *advice_on_value(const struct painter *painter, const struct part *part)
{
    for (size_t i = 0; i < painter->num_values; ++i) {
        const char *path = painter->values[i].path;
        if (mxg_result_find_variable(part->result, path) == MXG_NONE)
            return closest_input(part->result, path);
    }
    return NULL;
}

static bool fail_for_value(const struct painter *painter, const struct part *part, const char *name)
{
    const struct bind *bind = part->bind;
    const char *near = advice_on_value(painter, part);
    report_error(&painter->cli->report, bind->id,
                 near ? "%s: %s (did you mean '%s'?)"
                      : "%s: %s; the input is unused or compiled in, or the path is misspelled",
                 name, bind->reason, near);
    return false;
}

static bool fail(struct painter *painter, const struct part *part, const struct subject *subject)
{
    const struct bind *bind = part->bind;
    if (bind && bind->id && strcmp(bind->id, "output-clash") == 0)
        painter->has_clash = true;
    const char *name = subject_name(subject);
    if (bind && bind->id && strcmp(bind->id, "missing-texture") == 0)
        return fail_for_textures(painter, bind, subject);
    if (bind && bind->id && strcmp(bind->id, "no-uniform") == 0)
        return fail_for_value(painter, part, name);
    report_error(&painter->cli->report, bind && bind->id ? bind->id : "render-failed", "%s: %s",
                 name, bind ? bind->reason : "out of memory");
    return false;
}

static void init_bind(const struct painting *painting, struct part *part,
                      const struct subject *subject)
{
    const struct painter *painter = painting->painter;
    if (!subject->bindings)
        default_tokens_find(subject->document, painter->cli->context, painter->unwraps,
                            &part->defaults);
    *part->bind = (struct bind){.result = part->result,
                                .scene = &painting->scene,
                                .objects = part->fine ? part->fine : subject->objects,
                                .num_objects = subject->num_objects,
                                .document = subject->path,
                                .files = painter->files,
                                .values = painter->values,
                                .num_values = painter->num_values,
                                .tokens = part->defaults.num ? &part->defaults : subject->tokens,
                                .unwraps = painter->unwraps,
                                .checker = painter->checker};
}

static bool make_part(struct painting *painting, const struct subject *subject, enum draw_role role)
{
    struct part *part = &painting->parts[painting->num_parts++];
    part->subject = subject;
    part->bind = memory_alloc(sizeof *part->bind);
    if (!generate(painting->painter, subject, &part->result))
        return false;
    choose_mesh(painting, part, subject);
    init_bind(painting, part, subject);
    part->bind->draw.role = role;
    return true;
}

/* Makes the program for the depth of what the last part stores, if it has holes. */
static bool make_cuts(struct painting *painting)
{
    struct part *part = &painting->parts[painting->num_parts - 1];
    mxg_options *options = painting->painter->cli->options;
    mxg_shader_info info = {sizeof info};
    mxg_storage storage = {sizeof storage};
    mxg_result_info(part->result, &info);
    mxg_result_storage(part->result, &storage);
    if (!storage.words)
        return true;
    part->bind->draw.role = DRAW_STORES;
    part->bind->draw.has_holes = info.alpha == MXG_ALPHA_MASK;
    if (!part->bind->draw.has_holes)
        return true;
    mxg_options_set(options, "role", "depth");
    bool good = make_part(painting, part->subject, DRAW_CUTS);
    mxg_options_set(options, "role", "deferred");
    return good;
}

/* Generates the shaders of the subjects, and chooses their meshes. */
static bool make_parts(struct painting *painting, const struct subject *subjects, size_t count)
{
    painting->parts = memory_alloc(2 * count * sizeof *painting->parts);
    bool good = true;
    for (size_t i = 0; good && i < count; ++i)
        good = make_part(painting, &subjects[i], DRAW_LIT) && make_cuts(painting);
    return good;
}

/* Opens the passes over what the parts store, if any stores. */
static bool open_passes(struct painting *painting)
{
    struct painter *painter = painting->painter;
    struct passes_setup setup = {.context = painter->cli->context,
                                 .options = painter->cli->options,
                                 .scene = &painting->scene,
                                 .canvas = painting->canvas,
                                 .shown = painter->shown};
    struct bind **binds = memory_alloc(painting->num_parts * sizeof *binds);
    for (size_t i = 0; i < painting->num_parts; ++i) {
        mxg_storage storage = {sizeof storage};
        mxg_result_storage(painting->parts[i].result, &storage);
        setup.words = storage.words > setup.words ? storage.words : setup.words;
        setup.classes |= storage.classes;
        binds[i] = painting->parts[i].bind;
    }
    setup.binds = binds;
    setup.num_binds = painting->num_parts;
    bool good = !setup.words || !painting->canvas || passes_open(&setup, &painting->passes);
    free(binds);
    if (!good)
        report_error(&painter->cli->report, painting->passes.id, "%s", painting->passes.reason);
    return good;
}

/* A canvas with the outputs of the AOVs that are drawn now. NULL: see gpu->reason. */
static struct draw_canvas *open_canvas(struct painter *painter, uint32_t width, uint32_t height)
{
    struct draw_canvas *canvas = draw_open_canvas(&painter->gpu, width, height);
    bool good = canvas != NULL;
    for (size_t i = 0; good && i < painter->num_aovs; ++i) {
        const struct picture_aov *aov = &painter->aovs.items[painter->first_aov + i];
        good = draw_add_output(canvas, aovs_is_whole(aov->type) ? DRAW_WHOLE
                                       : aovs_has_alpha(aov)    ? DRAW_BLENDED
                                                                : DRAW_FLOATS);
    }
    if (good)
        return canvas;
    draw_close_canvas(canvas);
    return NULL;
}

bool painting_open(struct painter *painter, const struct subject *subjects, size_t count,
                   struct painting *painting)
{
    *painting = (struct painting){.painter = painter, .scene = painter->scene};
    uint32_t width = painter->width * painter->oversampling,
             height = painter->height * painter->oversampling;
    if (!make_parts(painting, subjects, count))
        return false;
    painting->samples = memory_alloc((size_t)width * height * 4 * sizeof(float));
    painting->canvas = open_canvas(painter, width, height);
    if (!open_passes(painting))
        return false;
    for (size_t i = 0; i < painting->num_parts; ++i) {
        struct part *part = &painting->parts[i];
        if (!render_open(&part->render, painting->canvas, &painter->gpu, part->bind))
            return fail(painter, part, part->subject);
        picture_tell(painter, part->bind, part->subject);
    }
    return true;
}

void painting_aim(struct painting *painting)
{
    struct scene_object object = painting->scene.object;
    painting->scene = painting->painter->scene;
    painting->scene.object = object;
}

/* A picture with such pixels is written, because it shows their place, but it is an error. */
static void tell_bad_pixels(struct painter *painter, const struct painting *painting,
                            const struct image *picture)
{
    const float *value = picture->pixels;
    size_t count = (size_t)picture->width * picture->height, num_bad = 0, first = 0;
    for (size_t i = 0; i < count; ++i, value += 4) {
        if (isfinite(value[0] + value[1] + value[2] + value[3]))
            continue;
        first = num_bad++ ? first : i;
    }
    mxg_shader_info info = {offsetof(mxg_shader_info, topology)};
    mxg_result_info(painting->parts[0].result, &info);
    if (num_bad)
        report_error(&painter->cli->report, "bad-pixels",
                     "'%s': %zu of %zu pixels are NaN or infinite, the first at %zu,%zu from the "
                     "top left",
                     painting->num_parts > 1 ? "the stage" : info.path, num_bad, count,
                     first % picture->width, first / picture->width);
}

/* Averages the samples of each pixel, or takes the first one. */
static void resolve(const struct painter *painter, const float *samples, bool averages,
                    struct image *out)
{
    unsigned n = painter->oversampling;
    size_t row = (size_t)painter->width * n;
    *out = (struct image){
        .width = painter->width,
        .height = painter->height,
        .is_float = true,
        .pixels = memory_alloc((size_t)painter->width * painter->height * 4 * sizeof(float))};
    float *pixel = out->pixels;
    for (uint32_t y = 0; y < painter->height; ++y) {
        for (uint32_t x = 0; x < painter->width; ++x, pixel += 4) {
            size_t count = averages ? (size_t)n * n : 1;
            for (size_t i = 0; i < count; ++i) {
                const float *sample = samples + 4 * ((y * n + i / n) * row + x * n + i % n);
                for (size_t c = 0; c < 4; ++c)
                    pixel[c] += sample[c] / (float)count;
            }
        }
    }
}

/* Keeps the AOVs that were drawn. */
static void take_aovs(struct painting *painting)
{
    struct painter *painter = painting->painter;
    for (size_t i = 0; i < painter->num_aovs; ++i) {
        struct picture_aov *aov = &painter->aovs.items[painter->first_aov + i];
        struct image values;
        draw_read_output(painting->canvas, (uint32_t)i + 1, painting->samples);
        resolve(painter, painting->samples, !aovs_is_whole(aov->type), &values);
        aov->pixels = values.pixels;
    }
}

/* A frame in front of a colour, in the samples. */
static bool draw_samples(struct painting *painting, const float behind[4])
{
    struct render *renders = memory_alloc(painting->num_parts * sizeof *renders);
    for (size_t i = 0; i < painting->num_parts; ++i)
        renders[i] = painting->parts[i].render;
    draw_clear_to(painting->canvas, behind);
    bool drawn = (!painting->passes.stored || passes_aim(&painting->passes))
                 && render_frame(renders, painting->num_parts, painting->canvas, painting->samples);
    free(renders);
    if (!drawn) {
        const struct bind *bind = painting->parts[0].bind;
        report_error(&painting->painter->cli->report, bind->id, "%s", bind->reason);
    }
    return drawn;
}

static bool has_two_sources(const struct painting *painting)
{
    for (size_t i = 0; i < painting->num_parts; ++i)
        if (painting->parts[i].bind->draw.blends_twice)
            return true;
    return false;
}

/* How much the picture shows of what lies behind: its difference in front of white. */
static bool find_through(struct painting *painting, struct image *picture)
{
    static const float white[4] = {1, 1, 1, 0};
    size_t count = (size_t)picture->width * picture->height;
    struct image bright;
    if (!draw_samples(painting, white))
        return false;
    picture->through = memory_alloc(count * 3 * sizeof(float));
    resolve(painting->painter, painting->samples, true, &bright);
    const float *with = bright.pixels, *without = picture->pixels;
    for (size_t i = 0; i < 3 * count; ++i)
        picture->through[i] = with[i / 3 * 4 + i % 3] - without[i / 3 * 4 + i % 3];
    image_finish(&bright);
    return true;
}

bool painting_draw(struct painting *painting, struct image *out)
{
    static const float nothing[4] = {0};
    struct painter *painter = painting->painter;
    *out = (struct image){0};
    if (!draw_samples(painting, nothing))
        return false;
    resolve(painter, painting->samples, true, out);
    take_aovs(painting);
    if (has_two_sources(painting) && !find_through(painting, out))
        return false;
    tell_bad_pixels(painter, painting, out);
    return true;
}

void painting_close(struct painting *painting)
{
    for (size_t i = 0; i < painting->num_parts; ++i) {
        struct part *part = &painting->parts[i];
        render_close(&part->render);
        if (part->bind)
            bind_finish(part->bind);
        free(part->bind);
        default_tokens_finish(&part->defaults);
        mxg_result_destroy(part->result);
        for (uint32_t k = 0; k < part->num_fine; ++k)
            object_finish(&part->fine[k]);
        free(part->fine);
    }
    draw_close_canvas(painting->canvas);
    passes_close(&painting->passes);
    free(painting->parts);
    free(painting->samples);
}

/* Renders the same picture with the path tracer. */
static bool picture_trace(struct painter *painter, const struct subject *subjects, size_t count,
                          struct image *out)
{
    struct painting painting = {.painter = painter, .scene = painter->scene};
    size_t pixels = (size_t)painter->width * painter->height;
    *out = (struct image){.width = painter->width,
                          .height = painter->height,
                          .is_float = true,
                          .pixels = memory_alloc(pixels * 4 * sizeof(float)),
                          .through = memory_alloc(pixels * 3 * sizeof(float))};
    struct bind **binds = memory_alloc(count * sizeof(struct bind *));
    bool good = make_parts(&painting, subjects, count);
    for (size_t i = 0; good && i < count; ++i)
        binds[i] = painting.parts[i].bind;
    size_t failed = 0;
    if (good && !trace_picture(&painter->gpu, binds, count, &painter->trace, out, &failed))
        good = fail(painter, &painting.parts[failed], &subjects[failed]);
    for (size_t i = 0; good && i < count; ++i)
        picture_tell(painter, binds[i], &subjects[i]);
    if (good)
        tell_bad_pixels(painter, &painting, out);
    painting_close(&painting);
    free(binds);
    return good;
}

/* ---- AOVs ---- */

/* Finds the AOVs of all subjects: their shaders get the same outputs. */
static bool find_aovs(struct painter *painter, const struct subject *subjects, size_t count)
{
    bool good = true;
    for (size_t i = 0; good && i < count; ++i) {
        mxg_result *result = NULL;
        mxg_status status = generate_for(painter, &subjects[i], true, &result);
        good = status == MXG_OK;
        if (!good && result)
            report_list(&painter->cli->report, mxg_result_diagnostics(result));
        if (!good)
            report_status(&painter->cli->report, status);
        aovs_add(&painter->aovs, result);
        mxg_result_destroy(result);
    }
    return good;
}

static void allocate_aovs(struct painter *painter)
{
    size_t size = (size_t)painter->width * painter->height * 4 * sizeof(float);
    for (size_t i = 0; i < painter->aovs.len; ++i)
        painter->aovs.items[i].pixels = memory_alloc(size);
}

static bool draw_once(struct painter *painter, const struct subject *subjects, size_t count,
                      struct image *out)
{
    struct painting painting;
    bool good = painting_open(painter, subjects, count, &painting) && painting_draw(&painting, out);
    painting_close(&painting);
    return good;
}

/* A device has a few attachments, so many AOVs need several drawings. */
static bool draw_with_aovs(struct painter *painter, const struct subject *subjects, size_t count,
                           struct image *out)
{
    struct image again = {0};
    bool good = true;
    size_t at = 0;
    do {
        size_t rest = painter->aovs.len - at;
        painter->first_aov = at;
        painter->num_aovs = rest < DRAW_MAX_OUTPUTS - 1 ? rest : DRAW_MAX_OUTPUTS - 1;
        aovs_list(&painter->aovs, at, painter->num_aovs, painter->cli->options);
        good = draw_once(painter, subjects, count, at ? &again : out);
        image_finish(&again);
        at += painter->num_aovs;
    } while (good && at < painter->aovs.len);
    painter->num_aovs = 0;
    return good;
}

bool picture_draw(struct painter *painter, const struct subject *subjects, size_t count,
                  struct image *out)
{
    *out = (struct image){0};
    aovs_finish(&painter->aovs);
    if (painter->wants_aovs && !find_aovs(painter, subjects, count))
        return false;
    if (painter->trace.paths) {
        if (painter->wants_aovs)
            aovs_list(&painter->aovs, 0, painter->aovs.len, painter->cli->options);
        painter->trace.aovs = &painter->aovs;
        allocate_aovs(painter);
        return picture_trace(painter, subjects, count, out);
    }
    return painter->wants_aovs ? draw_with_aovs(painter, subjects, count, out)
                               : draw_once(painter, subjects, count, out);
}

/* ---- Background ---- */

/* The background of pixel (x, y). */
static void background(const struct painter *painter, uint32_t x, uint32_t y, double out[4])
{
    memset(out, 0, 4 * sizeof *out);
    if (painter->background == BACKGROUND_NONE)
        return;
    out[3] = 1;
    if (painter->background == BACKGROUND_ENVIRONMENT) {
        scene_backdrop(&painter->scene, 2 * (x + 0.5) / painter->width - 1,
                       1 - 2 * (y + 0.5) / painter->height, out);
        for (size_t c = 0; c < 3; ++c)
            out[c] *= painter->exposure;
        return;
    }
    for (size_t c = 0; c < 3; ++c)
        out[c] = 0.18 - 0.12 * y / painter->height; /* grey, lighter at the top */
}

/* IEC 61966-2-1 */
static uint8_t encode_srgb(double linear)
{
    double x = linear > 0.0 ? fmin(linear, 1.0) : 0.0;
    double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055;
    return (uint8_t)(encoded * 255.0 + 0.5);
}

bool picture_develop(const struct painter *painter, const struct image *linear, struct image *out)
{
    *out = (struct image){.width = linear->width,
                          .height = linear->height,
                          .pixels = malloc((size_t)linear->width * linear->height * 4)};
    const float *in = linear->pixels;
    uint8_t *pixel = out->pixels;
    for (uint32_t y = 0; pixel && y < linear->height; ++y) {
        for (uint32_t x = 0; x < linear->width; ++x, in += 4, pixel += 4) {
            double behind[4], rest = 1 - fmin(in[3], 1);
            const float *through = linear->through;
            background(painter, x, y, behind);
            double alpha = fmin(in[3], 1) + rest * behind[3];
            for (size_t c = 0; c < 3; ++c) { /* 8-bit files are not premultiplied */
                double shown = through ? through[3 * ((size_t)y * linear->width + x) + c] : rest;
                pixel[c] = encode_srgb((painter->exposure * in[c] + shown * behind[c])
                                       / fmax(alpha, 1e-6));
            }
            pixel[3] = (uint8_t)(alpha * 255 + 0.5);
        }
    }
    return out->pixels != NULL;
}

bool picture_write(struct painter *painter, const char *path, const struct image *linear)
{
    char reason[256] = "out of memory";
    struct image shown = {0};
    struct image with_aovs = *linear;
    struct image_plane *planes = aovs_planes(&painter->aovs, &with_aovs.num_planes);
    with_aovs.planes = planes;
    bool good = image_is_linear(path) ? image_write(path, &with_aovs, reason, sizeof reason)
                                      : picture_develop(painter, linear, &shown)
                                            && image_write(path, &shown, reason, sizeof reason);
    if (!good)
        report_error(&painter->cli->report, "output-failed", "cannot write '%s': %s", path, reason);
    image_finish(&shown);
    aovs_finish_planes(planes, with_aovs.num_planes);
    return good;
}
