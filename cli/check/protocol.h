// SPDX-License-Identifier: Apache-2.0
/*
 * How `mxgen check` and its workers (mxgen-check) talk: frames on a pipe each way, a header and a body. Both are always
 * of one build. A worker ends when its input does.
 */
#ifndef MXG_CLI_CHECK_PROTOCOL_H
#define MXG_CLI_CHECK_PROTOCOL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum frame_kind {
    FRAME_TASK = 1, /* to a worker: the path of a document */
    FRAME_TASK_BRIEF, /* the same; nobody asks for more than verdicts and messages */
    FRAME_MARK,     /* from it: what it begins with, in case that this is the last one hears of it */
    FRAME_RECORD,   /* from it: what came of the document, as record.h writes it */
    FRAME_READY,    /* from it, once: it has its library and waits */
};

struct frame_header {
    uint32_t kind, size;
};

/* Writes a frame whole; false where the reader is gone. */
bool frame_write(int fd, enum frame_kind kind, const void *body, size_t size);

/* Reads a frame into new memory with a NUL behind it, to be freed; NULL at the end of the input. */
char *frame_read(int fd, struct frame_header *out_header);

#endif
