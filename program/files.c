// SPDX-License-Identifier: Apache-2.0
#define _GNU_SOURCE /* O_TMPFILE, flock */
#include "program/files.h"

#include "program/temporary.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
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

/* ---- Writing ---- */

/* 0 or errno. */
static int write_all(int fd, const char *data, size_t size)
{
    while (size) {
        ssize_t n = write(fd, data, size);
        if (n < 0 && errno != EINTR)
            return errno;
        data += n > 0 ? n : 0;
        size -= n > 0 ? (size_t)n : 0;
    }
    return 0;
}

/* The folder of a file, which the caller frees; NULL: out of memory. */
static char *folder_of(const char *path)
{
    size_t len = (size_t)(files_base_name(path) - path);
    char *folder = malloc(len + 2);
    if (folder)
        snprintf(folder, len + 2, "%.*s", (int)(len ? len : 1), len ? path : ".");
    return folder;
}

/*
 * A file beside `path` without a name, which disappears with the process (open(2), O_TMPFILE); -1
 * where the file system or the lack of /proc does not allow it.
 */
static int open_nameless(const char *path)
{
    char *folder = access("/proc/self/fd", X_OK) == 0 ? folder_of(path) : NULL;
    int fd = folder ? open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0666) : -1;
    free(folder);
    if (fd >= 0)
        flock(fd, LOCK_EX | LOCK_NB);
    return fd;
}

/* A noted name beside `path`, after files of killed processes are gone; NULL: no memory. */
static char *note_name(const char *path)
{
    char *folder = folder_of(path);
    if (folder)
        temporary_sweep(folder);
    free(folder);
    char *name = temporary_name(path, TEMPORARY_SUFFIX);
    if (name)
        temporary_note(name);
    return name;
}

