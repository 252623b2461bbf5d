// SPDX-License-Identifier: Apache-2.0
/* Reads a JSON report document by document, however it is broken into lines. */
#ifndef MXG_CHECK_REPORT_READER_H
#define MXG_CHECK_REPORT_READER_H

#include "check/json.h"

#include <stdbool.h>
#include <stdio.h>

struct report_reader {
    FILE *in;
    json_t *header;    /* the members before the documents */
    json_t *document;  /* at hand; NULL: none */
    const char *fault; /* it cannot be read, or is no report: why */
};

/* False: reader->fault says why. reader_close must follow in both cases. */
bool reader_open(struct report_reader *reader, const char *path);
void reader_close(struct report_reader *reader);

/*
 * Reads the next document. False at the end, or with reader->fault. `out_offset`, unless it is
 * NULL, receives the place of the document for reader_read_at.
 */
bool reader_next(struct report_reader *reader, uint64_t *out_offset);
bool reader_read_at(struct report_reader *reader, uint64_t offset);

#endif
