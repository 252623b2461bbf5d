// SPDX-License-Identifier: Apache-2.0
/*
 * Worker processes, each of which checks one document at a time. One that dies or does not end in time is told of and
 * replaced; nothing else is lost. Workers start when they are needed first.
 */
#ifndef MXG_CLI_CHECK_POOL_H
#define MXG_CLI_CHECK_POOL_H

#include "cli/check/record.h"

#include <stdbool.h>
#include <stddef.h>

struct pool {
    char *const *argv; /* of a worker; the first is the program */
    struct pool_worker *workers;
    size_t num_workers, num_busy;
    double time_limit; /* seconds for a step of a document */
    const char *fault; /* workers cannot be started: why; nothing more can be done */
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

bool pool_has_idle(const struct pool *pool);

/* Gives a document to an idle worker; a brief record has no measures. False: pool->fault says why. */
bool pool_give(struct pool *pool, const char *path, bool is_brief, size_t ticket);

/* Waits until a worker is done. False: pool->fault says why. There must be a busy one. */
bool pool_wait(struct pool *pool, struct pool_answer *out);

#endif
