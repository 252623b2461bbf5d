// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "compile/command.h"
#include "program/files.h"
#include "program/scratch.h"

#include <fcntl.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

enum { PATH_CAPACITY = 4096, MAX_ARGUMENTS = 24, MAX_SOURCES = 32 };

/*
 * "$SOURCE" and "$OBJECT" stand for the files that the compiler reads and writes, "$FOLDER" for
 * theirs, where the sources are shader0.ENDING and so on, and "$MODULES" for the names of all of
 * them as modules: a compiler with modules starts once for MAX_SOURCES shaders.
 */
static const struct command {
    const char *target, *ending;
    const char *argv[MAX_ARGUMENTS];
} commands[] = {
    {"osl", "osl", {"oslc", "-q", "-O2", "-o", "$OBJECT", "$SOURCE"}},
    /* without warnings of what is unused, of infinite numbers and of textures that are elsewhere */
    {"mdl",
     "mdl",
     {"mdlc", "--no-resolve-resources", "-W", "181=off", "-W", "182=off", "-W", "183=off", "-W",
      "225=off", "-W", "230=off", "-W", "350=off", "-p", "$FOLDER", "$MODULES"}},
};

static const struct command *find_command(const char *target)
{
    for (size_t i = 0; i < sizeof commands / sizeof *commands; ++i)
        if (strcmp(commands[i].target, target) == 0)
            return &commands[i];
    return NULL;
}

bool command_knows_target(const char *target)
{
    const struct command *command = find_command(target);
    return command && files_find_program(command->argv[0]);
}

/* ---- The module that shaders of MDL import ---- */

static mxg_result *module; /* NULL: they import none */

void compile_import_module(mxg_context *context, mxg_library *library, const mxg_options *options)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = "mdl";
    desc.options = options;
    command_end();
    if (mxg_generate_module(context, library, &desc, &module) != MXG_OK)
        command_end();
}

void command_end(void)
{
    mxg_result_destroy(module);
    module = NULL;
}

/* ---- Files: a compiler reads sources and may write an object ---- */

struct work { /* in a folder of its own */
    struct scratch folder;
    char source[PATH_CAPACITY], object[PATH_CAPACITY], log[PATH_CAPACITY];
    char modules[MAX_SOURCES][sizeof "::shader00"];
    size_t num_sources;
};

static bool write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    if (!file)
        return false;
    bool whole = fputs(text, file) >= 0;
    return fclose(file) == 0 && whole;
}

static bool write_module(const struct work *work, const char *ending)
{
    char path[PATH_CAPACITY];
    mxg_shader_info info = MXG_INIT(mxg_shader_info);
    mxg_result_info(module, &info);
    snprintf(path, sizeof path, "%s/%s.%s", work->folder.path, info.name, ending);
    return write_text(path, mxg_result_source(module, MXG_STAGE_PIXEL, NULL));
}

static bool make_work(struct work *work, const char *ending, const char *const *sources,
                      size_t count)
{
    bool good = scratch_make(&work->folder) && (!module || write_module(work, ending));
    snprintf(work->object, sizeof work->object, "%s/shader.object", work->folder.path);
    snprintf(work->log, sizeof work->log, "%s/log", work->folder.path);
    work->num_sources = count;
    for (size_t i = count; good && i-- > 0;) { /* the path of the first stays */
        snprintf(work->modules[i], sizeof work->modules[i], "::shader%u", (unsigned char)i);
        snprintf(work->source, sizeof work->source, "%s/%s.%s", work->folder.path,
                 work->modules[i] + 2, ending);
        good = write_text(work->source, sources[i]);
    }
    return good;
}

static const char *argument(const char *text, const struct work *work)
{
    return strcmp(text, "$SOURCE") == 0   ? work->source
           : strcmp(text, "$OBJECT") == 0 ? work->object
           : strcmp(text, "$FOLDER") == 0 ? work->folder.path
                                          : text;
}

/* Returns what waitpid tells of it; -1 where it did not run. */
static int run(const struct command *command, const struct work *work)
{
    posix_spawn_file_actions_t actions;
    if (posix_spawn_file_actions_init(&actions) != 0)
        return -1;
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, work->log,
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    char *argv[MAX_ARGUMENTS + MAX_SOURCES + 1] = {NULL};
    size_t len = 0;
    for (int i = 0; i < MAX_ARGUMENTS && command->argv[i]; ++i) {
        bool is_modules = strcmp(command->argv[i], "$MODULES") == 0;
        for (size_t k = 0; is_modules && k < work->num_sources; ++k)
            argv[len++] = (char *)(uintptr_t)work->modules[k];
        if (!is_modules)
            argv[len++] = (char *)(uintptr_t)argument(command->argv[i], work);
    }
    pid_t process;
    int status = -1;
    if (posix_spawnp(&process, argv[0], &actions, NULL, argv, environ) != 0
        || waitpid(process, &status, 0) != process)
        status = -1;
    posix_spawn_file_actions_destroy(&actions);
    return status;
}

/* ---- What it says ---- */

/* The line of a place that ends at `end`: "shader0.osl:12", "shader0.mdl(12,5)"; 0: none. */
static uint32_t line_of(const char *text, const char *end)
{
    const char *begin = end;
    while (begin > text && strchr("0123456789,()", begin[-1]))
        --begin;
    return (uint32_t)strtoul(begin + (*begin == '('), NULL, 10);
}

