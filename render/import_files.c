// SPDX-License-Identifier: Apache-2.0
#define _XOPEN_SOURCE 700
#include "render/import_files.h"

#include "program/limit.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <unistd.h>

enum { MAX_OPENED = 4096 };

/*
 * So much time of the processor may it take, and for each MiB of its files: it reads most in a
 * tenth of that, but some of its work grows with the square, as that for properties of a node.
 */
enum { BASE_SECONDS = 10, SECONDS_PER_MIB = 2 };

/* ---- Crashes ---- */

static const int signals[] = {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGPROF};
enum { NUM_SIGNALS = sizeof signals / sizeof *signals, STACK_SIZE = 1 << 16 };
static struct sigaction before[NUM_SIGNALS];
static char stack[STACK_SIZE], crashed[512], took_long[512];

/* Runs on a stack of its own, because the usual cause is a stack that is full. */
static void die(int number)
{
    const char *message = number == SIGPROF ? took_long : crashed;
    ssize_t written = write(STDERR_FILENO, message, strlen(message));
    _exit(written < 0 ? 2 : 1);
}

/* 0: no limit. */
static void limit_seconds(uint64_t seconds)
{
    const struct itimerval limit = {.it_value = {.tv_sec = (time_t)seconds}};
    setitimer(ITIMER_PROF, &limit, NULL);
}

static void catch_crashes(const char *path)
{
    const stack_t own = {.ss_sp = stack, .ss_size = sizeof stack};
    struct sigaction action = {.sa_handler = die, .sa_flags = SA_ONSTACK};
    snprintf(crashed, sizeof crashed,
             "error: cannot use the mesh '%.300s': its reader cannot go on; the file is damaged, "
             "nests too deep or needs too much memory [bad-mesh]\n",
             path);
    snprintf(took_long, sizeof took_long,
             "error: cannot use the mesh '%.300s': its reader takes too long; a node may have too "
             "many properties, or many corners lie at one place [bad-mesh]\n",
             path);
    sigemptyset(&action.sa_mask);
    sigaltstack(&own, NULL);
    for (size_t i = 0; i < NUM_SIGNALS; ++i)
        sigaction(signals[i], &action, &before[i]);
}

static void forget_crashes(void)
{
    for (size_t i = 0; i < NUM_SIGNALS; ++i)
        sigaction(signals[i], &before[i], NULL);
}

/* ---- Files ---- */

static struct import_files *files_of(struct aiFileIO *io)
{
    return (struct import_files *)(void *)io->UserData;
}

static FILE *stream_of(struct aiFile *file)
{
    return (FILE *)(void *)file->UserData;
}

static size_t read_bytes(struct aiFile *file, char *out, size_t size, size_t count)
{
    return fread(out, size, count, stream_of(file));
}

static size_t write_none(struct aiFile *file, const char *bytes, size_t size, size_t count)
{
    (void)file, (void)bytes, (void)size, (void)count;
    return 0;
}

static size_t tell(struct aiFile *file)
{
    long at = ftell(stream_of(file));
    return at < 0 ? 0 : (size_t)at;
}

static size_t size_of(struct aiFile *file)
{
    struct stat info;
    return fstat(fileno(stream_of(file)), &info) == 0 ? (size_t)info.st_size : 0;
}

static aiReturn seek(struct aiFile *file, size_t offset, enum aiOrigin origin)
{
    static const int whence[] = {
        [aiOrigin_SET] = SEEK_SET, [aiOrigin_CUR] = SEEK_CUR, [aiOrigin_END] = SEEK_END};
    bool good = origin <= aiOrigin_END && fseek(stream_of(file), (long)offset, whence[origin]) == 0;
    return good ? aiReturn_SUCCESS : aiReturn_FAILURE;
}

static void flush_none(struct aiFile *file)
{
    (void)file;
}

/* Notes why a file is refused; Assimp sees a file that does not exist. */
static const char *refuse(struct import_files *files, const char *path)
{
    const char *fault = NULL;
    if (strcmp(path, files->path) != 0)
        fault = mxg_context_file_fault(files->context, files->path, path);
    if (!fault && ++files->num_opened > MAX_OPENED)
        fault = "too many files are opened";
    if (fault && !*files->fault)
        snprintf(files->fault, sizeof files->fault, "'%.80s': %s", path, fault);
    return fault;
}

static struct aiFile *open_file(struct aiFileIO *io, const char *path, const char *mode)
{
    struct import_files *files = files_of(io);
    if (*mode != 'r' || refuse(files, path))
        return NULL;
    FILE *stream = fopen(path, "rb");
    struct aiFile *file = stream ? malloc(sizeof *file) : NULL;
    if (!file) {
        if (stream)
            fclose(stream);
        return NULL;
    }
    *file = (struct aiFile){.ReadProc = read_bytes,
                            .WriteProc = write_none,
                            .TellProc = tell,
                            .FileSizeProc = size_of,
                            .SeekProc = seek,
                            .FlushProc = flush_none,
                            .UserData = (aiUserData)(void *)stream};
    files->size += size_of(file);
    limit_data(files->data_before + limit_of_file(files->size));
    limit_seconds(BASE_SECONDS + SECONDS_PER_MIB * (files->size >> 20));
    return file;
}

static void close_file(struct aiFileIO *io, struct aiFile *file)
{
    (void)io;
    fclose(stream_of(file));
    free(file);
}

void import_files_begin(struct import_files *files, const mxg_context *context, const char *path)
{
    *files = (struct import_files){.context = context, .path = path};
    files->io = (struct aiFileIO){open_file, close_file, (aiUserData)(void *)files};
    files->data_before = limit_data_used();
    limit_data(files->data_before + limit_of_file(0));
    catch_crashes(path);
    limit_seconds(BASE_SECONDS);
}

void import_files_end(struct import_files *files)
{
    (void)files;
    limit_seconds(0);
    forget_crashes();
    limit_data(LIMIT_NONE);
}
