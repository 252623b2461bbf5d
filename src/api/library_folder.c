// SPDX-License-Identifier: Apache-2.0
/* Lists folders of a library. */
#include "api/api.h"
#include "api/file_system.h"

#include "base/hash.h"
#include "base/table.h"

#include <assert.h>
#include <stdlib.h>

bool folder_exists(const char *path)
{
    return file_facts(path).kind == FILE_FOLDER;
}

static const char *join(struct arena *arena, const char *folder, const char *name)
{
    struct text path;
    text_init(&path, arena);
    text_str(&path, folder);
    if (!text_ends_with(folder, "/"))
        text_char(&path, '/');
    text_str(&path, name);
    return text_cstr(&path);
}

static int compare(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
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
    uint64_t device, number;
};

struct folders {
    VEC(struct folder) items;
    struct table by_identity; /* indices from 1 */
};

/* Follows links, and adds a folder once: links can form a cycle. */
static enum file_kind add_entry(struct arena *arena, struct folders *folders, const char *path)
{
    struct file_facts facts = file_facts(path);
    if (facts.kind != FILE_FOLDER)
        return facts.kind;
    uint32_t hash = hash_pair((uint32_t)facts.device, (uint32_t)facts.number);
    for (uint32_t at = hash, i; (i = table_next(&folders->by_identity, hash, &at));)
        if (folders->items.items[i - 1].number == facts.number
            && folders->items.items[i - 1].device == facts.device)
            return FILE_FOLDER;
    vec_push(arena, &folders->items, (struct folder){path, facts.device, facts.number});
    table_add(&folders->by_identity, arena, hash, folders->items.len);
    return FILE_FOLDER;
}

const char *folder_list(struct arena *arena, const char *path, const char *suffix,
                        struct path_list *out)
{
    struct folders folders = {0};
    if (add_entry(arena, &folders, path) != FILE_FOLDER)
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
            if (add_entry(arena, &folders, found.items[j]) == FILE_REGULAR
                && text_ends_with(found.items[j], suffix))
                vec_push(arena, out, found.items[j]);
    }
    if (out->len > first)
        qsort(out->items + first, out->len - first, sizeof *out->items, compare);
    return NULL;
}