/* The number of the source that a place is in; 0 for places elsewhere. */
static size_t source_of(const char *text, const char *end, size_t num_sources)
{
    static const char name[] = "/shader";
    size_t source = 0;
    for (const char *at = strstr(text, name); at && at < end; at = strstr(at + 1, name))
        source = strtoul(at + sizeof name - 1, NULL, 10);
    return source < num_sources ? source : 0;
}

/*
 * "shader0.osl:12: error: text", "shader0.mdl(12,5): Error C109: text"; lines without a place go on
 * from the one before and are left out. `outs` has an item for each source.
 */
static void read_line(struct compiled *outs, size_t num_sources, mxg_stage stage, const char *text)
{
    static const struct {
        const char *mark;
        mxg_severity severity;
    } marks[] = {{": error: ", MXG_SEVERITY_ERROR},
                 {": Error C", MXG_SEVERITY_ERROR},
                 {": warning: ", MXG_SEVERITY_WARNING},
                 {": Warning C", MXG_SEVERITY_WARNING}};
    for (size_t i = 0; i < sizeof marks / sizeof *marks; ++i) {
        const char *at = strstr(text, marks[i].mark);
        if (!at)
            continue;
        const char *message = strstr(at + strlen(marks[i].mark) - 2, ": ");
        message = message ? message + 2 : at + strlen(marks[i].mark);
        compiled_add(&outs[source_of(text, at, num_sources)], stage, marks[i].severity,
                     line_of(text, at), message, strcspn(message, "\n"));
        return;
    }
}

static void read_log(struct compiled *outs, size_t num_sources, mxg_stage stage, const char *path)
{
    char line[1024];
    FILE *file = fopen(path, "r");
    while (file && fgets(line, sizeof line, file))
        read_line(outs, num_sources, stage, line);
    if (file)
        fclose(file);
}

/* Instructions of an .oso stand behind a tab. */
static uint32_t count_instructions(const char *path)
{
    uint32_t count = 0;
    FILE *file = fopen(path, "r");
    int before = '\n';
    for (int c = file ? getc(file) : EOF; c != EOF; before = c, c = getc(file))
        count += c == '\t' && before == '\n';
    if (file)
        fclose(file);
    return count;
}

static void add_fault(struct compiled *out, mxg_stage stage, const char *text)
{
    compiled_add(out, stage, MXG_SEVERITY_ERROR, 0, text, strlen(text));
}

static void explain_failure(struct compiled *out, mxg_stage stage, const char *program, int status)
{
    char text[128];
    if (status == -1)
        snprintf(text, sizeof text, "%s cannot be started", program);
    else if (WIFSIGNALED(status))
        snprintf(text, sizeof text, "%s was ended (%s), perhaps because memory ran out", program,
                 strsignal(WTERMSIG(status)));
    else
        snprintf(text, sizeof text, "%s failed without a message", program);
    add_fault(out, stage, text);
}

static uint32_t count_errors(const struct compiled *outs, size_t count)
{
    uint32_t errors = 0;
    for (size_t i = 0; i < count; ++i)
        errors += outs[i].errors;
    return errors;
}

/* False where the command failed without a message, and only one source alone could tell whose. */
static bool compile(const struct command *command, struct compiled *outs, mxg_stage stage,
                    const char *const *sources, size_t count)
{
    struct work work;
    if (!make_work(&work, command->ending, sources, count)) {
        for (size_t i = 0; i < count; ++i)
            add_fault(&outs[i], stage, "no temporary file can be written");
        scratch_remove(&work.folder);
        return true;
    }
    uint32_t before = count_errors(outs, count);
    int status = run(command, &work);
    read_log(outs, count, stage, work.log);
    bool is_explained = status == 0 || count_errors(outs, count) > before;
    if (!is_explained && count == 1)
        explain_failure(outs, stage, command->argv[0], status);
    if (count == 1)
        outs->stages[stage].body_instructions = count_instructions(work.object);
    scratch_remove(&work.folder);
    return is_explained || count == 1;
}

bool command_compile_program(const char *target, const char *const sources[MXG_NUM_STAGES],
                             struct compiled *out)
{
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage)
        if (sources[stage])
            compile(find_command(target), out, (mxg_stage)stage, &sources[stage], 1);
    return out->errors == 0;
}

bool command_takes_modules(const char *target)
{
    const struct command *command = find_command(target);
    for (int i = 0; command && i < MAX_ARGUMENTS && command->argv[i]; ++i)
        if (strcmp(command->argv[i], "$MODULES") == 0)
            return files_find_program(command->argv[0]);
    return false;
}

void command_compile_modules(const char *target, const char *const *sources, size_t count,
                             struct compiled *outs)
{
    const struct command *command = find_command(target);
    for (size_t first = 0; first < count; first += MAX_SOURCES) {
        size_t here = count - first < MAX_SOURCES ? count - first : MAX_SOURCES;
        if (compile(command, outs + first, MXG_STAGE_PIXEL, sources + first, here))
            continue;
        for (size_t i = first; i < first + here; ++i)
            compile(command, outs + i, MXG_STAGE_PIXEL, sources + i, 1);
    }
}
