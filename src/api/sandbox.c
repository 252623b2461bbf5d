// SPDX-License-Identifier: Apache-2.0
/*
 * The files that documents may refer to. A sandbox allows files in or below the folder of a file
 * that the caller names, and below the include roots of the context. Links are resolved before
 * paths are compared. A document may name a way up ("..") only from these folders and from those
 * around them: so no answer depends on other folders.
 */
#include "api/api.h"
#include "api/file_system.h"

struct sandbox_root {
    struct sandbox_root *next;
    size_t size;
    size_t len;        /* length of the path, which ends with '/' only for the root of all files */
    const char *given; /* as the caller names it, behind the path */
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

/* The length of the next part of a path, a folder or a file; skips separators and "." before it. */
static size_t next_part(const char **path)
{
    size_t len = 0;
    while (file_is_separator(**path)
           || (**path == '.' && ((*path)[1] == '\0' || file_is_separator((*path)[1]))))
        ++*path;
    while ((*path)[len] && !file_is_separator((*path)[len]))
        len++;
    return len;
}

static bool is_up(const char *part, size_t len)
{
    return len == 2 && memcmp(part, "..", 2) == 0;
}

static bool has_up(const char *path)
{
    for (size_t len; (len = next_part(&path)) != 0; path += len)
        if (is_up(path, len))
            return true;
    return false;
}

/* True if nothing is to be kept about a folder. Its name matters where it has a way up. */
static bool is_kept(const struct mxg_context *context, const char *real, const char *given)
{
    if (!has_up(given))
        return is_known(context, real);
    for (const struct sandbox_root *root = context->roots; root; root = root->next)
        if (strcmp(root->path, real) == 0 && strcmp(root->given, given) == 0)
            return true;
    return false;
}

static bool add(struct mxg_context *context, const char *path, const char *given)
{
    size_t len = strlen(path), given_size = strlen(given) + 1,
           size = sizeof(struct sandbox_root) + len + 1 + given_size;
    if (is_kept(context, path, given))
        return true;
    struct sandbox_root *root = context->mem.realloc(context->mem.user_data, NULL, 0, size);
    if (!root)
        return false;
    *root = (struct sandbox_root){
        .next = context->roots, .size = size, .len = len, .given = root->path + len + 1};
    memcpy(root->path, path, len + 1);
    memcpy(root->path + len + 1, given, given_size);
    context->roots = root;
    atomic_fetch_add(&context->used, size);
    return true;
}

bool sandbox_admit_folder(struct mxg_context *context, const char *folder)
{
    char real[PATH_MAX];
    return !context->sandbox || !file_real_path(folder, real) || add(context, real, folder);
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

/* The folders that a name may lead to: those of the context, and that of a file. */
struct bounds {
    const struct mxg_context *context;
    char folder[PATH_MAX], real[PATH_MAX]; /* of the file, as given and without links; "": none */
};

/* `from` may be NULL. */
static void set_bounds(struct bounds *bounds, const struct mxg_context *context, const char *from)
{
    bounds->context = context;
    if (!from || !folder_of(from, bounds->folder) || !file_real_path(bounds->folder, bounds->real))
        bounds->folder[0] = bounds->real[0] = '\0';
}

static bool is_in(const struct bounds *bounds, const char *real)
{
    return is_known(bounds->context, real)
           || (bounds->real[0] && is_below(bounds->real, strlen(bounds->real), real));
}

/* True for a folder around one of the allowed ones. */
static bool is_around(const struct bounds *bounds, const char *real)
{
    size_t len = strlen(real);
    for (const struct sandbox_root *root = bounds->context->roots; root; root = root->next)
        if (is_below(real, len, root->path))
            return true;
    return bounds->real[0] && is_below(real, len, bounds->real);
}

/*
 * True if the path, or the innermost folder of it that exists, is in an allowed folder. So the
 * answer for a path outside does not depend on the files there.
 */
static bool is_inside(const struct bounds *bounds, const char *path)
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
    return is_in(bounds, real);
}

/* The length of the folders with which both paths begin. */
static size_t common_begin(const char *path, const char *folder)
{
    size_t common = 0;
    for (size_t i = 0;; i++) {
        bool ends = file_is_separator(path[i]),
             folder_ends = !folder[i] || file_is_separator(folder[i]);
        if (ends && folder_ends)
            common = i;
        if (!folder[i] || (ends ? !folder_ends : path[i] != folder[i]))
            return common;
    }
}

/*
 * The length of the begin of a path that is no choice of a document: folders in the order in which
 * the caller names them, or the ways up from the working directory.
 */
static size_t free_begin(const struct bounds *bounds, const char *path)
{
    size_t longest = common_begin(path, bounds->folder);
    for (const struct sandbox_root *root = bounds->context->roots; root; root = root->next) {
        size_t len = common_begin(path, root->given);
        longest = len > longest ? len : longest;
    }
    const char *at = path;
    for (size_t len = next_part(&at); is_up(at, len); len = next_part(&at))
        at += len;
    return (size_t)(at - path) > longest ? (size_t)(at - path) : longest;
}

/*
 * Goes up from a folder, to the path without links where it exists. False if it is neither in nor
 * around the allowed folders.
 */
static bool go_up(const struct bounds *bounds, char at[PATH_MAX])
{
    char real[PATH_MAX];
    bool exists = file_real_path(at[0] ? at : ".", real);
    if (exists ? !is_in(bounds, real) && !is_around(bounds, real) : !is_inside(bounds, at))
        return false;
    if (exists)
        memcpy(at, real, strlen(real) + 1);
    size_t len = strlen(at);
    while (len > 1 && file_is_separator(at[len - 1]))
        len--;
    while (len > 0 && !file_is_separator(at[len - 1]))
        len--;
    at[len] = '\0';
    return true;
}

/* True if each ".." of a path leaves a folder in or around the allowed ones. */
static bool keeps_within(const struct bounds *bounds, const char *path)
{
    char at[PATH_MAX];
    size_t len = free_begin(bounds, path);
    if (!has_up(path + len))
        return true;
    if (strlen(path) >= sizeof at)
        return false;
    memcpy(at, path, len);
    at[len] = '\0';
    path += len;
    for (size_t part; (part = next_part(&path)) != 0; path += part) {
        len = strlen(at);
        if (is_up(path, part)) {
            if (!go_up(bounds, at))
                return false;
        } else if (len + part + 2 > sizeof at) {
            return false;
        } else {
            bool has_end = len == 0 || file_is_separator(at[len - 1]);
            at[len] = '/';
            memcpy(at + len + !has_end, path, part);
            at[len + !has_end + part] = '\0';
        }
    }
    return true;
}

/* True if the sandbox, which there is, lets a document read a path; `from` may be NULL. */
static bool is_allowed(const struct mxg_context *context, const char *from, const char *path)
{
    struct bounds bounds;
    set_bounds(&bounds, context, from);
    return keeps_within(&bounds, path) && is_inside(&bounds, path);
}

const char sandbox_outside[] = "it is outside the folders that documents may read";
static const char irregular[] = "it is not a regular file";

const char *sandbox_texture_fault(const struct mxg_context *context, const char *path)
{
    return context->sandbox && !is_allowed(context, NULL, path) ? sandbox_outside : NULL;
}

const char *sandbox_fault(const struct mxg_context *context, const char *path)
{
    const char *fault = sandbox_texture_fault(context, path);
    /* A missing file has none: the attempt to open it gives the reason. */
    return !fault && file_facts(path).kind == FILE_OTHER ? irregular : fault;
}

/* A pipe that the caller names is no file of a stranger. */
const char *sandbox_named_fault(const struct mxg_context *context, const char *path)
{
    bool is_file =
        context->sandbox && stdio_is_resolver(context) && file_facts(path).kind == FILE_REGULAR;
    return is_file ? sandbox_texture_fault(context, path) : NULL;
}

const char *mxg_context_file_fault(const mxg_context *context, const char *from, const char *path)
{
    if (!context || !from || !path)
        return "it has no name";
    if (context->sandbox && !is_allowed(context, from, path))
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
