// SPDX-License-Identifier: Apache-2.0
/* The targets that a command line can name: those of mxgen, then those of plug-ins. */
#ifndef MXG_PROGRAM_CLI_TARGETS_H
#define MXG_PROGRAM_CLI_TARGETS_H

#include "program/cli.h"

/* As mxg_catalogue_target. False: there are no more. */
bool cli_target(const struct cli *cli, uint32_t index, mxg_target *out);

/* The target by its name, or by MaterialX's; prints that there is none, and which there are. */
bool cli_find_target(const struct cli *cli, const char *name, size_t len, mxg_target *out);

/* The target of mxgen whose language a target has: `name`, or the base of a plug-in's target. */
const char *cli_base_target(const struct cli *cli, const char *name);

/*
 * False after a message about an option of generation that applies to none of the targets, which
 * exist.
 */
bool cli_options_apply(const struct cli *cli, const char *const *targets, size_t num_targets);

#endif
