// SPDX-License-Identifier: Apache-2.0
/* -W: which warnings are shown, and which are errors. */
#ifndef MXG_PROGRAM_WARNINGS_H
#define MXG_PROGRAM_WARNINGS_H

#include "program/args.h"

/* Prints an invalid word and returns false. */
bool warnings_check(const struct arg_list *words);

/* The words as one text for mxg_context_desc.warnings; the caller frees it. */
char *warnings_join(const struct arg_list *words);

/* Returns the rest of a word behind a prefix; the word itself if it has another beginning. */
const char *warnings_behind(const char *word, const char *prefix);

/* Returns how a warning of a program is told, by the words. */
enum warning_way { WARNING_HIDDEN, WARNING_SHOWN, WARNING_IS_ERROR };
enum warning_way warnings_way(const struct arg_list *words, const char *id);

#endif
