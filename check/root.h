// SPDX-License-Identifier: Apache-2.0
/*
 * The root of a run: reports name documents by their path below it, so that runs in different
 * folders and on different machines name them alike.
 */
#ifndef MXG_CHECK_ROOT_H
#define MXG_CHECK_ROOT_H

#include "check/record.h"

#include <stdbool.h>

/* Zero-initialise it; call check_root_finish. */
struct check_root {
    char *given;    /* absolute, without "." and ".." */
    char *physical; /* the same without symbolic links */
    char *folder;   /* the folder of the last path, as given */
    char *prefix;   /* and its path below the root, with a '/' at the end; NULL: outside */
};

/* Opens the folder as root; NULL: the working directory. False with errno: there is none. */
bool check_root_open(struct check_root *root, const char *folder);
void check_root_finish(struct check_root *root);

/* The path of a file below the root; "" if the file is outside. */
const char *check_root_name(struct check_root *root, struct store *store, const char *path);

#endif
