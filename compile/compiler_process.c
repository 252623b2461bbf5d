// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "compile/compiler_process.h"

#include "compile/spirv.h"

#include <fcntl.h>
#include <inttypes.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;
extern const char compile_slang_script[], compile_dawn_script[]; /* worker_scripts.S */

static struct worker {
    const char *target;
    const char *variable; /* the path of the compiler */
    const char *script;   /* for Node; NULL: the compiler answers requests itself */
    pid_t process;        /* 0: it does not run */
    int channel;
} workers[] = {
    {"slang", "MXGEN_SLANG", compile_slang_script, 0, -1},
    {"wgsl", "MXGEN_DAWN", compile_dawn_script, 0, -1},
    {"msl", "MXGEN_MSLCHECK", NULL, 0, -1},
};

static struct worker *find_worker(const char *target)
{
    for (size_t i = 0; i < sizeof workers / sizeof *workers; ++i)
        if (strcmp(workers[i].target, target) == 0)
            return &workers[i];
    return NULL;
}

bool worker_knows_target(const char *target)
{
    const struct worker *worker = find_worker(target);
    const char *path = worker ? getenv(worker->variable) : NULL;
    return path && *path && access(path, R_OK) == 0;
}

/* ---- The process ---- */

/* The process has its end of the channel as standard input and output. */
static bool spawn(struct worker *worker, int end)
{
    posix_spawn_file_actions_t actions;
    char *node[] = {(char[]){"node"}, (char[]){"--input-type=module"}, (char[]){"-e"},
                    (char *)(uintptr_t)worker->script, NULL};
    char *itself[] = {getenv(worker->variable), (char[]){"--serve"}, NULL};
    char **argv = worker->script ? node : itself;
    if (posix_spawn_file_actions_init(&actions) != 0)
        return false;
    posix_spawn_file_actions_adddup2(&actions, end, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, end, STDOUT_FILENO);
    bool good = posix_spawnp(&worker->process, argv[0], &actions, NULL, argv, environ) == 0;
    posix_spawn_file_actions_destroy(&actions);
    return good;
}

static bool start(struct worker *worker)
{
    int ends[2];
    if (worker->process)
        return true;
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0)
        return false;
    for (int i = 0; i < 2; i++)
        fcntl(ends[i], F_SETFD, FD_CLOEXEC);
    bool good = spawn(worker, ends[1]);
    close(ends[1]);
    worker->channel = ends[0];
    if (!good) {
        close(ends[0]);
        worker->process = 0;
    }
    return good;
}

static void end(struct worker *worker)
{
    if (!worker->process)
        return;
    close(worker->channel);
    waitpid(worker->process, NULL, 0);
    worker->process = 0;
}

void workers_end(void)
{
    for (size_t i = 0; i < sizeof workers / sizeof *workers; ++i)
        end(&workers[i]);
}

/* ---- Requests and answers: answer.mjs says their form ---- */

static bool send_all(const struct worker *worker, const char *bytes, size_t size)
{
    while (size) {
        ssize_t sent = send(worker->channel, bytes, size, MSG_NOSIGNAL);
        if (sent <= 0)
            return false;
        bytes += sent;
        size -= (size_t)sent;
    }
    return true;
}

static bool receive_all(const struct worker *worker, void *bytes, size_t size)
{
    for (char *at = bytes; size;) {
        ssize_t received = recv(worker->channel, at, size, 0);
        if (received <= 0)
            return false;
        at += received;
        size -= (size_t)received;
    }
    return true;
}

static bool send_request(const struct worker *worker, const char *const sources[MXG_NUM_STAGES])
{
    char line[64];
    size_t sizes[MXG_NUM_STAGES];
    for (int i = 0; i < MXG_NUM_STAGES; i++)
        sizes[i] = sources[i] ? strlen(sources[i]) : 0;
    int len = snprintf(line, sizeof line, "%zu %zu\n", sizes[0], sizes[1]);
    bool good = send_all(worker, line, (size_t)len);
    for (int i = 0; good && i < MXG_NUM_STAGES; i++)
        good = sizes[i] == 0 || send_all(worker, sources[i], sizes[i]);
    return good;
}

