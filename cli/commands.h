// SPDX-License-Identifier: Apache-2.0
/* The commands of mxgen, each with its exit code; check/check.h has one more. */
#ifndef MXG_CLI_COMMANDS_H
#define MXG_CLI_COMMANDS_H

#include "program/cli.h"

int command_bake(const struct command *command, int argc, char **argv);
int command_generate(const struct command *command, int argc, char **argv);
int command_inspect(const struct command *command, int argc, char **argv);
int command_bind(const struct command *command, int argc, char **argv);
int command_library(const struct command *command, int argc, char **argv);
int command_lsp(const struct command *command, int argc, char **argv);
int command_validate(const struct command *command, int argc, char **argv);
int command_explain(const struct command *command, int argc, char **argv);
int command_export(const struct command *command, int argc, char **argv);
int command_import(const struct command *command, int argc, char **argv);
int command_render(const struct command *command, int argc, char **argv);
int command_format(const struct command *command, int argc, char **argv);
int command_pipeline(const struct command *command, int argc, char **argv);
int command_translate(const struct command *command, int argc, char **argv);
int command_upgrade(const struct command *command, int argc, char **argv);

/* Becomes mxgen-render, whose first argument is the command. Returns only if it cannot start. */
int start_renderer(char **argv);

#endif
