// SPDX-License-Identifier: Apache-2.0
/* The files of a run: its documents, what else it reads, and the pictures that it writes. */
#include "program/files.h"
#include "program/folder.h"
#include "program/translated.h"
#include "render/job.h"

#include <stdlib.h>
#include <string.h>

char *job_frame_name(const char *output, size_t frame)
{
    const char *base = files_base_name(output), *dot = strrchr(base, '.');
    int stem = (int)(dot ? (size_t)(dot - output) : strlen(output));
    return cli_format("%.*s.%04zu%s", stem, output, frame, output + stem);
}

mxg_document *job_load(struct job *job, const char *path)
{
    mxg_document *document = translated_load(&job->cli, path, job->options.translate);
    bool good = true;
    for (uint32_t i = 0; i < mxg_document_num_files(document); ++i)
        good = outputs_read(&job->files, &job->cli.report, mxg_document_file(document, i)) && good;
    if (good)
        return document;
    job->painter.has_clash = true;
    mxg_document_destroy(document);
    return NULL;
}

/* Collects the documents, including those in folders. */
static bool find_documents(struct job *job)
{
    const char *reason = NULL,
               *path = folder_documents(&job->cli.parser.inputs, &job->found, &reason);
    if (path)
        report_error(&job->cli.report, "nothing-to-render", "'%s': %s", path, reason);
    return !path;
}

/* Notes the files that every picture needs. */
static bool claim_inputs(struct job *job)
{
    struct report *report = &job->cli.report;
    bool good = true;
    for (size_t i = 0; i < job->found.len; ++i)
        good = outputs_read(&job->files, report, job->found.items[i]) && good;
    for (uint32_t i = 0; i < mxg_library_num_files(job->cli.library); ++i)
        good = outputs_read(&job->files, report, mxg_library_file(job->cli.library, i)) && good;
    if (job->painter.studio.environment)
        good = outputs_read(&job->files, report, job->painter.studio.environment) && good;
    if (job->options.stage)
        good = outputs_read(&job->files, report, job->options.stage) && good;
    if (files_is_regular(job->painter.studio.mesh))
        good = outputs_read(&job->files, report, job->painter.studio.mesh) && good;
    return good;
}

/* Notes the pictures; false after an error: one of them is an input, or two are one file. */
static bool claim_outputs(struct job *job)
{
    struct report *report = &job->cli.report;
    bool good = true;
    for (size_t i = 0; i < job->options.frames; ++i) {
        char *name = job_frame_name(job->options.output, i);
        good = good && outputs_write(&job->files, report, name, "the turntable");
        free(name);
    }
    if (job->options.output && !job->options.frames)
        good = outputs_write(&job->files, report, job->options.output, "-o") && good;
    if (job->options.copy)
        good = outputs_write(&job->files, report, job->options.copy, "--copy") && good;
    return claim_inputs(job) && good;
}

/* Checked before rendering, which may take long. */
static bool can_write(struct job *job, const char *path)
{
    char reason[256];
    if (!path || image_can_write(path, reason, sizeof reason))
        return true;
    report_error(&job->cli.report, "output-failed", "cannot write '%s': %s", path, reason);
    return false;
}

bool job_claim_files(struct job *job)
{
    return can_write(job, job->options.output) && can_write(job, job->options.copy)
           && find_documents(job) && claim_outputs(job);
}
