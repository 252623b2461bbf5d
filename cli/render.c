// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen render: starts the program mxgen-render, which lies beside this one. It is a program of its own so that
 * generation pays nothing for Vulkan and OpenImageIO.
 */
#define _POSIX_C_SOURCE 200809L
#include "cli/cli.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define RENDERER "mxgen-render"

/* The folder of this program, with a '/' behind it; "" where the system does not tell. */
static const char *program_folder(char *buffer, size_t capacity)
{
    ssize_t len = readlink("/proc/self/exe", buffer, capacity - 1);
    buffer[len > 0 ? len : 0] = '\0';
    char *slash = strrchr(buffer, '/');
    if (slash)
        slash[1] = '\0';
    return buffer;
}

char *cli_renderer(void)
{
    char folder[4096];
    char *path = cli_format("%s" RENDERER, program_folder(folder, sizeof folder));
    if (access(path, X_OK) == 0)
        return path;
    free(path);
    return cli_format(RENDERER);
}

int command_render(const struct command *command, int argc, char **argv)
{
    (void)command;
    (void)argc;
    char *path = cli_renderer();
    execvp(path, argv);
    fprintf(stderr,
            "error: cannot start '%s': it is built where glslang, Vulkan and OpenImageIO are installed [no-renderer]\n",
            path);
    free(path);
    return EXIT_FAULT;
}
