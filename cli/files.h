// SPDX-License-Identifier: Apache-2.0
/*
 * Files of the programs. The library opens none but through its resolver; what is written is
 * written here.
 */
#ifndef MXG_CLI_FILES_H
#define MXG_CLI_FILES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* The bytes of a file with a NUL behind them, to be freed by the caller; NULL with errno set. */
char *files_read(const char *path, size_t *out_size);

/*
 * Writes a file whole or not at all: the bytes go to a new file beside it, which then takes its
 * name. What is no plain file (a pipe, /dev/stdout) is written directly. Returns NULL, or why it
 * failed.
 */
const char *files_write(const char *path, const void *data, size_t size);

/* A file that is written piece by piece, and appears whole or not at all. */
struct files_stream {
    FILE *out;
    char *path, *temporary; /* no temporary: written directly */
};

/*
 * Opens `path`, "-" being standard output. Returns NULL, or why it failed; the stream is then
 * empty.
 */
const char *files_begin(struct files_stream *stream, const char *path);
/* Gives the file its name, or with `keep` false takes it away. Returns NULL, or why it failed. */
const char *files_end(struct files_stream *stream, bool keep);

/* Makes a folder and the folders above it. Returns NULL, or why it failed. */
const char *files_make_folder(const char *path);

/* Whether a program can be started by this name: a path, or one in a folder of PATH. */
bool files_find_program(const char *name);

/* Writes a file name as make reads it: spaces and '#' escaped, '$' doubled. */
void files_put_make_name(FILE *out, const char *name);

bool files_is_regular(const char *path);

bool files_is_folder(const char *path);

/* The part of a path behind its last '/'. */
const char *files_base_name(const char *path);

#endif
