// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_PROGRAM_FOLDER_H
#define MXG_PROGRAM_FOLDER_H

#include "program/args.h"

/*
 * Appends the regular files below a folder whose names have this ending, sorted by name; the caller
 * frees each. Skips hidden files and links to folders, which could form a cycle. Returns NULL, or
 * the reason for a failure.
 */
const char *folder_find(const char *folder, const char *ending, struct arg_list *out);

/*
 * Appends the documents (.mtlx) of arguments: files, and all files below folders. The caller frees
 * each. Returns the argument that is a folder without documents, with the reason; NULL if there is
 * none.
 */
const char *folder_documents(const struct arg_list *paths, struct arg_list *out,
                             const char **out_reason);

#endif
