// SPDX-License-Identifier: Apache-2.0
/* The paths that primitives of a stage have if its file gives nodes any names, as glTF does. */
#ifndef MXG_PROGRAM_NODE_PATH_H
#define MXG_PROGRAM_NODE_PATH_H

#include "program/name_table.h"

/*
 * "/parent/name", of letters, digits and '_', or "/parent/name_2" where others have that. The table
 * has the paths so far, each with the number of the last one that took it. The caller frees it.
 */
char *node_path_add(struct name_table *paths, const char *parent, const char *name);

#endif
