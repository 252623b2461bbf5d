// SPDX-License-Identifier: Apache-2.0
/*
 * The protocol between `mxgen check` and its workers (mxgen-check), which come from one build:
 * frames on a pipe in each direction, with a header and a body. Several tasks can be in the pipe,
 * and several answers arrive together, so that not every frame wakes the reader. The worker writes
 * its current step to shared memory, its desk: this needs no system call, and survives the worker.
 * A worker ends when its input ends.
 */
#ifndef MXG_CHECK_PROTOCOL_H
#define MXG_CHECK_PROTOCOL_H

#include "check/record.h"

#include <stdatomic.h>

/* ---- Frames ---- */

/* Flags in the note of a task. */
enum task_note {
    TASK_BRIEF = 1,       /* only verdicts and messages, no measures */
    TASK_ERRORS_ONLY = 2, /* only errors need their printed form */
};

/*
 * A task is the path of a document; an answer is a record as JSON, and its note the duration in
 * microseconds.
 */
struct frame {
    uint32_t note, size;
    char *body; /* with a NUL after it; valid until the next read from the stream */
};

/* Bytes that were read but not taken yet, or bytes to write. */
struct frame_stream {
    int fd;
    char *bytes;
    size_t begin, end, capacity;
};

/* Takes a complete frame out of the buffer. False: there is none. */
bool frame_take(struct frame_stream *stream, struct frame *out);
/* Reads available bytes; waits if there are none. False at the end. */
bool frame_fill(struct frame_stream *stream);
/* Appends a frame to the bytes to write; ends the program if memory is exhausted. */
void frame_put(struct frame_stream *stream, uint32_t note, const void *body, size_t size);
/* Writes all bytes; false if the reader has ended. */
bool frame_flush(struct frame_stream *stream);
void frame_finish(struct frame_stream *stream);

/* ---- The desk ---- */

enum { DESK_FD = 3 /* descriptor in a worker */, DESK_TARGET = 64, DESK_ELEMENT = 960 };

/* Texts are complete unless the worker died while it wrote them. Their last byte stays NUL. */
struct desk {
    atomic_uint is_ready;         /* the worker has loaded its library */
    atomic_uint num_begun;        /* number of started tasks */
    atomic_ullong step_begin;     /* desk_clock, in nanoseconds */
    atomic_uint step;             /* enum check_failure: where a fault now would be */
    atomic_uint is_out_of_memory; /* an allocation failed that the worker cannot handle */
    char element[DESK_ELEMENT];   /* "": the document */
    char target[DESK_TARGET];
};

/* Nanoseconds of a monotonic clock that all processes share. */
uint64_t desk_clock(void);
/* The worker's current step: "generate of 'Gold' for glsl"; the caller frees it. */
char *desk_describe(const struct desk *desk);

/* ---- A worker's end ---- */

struct channel {
    struct frame_stream tasks, answers;
    struct desk *desk;
    uint64_t task_begin, oldest_answer; /* begin of the task; time of the oldest buffered answer */
};

/* False: this process was not started as a worker. */
bool channel_open(struct channel *channel, int input, int output);
/* The next task; false at the end. */
bool channel_next(struct channel *channel, struct frame *out_task);
/* Writes the step that begins to the desk, in case the worker dies in it. */
void channel_mark(struct channel *channel, enum check_failure step, const char *element,
                  const char *target);
/*
 * Queues the answer to the task; it is written when the worker has no more tasks, or after a short
 * time.
 */
void channel_answer(struct channel *channel, const void *record, size_t size);
void channel_close(struct channel *channel);

#endif
