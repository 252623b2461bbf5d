// SPDX-License-Identifier: Apache-2.0
/* mxgen export: the program mxgen-render has it. */
#include "cli/commands.h"
#include "program/export_options.h"

int command_export(const struct command *command, int argc, char **argv)
{
    struct export_options options = EXPORT_OPTIONS_DEFAULTS;
    struct arg args[MAX_EXPORT_ARGS];
    struct cli cli;
    int code;
    if (!command->book)
        return start_renderer(argv);
    cli_start(&cli, command, args, export_args(&options, args), CLI_GENERATES, argc, argv, &code);
    cli_finish(&cli);
    return code;
}
