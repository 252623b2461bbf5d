// SPDX-License-Identifier: Apache-2.0
/*
 * Files of a folder that appear together: each has another name until all are complete. After an
 * error the folder is as it was.
 */
#ifndef MXG_PROGRAM_BATCH_H
#define MXG_PROGRAM_BATCH_H

#include "program/report.h"

struct batch_file {
    char *temporary; /* NULL: the file has its name */
    char *path;
};

/* Zero-initialise it. */
struct batch {
    struct batch_file *items;
    size_t num;
};

/* Adds the file `name` of a folder. Returns the name under which it is written. */
const char *batch_begin(struct batch *batch, const char *folder, const char *name);
/* Gives all files their names, or removes them if `keep` is false. false: they are removed. */
bool batch_end(struct batch *batch, struct report *report, bool keep);
/* Removes files that have their names, too, and frees the batch. */
void batch_remove(struct batch *batch);
void batch_finish(struct batch *batch);

#endif
