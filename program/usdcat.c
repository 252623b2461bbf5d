// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "program/usdcat.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

bool usdcat_may_help(const mxg_diagnostics *list)
{
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(list); ++i) {
        mxg_diagnostic at = {sizeof at};
        mxg_diagnostics_item(list, i, &at);
        bool is_binary = strcmp(at.id, "usda-syntax") == 0 && at.line == 1 && at.column == 1;
        if (is_binary || strcmp(at.id, "usda-arc") == 0 || strcmp(at.id, "usda-reference") == 0)
            return true;
    }
    return false;
}

/* Returns 0 or a reason of errno. */
static int start(const char *path, const char *out, const char *log, pid_t *out_child)
{
    /* a name is no option */
    char *input = cli_format("%s%s", *path == '-' ? "./" : "", path);
    const char *arguments[] = {"usdcat", "--flatten", input, "--out", out, NULL};
    int reason = cli_start_logged((char *const *)(uintptr_t)arguments, log, out_child);
    free(input);
    return reason;
}

/* Waits for the end; a text says which limit was reached before, NULL: none. */
static const char *wait_for(pid_t child, const char *out, size_t max_mib, int *out_status)
{
    const struct timespec pause = {0, 10000000};
    const char *fault = NULL;
    struct stat info;
    time_t end = time(NULL) + USDCAT_SECONDS;
    for (;;) {
        pid_t ended = waitpid(child, out_status, fault ? 0 : WNOHANG);
        if (ended == child || (ended < 0 && errno != EINTR))
            return fault;
        if (stat(out, &info) == 0 && info.st_size > 0 && (size_t)info.st_size >> 20 > max_mib)
            fault = "its output is larger than --max-file-size";
        else if (time(NULL) > end)
            fault = "it takes too long";
        if (fault)
            kill(child, SIGKILL);
        else
            nanosleep(&pause, NULL);
    }
}

/*
 * The last lines that a program said, of at most 1 KiB together, without empty ones: OpenUSD gives
 * the cause of an error before the error. The caller frees the text.
 */
static char *last_lines(const char *log)
{
    char text[1024];
    FILE *file = fopen(log, "r");
    size_t len = 0, kept = 0;
    bool is_cut = false;
    if (file) {
        is_cut = fseek(file, -(long)sizeof text + 1, SEEK_END) == 0 && ftell(file) > 0;
        if (!is_cut)
            rewind(file);
        len = fread(text, 1, sizeof text - 1, file);
        fclose(file);
    }
    text[len] = '\0';
    char *line = is_cut ? strchr(text, '\n') : NULL; /* a cut line says nothing */
    for (size_t i = line ? (size_t)(line - text) : 0; i < len; i++)
        if (!strchr("\r\n", text[i]) || (kept && text[kept - 1] != '\n'))
            text[kept++] = text[i] == '\r' ? '\n' : text[i];
    text[kept - (kept && text[kept - 1] == '\n')] = '\0';
    return cli_format("%s", text);
}

static void report_fault(struct cli *cli, const char *path, const char *fault, const char *log)
{
    char *said = last_lines(log);
    report_error(&cli->report, "usd-flatten", "'usdcat --flatten %s' fails: %s%s%s", path,
                 fault ? fault : "", fault && *said ? "; it says: " : "",
                 *said || fault ? said : "it says nothing");
    free(said);
}

char *usdcat_flatten(struct cli *cli, const char *path, struct scratch *out_folder,
                     bool *out_is_missing)
{
    pid_t child;
    int status = 0;
    *out_is_missing = false;
    if (!scratch_make(out_folder)) {
        report_error(&cli->report, "usd-flatten", "there is no folder for files of usdcat: %s",
                     strerror(errno));
        return NULL;
    }
    char *out = cli_format("%s/stage.usda", out_folder->path),
         *log = cli_format("%s/log", out_folder->path);
    int reason = start(path, out, log, &child);
    const char *fault =
        reason ? strerror(reason) : wait_for(child, out, cli_max_file_size(cli), &status);
    *out_is_missing = reason == ENOENT;
    bool good = !reason && !fault && WIFEXITED(status) && WEXITSTATUS(status) == 0
                && access(out, R_OK) == 0;
    if (!good && !*out_is_missing)
        report_fault(cli, path, fault, log);
    free(log);
    if (good)
        return out;
    free(out);
    return NULL;
}
