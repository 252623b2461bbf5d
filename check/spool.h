// SPDX-License-Identifier: Apache-2.0
/* Temporary files for parts of a report that follow parts which are only known at the end. */
#ifndef MXG_CHECK_SPOOL_H
#define MXG_CHECK_SPOOL_H

#include <stdio.h>

/* A file without a name in the folder for temporary files; NULL with errno. */
FILE *spool_begin(void);

/*
 * Appends the text of a spool to a file, and closes the spool, which may be NULL. Returns NULL, or
 * the reason for a failure.
 */
const char *spool_end(FILE *spool, FILE *out);

#endif
