// SPDX-License-Identifier: Apache-2.0
/* -W: which warnings are shown, and which are errors. */
#ifndef MXG_PROGRAM_WARNINGS_H
#define MXG_PROGRAM_WARNINGS_H

#include "program/args.h"

/* Prints an invalid word and returns false. */
bool warnings_check(const struct arg_list *words);

/* The words as one text for mxg_context_desc.warnings; the caller frees it. */
char *warnings_join(const struct arg_list *words);

#endif
