// SPDX-License-Identifier: Apache-2.0
/*
 * --depfile: "reports: files", for make and ninja, so that they repeat the check when one of its
 * files changes.
 */
#include "check/sink.h"
#include "program/file_name.h"

/* The report is not written with a name that make would read as something else. */
static void put_name(struct sink *sink, const char *path, bool is_target)
{
    if (!file_name_put_make(sink->out, path, is_target) && !sink->fault)
        sink->fault = "make cannot read the name of a file; rename files with control characters, "
                      "';', '=', '|' or '\\' in their names, or '%', '*', '?' or '[' in reports";
}

static void begin(struct sink *sink)
{
    for (size_t i = 0; i < sink->run->num_outputs; ++i) {
        if (i)
            putc(' ', sink->out);
        put_name(sink, sink->run->outputs[i], true);
    }
    putc(':', sink->out);
}

static void put_input(struct sink *sink, const char *path)
{
    fputs(" \\\n ", sink->out);
    put_name(sink, path, false);
}

/* Omits missing images, because a rule cannot depend on them. */
static void write_document(struct sink *sink, const struct check_document *document)
{
    for (size_t i = 0; i < document->num_files; ++i)
        put_input(sink, document->files[i]);
    for (size_t i = 0; i < document->num_images; ++i)
        if (files_is_regular(document->images[i]))
            put_input(sink, document->images[i]);
}

static void end(struct sink *sink, const struct check_totals *totals)
{
    (void)totals;
    for (size_t i = 0; i < sink->run->inputs.len; ++i)
        put_input(sink, sink->run->inputs.items[i]);
    putc('\n', sink->out);
}

const struct sink_kind sink_depfile = {
    "depfile", "writes the dependencies of the reports, for make and ninja",
    begin,     write_document,
    NULL,      end};
