// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "program/scene_file.h"

#include "program/cli.h"
#include "program/files.h"
#include "program/memory.h"
#include "program/parent.h"
#include "program/usdcat.h"

#include <errno.h>
#include <spawn.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

enum scene_file_kind scene_file_kind(const char *path)
{
    const char *dot = strrchr(files_base_name(path), '.');
    if (!dot || strcmp(dot, ".txt") == 0)
        return SCENE_FILE_LIST;
    return strncmp(dot, ".usd", 4) == 0 ? SCENE_FILE_USD : SCENE_FILE_OTHER;
}

/* ---- Files that mxgen-render reads ---- */

/* Adds a path for each line that the program writes. */
static mxg_status read_paths(FILE *in, mxg_scene *scene)
{
    mxg_status status = MXG_OK;
    char *line = NULL;
    size_t capacity = 0;
    ssize_t len;
    while ((len = getline(&line, &capacity, in)) > 0) {
        line[len - 1] = '\0';
        if (status == MXG_OK)
            status = mxg_scene_add_paths(scene, (const char *const *)&line, 1);
    }
    free(line);
    return status;
}

/*
 * Starts mxgen-render with the limits of this program; its messages go to standard error. Returns 0
 * or a reason of errno.
 */
static int start(struct cli *cli, const char *program, const char *path, pid_t *out_child,
                 int *out_output)
{
    struct arg_list args = {0};
    args_append(&args, cli_format("%s", program));
    args_append(&args, cli_format("--stage=%s", path));
    args_append(&args, cli_format("--list"));
    cli_forward_limits(cli, &args);
    args_append(&args, NULL);
    int ends[2], reason = pipe(ends) < 0 ? errno : 0;
    parent_announce();
    if (!reason) {
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
        posix_spawn_file_actions_addclose(&actions, ends[0]);
        posix_spawn_file_actions_addclose(&actions, ends[1]);
        reason = posix_spawnp(out_child, program, &actions, NULL,
                              (char *const *)(uintptr_t)args.items, environ);
        posix_spawn_file_actions_destroy(&actions);
        close(ends[1]);
        *out_output = ends[0];
        if (reason)
            close(ends[0]);
    }
    args_free(&args);
    return reason;
}

/* Counts what the child has reported itself, and tells why it died. */
static void count_fault(struct report *report, const char *path, int code)
{
    if (WIFSIGNALED(code))
        report_error(report, "bad-mesh",
                     "cannot use the stage '%s': mxgen-render died of signal %d", path,
                     WTERMSIG(code));
    else if (code)
        ++report->errors;
}

static bool import(struct cli *cli, const char *path, mxg_scene *scene)
{
    char *program = cli_program("mxgen-render");
    pid_t child;
    int output, code = -1, reason = start(cli, program, path, &child, &output);
    mxg_status status = MXG_OK;
    if (!reason) {
        FILE *in = fdopen(output, "r");
        status = in ? read_paths(in, scene) : MXG_ERROR_MEMORY;
        if (in)
            fclose(in);
        while (waitpid(child, &code, 0) < 0 && errno == EINTR) {
        }
        count_fault(&cli->report, path, code);
    } else {
        report_error(&cli->report, "no-renderer", "cannot start '%s', which reads '%s': %s",
                     program, path, strerror(reason));
    }
    free(program);
    return !reason && !code && report_status(&cli->report, status);
}

/* ---- All files ---- */

/* The scene of the text that usdcat wrote to `file`. Messages name the stage, and its text. */
static mxg_status load_composed(struct cli *cli, const char *path, const char *file,
                                const char *purpose, mxg_scene **out_scene)
{
    size_t size = 0;
    char *data = files_read(file, &size), *name = cli_format("%s as composed", path);
    mxg_status status = data ? mxg_scene_parse(cli->context, name, data, size, purpose, out_scene)
                             : mxg_scene_load(cli->context, file, purpose, out_scene);
    free(name);
    free(data);
    return status;
}

