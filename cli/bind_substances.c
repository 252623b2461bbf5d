// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "cli/bind_substances.h"

#include "check/picture.h"
#include "program/files.h"
#include "program/folder.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define PICTURE_SIZE "160"

/* ---- Graphs ---- */

static void add_graph(const struct bind_substances *substances, const char *element, FILE *out)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    mxg_result *result = NULL;
    desc.target = "glsl";
    desc.element = element;
    /* faults are messages of generation, not of a page */
    if (mxg_inspect(substances->cli->context, substances->document, MXG_VIEW_GRAPH, &desc, &result)
        == MXG_OK) {
        size_t size = 0;
        const char *text = mxg_result_text(result, &size);
        fwrite(text, 1, size, out);
    }
    mxg_result_destroy(result);
}

/* The outputs of a nodegraph, each by itself. */
static void add_outputs(const struct bind_substances *substances, const char *name,
                        mxg_element graph, FILE *out)
{
    mxg_element_info info = {sizeof info};
    mxg_document_element(substances->document, graph, &info);
    for (mxg_element child = info.first_child; child; child = info.next) {
        mxg_document_element(substances->document, child, &info);
        if (strcmp(info.category, "output") != 0)
            continue;
        char *path = cli_format("%s/%s", name, info.name);
        add_graph(substances, path, out);
        free(path);
    }
}

char *substance_graph(const struct bind_substances *substances, const char *name)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    mxg_element element = mxg_document_find(substances->document, name);
    mxg_element_info info = {sizeof info};
    if (!out)
        return cli_format("%s", "");
    if (element && mxg_document_element(substances->document, element, &info) == MXG_OK) {
        if (strcmp(info.category, "nodegraph") == 0)
            add_outputs(substances, name, element, out);
        else
            add_graph(substances, name, out);
    }
    fclose(out);
    return text;
}

/* ---- Pictures ---- */

/* Draws a material to a file; false after a message. */
static bool draw(struct bind_substances *substances, const char *document, const char *name,
                 const char *picture)
{
    struct arg_list args = {0};
    int status = -1;
    args_append(&args, cli_program("mxgen-render"));
    args_append(&args, cli_format("%s", document));
    args_append(&args, cli_format("--element=%s", name));
    args_append(&args, cli_format("--output=%s", picture));
    args_append(&args, cli_format("--size=" PICTURE_SIZE));
    args_append(&args, cli_format("--missing-texture=checker"));
    cli_forward(substances->cli, &args);
    args_append(&args, NULL);
    bool good = cli_run(&substances->cli->report, (char *const *)(uintptr_t)args.items, &status);
    if (good && status != 0)
        report_error(&substances->cli->report, "no-picture", "the renderer made no picture of '%s'",
                     name);
    args_free(&args);
    return good && status == 0;
}

/* The document of a material: the user's, where textures are found, or a copy in the folder. */
static char *document_of(const struct bind_substances *substances, const char *folder,
                         const char *name)
{
    mxg_element element = mxg_document_find(substances->document, name);
    mxg_element_info info = {sizeof info};
    if (!element || mxg_document_element(substances->document, element, &info) != MXG_OK
        || strcmp(info.type, "material") != 0)
        return NULL;
    const char *dot = info.file ? strrchr(info.file, '.') : NULL;
    if (substances->file && !(dot && strncmp(dot, ".usd", 4) == 0))
        return cli_format("%s", substances->file);
    size_t size = 0;
    const char *xml = mxg_document_xml(substances->document, &size);
    char *path = cli_format("%s/document.mtlx", folder);
    if (!xml || files_write(path, xml, size)) {
        free(path);
        return NULL;
    }
    return path;
}

static char *picture_in(struct bind_substances *substances, const char *folder, const char *name)
{
    char *document = document_of(substances, folder, name), *out = NULL;
    char *path = cli_format("%s/picture.png", folder);
    if (document && draw(substances, document, name, path)) {
        struct store store = {0};
        size_t size = 0;
        char *data = files_read(path, &size);
        if (data)
            out = cli_format("%s", picture_base64(&store, data, size));
        free(data);
        store_finish(&store);
    }
    unlink(path);
    if (document && strcmp(document, substances->file ? substances->file : "") != 0)
        unlink(document);
    free(path);
    free(document);
    return out;
}

char *substance_picture(struct bind_substances *substances, const char *name)
{
    if (!substances->has_pictures)
        return NULL;
    char *folder = folder_temporary("mxgen-bind"), *out = NULL;
    if (folder) {
        out = picture_in(substances, folder, name);
        rmdir(folder);
    } else {
        report_error(&substances->cli->report, "output-failed",
                     "cannot make a folder for pictures: %s", strerror(errno));
    }
    free(folder);
    /* if one fails, all would: there may be no device */
    substances->has_pictures = !substances->cli->report.errors;
    return out;
}
