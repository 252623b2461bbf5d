// SPDX-License-Identifier: Apache-2.0
#define _GNU_SOURCE /* memfd_create */
#include "check/pool.h"

#include "check/protocol.h"
#include "program/cli.h"
#include "program/parent.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

enum {
    MAX_TASKS = 16 /* per worker */,
    MAX_TASK_BYTES = 32 << 10 /* in the pipe of a worker; a pipe holds at least this */
};
#define WORK_AHEAD 0.010 /* seconds of work in a worker's queue */

struct pool_worker {
    pid_t pid; /* 0: not started */
    struct frame_stream tasks, answers;
    struct desk *desk;
    struct pool_task queue[MAX_TASKS]; /* its tasks in order; it works on the first */
    size_t num_tasks, task_bytes;
    unsigned num_answered;
    double busy_since; /* the time when its first task began */
    bool is_late;      /* and the pool killed it for this */
};

static double now(void)
{
    return (double)desk_clock() * 1e-9;
}

size_t pool_capacity(size_t num_workers)
{
    return num_workers * MAX_TASKS;
}

void pool_init(struct pool *pool, char *const *argv, size_t num_workers, double time_limit)
{
    *pool = (struct pool){.argv = argv, .num_workers = num_workers, .time_limit = time_limit};
    pool->workers = calloc(num_workers, sizeof *pool->workers);
    pool->waiting = calloc(pool_capacity(num_workers), sizeof *pool->waiting);
    if (!pool->workers || !pool->waiting)
        pool->fault = "out of memory";
    parent_announce();
    signal(SIGPIPE, SIG_IGN); /* the pool notices a dead worker when it reads */
}

/* ---- Processes ---- */

static bool fail(struct pool *pool, const char *what, int reason)
{
    snprintf(pool->reason, sizeof pool->reason, "%s '%s'%s%s", what, pool->argv[0],
             reason ? ": " : "", reason ? strerror(reason) : "");
    pool->fault = pool->reason;
    return false;
}

/* The ends of two pipes and the desk; -1: closed. */
struct ends {
    int task_input, task_output, answer_input, answer_output, desk;
};

static void close_all(const int *fds, size_t count)
{
    for (size_t i = 0; i < count; ++i)
        if (fds[i] >= 0)
            close(fds[i]);
}

static bool open_pipe(int *input, int *output)
{
    int fds[2];
    if (pipe2(fds, O_CLOEXEC) != 0)
        return false;
    *input = fds[0];
    *output = fds[1];
    return true;
}

static struct desk *make_desk(int *out_fd)
{
    *out_fd = memfd_create("desk", MFD_CLOEXEC);
    if (*out_fd < 0 || ftruncate(*out_fd, sizeof(struct desk)) != 0)
        return NULL;
    void *desk = mmap(NULL, sizeof(struct desk), PROT_READ | PROT_WRITE, MAP_SHARED, *out_fd, 0);
    return desk == MAP_FAILED ? NULL : desk;
}

static int spawn(struct pool_worker *worker, char *const *argv, const struct ends *ends)
{
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends->task_input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, ends->answer_output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, ends->desk, DESK_FD);
    int reason = posix_spawnp(&worker->pid, argv[0], &actions, NULL, argv, environ);
    posix_spawn_file_actions_destroy(&actions);
    return reason;
}

static bool start(struct pool *pool, struct pool_worker *worker)
{
    struct ends ends = {-1, -1, -1, -1, -1};
    *worker = (struct pool_worker){0};
    bool good = open_pipe(&ends.task_input, &ends.task_output)
                && open_pipe(&ends.answer_input, &ends.answer_output)
                && (worker->desk = make_desk(&ends.desk)) != NULL;
    const char *what = good ? "cannot start" : "no pipe for";
    int reason = good ? spawn(worker, pool->argv, &ends) : errno;
    close_all((int[]){ends.task_input, ends.answer_output, ends.desk}, 3);
    worker->tasks.fd = ends.task_output;
    worker->answers.fd = ends.answer_input;
    if (good && !reason)
        return true;
    close_all((int[]){ends.task_output, ends.answer_input}, 2);
    if (worker->desk)
        munmap(worker->desk, sizeof *worker->desk);
    *worker = (struct pool_worker){0};
    return fail(pool, what, reason);
}

