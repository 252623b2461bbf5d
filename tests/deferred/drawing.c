// SPDX-License-Identifier: Apache-2.0
#include "deferred/drawing.h"

#include "unit/test.h"

#include <math.h>
#include <stdlib.h>

static bool open_device(struct bench *b)
{
    if (!gpu_open(&b->gpu) || !b->gpu.can_store) {
        printf("skip: no device that can store: %s\n", b->gpu.reason);
        return false;
    }
    const char *target = getenv("DEFERRED_TARGET");
    b->target = target ? target : "vulkan";
    compile_begin();
    REQUIRE_EQ(mxg_context_create(NULL, &b->context), MXG_OK);
    REQUIRE_EQ(mxg_options_create(b->context, &b->options), MXG_OK);
    mxg_options_set(b->options, "interface", "reduced");
    /* a stored roughness is not quite that of a forward shader, which then takes other samples */
    mxg_options_set(b->options, "quality", "reference");
    return true;
}

bool bench_open_ball(struct bench *b)
{
    if (!open_device(b))
        return false;
    REQUIRE(scene_init_sphere(&b->scene, 1));
    mxg_options_set(b->options, "texture-modes", "shared");
    return true;
}

bool bench_open_plane(struct bench *b)
{
    if (!open_device(b))
        return false;
    REQUIRE(scene_init_plane(&b->scene));
    b->scene.num_lights = 1;
    mxg_options_set(b->options, "environment", "none");
    return true;
}

static bool take(struct bench *b, mxg_status status, mxg_document *document)
{
    mxg_document_destroy(b->document);
    b->document = document;
    return REQUIRE_EQ(status, MXG_OK);
}

bool bench_load(struct bench *b, const char *root, const char *path)
{
    mxg_document *document = NULL;
    snprintf(b->path, sizeof b->path, "%s/%s", root, path);
    mxg_status status =
        mxg_document_load(b->context, mxg_library_builtin(b->context), b->path, &document);
    return take(b, status, document);
}

bool bench_parse(struct bench *b, const char *name, const char *text)
{
    mxg_document *document = NULL;
    mxg_status status = mxg_document_parse(b->context, mxg_library_builtin(b->context), name, text,
                                           strlen(text), &document);
    return take(b, status, document);
}

void bench_close(struct bench *b)
{
    mxg_document_destroy(b->document);
    mxg_options_destroy(b->options);
    mxg_context_destroy(b->context);
    scene_finish(&b->scene);
    gpu_close(&b->gpu);
    compile_end();
}

bool drawing_generate(struct bench *b, const char *element, const char *role_name,
                      const char *storage, mxg_result **out)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    /* the stages of these tests that call a function are GLSL */
    bool is_called = strcmp(role_name, "payload") == 0 || strcmp(role_name, "pack") == 0;
    desc.target = is_called ? "vulkan" : b->target;
    desc.element = b->bindings ? NULL : element;
    desc.bindings = b->bindings;
    desc.options = b->options;
    mxg_options_set(b->options, "role", role_name);
    mxg_options_set(b->options, "storage", storage);
    bool is_payload = strcmp(role_name, "payload") == 0; /* its pass has the environment */
    if (is_payload)
        mxg_options_set(b->options, "quality", "good");
    mxg_status status = mxg_generate(b->context, b->document, &desc, out);
    if (is_payload)
        mxg_options_set(b->options, "quality", "reference");
    mxg_diagnostic first = {sizeof first};
    if (*out && mxg_diagnostics_item(mxg_result_diagnostics(*out), 0, &first) == MXG_OK
        && first.severity <= MXG_SEVERITY_WARNING)
        printf("%s: %s\n", element, first.message);
    return REQUIRE_EQ(status, MXG_OK);
}

static bool add_program(struct bench *b, struct drawing *d, const char *element,
                        const char *role_name, const char *storage, enum draw_role role)
{
    size_t i = d->count++;
    if (!drawing_generate(b, element, role_name, storage, &d->results[i]))
        return false;
    d->binds[i] = (struct bind){.result = d->results[i], .scene = &b->scene, .document = b->path};
    d->binds[i].draw.role = role;
    return true;
}