/*
 * Loads what OpenUSD makes of a stage that mxgen does not read by itself. The stage stays if there
 * is no usdcat; a sandbox starts no programs.
 */
static void flatten(struct cli *cli, const char *path, const char *purpose, mxg_scene **scene,
                    mxg_status *out_status)
{
    bool is_missing;
    struct scratch folder;
    if (cli->sandbox || !*scene || !usdcat_may_help(mxg_scene_diagnostics(*scene)))
        return;
    char *text = usdcat_flatten(cli, path, &folder, &is_missing);
    if (!is_missing) {
        mxg_scene_destroy(*scene);
        *scene = NULL;
        *out_status = text ? load_composed(cli, path, text, purpose, scene) : MXG_OK;
    } else if (!cli->quiet) {
        fprintf(stderr,
                "note: with the program usdcat of OpenUSD on the path, mxgen composes '%s' by "
                "itself\n",
                path);
    }
    free(text);
    scratch_remove(&folder);
}

mxg_scene *scene_file_load(struct cli *cli, const char *path, const char *purpose)
{
    mxg_scene *scene = NULL;
    bool is_other = scene_file_kind(path) == SCENE_FILE_OTHER;
    mxg_status status = is_other ? mxg_scene_create(cli->context, &scene)
                                 : mxg_scene_load(cli->context, path, purpose, &scene);
    if (status == MXG_ERROR_DOCUMENT)
        flatten(cli, path, purpose, &scene, &status);
    if (scene && !is_other)
        report_list(&cli->report, mxg_scene_diagnostics(scene));
    if (report_status(&cli->report, status) && scene && (!is_other || import(cli, path, scene)))
        return scene;
    mxg_scene_destroy(scene);
    return NULL;
}

mxg_document *scene_file_document(struct cli *cli, const mxg_document *own, const mxg_scene *scene)
{
    mxg_document *whole = NULL;
    mxg_status status = mxg_document_import(cli->context, cli->library, own, scene, &whole);
    if (whole)
        report_list(&cli->report, mxg_document_diagnostics(whole));
    if (report_status(&cli->report, status))
        return whole;
    mxg_document_destroy(whole);
    return NULL;
}

/* ---- Primitives ---- */

char *scene_file_path(const mxg_scene *scene, uint32_t primitive)
{
    size_t size = mxg_scene_primitive_path(scene, primitive, NULL, 0) + 1;
    char *path = memory_alloc(size);
    mxg_scene_primitive_path(scene, primitive, path, size);
    return path;
}

void scene_file_report_unknown(struct report *report, const mxg_scene *scene, const char *path)
{
    enum { MAX_GUESSES = 1000 };
    uint32_t num = mxg_scene_num_primitives(scene);
    struct arg_list paths = {0};
    for (uint32_t i = 0; i < num && i < MAX_GUESSES; ++i)
        args_append(&paths, scene_file_path(scene, i));
    const char *near = args_closest(path, paths.items, paths.len);
    report_error(report, "unknown-primitive", "the stage has no primitive '%s'%s%s%s", path,
                 near ? " (did you mean '" : "", near ? near : "", near ? "'?)" : "");
    args_free(&paths);
}

bool scene_file_bind(struct cli *cli, const struct scene_place *place, const mxg_document *own,
                     struct bound_scene *out)
{
    mxg_bindings_desc desc = MXG_BINDINGS_DESC_INIT;
    desc.look = place->look;
    *out = (struct bound_scene){.scene = scene_file_load(cli, place->file, place->purpose)};
    if (out->scene)
        out->document = scene_file_document(cli, own, out->scene);
    if (!out->document)
        return false;
    mxg_status status =
        mxg_bindings_create(cli->context, out->document, out->scene, &desc, &out->bindings);
    if (out->bindings)
        report_list(&cli->report, mxg_bindings_diagnostics(out->bindings));
    return report_status(&cli->report, status);
}

void scene_file_unbind(struct bound_scene *stage)
{
    mxg_bindings_destroy(stage->bindings);
    mxg_scene_destroy(stage->scene);
    mxg_document_destroy(stage->document);
}
