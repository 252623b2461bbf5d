// SPDX-License-Identifier: Apache-2.0
#include "import/import.h"

#include "program/files.h"
#include "program/memory.h"
#include "program/relocate.h"

#include <ctype.h>
#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

void import_tell_loss(struct importing *importing, const char *of, const char *format, ...)
{
    char text[256];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    for (char *c = text; *c; ++c)
        *c = *c == '\n' || *c == '\t' ? '?' : *c; /* a URI of the file does not end the line */
    report_warning(&importing->cli->report, "import-loss",
                   "'%s' of '%s' is not in the document as it is: %s", of, importing->source.path,
                   text);
}

char *import_free_name(struct importing *importing, const char *scope, const char *wanted,
                       bool (*is_taken)(void *user_data, const char *name), void *user_data)
{
    char *key = cli_format("%s/%s", scope, wanted), *name = cli_format("%s", wanted);
    bool is_new;
    struct name_entry *last = names_add(&importing->numbers, key, &is_new);
    last->value += is_new;
    while (is_taken(user_data, name)) {
        free(name);
        name = cli_format("%s_%llu", wanted, (unsigned long long)++last->value);
    }
    free(key);
    return name;
}

struct place {
    const mxg_edit *edit;
    mxg_element parent;
};

static bool has_element(void *user_data, const char *name)
{
    const struct place *place = user_data;
    return mxg_edit_find_element(place->edit, place->parent, name) != 0;
}

char *import_name(struct importing *importing, mxg_element parent, const char *wanted)
{
    struct place place = {importing->edit, parent};
    char *valid =
             cli_format("%s%s", isdigit((unsigned char)*wanted) || !*wanted ? "_" : "", wanted),
         *scope = cli_format("%llu", (unsigned long long)parent);
    for (char *at = valid; *at; ++at)
        *at = isalnum((unsigned char)*at) && (unsigned char)*at < 0x80 ? *at : '_';
    char *name = import_free_name(importing, scope, valid, has_element, &place);
    free(scope);
    free(valid);
    return name;
}

bool import_write_file(struct importing *importing, const char *name, const void *data, size_t size)
{
    struct report *report = &importing->cli->report;
    bool is_printed = strcmp(importing->output, "-") == 0;
    if (is_printed && strcmp(name, "-") != 0) {
        report_error(report, "output-failed",
                     "cannot write '%s': '-o -' prints the document alone; name a file", name);
        return false;
    }
    char *path = is_printed ? cli_format("-") : cli_format("%s%s", importing->folder, name);
    bool is_free = outputs_write(&importing->outputs, report, path, "a file beside the document");
    const char *reason = is_free ? batch_write(&importing->files, path, data, size) : NULL;
    if (reason)
        report_error(report, "output-failed", "cannot write '%s': %s", path, reason);
    free(path);
    return is_free && !reason;
}

/* ---- The document ---- */

static void add_materials(struct importing *importing)
{
    const struct gltf_source *source = &importing->source;
    size_t num = json_array_size(json_object_get(source->root, "materials"));
    importing->materials = memory_alloc((num + 1) * sizeof *importing->materials);
    mxg_edit_set_attribute(importing->edit, mxg_edit_find_element(importing->edit, 0, ""),
                           "colorspace", "lin_rec709");
    for (size_t i = 0; i < num; ++i)
        importing->materials[importing->num_materials++] = import_add_material(importing, i);
    if (!num)
        report_error(&importing->cli->report, "import-file",
                     "cannot read '%s': it has no materials", source->path);
    import_add_looks(importing);
}

/* Writes the document that the edit makes. */
static void write_document(struct importing *importing)
{
    struct cli *cli = importing->cli;
    mxg_document *document = NULL;
    char reason[256] = "";
    size_t size = 0;
    mxg_edit_error(importing->edit, reason, sizeof reason);
    if (*reason)
        report_error(&cli->report, "import-file", "cannot read '%s': %s", importing->source.path,
                     reason);
    else
        report_status(&cli->report, mxg_edit_commit(importing->edit, &document));
    const char *text = document ? mxg_document_xml(document, &size) : NULL;
    if (document)
        report_list(&cli->report, mxg_document_diagnostics(document));
    if (text && !cli->report.errors)
        import_write_file(importing, files_base_name(importing->output), text, size);
    mxg_document_destroy(document);
}

static void run(struct importing *importing)
{
    struct cli *cli = importing->cli;
    size_t num = json_array_size(json_object_get(importing->source.root, "materials"));
    importing->folder = relocate_folder(importing->output);
    if (!importing->folder) {
        report_error(&cli->report, "output-failed", "cannot write '%s': %s", importing->output,
                     strerror(errno));
        return;
    }
    importing->num_images = json_array_size(json_object_get(importing->source.root, "images"));
    importing->images = memory_alloc((importing->num_images + 1) * sizeof *importing->images);
    outputs_read(&importing->outputs, &cli->report, importing->source.path);
    if (report_status(&cli->report, mxg_edit_create(cli->context, cli->library, NULL,
                                                    importing->output, &importing->edit))) {
        add_materials(importing);
        write_document(importing);
    }
    bool good = batch_end(&importing->files, &cli->report, !cli->report.errors);
    if (good && !cli->quiet)
        fprintf(stderr, "note: '%s' has %zu material%s\n", importing->output, num,
                num == 1 ? "" : "s");
}

void import_document(struct cli *cli, const char *path, const char *output)
{
    struct importing importing = {.cli = cli, .output = output};
    const char *fault = mxg_context_file_fault(cli->context, path, path);
    if (!fault && gltf_source_open(&importing.source, cli->context, path))
        run(&importing);
    else
        report_error(&cli->report, "import-file", "cannot read '%s': %s", path,
                     fault ? fault : importing.source.fault);
    mxg_edit_destroy(importing.edit);
    gltf_source_close(&importing.source);
    outputs_finish(&importing.outputs);
    for (size_t i = 0; i < importing.num_images; ++i)
        free(importing.images[i].name);
    free(importing.images);
    for (size_t i = 0; i < importing.num_materials; ++i)
        free(importing.materials[i]);
    free(importing.materials);
    free(importing.folder);
    names_finish(&importing.numbers);
}
