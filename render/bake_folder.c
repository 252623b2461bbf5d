// SPDX-License-Identifier: Apache-2.0
/* mxgen bake of a folder: its documents one after the other. */
#define _XOPEN_SOURCE 700
#include "render/bake.h"

#include "program/files.h"
#include "program/folder.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct many {
    struct baking *baking;
    const char *from, *to; /* folders */
    size_t num_baked, num_failed, num_empty;
};

/* True for what an earlier bake wrote, where the output folder is inside of the other. */
static bool is_output(const struct many *many, const char *path)
{
    char *folder = realpath(many->to, NULL), *file = realpath(path, NULL);
    size_t len = folder ? strlen(folder) : 0;
    bool is = folder && file && strncmp(file, folder, len) == 0 && file[len] == '/';
    free(folder);
    free(file);
    return is;
}

/* The folder for a document: "flat/wood" for "materials/wood/oak.mtlx". The caller frees it. */
static char *folder_for(const struct many *many, const char *path)
{
    const char *below = path + strlen(many->from), *base = files_base_name(path);
    below += strspn(below, "/");
    return base > below ? cli_format("%s/%.*s", many->to, (int)(base - below - 1), below)
                        : cli_format("%s", many->to);
}

/* Removes the folders that a document left empty. */
static void tidy(const struct many *many, const char *folder)
{
    char *path = cli_format("%s", folder);
    size_t least = strlen(many->to);
    while (strlen(path) > least && rmdir(path) == 0)
        *strrchr(path, '/') = '\0';
    free(path);
}

/* Returns true if the document is baked, or has nothing to bake. */
static bool bake_one(struct many *many, const char *path)
{
    struct baking *baking = many->baking;
    bake_begin(baking, path);
    mxg_document *document = cli_load(&baking->cli, path);
    bool is_empty = document && !mxg_document_num_renderables(document)
                    && baking->cli.report.errors == baking->errors_before,
         good = is_empty || (document && bake_document(baking, document));
    if (is_empty && !baking->cli.quiet)
        fprintf(stderr, "note: '%s' has no material and no output\n", path);
    many->num_empty += is_empty;
    many->num_baked += good && !is_empty;
    bake_finish(baking);
    mxg_document_destroy(document);
    return good;
}

static void bake_next(struct many *many, const char *path)
{
    struct baking *baking = many->baking;
    const struct bake_options options = baking->options;
    char *folder = folder_for(many, path);
    baking->options.output = folder;
    if (!bake_one(many, path)) {
        many->num_failed++;
        tidy(many, folder);
    }
    const struct cli cli = baking->cli;
    *baking = (struct baking){.cli = cli, .options = options};
    free(folder);
}

void bake_folder(struct baking *baking, const char *folder)
{
    struct many many = {.baking = baking, .from = folder, .to = baking->options.output};
    struct arg_list documents = {0};
    const char *reason = folder_find(folder, ".mtlx", &documents);
    if (!reason && !documents.len)
        reason = "the folder has no document (.mtlx)";
    if (reason)
        report_error(&baking->cli.report, "file-unreadable", "cannot read '%s': %s", folder,
                     reason);
    for (size_t i = 0; i < documents.len; ++i)
        if (!is_output(&many, documents.items[i]))
            bake_next(&many, documents.items[i]);
    if (!baking->cli.quiet && !reason)
        fprintf(stderr, "note: %zu baked, %zu failed, %zu without anything to bake\n",
                many.num_baked, many.num_failed, many.num_empty);
    args_free(&documents);
}
