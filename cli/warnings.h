// SPDX-License-Identifier: Apache-2.0
/* -W: which warnings are told, and which are errors. */
#ifndef MXG_CLI_WARNINGS_H
#define MXG_CLI_WARNINGS_H

#include "cli/args.h"

/* Prints which word is none, and returns false. */
bool warnings_check(const struct arg_list *words);

/* The words as a context has them (mxg_context_desc.warnings); to be freed. */
char *warnings_join(const struct arg_list *words);

#endif
