// SPDX-License-Identifier: Apache-2.0
/*
 * Files that appear together: none has its name until all are complete. After an error the folder
 * is as it was, and after a kill, too.
 */
#ifndef MXG_PROGRAM_BATCH_H
#define MXG_PROGRAM_BATCH_H

#include "program/files.h"
#include "program/report.h"

struct batch_file {
    struct files_stream stream;
    char *path;
};

/* Zero-initialise it. */
struct batch {
    struct batch_file *items;
    size_t num;
};

/*
 * Adds a file, to be written before the next one: *out is its stream. Returns NULL, or the reason
 * for a failure.
 */
const char *batch_begin(struct batch *batch, const char *path, const struct files_stream **out);
/* Adds a file with its bytes. Returns NULL, or the reason for a failure. */
const char *batch_write(struct batch *batch, const char *path, const void *data, size_t size);
/*
 * Gives all files their names if `keep` is set and nothing fails, and frees the batch. false: the
 * files that have no name yet are gone.
 */
bool batch_end(struct batch *batch, struct report *report, bool keep);

#endif
