// SPDX-License-Identifier: Apache-2.0
/*
 * Files of the programs. The library opens files only through its resolver, and writes none.
 */
#ifndef MXG_PROGRAM_FILES_H
#define MXG_PROGRAM_FILES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The bytes of a file with a NUL after them, which the caller frees; NULL with errno. */
char *files_read(const char *path, size_t *out_size);

/*
 * Writes a whole file or none: the bytes go to a new file beside it, which is then renamed. Pipes
 * and devices (/dev/stdout) are written directly. Returns NULL, or the reason for a failure.
 */
const char *files_write(const char *path, const void *data, size_t size);

/*
 * Writes a file over an old one, which keeps its mode, its owner, links that lead to it and its
 * other names. Only with other names its bytes are overwritten in their place, after a copy shows
 * that the disk has room. Returns NULL, or the reason for a failure.
 */
const char *files_replace(const char *path, const void *data, size_t size);

/* A file that is written in pieces, and appears as a whole or not at all. */
struct files_stream {
    FILE *out;
    char *path, *temporary; /* temporary NULL: the new file has no name yet, so a kill removes it */
    bool is_direct;         /* a pipe, a device or standard output: there is no new file */
    char link[32];
};

/*
 * Opens `path`; "-" is standard output. Returns NULL, or the reason for a failure; the stream is
 * then empty.
 */
const char *files_begin(struct files_stream *stream, const char *path);
/*
 * Gives the file its name; removes it if `keep` is false. Returns NULL, or the reason for a
 * failure.
 */
const char *files_end(struct files_stream *stream, bool keep);

/*
 * A file in a folder that has no name, so nothing of it stays; for reading and writing. -1 with
 * errno.
 */
int files_open_unnamed(const char *folder);

/* Makes a folder and its parents. Returns NULL, or the reason for a failure. */
const char *files_make_folder(const char *path);

/* True if a program of this name exists: a path, or a name in a folder of PATH. */
bool files_find_program(const char *name);

bool files_is_regular(const char *path);

/* True if the file has at most `size` bytes; 0: any number. */
bool files_is_within(const char *path, size_t size);

bool files_is_folder(const char *path);

static inline bool files_ends_with(const char *path, const char *end)
{
    size_t len = strlen(path), end_len = strlen(end);
    return len >= end_len && strcmp(path + len - end_len, end) == 0;
}

/* The part of a path after its last '/'. */
static inline const char *files_base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

#ifdef __cplusplus
}
#endif

#endif
