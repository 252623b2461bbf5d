// SPDX-License-Identifier: Apache-2.0
/*
 * How `mxgen check` and its workers (mxgen-check) talk, which are always of one build: frames on a
 * pipe each way, a header and a body. Several tasks may be on their way, and the answers to several
 * come at once: each wakes nobody by itself. What a worker is at stands in memory that both share,
 * its desk: that costs no call of the system and is still there when the worker is not. A worker
 * ends when its input does.
 */
#ifndef MXG_CHECK_PROTOCOL_H
#define MXG_CHECK_PROTOCOL_H

#include "check/record.h"

#include <stdatomic.h>

/* ---- Frames ---- */

/* What is asked for, in the note of a task. */
enum task_note {
    TASK_BRIEF = 1,       /* verdicts and messages, no measures */
    TASK_ERRORS_ONLY = 2, /* nobody reads how other messages than errors are printed */
};

/*
 * A task is the path of a document; an answer is a record as bytes, and its note how many
 * microseconds it took.
 */
struct frame {
    uint32_t note, size;
    char *body; /* with a NUL behind it; valid until the stream is read again */
};

/* What was read and not taken yet, or what is to be written. */
struct frame_stream {
    int fd;
    char *bytes;
    size_t begin, end, capacity;
};

/* Takes a frame of those that were read. False: none is whole. */
bool frame_take(struct frame_stream *stream, struct frame *out);
/* Reads what there is; waits where there is nothing. False at the end. */
bool frame_fill(struct frame_stream *stream);
/* Appends a frame to what is to be written; the program ends where there is no memory. */
void frame_put(struct frame_stream *stream, uint32_t note, const void *body, size_t size);
/* Writes all; false where the reader is gone. */
bool frame_flush(struct frame_stream *stream);
void frame_finish(struct frame_stream *stream);

/* ---- The desk ---- */

enum { DESK_FD = 3 /* by which a worker finds it */, DESK_TARGET = 64, DESK_ELEMENT = 960 };

/* The texts are complete unless the worker died while it wrote them. Their last byte stays NUL. */
struct desk {
    atomic_uint is_ready;       /* it has its library */
    atomic_uint num_begun;      /* tasks */
    atomic_ullong step_begin;   /* of the clock, in nanoseconds */
    atomic_uint stage;          /* of the step: enum check_stage */
    char element[DESK_ELEMENT]; /* "": the document */
    char target[DESK_TARGET];
};

/* Nanoseconds of a clock that only goes forward, the same for all processes. */
uint64_t desk_clock(void);
/* What the worker is at: "generate of 'Gold' for glsl"; to be freed. */
char *desk_describe(const struct desk *desk);

/* ---- A worker's end ---- */

struct channel {
    struct frame_stream tasks, answers;
    struct desk *desk;
    uint64_t task_begin, oldest_answer; /* when the oldest that was not written was made */
};

/* False: nobody started this as a worker. */
bool channel_open(struct channel *channel, int input, int output);
/* The next task; false at the end. */
bool channel_next(struct channel *channel, struct frame *out_task);
/* Tells what begins, should it be the last. */
void channel_mark(struct channel *channel, enum check_stage stage, const char *element,
                  const char *target);
/* The answer to the task. Written when the worker has no more to do, or after a while. */
void channel_answer(struct channel *channel, const void *record, size_t size);
void channel_close(struct channel *channel);

#endif
