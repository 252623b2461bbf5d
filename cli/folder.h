// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_CLI_FOLDER_H
#define MXG_CLI_FOLDER_H

#include "cli/args.h"

/*
 * Appends the files below a folder whose names have this ending, sorted by name; the caller frees
 * each. Skips hidden files. Returns NULL, or the reason for a failure.
 */
const char *folder_find(const char *folder, const char *ending, struct arg_list *out);

#endif