bool drawing_open_passes(struct bench *b, struct drawing *d, const struct passes_setup *what)
{
    struct passes_setup setup = *what;
    setup.context = b->context;
    setup.options = b->options;
    setup.target = b->target;
    setup.scene = &b->scene;
    setup.canvas = d->canvas;
    setup.host = b->host;
    bool good = passes_open(&setup, &d->passes);
    if (!good)
        printf("%s\n", d->passes.reason);
    return REQUIRE(good);
}

static bool open_passes(struct bench *b, struct drawing *d, uint32_t shown)
{
    struct bind *const binds[] = {&d->binds[0]};
    const uint32_t all = UINT32_MAX;
    const struct passes_setup stores = {.words = d->stored_words + b->words,
                                        .classes = b->decals ? all : d->stored_classes,
                                        .decals = b->decals,
                                        .painted = {b->painted[0], b->painted[1]},
                                        .binds = binds,
                                        .num_binds = 1,
                                        .shown = shown};
    bool good = drawing_open_passes(b, d, &stores);
    if (good)
        stored_mark(d->passes.stored, MARK);
    return good;
}

/* Reads what the last program stores: images are for the largest material. */
static void read_info(struct drawing *d, bool *out_has_holes)
{
    mxg_shader_info info = {sizeof info};
    struct bind *bind = &d->binds[d->count - 1];
    mxg_storage storage = {sizeof storage};
    mxg_result_info(bind->result, &info);
    mxg_result_storage(bind->result, &storage);
    *out_has_holes = storage.words && info.alpha == MXG_ALPHA_MASK;
    d->layout = storage.layout;
    d->stored_classes |= storage.classes;
    if (storage.words > d->stored_words)
        d->stored_words = storage.words;
    if (storage.words)
        bind->draw.role = DRAW_STORES;
    bind->draw.has_holes = *out_has_holes;
}

bool drawing_frame(struct drawing *d, size_t num_programs)
{
    bool is_finite = REQUIRE(render_frame(d->renders, num_programs, d->canvas, d->pixels));
    for (size_t i = 0; is_finite && i < PIXELS * 4; ++i)
        is_finite = isfinite(d->pixels[i]);
    return REQUIRE(is_finite);
}

static bool draw_programs(struct bench *b, struct drawing *d)
{
    bool good = true;
    for (size_t i = 0; good && i < d->count; ++i) {
        good = render_open(&d->renders[i], d->canvas, &b->gpu, &d->binds[i]);
        if (!good)
            printf("%s\n", d->binds[i].reason);
    }
    return REQUIRE(good) && drawing_frame(d, d->count);
}

static void begin(struct bench *b, struct drawing *d)
{
    *d = (struct drawing){.pixels = malloc(PIXELS * 4 * sizeof(float))};
    d->canvas = draw_open_canvas(&b->gpu, SIZE, SIZE);
}

bool drawing_open(struct bench *b, const char *element, const char *storage, uint32_t shown,
                  struct drawing *d)
{
    bool has_holes;
    begin(b, d);
    if (!add_program(b, d, element, storage ? "deferred" : "raster", storage ? storage : "dither",
                     DRAW_LIT))
        return false;
    read_info(d, &has_holes);
    return (!d->stored_words || open_passes(b, d, shown))
           && (!has_holes || add_program(b, d, element, "depth", storage, DRAW_CUTS))
           && draw_programs(b, d);
}

bool drawing_open_both(struct bench *b, const struct drawing_part parts[2], struct drawing *d)
{
    bool has_holes = false;
    begin(b, d);
    for (int i = 0; i < 2; ++i) {
        if (!add_program(b, d, parts[i].element, "deferred", "round", DRAW_STORES))
            return false;
        read_info(d, &has_holes);
        d->binds[i].objects = &parts[i].object;
        d->binds[i].num_objects = 1;
    }
    return REQUIRE(!has_holes) && open_passes(b, d, UINT32_MAX) && draw_programs(b, d);
}

void drawing_close(struct drawing *d)
{
    for (size_t i = 0; i < d->count; ++i)
        render_close(&d->renders[i]);
    draw_close_canvas(d->canvas);
    passes_close(&d->passes);
    for (size_t i = 0; i < d->count; ++i) {
        bind_finish(&d->binds[i]);
        mxg_result_destroy(d->results[i]);
    }
    free(d->pixels);
    *d = (struct drawing){0};
}
