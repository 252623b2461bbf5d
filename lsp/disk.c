// SPDX-License-Identifier: Apache-2.0
#include "lsp/disk.h"

#include "lsp/system.h"
#include "program/cli.h"
#include "program/files.h"
#include "program/memory.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* Appends the folders of a path; ".." leaves one, and stays where there is none to leave. */
static char *append(char *out, const char *begin, const char *path, size_t len)
{
    for (const char *end = path + len; path < end;) {
        size_t part = 0;
        while (path + part < end && path[part] != '/')
            ++part;
        bool is_up = part == 2 && memcmp(path, "..", 2) == 0;
        bool is_nothing = part == 0 || (part == 1 && *path == '.');
        char *last = out;
        while (last > begin && last[-1] != '/')
            --last;
        bool can_leave = out > begin && strncmp(last, "..", 2) != 0;
        if (is_up && can_leave) {
            out = last > begin ? last - 1 : last;
        } else if (!is_nothing && !(is_up && begin[-1] == '/')) {
            if (out > begin)
                *out++ = '/';
            memcpy(out, path, part);
            out += part;
        }
        path += part < (size_t)(end - path) ? part + 1 : part;
    }
    return out;
}

char *disk_join(const char *from, const char *ref)
{
    size_t folder = *ref == '/' ? 0 : (size_t)(files_base_name(from) - from);
    bool is_absolute = folder ? *from == '/' : *ref == '/';
    char *path = memory_alloc(folder + strlen(ref) + 3), *begin = path + 1;
    path[0] = is_absolute ? '/' : ' ';
    char *out = append(begin, begin, from, folder);
    out = append(out, begin, ref, strlen(ref));
    *out = '\0';
    if (!is_absolute)
        memmove(path, begin, (size_t)(out - begin) + 1);
    return path;
}

bool disk_open(struct disk *disk, const mxg_context_desc *desc, char *const *folders,
               size_t num_folders)
{
    mxg_context_desc gate = *desc;
    size_t num = desc->num_include_roots + num_folders;
    const char **roots = memory_alloc(num * sizeof *roots);
    for (size_t i = 0; i < num; ++i)
        roots[i] = i < desc->num_include_roots ? desc->include_roots[i]
                                               : folders[i - desc->num_include_roots];
    gate.include_roots = roots;
    gate.num_include_roots = num;
    gate.sandbox = true;
    gate.resolver = NULL;
    mxg_status status = mxg_context_create(&gate, &disk->gate);
    free(roots);
    return status == MXG_OK;
}

void disk_close(struct disk *disk)
{
    mxg_context_destroy(disk->gate);
    *disk = (struct disk){0};
}

/* ---- The resolver ---- */

static const char *fault_of(const struct disk *disk, const char *path)
{
    return mxg_context_file_fault(disk->gate, disk->from, path);
}

/* A file of the editor; false: it has none of this path. */
static bool open_edited(const struct disk *disk, const char *path, mxg_blob *out)
{
    for (size_t i = 0; i < disk->num_files; ++i) {
        const struct disk_file *file = &disk->files[i];
        if (strcmp(file->path, path) != 0)
            continue;
        *out = (mxg_blob){.name = file->path, .data = file->bytes, .size = file->size};
        return true;
    }
    return false;
}

/* The name stands after the bytes. */
static bool open_on_disk(const char *path, mxg_blob *out)
{
    size_t size = 0, name_size = strlen(path) + 1;
    char *data = system_read(path, 0, &size);
    if (!data)
        return false;
    data = memory_resize(data, size + name_size);
    memcpy(data + size, path, name_size);
    *out = (mxg_blob){.name = data + size, .data = data, .size = size, .handle = data};
    return true;
}

/* Beside the referring file, then in the working directory, as without a resolver. */
static bool open_file(void *user_data, const char *from, const char *ref, mxg_blob *out_blob,
                      const char **out_reason)
{
    const struct disk *disk = user_data;
    bool is_open = false, is_refused = false;
    for (int place = strchr(from, '/') && *ref != '/' ? 0 : 1; place < 2; ++place) {
        char *path = disk_join(place ? "" : from, ref);
        const char *fault = fault_of(disk, path);
        is_refused = fault != NULL;
        if (fault)
            *out_reason = fault;
        else
            is_open = open_edited(disk, path, out_blob) || open_on_disk(path, out_blob);
        int reason = errno;
        free(path);
        if (is_open || is_refused)
            break;
        *out_reason = strerror(reason);
        is_refused = reason != ENOENT && reason != ENOTDIR;
        if (is_refused)
            break;
    }
    if (is_refused)
        out_blob->name = ref;
    return is_open;
}

static void release_file(void *user_data, mxg_blob *blob)
{
    (void)user_data;
    free(blob->handle);
}

/* Whether a folder may be read: whether a file in it might. */
static bool may_list(const struct disk *disk, const char *folder)
{
    char *file = cli_format("%s/-", folder);
    const char *fault = fault_of(disk, file);
    free(file);
    return !fault;
}

/* A name that ends with '/' is that of no file. */
static size_t list_folder(void *user_data, const char *from, const char *folder, char *names,
                          size_t capacity)
{
    const struct disk *disk = user_data;
    size_t size = 0;
    for (int place = 0; place < 2 && !size; ++place) {
        char *path = disk_join(place ? "" : from, folder);
        if (may_list(disk, path))
            size = system_list(path, names, capacity);
        free(path);
    }
    return size;
}

mxg_resolver disk_resolver(struct disk *disk)
{
    return (mxg_resolver){
        .user_data = disk, .open = open_file, .release = release_file, .list_folder = list_folder};
}

/* ---- For the server itself ---- */

bool disk_may_read(const struct disk *disk, const char *file, const char *ref)
{
    char *path = disk_join(file, ref);
    const char *fault = fault_of(disk, path);
    free(path);
    return !fault;
}

char *disk_read(const struct disk *disk, const char *path, size_t limit, size_t *out_size)
{
    return fault_of(disk, path) ? NULL : system_read(path, limit, out_size);
}

enum { LIKELY_SIZE = 1 << 14 /* of the names in a folder */ };

char *disk_list(const struct disk *disk, const char *folder, size_t *out_size)
{
    char *path = disk_join(disk->from, folder), *names = memory_alloc(1);
    size_t capacity = 0, size = may_list(disk, path) ? LIKELY_SIZE : 0;
    /* a folder may grow meanwhile: its names are left out after a few times */
    for (int times = 0; size > capacity && times < 3; ++times) {
        capacity = size;
        names = memory_resize(names, capacity);
        size = system_list(path, names, capacity);
    }
    *out_size = size <= capacity ? size : 0;
    free(path);
    return names;
}
