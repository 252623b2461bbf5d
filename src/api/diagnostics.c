// SPDX-License-Identifier: Apache-2.0
#include "api/api.h"

#include <assert.h>

uint32_t mxg_diagnostics_num_items(const mxg_diagnostics *list)
{
    return list ? list->list.items.len : 0;
}

uint32_t mxg_diagnostics_num_errors(const mxg_diagnostics *list)
{
    return list ? list->list.num_errors : 0;
}

static const mxg_severity severities[] = {[DIAG_ERROR] = MXG_SEVERITY_ERROR,
                                          [DIAG_WARNING] = MXG_SEVERITY_WARNING,
                                          [DIAG_NOTE] = MXG_SEVERITY_NOTE,
                                          [DIAG_REMARK] = MXG_SEVERITY_NOTE};

mxg_status mxg_diagnostics_item(const mxg_diagnostics *list, uint32_t index, mxg_diagnostic *out)
{
    if (index >= mxg_diagnostics_num_items(list))
        return MXG_ERROR_ARGUMENT;
    const struct diag *diag = &list->list.items.items[index];
    assert(diag->parent <= index);
    assert((size_t)diag->severity < sizeof severities / sizeof *severities);
    mxg_diagnostic full = {
        .severity = severities[diag->severity],
        .id = diag_id_text(diag->id),
        .message = diag->message,
        .file = diag->place.file,
        .path = diag->place.path ? diag->place.path : "",
        .line = diag->place.line,
        .column = diag->place.column,
        .length = diag->place.length,
        .parent = diag->parent,
        .num_arguments = diag->num_arguments,
    };
    return struct_write(out, &full, sizeof full);
}

const char *mxg_diagnostics_argument(const mxg_diagnostics *list, uint32_t item, uint32_t index)
{
    if (item >= mxg_diagnostics_num_items(list))
        return NULL;
    const struct diag *diag = &list->list.items.items[item];
    return index < diag->num_arguments ? diag->arguments[index] : NULL;
}

uint32_t mxg_catalogue_num_diagnostic_kinds(void)
{
    return DIAG_NUM_IDS;
}

mxg_status mxg_catalogue_diagnostic_kind(uint32_t index, mxg_diagnostic_kind *out)
{
    if (index >= DIAG_NUM_IDS)
        return MXG_ERROR_ARGUMENT;
    const struct diag_explanation *explanation = diag_explain((enum diag_id)index);
    mxg_diagnostic_kind full = {
        .id = diag_id_text((enum diag_id)index),
        .severity = severities[diag_id_severity((enum diag_id)index)],
        .message = diag_id_format((enum diag_id)index),
        .cause = explanation->cause,
        .cure = explanation->cure,
        .example = explanation->example,
    };
    return struct_write(out, &full, sizeof full);
}

struct format_job {
    const struct diag *diag;
    const char *line;
    size_t line_size;
    bool colour;
    struct text text;
};

static void run_job(void *arg)
{
    struct format_job *job = arg;
    diag_render(job->diag, job->line, job->line_size, job->colour, &job->text);
    job->text.len--; /* the end of the last line */
}

/* Formats the text in memory of its own, because other threads may read the same list. */
size_t mxg_diagnostics_format(const mxg_diagnostics *list, uint32_t index, const char *line,
                              size_t line_size, bool colour, char *buffer, size_t capacity)
{
    text_copy("", 0, buffer, capacity);
    if (index >= mxg_diagnostics_num_items(list))
        return 0;
    struct object scratch = {.size = 0};
    object_init(&scratch, list->owner->context, 0);
    struct format_job job = {.diag = &list->list.items.items[index],
                             .line = line,
                             .line_size = line_size,
                             .colour = colour};
    text_init(&job.text, &scratch.arena);
    size_t len = 0;
    if (object_run(&scratch, run_job, &job) == MXG_OK)
        len = text_copy(job.text.data, job.text.len, buffer, capacity);
    arena_finish(&scratch.arena);
    atomic_fetch_sub(&scratch.context->used, scratch.counted);
    return len;
}

const mxg_diagnostics *mxg_library_diagnostics(const mxg_library *library)
{
    return library ? &library->object.diagnostics : NULL;
}

const mxg_diagnostics *mxg_document_diagnostics(const mxg_document *document)
{
    return document ? &document->object.diagnostics : NULL;
}
