// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "program/files.h"

#include "program/temporary.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Reads to the end of fd; the size from fstat is only a hint, because pipes have none. */
static char *read_all(int fd, size_t hint, size_t *out_size)
{
    size_t capacity = hint + 2, size = 0;
    char *data = malloc(capacity);
    for (;;) {
        ssize_t n = data ? read(fd, data + size, capacity - size - 1) : -1;
        if (n < 0) {
            if (data && errno == EINTR)
                continue;
            free(data);
            return NULL;
        }
        size += (size_t)n;
        if (n == 0)
            break;
        if (size + 1 == capacity) {
            char *more = realloc(data, capacity * 2);
            if (!more)
                free(data);
            data = more;
            capacity *= 2;
        }
    }
    data[size] = '\0';
    *out_size = size;
    return data;
}

char *files_read(const char *path, size_t *out_size)
{
    int fd = open(path, O_RDONLY | O_CLOEXEC);
    if (fd < 0)
        return NULL;
    struct stat info;
    size_t hint = fstat(fd, &info) == 0 && S_ISREG(info.st_mode) ? (size_t)info.st_size : 0;
    char *data = read_all(fd, hint, out_size);
    int reason = errno;
    close(fd);
    errno = reason;
    return data;
}

/* Writes all bytes and closes; 0 or errno. Some file systems report a full disk only at close. */
static int write_all(int fd, const char *data, size_t size)
{
    int reason = 0;
    while (size && !reason) {
        ssize_t n = write(fd, data, size);
        if (n >= 0) {
            data += n;
            size -= (size_t)n;
        } else if (errno != EINTR) {
            reason = errno;
        }
    }
    if (close(fd) != 0 && !reason)
        reason = errno;
    return reason;
}

static const char *write_direct(const char *path, const void *data, size_t size)
{
    int fd = open(path, O_WRONLY | O_CLOEXEC);
    if (fd < 0)
        return strerror(errno);
    int reason = write_all(fd, data, size);
    return reason ? strerror(reason) : NULL;
}

const char *files_write(const char *path, const void *data, size_t size)
{
    struct stat info;
    if (stat(path, &info) == 0 && !S_ISREG(info.st_mode))
        return S_ISDIR(info.st_mode) ? strerror(EISDIR) : write_direct(path, data, size);
    size_t room = strlen(path) + 32;
    char *temporary = malloc(room);
    if (!temporary)
        return strerror(ENOMEM);
    snprintf(temporary, room, "%s.%ld.tmp", path, (long)getpid());
    int reason = 0;
    temporary_note(temporary);
    int fd = open(temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd < 0) {
        reason = errno;
    } else {
        reason = write_all(fd, data, size);
        if (!reason && rename(temporary, path) != 0)
            reason = errno;
        if (reason)
            unlink(temporary);
    }
    temporary_forget(temporary);
    free(temporary);
    return reason ? strerror(reason) : NULL;
}

/* Opens the file of the stream; 0 or errno. */
static int open_stream(struct files_stream *stream, const char *path)
{
    struct stat info;
    bool is_direct = stat(path, &info) == 0 && !S_ISREG(info.st_mode);
    size_t room = strlen(path) + 32;
    stream->path = malloc(room);
    stream->temporary = is_direct ? NULL : malloc(room);
    if (!stream->path || (!is_direct && !stream->temporary))
        return ENOMEM;
    snprintf(stream->path, room, "%s", path);
    if (stream->temporary) {
        snprintf(stream->temporary, room, "%s.%ld.tmp", path, (long)getpid());
        temporary_note(stream->temporary);
    }
    int flags = is_direct ? O_WRONLY | O_CLOEXEC : O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC;
    int fd = open(is_direct ? path : stream->temporary, flags, 0666);
    stream->out = fd < 0 ? NULL : fdopen(fd, "w");
    return stream->out ? 0 : errno;
}

const char *files_begin(struct files_stream *stream, const char *path)
{
    *stream = (struct files_stream){0};
    if (strcmp(path, "-") == 0) {
        stream->out = stdout;
        return NULL;
    }
    int reason = open_stream(stream, path);
    if (!reason)
        return NULL;
    if (stream->temporary)
        temporary_forget(stream->temporary);
    free(stream->path);
    free(stream->temporary);
    *stream = (struct files_stream){0};
    return strerror(reason);
}

const char *files_end(struct files_stream *stream, bool keep)
{
    if (!stream->out)
        return NULL;
    int reason = ferror(stream->out) ? EIO : 0;
    errno = 0;
    if ((stream->out == stdout ? fflush(stream->out) : fclose(stream->out)) != 0)
        reason = errno ? errno : EIO;
    if (stream->temporary) {
        if (keep && !reason && rename(stream->temporary, stream->path) != 0)
            reason = errno;
        if (!keep || reason)
            unlink(stream->temporary);
        temporary_forget(stream->temporary);
    }
    free(stream->path);
    free(stream->temporary);
    *stream = (struct files_stream){0};
    return keep && reason ? strerror(reason) : NULL;
}

const char *files_make_folder(const char *path)
{
    size_t len = strlen(path);
    char *part = malloc(len + 1);
    if (!part)
        return strerror(ENOMEM);
    memcpy(part, path, len + 1);
    int reason = 0;
    for (size_t i = 1; i <= len && !reason; ++i) {
        if (part[i] != '/' && part[i] != '\0')
            continue;
        char end = part[i];
        part[i] = '\0';
        if (mkdir(part, 0777) != 0 && errno != EEXIST)
            reason = errno;
        part[i] = end;
    }
    free(part);
    return reason ? strerror(reason) : NULL;
}

bool files_find_program(const char *name)
{
    if (strchr(name, '/'))
        return access(name, X_OK) == 0;
    bool found = false;
    for (const char *at = getenv("PATH"); at && *at && !found;) {
        size_t len = strcspn(at, ":"), room = len + strlen(name) + 2;
        char *path = malloc(room);
        if (path)
            snprintf(path, room, "%.*s/%s", (int)len, at, name);
        found = path && access(path, X_OK) == 0;
        free(path);
        at += len + (at[len] == ':');
    }
    return found;
}

bool files_is_regular(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0 && S_ISREG(info.st_mode);
}

bool files_is_within(const char *path, size_t size)
{
    struct stat info;
    return !size || (stat(path, &info) == 0 && (uintmax_t)info.st_size <= size);
}

bool files_is_folder(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

const char *files_base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}
