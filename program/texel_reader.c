// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "program/texel_reader.h"
#include "program/cli.h"
#include "program/parent.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

/* Starts a program that writes into a pipe, without its messages. Its process; -1: it did not. */
static pid_t start(char *const *arguments, int to, int from)
{
    posix_spawn_file_actions_t actions;
    pid_t process = -1;
    if (posix_spawn_file_actions_init(&actions))
        return -1;
    parent_announce();
    bool good =
        !posix_spawn_file_actions_adddup2(&actions, to, STDOUT_FILENO)
        && !posix_spawn_file_actions_addclose(&actions, from)
        && !posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    if (!good || posix_spawnp(&process, arguments[0], &actions, NULL, arguments, environ))
        process = -1;
    posix_spawn_file_actions_destroy(&actions);
    return process;
}

/* True if the pipe has exactly so many bytes. */
static bool read_all(int pipe_end, void *out, size_t size)
{
    FILE *stream = fdopen(pipe_end, "rb");
    if (!stream) {
        close(pipe_end);
        return false;
    }
    bool good = fread(out, 1, size, stream) == size && fgetc(stream) == EOF;
    fclose(stream);
    return good;
}

static bool ask(char *const *arguments, float *out_texels, size_t size)
{
    int ends[2], status = -1;
    if (pipe(ends))
        return false;
    pid_t process = start(arguments, ends[1], ends[0]);
    close(ends[1]);
    bool good = read_all(ends[0], out_texels, size);
    if (process < 0)
        return false;
    while (waitpid(process, &status, 0) < 0)
        if (errno != EINTR)
            return false;
    return good && status == 0;
}

bool cli_read_texels(void *user_data, const char *from, const char *file, const char *layer,
                     uint32_t size, float *out_texels)
{
    (void)user_data;
    struct arg_list args = {0};
    args_append(&args, cli_program("mxgen-render"));
    args_append(&args, cli_format(CLI_TEXELS));
    args_append(&args, cli_beside(from, file));
    args_append(&args, cli_format("%s", layer));
    args_append(&args, cli_format("%u", (unsigned)size));
    args_append(&args, NULL);
    bool good = ask((char *const *)(uintptr_t)args.items, out_texels,
                    (size_t)size * size * 4 * sizeof *out_texels);
    args_free(&args);
    return good;
}
