// SPDX-License-Identifier: Apache-2.0
/* The file system of POSIX. */
#define _XOPEN_SOURCE 700
#include "api/file_system.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

struct file_facts file_facts(const char *path)
{
    struct stat info;
    if (stat(path, &info) != 0)
        return (struct file_facts){.kind = FILE_MISSING};
    return (struct file_facts){
        .kind = S_ISREG(info.st_mode)   ? FILE_REGULAR
                : S_ISDIR(info.st_mode) ? FILE_FOLDER
                                        : FILE_OTHER,
        .device = (uint64_t)info.st_dev,
        .number = (uint64_t)info.st_ino,
        .size = (uint64_t)info.st_size,
    };
}

bool file_has_entry(const char *path)
{
    struct stat info;
    return lstat(path, &info) == 0;
}

bool file_real_path(const char *path, char out[PATH_MAX])
{
    return realpath(path, out) != NULL;
}

bool file_is_separator(char c)
{
    return c == '/';
}

const char *folder_names(const char *folder, char *names, size_t capacity, size_t *out_size)
{
    *out_size = 0;
    DIR *dir = opendir(folder);
    if (!dir)
        return strerror(errno);
    for (const struct dirent *entry; (entry = readdir(dir)) != NULL;) {
        size_t len = strlen(entry->d_name) + 1;
        if (*out_size + len <= capacity)
            memcpy(names + *out_size, entry->d_name, len);
        *out_size += len;
    }
    closedir(dir);
    return NULL;
}
