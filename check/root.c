// SPDX-License-Identifier: Apache-2.0
#define _XOPEN_SOURCE 700 /* realpath */
#include "check/root.h"

#include "program/cli.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Removes ".", ".." and repeated slashes from an absolute path, in place. */
static void tidy(char *path)
{
    char *out = path;
    for (const char *at = path; *at;) {
        at += strspn(at, "/");
        size_t len = strcspn(at, "/");
        if (len == 2 && strncmp(at, "..", 2) == 0) {
            while (out > path && *--out != '/') {
            }
        } else if (len && (len != 1 || *at != '.')) {
            *out++ = '/';
            memmove(out, at, len);
            out += len;
        }
        at += len;
    }
    if (out == path)
        *out++ = '/';
    *out = '\0';
}

/* An absolute path without "." and ".."; NULL without a working directory. */
static char *absolute(const char *path)
{
    char *folder = *path == '/' ? NULL : realpath(".", NULL);
    if (*path != '/' && !folder)
        return NULL;
    char *whole = folder ? cli_format("%s/%s", folder, path) : cli_format("%s", path);
    free(folder);
    tidy(whole);
    return whole;
}

bool check_root_open(struct check_root *root, const char *folder)
{
    root->given = absolute(folder ? folder : ".");
    root->physical = realpath(folder ? folder : ".", NULL);
    return root->given && root->physical;
}

void check_root_finish(struct check_root *root)
{
    free(root->given);
    free(root->physical);
    free(root->folder);
    free(root->prefix);
    *root = (struct check_root){0};
}

/* The part of `path` below `root`, with a '/' at its end unless it is empty; NULL: it is outside.
 */
static char *below(const char *root, const char *path)
{
    size_t len = strlen(root);
    if (!path)
        return NULL;
    if (len == 1) /* "/" */
        len = 0;
    if (strncmp(root, path, len) != 0 || (path[len] && path[len] != '/'))
        return NULL;
    path += len + (path[len] == '/');
    return *path ? cli_format("%s/", path) : cli_format("%s", "");
}

/*
 * Several paths may lead to a folder, so the path without links counts first. A link in the root
 * may lead out of it: then the path as it is given counts.
 */
static char *find_prefix(const struct check_root *root, const char *folder)
{
    char *physical = realpath(folder, NULL), *prefix = below(root->physical, physical);
    free(physical);
    if (prefix)
        return prefix;
    char *given = absolute(folder);
    prefix = below(root->given, given);
    free(given);
    return prefix;
}

/* Files come folder by folder, so the prefix of the last folder usually serves again. */
const char *check_root_name(struct check_root *root, struct store *store, const char *path)
{
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path;
    size_t len = (size_t)(base - path);
    if (!root->folder || strncmp(root->folder, path, len) != 0 || root->folder[len]) {
        free(root->folder);
        free(root->prefix);
        root->folder = cli_copy(path, len);
        root->prefix = find_prefix(root, len ? root->folder : ".");
    }
    if (!root->prefix)
        return "";
    size_t prefix_len = strlen(root->prefix), base_len = strlen(base);
    char *name = store_alloc(store, prefix_len + base_len + 1);
    memcpy(name, root->prefix, prefix_len);
    memcpy(name + prefix_len, base, base_len);
    return name;
}