/* How long the parts of an answer are. */
struct sizes {
    size_t log, words[MXG_NUM_STAGES], places;
};

static bool receive_sizes(const struct worker *worker, struct sizes *out)
{
    char line[96];
    size_t len = 0;
    do {
        if (len + 1 == sizeof line || !receive_all(worker, line + len, 1))
            return false;
    } while (line[len++] != '\n');
    line[len] = '\0';
    return sscanf(line, "%zu %zu %zu %zu", &out->log, &out->words[0], &out->words[1], &out->places)
           == 4;
}

static bool add_message(struct compiled *out, const char *line, size_t len)
{
    unsigned stage, is_error, number;
    int text = 0;
    if (sscanf(line, "%u %u %u %n", &stage, &is_error, &number, &text) == 3 && text)
        compiled_add(out, stage == 0 ? MXG_STAGE_VERTEX : MXG_STAGE_PIXEL,
                     is_error ? MXG_SEVERITY_ERROR : MXG_SEVERITY_WARNING, number, line + text,
                     len - (size_t)text);
    return true;
}

static bool add_place(struct compiled *out, const char *line, size_t len)
{
    struct compiled_place place = {0};
    int name = 0;
    if (sscanf(line, "%" SCNu32 "%" SCNu32 "%" SCNu32 "%" SCNu32 "%" SCNu32 " %n", &place.set,
               &place.index, &place.offset, &place.byte_size, &place.array_stride, &name)
            != 5
        || !name)
        return false;
    struct compiled_place *more = realloc(out->places, (out->num_places + 1) * sizeof *more);
    if (!more)
        return false;
    out->places = more;
    place.name = strndup(line + name, len - (size_t)name);
    out->places[out->num_places] = place;
    out->num_places += place.name != NULL;
    return place.name != NULL;
}

/* `add` is false for a line that cannot be kept. */
static bool receive_lines(const struct worker *worker, struct compiled *out, size_t size,
                          bool (*add)(struct compiled *out, const char *line, size_t len))
{
    char *text = malloc(size + 1);
    bool good = text && receive_all(worker, text, size);
    if (good)
        text[size] = '\0';
    for (char *line = text; good && *line;) {
        size_t len = strcspn(line, "\n");
        good = add(out, line, len);
        line += len + (line[len] == '\n');
    }
    free(text);
    return good;
}

static bool receive_words(const struct worker *worker, struct compiled_stage *code, size_t size)
{
    if (size == 0)
        return true;
    code->num_words = size / sizeof *code->words;
    code->words = malloc(code->num_words * sizeof *code->words);
    if (!code->words || !receive_all(worker, code->words, code->num_words * sizeof *code->words))
        return false;
    spirv_hide_language(code->words, code->num_words);
    code->body_instructions = spirv_count(code->words, code->num_words, NULL, NULL);
    return true;
}

bool worker_compile_program(const char *target, const char *const sources[MXG_NUM_STAGES],
                            struct compiled *out)
{
    static const char fault[] = "the compiler cannot be started, or ended early";
    struct worker *worker = find_worker(target);
    struct sizes sizes;
    bool good = start(worker) && send_request(worker, sources) && receive_sizes(worker, &sizes)
                && receive_lines(worker, out, sizes.log, add_message);
    for (int i = 0; good && i < MXG_NUM_STAGES; i++)
        good = receive_words(worker, &out->stages[i], sizes.words[i]);
    good = good && receive_lines(worker, out, sizes.places, add_place);
    if (!good) {
        compiled_add(out, MXG_STAGE_PIXEL, MXG_SEVERITY_ERROR, 0, fault, sizeof fault - 1);
        end(worker);
    }
    return out->errors == 0;
}
