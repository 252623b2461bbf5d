// SPDX-License-Identifier: Apache-2.0
/* Reads a JSON report document by document, however it is broken into lines. */
#ifndef MXG_CHECK_REPORT_READER_H
#define MXG_CHECK_REPORT_READER_H

#include "check/record.h"

struct report_reader {
    FILE *in;
    char *text; /* of the document at hand */
    size_t size, capacity;
    struct store store;              /* of the header */
    const struct json_value *header; /* what stands before the documents */
    const char *fault;               /* it cannot be read, or is no report: why */
};

/* False: reader->fault says why. reader_close must follow in both cases. */
bool reader_open(struct report_reader *reader, const char *path);
void reader_close(struct report_reader *reader);

/* The next document's text is in the reader; false at the end, or with reader->fault. */
bool reader_next(struct report_reader *reader);

/* Where the document begins, for reader_read_at. */
uint64_t reader_offset(const struct report_reader *reader);
bool reader_read_at(struct report_reader *reader, uint64_t offset);

#endif
