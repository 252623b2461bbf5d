// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "cli/folder.h"

#include "cli/cli.h"
#include "cli/files.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_DEPTH = 32 }; /* depth of nested folders, because links can form cycles */

static const char *find_below(const char *folder, const char *ending, int depth,
                              struct arg_list *out)
{
    DIR *dir = opendir(folder);
    if (!dir)
        return strerror(errno);
    const char *reason = NULL;
    for (const struct dirent *entry; !reason && (entry = readdir(dir)) != NULL;) {
        size_t len = strlen(entry->d_name), end_len = strlen(ending);
        char *path = entry->d_name[0] == '.' ? NULL : cli_format("%s/%s", folder, entry->d_name);
        if (path && files_is_folder(path)) {
            reason = depth < MAX_DEPTH ? find_below(path, ending, depth + 1, out) : strerror(ELOOP);
        } else if (path && len >= end_len && strcmp(entry->d_name + len - end_len, ending) == 0) {
            args_append(out, path);
            continue;
        }
        free(path);
    }
    closedir(dir);
    return reason;
}

static int compare_paths(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

const char *folder_find(const char *folder, const char *ending, struct arg_list *out)
{
    size_t first = out->len;
    const char *reason = find_below(folder, ending, 0, out);
    if (out->len > first)
        qsort(out->items + first, out->len - first, sizeof *out->items, compare_paths);
    return reason;
}
