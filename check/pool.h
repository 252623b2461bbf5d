// SPDX-License-Identifier: Apache-2.0
/*
 * Worker processes, each of which checks one document after the other. One that dies or does not
 * end in time is told of and replaced; what else it had to do is given to others. Workers start
 * when they are needed first.
 *
 * A worker has so many documents to do as it does in a short while: it need not wait for the next
 * one, and documents that take long wait for the worker that has time first.
 */
#ifndef MXG_CHECK_POOL_H
#define MXG_CHECK_POOL_H

#include "check/record.h"

#include <stdbool.h>
#include <stddef.h>

struct pool_task {
    const char *path; /* valid until it is answered */
    uint32_t note;    /* enum task_note */
    size_t ticket;
};

struct pool {
    char *const *argv; /* of a worker; the first is the program */
    struct pool_worker *workers;
    size_t num_workers;
    struct pool_task *waiting;    /* for a worker; the first is given next */
    size_t num_waiting, num_open; /* tasks that are not answered, those that wait too */
    double task_time;             /* of the last tasks, in seconds; 0: not known */
    double time_limit;            /* seconds for a step of a document */
    const char *fault;            /* workers cannot be started: why; nothing more can be done */
    char reason[256];
};

struct pool_answer {
    size_t ticket;
    char *record; /* to be freed; NULL: the worker died, or took too long */
    size_t size;
    enum check_stage failed; /* CHECK_CRASH or CHECK_TIMEOUT */
    char *reason;            /* to be freed; why there is no record */
};

/* argv must live on. */
void pool_init(struct pool *pool, char *const *argv, size_t num_workers, double time_limit);
/* Ends all workers. */
void pool_finish(struct pool *pool);

/* How many tasks there may be at a time. */
size_t pool_capacity(size_t num_workers);

/* Whether more work would be done soon. */
bool pool_wants(const struct pool *pool);

/* Where it wants work. */
void pool_give(struct pool *pool, struct pool_task task);

/* Waits until a task is done. False: pool->fault says why. There must be one. */
bool pool_wait(struct pool *pool, struct pool_answer *out);

#endif
