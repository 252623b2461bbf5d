// SPDX-License-Identifier: Apache-2.0
#define _XOPEN_SOURCE 700
#include "program/relocate.h"
#include "program/files.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

char *relocate_folder(const char *file)
{
    int len = (int)(files_base_name(file) - file);
    char *folder = len ? cli_format("%.*s", len, file) : cli_format(".");
    char *real = realpath(folder, NULL), *out = NULL;
    if (real)
        out = cli_format("%s%s", real, strcmp(real, "/") == 0 ? "" : "/");
    free(folder);
    free(real);
    return out;
}

char *relocate_way(const char *from, const char *to)
{
    size_t shared = 0, ups = 0;
    for (size_t i = 0; from[i] && from[i] == to[i]; ++i)
        if (from[i] == '/')
            shared = i + 1;
    for (const char *rest = from + shared; *rest; ++rest)
        ups += *rest == '/';
    char *out = cli_format("%s", "");
    for (size_t i = 0; i < ups; ++i) {
        char *longer = cli_format("%s../", out);
        free(out);
        out = longer;
    }
    char *way = cli_format("%s%s", out, to + shared);
    free(out);
    return way;
}

/* The folder of a file, which may be missing: then it is where it would be. */
static char *find_folder(const char *file)
{
    char *real = relocate_folder(file);
    size_t len = (size_t)(files_base_name(file) - file);
    while (len && file[len - 1] == '/')
        len--;
    if (real || !len)
        return real;
    char *folder = cli_copy(file, len), *around = find_folder(folder), *out = NULL;
    const char *name = files_base_name(folder);
    bool is_here = strcmp(name, ".") == 0;
    if (around && strcmp(name, "..") == 0) {
        around[strlen(around) - 1] = '\0';
        out = find_folder(around);
    } else if (around) {
        out = cli_format("%s%s%s", around, is_here ? "" : name, is_here ? "" : "/");
    }
    free(folder);
    free(around);
    return out;
}

char *relocate_file(const char *folder, const char *path)
{
    char *inside = cli_format("%s/", folder), *from = find_folder(inside),
         *there = find_folder(path), *out = NULL;
    if (from && there) {
        char *way = relocate_way(from, there);
        out = cli_format("%s%s", way, files_base_name(path));
        free(way);
    }
    free(inside);
    free(from);
    free(there);
    return out ? out : cli_format("%s", path);
}

static bool is_absolute(const char *prefix)
{
    return prefix[0] == '/' || strstr(prefix, "://");
}

static bool set_prefix(mxg_edit *edit, const mxg_document *document, mxg_element element,
                       const char *way)
{
    mxg_attribute attribute = {.size = sizeof attribute, .value = ""};
    uint32_t index = mxg_document_find_attribute(document, element, "fileprefix");
    if (index != MXG_NONE)
        mxg_document_attribute(document, element, index, &attribute);
    bool is_root = element == mxg_document_find_element(document, 0, "");
    if ((index == MXG_NONE && !is_root) || is_absolute(attribute.value))
        return true;
    char *prefix = cli_format("%s%s", way, attribute.value);
    bool good = mxg_edit_set_attribute(edit, element, "fileprefix", prefix) == MXG_OK;
    free(prefix);
    return good;
}

static mxg_document *with_way(struct cli *cli, mxg_document *document, const char *way)
{
    mxg_edit *edit = NULL;
    mxg_document *out = NULL;
    mxg_status status = mxg_edit_create(cli->context, cli->library, document, NULL, &edit);
    bool good = status == MXG_OK;
    const mxg_element root = mxg_document_find_element(document, 0, "");
    for (mxg_element e = root; e && good; e = cli_next_element(document, root, e))
        good = set_prefix(edit, document, e, way);
    status = good ? mxg_edit_commit(edit, &out) : status == MXG_OK ? MXG_ERROR_MEMORY : status;
    report_status(&cli->report, status);
    mxg_edit_destroy(edit);
    mxg_document_destroy(document);
    return out;
}

mxg_document *relocate(struct cli *cli, mxg_document *document, const char *from, const char *to)
{
    char *old = relocate_folder(from), *new = old ? relocate_folder(to) : NULL;
    if (!new)
        report_error(&cli->report, "output-failed", "cannot write '%s': %s", to, strerror(errno));
    char *way = new ? relocate_way(new, old) : NULL;
    mxg_document *out = document;
    if (!way || *way)
        out = way ? with_way(cli, document, way) : NULL;
    if (!way)
        mxg_document_destroy(document);
    free(old);
    free(new);
    free(way);
    return out;
}
