// SPDX-License-Identifier: Apache-2.0
/*
 * The files that documents may refer to. A sandbox allows files in or below the folder of a file
 * that the caller names, and below the include roots of the context. Links are resolved before
 * paths are compared.
 */
#include "api/api.h"
#include "api/file_system.h"

struct sandbox_root {
    struct sandbox_root *next;
    size_t size;
    size_t len; /* length of the path, which ends with '/' only for the root of the file system */
    char path[];
};

static bool is_below(const char *root, size_t len, const char *path)
{
    if (strncmp(path, root, len) != 0)
        return false;
    return len == 1 || path[len] == '/' || path[len] == '\0';
}

static bool is_known(const struct mxg_context *context, const char *path)
{
    for (const struct sandbox_root *root = context->roots; root; root = root->next)
        if (is_below(root->path, root->len, path))
            return true;
    return false;
}

static bool add(struct mxg_context *context, const char *path)
{
    size_t len = strlen(path), size = sizeof(struct sandbox_root) + len + 1;
    if (is_known(context, path))
        return true;
    struct sandbox_root *root = context->mem.realloc(context->mem.user_data, NULL, 0, size);
    if (!root)
        return false;
    *root = (struct sandbox_root){.next = context->roots, .size = size, .len = len};
    memcpy(root->path, path, len + 1);
    context->roots = root;
    atomic_fetch_add(&context->used, size);
    return true;
}

bool sandbox_admit_folder(struct mxg_context *context, const char *folder)
{
    char real[PATH_MAX];
    return !context->sandbox || !file_real_path(folder, real) || add(context, real);
}

/* The folder of a file, "." without one; false: its path is too long. */
static bool folder_of(const char *file, char out[PATH_MAX])
{
    const char *slash = file_last_separator(file);
    size_t len = slash ? (size_t)(slash - file) + (slash == file) : 1;
    if (len >= PATH_MAX)
        return false;
    memcpy(out, slash ? file : ".", len);
    out[len] = '\0';
    return true;
}

bool sandbox_admit_file(struct mxg_context *context, const char *file)
{
    char folder[PATH_MAX];
    return !context->sandbox || !folder_of(file, folder) || sandbox_admit_folder(context, folder);
}

/* True if a real path is in or below the folder of a file. */
static bool is_beside(const char *file, const char *path)
{
    char folder[PATH_MAX], real[PATH_MAX];
    return folder_of(file, folder) && file_real_path(folder, real)
           && is_below(real, strlen(real), path);
}

/*
 * True if the path, or the innermost folder of it that exists, is in a known folder, or in that of
 * `from`, which may be NULL. So the answer for a path outside does not depend on the files there.
 */
static bool is_inside(const struct mxg_context *context, const char *from, const char *path)
{
    char part[PATH_MAX], real[PATH_MAX];
    size_t len = strlen(path);
    if (len >= sizeof part)
        return false;
    memcpy(part, path, len + 1);
    while (!file_real_path(part, real)) {
        const char *slash = file_last_separator(part);
        if (file_has_entry(part)) /* a link that leads nowhere, or a folder closed to us */
            return false;
        if (slash)
            part[slash == part ? 1 : slash - part] = '\0';
        else
            memcpy(part, ".", 2);
    }
    return is_known(context, real) || (from && is_beside(from, real));
}

const char sandbox_outside[] = "it is outside the folders that documents may read";
static const char irregular[] = "it is not a regular file";

const char *sandbox_texture_fault(const struct mxg_context *context, const char *path)
{
    return context->sandbox && !is_inside(context, NULL, path) ? sandbox_outside : NULL;
}

const char *sandbox_fault(const struct mxg_context *context, const char *path)
{
    const char *fault = sandbox_texture_fault(context, path);
    /* A missing file has none: the attempt to open it gives the reason. */
    return !fault && file_facts(path).kind == FILE_OTHER ? irregular : fault;
}

const char *mxg_context_file_fault(const mxg_context *context, const char *from, const char *path)
{
    if (!context || !from || !path)
        return "it has no name";
    if (context->sandbox && !is_inside(context, from, path))
        return sandbox_outside;
    struct file_facts facts = file_facts(path);
    if (facts.kind == FILE_MISSING)
        return NULL;
    if (facts.kind != FILE_REGULAR)
        return irregular;
    return facts.size > (uint64_t)context->xml_limits.max_file_mib << 20
               ? "it is too large; raise the limit 'max-file-size' if this is intended"
               : NULL;
}

void sandbox_finish(struct mxg_context *context)
{
    while (context->roots) {
        struct sandbox_root *root = context->roots;
        context->roots = root->next;
        context->mem.realloc(context->mem.user_data, root, root->size, 0);
    }
}
