// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen-check: a worker of `mxgen check`, which starts several of them and gives each one document after the other
 * (cli/check/protocol.h). It is a program of its own so that what goes wrong in a document, or in a compiler, ends
 * nothing but its check, and so that plain generation pays nothing for compilers.
 */
#define _POSIX_C_SOURCE 200809L
#include "cli/check/protocol.h"
#include "validate/examine.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* What compilers print must not mix with the frames: standard output becomes another name of stderr. */
static int take_output(void)
{
    int fd = dup(STDOUT_FILENO);
    dup2(STDERR_FILENO, STDOUT_FILENO);
    return fd;
}

static bool send_record(int fd, const struct check_document *document)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return false;
    check_write_document(out, document, true);
    bool good = fclose(out) == 0 && frame_write(fd, FRAME_RECORD, text, size);
    free(text);
    return good;
}

static void serve(struct examiner *examiner)
{
    struct frame_header header;
    bool alive = frame_write(examiner->marks, FRAME_READY, "", 0);
    for (char *path; alive && (path = frame_read(STDIN_FILENO, &header)) != NULL;) {
        examiner->is_brief = header.kind == FRAME_TASK_BRIEF;
        alive = send_record(examiner->marks, examine(examiner, path));
        free(path);
    }
}

int main(int argc, char **argv)
{
    static const struct command command = {"check", "-check (started by `mxgen check`)", "Checks documents.", NULL};
    struct cli cli;
    bool no_compile = false;
    struct examiner examiner = {.cli = &cli, .marks = take_output()};
    const struct arg args[] = {
        {"target", 't', ARG_LIST, "T", "a target", &examiner.targets},
        {"no-compile", 0, ARG_FLAG, NULL, "generates only", &no_compile},
        {"render", 0, ARG_FLAG, NULL, "draws every element", &examiner.render},
    };
    int code;
    if (cli_start(&cli, &command, args, sizeof args / sizeof *args, CLI_GENERATES, argc, argv, &code)) {
        examiner.compile = !no_compile;
        cli.report.colour = false;
        serve(&examiner);
        code = EXIT_DONE;
    }
    examiner_finish(&examiner);
    cli_finish(&cli);
    free(examiner.targets.items);
    return code;
}
