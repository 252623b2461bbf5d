// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "program/folder.h"

#include "program/cli.h"
#include "program/files.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static bool is_folder(const char *path)
{
    struct stat info;
    return lstat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

/* Appends the files in a folder to `out`, and its folders to `folders`. */
static const char *find_in(const char *folder, const char *ending, struct arg_list *folders,
                           struct arg_list *out)
{
    DIR *dir = opendir(folder);
    if (!dir)
        return strerror(errno);
    const char *slash = files_ends_with(folder, "/") ? "" : "/";
    for (const struct dirent *entry; (entry = readdir(dir)) != NULL;) {
        if (entry->d_name[0] == '.')
            continue;
        char *path = cli_format("%s%s%s", folder, slash, entry->d_name);
        if (is_folder(path))
            args_append(folders, path);
        else if (files_ends_with(entry->d_name, ending) && files_is_regular(path))
            args_append(out, path);
        else
            free(path);
    }
    closedir(dir);
    return NULL;
}

static int compare_paths(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

const char *folder_find(const char *folder, const char *ending, struct arg_list *out)
{
    struct arg_list folders = {0};
    size_t first = out->len;
    const char *reason = NULL;
    args_append(&folders, cli_format("%s", folder));
    for (size_t i = 0; i < folders.len && !reason; ++i)
        reason = find_in(folders.items[i], ending, &folders, out);
    if (out->len > first)
        qsort(out->items + first, out->len - first, sizeof *out->items, compare_paths);
    args_free(&folders);
    return reason;
}

const char *folder_documents(const struct arg_list *paths, struct arg_list *out,
                             const char **out_reason)
{
    for (size_t i = 0; i < paths->len; ++i) {
        const char *path = paths->items[i];
        if (!files_is_folder(path)) {
            args_append(out, cli_format("%s", path));
            continue;
        }
        size_t before = out->len;
        const char *reason = folder_find(path, ".mtlx", out);
        if (!reason && out->len == before)
            reason = "the folder has no document (.mtlx)";
        if (reason) {
            *out_reason = reason;
            return path;
        }
    }
    return NULL;
}
