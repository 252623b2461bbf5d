// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_CLI_FOLDER_H
#define MXG_CLI_FOLDER_H

#include "cli/args.h"

/*
 * Appends the files of a folder and the folders below it whose names end so, sorted by name; each
 * is to be freed. What is hidden is left out. Returns NULL, or why it failed.
 */
const char *folder_find(const char *folder, const char *ending, struct arg_list *out);

#endif
