// SPDX-License-Identifier: Apache-2.0
/* The names in a folder, from a host's function (mxg_resolver.list_folder). */
#ifndef MXG_BASE_FOLDER_NAMES_H
#define MXG_BASE_FOLDER_NAMES_H

#include "base/mem.h"

/* As mxg_resolver.list_folder. */
typedef size_t names_fn(void *user_data, const char *from, const char *folder, char *names,
                        size_t capacity);

/*
 * The names, each with its NUL, in memory of the arena; returns their bytes. A folder may grow
 * between two calls, but a function that always needs more room, or more than 64 MiB, lists
 * nothing.
 */
size_t names_list(struct arena *arena, names_fn *list, void *user_data, const char *from,
                  const char *folder, const char **out_names);

#endif
