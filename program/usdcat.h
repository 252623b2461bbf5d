// SPDX-License-Identifier: Apache-2.0
/* OpenUSD composes stages: its program usdcat writes one as a text layer, which mxgen reads. */
#ifndef MXG_PROGRAM_USDCAT_H
#define MXG_PROGRAM_USDCAT_H

#include "program/cli.h"
#include "program/scratch.h"

/*
 * True if the messages about a stage say that it has arcs, or is no text, so that another program
 * can help.
 */
bool usdcat_may_help(const mxg_diagnostics *list);

/*
 * Starts 'usdcat --flatten' of the search path, for at most USDCAT_SECONDS, and while its output
 * stays below --max-file-size. The name of the text in a scratch folder, which the caller removes;
 * the caller frees the name. NULL: there is no usdcat, with *out_is_missing, or after an error with
 * what the program said.
 */
enum { USDCAT_SECONDS = 300 };
char *usdcat_flatten(struct cli *cli, const char *path, struct scratch *out_folder,
                     bool *out_is_missing);

#endif
