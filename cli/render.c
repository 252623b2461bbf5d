// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen render: starts the program mxgen-render, which lies beside this one. It is a program of its
 * own so that generation pays nothing for Vulkan and OpenImageIO.
 */
#define _POSIX_C_SOURCE 200809L
#include "cli/cli.h"

#include <stdlib.h>
#include <unistd.h>

int command_render(const struct command *command, int argc, char **argv)
{
    (void)command;
    (void)argc;
    char *path = cli_program("mxgen-render");
    execvp(path, argv);
    fprintf(stderr,
            "error: cannot start '%s': it is built where glslang, Vulkan and OpenImageIO are "
            "installed [no-renderer]\n",
            path);
    free(path);
    return EXIT_FAULT;
}
