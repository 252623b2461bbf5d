// SPDX-License-Identifier: Apache-2.0
/* --render: a picture of an element, which the program mxgen-render draws. */
#define _POSIX_C_SOURCE 200809L
#include "check/picture.h"
#include "cli/drawn.h"
#include "cli/files.h"
#include "check/examine.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#define SIZE "96" /* pixels */
#define FRAME 33

extern char **environ;

static char *path_in(const struct examiner *examiner, const char *name)
{
    return cli_format("%s/%s", examiner->folder, name);
}

/* Makes the temporary folder for pictures, on first use. */
static bool make_folder(struct examiner *examiner)
{
    const char *root = getenv("TMPDIR");
    if (examiner->folder)
        return true;
    char *folder = cli_format("%s/mxgen-check-XXXXXX", root && *root ? root : "/tmp");
    if (mkdtemp(folder))
        examiner->folder = folder;
    else
        free(folder);
    return examiner->folder != NULL;
}

/* So many steps of a budget of slabs a picture shows. */
enum { NO_STEPS = 0, ALL_STEPS = -1 };

/*
 * Runs the renderer with its output in a file. Returns 0, its exit code, or -1 if it cannot start
 * or dies.
 */
static int run(struct examiner *examiner, const char *element, int steps)
{
    struct arg_list args = {0};
    args_append(&args, cli_program("mxgen-render"));
    args_append(&args, cli_format("%s", examiner->document->file));
    args_append(&args, cli_format("--element=%s", element));
    args_append(&args, cli_format("--output=%s/picture.png", examiner->folder));
    args_append(&args, cli_format("--copy=%s/picture.ppm", examiner->folder));
    args_append(&args, cli_format("--size=" SIZE));
    args_append(&args, cli_format("--frame=%d", FRAME));
    args_append(&args, cli_format("--missing-texture=checker"));
    if (steps == NO_STEPS)
        cli_forward_full(examiner->cli, &args);
    else
        cli_forward(examiner->cli, &args);
    if (steps != ALL_STEPS)
        args_append(&args, cli_format("--max-steps=%d", steps));
    args_append(&args, NULL);

    posix_spawn_file_actions_t actions;
    char *log = path_in(examiner, "log");
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log, O_WRONLY | O_CREAT | O_TRUNC,
                                     0600);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    pid_t child;
    int status = -1;
    int reason = posix_spawnp(&child, args.items[0], &actions, NULL,
                              (char *const *)(uintptr_t)args.items, environ);
    while (!reason && waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    posix_spawn_file_actions_destroy(&actions);
    free(log);
    args_free(&args);
    return !reason && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static char *read_output(const struct examiner *examiner, const char *name, size_t *out_size)
{
    char *path = path_in(examiner, name), *data = files_read(path, out_size);
    unlink(path);
    free(path);
    return data;
}

static void fail(struct examiner *examiner, const struct check_element *element, const char *log)
{
    const char *why = log && *log ? log : "mxgen-render could not be started, or died\n";
    char *text =
        cli_format("cannot render '%s': %.*s", element->path, (int)strcspn(why, "\n"), why);
    char *rendered = cli_format("%s: error: %s [render-failed]\n", examiner->document->file, text);
    examine_add(examiner, NULL,
                (struct check_message){.id = "render-failed",
                                       .text = text,
                                       .file = examiner->document->file,
                                       .element = element->path,
                                       .rendered = rendered});
    check_fail(&examiner->document->failed, CHECK_RENDER);
    free(rendered);
    free(text);
}

/* Resolves an image relative to the document, as the renderer does. */
static void add_image(struct examiner *examiner, const char *file)
{
    char *path = cli_beside(examiner->document->file, file);
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
                add_image(examiner, file);
    }
}

/* What the renderer made; each NULL where it did not. */
struct drawn {
    char *png, *ppm, *log;
    size_t png_size, ppm_size;
};

static struct drawn draw(struct examiner *examiner, const char *element, int steps)
{
    struct drawn out = {0};
    bool good = make_folder(examiner) && run(examiner, element, steps) == 0;
    if (!examiner->folder)
        return out;
    out.png = read_output(examiner, "picture.png", &out.png_size);
    out.ppm = read_output(examiner, "picture.ppm", &out.ppm_size);
    out.log = read_output(examiner, "log", &(size_t){0});
    if (!good) {
        free(out.png);
        free(out.ppm);
        out.png = out.ppm = NULL;
    }
    return out;
}

static void drop(struct drawn *drawn)
{
    free(drawn->png);
    free(drawn->ppm);
    free(drawn->log);
}

/* How far a picture is from the one without a budget; "" after a message. */
static const char *compare(struct examiner *examiner, const struct check_element *element,
                           const struct drawn *full, const struct drawn *cheaper)
{
    char text[32];
    double error = drawn_difference(full->ppm, full->ppm_size, cheaper->ppm, cheaper->ppm_size);
    if (error < 0) {
        fail(examiner, element, full->ppm ? cheaper->log : full->log);
        return "";
    }
    snprintf(text, sizeof text, "%.2f", error);
    return store_text(&examiner->store, text, strlen(text));
}

/* The error of each step; the last one is that of the picture with the whole budget. */
static void draw_steps(struct examiner *examiner, struct check_element *element,
                       const struct drawn *full)
{
    for (size_t i = 0; i + 1 < element->num_steps; ++i) {
        channel_mark(&examiner->channel, CHECK_RENDER, element->path, "vulkan");
        struct drawn drawn = draw(examiner, element->path, (int)i + 1);
        element->steps[i].drawn = compare(examiner, element, full, &drawn);
        drop(&drawn);
    }
    if (element->num_steps)
        element->steps[element->num_steps - 1].drawn = element->drawn_error;
}

/* The material without a budget, how far the picture is from it, and by which steps. */
static void add_full(struct examiner *examiner, struct check_element *element,
                     const struct drawn *cheaper)
{
    struct drawn full = draw(examiner, element->path, NO_STEPS);
    element->drawn_error = compare(examiner, element, &full, cheaper);
    if (full.png && *element->drawn_error) {
        element->full = picture_base64(&examiner->store, full.png, full.png_size);
        draw_steps(examiner, element, &full);
    } else {
        element->num_steps = 0;
    }
    drop(&full);
}

void examine_picture(struct examiner *examiner, const mxg_document *document,
                     struct check_element *element)
{
    double begin = examine_clock();
    channel_mark(&examiner->channel, CHECK_RENDER, element->path, "vulkan");
    struct drawn drawn = draw(examiner, element->path, ALL_STEPS);
    char *signature = drawn.ppm ? picture_sign(&examiner->store, drawn.ppm, drawn.ppm_size) : NULL;
    if (signature && drawn.png) {
        element->signature = signature;
        element->picture = picture_base64(&examiner->store, drawn.png, drawn.png_size);
        examine_slabs(examiner, document, element);
        if (cli_has_budget(examiner->cli))
            add_full(examiner, element, &drawn);
    } else {
        fail(examiner, element, drawn.log);
    }
    drop(&drawn);
    examiner->document->render_ms += examine_clock() - begin;
}
