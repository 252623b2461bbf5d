// SPDX-License-Identifier: Apache-2.0
#include "render/deferred_passes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *const pass_views[] = {"classes",       "bytes",      "closures", "coverage",
                                  "transmittance", "properties", NULL};

static bool fail(struct passes *passes, const char *id, const char *reason)
{
    passes->id = id;
    snprintf(passes->reason, sizeof passes->reason, "%s", reason);
    return false;
}

static bool fail_device(struct passes *passes, const struct passes_setup *setup)
{
    const struct gpu *gpu = draw_gpu(setup->canvas);
    return fail(passes, gpu->id, gpu->reason);
}

/* How the passes run. A picture has the passes of one use. */
enum use { LIGHTS, SHOWS, LIGHTS_RAYS, STORES_OVER };
static const struct {
    const char *name;
    int which; /* as struct stored_pass has it */
    enum use use;
} runs[] = {
    {"classify", STORED_ALL_TILES, LIGHTS},
    {"compose", 0, LIGHTS},
    {"light_simple", 1, LIGHTS},
    {"light_single", 2, LIGHTS},
    {"light_complex", 3, LIGHTS},
    {"light_special", 4, LIGHTS},
    {"diffuse", STORED_ALL_TILES, LIGHTS},
    {"blur", STORED_ALL_TILES, LIGHTS},
    {"show", STORED_ALL_TILES, SHOWS},
    {"light_rays", STORED_ALL_TILES, LIGHTS_RAYS},
    {"over", STORED_ALL_TILES, STORES_OVER},
};

static const char *target_of(const struct passes_setup *setup)
{
    return setup->target ? setup->target : "vulkan";
}

/* Makes the text of a pass; false: with the first message. */
static bool generate(struct passes *passes, const struct passes_setup *setup, uint32_t index,
                     mxg_result **out)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = target_of(setup);
    desc.options = setup->options;
    mxg_status status = mxg_generate_pass(setup->context, index, &desc, out);
    mxg_diagnostic first = {sizeof first};
    if (status == MXG_OK)
        return true;
    if (mxg_diagnostics_item(mxg_result_diagnostics(*out), 0, &first) == MXG_OK)
        return fail(passes, first.id, first.message);
    return fail(passes, "render-failed", mxg_status_string(status));
}

static bool compile(struct passes *passes, struct pass_part *part, const char *target,
                    const char *text)
{
    return compile_compute(target, text, &part->compiled)
           || fail(passes, "bad-shader",
                   part->compiled.num_messages ? part->compiled.messages[0].text
                                               : "the pass does not compile");
}

/* Adds a pass that is compiled to the device. */
static bool add_pass(struct passes *passes, const struct passes_setup *setup,
                     const struct pass_part *part, int which)
{
    const struct compiled_stage *code = &part->compiled.stages[MXG_STAGE_PIXEL];
    const struct stored_pass pass = {code->words, code->num_words, &part->bind.draw, which};
    return stored_add_pass(passes->stored, &pass) || fail_device(passes, setup);
}

/* The functions of the host stand behind the pass. */
static bool compile_with_host(struct passes *passes, const struct passes_setup *setup,
                              struct pass_part *part)
{
    size_t size = 0;
    const char *source = mxg_result_source(part->result, MXG_STAGE_PIXEL, &size),
               *host = mxg_result_num_host_functions(part->result) ? setup->host : "";
    char *text = host ? malloc(size + strlen(host) + 1) : NULL;
    if (!host)
        return fail(passes, "bad-shader", "the pass asks its host for functions");
    if (!text)
        return fail(passes, "render-failed", "out of memory");
    memcpy(text, source, size);
    strcpy(text + size, host);
    bool good = compile(passes, part, target_of(setup), text);
    free(text);
    return good;
}

/* False for a pass that the options do not ask for, or over classes that no material has. */
static bool is_needed(const struct passes_setup *setup, const mxg_result *pass)
{
    if (!mxg_result_source(pass, MXG_STAGE_PIXEL, NULL))
        return false;
    mxg_storage storage = {sizeof storage};
    mxg_result_storage(pass, &storage);
    return !storage.classes || storage.classes & setup->classes;
}

/* Makes pass `index` of the library, if it is needed. */
static bool open_pass(struct passes *passes, const struct passes_setup *setup, uint32_t index,
                      int which)
{
    mxg_result *result = NULL;
    if (!generate(passes, setup, index, &result) || !is_needed(setup, result)) {
        bool good = !passes->id;
        mxg_result_destroy(result);
        return good;
    }
    struct pass_part *part = &passes->parts[passes->num_parts++];
    part->result = result;
    if (!compile_with_host(passes, setup, part))
        return false;
    part->bind = (struct bind){.result = part->result,
                               .scene = setup->scene,
                               .is_opaque = true,
                               .tints = &passes->tints,
                               .places = part->compiled.places,
                               .num_places = part->compiled.num_places};
    if (!bind_shader(&part->bind))
        return fail(passes, part->bind.id, part->bind.reason);
    return add_pass(passes, setup, part, which);
}