/* A new file that this process locks; -1 with errno, EEXIST if another one sweeps it. */
static int create_locked(const char *name)
{
    struct stat info;
    int fd = open(name, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd < 0)
        return -1;
    bool is_locked = flock(fd, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
    if (is_locked && fstat(fd, &info) == 0 && info.st_nlink > 0)
        return fd;
    close(fd);
    errno = EEXIST;
    return -1;
}

/* A new file beside `path`; -1 with errno. *out_name is its noted name. */
static int open_named(const char *path, char **out_name)
{
    enum { MAX_TRIES = 100 };
    for (int i = 0; i < MAX_TRIES; ++i) {
        char *name = note_name(path);
        if (!name)
            return -1;
        int fd = create_locked(name);
        *out_name = name;
        if (fd >= 0)
            return fd;
        int reason = errno;
        temporary_forget(name);
        free(name);
        *out_name = NULL;
        errno = reason;
        if (reason != EEXIST)
            break;
    }
    return -1;
}

/* Opens the file of the stream; 0 or errno. */
static int open_stream(struct files_stream *stream, const char *path)
{
    struct stat info;
    stream->is_direct = stat(path, &info) == 0 && !S_ISREG(info.st_mode);
    stream->path = strdup(path);
    if (!stream->path)
        return ENOMEM;
    int fd = stream->is_direct ? open(path, O_WRONLY | O_CLOEXEC) : open_nameless(path);
    if (fd < 0 && !stream->is_direct)
        fd = open_named(path, &stream->temporary);
    stream->out = fd < 0 ? NULL : fdopen(fd, "w");
    snprintf(stream->link, sizeof stream->link, "/proc/self/fd/%d", fd);
    return stream->out ? 0 : errno;
}

/* Forgets all but the reason, which it returns. */
static int finish_stream(struct files_stream *stream, int reason)
{
    if (stream->temporary) {
        temporary_forget(stream->temporary);
        free(stream->temporary);
    }
    free(stream->path);
    *stream = (struct files_stream){0};
    return reason;
}

const char *files_begin(struct files_stream *stream, const char *path)
{
    *stream = (struct files_stream){0};
    if (strcmp(path, "-") == 0) {
        stream->out = stdout;
        stream->is_direct = true;
        return NULL;
    }
    int reason = open_stream(stream, path);
    return reason ? strerror(finish_stream(stream, reason)) : NULL;
}

/* Gives a file without a name another one; 0 or errno. */
static int link_file(const struct files_stream *stream, const char *name)
{
    return linkat(AT_FDCWD, stream->link, AT_FDCWD, name, AT_SYMLINK_FOLLOW) == 0 ? 0 : errno;
}

/*
 * Gives a file without a name its own; 0 or errno. Over another file it has a temporary one
 * first, because only a rename replaces a file.
 */
static int name_file(struct files_stream *stream)
{
    enum { MAX_TRIES = 100 };
    int reason = link_file(stream, stream->path);
    for (int i = 0; i < MAX_TRIES && reason == EEXIST; ++i) {
        free(stream->temporary);
        stream->temporary = note_name(stream->path);
        if (!stream->temporary)
            return ENOMEM;
        reason = link_file(stream, stream->temporary);
        if (reason)
            temporary_forget(stream->temporary);
    }
    if (reason) {
        free(stream->temporary);
        stream->temporary = NULL;
    }
    return reason;
}

/* Why a stream has failed, which stdio does not keep: the next write fails for the same reason. */
static int fault_of(FILE *out)
{
    errno = 0;
    if (fflush(out) != 0 && errno)
        return errno;
    if (!ferror(out))
        return 0;
    return write(fileno(out), "", 1) < 0 ? errno : EIO;
}

/*
 * Closes the stream, which has been flushed, and gives its temporary file the final name; 0 or
 * errno. A copy of the descriptor keeps the lock until then, because other processes remove a
 * temporary file that nobody locks.
 */
static int close_and_rename(const struct files_stream *stream)
{
    int lock = stream->temporary ? fcntl(fileno(stream->out), F_DUPFD_CLOEXEC, 0) : -1;
    int reason = stream->temporary && lock < 0 ? errno : 0;
    if (fclose(stream->out) != 0 && !reason)
        reason = errno;
    if (!reason && stream->temporary && rename(stream->temporary, stream->path) != 0)
        reason = errno;
    if (lock >= 0)
        close(lock);
    return reason;
}

const char *files_end(struct files_stream *stream, bool keep)
{
    if (!stream->out)
        return NULL;
    int reason = fault_of(stream->out);
    bool is_kept = keep && !reason && !stream->is_direct;
    if (is_kept && !stream->temporary)
        reason = name_file(stream);
    if (is_kept && !reason)
        reason = close_and_rename(stream);
    else if (stream->out != stdout && fclose(stream->out) != 0 && !reason)
        reason = errno;
    if (stream->temporary && (!is_kept || reason))
        unlink(stream->temporary);
    finish_stream(stream, 0);
    return keep && reason ? strerror(reason) : NULL;
}

const char *files_write(const char *path, const void *data, size_t size)
{
    struct files_stream stream;
    if (files_is_folder(path))
        return strerror(EISDIR);
    const char *reason = files_begin(&stream, path);
    if (reason)
        return reason;
    fwrite(data, 1, size, stream.out);
    return files_end(&stream, true);
}

/* Overwrites a file in its place; 0 or errno. */
static int overwrite(const char *path, const void *data, size_t size)
{
    int fd = open(path, O_WRONLY | O_CLOEXEC);
    int reason = fd < 0 ? errno : write_all(fd, data, size);
    if (fd >= 0 && !reason && ftruncate(fd, (off_t)size) != 0)
        reason = errno;
    if (fd >= 0 && close(fd) != 0 && !reason)
        reason = errno;
    return reason;
}

/* Gives the new file of a stream the mode and the owner of an old one, as far as it may. */
static void copy_mode(const struct files_stream *stream, const struct stat *old)
{
    int fd = fileno(stream->out);
    bool is_own = fchown(fd, old->st_uid, old->st_gid) == 0;
    mode_t mode = old->st_mode & (is_own ? 07777 : 0777);
    if (fchmod(fd, mode) != 0)
        errno = 0; /* the file keeps the usual mode */
}

const char *files_replace(const char *path, const void *data, size_t size)
{
    struct stat old;
    struct files_stream stream;
    char *real = realpath(path, NULL);
    if (!real || stat(real, &old) != 0) {
        free(real);
        return strerror(errno);
    }
    const char *reason = files_begin(&stream, real);
    if (!reason) {
        fwrite(data, 1, size, stream.out);
        if (!stream.is_direct)
            copy_mode(&stream, &old);
        /* other names of the file see the new text, and by now it is known that the disk has room
         */
        bool is_linked = old.st_nlink > 1 && !stream.is_direct;
        int fault = is_linked ? fault_of(stream.out) : 0;
        if (is_linked && !fault)
            fault = overwrite(real, data, size);
        reason = files_end(&stream, !is_linked);
        reason = fault ? strerror(fault) : reason;
    }
    free(real);
    return reason;
}

int files_open_unnamed(const char *folder)
{
    int fd = open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (fd >= 0)
        return fd;
    size_t size = strlen(folder) + sizeof "/mxgen";
    char *path = malloc(size), *name = NULL;
    if (path) {
        snprintf(path, size, "%s/mxgen", folder);
        fd = open_named(path, &name);
    }
    if (fd >= 0)
        unlink(name);
    if (name)
        temporary_forget(name);
    free(name);
    free(path);
    return fd;
}

/* ---- Folders ---- */

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
