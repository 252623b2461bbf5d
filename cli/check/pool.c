// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "cli/check/pool.h"

#include "cli/check/protocol.h"
#include "cli/cli.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

extern char **environ;

struct pool_worker {
    pid_t pid; /* 0: not started */
    int to, from;
    bool is_ready, is_busy;
    size_t ticket;
    double deadline;
    char *mark; /* what it began with last */
};

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

void pool_init(struct pool *pool, char *const *argv, size_t num_workers, double time_limit)
{
    *pool = (struct pool){.argv = argv, .num_workers = num_workers, .time_limit = time_limit};
    pool->workers = calloc(num_workers, sizeof *pool->workers);
    if (!pool->workers)
        pool->fault = "out of memory";
    signal(SIGPIPE, SIG_IGN); /* a worker that died is seen when it is read */
}

/* ---- Processes ---- */

static bool fail(struct pool *pool, const char *what, int reason)
{
    snprintf(pool->reason, sizeof pool->reason, "%s '%s'%s%s", what, pool->argv[0], reason ? ": " : "",
             reason ? strerror(reason) : "");
    pool->fault = pool->reason;
    return false;
}

static bool make_pipe(int ends[2])
{
    if (pipe(ends) != 0)
        return false;
    fcntl(ends[0], F_SETFD, FD_CLOEXEC);
    fcntl(ends[1], F_SETFD, FD_CLOEXEC);
    return true;
}

static int spawn(struct pool_worker *worker, char *const *argv, int input, int output)
{
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    int reason = posix_spawnp(&worker->pid, argv[0], &actions, NULL, argv, environ);
    posix_spawn_file_actions_destroy(&actions);
    return reason;
}

static bool start(struct pool *pool, struct pool_worker *worker)
{
    int down[2], up[2];
    *worker = (struct pool_worker){0};
    if (!make_pipe(down))
        return fail(pool, "no pipe for", errno);
    if (!make_pipe(up)) {
        int reason = errno;
        close(down[0]);
        close(down[1]);
        return fail(pool, "no pipe for", reason);
    }
    int reason = spawn(worker, pool->argv, down[0], up[1]);
    close(down[0]);
    close(up[1]);
    worker->to = down[1];
    worker->from = up[0];
    if (!reason)
        return true;
    close(worker->to);
    close(worker->from);
    worker->pid = 0;
    return fail(pool, "cannot start", reason);
}

/* Returns the status of waitpid. */
static int stop(struct pool_worker *worker, bool by_force)
{
    int status = 0;
    if (by_force)
        kill(worker->pid, SIGKILL);
    close(worker->to);
    close(worker->from);
    while (waitpid(worker->pid, &status, 0) < 0 && errno == EINTR) {
    }
    free(worker->mark);
    *worker = (struct pool_worker){0};
    return status;
}

void pool_finish(struct pool *pool)
{
    for (size_t i = 0; i < pool->num_workers && pool->workers; ++i)
        if (pool->workers[i].pid)
            stop(&pool->workers[i], pool->workers[i].is_busy);
    free(pool->workers);
}

/* ---- Work ---- */

bool pool_has_idle(const struct pool *pool)
{
    return pool->num_busy < pool->num_workers;
}

/* One that runs already is preferred. */
static struct pool_worker *find_idle(const struct pool *pool)
{
    struct pool_worker *found = NULL;
    for (size_t i = 0; i < pool->num_workers; ++i) {
        struct pool_worker *worker = &pool->workers[i];
        if (!worker->is_busy && (!found || (worker->pid && !found->pid)))
            found = worker;
    }
    return found;
}

bool pool_give(struct pool *pool, const char *path, bool is_brief, size_t ticket)
{
    if (pool->fault)
        return false;
    struct pool_worker *worker = find_idle(pool);
    if (!worker->pid && !start(pool, worker))
        return false;
    worker->is_busy = true;
    worker->ticket = ticket;
    worker->deadline = now() + pool->time_limit;
    ++pool->num_busy;
    frame_write(worker->to, is_brief ? FRAME_TASK_BRIEF : FRAME_TASK, path, strlen(path));
    return true;
}

