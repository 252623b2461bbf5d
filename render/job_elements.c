// SPDX-License-Identifier: Apache-2.0
/* The elements of a run: pictures, turntables, contact sheets, and values on a grid. */
#define _POSIX_C_SOURCE 200809L
#include "render/job.h"
#include "render/look_parts.h"
#include "program/memory.h"
#include "render/contact_sheet.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct item {
    struct subject subject;
    char *name;
};

struct items {
    struct item *items;
    mxg_document **documents;
    size_t len, num_documents;
};

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
    job->painter.wants_aovs = job_writes_channels(job);
    if (picture_draw(&job->painter, subject, 1, &picture)) {
        picture_write(&job->painter, job->options.output, &picture);
        if (job->options.copy)
            picture_write(&job->painter, job->options.copy, &picture);
    }
    image_finish(&picture);
}

static void add_item(struct items *list, const mxg_document *document, const char *path,
                     const char *element)
{
    struct item item = {{.document = document, .path = path, .element = element},
                        cli_format("%s", element)};
    MEMORY_PUSH(list->items, list->len, item);
}

static void tell_part(void *user_data, const char *look, const mxg_element_info *part)
{
    struct report *report = user_data;
    report_warning(report, "look-part",
                   "'%s/%s' (%s:%u) changes inputs of materials, which --look draws as they are; "
                   "with --stage it counts",
                   look, part->name, part->file, (unsigned)part->line);
}

/* Adds the materials of the requested look, or the renderables. */
static void add_elements(struct job *job, struct items *list, const mxg_document *document,
                         const char *path)
{
    mxg_renderable renderable = {sizeof renderable};
    const char *look = job->options.look, *element = job->options.element;
    uint32_t num = mxg_document_num_renderables(document);
    size_t before = list->len;
    for (uint32_t i = 0; i < num; ++i) {
        mxg_document_renderable(document, i, &renderable);
        if (look ? mxg_document_has_assignment(document, look, i)
                 : !element || strcmp(element, renderable.path) == 0)
            add_item(list, document, path, renderable.path);
    }
    if (look && list->len == before)
        report_error(&job->cli.report, "no-look", "'%s' has no look '%s' that assigns a material",
                     path, look);
    if (look) {
        look_parts(document, look, tell_part, &job->cli.report);
        return;
    }
    if (num == 0 || (list->len == 0 && job->options.element)) /* generation reports the error */
        add_item(list, document, path, job->options.element);
}

static void load_items(struct job *job, struct items *list)
{
    list->documents = calloc(job->found.len + 1, sizeof *list->documents);
    for (size_t i = 0; list->documents && i < job->found.len; ++i) {
        mxg_document *document = job_load(job, job->found.items[i]);
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

static void draw_turntable(struct job *job, const struct subject *subject)
{
    struct painter *painter = &job->painter;
    struct painting painting;
    bool good = painting_open(painter, subject, 1, &painting);
    for (size_t i = 0; good && i < job->options.frames; ++i) {
        struct image picture;
        char *name = job_frame_name(job->options.output, i);
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

void job_render_file(struct job *job, const char *path)
{
    mxg_document *document = job_load(job, path);
    struct subject subject = {.document = document, .path = path, .element = job->options.element};
    if (document && job_prepare(job)) {
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

void job_render_all(struct job *job)
{
    struct items list = {0};
    load_items(job, &list);
    if (list.len && !job->painter.has_clash && job_prepare(job)) {
        if (list.len == 1)
            draw_one(job, &list.items[0].subject);
        else
            draw_sheet(job, &list);
    }
    free_items(&list);
}
