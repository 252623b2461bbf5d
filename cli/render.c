// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen render: starts the program mxgen-render in the same folder. It is a separate program, so
 * that generation does not load Vulkan and OpenImageIO.
 */
#define _POSIX_C_SOURCE 200809L
#include "cli/commands.h"
#include "program/render_options.h"

#include <stdlib.h>
#include <unistd.h>

int start_renderer(char **argv)
{
    char *path = cli_program("mxgen-render");
    execvp(path, argv);
    fprintf(stderr,
            "error: cannot start '%s': it is built where glslang, Vulkan and OpenImageIO are "
            "installed [no-renderer]\n",
            path);
    free(path);
    return EXIT_FAULT;
}

int command_render(const struct command *command, int argc, char **argv)
{
    if (command->book) { /* the caller needs only the table of options */
        struct render_options options = RENDER_OPTIONS_DEFAULTS;
        struct arg args[MAX_RENDER_ARGS];
        struct cli cli;
        int code;
        cli_start(&cli, command, args, render_args(&options, args), CLI_GENERATES, argc, argv,
                  &code);
        cli_finish(&cli);
        return code;
    }
    return start_renderer(argv);
}
