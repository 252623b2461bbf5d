/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The questions of the library to the file system beside reading a file. posix.c answers them, and
 * windows.c; no other file of the library knows its platform.
 */
#ifndef MXG_API_FILE_SYSTEM_H
#define MXG_API_FILE_SYSTEM_H

#include <limits.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifndef PATH_MAX
#define PATH_MAX 4096
#endif

enum file_kind {
    FILE_MISSING,
    FILE_OTHER, /* a device, a pipe or a socket: reading may never end */
    FILE_REGULAR,
    FILE_FOLDER
};

struct file_facts {
    enum file_kind kind;
    uint64_t device, number; /* equal for all paths of a file */
    uint64_t size;
};

/* Follows links. */
struct file_facts file_facts(const char *path);
/* True also for a link that leads nowhere. */
bool file_has_entry(const char *path);
/* The path without links, with '/' between folders; false: there is no such file. */
bool file_real_path(const char *path, char out[PATH_MAX]);
/* True for what stands between folders in names that a host gives. */
bool file_is_separator(char c);
/*
 * Writes the names in a folder, each with its NUL, as far as they fit, and the number of bytes that
 * all names need. NULL or an error.
 */
const char *folder_names(const char *folder, char *names, size_t capacity, size_t *out_size);

/* The last of the separators, or NULL. */
static inline const char *file_last_separator(const char *path)
{
    const char *last = NULL;
    for (; *path; path++)
        if (file_is_separator(*path))
            last = path;
    return last;
}

#endif
