// SPDX-License-Identifier: Apache-2.0
/* Lists folders of a library. */
#define _POSIX_C_SOURCE 200809L
#include "api/api.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <sys/stat.h>

bool folder_exists(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

static bool ends_with(const char *text, const char *end)
{
    size_t len = strlen(text), end_len = strlen(end);
    return len >= end_len && strcmp(text + len - end_len, end) == 0;
}

static const char *join(struct arena *arena, const char *folder, const char *name)
{
    struct text path;
    text_init(&path, arena);
    text_str(&path, folder);
    if (!ends_with(folder, "/"))
        text_char(&path, '/');
    text_str(&path, name);
    return text_cstr(&path);
}

static int compare(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
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

/*
 * The names in a folder as paths. A jump out of memory must not skip closing the folder, so the
 * code counts the names before it allocates.
 */
static const char *list_one(struct arena *arena, const char *folder, struct path_list *out)
{
    size_t size = 0, capacity = 0;
    char *names = NULL;
    const char *reason;
    while ((reason = folder_names(folder, names, capacity, &size)) == NULL && size > capacity)
        names = arena_alloc(arena, capacity = size);
    if (reason)
        return reason;
    for (size_t at = 0; at < size; at += strlen(names + at) + 1)
        if (names[at] != '.') /* skips hidden files, the folder and its parent */
            vec_push(arena, out, join(arena, folder, names + at));
    return NULL;
}

const char *folder_list(struct arena *arena, const char *path, const char *suffix,
                        struct path_list *out)
{
    VEC(const char *) folders = {0};
    vec_push(arena, &folders, path);
    uint32_t first = out->len;
    for (uint32_t i = 0; i < folders.len; i++) {
        struct path_list found = {0};
        const char *reason = list_one(arena, folders.items[i], &found);
        if (reason)
            return reason;
        for (uint32_t j = 0; j < found.len; j++) {
            if (folder_exists(found.items[j]))
                vec_push(arena, &folders, found.items[j]);
            else if (ends_with(found.items[j], suffix))
                vec_push(arena, out, found.items[j]);
        }
    }
    if (out->len > first)
        qsort(out->items + first, out->len - first, sizeof *out->items, compare);
    return NULL;
}