/* Returns the status of waitpid. */
static int stop(struct pool_worker *worker, bool by_force)
{
    int status = 0;
    if (by_force)
        kill(worker->pid, SIGKILL);
    close(worker->tasks.fd);
    close(worker->answers.fd);
    while (waitpid(worker->pid, &status, 0) < 0 && errno == EINTR) {
    }
    frame_finish(&worker->tasks);
    frame_finish(&worker->answers);
    munmap(worker->desk, sizeof *worker->desk);
    *worker = (struct pool_worker){0};
    return status;
}

void pool_finish(struct pool *pool)
{
    for (size_t i = 0; i < pool->num_workers && pool->workers; ++i)
        if (pool->workers[i].pid)
            stop(&pool->workers[i], pool->workers[i].num_tasks > 0);
    free(pool->workers);
    free(pool->waiting);
}

/* ---- Tasks ---- */

/* The number of tasks that a worker does in WORK_AHEAD. */
static size_t depth(const struct pool *pool)
{
    double count = pool->task_time > 0.0 ? WORK_AHEAD / pool->task_time : 1.0;
    return count < 1.0 ? 1 : count < MAX_TASKS ? (size_t)count : MAX_TASKS;
}

bool pool_wants(const struct pool *pool)
{
    return pool->num_open < depth(pool) * pool->num_workers && !pool->fault;
}

void pool_give(struct pool *pool, struct pool_task task)
{
    pool->waiting[pool->num_waiting++] = task;
    ++pool->num_open;
}

/* The worker with the fewest tasks; among equals one that runs already. */
static struct pool_worker *find_worker(const struct pool *pool)
{
    struct pool_worker *found = NULL;
    for (size_t i = 0; i < pool->num_workers; ++i) {
        struct pool_worker *worker = &pool->workers[i];
        bool is_better = !found || worker->num_tasks < found->num_tasks;
        if (is_better || (worker->num_tasks == found->num_tasks && worker->pid && !found->pid))
            found = worker;
    }
    return found;
}

/*
 * Assigns waiting tasks to workers. Tasks on their way fit into a pipe, so neither side blocks.
 */
static bool hand_out(struct pool *pool)
{
    size_t num_given = 0;
    for (; num_given < pool->num_waiting; ++num_given) {
        struct pool_worker *worker = find_worker(pool);
        const struct pool_task *task = &pool->waiting[num_given];
        size_t bytes = strlen(task->path);
        if (worker->num_tasks
            && (worker->num_tasks >= depth(pool) || worker->task_bytes + bytes > MAX_TASK_BYTES))
            break;
        if (!worker->pid && !start(pool, worker))
            return false;
        if (!worker->num_tasks)
            worker->busy_since = now();
        worker->queue[worker->num_tasks++] = *task;
        worker->task_bytes += bytes;
        frame_put(&worker->tasks, task->note, task->path, bytes);
    }
    pool->num_waiting -= num_given;
    memmove(pool->waiting, pool->waiting + num_given, pool->num_waiting * sizeof *pool->waiting);
    for (size_t i = 0; i < pool->num_workers; ++i)
        if (pool->workers[i].pid)
            frame_flush(&pool->workers[i].tasks);
    return true;
}

/* Removes a task from a worker's queue. */
static struct pool_task take_task(struct pool *pool, struct pool_worker *worker, size_t index)
{
    struct pool_task task = worker->queue[index];
    worker->task_bytes -= strlen(task.path);
    --worker->num_tasks;
    --pool->num_open;
    memmove(worker->queue + index, worker->queue + index + 1,
            (worker->num_tasks - index) * sizeof task);
    return task;
}

/* ---- Answers ---- */

static char *copy_body(const struct frame *frame)
{
    char *copy = malloc((size_t)frame->size + 1);
    return copy ? memcpy(copy, frame->body, (size_t)frame->size + 1) : NULL;
}

/* Handles an answer. */
static bool take_answer(struct pool *pool, struct pool_worker *worker, struct pool_answer *out)
{
    struct frame frame;
    if (!worker->num_tasks || !frame_take(&worker->answers, &frame))
        return false;
    double time = frame.note * 1e-6;
    pool->task_time = pool->task_time > 0.0 ? pool->task_time + (time - pool->task_time) / 8 : time;
    ++worker->num_answered;
    *out = (struct pool_answer){.ticket = take_task(pool, worker, 0).ticket,
                                .record = copy_body(&frame),
                                .size = frame.size};
    return true;
}

