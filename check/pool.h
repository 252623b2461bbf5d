// SPDX-License-Identifier: Apache-2.0
/*
 * Worker processes, each of which checks one document after the other. If one dies or exceeds the
 * time limit, the pool reports this, replaces the worker, and gives its other tasks to other
 * workers. Workers start on first use.
 *
 * A worker's queue holds the documents that it can check in a short time. So it need not wait for
 * the next one, and slow documents go to the first free worker.
 */
#ifndef MXG_CHECK_POOL_H
#define MXG_CHECK_POOL_H

#include "check/record.h"

#include <stdbool.h>
#include <stddef.h>

struct pool_task {
    const char *path; /* valid until the answer */
    uint32_t note;    /* enum task_note */
    size_t ticket;
};

struct pool {
    char *const *argv; /* command line of a worker; the program first */
    struct pool_worker *workers;
    size_t num_workers;
    struct pool_task *waiting;    /* tasks for workers; the first is next */
    size_t num_waiting, num_open; /* waiting, and without an answer */
    double task_time;             /* mean of the last tasks, in seconds; 0: unknown */
    double time_limit;            /* seconds per step of a document */
    size_t memory_limit;          /* MiB of a worker, which sets it for itself; 0: none */
    const char *fault;            /* the reason why workers cannot start; the pool is unusable */
    char reason[256];
};

struct pool_answer {
    size_t ticket;
    char *record; /* the caller frees it; NULL: the worker died or exceeded a limit */
    size_t size;
    enum check_failure failed; /* CHECK_CRASH, CHECK_TIMEOUT or CHECK_MEMORY */
    char *reason;              /* the caller frees it; why there is no record */
};

/* The caller keeps argv alive. */
void pool_init(struct pool *pool, char *const *argv, size_t num_workers, double time_limit);
/* Ends all workers. */
void pool_finish(struct pool *pool);

/* The maximum number of tasks at a time. */
size_t pool_capacity(size_t num_workers);

/* True if a worker would soon start another task. */
bool pool_wants(const struct pool *pool);

/* Adds a task; only valid if pool_wants. */
void pool_give(struct pool *pool, struct pool_task task);

/* Waits for the end of a task; there must be one. False: pool->fault has the reason. */
bool pool_wait(struct pool *pool, struct pool_answer *out);

#endif
