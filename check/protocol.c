// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "check/protocol.h"

#include "program/cli.h"
#include "program/memory.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

enum { FIRST_CAPACITY = 64 << 10, READ_SIZE = 32 << 10 };
enum {
    MAX_WAIT = 10000000 /* nanoseconds that an answer may wait in the buffer */,
    MAX_LYING = 256 << 10 /* bytes of buffered answers */
};

struct frame_header {
    uint32_t note, size;
};

/* ---- Frames ---- */

/* Reserves `size` more bytes and a NUL after them. */
static void reserve(struct frame_stream *stream, size_t size)
{
    if (stream->begin == stream->end)
        stream->begin = stream->end = 0;
    if (stream->capacity - stream->end > size)
        return;
    if (stream->begin)
        memmove(stream->bytes, stream->bytes + stream->begin, stream->end - stream->begin);
    stream->end -= stream->begin;
    stream->begin = 0;
    if (stream->capacity - stream->end > size)
        return;
    size_t capacity = stream->capacity ? stream->capacity : FIRST_CAPACITY;
    while (capacity - stream->end <= size)
        capacity *= 2;
    stream->bytes = memory_resize(stream->bytes, capacity);
    stream->capacity = capacity;
}

bool frame_take(struct frame_stream *stream, struct frame *out)
{
    struct frame_header header;
    size_t len = stream->end - stream->begin;
    if (len < sizeof header)
        return false;
    memcpy(&header, stream->bytes + stream->begin, sizeof header);
    if (len - sizeof header < (size_t)header.size + 1)
        return false;
    *out = (struct frame){header.note, header.size, stream->bytes + stream->begin + sizeof header};
    out->body[header.size] = '\0';
    stream->begin += sizeof header + header.size + 1;
    return true;
}

bool frame_fill(struct frame_stream *stream)
{
    ssize_t count;
    reserve(stream, READ_SIZE);
    do
        count = read(stream->fd, stream->bytes + stream->end, stream->capacity - stream->end);
    while (count < 0 && errno == EINTR);
    stream->end += count > 0 ? (size_t)count : 0;
    return count > 0;
}

void frame_put(struct frame_stream *stream, uint32_t note, const void *body, size_t size)
{
    struct frame_header header = {note, (uint32_t)size};
    reserve(stream, sizeof header + size + 1);
    char *at = stream->bytes + stream->end;
    memcpy(at, &header, sizeof header);
    memcpy(at + sizeof header, body, size);
    at[sizeof header + size] = '\0';
    stream->end += sizeof header + size + 1;
}

bool frame_flush(struct frame_stream *stream)
{
    while (stream->begin < stream->end) {
        ssize_t count =
            write(stream->fd, stream->bytes + stream->begin, stream->end - stream->begin);
        if (count < 0 && errno != EINTR)
            return false;
        stream->begin += count > 0 ? (size_t)count : 0;
    }
    return true;
}

void frame_finish(struct frame_stream *stream)
{
    free(stream->bytes);
    *stream = (struct frame_stream){.fd = stream->fd};
}

/* ---- The desk ---- */

uint64_t desk_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000000u + (uint64_t)now.tv_nsec;
}

char *desk_describe(const struct desk *desk)
{
    unsigned step = atomic_load(&desk->step);
    const char *name =
        step == CHECK_PASSED || step >= NUM_CHECK_FAILURES ? "start" : check_failure_names[step];
    return *desk->element ? cli_format("%s of '%s' for %s", name, desk->element, desk->target)
                          : cli_format("%s", name);
}

/* Copies the beginning of a text that may be too long. */
static void put_text(char *to, size_t capacity, const char *text)
{
    size_t len = strlen(text);
    len = len < capacity ? len : capacity - 1;
    memcpy(to, text, len);
    to[len] = '\0';
}

/* ---- The worker's side ---- */

bool channel_open(struct channel *channel, int input, int output)
{
    void *desk = mmap(NULL, sizeof *channel->desk, PROT_READ | PROT_WRITE, MAP_SHARED, DESK_FD, 0);
    *channel = (struct channel){.tasks.fd = input, .answers.fd = output, .desk = desk};
    if (desk == MAP_FAILED)
        return false;
    atomic_store(&channel->desk->is_ready, 1);
    return true;
}

static bool flush(struct channel *channel)
{
    channel->oldest_answer = 0;
    return frame_flush(&channel->answers);
}

bool channel_next(struct channel *channel, struct frame *out_task)
{
    while (!frame_take(&channel->tasks, out_task))
        if (!flush(channel) || !frame_fill(&channel->tasks))
            return false;
    channel->task_begin = desk_clock();
    atomic_fetch_add(&channel->desk->num_begun, 1);
    return true;
}

void channel_mark(struct channel *channel, enum check_failure step, const char *element,
                  const char *target)
{
    struct desk *desk = channel->desk;
    uint64_t now = desk_clock();
    put_text(desk->element, sizeof desk->element, element);
    put_text(desk->target, sizeof desk->target, target);
    atomic_store(&desk->step, (unsigned)step);
    atomic_store(&desk->step_begin, now);
    if (channel->oldest_answer && now - channel->oldest_answer > MAX_WAIT)
        flush(channel); /* the step may take long */
}

void channel_answer(struct channel *channel, const void *record, size_t size)
{
    uint64_t now = desk_clock(), microseconds = (now - channel->task_begin) / 1000;
    frame_put(&channel->answers, microseconds < UINT32_MAX ? (uint32_t)microseconds : UINT32_MAX,
              record, size < UINT32_MAX ? size : 0); /* too large: send none */
    if (!channel->oldest_answer)
        channel->oldest_answer = now;
    if (now - channel->oldest_answer > MAX_WAIT
        || channel->answers.end - channel->answers.begin > MAX_LYING)
        flush(channel);
}

void channel_close(struct channel *channel)
{
    flush(channel);
    frame_finish(&channel->tasks);
    frame_finish(&channel->answers);
    munmap(channel->desk, sizeof *channel->desk);
}
