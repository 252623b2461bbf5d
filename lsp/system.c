// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "lsp/system.h"

#include "program/cli.h"
#include "program/memory.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

char *system_read(const char *path, size_t limit, size_t *out_size)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return NULL;
    struct stat info;
    bool is_regular = fstat(fileno(file), &info) == 0 && S_ISREG(info.st_mode);
    size_t size = is_regular ? (size_t)info.st_size : 0;
    size = limit && size > limit ? limit : size;
    char *data = memory_alloc(size + 1);
    *out_size = fread(data, 1, size, file);
    if (ferror(file)) {
        free(data);
        data = NULL;
    }
    fclose(file);
    return data;
}

/* Appends a name with its end; counts also what has no room. */
static void put_name(const char *name, const char *end, char *names, size_t capacity, size_t *size)
{
    size_t len = strlen(name) + strlen(end) + 1;
    if (*size + len <= capacity)
        snprintf(names + *size, len, "%s%s", name, end);
    *size += len;
}

size_t system_list(const char *folder, char *names, size_t capacity)
{
    size_t size = 0;
    DIR *dir = opendir(*folder ? folder : ".");
    for (const struct dirent *entry; dir && (entry = readdir(dir)) != NULL;) {
        struct stat info;
        char *path = cli_format("%s/%s", *folder ? folder : ".", entry->d_name);
        bool is_folder = stat(path, &info) == 0 && S_ISDIR(info.st_mode);
        free(path);
        put_name(entry->d_name, is_folder ? "/" : "", names, capacity, &size);
    }
    if (dir)
        closedir(dir);
    return size;
}

bool system_is_link(const char *path)
{
    struct stat info;
    return lstat(path, &info) == 0 && S_ISLNK(info.st_mode);
}