static char *describe_end(const char *mark, int status)
{
    if (WIFSIGNALED(status))
        return cli_format("mxgen-check crashed with signal %d (%s) at: %s", WTERMSIG(status),
                          strsignal(WTERMSIG(status)), mark);
    return cli_format("mxgen-check ended with exit code %d at: %s", WEXITSTATUS(status), mark);
}

/*
 * Handles the end of a worker's pipe: the current task gets the blame. Tasks before it are done,
 * but without answers, so they and the tasks after it wait again. If the worker was not ready yet,
 * other workers would fail too.
 */
static bool answer_end(struct pool *pool, struct pool_worker *worker, struct pool_answer *out)
{
    unsigned num_begun = atomic_load(&worker->desk->num_begun) - worker->num_answered;
    size_t at = num_begun && num_begun <= worker->num_tasks ? num_begun - 1 : 0;
    bool is_ready = atomic_load(&worker->desk->is_ready), is_late = worker->is_late,
         is_large = atomic_load(&worker->desk->is_out_of_memory) && pool->memory_limit && !is_late;
    char *mark = num_begun ? desk_describe(worker->desk) : cli_format("start");
    *out = (struct pool_answer){.ticket = take_task(pool, worker, at).ticket,
                                .failed = is_late    ? CHECK_TIMEOUT
                                          : is_large ? CHECK_MEMORY
                                                     : CHECK_CRASH};
    memmove(pool->waiting + worker->num_tasks, pool->waiting,
            pool->num_waiting * sizeof *pool->waiting);
    memcpy(pool->waiting, worker->queue, worker->num_tasks * sizeof *pool->waiting);
    pool->num_waiting += worker->num_tasks;
    int status = stop(worker, false);
    if (is_late)
        out->reason =
            cli_format("the step takes longer than %g seconds: %s", pool->time_limit, mark);
    else if (is_large)
        out->reason =
            cli_format("a worker needs more than %zu MiB of memory: %s", pool->memory_limit, mark);
    else if (is_ready)
        out->reason = describe_end(mark, status);
    free(mark);
    return is_late || is_large || is_ready
           || fail(pool, "this program ended before it was ready:", 0);
}

static double deadline(const struct pool *pool, const struct pool_worker *worker)
{
    double step_begin = (double)atomic_load(&worker->desk->step_begin) * 1e-9;
    return fmax(step_begin, worker->busy_since) + pool->time_limit;
}

static void end_late(struct pool *pool)
{
    double time = now();
    for (size_t i = 0; i < pool->num_workers; ++i) {
        struct pool_worker *worker = &pool->workers[i];
        if (!worker->num_tasks || worker->is_late || time <= deadline(pool, worker))
            continue;
        worker->is_late = true;
        kill(worker->pid, SIGKILL); /* this ends its pipe */
    }
}

/* Waits for output of busy workers until the next deadline. */
static bool poll_workers(const struct pool *pool, struct pollfd *polls)
{
    double next = HUGE_VAL;
    for (size_t i = 0; i < pool->num_workers; ++i) {
        const struct pool_worker *worker = &pool->workers[i];
        polls[i] =
            (struct pollfd){.fd = worker->num_tasks ? worker->answers.fd : -1, .events = POLLIN};
        if (worker->num_tasks && !worker->is_late)
            next = fmin(next, deadline(pool, worker));
    }
    double left = (next - now()) * 1e3;
    int count = poll(polls, (nfds_t)pool->num_workers,
                     left < 0.0   ? 0
                     : left > 1e6 ? 1000000
                                  : (int)left + 1);
    return count > 0;
}

/* Handles buffered answers first, then reads more. */
static bool find_answer(struct pool *pool, struct pollfd *polls, struct pool_answer *out)
{
    for (size_t i = 0; i < pool->num_workers; ++i)
        if (take_answer(pool, &pool->workers[i], out))
            return true;
    if (!hand_out(pool))
        return false;
    bool news = poll_workers(pool, polls);
    for (size_t i = 0; i < pool->num_workers && news; ++i)
        if (polls[i].revents && !frame_fill(&pool->workers[i].answers))
            return answer_end(pool, &pool->workers[i], out);
    end_late(pool);
    return false;
}

bool pool_wait(struct pool *pool, struct pool_answer *out)
{
    struct pollfd *polls = calloc(pool->num_workers, sizeof *polls);
    bool found = false;
    while (polls && !found && !pool->fault)
        found = find_answer(pool, polls, out);
    free(polls);
    return found;
}
