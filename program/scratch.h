// SPDX-License-Identifier: Apache-2.0
/*
 * Folders of files that do not stay. A process locks its folders, so the next process that makes
 * one removes those of processes that were killed.
 */
#ifndef MXG_PROGRAM_SCRATCH_H
#define MXG_PROGRAM_SCRATCH_H

#include <stdbool.h>

struct scratch {
    char *path; /* NULL: there is none */
    int lock;
};

/* Where temporary files are: $TMPDIR, or /tmp. */
const char *scratch_root(void);

/* Makes a folder there, which only this user reads. false: errno has the reason. */
bool scratch_make(struct scratch *scratch);
/* Removes it with all that is in it. */
void scratch_remove(struct scratch *scratch);

#endif
