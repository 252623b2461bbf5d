// SPDX-License-Identifier: Apache-2.0
/* Lists folders of a library. */
#define _POSIX_C_SOURCE 200809L
#include "api/api.h"

#include "base/hash.h"
#include "base/table.h"

#include <assert.h>
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

/* ---- A folder and the folders in it ---- */

/* Links give a folder several paths; its identity is its device and number. */
struct folder {
    const char *path;
    dev_t device;
    ino_t inode;
};

struct folders {
    VEC(struct folder) items;
    struct table by_identity; /* indices from 1 */
};

enum entry_kind { ENTRY_OTHER, ENTRY_FILE, ENTRY_FOLDER };

/*
 * Follows links, and adds a folder once: links can form a cycle. Devices, pipes and sockets are
 * OTHER, because reading them may never end.
 */
static enum entry_kind add_entry(struct arena *arena, struct folders *folders, const char *path)
{
    struct stat info;
    if (stat(path, &info) != 0)
        return ENTRY_OTHER;
    if (!S_ISDIR(info.st_mode))
        return S_ISREG(info.st_mode) ? ENTRY_FILE : ENTRY_OTHER;
    uint32_t hash = hash_pair((uint32_t)info.st_dev, (uint32_t)info.st_ino);
    for (uint32_t at = hash, i; (i = table_next(&folders->by_identity, hash, &at));)
        if (folders->items.items[i - 1].inode == info.st_ino
            && folders->items.items[i - 1].device == info.st_dev)
            return ENTRY_FOLDER;
    vec_push(arena, &folders->items, (struct folder){path, info.st_dev, info.st_ino});
    table_add(&folders->by_identity, arena, hash, folders->items.len);
    return ENTRY_FOLDER;
}

const char *folder_list(struct arena *arena, const char *path, const char *suffix,
                        struct path_list *out)
{
    struct folders folders = {0};
    if (add_entry(arena, &folders, path) != ENTRY_FOLDER)
        return "it is no folder";
    uint32_t first = out->len;
    assert(folders.items.len == 1);
    for (uint32_t i = 0; i < folders.items.len; i++) {
        struct path_list found = {0};
        const char *reason = list_one(arena, folders.items.items[i].path, &found);
        if (reason)
            return reason;
        /* in order: the first path of a folder is the one that counts */
        if (found.len)
            qsort(found.items, found.len, sizeof *found.items, compare);
        for (uint32_t j = 0; j < found.len; j++)
            if (add_entry(arena, &folders, found.items[j]) == ENTRY_FILE
                && ends_with(found.items[j], suffix))
                vec_push(arena, out, found.items[j]);
    }
    if (out->len > first)
        qsort(out->items + first, out->len - first, sizeof *out->items, compare);
    return NULL;
}
