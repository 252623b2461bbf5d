// SPDX-License-Identifier: Apache-2.0
/* --render: a picture of an element, which the program mxgen-render draws. */
#define _POSIX_C_SOURCE 200809L
#include "check/signature.h"
#include "program/drawn.h"
#include "check/examine.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FRAME = 33 }; /* of images with a frame in their names */

const char *examine_folder(struct examiner *examiner)
{
    if (!examiner->scratch.path)
        scratch_make(&examiner->scratch);
    return examiner->scratch.path;
}

static void fail(struct examiner *examiner, const struct check_element *element, const char *why)
{
    char *text = cli_format("cannot render '%s': %s", element->path, why);
    examine_fault(examiner, element->path, CHECK_RENDER, "render-failed", text);
    free(text);
}

/* Resolves an image relative to the file that names it, as the renderer does. */
static void add_image(struct examiner *examiner, const char *origin, const char *file)
{
    char *path = cli_beside(origin, file);
    check_add_image(&examiner->store, examiner->document, path);
    free(path);
}

void examine_images(struct examiner *examiner, const mxg_result *result)
{
    for (uint32_t i = 0; i < mxg_result_num_variables(result); ++i) {
        mxg_variable variable = {sizeof variable};
        char file[4096];
        mxg_result_variable(result, i, &variable);
        if (variable.block != MXG_BLOCK_TEXTURES || !*variable.file)
            continue;
        for (uint32_t tile = 0; tile < (variable.num_tiles ? variable.num_tiles : 1); ++tile)
            if (mxg_result_texture_file(result, i, tile, FRAME, file, sizeof file))
                add_image(examiner, variable.origin, file);
    }
}

/* ---- Pictures ---- */

struct picture_step {
    struct examiner *examiner;
    const struct check_element *element;
};

static void begin_picture(void *user_data)
{
    const struct picture_step *step = user_data;
    channel_mark(&step->examiner->channel, CHECK_RENDER, step->element->path, "vulkan");
}

/* The text of an error; "" for one below 0, of a picture that failed. */
static const char *error_text(struct examiner *examiner, double error)
{
    char text[32] = "";
    if (error >= 0)
        snprintf(text, sizeof text, "%.2f", error);
    return store_text(&examiner->store, text, strlen(text));
}

/* The material without a budget, how far the picture is from it, and by which steps. */
static void add_full(struct examiner *examiner, struct check_element *element,
                     const struct drawn_subject *subject, struct drawn_comparison *comparison)
{
    const struct drawn_picture *full = &comparison->full;
    if (!drawn_compare(subject, element->num_steps, comparison))
        fail(examiner, element, comparison->fault);
    element->drawn_error = error_text(examiner, comparison->error);
    element->num_steps = comparison->num_steps;
    if (comparison->error >= 0)
        element->full = picture_base64(&examiner->store, full->png, full->png_size);
    for (size_t i = 0; i < comparison->num_steps; ++i)
        element->steps[i].drawn = error_text(examiner, comparison->errors[i]);
}

static void add_pictures(struct examiner *examiner, const mxg_document *document,
                         struct check_element *element, const struct drawn_subject *subject,
                         struct drawn_comparison *comparison)
{
    const struct drawn_picture *drawn = &comparison->cheapest;
    bool good = drawn_begin(subject, comparison);
    char *signature = good ? picture_sign(&examiner->store, drawn->ppm, drawn->ppm_size) : NULL;
    if (!signature) {
        fail(examiner, element, good ? "mxgen-render wrote no picture" : comparison->fault);
        return;
    }
    element->signature = signature;
    element->picture = picture_base64(&examiner->store, drawn->png, drawn->png_size);
    examine_slabs(examiner, document, element);
    if (cli_has_budget(examiner->cli))
        add_full(examiner, element, subject, comparison);
}

void examine_picture(struct examiner *examiner, const mxg_document *document,
                     struct check_element *element)
{
    char frame[32];
    char *translate =
        examiner->translate ? cli_format("--translate=%s", examiner->translate) : NULL;
    const char *const look[] = {"--size=96", frame, translate, NULL};
    double begin = examine_clock();
    struct picture_step step = {examiner, element};
    struct drawn_comparison comparison = {0};
    snprintf(frame, sizeof frame, "--frame=%d", FRAME);
    const struct drawn_subject subject = {.cli = examiner->cli,
                                          .file = examiner->document->file,
                                          .element = element->path,
                                          .look = look,
                                          .folder = examine_folder(examiner),
                                          .begin = begin_picture,
                                          .user_data = &step};
    if (subject.folder)
        add_pictures(examiner, document, element, &subject, &comparison);
    else
        fail(examiner, element, "there is no folder for pictures");
    drawn_finish(&comparison);
    free(translate);
    examiner->document->render_ms += examine_clock() - begin;
}
