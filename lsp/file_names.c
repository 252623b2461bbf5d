// SPDX-License-Identifier: Apache-2.0
/*
 * Files that the editor renames or moves: the names that documents have for them follow, and those
 * in a document that moves. A name behind a `fileprefix` that is no folder stays.
 */
#include "lsp/family.h"
#include "lsp/handlers.h"
#include "lsp/named_elements.h"
#include "lsp/wire.h"
#include "program/cli.h"
#include "program/files.h"
#include "program/memory.h"
#include "program/relocate.h"

#include <stdlib.h>
#include <string.h>

/* A renamed file or folder. */
struct renamed {
    char *from, *to;
};

struct renaming {
    struct renamed *files;
    size_t num_files;
};

/* The path of a file after the renaming. The caller frees it. */
static char *path_after(const struct renaming *renaming, const char *path)
{
    for (size_t i = 0; i < renaming->num_files; ++i) {
        const struct renamed *file = &renaming->files[i];
        size_t len = strlen(file->from);
        if (strncmp(path, file->from, len) == 0 && (!path[len] || path[len] == '/'))
            return cli_format("%s%s", file->to, path + len);
    }
    return cli_format("%s", path);
}

/* The folder of a path, with its '/'. The caller frees it. */
static char *folder_of(const char *path)
{
    return cli_copy(path, (size_t)(files_base_name(path) - path));
}

/*
 * The name of `file` in a document at `path` behind a prefix. NULL: its text would need escapes.
 * The caller frees it.
 */
static char *name_in(const char *path, const char *prefix, const char *file)
{
    char *base = cli_format("%s-", prefix), *beside = disk_join(path, base),
         *from = folder_of(beside), *to = folder_of(file), *way = relocate_way(from, to),
         *name = cli_format("%s%s", way, files_base_name(file));
    free(base);
    free(beside);
    free(from);
    free(to);
    free(way);
    if (!strpbrk(name, "&<\"'"))
        return name;
    free(name);
    return NULL;
}

/* The edit of one name; NULL: it stays. */
static json_t *rename_file(const struct renaming *renaming, const struct lsp_query *query,
                           struct span value, const char *prefix)
{
    char *file = cli_format("%s%.*s", prefix, (int)(value.end - value.start),
                            query->text->bytes + value.start);
    size_t len = strlen(prefix);
    bool is_plain = *file && *file != '/' && !strpbrk(file, "&\\") && !strstr(file, "://")
                    && (!len || prefix[len - 1] == '/');
    json_t *edit = NULL;
    if (is_plain) {
        const char *own = query->document->path;
        char *path = disk_join(own, file), *path_then = path_after(renaming, path),
             *own_then = path_after(renaming, own);
        bool moves = strcmp(path, path_then) != 0 || strcmp(own, own_then) != 0;
        char *name = moves ? name_in(own_then, prefix, path_then) : NULL;
        if (name && !query_equals(query->text, value, name))
            edit = wire_edit(query->session, query->text, value, name);
        free(name);
        free(path);
        free(path_then);
        free(own_then);
    }
    free(file);
    return edit;
}

static json_t *rename_in(const struct renaming *renaming, const struct lsp_query *query)
{
    json_t *edits = json_array();
    for (uint32_t i = 0; i < query->model->num_elements; ++i) {
        char prefix[QUERY_NAME];
        const struct model_attribute *file = names_file(query, i, prefix, sizeof prefix);
        json_t *edit = file ? rename_file(renaming, query, file->value, prefix) : NULL;
        if (edit)
            json_array_append_new(edits, edit);
    }
    return edits;
}

static void read_files(struct renaming *renaming, const json_t *files)
{
    size_t i;
    const json_t *file;
    renaming->files = memory_alloc((json_array_size(files) + 1) * sizeof *renaming->files);
    json_array_foreach(files, i, file)
    {
        struct renamed renamed = {wire_path(json_text_of(file, "oldUri")),
                                  wire_path(json_text_of(file, "newUri"))};
        if (renamed.from && renamed.to) {
            renaming->files[renaming->num_files++] = renamed;
            continue;
        }
        free(renamed.from);
        free(renamed.to);
    }
}

json_t *handle_will_rename(struct lsp_session *session, const json_t *params,
                           struct lsp_error *error)
{
    struct renaming renaming = {0};
    struct family family;
    json_t *edit = wire_workspace_edit();
    (void)error;
    read_files(&renaming, json_object_get(params, "files"));
    family_scan(session, &family);
    for (size_t i = 0; i < family.num_files; ++i) {
        struct lsp_query query;
        family_query(&family, i, session, &query);
        if (query.document->is_file)
            wire_add_edits(edit, query.document->uri, rename_in(&renaming, &query));
    }
    family_finish(&family);
    for (size_t i = 0; i < renaming.num_files; ++i) {
        free(renaming.files[i].from);
        free(renaming.files[i].to);
    }
    free(renaming.files);
    return edit;
}
