// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen-check: a worker of `mxgen check`, which starts several of them and sends each one document
 * after the other (check/protocol.h). It is a separate program for two reasons: a crash in a
 * document or a compiler ends only one check, and plain generation does not load compilers.
 */
#define _POSIX_C_SOURCE 200809L
#include "check/examine.h"
#include "check/record_json.h"
#include "program/limit.h"
#include "program/json_values.h"
#include "program/parent.h"
#include "program/memory.h"
#include "compile/compile.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/*
 * Output of compilers must not mix with the frames, so standard output becomes a copy of stderr.
 */
static int take_output(void)
{
    int fd = dup(STDOUT_FILENO);
    dup2(STDERR_FILENO, STDOUT_FILENO);
    return fd;
}

/* The worker's desk, for a handler; NULL: the worker has none yet. */
static struct desk *desk_of_worker;

static void tell_no_memory(void)
{
    if (desk_of_worker)
        atomic_store(&desk_of_worker->is_out_of_memory, 1);
}

static bool serve(struct examiner *examiner, int output)
{
    struct frame task;
    if (!channel_open(&examiner->channel, STDIN_FILENO, output)) {
        fputs("mxgen: this program is started by 'mxgen check'\n", stderr);
        return false;
    }
    desk_of_worker = examiner->channel.desk;
    compile_on_exhaustion(tell_no_memory);
    memory_on_exhaustion(tell_no_memory);
    json_use_memory();
    while (channel_next(&examiner->channel, &task)) {
        examiner->is_brief = task.note & TASK_BRIEF;
        examiner->errors_only = task.note & TASK_ERRORS_ONLY;
        const struct check_document *document = examine(examiner, task.body);
        size_t size;
        char *record = record_to_text(document, &size);
        channel_answer(&examiner->channel, record, size);
        free(record);
    }
    desk_of_worker = NULL;
    channel_close(&examiner->channel);
    return true;
}

int main(int argc, char **argv)
{
    static const struct command command = {"check", "-check (a worker, which `mxgen check` starts)",
                                           "Checks documents.", NULL};
    struct cli cli;
    bool no_compile = false;
    const char *accept = NULL;
    struct examiner examiner = {.cli = &cli};
    int output = take_output();
    parent_follow();
    size_t memory_limit = 0;
    const struct arg args[] = {
        {"target", 't', ARG_LIST, "T", "a target", &examiner.targets},
        {"no-compile", 0, ARG_FLAG, NULL, "does not compile the shaders", &no_compile},
        {"render", 0, ARG_FLAG, NULL, "renders each element", &examiner.render},
        {"translate", 0, ARG_TEXT, "MODEL", "translates surfaces", &examiner.translate},
        {"accept", 0, ARG_TEXT, "ERROR", "compares pictures before and after", &accept},
        {"stage", 0, ARG_TEXT, "FILE", "checks the stacks of a scene", &examiner.stage.file},
        {"look", 0, ARG_TEXT, "LOOK", "the look for --stage", &examiner.stage.look},
        {"purpose", 0, ARG_TEXT, "WORD", "the purpose for --stage", &examiner.stage.purpose},
        {"memory-limit", 0, ARG_SIZE, "MIB", "limit of this process", &memory_limit},
    };
    int code;
    if (cli_start(&cli, &command, args, sizeof args / sizeof *args, CLI_GENERATES, argc, argv,
                  &code)) {
        examiner.compile = !no_compile;
        examiner.accept = accept ? strtod(accept, NULL) : -1;
        cli.report.colour = false;
        examiner.memory_limit = memory_limit;
        if (memory_limit)
            limit_data((uint64_t)memory_limit << 20);
        code = serve(&examiner, output) ? EXIT_DONE : EXIT_USAGE;
    }
    examiner_finish(&examiner);
    cli_finish(&cli);
    free(examiner.targets.items);
    return code;
}