/* text: writes payloads, in GLSL. */
static bool open_payloads(struct passes *passes, const struct passes_setup *setup, const char *text)
{
    passes->payloads = stored_hold_rays(passes->stored);
    struct pass_part *part = &passes->parts[passes->num_parts++];
    return (passes->payloads || fail_device(passes, setup)) && compile(passes, part, "vulkan", text)
           && add_pass(passes, setup, part, STORED_ALL_TILES);
}

static bool open_tints(struct passes *passes, const struct passes_setup *setup)
{
    if (tints_open(&passes->tints, setup->binds, setup->num_binds))
        return true;
    for (size_t i = 0; i < setup->num_binds; ++i)
        if (setup->binds[i]->id)
            return fail(passes, setup->binds[i]->id, setup->binds[i]->reason);
    return fail(passes, "render-failed", "out of memory");
}

static bool open_use(struct passes *passes, const struct passes_setup *setup, enum use use)
{
    bool good = true;
    for (size_t r = 0; good && r < sizeof runs / sizeof *runs; ++r)
        for (uint32_t i = 0; good && i < mxg_catalogue_num_passes(); ++i)
            if (runs[r].use == use && strcmp(mxg_catalogue_pass(i), runs[r].name) == 0)
                good = open_pass(passes, setup, i, runs[r].which);
    return good;
}

static bool open_painted(struct passes *passes, const struct passes_setup *setup)
{
    bool good = true;
    for (int i = 0; good && i < PASSES_MAX_PAINTED && setup->painted[i]; ++i) {
        struct pass_part *part = &passes->parts[passes->num_parts++];
        good = compile(passes, part, "vulkan", setup->painted[i])
               && add_pass(passes, setup, part, STORED_FIRST);
    }
    return good;
}

static bool open_passes(struct passes *passes, const struct passes_setup *setup)
{
    const char *payloads = setup->hits ? setup->hits : setup->decals;
    return open_tints(passes, setup) && open_painted(passes, setup)
           && (!payloads || open_payloads(passes, setup, payloads))
           && (!setup->decals || open_use(passes, setup, STORES_OVER))
           && open_use(passes, setup,
                       setup->hits                  ? LIGHTS_RAYS
                       : setup->shown != UINT32_MAX ? SHOWS
                                                    : LIGHTS);
}

bool passes_open(const struct passes_setup *setup, struct passes *out)
{
    *out = (struct passes){.scene = setup->scene, .shown = setup->shown};
    draw_size(setup->canvas, &out->width, &out->height);
    if (!draw_gpu(setup->canvas)->can_store)
        return fail(out, "no-device",
                    "the device cannot write images in pixel stages, as '--role deferred' needs");
    out->stored = draw_store(setup->canvas, setup->words);
    if (!out->stored)
        return fail_device(out, setup);
    return open_passes(out, setup) && passes_aim(out);
}

/* From pixels to the world: the viewport turns the picture, so y grows downwards. */
static void fill_frame(const struct passes *passes, struct stored_frame *out)
{
    const struct scene *scene = passes->scene;
    struct matrix to_clip = matrix_multiply(scene->projection, scene->view);
    struct matrix of_pixels = {{{2.0 / passes->width, 0, 0, 0},
                                {0, -2.0 / passes->height, 0, 0},
                                {0, 0, 1, 0},
                                {-1, 1, 0, 1}}};
    struct matrix to_world = matrix_multiply(matrix_inverse(to_clip), of_pixels);
    for (size_t i = 0; i < 16; ++i)
        out->to_world[i] = (float)to_world.m[i / 4][i % 4];
    out->shown = passes->shown;
}

bool passes_aim(struct passes *passes)
{
    struct stored_frame frame;
    for (uint32_t i = 0; i < passes->num_parts; ++i)
        if (passes->parts[i].result && !bind_scene(&passes->parts[i].bind))
            return fail(passes, passes->parts[i].bind.id, passes->parts[i].bind.reason);
    fill_frame(passes, &frame);
    stored_update(passes->stored, &frame);
    return true;
}

void passes_close(struct passes *passes)
{
    for (uint32_t i = 0; i < passes->num_parts; ++i) {
        bind_finish(&passes->parts[i].bind);
        compiled_finish(&passes->parts[i].compiled);
        mxg_result_destroy(passes->parts[i].result);
    }
    tints_close(&passes->tints);
}