static char *describe_end(const struct pool_worker *worker, int status)
{
    const char *mark = worker->mark ? worker->mark : "start";
    if (WIFSIGNALED(status))
        return cli_format("mxgen-check died of signal %d (%s) at: %s", WTERMSIG(status), strsignal(WTERMSIG(status)), mark);
    return cli_format("mxgen-check ended with exit code %d at: %s", WEXITSTATUS(status), mark);
}

/* The worker's pipe ended. Before it was ready, others would not fare better. */
static bool answer_crash(struct pool *pool, struct pool_worker *worker, struct pool_answer *out)
{
    struct pool_worker dead = *worker;
    worker->mark = NULL;
    int status = stop(worker, false);
    --pool->num_busy;
    *out = (struct pool_answer){.ticket = dead.ticket, .failed = CHECK_CRASH};
    if (dead.is_ready)
        out->reason = describe_end(&dead, status);
    free(dead.mark);
    return dead.is_ready || fail(pool, "this program ended before it was ready:", 0);
}

static void answer_timeout(struct pool *pool, struct pool_worker *worker, struct pool_answer *out)
{
    *out = (struct pool_answer){.ticket = worker->ticket, .failed = CHECK_TIMEOUT};
    out->reason = cli_format("not done within %g seconds at: %s", pool->time_limit, worker->mark ? worker->mark : "start");
    stop(worker, true);
    --pool->num_busy;
}

/* Takes one frame. True where it ends the wait: *out is set, or the pool has a fault. */
static bool take_frame(struct pool *pool, struct pool_worker *worker, struct pool_answer *out)
{
    struct frame_header header;
    char *body = frame_read(worker->from, &header);
    if (!body) {
        answer_crash(pool, worker, out);
        return true;
    }
    if (header.kind == FRAME_RECORD) {
        *out = (struct pool_answer){.ticket = worker->ticket, .record = body, .size = header.size};
        worker->is_busy = false;
        --pool->num_busy;
        return true;
    }
    if (header.kind == FRAME_MARK) {
        free(worker->mark);
        worker->mark = body;
        worker->deadline = now() + pool->time_limit; /* it goes on */
        return false;
    }
    worker->is_ready = true;
    free(body);
    return false;
}

/* Polls all busy workers until the next deadline. False: that has passed without news, or the system failed. */
static bool poll_workers(const struct pool *pool, struct pollfd *polls)
{
    double next = HUGE_VAL;
    for (size_t i = 0; i < pool->num_workers; ++i) {
        const struct pool_worker *worker = &pool->workers[i];
        polls[i] = (struct pollfd){.fd = worker->is_busy ? worker->from : -1, .events = POLLIN};
        if (worker->is_busy && worker->deadline < next)
            next = worker->deadline;
    }
    double left = (next - now()) * 1e3;
    int count = poll(polls, (nfds_t)pool->num_workers, left < 0.0 ? 0 : left > 1e6 ? 1000000 : (int)left + 1);
    return count > 0;
}

bool pool_wait(struct pool *pool, struct pool_answer *out)
{
    struct pollfd *polls = calloc(pool->num_workers, sizeof *polls);
    bool answered = !polls;
    while (!answered) {
        bool news = poll_workers(pool, polls);
        for (size_t i = 0; i < pool->num_workers && !answered; ++i) {
            struct pool_worker *worker = &pool->workers[i];
            if (news && polls[i].revents)
                answered = take_frame(pool, worker, out);
            if (!answered && worker->is_busy && now() > worker->deadline) {
                answer_timeout(pool, worker, out);
                answered = true;
            }
        }
    }
    free(polls);
    return polls && !pool->fault;
}
