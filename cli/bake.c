// SPDX-License-Identifier: Apache-2.0
/* mxgen bake: the program mxgen-render has it. */
#include "cli/commands.h"
#include "program/bake_options.h"

int command_bake(const struct command *command, int argc, char **argv)
{
    struct bake_options options = BAKE_OPTIONS_DEFAULTS;
    struct arg args[MAX_BAKE_ARGS];
    struct cli cli;
    int code;
    if (!command->book)
        return start_renderer(argv);
    cli_start(&cli, command, args, bake_args(&options, args), CLI_GENERATES, argc, argv, &code);
    cli_finish(&cli);
    return code;
}
