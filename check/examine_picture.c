// SPDX-License-Identifier: Apache-2.0
/* --render: a picture of an element, which the program mxgen-render draws. */
#define _POSIX_C_SOURCE 200809L
#include "check/picture.h"
#include "cli/files.h"
#include "check/examine.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
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

/*
 * Runs the renderer with its output in a file. Returns 0, its exit code, or -1 if it cannot start
 * or dies.
 */
static int run(struct examiner *examiner, const char *element)
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
    cli_forward(examiner->cli, &args);
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
    const char *document = examiner->document->file, *slash = strrchr(document, '/');
    int folder = slash && file[0] != '/' ? (int)(slash - document) + 1 : 0;
    char *path = cli_format("%.*s%s", folder, document, file);
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

void examine_picture(struct examiner *examiner, struct check_element *element)
{
    double begin = examine_clock();
    size_t size = 0, pixels_size = 0;
    channel_mark(&examiner->channel, CHECK_RENDER, element->path, "vulkan");
    bool good = make_folder(examiner) && run(examiner, element->path) == 0;
    char *picture = examiner->folder ? read_output(examiner, "picture.png", &size) : NULL;
    char *pixels = examiner->folder ? read_output(examiner, "picture.ppm", &pixels_size) : NULL;
    char *log = examiner->folder ? read_output(examiner, "log", &(size_t){0}) : NULL;
    char *signature = good && pixels ? picture_sign(&examiner->store, pixels, pixels_size) : NULL;
    if (signature && picture) {
        element->signature = signature;
        element->picture = picture_base64(&examiner->store, picture, size);
    } else {
        fail(examiner, element, log);
    }
    free(picture);
    free(pixels);
    free(log);
    examiner->document->render_ms += examine_clock() - begin;
}
