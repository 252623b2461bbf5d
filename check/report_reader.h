// SPDX-License-Identifier: Apache-2.0
/* Reads a JSON report document by document, with any line breaks. */
#ifndef MXG_CHECK_REPORT_READER_H
#define MXG_CHECK_REPORT_READER_H

#include "program/json_values.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#define REPORT_DOCUMENT_DAMAGED "a document in it cannot be read"

struct report_reader {
    FILE *in;
    json_t *header;   /* the members before the documents */
    json_t *document; /* the current document; NULL: none */
    json_t *tail;     /* the members behind the documents, once these are read; NULL: none */
    uint64_t documents, failed, elements; /* read so far, as the summary counts them */
    const char *fault;                    /* the reason why it is unreadable or no report */
};

/* False: reader->fault has the reason. Call reader_close in both cases. */
bool reader_open(struct report_reader *reader, const char *path);
void reader_close(struct report_reader *reader);

/*
 * Reads the next document. False at the end, or with reader->fault, which also tells of a summary
 * that counts other documents. `out_offset` receives the document's offset for reader_read_at; may
 * be NULL.
 */
bool reader_next(struct report_reader *reader, uint64_t *out_offset);
bool reader_read_at(struct report_reader *reader, uint64_t offset);

#endif
